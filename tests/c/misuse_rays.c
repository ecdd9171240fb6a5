/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Rays, and faces in a place, and their misuse by a table: the status is right, the message is one line that names
 * the argument, and nothing was written. */
#include "check.h"

#include <stddef.h>

/* Every argument of every function, with values that are good. Calls write only to what is listed in `outputs`. */
typedef struct arguments {
  size_t count, t_stride;
  const double *origin, *direction, *t_min, *t_max;
  const size_t *offsets;
  size_t *out_offsets;
  const double *lo, *hi, *point;
  double radius;
  size_t capacity, *out_count;
  int64_t *out_faces;
  const emb_geom *g;
  const emb_run *run;
  const emb_ray_out *out;
  /* what the struct pointers above point to */
  struct { emb_run value; char tail[16]; } run_value;
  struct { emb_ray_out value; char tail[16]; } out_value;
} arguments;

/* Everything that a call may write to. */
static struct outputs {
  double t[8], normal[24];
  int64_t primitive[8];
  int32_t labels[3][8];
  size_t offsets[3];
} outputs;

/* Through the middle of the cube from x = -1 to 2, and past it. */
static const double xs[8] = {-2, 0.5, 0.25, -2, 5, 5}, along[6] = {1, 0, 0, 1, 0, 0};
static const double from[2] = {0, 1}, to[2] = {2, 9}, zeros[6] = {1, 0, 0, 0, -0.0, 0}, nans[2] = {0, NAN};
static const size_t good_offsets[3] = {0, 2, 2}, late[3] = {1, 2, 2}, falling[3] = {0, 2, 1}, many[3] = {0, 1, 2};
static const double los[3] = {0, 0, 0}, his[3] = {0.25, 0.125, INFINITY}, below[3] = {0, -1, 1};
static const double nan_corner[3] = {0, NAN, 1};
static emb_geom *cube_geom, *sphere;
static int drops;

static arguments good(void) {
  arguments a;
  memset(&a, 0, sizeof a);
  a.count = 2, a.t_stride = 1;
  a.origin = xs, a.direction = along;
  a.offsets = good_offsets, a.out_offsets = outputs.offsets;
  a.lo = los, a.hi = his, a.point = los, a.radius = 0.5;
  a.capacity = 8, a.out_faces = outputs.primitive, a.out_count = outputs.offsets;
  a.g = cube_geom;
  a.run_value.value.struct_size = sizeof(emb_run);
  a.out_value.value.struct_size = sizeof(emb_ray_out);
  a.out_value.value.t = outputs.t;
  a.out_value.value.side = outputs.labels[0];
  a.out_value.value.normal[0] = outputs.normal;
  a.out_value.value.normal[1] = outputs.normal + 1;
  a.out_value.value.normal[2] = outputs.normal + 2;
  a.out_value.value.vector_stride = 3;
  a.out_value.value.primitive = outputs.primitive;
  a.out_value.value.part = outputs.labels[1];
  a.out_value.value.tag = outputs.labels[2];
  return a;
}

/* Points the struct pointers into the copy of the arguments that a call is given. */
static void connect(arguments *a) { a->run = &a->run_value.value, a->out = &a->out_value.value; }

static void reset_outputs(int byte) { memset(&outputs, byte, sizeof outputs); }

#include "misuse.h"

CALL(rays, emb_geom_rays(a->g, a->count, a->origin, a->direction, a->t_min, a->t_max, a->t_stride, a->run, a->out))
CALL(ray_counts, emb_geom_ray_counts(a->g, a->count, a->origin, a->direction, a->t_min, a->t_max, a->t_stride, a->run,
                                     a->out_offsets))
CALL(ray_hits, emb_geom_ray_hits(a->g, a->count, a->origin, a->direction, a->t_min, a->t_max, a->t_stride, a->offsets,
                                 a->run, a->out))

CALL(overlapping, emb_geom_overlapping(a->g, a->lo, a->hi, a->capacity, a->out_faces, a->out_count))
CALL(within, emb_geom_within(a->g, a->point, a->radius, a->capacity, a->out_faces, a->out_count))

#define RAYS(call)                                                                                                \
  NULLED(call, g, "g"), HELD(call, g, &sphere, EMB_ERROR_UNSUPPORTED, "a shape"),                                 \
  NULLED(call, origin, "origin"), BENT(call, origin, "origin"),                                                   \
  NULLED(call, direction, "direction"), BENT(call, direction, "direction"), BENT(call, t_min, "t_min"),           \
  POINTED(call, origin, not_finite, EMB_ERROR_INVALID_ARGUMENT, "origin: ray 0"),                                 \
  POINTED(call, direction, zeros, EMB_ERROR_INVALID_ARGUMENT, "direction: ray 1"),                                \
  POINTED(call, direction, not_finite, EMB_ERROR_INVALID_ARGUMENT, "direction: ray 0"),                           \
  POINTED(call, t_max, nans, EMB_ERROR_INVALID_ARGUMENT, "t_min, t_max: ray 1"),                                  \
  POINTED(call, t_min, nans, EMB_ERROR_INVALID_ARGUMENT, "t_min, t_max: ray 1"),                                  \
  POINTED(call, t_max, xs, EMB_ERROR_INVALID_ARGUMENT, "t_min, t_max: ray 0"),                                    \
  SIZED(call, count, SIZE_MAX, "count"), SIZED(call, count, SIZE_MAX / 16, "count"),                              \
  SIZED(call, t_stride, 2, "t_stride: 2"), RUN(call)
#define OUT(call)                                                                                                 \
  NULLED(call, out, "out"), VERSIONED(call, out_value, emb_ray_out, "out"),                                       \
  BENT(call, out_value.value.t, "out.t"), BENT(call, out_value.value.side, "out.side"),                           \
  BENT(call, out_value.value.normal[2], "out.normal[2]"), BENT(call, out_value.value.primitive, "out.primitive"), \
  BENT(call, out_value.value.part, "out.part"), BENT(call, out_value.value.tag, "out.tag"),                       \
  SIZED(call, out_value.value.vector_stride, 0, "out.vector_stride"),                                             \
  SIZED(call, out_value.value.vector_stride, SIZE_MAX, "out.vector_stride")

#define FACES(call)                                                                                               \
  NULLED(call, g, "g"), HELD(call, g, &sphere, EMB_ERROR_UNSUPPORTED, "a shape"),                                 \
  SIZED(call, capacity, 1, "capacity: 1"),                                                                        \
  NULLED(call, out_faces, "out_faces"), BENT(call, out_faces, "out_faces"), NULLED(call, out_count, "out_count"), \
  BENT(call, out_count, "out_count")

static const misuse table[] = {
    FACES(overlapping),
    NULLED(overlapping, lo, "lo"),
    NULLED(overlapping, hi, "hi"),
    POINTED(overlapping, lo, nan_corner, EMB_ERROR_INVALID_ARGUMENT, "lo, hi"),
    POINTED(overlapping, hi, nan_corner, EMB_ERROR_INVALID_ARGUMENT, "lo, hi"),
    POINTED(overlapping, hi, below, EMB_ERROR_INVALID_ARGUMENT, "lo, hi"),
    FACES(within),
    NULLED(within, point, "point"),
    POINTED(within, point, nan_corner, EMB_ERROR_INVALID_ARGUMENT, "point"),
    REAL_ONE(within, radius, NAN, "radius"),
    REAL_ONE(within, radius, -1e-9, "radius"),
    RAYS(rays),
    OUT(rays),
    RAYS(ray_counts),
    NULLED(ray_counts, out_offsets, "out_offsets"),
    BENT(ray_counts, out_offsets, "out_offsets"),
    RAYS(ray_hits),
    OUT(ray_hits),
    NULLED(ray_hits, offsets, "offsets"),
    BENT(ray_hits, offsets, "offsets"),
    POINTED(ray_hits, offsets, late, EMB_ERROR_INVALID_ARGUMENT, "offsets"),
    POINTED(ray_hits, offsets, falling, EMB_ERROR_INVALID_ARGUMENT, "offsets[2]: 1"),
    POINTED(ray_hits, offsets, many, EMB_ERROR_INVALID_ARGUMENT, "offsets[1]: room for 1"),
};

static void rays_are_answered(void) {
  arguments a = good();
  connect(&a);
  reset_outputs(0xA5);
  CHECK_OK(rays(&a));
  CHECK(outputs.t[0] == 2.0 && isnan(outputs.t[1]));
  CHECK(outputs.normal[0] == -1.0 && outputs.normal[1] == 0.0 && outputs.normal[2] == 0.0 && isnan(outputs.normal[3]));
  CHECK(outputs.labels[0][0] == -1 && outputs.labels[0][1] == 0);
  CHECK(outputs.primitive[0] >= 0 && outputs.primitive[1] == -1 && outputs.labels[2][1] == -1);
  CHECK_OK(ray_counts(&a));
  CHECK(memcmp(outputs.offsets, good_offsets, sizeof good_offsets) == 0);
  CHECK_OK(ray_hits(&a));
  CHECK(outputs.t[0] == 2.0 && outputs.t[1] == 3.0 && outputs.labels[0][0] == -1 && outputs.labels[0][1] == 1);
  CHECK(outputs.normal[3] == 1.0);
  /* a range for each, and one for all */
  a.t_min = from, a.t_max = to;
  CHECK_OK(rays(&a));
  CHECK(outputs.t[0] == 2.0);
  a.t_min = to, a.t_max = NULL, a.t_stride = 0;
  CHECK_OK(ray_counts(&a));
  CHECK(outputs.offsets[1] == 2);
  a.t_max = to;
  CHECK_OK(ray_counts(&a));
  CHECK(outputs.offsets[0] == 0 && outputs.offsets[1] == 1 && outputs.offsets[2] == 1);
  /* no rays */
  a.count = 0, a.origin = a.direction = a.t_min = a.t_max = NULL;
  CHECK_OK(rays(&a));
  CHECK_OK(ray_counts(&a));
  CHECK_OK(ray_hits(&a));
  CHECK(outputs.offsets[0] == 0 && outputs.offsets[1] == 1);
}

static void faces_are_listed(void) {
  arguments a = good();
  size_t count;
  connect(&a);
  reset_outputs(0xA5);
  CHECK_OK(overlapping(&a));
  count = outputs.offsets[0];
  CHECK(count > 1 && count <= 8 && outputs.primitive[0] >= 0 && outputs.primitive[count - 1] < 12);
  a.capacity = 0, a.out_faces = NULL;
  CHECK_OK(overlapping(&a));
  CHECK(outputs.offsets[0] == count);
  a.radius = 0.0;
  CHECK_OK(within(&a));
  CHECK(outputs.offsets[0] >= 3);
  a.radius = INFINITY;
  CHECK_OK(within(&a));
  CHECK(outputs.offsets[0] == 12);
}

int main(void) {
  const double origin[3] = {0, 0, 0};
  soup cube = soup_cube(0, 1);
  emb_mesh *mesh = soup_mesh(&cube);
  size_t i;
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &cube_geom));
  CHECK_OK(emb_geom_sphere(origin, 1.0, &sphere));
  rays_are_answered();
  faces_are_listed();
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    arguments a = good();
    connect(&a);
    check_row(&table[i], &a);
  }
  emb_geom_free(cube_geom);
  emb_geom_free(sphere);
  emb_mesh_free(mesh);
  soup_free(&cube);
  return checks_done("misuse_rays");
}
