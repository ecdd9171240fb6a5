/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Misuse of pools, meshes and questions, by a table: each function with each argument NULL, out of range, not
 * finite, overflowing or unknown. The status is right, the message is one line that names the argument, and nothing
 * was written. */
#include "check.h"

#include <stddef.h>

/* Every argument of every function, with values that are good. Calls write only to what is listed in `outputs`. */
typedef struct arguments {
  size_t count, stride, size, threads, width;
  double max_distance, band;
  int32_t mode, axis;
  const double *x, *y, *z, *a, *b, *lo, *hi;
  const float *xf, *yf, *zf;
  double *out_values;
  float *out_values_f32;
  int32_t *out_class;
  double *out_lo, *out_hi;
  const emb_geom *g;
  const emb_mesh *mesh;
  const char *path;
  const void *bytes;
  size_t vertex_count, triangle_count, face_count;
  const double *xyz;
  const float *xyz_f32;
  const uint32_t *indices;
  const size_t *offsets;
  const int32_t *tags;
  emb_geom **out_geom;
  emb_mesh **out_mesh;
  emb_pool **out_pool;
  emb_parallel_for_fn executor;
  const emb_run *run;
  const emb_lattice *lattice;
  const emb_array *array;
  const emb_closest_out *closest;
  const emb_hit_out *hit;
  const emb_crossings_out *crossings;
  emb_mesh_report *report;
  emb_geom_properties *properties;
  emb_mesh_options *mesh_options;
  emb_sdf_options *sdf_options;
  /* what the struct pointers above point to */
  struct { emb_run value; char tail[16]; } run_value;
  struct { emb_lattice value; char tail[16]; } lattice_value;
  struct { emb_array value; char tail[16]; } array_value;
  struct { emb_closest_out value; char tail[16]; } closest_value;
  struct { emb_hit_out value; char tail[16]; } hit_value;
  struct { emb_crossings_out value; char tail[16]; } crossings_value;
  struct { emb_mesh_options value; char tail[16]; } mesh_options_value;
  struct { emb_sdf_options value; char tail[16]; } sdf_options_value;
} arguments;

/* Everything that a call may write to. */
static struct outputs {
  double values[64], values2[64], vectors[9][64], lo[3], hi[3];
  float values_f32[64];
  int64_t primitive[64];
  int32_t labels[4][64];
  emb_geom *geom;
  emb_mesh *mesh;
  emb_pool *pool;
  struct { emb_mesh_report value; char tail[16]; } report;
  struct { emb_geom_properties value; char tail[16]; } properties;
} outputs;

static const double xs[8] = {0, 1, 2, 3, 4, 5, 6, 7}, ys[8] = {0, 1, 2, 3, 4, 5, 6, 7}, zs[8] = {0, 1, 2, 3};
static const float xf[4] = {0, 1, 2, 3};
static const double los[6] = {0, 0, 0, 1, 1, 1}, his[6] = {1, 1, 1, 2, 2, 2};
static const float cube_f32[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
static const size_t offsets[5] = {0, 3, 6, 9, 12};
static soup cube;
static emb_geom *sphere;
static emb_geom *sign_only;
static emb_mesh *mesh;
static int drops;

static void run_serially(void *user, size_t tasks, void (*task)(void *context, size_t index), void *context) {
  size_t i;
  (void)user;
  for (i = 0; i < tasks; i++) {
    task(context, i);
  }
}

static arguments good(void) {
  static const char not_stl[] = "no mesh";
  arguments a;
  memset(&a, 0, sizeof a);
  a.count = 2, a.stride = 1, a.threads = 1, a.width = 2;
  a.max_distance = INFINITY, a.band = 1.0;
  a.mode = EMB_FILL_EXACT;
  a.x = xs, a.y = ys, a.z = zs, a.a = los, a.b = his, a.lo = los, a.hi = his;
  a.xf = a.yf = a.zf = xf;
  a.out_values = outputs.values, a.out_values_f32 = outputs.values_f32, a.out_class = outputs.labels[0];
  a.out_lo = outputs.lo, a.out_hi = outputs.hi;
  a.g = sphere, a.mesh = mesh;
  a.path = "/nonexistent/part.stl", a.bytes = not_stl, a.size = sizeof not_stl - 1;
  a.vertex_count = cube.vertices, a.triangle_count = cube.triangles, a.face_count = 4;
  a.xyz = cube.xyz, a.xyz_f32 = cube_f32, a.indices = cube.indices, a.offsets = offsets, a.tags = cube.tags;
  a.out_geom = &outputs.geom, a.out_mesh = &outputs.mesh, a.out_pool = &outputs.pool;
  a.executor = run_serially;
  a.report = &outputs.report.value, a.properties = &outputs.properties.value;

  a.run_value.value.struct_size = sizeof(emb_run);
  a.lattice_value.value.struct_size = sizeof(emb_lattice);
  a.lattice_value.value.n[0] = 3, a.lattice_value.value.n[1] = 2, a.lattice_value.value.n[2] = 2;
  a.lattice_value.value.x = xs, a.lattice_value.value.y = ys, a.lattice_value.value.z = zs;
  a.array_value.value.struct_size = sizeof(emb_array);
  a.array_value.value.data = outputs.values;
  a.closest_value.value.struct_size = sizeof(emb_closest_out);
  a.closest_value.value.value = outputs.values;
  a.closest_value.value.point[1] = outputs.vectors[0];
  a.closest_value.value.vector_stride = 1;
  a.closest_value.value.primitive = outputs.primitive;
  a.hit_value.value.struct_size = sizeof(emb_hit_out);
  a.hit_value.value.t = outputs.values;
  a.hit_value.value.normal[2] = outputs.vectors[0];
  a.hit_value.value.vector_stride = 1;
  a.crossings_value.value.struct_size = sizeof(emb_crossings_out);
  a.crossings_value.value.where.struct_size = a.crossings_value.value.count.struct_size =
      a.crossings_value.value.tag.struct_size = a.crossings_value.value.part.struct_size = sizeof(emb_array);
  a.crossings_value.value.where.data = outputs.values;
  a.crossings_value.value.count.data = outputs.labels[0];
  a.crossings_value.value.tag.data = outputs.labels[1];
  a.crossings_value.value.part.data = outputs.labels[2];
  a.crossings_value.value.count.type = a.crossings_value.value.tag.type = a.crossings_value.value.part.type = EMB_I32;
  emb_mesh_options_init(&a.mesh_options_value.value, sizeof(emb_mesh_options));
  emb_sdf_options_init(&a.sdf_options_value.value, sizeof(emb_sdf_options));
  return a;
}

/* Points the struct pointers into the copy of the arguments that a call is given. */
static void connect(arguments *a) {
  a->run = &a->run_value.value, a->lattice = &a->lattice_value.value, a->array = &a->array_value.value;
  a->closest = &a->closest_value.value, a->hit = &a->hit_value.value, a->crossings = &a->crossings_value.value;
  a->mesh_options = &a->mesh_options_value.value, a->sdf_options = &a->sdf_options_value.value;
}

/* What may be written, as a call finds it: filled with `byte`, the sizes of structs set. */
static void reset_outputs(int byte) {
  memset(&outputs, byte, sizeof outputs);
  outputs.report.value.struct_size = sizeof(emb_mesh_report);
  outputs.properties.value.struct_size = sizeof(emb_geom_properties);
}

#include "misuse.h"

CALL(pool_new, emb_pool_new(a->threads, a->out_pool))
CALL(pool_from_callback, emb_pool_from_callback(a->width, a->executor, &drops, count_drop, a->out_pool))
CALL(mesh_read, emb_mesh_read(a->path, a->mesh_options, a->run, a->out_mesh))
CALL(mesh_read_memory, emb_mesh_read_memory(a->bytes, a->size, a->mesh_options, a->run, a->out_mesh))
CALL(from_triangles, emb_mesh_from_triangles(a->vertex_count, a->xyz, a->triangle_count, a->indices, a->tags,
                                             a->mesh_options, a->out_mesh))
CALL(from_triangles_f32, emb_mesh_from_triangles_f32(a->vertex_count, a->xyz_f32, a->triangle_count, a->indices,
                                                     a->tags, a->mesh_options, a->out_mesh))
CALL(from_polygons, emb_mesh_from_polygons(a->vertex_count, a->xyz, a->face_count, a->offsets, a->indices, a->tags,
                                           a->mesh_options, a->out_mesh))
CALL(mesh_write, emb_mesh_write(a->mesh, a->path))
CALL(report_get, emb_mesh_report_get(a->mesh, a->report))
CALL(from_mesh, emb_geom_from_mesh(a->mesh, a->sdf_options, a->run, a->out_geom))
CALL(geom_bounds, emb_geom_bounds(a->g, a->out_lo, a->out_hi))
CALL(properties_get, emb_geom_properties_get(a->g, a->properties))
CALL(values, emb_geom_values(a->g, a->count, a->x, a->y, a->z, a->stride, a->run, a->out_values))
CALL(values_f32, emb_geom_values_f32(a->g, a->count, a->xf, a->yf, a->zf, a->stride, a->run, a->out_values_f32))
CALL(closest, emb_geom_closest(a->g, a->count, a->x, a->y, a->z, a->stride, a->max_distance, a->run, a->closest))
CALL(fill, emb_geom_fill(a->g, a->lattice, a->mode, a->band, a->run, a->array))
CALL(crossings, emb_geom_crossings(a->g, a->lattice, a->axis, a->run, a->crossings))
CALL(intercepts, emb_geom_intercepts(a->g, a->count, a->a, a->b, a->run, a->hit))
CALL(classify_boxes, emb_geom_classify_boxes(a->g, a->count, a->lo, a->hi, a->run, a->out_class))
CALL(mesh_options_init, emb_mesh_options_init(a->mesh_options, a->size))
CALL(sdf_options_init, emb_sdf_options_init(a->sdf_options, a->size))

#define POINTS(call, x, y, z)                                                                          \
  NULLED(call, x, "x"), NULLED(call, y, "y"), NULLED(call, z, "z"), BENT(call, x, "x"), BENT(call, z, "z"), \
  SIZED(call, count, SIZE_MAX, "count"), SIZED(call, stride, 0, "stride"), SIZED(call, stride, SIZE_MAX, "stride")

static const uint32_t far_index[36] = {0, 1, 99};
static const size_t falling[5] = {0, 3, 2, 9, 12}, late[5] = {1, 3, 6, 9, 12}, short_face[5] = {0, 2, 6, 9, 12};

static const misuse table[] = {
    NULLED(pool_new, out_pool, "out_pool"),
    SIZED(pool_new, threads, SIZE_MAX, "threads"),
    NULLED(pool_from_callback, executor, "fn"),
    NULLED(pool_from_callback, out_pool, "out_pool"),
    SIZED(pool_from_callback, width, 0, "width: 0"),
    SIZED(pool_from_callback, width, SIZE_MAX, "width"),

    NULLED(mesh_read, path, "path"),
    NULLED(mesh_read, out_mesh, "out_mesh"),
    POINTED(mesh_read, path, "/nonexistent/part.stl", EMB_ERROR_IO, "/nonexistent/part.stl"),
    POINTED(mesh_read, path, "/", EMB_ERROR_IO, "/"),
    RUN(mesh_read),
    MESH_OPTIONS(mesh_read),
    NULLED(mesh_read_memory, bytes, "bytes"),
    NULLED(mesh_read_memory, out_mesh, "out_mesh"),
    SIZED(mesh_read_memory, size, SIZE_MAX, "size"),
    SIZED_AS(mesh_read_memory, size, 0, EMB_ERROR_PARSE, ""),
    SIZED_AS(mesh_read_memory, size, 7, EMB_ERROR_PARSE, ""),
    RUN(mesh_read_memory),
    MESH_OPTIONS(mesh_read_memory),
    NULLED(from_triangles, xyz, "xyz"),
    NULLED(from_triangles, indices, "indices"),
    NULLED(from_triangles, out_mesh, "out_mesh"),
    BENT(from_triangles, xyz, "xyz"),
    BENT(from_triangles, indices, "indices"),
    BENT(from_triangles, tags, "tags"),
    SIZED(from_triangles, vertex_count, SIZE_MAX, "vertex_count"),
    SIZED(from_triangles, triangle_count, SIZE_MAX, "triangle_count"),
    POINTED(from_triangles, indices, far_index, EMB_ERROR_INVALID_ARGUMENT, "indices[2]: 99"),
    MESH_OPTIONS(from_triangles),
    NULLED(from_triangles_f32, xyz_f32, "xyz"),
    NULLED(from_triangles_f32, indices, "indices"),
    NULLED(from_triangles_f32, out_mesh, "out_mesh"),
    SIZED(from_triangles_f32, vertex_count, SIZE_MAX, "vertex_count"),
    SIZED(from_triangles_f32, triangle_count, SIZE_MAX, "triangle_count"),
    MESH_OPTIONS(from_triangles_f32),
    NULLED(from_polygons, xyz, "xyz"),
    NULLED(from_polygons, offsets, "offsets"),
    NULLED(from_polygons, indices, "indices"),
    NULLED(from_polygons, out_mesh, "out_mesh"),
    SIZED(from_polygons, vertex_count, SIZE_MAX, "vertex_count"),
    SIZED(from_polygons, face_count, SIZE_MAX, "face_count"),
    POINTED(from_polygons, offsets, falling, EMB_ERROR_INVALID_ARGUMENT, "offsets[2]: 2"),
    POINTED(from_polygons, offsets, late, EMB_ERROR_INVALID_ARGUMENT, "offsets[0]: 1"),
    POINTED(from_polygons, offsets, short_face, EMB_ERROR_INVALID_ARGUMENT, "offsets"),
    POINTED(from_polygons, indices, far_index, EMB_ERROR_INVALID_ARGUMENT, "indices[2]: 99"),
    MESH_OPTIONS(from_polygons),
    NULLED(mesh_write, mesh, "mesh"),
    NULLED(mesh_write, path, "path"),
    POINTED(mesh_write, path, "/nonexistent/part.stl", EMB_ERROR_IO, "/nonexistent/part.stl"),
    POINTED(mesh_write, path, "/nonexistent/part.xyz", EMB_ERROR_UNSUPPORTED, "part.xyz"),
    NULLED(report_get, mesh, "mesh"),
    NULLED(report_get, report, "report"),

    NULLED(from_mesh, mesh, "mesh"),
    NULLED(from_mesh, out_geom, "out_geom"),
    RUN(from_mesh),
    VERSIONED(from_mesh, sdf_options_value, emb_sdf_options, "options"),
    UNKNOWN(from_mesh, sdf_options_value.value.sign, "options.sign"),
    UNKNOWN(from_mesh, sdf_options_value.value.open, "options.open"),
    UNKNOWN(from_mesh, sdf_options_value.value.axis, "options.axis"),
    UNKNOWN(from_mesh, sdf_options_value.value.accelerator, "options.accelerator"),
    INTEGER(from_mesh, sdf_options_value.value.open, EMB_OPEN_SWEEP, EMB_ERROR_INVALID_ARGUMENT, "options.open_lo"),
    NULLED(geom_bounds, g, "g"),
    NULLED(geom_bounds, out_lo, "out_lo"),
    NULLED(geom_bounds, out_hi, "out_hi"),
    BENT(geom_bounds, out_lo, "out_lo"),
    NULLED(properties_get, g, "g"),
    NULLED(properties_get, properties, "properties"),

    NULLED(values, g, "g"),
    POINTS(values, x, y, z),
    RUN(values),
    NULLED(values, out_values, "out_values"),
    BENT(values, out_values, "out_values"),
    NULLED(values_f32, g, "g"),
    POINTS(values_f32, xf, yf, zf),
    RUN(values_f32),
    NULLED(values_f32, out_values_f32, "out_values"),
    NULLED(closest, g, "g"),
    POINTS(closest, x, y, z),
    RUN(closest),
    NULLED(closest, closest, "out"),
    VERSIONED(closest, closest_value, emb_closest_out, "out"),
    BENT(closest, closest_value.value.value, "out.value"),
    BENT(closest, closest_value.value.gradient[2], "out.gradient[2]"),
    BENT(closest, closest_value.value.tag, "out.tag"),
    SIZED(closest, closest_value.value.vector_stride, 0, "out.vector_stride"),
    SIZED(closest, closest_value.value.vector_stride, SIZE_MAX, "out.vector_stride"),
    REAL_ONE(closest, max_distance, NAN, "max_distance"),
    REAL_ONE(closest, max_distance, 0.0, "max_distance"),
    REAL_ONE(closest, max_distance, -INFINITY, "max_distance"),
    NULLED(fill, g, "g"),
    LATTICE(fill),
    RUN(fill),
    NULLED(fill, array, "out"),
    VERSIONED(fill, array_value, emb_array, "out"),
    NULLED(fill, array_value.value.data, "out.data"),
    BENT(fill, array_value.value.data, "out.data"),
    UNKNOWN(fill, mode, "mode"),
    UNKNOWN(fill, array_value.value.type, "out.type"),
    INTEGER(fill, array_value.value.type, EMB_I32, EMB_ERROR_INVALID_ARGUMENT, "out.type"),
    INTEGER(fill, array_value.value.type, EMB_I8, EMB_ERROR_INVALID_ARGUMENT, "out.type"),
    {"fill sharing", fill, STEP, AT(array_value), NULL, 1, 0, 0, EMB_ERROR_INVALID_ARGUMENT, "out.stride[1]: 2"},
    {"fill on one", fill, STEP, AT(array_value), NULL, 2, 0, 0, EMB_ERROR_INVALID_ARGUMENT, "out.stride[2]: 0"},
    {"fill beyond", fill, STEP, AT(array_value), NULL, 3, 0, 0, EMB_ERROR_INVALID_ARGUMENT, "out.stride[2]"},
    HELD(fill, g, &sign_only, EMB_ERROR_UNSUPPORTED, "mode"),
    NULLED(crossings, g, "g"),
    LATTICE(crossings),
    RUN(crossings),
    NULLED(crossings, crossings, "out"),
    UNKNOWN(crossings, axis, "axis"),
    INTEGER(crossings, axis, 3, EMB_ERROR_INVALID_ARGUMENT, "axis: 3"),
    VERSIONED(crossings, crossings_value, emb_crossings_out, "out"),
    UNKNOWN(crossings, crossings_value.value.form, "out.form"),
    UNKNOWN(crossings, crossings_value.value.elsewhere, "out.elsewhere"),
    SIZED(crossings, crossings_value.value.where.struct_size, 0, "out.where.struct_size"),
    SIZED(crossings, crossings_value.value.part.struct_size, 5000, "out.part.struct_size"),
    BENT(crossings, crossings_value.value.where.data, "out.where.data"),
    UNKNOWN(crossings, crossings_value.value.where.type, "out.where.type"),
    UNKNOWN(crossings, crossings_value.value.count.type, "out.count.type"),
    UNKNOWN(crossings, crossings_value.value.tag.type, "out.tag.type"),
    UNKNOWN(crossings, crossings_value.value.part.type, "out.part.type"),
    INTEGER(crossings, crossings_value.value.where.type, EMB_I32, EMB_ERROR_INVALID_ARGUMENT, "out.where.type"),
    INTEGER(crossings, crossings_value.value.count.type, EMB_F64, EMB_ERROR_INVALID_ARGUMENT, "out.count.type"),
    INTEGER(crossings, crossings_value.value.tag.type, EMB_I8, EMB_ERROR_INVALID_ARGUMENT, "out.tag.type"),
    INTEGER(crossings, crossings_value.value.part.type, EMB_F32, EMB_ERROR_INVALID_ARGUMENT, "out.part.type"),
    NULLED(intercepts, g, "g"),
    NULLED(intercepts, a, "a"),
    NULLED(intercepts, b, "b"),
    BENT(intercepts, a, "a"),
    SIZED(intercepts, count, SIZE_MAX, "count"),
    SIZED(intercepts, count, SIZE_MAX / 16, "count"),
    RUN(intercepts),
    NULLED(intercepts, hit, "out"),
    VERSIONED(intercepts, hit_value, emb_hit_out, "out"),
    BENT(intercepts, hit_value.value.primitive, "out.primitive"),
    SIZED(intercepts, hit_value.value.vector_stride, 0, "out.vector_stride"),
    NULLED(classify_boxes, g, "g"),
    NULLED(classify_boxes, lo, "lo"),
    NULLED(classify_boxes, hi, "hi"),
    NULLED(classify_boxes, out_class, "out_class"),
    BENT(classify_boxes, hi, "hi"),
    BENT(classify_boxes, out_class, "out_class"),
    SIZED(classify_boxes, count, SIZE_MAX, "count"),
    POINTED(classify_boxes, lo, not_finite, EMB_ERROR_INVALID_ARGUMENT, "box 0"),
    POINTED(classify_boxes, hi, los, EMB_OK, ""),
    POINTED(classify_boxes, lo, his, EMB_OK, ""),
    RUN(classify_boxes),

    NULLED(mesh_options_init, mesh_options, "options"),
    SIZED(mesh_options_init, size, 0, "size: 0"),
    SIZED(mesh_options_init, size, sizeof(emb_mesh_options) - 8, "size"),
    SIZED(mesh_options_init, size, 5000, "size: 5000"),
    NULLED(sdf_options_init, sdf_options, "options"),
    SIZED(sdf_options_init, size, sizeof(size_t), "size"),
    SIZED(sdf_options_init, size, SIZE_MAX, "size"),
};

/* Every row differs from this only in what it spoils. */
static void good_arguments_are_accepted(void) {
  size_t i;
  const misuse *row = NULL;
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    arguments a = good();
    if (row != NULL && row->call == table[i].call) {
      continue;
    }
    row = &table[i];
    connect(&a);
    a.size = row->call == mesh_options_init  ? sizeof(emb_mesh_options)
             : row->call == sdf_options_init ? sizeof(emb_sdf_options)
                                             : a.size;
    reset_outputs(0);
    {
      emb_status status = row->call(&a), expected = EMB_OK;
      if (row->call == mesh_read || row->call == mesh_write) {
        expected = EMB_ERROR_IO;
      } else if (row->call == mesh_read_memory) {
        expected = EMB_ERROR_PARSE;
      }
      check_status(status, expected, row->function, __FILE__, __LINE__);
    }
    emb_geom_free(outputs.geom);
    emb_mesh_free(outputs.mesh);
    emb_pool_free(outputs.pool);
  }
  CHECK(drops == 1); /* the pool's */
  drops = 0;
}

/* A count of zero writes nothing, and the arrays may be NULL. */
static void zero_counts_write_nothing(void) {
  static const size_t empty[3][3] = {{0, 2, 2}, {3, 0, 2}, {3, 2, 0}};
  struct outputs before;
  int k;
  arguments a = good();
  connect(&a);
  memset(&outputs, 0xA5, sizeof outputs);
  before = outputs;
  a.count = 0;
  a.x = a.y = a.z = a.a = a.b = NULL;
  a.xf = a.yf = a.zf = NULL;
  CHECK_OK(values(&a));
  CHECK_OK(values_f32(&a));
  CHECK_OK(closest(&a));
  CHECK_OK(intercepts(&a));
  a.lo = a.hi = NULL;
  CHECK_OK(classify_boxes(&a));
  a.out_values = NULL, a.out_values_f32 = NULL, a.out_class = NULL;
  CHECK_OK(values(&a));
  CHECK_OK(values_f32(&a));
  CHECK_OK(classify_boxes(&a));
  for (k = 0; k < 3; k++) {
    memcpy(a.lattice_value.value.n, empty[k], sizeof empty[k]);
    CHECK_OK(fill(&a));
    CHECK_OK(crossings(&a));
  }
  a.lattice_value.value.z = NULL; /* n[2] is 0: no points, not the plane z = 0 */
  a.array_value.value.data = NULL;
  CHECK_OK(fill(&a));
  CHECK(memcmp(&before, &outputs, sizeof outputs) == 0);
  /* meshes of nothing are no meshes */
  outputs.mesh = NULL;
  a.triangle_count = 0, a.indices = NULL, a.tags = NULL;
  CHECK_STATUS(from_triangles(&a), EMB_ERROR_INVALID_ARGUMENT);
  a.face_count = 0;
  CHECK_STATUS(from_polygons(&a), EMB_ERROR_INVALID_ARGUMENT);
  a.vertex_count = 0, a.xyz = NULL, a.xyz_f32 = NULL;
  CHECK_STATUS(from_triangles(&a), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(from_triangles_f32(&a), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(outputs.mesh == NULL);
}

/* Later releases' structs: larger, what is unknown zero. */
static void larger_structs_with_zeros_are_accepted(void) {
  arguments a = good();
  size_t i;
  connect(&a);
  a.run_value.value.struct_size += 16, a.lattice_value.value.struct_size += 16;
  a.array_value.value.struct_size += 16, a.closest_value.value.struct_size += 16;
  a.hit_value.value.struct_size += 16, a.crossings_value.value.struct_size += 16;
  a.mesh_options_value.value.struct_size += 16, a.sdf_options_value.value.struct_size += 16;
  CHECK_OK(fill(&a));
  CHECK_OK(closest(&a));
  CHECK_OK(intercepts(&a));
  CHECK_OK(crossings(&a));
  CHECK_OK(from_triangles(&a));
  emb_mesh_free(outputs.mesh);
  CHECK_OK(from_mesh(&a));
  emb_geom_free(outputs.geom);
  /* results: what is unknown stays */
  memset(&outputs, 0, sizeof outputs);
  outputs.report.value.struct_size = sizeof outputs.report;
  outputs.properties.value.struct_size = sizeof outputs.properties;
  CHECK_OK(report_get(&a));
  CHECK_OK(properties_get(&a));
  CHECK(outputs.report.value.struct_size == sizeof outputs.report && outputs.report.value.closed == 1);
  CHECK(outputs.properties.value.struct_size == sizeof outputs.properties && outputs.properties.value.primitives == 1);
  for (i = 0; i < 16; i++) {
    CHECK(outputs.report.tail[i] == 0 && outputs.properties.tail[i] == 0);
  }
  outputs.report.tail[3] = 1;
  CHECK_STATUS(report_get(&a), EMB_ERROR_INVALID_ARGUMENT);
  outputs.report.value.struct_size = 16;
  CHECK_STATUS(report_get(&a), EMB_ERROR_INVALID_ARGUMENT);
  outputs.properties.value.struct_size = sizeof(size_t);
  CHECK_STATUS(properties_get(&a), EMB_ERROR_INVALID_ARGUMENT);
  /* defaults: the size given is filled and nothing beyond */
  memset(&a.sdf_options_value, 0xA5, sizeof a.sdf_options_value);
  CHECK_OK(emb_sdf_options_init(&a.sdf_options_value.value, sizeof(emb_sdf_options) + 8));
  CHECK(a.sdf_options_value.value.struct_size == sizeof(emb_sdf_options) + 8);
  for (i = 0; i < 16; i++) {
    CHECK((unsigned char)a.sdf_options_value.tail[i] == (i < 8 ? 0 : 0xA5));
  }
}

/* What cannot fail. */
static void getters_cannot_fail(void) {
  static const double turned_lo[3] = {1, 1, 1}, turned_hi[3] = {0, 2, 2}, nan_corner[3] = {0, NAN, 0};
  const double bad[3] = {NAN, INFINITY, -INFINITY};
  double out[3];
  char before[200];
  int i;
  emb_geom_sphere(NULL, 1.0, NULL);
  snprintf(before, sizeof before, "%s", emb_last_error());
  CHECK(isnan(emb_geom_value(NULL, 0, 0, 0)));
  CHECK(isnan(emb_geom_value_f32(NULL, 0, 0, 0)));
  CHECK(isnan(emb_geom_value_fn(NULL, 0, 0, 0)));
  for (i = 0; i < 3; i++) {
    CHECK(isnan(emb_geom_value(sphere, bad[i], 0, 0)));
    CHECK(isnan(emb_geom_value(sphere, 0, bad[i], 0)));
    CHECK(isnan(emb_geom_value(sphere, 0, 0, bad[i])));
    CHECK(isnan(emb_geom_value_f32(sphere, 0, (float)bad[i], 0)));
  }
  CHECK(emb_geom_fingerprint(NULL) == 0);
  CHECK(emb_geom_fingerprint(sign_only) == 0);
  CHECK(emb_geom_fingerprint(sphere) != 0);
  CHECK(emb_geom_classify_box(NULL, los, his) == 0);
  CHECK(emb_geom_classify_box(sphere, NULL, his) == 0);
  CHECK(emb_geom_classify_box(sphere, los, NULL) == 0);
  CHECK(emb_geom_classify_box(sphere, nan_corner, his) == 0);
  CHECK(emb_geom_classify_box(sphere, los, nan_corner) == 0);
  CHECK(emb_geom_classify_box(sphere, turned_lo, turned_hi) == 0);
  CHECK(emb_geom_classify_box(sphere, los, los) == -1);
  CHECK(emb_geom_clone(NULL) == NULL && emb_mesh_clone(NULL) == NULL && emb_pool_clone(NULL) == NULL);
  CHECK(emb_pool_width(NULL) == 1);
  emb_geom_free(NULL);
  emb_mesh_free(NULL);
  emb_pool_free(NULL);
  CHECK(strcmp(before, emb_last_error()) == 0);
  /* one bad point does not spoil a batch */
  CHECK_OK(emb_geom_values(sphere, 3, bad, ys, zs, 1, NULL, out));
  CHECK(isnan(out[0]) && isnan(out[1]) && isnan(out[2]));
  CHECK_OK(emb_geom_values(sphere, 3, not_finite, ys, zs, 1, NULL, out));
  CHECK(out[0] == -1.0 && isnan(out[1]) && !isnan(out[2]));
  CHECK(strcmp(before, emb_last_error()) == 0);
}

int main(void) {
  const double origin[3] = {0, 0, 0};
  size_t i;
  cube = soup_cube(0, 1);
  mesh = soup_mesh(&cube);
  CHECK_OK(emb_geom_sphere(origin, 1.0, &sphere));
  CHECK_OK(emb_geom_callback(sphere_function, NULL, NULL, NULL, &sign_only));
  good_arguments_are_accepted();
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    arguments a = good();
    connect(&a);
    check_row(&table[i], &a);
  }
  zero_counts_write_nothing();
  larger_structs_with_zeros_are_accepted();
  getters_cannot_fail();
  emb_geom_free(sphere);
  emb_geom_free(sign_only);
  emb_mesh_free(mesh);
  soup_free(&cube);
  return checks_done("misuse");
}
