/* SPDX-License-Identifier: MIT OR Apache-2.0
 * What meshes carry: tags with names, data of vertices and faces, and those data at closest points, of triangles and of
 * faces that were cut into several, in either layout, with and without a pool. The last line is a hash of all values,
 * the same with every library and instruction set. */
#include "check.h"

#include <stddef.h>

enum { POINTS = 3000 };

static uint64_t hash = HASH_START;

static void tags_are_told_with_their_names(void) {
  static const int32_t tags[6] = {3, 3, 7, -2, 3, 3}, named[3] = {7, -2, 100};
  static const char *const names[3] = {"outlet", "wall \xC3\xA9", "nowhere"};
  emb_mesh *plain = cube_of_squares(0, 1, NULL, NULL), *mesh = NULL;
  int32_t all[5] = {9, 9, 9, 9, 9};
  char name[16];
  size_t count = 0;
  CHECK_OK(emb_mesh_with_tags(plain, tags, 3, named, names, &mesh));
  CHECK_OK(emb_mesh_face_tags(mesh, 2, 3, all));
  CHECK(all[0] == 7 && all[1] == -2 && all[2] == 3 && all[3] == 9);
  CHECK_OK(emb_mesh_tags(mesh, 0, NULL, &count));
  CHECK(count == 3);
  all[0] = all[1] = all[2] = 9;
  CHECK_STATUS(emb_mesh_tags(mesh, 2, all, &count), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(count == 3 && all[0] == 9);
  count = 0;
  CHECK_OK(emb_mesh_tags(mesh, 5, all, &count));
  CHECK(count == 3 && all[0] == -2 && all[1] == 3 && all[2] == 7 && all[3] == 9);
  memset(name, '#', sizeof name);
  CHECK_OK(emb_mesh_tag_name(mesh, -2, 0, NULL, &count));
  CHECK(count == 8);
  CHECK_OK(emb_mesh_tag_name(mesh, -2, count, name, &count));
  CHECK(memcmp(name, "wall \xC3\xA9\0########", 16) == 0);
  CHECK_OK(emb_mesh_tag_name(mesh, 7, sizeof name, name, &count));
  CHECK(strcmp(name, "outlet") == 0 && count == 7);
  CHECK_OK(emb_mesh_tag_name(mesh, 100, sizeof name, name, &count)); /* also of a tag that no face has */
  CHECK(strcmp(name, "nowhere") == 0);
  CHECK_OK(emb_mesh_tag_name(mesh, 3, sizeof name, name, &count));
  CHECK(strcmp(name, "") == 0 && count == 1);
  {
    static const char *const spaced[3] = {"outlet", "wall ", "nowhere"};
    emb_mesh *none = NULL;
    CHECK_STATUS(emb_mesh_with_tags(plain, tags, 3, named, spaced, &none), EMB_ERROR_INVALID_ARGUMENT);
    CHECK(none == NULL && strstr(emb_last_error(), "\"wall \" of tag -2") != NULL);
  }
  /* the mesh that it was made of has what it had */
  CHECK_OK(emb_mesh_face_tags(plain, 0, 5, all));
  CHECK(all[0] == 0 && all[3] == 0);
  CHECK_OK(emb_mesh_tags(plain, 5, all, &count));
  CHECK(count == 1 && all[0] == 0);
  CHECK_OK(emb_mesh_tag_name(plain, 7, 0, NULL, &count));
  CHECK(count == 1);
  emb_mesh_free(plain);
  emb_mesh_free(mesh);
}

static void linear(const double p[3], double out[2]) {
  out[0] = 1.0 + 2.0 * p[0] - 3.0 * p[1] + 0.5 * p[2];
  out[1] = -p[0];
}

/* The mesh with the linear function of the vertices, and the faces' own numbers. Frees the one given. */
static emb_mesh *with_fields(emb_mesh *mesh) {
  size_t vertices = emb_mesh_vertex_count(mesh), faces = emb_mesh_face_count(mesh), i;
  double *xyz = (double *)need(malloc(3 * vertices * sizeof *xyz));
  double *values = (double *)need(malloc((2 * vertices + faces) * sizeof *values));
  emb_mesh *with_vertices = NULL, *with_both = NULL;
  CHECK_OK(emb_mesh_vertices(mesh, 0, vertices, xyz));
  for (i = 0; i < vertices; i++) {
    linear(xyz + 3 * i, values + 2 * i);
  }
  for (i = 0; i < faces; i++) {
    values[2 * vertices + i] = 100.0 + (double)i;
  }
  CHECK_OK(emb_mesh_with_field(mesh, EMB_ON_VERTICES, "linear", 2, values, &with_vertices));
  emb_mesh_free(mesh);
  CHECK_OK(emb_mesh_with_field(with_vertices, EMB_ON_FACES, "number", 1, values + 2 * vertices, &with_both));
  emb_mesh_free(with_vertices);
  free(xyz);
  free(values);
  return with_both;
}

static void fields_are_told_and_read_back(void) {
  static const double ones[8] = {1, 1, 1, 1, 1, 1, 1, NAN};
  emb_mesh *mesh = with_fields(cube_of_squares(0, 1, NULL, NULL)), *more = NULL, *other = NULL;
  emb_mesh_field field = {sizeof field, 9, 9};
  size_t count = 9, size = 9;
  double values[16], number[6];
  char name[8] = "#######";
  CHECK_OK(emb_mesh_field_count(mesh, EMB_ON_VERTICES, &count));
  CHECK(count == 1);
  CHECK_OK(emb_mesh_field_get(mesh, EMB_ON_VERTICES, 0, &field, 0, NULL, &size));
  CHECK(field.components == 2 && field.count == 8 && size == sizeof "linear" && strcmp(name, "#######") == 0);
  CHECK_OK(emb_mesh_field_get(mesh, EMB_ON_VERTICES, 0, NULL, size, name, &size));
  CHECK(strcmp(name, "linear") == 0 && size == sizeof "linear");
  CHECK_OK(emb_mesh_field_get(mesh, EMB_ON_FACES, 0, &field, sizeof name, name, &size));
  CHECK(field.components == 1 && field.count == 6 && strcmp(name, "number") == 0);
  CHECK_OK(emb_mesh_field_values(mesh, EMB_ON_VERTICES, 0, 0, 8, values));
  CHECK(values[0] == 1.0 && values[1] == 0.0 && values[14] == 0.5 && values[15] == -1.0);
  values[4] = 9.0;
  CHECK_OK(emb_mesh_field_values(mesh, EMB_ON_VERTICES, 0, 6, 2, values));
  CHECK(values[0] == -1.5 && values[2] == 0.5 && values[4] == 9.0);
  CHECK_OK(emb_mesh_field_values(mesh, EMB_ON_FACES, 0, 0, 6, number));
  CHECK(number[0] == 100.0 && number[5] == 105.0);
  /* another of the same name takes its place, on vertices alone; numbers or not */
  CHECK_OK(emb_mesh_with_field(mesh, EMB_ON_VERTICES, "number", 1, ones, &more));
  CHECK_OK(emb_mesh_with_field(more, EMB_ON_VERTICES, "linear", 1, ones, &other));
  CHECK_OK(emb_mesh_field_count(other, EMB_ON_VERTICES, &count));
  CHECK(count == 2);
  CHECK_OK(emb_mesh_field_get(other, EMB_ON_VERTICES, 0, &field, sizeof name, name, &size));
  CHECK(field.components == 1 && strcmp(name, "linear") == 0);
  CHECK_OK(emb_mesh_field_values(other, EMB_ON_VERTICES, 0, 0, 8, values));
  CHECK(same_bits(values, ones, 8));
  CHECK_OK(emb_mesh_field_get(other, EMB_ON_FACES, 0, &field, sizeof name, name, &size));
  CHECK(field.count == 6 && strcmp(name, "number") == 0);
  CHECK_OK(emb_mesh_field_get(mesh, EMB_ON_VERTICES, 0, &field, 0, NULL, &size));
  CHECK(field.components == 2);
  emb_mesh_free(mesh);
  emb_mesh_free(more);
  emb_mesh_free(other);
}

static int stop_at_once(void *user, double fraction) {
  (void)fraction;
  ++*(int *)user;
  return 1;
}

/* The linear function at the closest points to random ones, from one mesh; `several`: faces are cut into pieces. */
static void data_are_interpolated(emb_mesh *mesh, double reach, int several, const emb_run *pooled) {
  static double p[3 * POINTS], at[3 * POINTS], w[3 * POINTS], apart[3][POINTS], one[2 * POINTS], two[2 * POINTS],
      number[POINTS];
  static int64_t primitive[POINTS];
  static int32_t piece[POINTS];
  const double *together[3] = {w, w + 1, w + 2}, *separate[3] = {apart[0], apart[1], apart[2]};
  emb_closest_out out;
  emb_geom *g = NULL;
  emb_run stopped = {sizeof stopped, NULL, stop_at_once, NULL};
  size_t i, later = 0;
  int c, calls = 0, differ = 0;
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  for (i = 0; i < 3 * POINTS; i++) {
    p[i] = random_between(-reach, reach);
  }
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out, out.vector_stride = 3;
  for (c = 0; c < 3; c++) {
    out.point[c] = at + c, out.barycentric[c] = w + c;
  }
  out.primitive = primitive, out.piece = piece;
  CHECK_OK(emb_geom_closest(g, POINTS, p, p + 1, p + 2, 3, INFINITY, NULL, &out));
  emb_geom_free(g);
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, POINTS, primitive, piece, together, 3, NULL, one));
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_FACES, 0, POINTS, primitive, NULL, NULL, 1, NULL, number));
  for (i = 0; i < POINTS; i++) {
    double wanted[2];
    linear(at + 3 * i, wanted);
    for (c = 0; c < 2; c++) {
      if (!check_that(fabs(one[2 * i + c] - wanted[c]) < 1e-12 * (1.0 + reach), "linear", __FILE__, __LINE__)) {
        printf("    point %lu, component %d: %.17g, not %.17g\n", (unsigned long)i, c, one[2 * i + c], wanted[c]);
      }
    }
    CHECK(number[i] == 100.0 + (double)primitive[i]);
    for (c = 0; c < 3; c++) {
      apart[c][i] = w[3 * i + c];
    }
    later += piece[i] > 0;
  }
  CHECK((later > POINTS / 10) == several);
  /* the same bits from three arrays, by many threads */
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, POINTS, primitive, piece, separate, 1, pooled, two));
  CHECK(same_bits(one, two, 2 * POINTS));
  hash = hash_bytes(hash, one, sizeof one);
  /* without pieces every one is the first: that is the same where faces are triangles, and elsewhere it is not */
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, POINTS, primitive, NULL, separate, 1, NULL, two));
  for (i = 0; i < POINTS; i++) {
    differ += !same_bits(one + 2 * i, two + 2 * i, 2);
  }
  CHECK((differ != 0) == several);
  stopped.user = &calls;
  CHECK_STATUS(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, POINTS, primitive, piece, separate, 1, &stopped, two),
               EMB_ERROR_CANCELLED);
  CHECK(calls == 1);
  emb_mesh_free(mesh);
}

/* An L of eight faces, two of them concave hexagons, about the origin. */
static emb_mesh *angle(void) {
  static const double corners[12] = {-1, -1, 2, -1, 2, 0, 0, 0, 0, 2, -1, 2};
  size_t offsets[9] = {0, 6, 12, 16, 20, 24, 28, 32, 36};
  uint32_t indices[36], i;
  double xyz[36];
  emb_mesh *mesh = NULL;
  for (i = 0; i < 6; i++) {
    uint32_t *side = indices + 12 + 4 * i, next = (i + 1) % 6;
    memcpy(xyz + 3 * i, corners + 2 * i, 2 * sizeof *xyz);
    memcpy(xyz + 18 + 3 * i, corners + 2 * i, 2 * sizeof *xyz);
    xyz[3 * i + 2] = -1, xyz[20 + 3 * i] = 1;
    indices[i] = 5 - i, indices[6 + i] = 6 + i;
    side[0] = i, side[1] = next, side[2] = 6 + next, side[3] = 6 + i;
  }
  CHECK_OK(emb_mesh_from_polygons(12, xyz, 8, offsets, indices, NULL, NULL, &mesh));
  return mesh;
}

static void what_is_far_or_no_face_is_not_a_number(void) {
  emb_mesh *mesh = with_fields(cube_of_squares(0, 1, NULL, NULL));
  static const int64_t primitive[7] = {-1, 6, INT64_MAX, INT64_MIN, 2, 2, 2};
  static const int32_t piece[7] = {0, 0, 0, 0, 2, -1, 1};
  static const double ones[7] = {1, 1, 1, 1, 1, 1, 1}, zeros[7] = {0};
  const double *weights[3] = {ones, zeros, zeros};
  double values[14], number[7], x = 9.0;
  int64_t far[1] = {5};
  int32_t far_piece[1] = {5};
  emb_closest_out out;
  emb_geom *g = NULL;
  int i;
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, 7, primitive, piece, weights, 1, NULL, values));
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_FACES, 0, 7, primitive, piece, NULL, 1, NULL, number));
  for (i = 0; i < 7; i++) {
    CHECK(isnan(values[2 * i]) == (i < 6) && isnan(values[2 * i + 1]) == (i < 6));
    CHECK(i < 4 ? isnan(number[i]) : number[i] == 102.0);
  }
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out, out.primitive = far, out.piece = far_piece;
  CHECK_OK(emb_geom_closest(g, 1, &x, &x, &x, 1, 0.5, NULL, &out));
  CHECK(far[0] == -1 && far_piece[0] == -1);
  CHECK_OK(emb_mesh_interpolate(mesh, EMB_ON_VERTICES, 0, 1, far, far_piece, weights, 1, NULL, values));
  CHECK(isnan(values[0]) && isnan(values[1]));
  emb_geom_free(g);
  emb_mesh_free(mesh);
}

/* emb_closest_out as the first release had it: what it lacked is not looked at, and the rest is as ever. */
static void closest_points_are_told_to_callers_of_the_first_release(void) {
  const size_t first = offsetof(emb_closest_out, piece);
  emb_mesh *mesh = cube_of_squares(0, 1, NULL, NULL);
  double x[2] = {0.25, 3}, y[2] = {0.75, 0.5}, z[2] = {2, 0.25}, value[2] = {0, 0};
  int64_t primitive[2] = {-7, -7};
  int32_t piece[2] = {-7, -7};
  emb_closest_out out;
  emb_geom *g = NULL;
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  emb_mesh_free(mesh);
  memset(&out, 0, sizeof out);
  memset(&out.piece, 0xA5, sizeof out.piece);
  out.struct_size = first, out.value = value, out.primitive = primitive;
  CHECK_OK(emb_geom_closest(g, 2, x, y, z, 1, INFINITY, NULL, &out));
  CHECK(value[0] == 1.0 && value[1] == 2.0 && primitive[0] == 1 && primitive[1] == 5);
  out.struct_size = sizeof out;
  CHECK_STATUS(emb_geom_closest(g, 2, x, y, z, 1, INFINITY, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "out.piece: 0x") != NULL);
  out.piece = piece;
  CHECK_OK(emb_geom_closest(g, 2, x, y, z, 1, INFINITY, NULL, &out));
  CHECK(piece[0] >= 0 && piece[0] <= 1 && piece[1] >= 0 && piece[1] <= 1);
  out.struct_size = first - 1;
  CHECK_STATUS(emb_geom_closest(g, 2, x, y, z, 1, INFINITY, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  emb_geom_free(g);
}

int main(void) {
  soup ball = soup_sphere(1.0, 24);
  emb_pool *pool = NULL;
  emb_run pooled = {sizeof pooled, NULL, NULL, NULL};
  emb_mesh_options flip;
  CHECK_OK(emb_mesh_options_init(&flip, sizeof flip));
  flip.orient = EMB_ORIENT_FLIP;
  CHECK_OK(emb_pool_new(3, &pool));
  pooled.pool = pool;
  tags_are_told_with_their_names();
  fields_are_told_and_read_back();
  data_are_interpolated(with_fields(soup_mesh(&ball)), 2.0, 0, &pooled);
  data_are_interpolated(with_fields(cube_of_squares(-1, 1, NULL, NULL)), 3.0, 1, &pooled);
  data_are_interpolated(with_fields(cube_of_squares(-1, 1, NULL, &flip)), 3.0, 1, &pooled);
  data_are_interpolated(with_fields(angle()), 3.0, 1, &pooled);
  what_is_far_or_no_face_is_not_a_number();
  closest_points_are_told_to_callers_of_the_first_release();
  emb_pool_free(pool);
  soup_free(&ball);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("mesh_data");
}
