/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/* Builds a unit cube with a spherical pocket and prints its values at a few points, bit for bit; every
   program of the consumer test, in C or C++, shared or static, must print the same. With an argument
   it also writes the cube there, for the example in the README. */
#include <embound.h>
#include <stdio.h>

static int check(emb_status status, const char *what) {
    if (status != EMB_OK) fprintf(stderr, "%s: status %d: %s\n", what, (int)status, emb_last_error());
    return status == EMB_OK;
}

int main(int argc, char **argv) {
    static const double corners[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    static const uint32_t triangles[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    static const double center[3] = {0.5, 0.5, 1.0};
    emb_mesh *mesh = NULL;
    emb_geom *cube = NULL, *sphere = NULL, *pocket = NULL;
    double x[27], y[27], z[27], values[27];
    int i, good;

    good = check(emb_mesh_from_triangles(8, corners, 12, triangles, NULL, NULL, &mesh), "mesh") &&
           (argc < 2 || check(emb_mesh_write(mesh, argv[1]), argv[1])) &&
           check(emb_geom_from_mesh(mesh, NULL, NULL, &cube), "cube") &&
           check(emb_geom_sphere(center, 0.3, &sphere), "sphere") &&
           check(emb_geom_difference(cube, sphere, &pocket), "difference");
    for (i = 0; i < 27; i++) {
        x[i] = 0.1 + 0.45 * (i % 3);
        y[i] = 0.2 + 0.33 * (i / 3 % 3);
        z[i] = 0.3 + 0.37 * (i / 9);
    }
    good = good && check(emb_geom_values(pocket, 27, x, y, z, 1, NULL, values), "values");
    for (i = 0; good && i < 27; i++) {
        if (values[i] != emb_geom_value(pocket, x[i], y[i], z[i])) good = check(EMB_ERROR_INTERNAL, "value");
        printf("%a\n", values[i]);
    }
    if (good) printf("version %u\n", (unsigned)emb_version_number());
    emb_geom_free(pocket);
    emb_geom_free(sphere);
    emb_geom_free(cube);
    emb_mesh_free(mesh);
    return good ? 0 : 1;
}
