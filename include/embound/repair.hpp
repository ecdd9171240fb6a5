// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Repair of meshes.
#ifndef EMBOUND_REPAIR_HPP
#define EMBOUND_REPAIR_HPP

#include "mesh.hpp"

#include <optional>

namespace embound {

/// What to repair, and within which bounds; see emb_repair_options.
struct RepairOptions {
    std::int32_t flags = EMB_REPAIR_ALL;  ///< EMB_REPAIR_* flags.
    double weld_tolerance = 0.0;          ///< Of the diagonal; 0: equal positions.
    std::size_t hole_edges = 1000;        ///< Holes with more edges stay; at most 2,048.
    double hole_length = 0.5;             ///< Longer rims stay, as a part of their component's diagonal; see C.
    std::optional<std::int32_t> fill_tag; ///< The tag of new triangles; none: that of most faces round the hole.

    /// As the C functions take them.
    emb_repair_options c() const {
        emb_repair_options options;
        check(emb_repair_options_init(&options, sizeof options));
        options.flags = flags;
        options.weld_tolerance = weld_tolerance;
        options.hole_edges = hole_edges;
        options.hole_length = hole_length;
        options.fill_tag_rule = fill_tag ? EMB_FILL_TAG_GIVEN : EMB_FILL_TAG_AROUND;
        options.fill_tag = fill_tag.value_or(0);
        return options;
    }
};

/// A repaired mesh, and what was done.
struct Repaired {
    Mesh mesh;                ///< The mesh; faces keep their numbers.
    emb_repair_result result; ///< How often each step did something.
};

/// Repairs what the options ask for, and nothing else; `mesh` stays as it is. Triangles that fill holes have as data of
/// faces NaN, or 0 where its type is an integer. Vertices that were split are welded again where the mesh is written to a
/// file and read with the default weld_tolerance; Mesh::transform and Mesh::join leave them apart.
inline Repaired repair(const Mesh &mesh, const RepairOptions &options = {}, const Run &run = {}) {
    const emb_repair_options c = options.c();
    emb_repair_result result{};
    result.struct_size = sizeof result;
    emb_mesh *out = nullptr;
    detail::call(run, [&](const emb_run *r) { return emb_mesh_repair(mesh.get(), &c, r, &result, &out); });
    return {Mesh(out), result};
}

} // namespace embound

#endif
