// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// The caller's memory as embound sees it: spans, points, lattices, arrays over a lattice. Views do
/// not own: what they show must outlive the call they are given to.
#ifndef EMBOUND_VIEWS_HPP
#define EMBOUND_VIEWS_HPP

#include "error.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace embound {

/// x, y, z in the caller's unit of length.
using Point = std::array<double, 3>;

/// A 3 x 3 matrix, row major.
using Matrix = std::array<double, 9>;

/// The matrix that changes nothing.
inline constexpr Matrix identity{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/// A box with sides along the axes.
struct Box {
    Point lo; ///< Lower corner; +infinity in a box that holds nothing.
    Point hi; ///< Upper corner; -infinity in a box that holds nothing.
};

/// Pointer and size. Made from both, from a C array, or from anything contiguous that has data()
/// and size(): std::vector, std::array, std::span.
template <class T> class Span {
public:
    /// Nothing: an output not wanted.
    constexpr Span() noexcept = default;
    /// `size` elements at `data`.
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    /// A C array.
    template <std::size_t N> constexpr Span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    /// A contiguous container of T, or of what T is the const of. A temporary may be shown where it
    /// owns nothing (std::span) or is only read.
    template <class Container,
              class Shown = std::conditional_t<std::is_lvalue_reference_v<Container>, Container, const Container &>,
              class Data = std::remove_pointer_t<decltype(std::declval<Shown>().data())>,
              class = decltype(std::declval<Shown>().size()),
              class = std::enable_if_t<std::is_convertible_v<Data (*)[], T (*)[]> &&
                                       !std::is_same_v<std::remove_cv_t<std::remove_reference_t<Container>>, Span>>>
    constexpr Span(Container &&container) : data_(container.data()), size_(container.size()) {}

    constexpr T *data() const noexcept { return data_; }             ///< The first element.
    constexpr std::size_t size() const noexcept { return size_; }    ///< How many.
    constexpr bool empty() const noexcept { return size_ == 0; }     ///< None?
    constexpr T *begin() const noexcept { return data_; }            ///< The first element.
    constexpr T *end() const noexcept { return data_ + size_; }      ///< Past the last.
    constexpr T &operator[](std::size_t i) const { return data_[i]; } ///< Element i, unchecked.

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail {

/// `have` elements of what is called `name` must be at least `needed`, or exactly as many.
inline void require_size(const char *name, std::size_t have, std::size_t needed) {
    if (have != needed) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT,
                    std::string(name) + ": " + std::to_string(have) + " elements, " + std::to_string(needed) + " needed");
    }
}

/// The pointer of an output of `count` elements; null for an empty span, which is not wanted.
template <class T> T *wanted(const char *name, Span<T> out, std::size_t count) {
    if (out.empty()) {
        return nullptr;
    }
    require_size(name, out.size(), count);
    return out.data();
}

/// The coordinates of an array of points, one after the other.
inline double *flat(Point *points) noexcept { return points == nullptr ? nullptr : points->data(); }
/// The coordinates of an array of points, one after the other.
inline const double *flat(const Point *points) noexcept { return points == nullptr ? nullptr : points->data(); }
/// The coordinates of corners in a plane, one after the other.
inline const double *flat(Span<const std::array<double, 2>> corners) noexcept {
    return corners.empty() ? nullptr : corners[0].data();
}

static_assert(sizeof(Point) == 3 * sizeof(double), "an array of Point is an array of coordinates");

} // namespace detail

/// Points to ask about, in either layout, in f64 (`Points`) or f32 (`PointsF32`).
template <class Real> class PointsView {
public:
    /// One array x0 y0 z0 x1 y1 z1 ...; Error where its length is not a multiple of 3.
    template <class Container, class = std::enable_if_t<std::is_convertible_v<Container &&, Span<const Real>>>>
    PointsView(Container &&xyz) {
        const Span<const Real> span(xyz);
        if (span.size() % 3 != 0) {
            throw Error(EMB_ERROR_INVALID_ARGUMENT,
                        "xyz: " + std::to_string(span.size()) + " coordinates are not points of three");
        }
        set(span.size() / 3, span.data(), 3);
    }
    /// An array of points.
    template <class Container, class Only = void,
              class = std::enable_if_t<std::is_convertible_v<Container &&, Span<const std::array<Real, 3>>>, Only>>
    PointsView(Container &&points) {
        const Span<const std::array<Real, 3>> span(points);
        set(span.size(), span.empty() ? nullptr : span[0].data(), 3);
    }
    /// Three arrays of one length.
    PointsView(Span<const Real> x, Span<const Real> y, Span<const Real> z)
        : x_(x.data()), y_(y.data()), z_(z.data()), count_(x.size()) {
        detail::require_size("y", y.size(), count_);
        detail::require_size("z", z.size(), count_);
    }
    /// As the C functions take them: point i is (x[i * stride], y[i * stride], z[i * stride]).
    PointsView(std::size_t count, const Real *x, const Real *y, const Real *z, std::size_t stride) noexcept
        : x_(x), y_(y), z_(z), count_(count), stride_(stride) {}

    const Real *x() const noexcept { return x_; }               ///< First x.
    const Real *y() const noexcept { return y_; }               ///< First y.
    const Real *z() const noexcept { return z_; }               ///< First z.
    std::size_t count() const noexcept { return count_; }       ///< How many points.
    std::size_t stride() const noexcept { return stride_; }     ///< From one to the next, in elements.

private:
    void set(std::size_t count, const Real *xyz, std::size_t stride) noexcept {
        count_ = count;
        stride_ = stride;
        if (xyz != nullptr) {
            x_ = xyz;
            y_ = xyz + 1;
            z_ = xyz + 2;
        }
    }

    const Real *x_ = nullptr;
    const Real *y_ = nullptr;
    const Real *z_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 1;
};

using Points = PointsView<double>;   ///< Points in f64.
using PointsF32 = PointsView<float>; ///< Points in f32.

/// A tensor grid: the point (i, j, k) is (x[i], y[j], z[k]). Each axis is finite and monotone either
/// way, repeats allowed. The coordinates are the caller's own doubles: compute them once, as the
/// solver does, and embound never computes them again. The axes must outlive the lattice: name them, unless
/// the lattice itself is a temporary in the call.
class Lattice {
public:
    /// Three axes.
    Lattice(Span<const double> x, Span<const double> y, Span<const double> z) noexcept
        : x_(x.data()), y_(y.data()), z_(z.data()), n_{x.size(), y.size(), z.size()} {}
    /// Two axes: z = 0.
    Lattice(Span<const double> x, Span<const double> y) noexcept : x_(x.data()), y_(y.data()), n_{x.size(), y.size(), 1} {}

    /// Points along each axis; 1 along z in two dimensions.
    const std::array<std::size_t, 3> &n() const noexcept { return n_; }

    /// How many points; EMB_ERROR_MEMORY where no memory could hold one value each.
    std::size_t points() const { return product(n_); }

    /// How many edges join a point to its neighbour along `axis` (0, 1, 2).
    std::size_t edges(int axis) const { return product(edge_shape(axis)); }

    /// Edges along each axis, of those that run along `axis`.
    std::array<std::size_t, 3> edge_shape(int axis) const {
        if (axis < 0 || axis > 2) {
            throw Error(EMB_ERROR_INVALID_ARGUMENT, "axis: " + std::to_string(axis) + " is not 0, 1 or 2");
        }
        std::array<std::size_t, 3> shape = n_;
        std::size_t &along = shape[static_cast<std::size_t>(axis)];
        along -= along > 0 ? 1 : 0;
        return shape;
    }

    /// As the C functions take it.
    emb_lattice c() const noexcept {
        emb_lattice lattice{};
        lattice.struct_size = sizeof lattice;
        for (std::size_t d = 0; d < 3; ++d) {
            lattice.n[d] = n_[d];
        }
        lattice.x = x_;
        lattice.y = y_;
        lattice.z = z_;
        return lattice;
    }

private:
    static std::size_t product(const std::array<std::size_t, 3> &n) {
        if (n[0] == 0 || n[1] == 0 || n[2] == 0) {
            return 0;
        }
        constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / sizeof(double);
        if (n[0] > most / n[1] || n[0] * n[1] > most / n[2]) {
            throw Error(EMB_ERROR_MEMORY, "lattice.n: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                                              std::to_string(n[2]) + " values: cannot be allocated");
        }
        return n[0] * n[1] * n[2];
    }

    const double *x_ = nullptr;
    const double *y_ = nullptr;
    const double *z_ = nullptr;
    std::array<std::size_t, 3> n_;
};

namespace detail {

/// What the C functions call a type of elements.
template <class T> constexpr std::int32_t type_of() noexcept {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, float> || std::is_same_v<T, std::int32_t> ||
                      std::is_same_v<T, std::int8_t>,
                  "arrays over a lattice hold double, float, std::int32_t or std::int8_t");
    if constexpr (std::is_same_v<T, double>) {
        return EMB_F64;
    } else if constexpr (std::is_same_v<T, float>) {
        return EMB_F32;
    } else if constexpr (std::is_same_v<T, std::int32_t>) {
        return EMB_I32;
    } else {
        return EMB_I8;
    }
}

} // namespace detail

/// The caller's array over a lattice, of double, float, std::int32_t or std::int8_t (integers for
/// sign fills, counts, tags and parts only). Empty: an output not wanted.
class Array {
public:
    /// Not wanted.
    Array() noexcept = default;
    /// Tight, x fastest: element (i, j, k) at i + n[0] * (j + n[1] * k). Its size is checked.
    template <class Container,
              class T = std::remove_pointer_t<decltype(std::declval<Container &>().data())>,
              class = std::enable_if_t<std::is_convertible_v<Container &&, Span<T>>>>
    Array(Container &&values) noexcept : data_(values.data()), size_(values.size()), type_(detail::type_of<T>()) {}
    /// Element (i, j, k) at data[i * stride[0] + j * stride[1] + k * stride[2]], in elements; the
    /// memory there is the caller's word.
    template <class T>
    Array(T *data, const std::array<std::ptrdiff_t, 3> &stride) noexcept
        : data_(data), size_(unknown), type_(detail::type_of<T>()), stride_(stride) {}

    /// As the C functions take it; Error where a tight array has not `count` elements.
    emb_array c(const char *name, std::size_t count) const {
        if (data_ != nullptr && size_ != unknown) {
            detail::require_size(name, size_, count);
        }
        emb_array array{};
        array.struct_size = sizeof array;
        array.data = data_;
        array.type = type_;
        for (std::size_t d = 0; d < 3; ++d) {
            array.stride[d] = stride_[d];
        }
        return array;
    }

private:
    static constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();

    void *data_ = nullptr;
    std::size_t size_ = 0;
    std::int32_t type_ = EMB_F64;
    std::array<std::ptrdiff_t, 3> stride_{0, 0, 0};
};

/// The caller's values over a lattice, which are only read: of double or float, and where `Integers` says so of
/// std::int32_t or std::int8_t as well.
template <bool Integers> class ReadArray {
public:
    /// Tight, x fastest: element (i, j, k) at i + n[0] * (j + n[1] * k). Its size is checked.
    template <class Container,
              class T = std::remove_cv_t<std::remove_pointer_t<decltype(std::declval<const Container &>().data())>>,
              class = std::enable_if_t<std::is_convertible_v<const Container &, Span<const T>>>>
    ReadArray(const Container &values) noexcept : data_(values.data()), size_(values.size()), type_(allowed<T>()) {}
    /// Element (i, j, k) at data[i * stride[0] + j * stride[1] + k * stride[2]], in elements; the
    /// memory there is the caller's word.
    template <class T>
    ReadArray(const T *data, const std::array<std::ptrdiff_t, 3> &stride) noexcept
        : data_(data), size_(unknown), type_(allowed<T>()), stride_(stride) {}

    /// As the C functions take it; Error where a tight array has not `count` elements.
    emb_array c(const char *name, std::size_t count) const {
        if (size_ != unknown) {
            detail::require_size(name, size_, count);
        }
        emb_array array{};
        array.struct_size = sizeof array;
        array.data = const_cast<void *>(data_);
        array.type = type_;
        for (std::size_t d = 0; d < 3; ++d) {
            array.stride[d] = stride_[d];
        }
        return array;
    }

private:
    template <class T> static constexpr std::int32_t allowed() noexcept {
        static_assert(Integers || std::is_floating_point_v<T>, "samples are double or float");
        return detail::type_of<T>();
    }

    static constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();

    const void *data_;
    std::size_t size_;
    std::int32_t type_;
    std::array<std::ptrdiff_t, 3> stride_{0, 0, 0};
};

using ConstArray = ReadArray<false>;         ///< Samples.
using ConstArrayOfAnyType = ReadArray<true>; ///< Samples, or numbers of other kinds.

} // namespace embound

#endif
