// SPDX-License-Identifier: MIT OR Apache-2.0
// Each cell is cut into the six tetrahedra along its diagonal (Kuhn's triangulation, the same in
// every cell, so that neighbours agree on their common face). In each the level set is linear between
// the corners and its negative part has a closed form.
#include "volume.hpp"

#include <algorithm>
#include <array>

namespace {

// How far from a to b the level set vanishes, a < 0 <= b.
double cut(double a, double b) { return a / (a - b); }

// The negative part of a tetrahedron whose corner values ascend, as a fraction.
double negative_fraction(std::array<double, 4> f) {
    std::sort(f.begin(), f.end());
    const auto [a, b, c, d] = f;
    if (a >= 0.0) {
        return 0.0;
    }
    if (d < 0.0) {
        return 1.0;
    }
    if (b >= 0.0) { // the corner a is cut off
        return cut(a, b) * cut(a, c) * cut(a, d);
    }
    if (c >= 0.0) { // a wedge along the edge from a to b, as three tetrahedra
        const double ac = cut(a, c), ad = cut(a, d), bc = cut(b, c), bd = cut(b, d);
        return ac * ad + (1.0 - ac) * ad * bc + (1.0 - ad) * bc * bd;
    }
    return 1.0 - (1.0 - cut(a, d)) * (1.0 - cut(b, d)) * (1.0 - cut(c, d)); // all but the corner d
}

// The negative part of a cell; corner 1 is a step along x from corner 0, 2 along y, 4 along z.
double cell_fraction(const std::array<double, 8> &f) {
    const auto [least, most] = std::minmax_element(f.begin(), f.end());
    if (*least >= 0.0) {
        return 0.0;
    }
    if (*most < 0.0) {
        return 1.0;
    }
    // The ways from corner 0 to corner 7 along three edges.
    constexpr std::size_t between[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
    double sum = 0.0;
    for (const auto &[p, q] : between) {
        sum += negative_fraction({f[0], f[p], f[q], f[7]});
    }
    return sum / 6.0;
}

} // namespace

double enclosed_volume(const Grid &grid) {
    double cells = 0.0;
    for (std::size_t k = 0; k + 1 < grid.n(2); ++k) {
        for (std::size_t j = 0; j + 1 < grid.n(1); ++j) {
            double row = 0.0;
            for (std::size_t i = 0; i + 1 < grid.n(0); ++i) {
                std::array<double, 8> f{};
                for (std::size_t corner = 0; corner < 8; ++corner) {
                    f[corner] = grid.values[grid.index(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2))];
                }
                row += cell_fraction(f);
            }
            cells += row;
        }
    }
    return cells * grid.spacing(0) * grid.spacing(1) * grid.spacing(2);
}
