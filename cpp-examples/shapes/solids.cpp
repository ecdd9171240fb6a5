// SPDX-License-Identifier: MIT OR Apache-2.0
// What bodies begin with: meshes, shapes in closed form at any place and orientation, samples, expressions
// and functions of one's own.
#include "tile.hpp"

#include "vector.hpp"
#include "volumes.hpp"

#include <cmath>

using namespace embound;

namespace {

constexpr double pi = volume_of::pi;

// An icosahedron with a pyramid on each face.
Mesh star() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<Point> corners;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-g, g}) {
            corners.push_back({0.0, a, b});
            corners.push_back({a, b, 0.0});
            corners.push_back({b, 0.0, a});
        }
    }
    std::vector<double> xyz;
    const auto vertex = [&](const Point &p, double scale) {
        xyz.insert(xyz.end(), {scale * p[0], scale * p[1], scale * p[2]});
        return static_cast<std::uint32_t>(xyz.size() / 3 - 1);
    };
    for (const Point &p : corners) {
        vertex(p, 0.3);
    }
    std::vector<std::uint32_t> indices;
    const auto touching = [&](std::uint32_t i, std::uint32_t j) {
        return std::abs(distance(corners[i], corners[j]) - 2.0) < 1e-9;
    };
    for (std::uint32_t i = 0; i < 12; ++i) {
        for (std::uint32_t j = i + 1; j < 12; ++j) {
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                if (touching(i, j) && touching(j, k) && touching(k, i)) {
                    const Point middle = along(along(corners[i], 1.0, corners[j]), 1.0, corners[k]);
                    const std::uint32_t tip = vertex(middle, 0.2);
                    const bool outward =
                        dot(cross(along(corners[j], -1.0, corners[i]), along(corners[k], -1.0, corners[i])), middle) > 0.0;
                    const std::uint32_t b = outward ? j : k, c = outward ? k : j; // i, b, c: counterclockwise from outside
                    indices.insert(indices.end(), {i, b, tip, b, c, tip, c, i, tip});
                }
            }
        }
    }
    return Mesh::from_triangles(xyz, indices);
}

volume_of::Polygon gear(std::size_t teeth) {
    volume_of::Polygon corners;
    for (std::size_t i = 0; i < 4 * teeth; ++i) {
        const double angle = 2.0 * pi * (static_cast<double>(i) + (i % 2 == 0 ? 0.1 : -0.1)) / static_cast<double>(4 * teeth);
        const double r = i / 2 % 2 == 0 ? 0.9 : 0.65;
        corners.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return corners;
}

std::vector<double> even(double lo, double hi, std::size_t n) {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = lo + (hi - lo) * static_cast<double>(i) / static_cast<double>(n - 1);
    }
    return x;
}

Tile terrain() {
    const std::vector<double> x = even(-1.0, 1.0, 33);
    std::vector<double> heights;
    for (const double v : x) {
        for (const double u : x) {
            heights.push_back(0.22 * std::sin(3.0 * u) * std::cos(4.0 * v) - 0.1);
        }
    }
    return {"height_field", height_field(Lattice(x, x), heights), Kind::LowerBound, unknown, {}};
}

// Three balls grown together, sampled as a simulation or a scan would give them.
Tile sampled() {
    const std::vector<double> x = even(-1.0, 1.0, 40);
    const Point centres[] = {{-0.42, 0.1, -0.25}, {0.42, 0.1, -0.3}, {0.0, -0.1, 0.42}};
    std::vector<double> values;
    for (const double w : x) {
        for (const double v : x) {
            for (const double u : x) {
                double sum = 0.0;
                for (const Point &centre : centres) {
                    sum += std::exp(-6.0 * distance({u, v, w}, centre));
                }
                values.push_back(-0.09 * std::log(sum) - 0.18);
            }
        }
    }
    return {"grid", grid(Lattice(x, x, x), values), Kind::LowerBound, unknown, {}};
}

Tile heart() {
    ExpressionOptions options;
    options.lo = {-1.0, -1.0, -1.0};
    options.hi = {1.0, 1.0, 1.0};
    return {"expression",
            expression("((1.4*x)^2 + 9/4*(1.4*y)^2 + (1.4*z)^2 - 1)^3 - (1.4*x)^2*(1.4*z)^3 - 9/80*(1.4*y)^2*(1.4*z)^3", options),
            Kind::SignOnly,
            unknown,
            {{{0.0, 0.0, 0.0}, -1.0}}};
}

Tile gyroid() {
    FunctionOptions known;
    known.lipschitz = 8.0; // of a sum of three products with frequency 4
    known.thread_safe = true;
    const auto f = [](double x, double y, double z) {
        const double k = 4.0;
        return std::abs(std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) +
                        std::sin(k * z) * std::cos(k * x)) -
               0.35;
    };
    return {"function", function(f, known), Kind::SignOnly, unknown, {{{0.0, 0.0, 0.0}, -0.35}}};
}

} // namespace

std::vector<Tile> solids() {
    const Mesh mesh = star();
    const double tilt = std::sqrt(0.5);
    const Matrix turned{tilt, -tilt, 0.0, tilt, tilt, 0.0, 0.0, 0.0, 1.0};
    const volume_of::Polygon teeth = gear(9);
    const volume_of::Polygon vase{{0.0, -0.9}, {0.45, -0.9}, {0.5, -0.8}, {0.22, -0.55}, {0.2, -0.3}, {0.62, 0.2},
                                  {0.6, 0.55}, {0.5, 0.9},   {0.42, 0.9}, {0.5, 0.5},    {0.5, 0.25}, {0.0, -0.2}};
    const double half_angle = 25.0 * pi / 180.0, spread = std::tan(half_angle);

    return {
        {"from_mesh", from_mesh(mesh), Kind::Exact, mesh.report().volume, {}},
        {"sphere", sphere({0.0, 0.0, 0.0}, 0.8), Kind::Exact, volume_of::ball(0.8), {{{0, 0, 0}, -0.8}, {{3, 4, 0}, 4.2}}},
        {"box",
         box({-0.7, -0.6, -0.5}, {0.7, 0.6, 0.5}),
         Kind::Exact,
         1.4 * 1.2 * 1.0,
         {{{0, 0, 0}, -0.5}, {{3.7, 4.6, 0}, 5.0}}},
        {"rounded_box",
         rounded_box({0.0, 0.0, 0.0}, {0.8, 0.8, 0.6}, 0.25, turned),
         Kind::Exact,
         volume_of::rounded_box(1.1, 1.1, 0.7, 0.25),
         {{{0, 0, 0}, -0.6}, {{0, 0, 1.0}, 0.4}}},
        {"plane", plane({0.0, 0.0, 0.0}, {0.0, -3.0, 4.0}), Kind::Exact, 4.0, {{{1, -3, 4}, 5.0}, {{0, 3, -4}, -5.0}}},
        {"ellipsoid",
         ellipsoid({0.0, 0.0, 0.0}, {0.95, 0.6, 0.4}),
         Kind::Exact,
         volume_of::ball(1.0) * 0.95 * 0.6 * 0.4,
         {{{0, 0, 0}, -0.4}, {{2, 0, 0}, 1.05}}},
        {"torus",
         torus({0.0, 0.0, 0.0}, {0.3, -0.4, 1.0}, 0.65, 0.25),
         Kind::Exact,
         2.0 * pi * pi * 0.65 * 0.25 * 0.25,
         {{{0, 0, 0}, 0.4}}},
        {"cylinder",
         cylinder({0.0, 0.0, -0.7}, {0.0, 0.0, 0.7}, 0.6),
         Kind::Exact,
         pi * 0.36 * 1.4,
         {{{0, 0, 0}, -0.6}, {{3.6, 0, 4.7}, 5.0}}},
        {"infinite_cylinder",
         infinite_cylinder({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.5),
         Kind::Exact,
         pi * 0.25 * 2.0,
         {{{3, 7, 4}, 4.5}}},
        {"rounded_cylinder",
         rounded_cylinder({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.7, 1.2, 0.2),
         Kind::Exact,
         volume_of::rounded_cylinder(0.5, 0.8, 0.2),
         {{{0, 0, 0}, -0.6}, {{3.5, 0, 4.4}, 4.8}}},
        {"capsule",
         capsule({-0.5, 0.0, -0.4}, {0.5, 0.0, 0.4}, 0.3),
         Kind::Exact,
         pi * 0.09 * std::sqrt(1.64) + volume_of::ball(0.3),
         {{{0, 0, 0}, -0.3}, {{0.5, 2, 0.4}, 1.7}}},
        {"capsule_tips",
         capsule_tips({0.0, 0.0, -0.9}, {0.0, 0.0, 0.9}, 0.4),
         Kind::Exact,
         pi * 0.16 * 1.0 + volume_of::ball(0.4),
         {{{0, 0, 0.9}, 0.0}, {{2, 0, 0}, 1.6}}},
        {"cone",
         cone({0.0, 0.0, 0.8}, {0.0, 0.0, -1.0}, 1.5, 50.0),
         Kind::Exact,
         pi / 3.0 * spread * spread * 1.5 * 1.5 * 1.5,
         {{{0, 0, 1.8}, 1.0}, {{0, 0, -1.7}, 1.0}}},
        {"infinite_cone",
         infinite_cone({0.0, 0.0, 0.7}, {0.0, 0.0, -1.0}, 50.0),
         Kind::Exact,
         pi / 3.0 * spread * spread * 1.7 * 1.7 * 1.7,
         {{{0, 0, 1.7}, 1.0}, {{0, 0, -0.3}, -std::sin(half_angle)}}},
        {"prism",
         prism({0.0, 0.0, -0.6}, {0.0, 0.0, 0.6}, {1.0, 0.0, 0.0}, 6, 0.8),
         Kind::Exact,
         1.5 * std::sqrt(3.0) * 0.64 * 1.2,
         {{{0, 0, 0}, -0.6}, {{1.8, 0, 0}, 1.0}}},
        {"extruded_polygon",
         extruded_polygon({0.0, 0.0, 0.0}, teeth, -0.25, 0.25),
         Kind::Exact,
         0.5 * volume_of::area(teeth),
         {{{0, 0, 0}, -0.25}, {{0, 0, 1}, 0.75}}},
        {"revolved_polygon",
         revolved_polygon({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, vase),
         Kind::Exact,
         volume_of::revolved(vase),
         {{{0, 0, -1.4}, 0.5}}},
        terrain(),
        sampled(),
        {"perlin", perlin(0.5, {1.7, 1.7, 1.7}, 0.5, 3, 7), Kind::SignOnly, unknown, {{{0, 0, 0}, 0.0}}},
        heart(),
        gyroid(),
    };
}
