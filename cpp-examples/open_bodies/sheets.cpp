// SPDX-License-Identifier: MIT OR Apache-2.0
#include "sheets.hpp"

#include <cmath>
#include <vector>

namespace {

constexpr double pi = 3.141592653589793;

} // namespace

embound::Mesh make_sheet(const Cells &cells, const std::function<embound::Point(double, double)> &at) {
    const std::uint32_t row = cells.round ? cells.along_u : cells.along_u + 1;
    std::vector<double> xyz;
    for (std::uint32_t j = 0; j <= cells.along_v; ++j) {
        for (std::uint32_t i = 0; i < row; ++i) {
            const embound::Point p = at(static_cast<double>(i) / cells.along_u, static_cast<double>(j) / cells.along_v);
            xyz.insert(xyz.end(), p.begin(), p.end());
        }
    }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t j = 0; j < cells.along_v; ++j) {
        for (std::uint32_t i = 0; i < cells.along_u; ++i) {
            const std::uint32_t next = (i + 1) % row;
            const std::uint32_t a = i + row * j, b = next + row * j, c = next + row * (j + 1), d = i + row * (j + 1);
            indices.insert(indices.end(), {a, b, c, a, c, d});
        }
    }
    return embound::Mesh::from_triangles(xyz, indices);
}

double ground(double x, double y) { return -0.6 + 0.15 * std::sin(2.0 * x) * std::cos(3.0 * y); }

// Along x, cut off just where the domain, -1 to 1, ends.
embound::Mesh make_pipe() {
    return make_sheet({96, 24, true}, [](double u, double v) {
        return embound::Point{2.0 * v - 1.0, pipe_radius * std::cos(2.0 * pi * u), pipe_radius * std::sin(2.0 * pi * u)};
    });
}

embound::Mesh make_ground() {
    return make_sheet({120, 120, false}, [](double u, double v) {
        const double x = 3.0 * u - 1.5, y = 3.0 * v - 1.5;
        return embound::Point{x, y, ground(x, y)};
    });
}

embound::Mesh make_plate() {
    return make_sheet({8, 8, false}, [](double u, double v) { return embound::Point{0.1, u - 0.5, v - 0.5}; });
}

embound::Mesh make_ball_without_a_triangle() {
    constexpr std::uint32_t around = 64, up = 32;
    std::vector<double> xyz{0.0, 0.0, -ball_radius};
    for (std::uint32_t j = 1; j < up; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double u = 2.0 * pi * i / around, v = pi * j / up;
            for (const double c : {std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), -std::cos(v)}) {
                xyz.push_back(ball_radius * c);
            }
        }
    }
    xyz.insert(xyz.end(), {0.0, 0.0, ball_radius});
    const std::uint32_t last = 1 + (up - 1) * around;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        indices.insert(indices.end(), {0, 1 + next, 1 + i});
        for (std::uint32_t j = 0; j + 2 < up; ++j) {
            const std::uint32_t a = 1 + i + around * j, b = 1 + next + around * j;
            indices.insert(indices.end(), {a, b, b + around, a, b + around, a + around});
        }
        indices.insert(indices.end(), {last - around + i, last - around + next, last});
    }
    const std::vector<std::uint32_t> open(indices.begin() + 3, indices.end());
    return embound::Mesh::from_triangles(xyz, open);
}
