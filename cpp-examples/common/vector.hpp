// SPDX-License-Identifier: MIT OR Apache-2.0
// The few words of vector algebra that the examples use.
#ifndef EXAMPLES_VECTOR_HPP
#define EXAMPLES_VECTOR_HPP

#include <embound.hpp>

#include <cmath>

inline double dot(const embound::Point &a, const embound::Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const embound::Point &a) { return std::sqrt(dot(a, a)); }

// p + t d.
inline embound::Point along(const embound::Point &p, double t, const embound::Point &d) {
    return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}
inline double distance(const embound::Point &a, const embound::Point &b) { return length(along(a, -1.0, b)); }
inline embound::Point unit(const embound::Point &a) {
    const double s = 1.0 / length(a);
    return {s * a[0], s * a[1], s * a[2]};
}
inline embound::Point cross(const embound::Point &a, const embound::Point &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

#endif
