// SPDX-License-Identifier: MIT OR Apache-2.0
// Boundary data painted on a body, carried to the cut surface of a solver's grid. paint [mesh [field]]
#include "colours.hpp"
#include "cut_surface.hpp"
#include "nozzle.hpp"

#include "grid.hpp"
#include "render.hpp"
#include "report.hpp"
#include "text.hpp"
#include "vector.hpp"

#include <embound.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using embound::Geometry;
using embound::Mesh;
using embound::On;
using embound::Point;

constexpr std::size_t nodes_per_side = 96;
constexpr double rounding = 1e-12;
constexpr double heating_tolerance = 0.01;                      // of flat faces, of stripes from 0 to 1
constexpr double area_tolerance = 0.05, area_allowance = 0.005; // of a tag's own area, of the whole surface's

using Areas = std::map<std::int32_t, double>; // by tag

struct Cut {
    Mesh mesh; // bare
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Point> vertices, centroids;
};

Cut cut(const Geometry &body, double &cell_diagonal, const embound::Pool &pool) {
    Grid grid = make_grid(body.bounds(), 1.1, nodes_per_side);
    const double fill_time = seconds([&] { sample(grid, body, pool); });
    cell_diagonal = length({grid.spacing(0), grid.spacing(1), grid.spacing(2)});
    Cut made{cut_surface(grid), {}, {}, {}};
    made.vertices = made.mesh.vertices();
    const std::vector<std::uint32_t> corners = made.mesh.triangles();
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        made.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        Point sum{};
        for (const std::uint32_t v : made.triangles.back()) {
            sum = along(sum, 1.0 / 3.0, made.vertices[v]);
        }
        made.centroids.push_back(sum);
    }
    const emb_mesh_report report = made.mesh.report();
    std::printf("cut surface   %zu triangles between %zu^3 nodes, filled in %s; closed %s\n", made.triangles.size(), nodes_per_side,
                in_words(fill_time).c_str(), report.closed != 0 ? "yes" : "no");
    require(report.closed == 1 && report.inside_out == 0, "the cut surface is not closed and outward");
    return made;
}

// What the mesh carries at the vertices and triangles of the cut surface: of the nearest point of the body.
Mesh painted(const Mesh &mesh, const Mesh &bare, const embound::Closest &at_vertices, const embound::Closest &at_centroids,
             const embound::Run &run) {
    std::vector<std::pair<std::int32_t, std::string>> names;
    for (const std::int32_t tag : tags(mesh)) {
        std::string name = tag_name(mesh, tag);
        if (!name.empty()) {
            names.emplace_back(tag, std::move(name));
        }
    }
    Mesh made = with_tags(bare, at_centroids.tag, names);
    for (const embound::Field &field : fields(mesh, On::Vertices)) {
        made = with_field(made, On::Vertices, field.name, interpolate(mesh, field, at_vertices, run));
    }
    for (const embound::Field &field : fields(mesh, On::Faces)) {
        made = with_field(made, On::Faces, field.name, interpolate(mesh, field, at_centroids, run));
    }
    return made;
}

// Interpolated positions are the closest points themselves, whatever the mesh is.
void check_positions(const Mesh &mesh, const embound::Closest &closest, double cell_diagonal, const embound::Run &run) {
    const std::vector<Point> vertices = mesh.vertices();
    const Mesh located = with_field(mesh, On::Vertices, "position", {vertices.front().data(), 3 * vertices.size()});
    const std::vector<double> positions = interpolate(located, field(located, On::Vertices, "position"), closest, run);
    const emb_mesh_report report = mesh.report();
    double scale = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
        scale = std::max({scale, std::abs(report.lo[d]), std::abs(report.hi[d])});
    }
    double off = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < closest.point.size(); ++i) {
        off = std::max(off, distance({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}, closest.point[i]));
        farthest = std::max(farthest, std::abs(closest.value[i]));
    }
    std::printf("closest       no vertex of the cut surface is farther from the body than %.2g cell diagonals; positions "
                "interpolated there are off by %.1e of the coordinates\n",
                farthest / cell_diagonal, off / scale);
    require(off <= rounding * scale, "interpolated positions are not the closest points");
    require(farthest <= cell_diagonal, "the cut surface is farther from the body than a cell");
}

// The same for what is known of the built-in nozzle's data.
void check_own_data(const Mesh &nozzle, const Mesh &paint, const embound::Closest &at_vertices,
                    const embound::Closest &at_centroids) {
    const std::vector<double> linear = values(paint, field(paint, On::Vertices, "temperature")),
                              curved = values(paint, field(paint, On::Vertices, "heating")),
                              panels = values(paint, field(paint, On::Faces, "panel"));
    double linear_off = 0.0, curved_off = 0.0;
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const Point &p = at_vertices.point[i];
        linear_off = std::max(linear_off, std::abs(linear[i] - temperature(p)) / temperature(p));
        curved_off = std::max(curved_off, std::abs(curved[i] - heating(p)));
    }
    const std::vector<std::int32_t> face_tags = embound::face_tags(nozzle);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const auto face = static_cast<std::size_t>(at_centroids.primitive[i]);
        wrong += panels[i] == static_cast<double>(face) && at_centroids.tag[i] == face_tags[face] ? 0 : 1;
    }
    std::printf("values        temperature, linear in space, is off by %.1e of itself, heating by %.1e of its range; panels and "
                "tags are the closest face's on %zu of %zu triangles\n",
                linear_off, curved_off, panels.size() - wrong, panels.size());
    require(linear_off <= rounding, "a linear field is not itself at the closest point");
    require(curved_off <= heating_tolerance, "a curved field is off by more than its faces are flat");
    require(wrong == 0, "a panel or a tag is not that of the closest face");
}

void compare_areas(const Mesh &mesh, const Cut &cut, const std::vector<std::int32_t> &cut_tags) {
    Areas of_mesh, of_cut;
    const embound::Topology topology(mesh);
    const std::vector<std::int32_t> mesh_tags = face_tags(mesh);
    double total = 0.0;
    for (std::size_t f = 0; f < mesh_tags.size(); ++f) {
        if (topology.face_half_edge(f) != embound::Topology::none) {
            const double area = topology.measure(embound::Element::face(f)).size;
            of_mesh[mesh_tags[f]] += area;
            total += area;
        }
    }
    for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
        const auto &[a, b, c] = cut.triangles[i];
        const std::vector<Point> &p = cut.vertices;
        of_cut[cut_tags[i]] += 0.5 * length(cross(along(p[b], -1.0, p[a]), along(p[c], -1.0, p[a])));
    }
    for (const auto &[tag, area] : of_mesh) {
        const double painted_area = of_cut[tag], off = painted_area - area;
        const std::string name = tag_name(mesh, tag);
        std::printf("%s %-12s area %-10.6g on the body, %-10.6g on the cut surface: %+.2f%%\n",
                    tag == of_mesh.begin()->first ? "tags         " : "             ",
                    name.empty() ? std::to_string(tag).c_str() : name.c_str(), area, painted_area, 100.0 * off / area);
        // Where flat faces meet, planes through a cell cut the edge off.
        require(std::abs(off) <= std::max(area_tolerance * area, area_allowance * total),
                "the area of tag " + std::to_string(tag) + " is not that of the body");
    }
    require(of_cut.size() == of_mesh.size(), "the cut surface has a tag that the body does not have");
}

// The file gives back what was painted, bit by bit.
void write_and_read(const std::string &path, const Mesh &paint) {
    paint.write(path);
    const Mesh again = Mesh::read(path);
    require(again.face_count() == paint.face_count() && face_tags(again) == face_tags(paint), path + ": other faces or tags");
    for (const On on : {On::Vertices, On::Faces}) {
        for (const embound::Field &written : fields(paint, on)) {
            const std::vector<double> before = values(paint, written), after = values(again, field(again, on, written.name));
            require(before.size() == after.size() && std::memcmp(before.data(), after.data(), before.size() * sizeof(double)) == 0,
                    path + ": other values of " + written.name);
        }
    }
    for (const std::int32_t tag : tags(paint)) {
        require(tag_name(again, tag) == tag_name(paint, tag), path + ": another name of a tag");
    }
    std::printf("written       %s: the cut surface with its data, which reads back the same\n", path.c_str());
}

// The words that there are letters for.
std::string in_letters(const std::string &words) {
    std::string text;
    for (const char c : words) {
        const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool known = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
        text += known ? small : small == '-' || small == '.' || small == '_' ? small : ' ';
    }
    return text;
}

// The painted cut surface itself, seen from a corner: a field on the left, the tags on the right.
void draw(const std::string &path, const Mesh &paint, const std::string &field_name, const embound::Pool &pool) {
    const Geometry surface = embound::from_mesh(paint, {}, pool);
    const FieldColours colours(paint, field_name);
    const std::vector<std::int32_t> all_tags = tags(paint);
    const embound::Box box = surface.bounds();
    const Point middle = along(box.lo, 0.5, along(box.hi, -1.0, box.lo));
    const double reach = distance(box.lo, box.hi);
    const View view{middle, {-0.8, -1.1, 0.45}, 0.44 * reach, reach};
    constexpr std::size_t width = 400, height = 280, caption = 24;

    Look look;
    look.shadows = false;
    Image both(2 * width, height + caption, look.background);
    const auto show = [&](std::size_t column, const std::string &words) {
        both.paste(render(surface, view, look, width, height, pool), 0, column);
        const std::string text = in_letters(words);
        write_text(both, height + 2, column + (width - std::min(width, text_width(text, 2))) / 2, text, 2, {0.2, 0.2, 0.2});
    };
    look.paint = [&](const std::vector<Point> &points) {
        return colours.at(surface.closest(points, std::numeric_limits<double>::infinity(), pool), pool);
    };
    show(0, colours.name().empty() ? "no data" : colours.name());
    look.paint = [&](const std::vector<Point> &points) {
        return tag_colours(all_tags, surface.closest(points, std::numeric_limits<double>::infinity(), pool).tag);
    };
    show(width, "tags");
    write_png(path, both);
}

void paint(int argc, char **argv) {
    const embound::Pool pool;
    print_library(pool);
    const bool own = argc == 1;
    const Mesh mesh = own ? make_nozzle() : Mesh::read(argv[1]);
    const std::string field_name = argc > 2 ? argv[2] : "";
    const FieldColours shown(mesh, field_name); // refuses a name that there is not
    std::printf("mesh          %zu faces, %zu tags; data of vertices: %zu, of faces: %zu\n", mesh.face_count(), tags(mesh).size(),
                fields(mesh, On::Vertices).size(), fields(mesh, On::Faces).size());

    const Geometry body = embound::from_mesh(mesh, {}, pool);
    double cell_diagonal = 0.0;
    const Cut surface = cut(body, cell_diagonal, pool);
    embound::Closest at_vertices, at_centroids;
    constexpr double any = std::numeric_limits<double>::infinity();
    const double time = seconds([&] {
        at_vertices = body.closest(surface.vertices, any, pool);
        at_centroids = body.closest(surface.centroids, any, pool);
    });
    Mesh result = surface.mesh;
    const double paint_time = seconds([&] { result = painted(mesh, surface.mesh, at_vertices, at_centroids, pool); });
    std::printf("painted       %zu closest points in %s, data carried over in %s\n", surface.vertices.size() + surface.centroids.size(),
                in_words(time).c_str(), in_words(paint_time).c_str());

    check_positions(mesh, at_vertices, cell_diagonal, pool);
    if (own) {
        check_own_data(mesh, result, at_vertices, at_centroids);
    }
    compare_areas(mesh, surface, at_centroids.tag);
    const std::string stem = in_demo_out(own ? "paint" : "paint-" + std::filesystem::path(argv[1]).stem().string());
    write_and_read(stem + ".vtk", result);
    const std::string picture = stem + ".png";
    const double picture_time = seconds([&] { draw(picture, result, field_name, pool); });
    if (shown.name().empty()) {
        std::printf("              %s: tags alone, the mesh has no data, in %s\n", picture.c_str(), in_words(picture_time).c_str());
    } else {
        std::printf("              %s: %s from %.4g to %.4g, and tags, in %s\n", picture.c_str(), shown.name().c_str(), shown.least(),
                    shown.most(), in_words(picture_time).c_str());
    }
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        std::fprintf(stderr, "usage: paint [mesh [field]]\n");
        return 2;
    }
    return run_example("paint", paint, argc, argv);
}
