// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// What is asked of a geometry and what comes back: modes, and the outputs of each question, as
/// vectors that a call returns or as spans of the caller's that it fills.
#ifndef EMBOUND_ANSWERS_HPP
#define EMBOUND_ANSWERS_HPP

#include "views.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace embound {

namespace detail {

/// A text by two calls: the size, then the text.
template <class Call> std::string text(Call &&call) {
    std::size_t size = 0;
    check(call(std::size_t{0}, static_cast<char *>(nullptr), &size));
    std::string result(size, '\0');
    check(call(size, result.data(), &size));
    result.resize(size - 1);
    return result;
}

} // namespace detail

/// Which side of the surface is fluid: bodies in a channel, or the inside of a pipe. For the
/// adapters to solvers, whose sign conventions differ; embound's own sign is negative inside.
enum class Fluid { Outside, Inside };

/// What the magnitude of a value means.
enum class Kind : std::int32_t {
    Exact = EMB_EXACT,            ///< The distance to the surface, faces that lie within a body included.
    LowerBound = EMB_LOWER_BOUND, ///< Not above the distance to the surface.
    SignOnly = EMB_SIGN_ONLY      ///< Nothing: only the sign counts.
};

/// How the sign of a mesh is decided.
enum class Sign : std::int32_t {
    Auto = EMB_SIGN_AUTO,                 ///< Chosen from what the mesh is like; properties() says which.
    Pseudonormal = EMB_SIGN_PSEUDONORMAL, ///< Angle-weighted pseudonormals.
    Winding = EMB_SIGN_WINDING,           ///< Generalised winding number, for any mesh, open ones too.
    Ray = EMB_SIGN_RAY,                   ///< Exact crossings of a ray; of open meshes what most of six rays say.
    Axis = EMB_SIGN_AXIS,                 ///< Terrain sheets: solid below the first hit down an axis.
    None = EMB_SIGN_NONE                  ///< Baffles: unsigned, never inside.
};

/// What a fill writes.
enum class FillMode : std::int32_t {
    Exact = EMB_FILL_EXACT, ///< The value.
    Band = EMB_FILL_BAND,   ///< The value where its magnitude is below the band, plus or minus the band elsewhere.
    Sign = EMB_FILL_SIGN    ///< -1, 0 or +1.
};

/// A fill mode with its band.
class Fill {
public:
    /// FillMode::Exact or FillMode::Sign.
    constexpr Fill(FillMode mode = FillMode::Exact) noexcept : mode_(mode) {}
    /// FillMode::Band of this half width, > 0, in the unit of length.
    static constexpr Fill band(double width) noexcept {
        Fill fill(FillMode::Band);
        fill.width_ = width;
        return fill;
    }
    constexpr FillMode mode() const noexcept { return mode_; } ///< The mode.
    constexpr double width() const noexcept { return width_; } ///< The band; 0 in other modes.

private:
    FillMode mode_;
    double width_ = 0.0;
};

/// How a crossing is given.
enum class CrossingForm : std::int32_t {
    Coordinate = EMB_CROSSING_COORDINATE, ///< The coordinate along the axis.
    Fraction = EMB_CROSSING_FRACTION      ///< 0 at the lattice point, 1 at its neighbour.
};

/// What happens on edges the surface does not cross.
enum class Elsewhere : std::int32_t {
    Write = EMB_ELSEWHERE_WRITE, ///< `none` is written.
    Leave = EMB_ELSEWHERE_LEAVE  ///< The caller's values stay.
};

/// Where closest() writes; what is empty is not wanted, the rest has one element for each point.
/// emb_closest_out says more of each.
struct ClosestOut {
    Span<double> value;             ///< Signed distance.
    Span<Point> point;              ///< The nearest point of the part that decides the value.
    Span<Point> gradient;           ///< Of the value; of length 1 where it is exact; on the surface along its outward normal.
    Span<Point> barycentric;        ///< Of the nearest point, for the triangle's corners as given.
    Span<std::int64_t> primitive;   ///< Index of the input face; ties go to the lowest.
    Span<std::int32_t> part;        ///< The body's label, -1: none.
    Span<std::int32_t> tag;         ///< The face's tag.
    Span<std::int32_t> feature;     ///< 0 face, 1-3 edge, 4-6 vertex, -1 not a mesh.
    Span<std::int32_t> piece;       ///< Which of the triangles that the face was cut into.
};

/// What closest() returns, one element for each point; see ClosestOut.
struct Closest {
    std::vector<double> value;           ///< Signed distance.
    std::vector<Point> point;            ///< The nearest point of the part that decides the value.
    std::vector<Point> gradient;         ///< Of the value; of length 1 where it is exact.
    std::vector<Point> barycentric;      ///< Of the nearest point, for the triangle's corners as given; see Mesh::is_turned.
    std::vector<std::int64_t> primitive; ///< Index of the input face.
    std::vector<std::int32_t> part;      ///< The body's label, -1: none.
    std::vector<std::int32_t> tag;       ///< The face's tag.
    std::vector<std::int32_t> feature;   ///< 0 face, 1-3 edge, 4-6 vertex, -1 not a mesh.
    std::vector<std::int32_t> piece;     ///< Which of the triangles that the face was cut into.
};

/// Where crossings() writes, arrays of Lattice::edge_shape(axis); what is empty is not wanted.
struct CrossingsOut {
    Array where;                                              ///< The crossing, double or float.
    Array count;                                              ///< How often the surface was met.
    Array tag;                                                ///< Of the face crossed.
    Array part;                                               ///< Of the body crossed.
    CrossingForm form = CrossingForm::Coordinate;             ///< How `where` is given.
    Elsewhere elsewhere = Elsewhere::Write;                   ///< What edges without a crossing get.
    double none = std::numeric_limits<double>::quiet_NaN();   ///< Written to `where` on those.
};

/// What crossings() returns, one element for each edge, x fastest.
struct Crossings {
    std::vector<double> where;       ///< The crossing; NaN where the ends are on one side.
    std::vector<std::int32_t> count; ///< How often the surface was met.
    std::vector<std::int32_t> tag;   ///< Of the face crossed.
    std::vector<std::int32_t> part;  ///< Of the body crossed.
};

/// Where intercepts() writes; what is empty is not wanted, the rest has one element for each segment.
struct InterceptsOut {
    Span<double> t;               ///< 0 at a, 1 at b; NaN where the ends are on one side.
    Span<std::int32_t> count;     ///< How often the surface was met, also where t is NaN.
    Span<std::int32_t> status;    ///< 0 none, 1 ray, 2 several, 3 bisected.
    Span<Point> normal;           ///< Of the surface there, outward.
    Span<std::int64_t> primitive; ///< Index of the input face.
    Span<std::int32_t> part;      ///< The body's label, -1: none.
    Span<std::int32_t> tag;       ///< The face's tag.
};

/// What intercepts() returns, one element for each segment; see InterceptsOut.
struct Intercepts {
    std::vector<double> t;               ///< 0 at a, 1 at b; NaN where the ends are on one side.
    std::vector<std::int32_t> count;     ///< How often the surface was met.
    std::vector<std::int32_t> status;    ///< 0 none, 1 ray, 2 several, 3 bisected.
    std::vector<Point> normal;           ///< Of the surface there, outward.
    std::vector<std::int64_t> primitive; ///< Index of the input face.
    std::vector<std::int32_t> part;      ///< The body's label, -1: none.
    std::vector<std::int32_t> tag;       ///< The face's tag.
};

/// What a geometry says of itself.
struct Properties {
    Kind kind;                ///< What the magnitude of its values means.
    Sign sign_method;         ///< How the sign of its mesh is decided; Auto without a mesh or with several methods.
    double lipschitz;         ///< |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown.
    std::uint64_t primitives; ///< Triangles and shapes.
    std::uint64_t bytes;      ///< Memory, shared parts counted once.
};

} // namespace embound

#endif
