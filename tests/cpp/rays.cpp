// SPDX-License-Identifier: MIT OR Apache-2.0
// Rays through the C++ layer.
#include "support/check.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

// The unit cube.
embound::Geometry cube() {
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const std::vector<std::size_t> offsets{0, 4, 8, 12, 16, 20, 24};
    const std::vector<std::uint32_t> squares{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return embound::from_mesh(embound::Mesh::from_polygons(corners, offsets, squares));
}

} // namespace

TEST(rays_meet_the_faces_of_meshes) {
    const embound::Geometry g = embound::part(cube(), 6);
    const std::vector<embound::Point> origin{{-1, 0.5, 0.5}, {-1, -1, -1}, {5, 5, 5}}, direction{{1, 0, 0}, {1, 1, 1}, {1, 0, 0}};
    embound::Rays rays{origin, direction};
    const embound::RayHits first = embound::first_hits(g, rays);
    CHECK(first.t[0] == 1.0 && first.t[1] == 1.0 && std::isnan(first.t[2]));
    CHECK(first.side[0] == -1 && first.side[2] == 0 && first.part[0] == 6 && first.part[2] == -1);
    CHECK(first.primitive[0] == 4 && first.primitive[2] == -1 && first.normal[0][0] == -1.0);
    const embound::AllRayHits all = embound::all_hits(g, rays, embound::Pool(2));
    CHECK((all.offsets == std::vector<std::size_t>{0, 2, 4, 4}));
    CHECK((all.hits.t == std::vector<double>{1.0, 2.0, 1.0, 2.0}) && (all.hits.side == std::vector<std::int32_t>{-1, 1, -1, 1}));
    rays.t_min = 1.5;
    std::vector<double> t(3);
    embound::RayHitsOut out;
    out.t = t;
    embound::first_hits(g, rays, out);
    CHECK(t[0] == 2.0 && t[1] == 2.0 && std::isnan(t[2]));
    rays.t_max = 1.75;
    CHECK(embound::all_hits(g, rays).offsets[3] == 0);
    CHECK(check::status_of([&] { embound::first_hits(embound::sphere({0, 0, 0}, 1.0), rays); }, "a shape") == EMB_ERROR_UNSUPPORTED);
    t.resize(2);
    out.t = t;
    CHECK(check::status_of([&] { embound::first_hits(g, rays, out); }, "out.t: 2 elements") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(faces_are_found_by_box_and_by_distance) {
    const embound::Geometry g = cube();
    CHECK((embound::faces_overlapping(g, embound::Box{{-1, -1, -1}, {2, 2, 0}}) == std::vector<std::int64_t>{0, 2, 3, 4, 5}));
    CHECK((embound::faces_overlapping(g, embound::Box{{0.25, 0.25, 0.5}, {0.5, 0.5, 1}}) == std::vector<std::int64_t>{1}));
    CHECK(embound::faces_overlapping(g, embound::Box{{0.25, 0.25, 0.5}, {0.5, 0.5, 0.75}}).empty());
    CHECK((embound::faces_within(g, {0.5, 0.5, 2.0}, 1.0) == std::vector<std::int64_t>{1}));
    CHECK(embound::faces_within(g, {0.5, 0.5, 2.0}, 0.875).empty() && embound::faces_within(g, {9, 9, 9}, INFINITY).size() == 6);
    CHECK((embound::faces_within(embound::translate(g, {1, 0, 0}), {1.5, 0.5, 2.0}, 1.0) == std::vector<std::int64_t>{1}));
    const embound::Geometry two = embound::unite({g, embound::translate(g, {4, 0, 0})});
    CHECK(check::status_of([&] { embound::faces_within(two, {0, 0, 0}, 1.0); }, "2 meshes") == EMB_ERROR_UNSUPPORTED);
}
