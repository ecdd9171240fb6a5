/* SPDX-License-Identifier: MIT OR Apache-2.0
 * The signs of open meshes: what is inside, what is said of it, what is refused. The last line is a hash of all values. */
#include "check.h"

static uint64_t hash = HASH_START;

/* A box of four by four by four units without its top. */
static emb_mesh *tub(void) {
  static const double xyz[24] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0, 0, 0, 4, 4, 0, 4, 0, 4, 4, 4, 4, 4};
  static const uint32_t indices[30] = {0, 2, 3, 0, 3, 1, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  emb_mesh *mesh = NULL;
  CHECK_OK(emb_mesh_from_triangles(8, xyz, 10, indices, NULL, NULL, &mesh));
  return mesh;
}

static emb_geom *by(const emb_mesh *mesh, int32_t sign, int32_t axis) {
  emb_sdf_options options;
  emb_geom *g = NULL;
  CHECK_OK(emb_sdf_options_init(&options, sizeof options));
  options.sign = sign;
  options.axis = axis;
  CHECK_OK(emb_geom_from_mesh(mesh, &options, NULL, &g));
  return g;
}

static void text_is(const emb_geom *g, const char *wanted) {
  char text[400];
  size_t size = 0, again = 0;
  CHECK_OK(emb_geom_sign_text(g, 0, NULL, &size));
  CHECK(size <= sizeof text);
  CHECK_OK(emb_geom_sign_text(g, size, text, &again));
  CHECK(again == size && size == strlen(text) + 1);
  if (!CHECK(strcmp(text, wanted) == 0)) {
    printf("    %s\n", text);
  }
  CHECK_STATUS(emb_geom_sign_text(g, size - 1, text, &again), size == 1 ? EMB_OK : EMB_ERROR_INVALID_ARGUMENT);
}

int main(void) {
  static const int32_t signs[5] = {EMB_SIGN_WINDING, EMB_SIGN_RAY, EMB_SIGN_AXIS, EMB_SIGN_NONE, EMB_SIGN_WINDING};
  static const char *const texts[5] = {
      "WINDING, as asked: there are 4 boundary edges in 1 loops",
      "RAY, as asked: inside is where four of six rays say so (4 boundary edges in 1 loops)",
      "AXIS, as asked: inside is below the highest face (4 boundary edges in 1 loops)",
      "NONE, as asked: nothing is inside",
      "WINDING, as asked: there are 4 boundary edges in 1 loops"};
  emb_mesh *mesh = tub();
  emb_geom *g = NULL, *ball = NULL;
  const double center[3] = {0, 0, 0};
  size_t size = 0;
  int k;
  CHECK(emb_mesh_has_inside(mesh) == 0);
  CHECK_STATUS(emb_geom_from_mesh(mesh, NULL, NULL, &g), EMB_ERROR_TOPOLOGY);
  CHECK(strstr(emb_last_error(), "1 of 1 loops: 4 edges around (2.0") != NULL && g == NULL);
  for (k = 0; k < 5; ++k) {
    emb_geom_properties properties;
    int i;
    g = by(mesh, signs[k], 2);
    memset(&properties, 0, sizeof properties);
    properties.struct_size = sizeof properties;
    CHECK_OK(emb_geom_properties_get(g, &properties));
    CHECK(properties.sign_method == signs[k] && properties.kind == EMB_EXACT);
    CHECK((properties.lipschitz == 1.0) == (signs[k] == EMB_SIGN_NONE));
    text_is(g, texts[k]);
    for (i = 0; i < 3000; ++i) {
      const double x = -1.0 + 0.419 * (i % 15), y = -1.0 + 0.43 * (i / 15 % 14), z = -1.3 + 0.47 * (i / 210);
      const double value = emb_geom_value(g, x, y, z);
      const int within = x > 0 && x < 4 && y > 0 && y < 4, between = within && z > 0 && z < 4;
      const int inside = signs[k] == EMB_SIGN_NONE ? 0 : signs[k] == EMB_SIGN_AXIS ? within && z < 0 : between;
      if (signs[k] != EMB_SIGN_AXIS || !between) { /* the floor is the highest face but for the walls */
        CHECK((value < 0) == inside);
      }
      hash = hash_bytes(hash, &value, sizeof value);
    }
    CHECK(emb_geom_classify_box(g, (double[3]){1, 1, 1}, (double[3]){1.5, 1.5, 1.5}) == (k == 0 || k == 4 ? -1 : k == 1 ? -1 : 1));
    emb_geom_free(g);
    g = NULL;
  }
  CHECK_OK(emb_geom_sphere(center, 1.0, &ball));
  text_is(ball, "");
  CHECK_STATUS(emb_geom_sign_text(NULL, 0, NULL, &size), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_geom_sign_text(ball, 0, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  emb_geom_free(ball);
  emb_mesh_free(mesh);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("signs");
}
