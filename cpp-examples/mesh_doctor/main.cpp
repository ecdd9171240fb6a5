// SPDX-License-Identifier: MIT OR Apache-2.0
// What is wrong with a mesh, and repair of what may be.
#include "patient.hpp"

#include <embound.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr const char *usage =
    "usage: mesh_doctor [option]... [mesh]...\n"
    "  --table        one line a mesh instead of a report\n"
    "  --repair       weld, drop bad faces, fill small holes, split and orient, and say what was done\n"
    "  --weld T       weld vertices nearer than T diagonals (with --repair)\n"
    "  --fill L       fill holes of one triangle, or whose rim is at most L diagonals; 0: none (with --repair; 0.5)\n"
    "  --join         all meshes together as one, a tag a file\n"
    "  --write FILE   write the mesh as it is then: .stl, .ply, .obj, .vtk or .vtp\n"
    "  --make FILE    write a mesh with every fault, and stop\n"
    "Without a mesh, one with every fault is made, repaired and checked.\n";

struct Request {
    bool table = false, repair = false, join = false, of_repair = false;
    std::string write, make;
    embound::RepairOptions options;
    std::vector<std::string> files;
};

std::optional<Request> parse(int argc, char **argv) {
    Request request;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        const bool takes_value = word == "--weld" || word == "--fill" || word == "--write" || word == "--make";
        if (takes_value && ++k == argc) {
            return std::nullopt;
        }
        char *end = nullptr;
        if (word == "--table") {
            request.table = true;
        } else if (word == "--repair") {
            request.repair = true;
        } else if (word == "--join") {
            request.join = true;
        } else if (word == "--write") {
            request.write = argv[k];
        } else if (word == "--make") {
            request.make = argv[k];
        } else if (word == "--weld" || word == "--fill") {
            request.of_repair = true;
            double &value = word == "--weld" ? request.options.weld_tolerance : request.options.hole_length;
            value = std::strtod(argv[k], &end);
            if (end == argv[k] || *end != '\0') {
                return std::nullopt;
            }
            if (word == "--fill" && value == 0.0) {
                request.options.flags &= ~EMB_REPAIR_HOLES;
            }
        } else if (word.rfind("--", 0) == 0) {
            return std::nullopt;
        } else {
            request.files.push_back(word);
        }
    }
    return request;
}

void table_line(const std::string &name, const emb_mesh_report &r, const emb_diagnosis_summary &s) {
    const std::size_t slash = name.find_last_of('/');
    std::printf("%-22s %9llu %-4s %8llu %6llu %8llu %14.8g %12.8g %5d %10llu %7llu\n", name.substr(slash + 1).c_str(),
                static_cast<unsigned long long>(r.triangles), r.closed != 0 ? "yes" : "no",
                static_cast<unsigned long long>(r.boundary_edges), static_cast<unsigned long long>(r.nonmanifold_edges),
                static_cast<unsigned long long>(r.inconsistent_edges), r.volume, r.area, r.components,
                static_cast<unsigned long long>(r.self_intersections), static_cast<unsigned long long>(s.turned_faces));
}

void report(const std::string &name, const embound::Mesh &mesh, bool table, const embound::Pool &pool) {
    const embound::Diagnosis diagnosis(mesh, {}, embound::Run(pool));
    if (table) {
        table_line(name, diagnosis.report(), diagnosis.summary());
    } else {
        std::printf("== %s\n%s\n", name.c_str(), diagnosis.text().c_str());
    }
}

embound::Mesh mend(const embound::Mesh &mesh, const embound::RepairOptions &options, bool quiet) {
    embound::Repaired repaired = embound::repair(mesh, options);
    const emb_repair_result &r = repaired.result;
    const auto say = [&](std::uint64_t count, const char *what) {
        if (!quiet && count > 0) {
            std::printf("%8llu %s\n", static_cast<unsigned long long>(count), what);
        }
    };
    if (!quiet) {
        std::printf("-- repair\n");
    }
    say(r.vertices_welded, "vertices welded");
    say(r.faces_collapsed, "faces collapsed by welding");
    say(r.degenerate_faces, "faces without area dropped");
    say(r.corners_added, "corners taken over by their neighbours");
    say(r.duplicate_faces, "repeated faces dropped");
    say(r.vertices_split, "vertices split");
    say(r.faces_turned, "faces turned over");
    say(r.components_turned, "components turned over as a whole");
    say(r.holes_filled, "holes filled");
    say(r.faces_added, "faces added");
    say(r.holes_left, "holes left");
    return repaired.mesh;
}

// The mesh with every fault must come out closed, consistent and of the right volume.
int self_check(const embound::Pool &pool) {
    const embound::Mesh broken = make_patient();
    report("a mesh with every fault", broken, false, pool);
    const embound::Mesh mended = mend(broken, {}, false);
    report("mended", mended, false, pool);
    const embound::Diagnosis diagnosis(mended, {}, embound::Run(pool));
    const emb_mesh_report r = diagnosis.report();
    // The two cubes still touch, which counts as an intersection, but share no vertex any more.
    const bool clean = r.closed != 0 && r.consistent != 0 && r.inside_out == 0 && r.nonmanifold_edges == 0 &&
                       r.degenerate_faces == 0 && r.duplicate_faces == 0 &&
                       diagnosis.summary().nonmanifold_vertices == 0 && r.components == 4;
    const embound::Geometry body = embound::from_mesh(mended);
    const bool right = std::abs(r.volume - healthy_volume) < 1e-12 && std::abs(body(0.5, 0.5, 0.5) + 0.5) < 1e-12 &&
                       std::abs(body(5.0, 5.0, 5.0) - 0.5) < 1e-12;
    std::printf("%s: volume %.8g of %.8g\n", clean && right ? "mended" : "NOT mended", r.volume, healthy_volume);
    return clean && right ? 0 : 1;
}

int run(const Request &request) {
    const embound::Pool pool(2);
    if (!request.make.empty()) {
        make_patient().write(request.make);
        return 0;
    }
    if (request.files.empty()) {
        return self_check(pool);
    }
    // Reported as read; orientation at reading is counted, and undone by nothing that is written.
    if (request.table) {
        std::printf("%-22s %9s %-4s %8s %6s %8s %14s %12s %5s %10s %7s\n", "mesh", "triangles", "shut", "boundary", "crowd",
                    "disagree", "volume", "area", "parts", "intersect", "turned");
    }
    std::vector<embound::Mesh> meshes;
    if (request.join) {
        meshes.push_back(embound::Mesh::read_files(request.files, embound::JoinTags::ByMesh));
    }
    int status = 0;
    for (std::size_t k = 0; k < (request.join ? 1 : request.files.size()); ++k) {
        // One file that cannot be read is told of, and the others are looked at.
        try {
            embound::Mesh mesh = request.join ? meshes[0] : embound::Mesh::read(request.files[k]);
            report(request.join ? "all together" : request.files[k], mesh, request.table, pool);
            if (request.repair) {
                mesh = mend(mesh, request.options, request.table);
                report("repaired", mesh, request.table, pool);
            }
            if (!request.write.empty()) {
                mesh.write(request.write);
            }
        } catch (const embound::Error &error) {
            std::fflush(stdout);
            std::fprintf(stderr, "mesh_doctor: %s\n", error.what());
            status = 1;
        }
    }
    return status;
}

} // namespace

int main(int argc, char **argv) {
    const std::optional<Request> request = parse(argc, argv);
    if (!request || (!request->write.empty() && request->files.size() != 1 && !request->join)) {
        std::fputs(usage, stderr);
        return 2;
    }
    if (request->of_repair && !request->repair) {
        std::fprintf(stderr, "mesh_doctor: --weld and --fill mean something with --repair alone\n%s", usage);
        return 2;
    }
    try {
        return run(*request);
    } catch (const embound::Error &error) {
        std::fprintf(stderr, "mesh_doctor: %s\n", error.what());
        return 1;
    }
}
