// SPDX-License-Identifier: MIT OR Apache-2.0
// Handles: copies, moves, adoption, and that everything is freed once.
#include "support/check.hpp"
#include "support/elsewhere.hpp"

#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

namespace {

static_assert(std::is_nothrow_move_constructible_v<embound::Geometry>);
static_assert(std::is_copy_constructible_v<embound::Geometry> && std::is_copy_assignable_v<embound::Geometry>);
static_assert(!std::is_convertible_v<emb_geom *, embound::Geometry>, "adoption is asked for by name");

const embound::Point origin{0.0, 0.0, 0.0};

// A function whose copies are counted.
struct Counted {
    std::shared_ptr<int> alive;
    double operator()(double x, double, double) const { return x; }
};

} // namespace

TEST(copies_share_and_moves_empty) {
    embound::Geometry a = embound::sphere(origin, 1.0);
    const embound::Geometry b = a;
    CHECK(check::same_bits(a(3.0, 4.0, 0.0), 4.0) && check::same_bits(b(3.0, 4.0, 0.0), 4.0));
    const embound::Geometry c = std::move(a);
    CHECK(!a && b && c);
    CHECK(std::isnan(a(0.0, 0.0, 0.0)));
    CHECK(check::status_of([&] { a.bounds(); }) == EMB_ERROR_NULL_ARGUMENT);
    a = c;
    CHECK(a(0.0, 0.0, 2.0) == 1.0);
    embound::Geometry &alias = a;
    a = alias;
    a = std::move(alias);
    CHECK(a && a(0.0, 0.0, 2.0) == 1.0);
    const embound::Geometry empty;
    const embound::Geometry copy_of_empty = empty;
    CHECK(!copy_of_empty);
}

TEST(handles_are_adopted_lent_and_given_up) {
    emb_geom *handle = nullptr;
    CHECK(emb_geom_sphere(origin.data(), 1.0, &handle) == EMB_OK);
    embound::Geometry g(handle);
    CHECK(g.get() == handle);
    CHECK(emb_geom_value_fn(g.get(), 2.0, 0.0, 0.0) == 1.0);
    emb_geom *given = g.release();
    CHECK(given == handle && !g);
    CHECK(emb_geom_value(given, 2.0, 0.0, 0.0) == 1.0);
    emb_geom_free(given);
}

TEST(parts_live_as_long_as_what_is_made_of_them) {
    embound::Geometry g;
    {
        const embound::Geometry ball = embound::sphere(origin, 1.0);
        const std::vector<embound::Geometry> parts{ball, embound::translate(ball, {3.0, 0.0, 0.0})};
        g = embound::unite(parts);
    }
    CHECK(g(0.0, 0.0, 0.0) == -1.0 && g(3.0, 0.0, 0.0) == -1.0 && g(1.5, 0.0, 0.0) == 0.5);
}

TEST(a_function_dies_once_with_its_last_geometry) {
    auto alive = std::make_shared<int>(0);
    {
        embound::Geometry g = embound::function(Counted{alive});
        CHECK(alive.use_count() == 2);
        const embound::Geometry copy = g;
        const embound::Geometry inside_out = embound::complement(g);
        g = embound::Geometry();
        CHECK(alive.use_count() == 2 && copy(2.0, 0.0, 0.0) == 2.0 && inside_out(2.0, 0.0, 0.0) == -2.0);
    }
    CHECK(alive.use_count() == 1);
    embound::FunctionOptions wrong;
    wrong.gradient_step = -1.0;
    CHECK(check::status_of([&] { embound::function(Counted{alive}, wrong); }, "gradient_step") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(alive.use_count() == 1);
}

TEST(an_executor_dies_once_with_the_last_copy_of_its_pool) {
    auto alive = std::make_shared<int>(0);
    const auto serial = [alive](std::size_t tasks, embound::Task task) {
        for (std::size_t i = 0; i < tasks; ++i) {
            task(i);
        }
    };
    CHECK(alive.use_count() == 2);
    {
        const embound::Run run = embound::Pool::from_executor(3, serial);
        CHECK(alive.use_count() == 3); // the pool is gone, the run keeps it
        const std::vector<double> axis = check::axis(-1.0, 1.0, 20);
        const embound::Geometry ball = embound::sphere(origin, 0.5);
        const embound::Lattice lattice(axis, axis, axis);
        CHECK(check::same_bits(ball.fill(lattice, embound::FillMode::Exact, run), ball.fill(lattice)));
    }
    CHECK(alive.use_count() == 2);
    CHECK(check::status_of([&] { embound::Pool::from_executor(0, serial); }, "width") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(alive.use_count() == 2);
    CHECK(check::status_of([] { embound::Pool pool(1000000); }, "threads") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(errors_name_the_argument) {
    CHECK(check::status_of([] { embound::sphere(origin, -2.0); }, "radius") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([] { embound::Mesh::read("/nowhere/at/all.stl"); }, "/nowhere/at/all.stl") == EMB_ERROR_IO);
    std::string message;
    try {
        embound::sphere(origin, std::nan(""));
    } catch (const std::runtime_error &error) {
        message = error.what();
    }
    CHECK(!message.empty() && message == emb_last_error());
}

TEST(another_translation_unit_throws_the_same_types) {
    const embound::Geometry g = elsewhere::throws_its_number(23);
    CHECK(check::thrown<elsewhere::Number>([&] { g(0.0, 0.0, 0.0); }, elsewhere::Number{0}).value == 23);
    CHECK(check::status_of(elsewhere::fails, "radius") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(defaults_are_the_librarys) {
    emb_mesh_options mesh;
    emb_sdf_options sdf;
    emb_callback_options callback;
    CHECK(emb_mesh_options_init(&mesh, sizeof mesh) == EMB_OK);
    CHECK(emb_sdf_options_init(&sdf, sizeof sdf) == EMB_OK);
    CHECK(emb_callback_options_init(&callback, sizeof callback) == EMB_OK);
    const emb_mesh_options m = embound::MeshOptions{}.c();
    CHECK(m.scale == mesh.scale && m.weld_tolerance == mesh.weld_tolerance && m.orient == mesh.orient);
    CHECK(m.format == mesh.format && m.index_base == mesh.index_base);
    CHECK(std::memcmp(m.rotation, mesh.rotation, sizeof m.rotation) == 0);
    CHECK(std::memcmp(m.shift, mesh.shift, sizeof m.shift) == 0);
    const emb_sdf_options s = embound::SdfOptions{}.c();
    CHECK(s.sign == sdf.sign && s.open == sdf.open && s.axis == sdf.axis && s.accelerator == sdf.accelerator);
    const emb_callback_options c = embound::FunctionOptions{}.c();
    CHECK(std::memcmp(c.lo, callback.lo, sizeof c.lo) == 0 && std::memcmp(c.hi, callback.hi, sizeof c.hi) == 0);
    CHECK(c.lipschitz == callback.lipschitz && c.gradient_step == callback.gradient_step);
    CHECK(c.kind == callback.kind && c.thread_safe == callback.thread_safe);
}
