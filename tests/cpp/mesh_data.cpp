// SPDX-License-Identifier: MIT OR Apache-2.0
// Half-edges, tags and named data of meshes through the C++ layer; meshes put together and taken apart.
#include "support/check.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace {

const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const std::vector<std::uint32_t> squares{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
const std::vector<std::size_t> offsets{0, 4, 8, 12, 16, 20, 24};

embound::Mesh cube(const embound::MeshOptions &options = {}, embound::Span<const std::int32_t> tags = {}) {
    return embound::Mesh::from_polygons(corners, offsets, squares, tags, options);
}

embound::Mesh cube_at(double x) {
    embound::MeshOptions options;
    options.shift = {x, 0.0, 0.0};
    return cube(options);
}

bool near(const embound::Point &p, double x, double y, double z) {
    return std::abs(p[0] - x) + std::abs(p[1] - y) + std::abs(p[2] - z) < 1e-14;
}

// 2 x - y + 3 z + 1 and x at each vertex; the number of each face.
embound::Mesh with_fields(const embound::Mesh &mesh) {
    std::vector<double> linear, number;
    for (const embound::Point &p : mesh.vertices()) {
        linear.push_back(2 * p[0] - p[1] + 3 * p[2] + 1);
        linear.push_back(p[0]);
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        number.push_back(static_cast<double>(f));
    }
    const embound::Mesh half = embound::with_field(mesh, embound::On::Vertices, "linear", linear);
    return embound::with_field(half, embound::On::Faces, "number", number);
}

} // namespace

TEST(a_cube_is_walked_by_half_edges) {
    const embound::Topology topology(cube()); // keeps the mesh
    CHECK(topology.half_edge_count() == 24);
    for (std::uint64_t f = 0; f < 6; ++f) {
        const std::vector<std::uint32_t> vertices = topology.corners(f);
        CHECK(vertices == std::vector<std::uint32_t>(squares.begin() + 4 * static_cast<std::ptrdiff_t>(f),
                                                     squares.begin() + 4 * static_cast<std::ptrdiff_t>(f) + 4));
        std::uint32_t h = topology.face_half_edge(f);
        for (const std::uint32_t v : vertices) {
            const std::uint32_t twin = topology.twin(h);
            CHECK(topology.origin(h) == v && topology.face(h) == static_cast<std::int64_t>(f));
            CHECK(topology.twin(twin) == h && topology.target(twin) == v && topology.previous(topology.next(h)) == h);
            h = topology.next(h);
        }
        CHECK(h == topology.face_half_edge(f));
    }
    for (std::uint32_t v = 0; v < 8; ++v) {
        const std::vector<std::uint32_t> leaving = topology.outgoing(v);
        CHECK(leaving.size() == 3 && topology.origin(leaving[1]) == v);
        const std::uint32_t h = leaving[0];
        CHECK(topology.around(topology.around(topology.around(h))) == h && topology.around(h) != h);
    }
    CHECK(topology.corners(6).empty() && topology.outgoing(8).empty());
    CHECK(topology.origin(24) == embound::Topology::none && topology.twin(topology.none) == topology.none);
    CHECK(topology.face(24) == -1 && topology.face_half_edge(6) == topology.none);
}

TEST(elements_are_measured) {
    const embound::Topology topology(cube());
    const double half = std::sqrt(0.5), third = 1.0 / std::sqrt(3.0);
    const embound::Measure face = topology.measure(embound::Element::face(1));
    CHECK(near(face.normal, 0, 0, 1) && near(face.centroid, 0.5, 0.5, 1) && std::abs(face.size - 1.0) < 1e-14);
    const embound::Measure edge = topology.measure(embound::Element::edge(topology.face_half_edge(2)));
    CHECK(near(edge.normal, 0, -half, -half) && near(edge.centroid, 0.5, 0, 0) && edge.size == 1.0);
    const embound::Measure vertex = topology.measure(embound::Element::vertex(7));
    CHECK(near(vertex.normal, third, third, third) && near(vertex.centroid, 1, 1, 1) && vertex.size == 0.0);
    const embound::Nearest nearest = topology.distance(embound::Element::face(1), {0.25, 0.5, -2.0});
    CHECK(nearest.distance == -3.0 && near(nearest.point, 0.25, 0.5, 1));
    CHECK(topology.distance(embound::Element::vertex(7), {3, 3, 2}).distance == 3.0);
    CHECK(check::status_of([&] { topology.measure(embound::Element::face(6)); }, "face 6") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { topology.measure({77, 0}); }, "element: 77") == EMB_ERROR_INVALID_ARGUMENT);
    const embound::Point nowhere{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
    CHECK(check::status_of([&] { topology.distance(embound::Element::vertex(7), nowhere); }, "point: (0, NaN, 0)") ==
          EMB_ERROR_INVALID_ARGUMENT);
}

TEST(points_lie_in_polygons_and_faces_three_ways) {
    using embound::Inside;
    // A pentagram's middle is covered twice.
    std::vector<std::array<double, 2>> star;
    for (int k = 0; k < 5; ++k) {
        const double turn = 0.8 * std::acos(-1.0) * k;
        star.push_back({std::cos(turn), std::sin(turn)});
    }
    CHECK(!embound::polygon_contains(star, {0.01, 0.02}) && !embound::polygon_contains(star, {0.01, 0.02}, Inside::Crossing));
    CHECK(embound::polygon_contains(star, {0.01, 0.02}, Inside::Winding));
    CHECK(embound::polygon_contains(star, {0.01, 0.02}, Inside::Angle));
    const embound::Topology topology(cube());
    for (const Inside how : {Inside::Crossing, Inside::Winding, Inside::Angle}) {
        CHECK(embound::polygon_contains(star, {0.7, 0.01}, how) && !embound::polygon_contains(star, {-0.9, 0.3}, how));
        CHECK(!embound::polygon_contains({}, {0.0, 0.0}, how));
        CHECK(topology.face_contains(1, {0.25, 0.75, -40.0}, how) && !topology.face_contains(1, {0.25, 1.25, 1.0}, how));
        CHECK(check::status_of([&] { embound::polygon_contains(star, {0.0, 2e100}, how); }, "point[1]: 2e100") ==
              EMB_ERROR_INVALID_ARGUMENT);
    }
    CHECK(check::status_of([&] { topology.face_contains(6, {0.0, 0.0, 0.0}); }, "face 6") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { topology.face_contains(1, {0.0, 0.0, -2e100}); }, "point[2]: -2e100") ==
          EMB_ERROR_INVALID_ARGUMENT);
}

TEST(vertices_triangles_and_tags_come_as_vectors) {
    const std::vector<std::int32_t> given{4, 4, -9, 4, 4, 4};
    const embound::Mesh mesh = cube({}, given);
    CHECK(mesh.vertex_count() == 8 && mesh.face_count() == 6 && mesh.triangle_count() == 12);
    CHECK(near(mesh.vertices()[6], 0, 1, 1) && mesh.triangles().size() == 36 && mesh.triangles()[35] < 8);
    CHECK(embound::tags(mesh) == std::vector<std::int32_t>({-9, 4}) && embound::face_tags(mesh) == given);
    CHECK(embound::tag_name(mesh, 4).empty());
    const std::int32_t named[1] = {4};
    const char *const names[1] = {"hull"};
    emb_mesh *with_names = nullptr;
    embound::check(emb_mesh_with_tags(mesh.get(), given.data(), 1, named, names, &with_names));
    CHECK(embound::tag_name(embound::Mesh(with_names), 4) == "hull");
}

TEST(fields_are_told_and_interpolated) {
    const embound::Mesh mesh = with_fields(cube());
    const std::vector<double> others(8, 1.0);
    const embound::Mesh other = embound::with_field(cube(), embound::On::Vertices, "other", others);
    CHECK(check::status_of([&] { embound::values(other, embound::field(mesh, embound::On::Vertices, "linear")); }, "\"other\"") ==
          EMB_ERROR_INVALID_ARGUMENT);
    const embound::Field linear = embound::field(mesh, embound::On::Vertices, "linear");
    const embound::Field number = embound::field(mesh, embound::On::Faces, "number");
    CHECK(linear.components == 2 && linear.count == 8 && number.components == 1 && number.count == 6);
    CHECK(embound::fields(mesh, embound::On::Vertices).size() == 1 && linear.name == "linear" && number.index == 0);
    CHECK(embound::values(mesh, linear)[15] == 1.0 && embound::values(mesh, number)[5] == 5.0);
    std::vector<embound::Point> points;
    for (int i = 0; i < 4000; ++i) {
        points.push_back({0.37 * (i % 7) - 0.6, 0.29 * (i % 11) - 0.9, 0.23 * (i % 13) - 0.8});
    }
    const embound::Closest closest = embound::from_mesh(mesh).closest(points);
    const std::vector<double> found = embound::interpolate(mesh, linear, closest);
    const std::vector<double> faces = embound::interpolate(mesh, number, closest);
    CHECK(found.size() == 8000 && faces.size() == 4000);
    bool same = true, later = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const embound::Point &p = closest.point[i];
        same = same && std::abs(found[2 * i] - (2 * p[0] - p[1] + 3 * p[2] + 1)) < 1e-13 && std::abs(found[2 * i + 1] - p[0]) < 1e-13;
        same = same && faces[i] == static_cast<double>(closest.primitive[i]);
        later = later || closest.piece[i] == 1;
    }
    CHECK(same && later);
    const embound::Pool pool(3);
    CHECK(check::same_bits(found, embound::interpolate(mesh, linear, closest, embound::Run(pool))));
    CHECK(embound::interpolate(mesh, linear, {}).empty());
    // what faces carry needs neither weights nor pieces
    embound::Closest bare;
    bare.primitive = {3, -1};
    CHECK(embound::interpolate(mesh, number, bare)[0] == 3.0 && std::isnan(embound::interpolate(mesh, number, bare)[1]));
}

TEST(errors_of_data_are_exceptions) {
    const embound::Mesh mesh = with_fields(cube());
    const embound::Field linear = embound::field(mesh, embound::On::Vertices, "linear");
    embound::Closest closest = embound::from_mesh(mesh).closest(std::vector<embound::Point>(2000, {0.5, 0.5, 3.0}));
    const auto refused = [](auto &&work, const char *word) { return check::status_of(work, word) == EMB_ERROR_INVALID_ARGUMENT; };
    CHECK(refused([&] { embound::field(mesh, embound::On::Faces, "linear"); }, "\"linear\""));
    CHECK(refused([&] { embound::with_field(mesh, embound::On::Faces, "a", std::vector<double>(7)); }, "values: 7"));
    CHECK(refused([&] { embound::with_field(mesh, embound::On::Vertices, "a", std::vector<double>(36)); }, "8 vertices, those left after welding"));
    CHECK(refused([&] { embound::with_field(mesh, embound::On::Faces, "", std::vector<double>(6)); }, "name: \"\""));
    CHECK(refused([&] { embound::with_field(mesh, embound::On::Faces, "a", {}); }, "components: 0"));
    CHECK(refused([&] { embound::interpolate(cube(), linear, closest); }, "k: 0"));
    // of another mesh, whose data would not fit into the result
    const embound::Mesh wide = embound::with_field(cube(), embound::On::Vertices, "linear", std::vector<double>(24));
    CHECK(refused([&] { embound::interpolate(wide, linear, closest); }, "has 2 components, the data of this mesh 3"));
    CHECK(refused([&] { embound::values(wide, linear); }, "has 2 components, the data of this mesh 3"));
    CHECK(check::status_of(
              [&] { embound::interpolate(mesh, linear, closest, embound::Run().progress([](double) { return true; })); }) ==
          EMB_ERROR_CANCELLED);
    closest.piece.pop_back();
    CHECK(refused([&] { embound::interpolate(mesh, linear, closest); }, "closest.piece: 1999"));
    closest.piece.clear();
    closest.barycentric.pop_back();
    CHECK(refused([&] { embound::interpolate(mesh, linear, closest); }, "closest.barycentric: 1999"));
}

TEST(meshes_are_joined_split_and_moved) {
    const embound::Mesh whole = embound::Mesh::join({with_fields(cube_at(0)), with_fields(cube_at(5)), cube_at(9)});
    CHECK(whole.report().components == 3 && whole.face_count() == 18 && embound::tags(whole).size() == 3);
    CHECK(embound::face_tags(whole)[6] == 1 && embound::face_tags(whole)[12] == 2);
    const std::vector<double> number = embound::values(whole, embound::field(whole, embound::On::Faces, "number"));
    CHECK(number[11] == 5.0 && std::isnan(number[12]));
    for (const embound::SplitBy by : {embound::SplitBy::Tag, embound::SplitBy::Component}) {
        std::vector<embound::Mesh> parts = whole.split(by);
        CHECK(parts.size() == 3 && parts[1].face_count() == 6 && parts[1].report().lo[0] == 5.0);
        CHECK(embound::values(parts[1], embound::field(parts[1], embound::On::Faces, "number"))[4] == 4.0);
        const embound::Mesh again = embound::Mesh::join(parts, embound::JoinTags::Keep);
        parts.clear();
        CHECK(again.vertices() == whole.vertices() && again.triangles() == whole.triangles());
        CHECK(embound::face_tags(again) == embound::face_tags(whole));
    }
    embound::MeshOptions options;
    options.scale = 2.0;
    options.orient = embound::Orient::Flip;
    const embound::Mesh moved = cube_at(1).transform(options);
    CHECK(moved.report().lo[0] == 2.0 && moved.report().hi[0] == 4.0);
    CHECK(embound::from_mesh(moved)(3.0, 1.0, 0.5) == 0.5);
    CHECK(check::status_of([] { embound::Mesh::join({}); }, "meshes") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { whole.split(static_cast<embound::SplitBy>(7)); }, "by: 7") == EMB_ERROR_INVALID_ARGUMENT);
    options.scale = 0.0;
    CHECK(check::status_of([&] { whole.transform(options); }, "scale") == EMB_ERROR_INVALID_ARGUMENT);
    const embound::Mesh wide = embound::with_field(cube(), embound::On::Faces, "number", std::vector<double>(12));
    CHECK(check::status_of([&] { embound::Mesh::join({whole, wide}); }, "\"number\"") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(files_become_one_mesh) {
    const std::vector<std::string> paths{"embound_tests_left.stl", "embound_tests_right.stl"};
    cube_at(0).write(paths[0]);
    cube_at(3).write(paths[1]);
    const embound::Mesh both = embound::Mesh::read_files(paths);
    CHECK(both.report().components == 2 && both.face_count() == 24 && embound::tags(both).size() == 2);
    CHECK(embound::tag_name(both, 0) == "embound_tests_left" && embound::tag_name(both, 1) == "embound_tests_right");
    CHECK(embound::tags(embound::Mesh::read_files(paths, embound::JoinTags::Keep)).size() == 1);
    const embound::Run stop = embound::Run().progress([](double) { return true; });
    CHECK(check::status_of([&] { embound::Mesh::read_files(paths, embound::JoinTags::ByMesh, {}, stop); }) == EMB_ERROR_CANCELLED);
    std::remove(paths[1].c_str());
    CHECK(check::status_of([&] { embound::Mesh::read_files(paths); }, "right.stl") == EMB_ERROR_IO);
    std::remove(paths[0].c_str());
    CHECK(check::status_of([&] { embound::Mesh::read_files({}); }, "paths") == EMB_ERROR_INVALID_ARGUMENT);
}
