// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// What geometries are made of: shapes, meshes, functions of the caller's, and what is made from
/// other geometries. A composite keeps its parts alive. Each throws Error naming the argument that
/// is not finite, not positive or empty where it must be.
#ifndef EMBOUND_SHAPES_HPP
#define EMBOUND_SHAPES_HPP

#include "geometry.hpp"
#include "mesh.hpp"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace embound {

/// What to do about the boundary loops of an open mesh.
enum class Open : std::int32_t {
    Error = EMB_OPEN_ERROR, ///< EMB_ERROR_TOPOLOGY.
    Cap = EMB_OPEN_CAP,     ///< Loops are capped. Not in this version.
    Sweep = EMB_OPEN_SWEEP  ///< Loops are swept beyond a box, for bodies that leave the domain. Not in this version.
};

/// How the nearest triangle is found.
enum class Accelerator : std::int32_t {
    Auto = EMB_ACCELERATOR_AUTO,      ///< A bounding volume hierarchy.
    None = EMB_ACCELERATOR_NONE,      ///< Every triangle is looked at: slow, the same bits.
    Compact = EMB_ACCELERATOR_COMPACT ///< A hierarchy of small memory. Not in this version.
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

/// What the caller knows of a function. The caller vouches for all of it.
struct FunctionOptions {
    Point lo{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()}; ///< Of a box around the body.
    Point hi{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()}; ///< Of a box around the body.
    double lipschitz = 0.0;                            ///< |f(p) - f(q)| <= lipschitz |p - q|; 0: unknown.
    double gradient_step = 0.0;                        ///< Of centred differences; 0: chosen from the bounds.
    Kind kind = Kind::SignOnly;                        ///< What its magnitude means.
    bool thread_safe = false;                          ///< Whether several threads may call it at once.

    /// As the C functions take them.
    emb_callback_options c() const {
        emb_callback_options options;
        check(emb_callback_options_init(&options, sizeof options));
        std::copy(lo.begin(), lo.end(), options.lo);
        std::copy(hi.begin(), hi.end(), options.hi);
        options.lipschitz = lipschitz;
        options.gradient_step = gradient_step;
        options.kind = static_cast<std::int32_t>(kind);
        options.thread_safe = thread_safe ? 1 : 0;
        return options;
    }
};

namespace detail {

/// A geometry made by `create(emb_geom **)`.
template <class Create> Geometry made(Create &&create) {
    return Geometry(created<emb_geom>(std::forward<Create>(create)));
}

/// The handles of several geometries.
inline std::vector<const emb_geom *> handles(Span<const Geometry> parts) {
    std::vector<const emb_geom *> all = vector_of<const emb_geom *>(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        all[i] = parts[i].get();
    }
    return all;
}

/// The function that the library calls; an exception is kept for the C++ call it serves, and NaN
/// says that the function failed.
template <class Function> double function_value(void *user, double x, double y, double z) {
    try {
        return static_cast<double>((*static_cast<Function *>(user))(x, y, z));
    } catch (...) {
        Frame::keep_exception();
        return std::numeric_limits<double>::quiet_NaN();
    }
}

/// The library's last use of a function.
template <class Function> void function_drop(void *user) { delete static_cast<Function *>(user); }

} // namespace detail

/// The signed distance to a mesh. The work may be shared and told of through `run`. An open or
/// inconsistent mesh without a sign is EMB_ERROR_TOPOLOGY.
inline Geometry from_mesh(const Mesh &mesh, const SdfOptions &options = {}, const Run &run = {}) {
    const emb_sdf_options c = options.c();
    emb_geom *geometry = nullptr;
    detail::call(run, [&](const emb_run *r) { return emb_geom_from_mesh(mesh.get(), &c, r, &geometry); });
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

/// All of the parts together; of none: nothing.
inline Geometry unite(Span<const Geometry> parts) {
    const auto all = detail::handles(parts);
    return detail::made([&](emb_geom **out) { return emb_geom_union(all.size(), all.data(), out); });
}
/// All of the parts together.
template <class... More> Geometry unite(const Geometry &first, const Geometry &second, const More &...more) {
    const Geometry parts[] = {first, second, more...};
    return unite(Span<const Geometry>(parts));
}

/// What is in every part; of none: all of space.
inline Geometry intersection(Span<const Geometry> parts) {
    const auto all = detail::handles(parts);
    return detail::made([&](emb_geom **out) { return emb_geom_intersection(all.size(), all.data(), out); });
}
/// What is in every part.
template <class... More> Geometry intersection(const Geometry &first, const Geometry &second, const More &...more) {
    const Geometry parts[] = {first, second, more...};
    return intersection(Span<const Geometry>(parts));
}

/// `from` without `remove`.
inline Geometry difference(const Geometry &from, const Geometry &remove) {
    return detail::made([&](emb_geom **out) { return emb_geom_difference(from.get(), remove.get(), out); });
}

/// Inside out.
inline Geometry complement(const Geometry &g) {
    return detail::made([&](emb_geom **out) { return emb_geom_complement(g.get(), out); });
}

/// Moved by `shift`; O(1), shares g.
inline Geometry translate(const Geometry &g, const Point &shift) {
    return detail::made([&](emb_geom **out) { return emb_geom_translate(g.get(), shift.data(), out); });
}

/// Rotated about the origin, then moved by `shift`; O(1), shares g.
inline Geometry place(const Geometry &g, const Matrix &rotation, const Point &shift = {0.0, 0.0, 0.0}) {
    return detail::made([&](emb_geom **out) { return emb_geom_place(g.get(), rotation.data(), shift.data(), out); });
}

/// Labels a body, for the `part` of closest points and crossings; the innermost label wins.
inline Geometry part(const Geometry &g, std::int32_t label) {
    return detail::made([&](emb_geom **out) { return emb_geom_part(g.get(), label, out); });
}

/// Any callable `double(double x, double y, double z)`: negative inside, NaN where it fails. The
/// geometry keeps a copy, which dies with the last geometry that uses it, on whatever thread that is.
/// One not marked thread-safe is only called on the threads that ask. What it throws reaches the
/// C++ caller as it was thrown; a C caller gets NaN, or EMB_ERROR_CALLBACK from a batch.
template <class Function> Geometry function(Function f, const FunctionOptions &options = {}) {
    const emb_callback_options c = options.c();
    auto kept = std::make_unique<Function>(std::move(f));
    emb_geom *geometry = detail::created<emb_geom>([&](emb_geom **out) {
        return emb_geom_callback(detail::function_value<Function>, kept.get(), detail::function_drop<Function>, &c, out);
    });
    static_cast<void>(kept.release());
    return Geometry(geometry);
}

} // namespace embound

#endif
