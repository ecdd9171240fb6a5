// SPDX-License-Identifier: MIT OR Apache-2.0
// From a mesh to what a solver needs of it: quickstart [mesh]
#include "part.hpp"

#include "grid.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "slice.hpp"
#include "volume.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>

namespace {

constexpr std::size_t nodes_per_side = 128;
constexpr std::size_t blocks_per_side = 16;
constexpr double domain_over_bounds = 1.25;
constexpr double volume_tolerance = 0.01;
constexpr std::size_t compared_points = 1000;

const char *yes(int32_t flag) { return flag != 0 ? "yes" : "no"; }

embound::Mesh load(int argc, char **argv) {
    if (argc > 1) {
        embound::Mesh mesh = embound::Mesh::read(argv[1]);
        std::printf("mesh          %s\n", argv[1]);
        return mesh;
    }
    const Part part = make_bracket();
    embound::Mesh mesh = embound::Mesh::from_triangles(part.xyz, part.indices);
    const std::string path = in_demo_out("bracket.stl");
    mesh.write(path);
    const double volume = mesh.report().volume;
    if (!(std::abs(volume - part.volume) <= 1e-12 * part.volume)) {
        fail("the bracket's volume is " + std::to_string(volume) + " instead of " + std::to_string(part.volume));
    }
    std::printf("mesh          the built-in bracket, written to %s\n", path.c_str());
    return mesh;
}

void print(const emb_mesh_report &r) {
    std::printf("              %" PRIu64 " vertices, %" PRIu64 " faces, %" PRIu64 " triangles, %d component%s\n", r.vertices,
                r.faces, r.triangles, r.components, r.components == 1 ? "" : "s");
    std::printf("              closed %s, consistent %s, inside out %s\n", yes(r.closed), yes(r.consistent),
                r.inside_out != 0 ? "yes: turned outward" : "no");
    std::printf("              edges: %" PRIu64 " boundary, %" PRIu64 " non-manifold, %" PRIu64 " inconsistent; faces: %" PRIu64
                " degenerate, %" PRIu64 " duplicate\n",
                r.boundary_edges, r.nonmanifold_edges, r.inconsistent_edges, r.degenerate_faces, r.duplicate_faces);
    std::printf("              volume %.8g, area %.8g\n", r.volume, r.area);
    std::printf("              from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)\n", r.lo[0], r.lo[1], r.lo[2], r.hi[0], r.hi[1],
                r.hi[2]);
}

// Half of the points anywhere in the domain, half within a hundredth of its sides of the surface.
std::vector<embound::Point> scattered_points(const embound::Geometry &g, const Grid &grid) {
    std::mt19937_64 engine(20260101);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    std::vector<embound::Point> points(compared_points);
    for (embound::Point &p : points) {
        for (std::size_t d = 0; d < 3; ++d) {
            const std::vector<double> &nodes = grid.nodes[d];
            p[d] = nodes.front() + uniform() * (nodes.back() - nodes.front());
        }
    }
    const std::vector<embound::Point> on_surface = g.closest(points).point;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double side = grid.nodes[d].back() - grid.nodes[d].front();
            points[i][d] = on_surface[i][d] + (uniform() - 0.5) * 0.02 * side;
        }
    }
    return points;
}

// The hierarchy must not change a bit: the same points once through it, once past every triangle.
void compare_with_brute_force(const embound::Mesh &mesh, const embound::Geometry &g, const Grid &grid) {
    embound::SdfOptions every_triangle;
    every_triangle.accelerator = embound::Accelerator::None;
    const embound::Geometry brute = embound::from_mesh(mesh, every_triangle);
    const std::vector<embound::Point> points = scattered_points(g, grid);
    embound::Closest fast, slow;
    const double fast_time = seconds([&] { fast = g.closest(points); });
    const double slow_time = seconds([&] { slow = brute.closest(points); });
    std::size_t differing = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool same = std::memcmp(&fast.value[i], &slow.value[i], sizeof(double)) == 0 &&
                          fast.primitive[i] == slow.primitive[i] && fast.feature[i] == slow.feature[i];
        differing += same ? 0 : 1;
    }
    std::printf("agreement     with brute force to the last bit at %zu of %zu points; %s against %s: %.0f times faster\n",
                points.size() - differing, points.size(), in_words(slow_time).c_str(), in_words(fast_time).c_str(),
                slow_time / fast_time);
    if (differing != 0) {
        fail(std::to_string(differing) + " points differ from brute force");
    }
}

void classify(const embound::Geometry &g, const Grid &grid, const embound::Run &run) {
    const Blocks blocks = make_blocks(grid, blocks_per_side);
    std::vector<std::int32_t> sides;
    const double time = seconds([&] { sides = g.classify(blocks.lo, blocks.hi, run); });
    const auto count = [&](std::int32_t side) { return std::count(sides.begin(), sides.end(), side); };
    std::printf("boxes         %zu^3 of the same domain in %s: %td inside, %td outside, %td cut or near the surface\n", blocks_per_side,
                in_words(time).c_str(), count(-1), count(1), count(0));
    const std::size_t wrong = count_contradictions(grid, blocks, sides);
    if (wrong != 0) {
        fail(std::to_string(wrong) + " boxes are not on the side they are said to be");
    }
}

void compare_volumes(const Grid &grid, double exact) {
    const double volume = enclosed_volume(grid);
    const double off = (volume - exact) / exact;
    std::printf("volume        %.8g from the level set, %.8g from the mesh: %+.3f%%, the error of the grid\n", volume, exact,
                100.0 * off);
    if (!(std::abs(off) <= volume_tolerance)) {
        fail("the volume of the level set is off by more than 1%");
    }
}

void quickstart(int argc, char **argv) {
    const embound::Pool pool;
    print_library(pool);
    const embound::Mesh mesh = load(argc, argv);
    const emb_mesh_report report = mesh.report();
    print(report);

    embound::Geometry g;
    const double build_time = seconds([&] { g = embound::from_mesh(mesh, {}, pool); });
    const embound::Properties properties = g.properties();
    std::printf("distance      built in %s, %.1f MB, sign by %s\n", in_words(build_time).c_str(),
                1e-6 * static_cast<double>(properties.bytes), g.sign_text().c_str());

    Grid grid = make_grid(g.bounds(), domain_over_bounds, nodes_per_side);
    const double fill_time = seconds([&] {
        Progress progress("level set");
        grid.values = g.fill(grid.lattice(), embound::FillMode::Exact,
                             embound::Run(pool).progress([&](double fraction) { progress.tell(fraction); }));
    });
    const std::size_t points = grid.values.size();
    std::printf("level set     %zu^3 nodes in %s: %.2f million a second\n", nodes_per_side, in_words(fill_time).c_str(),
                1e-6 * static_cast<double>(points) / fill_time);

    classify(g, grid, pool);
    compare_with_brute_force(mesh, g, grid);
    const std::string stem = in_demo_out(argc > 1 ? std::filesystem::path(argv[1]).stem().string() : "bracket");
    embound::write_grid(stem + ".vti", grid.lattice(), {{"distance", grid.values}});
    std::printf("written       %s.vti: the level set, for ParaView\n", stem.c_str());
    const Slice slice = best_slice(grid);
    Legend legend{};
    const double picture_time = seconds([&] {
        Progress progress("picture");
        legend = write_slice(stem + ".png", g, grid, slice,
                             embound::Run(pool).progress([&](double fraction) { progress.tell(fraction); }));
    });
    std::printf("              %s.png: %zu x %zu pixels at %c = %.6g, a contour every %g, in %s\n", stem.c_str(), legend.width,
                legend.height, "xyz"[slice.axis], slice.at, legend.line_spacing, in_words(picture_time).c_str());
    compare_volumes(grid, std::abs(report.volume));
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 2 || (argc == 2 && std::string(argv[1]) == "--help")) {
        std::fprintf(stderr, "usage: quickstart [mesh]\n");
        return 2;
    }
    return run_example("quickstart", quickstart, argc, argv);
}
