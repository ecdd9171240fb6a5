// SPDX-License-Identifier: MIT OR Apache-2.0
#include "part.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

embound::Mesh make_blank() {
    constexpr double pi = 3.14159265358979323846;
    constexpr std::uint32_t around = 120, bands = 60;
    constexpr double a = 45.0, b = 25.0, c = 12.0;
    // A sphere of meridians and parallels, each point moved out or in along its ray from the centre.
    std::vector<double> xyz;
    const auto add = [&](double latitude, double longitude) {
        const double x = std::cos(latitude) * std::cos(longitude) * a, y = std::cos(latitude) * std::sin(longitude) * b;
        const double z = std::sin(latitude) * c;
        const double reach = std::pow(std::pow(x / a, 6) + std::pow(y / b, 6) + std::pow(z / c, 6), -1.0 / 6.0);
        xyz.insert(xyz.end(), {reach * x, reach * y, reach * z});
    };
    add(-0.5 * pi, 0.0);
    for (std::uint32_t j = 1; j < bands; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            add(pi * j / bands - 0.5 * pi, 2.0 * pi * i / around);
        }
    }
    add(0.5 * pi, 0.0);

    const std::uint32_t top = 1 + (bands - 1) * around;
    const auto vertex = [&](std::uint32_t j, std::uint32_t i) { return 1 + (j - 1) * around + i % around; };
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < around; ++i) {
        indices.insert(indices.end(), {0, vertex(1, i + 1), vertex(1, i)});
        for (std::uint32_t j = 1; j + 1 < bands; ++j) {
            indices.insert(indices.end(), {vertex(j, i), vertex(j, i + 1), vertex(j + 1, i + 1)});
            indices.insert(indices.end(), {vertex(j, i), vertex(j + 1, i + 1), vertex(j + 1, i)});
        }
        indices.insert(indices.end(), {vertex(bands - 1, i), vertex(bands - 1, i + 1), top});
    }
    return embound::Mesh::from_triangles(xyz, indices);
}
