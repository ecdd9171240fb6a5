// SPDX-License-Identifier: MIT OR Apache-2.0
// Geometries as blocks and files: copies, borrowed blocks with an owner, maps.
#include "support/check.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

// A block at a multiple of 64 bytes.
struct Aligned {
    explicit Aligned(std::size_t size) : bytes(static_cast<std::byte *>(std::aligned_alloc(64, size)), std::free) {}
    std::shared_ptr<std::byte> bytes;
};

embound::Geometry body() {
    std::vector<embound::Geometry> balls;
    for (int k = 0; k < 50; ++k) {
        balls.push_back(embound::sphere({0.1 * k, 0.3 * (k % 7), 0.2 * (k % 3)}, 0.09));
    }
    return embound::unite(balls);
}

bool same(const embound::Geometry &a, const embound::Geometry &b) {
    bool all = emb_geom_fingerprint(a.get()) == emb_geom_fingerprint(b.get());
    for (int k = 0; k < 100; ++k) {
        const double x = 0.07 * k - 1.0, y = 0.02 * k, z = 0.5 - 0.01 * k;
        all = all && check::same_bits(a(x, y, z), b(x, y, z));
    }
    return all;
}

} // namespace

TEST(blocks_come_back) {
    const embound::Geometry g = body();
    std::vector<std::byte> block = embound::pack(g);
    CHECK(block.size() == embound::packed_size(g));
    CHECK(same(g, embound::unpack(block)));
    CHECK(same(g, embound::unpack(block, embound::UnpackCheck::Trust)));
    block[block.size() / 2] ^= std::byte{1};
    CHECK(check::status_of([&] { embound::unpack(block); }) == EMB_ERROR_PARSE);
    std::vector<std::byte> small(10);
    CHECK(check::status_of([&] { embound::pack(g, small); }) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(check::status_of([&] { embound::pack(g, {}); }) == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(borrowed_blocks_live_as_long_as_they_are_used) {
    const embound::Geometry g = body();
    std::weak_ptr<std::byte> watched;
    embound::Geometry moved;
    {
        Aligned window(embound::packed_size(g));
        watched = window.bytes;
        const embound::Span<std::byte> bytes(window.bytes.get(), embound::packed_size(g));
        CHECK(embound::pack(g, bytes) == bytes.size());
        const embound::Geometry lent = embound::unpack_borrowed(bytes, window);
        CHECK(same(g, lent));
        moved = embound::translate(lent, {1.0, 0.0, 0.0});
    }
    CHECK(!watched.expired() && check::same_bits(moved(1.5, 0.1, 0.2), g(0.5, 0.1, 0.2)));
    moved = {};
    CHECK(watched.expired());
}

TEST(files_are_mapped) {
    const embound::Geometry g = body();
    const char *directory = std::getenv("TMPDIR");
    const std::string path =
        std::string(directory == nullptr ? "/tmp" : directory) + "/embound-cpp-" + std::to_string(getpid()) + ".packed";
    embound::save(g, path);
    const embound::Geometry mapped = embound::open(path);
    const embound::Geometry trusted = embound::open(path, embound::UnpackCheck::Trust);
    std::remove(path.c_str());
    CHECK(same(g, mapped) && same(g, trusted));
    CHECK(check::status_of([&] { embound::open(path); }) == EMB_ERROR_IO);
}
