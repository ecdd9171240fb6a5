// SPDX-License-Identifier: MIT OR Apache-2.0
// Everything that bodies can be made of, checked and drawn: shapes
#include "check.hpp"
#include "tile.hpp"

#include "progress.hpp"
#include "render.hpp"
#include "report.hpp"
#include "text.hpp"

#include <embound.hpp>

#include <cmath>
#include <cstdio>
#include <string>

namespace {

constexpr std::size_t columns = 6, tile_width = 200, tile_height = 156, caption_height = 26, margin = 10;
constexpr Colour paper{1.0, 1.0, 1.0}, ink{0.16, 0.17, 0.20};
constexpr Colour blue{0.26, 0.52, 0.78}, orange{0.93, 0.53, 0.24}, green{0.30, 0.62, 0.47}, pale{0.93, 0.90, 0.82};

// What is shown of a body: what lies in a cube, where it has no end, and what lies behind the front corner,
// where the inside is of interest. Both cuts carry a label, so that they can have a colour of their own.
embound::Geometry shown(const Tile &tile) {
    embound::Geometry body = tile.body;
    const embound::Box bounds = body.bounds();
    if (!std::isfinite(bounds.lo[0] + bounds.hi[0] + bounds.lo[1] + bounds.hi[1] + bounds.lo[2] + bounds.hi[2])) {
        body = embound::intersection(body, embound::part(embound::box({-0.76, -0.76, -0.76}, {0.76, 0.76, 0.76}), cut_face));
    }
    if (tile.opened) {
        body = embound::difference(body, embound::part(embound::box({0.0, -2.0, 0.0}, {2.0, 0.0, 2.0}), cut_face));
    }
    return body;
}

Image picture(const Tile &tile, const Colour &colour, const embound::Run &run) {
    const View view{{0.0, 0.0, 0.0}, {0.75, -1.6, 0.85}, 1.3, 2.5};
    Image image(tile_width, tile_height + caption_height, paper);
    image.paste(render(shown(tile), view, {{colour, blue, orange, pale}, paper}, tile_width, tile_height, run), 0, 0);
    std::size_t left = (tile_width - std::min(tile_width, text_width(tile.name, 2))) / 2;
    write_text(image, tile_height + 4, left, tile.name, 2, ink);
    return image;
}

std::string volume_in_words(double volume) {
    char text[32];
    std::snprintf(text, sizeof text, std::isnan(volume) ? "-" : "%.4f", volume);
    return text;
}

void shapes(int, char **) {
    const embound::Pool pool;
    print_library(pool);
    struct Group {
        std::vector<Tile> tiles;
        Colour colour;
    };
    const std::vector<Group> groups{{solids(), blue}, {transforms(), green}, {sets(), orange}};
    std::size_t count = 0;
    for (const Group &group : groups) {
        count += group.tiles.size();
    }
    const std::size_t rows = (count + columns - 1) / columns, step = tile_height + caption_height + margin;
    Image sheet(columns * (tile_width + margin) + margin, rows * step + margin, paper);

    std::printf("%-20s %-12s %8s %8s %8s %10s\n", "", "values", "slope", "volume", "exact", "cut boxes");
    double checking = 0.0, drawing = 0.0;
    std::size_t i = 0;
    for (const Group &group : groups) {
        for (const Tile &tile : group.tiles) {
            Measured measured{};
            checking += seconds([&] { measured = check(tile, pool); });
            const embound::Properties properties = tile.body.properties();
            std::printf("%-20s %-12s %8.3g %8.4f %8s %10zu\n", tile.name.c_str(), in_words(properties.kind), properties.lipschitz,
                        measured.volume, volume_in_words(tile.volume).c_str(), measured.cut_boxes);
            drawing += seconds([&] {
                sheet.paste(picture(tile, group.colour, pool), margin + i / columns * step,
                            margin + i % columns * (tile_width + margin));
            });
            ++i;
        }
    }
    const std::string path = in_demo_out("shapes.png");
    write_png(path, sheet);
    std::printf("%zu bodies checked in %s and drawn in %s: %s, %zu x %zu pixels\n", count, in_words(checking).c_str(),
                in_words(drawing).c_str(), path.c_str(), sheet.width, sheet.height);
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 1) {
        std::fprintf(stderr, "usage: shapes\n");
        return 2;
    }
    return run_example("shapes", shapes, argc, argv);
}
