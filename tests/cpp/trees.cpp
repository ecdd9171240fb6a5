// SPDX-License-Identifier: MIT OR Apache-2.0
// Every constructor through the C++ layer, against closed forms; functions with what is known of them; blends.
#include "support/check.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace {

using embound::Geometry;
using embound::Point;

const Point origin{0.0, 0.0, 0.0}, up{0.0, 0.0, 2.0}, right{1.0, 0.0, 0.0};
const embound::Matrix quarter{0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};

bool near(double a, double b) { return std::fabs(a - b) < 1e-12; }

// Not a std::exception, on purpose.
struct Boom {
    int number;
};

template <class Work> int boom(Work &&work) { return check::thrown<Boom>(work, Boom{-1}).number; }

emb_status refused(const std::string &word, Geometry (*make)()) { return check::status_of(make, word); }

const std::vector<double> axis = check::axis(-1.5, 1.5, 21);
const embound::Lattice lattice(axis, axis, axis);

double sphere_value(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z) - 1.0; }

Point sphere_gradient(double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length};
}

void sphere_values(embound::Span<const double> x, embound::Span<const double> y, embound::Span<const double> z,
                   embound::Span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = sphere_value(x[i], y[i], z[i]);
    }
}

// Of the first coordinate alone.
embound::Range range_of_x(const Point &lo, const Point &hi) { return {lo[0], hi[0]}; }

} // namespace

TEST(shapes_are_where_they_should_be) {
    CHECK(embound::plane(origin, up)(3.0, 4.0, 5.0) == 5.0);
    CHECK(near(embound::torus(origin, up, 2.0, 0.5)(0.0, 3.0, 0.0), 0.5));
    CHECK(near(embound::cylinder(origin, up, 0.5)(1.0, 0.0, 1.0), 0.5));
    CHECK(near(embound::infinite_cylinder(origin, up, 0.5)(0.0, 1.0, 99.0), 0.5));
    CHECK(near(embound::capsule(origin, up, 0.5)(0.0, 0.0, 3.0), 0.5));
    CHECK(near(embound::capsule_tips(origin, up, 0.5)(0.0, 0.0, 3.0), 1.0));
    CHECK(near(embound::infinite_cone(origin, up, 90.0)(0.0, 0.0, 1.0), -std::sqrt(0.5)));
    CHECK(near(embound::cone(origin, up, 1.0, 90.0)(0.0, 0.0, 1.5), 0.5));
    CHECK(near(embound::rounded_box(origin, {1.0, 2.0, 3.0}, 0.25)(0.0, 2.5, 0.0), 0.5));
    CHECK(near(embound::rounded_box(origin, {1.0, 2.0, 3.0}, 0.0, quarter)(2.5, 0.0, 0.0), 0.5));
    CHECK(near(embound::rounded_cylinder(origin, up, 1.0, 2.0, 0.25)(0.0, 0.0, 1.5), 0.5));
    CHECK(near(embound::ellipsoid(origin, {1.0, 2.0, 3.0})(0.0, 2.5, 0.0), 0.5));
    CHECK(near(embound::ellipsoid(origin, {1.0, 2.0, 3.0}, quarter)(2.5, 0.0, 0.0), 0.5));
    CHECK(near(embound::prism(origin, up, right, 4, 1.0)(1.5, 0.0, 1.0), 0.5));
    const std::vector<std::array<double, 2>> square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    CHECK(near(embound::extruded_polygon(origin, square, -1.0, 1.0)(0.5, 0.5, 1.5), 0.5));
    CHECK(near(embound::extruded_polygon(origin, square, -1.0, 1.0, quarter)(-1.5, 0.5, 0.0), 0.5));
    CHECK(near(embound::revolved_polygon(origin, up, square)(0.0, 1.5, 0.5), 0.5));
    const Geometry noise = embound::perlin(1.0, {1.0, 1.0, 1.0}, 0.5, 3, 7);
    CHECK(noise(1.0, 2.0, 3.0) == 0.0 && noise(0.3, 0.4, 0.5) != 0.0);
}

TEST(samples_and_expressions_are_bodies) {
    const std::vector<double> xs{0.0, 1.0, 2.0}, ys{2.0, 0.0};
    const std::vector<double> heights{0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    const Geometry terrain = embound::height_field({xs, ys}, heights);
    CHECK(near(terrain(1.0, 0.0, 1.0), 0.0) && terrain(1.0, 0.0, 0.5) < 0.0 && terrain(1.0, 2.0, 0.5) > 0.0);
    CHECK(terrain.properties().kind == embound::Kind::LowerBound);
    CHECK(check::status_of([&] { embound::height_field({xs, ys}, xs); }, "heights: 3") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { embound::height_field({xs, ys, xs}, heights); }) == EMB_ERROR_INVALID_ARGUMENT);
    const std::vector<double> values = embound::sphere(origin, 1.0).fill(lattice);
    const std::vector<float> floats(values.begin(), values.end());
    const Geometry sampled = embound::grid(lattice, values);
    CHECK(sampled.properties().kind == embound::Kind::SignOnly && sampled.properties().lipschitz < 2.0);
    CHECK(near(embound::lower_bound(sampled)(axis[3], axis[7], axis[11]) * sampled.properties().lipschitz,
               embound::sphere(origin, 1.0)(axis[3], axis[7], axis[11])));
    CHECK(std::fabs(embound::grid(lattice, floats)(0.5, 0.0, 0.0) + 0.5) < 0.01);
    const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(axis.size());
    const Geometry strided = embound::grid(lattice, {values.data(), {1, n, n * n}});
    CHECK(emb_geom_fingerprint(strided.get()) == emb_geom_fingerprint(sampled.get()));
    embound::ExpressionOptions options;
    options.lo = {-2.0, -2.0, -2.0};
    options.hi = {2.0, 2.0, 2.0};
    const Geometry ball = embound::expression("sqrt(x^2 + y^2 + z^2) - 1", options);
    CHECK(near(ball(0.5, 0.0, 0.0), -0.5) && ball.bounds().hi[0] <= 2.0);
    CHECK(check::status_of([] { embound::expression("x +"); }, "expression") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([] { embound::expression(std::string("x\0 y", 4)); }, "byte 1") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(transforms_move_turn_and_bend) {
    const Geometry ball = embound::sphere({1.0, 0.0, 0.0}, 0.5);
    CHECK(embound::rotate(ball, up, 90.0)(0.0, 1.0, 0.0) == -0.5);
    CHECK(near(embound::rotate(ball, up, 180.0, {2.0, 0.0, 0.0})(3.0, 0.0, 0.0), -0.5));
    CHECK(embound::scale(ball, 2.0)(2.0, 0.0, 0.0) == -1.0);
    CHECK(embound::reflect(ball, 0)(-1.0, 0.0, 0.0) == -0.5);
    CHECK(near(embound::reflect_in(ball, {2.0, 0.0, 0.0}, right)(3.0, 0.0, 0.0), -0.5));
    CHECK(embound::affine(ball, {2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0})(3.0, 0.0, 0.0) <= 1e-12);
    CHECK(embound::affine(ball, embound::identity, {5.0, 0.0, 0.0})(6.0, 0.0, 0.0) < 0.0);
    CHECK(embound::offset(ball, 0.25)(1.0, 0.0, 0.0) == -0.75);
    CHECK(embound::annular(ball, 0.125)(1.5, 0.0, 0.0) == -0.125);
    const Geometry noise = embound::lower_bound(embound::perlin(1.0, {1.0, 1.0, 1.0}, 0.5, 3, 7));
    CHECK(noise.properties().kind == embound::Kind::LowerBound && noise.properties().lipschitz <= 1.0);
    CHECK(embound::offset(noise, 0.1).properties().kind == embound::Kind::LowerBound);
    CHECK(std::fabs(embound::blur(ball, 0.01, 0.5)(1.4, 0.0, 0.0) + 0.1) < 0.01);
    CHECK(std::fabs(embound::mollify(ball, 0.01, 3)(1.4, 0.0, 0.0) + 0.1) < 0.01);
    CHECK(embound::elongate(embound::sphere(origin, 0.5), {1.0, 0.0, 0.0})(1.25, 0.0, 0.0) == -0.25);
    CHECK(embound::twist(ball, 180.0)(std::sqrt(0.5), std::sqrt(0.5), 0.25) < 0.0);
    CHECK(embound::twist(ball, 180.0).properties().kind == embound::Kind::LowerBound);
    CHECK(embound::slice(ball, {0.0, 0.0, 0.25}, right, {0.0, 1.0, 0.0})(1.0, 0.0, 77.0) == -0.25);
    const Geometry row = embound::repeat(ball, {3.0, 0.0, 0.0}, {4, 1, 1});
    CHECK(row(10.0, 0.0, 0.0) == -0.5 && row(13.0, 0.0, 0.0) == 2.5);
}

TEST(sets_are_sharp_or_smooth) {
    const Geometry a = embound::sphere(origin, 1.0), b = embound::sphere({1.5, 0.0, 0.0}, 1.0);
    const std::vector<Geometry> both{a, b};
    const embound::Blend smooth = embound::Blend::smooth(0.5);
    const double sharp = embound::unite(both)(0.75, 0.0, 0.8);
    CHECK(near(embound::smooth_union(both, smooth)(0.75, 0.0, 0.8), sharp - 0.125));
    CHECK(near(embound::smooth_union({a, b}, embound::Blend::exponential(0.5))(0.75, 0.0, 0.8), sharp - 0.5 * std::log(2.0)));
    CHECK(near(embound::smooth_intersection({a, b}, smooth)(0.75, 0.0, 0.0), -0.25 + 0.125));
    CHECK(near(embound::smooth_intersection(both, smooth)(0.75, 0.0, 0.0), -0.25 + 0.125));
    CHECK(embound::smooth_difference(a, b, smooth)(-1.5, 0.0, 0.0) == 0.5);
    CHECK(embound::smooth_difference(a, {b}, embound::Blend::smooth(1.0))(0.75, 0.0, 0.0) > embound::difference(a, b)(0.75, 0.0, 0.0));
    CHECK(embound::difference(a, both)(0.0, 0.0, 0.0) == 1.0);
    CHECK(embound::difference(a, std::vector<Geometry>{b, b})(0.0, 0.0, 0.0) == embound::difference(a, b)(0.0, 0.0, 0.0));
}

TEST(errors_name_the_argument) {
    CHECK(refused("normal", [] { return embound::plane(origin, origin); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("minor", [] { return embound::torus(origin, up, 1.0, 1.0); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("angle: 180", [] { return embound::cone(origin, up, 1.0, 180.0); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("sides: -3", [] { return embound::prism(origin, up, right, -3, 1.0); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("octaves: 0", [] { return embound::perlin(1.0, up, 0.5, 0, 1); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("g: NULL", [] { return embound::scale(Geometry(), 2.0); }) == EMB_ERROR_NULL_ARGUMENT);
    CHECK(refused("parts[1]", [] {
              return embound::smooth_union({embound::sphere(origin, 1.0), Geometry()}, embound::Blend::smooth(1.0));
          }) == EMB_ERROR_NULL_ARGUMENT);
    CHECK(refused("remove[0]", [] {
              return embound::difference(embound::sphere(origin, 1.0), std::vector<Geometry>(1));
          }) == EMB_ERROR_NULL_ARGUMENT);
    CHECK(refused("blend.width: 0", [] { return embound::smooth_union({}, embound::Blend::smooth(0.0)); }) ==
          EMB_ERROR_INVALID_ARGUMENT);
    CHECK(refused("plane: 3", [] { return embound::reflect(embound::sphere(origin, 1.0), 3); }) ==
          EMB_ERROR_INVALID_ARGUMENT);
}

TEST(functions_know_gradients_and_ranges) {
    embound::FunctionOptions options;
    options.kind = embound::Kind::Exact;
    options.lipschitz = 1.0;
    options.thread_safe = true;
    const Geometry pointwise = embound::function(sphere_value, options);
    const Geometry graded = embound::function(sphere_value, sphere_gradient, options);
    const Geometry batched = embound::batched_function(sphere_values, sphere_gradient, options);
    const std::vector<double> values = pointwise.fill(lattice);
    CHECK(check::same_bits(graded.fill(lattice), values) && check::same_bits(batched.fill(lattice), values));
    CHECK(check::same_bits(batched.fill(lattice, embound::FillMode::Exact, embound::Pool(2)), values));
    CHECK(check::same_bits(embound::batched_function(sphere_values)(0.1, 0.2, 0.3), sphere_value(0.1, 0.2, 0.3)));
    const std::vector<Point> points{{0.25, 0.5, 0.75}};
    const Point exact = sphere_gradient(0.25, 0.5, 0.75);
    for (const Geometry &g : {graded, batched}) {
        const embound::Closest closest = g.closest(points);
        CHECK(near(closest.gradient[0][0], exact[0]) && near(closest.gradient[0][2], exact[2]));
    }
    const auto x_only = [](double x, double, double) { return x; };
    CHECK(embound::function(x_only).classify({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}) == 0);
    CHECK(embound::function(x_only, nullptr, range_of_x).classify({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}) == 1);
    CHECK(embound::function(x_only, nullptr, range_of_x).classify({-2.0, 0.0, 0.0}, {-1.0, 1.0, 1.0}) == -1);
    CHECK(embound::function(x_only, nullptr, range_of_x).classify({-2.0, 0.0, 0.0}, {1.0, 1.0, 1.0}) == 0);
    const auto unknown = [](const Point &, const Point &) { return embound::Range{}; };
    CHECK(embound::function(x_only, nullptr, unknown, embound::FunctionOptions{}).classify(right, up) == 0);
}

TEST(what_functions_throw_reaches_the_caller) {
    const auto throwing = [](embound::Span<const double> x, embound::Span<const double>, embound::Span<const double>,
                             embound::Span<double> out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (x[i] > 0.5) {
                throw Boom{21};
            }
            out[i] = x[i];
        }
    };
    const Geometry g = embound::batched_function(throwing);
    CHECK(g(0.25, 0.0, 0.0) == 0.25);
    CHECK(boom([&] { g(0.75, 0.0, 0.0); }) == 21);
    CHECK(boom([&] { g.fill(lattice, embound::FillMode::Sign); }) == 21);
    const auto no_gradient = [](double, double, double) -> Point { throw Boom{22}; };
    const std::vector<Point> points{{0.25, 0.5, 0.75}};
    CHECK(boom([&] { embound::function(sphere_value, no_gradient).closest(points); }) == 22);
    const auto no_range = [](const Point &, const Point &) -> embound::Range { throw Boom{23}; };
    CHECK(boom([&] { embound::function(sphere_value, nullptr, no_range).classify(right, up); }) == -1); // not a box
    CHECK(boom([&] { embound::function(sphere_value, nullptr, no_range).classify(origin, {1.0, 1.0, 1.0}); }) == 23);
}

TEST(blends_of_the_callers_are_kept_and_may_throw) {
    const Geometry a = embound::sphere(origin, 1.0), b = embound::sphere({1.5, 0.0, 0.0}, 1.0);
    const auto alive = std::make_shared<int>(0);
    {
        Geometry first, second;
        {
            embound::BlendOptions options;
            options.support = 0.5;
            options.depth = 0.5;
            options.lipschitz = 1.0;
            const auto quadratic = [alive](double u, double v) {
                const double h = std::max(0.5 - (v - u), 0.0) / 0.5;
                return embound::Blended{u - h * h * 0.125, 1.0 - 0.5 * h, 0.5 * h};
            };
            const embound::Blend blend = embound::Blend::custom(quadratic, options);
            first = embound::smooth_union({a, b}, blend);
            second = embound::smooth_union({b, a}, blend);
            CHECK(check::status_of([&] { embound::smooth_union({a, Geometry()}, blend); }) == EMB_ERROR_NULL_ARGUMENT);
        }
        CHECK(alive.use_count() == 2); // one function, which both geometries keep
        const Geometry known = embound::smooth_union({a, b}, embound::Blend::smooth(0.5));
        CHECK(check::same_bits(first.fill(lattice), known.fill(lattice)));
        CHECK(check::same_bits(second.fill(lattice), known.fill(lattice)));
        CHECK(first.properties().kind == embound::Kind::LowerBound);
    }
    CHECK(alive.use_count() == 1);
    const auto fails = [](double, double) -> double { throw Boom{31}; };
    const Geometry g = embound::smooth_union({a, b}, embound::Blend::custom(fails));
    CHECK(boom([&] { g(0.75, 0.0, 0.0); }) == 31);
    CHECK(boom([&] { g.fill(lattice, embound::FillMode::Sign); }) == 31);
    CHECK(std::isnan(emb_geom_value(g.get(), 0.75, 0.0, 0.0)));
}

TEST(bodies_without_bounds_are_given_some) {
    const Geometry ball = embound::function(sphere_value);
    const embound::Box start{{-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}};
    const embound::BoundingBox found = embound::bounding_box(ball, start, 6, 1.0);
    CHECK(found.state == embound::Bounding::Found);
    for (std::size_t d = 0; d < 3; ++d) {
        CHECK(found.box.lo[d] <= -1.0 && found.box.lo[d] > -1.5 && found.box.hi[d] >= 1.0 && found.box.hi[d] < 1.5);
    }
    const embound::BoundingSphere around = embound::bounding_sphere(ball, start, 6);
    CHECK(around.state == embound::Bounding::Found && around.radius >= 1.0 && around.radius < 1.4);
    const embound::Box small{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, beside{{2.0, 2.0, 2.0}, {3.0, 3.0, 3.0}};
    CHECK(embound::bounding_box(ball, small, 4).state == embound::Bounding::ReachesStart);
    CHECK(std::isinf(embound::bounding_box(ball, beside, 4).box.lo[0]));
    CHECK(embound::bounding_sphere(ball, beside, 4).state == embound::Bounding::Nothing);
    CHECK(check::status_of([&] { embound::bounding_box(ball, small, 99); }) == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(sets_take_lists) {
    const Geometry a = embound::sphere(origin, 1.0), b = embound::sphere({1.5, 0.0, 0.0}, 1.0);
    CHECK(embound::unite({a, b})(1.5, 0.0, 0.0) == embound::unite(a, b)(1.5, 0.0, 0.0));
    CHECK(embound::intersection({a, b})(1.5, 0.0, 0.0) == embound::intersection(a, b)(1.5, 0.0, 0.0));
    CHECK(embound::difference(a, {b})(0.1, 0.0, 0.0) == embound::difference(a, b)(0.1, 0.0, 0.0));
}

TEST(a_body_cut_down_to_a_box_is_the_same_there) {
    std::vector<Geometry> parts;
    for (int i = 0; i < 100; ++i) {
        parts.push_back(embound::sphere({0.5 * i, 0.0, 0.0}, 0.3));
    }
    const Geometry row = embound::unite(parts), cut = embound::simplify(row, {{10.0, -1.0, -1.0}, {11.0, 1.0, 1.0}});
    CHECK(cut.properties().primitives < 20);
    CHECK(cut(10.3, 0.2, 0.1) == row(10.3, 0.2, 0.1));
}
