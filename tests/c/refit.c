/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Meshes whose vertices move: the bits of a geometry made anew, with and without a pool; what is refused writes nothing. */
#include "check.h"

static const uint32_t indices[36] = {0, 2, 3, 0, 3, 1, 4, 7, 5, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                     0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/* A box over these corners, as they run. */
static emb_geom *box(const double xyz[24]) {
  static const uint32_t outward[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                       0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  emb_mesh_options options;
  emb_mesh *mesh = NULL;
  emb_geom *g = NULL;
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  options.weld_tolerance = -1.0;
  options.orient = EMB_ORIENT_KEEP;
  CHECK_OK(emb_mesh_from_triangles(8, xyz, 12, outward, NULL, &options, &mesh));
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  emb_mesh_free(mesh);
  return g;
}

static int32_t stop(void *user, double fraction) {
  (void)user, (void)fraction;
  return 1;
}

int main(void) {
  static const double before[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  double after[24], bad[24];
  emb_geom *g = box(before), *anew, *moved = NULL, *out = NULL, *other = NULL;
  emb_pool *pool = NULL;
  emb_run run;
  emb_mesh *mesh = NULL;
  uint64_t was = emb_geom_fingerprint(g);
  int k, check;
  for (k = 0; k < 24; ++k) {
    after[k] = before[k] * (1.0 + 0.1 * (k % 3)) + 0.01 * (k % 7);
  }
  anew = box(after);
  memset(&run, 0, sizeof run);
  run.struct_size = sizeof run;
  CHECK_OK(emb_pool_new(3, &pool));
  run.pool = pool;
  for (check = EMB_REFIT_CHECK; check <= EMB_REFIT_TRUST; ++check) {
    CHECK_OK(emb_geom_refit(g, 8, after, check, NULL, &moved));
    CHECK(emb_geom_fingerprint(moved) == emb_geom_fingerprint(anew) && emb_geom_fingerprint(moved) != was);
    CHECK_OK(emb_geom_refit(g, 8, after, check, &run, &out));
    CHECK(emb_geom_fingerprint(out) == emb_geom_fingerprint(anew));
    for (k = 0; k < 200; ++k) {
      double x = -0.5 + 0.01 * k, y = 0.3 + 0.002 * k, z = 1.2 - 0.007 * k;
      CHECK(emb_geom_value(moved, x, y, z) == emb_geom_value(anew, x, y, z));
      CHECK(emb_geom_value(out, x, y, z) == emb_geom_value(anew, x, y, z));
    }
    emb_geom_free(out);
    emb_geom_free(moved);
    out = moved = NULL;
  }
  CHECK(emb_geom_fingerprint(g) == was);

  CHECK_STATUS(emb_geom_refit(NULL, 8, after, 0, NULL, &out), EMB_ERROR_NULL_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "g: NULL") == 0);
  CHECK_STATUS(emb_geom_refit(g, 8, NULL, 0, NULL, &out), EMB_ERROR_NULL_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "xyz: NULL") == 0);
  CHECK_STATUS(emb_geom_refit(g, 8, after, 0, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "out_geom: NULL") == 0);
  CHECK_STATUS(emb_geom_refit(g, 7, after, 0, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "vertex_count: 7 is not 8") != NULL);
  CHECK_STATUS(emb_geom_refit(g, SIZE_MAX, after, 0, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_geom_refit(g, 8, after, 2, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "check: 2") != NULL);
  memcpy(bad, after, sizeof bad);
  bad[16] = NAN;
  CHECK_STATUS(emb_geom_refit(g, 8, bad, 0, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "xyz: vertex 5") != NULL);
  for (k = 0; k < 24; k += 3) {
    bad[k] = -after[k], bad[k + 1] = after[k + 1], bad[k + 2] = after[k + 2];
  }
  CHECK_STATUS(emb_geom_refit(g, 8, bad, 1, NULL, &out), EMB_ERROR_TOPOLOGY);
  CHECK(strstr(emb_last_error(), "inside out") != NULL);
  CHECK_OK(emb_geom_part(g, 4, &other));
  CHECK_STATUS(emb_geom_refit(other, 8, after, 0, NULL, &out), EMB_ERROR_UNSUPPORTED);
  CHECK(strncmp(emb_last_error(), "g: ", 3) == 0);
  emb_geom_free(other);
  run.progress = stop;
  CHECK_STATUS(emb_geom_refit(g, 8, after, 0, &run, &out), EMB_ERROR_CANCELLED);
  run.struct_size = 3;
  CHECK_STATUS(emb_geom_refit(g, 8, after, 0, &run, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(out == NULL && emb_geom_fingerprint(g) == was);

  /* The vertices that a mesh gives are those that move: of twelve triangles one runs the wrong way, and is turned. */
  CHECK_OK(emb_mesh_from_triangles(8, before, 12, indices, NULL, NULL, &mesh));
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &other));
  CHECK(emb_mesh_vertex_count(mesh) == 8);
  CHECK_OK(emb_mesh_vertices(mesh, 0, 8, bad));
  CHECK_OK(emb_geom_refit(other, emb_mesh_vertex_count(mesh), bad, 0, NULL, &out));
  CHECK(emb_geom_fingerprint(out) == emb_geom_fingerprint(other));
  emb_mesh_free(mesh);
  emb_geom_free(other);
  emb_geom_free(out);
  emb_geom_free(g);
  emb_geom_free(anew);
  emb_pool_free(pool);
  return checks_done("refit");
}
