// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Geometries moved, turned, grown and bent; each shares what it is made from. Each throws Error naming
/// the argument that is not finite or not positive where it must be.
#ifndef EMBOUND_TRANSFORMS_HPP
#define EMBOUND_TRANSFORMS_HPP

#include "geometry.hpp"

namespace embound {

/// Moved by `shift`; O(1), shares g.
inline Geometry translate(const Geometry &g, const Point &shift) {
    return detail::made([&](emb_geom **out) { return emb_geom_translate(g.get(), shift.data(), out); });
}

/// Rotated about the origin, then moved by `shift`; O(1), shares g.
inline Geometry place(const Geometry &g, const Matrix &rotation, const Point &shift = {0.0, 0.0, 0.0}) {
    return detail::made([&](emb_geom **out) { return emb_geom_place(g.get(), rotation.data(), shift.data(), out); });
}

/// Turned by `degrees`, right-handed, about the axis through `point`; O(1), shares g.
inline Geometry rotate(const Geometry &g, const Point &axis, double degrees, const Point &point = {0.0, 0.0, 0.0}) {
    return detail::made([&](emb_geom **out) { return emb_geom_rotate(g.get(), axis.data(), degrees, point.data(), out); });
}

/// Scaled about the origin by `factor` > 0; stays exact. O(1), shares g.
inline Geometry scale(const Geometry &g, double factor) {
    return detail::made([&](emb_geom **out) { return emb_geom_scale(g.get(), factor, out); });
}

/// Reflected in a plane of coordinates: 0 yz, 1 xz, 2 xy. O(1), shares g.
inline Geometry reflect(const Geometry &g, std::int32_t plane) {
    return detail::made([&](emb_geom **out) { return emb_geom_reflect(g.get(), plane, out); });
}

/// Reflected in the plane through `point` across `normal`. O(1), shares g.
inline Geometry reflect_in(const Geometry &g, const Point &point, const Point &normal) {
    return detail::made([&](emb_geom **out) { return emb_geom_reflect_in(g.get(), point.data(), normal.data(), out); });
}

/// Under a linear map: q comes to matrix * q + shift; a lower bound of the distance. O(1), shares g.
inline Geometry affine(const Geometry &g, const Matrix &matrix, const Point &shift = {0.0, 0.0, 0.0}) {
    return detail::made([&](emb_geom **out) { return emb_geom_affine(g.get(), matrix.data(), shift.data(), out); });
}

/// Grown by `distance`, or shrunk where it is negative.
inline Geometry offset(const Geometry &g, double distance) {
    return detail::made([&](emb_geom **out) { return emb_geom_offset(g.get(), distance, out); });
}

/// The shell of points within `half_thickness` of the surface.
inline Geometry annular(const Geometry &g, double half_thickness) {
    return detail::made([&](emb_geom **out) { return emb_geom_annular(g.get(), half_thickness, out); });
}

/// Divided by its Lipschitz constant; EMB_ERROR_UNSUPPORTED where none is known.
inline Geometry lower_bound(const Geometry &g) {
    return detail::made([&](emb_geom **out) { return emb_geom_lower_bound(g.get(), out); });
}

/// Blurred: a mean of 27 values, `h` apart; alpha in [0, 1] is the weight that stays.
inline Geometry blur(const Geometry &g, double h, double alpha) {
    return detail::made([&](emb_geom **out) { return emb_geom_blur(g.get(), h, alpha, out); });
}

/// Mollified: the mean of samples^3 values within +-d, with binomial weights.
inline Geometry mollify(const Geometry &g, double d, std::int32_t samples) {
    return detail::made([&](emb_geom **out) { return emb_geom_mollify(g.get(), d, samples, out); });
}

/// Cut at the coordinate planes and pulled apart by +-extent.
inline Geometry elongate(const Geometry &g, const Point &extent) {
    return detail::made([&](emb_geom **out) { return emb_geom_elongate(g.get(), extent.data(), out); });
}

/// Twisted about the z axis by `degrees` a unit of height; a lower bound of the distance for bodies within bounds.
inline Geometry twist(const Geometry &g, double degrees) {
    return detail::made([&](emb_geom **out) { return emb_geom_twist(g.get(), degrees, out); });
}

/// The section by a plane, as a body of x and y, the same at every z.
inline Geometry slice(const Geometry &g, const Point &origin, const Point &u_axis, const Point &v_axis) {
    return detail::made(
        [&](emb_geom **out) { return emb_geom_slice(g.get(), origin.data(), u_axis.data(), v_axis.data(), out); });
}

} // namespace embound

#endif
