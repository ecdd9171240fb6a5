// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Values one after another, for solvers that call a function for each point.
#ifndef EMBOUND_CURSOR_HPP
#define EMBOUND_CURSOR_HPP

#include "geometry.hpp"

#include <utility>

namespace embound {

/// A geometry, and what was found around the points it was asked about lately, so that a point near
/// others costs a fraction of one by itself: see emb_cursor_new. The bits are those of the geometry.
/// One for each thread; a copy starts with nothing found. Empty like a Geometry.
///
///     embound::Cursor level(body);
///     for (...) phi(i, j, k) = level(x[i], y[j], z[k]);
class Cursor {
public:
    /// Empty.
    Cursor() noexcept = default;
    /// Of a geometry, which it shares; empty where that is.
    explicit Cursor(const Geometry &geometry) : geometry_(geometry), handle_(make(geometry_)) {}
    /// With nothing found yet.
    Cursor(const Cursor &other) : Cursor(other.geometry_) {}
    /// Leaves `other` empty.
    Cursor(Cursor &&other) noexcept : geometry_(std::move(other.geometry_)), handle_(std::exchange(other.handle_, nullptr)) {}
    /// As a copy, or leaves `other` empty.
    Cursor &operator=(Cursor other) noexcept {
        std::swap(geometry_, other.geometry_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Cursor() { emb_cursor_free(handle_); }

    /// Lends the handle, which is valid as long as this object is. `emb_cursor_value_fn` with it is
    /// the pair of function and user data that many solvers take.
    emb_cursor *get() const noexcept { return handle_; }
    /// What it asks.
    const Geometry &geometry() const noexcept { return geometry_; }
    /// Whether there is a geometry.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The value at one point, as Geometry's.
    double operator()(double x, double y, double z) const {
        detail::Frame frame(false);
        const double value = emb_cursor_value(handle_, x, y, z);
        frame.rethrow();
        return value;
    }

private:
    static emb_cursor *make(const Geometry &geometry) {
        emb_cursor *made = nullptr;
        if (geometry) {
            check(emb_cursor_new(geometry.get(), &made));
        }
        return made;
    }

    Geometry geometry_;
    emb_cursor *handle_ = nullptr;
};

} // namespace embound

#endif
