/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Misuse of what meshes tell, carry and become, by a table: each function with each argument NULL, out of range, not
 * finite, overflowing, misaligned or unknown. The status is right, the message is one line that names the argument,
 * and nothing was written. */
#include "check.h"
#include "files.h"

#include <stddef.h>

/* Every argument of every function, with values that are good. */
typedef struct arguments {
  size_t first, count, index, capacity, name_count, k, components, stride;
  int32_t element, on, tag, join, by;
  const emb_mesh *mesh;
  const emb_mesh *const *meshes;
  const char *const *paths, *const *names;
  const char *name;
  const int32_t *tags, *named_tags, *piece;
  const int64_t *primitive;
  const double *point, *values;
  const double *const *barycentric;
  const emb_run *run;
  emb_mesh_options *mesh_options;
  double *out_values, *out_point;
  uint32_t *out_vertices, *out_twins;
  int64_t *out_faces;
  int32_t *out_tags;
  char *out_text;
  size_t *out_count;
  emb_mesh_measure *measure;
  emb_mesh_field *field;
  emb_mesh **out_mesh, **out_meshes;
  /* what the struct pointers above point to */
  struct { emb_run value; char tail[16]; } run_value;
  struct { emb_mesh_options value; char tail[16]; } mesh_options_value;
} arguments;

/* Everything that a call may write to. */
static struct outputs {
  double values[64], point[3];
  uint32_t vertices[64], twins[64];
  int64_t faces[64];
  int32_t tags[64];
  char text[64];
  size_t count;
  struct { emb_mesh_measure value; char tail[16]; } measure;
  struct { emb_mesh_field value; char tail[16]; } field;
  emb_mesh *mesh, *meshes[8];
} outputs;

static const double xs[24] = {0.5, 0.25, 0.25, 3.0, 4.0, 5.0}, infinite[3] = {1, -INFINITY, 1};
static const int32_t tags[6] = {3, 3, 3, -2, 3, 3}, named_tags[2] = {3, -2}, twice_named[2] = {3, 3};
static const int32_t pieces[3] = {0, 1, 0};
static const int64_t primitives[3] = {0, 5, -1};
static const double weights[2][9] = {{0.5, 0.25, 0.25, 1, 0, 0, NAN, NAN, NAN}, {0}};
static const double *barycentric[3], *hollow_weights[3], *bent_weights[3];
static const char *const names[2] = {"wall", "inlet of \xC3\xA9tain"}, *const hollow_names[2] = {"wall", NULL},
                                *const empty_names[2] = {"wall", ""}, *const wild_names[2] = {"wall", "a\xFFz"},
                                *const broken_names[2] = {"a\nb", "inlet"};
static file_path file, missing, junk;
static const char *paths[2], *hollow_paths[2], *missing_paths[2], *junk_paths[2];
static emb_mesh *mesh, *other;
static const emb_mesh *meshes[2], *hollow_meshes[2], *unlike_meshes[2];
static int drops;

static arguments good(void) {
  arguments a;
  memset(&a, 0, sizeof a);
  a.first = 1, a.count = 2, a.index = 1, a.capacity = 40, a.name_count = 2, a.components = 3, a.stride = 3;
  a.element = EMB_ELEMENT_FACE, a.on = EMB_ON_VERTICES, a.tag = -2, a.join = EMB_JOIN_RENUMBER, a.by = EMB_SPLIT_TAG;
  a.mesh = mesh, a.meshes = meshes, a.paths = paths, a.names = names, a.name = "name";
  a.tags = tags, a.named_tags = named_tags, a.piece = pieces, a.primitive = primitives;
  a.point = xs, a.values = xs, a.barycentric = barycentric;
  a.out_values = outputs.values, a.out_point = outputs.point;
  a.out_vertices = outputs.vertices, a.out_twins = outputs.twins, a.out_faces = outputs.faces;
  a.out_tags = outputs.tags, a.out_text = outputs.text, a.out_count = &outputs.count;
  a.measure = &outputs.measure.value, a.field = &outputs.field.value;
  a.out_mesh = &outputs.mesh, a.out_meshes = outputs.meshes;
  a.run_value.value.struct_size = sizeof(emb_run);
  emb_mesh_options_init(&a.mesh_options_value.value, sizeof(emb_mesh_options));
  return a;
}

/* Points the struct pointers into the copy of the arguments that a call is given. */
static void connect(arguments *a) {
  a->run = &a->run_value.value, a->mesh_options = &a->mesh_options_value.value;
}

/* What may be written, as a call finds it: filled with `byte`, the sizes of structs set. */
static void reset_outputs(int byte) {
  memset(&outputs, byte, sizeof outputs);
  outputs.measure.value.struct_size = sizeof(emb_mesh_measure);
  outputs.field.value.struct_size = sizeof(emb_mesh_field);
}

#include "misuse.h"

CALL(vertices, emb_mesh_vertices(a->mesh, a->first, a->count, a->out_values))
CALL(triangles, emb_mesh_triangles(a->mesh, a->first, a->count, a->out_vertices, a->out_faces))
CALL(half_edges, emb_mesh_half_edges(a->mesh, a->first, a->count, a->out_vertices, a->out_twins, a->out_faces))
CALL(measure_get, emb_mesh_measure_get(a->mesh, a->element, a->index, a->measure))
CALL(measure_edge, emb_mesh_measure_get(a->mesh, EMB_ELEMENT_EDGE, a->index, a->measure))
CALL(measure_vertex, emb_mesh_measure_get(a->mesh, EMB_ELEMENT_VERTEX, a->index, a->measure))
CALL(mesh_distance, emb_mesh_distance(a->mesh, a->element, a->index, a->point, a->out_values, a->out_point))
CALL(face_tags, emb_mesh_face_tags(a->mesh, a->first, a->count, a->out_tags))
CALL(mesh_tags, emb_mesh_tags(a->mesh, a->capacity, a->out_tags, a->out_count))
CALL(tag_name, emb_mesh_tag_name(a->mesh, a->tag, a->capacity, a->out_text, a->out_count))
CALL(with_tags, emb_mesh_with_tags(a->mesh, a->tags, a->name_count, a->named_tags, a->names, a->out_mesh))
CALL(field_count, emb_mesh_field_count(a->mesh, a->on, a->out_count))
CALL(field_get, emb_mesh_field_get(a->mesh, a->on, a->k, a->field, a->capacity, a->out_text, a->out_count))
CALL(field_values, emb_mesh_field_values(a->mesh, a->on, a->k, a->first, a->count, a->out_values))
CALL(with_field, emb_mesh_with_field(a->mesh, a->on, a->name, a->components, a->values, a->out_mesh))
CALL(interpolate, emb_mesh_interpolate(a->mesh, a->on, a->k, a->count, a->primitive, a->piece, a->barycentric,
                                       a->stride, a->run, a->out_values))
CALL(read_files, emb_mesh_read_files(a->count, a->paths, a->join, a->mesh_options, a->run, a->out_mesh))
CALL(join, emb_mesh_join(a->count, a->meshes, a->join, a->mesh_options, a->out_mesh))
CALL(transform, emb_mesh_transform(a->mesh, a->mesh_options, a->out_mesh))
CALL(split, emb_mesh_split(a->mesh, a->by, a->capacity, a->out_meshes, a->out_count))

#define MESH(call) NULLED(call, mesh, "mesh: NULL")
/* A pointer that is needed. */
#define NEEDED(call, member, name) NULLED(call, member, name ": NULL"), BENT(call, member, name ": 0x")
/* Two from number 1 on, of `total`. */
#define PORTION(call, total)                                                                              \
  SIZED(call, first, total - 1, "and 2 reach beyond " #total " "), SIZED(call, first, SIZE_MAX, "first, count"), \
  SIZED(call, first, SIZE_MAX - 1, "first, count"), SIZED(call, count, total, "first, count: 1 and " #total),    \
  SIZED(call, count, SIZE_MAX, "first, count"), SIZED(call, count, SIZE_MAX / 8, "first, count")
/* A list or a text, for which `too_few` is too small a capacity. */
#define LIST(call, too_few, out, name)                                                     \
  SIZED(call, capacity, too_few, "capacity: " #too_few " is less than"), NEEDED(call, out, name), \
  NEEDED(call, out_count, "out_count")
#define TEXT(call, too_few)                                                                \
  SIZED(call, capacity, too_few, "capacity: " #too_few " is less than"), SIZED(call, capacity, 1, "capacity: 1"), \
  NULLED(call, out_text, "out_name: NULL"), NEEDED(call, out_count, "out_size")
#define CARRIER(call) UNKNOWN(call, on, "on"), INTEGER(call, on, 2, EMB_ERROR_INVALID_ARGUMENT, "on: 2")
#define FIELD(call)                                                                                       \
  MESH(call), CARRIER(call), SIZED(call, k, 1, "k: 1"), SIZED(call, k, SIZE_MAX, "k: 18446744073709551615"), \
  INTEGER(call, on, EMB_ON_FACES, EMB_ERROR_INVALID_ARGUMENT, "k: 0")
#define NAME(call, member, to, name) POINTED(call, member, to, EMB_ERROR_INVALID_ARGUMENT, name)
#define BEYOND(call, total, what)                                                             \
  SIZED(call, index, total, "index: the mesh as it stands has no " what " " #total),           \
  SIZED(call, index, (size_t)1 << 32, "index: the mesh as it stands has no " what " 4294967296"), \
  SIZED(call, index, SIZE_MAX, "index: the mesh as it stands has no " what " 18446744073709551615")
#define ELEMENT(call)                                                                                     \
  MESH(call), UNKNOWN(call, element, "element"), INTEGER(call, element, 3, EMB_ERROR_INVALID_ARGUMENT, "element: 3"), \
  BEYOND(call, 6, "face")

static const misuse table[] = {
    MESH(vertices), NEEDED(vertices, out_values, "out_xyz"), PORTION(vertices, 8),
    MESH(triangles), BENT(triangles, out_vertices, "out_vertices"), BENT(triangles, out_faces, "out_faces"),
    PORTION(triangles, 12),
    MESH(half_edges), BENT(half_edges, out_vertices, "out_origin"), BENT(half_edges, out_twins, "out_twin"),
    BENT(half_edges, out_faces, "out_face"), PORTION(half_edges, 24),
    ELEMENT(measure_get), NULLED(measure_get, measure, "measure: NULL"),
    BEYOND(measure_edge, 24, "half-edge"), BEYOND(measure_vertex, 8, "vertex"),
    ELEMENT(mesh_distance), NEEDED(mesh_distance, point, "point"),
    INTEGER(mesh_distance, element, EMB_ELEMENT_EDGE, EMB_OK, ""),
    POINTED(mesh_distance, point, not_finite, EMB_ERROR_INVALID_ARGUMENT, "point: (0, NaN, 2)"),
    POINTED(mesh_distance, point, infinite, EMB_ERROR_INVALID_ARGUMENT, "point: (1, -inf, 1)"),
    NEEDED(mesh_distance, out_values, "out_distance"), BENT(mesh_distance, out_point, "out_point"),

    MESH(face_tags), NEEDED(face_tags, out_tags, "out_tags"), PORTION(face_tags, 6),
    MESH(mesh_tags), LIST(mesh_tags, 1, out_tags, "out_tags"), MESH(tag_name), TEXT(tag_name, 5),
    MESH(with_tags), NEEDED(with_tags, tags, "tags"), NEEDED(with_tags, named_tags, "named_tags"),
    NEEDED(with_tags, names, "names"), NULLED(with_tags, out_mesh, "out_mesh"), BENT(with_tags, out_mesh, "out_mesh"),
    SIZED(with_tags, name_count, SIZE_MAX, "name_count"), SIZED(with_tags, name_count, SIZE_MAX / 8, "name_count"),
    POINTED(with_tags, names, hollow_names, EMB_ERROR_NULL_ARGUMENT, "names[1]: NULL"),
    NAME(with_tags, names, empty_names, "names[1]: \"\""), NAME(with_tags, names, wild_names, "names[1]: \"a\\xffz\""),
    NAME(with_tags, names, broken_names, "names[0]: \"a\\nb\""), NAME(with_tags, named_tags, twice_named, "tag 3"),

    MESH(field_count), CARRIER(field_count), NEEDED(field_count, out_count, "out_count"),
    FIELD(field_get), TEXT(field_get, 8),
    FIELD(field_values), NEEDED(field_values, out_values, "out_values"), PORTION(field_values, 8),
    MESH(with_field), CARRIER(with_field), NEEDED(with_field, values, "values"),
    NEEDED(with_field, out_mesh, "out_mesh"), NULLED(with_field, name, "name: NULL"), NAME(with_field, name, "", "name: \"\""),
    NAME(with_field, name, "a\rb", "name: \"a\\rb\""), NAME(with_field, name, "\xC3", "name: \"\\xc3\""),
    SIZED(with_field, components, 0, "components: 0"), SIZED(with_field, components, SIZE_MAX, "components"),
    SIZED(with_field, components, SIZE_MAX / 64, "components"),
    SIZED_AS(with_field, components, SIZE_MAX / 128, EMB_ERROR_MEMORY, "1152921504606846968 values"),
    FIELD(interpolate), NEEDED(interpolate, primitive, "primitive"), BENT(interpolate, piece, "piece"),
    NEEDED(interpolate, barycentric, "barycentric"), NEEDED(interpolate, out_values, "out_values"),
    POINTED(interpolate, barycentric, hollow_weights, EMB_ERROR_NULL_ARGUMENT, "barycentric[1]: NULL"),
    POINTED(interpolate, barycentric, bent_weights, EMB_ERROR_INVALID_ARGUMENT, "barycentric[2]: 0x"),
    SIZED(interpolate, stride, 0, "stride: 0"), SIZED(interpolate, stride, SIZE_MAX, "stride"),
    SIZED(interpolate, stride, PTRDIFF_MAX / sizeof(double), "stride"), SIZED(interpolate, count, SIZE_MAX, "count"),
    SIZED(interpolate, count, PTRDIFF_MAX / sizeof(double) / 3 + 1, "count"), RUN(interpolate),

    NEEDED(read_files, paths, "paths"), NEEDED(read_files, out_mesh, "out_mesh"), UNKNOWN(read_files, join, "tags"),
    SIZED(read_files, count, 0, "paths"), SIZED(read_files, count, SIZE_MAX, "count"),
    SIZED(read_files, count, SIZE_MAX / 16, "count"),
    POINTED(read_files, paths, hollow_paths, EMB_ERROR_NULL_ARGUMENT, "paths[1]: NULL"),
    POINTED(read_files, paths, missing_paths, EMB_ERROR_IO, "missing.stl"), RUN(read_files), MESH_OPTIONS(read_files),
    POINTED(read_files, paths, junk_paths, EMB_ERROR_PARSE, "junk.stl: "),
    NEEDED(join, meshes, "meshes"), NEEDED(join, out_mesh, "out_mesh"), UNKNOWN(join, join, "tags"),
    INTEGER(join, join, 3, EMB_ERROR_INVALID_ARGUMENT, "tags: 3"),
    SIZED(join, count, 0, "meshes"), SIZED(join, count, SIZE_MAX, "count"), SIZED(join, count, SIZE_MAX / 8, "count"),
    POINTED(join, meshes, hollow_meshes, EMB_ERROR_NULL_ARGUMENT, "meshes[1]: NULL"),
    POINTED(join, meshes, unlike_meshes, EMB_ERROR_INVALID_ARGUMENT, "meshes: the field \"position\""),
    MESH_OPTIONS(join), MESH(transform), NEEDED(transform, out_mesh, "out_mesh"), MESH_OPTIONS(transform),
    REAL_ONE(transform, mesh_options_value.value.scale, 1e200, "xyz: vertex"),
    REAL_ONE(transform, mesh_options_value.value.scale, 1e-200, "xyz"),
    MESH(split), UNKNOWN(split, by, "by"), INTEGER(split, by, 2, EMB_ERROR_INVALID_ARGUMENT, "by: 2"),
    LIST(split, 1, out_meshes, "out_meshes"),
};

static void free_outputs(void) {
  int i;
  emb_mesh_free(outputs.mesh);
  for (i = 0; i < 8; i++) {
    emb_mesh_free(outputs.meshes[i]);
  }
}

/* Every row differs from this only in what it spoils. */
static void good_arguments_are_accepted(void) {
  size_t i;
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    arguments a = good();
    if (i > 0 && table[i].call == table[i - 1].call) {
      continue;
    }
    connect(&a);
    reset_outputs(0);
    check_status(table[i].call(&a), EMB_OK, table[i].function, __FILE__, __LINE__);
    free_outputs();
  }
}

/* What may be left out. */
static void optional_pointers_may_be_null(void) {
  arguments a = good();
  int i;
  connect(&a);
  a.run = NULL, a.mesh_options = NULL;
#define WITHOUT(call) reset_outputs(0), CHECK_OK(call(&a)), free_outputs()
  WITHOUT(join);
  WITHOUT(transform);
  WITHOUT(read_files);
  WITHOUT(interpolate);
  a.piece = NULL;
  WITHOUT(interpolate);
  a.name_count = 0, a.names = NULL, a.named_tags = NULL;
  WITHOUT(with_tags);
  reset_outputs(0);
  a.out_vertices = NULL;
  CHECK_OK(triangles(&a));
  CHECK(outputs.faces[0] == 0 && outputs.faces[1] == 1);
  reset_outputs(0);
  CHECK_OK(half_edges(&a));
  CHECK(outputs.faces[0] == 0 && outputs.twins[0] != outputs.twins[1]);
  a.out_faces = NULL, a.out_twins = NULL;
  CHECK_OK(triangles(&a));
  CHECK_OK(half_edges(&a));
  /* the rest is asked for all the same */
  a.first = 24;
  CHECK_STATUS(triangles(&a), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(half_edges(&a), EMB_ERROR_INVALID_ARGUMENT);
  a.out_point = NULL;
  CHECK_OK(mesh_distance(&a));
  reset_outputs(0);
  a.field = NULL;
  CHECK_OK(field_get(&a));
  CHECK(strcmp(outputs.text, "position") == 0 && outputs.count == sizeof "position");
  CHECK(outputs.field.value.components == 0);
  /* the weights of corners are nothing to data of faces */
  CHECK_OK(emb_mesh_with_field(mesh, EMB_ON_FACES, "load", 1, xs, &outputs.mesh));
  a = good();
  a.mesh = outputs.mesh, a.on = EMB_ON_FACES, a.barycentric = NULL, a.count = 3;
  for (i = 0; i < 2; i++) {
    memset(outputs.values, 0, sizeof outputs.values);
    CHECK_OK(interpolate(&a));
    CHECK(outputs.values[0] == xs[0] && outputs.values[1] == xs[5] && isnan(outputs.values[2]));
    a.piece = NULL;
  }
  a.stride = 0;
  CHECK_STATUS(interpolate(&a), EMB_ERROR_INVALID_ARGUMENT);
  emb_mesh_free(outputs.mesh);
}

/* Nothing from anywhere up to the end, into no array. */
static void zero_counts_write_nothing(void) {
  static const size_t ends[6] = {8, 12, 24, 6, 8, 0};
  static emb_status (*const calls[6])(arguments *) = {vertices,  triangles,    half_edges,
                                                      face_tags, field_values, interpolate};
  struct outputs before;
  arguments a = good();
  int i;
  connect(&a);
  reset_outputs(0xA5);
  before = outputs;
  a.count = 0;
  for (i = 0; i < 6; i++) {
    a.first = ends[i];
    CHECK_OK(calls[i](&a));
  }
  a.out_values = NULL, a.out_vertices = NULL, a.out_faces = NULL, a.out_tags = NULL;
  a.primitive = NULL, a.piece = NULL, a.barycentric = NULL;
  for (i = 0; i < 6; i++) {
    a.first = ends[i];
    CHECK_OK(calls[i](&a));
    a.first = ends[i] + 1;
    CHECK_STATUS(calls[i](&a), i == 5 ? EMB_OK : EMB_ERROR_INVALID_ARGUMENT);
  }
  CHECK(memcmp(&before, &outputs, sizeof outputs) == 0);
}

/* Result structs of every size: those that no release has are refused, of a larger one what is unknown stays. */
static void result_structs_carry_their_size(void) {
  static const size_t wrong[4] = {0, sizeof(size_t), 5000, SIZE_MAX};
  arguments a = good();
  struct outputs before;
  size_t i;
  for (i = 0; i < 6; i++) {
    reset_outputs(0);
    if (i < 4) {
      outputs.measure.value.struct_size = outputs.field.value.struct_size = wrong[i];
    } else if (i == 4) {
      outputs.measure.value.struct_size = sizeof(emb_mesh_measure) - 1;
      outputs.field.value.struct_size = sizeof(emb_mesh_field) - 1;
    } else {
      outputs.measure.value.struct_size = sizeof outputs.measure, outputs.measure.tail[7] = 1;
      outputs.field.value.struct_size = sizeof outputs.field, outputs.field.tail[7] = 1;
    }
    before = outputs;
    CHECK_STATUS(measure_get(&a), EMB_ERROR_INVALID_ARGUMENT);
    CHECK(strstr(emb_last_error(), "measure.struct_size: ") != NULL);
    CHECK_STATUS(field_get(&a), EMB_ERROR_INVALID_ARGUMENT);
    CHECK(strstr(emb_last_error(), "field.struct_size: ") != NULL);
    CHECK(memcmp(&before, &outputs, sizeof outputs) == 0);
  }
  reset_outputs(0);
  outputs.measure.value.struct_size = sizeof outputs.measure, outputs.field.value.struct_size = sizeof outputs.field;
  CHECK_OK(measure_get(&a));
  CHECK_OK(field_get(&a));
  CHECK(outputs.measure.value.struct_size == sizeof outputs.measure && outputs.measure.value.size == 1.0);
  CHECK(outputs.field.value.struct_size == sizeof outputs.field && outputs.field.value.count == 8);
  for (i = 0; i < 16; i++) {
    CHECK(outputs.measure.tail[i] == 0 && outputs.field.tail[i] == 0);
  }
}

/* What cannot fail: nothing is known of no mesh, nor beyond what there is, and there is no message. */
static void getters_cannot_fail(void) {
  static const uint32_t beyond[3] = {24, 1u << 31, EMB_NO_INDEX};
  char before[200];
  int i;
  emb_geom_sphere(NULL, 1.0, NULL);
  snprintf(before, sizeof before, "%s", emb_last_error());
  CHECK(emb_mesh_vertex_count(NULL) == 0 && emb_mesh_face_count(NULL) == 0);
  CHECK(emb_mesh_face_is_turned(NULL, 0) == 0);
  CHECK(emb_mesh_has_inside(NULL) == 0 && emb_mesh_triangle_count(NULL) == 0 && emb_mesh_half_edge_count(NULL) == 0);
  for (i = 0; i < 4; i++) {
    const emb_mesh *m = i == 3 ? NULL : mesh;
    uint32_t h = i == 3 ? 0 : beyond[i];
    uint64_t f = i == 0 ? 6 : i == 1 ? (uint64_t)1 << 32 : i == 2 ? UINT64_MAX : 0;
    uint32_t v = i == 0 ? 8 : h;
    CHECK(emb_mesh_face_corner_count(m, f) == 0 && emb_mesh_face_half_edge(m, f) == EMB_NO_INDEX);
    CHECK(emb_mesh_vertex_half_edge_count(m, v) == 0 && emb_mesh_vertex_half_edge(m, v, 0) == EMB_NO_INDEX);
    CHECK(emb_mesh_half_edge_origin(m, h) == EMB_NO_INDEX && emb_mesh_half_edge_target(m, h) == EMB_NO_INDEX);
    CHECK(emb_mesh_half_edge_next(m, h) == EMB_NO_INDEX && emb_mesh_half_edge_previous(m, h) == EMB_NO_INDEX);
    CHECK(emb_mesh_half_edge_twin(m, h) == EMB_NO_INDEX && emb_mesh_half_edge_around(m, h) == EMB_NO_INDEX);
    CHECK(emb_mesh_half_edge_face(m, h) == -1);
  }
  CHECK(emb_mesh_vertex_half_edge(mesh, 0, 3) == EMB_NO_INDEX && emb_mesh_vertex_half_edge(mesh, 0, 2) != EMB_NO_INDEX);
  CHECK(emb_mesh_vertex_half_edge(mesh, 0, SIZE_MAX) == EMB_NO_INDEX);
  CHECK(strcmp(before, emb_last_error()) == 0);
}

int main(void) {
  emb_mesh *plain = cube_of_squares(0, 1, tags, NULL), *tagged = NULL;
  double xyz[24];
  size_t i;
  cube_corners(0, 1, xyz);
  CHECK_OK(emb_mesh_with_tags(plain, tags, 2, named_tags, (const char *const[]){"wall", "inlet"}, &tagged));
  CHECK_OK(emb_mesh_with_field(tagged, EMB_ON_VERTICES, "position", 3, xyz, &mesh));
  CHECK_OK(emb_mesh_with_field(tagged, EMB_ON_VERTICES, "position", 2, xyz, &other));
  temporary_path(file, "misuse-part.stl");
  temporary_path(missing, "missing.stl");
  temporary_path(junk, "junk.stl");
  CHECK_OK(emb_mesh_write(plain, file));
  write_file(junk, "no mesh", 7);
  for (i = 0; i < 3; i++) {
    barycentric[i] = hollow_weights[i] = bent_weights[i] = weights[0] + i;
  }
  hollow_weights[1] = NULL, bent_weights[2] = (const double *)((const char *)weights[0] + 1);
  paths[0] = paths[1] = hollow_paths[0] = missing_paths[0] = junk_paths[0] = file;
  missing_paths[1] = missing, junk_paths[1] = junk;
  meshes[0] = meshes[1] = hollow_meshes[0] = unlike_meshes[0] = mesh, unlike_meshes[1] = other;
  good_arguments_are_accepted();
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    arguments a = good();
    connect(&a);
    check_row(&table[i], &a);
  }
  optional_pointers_may_be_null();
  zero_counts_write_nothing();
  result_structs_carry_their_size();
  getters_cannot_fail();
  emb_mesh_free(plain);
  emb_mesh_free(tagged);
  emb_mesh_free(mesh);
  emb_mesh_free(other);
  remove(file);
  remove(junk);
  return checks_done("misuse_meshes");
}
