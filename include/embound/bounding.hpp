// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Boxes and balls around bodies that do not know their own, and bodies cut down to a box.
#ifndef EMBOUND_BOUNDING_HPP
#define EMBOUND_BOUNDING_HPP

#include "geometry.hpp"

#include <cstdint>

namespace embound {

/// What a search for bounds found.
enum class Bounding : std::int32_t {
    Found = EMB_BOUNDING_FOUND,                ///< The body lies within.
    ReachesStart = EMB_BOUNDING_REACHES_START, ///< The body may reach the border of the start box; infinite.
    Nothing = EMB_BOUNDING_NOTHING             ///< No part of the body lies in the start box; infinite.
};

/// A box, and whether the body lies in it.
struct BoundingBox {
    Box box;        ///< Infinite where state is not Found.
    Bounding state; ///< What was found.
};

/// A ball, and whether the body lies in it.
struct BoundingSphere {
    Point center;   ///< Zero where state is not Found.
    double radius;  ///< Infinite where state is not Found.
    Bounding state; ///< What was found.
};

/// A box around a body, by halving `start` `depth` times (1 to 16) along each axis; `safety` in widths of
/// the finest cells. Where Geometry::bounds() is finite it is the better answer.
inline BoundingBox bounding_box(const Geometry &g, const Box &start, std::int32_t depth, double safety = 0.0,
                                const Run &run = {}) {
    Box box{};
    std::int32_t state = 0;
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_bounding_box(g.get(), start.lo.data(), start.hi.data(), depth, safety, r, box.lo.data(),
                                     box.hi.data(), &state);
    });
    return BoundingBox{box, static_cast<Bounding>(state)};
}

/// A ball around a body, about the middle of its bounding_box().
inline BoundingSphere bounding_sphere(const Geometry &g, const Box &start, std::int32_t depth, double safety = 0.0,
                                      const Run &run = {}) {
    Point center{};
    double radius = 0.0;
    std::int32_t state = 0;
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_bounding_sphere(g.get(), start.lo.data(), start.hi.data(), depth, safety, r, center.data(),
                                        &radius, &state);
    });
    return BoundingSphere{center, radius, static_cast<Bounding>(state)};
}

/// The body with no more parts than matter within a finite box: there the values have the same bits, elsewhere
/// they mean nothing.
inline Geometry simplify(const Geometry &g, const Box &box) {
    return detail::made([&](emb_geom **out) { return emb_geom_simplify(g.get(), box.lo.data(), box.hi.data(), out); });
}

} // namespace embound

#endif
