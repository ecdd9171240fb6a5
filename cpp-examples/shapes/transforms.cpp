// SPDX-License-Identifier: MIT OR Apache-2.0
// What can be done to a body. Most are shown on a letter, which tells left from right.
#include "tile.hpp"

#include "volumes.hpp"

#include <cmath>

using namespace embound;

std::vector<Tile> transforms() {
    const volume_of::Polygon outline{{-0.4, -0.6},  {-0.15, -0.6}, {-0.15, -0.1}, {0.2, -0.1}, {0.2, 0.12},
                                     {-0.15, 0.12}, {-0.15, 0.36}, {0.4, 0.36},   {0.4, 0.6},  {-0.4, 0.6}};
    const Matrix upright{1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0}; // v of the outline goes along z
    const Geometry letter = extruded_polygon({0.0, 0.0, 0.0}, outline, -0.2, 0.2, upright);
    const double volume = 0.4 * volume_of::area(outline);
    const double at_origin = letter(0.0, 0.0, 0.0);

    const Matrix quarter{0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}; // x becomes y
    const Matrix sheared{1.0, 0.0, 0.5, 0.0, 1.5, 0.0, 0.0, 0.0, 1.0};
    const Geometry ball = sphere({0.0, 0.0, 0.0}, 0.7);
    const Geometry column = box({-0.4, -0.4, -0.9}, {0.4, 0.4, 0.9});
    const Geometry ring = torus({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.5, 0.2);

    return {
        {"translate", translate(letter, {0.3, 0.5, 0.2}), Kind::Exact, volume, {{{0.3, 0.5, 0.2}, at_origin}}},
        {"place", place(letter, quarter, {0.0, 0.0, 0.2}), Kind::Exact, volume, {{{0.0, 0.0, 0.2}, at_origin}}},
        {"rotate", rotate(letter, {0.0, 1.0, 0.0}, 60.0), Kind::Exact, volume, {{{0.0, 0.0, 0.0}, at_origin}}},
        {"scale", scale(letter, 1.5), Kind::Exact, 1.5 * 1.5 * 1.5 * volume, {{{0.0, 0.0, 0.0}, 1.5 * at_origin}}},
        {"reflect", reflect(letter, 0), Kind::Exact, volume, {{{-0.3, 0.0, 0.0}, letter(0.3, 0.0, 0.0)}}},
        {"part",
         unite(part(translate(letter, {-0.45, 0.0, 0.0}), first_body), part(translate(letter, {0.5, 0.0, 0.0}), second_body)),
         Kind::Exact,
         2.0 * volume,
         {{{0.5, 0.0, 0.0}, at_origin}}},
        {"affine", affine(letter, sheared), Kind::LowerBound, 1.5 * volume, {}},
        {"elongate",
         elongate(sphere({0.0, 0.0, 0.0}, 0.4), {0.45, 0.3, 0.15}),
         Kind::LowerBound,
         volume_of::rounded_box(0.9, 0.6, 0.3, 0.4),
         {{{0.0, 0.0, 1.0}, 0.45}}},
        {"offset", offset(letter, 0.12), Kind::LowerBound, unknown, {{{0.0, 0.0, 0.0}, at_origin - 0.12}}},
        {"annular",
         annular(ball, 0.08),
         Kind::Exact,
         volume_of::ball(0.78) - volume_of::ball(0.62),
         {{{0.0, 0.0, 0.0}, 0.62}},
         true},
        {"complement", complement(ball), Kind::Exact, 8.0 - volume_of::ball(0.7), {{{0.0, 0.0, 0.0}, 0.7}}, true},
        {"blur", blur(scale(letter, 1.4), 0.12, 0.5), Kind::LowerBound, unknown, {}},
        {"mollify", mollify(scale(letter, 1.4), 0.12, 3), Kind::LowerBound, unknown, {}},
        {"twist", twist(column, 60.0), Kind::LowerBound, 0.8 * 0.8 * 1.8, {}},
        {"slice",
         slice(ring, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}),
         Kind::LowerBound,
         2.0 * 2.0 * volume_of::pi * 0.04,
         {{{0.5, 0.0, 0.0}, -0.2}}},
        {"lower_bound", lower_bound(perlin(0.5, {1.1, 1.1, 1.1}, 0.5, 1, 3)), Kind::LowerBound, unknown, {}},
        {"repeat",
         repeat(translate(scale(letter, 0.7), {-0.45, -0.45, -0.45}), {0.9, 0.9, 0.9}, {2, 2, 2}),
         Kind::Exact,
         8.0 * 0.7 * 0.7 * 0.7 * volume,
         {{{0.45, 0.45, -0.45}, 0.7 * at_origin}}},
    };
}
