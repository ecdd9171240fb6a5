// SPDX-License-Identifier: MIT OR Apache-2.0
// A mesh machined with shapes: drilled, given a boss with a fillet, engraved, cut in half. csg [mesh]
#include "part.hpp"

#include "grid.hpp"
#include "render.hpp"
#include "report.hpp"
#include "volume.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using embound::Geometry;

constexpr std::size_t nodes_per_side = 96;
constexpr double own_tolerance = 0.005, given_tolerance = 0.03; // of the grid, in parts of the blank

enum Part : std::int32_t { blank, drilling, boss, engraving, section };
const Look look{
    {{0.8, 0.8, 0.8}, {0.62, 0.68, 0.74}, {0.93, 0.60, 0.30}, {0.38, 0.60, 0.82}, {0.45, 0.70, 0.50}, {0.93, 0.90, 0.82}}};

// The tools, sized by the box around the mesh. A label names what each leaves behind.
struct Tools {
    Geometry drills, boss, cutter, keep;
    double fillet;
};
Tools make_tools(const embound::Box &box) {
    const embound::Point mid{0.5 * (box.lo[0] + box.hi[0]), 0.5 * (box.lo[1] + box.hi[1]), 0.5 * (box.lo[2] + box.hi[2])};
    const double x = box.hi[0] - box.lo[0], y = box.hi[1] - box.lo[1], z = box.hi[2] - box.lo[2], top = box.hi[2] + 0.5 * z;
    const double boss_at = mid[0] + 0.22 * x, boss_radius = 0.14 * std::min(x, 2.0 * y), depth = 0.8 * z;

    // One drill, four times: the copies cost no memory, and a question asks those that are near.
    const Geometry drill =
        embound::cylinder({mid[0] - 0.38 * x, mid[1], box.lo[2] - z}, {mid[0] - 0.38 * x, mid[1], box.hi[2] + z}, 0.04 * x);
    // A prism around the z axis, twisted about it by a quarter turn over its depth, and put where it belongs.
    const Geometry prism = embound::prism({0.0, 0.0, -depth}, {0.0, 0.0, 0.1 * z}, {1.0, 0.0, 0.0}, 5, 0.65 * boss_radius);
    const Geometry screw = embound::translate(embound::twist(prism, 90.0 / depth), {boss_at, mid[1], top});
    return {embound::part(embound::repeat(drill, {0.12 * x, 0.0, 0.0}, {4, 1, 1}), drilling),
            embound::part(embound::cylinder({boss_at, mid[1], mid[2]}, {boss_at, mid[1], top}, boss_radius), boss),
            embound::part(screw, engraving), embound::part(embound::plane(mid, {0.0, -1.0, 0.0}), section), 0.3 * z};
}

class Bench {
  public:
    Bench(const embound::Box &box, const embound::Pool &pool) : grid_(make_grid(box, 1.1, nodes_per_side)), pool_(pool) {}

    // Prints a line about a body and gives the volume that a level set of it encloses.
    double measure(const char *what, const Geometry &g) {
        double volume = 0.0;
        const double time = seconds([&] {
            sample(grid_, g, pool_);
            volume = enclosed_volume(grid_);
        });
        const embound::Box box = g.bounds();
        std::printf("%-13s %-11s  volume %-9.6g  z from %.4g to %.4g  (%zu^3 nodes in %s)\n", what, in_words(g.properties().kind),
                    volume, box.lo[2], box.hi[2], nodes_per_side, in_words(time).c_str());
        return volume;
    }

  private:
    Grid grid_;
    const embound::Pool &pool_;
};

void draw(const std::string &path, const Geometry &whole, const Geometry &half, const embound::Box &box,
          const embound::Pool &pool) {
    const double reach = std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
    const embound::Point mid{0.5 * (box.lo[0] + box.hi[0]), 0.5 * (box.lo[1] + box.hi[1]), 0.5 * (box.lo[2] + box.hi[2])};
    const View view{mid, {-0.45, -1.3, 0.95}, 0.57 * reach, 2.0 * reach};
    Image both(720, 280, look.background);
    both.paste(render(whole, view, look, 360, 280, pool), 0, 0);
    both.paste(render(half, view, look, 360, 280, pool), 0, 360);
    write_png(path, both);
}

void csg(int argc, char **argv) {
    const embound::Pool pool;
    print_library(pool);
    const embound::Mesh mesh = argc > 1 ? embound::Mesh::read(argv[1]) : make_blank();
    const Geometry body = embound::part(embound::from_mesh(mesh, {}, pool), blank);
    const emb_mesh_report report = mesh.report();
    const Tools tools = make_tools(body.bounds());

    const Geometry drilled = embound::difference(body, tools.drills);
    const Geometry bossed = embound::smooth_union({drilled, tools.boss}, embound::Blend::smooth(tools.fillet));
    const Geometry engraved = embound::difference(bossed, tools.cutter);
    const Geometry half = embound::intersection(engraved, tools.keep);
    const Geometry other_half = embound::difference(engraved, tools.keep);

    std::printf("mesh          %llu triangles, volume %.6g\n", static_cast<unsigned long long>(report.triangles), report.volume);
    Bench bench(bossed.bounds(), pool);
    const double v_body = bench.measure("blank", body);
    const double v_chips = bench.measure("chips", embound::intersection(body, tools.drills));
    const double v_drilled = bench.measure("drilled", drilled);
    const double v_sharp = bench.measure("sharp boss", embound::unite(drilled, tools.boss));
    const double v_bossed = bench.measure("boss, fillet", bossed);
    // A twist stretches the more the further out: the value is divided by the most within the tool's bounds.
    const double v_engraved = bench.measure("engraved", engraved);
    const double v_half = bench.measure("one half", half);
    const double v_other = bench.measure("other half", other_half);

    const double slack = (argc > 1 ? given_tolerance : own_tolerance) * v_body; // a mesh may be thin for the grid
    require(std::abs(v_body - std::abs(report.volume)) <= slack, "the level set of the mesh has another volume than the mesh");
    require(v_chips > 0.0 && std::abs(v_drilled + v_chips - v_body) <= slack, "what is drilled and the chips are not the blank");
    require(v_sharp > v_drilled && v_bossed > v_sharp, "a boss adds, and a fillet adds to it");
    require(v_engraved < v_bossed, "engraving takes away");
    require(v_half > 0.0 && v_half < v_engraved, "a half is less than the whole");
    require(std::abs(v_half + v_other - v_engraved) <= slack, "two halves are not the whole");

    const std::string name = argc > 1 ? "csg-" + std::filesystem::path(argv[1]).stem().string() : "csg";
    const std::string path = in_demo_out(name + ".png");
    const double time = seconds([&] { draw(path, engraved, half, bossed.bounds(), pool); });
    std::printf("written       %s, in %s\n", path.c_str(), in_words(time).c_str());
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 2) {
        std::fprintf(stderr, "usage: csg [mesh]\n");
        return 2;
    }
    return run_example("csg", csg, argc, argv);
}
