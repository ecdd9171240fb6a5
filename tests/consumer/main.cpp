// SPDX-License-Identifier: MIT OR Apache-2.0
// The body of main.c through embound.hpp; it must print the same.
#include <embound.hpp>
#include <cstdio>
#include <vector>

int main() {
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const std::vector<std::uint32_t> triangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                               2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    try {
        const embound::Mesh mesh = embound::Mesh::from_triangles(corners, triangles);
        const embound::Geometry sphere = embound::sphere({0.5, 0.5, 1.0}, 0.3);
        const embound::Geometry pocket = embound::difference(embound::from_mesh(mesh), sphere);
        for (int i = 0; i < 27; i++) {
            std::printf("%a\n", pocket(0.1 + 0.45 * (i % 3), 0.2 + 0.33 * (i / 3 % 3), 0.3 + 0.37 * (i / 9)));
        }
        std::printf("version %u\n", static_cast<unsigned>(emb_version_number()));
    } catch (const embound::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
