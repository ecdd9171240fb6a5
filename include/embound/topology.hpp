// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// The half-edges of a mesh, what there is to measure of its faces, edges and vertices, and points in polygons.
#ifndef EMBOUND_TOPOLOGY_HPP
#define EMBOUND_TOPOLOGY_HPP

#include "mesh.hpp"

#include <array>

namespace embound {

/// One face, edge or vertex of a mesh.
struct Element {
    std::int32_t kind;   ///< EMB_ELEMENT_FACE, EMB_ELEMENT_EDGE or EMB_ELEMENT_VERTEX.
    std::uint64_t index; ///< The number of the input face, a half-edge or a vertex.

    static constexpr Element face(std::uint64_t face) noexcept { return {EMB_ELEMENT_FACE, face}; }     ///< An input face.
    static constexpr Element edge(std::uint32_t h) noexcept { return {EMB_ELEMENT_EDGE, h}; }           ///< A half-edge's edge.
    static constexpr Element vertex(std::uint32_t v) noexcept { return {EMB_ELEMENT_VERTEX, v}; }       ///< A vertex.
};

/// What there is to measure of an element.
struct Measure {
    Point normal;    ///< Unit normal or pseudonormal; zero where there is none.
    Point centroid;  ///< Centroid, middle or position.
    double size;     ///< Area or length; 0 for a vertex.
};

/// A signed distance and where it ends.
struct Nearest {
    double distance; ///< Negative behind the element's normal.
    Point point;     ///< The nearest point of the element.
};

/// How to decide whether a point lies in a polygon. They differ where a polygon covers itself twice, and nowhere on
/// its boundary: of polygons side by side one holds each point between them.
enum class Inside : std::int32_t {
    Crossing = EMB_POLYGON_CROSSING, ///< Where a ray crosses the boundary an odd number of times. Exact.
    Winding = EMB_POLYGON_WINDING,   ///< Where the boundary winds around the point, whichever way. Exact.
    Angle = EMB_POLYGON_ANGLE        ///< Where the sides subtend more than half a turn: the winding number to rounding.
};

/// Whether a point of the plane lies in a polygon, whichever way its corners run; in fewer than three none does.
/// Error: EMB_ERROR_INVALID_ARGUMENT naming a coordinate that is not finite or beyond 1e100.
///
///     const std::vector<std::array<double, 2>> inlet{{0, 0}, {3, 0}, {3, 1}, {0, 2}};
///     bool in = embound::polygon_contains(inlet, {0.5, 0.5});
inline bool polygon_contains(Span<const std::array<double, 2>> corners, const std::array<double, 2> &point,
                             Inside how = Inside::Crossing) {
    std::int32_t inside = 0;
    const std::int32_t method = static_cast<std::int32_t>(how);
    check(emb_polygon_contains(corners.size(), detail::flat(corners), point.data(), method, &inside));
    return inside != 0;
}

/// The half-edges of a mesh. `none` stands for no half-edge or vertex. Shares the mesh; cheap to copy.
class Topology {
public:
    static constexpr std::uint32_t none = EMB_NO_INDEX; ///< No half-edge.

    /// Of this mesh.
    explicit Topology(Mesh mesh) : mesh_(std::move(mesh)) {}

    std::size_t half_edge_count() const noexcept { return emb_mesh_half_edge_count(m()); } ///< How many.

    /// The vertex that a half-edge leaves.
    std::uint32_t origin(std::uint32_t h) const noexcept { return emb_mesh_half_edge_origin(m(), h); }
    /// The vertex that a half-edge leads to.
    std::uint32_t target(std::uint32_t h) const noexcept { return emb_mesh_half_edge_target(m(), h); }
    /// The next half-edge round the face.
    std::uint32_t next(std::uint32_t h) const noexcept { return emb_mesh_half_edge_next(m(), h); }
    /// The previous half-edge round the face.
    std::uint32_t previous(std::uint32_t h) const noexcept { return emb_mesh_half_edge_previous(m(), h); }
    /// The half-edge of the other face of the edge; none at boundaries and where faces disagree.
    std::uint32_t twin(std::uint32_t h) const noexcept { return emb_mesh_half_edge_twin(m(), h); }
    /// The next half-edge that leaves the same vertex, counter-clockwise; none where the fan ends.
    std::uint32_t around(std::uint32_t h) const noexcept { return emb_mesh_half_edge_around(m(), h); }
    /// The input face of a half-edge.
    std::int64_t face(std::uint32_t h) const noexcept { return emb_mesh_half_edge_face(m(), h); }
    /// The first half-edge of an input face; none where the face is gone.
    std::uint32_t face_half_edge(std::uint64_t face) const noexcept { return emb_mesh_face_half_edge(m(), face); }

    /// The vertices of an input face, counter-clockwise seen from outside; empty where the face is gone.
    std::vector<std::uint32_t> corners(std::uint64_t face) const {
        std::vector<std::uint32_t> vertices(emb_mesh_face_corner_count(m(), face));
        check(emb_mesh_half_edges(m(), vertices.empty() ? 0 : face_half_edge(face), vertices.size(), vertices.data(),
                                  nullptr, nullptr));
        return vertices;
    }

    /// All half-edges that leave a vertex, ascending.
    std::vector<std::uint32_t> outgoing(std::uint32_t vertex) const {
        std::vector<std::uint32_t> leaving(emb_mesh_vertex_half_edge_count(m(), vertex));
        for (std::size_t k = 0; k < leaving.size(); ++k) {
            leaving[k] = emb_mesh_vertex_half_edge(m(), vertex, k);
        }
        return leaving;
    }

    /// Measures an element.
    Measure measure(Element element) const {
        emb_mesh_measure c{};
        c.struct_size = sizeof c;
        check(emb_mesh_measure_get(m(), element.kind, element.index, &c));
        return {{c.normal[0], c.normal[1], c.normal[2]}, {c.centroid[0], c.centroid[1], c.centroid[2]}, c.size};
    }

    /// The signed distance from a point to one element alone.
    Nearest distance(Element element, const Point &point) const {
        Nearest nearest{};
        check(emb_mesh_distance(m(), element.kind, element.index, point.data(), &nearest.distance, nearest.point.data()));
        return nearest;
    }

    /// Whether a point lies in an input face: off the face's plane, whether its foot along the face's normal does.
    bool face_contains(std::uint64_t face, const Point &point, Inside how = Inside::Crossing) const {
        std::int32_t inside = 0;
        check(emb_mesh_face_contains(m(), face, point.data(), static_cast<std::int32_t>(how), &inside));
        return inside != 0;
    }

private:
    const emb_mesh *m() const noexcept { return mesh_.get(); }

    Mesh mesh_;
};

} // namespace embound

#endif
