// SPDX-License-Identifier: MIT OR Apache-2.0
// Faces bring vertices of their own; those at one place are the same double for double, and welding joins them.
#include "nozzle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numeric>
#include <vector>

namespace {

using embound::Point;

constexpr double pi = 3.14159265358979323846;
constexpr double axial_length = 4.0;
constexpr std::size_t stations = 100, around = 96, rings = 12;
constexpr std::size_t jacket_begins = 54, jacket_ends = 80; // stations, around the throat

double radius(double x) { return 0.65 + 0.25 * std::cos(2.0 * pi * (x - 1.2) / 3.2); }

Point at(std::size_t station, std::size_t ring, std::size_t spoke) {
    const double x = axial_length * static_cast<double>(station) / stations;
    const double angle = 2.0 * pi * static_cast<double>(spoke % around) / around;
    const double r = radius(x) * (static_cast<double>(ring) / rings);
    return {x, r * std::cos(angle), r * std::sin(angle)};
}

struct Faces {
    std::vector<double> xyz;
    std::vector<std::size_t> offsets{0};
    std::vector<std::int32_t> tags;

    // Counterclockwise from outside.
    void add(std::initializer_list<Point> corners, std::int32_t tag) {
        for (const Point &p : corners) {
            xyz.insert(xyz.end(), p.begin(), p.end());
        }
        offsets.push_back(xyz.size() / 3);
        tags.push_back(tag);
    }
};

// One number of each vertex.
std::vector<double> at_vertices(const embound::Mesh &mesh, const std::function<double(const Point &)> &f) {
    const std::vector<Point> vertices = mesh.vertices();
    std::vector<double> values(vertices.size());
    std::transform(vertices.begin(), vertices.end(), values.begin(), f);
    return values;
}

} // namespace

double temperature(const Point &p) { return 300.0 + 25.0 * p[0] + 10.0 * p[1] - 15.0 * p[2]; }

double heating(const Point &p) {
    const double squared = p[1] * p[1] + p[2] * p[2], off_axis = squared / (0.1 + squared); // on the axis there is no angle
    return 0.5 + 0.5 * off_axis * std::sin(3.0 * std::atan2(p[2], p[1]) - 4.0 * p[0]);
}

embound::Mesh make_nozzle() {
    Faces faces;
    for (std::size_t i = 0; i < around; ++i) {
        faces.add({at(0, 0, 0), at(0, 1, i + 1), at(0, 1, i)}, inlet);
        faces.add({at(stations, 0, 0), at(stations, 1, i), at(stations, 1, i + 1)}, outlet);
        for (std::size_t r = 1; r < rings; ++r) {
            faces.add({at(0, r, i), at(0, r, i + 1), at(0, r + 1, i + 1), at(0, r + 1, i)}, inlet);
            faces.add({at(stations, r, i), at(stations, r + 1, i), at(stations, r + 1, i + 1), at(stations, r, i + 1)}, outlet);
        }
        for (std::size_t k = 0; k < stations; ++k) {
            faces.add({at(k, rings, i), at(k, rings, i + 1), at(k + 1, rings, i + 1), at(k + 1, rings, i)},
                      k >= jacket_begins && k < jacket_ends ? jacket : wall);
        }
    }
    std::vector<std::uint32_t> indices(faces.offsets.back());
    std::iota(indices.begin(), indices.end(), 0U);
    const embound::Mesh bare = embound::Mesh::from_polygons(faces.xyz, faces.offsets, indices);
    std::vector<double> numbers(faces.tags.size());
    std::iota(numbers.begin(), numbers.end(), 0.0);
    embound::Mesh mesh = embound::with_tags(bare, faces.tags, {{inlet, "inlet"}, {outlet, "outlet"}, {wall, "wall"}, {jacket, "jacket"}});
    mesh = embound::with_field(mesh, embound::On::Vertices, "heating", at_vertices(mesh, heating));
    mesh = embound::with_field(mesh, embound::On::Vertices, "temperature", at_vertices(mesh, temperature));
    return embound::with_field(mesh, embound::On::Faces, "panel", numbers);
}
