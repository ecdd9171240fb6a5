// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Where rays meet the faces of meshes, and which faces are in a place.
#ifndef EMBOUND_RAYS_HPP
#define EMBOUND_RAYS_HPP

#include "geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace embound {

/// Rays: the points origin[i] + t * direction[i] with t_min <= t <= t_max, which are one number for all of them.
struct Rays {
    Span<const Point> origin;                               ///< Where t is 0.
    Span<const Point> direction;                            ///< Of any length but zero.
    double t_min = 0.0;                                     ///< The least t; -infinity: lines.
    double t_max = std::numeric_limits<double>::infinity(); ///< The greatest; 1 for a segment whose direction reaches from end to end.
};

/// Where first_hits() writes; what is empty is not wanted, the rest has one element for each ray.
struct RayHitsOut {
    Span<double> t;               ///< NaN where nothing is met.
    Span<std::int32_t> side;      ///< -1: the ray comes in, +1: it goes out, 0: nothing is met.
    Span<Point> normal;           ///< Of the face, outward.
    Span<std::int64_t> primitive; ///< Index of the input face.
    Span<std::int32_t> part;      ///< The body's label, -1: none.
    Span<std::int32_t> tag;       ///< The face's tag.
};

/// What first_hits() returns, one element for each ray, and all_hits(), one for each hit.
struct RayHits {
    std::vector<double> t;               ///< NaN where nothing is met.
    std::vector<std::int32_t> side;      ///< -1: the ray comes in, +1: it goes out, 0: nothing is met.
    std::vector<Point> normal;           ///< Of the face, outward.
    std::vector<std::int64_t> primitive; ///< Index of the input face.
    std::vector<std::int32_t> part;      ///< The body's label, -1: none.
    std::vector<std::int32_t> tag;       ///< The face's tag.
};

/// The hits of each ray: those of ray i are the elements offsets[i] to offsets[i + 1] - 1, by t, then by face.
struct AllRayHits {
    std::vector<std::size_t> offsets; ///< One more than rays.
    RayHits hits;                     ///< Of all rays.
};

namespace detail {

inline std::size_t count_of(const Rays &rays) {
    require_size("direction", rays.direction.size(), rays.origin.size());
    return rays.origin.size();
}

inline RayHits ray_hits_of(std::size_t n) {
    return RayHits{vector_of<double>(n),       vector_of<std::int32_t>(n), vector_of<Point>(n),
                   vector_of<std::int64_t>(n), vector_of<std::int32_t>(n), vector_of<std::int32_t>(n)};
}

inline RayHitsOut out_of(RayHits &hits) {
    return RayHitsOut{hits.t, hits.side, hits.normal, hits.primitive, hits.part, hits.tag};
}

inline emb_ray_out ray_out(const RayHitsOut &out, std::size_t n) {
    emb_ray_out c{};
    c.struct_size = sizeof c;
    c.t = wanted("out.t", out.t, n);
    c.side = wanted("out.side", out.side, n);
    double *const normal = flat(wanted("out.normal", out.normal, n));
    for (std::size_t k = 0; k < 3; ++k) {
        c.normal[k] = normal == nullptr ? nullptr : normal + k;
    }
    c.vector_stride = 3;
    c.primitive = wanted("out.primitive", out.primitive, n);
    c.part = wanted("out.part", out.part, n);
    c.tag = wanted("out.tag", out.tag, n);
    return c;
}

} // namespace detail

/// The first face that each ray meets; see emb_geom_rays for what g may be.
inline void first_hits(const Geometry &g, const Rays &rays, const RayHitsOut &out, const Run &run = {}) {
    const std::size_t n = detail::count_of(rays);
    const emb_ray_out c = detail::ray_out(out, n);
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_rays(g.get(), n, detail::flat(rays.origin.data()), detail::flat(rays.direction.data()), &rays.t_min,
                             &rays.t_max, 0, r, &c);
    });
}

/// The first face that each ray meets, with everything there.
inline RayHits first_hits(const Geometry &g, const Rays &rays, const Run &run = {}) {
    RayHits hits = detail::ray_hits_of(detail::count_of(rays));
    first_hits(g, rays, detail::out_of(hits), run);
    return hits;
}

/// Every face that each ray meets.
inline AllRayHits all_hits(const Geometry &g, const Rays &rays, const Run &run = {}) {
    const std::size_t n = detail::count_of(rays);
    const double *const origin = detail::flat(rays.origin.data());
    const double *const direction = detail::flat(rays.direction.data());
    AllRayHits all{detail::vector_of<std::size_t>(n + 1), {}};
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_ray_counts(g.get(), n, origin, direction, &rays.t_min, &rays.t_max, 0, r, all.offsets.data());
    });
    all.hits = detail::ray_hits_of(all.offsets[n]);
    const emb_ray_out c = detail::ray_out(detail::out_of(all.hits), all.offsets[n]);
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_ray_hits(g.get(), n, origin, direction, &rays.t_min, &rays.t_max, 0, all.offsets.data(), r, &c);
    });
    return all;
}

/// The input faces of a mesh that have a point in common with a closed box, ascending; see emb_geom_overlapping.
inline std::vector<std::int64_t> faces_overlapping(const Geometry &g, const Box &box) {
    std::size_t count = 0;
    check(emb_geom_overlapping(g.get(), box.lo.data(), box.hi.data(), 0, nullptr, &count));
    std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(count);
    check(emb_geom_overlapping(g.get(), box.lo.data(), box.hi.data(), count, faces.data(), &count));
    return faces;
}

/// The input faces of a mesh at most `radius` away from a point, ascending; see emb_geom_within.
inline std::vector<std::int64_t> faces_within(const Geometry &g, const Point &point, double radius) {
    std::size_t count = 0;
    check(emb_geom_within(g.get(), point.data(), radius, 0, nullptr, &count));
    std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(count);
    check(emb_geom_within(g.get(), point.data(), radius, count, faces.data(), &count));
    return faces;
}

} // namespace embound

#endif
