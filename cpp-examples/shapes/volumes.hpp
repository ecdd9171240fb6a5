// SPDX-License-Identifier: MIT OR Apache-2.0
// Volumes in closed form.
#ifndef SHAPES_VOLUMES_HPP
#define SHAPES_VOLUMES_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace volume_of {

constexpr double pi = 3.14159265358979323846;

inline double ball(double r) { return 4.0 / 3.0 * pi * r * r * r; }

// A box of sides a, b, c with a ball of radius r rolled around it (Steiner's formula).
inline double rounded_box(double a, double b, double c, double r) {
    return a * b * c + 2.0 * r * (a * b + b * c + c * a) + pi * r * r * (a + b + c) + ball(r);
}

// The same of a cylinder of radius a and height l.
inline double rounded_cylinder(double a, double l, double r) {
    return pi * a * a * l + r * 2.0 * pi * a * (a + l) + r * r * (pi * l + pi * pi * a) + ball(r);
}

using Polygon = std::vector<std::array<double, 2>>;

inline double area(const Polygon &p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto &[a, b] = p[i];
        const auto &[c, d] = p[(i + 1) % p.size()];
        sum += 0.5 * (a * d - b * c);
    }
    return std::abs(sum);
}

// Of a polygon (distance from the axis, height) turned around the axis: a sum of truncated cones.
inline double revolved(const Polygon &p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto &[r, z] = p[i];
        const auto &[s, w] = p[(i + 1) % p.size()];
        sum += pi / 3.0 * (r * r + r * s + s * s) * (w - z);
    }
    return std::abs(sum);
}

} // namespace volume_of

#endif
