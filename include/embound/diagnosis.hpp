// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// What is the matter with a mesh as read, fault by fault, and as text.
#ifndef EMBOUND_DIAGNOSIS_HPP
#define EMBOUND_DIAGNOSIS_HPP

#include "data.hpp"
#include "mesh.hpp"

#include <array>

namespace embound {

/// What a diagnosis looks for; see emb_diagnosis_options.
struct DiagnosisOptions {
    double sliver_ratio = 1e-3;                 ///< Smallest height over longest edge of a sliver is below.
    double off_plane_ratio = 0.0;               ///< Polygons farther off a plane are listed; 0: not looked for.
    std::uint64_t intersection_limit = 1000000; ///< Most pairs that intersect to list; 0: not looked for.

    /// As the C functions take them.
    emb_diagnosis_options c() const {
        emb_diagnosis_options options;
        check(emb_diagnosis_options_init(&options, sizeof options));
        options.sliver_ratio = sliver_ratio;
        options.off_plane_ratio = off_plane_ratio;
        options.intersection_limit = intersection_limit;
        return options;
    }
};

/// An edge of more than two faces.
struct NonmanifoldEdge {
    std::array<std::uint32_t, 2> vertices; ///< The lower first.
    std::vector<std::int64_t> faces;       ///< The faces at it.
};

/// An edge that two faces run along the same way.
struct InconsistentEdge {
    std::array<std::uint32_t, 2> vertices; ///< The lower first.
    std::array<std::int64_t, 2> faces;     ///< The lower first.
};

/// A vertex at which the faces do not form one fan or one disc.
struct NonmanifoldVertex {
    std::uint32_t vertex; ///< The vertex.
    std::uint32_t fans;   ///< The fans and discs that the faces form.
};

/// A face that repeats an earlier one.
struct Duplicate {
    std::int64_t face;     ///< The face.
    std::int64_t original; ///< The earliest that it repeats.
    bool same_way;         ///< Whether both run the same way.
};

/// A face, and a number that says how bad it is.
struct FaceMeasure {
    std::int64_t face; ///< The face.
    double ratio;      ///< The number.
};

/// What is the matter with a mesh as read. Immutable; a copy is another handle on the same diagnosis. Faces are input
/// faces, vertices are numbered as those of the mesh. Does not need the mesh any more.
class Diagnosis {
public:
    /// Diagnoses a mesh; see emb_mesh_diagnose.
    explicit Diagnosis(const Mesh &mesh, const DiagnosisOptions &options = {}, const Run &run = {})
        : Diagnosis(made(mesh, options, run)) {}

    /// Adopts a handle of the C functions.
    explicit Diagnosis(emb_diagnosis *diagnosis) : handle_(diagnosis, emb_diagnosis_free) {}

    /// The report of the mesh, with self_intersections where they were looked for.
    emb_mesh_report report() const {
        emb_mesh_report report{};
        report.struct_size = sizeof report;
        check(emb_diagnosis_report(get(), &report));
        return report;
    }

    /// The counts beyond the report.
    emb_diagnosis_summary summary() const {
        emb_diagnosis_summary summary{};
        summary.struct_size = sizeof summary;
        check(emb_diagnosis_summary_get(get(), &summary));
        return summary;
    }

    /// For a reader: a fact a line, at the end what to do.
    std::string text() const {
        return detail::text([&](std::size_t capacity, char *out, std::size_t *size) {
            return emb_diagnosis_text(get(), capacity, out, size);
        });
    }

    /// Edges of more than two faces.
    std::vector<NonmanifoldEdge> nonmanifold_edges() const {
        std::size_t count = size([&](std::size_t *n) { return emb_diagnosis_nonmanifold_edges(get(), 0, nullptr, nullptr, n); });
        std::vector<std::uint32_t> vertices = detail::vector_of<std::uint32_t>(2 * count);
        check(emb_diagnosis_nonmanifold_edges(get(), count, vertices.data(), nullptr, &count));
        std::vector<NonmanifoldEdge> edges = detail::vector_of<NonmanifoldEdge>(count);
        for (std::size_t k = 0; k < count; ++k) {
            edges[k].vertices = {vertices[2 * k], vertices[2 * k + 1]};
            edges[k].faces = list<std::int64_t>([&](std::size_t capacity, std::int64_t *out, std::size_t *n) {
                return emb_diagnosis_nonmanifold_edge_faces(get(), k, capacity, out, n);
            });
        }
        return edges;
    }

    /// Edges that two faces run along the same way.
    std::vector<InconsistentEdge> inconsistent_edges() const {
        std::size_t count = size([&](std::size_t *n) { return emb_diagnosis_inconsistent_edges(get(), 0, nullptr, nullptr, n); });
        std::vector<std::uint32_t> vertices = detail::vector_of<std::uint32_t>(2 * count);
        std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(2 * count);
        check(emb_diagnosis_inconsistent_edges(get(), count, vertices.data(), faces.data(), &count));
        std::vector<InconsistentEdge> edges = detail::vector_of<InconsistentEdge>(count);
        for (std::size_t k = 0; k < count; ++k) {
            edges[k] = {{vertices[2 * k], vertices[2 * k + 1]}, {faces[2 * k], faces[2 * k + 1]}};
        }
        return edges;
    }

    /// Vertices at which the faces do not form one fan or one disc.
    std::vector<NonmanifoldVertex> nonmanifold_vertices() const {
        std::size_t count = size([&](std::size_t *n) { return emb_diagnosis_nonmanifold_vertices(get(), 0, nullptr, nullptr, n); });
        std::vector<std::uint32_t> vertices = detail::vector_of<std::uint32_t>(count);
        std::vector<std::uint32_t> fans = detail::vector_of<std::uint32_t>(count);
        check(emb_diagnosis_nonmanifold_vertices(get(), count, vertices.data(), fans.data(), &count));
        std::vector<NonmanifoldVertex> all = detail::vector_of<NonmanifoldVertex>(count);
        for (std::size_t k = 0; k < count; ++k) {
            all[k] = {vertices[k], fans[k]};
        }
        return all;
    }

    /// Faces that welding took corners from.
    std::vector<std::int64_t> shrunk_faces() const {
        return list<std::int64_t>([&](std::size_t capacity, std::int64_t *out, std::size_t *n) {
            return emb_diagnosis_shrunk_faces(get(), capacity, out, n);
        });
    }

    /// Faces of exactly zero area.
    std::vector<std::int64_t> flat_faces() const {
        return list<std::int64_t>([&](std::size_t capacity, std::int64_t *out, std::size_t *n) {
            return emb_diagnosis_flat_faces(get(), capacity, out, n);
        });
    }

    /// Faces that repeat an earlier one.
    std::vector<Duplicate> duplicates() const {
        std::size_t count = size([&](std::size_t *n) { return emb_diagnosis_duplicates(get(), 0, nullptr, nullptr, nullptr, n); });
        std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(count);
        std::vector<std::int64_t> originals = detail::vector_of<std::int64_t>(count);
        std::vector<std::int32_t> ways = detail::vector_of<std::int32_t>(count);
        check(emb_diagnosis_duplicates(get(), count, faces.data(), originals.data(), ways.data(), &count));
        std::vector<Duplicate> all = detail::vector_of<Duplicate>(count);
        for (std::size_t k = 0; k < count; ++k) {
            all[k] = {faces[k], originals[k], ways[k] != 0};
        }
        return all;
    }

    /// Faces of hardly any area, each with its smallest height over its longest edge.
    std::vector<FaceMeasure> slivers() const { return measures(emb_diagnosis_slivers); }

    /// Faces that the report counts as warped, each with how far it is off a plane, over the diagonal of its box.
    std::vector<FaceMeasure> warped_faces() const { return measures(emb_diagnosis_warped_faces); }

    /// Faces off a plane by more than asked for, each with how far, over the diagonal of its box.
    std::vector<FaceMeasure> off_plane_faces() const { return measures(emb_diagnosis_off_plane_faces); }

    /// Pairs of faces that intersect, the lower first.
    std::vector<std::array<std::int64_t, 2>> intersections() const {
        std::size_t count = size([&](std::size_t *n) { return emb_diagnosis_intersections(get(), 0, nullptr, n); });
        std::vector<std::array<std::int64_t, 2>> pairs = detail::vector_of<std::array<std::int64_t, 2>>(count);
        check(emb_diagnosis_intersections(get(), count, pairs.empty() ? nullptr : pairs.data()->data(), &count));
        return pairs;
    }

    /// The sets of faces connected over edges, by lowest face.
    std::vector<emb_mesh_component> components() const {
        std::vector<emb_mesh_component> all = detail::vector_of<emb_mesh_component>(summary().components);
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k].struct_size = sizeof all[k];
            check(emb_diagnosis_component(get(), k, &all[k]));
        }
        return all;
    }

    /// The component of each input face; EMB_NO_INDEX for faces that are gone.
    std::vector<std::uint32_t> face_components() const {
        return list<std::uint32_t>([&](std::size_t capacity, std::uint32_t *out, std::size_t *n) {
            return emb_diagnosis_face_components(get(), capacity, out, n);
        });
    }

    /// The chains of boundary edges, by lowest vertex.
    std::vector<emb_mesh_loop> loops() const {
        std::vector<emb_mesh_loop> all = detail::vector_of<emb_mesh_loop>(summary().boundary_loops);
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k].struct_size = sizeof all[k];
            check(emb_diagnosis_loop(get(), k, &all[k]));
        }
        return all;
    }

    /// The vertices of a loop, in order.
    std::vector<std::uint32_t> loop_vertices(std::size_t loop) const {
        return list<std::uint32_t>([&](std::size_t capacity, std::uint32_t *out, std::size_t *n) {
            return emb_diagnosis_loop_vertices(get(), loop, capacity, out, n);
        });
    }

    /// Lends the handle: valid as long as a copy of this diagnosis is.
    const emb_diagnosis *get() const noexcept { return handle_.get(); }

private:
    static emb_diagnosis *made(const Mesh &mesh, const DiagnosisOptions &options, const Run &run) {
        const emb_diagnosis_options c = options.c();
        emb_diagnosis *out = nullptr;
        detail::call(run, [&](const emb_run *r) { return emb_mesh_diagnose(mesh.get(), &c, r, &out); });
        return out;
    }

    template <class Call> static std::size_t size(Call &&call) {
        std::size_t count = 0;
        check(call(&count));
        return count;
    }

    template <class T, class Call> static std::vector<T> list(Call &&call) {
        std::size_t count = size([&](std::size_t *n) { return call(0, nullptr, n); });
        std::vector<T> all = detail::vector_of<T>(count);
        check(call(count, all.data(), &count));
        return all;
    }

    template <class Getter> std::vector<FaceMeasure> measures(Getter getter) const {
        std::size_t count = size([&](std::size_t *n) { return getter(get(), 0, nullptr, nullptr, n); });
        std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(count);
        std::vector<double> ratios = detail::vector_of<double>(count);
        check(getter(get(), count, faces.data(), ratios.data(), &count));
        std::vector<FaceMeasure> all = detail::vector_of<FaceMeasure>(count);
        for (std::size_t k = 0; k < count; ++k) {
            all[k] = {faces[k], ratios[k]};
        }
        return all;
    }

    std::shared_ptr<emb_diagnosis> handle_;
};

} // namespace embound

#endif
