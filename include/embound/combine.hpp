// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Set operations, sharp and smooth, and repetition. A composite keeps its parts alive. Each throws Error
/// naming the part that is empty.
#ifndef EMBOUND_COMBINE_HPP
#define EMBOUND_COMBINE_HPP

#include "geometry.hpp"

#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace embound {

/// What the caller knows of a blend of its own, and vouches for.
struct BlendOptions {
    double support = std::numeric_limits<double>::infinity();   ///< Values further apart leave the lesser alone.
    double depth = std::numeric_limits<double>::infinity();     ///< The most it goes below the least value.
    double lipschitz = std::numeric_limits<double>::infinity(); ///< Of the greater change of its two values.
    bool thread_safe = false;                                   ///< Whether several threads may call it at once.
};

/// A blended value with its derivatives by both, where they are known.
struct Blended {
    double value;                                          ///< The blend.
    double by_a = std::numeric_limits<double>::quiet_NaN(); ///< By the lesser; NaN: centred differences.
    double by_b = std::numeric_limits<double>::quiet_NaN(); ///< By the greater; NaN: centred differences.
};

/// How smooth set operations blend values that are close.
class Blend {
public:
    /// A quadratic piece that leaves values further than `width` apart alone (Quilez 2013).
    static Blend smooth(double width) { return Blend(EMB_BLEND_SMOOTH, width); }
    /// -width log(exp(-a / width) + exp(-b / width)) (Ricci 1973).
    static Blend exponential(double width) { return Blend(EMB_BLEND_EXPONENTIAL, width); }
    /// Any callable of two doubles a <= b that returns double or Blended, rises with either, is never above a,
    /// and is NaN where it fails. Geometries made with it keep it. One not marked thread-safe is only called on the threads
    /// that ask. What it throws reaches the C++ caller as it was thrown.
    template <class Function> static Blend custom(Function f, const BlendOptions &options = {}) {
        Blend blend(EMB_BLEND_CUSTOM, 0.0);
        blend.c_.thread_safe = options.thread_safe ? 1 : 0;
        blend.c_.support = options.support;
        blend.c_.depth = options.depth;
        blend.c_.lipschitz = options.lipschitz;
        blend.function_ = std::make_shared<Callable<Function>>(std::move(f));
        blend.c_.blend = call;
        blend.c_.drop = drop;
        return blend;
    }

    /// Makes a geometry by `create(const emb_blend *, emb_geom **)`, which keeps a share of the function.
    template <class Create> Geometry make(Create &&create) const {
        emb_blend c = c_;
        auto share = function_ ? std::make_unique<Share>(function_) : nullptr;
        c.user = share.get();
        emb_geom *geometry = detail::created<emb_geom>([&](emb_geom **out) { return create(&c, out); });
        static_cast<void>(share.release());
        return Geometry(geometry);
    }

private:
    struct Base {
        virtual ~Base() = default;
        virtual Blended blend(double a, double b) = 0;
    };
    template <class Function> struct Callable final : Base {
        explicit Callable(Function f) : function(std::move(f)) {}
        Blended blend(double a, double b) override {
            if constexpr (std::is_same_v<decltype(function(a, b)), Blended>) {
                return function(a, b);
            } else {
                return Blended{static_cast<double>(function(a, b))};
            }
        }
        Function function;
    };
    using Share = std::shared_ptr<Base>;

    Blend(std::int32_t kind, double width) {
        check(emb_blend_init(&c_, sizeof c_));
        c_.kind = kind;
        c_.width = width;
    }

    static double call(void *user, double a, double b, double *out_by_a, double *out_by_b) {
        try {
            const Blended blended = (*static_cast<Share *>(user))->blend(a, b);
            *out_by_a = blended.by_a;
            *out_by_b = blended.by_b;
            return blended.value;
        } catch (...) {
            detail::Frame::keep_exception();
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    static void drop(void *user) { delete static_cast<Share *>(user); }

    emb_blend c_;
    Share function_;
};

namespace detail {

/// The handles of several geometries.
inline std::vector<const emb_geom *> handles(Span<const Geometry> parts) {
    std::vector<const emb_geom *> all = vector_of<const emb_geom *>(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        all[i] = parts[i].get();
    }
    return all;
}

} // namespace detail

/// All of the parts together; of none: nothing.
inline Geometry unite(Span<const Geometry> parts) {
    const auto all = detail::handles(parts);
    return detail::made([&](emb_geom **out) { return emb_geom_union(all.size(), all.data(), out); });
}
/// All of the parts together.
inline Geometry unite(std::initializer_list<Geometry> parts) {
    return unite(Span<const Geometry>(parts.begin(), parts.size()));
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
inline Geometry intersection(std::initializer_list<Geometry> parts) {
    return intersection(Span<const Geometry>(parts.begin(), parts.size()));
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

/// `from` without any of `remove`.
inline Geometry difference(const Geometry &from, Span<const Geometry> remove) {
    const auto all = detail::handles(remove);
    return detail::made(
        [&](emb_geom **out) { return emb_geom_difference_of_many(from.get(), all.size(), all.data(), out); });
}
/// `from` without any of `remove`.
inline Geometry difference(const Geometry &from, std::initializer_list<Geometry> remove) {
    return difference(from, Span<const Geometry>(remove.begin(), remove.size()));
}

/// All of the parts together, their inner edges filled.
inline Geometry smooth_union(Span<const Geometry> parts, const Blend &blend) {
    const auto all = detail::handles(parts);
    return blend.make(
        [&](const emb_blend *c, emb_geom **out) { return emb_geom_smooth_union(all.size(), all.data(), c, out); });
}
/// All of the parts together, their inner edges filled.
inline Geometry smooth_union(std::initializer_list<Geometry> parts, const Blend &blend) {
    return smooth_union(Span<const Geometry>(parts.begin(), parts.size()), blend);
}

/// What is in every part, the edges rounded.
inline Geometry smooth_intersection(Span<const Geometry> parts, const Blend &blend) {
    const auto all = detail::handles(parts);
    return blend.make(
        [&](const emb_blend *c, emb_geom **out) { return emb_geom_smooth_intersection(all.size(), all.data(), c, out); });
}
/// What is in every part, the edges rounded.
inline Geometry smooth_intersection(std::initializer_list<Geometry> parts, const Blend &blend) {
    return smooth_intersection(Span<const Geometry>(parts.begin(), parts.size()), blend);
}

/// `from` without any of `remove`, the edges between them rounded.
inline Geometry smooth_difference(const Geometry &from, Span<const Geometry> remove, const Blend &blend) {
    const auto all = detail::handles(remove);
    return blend.make([&](const emb_blend *c, emb_geom **out) {
        return emb_geom_smooth_difference(from.get(), all.size(), all.data(), c, out);
    });
}
/// `from` without any of `remove`, the edges between them rounded.
inline Geometry smooth_difference(const Geometry &from, std::initializer_list<Geometry> remove, const Blend &blend) {
    return smooth_difference(from, Span<const Geometry>(remove.begin(), remove.size()), blend);
}
/// `from` without `remove`, the edges between them rounded.
inline Geometry smooth_difference(const Geometry &from, const Geometry &remove, const Blend &blend) {
    return smooth_difference(from, Span<const Geometry>(&remove, 1), blend);
}

/// Copies at (i period[0], j period[1], k period[2]), 0 <= i < counts[0] and so on, for the memory of one.
inline Geometry repeat(const Geometry &g, const Point &period, const std::array<std::int32_t, 3> &counts) {
    return detail::made([&](emb_geom **out) { return emb_geom_repeat(g.get(), period.data(), counts.data(), out); });
}

/// Inside out.
inline Geometry complement(const Geometry &g) {
    return detail::made([&](emb_geom **out) { return emb_geom_complement(g.get(), out); });
}

} // namespace embound

#endif
