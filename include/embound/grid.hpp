// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Values over a lattice as files for ParaView and VisIt.
#ifndef EMBOUND_GRID_HPP
#define EMBOUND_GRID_HPP

#include "views.hpp"

#include <string>
#include <vector>

namespace embound {

/// Named values at the points of a lattice: double, float, std::int32_t or std::int8_t, tight or with strides.
struct GridField {
    std::string name;           ///< One line.
    ConstArrayOfAnyType values; ///< Only read, and not copied: they must outlive the call.
};

/// Writes fields over a lattice to `path`, as emb_lattice_write does: ".vti" where the steps of each axis are
/// even, ".vtr" for any axes that rise.
///
///     embound::write_grid("levels.vti", lattice, {{"distance", distances}, {"part", parts}});
inline void write_grid(const std::string &path, const Lattice &lattice, const std::vector<GridField> &fields) {
    const emb_lattice l = lattice.c();
    const std::size_t points = lattice.points();
    std::vector<const char *> names;
    std::vector<emb_array> arrays;
    for (const GridField &field : fields) {
        names.push_back(field.name.c_str());
        arrays.push_back(field.values.c(field.name.c_str(), points));
    }
    check(emb_lattice_write(&l, path.c_str(), fields.size(), names.data(), arrays.data()));
}

} // namespace embound

#endif
