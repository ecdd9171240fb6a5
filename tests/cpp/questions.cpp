// SPDX-License-Identifier: MIT OR Apache-2.0
// Every question through the C++ layer, against closed forms and against one another.
#include "support/check.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <thread>
#include <type_traits>

namespace {

// What std::span is like: it owns nothing, so a temporary may be written through.
struct View {
    double *first;
    std::size_t count;
    double *data() const { return first; }
    std::size_t size() const { return count; }
};

using Doubles = std::vector<double>;
static_assert(std::is_convertible_v<Doubles &, embound::Span<double>> && std::is_convertible_v<View, embound::Span<double>>);
static_assert(std::is_convertible_v<Doubles, embound::Span<const double>>);
static_assert(!std::is_convertible_v<Doubles, embound::Span<double>>, "results would be lost with the temporary");
static_assert(!std::is_convertible_v<const Doubles &, embound::Span<double>>);
static_assert(!std::is_convertible_v<Doubles, embound::Array> && std::is_convertible_v<View, embound::Array>);
static_assert(!std::is_convertible_v<std::vector<float> &, embound::Points>);

const double inf = std::numeric_limits<double>::infinity();

// Tasks on threads of this program, one each.
void run_on_threads(std::size_t tasks, embound::Task task) {
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < tasks; ++i) {
        threads.emplace_back([task, i] { task(i); });
    }
    task(0);
    for (std::thread &thread : threads) {
        thread.join();
    }
}

// A body of all kinds of nodes.
embound::Geometry body() {
    const embound::Geometry block = embound::box({-1.0, -0.5, -0.25}, {1.0, 0.5, 0.25});
    const embound::Matrix quarter_turn{0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const embound::Geometry ball = embound::sphere({0.25, 0.0, 0.0}, 0.4);
    const embound::Geometry pierced = embound::difference(block, ball);
    const embound::Geometry turned = embound::part(embound::place(pierced, quarter_turn, {0.3, 0.0, 0.0}), 4);
    const embound::Geometry moved = embound::translate(embound::intersection(block, embound::sphere({1.0, 0.0, 0.0}, 0.6)),
                                                       {0.0, -1.0, 0.0});
    return embound::unite(turned, embound::part(moved, 5), embound::sphere({-1.0, 1.0, 0.0}, 0.3));
}

// A lattice of unequal cells over it, z falling.
const std::vector<double> xs = check::axis(-1.5, 1.7, 23);
const std::vector<double> ys = check::axis(-1.9, 1.6, 31);
const std::vector<double> zs = check::axis(0.6, -0.7, 17);
const embound::Lattice lattice(xs, ys, zs);

// The points of the lattice, x fastest.
std::vector<embound::Point> points_of_lattice() {
    std::vector<embound::Point> points;
    for (const double z : zs) {
        for (const double y : ys) {
            for (const double x : xs) {
                points.push_back({x, y, z});
            }
        }
    }
    return points;
}

} // namespace

TEST(a_spheres_values_are_right) {
    const embound::Geometry g = embound::sphere({1.0, 2.0, 3.0}, 0.5);
    CHECK(g(1.0, 2.0, 3.0) == -0.5);
    CHECK(g(4.0, 6.0, 3.0) == 4.5);
    CHECK(g(1.5, 2.0, 3.0) == 0.0 && !std::signbit(g(1.5, 2.0, 3.0)));
    CHECK(std::isnan(g(inf, 0.0, 0.0)));
}

TEST(every_layout_of_points_has_the_same_bits) {
    const embound::Geometry g = body();
    const std::vector<embound::Point> points = points_of_lattice();
    std::vector<double> flat, x, y, z, one_by_one;
    for (const embound::Point &p : points) {
        flat.insert(flat.end(), p.begin(), p.end());
        x.push_back(p[0]);
        y.push_back(p[1]);
        z.push_back(p[2]);
        one_by_one.push_back(g(p[0], p[1], p[2]));
    }
    CHECK(check::same_bits(g.values(points), one_by_one));
    CHECK(check::same_bits(g.values(flat), one_by_one));
    CHECK(check::same_bits(g.values({x, y, z}), one_by_one));
    CHECK(check::same_bits(g.values({points.size(), flat.data(), flat.data() + 1, flat.data() + 2, 3}), one_by_one));
    std::vector<double> out(points.size());
    g.values(embound::Span<const embound::Point>(points.data(), points.size()), out);
    CHECK(check::same_bits(out, one_by_one));
    out.assign(out.size(), 0.0);
    g.values(points, View{out.data(), out.size()});
    CHECK(check::same_bits(out, one_by_one));
    CHECK(check::same_bits(g.fill(lattice), one_by_one));
    CHECK(check::same_bits(g.fill(lattice, embound::FillMode::Exact, embound::Pool(2)), one_by_one));
    CHECK(check::same_bits(g.fill(lattice, embound::FillMode::Exact, embound::Pool::from_executor(3, run_on_threads)),
                           one_by_one));
}

TEST(f32_is_the_value_in_f32) {
    const embound::Geometry g = body();
    std::vector<float> flat;
    for (const embound::Point &p : points_of_lattice()) {
        for (const double c : p) {
            flat.push_back(static_cast<float>(c));
        }
    }
    const std::vector<float> values = g.values(flat);
    bool same = values.size() == flat.size() / 3;
    for (std::size_t i = 0; same && i < values.size(); ++i) {
        same = values[i] == emb_geom_value_f32(g.get(), flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]) &&
               values[i] == static_cast<float>(g(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]));
    }
    CHECK(same);
    const std::vector<double> exact = g.fill(lattice);
    const std::vector<float> single = g.fill<float>(lattice);
    bool rounded = true;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        rounded = rounded && single[i] == static_cast<float>(exact[i]);
    }
    CHECK(rounded);
}

TEST(fills_agree_in_every_mode_and_type) {
    const embound::Geometry g = body();
    const std::vector<double> exact = g.fill(lattice);
    const std::vector<double> band = g.fill(lattice, embound::Fill::band(0.2));
    const std::vector<double> sign = g.fill(lattice, embound::FillMode::Sign);
    const auto sign32 = g.fill<std::int32_t>(lattice, embound::FillMode::Sign);
    const auto sign8 = g.fill<std::int8_t>(lattice, embound::FillMode::Sign, embound::Pool(2));
    bool banded = true, signs = true;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double value = exact[i];
        banded = banded && band[i] == (std::abs(value) < 0.2 ? value : std::copysign(0.2, value));
        const int expected = (value > 0.0) - (value < 0.0);
        signs = signs && sign[i] == expected && sign32[i] == expected && sign8[i] == expected;
    }
    CHECK(banded);
    CHECK(signs);
    CHECK(check::status_of([&] { g.fill(lattice, embound::Fill::band(-1.0)); }, "band") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { g.fill<std::int8_t>(lattice); }) != EMB_OK);
}

TEST(a_strided_fill_leaves_ghost_cells_alone) {
    const embound::Geometry g = body();
    const std::vector<double> tight = g.fill(lattice);
    const std::size_t nx = xs.size(), ny = ys.size(), nz = zs.size();
    std::vector<double> padded((nx + 2) * (ny + 2) * (nz + 2), 77.0);
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k) { return i + (nx + 2) * (j + (ny + 2) * k); };
    const auto row = static_cast<std::ptrdiff_t>(nx + 2), plane = row * static_cast<std::ptrdiff_t>(ny + 2);
    g.fill(lattice, embound::Array(padded.data() + at(1, 1, 1), {1, row, plane}));
    bool same = true;
    std::size_t left = padded.size();
    for (std::size_t k = 0; k < nz; ++k) {
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t i = 0; i < nx; ++i) {
                same = same && check::same_bits(padded[at(i + 1, j + 1, k + 1)], tight[i + nx * (j + ny * k)]);
            }
        }
    }
    for (const double value : padded) {
        left -= value == 77.0 ? 0 : 1;
    }
    CHECK(same);
    CHECK(left == padded.size() - tight.size());
}

TEST(a_flat_lattice_is_the_plane_z_0) {
    const embound::Geometry g = body();
    const embound::Lattice flat(xs, ys);
    const std::vector<double> values = g.fill(flat);
    bool same = values.size() == xs.size() * ys.size();
    for (std::size_t i = 0; same && i < values.size(); ++i) {
        same = check::same_bits(values[i], g(xs[i % xs.size()], ys[i / xs.size()], 0.0));
    }
    CHECK(same);
    CHECK(g.crossings(flat, 0).where.size() == (xs.size() - 1) * ys.size());
    CHECK(g.crossings(flat, 2).where.empty());
}

TEST(an_empty_lattice_is_nothing_to_do) {
    const std::vector<double> none;
    CHECK(body().fill(embound::Lattice(none, ys, zs)).empty());
    CHECK(body().crossings(embound::Lattice(xs, none, zs), 1).where.empty());
    CHECK(body().values(std::vector<embound::Point>{}).empty());
}

TEST(crossings_have_the_bits_of_intercepts) {
    const embound::Geometry g = body();
    std::size_t crossed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::array<std::size_t, 3> shape = lattice.edge_shape(axis);
        const auto a = static_cast<std::size_t>(axis);
        std::vector<embound::Point> from, to;
        for (std::size_t k = 0; k < shape[2]; ++k) {
            for (std::size_t j = 0; j < shape[1]; ++j) {
                for (std::size_t i = 0; i < shape[0]; ++i) {
                    std::array<std::size_t, 3> end{i, j, k};
                    from.push_back({xs[i], ys[j], zs[k]});
                    end[a] += 1;
                    to.push_back({xs[end[0]], ys[end[1]], zs[end[2]]});
                }
            }
        }
        const embound::Crossings edges = g.crossings(lattice, axis, embound::CrossingForm::Fraction);
        const embound::Crossings coordinates = g.crossings(lattice, axis);
        const embound::Intercepts there = g.intercepts(from, to);
        const embound::Intercepts back = g.intercepts(to, from, embound::Pool(2));
        CHECK(check::same_bits(edges.where, there.t));
        CHECK(edges.count == there.count && edges.tag == there.tag && edges.part == there.part);
        CHECK(coordinates.count == there.count && back.count == there.count);
        bool between = true, opposite = true;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const double t = there.t[i], x = coordinates.where[i];
            const bool sides = (g(from[i][0], from[i][1], from[i][2]) <= 0.0) != (g(to[i][0], to[i][1], to[i][2]) <= 0.0);
            opposite = opposite && sides == !std::isnan(t) && sides == !std::isnan(x) && sides == !std::isnan(back.t[i]);
            if (sides) {
                ++crossed;
                const double lo = std::min(from[i][a], to[i][a]), hi = std::max(from[i][a], to[i][a]);
                between = between && t >= 0.0 && t <= 1.0 && x >= lo && x <= hi;
                embound::Point p = from[i];
                p[a] = x;
                between = between && std::abs(g(p[0], p[1], p[2])) < 1e-12;
                between = between && there.part[i] == back.part[i];
            }
        }
        CHECK(opposite);
        CHECK(between);
    }
    CHECK(crossed > 500);
}

TEST(crossings_leave_other_edges_alone_where_asked) {
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 0.5);
    const std::vector<double> x{-1.0, 0.0, 1.0, 2.0}, y{0.0};
    std::vector<double> where(3, -7.0);
    embound::CrossingsOut out;
    out.where = embound::Array(where);
    out.elsewhere = embound::Elsewhere::Leave;
    g.crossings(embound::Lattice(x, y), 0, out);
    CHECK(where[0] == -0.5 && where[1] == 0.5 && where[2] == -7.0);
    out.elsewhere = embound::Elsewhere::Write;
    out.none = 99.0;
    g.crossings(embound::Lattice(x, y), 0, out);
    CHECK(where[2] == 99.0);
    CHECK(check::status_of([&] { g.crossings(embound::Lattice(x, y), 3); }, "axis") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(closest_points_of_a_sphere) {
    const embound::Geometry g = embound::part(embound::sphere({0.0, 0.0, 0.0}, 2.0), 8);
    const std::vector<embound::Point> points{{5.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    const embound::Closest all = g.closest(points);
    CHECK(all.value[0] == 3.0 && all.value[1] == -1.0);
    CHECK(all.point[0] == (embound::Point{2.0, 0.0, 0.0}) && all.point[1] == (embound::Point{0.0, 2.0, 0.0}));
    CHECK(all.gradient[0] == (embound::Point{1.0, 0.0, 0.0}) && all.gradient[1] == (embound::Point{0.0, 1.0, 0.0}));
    CHECK(all.part[0] == 8 && all.feature[0] == -1);
    const embound::Closest near = g.closest(points, 2.0);
    CHECK(near.value[0] == 2.0 && near.part[0] == -1 && std::isnan(near.point[0][0]) && near.value[1] == -1.0);
    std::vector<std::int32_t> part(2);
    embound::ClosestOut only_part;
    only_part.part = part;
    g.closest(points, only_part);
    CHECK(part[0] == 8 && part[1] == 8);
}

TEST(boxes_are_on_the_side_they_are_said_to_be) {
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 1.0);
    CHECK(g.classify({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}) == -1);
    CHECK(g.classify({2.0, -0.1, -0.1}, {2.1, 0.1, 0.1}) == 1);
    CHECK(g.classify({0.9, -0.1, -0.1}, {1.1, 0.1, 0.1}) == 0);
    CHECK(g.classify({1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}) == 0);
    const std::vector<embound::Point> lo{{-0.1, -0.1, -0.1}, {2.0, -0.1, -0.1}}, hi{{0.1, 0.1, 0.1}, {2.1, 0.1, 0.1}};
    CHECK((g.classify(lo, hi) == std::vector<std::int32_t>{-1, 1}));
    CHECK((g.classify(lo, hi, embound::Pool(2)) == std::vector<std::int32_t>{-1, 1}));
    CHECK(check::status_of([&] { g.classify(hi, lo); }) == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(bounds_and_properties) {
    const embound::Geometry g = embound::sphere({1.0, 0.0, 0.0}, 1.0);
    const embound::Box box = g.bounds();
    CHECK(box.lo[0] <= 0.0 && box.lo[0] > -1e-9 && box.hi[2] >= 1.0 && box.hi[2] < 1.0 + 1e-9);
    CHECK(embound::complement(g).bounds().hi[0] == inf);
    CHECK(embound::unite(std::vector<embound::Geometry>{}).bounds().lo[0] == inf);
    CHECK(g.properties().kind == embound::Kind::Exact && g.properties().primitives == 1);
    const embound::Geometry f = embound::function([](double x, double, double) { return x; });
    CHECK(f.properties().kind == embound::Kind::SignOnly && f.bounds().lo[0] == -inf);
    CHECK(check::status_of([&] { f.fill(lattice); }) == EMB_ERROR_UNSUPPORTED);
    CHECK(f.fill<std::int8_t>(lattice, embound::FillMode::Sign)[0] == -1);
}

TEST(sizes_that_do_not_fit_are_errors) {
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 1.0);
    std::vector<double> two(2), four(4);
    const std::vector<embound::Point> points(3);
    CHECK(check::status_of([&] { g.values(points, two); }, "out: 2 elements, 3 needed") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { g.values(four); }, "4 coordinates") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { g.fill(lattice, four); }, "out: 4 elements") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { g.values({two, four, two}); }, "y: 4 elements, 2 needed") == EMB_ERROR_INVALID_ARGUMENT);
    embound::ClosestOut out;
    out.value = two;
    CHECK(check::status_of([&] { g.closest(points, out); }, "out.value") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(memory_that_cannot_be_had_is_an_error) {
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 1.0);
    const std::vector<double> axis(std::size_t{1} << 14, 0.0), short_axis(std::size_t{1} << 12, 0.0);
    const embound::Lattice huge(axis, axis, short_axis); // 2^40 points
    CHECK(huge.points() == std::size_t{1} << 40);
    CHECK(check::status_of([&] { g.fill(huge); }, "1099511627776") == EMB_ERROR_MEMORY);
    CHECK(check::status_of([&] { g.crossings(huge, 2); }) == EMB_ERROR_MEMORY);
    const double *nowhere = axis.data();
    const embound::Span<const double> endless(nowhere, std::size_t{1} << 40);
    CHECK(check::status_of([&] { g.fill(embound::Lattice(endless, endless, endless)); }, "lattice.n") == EMB_ERROR_MEMORY);
    CHECK(check::status_of([&] { g.values({std::size_t{1} << 62, nowhere, nowhere, nowhere, 1}); }) == EMB_ERROR_MEMORY);
}
