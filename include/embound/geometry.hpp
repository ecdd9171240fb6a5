// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Geometries and the questions asked of them.
#ifndef EMBOUND_GEOMETRY_HPP
#define EMBOUND_GEOMETRY_HPP

#include "answers.hpp"
#include "run.hpp"
#include "views.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace embound {

/// A body as an implicit function: negative inside, positive outside, zero on the surface and
/// counted as inside. Immutable: any number of threads may ask one object at once. A copy is O(1)
/// and shares everything. An empty geometry (default constructed, moved from) answers NaN to
/// operator() and throws EMB_ERROR_NULL_ARGUMENT elsewhere.
///
/// Every question but classify() of one box throws Error where embound refuses, and whatever a
/// function of the caller's threw on the way. Several pooled calls on several threads whose
/// functions throw at the same moment may each rethrow the exception of another.
class Geometry {
public:
    /// Empty.
    Geometry() noexcept = default;
    /// Adopts a handle of the C functions: this object frees it.
    explicit Geometry(emb_geom *handle) noexcept : handle_(handle) {}
    /// Shares everything.
    Geometry(const Geometry &other) : handle_(emb_geom_clone(other.handle_)) {}
    /// Leaves `other` empty.
    Geometry(Geometry &&other) noexcept : handle_(other.release()) {}
    /// Shares everything, or leaves `other` empty.
    Geometry &operator=(Geometry other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Geometry() { emb_geom_free(handle_); }

    /// Lends the handle: valid as long as this object is. `emb_geom_value_fn` with this handle is
    /// the pair of function and user data that many solvers take.
    emb_geom *get() const noexcept { return handle_; }
    /// Gives the handle up to the caller, who frees it with emb_geom_free; leaves this empty.
    emb_geom *release() noexcept { return std::exchange(handle_, nullptr); }
    /// Whether there is a geometry.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The value at one point; NaN where a coordinate is not finite. Throws only what a function of
    /// the caller's threw.
    double operator()(double x, double y, double z) const {
        detail::Frame frame(false);
        const double value = emb_geom_value(handle_, x, y, z);
        frame.rethrow();
        return value;
    }

    /// The value at each point; the same bits as operator().
    void values(const Points &points, Span<double> out, const Run &run = {}) const {
        detail::require_size("out", out.size(), points.count());
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_values(handle_, points.count(), points.x(), points.y(), points.z(), points.stride(), r, out.data());
        });
    }
    /// The value at each point, in f32.
    void values(const PointsF32 &points, Span<float> out, const Run &run = {}) const {
        detail::require_size("out", out.size(), points.count());
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_values_f32(handle_, points.count(), points.x(), points.y(), points.z(), points.stride(), r, out.data());
        });
    }
    /// The value at each point.
    std::vector<double> values(const Points &points, const Run &run = {}) const {
        std::vector<double> out = detail::vector_of<double>(points.count());
        values(points, out, run);
        return out;
    }
    /// The value at each point, in f32.
    std::vector<float> values(const PointsF32 &points, const Run &run = {}) const {
        std::vector<float> out = detail::vector_of<float>(points.count());
        values(points, out, run);
        return out;
    }

    /// The nearest point of the surface, with what is there. Beyond `max_distance` the value is plus
    /// or minus max_distance, ids are -1 and vectors NaN.
    void closest(const Points &points, const ClosestOut &out, double max_distance = std::numeric_limits<double>::infinity(),
                 const Run &run = {}) const {
        const std::size_t n = points.count();
        emb_closest_out c{};
        c.struct_size = sizeof c;
        c.value = detail::wanted("out.value", out.value, n);
        lend(detail::wanted("out.point", out.point, n), c.point);
        lend(detail::wanted("out.gradient", out.gradient, n), c.gradient);
        lend(detail::wanted("out.barycentric", out.barycentric, n), c.barycentric);
        c.vector_stride = 3;
        c.primitive = detail::wanted("out.primitive", out.primitive, n);
        c.part = detail::wanted("out.part", out.part, n);
        c.tag = detail::wanted("out.tag", out.tag, n);
        c.feature = detail::wanted("out.feature", out.feature, n);
        c.piece = detail::wanted("out.piece", out.piece, n);
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_closest(handle_, n, points.x(), points.y(), points.z(), points.stride(), max_distance, r, &c);
        });
    }
    /// The nearest point of the surface, with everything there.
    Closest closest(const Points &points, double max_distance = std::numeric_limits<double>::infinity(),
                    const Run &run = {}) const {
        const std::size_t n = points.count();
        Closest all{detail::vector_of<double>(n),       detail::vector_of<Point>(n),        detail::vector_of<Point>(n),
                    detail::vector_of<Point>(n),        detail::vector_of<std::int64_t>(n), detail::vector_of<std::int32_t>(n),
                    detail::vector_of<std::int32_t>(n), detail::vector_of<std::int32_t>(n), detail::vector_of<std::int32_t>(n)};
        closest(points,
                ClosestOut{all.value, all.point, all.gradient, all.barycentric, all.primitive, all.part, all.tag,
                           all.feature, all.piece},
                max_distance, run);
        return all;
    }

    /// Values over a lattice into the caller's array. A SignOnly geometry refuses all modes but
    /// FillMode::Sign with EMB_ERROR_UNSUPPORTED.
    void fill(const Lattice &lattice, const Array &out, Fill mode = {}, const Run &run = {}) const {
        const emb_array array = out.c("out", lattice.points());
        const emb_lattice l = lattice.c();
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_fill(handle_, &l, static_cast<std::int32_t>(mode.mode()), mode.width(), r, &array);
        });
    }
    /// Values over a lattice, x fastest; T is double, float, or for sign fills std::int32_t or
    /// std::int8_t. A lattice too large for memory is EMB_ERROR_MEMORY.
    template <class T = double> std::vector<T> fill(const Lattice &lattice, Fill mode = {}, const Run &run = {}) const {
        std::vector<T> out = detail::vector_of<T>(lattice.points());
        fill(lattice, out, mode, run);
        return out;
    }

    /// Where the surface crosses the edges of a lattice that run along `axis` (0, 1, 2).
    void crossings(const Lattice &lattice, int axis, const CrossingsOut &out, const Run &run = {}) const {
        const std::size_t n = lattice.edges(axis);
        emb_crossings_out c{};
        c.struct_size = sizeof c;
        c.form = static_cast<std::int32_t>(out.form);
        c.elsewhere = static_cast<std::int32_t>(out.elsewhere);
        c.none = out.none;
        c.where = out.where.c("out.where", n);
        c.count = out.count.c("out.count", n);
        c.tag = out.tag.c("out.tag", n);
        c.part = out.part.c("out.part", n);
        const emb_lattice l = lattice.c();
        detail::call(run, [&](const emb_run *r) { return emb_geom_crossings(handle_, &l, axis, r, &c); });
    }
    /// Where the surface crosses the edges of a lattice that run along `axis`.
    Crossings crossings(const Lattice &lattice, int axis, CrossingForm form = CrossingForm::Coordinate,
                        const Run &run = {}) const {
        const std::size_t n = lattice.edges(axis);
        Crossings all{detail::vector_of<double>(n), detail::vector_of<std::int32_t>(n), detail::vector_of<std::int32_t>(n),
                      detail::vector_of<std::int32_t>(n)};
        CrossingsOut out;
        out.where = Array(all.where);
        out.count = Array(all.count);
        out.tag = Array(all.tag);
        out.part = Array(all.part);
        out.form = form;
        crossings(lattice, axis, out, run);
        return all;
    }

    /// Where the surface crosses the segments from a[i] to b[i].
    void intercepts(Span<const Point> a, Span<const Point> b, const InterceptsOut &out, const Run &run = {}) const {
        const std::size_t n = a.size();
        detail::require_size("b", b.size(), n);
        emb_hit_out c{};
        c.struct_size = sizeof c;
        c.t = detail::wanted("out.t", out.t, n);
        c.count = detail::wanted("out.count", out.count, n);
        c.status = detail::wanted("out.status", out.status, n);
        lend(detail::wanted("out.normal", out.normal, n), c.normal);
        c.vector_stride = 3;
        c.primitive = detail::wanted("out.primitive", out.primitive, n);
        c.part = detail::wanted("out.part", out.part, n);
        c.tag = detail::wanted("out.tag", out.tag, n);
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_intercepts(handle_, n, detail::flat(a.data()), detail::flat(b.data()), r, &c);
        });
    }
    /// Where the surface crosses the segments from a[i] to b[i], with everything there.
    Intercepts intercepts(Span<const Point> a, Span<const Point> b, const Run &run = {}) const {
        const std::size_t n = a.size();
        Intercepts all{detail::vector_of<double>(n),       detail::vector_of<std::int32_t>(n), detail::vector_of<std::int32_t>(n),
                       detail::vector_of<Point>(n),        detail::vector_of<std::int64_t>(n), detail::vector_of<std::int32_t>(n),
                       detail::vector_of<std::int32_t>(n)};
        intercepts(a, b, InterceptsOut{all.t, all.count, all.status, all.normal, all.primitive, all.part, all.tag}, run);
        return all;
    }

    /// -1: negative at every double of the closed box; +1: positive; 0: neither, not known, or not a box.
    int classify(const Point &lo, const Point &hi) const {
        detail::Frame frame(false);
        const std::int32_t side = emb_geom_classify_box(handle_, lo.data(), hi.data());
        frame.rethrow();
        return side;
    }
    /// The same for the boxes from lo[i] to hi[i]; NaN or lo > hi is an error naming the box.
    void classify(Span<const Point> lo, Span<const Point> hi, Span<std::int32_t> out, const Run &run = {}) const {
        detail::require_size("hi", hi.size(), lo.size());
        detail::require_size("out", out.size(), lo.size());
        detail::call(run, [&](const emb_run *r) {
            return emb_geom_classify_boxes(handle_, lo.size(), detail::flat(lo.data()), detail::flat(hi.data()), r, out.data());
        });
    }
    /// The same for the boxes from lo[i] to hi[i].
    std::vector<std::int32_t> classify(Span<const Point> lo, Span<const Point> hi, const Run &run = {}) const {
        std::vector<std::int32_t> out = detail::vector_of<std::int32_t>(lo.size());
        classify(lo, hi, out, run);
        return out;
    }

    /// A box around the body, infinite where it is unbounded.
    Box bounds() const {
        Box box{};
        check(emb_geom_bounds(handle_, box.lo.data(), box.hi.data()));
        return box;
    }

    /// What it says of itself.
    Properties properties() const {
        emb_geom_properties c{};
        c.struct_size = sizeof c;
        check(emb_geom_properties_get(handle_, &c));
        return Properties{static_cast<Kind>(c.kind), static_cast<Sign>(c.sign_method), c.lipschitz, c.primitives, c.bytes};
    }

    /// How the sign of its meshes is decided, and why: a line for each mesh.
    std::string sign_text() const {
        return detail::text([&](std::size_t capacity, char *out, std::size_t *size) {
            return emb_geom_sign_text(handle_, capacity, out, size);
        });
    }

private:
    /// Three pointers with a stride of three for an array of points.
    static void lend(Point *points, double *(&axes)[3]) noexcept {
        double *const xyz = detail::flat(points);
        for (std::size_t d = 0; d < 3; ++d) {
            axes[d] = xyz == nullptr ? nullptr : xyz + d;
        }
    }

    emb_geom *handle_ = nullptr;
};

namespace detail {

/// A geometry made by `create(emb_geom **)`.
template <class Create> Geometry made(Create &&create) {
    return Geometry(created<emb_geom>(std::forward<Create>(create)));
}

} // namespace detail
} // namespace embound

#endif
