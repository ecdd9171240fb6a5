/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Every constructor through C, against closed forms; trees of them answer every question alike; functions with what is
 * known of them, blends of the caller's. The last line is a hash of all results, to be compared between libraries and
 * instruction sets. */
#include "check.h"

#include <stddef.h>

#define N 17
#define CELLS (N * N * N)
#define POINTS 500

static uint64_t hash = HASH_START;
static emb_pool *pool;
static double axis[N];

static const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 2}, right[3] = {1, 0, 0}, half[3] = {1, 2, 3};
static const double quarter[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1}, square[8] = {0, 0, 1, 0, 1, 1, 0, 1};

static int near(double a, double b) {
  return fabs(a - b) < 1e-12;
}

/* The value at one point. Adds values around it to the hash; the geometry is the caller's no longer. */
static double take(emb_geom *g, double x, double y, double z) {
  static double p[3 * POINTS], values[POINTS];
  double value = emb_geom_value(g, x, y, z);
  int i;
  for (i = 0; i < 3 * POINTS; i++) {
    p[i] = random_between(-2, 2);
  }
  CHECK_OK(emb_geom_values(g, POINTS, p, p + 1, p + 2, 3, NULL, values));
  for (i = 0; i < POINTS; i++) {
    CHECK(same_double(values[i], emb_geom_value(g, p[3 * i], p[3 * i + 1], p[3 * i + 2])));
  }
  hash = hash_bytes(hash, &value, sizeof value);
  hash = hash_bytes(hash, values, sizeof values);
  emb_geom_free(g);
  return value;
}

/* What `call`, which writes to g, makes has this value there. */
#define VALUE(call, x, y, z, expected)                 \
  do {                                                 \
    emb_geom *g = NULL;                                \
    if (CHECK_OK(call)) {                              \
      CHECK(near(take(g, x, y, z), expected));         \
    }                                                  \
  } while (0)

static void shapes_are_where_they_should_be(void) {
  VALUE(emb_geom_sphere(right, 0.5, &g), 3, 0, 0, 1.5);
  VALUE(emb_geom_box(origin, half, &g), 0.5, 3, 1, 1);
  VALUE(emb_geom_plane(origin, up, &g), 3, 4, 5, 5);
  VALUE(emb_geom_torus(origin, up, 2, 0.5, &g), 0, 3, 0, 0.5);
  VALUE(emb_geom_cylinder(origin, up, 0.5, &g), 1, 0, 1, 0.5);
  VALUE(emb_geom_infinite_cylinder(origin, up, 0.5, &g), 0, 1, 99, 0.5);
  VALUE(emb_geom_capsule(origin, up, 0.5, &g), 0, 0, 3, 0.5);
  VALUE(emb_geom_capsule_tips(origin, up, 0.5, &g), 0, 0, 3, 1);
  VALUE(emb_geom_infinite_cone(origin, up, 90, &g), 0, 0, 1, -sqrt(0.5));
  VALUE(emb_geom_cone(origin, up, 1, 90, &g), 0, 0, 1.5, 0.5);
  VALUE(emb_geom_rounded_box(origin, half, 0.25, NULL, &g), 0, 2.5, 0, 0.5);
  VALUE(emb_geom_rounded_box(origin, half, 0, quarter, &g), 2.5, 0, 0, 0.5);
  VALUE(emb_geom_rounded_cylinder(origin, up, 1, 2, 0.25, &g), 0, 0, 1.5, 0.5);
  VALUE(emb_geom_ellipsoid(origin, half, NULL, &g), 0, 2.5, 0, 0.5);
  VALUE(emb_geom_ellipsoid(origin, half, quarter, &g), 2.5, 0, 0, 0.5);
  VALUE(emb_geom_prism(origin, up, right, 4, 1, &g), 1.5, 0, 1, 0.5);
  VALUE(emb_geom_extruded_polygon(origin, NULL, 4, square, -1, 1, &g), 0.5, 0.5, 1.5, 0.5);
  VALUE(emb_geom_extruded_polygon(origin, quarter, 4, square, -1, 1, &g), -1.5, 0.5, 0, 0.5);
  VALUE(emb_geom_revolved_polygon(origin, up, 4, square, &g), 0, 1.5, 0.5, 0.5);
  VALUE(emb_geom_perlin(1, half, 0.5, 3, 7, &g), 1, 2, 3, 0);
}

static void samples_and_expressions_are_bodies(void) {
  static const double x[3] = {0, 1, 2}, y[2] = {2, 0};
  static float heights[6] = {0, 0, 0, 1, 1, 1};
  static double values[CELLS];
  emb_lattice plane = {sizeof plane, {3, 2, 1}, x, y, NULL}, cube = {sizeof cube, {N, N, N}, axis, axis, axis};
  emb_array array = {sizeof array, heights, EMB_F32, {0, 0, 0}};
  emb_expression_options options;
  emb_geom *ball, *sampled;
  int i, j, k;
  CHECK_OK(emb_expression_options_init(&options, sizeof options));
  CHECK(options.lo[1] == -INFINITY && options.hi[2] == INFINITY && options.lipschitz == 0);
  VALUE(emb_geom_height_field(&plane, &array, &g), 1, 0, 3, 2 / sqrt(1.25));
  VALUE(emb_geom_height_field(&plane, &array, &g), 0.5, 2, -1, -1 / sqrt(1.25));
  CHECK_OK(emb_geom_sphere(origin, 1, &ball));
  array.data = values, array.type = EMB_F64;
  CHECK_OK(emb_geom_fill(ball, &cube, EMB_FILL_EXACT, 0, NULL, &array));
  CHECK_OK(emb_geom_grid(&cube, &array, &sampled));
  for (k = 0; k < N; k++) {
    for (j = 0; j < N; j++) {
      for (i = 0; i < N; i++) {
        CHECK(same_double(emb_geom_value(sampled, axis[i], axis[j], axis[k]), values[(k * N + j) * N + i]));
      }
    }
  }
  take(sampled, 0, 0, 0);
  emb_geom_free(ball);
  VALUE(emb_geom_expression("sqrt(x^2 + y^2 + z^2) - 1", NULL, &g), 0.5, 0, 0, -0.5);
  options.lo[0] = options.lo[1] = options.lo[2] = -3;
  options.hi[0] = options.hi[1] = options.hi[2] = 3;
  VALUE(emb_geom_expression("max(abs(x), y) + 0*z - 2", &options, &g), 0, 1, 0, -1);
}

static void transforms_move_turn_and_bend(void) {
  static const double stretch[9] = {2, 0, 0, 0, 1, 0, 0, 0, 1}, far_off[3] = {2, 0, 0}, high[3] = {0, 0, 0.25},
                      y[3] = {0, 1, 0}, period[3] = {3, 0, 0};
  static const int32_t counts[3] = {4, 1, 1};
  emb_geom *ball, *noise, *bound;
  emb_geom_properties properties;
  CHECK_OK(emb_geom_sphere(right, 0.5, &ball));
  VALUE(emb_geom_translate(ball, right, &g), 2, 0, 0, -0.5);
  VALUE(emb_geom_place(ball, quarter, right, &g), 1, 1, 0, -0.5);
  VALUE(emb_geom_rotate(ball, up, 90, NULL, &g), 0, 1, 0, -0.5);
  VALUE(emb_geom_rotate(ball, up, 180, far_off, &g), 3, 0, 0, -0.5);
  VALUE(emb_geom_scale(ball, 2, &g), 2, 0, 0, -1);
  VALUE(emb_geom_reflect(ball, 0, &g), -1, 0, 0, -0.5);
  VALUE(emb_geom_reflect_in(ball, far_off, right, &g), 3, 0, 0, -0.5);
  VALUE(emb_geom_affine(ball, stretch, NULL, &g), 3, 0, 0, 0);
  VALUE(emb_geom_affine(ball, stretch, right, &g), 4, 0, 0, 0);
  VALUE(emb_geom_offset(ball, 0.25, &g), 1, 0, 0, -0.75);
  VALUE(emb_geom_annular(ball, 0.125, &g), 1.5, 0, 0, -0.125);
  VALUE(emb_geom_elongate(ball, right, &g), 2.25, 0, 0, -0.25);
  VALUE(emb_geom_twist(ball, 360, &g), 0, 1.4330127018922194, 0.25, 0);
  VALUE(emb_geom_slice(ball, high, right, y, &g), 1, 0, 77, -0.25);
  VALUE(emb_geom_repeat(ball, period, counts, &g), 10, 0, 0, -0.5);
  VALUE(emb_geom_repeat(ball, period, counts, &g), 13, 0, 0, 2.5);
  VALUE(emb_geom_part(ball, 7, &g), 1, 0, 0, -0.5);
  VALUE(emb_geom_complement(ball, &g), 1, 0, 0, 0.5);
  /* means of linear values are the values */
  CHECK_OK(emb_geom_plane(origin, right, &bound));
  VALUE(emb_geom_blur(bound, 0.25, 0.5, &g), 1.5, 0, 0, 1.5);
  VALUE(emb_geom_mollify(bound, 0.25, 5, &g), 1.5, 0, 0, 1.5);
  emb_geom_free(bound);
  CHECK_OK(emb_geom_perlin(1, half, 0.5, 3, 7, &noise));
  CHECK_OK(emb_geom_lower_bound(noise, &bound));
  properties.struct_size = sizeof properties;
  CHECK_OK(emb_geom_properties_get(noise, &properties));
  CHECK(properties.kind == EMB_SIGN_ONLY && properties.lipschitz > 1);
  CHECK(near(emb_geom_value(bound, 0.3, 0.4, 0.5) * properties.lipschitz, emb_geom_value(noise, 0.3, 0.4, 0.5)));
  CHECK_OK(emb_geom_properties_get(bound, &properties));
  CHECK(properties.kind == EMB_LOWER_BOUND && properties.lipschitz <= 1);
  take(bound, 0, 0, 0);
  emb_geom_free(noise);
  emb_geom_free(ball);
}

static emb_blend blend_of(int32_t kind, double width) {
  emb_blend blend;
  CHECK_OK(emb_blend_init(&blend, sizeof blend));
  CHECK(blend.kind == EMB_BLEND_SMOOTH && blend.thread_safe == 0 && blend.width == 0 && blend.blend == NULL &&
        blend.drop == NULL && blend.support == INFINITY && blend.depth == INFINITY && blend.lipschitz == INFINITY);
  blend.kind = kind, blend.width = width;
  return blend;
}

static void sets_are_sharp_or_smooth(void) {
  static const double beside[3] = {1.5, 0, 0};
  const double sharp = sqrt(0.75 * 0.75 + 0.8 * 0.8) - 1;
  emb_blend smooth = blend_of(EMB_BLEND_SMOOTH, 0.5), exponential = blend_of(EMB_BLEND_EXPONENTIAL, 0.5);
  emb_geom *a, *b;
  const emb_geom *both[2];
  CHECK_OK(emb_geom_sphere(origin, 1, &a));
  CHECK_OK(emb_geom_sphere(beside, 1, &b));
  both[0] = a, both[1] = b;
  VALUE(emb_geom_union(2, both, &g), 0.75, 0, 0.8, sharp);
  VALUE(emb_geom_smooth_union(2, both, &smooth, &g), 0.75, 0, 0.8, sharp - 0.125);
  VALUE(emb_geom_smooth_union(2, both, &exponential, &g), 0.75, 0, 0.8, sharp - 0.5 * log(2));
  VALUE(emb_geom_intersection(2, both, &g), 0.75, 0, 0, -0.25);
  VALUE(emb_geom_smooth_intersection(2, both, &smooth, &g), 0.75, 0, 0, -0.125);
  VALUE(emb_geom_difference(a, b, &g), 0.5, 0, 0, 0);
  VALUE(emb_geom_difference_of_many(a, 2, both, &g), 0, 0, 0, 1);
  VALUE(emb_geom_smooth_difference(a, 1, both + 1, &smooth, &g), 0.5, 0, 0, 0);
  VALUE(emb_geom_smooth_difference(a, 1, both + 1, &exponential, &g), -3, 0, 0, 2 + 0.5 * log(1 + exp(-11)));
  emb_geom_free(a);
  emb_geom_free(b);
}

/* A bracket: all kinds of nodes, none of which is the caller's. */
static emb_geom *bracket(void) {
  static const double lo[3] = {-1, -0.4, -0.3}, hi[3] = {1, 0.4, 0}, a[3] = {-0.5, 0, -1}, b[3] = {-0.5, 0, 1},
                      size[3] = {0.3, 0.2, 0.25}, above[3] = {0.4, 0, 0.1}, period[3] = {0.25, 0, 0},
                      at[3] = {0.1, 0, -0.3};
  static const int32_t counts[3] = {3, 1, 1};
  emb_blend blend = blend_of(EMB_BLEND_SMOOTH, 0.2);
  emb_geom *plate, *hole, *knob, *turned, *pin, *pins, *solid, *shell, *pierced, *cut, *all;
  const emb_geom *parts[2];
  CHECK_OK(emb_geom_box(lo, hi, &plate));
  CHECK_OK(emb_geom_cylinder(a, b, 0.2, &hole));
  CHECK_OK(emb_geom_rounded_box(above, size, 0.05, NULL, &knob));
  CHECK_OK(emb_geom_rotate(knob, up, 30, above, &turned));
  CHECK_OK(emb_geom_sphere(at, 0.1, &pin));
  CHECK_OK(emb_geom_repeat(pin, period, counts, &pins));
  parts[0] = plate, parts[1] = turned;
  CHECK_OK(emb_geom_smooth_union(2, parts, &blend, &solid));
  CHECK_OK(emb_geom_annular(solid, 0.03, &shell));
  CHECK_OK(emb_geom_smooth_difference(solid, 1, (const emb_geom *const *)&hole, &blend, &pierced));
  parts[0] = hole, parts[1] = pins;
  CHECK_OK(emb_geom_difference_of_many(shell, 2, parts, &cut));
  parts[0] = pierced, parts[1] = cut;
  CHECK_OK(emb_geom_union(2, parts, &all));
  emb_geom_free(plate), emb_geom_free(hole), emb_geom_free(knob), emb_geom_free(turned), emb_geom_free(pin);
  emb_geom_free(pins), emb_geom_free(solid), emb_geom_free(shell), emb_geom_free(pierced), emb_geom_free(cut);
  return all;
}

static void a_tree_answers_every_question_alike(void) {
  static double exact[CELLS], pooled[CELLS], value[CELLS], p[3 * CELLS], point[3 * CELLS], gradient[3 * CELLS];
  static int8_t signs[CELLS];
  emb_geom *g = bracket();
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array out = {sizeof out, exact, EMB_F64, {0, 0, 0}};
  emb_run run = {sizeof run, NULL, NULL, NULL};
  emb_closest_out closest;
  int i, j, k, c, at = 0, uniform = 0;
  run.pool = pool;
  CHECK(emb_geom_fingerprint(g) != 0);
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  out.data = pooled;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0, &run, &out));
  out.data = signs, out.type = EMB_I8;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_SIGN, 0, &run, &out));
  for (k = 0; k < N; k++) {
    for (j = 0; j < N; j++) {
      for (i = 0; i < N; i++, at++) {
        double v = emb_geom_value(g, axis[i], axis[j], axis[k]);
        CHECK(same_double(exact[at], v) && same_double(pooled[at], v) && signs[at] == (v > 0) - (v < 0));
        p[3 * at] = axis[i], p[3 * at + 1] = axis[j], p[3 * at + 2] = axis[k];
      }
    }
  }
  memset(&closest, 0, sizeof closest);
  closest.struct_size = sizeof closest;
  closest.value = value, closest.vector_stride = 3;
  for (c = 0; c < 3; c++) {
    closest.point[c] = point + c, closest.gradient[c] = gradient + c;
  }
  CHECK_OK(emb_geom_closest(g, CELLS, p, p + 1, p + 2, 3, INFINITY, &run, &closest));
  CHECK(same_bits(value, exact, CELLS));
  for (i = 0; i < 200; i++) {
    double lo[3], hi[3];
    int32_t side;
    for (c = 0; c < 3; c++) {
      lo[c] = random_between(-1.2, 1.2);
      hi[c] = lo[c] + random_between(0, 0.3);
    }
    side = emb_geom_classify_box(g, lo, hi);
    uniform += side != 0;
    for (k = 0; side != 0 && k < 50; k++) {
      for (c = 0; c < 3; c++) {
        p[c] = random_between(lo[c], hi[c]);
      }
      CHECK(emb_geom_value(g, p[0], p[1], p[2]) * side > 0);
    }
  }
  CHECK(uniform > 20);
  hash = hash_bytes(hash, exact, sizeof exact);
  hash = hash_bytes(hash, point, sizeof point);
  hash = hash_bytes(hash, gradient, sizeof gradient);
  emb_geom_free(g);
}

/* What a function's `user` counts. */
typedef struct calls {
  int values, batches, gradients, ranges, drops, fails;
} calls;

static double cone_value(void *user, double x, double y, double z) {
  ((calls *)user)->values++;
  return 0.8 * (sqrt(x * x + y * y) - 0.5 * fabs(z));
}

static void cone_values(void *user, size_t count, const double *x, const double *y, const double *z, double *out) {
  size_t i;
  ((calls *)user)->batches++;
  CHECK(count > 0 && isnan(out[0]));
  for (i = 0; i < count; i++) {
    if (!((calls *)user)->fails || x[i] < 1) {
      out[i] = 0.8 * (sqrt(x[i] * x[i] + y[i] * y[i]) - 0.5 * fabs(z[i]));
    }
  }
}

static int32_t cone_gradient(void *user, double x, double y, double z, double *out_gradient) {
  double r = sqrt(x * x + y * y);
  ((calls *)user)->gradients++;
  out_gradient[0] = 0.8 * x / r, out_gradient[1] = 0.8 * y / r, out_gradient[2] = z > 0 ? -0.4 : 0.4;
  return ((calls *)user)->fails;
}

/* Known beside the axis alone. */
static int32_t cone_range(void *user, const double *lo, const double *hi, double *out_lo, double *out_hi) {
  ((calls *)user)->ranges++;
  *out_lo = 0.8 * (lo[0] - 0.5 * fmax(fabs(lo[2]), fabs(hi[2]))) - 1e-9;
  *out_hi = ((calls *)user)->fails ? NAN : INFINITY;
  return lo[0] <= 0;
}

static void drop_calls(void *user) {
  ((calls *)user)->drops++;
}

static void functions_tell_what_they_know(void) {
  static double one[CELLS], batched[CELLS];
  static const double lo[3] = {0.5, -1, -0.5}, hi[3] = {1.5, 1, 0.5}, shift[3] = {0.25, 0, 0};
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array out = {sizeof out, one, EMB_F64, {0, 0, 0}};
  emb_callback_options options;
  emb_closest_out closest;
  emb_geom *plain, *full, *moved, *moved_plain;
  const emb_geom *parts[2];
  double gradient[3], x = 0.75, y = 0.25, z = 0.5;
  calls plain_calls = {0, 0, 0, 0, 0, 0}, full_calls = {0, 0, 0, 0, 0, 0};
  int c;
  CHECK_OK(emb_callback_options_init(&options, sizeof options));
  CHECK(options.values == NULL && options.gradient == NULL && options.range == NULL);
  options.kind = EMB_LOWER_BOUND;
  CHECK_OK(emb_geom_callback(cone_value, &plain_calls, drop_calls, &options, &plain));
  options.values = cone_values, options.gradient = cone_gradient, options.range = cone_range;
  CHECK_OK(emb_geom_callback(cone_value, &full_calls, drop_calls, &options, &full));
  /* a batch is the same bits, also within a tree */
  CHECK_OK(emb_geom_fill(plain, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  out.data = batched;
  CHECK_OK(emb_geom_fill(full, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  CHECK(same_bits(one, batched, CELLS));
  CHECK(full_calls.batches > 0 && full_calls.values < CELLS && plain_calls.values >= CELLS);
  CHECK_OK(emb_geom_translate(plain, shift, &moved_plain));
  parts[0] = plain, parts[1] = moved_plain;
  CHECK_OK(emb_geom_union(2, parts, &moved));
  out.data = one;
  CHECK_OK(emb_geom_fill(moved, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  emb_geom_free(moved);
  emb_geom_free(moved_plain);
  CHECK_OK(emb_geom_translate(full, shift, &moved_plain));
  parts[0] = full, parts[1] = moved_plain;
  CHECK_OK(emb_geom_union(2, parts, &moved));
  out.data = batched;
  CHECK_OK(emb_geom_fill(moved, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  CHECK(same_bits(one, batched, CELLS));
  emb_geom_free(moved);
  emb_geom_free(moved_plain);
  hash = hash_bytes(hash, one, sizeof one);
  /* the gradient */
  memset(&closest, 0, sizeof closest);
  closest.struct_size = sizeof closest;
  closest.vector_stride = 1;
  for (c = 0; c < 3; c++) {
    closest.gradient[c] = gradient + c;
  }
  CHECK_OK(emb_geom_closest(full, 1, &x, &y, &z, 1, INFINITY, NULL, &closest));
  CHECK(full_calls.gradients > 0 && near(gradient[2] / gradient[0], -0.5 / (0.75 / sqrt(0.625))));
  /* the range */
  CHECK(emb_geom_classify_box(plain, lo, hi) == 0);
  CHECK(emb_geom_classify_box(full, lo, hi) == 1 && full_calls.ranges > 0);
  CHECK(emb_geom_classify_box(full, origin, hi) == 0);
  /* failures */
  full_calls.fails = 1;
  CHECK(emb_geom_classify_box(full, lo, hi) == 0);
  CHECK_STATUS(emb_geom_fill(full, &lattice, EMB_FILL_EXACT, 0, NULL, &out), EMB_ERROR_CALLBACK);
  CHECK_OK(emb_geom_closest(full, 1, &x, &y, &z, 1, INFINITY, NULL, &closest));
  CHECK(isnan(gradient[0]) && isnan(gradient[2]));
  CHECK(plain_calls.drops == 0 && full_calls.drops == 0);
  emb_geom_free(plain);
  emb_geom_free(full);
  CHECK(plain_calls.drops == 1 && full_calls.drops == 1);
}

/* EMB_BLEND_SMOOTH of width 0.5, written out. */
static double quadratic(void *user, double a, double b, double *out_by_a, double *out_by_b) {
  double h = b - a < 0.5 ? (0.5 - (b - a)) / 0.5 : 0;
  calls *counts = (calls *)user;
  counts->values++;
  CHECK(a <= b && isnan(*out_by_a) && isnan(*out_by_b));
  if (counts->gradients) {
    *out_by_a = 1 - 0.5 * h, *out_by_b = 0.5 * h;
  }
  return counts->fails ? NAN : a - h * h * 0.5 * 0.25;
}

static void blends_of_the_callers_are_kept(void) {
  static double known[CELLS], own[CELLS], gradients[2][3];
  static const double beside[3] = {1.5, 0, 0};
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array out = {sizeof out, known, EMB_F64, {0, 0, 0}};
  emb_blend smooth = blend_of(EMB_BLEND_SMOOTH, 0.5), custom = blend_of(EMB_BLEND_CUSTOM, 0);
  calls counts = {0, 0, 0, 0, 0, 0};
  emb_geom *a, *b, *expected, *made, *again, *unknown, *none = NULL;
  emb_closest_out closest;
  emb_geom_properties properties;
  const emb_geom *both[2], *three[3];
  double x = 0.7, y = 0.1, z = 0.9;
  int i, c;
  custom.blend = quadratic, custom.user = &counts, custom.drop = drop_calls;
  custom.support = 0.5, custom.depth = 0.5, custom.lipschitz = 1;
  CHECK_OK(emb_geom_sphere(origin, 1, &a));
  CHECK_OK(emb_geom_sphere(beside, 1, &b));
  both[0] = a, both[1] = b;
  CHECK_OK(emb_geom_smooth_union(2, both, &smooth, &expected));
  CHECK_OK(emb_geom_smooth_union(2, both, &custom, &made));
  CHECK_OK(emb_geom_smooth_difference(a, 1, both + 1, &custom, &again));
  CHECK_OK(emb_geom_fill(expected, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  out.data = own;
  CHECK_OK(emb_geom_fill(made, &lattice, EMB_FILL_EXACT, 0, NULL, &out));
  CHECK(same_bits(known, own, CELLS) && counts.values > 0);
  CHECK(emb_geom_fingerprint(expected) != 0 && emb_geom_fingerprint(made) == 0);
  properties.struct_size = sizeof properties;
  CHECK_OK(emb_geom_properties_get(made, &properties));
  CHECK(properties.kind == EMB_LOWER_BOUND && properties.lipschitz == 1);
  /* one call of the blend for one value */
  counts.values = 0;
  emb_geom_value(made, x, y, z);
  CHECK(counts.values == 1);
  /* derivatives: by differences, then as told */
  memset(&closest, 0, sizeof closest);
  closest.struct_size = sizeof closest;
  closest.vector_stride = 1;
  for (i = 0; i < 2; i++) {
    counts.gradients = i;
    for (c = 0; c < 3; c++) {
      closest.gradient[c] = &gradients[i][c];
    }
    CHECK_OK(emb_geom_closest(made, 1, &x, &y, &z, 1, INFINITY, NULL, &closest));
  }
  for (c = 0; c < 3; c++) {
    CHECK(fabs(gradients[0][c] - gradients[1][c]) < 1e-6);
  }
  /* nothing known but the function: every part is asked */
  custom.support = custom.depth = custom.lipschitz = INFINITY;
  both[0] = made, both[1] = b;
  CHECK_OK(emb_geom_smooth_union(2, both, &custom, &unknown));
  CHECK_OK(emb_geom_properties_get(unknown, &properties));
  CHECK(properties.kind == EMB_SIGN_ONLY && properties.lipschitz == INFINITY);
  for (i = 0; i < 100; i++) {
    double p[3] = {random_between(-2, 3), random_between(-1.5, 1.5), random_between(-1.5, 1.5)};
    double v = emb_geom_value(unknown, p[0], p[1], p[2]), least = emb_geom_value(made, p[0], p[1], p[2]);
    CHECK(v <= least + 1e-12 && v >= least - 0.125);
    CHECK(emb_geom_classify_box(unknown, p, p) == (v > 0) - (v < 0));
  }
  emb_geom_free(unknown);
  CHECK(counts.drops == 1);
  counts.drops = 0;
  custom.support = custom.depth = 0.5, custom.lipschitz = 1;
  /* failure, also where more parts follow */
  counts.fails = 1;
  three[0] = three[1] = a, three[2] = b;
  CHECK_OK(emb_geom_smooth_union(3, three, &custom, &unknown));
  CHECK(isnan(emb_geom_value(unknown, 0.75, 0, 0)));
  emb_geom_free(unknown);
  counts.drops = 0;
  CHECK(isnan(emb_geom_value(made, 0.75, 0, 0)));
  CHECK_STATUS(emb_geom_fill(made, &lattice, EMB_FILL_EXACT, 0, NULL, &out), EMB_ERROR_CALLBACK);
  /* dropped once for each geometry, and not where none was made */
  both[1] = NULL;
  CHECK_STATUS(emb_geom_smooth_union(2, both, &custom, &none), EMB_ERROR_NULL_ARGUMENT);
  CHECK(none == NULL && counts.drops == 0);
  emb_geom_free(made);
  CHECK(counts.drops == 1);
  emb_geom_free(again);
  CHECK(counts.drops == 2);
  emb_geom_free(expected);
  emb_geom_free(a);
  emb_geom_free(b);
}

int main(void) {
  int i;
  for (i = 0; i < N; i++) {
    axis[i] = -1.5 + 3.0 * i / (N - 1);
  }
  CHECK_OK(emb_pool_new(2, &pool));
  shapes_are_where_they_should_be();
  samples_and_expressions_are_bodies();
  transforms_move_turn_and_bend();
  sets_are_sharp_or_smooth();
  a_tree_answers_every_question_alike();
  functions_tell_what_they_know();
  blends_of_the_callers_are_kept();
  emb_pool_free(pool);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("trees");
}
