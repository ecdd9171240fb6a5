// SPDX-License-Identifier: MIT OR Apache-2.0
// Rays through the pixels are marched to where they enter the body; intercepts() then gives the point, the
// normal and the part. Light comes from the upper left, casts shadows, and is weaker where the surface's own
// neighbourhood is in the way, which the values near it tell.
#include "render.hpp"

#include "march.hpp"
#include "vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using embound::Point;

namespace {

constexpr std::size_t rays_per_side = 2; // of a pixel

struct Camera {
    Point right, up, toward;

    explicit Camera(const View &view) : right{}, up{}, toward(unit(view.toward)) {
        const Point vertical = std::abs(toward[2]) < 0.999 ? Point{0.0, 0.0, 1.0} : Point{0.0, 1.0, 0.0};
        right = unit(cross(vertical, toward));
        up = cross(toward, right);
    }
    Point light() const { return unit(along(along(along({}, 1.0, toward), -0.5, right), 0.6, up)); }
};

std::vector<Point> ray_starts(const View &view, const Camera &camera, std::size_t width, std::size_t height) {
    const double pitch = 2.0 * view.half_width / static_cast<double>(width);
    std::vector<Point> starts;
    starts.reserve(width * height);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const double x = (static_cast<double>(column) + 0.5 - 0.5 * static_cast<double>(width)) * pitch;
            const double y = (0.5 * static_cast<double>(height) - 0.5 - static_cast<double>(row)) * pitch;
            starts.push_back(along(along(along(view.target, view.half_depth, camera.toward), x, camera.right), y, camera.up));
        }
    }
    return starts;
}

// What the rays meet, one element for each that meets something.
struct Surface {
    std::vector<std::size_t> ray;
    std::vector<Point> point, normal;
    std::vector<std::int32_t> part;
    std::vector<double> open, lit; // to the surroundings, to the light; 0 to 1
};

Surface first_surface(const embound::Geometry &g, const Marcher &marcher, const std::vector<Point> &starts,
                      const Point &direction, double reach, const embound::Run &run) {
    const std::vector<Entry> entries = marcher.march(starts, direction, reach);
    std::vector<Point> a, b;
    for (const Entry &entry : entries) {
        a.push_back(along(starts[entry.ray], entry.from, direction));
        b.push_back(along(starts[entry.ray], entry.to, direction));
    }
    const embound::Intercepts hits = g.intercepts(a, b, run);
    Surface surface;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (std::isfinite(hits.t[i]) && std::isfinite(hits.normal[i][0])) {
            surface.ray.push_back(entries[i].ray);
            surface.point.push_back(along(a[i], hits.t[i] * (entries[i].to - entries[i].from), direction));
            surface.normal.push_back(hits.normal[i]);
            surface.part.push_back(hits.part[i]);
        }
    }
    surface.open.assign(surface.ray.size(), 1.0);
    surface.lit.assign(surface.ray.size(), 1.0);
    return surface;
}

// Above a flat surface the value at a height is the height. Where it is less, something is near.
void find_open(Surface &surface, const embound::Geometry &g, double height, const embound::Run &run) {
    if (g.properties().kind == embound::Kind::SignOnly) {
        return;
    }
    std::fill(surface.open.begin(), surface.open.end(), 0.0);
    std::vector<Point> above(surface.point.size());
    for (const double h : {0.3 * height, height}) {
        for (std::size_t i = 0; i < above.size(); ++i) {
            above[i] = along(surface.point[i], h, surface.normal[i]);
        }
        const std::vector<double> values = g.values(above, run);
        for (std::size_t i = 0; i < above.size(); ++i) {
            surface.open[i] += 0.5 * std::clamp(values[i] / h, 0.0, 1.0);
        }
    }
}

// Light that starts a little above the surface and meets the body again does not reach it.
void find_lit(Surface &surface, const Marcher &marcher, const Point &light, double reach, double above) {
    std::vector<Point> starts;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < surface.point.size(); ++i) {
        if (dot(surface.normal[i], light) > 0.0) {
            starts.push_back(along(surface.point[i], above, surface.normal[i]));
            of.push_back(i);
        }
    }
    for (const Entry &entry : marcher.march(starts, light, reach)) {
        surface.lit[of[entry.ray]] = 0.0;
    }
}

// The surface's own colours.
std::vector<Colour> own_colours(const Surface &surface, const Look &look) {
    if (look.paint) {
        return look.paint(surface.point);
    }
    std::vector<Colour> colours;
    colours.reserve(surface.part.size());
    for (const std::int32_t part : surface.part) {
        colours.push_back(look.colours[std::min(static_cast<std::size_t>(part + 1), look.colours.size() - 1)]);
    }
    return colours;
}

Image shrunk(const Image &image) {
    constexpr std::size_t n = rays_per_side;
    Image small(image.width / n, image.height / n, {});
    for (std::size_t row = 0; row < image.height; ++row) {
        for (std::size_t column = 0; column < image.width; ++column) {
            Colour &sum = small.at(row / n, column / n);
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += image.at(row, column)[c] / static_cast<double>(n * n);
            }
        }
    }
    return small;
}

} // namespace

Image render(const embound::Geometry &g, const View &view, const Look &look, std::size_t width, std::size_t height,
             const embound::Run &run) {
    const Camera camera(view);
    Image image(rays_per_side * width, rays_per_side * height, look.background);
    const double pitch = 2.0 * view.half_width / static_cast<double>(image.width); // from ray to ray
    const double least_step = g.properties().kind == embound::Kind::SignOnly ? 3.0 * pitch : pitch;
    const Point ahead = along({}, -1.0, camera.toward), light = camera.light();

    const Marcher marcher(g, least_step, run);
    Surface surface =
        first_surface(g, marcher, ray_starts(view, camera, image.width, image.height), ahead, 2.0 * view.half_depth, run);
    find_open(surface, g, 0.12 * view.half_width, run);
    if (look.shadows) {
        find_lit(surface, marcher, light, 2.0 * view.half_depth, 2.0 * least_step);
    }
    const std::vector<Colour> colours = own_colours(surface, look);
    for (std::size_t i = 0; i < surface.ray.size(); ++i) {
        const double toward_light = std::max(0.0, dot(surface.normal[i], light)) * surface.lit[i];
        const double sky = 0.5 + 0.5 * dot(surface.normal[i], camera.up),
                     eye = std::max(0.0, dot(surface.normal[i], camera.toward));
        const double bright = (0.40 + 0.16 * sky + 0.12 * eye) * (0.45 + 0.55 * surface.open[i]) + 0.52 * toward_light;
        const Colour &own = colours[i];
        image.pixels[surface.ray[i]] =
            bright <= 1.0 ? mix({0.02, 0.02, 0.05}, own, bright) : mix(own, {1.0, 1.0, 1.0}, bright - 1.0);
    }
    return shrunk(image);
}
