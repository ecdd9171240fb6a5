// SPDX-License-Identifier: MIT OR Apache-2.0
// The angle bracket: every cell of a perforated face is a ring of quads between its square outline
// and its hole. Outlines are cut at the same places everywhere, so neighbours share their vertices
// and the surface is closed.
#include "part.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>

namespace {

using Point = std::array<double, 3>;

constexpr int cells_x = 4;          // of floor and wall
constexpr int cells_y = 3;          // of the floor
constexpr int cells_z = 1;          // of the wall, above the floor
constexpr int cuts = 12;            // of each side of a cell's outline
constexpr int segments = 4 * cuts;  // of a hole
constexpr double cell = 20.0;       // side of a cell
constexpr double radius = 9.0;      // of a hole: webs of 2.0
constexpr double floor_height = 8.0;
constexpr double wall_width = 1.6;
constexpr double pi = 3.14159265358979323846;

// Where the outlines are cut: every face computes the same double for the same place.
constexpr double along(int cut) { return cut * (cell / cuts); }

constexpr double wall_y = along(cells_y * cuts);

class Surface {
public:
    // Counterclockwise from outside.
    void quad(const Point &a, const Point &b, const Point &c, const Point &d) {
        const std::array<std::uint32_t, 4> v{vertex(a), vertex(b), vertex(c), vertex(d)};
        for (const std::size_t k : std::array<std::size_t, 6>{0, 1, 2, 0, 2, 3}) {
            part.indices.push_back(v[k]);
        }
    }

    Part part{};

private:
    std::uint32_t vertex(const Point &p) {
        const auto [at, fresh] = known_.try_emplace(p, static_cast<std::uint32_t>(known_.size()));
        if (fresh) {
            part.xyz.insert(part.xyz.end(), p.begin(), p.end());
        }
        return at->second;
    }

    std::map<Point, std::uint32_t> known_;
};

// (u, v) of the k-th point of the outline of cell (i, j), counterclockwise from its lower left corner.
std::array<double, 2> outline(int i, int j, int k) {
    const int side = (k / cuts) % 4, step = k % cuts;
    const int u0 = i * cuts, v0 = j * cuts;
    switch (side) {
    case 0: return {along(u0 + step), along(v0)};
    case 1: return {along(u0 + cuts), along(v0 + step)};
    case 2: return {along(u0 + cuts - step), along(v0 + cuts)};
    default: return {along(u0), along(v0 + cuts - step)};
    }
}

// (u, v) of the point of the hole that faces it.
std::array<double, 2> hole(int i, int j, int k) {
    const double angle = 2.0 * pi * (k % segments) / segments - 0.75 * pi;
    return {(i + 0.5) * cell + radius * std::cos(angle), (j + 0.5) * cell + radius * std::sin(angle)};
}

// A plate of perforated cells between two parallel faces. `front` places (u, v) on the face from
// which u, v and the outward normal are right-handed, `back` on the other.
void perforated(Surface &surface, int cells_u, int cells_v, const std::function<Point(double, double)> &front,
                const std::function<Point(double, double)> &back) {
    for (int i = 0; i < cells_u; ++i) {
        for (int j = 0; j < cells_v; ++j) {
            for (int k = 0; k < segments; ++k) {
                const auto [ou, ov] = outline(i, j, k);
                const auto [pu, pv] = outline(i, j, k + 1);
                const auto [hu, hv] = hole(i, j, k);
                const auto [gu, gv] = hole(i, j, k + 1);
                surface.quad(front(ou, ov), front(pu, pv), front(gu, gv), front(hu, hv));
                surface.quad(back(pu, pv), back(ou, ov), back(hu, hv), back(gu, gv));
                surface.quad(front(hu, hv), front(gu, gv), back(gu, gv), back(hu, hv));
            }
        }
    }
}

} // namespace

Part make_bracket() {
    Surface surface;
    const double back_y = wall_y + wall_width;
    const auto height = [](int cut) { return floor_height + along(cut); };
    const double top = height(cells_z * cuts);

    perforated(surface, cells_x, cells_y, [](double u, double v) { return Point{u, v, floor_height}; },
               [](double u, double v) { return Point{u, v, 0.0}; });
    perforated(surface, cells_x, cells_z, [](double u, double v) { return Point{u, wall_y, floor_height + v}; },
               [=](double u, double v) { return Point{u, back_y, floor_height + v}; });

    for (int k = 0; k < cells_x * cuts; ++k) { // the long sides, and the wall's top and foot
        const double a = along(k), b = along(k + 1);
        surface.quad({a, 0.0, 0.0}, {b, 0.0, 0.0}, {b, 0.0, floor_height}, {a, 0.0, floor_height});
        surface.quad({b, back_y, 0.0}, {a, back_y, 0.0}, {a, back_y, floor_height}, {b, back_y, floor_height});
        surface.quad({a, wall_y, top}, {b, wall_y, top}, {b, back_y, top}, {a, back_y, top});
        surface.quad({b, wall_y, 0.0}, {a, wall_y, 0.0}, {a, back_y, 0.0}, {b, back_y, 0.0});
    }
    const double left = 0.0, right = along(cells_x * cuts);
    const auto ends = [&](double y0, double y1, double z0, double z1) {
        surface.quad({right, y0, z0}, {right, y1, z0}, {right, y1, z1}, {right, y0, z1});
        surface.quad({left, y1, z0}, {left, y0, z0}, {left, y0, z1}, {left, y1, z1});
    };
    for (int k = 0; k < cells_y * cuts; ++k) {
        ends(along(k), along(k + 1), 0.0, floor_height);
    }
    ends(wall_y, back_y, 0.0, floor_height);
    for (int k = 0; k < cells_z * cuts; ++k) {
        ends(wall_y, back_y, height(k), height(k + 1));
    }

    const double opening = 0.5 * segments * radius * radius * std::sin(2.0 * pi / segments);
    surface.part.volume = cells_x * cells_y * (cell * cell - opening) * floor_height +
                          cells_x * cell * wall_width * top - cells_x * cells_z * opening * wall_width;
    return surface.part;
}
