// SPDX-License-Identifier: MIT OR Apache-2.0
// Marching tetrahedra (Doi & Koide 1991) over the six tetrahedra along the diagonal of each cell, the same in
// every cell. A point on an edge is computed from its inner end, so that all tetrahedra at the edge get the same
// double, and welding makes one surface of their triangles.
#include "cut_surface.hpp"

#include "report.hpp"
#include "vector.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace {

using embound::Point;

struct Node {
    Point at;
    double value;
    bool inside() const { return value <= 0.0; }
};

class Surface {
  public:
    // Corners 1, 2, 3 of a right-handed tetrahedron stand counterclockwise seen from outside opposite corner 0.
    void cut(std::array<Node, 4> c, bool right_handed) {
        for (std::size_t last = 3; last > 0; --last) { // what is inside comes first; every exchange turns the hand
            for (std::size_t i = 0; i < last; ++i) {
                if (!c[i].inside() && c[i + 1].inside()) {
                    std::swap(c[i], c[i + 1]);
                    right_handed = !right_handed;
                }
            }
        }
        if (!right_handed) {
            // Exchanging two that are on the same side rights it.
            c[1].inside() == c[0].inside() ? std::swap(c[0], c[1]) : std::swap(c[2], c[3]);
        }
        switch (std::count_if(c.begin(), c.end(), [](const Node &node) { return node.inside(); })) {
        case 1: add(between(c[0], c[1]), between(c[0], c[2]), between(c[0], c[3])); break;
        case 2: {
            const Point a = between(c[0], c[2]), b = between(c[1], c[3]);
            add(a, between(c[0], c[3]), b);
            add(a, b, between(c[1], c[2]));
            break;
        }
        case 3: add(between(c[0], c[3]), between(c[1], c[3]), between(c[2], c[3])); break;
        default: break;
        }
    }

    embound::Mesh mesh() const {
        require(!xyz_.empty(), "no cell of the grid is cut");
        std::vector<std::uint32_t> indices(xyz_.size() / 3);
        std::iota(indices.begin(), indices.end(), 0U);
        embound::MeshOptions options;
        options.orient = embound::Orient::Keep;
        return embound::Mesh::from_triangles(xyz_, indices, {}, options);
    }

  private:
    static Point between(const Node &in, const Node &out) {
        return along(in.at, in.value / (in.value - out.value), along(out.at, -1.0, in.at));
    }

    // Where a node lies on the surface, triangles at it shrink to an edge or a point.
    void add(const Point &a, const Point &b, const Point &c) {
        if (a != b && b != c && c != a) {
            for (const Point *p : {&a, &b, &c}) {
                xyz_.insert(xyz_.end(), p->begin(), p->end());
            }
        }
    }

    std::vector<double> xyz_;
};

// Corner 1 is a step along x from corner 0, 2 along y, 4 along z.
void cut_cell(Surface &surface, const std::array<Node, 8> &c) {
    struct Way { // from corner 0 to corner 7 along three edges
        std::size_t first, second;
        bool right_handed;
    };
    constexpr Way ways[6]{{1, 3, true}, {1, 5, false}, {2, 3, false}, {2, 6, true}, {4, 5, true}, {4, 6, false}};
    for (const auto &[p, q, right_handed] : ways) {
        surface.cut({c[0], c[p], c[q], c[7]}, right_handed);
    }
}

} // namespace

embound::Mesh cut_surface(const Grid &grid) {
    Surface surface;
    for (std::size_t k = 0; k + 1 < grid.n(2); ++k) {
        for (std::size_t j = 0; j + 1 < grid.n(1); ++j) {
            for (std::size_t i = 0; i + 1 < grid.n(0); ++i) {
                std::array<Node, 8> corners{};
                std::size_t inside = 0;
                for (std::size_t c = 0; c < 8; ++c) {
                    const std::size_t x = i + (c & 1), y = j + (c >> 1 & 1), z = k + (c >> 2);
                    corners[c] = {{grid.nodes[0][x], grid.nodes[1][y], grid.nodes[2][z]}, grid.values[grid.index(x, y, z)]};
                    inside += corners[c].inside() ? 1 : 0;
                }
                if (inside != 0 && inside != 8) {
                    cut_cell(surface, corners);
                }
            }
        }
    }
    return surface.mesh();
}
