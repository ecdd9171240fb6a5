/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Misuse of what makes geometries, by a table: each constructor with each argument NULL, out of range, not finite or
 * unknown. The status is right, the message is one line that names the argument, and nothing was written. */
#include "check.h"

#include <stddef.h>

/* Every argument of every constructor, with values that are good. */
typedef struct arguments {
  size_t count, size;
  double small, large, height, angle, z_lo, z_hi;
  int32_t part, sides, octaves, plane, samples, depth;
  const double *point, *end, *axis, *toward, *half, *lo, *hi, *rotation, *shift, *corners;
  const int32_t *counts;
  const char *text;
  const emb_geom *g, *second;
  const emb_geom *const *parts;
  emb_value_fn value;
  const emb_lattice *lattice;
  const emb_array *array;
  emb_blend *blend;
  emb_callback_options *callback_options;
  emb_expression_options *expression_options;
  emb_geom **out_geom;
  double *out_lo, *out_hi;
  int32_t *out_state;
  /* what the struct pointers above point to */
  struct { emb_lattice value; char tail[16]; } lattice_value;
  struct { emb_array value; char tail[16]; } array_value;
  struct { emb_blend value; char tail[16]; } blend_value;
  struct { emb_callback_options value; char tail[16]; } callback_options_value;
  struct { emb_expression_options value; char tail[16]; } expression_options_value;
} arguments;

/* Everything that a call may write to. */
static struct outputs {
  emb_geom *geom;
  double lo[3], hi[3];
  int32_t state;
} outputs;

static const double xs[8] = {0, 1, 2, 3, 4, 5, 6, 7}, zero[9] = {0}, up[3] = {0, 0, 2}, aside[3] = {3, 0, 1},
                    half[3] = {1, 2, 3}, square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
static const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1}, identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const int32_t counts[3] = {2, 1, 3};
static double samples[16] = {1, 2, -1, 0, 3, 1, 1, 2, -1, 0, 3, 1};
static const emb_geom *parts[4];
static emb_geom *sphere, *sign_only;
static int drops;

static double least(void *user, double a, double b, double *out_by_a, double *out_by_b) {
  (void)user, (void)b, (void)out_by_a, (void)out_by_b;
  return a;
}

static arguments good(void) {
  arguments a;
  memset(&a, 0, sizeof a);
  a.count = 4;
  a.small = 0.5, a.large = 2.0, a.height = 3.0, a.angle = 60.0, a.z_lo = -1.0, a.z_hi = 1.0;
  a.part = 3, a.sides = 6, a.octaves = 2, a.plane = 1, a.samples = 3, a.depth = 4;
  a.point = zero, a.end = a.axis = up, a.toward = aside, a.half = half, a.lo = lo, a.hi = hi;
  a.rotation = identity, a.shift = xs, a.corners = square, a.counts = counts;
  a.text = "x^2 + y^2 - 1";
  a.g = a.second = sphere, a.parts = parts;
  a.value = sphere_function;
  a.out_geom = &outputs.geom, a.out_lo = outputs.lo, a.out_hi = outputs.hi, a.out_state = &outputs.state;
  a.lattice_value.value.struct_size = sizeof(emb_lattice);
  a.lattice_value.value.n[0] = 3, a.lattice_value.value.n[1] = 2, a.lattice_value.value.n[2] = 2;
  a.lattice_value.value.x = a.lattice_value.value.y = a.lattice_value.value.z = xs;
  a.array_value.value.struct_size = sizeof(emb_array);
  a.array_value.value.data = samples;
  emb_blend_init(&a.blend_value.value, sizeof(emb_blend));
  a.blend_value.value.width = 0.25;
  a.blend_value.value.user = &drops, a.blend_value.value.drop = count_drop, a.blend_value.value.blend = least;
  emb_callback_options_init(&a.callback_options_value.value, sizeof(emb_callback_options));
  emb_expression_options_init(&a.expression_options_value.value, sizeof(emb_expression_options));
  return a;
}

/* The arguments of a height field have one axis less. */
static arguments flat(void) {
  arguments a = good();
  a.lattice_value.value.n[2] = 1, a.lattice_value.value.z = NULL;
  return a;
}

/* The blend is the caller's. */
static arguments custom(void) {
  arguments a = good();
  a.blend_value.value.kind = EMB_BLEND_CUSTOM;
  return a;
}

/* Points the struct pointers into the copy of the arguments that a call is given. */
static void connect(arguments *a) {
  a->lattice = &a->lattice_value.value, a->array = &a->array_value.value, a->blend = &a->blend_value.value;
  a->callback_options = &a->callback_options_value.value;
  a->expression_options = &a->expression_options_value.value;
}

/* What may be written, as a call finds it. */
static void reset_outputs(int byte) {
  memset(&outputs, byte, sizeof outputs);
}

#include "misuse.h"

CALL(geom_sphere, emb_geom_sphere(a->point, a->small, a->out_geom))
CALL(geom_box, emb_geom_box(a->lo, a->hi, a->out_geom))
CALL(plane, emb_geom_plane(a->point, a->axis, a->out_geom))
CALL(torus, emb_geom_torus(a->point, a->axis, a->large, a->small, a->out_geom))
CALL(cylinder, emb_geom_cylinder(a->point, a->end, a->small, a->out_geom))
CALL(infinite_cylinder, emb_geom_infinite_cylinder(a->point, a->axis, a->small, a->out_geom))
CALL(capsule, emb_geom_capsule(a->point, a->end, a->small, a->out_geom))
CALL(capsule_tips, emb_geom_capsule_tips(a->point, a->end, a->small, a->out_geom))
CALL(infinite_cone, emb_geom_infinite_cone(a->point, a->axis, a->angle, a->out_geom))
CALL(cone, emb_geom_cone(a->point, a->axis, a->large, a->angle, a->out_geom))
CALL(rounded_box, emb_geom_rounded_box(a->point, a->half, a->small, a->rotation, a->out_geom))
CALL(rounded_cylinder, emb_geom_rounded_cylinder(a->point, a->axis, a->large, a->height, a->small, a->out_geom))
CALL(ellipsoid, emb_geom_ellipsoid(a->point, a->half, a->rotation, a->out_geom))
CALL(prism, emb_geom_prism(a->point, a->end, a->toward, a->sides, a->large, a->out_geom))
CALL(extruded_polygon, emb_geom_extruded_polygon(a->point, a->rotation, a->count, a->corners, a->z_lo, a->z_hi,
                                                 a->out_geom))
CALL(revolved_polygon, emb_geom_revolved_polygon(a->point, a->axis, a->count, a->corners, a->out_geom))
CALL(perlin, emb_geom_perlin(a->large, a->half, a->small, a->octaves, 7, a->out_geom))
CALL(height_field, emb_geom_height_field(a->lattice, a->array, a->out_geom))
CALL(grid, emb_geom_grid(a->lattice, a->array, a->out_geom))
CALL(expression, emb_geom_expression(a->text, a->expression_options, a->out_geom))
CALL(geom_union, emb_geom_union(a->count, a->parts, a->out_geom))
CALL(geom_intersection, emb_geom_intersection(a->count, a->parts, a->out_geom))
CALL(geom_difference, emb_geom_difference(a->g, a->second, a->out_geom))
CALL(difference_of_many, emb_geom_difference_of_many(a->g, a->count, a->parts, a->out_geom))
CALL(geom_complement, emb_geom_complement(a->g, a->out_geom))
CALL(smooth_union, emb_geom_smooth_union(a->count, a->parts, a->blend, a->out_geom))
CALL(smooth_intersection, emb_geom_smooth_intersection(a->count, a->parts, a->blend, a->out_geom))
CALL(smooth_difference, emb_geom_smooth_difference(a->g, a->count, a->parts, a->blend, a->out_geom))
CALL(repeat, emb_geom_repeat(a->g, a->half, a->counts, a->out_geom))
CALL(simplify, emb_geom_simplify(a->g, a->lo, a->hi, a->out_geom))
CALL(bounding_box, emb_geom_bounding_box(a->g, a->lo, a->hi, a->depth, a->small, NULL, a->out_lo, a->out_hi,
                                         a->out_state))
CALL(bounding_sphere, emb_geom_bounding_sphere(a->g, a->lo, a->hi, a->depth, a->small, NULL, a->out_lo, a->out_hi,
                                               a->out_state))
CALL(geom_translate, emb_geom_translate(a->g, a->shift, a->out_geom))
CALL(geom_place, emb_geom_place(a->g, a->rotation, a->shift, a->out_geom))
CALL(rotate, emb_geom_rotate(a->g, a->axis, a->angle, a->point, a->out_geom))
CALL(scale, emb_geom_scale(a->g, a->small, a->out_geom))
CALL(reflect, emb_geom_reflect(a->g, a->plane, a->out_geom))
CALL(reflect_in, emb_geom_reflect_in(a->g, a->point, a->axis, a->out_geom))
CALL(affine, emb_geom_affine(a->g, a->rotation, a->shift, a->out_geom))
CALL(offset, emb_geom_offset(a->g, a->small, a->out_geom))
CALL(annular, emb_geom_annular(a->g, a->small, a->out_geom))
CALL(lower_bound, emb_geom_lower_bound(a->g, a->out_geom))
CALL(blur, emb_geom_blur(a->g, a->large, a->small, a->out_geom))
CALL(mollify, emb_geom_mollify(a->g, a->small, a->samples, a->out_geom))
CALL(elongate, emb_geom_elongate(a->g, a->half, a->out_geom))
CALL(twist, emb_geom_twist(a->g, a->angle, a->out_geom))
CALL(slice, emb_geom_slice(a->g, a->point, a->axis, a->toward, a->out_geom))
CALL(geom_part, emb_geom_part(a->g, a->part, a->out_geom))
CALL(geom_callback, emb_geom_callback(a->value, &drops, count_drop, a->callback_options, a->out_geom))
CALL(callback_options_init, emb_callback_options_init(a->callback_options, a->size))
CALL(expression_options_init, emb_expression_options_init(a->expression_options, a->size))
CALL(blend_init, emb_blend_init(a->blend, a->size))

static const double nan_second[9] = {1, NAN, 2, 3, 4, 5, 6, 7, 8}, infinite[9] = {1, INFINITY, 1}, stretched[9] = {2, 0, 0, 0, 1, 0, 0, 0, 1},
                    mirrored[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1}, singular[9] = {1, 0, 0, 0, 1, 0, 1, 1, 0};
static const double negative[3] = {1, -2, 1}, crossed[8] = {0, 0, 1, 1, 1, 0, 0, 1}, left[8] = {-1, 0, 1, 0, 1, 1, 0, 1},
                    twice[8] = {0, 0, 1, 0, 1, 0, 0, 1}, hollow[3] = {1, 0, 3};
static const int32_t no_copies[3] = {2, 0, 3}, many_copies[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
static double gaps[16] = {1, 2, NAN, 0};
static float gaps_f32[16] = {1, 2, 3, INFINITY};
static const emb_geom *hollow_parts[4];

#define BOUNDING(call, first, second)                                                                          \
  NULLED(call, g, "g"), NULLED(call, lo, "start_lo"), NULLED(call, hi, "start_hi"), BENT(call, lo, "start_lo"), \
  NULLED(call, out_lo, first), NULLED(call, out_hi, second), NULLED(call, out_state, "out_state"),              \
  POINTED(call, hi, infinite, EMB_ERROR_INVALID_ARGUMENT, "start_hi[1]: 0 to inf"),                             \
  POINTED(call, hi, lo, EMB_ERROR_INVALID_ARGUMENT, "start_hi[0]: 0 to 0"),                                     \
  INTEGER(call, depth, 0, EMB_ERROR_INVALID_ARGUMENT, "depth: 0"),                                              \
  INTEGER(call, depth, 17, EMB_ERROR_INVALID_ARGUMENT, "depth: 17"), NOT_FINITE(call, small, "safety"),         \
  REAL_ONE(call, small, -1.0, "safety: -1")
#define OUT(call) NULLED(call, out_geom, "out_geom")
#define VECTOR(call, member, name)                                                                            \
  NULLED(call, member, name), BENT(call, member, name),                                                       \
  POINTED(call, member, nan_second, EMB_ERROR_INVALID_ARGUMENT, name "[1]: NaN"),                             \
  POINTED(call, member, infinite, EMB_ERROR_INVALID_ARGUMENT, name "[1]: inf")
#define AXIS(call, member, name) VECTOR(call, member, name), POINTED(call, member, zero, EMB_ERROR_INVALID_ARGUMENT, name)
#define POSITIVE(call, member, name) \
  NOT_FINITE(call, member, name), REAL_ONE(call, member, 0.0, name ": 0"), REAL_ONE(call, member, -2.0, name ": -2")
#define FINITE(call, member, name)                                                                       \
  REAL_ONE(call, member, NAN, name ": NaN"), REAL_ONE(call, member, INFINITY, name ": inf"),             \
  REAL_ONE(call, member, -INFINITY, name ": -inf")
#define CONE(call)                                                                                       \
  NOT_FINITE(call, angle, "angle"), REAL_ONE(call, angle, 0.0, "angle: 0"),                              \
  REAL_ONE(call, angle, 180.0, "angle: 180"), REAL_ONE(call, angle, -20.0, "angle: -20")
#define TURN(call)                                                                             \
  BENT(call, rotation, "rotation"),                                                            \
  POINTED(call, rotation, not_finite, EMB_ERROR_INVALID_ARGUMENT, "rotation[1]: NaN"),         \
  POINTED(call, rotation, stretched, EMB_ERROR_INVALID_ARGUMENT, "rotation"),                  \
  POINTED(call, rotation, mirrored, EMB_ERROR_INVALID_ARGUMENT, "rotation")
#define CORNERS(call)                                                                          \
  NULLED(call, corners, "points"), BENT(call, corners, "points"),                              \
  POINTED(call, corners, not_finite, EMB_ERROR_INVALID_ARGUMENT, "points[0][1]: NaN"),         \
  POINTED(call, corners, crossed, EMB_ERROR_INVALID_ARGUMENT, "points: edges"),                \
  POINTED(call, corners, twice, EMB_ERROR_INVALID_ARGUMENT, "points[2]"),                      \
  SIZED(call, count, 2, "points: 2"), SIZED(call, count, 0, "points: 0"),                      \
  SIZED(call, count, SIZE_MAX, "count"), SIZED(call, count, SIZE_MAX / 2, "count")
#define SAMPLES(call, name)                                                                              \
  NULLED(call, array, name), VERSIONED(call, array_value, emb_array, name),                              \
  NULLED(call, array_value.value.data, name ".data"), BENT(call, array_value.value.data, name ".data"),  \
  UNKNOWN(call, array_value.value.type, name ".type"),                                                   \
  INTEGER(call, array_value.value.type, EMB_I32, EMB_ERROR_INVALID_ARGUMENT, name ".type"),              \
  INTEGER(call, array_value.value.type, EMB_I8, EMB_ERROR_INVALID_ARGUMENT, name ".type"),               \
  POINTED(call, array_value.value.data, gaps, EMB_ERROR_INVALID_ARGUMENT, name "[2]: NaN"),              \
  {#call " sharing", call, STEP, AT(array_value), NULL, 1, 0, 0, EMB_ERROR_INVALID_ARGUMENT, name ".stride[1]: 2"},    \
  SIZED(call, lattice_value.value.n[0], 1, "lattice.n[0]: 1"),                                           \
  SIZED(call, lattice_value.value.n[1], 0, "lattice.n[1]: 0"),                                           \
  POINTED(call, lattice_value.value.x, zero, EMB_ERROR_INVALID_ARGUMENT, "x[1]: 0")
#define PARTS(call, name)                                                                                \
  NULLED(call, parts, name), BENT(call, parts, name), SIZED(call, count, SIZE_MAX, "count"),             \
  POINTED(call, parts, hollow_parts, EMB_ERROR_NULL_ARGUMENT, name "[1]: NULL")
#define BLEND(call)                                                                                      \
  NULLED(call, blend, "blend"), VERSIONED(call, blend_value, emb_blend, "blend"),                        \
  UNKNOWN(call, blend_value.value.kind, "blend.kind"), POSITIVE(call, blend_value.value.width, "blend.width")

static const misuse table[] = {
    NULLED(geom_sphere, point, "center"),
    NULLED(geom_sphere, out_geom, "out_geom"),
    BENT(geom_sphere, point, "center"),
    POINTED(geom_sphere, point, not_finite, EMB_ERROR_INVALID_ARGUMENT, "center[1]: NaN"),
    POINTED(geom_sphere, point, infinite, EMB_ERROR_INVALID_ARGUMENT, "center[1]: inf"),
    NOT_FINITE(geom_sphere, small, "radius"),
    REAL_ONE(geom_sphere, small, 0.0, "radius: 0"),
    REAL_ONE(geom_sphere, small, -1.0, "radius: -1"),
    NULLED(geom_box, lo, "lo"),
    NULLED(geom_box, hi, "hi"),
    NULLED(geom_box, out_geom, "out_geom"),
    POINTED(geom_box, lo, not_finite, EMB_ERROR_INVALID_ARGUMENT, "lo[1]"),
    POINTED(geom_box, hi, infinite, EMB_ERROR_INVALID_ARGUMENT, "hi[1]"),
    POINTED(geom_box, hi, lo, EMB_ERROR_INVALID_ARGUMENT, "hi[0]"),
    OUT(plane), VECTOR(plane, point, "point"), AXIS(plane, axis, "normal"),
    OUT(torus), VECTOR(torus, point, "center"), AXIS(torus, axis, "axis"), POSITIVE(torus, large, "major"),
    POSITIVE(torus, small, "minor"), REAL_ONE(torus, small, 2.0, "minor: 2"), REAL_ONE(torus, small, 3.0, "minor: 3"),
    OUT(cylinder), VECTOR(cylinder, point, "a"), VECTOR(cylinder, end, "b"), POSITIVE(cylinder, small, "radius"),
    POINTED(cylinder, end, zero, EMB_ERROR_INVALID_ARGUMENT, "b - a"),
    OUT(infinite_cylinder), VECTOR(infinite_cylinder, point, "point"), AXIS(infinite_cylinder, axis, "axis"),
    POSITIVE(infinite_cylinder, small, "radius"),
    OUT(capsule), VECTOR(capsule, point, "a"), VECTOR(capsule, end, "b"), POSITIVE(capsule, small, "radius"),
    POINTED(capsule, end, zero, EMB_ERROR_INVALID_ARGUMENT, "b - a"),
    OUT(capsule_tips), VECTOR(capsule_tips, point, "tip_a"), VECTOR(capsule_tips, end, "tip_b"),
    POSITIVE(capsule_tips, small, "radius"), REAL_ONE(capsule_tips, small, 1.0, "radius: 1"),
    POINTED(capsule_tips, end, zero, EMB_ERROR_INVALID_ARGUMENT, "tip_b - tip_a"),
    OUT(infinite_cone), VECTOR(infinite_cone, point, "tip"), AXIS(infinite_cone, axis, "axis"), CONE(infinite_cone),
    OUT(cone), VECTOR(cone, point, "tip"), AXIS(cone, axis, "axis"), CONE(cone), POSITIVE(cone, large, "height"),
    OUT(rounded_box), VECTOR(rounded_box, point, "center"), VECTOR(rounded_box, half, "half"), TURN(rounded_box),
    POINTED(rounded_box, half, hollow, EMB_ERROR_INVALID_ARGUMENT, "half[1]: 0"),
    POINTED(rounded_box, half, negative, EMB_ERROR_INVALID_ARGUMENT, "half[1]: -2"),
    NOT_FINITE(rounded_box, small, "radius"), REAL_ONE(rounded_box, small, -1.0, "radius: -1"),
    REAL_ONE(rounded_box, small, 1.5, "radius: 1.5"),
    OUT(rounded_cylinder), VECTOR(rounded_cylinder, point, "center"), AXIS(rounded_cylinder, axis, "axis"),
    POSITIVE(rounded_cylinder, large, "radius"), POSITIVE(rounded_cylinder, height, "height"),
    NOT_FINITE(rounded_cylinder, small, "rounding"), REAL_ONE(rounded_cylinder, small, -1.0, "rounding: -1"),
    REAL_ONE(rounded_cylinder, small, 1.75, "rounding: 1.75"),
    OUT(ellipsoid), VECTOR(ellipsoid, point, "center"), VECTOR(ellipsoid, half, "semi_axes"), TURN(ellipsoid),
    POINTED(ellipsoid, half, hollow, EMB_ERROR_INVALID_ARGUMENT, "semi_axes[1]: 0"),
    POINTED(ellipsoid, half, negative, EMB_ERROR_INVALID_ARGUMENT, "semi_axes[1]: -2"),
    OUT(prism), VECTOR(prism, point, "a"), VECTOR(prism, end, "b"), AXIS(prism, toward, "toward"),
    POINTED(prism, end, zero, EMB_ERROR_INVALID_ARGUMENT, "b - a"),
    POINTED(prism, toward, up, EMB_ERROR_INVALID_ARGUMENT, "toward"), POSITIVE(prism, large, "radius"),
    INTEGER(prism, sides, 2, EMB_ERROR_INVALID_ARGUMENT, "sides: 2"),
    INTEGER(prism, sides, -3, EMB_ERROR_INVALID_ARGUMENT, "sides: -3"),
    INTEGER(prism, sides, 1001, EMB_ERROR_INVALID_ARGUMENT, "sides: 1001"),
    OUT(extruded_polygon), VECTOR(extruded_polygon, point, "origin"), TURN(extruded_polygon), CORNERS(extruded_polygon),
    FINITE(extruded_polygon, z_lo, "z_lo"), FINITE(extruded_polygon, z_hi, "z_hi"),
    REAL_ONE(extruded_polygon, z_hi, -1.0, "z_hi: -1"), REAL_ONE(extruded_polygon, z_lo, 2.0, "z_lo = 2"),
    OUT(revolved_polygon), VECTOR(revolved_polygon, point, "origin"), AXIS(revolved_polygon, axis, "axis"),
    CORNERS(revolved_polygon), POINTED(revolved_polygon, corners, left, EMB_ERROR_INVALID_ARGUMENT, "points[0][0]: -1"),
    OUT(perlin), VECTOR(perlin, half, "frequency"), POSITIVE(perlin, large, "amplitude"),
    POSITIVE(perlin, small, "persistence"), POINTED(perlin, half, negative, EMB_ERROR_INVALID_ARGUMENT, "frequency[1]: -2"),
    INTEGER(perlin, octaves, 0, EMB_ERROR_INVALID_ARGUMENT, "octaves: 0"),
    INTEGER(perlin, octaves, -1, EMB_ERROR_INVALID_ARGUMENT, "octaves: -1"),
    INTEGER(perlin, octaves, 17, EMB_ERROR_INVALID_ARGUMENT, "octaves: 17"),

    OUT(grid), LATTICE(grid), SAMPLES(grid, "values"), SIZED(grid, lattice_value.value.n[2], 1, "lattice.n[2]: 1"),
    {"grid beyond", grid, STEP, AT(array_value), NULL, 3, 0, 0, EMB_ERROR_INVALID_ARGUMENT, "values.stride[2]"},
    OUT(expression), NULLED(expression, text, "expression"),
    POINTED(expression, text, "", EMB_ERROR_INVALID_ARGUMENT, "expression: the text is empty"),
    POINTED(expression, text, "x +* 2", EMB_ERROR_INVALID_ARGUMENT, "expression"),
    POINTED(expression, text, "w", EMB_ERROR_INVALID_ARGUMENT, "'w'"),
    POINTED(expression, text, "x + \xff", EMB_ERROR_INVALID_ARGUMENT, "expression: byte 4"),
    VERSIONED(expression, expression_options_value, emb_expression_options, "options"),
    REAL_ONE(expression, expression_options_value.value.lo[1], NAN, "options.lo[1]"),
    REAL_ONE(expression, expression_options_value.value.lo[2], INFINITY, "options.lo[2]"),
    REAL_ONE(expression, expression_options_value.value.hi[0], NAN, "hi[0]"),
    NOT_FINITE(expression, expression_options_value.value.lipschitz, "options.lipschitz"),
    REAL_ONE(expression, expression_options_value.value.lipschitz, -1.0, "options.lipschitz: -1"),

    NULLED(geom_union, parts, "parts"),
    NULLED(geom_union, out_geom, "out_geom"),
    BENT(geom_union, parts, "parts"),
    SIZED(geom_union, count, SIZE_MAX, "count"),
    POINTED(geom_union, parts, hollow_parts, EMB_ERROR_NULL_ARGUMENT, "parts[1]"),
    NULLED(geom_intersection, parts, "parts"),
    NULLED(geom_intersection, out_geom, "out_geom"),
    SIZED(geom_intersection, count, SIZE_MAX, "count"),
    POINTED(geom_intersection, parts, hollow_parts, EMB_ERROR_NULL_ARGUMENT, "parts[1]"),
    NULLED(geom_difference, g, "from"),
    NULLED(geom_difference, second, "remove"),
    NULLED(geom_difference, out_geom, "out_geom"),
    OUT(difference_of_many), NULLED(difference_of_many, g, "from"), PARTS(difference_of_many, "remove"),
    OUT(smooth_union), PARTS(smooth_union, "parts"), BLEND(smooth_union),
    OUT(smooth_intersection), PARTS(smooth_intersection, "parts"), BLEND(smooth_intersection),
    OUT(smooth_difference), NULLED(smooth_difference, g, "from"), PARTS(smooth_difference, "remove"),
    BLEND(smooth_difference),
    OUT(repeat), NULLED(repeat, g, "g"), VECTOR(repeat, half, "period"), NULLED(repeat, counts, "counts"),
    BENT(repeat, counts, "counts"), POINTED(repeat, counts, no_copies, EMB_ERROR_INVALID_ARGUMENT, "counts[1]: 0"),
    POINTED(repeat, counts, many_copies, EMB_ERROR_INVALID_ARGUMENT, "counts: 2147483647"),
    OUT(simplify), NULLED(simplify, g, "g"), NULLED(simplify, lo, "lo"), NULLED(simplify, hi, "hi"),
    BENT(simplify, lo, "lo"), POINTED(simplify, hi, infinite, EMB_ERROR_INVALID_ARGUMENT, "lo, hi"),
    POINTED(simplify, lo, half, EMB_ERROR_INVALID_ARGUMENT, "lo, hi"),
    BOUNDING(bounding_box, "out_lo", "out_hi"), BOUNDING(bounding_sphere, "out_center", "out_radius"),
    NULLED(geom_complement, g, "g"),
    NULLED(geom_complement, out_geom, "out_geom"),
    NULLED(geom_translate, g, "g"),
    NULLED(geom_translate, shift, "shift"),
    NULLED(geom_translate, out_geom, "out_geom"),
    POINTED(geom_translate, shift, not_finite, EMB_ERROR_INVALID_ARGUMENT, "shift[1]"),
    POINTED(geom_translate, shift, infinite, EMB_ERROR_INVALID_ARGUMENT, "shift[1]"),
    NULLED(geom_place, g, "g"),
    NULLED(geom_place, rotation, "rotation"),
    NULLED(geom_place, shift, "shift"),
    NULLED(geom_place, out_geom, "out_geom"),
    POINTED(geom_place, rotation, not_finite, EMB_ERROR_INVALID_ARGUMENT, "rotation[1]"),
    POINTED(geom_place, rotation, stretched, EMB_ERROR_INVALID_ARGUMENT, "rotation"),
    POINTED(geom_place, rotation, mirrored, EMB_ERROR_INVALID_ARGUMENT, "rotation"),
    POINTED(geom_place, shift, infinite, EMB_ERROR_INVALID_ARGUMENT, "shift[1]"),
    OUT(rotate), NULLED(rotate, g, "g"), AXIS(rotate, axis, "axis"), FINITE(rotate, angle, "degrees"),
    BENT(rotate, point, "point"), POINTED(rotate, point, not_finite, EMB_ERROR_INVALID_ARGUMENT, "point[1]: NaN"),
    OUT(scale), NULLED(scale, g, "g"), POSITIVE(scale, small, "factor"), REAL_ONE(scale, small, 1e-320, "factor"),
    OUT(reflect), NULLED(reflect, g, "g"), UNKNOWN(reflect, plane, "plane"),
    INTEGER(reflect, plane, 3, EMB_ERROR_INVALID_ARGUMENT, "plane: 3"),
    OUT(reflect_in), NULLED(reflect_in, g, "g"), VECTOR(reflect_in, point, "point"), AXIS(reflect_in, axis, "normal"),
    OUT(affine), NULLED(affine, g, "g"), VECTOR(affine, rotation, "matrix"), BENT(affine, shift, "shift"),
    POINTED(affine, rotation, zero, EMB_ERROR_INVALID_ARGUMENT, "matrix"),
    POINTED(affine, rotation, singular, EMB_ERROR_INVALID_ARGUMENT, "matrix"),
    POINTED(affine, shift, infinite, EMB_ERROR_INVALID_ARGUMENT, "shift[1]: inf"),
    OUT(offset), NULLED(offset, g, "g"), FINITE(offset, small, "distance"),
    OUT(annular), NULLED(annular, g, "g"), POSITIVE(annular, small, "half_thickness"),
    OUT(lower_bound), NULLED(lower_bound, g, "g"), HELD(lower_bound, g, &sign_only, EMB_ERROR_UNSUPPORTED, "g: its Lipschitz"),
    OUT(blur), NULLED(blur, g, "g"), POSITIVE(blur, large, "h"), NOT_FINITE(blur, small, "alpha"),
    REAL_ONE(blur, small, -0.5, "alpha: -0.5"), REAL_ONE(blur, small, 1.5, "alpha: 1.5"),
    OUT(mollify), NULLED(mollify, g, "g"), POSITIVE(mollify, small, "d"),
    INTEGER(mollify, samples, 0, EMB_ERROR_INVALID_ARGUMENT, "samples: 0"),
    INTEGER(mollify, samples, 33, EMB_ERROR_INVALID_ARGUMENT, "samples: 33"),
    INTEGER(mollify, samples, -1, EMB_ERROR_INVALID_ARGUMENT, "samples: -1"),
    OUT(elongate), NULLED(elongate, g, "g"), VECTOR(elongate, half, "extent"),
    POINTED(elongate, half, negative, EMB_ERROR_INVALID_ARGUMENT, "extent[1]: -2"),
    OUT(twist), NULLED(twist, g, "g"), FINITE(twist, angle, "degrees"),
    OUT(slice), NULLED(slice, g, "g"), VECTOR(slice, point, "origin"), AXIS(slice, axis, "u_axis"),
    AXIS(slice, toward, "v_axis"), POINTED(slice, toward, up, EMB_ERROR_INVALID_ARGUMENT, "v_axis"),
    NULLED(geom_part, g, "g"),
    NULLED(geom_part, out_geom, "out_geom"),
    INTEGER(geom_part, part, -2, EMB_ERROR_INVALID_ARGUMENT, "part: -2"),
    NULLED(geom_callback, value, "value"),
    NULLED(geom_callback, out_geom, "out_geom"),
    VERSIONED(geom_callback, callback_options_value, emb_callback_options, "options"),
    UNKNOWN(geom_callback, callback_options_value.value.kind, "options.kind"),
    REAL_ONE(geom_callback, callback_options_value.value.lo[1], NAN, "options.lo[1]"),
    REAL_ONE(geom_callback, callback_options_value.value.hi[2], NAN, "hi[2]"),
    NOT_FINITE(geom_callback, callback_options_value.value.lipschitz, "options.lipschitz"),
    REAL_ONE(geom_callback, callback_options_value.value.lipschitz, -1.0, "options.lipschitz"),
    NOT_FINITE(geom_callback, callback_options_value.value.gradient_step, "options.gradient_step"),
    REAL_ONE(geom_callback, callback_options_value.value.gradient_step, -1.0, "options.gradient_step"),

    NULLED(callback_options_init, callback_options, "options"),
    SIZED(callback_options_init, size, offsetof(emb_callback_options, values) - 1, "size"),
    SIZED(callback_options_init, size, SIZE_MAX, "size"),
    NULLED(expression_options_init, expression_options, "options"),
    SIZED(expression_options_init, size, sizeof(emb_expression_options) - 1, "size"),
    SIZED(expression_options_init, size, 5000, "size: 5000"),
    NULLED(blend_init, blend, "blend"),
    SIZED(blend_init, size, sizeof(emb_blend) - 1, "size"),
    SIZED(blend_init, size, SIZE_MAX, "size"),
};

/* On the lattice of a height field. */
static const misuse flat_table[] = {
    OUT(height_field), NULLED(height_field, lattice, "lattice"),
    VERSIONED(height_field, lattice_value, emb_lattice, "lattice"),
    NULLED(height_field, lattice_value.value.x, "lattice.x"), BENT(height_field, lattice_value.value.y, "lattice.y"),
    POINTED(height_field, lattice_value.value.x, zigzag, EMB_ERROR_INVALID_ARGUMENT, "lattice.x[2]"),
    POINTED(height_field, lattice_value.value.y, not_finite, EMB_ERROR_INVALID_ARGUMENT, "lattice.y[1]"),
    POINTED(height_field, lattice_value.value.z, zero, EMB_ERROR_INVALID_ARGUMENT, "lattice.z"),
    SIZED(height_field, lattice_value.value.n[2], 0, "lattice.n[2]: 0"),
    SIZED(height_field, lattice_value.value.n[2], 2, "lattice.n[2]: 2"),
    SAMPLES(height_field, "heights"),
};

/* With a blend of the caller's. */
static const misuse custom_table[] = {
    NULLED(smooth_union, blend_value.value.blend, "blend.blend"),
    REAL_ONE(smooth_union, blend_value.value.support, NAN, "blend.support: NaN"),
    REAL_ONE(smooth_union, blend_value.value.support, -1.0, "blend.support: -1"),
    REAL_ONE(smooth_intersection, blend_value.value.depth, NAN, "blend.depth: NaN"),
    REAL_ONE(smooth_intersection, blend_value.value.depth, -1.0, "blend.depth: -1"),
    REAL_ONE(smooth_difference, blend_value.value.lipschitz, NAN, "blend.lipschitz: NaN"),
    REAL_ONE(smooth_difference, blend_value.value.lipschitz, -1.0, "blend.lipschitz: -1"),
    POINTED(smooth_union, parts, hollow_parts, EMB_ERROR_NULL_ARGUMENT, "parts[1]: NULL"),
    OUT(smooth_difference),
};

static void check_table(const misuse *rows, size_t count, arguments (*start)(void)) {
  size_t i;
  for (i = 0; i < count; i++) {
    arguments a = start();
    connect(&a);
    check_row(&rows[i], &a);
  }
}
#define CHECK_TABLE(rows, start) check_table(rows, sizeof rows / sizeof *rows, start)

/* Every row differs from this only in what it spoils. */
static void good_arguments_are_accepted(const misuse *rows, size_t count, arguments (*start)(void), int dropped) {
  size_t i;
  for (i = 0; i < count; i++) {
    arguments a = start();
    if (i > 0 && rows[i].call == rows[i - 1].call) {
      continue;
    }
    connect(&a);
    a.size = rows[i].call == callback_options_init     ? sizeof(emb_callback_options)
             : rows[i].call == expression_options_init ? sizeof(emb_expression_options)
                                                       : sizeof(emb_blend);
    reset_outputs(0);
    check_status(rows[i].call(&a), EMB_OK, rows[i].function, __FILE__, __LINE__);
    emb_geom_free(outputs.geom);
  }
  CHECK(drops == dropped);
  drops = 0;
}
#define GOOD(rows, start, dropped) good_arguments_are_accepted(rows, sizeof rows / sizeof *rows, start, dropped)

/* What may be left out. */
static void optional_pointers_may_be_null(void) {
  arguments a = good();
  connect(&a);
  a.rotation = a.shift = NULL;
  a.callback_options = NULL, a.expression_options = NULL;
#define WITHOUT(call) CHECK_OK(call(&a)), emb_geom_free(outputs.geom)
  WITHOUT(rounded_box);
  WITHOUT(ellipsoid);
  WITHOUT(extruded_polygon);
  WITHOUT(expression);
  WITHOUT(geom_callback);
  a.point = NULL;
  WITHOUT(rotate);
  a.rotation = identity;
  WITHOUT(affine);
  /* composites of nothing */
  a.count = 0, a.parts = NULL;
  CHECK_OK(geom_union(&a));
  CHECK(emb_geom_value(outputs.geom, 0, 0, 0) == INFINITY);
  emb_geom_free(outputs.geom);
  CHECK_OK(geom_intersection(&a));
  CHECK(emb_geom_value(outputs.geom, 0, 0, 0) == -INFINITY);
  emb_geom_free(outputs.geom);
  CHECK_OK(smooth_union(&a));
  CHECK(emb_geom_value(outputs.geom, 0, 0, 0) == INFINITY);
  emb_geom_free(outputs.geom);
  CHECK_OK(smooth_intersection(&a));
  CHECK(emb_geom_value(outputs.geom, 0, 0, 0) == -INFINITY);
  emb_geom_free(outputs.geom);
  CHECK_OK(difference_of_many(&a));
  CHECK(emb_geom_value(outputs.geom, 3, 0, 0) == 2.0);
  emb_geom_free(outputs.geom);
  CHECK_OK(smooth_difference(&a));
  CHECK(emb_geom_value(outputs.geom, 3, 0, 0) == 2.0);
  emb_geom_free(outputs.geom);
  drops = 0;
}

/* Later releases' structs: larger, what is unknown zero. */
static void larger_structs_with_zeros_are_accepted(void) {
  arguments a = custom();
  connect(&a);
  a.lattice_value.value.struct_size += 16, a.array_value.value.struct_size += 16, a.blend_value.value.struct_size += 16;
  a.callback_options_value.value.struct_size += 16, a.expression_options_value.value.struct_size += 16;
  WITHOUT(grid);
  WITHOUT(expression);
  CHECK(drops == 0);
  WITHOUT(smooth_union);
  WITHOUT(geom_callback);
  CHECK(drops == 2);
  drops = 0;
}

/* Structs of the first release: what it lacks has its default, whatever stands there. */
static void smaller_structs_are_accepted(void) {
  const size_t first = offsetof(emb_callback_options, values);
  arguments a = good();
  size_t i;
  connect(&a);
  memset((char *)a.callback_options + first, 0xA5, sizeof *a.callback_options - first);
  a.callback_options->struct_size = first;
  CHECK_OK(geom_callback(&a));
  CHECK(emb_geom_value(outputs.geom, 3, 0, 0) == 2.0);
  emb_geom_free(outputs.geom);
  CHECK_OK(emb_callback_options_init(a.callback_options, first));
  for (i = first; i < sizeof *a.callback_options; i++) {
    CHECK(((unsigned char *)a.callback_options)[i] == 0xA5);
  }
  drops = 0;
}

/* Numbers in either type, with strides; a number that is not finite is named by its place. */
static void samples_are_read_as_they_lie(void) {
  static const float floats[12] = {1, -1, 2, -2, -1, 1, -2, 2, 1, 1, 1, 1};
  static double wide[48];
  arguments a = good();
  emb_geom *tight;
  int i, j, k, at = 0;
  connect(&a);
  a.array_value.value.data = (void *)(uintptr_t)floats, a.array_value.value.type = EMB_F32;
  CHECK_OK(grid(&a));
  tight = outputs.geom;
  /* x from the other end, z fastest */
  for (i = 0; i < 48; i++) {
    wide[i] = NAN;
  }
  for (k = 0; k < 2; k++) {
    for (j = 0; j < 2; j++) {
      for (i = 0; i < 3; i++, at++) {
        wide[16 * (2 - i) + 4 * j + 2 * k] = floats[at];
      }
    }
  }
  a.array_value.value.data = wide + 32, a.array_value.value.type = EMB_F64;
  a.array_value.value.stride[0] = -16, a.array_value.value.stride[1] = 4, a.array_value.value.stride[2] = 2;
  CHECK_OK(grid(&a));
  CHECK(emb_geom_fingerprint(tight) == emb_geom_fingerprint(outputs.geom) && emb_geom_fingerprint(tight) != 0);
  CHECK(emb_geom_value(tight, 1, 0, 0) == -1.0 && emb_geom_value(outputs.geom, 1.5, 0, 0) == 0.5);
  emb_geom_free(tight);
  emb_geom_free(outputs.geom);
  a = good();
  connect(&a);
  a.array_value.value.data = gaps_f32, a.array_value.value.type = EMB_F32;
  CHECK_STATUS(grid(&a), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "values[3]: inf") != NULL);
}

int main(void) {
  const double origin[3] = {0, 0, 0};
  int i;
  CHECK_OK(emb_geom_sphere(origin, 1.0, &sphere));
  CHECK_OK(emb_geom_callback(sphere_function, NULL, NULL, NULL, &sign_only));
  for (i = 0; i < 4; i++) {
    parts[i] = sphere, hollow_parts[i] = i == 1 ? NULL : sphere;
  }
  GOOD(table, good, 1);
  GOOD(flat_table, flat, 0);
  GOOD(custom_table, custom, 5);
  CHECK_TABLE(table, good);
  CHECK_TABLE(flat_table, flat);
  CHECK_TABLE(custom_table, custom);
  optional_pointers_may_be_null();
  larger_structs_with_zeros_are_accepted();
  smaller_structs_are_accepted();
  samples_are_read_as_they_lie();
  emb_geom_free(sphere);
  emb_geom_free(sign_only);
  return checks_done("misuse_shapes");
}
