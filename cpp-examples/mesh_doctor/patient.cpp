// SPDX-License-Identifier: MIT OR Apache-2.0
#include "patient.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Soup {
    std::vector<double> xyz;
    std::vector<Triangle> triangles;

    std::uint32_t vertex(double x, double y, double z) {
        xyz.insert(xyz.end(), {x, y, z});
        return static_cast<std::uint32_t>(xyz.size() / 3 - 1);
    }

    // Twelve triangles, outward.
    void cube(double lo, double hi) {
        std::array<std::uint32_t, 8> c{};
        for (unsigned k = 0; k < 8; ++k) {
            c[k] = vertex((k & 1U) != 0U ? hi : lo, (k & 2U) != 0U ? hi : lo, (k & 4U) != 0U ? hi : lo);
        }
        constexpr std::array<std::array<unsigned, 4>, 6> sides{
            {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
        for (const auto &s : sides) {
            triangles.push_back({c[s[0]], c[s[1]], c[s[2]]});
            triangles.push_back({c[s[0]], c[s[2]], c[s[3]]});
        }
    }
};

} // namespace

embound::Mesh make_patient() {
    Soup soup;
    soup.cube(0.0, 1.0);
    soup.triangles.erase(soup.triangles.begin() + 3); // half of a side is gone
    // The first edge of the first triangle is cut at its middle on one side only; a flat triangle fills the crack.
    const Triangle first = soup.triangles[0];
    std::array<double, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (soup.xyz[3 * first[0] + k] + soup.xyz[3 * first[1] + k]);
    }
    const std::uint32_t m = soup.vertex(middle[0], middle[1], middle[2]);
    soup.triangles[0] = {first[0], m, first[2]};
    soup.triangles.push_back({m, first[1], first[2]});
    soup.triangles.push_back({first[0], first[1], m});
    soup.cube(1.0, 2.0); // shares a corner with the first
    for (std::size_t t = 0; t < soup.triangles.size(); t += 3) {
        std::swap(soup.triangles[t][1], soup.triangles[t][2]);
    }
    const std::vector<Triangle> again(soup.triangles.begin(), soup.triangles.begin() + 5);
    soup.triangles.insert(soup.triangles.end(), again.begin(), again.end());
    soup.cube(4.0, 6.0);
    soup.cube(4.5, 5.5); // a hollow whose shell should face inward

    std::vector<std::uint32_t> indices;
    for (const Triangle &t : soup.triangles) {
        indices.insert(indices.end(), t.begin(), t.end());
    }
    embound::MeshOptions as_it_is;
    as_it_is.orient = embound::Orient::Keep;
    return embound::Mesh::from_triangles(soup.xyz, indices, {}, as_it_is);
}
