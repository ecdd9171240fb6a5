// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Geometries as blocks of bytes and as files, which ranks send each other or share.
#ifndef EMBOUND_PACK_HPP
#define EMBOUND_PACK_HPP

#include "geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace embound {

/// What is looked at when a geometry is unpacked or opened.
enum class UnpackCheck : std::int32_t {
    Check = 0,               ///< Every byte: damage is an error.
    Trust = EMB_UNPACK_TRUST ///< Header and nodes alone: the caller knows that the arrays are whole.
};

/// The size of pack(g) in bytes. O(nodes).
inline std::size_t packed_size(const Geometry &g) {
    std::size_t size = 0;
    check(emb_geom_pack(g.get(), 0, nullptr, &size));
    return size;
}

/// Writes the block of a geometry to where there is room for packed_size(g) bytes or more, such as a window of memory that
/// the ranks of a node share; returns how many it has. Errors as of emb_geom_pack.
inline std::size_t pack(const Geometry &g, Span<std::byte> out) {
    std::size_t size = 0;
    // 0 would ask for the size.
    check(emb_geom_pack(g.get(), out.empty() ? 1 : out.size(), out.data(), &size));
    return size;
}

/// The block of a geometry: the same bytes in every process.
inline std::vector<std::byte> pack(const Geometry &g) {
    std::vector<std::byte> block = detail::vector_of<std::byte>(packed_size(g));
    pack(g, block);
    return block;
}

/// The geometry of a block, which is copied. Errors as of emb_geom_unpack.
inline Geometry unpack(Span<const std::byte> block, UnpackCheck what = UnpackCheck::Check) {
    return detail::made([&](emb_geom **out) {
        return emb_geom_unpack(block.data(), block.size(), static_cast<std::int32_t>(what), nullptr, nullptr, out);
    });
}

/// The geometry of a block that is not copied. It begins at a multiple of 64 bytes and stays unchanged until `owner`, of
/// which a copy is kept as long as any geometry uses the block, is destroyed: on any thread, and it must not throw.
template <class Owner>
Geometry unpack_borrowed(Span<const std::byte> block, Owner owner, UnpackCheck what = UnpackCheck::Check) {
    auto kept = std::make_unique<Owner>(std::move(owner));
    const std::int32_t flags = EMB_UNPACK_BORROW | static_cast<std::int32_t>(what);
    const emb_drop_fn drop = [](void *user) { delete static_cast<Owner *>(user); };
    Geometry g = detail::made([&](emb_geom **out) {
        return emb_geom_unpack(block.data(), block.size(), flags, drop, kept.get(), out);
    });
    static_cast<void>(kept.release());
    return g;
}

/// Writes the block of a geometry to a file. Errors as of emb_geom_save.
inline void save(const Geometry &g, const std::string &path, const Run &run = {}) {
    detail::call(run, [&](const emb_run *r) { return emb_geom_save(g.get(), path.c_str(), r); });
}

/// The geometry of such a file, which is mapped: processes share its memory. With UnpackCheck::Trust that takes milliseconds.
/// The file must not be changed while it is in use. Errors as of emb_geom_open.
inline Geometry open(const std::string &path, UnpackCheck what = UnpackCheck::Check, const Run &run = {}) {
    emb_geom *geometry = nullptr;
    detail::call(run, [&](const emb_run *r) {
        return emb_geom_open(path.c_str(), static_cast<std::int32_t>(what), r, &geometry);
    });
    return Geometry(geometry);
}

} // namespace embound

#endif
