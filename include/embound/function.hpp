// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Geometries that are a function of the caller's.
#ifndef EMBOUND_FUNCTION_HPP
#define EMBOUND_FUNCTION_HPP

#include "geometry.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace embound {

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

/// Numbers between which the values of a function in a box lie, rounding included; unknown by default.
struct Range {
    double lo = -std::numeric_limits<double>::infinity(); ///< None is less.
    double hi = std::numeric_limits<double>::infinity();  ///< None is greater.
};

namespace detail {

/// What a caller hands in: the value, point by point or batched, and its gradient and range, each a
/// callable or nullptr. An exception is kept for the C++ call it serves, and the library is told that
/// the function failed.
template <class Value, class Values, class Gradient, class InBox> struct Function {
    Value value;
    Values values;
    Gradient gradient;
    InBox range;

    static double call_value(void *user, double x, double y, double z) {
        try {
            Function &self = *static_cast<Function *>(user);
            if constexpr (std::is_null_pointer_v<Value>) {
                double result = std::numeric_limits<double>::quiet_NaN();
                using In = Span<const double>;
                self.values(In(&x, 1), In(&y, 1), In(&z, 1), Span<double>(&result, 1));
                return result;
            } else {
                return static_cast<double>(self.value(x, y, z));
            }
        } catch (...) {
            Frame::keep_exception();
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    static void call_values(void *user, std::size_t count, const double *x, const double *y, const double *z, double *out) {
        try {
            using In = Span<const double>;
            static_cast<Function *>(user)->values(In(x, count), In(y, count), In(z, count), Span<double>(out, count));
        } catch (...) {
            Frame::keep_exception();
            std::fill_n(out, count, std::numeric_limits<double>::quiet_NaN());
        }
    }

    static std::int32_t call_gradient(void *user, double x, double y, double z, double *out) {
        try {
            const Point g = static_cast<Function *>(user)->gradient(x, y, z);
            std::copy(g.begin(), g.end(), out);
            return 0;
        } catch (...) {
            Frame::keep_exception();
            return 1;
        }
    }

    static std::int32_t call_range(void *user, const double *lo, const double *hi, double *out_lo, double *out_hi) {
        try {
            const Range range = static_cast<Function *>(user)->range(Point{lo[0], lo[1], lo[2]}, Point{hi[0], hi[1], hi[2]});
            *out_lo = range.lo;
            *out_hi = range.hi;
            return 0;
        } catch (...) {
            Frame::keep_exception();
            return 1;
        }
    }

    static void drop(void *user) { delete static_cast<Function *>(user); }

    /// As a geometry, which keeps it.
    static Geometry make(Function all, const FunctionOptions &options) {
        emb_callback_options c = options.c();
        if constexpr (!std::is_null_pointer_v<Values>) {
            c.values = call_values;
        }
        if constexpr (!std::is_null_pointer_v<Gradient>) {
            c.gradient = call_gradient;
        }
        if constexpr (!std::is_null_pointer_v<InBox>) {
            c.range = call_range;
        }
        auto kept = std::make_unique<Function>(std::move(all));
        emb_geom *geometry = created<emb_geom>(
            [&](emb_geom **out) { return emb_geom_callback(call_value, kept.get(), drop, &c, out); });
        static_cast<void>(kept.release());
        return Geometry(geometry);
    }
};

/// Anything but options, which the overload without the argument takes.
template <class T> using NotOptions = std::enable_if_t<!std::is_same_v<T, FunctionOptions>>;

} // namespace detail

/// Any callable `double(double x, double y, double z)`: negative inside, NaN where it fails. The
/// geometry keeps a copy, which dies with the last geometry that uses it, on whatever thread that is.
/// One not marked thread-safe is only called on the threads that ask. What it throws reaches the
/// C++ caller as it was thrown; a C caller gets NaN, or EMB_ERROR_CALLBACK from a batch.
template <class Value> Geometry function(Value value, const FunctionOptions &options = {}) {
    using All = detail::Function<Value, std::nullptr_t, std::nullptr_t, std::nullptr_t>;
    return All::make({std::move(value), nullptr, nullptr, nullptr}, options);
}
/// With its gradient, a callable `Point(double x, double y, double z)`.
template <class Value, class Gradient, class = detail::NotOptions<Gradient>>
Geometry function(Value value, Gradient gradient, const FunctionOptions &options = {}) {
    using All = detail::Function<Value, std::nullptr_t, Gradient, std::nullptr_t>;
    return All::make({std::move(value), nullptr, std::move(gradient), nullptr}, options);
}
/// With its gradient, or nullptr, and its range over a box, a callable `Range(const Point &lo, const Point &hi)`.
template <class Value, class Gradient, class InBox, class = detail::NotOptions<InBox>>
Geometry function(Value value, Gradient gradient, InBox range, const FunctionOptions &options = {}) {
    using All = detail::Function<Value, std::nullptr_t, Gradient, InBox>;
    return All::make({std::move(value), nullptr, std::move(gradient), std::move(range)}, options);
}

/// A function of many points at once: any callable `void(Span<const double> x, Span<const double> y,
/// Span<const double> z, Span<double> out)` of four spans of one size, whose results do not depend on how
/// points are put together. Otherwise as function().
template <class Values> Geometry batched_function(Values values, const FunctionOptions &options = {}) {
    using All = detail::Function<std::nullptr_t, Values, std::nullptr_t, std::nullptr_t>;
    return All::make({nullptr, std::move(values), nullptr, nullptr}, options);
}
/// With its gradient, a callable `Point(double x, double y, double z)`.
template <class Values, class Gradient, class = detail::NotOptions<Gradient>>
Geometry batched_function(Values values, Gradient gradient, const FunctionOptions &options = {}) {
    using All = detail::Function<std::nullptr_t, Values, Gradient, std::nullptr_t>;
    return All::make({nullptr, std::move(values), std::move(gradient), nullptr}, options);
}
/// With its gradient, or nullptr, and its range over a box, a callable `Range(const Point &lo, const Point &hi)`.
template <class Values, class Gradient, class InBox, class = detail::NotOptions<InBox>>
Geometry batched_function(Values values, Gradient gradient, InBox range, const FunctionOptions &options = {}) {
    using All = detail::Function<std::nullptr_t, Values, Gradient, InBox>;
    return All::make({nullptr, std::move(values), std::move(gradient), std::move(range)}, options);
}

} // namespace embound

#endif
