// SPDX-License-Identifier: MIT OR Apache-2.0
// One mesh, placed many times: a hierarchy over copies that share one over triangles. nested_bvh [count] [mesh]
#include "placements.hpp"

#include "part.hpp"

#include "grid.hpp"
#include "random.hpp"
#include "report.hpp"
#include "slice.hpp"
#include "vector.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace {

using embound::Geometry;

constexpr std::size_t most_copies = 1000000;
constexpr std::size_t compared_points = 400;
constexpr std::size_t timed_points = 200000;
constexpr std::size_t blocks_per_side = 40, nodes_per_side = 121;
constexpr double bytes_per_copy = 2048.0; // the most that a placement may take

// nested_bvh [count] [mesh]: what is no number is the mesh.
struct Arguments {
    std::size_t count = 1000;
    std::string mesh; // empty: the bracket
};

Arguments parse(int argc, char **argv) {
    Arguments given;
    const std::string first = argc > 1 ? argv[1] : "";
    const bool counted = !first.empty() && first.find_first_not_of("0123456789") == std::string::npos;
    if (counted || argc > 2) {
        given.count = whole_number(first);
        given.mesh = argc > 2 ? argv[2] : "";
    } else {
        given.mesh = first;
    }
    return given;
}

embound::Mesh load(const std::string &path) {
    if (!path.empty()) {
        return embound::Mesh::read(path);
    }
    const Part bracket = make_bracket();
    return embound::Mesh::from_triangles(bracket.xyz, bracket.indices);
}

// Half anywhere around the copies, half within a hundredth of a copy's size of a surface.
std::vector<embound::Point> scattered_points(const Geometry &all, double size, Random &random) {
    const embound::Box box = all.bounds();
    std::vector<embound::Point> points = random.points_in(box, compared_points);
    const std::vector<embound::Point> on_surface = all.closest(points).point;
    const double reach = 0.01 * size;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        points[i] = along(on_surface[i], 1.0, random.in({{-reach, -reach, -reach}, {reach, reach, reach}}));
    }
    return points;
}

// The union must not change a bit: the same points once through it, once through every copy.
void compare_with_every_copy(const Geometry &all, const std::vector<Geometry> &copies, double size, Random &random) {
    const std::vector<embound::Point> points = scattered_points(all, size, random);
    std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
    const double slow = seconds([&] {
        for (const Geometry &copy : copies) {
            const std::vector<double> values = copy.values(points);
            std::transform(values.begin(), values.end(), least.begin(), least.begin(),
                           [](double value, double before) { return std::min(value, before); });
        }
    });
    const embound::Closest closest = all.closest(points);
    std::size_t values_differ = 0, labels_differ = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto label = static_cast<std::size_t>(closest.part[i]);
        values_differ += std::memcmp(&closest.value[i], &least[i], sizeof(double)) == 0 ? 0 : 1;
        const auto &[x, y, z] = points[i];
        labels_differ += label < copies.size() && copies[label](x, y, z) == least[i] ? 0 : 1;
    }
    std::printf("agreement     with the least of all copies to the last bit at %zu of %zu points; the label is the nearest "
                "copy's at %zu\n",
                points.size() - values_differ, points.size(), points.size() - labels_differ);
    require(values_differ == 0, std::to_string(values_differ) + " values differ from the least of all copies");
    require(labels_differ == 0, std::to_string(labels_differ) + " labels are not of the nearest copy");

    const std::vector<embound::Point> more = random.points_in(all.bounds(), timed_points);
    std::vector<double> values(more.size());
    const double fast = seconds([&] { all.values(more, values); });
    const double each = slow / compared_points, one = fast / timed_points;
    std::printf("values        %.0f ns a point on one thread, %.0f ns where every copy is asked: %.0f times as long\n", 1e9 * one,
                1e9 * each, each / one);
}

void fill_and_classify(Grid &grid, const Geometry &all, const embound::Pool &pool) {
    const double fill_time = seconds([&] { sample(grid, all, pool); });
    std::printf("level set     %zu^3 nodes in %s: %.2f million a second\n", nodes_per_side, in_words(fill_time).c_str(),
                1e-6 * static_cast<double>(grid.values.size()) / fill_time);
    const Blocks blocks = make_blocks(grid, blocks_per_side);
    std::vector<std::int32_t> sides;
    const double time = seconds([&] { sides = all.classify(blocks.lo, blocks.hi, pool); });
    const auto count = [&](std::int32_t side) { return std::count(sides.begin(), sides.end(), side); };
    std::printf("boxes         %zu^3 in %s: %td inside, %td outside, %td cut or near the surface\n", blocks_per_side,
                in_words(time).c_str(), count(-1), count(1), count(0));
    const std::size_t wrong = count_contradictions(grid, blocks, sides);
    require(wrong == 0, std::to_string(wrong) + " boxes are not on the side they are said to be");
}

void draw(const Geometry &all, const Grid &grid, const embound::Pool &pool) {
    const std::string path = in_demo_out("nested_bvh.png");
    const Slice slice = best_slice(grid);
    const double time = seconds([&] { write_slice(path, all, grid, slice, pool); });
    std::printf("written       %s: the distance in the plane %c = %.4g, in %s\n", path.c_str(), "xyz"[slice.axis], slice.at,
                in_words(time).c_str());
}

void nested_bvh(int argc, char **argv) {
    const Arguments given = parse(argc, argv);
    const std::size_t count = given.count;
    require(count > 0 && count <= most_copies, "the count must be a number from 1 to a million");
    const embound::Pool pool;
    print_library(pool);

    const embound::Mesh mesh = load(given.mesh);
    Geometry body;
    const double body_time = seconds([&] { body = embound::from_mesh(mesh, {}, pool); });
    const embound::Properties one = body.properties();
    std::printf("mesh          %zu triangles, distance built in %s, %.3f MB\n", mesh.triangle_count(), in_words(body_time).c_str(),
                1e-6 * static_cast<double>(one.bytes));

    std::vector<Geometry> copies;
    Geometry all;
    const double place_time = seconds([&] { copies = place_copies(body, count, 2026); });
    const double union_time = seconds([&] { all = embound::unite(copies); });
    const embound::Properties properties = all.properties();
    const double copied = static_cast<double>(properties.bytes) - static_cast<double>(one.bytes);
    std::printf("union         %zu copies placed in %s, united in %s; %s\n", count, in_words(place_time).c_str(),
                in_words(union_time).c_str(), in_words(properties.kind));
    std::printf("memory        %.3f MB, %.0f bytes a copy beside the one mesh; %zu meshes would take %.0f MB\n",
                1e-6 * static_cast<double>(properties.bytes), copied / static_cast<double>(count), count,
                1e-6 * static_cast<double>(count) * static_cast<double>(one.bytes));
    require(copied <= bytes_per_copy * static_cast<double>(count), "the union stores more than placements");
    require(properties.kind == one.kind, "the union of disjoint copies is not what one of them is");

    Random random(1);
    const embound::Box box = body.bounds();
    compare_with_every_copy(all, copies, distance(box.lo, box.hi), random);
    Grid grid = make_grid(all.bounds(), 1.05, nodes_per_side);
    fill_and_classify(grid, all, pool);
    draw(all, grid, pool);
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        std::fprintf(stderr, "usage: nested_bvh [count] [mesh]\n");
        return 2;
    }
    return run_example("nested_bvh", nested_bvh, argc, argv);
}
