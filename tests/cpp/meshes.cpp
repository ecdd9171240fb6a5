// SPDX-License-Identifier: MIT OR Apache-2.0
// Meshes through the C++ layer: from arrays, from memory, to a file and back.
#include "support/check.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace {

const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const std::vector<std::uint32_t> triangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
const std::vector<std::uint32_t> squares{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

} // namespace

TEST(a_cube_of_triangles) {
    std::vector<std::int32_t> tags;
    for (int i = 0; i < 12; ++i) {
        tags.push_back(100 + i);
    }
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, triangles, tags);
    const emb_mesh_report report = mesh.report();
    CHECK(report.closed == 1 && report.consistent == 1 && report.inside_out == 0 && report.components == 1);
    CHECK(report.vertices == 8 && report.faces == 12 && report.triangles == 12);
    CHECK(std::abs(report.volume - 1.0) < 1e-14 && std::abs(report.area - 6.0) < 1e-14);
    CHECK(report.lo[0] == 0.0 && report.hi[2] == 1.0);
    const embound::Geometry g = embound::from_mesh(mesh);
    CHECK(g(0.5, 0.5, 0.25) == -0.25 && g(0.5, 0.5, 3.0) == 2.0 && g(-3.0, -4.0, 0.5) == 5.0);
    const embound::Closest closest = g.closest(std::vector<embound::Point>{{0.25, 0.7, 3.0}, {-1.0, -1.0, -1.0}});
    CHECK(closest.primitive[0] == 2 || closest.primitive[0] == 3);
    CHECK(closest.tag[0] == 100 + closest.primitive[0] && closest.feature[0] == 0);
    CHECK(closest.primitive[1] == 0 && closest.feature[1] >= 4);
    const embound::Point w = closest.barycentric[0];
    CHECK(std::abs(w[0] + w[1] + w[2] - 1.0) < 1e-15);
    CHECK(g.properties().sign_method == embound::Sign::Pseudonormal && g.properties().primitives == 12);
}

TEST(squares_and_floats_make_the_same_cube) {
    const std::vector<std::size_t> offsets{0, 4, 8, 12, 16, 20, 24};
    const std::vector<float> single(corners.begin(), corners.end());
    const embound::Geometry a = embound::from_mesh(embound::Mesh::from_triangles(corners, triangles));
    const embound::Geometry b = embound::from_mesh(embound::Mesh::from_polygons(corners, offsets, squares));
    const embound::Geometry c = embound::from_mesh(embound::Mesh::from_triangles(single, triangles));
    const std::vector<double> axis = check::axis(-0.7, 1.6, 9);
    const std::vector<double> values = a.fill(embound::Lattice(axis, axis, axis));
    CHECK(check::same_bits(values, b.fill(embound::Lattice(axis, axis, axis))));
    CHECK(check::same_bits(values, c.fill(embound::Lattice(axis, axis, axis))));
    const std::vector<std::size_t> short_offsets{0, 4};
    CHECK(check::status_of([&] { embound::Mesh::from_polygons(corners, short_offsets, squares); }, "offsets") ==
          EMB_ERROR_INVALID_ARGUMENT);
}

TEST(options_reach_the_library) {
    embound::MeshOptions options;
    options.scale = 2.0;
    options.shift = {10.0, 0.0, 0.0};
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, triangles, {}, options);
    CHECK(mesh.report().lo[0] == 10.0 && mesh.report().hi[0] == 12.0 && std::abs(mesh.report().volume - 8.0) < 1e-13);
    options = {};
    options.orient = embound::Orient::Flip;
    const embound::Geometry inside_out = embound::from_mesh(embound::Mesh::from_triangles(corners, triangles, {}, options));
    CHECK(inside_out(0.5, 0.5, 0.25) == 0.25);
    embound::SdfOptions brute;
    brute.accelerator = embound::Accelerator::None;
    const embound::Mesh plain = embound::Mesh::from_triangles(corners, triangles);
    const std::vector<double> axis = check::axis(-0.7, 1.6, 9);
    CHECK(check::same_bits(embound::from_mesh(plain).fill(embound::Lattice(axis, axis, axis)),
                           embound::from_mesh(plain, brute).fill(embound::Lattice(axis, axis, axis))));
}

TEST(vertices_move) {
    embound::MeshOptions options;
    options.weld_tolerance = -1.0;
    const embound::Geometry g = embound::from_mesh(embound::Mesh::from_triangles(corners, triangles, {}, options));
    std::vector<double> moved(corners.begin(), corners.end());
    for (double &c : moved) {
        c = 2.0 * c + 1.0;
    }
    const embound::Geometry h = embound::refit(g, moved);
    CHECK(h(2.0, 2.0, 1.5) == -0.5 && g(0.5, 0.5, 0.25) == -0.25);
    const embound::Pool pool(2);
    CHECK(embound::refit(g, moved, embound::RefitCheck::Trust, embound::Run(pool))(2.0, 2.0, 1.5) == -0.5);
    moved.pop_back();
    CHECK(check::status_of([&] { embound::refit(g, moved); }, "xyz") == EMB_ERROR_INVALID_ARGUMENT);
    moved.resize(3);
    CHECK(check::status_of([&] { embound::refit(g, moved); }, "vertex_count") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { embound::refit(embound::complement(g), moved); }, "g: ") == EMB_ERROR_UNSUPPORTED);
}

TEST(a_mesh_survives_a_file) {
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, triangles);
    const std::string path = "embound_tests_cube.stl";
    mesh.write(path);
    const embound::Mesh again = embound::Mesh::read(path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::remove(path.c_str());
    const embound::Mesh from_memory = embound::Mesh::read_memory(bytes.data(), bytes.size());
    for (const embound::Mesh &m : {again, from_memory}) {
        CHECK(m.report().vertices == 8 && m.report().triangles == 12 && std::abs(m.report().volume - 1.0) < 1e-14);
    }
    CHECK(check::status_of([&] { mesh.write("cube.unknown"); }) == EMB_ERROR_UNSUPPORTED);
    CHECK(check::status_of([&] { embound::Mesh::read_memory(bytes.data(), 100); }) == EMB_ERROR_PARSE);
    const embound::Run stop = embound::Run().progress([](double) { return true; });
    CHECK(check::status_of([&] { embound::Mesh::read_memory(bytes.data(), bytes.size(), {}, stop); }) == EMB_ERROR_CANCELLED);
    CHECK(check::thrown<int>(
              [&] {
                  const embound::Run fail = embound::Run().progress([](double) -> bool { throw 17; });
                  embound::from_mesh(mesh, {}, fail);
              },
              0) == 17);
}

TEST(triangles_know_their_faces_and_a_mesh_whether_it_has_an_inside) {
    const std::vector<std::size_t> offsets{0, 4, 8, 12, 16, 20, 24};
    const embound::Mesh cube = embound::Mesh::from_polygons(corners, offsets, squares);
    CHECK((cube.triangle_faces() == std::vector<std::int64_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
    CHECK(cube.has_inside());
    const std::vector<std::uint32_t> open(triangles.begin() + 6, triangles.end());
    const embound::Mesh lidless = embound::Mesh::from_triangles(corners, open);
    embound::RepairOptions all;
    all.hole_length = 2.4; // a rim of 4 over a diagonal of 1.73
    CHECK(!lidless.has_inside() && !embound::repair(lidless).mesh.has_inside() && embound::repair(lidless, all).mesh.has_inside());
}

TEST(an_open_mesh_has_no_sign_but_a_distance) {
    const std::vector<std::uint32_t> open(triangles.begin(), triangles.end() - 3);
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, open);
    CHECK(mesh.report().closed == 0 && mesh.report().boundary_edges == 3);
    CHECK(check::status_of([&] { embound::from_mesh(mesh); }) == EMB_ERROR_TOPOLOGY);
    embound::SdfOptions unsigned_distance;
    unsigned_distance.sign = embound::Sign::None;
    CHECK(embound::from_mesh(mesh, unsigned_distance)(0.5, 0.5, 0.25) == 0.25);
    embound::SdfOptions winding;
    winding.sign = embound::Sign::Winding;
    const embound::Geometry g = embound::from_mesh(mesh, winding);
    CHECK(g(0.5, 0.5, 0.25) == -0.25 && g(0.5, 0.5, 1.25) > 0.0);
    CHECK(g.properties().sign_method == embound::Sign::Winding && std::isinf(g.properties().lipschitz));
    CHECK(g.sign_text() == "WINDING, as asked: there are 3 boundary edges in 1 loops");
    CHECK(embound::sphere({0, 0, 0}, 1.0).sign_text().empty());
    const std::vector<std::uint32_t> wild{0, 1, 99};
    CHECK(check::status_of([&] { embound::Mesh::from_triangles(corners, wild); }, "99") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(an_open_mesh_is_closed_by_caps_or_goes_on_beyond_a_box) {
    const std::vector<std::uint32_t> open(triangles.begin(), triangles.end() - 3);
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, open);
    embound::SdfOptions options;
    options.open = embound::Open::Cap;
    const embound::Geometry capped = embound::from_mesh(mesh, options);
    CHECK(capped(0.5, 0.5, 0.25) == -0.25 && capped(0.5, 0.5, 3.0) == 2.0);
    options.sign = embound::Sign::None;
    CHECK(check::status_of([&] { embound::from_mesh(mesh, options); }, "options.open") == EMB_ERROR_INVALID_ARGUMENT);
    options.sign = embound::Sign::Auto;
    options.open = embound::Open::Sweep;
    CHECK(check::status_of([&] { embound::from_mesh(mesh, options); }, "options.open_lo") == EMB_ERROR_INVALID_ARGUMENT);
    // Without its first side the cube goes on there.
    const std::vector<std::uint32_t> sides(triangles.begin() + 6, triangles.end());
    options.open_lo = {0.0, 0.0, 0.0};
    options.open_hi = {1.0, 1.0, 1.0};
    const embound::Geometry swept = embound::from_mesh(embound::Mesh::from_triangles(corners, sides), options);
    int near_an_end = 0;
    for (const double c : {0.01, 0.99}) {
        near_an_end += (swept(c, 0.5, 0.5) < -0.4) + (swept(0.5, c, 0.5) < -0.4) + (swept(0.5, 0.5, c) < -0.4);
    }
    CHECK(near_an_end == 1);
}

TEST(tags_are_replaced_and_named) {
    const embound::Mesh cube = embound::Mesh::from_triangles(corners, triangles);
    const std::vector<std::int32_t> sides{7, 7, 7, 7, 7, 7, 7, 7, 7, 7, -2, -2};
    const embound::Mesh named = embound::with_tags(cube, sides, {{7, "wall"}, {-2, "inlet"}});
    CHECK(embound::face_tags(named) == sides && embound::tags(named) == (std::vector<std::int32_t>{-2, 7}));
    CHECK(embound::tag_name(named, 7) == "wall" && embound::tag_name(named, -2) == "inlet" && embound::tag_name(named, 0).empty());
    CHECK(embound::tags(cube) == std::vector<std::int32_t>{0});
    CHECK(embound::tag_name(embound::with_tags(named, sides), 7).empty());
    const std::vector<std::int32_t> few{1, 2};
    CHECK(check::status_of([&] { embound::with_tags(cube, few); }, "tags") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { embound::with_tags(cube, sides, {{7, "wall"}, {7, "roof"}}); }, "7") ==
          EMB_ERROR_INVALID_ARGUMENT);
}
