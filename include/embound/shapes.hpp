// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// What geometries begin with: meshes, bodies in closed form, samples, expressions. Lengths are in the
/// caller's unit, directions need not have length 1. Each throws Error naming the argument that is not
/// finite, not positive or empty where it must be.
#ifndef EMBOUND_SHAPES_HPP
#define EMBOUND_SHAPES_HPP

#include "geometry.hpp"
#include "mesh.hpp"

#include <array>
#include <limits>
#include <string>

namespace embound {

/// What to do about the boundary loops of an open mesh.
enum class Open : std::int32_t {
    Error = EMB_OPEN_ERROR, ///< EMB_ERROR_TOPOLOGY.
    Cap = EMB_OPEN_CAP,     ///< Loops are capped.
    Sweep = EMB_OPEN_SWEEP  ///< Loops are swept beyond a box, for bodies that leave the domain.
};

/// How the nearest triangle is found.
enum class Accelerator : std::int32_t {
    Auto = EMB_ACCELERATOR_AUTO,      ///< A bounding volume hierarchy.
    None = EMB_ACCELERATOR_NONE,      ///< Every triangle is looked at: slow, the same bits.
    Compact = EMB_ACCELERATOR_COMPACT ///< A hierarchy of half the memory: slower, the same bits.
};

/// How a mesh becomes a geometry.
struct SdfOptions {
    Sign sign = Sign::Auto;                      ///< Sign method.
    Open open = Open::Error;                     ///< Boundary loops.
    std::int32_t axis = 0;                       ///< Of Sign::Axis: 0, 1, 2.
    Accelerator accelerator = Accelerator::Auto; ///< Acceleration.
    Point open_lo{0.0, 0.0, 0.0};                ///< Box of Open::Sweep, lower corner.
    Point open_hi{0.0, 0.0, 0.0};                ///< Box of Open::Sweep, upper corner.

    /// As the C functions take them.
    emb_sdf_options c() const {
        emb_sdf_options options;
        check(emb_sdf_options_init(&options, sizeof options));
        options.sign = static_cast<std::int32_t>(sign);
        options.open = static_cast<std::int32_t>(open);
        options.axis = axis;
        options.accelerator = static_cast<std::int32_t>(accelerator);
        std::copy(open_lo.begin(), open_lo.end(), options.open_lo);
        std::copy(open_hi.begin(), open_hi.end(), options.open_hi);
        return options;
    }
};

/// What the caller knows of an expression.
struct ExpressionOptions {
    Point lo{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()}; ///< Of a box that the body is cut off at.
    Point hi{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()}; ///< Of that box.
    double lipschitz = 0.0; ///< |f(p) - f(q)| <= lipschitz |p - q| in the box; 0: looked for where it is finite.

    /// As the C functions take them.
    emb_expression_options c() const {
        emb_expression_options options;
        check(emb_expression_options_init(&options, sizeof options));
        std::copy(lo.begin(), lo.end(), options.lo);
        std::copy(hi.begin(), hi.end(), options.hi);
        options.lipschitz = lipschitz;
        return options;
    }
};

/// The signed distance to a mesh. The work may be shared and told of through `run`. An open or
/// inconsistent mesh without a sign is EMB_ERROR_TOPOLOGY.
inline Geometry from_mesh(const Mesh &mesh, const SdfOptions &options = {}, const Run &run = {}) {
    const emb_sdf_options c = options.c();
    emb_geom *geometry = nullptr;
    detail::call(run, [&](const emb_run *r) { return emb_geom_from_mesh(mesh.get(), &c, r, &geometry); });
    return Geometry(geometry);
}

/// What is looked at when the vertices of a mesh have moved.
enum class RefitCheck : std::int32_t {
    Check = EMB_REFIT_CHECK, ///< Where the surface meets itself now.
    Trust = EMB_REFIT_TRUST  ///< Nothing: the caller knows that it meets itself nowhere but where it did.
};

/// The signed distance to the same faces over vertices that have moved: three coordinates for each vertex of the mesh that
/// g was made from, in its order. g stays as it is. O(n); for rigid motions place() is O(1). Errors as of emb_geom_refit.
inline Geometry refit(const Geometry &g, Span<const double> xyz, RefitCheck what = RefitCheck::Check, const Run &run = {}) {
    if (xyz.size() % 3 != 0) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT, "xyz: " + std::to_string(xyz.size()) + " coordinates are not three for each vertex");
    }
    emb_geom *geometry = nullptr;
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_refit(g.get(), xyz.size() / 3, xyz.data(), static_cast<std::int32_t>(what), r, &geometry);
    });
    return Geometry(geometry);
}

/// A ball; radius > 0.
inline Geometry sphere(const Point &center, double radius) {
    return detail::made([&](emb_geom **out) { return emb_geom_sphere(center.data(), radius, out); });
}

/// A box with sides along the axes; exact inside too.
inline Geometry box(const Point &lo, const Point &hi) {
    return detail::made([&](emb_geom **out) { return emb_geom_box(lo.data(), hi.data(), out); });
}

/// The half space behind a plane; `normal` points out of it.
inline Geometry plane(const Point &point, const Point &normal) {
    return detail::made([&](emb_geom **out) { return emb_geom_plane(point.data(), normal.data(), out); });
}

/// A torus around `axis`; 0 < minor < major.
inline Geometry torus(const Point &center, const Point &axis, double major, double minor) {
    return detail::made([&](emb_geom **out) { return emb_geom_torus(center.data(), axis.data(), major, minor, out); });
}

/// A cylinder with flat ends at `a` and `b`.
inline Geometry cylinder(const Point &a, const Point &b, double radius) {
    return detail::made([&](emb_geom **out) { return emb_geom_cylinder(a.data(), b.data(), radius, out); });
}

/// A cylinder without ends.
inline Geometry infinite_cylinder(const Point &point, const Point &axis, double radius) {
    return detail::made([&](emb_geom **out) { return emb_geom_infinite_cylinder(point.data(), axis.data(), radius, out); });
}

/// The points within `radius` of the segment from `a` to `b`.
inline Geometry capsule(const Point &a, const Point &b, double radius) {
    return detail::made([&](emb_geom **out) { return emb_geom_capsule(a.data(), b.data(), radius, out); });
}

/// A capsule by its outermost points.
inline Geometry capsule_tips(const Point &tip_a, const Point &tip_b, double radius) {
    return detail::made([&](emb_geom **out) { return emb_geom_capsule_tips(tip_a.data(), tip_b.data(), radius, out); });
}

/// A cone without end, open along `axis`; `angle` is the full one, in degrees, below 180.
inline Geometry infinite_cone(const Point &tip, const Point &axis, double angle) {
    return detail::made([&](emb_geom **out) { return emb_geom_infinite_cone(tip.data(), axis.data(), angle, out); });
}

/// A cone with a flat base `height` from its tip; `angle` is the full one, in degrees, below 180.
inline Geometry cone(const Point &tip, const Point &axis, double height, double angle) {
    return detail::made([&](emb_geom **out) { return emb_geom_cone(tip.data(), axis.data(), height, angle, out); });
}

/// A box of outer half sizes `half`, its edges rounded by `radius` (0: sharp), turned around its centre.
inline Geometry rounded_box(const Point &center, const Point &half, double radius, const Matrix &rotation = identity) {
    return detail::made(
        [&](emb_geom **out) { return emb_geom_rounded_box(center.data(), half.data(), radius, rotation.data(), out); });
}

/// A cylinder of outer `radius` and `height`, its edges rounded by `rounding`.
inline Geometry rounded_cylinder(const Point &center, const Point &axis, double radius, double height, double rounding) {
    return detail::made([&](emb_geom **out) {
        return emb_geom_rounded_cylinder(center.data(), axis.data(), radius, height, rounding, out);
    });
}

/// An ellipsoid, turned around its centre.
inline Geometry ellipsoid(const Point &center, const Point &semi_axes, const Matrix &rotation = identity) {
    return detail::made(
        [&](emb_geom **out) { return emb_geom_ellipsoid(center.data(), semi_axes.data(), rotation.data(), out); });
}

/// A regular prism with flat ends at `a` and `b`; `toward` points from its axis to the first corner.
inline Geometry prism(const Point &a, const Point &b, const Point &toward, std::int32_t sides, double radius) {
    return detail::made(
        [&](emb_geom **out) { return emb_geom_prism(a.data(), b.data(), toward.data(), sides, radius, out); });
}

/// A closed polygon of corners (u, v) drawn from z_lo to z_hi; (u, v, z) comes to rotation * (u, v, z) + origin.
inline Geometry extruded_polygon(const Point &origin, Span<const std::array<double, 2>> points, double z_lo, double z_hi,
                                 const Matrix &rotation = identity) {
    return detail::made([&](emb_geom **out) {
        return emb_geom_extruded_polygon(origin.data(), rotation.data(), points.size(), detail::flat(points), z_lo, z_hi,
                                         out);
    });
}

/// A closed polygon of corners (distance from the axis, place along it from `origin`), turned around the axis.
inline Geometry revolved_polygon(const Point &origin, const Point &axis, Span<const std::array<double, 2>> points) {
    return detail::made([&](emb_geom **out) {
        return emb_geom_revolved_polygon(origin.data(), axis.data(), points.size(), detail::flat(points), out);
    });
}

/// Perlin noise: amplitude times the sum over k < octaves of persistence^k noise(frequency 2^k p).
inline Geometry perlin(double amplitude, const Point &frequency, double persistence, std::int32_t octaves,
                       std::uint64_t seed) {
    return detail::made(
        [&](emb_geom **out) { return emb_geom_perlin(amplitude, frequency.data(), persistence, octaves, seed, out); });
}

/// Terrain: solid below the heights over a lattice of two axes; bilinear, the edge's heights go on beyond.
inline Geometry height_field(const Lattice &lattice, const ConstArray &heights) {
    const emb_array array = heights.c("heights", lattice.points());
    const emb_lattice l = lattice.c();
    return detail::made([&](emb_geom **out) { return emb_geom_height_field(&l, &array, out); });
}

/// A function sampled on a lattice, negative inside; trilinear, constant beyond.
inline Geometry grid(const Lattice &lattice, const ConstArray &values) {
    const emb_array array = values.c("values", lattice.points());
    const emb_lattice l = lattice.c();
    return detail::made([&](emb_geom **out) { return emb_geom_grid(&l, &array, out); });
}

/// The body where an expression of x, y and z is negative, such as "sqrt(x^2 + y^2) - 1".
inline Geometry expression(const std::string &text, const ExpressionOptions &options = {}) {
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT, "expression: byte " + std::to_string(zero) + " is zero");
    }
    const emb_expression_options c = options.c();
    return detail::made([&](emb_geom **out) { return emb_geom_expression(text.c_str(), &c, out); });
}

/// Labels a body, for the `part` of closest points and crossings; the innermost label wins.
inline Geometry part(const Geometry &g, std::int32_t label) {
    return detail::made([&](emb_geom **out) { return emb_geom_part(g.get(), label, out); });
}

} // namespace embound

#endif
