// SPDX-License-Identifier: MIT OR Apache-2.0
//! CGAL's tree of boxes (libcgal-dev) on one case: cgal CASE_DIRECTORY. Prints the lines of
//! benches/peers/case/src/report.rs.

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// What f64 peers must reach, in diagonals.
constexpr double tolerance = 1e-9;

template <class Number> std::vector<Number> numbers(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    std::vector<Number> all(static_cast<std::size_t>(file.tellg()) / sizeof(Number));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(all.size() * sizeof(Number)));
    return all;
}

template <class Work> double seconds(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double worst_error(const std::string& set, const std::vector<double>& answers, double diagonal) {
    const auto at = numbers<std::uint32_t>(set + ".at.u32");
    const auto exact = numbers<double>(set + ".exact.f64");
    double worst = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        const double error = std::abs(answers[at[k]] - std::abs(exact[k])) / diagonal;
        worst = std::max(worst, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    }
    return worst;
}

int main(int argc, char** argv) try {
    if (argc != 2) throw std::runtime_error("usage: cgal CASE_DIRECTORY");
    const std::string directory = argv[1], name = directory.substr(directory.find_last_of('/') + 1);
    const auto xyz = numbers<double>(directory + "/vertices.f64");
    const auto corners = numbers<std::uint32_t>(directory + "/triangles.u32");
    const auto point = [](const std::vector<double>& from, std::size_t k) {
        return Kernel::Point_3(from[3 * k], from[3 * k + 1], from[3 * k + 2]);
    };
    Triangles triangles;
    CGAL::Bbox_3 box;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        triangles.emplace_back(point(xyz, corners[t]), point(xyz, corners[t + 1]), point(xyz, corners[t + 2]));
        box += triangles.back().bbox();
    }
    const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());

    Tree tree;
    const double built = seconds([&] {
        tree.insert(triangles.begin(), triangles.end());
        tree.build();
        tree.accelerate_distance_queries();
    });
    std::printf("peer\tCGAL\t%s\tf64, unsigned, Debian\n", CGAL_VERSION_STR);
    std::printf("row\t%s\tbuild\tCGAL\t%e\ts\t-\t-\t-\n", name.c_str(), built);
    for (const std::string set : {"uniform", "near", "grid"}) {
        const std::string path = directory + "/" + set;
        const auto points = numbers<double>(path + ".f64");
        std::vector<double> answers(points.size() / 3, std::nan(""));
        const auto ask = [&](std::size_t step) {
            for (std::size_t k = 0; k < answers.size(); k += step)
                answers[k] = std::sqrt(tree.squared_distance(point(points, k)));
        };
        ask(10);
        const double time = seconds([&] { ask(1); });
        std::printf("row\t%s\t%s\tCGAL\t%e\tns\t%e\t-\t%e\n", name.c_str(), set.c_str(),
                    time * 1e9 / static_cast<double>(answers.size()), worst_error(path, answers, diagonal), tolerance);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
