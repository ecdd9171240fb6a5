// SPDX-License-Identifier: MIT OR Apache-2.0
// Diagnoses of meshes through the C++ layer.
#include "support/check.hpp"

#include <cstdint>

namespace {

const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const std::vector<std::uint32_t> triangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

// The cube without its last face, with the second face turned over, the first again, a needle and a spike.
embound::Mesh dirty() {
    std::vector<double> xyz = corners;
    std::vector<std::uint32_t> indices(triangles.begin(), triangles.end() - 3);
    std::swap(indices[4], indices[5]);
    indices.insert(indices.end(), {0, 2, 1, 8, 9, 10, 0, 0, 1, 8, 9, 11});
    xyz.insert(xyz.end(), {5, 0, 0, 6, 0, 0, 5.5, 1e-5, 0, 5.25, 0, 0});
    return embound::Mesh::from_triangles(xyz, indices);
}

} // namespace

TEST(a_clean_cube_has_nothing_to_tell) {
    const embound::Mesh mesh = embound::Mesh::from_triangles(corners, triangles);
    const embound::Diagnosis found(mesh);
    const emb_mesh_report report = found.report();
    CHECK(report.closed == 1 && report.components == 1 && report.self_intersections == 0 && report.volume == 1.0);
    const emb_diagnosis_summary summary = found.summary();
    CHECK(summary.components == 1 && summary.boundary_loops == 0 && summary.intersections_complete == 1);
    CHECK(found.nonmanifold_edges().empty() && found.inconsistent_edges().empty() && found.nonmanifold_vertices().empty());
    CHECK(found.shrunk_faces().empty() && found.flat_faces().empty() && found.duplicates().empty());
    CHECK(found.slivers().empty() && found.warped_faces().empty() && found.off_plane_faces().empty() && found.intersections().empty() && found.loops().empty());
    CHECK(found.components().size() == 1 && found.components()[0].faces == 12 && found.components()[0].volume == 1.0);
    CHECK(found.text().find("to do: nothing: closed, consistent, outward") != std::string::npos);
}

TEST(faults_are_listed) {
    const embound::Diagnosis found{dirty()};
    const embound::Diagnosis copy = found;
    CHECK(copy.report().faces == 15 && copy.report().degenerate_faces == 2 && copy.report().duplicate_faces == 1);
    CHECK(found.nonmanifold_edges().size() == 3);
    for (const embound::NonmanifoldEdge &edge : found.nonmanifold_edges()) {
        CHECK(edge.faces.size() == 3 && edge.vertices[0] < edge.vertices[1]);
    }
    CHECK(found.inconsistent_edges().size() == 3 && found.inconsistent_edges()[0].faces[0] == 1);
    CHECK(found.nonmanifold_vertices().size() == 3 && found.nonmanifold_vertices()[0].fans == 3);
    CHECK(found.shrunk_faces() == std::vector<std::int64_t>{13} && found.flat_faces() == std::vector<std::int64_t>{14});
    const std::vector<embound::Duplicate> duplicates = found.duplicates();
    CHECK(duplicates.size() == 1 && duplicates[0].face == 11 && duplicates[0].original == 0 && duplicates[0].same_way);
    const std::vector<embound::FaceMeasure> slivers = found.slivers();
    CHECK(slivers.size() == 1 && slivers[0].face == 12 && slivers[0].ratio > 0.99e-5 && slivers[0].ratio < 1.01e-5);
    const std::vector<emb_mesh_component> components = found.components();
    CHECK(components.size() == 2 && components[1].lowest_face == 12 && components[1].closed == 0);
    CHECK(found.face_components()[13] == EMB_NO_INDEX && found.face_components()[14] == 1);
    const std::vector<emb_mesh_loop> loops = found.loops();
    CHECK(loops.size() == 2 && loops[0].edges == 3 && loops[0].closed == 1);
    CHECK(found.loop_vertices(0).size() == 3);
    CHECK(check::status_of([&] { found.loop_vertices(2); }, "index: 2") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(found.text().find("duplicate faces: 1: ") != std::string::npos);
}

TEST(intersections_are_pairs_of_faces) {
    std::vector<double> xyz = corners;
    std::vector<std::uint32_t> indices = triangles;
    for (const double c : corners) {
        xyz.push_back(c + 0.5);
    }
    for (const std::uint32_t v : triangles) {
        indices.push_back(v + 8);
    }
    const embound::Mesh mesh = embound::Mesh::from_triangles(xyz, indices);
    const embound::Diagnosis found(mesh, {}, embound::Run(embound::Pool(2)));
    const std::vector<std::array<std::int64_t, 2>> pairs = found.intersections();
    CHECK(!pairs.empty() && found.report().self_intersections == pairs.size() && found.summary().components == 2);
    for (const std::array<std::int64_t, 2> &pair : pairs) {
        CHECK(pair[0] < 12 && pair[1] >= 12);
    }
    embound::DiagnosisOptions few;
    few.intersection_limit = 2;
    const embound::Diagnosis limited(mesh, few);
    CHECK(limited.intersections().size() == 2 && limited.summary().intersections_complete == 0);
    few.intersection_limit = 0;
    CHECK(embound::Diagnosis(mesh, few).report().self_intersections == UINT64_MAX);
    few.sliver_ratio = 2.0;
    CHECK(check::status_of([&] { embound::Diagnosis(mesh, few); }, "sliver_ratio") == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::thrown<int>([&] { embound::Diagnosis(mesh, {}, embound::Run().progress([](double) -> bool { throw 5; })); }, 0) == 5);
}
