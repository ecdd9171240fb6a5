// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Tags of faces with their names, and named data of vertices and faces, also at points of the surface.
#ifndef EMBOUND_DATA_HPP
#define EMBOUND_DATA_HPP

#include "answers.hpp"
#include "mesh.hpp"

#include <string>
#include <utility>
#include <vector>

namespace embound {

/// What carries named data.
enum class On : std::int32_t {
    Vertices = EMB_ON_VERTICES, ///< The vertices: interpolated over a face.
    Faces = EMB_ON_FACES        ///< The faces: constant over each.
};

/// Named data of a mesh.
struct Field {
    std::string name;       ///< As in the file.
    On on;                  ///< What carries them.
    std::size_t index;      ///< Their number, for the C functions.
    std::size_t components; ///< Numbers an item.
    std::size_t count;      ///< Items; see emb_mesh_field.
};

/// The different tags of the faces, ascending.
inline std::vector<std::int32_t> tags(const Mesh &mesh) {
    std::size_t count = 0;
    check(emb_mesh_tags(mesh.get(), 0, nullptr, &count));
    std::vector<std::int32_t> all(count);
    check(emb_mesh_tags(mesh.get(), count, all.data(), &count));
    return all;
}

/// The tag of each input face.
inline std::vector<std::int32_t> face_tags(const Mesh &mesh) {
    std::vector<std::int32_t> all(mesh.face_count());
    check(emb_mesh_face_tags(mesh.get(), 0, all.size(), all.data()));
    return all;
}

/// The name of a tag; empty where it has none.
inline std::string tag_name(const Mesh &mesh, std::int32_t tag) {
    return detail::text([&](std::size_t capacity, char *out, std::size_t *size) {
        return emb_mesh_tag_name(mesh.get(), tag, capacity, out, size);
    });
}

/// The mesh with other tags, one for each input face, and names for some of them. tag_name tells the name of a tag that
/// no face has, too; tags does not list such a tag.
inline Mesh with_tags(const Mesh &mesh, Span<const std::int32_t> tags,
                      const std::vector<std::pair<std::int32_t, std::string>> &names = {}) {
    detail::require_size("tags", tags.size(), mesh.face_count());
    std::vector<std::int32_t> named;
    std::vector<const char *> texts;
    for (const auto &[tag, name] : names) {
        named.push_back(tag);
        texts.push_back(name.c_str());
    }
    return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
        return emb_mesh_with_tags(mesh.get(), tags.data(), named.size(), named.data(), texts.data(), out);
    }));
}

/// The named data of the vertices or faces.
inline std::vector<Field> fields(const Mesh &mesh, On on) {
    const std::int32_t c_on = static_cast<std::int32_t>(on);
    std::size_t count = 0;
    check(emb_mesh_field_count(mesh.get(), c_on, &count));
    std::vector<Field> all;
    for (std::size_t k = 0; k < count; ++k) {
        emb_mesh_field c{};
        c.struct_size = sizeof c;
        std::string name = detail::text([&](std::size_t capacity, char *out, std::size_t *size) {
            return emb_mesh_field_get(mesh.get(), c_on, k, &c, capacity, out, size);
        });
        all.push_back({std::move(name), on, k, c.components, c.count});
    }
    return all;
}

/// The named data of one name; Error where there are none.
inline Field field(const Mesh &mesh, On on, const std::string &name) {
    for (Field &known : fields(mesh, on)) {
        if (known.name == name) {
            return std::move(known);
        }
    }
    throw Error(EMB_ERROR_INVALID_ARGUMENT, "name: the mesh has no field \"" + name + "\" there");
}

namespace detail {

/// Results are sized by what `field` says, so it must be of this mesh.
inline void require_field(const Mesh &mesh, const Field &field) {
    emb_mesh_field c{};
    c.struct_size = sizeof c;
    const std::string name = text([&](std::size_t capacity, char *out, std::size_t *size) {
        return emb_mesh_field_get(mesh.get(), static_cast<std::int32_t>(field.on), field.index, &c, capacity, out, size);
    });
    if (field.name != name) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT,
                    "field: \"" + field.name + "\" is of another mesh; in its place this one has \"" + name + "\"");
    }
    if (c.components != field.components) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT, "field: \"" + field.name + "\" has " + std::to_string(field.components) +
                                                    " components, the data of this mesh " + std::to_string(c.components));
    }
}

} // namespace detail

/// All values of named data, item after item.
inline std::vector<double> values(const Mesh &mesh, const Field &field) {
    detail::require_field(mesh, field);
    std::vector<double> all = detail::vector_of<double>(field.components * field.count);
    check(emb_mesh_field_values(mesh.get(), static_cast<std::int32_t>(field.on), field.index, 0, field.count, all.data()));
    return all;
}

/// The mesh with one more named field: `values` holds the same number of numbers for each vertex as it stands or for
/// each input face. Vertices as they stand are those that welding left: for data of the vertices given, make the mesh
/// with weld_tolerance -1, add the data, and weld with repair.
inline Mesh with_field(const Mesh &mesh, On on, const std::string &name, Span<const double> values) {
    const std::size_t items = on == On::Faces ? mesh.face_count() : mesh.vertex_count();
    if (items == 0 || values.size() % items != 0) {
        const std::string each = on == On::Faces ? " input faces" : " vertices, those left after welding (weld_tolerance -1 leaves all)";
        throw Error(EMB_ERROR_INVALID_ARGUMENT, "values: " + std::to_string(values.size()) + " are not the same number for each of " +
                                                    std::to_string(items) + each);
    }
    return Mesh(detail::created<emb_mesh>([&](emb_mesh **out) {
        return emb_mesh_with_field(mesh.get(), static_cast<std::int32_t>(on), name.c_str(), values.size() / items,
                                   values.data(), out);
    }));
}

/// Named data at the closest points that Geometry::closest found: `components` numbers a point, NaN where
/// there is no face. A face is told by its number alone: at points of a union, `mesh` must be the one that the closest
/// part was made of, else the values are those of another place, with no error. `closest.part` says which part it is,
/// where the parts were labelled by part(). Of `closest` only primitive, piece (empty: 0 throughout) and, for data of vertices,
/// barycentric are read.
inline std::vector<double> interpolate(const Mesh &mesh, const Field &field, const Closest &closest, const Run &run = {}) {
    detail::require_field(mesh, field);
    const std::size_t n = closest.primitive.size();
    const double *axes[3] = {nullptr, nullptr, nullptr};
    if (field.on == On::Vertices && n > 0) {
        detail::require_size("closest.barycentric", closest.barycentric.size(), n);
        const double *weights = detail::flat(closest.barycentric.data());
        axes[0] = weights, axes[1] = weights + 1, axes[2] = weights + 2;
    }
    if (!closest.piece.empty()) {
        detail::require_size("closest.piece", closest.piece.size(), n);
    }
    std::vector<double> out = detail::vector_of<double>(n * field.components);
    detail::call(run, [&](const emb_run *r) {
        return emb_mesh_interpolate(mesh.get(), static_cast<std::int32_t>(field.on), field.index, n, closest.primitive.data(),
                                    closest.piece.empty() ? nullptr : closest.piece.data(), axes, 3, r, out.data());
    });
    return out;
}

} // namespace embound

#endif
