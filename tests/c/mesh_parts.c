/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Meshes put together and taken apart, moved, turned over, read from several files; and that a mesh made of another
 * needs it no more, in whatever order handles are freed. */
#include "check.h"
#include "files.h"

enum { MOST = 128 };

/* All there is to say of a small mesh, faces in their order. */
typedef struct description {
  size_t faces, half_edges, fields[2];
  int32_t tags[MOST];
  char names[MOST][24];
  double corners[3 * MOST], of_corners[MOST], of_faces[MOST];
} description;

/* Tags, names, positions of corners and the first data of each kind, of one component. */
static void describe(const emb_mesh *mesh, description *d) {
  size_t f, k, size, at = 0;
  double xyz[3 * MOST], values[MOST];
  memset(d, 0, sizeof *d);
  d->faces = emb_mesh_face_count(mesh), d->half_edges = emb_mesh_half_edge_count(mesh);
  CHECK(d->faces <= MOST && d->half_edges <= MOST);
  CHECK_OK(emb_mesh_field_count(mesh, EMB_ON_VERTICES, &d->fields[0]));
  CHECK_OK(emb_mesh_field_count(mesh, EMB_ON_FACES, &d->fields[1]));
  CHECK_OK(emb_mesh_face_tags(mesh, 0, d->faces, d->tags));
  CHECK_OK(emb_mesh_vertices(mesh, 0, emb_mesh_vertex_count(mesh), xyz));
  if (d->fields[0] > 0) {
    CHECK_OK(emb_mesh_field_values(mesh, EMB_ON_VERTICES, 0, 0, emb_mesh_vertex_count(mesh), values));
  }
  if (d->fields[1] > 0) {
    CHECK_OK(emb_mesh_field_values(mesh, EMB_ON_FACES, 0, 0, d->faces, d->of_faces));
  }
  for (f = 0; f < d->faces; f++) {
    uint32_t h = emb_mesh_face_half_edge(mesh, f);
    CHECK_OK(emb_mesh_tag_name(mesh, d->tags[f], sizeof d->names[f], d->names[f], &size));
    for (k = 0; k < emb_mesh_face_corner_count(mesh, f); k++, h = emb_mesh_half_edge_next(mesh, h), at++) {
      uint32_t v = emb_mesh_half_edge_origin(mesh, h);
      memcpy(d->corners + 3 * at, xyz + 3 * v, 3 * sizeof *xyz);
      d->of_corners[at] = d->fields[0] > 0 ? values[v] : 0.0;
    }
  }
}

static int same(const emb_mesh *a, const emb_mesh *b) {
  static description of_a, of_b;
  describe(a, &of_a);
  describe(b, &of_b);
  return memcmp(&of_a, &of_b, sizeof of_a) == 0;
}

/* A cube [lo, lo + 1]^3 with a tag of its own and another on its last face, names of both, and data. */
static emb_mesh *cube_with_data(double lo, int32_t tag, const char *name) {
  const int32_t tags[6] = {tag, tag, tag, tag, tag, 50}, named[2] = {tag, 50};
  const char *names[2] = {NULL, "shared"};
  double of_vertices[8], of_faces[6];
  emb_mesh *plain = cube_of_squares(lo, lo + 1, NULL, NULL), *tagged = NULL, *with_one = NULL, *mesh = NULL;
  int i;
  names[0] = name;
  for (i = 0; i < 8; i++) {
    of_vertices[i] = 10 * lo + i, of_faces[i % 6] = -100 * lo - i % 6;
  }
  CHECK_OK(emb_mesh_with_tags(plain, tags, 2, named, names, &tagged));
  emb_mesh_free(plain);
  CHECK_OK(emb_mesh_with_field(tagged, EMB_ON_VERTICES, "v", 1, of_vertices, &with_one));
  CHECK_OK(emb_mesh_with_field(with_one, EMB_ON_FACES, "f", 1, of_faces, &mesh));
  emb_mesh_free(tagged);
  emb_mesh_free(with_one);
  return mesh;
}

static emb_mesh *joined(size_t count, const emb_mesh *const *meshes, int32_t tags) {
  emb_mesh *mesh = NULL;
  CHECK_OK(emb_mesh_join(count, meshes, tags, NULL, &mesh));
  return mesh;
}

/* The same, with vertices of different meshes that have one position made one. */
static emb_mesh *welded(size_t count, const emb_mesh *const *meshes, int32_t tags) {
  emb_mesh *mesh = NULL;
  emb_mesh_options options;
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  options.weld_tolerance = 1e-12;
  CHECK_OK(emb_mesh_join(count, meshes, tags, &options, &mesh));
  return mesh;
}

static emb_mesh_report report_of(const emb_mesh *mesh) {
  emb_mesh_report report;
  report.struct_size = sizeof report;
  CHECK_OK(emb_mesh_report_get(mesh, &report));
  return report;
}

static void what_is_split_and_joined_is_the_same_again(void) {
  emb_mesh *cubes[2], *whole, *again, *parts[4] = {NULL, NULL, NULL, NULL};
  static description d;
  size_t count = 9, i;
  cubes[0] = cube_with_data(3, -1, "near"), cubes[1] = cube_with_data(0, 8, "far");
  whole = joined(2, (const emb_mesh *const *)cubes, EMB_JOIN_KEEP);
  CHECK(report_of(whole).components == 2 && report_of(whole).closed == 1);
  CHECK(fabs(report_of(whole).volume - 2.0) < 1e-13);
  describe(whole, &d);
  CHECK(d.faces == 12 && d.tags[0] == -1 && d.tags[5] == 50 && d.tags[6] == 8 && d.tags[11] == 50);
  CHECK(strcmp(d.names[0], "near") == 0 && strcmp(d.names[6], "far") == 0 && strcmp(d.names[11], "shared") == 0);
  CHECK(d.of_faces[4] == -304.0 && d.of_faces[7] == -1.0 && d.corners[0] == 3.0 && d.of_corners[25] == 2.0);
  CHECK_OK(emb_mesh_split(whole, EMB_SPLIT_COMPONENT, 0, NULL, &count));
  CHECK(count == 2);
  CHECK_STATUS(emb_mesh_split(whole, EMB_SPLIT_COMPONENT, 1, parts, &count), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(parts[0] == NULL);
  CHECK_OK(emb_mesh_split(whole, EMB_SPLIT_COMPONENT, 4, parts, &count));
  CHECK(count == 2 && parts[2] == NULL && same(parts[0], cubes[0]) && same(parts[1], cubes[1]));
  again = joined(2, (const emb_mesh *const *)parts, EMB_JOIN_KEEP);
  CHECK(same(again, whole));
  for (i = 0; i < 2; i++) {
    emb_mesh_free(parts[i]);
    emb_mesh_free(cubes[i]);
  }
  emb_mesh_free(again);
  /* by tag: -1, 8, 50; each knows the names of its own tags */
  CHECK_OK(emb_mesh_split(whole, EMB_SPLIT_TAG, 4, parts, &count));
  CHECK(count == 3 && parts[3] == NULL);
  for (i = 0; i < 3; i++) {
    static const int32_t tags[3] = {-1, 8, 50};
    static const char *const names[3] = {"near", "far", "shared"};
    size_t k, size;
    describe(parts[i], &d);
    CHECK(d.faces == (i < 2 ? 5u : 2u) && d.tags[0] == tags[i] && d.tags[d.faces - 1] == tags[i]);
    CHECK(strcmp(d.names[0], names[i]) == 0 && report_of(parts[i]).closed == 0);
    for (k = 0; k < 3; k++) {
      CHECK_OK(emb_mesh_tag_name(parts[i], tags[k], 0, NULL, &size));
      CHECK(size == (k == i ? strlen(names[k]) + 1 : 1));
    }
  }
  CHECK(d.of_faces[0] == -305.0 && d.of_faces[1] == -5.0); /* the shared ones, in their order */
  again = joined(3, (const emb_mesh *const *)parts, EMB_JOIN_BY_MESH);
  CHECK(report_of(again).closed == 0 && emb_mesh_has_inside(again) == 0); /* each part as it was */
  emb_mesh_free(again);
  again = welded(3, (const emb_mesh *const *)parts, EMB_JOIN_BY_MESH);
  CHECK(report_of(again).closed == 1 && report_of(again).components == 2 && emb_mesh_has_inside(again) == 1);
  describe(again, &d);
  CHECK(d.tags[0] == 0 && d.tags[5] == 1 && d.tags[11] == 2 && strcmp(d.names[11], "shared") == 0);
  emb_mesh_free(again);
  for (i = 0; i < 3; i++) {
    emb_mesh_free(parts[i]);
  }
  emb_mesh_free(whole);
}

static void tags_and_data_of_those_that_become_one(void) {
  emb_mesh *meshes[3], *all;
  static description d;
  size_t i;
  meshes[0] = cube_with_data(0, 8, "a"), meshes[1] = cube_of_squares(2, 3, NULL, NULL);
  meshes[2] = cube_with_data(4, 8, "b");
  all = joined(3, (const emb_mesh *const *)meshes, EMB_JOIN_KEEP);
  describe(all, &d);
  CHECK(d.tags[0] == 8 && d.tags[6] == 0 && d.tags[12] == 8 && strcmp(d.names[12], "a") == 0);
  CHECK(isnan(d.of_faces[6]) && isnan(d.of_corners[24]) && d.of_faces[12] == -400.0 && d.of_corners[48] == 40.0);
  emb_mesh_free(all);
  all = joined(3, (const emb_mesh *const *)meshes, EMB_JOIN_RENUMBER);
  describe(all, &d);
  CHECK(d.tags[0] == 0 && d.tags[5] == 1 && d.tags[6] == 2 && d.tags[12] == 3 && d.tags[17] == 4);
  CHECK(strcmp(d.names[0], "a") == 0 && strcmp(d.names[5], "shared") == 0 && strcmp(d.names[6], "") == 0);
  CHECK(strcmp(d.names[12], "b") == 0 && strcmp(d.names[17], "shared") == 0);
  emb_mesh_free(all);
  all = joined(3, (const emb_mesh *const *)meshes, EMB_JOIN_BY_MESH);
  describe(all, &d);
  CHECK(d.tags[5] == 0 && d.tags[6] == 1 && d.tags[11] == 1 && d.tags[12] == 2);
  for (i = 0; i < 3; i++) {
    emb_mesh_free(meshes[i]);
  }
  emb_mesh_free(all);
}

/* Two cubes that meet in a corner, where the data differ: each face keeps what it had, also when they part again. */
static void data_that_differ_at_a_common_vertex_stay_with_their_faces(void) {
  static const double none = 0.0, all = 1.0;
  emb_mesh *cubes[2], *whole, *parts[2] = {NULL, NULL};
  emb_mesh_field field = {sizeof field, 0, 0};
  double values[16];
  size_t count = 0, k, found = 0;
  int32_t piece;
  cubes[0] = cube_with_data(0, 8, "a"), cubes[1] = cube_with_data(1, 9, "b");
  whole = joined(2, (const emb_mesh *const *)cubes, EMB_JOIN_KEEP);
  CHECK(emb_mesh_vertex_count(whole) == 16 && report_of(whole).components == 2);
  emb_mesh_free(whole);
  whole = welded(2, (const emb_mesh *const *)cubes, EMB_JOIN_KEEP);
  CHECK(emb_mesh_vertex_count(whole) == 15 && report_of(whole).components == 2);
  CHECK_OK(emb_mesh_field_get(whole, EMB_ON_VERTICES, 0, &field, 0, NULL, &count));
  CHECK(field.count == 16);
  CHECK_OK(emb_mesh_field_values(whole, EMB_ON_VERTICES, 0, 0, 16, values));
  CHECK(values[7] == 7.0 && values[8] == 11.0 && values[15] == 10.0);
  for (piece = 0; piece < 2; piece++) {
    for (k = 0; k < 3; k++) {
      const double *weights[3] = {&none, &none, &none};
      const int64_t face = 6; /* the first of the second cube */
      double value = 0.0;
      weights[k] = &all;
      CHECK_OK(emb_mesh_interpolate(whole, EMB_ON_VERTICES, 0, 1, &face, &piece, weights, 1, NULL, &value));
      CHECK(value >= 10.0 && value <= 13.0);
      found += value == 10.0;
    }
  }
  CHECK(found > 0);
  CHECK_OK(emb_mesh_split(whole, EMB_SPLIT_COMPONENT, 2, parts, &count));
  CHECK(count == 2 && same(parts[0], cubes[0]) && same(parts[1], cubes[1]));
  for (k = 0; k < 2; k++) {
    CHECK_OK(emb_mesh_field_get(parts[k], EMB_ON_VERTICES, 0, &field, 0, NULL, &count));
    CHECK(field.count == 8);
    emb_mesh_free(parts[k]);
    emb_mesh_free(cubes[k]);
  }
  emb_mesh_free(whole);
}

static void a_mesh_is_moved_and_turned_over_with_its_data(void) {
  emb_mesh *cube = cube_with_data(0, 8, "a"), *moved = NULL, *flipped = NULL, *back = NULL;
  static description before, after;
  emb_mesh_options options;
  emb_geom *g = NULL;
  int i;
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  options.scale = 2.0, options.shift[0] = 5.0;
  CHECK_OK(emb_mesh_transform(cube, &options, &moved));
  describe(cube, &before);
  describe(moved, &after);
  for (i = 0; i < 72; i++) {
    CHECK(after.corners[i] == 2.0 * before.corners[i] + (i % 3 == 0 ? 5.0 : 0.0));
  }
  memcpy(after.corners, before.corners, sizeof after.corners);
  CHECK(memcmp(&before, &after, sizeof before) == 0);
  emb_mesh_options_init(&options, sizeof options);
  options.orient = EMB_ORIENT_FLIP;
  CHECK_OK(emb_mesh_transform(cube, &options, &flipped));
  CHECK(!same(flipped, cube));
  CHECK_OK(emb_geom_from_mesh(flipped, NULL, NULL, &g));
  CHECK(emb_geom_value(g, 0.5, 0.5, 0.25) == 0.25 && emb_geom_value(g, 0.5, 0.5, 3.0) == -2.0);
  CHECK_OK(emb_mesh_transform(flipped, &options, &back));
  CHECK(same(back, cube));
  emb_mesh_free(back);
  CHECK(emb_mesh_face_is_turned(flipped, 0) == 1 && emb_mesh_face_is_turned(cube, 0) == 0);
  CHECK(emb_mesh_face_is_turned(flipped, 1000) == 0 && emb_mesh_face_is_turned(flipped, -1) == 0);
  CHECK_OK(emb_mesh_transform(flipped, NULL, &back)); /* inward still: the defaults turn nothing */
  CHECK(same(back, flipped));
  emb_mesh_free(back);
  options.orient = EMB_ORIENT_ALTERNATE;
  CHECK_OK(emb_mesh_transform(flipped, &options, &back));
  CHECK(same(back, cube));
  emb_geom_free(g);
  emb_mesh_free(cube);
  emb_mesh_free(moved);
  emb_mesh_free(flipped);
  emb_mesh_free(back);
}

static int heard(void *user, double fraction) {
  double *told = (double *)user;
  told[0] = told[1], told[1] = fraction;
  return 0;
}

static int stop_at_once(void *user, double fraction) {
  (void)user, (void)fraction;
  return 1;
}

/* The name of a file without folder and extension. */
static const char *stem(const char *path, char name[64]) {
  const char *from = strrchr(path, '/') + 1;
  snprintf(name, 64, "%.*s", (int)(strlen(from) - strlen(".stl")), from);
  return name;
}

static void files_become_one_mesh(void) {
  static const char solids[] =
      "solid top\nfacet normal 0 0 1\nouter loop\nvertex 0 0 9\nvertex 1 0 9\nvertex 0 1 9\nendloop\nendfacet\n"
      "endsolid top\nsolid under\nfacet normal 0 0 1\nouter loop\nvertex 0 0 8\nvertex 1 0 8\nvertex 0 1 8\nendloop\n"
      "endfacet\nendsolid under\n";
  static const int32_t how[3] = {EMB_JOIN_KEEP, EMB_JOIN_RENUMBER, EMB_JOIN_BY_MESH};
  static const int32_t tags[3][4] = {{0, 0, 1, 0}, {0, 1, 2, 3}, {0, 1, 1, 2}};
  static const size_t first[4] = {0, 12, 13, 14};
  static file_path path[3];
  static description d;
  const char *paths[3], *names[3][4] = {{"top", "top", "under", "top"}, {NULL, "top", "under", NULL}, {0}};
  char stems[3][64];
  double told[2] = {-1, -1};
  emb_run run = {sizeof run, NULL, heard, NULL};
  emb_mesh *cube, *mesh = NULL;
  int i, k;
  run.user = told;
  temporary_path(path[0], "a.stl"), temporary_path(path[1], "b.stl"), temporary_path(path[2], "c.stl");
  for (i = 0; i < 3; i++) {
    paths[i] = path[i];
    stem(path[i], stems[i]);
  }
  cube = cube_of_squares(0, 1, NULL, NULL);
  CHECK_OK(emb_mesh_write(cube, path[0]));
  emb_mesh_free(cube);
  cube = cube_of_squares(-0.5, 0.25, NULL, NULL);
  CHECK_OK(emb_mesh_write(cube, path[2]));
  write_file(path[1], solids, sizeof solids - 1);
  names[1][0] = names[2][0] = stems[0], names[2][1] = names[2][2] = stems[1], names[1][3] = names[2][3] = stems[2];
  for (i = 0; i < 3; i++) {
    CHECK_OK(emb_mesh_read_files(3, paths, how[i], NULL, &run, &mesh));
    CHECK(told[0] == 0.0 && told[1] == 1.0);
    CHECK(report_of(mesh).components == 4 && report_of(mesh).boundary_edges == 6);
    describe(mesh, &d);
    CHECK(d.faces == 26 && d.half_edges == 78 && d.corners[9 * 12 + 2] == 9.0 && d.corners[9 * 13 + 2] == 8.0);
    for (k = 0; k < 4; k++) {
      if (!check_that(d.tags[first[k]] == tags[i][k] && strcmp(d.names[first[k]], names[i][k]) == 0, "tag and name",
                      __FILE__, __LINE__)) {
        printf("    %d, %d: %d \"%s\"\n", i, k, (int)d.tags[first[k]], d.names[first[k]]);
      }
    }
    emb_mesh_free(mesh);
  }
  /* of one file, the mesh that was written */
  CHECK_OK(emb_mesh_read_files(1, paths + 2, EMB_JOIN_KEEP, NULL, NULL, &mesh));
  CHECK(report_of(mesh).volume == report_of(cube).volume && report_of(mesh).closed == 1);
  emb_mesh_free(mesh);
  emb_mesh_free(cube);
  mesh = NULL;
  run.progress = stop_at_once;
  CHECK_STATUS(emb_mesh_read_files(3, paths, EMB_JOIN_KEEP, NULL, &run, &mesh), EMB_ERROR_CANCELLED);
  CHECK(mesh == NULL);
  for (i = 0; i < 3; i++) {
    remove(path[i]);
  }
}

/* Each handle outlives what it was made of, and what is made of it outlives it. */
static void handles_are_freed_in_any_order(void) {
  int order;
  for (order = 0; order < 4; order++) {
    const double *none[3] = {NULL, NULL, NULL};
    emb_mesh *made[5] = {NULL, NULL, NULL, NULL, NULL};
    int64_t face = 3;
    double value = 0.0;
    emb_geom *g = NULL;
    size_t count;
    int i;
    made[0] = cube_with_data(0, 8, "a");
    made[1] = emb_mesh_clone(made[0]);
    CHECK_OK(emb_mesh_join(1, (const emb_mesh *const *)made, EMB_JOIN_KEEP, NULL, &made[2]));
    CHECK_OK(emb_mesh_transform(made[2], NULL, &made[3]));
    CHECK_OK(emb_mesh_split(made[3], EMB_SPLIT_COMPONENT, 1, &made[4], &count));
    CHECK_OK(emb_geom_from_mesh(made[order], NULL, NULL, &g));
    for (i = 0; i < 5; i++) {
      int k = order % 2 == 0 ? i : 4 - i;
      CHECK_OK(emb_mesh_interpolate(made[k], EMB_ON_FACES, 0, 1, &face, NULL, none, 1, NULL, &value));
      CHECK(value == -3.0);
      if (i == 2) {
        CHECK(emb_geom_value(g, 0.5, 0.5, 2.0) == 1.0);
        emb_geom_free(g);
      }
      emb_mesh_free(made[k]);
    }
  }
}

int main(void) {
  what_is_split_and_joined_is_the_same_again();
  tags_and_data_of_those_that_become_one();
  data_that_differ_at_a_common_vertex_stay_with_their_faces();
  a_mesh_is_moved_and_turned_over_with_its_data();
  files_become_one_mesh();
  handles_are_freed_in_any_order();
  return checks_done("mesh_parts");
}
