// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Surface meshes: from files, from memory, from the caller's arrays.
#ifndef EMBOUND_MESH_HPP
#define EMBOUND_MESH_HPP

#include "run.hpp"
#include "views.hpp"

#include <memory>
#include <string>
#include <vector>

namespace embound {

/// What to do about the orientation of faces.
enum class Orient : std::int32_t {
    Auto = EMB_ORIENT_AUTO, ///< Made consistent and outward.
    Keep = EMB_ORIENT_KEEP, ///< As given: solvers that mean internal flow keep inward normals.
    Flip = EMB_ORIENT_FLIP, ///< Every face turned over, nothing else.
    Alternate = EMB_ORIENT_ALTERNATE ///< As Auto, but closed shells alternate with those around them.
};

/// How vertices and faces become a mesh: a point p of the input becomes
/// shift + scale * rotation * p, in double, before welding. Of meshes that stand, in join and transform, the
/// defaults weld and turn nothing.
struct MeshOptions {
    double scale = 1.0;                   ///< Uniform, > 0.
    Matrix rotation = identity;           ///< Row major.
    Point shift{0.0, 0.0, 0.0};           ///< After scale and rotation.
    double weld_tolerance = 0.0;          ///< Nearer vertices become one, as a part of the diagonal; 0: equal positions, -1: none.
    Orient orient = Orient::Auto;         ///< Orientation.
    std::int32_t format = EMB_FORMAT_DETECT; ///< EMB_FORMAT_DETECT: found by content.
    std::int32_t index_base = 0;          ///< First index of index arrays: 0 or 1.

    /// As the C functions take them.
    emb_mesh_options c() const {
        emb_mesh_options options;
        check(emb_mesh_options_init(&options, sizeof options));
        options.scale = scale;
        std::copy(rotation.begin(), rotation.end(), options.rotation);
        std::copy(shift.begin(), shift.end(), options.shift);
        options.weld_tolerance = weld_tolerance;
        options.orient = static_cast<std::int32_t>(orient);
        options.format = format;
        options.index_base = index_base;
        return options;
    }
};

/// What tags become where several meshes become one.
enum class JoinTags : std::int32_t {
    Keep = EMB_JOIN_KEEP,         ///< As they are; of several names of a tag the first stays.
    Renumber = EMB_JOIN_RENUMBER, ///< Numbered anew from 0, mesh after mesh; names go along.
    ByMesh = EMB_JOIN_BY_MESH     ///< The number of the mesh or file.
};

/// What a mesh is split by.
enum class SplitBy : std::int32_t {
    Tag = EMB_SPLIT_TAG,            ///< One mesh a tag, by rising tag.
    Component = EMB_SPLIT_COMPONENT ///< One mesh for what edges connect.
};

/// A polygon mesh: immutable, so any number of threads may use one at once. A copy is another
/// handle on the same mesh. A moved-from mesh is only good for assignment and destruction.
class Mesh {
public:
    /// Adopts a handle of the C functions.
    explicit Mesh(emb_mesh *mesh) : handle_(mesh, emb_mesh_free) {}

    /// Reads a file; the format is found by its content. Error: EMB_ERROR_IO where it cannot be
    /// read, EMB_ERROR_PARSE naming the offset or line where it is not what its format asks for.
    static Mesh read(const std::string &path, const MeshOptions &options = {}, const Run &run = {}) {
        const emb_mesh_options c = options.c();
        return from(run, [&](const emb_run *r, emb_mesh **out) { return emb_mesh_read(path.c_str(), &c, r, out); });
    }

    /// Reads the content of a file from memory: `size` bytes, not kept.
    static Mesh read_memory(const void *bytes, std::size_t size, const MeshOptions &options = {}, const Run &run = {}) {
        const emb_mesh_options c = options.c();
        return from(run, [&](const emb_run *r, emb_mesh **out) { return emb_mesh_read_memory(bytes, size, &c, r, out); });
    }

    /// Triangles: `xyz` holds x y z of each vertex, `indices` three vertices for each triangle,
    /// counterclockwise seen from outside, `tags` one number for each triangle or nothing.
    static Mesh from_triangles(Span<const double> xyz, Span<const std::uint32_t> indices, Span<const std::int32_t> tags = {},
                               const MeshOptions &options = {}) {
        const std::size_t vertices = thirds("xyz", xyz.size());
        const std::size_t triangles = thirds("indices", indices.size());
        const std::int32_t *tag = detail::wanted("tags", tags, triangles);
        const emb_mesh_options c = options.c();
        return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
            return emb_mesh_from_triangles(vertices, xyz.data(), triangles, indices.data(), tag, &c, out);
        }));
    }

    /// Triangles with vertices in f32.
    static Mesh from_triangles(Span<const float> xyz, Span<const std::uint32_t> indices, Span<const std::int32_t> tags = {},
                               const MeshOptions &options = {}) {
        const std::size_t vertices = thirds("xyz", xyz.size());
        const std::size_t triangles = thirds("indices", indices.size());
        const std::int32_t *tag = detail::wanted("tags", tags, triangles);
        const emb_mesh_options c = options.c();
        return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
            return emb_mesh_from_triangles_f32(vertices, xyz.data(), triangles, indices.data(), tag, &c, out);
        }));
    }

    /// Planar polygons: face f has the vertices indices[offsets[f]] to indices[offsets[f + 1] - 1].
    static Mesh from_polygons(Span<const double> xyz, Span<const std::size_t> offsets, Span<const std::uint32_t> indices,
                              Span<const std::int32_t> tags = {}, const MeshOptions &options = {}) {
        const std::size_t vertices = thirds("xyz", xyz.size());
        if (offsets.empty() || offsets[offsets.size() - 1] != indices.size()) {
            throw Error(EMB_ERROR_INVALID_ARGUMENT,
                        "offsets: the last is not the " + std::to_string(indices.size()) + " of indices");
        }
        const std::size_t faces = offsets.size() - 1;
        const std::int32_t *tag = detail::wanted("tags", tags, faces);
        const emb_mesh_options c = options.c();
        return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
            return emb_mesh_from_polygons(vertices, xyz.data(), faces, offsets.data(), indices.data(), tag, &c, out);
        }));
    }

    /// Reads several files into one mesh.
    static Mesh read_files(const std::vector<std::string> &paths, JoinTags tags = JoinTags::Renumber,
                           const MeshOptions &options = {}, const Run &run = {}) {
        std::vector<const char *> names;
        for (const std::string &path : paths) {
            names.push_back(path.c_str());
        }
        const emb_mesh_options c = options.c();
        return from(run, [&](const emb_run *r, emb_mesh **out) {
            return emb_mesh_read_files(names.size(), names.data(), static_cast<std::int32_t>(tags), &c, r, out);
        });
    }

    /// Several meshes as one, placed as the options say. Each keeps its vertices and its orientation; a
    /// weld_tolerance above 0 (1e-12: equal positions) welds them together and orients as `orient` says.
    static Mesh join(const std::vector<Mesh> &meshes, JoinTags tags = JoinTags::Renumber, const MeshOptions &options = {}) {
        std::vector<const emb_mesh *> parts;
        for (const Mesh &mesh : meshes) {
            parts.push_back(mesh.get());
        }
        const emb_mesh_options c = options.c();
        return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
            return emb_mesh_join(parts.size(), parts.data(), static_cast<std::int32_t>(tags), &c, out);
        }));
    }

    /// The same surface, scaled, rotated and shifted; Orient::Flip turns it over. Vertices and orientation stay, unless
    /// asked for as in join. Data stay as they are: vectors are not rotated along.
    Mesh transform(const MeshOptions &options) const {
        const emb_mesh_options c = options.c();
        return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) { return emb_mesh_transform(get(), &c, out); }));
    }

    /// In parts, which keep orientation, tags and data; faces are numbered anew in each.
    std::vector<Mesh> split(SplitBy by) const {
        std::size_t count = 0;
        check(emb_mesh_split(get(), static_cast<std::int32_t>(by), 0, nullptr, &count));
        std::vector<emb_mesh *> handles = detail::vector_of<emb_mesh *>(count);
        // Every handle has an owner before anything can be thrown again.
        std::vector<Owned> owned = detail::vector_of<Owned>(count);
        check(emb_mesh_split(get(), static_cast<std::int32_t>(by), count, handles.data(), &count));
        for (std::size_t k = 0; k < count; ++k) {
            owned[k].reset(handles[k]);
        }
        return detail::allocated("parts", [&] {
            std::vector<Mesh> parts;
            parts.reserve(count);
            for (Owned &handle : owned) {
                parts.emplace_back(handle.release());
            }
            return parts;
        });
    }

    std::size_t vertex_count() const noexcept { return emb_mesh_vertex_count(get()); }     ///< Vertices after welding.
    std::size_t face_count() const noexcept { return emb_mesh_face_count(get()); }         ///< Numbers of input faces.
    std::size_t triangle_count() const noexcept { return emb_mesh_triangle_count(get()); } ///< Triangles of all faces.

    /// Whether the mesh as it stands has an inside, so that from_mesh gives it a sign. At no cost.
    bool has_inside() const noexcept { return emb_mesh_has_inside(get()) != 0; }

    /// The positions of all vertices: those that welding left, in the order of those given; see emb_mesh_vertices.
    std::vector<Point> vertices() const {
        std::vector<Point> positions = detail::vector_of<Point>(vertex_count());
        check(emb_mesh_vertices(get(), 0, positions.size(), detail::flat(positions.data())));
        return positions;
    }

    /// Whether orientation turned an input face over: triangles() and half-edges then have its corners the other way
    /// round, corners 1 and 2 of a triangle exchanged, while barycentric and feature of a closest point are of the
    /// corners given.
    bool is_turned(std::int64_t face) const noexcept { return emb_mesh_face_is_turned(get(), face) != 0; }

    /// The vertices of all triangles, three each, counter-clockwise seen from outside: not as given where is_turned().
    std::vector<std::uint32_t> triangles() const {
        std::vector<std::uint32_t> corners = detail::vector_of<std::uint32_t>(3 * triangle_count());
        check(emb_mesh_triangles(get(), 0, triangle_count(), corners.data(), nullptr));
        return corners;
    }

    /// The input face that each triangle is cut from, in the order of triangles().
    std::vector<std::int64_t> triangle_faces() const {
        std::vector<std::int64_t> faces = detail::vector_of<std::int64_t>(triangle_count());
        check(emb_mesh_triangles(get(), 0, faces.size(), nullptr, faces.data()));
        return faces;
    }

    /// Writes a file of the format its extension names: .stl, .ply, .obj, .vtk or .vtp. Vertices that repair split, and
    /// an orientation that is kept, are undone where it is read with default options; see emb_mesh_write, also for
    /// the names of data that a format refuses.
    void write(const std::string &path) const { check(emb_mesh_write(get(), path.c_str())); }

    /// What the mesh was like as read, before orientation: counts, volume, area, bounds.
    emb_mesh_report report() const {
        emb_mesh_report report{};
        report.struct_size = sizeof report;
        check(emb_mesh_report_get(get(), &report));
        return report;
    }

    /// Lends the handle: valid as long as a copy of this mesh is.
    const emb_mesh *get() const noexcept { return handle_.get(); }

private:
    struct Free {
        void operator()(emb_mesh *mesh) const noexcept { emb_mesh_free(mesh); }
    };
    using Owned = std::unique_ptr<emb_mesh, Free>;

    template <class Create> static Mesh from(const Run &run, Create &&create) {
        emb_mesh *mesh = nullptr;
        detail::call(run, [&](const emb_run *r) { return create(r, &mesh); });
        return Mesh(mesh);
    }

    static std::size_t thirds(const char *name, std::size_t size) {
        if (size % 3 != 0) {
            throw Error(EMB_ERROR_INVALID_ARGUMENT, std::string(name) + ": " + std::to_string(size) + " is not a multiple of 3");
        }
        return size / 3;
    }

    std::shared_ptr<emb_mesh> handle_;
};

} // namespace embound

#endif
