/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Results do not depend on the caller's floating-point environment, and the caller finds it, sticky flags included, as
 * it left it: with every trap enabled, flushed denormals and each rounding mode. Callbacks run in the caller's. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "check.h"

#include <fenv.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#define POINTS 500
#define N 12
#define CELLS (N * N * N)

/* The control and status word, as far as this machine has one that can be read. */
static uint32_t word(void) {
#if defined(__x86_64__)
  return _mm_getcsr();
#else
  return (uint32_t)fegetround();
#endif
}

static void flush_denormals(int on) {
#if defined(__x86_64__)
  _mm_setcsr(on ? _mm_getcsr() | 0x8040u : _mm_getcsr() & ~0x8040u);
#else
  (void)on;
#endif
}

/* Everything that is computed, in one environment. */
typedef struct results {
  double values[POINTS], one[POINTS], fill[CELLS], band[CELLS], where[CELLS], t[POINTS], point[3 * POINTS], bounds[6];
  double tiny[CELLS], tree[POINTS];
  float floats[CELLS];
  int32_t signs[CELLS], classes[POINTS];
  uint64_t fingerprint, tree_fingerprint;
  emb_mesh_report report;
} results;

static double points[3 * POINTS], ends[3 * POINTS], axis[N], tiny_axis[N];
static soup ball;
static emb_pool *pool;
static uint32_t callback_word, values_word, gradient_word, range_word, blend_word;
static uint32_t progress_word, executor_word, drop_word;
static int keeps_word; /* valgrind does not */
static int has_executor;

/* Exact, since it may run with every trap enabled. */
static double recording_function(void *user, double x, double y, double z) {
  (void)user;
  callback_word = word();
  return x > 0.25 || y > 0.25 || z > 0.25 ? 1.0 : -1.0;
}

static void recording_values(void *user, size_t count, const double *x, const double *y, const double *z, double *out) {
  size_t i;
  (void)user;
  values_word = word();
  for (i = 0; i < count; i++) {
    out[i] = x[i] > 0.25 || y[i] > 0.25 || z[i] > 0.25 ? 1.0 : -1.0;
  }
}

static int32_t recording_gradient(void *user, double x, double y, double z, double *out_gradient) {
  (void)user, (void)x, (void)y, (void)z;
  gradient_word = word();
  out_gradient[0] = 1.0, out_gradient[1] = out_gradient[2] = 0.0;
  return 0;
}

static int32_t recording_range(void *user, const double *lo, const double *hi, double *out_lo, double *out_hi) {
  (void)user, (void)lo, (void)hi;
  range_word = word();
  *out_lo = -1.0, *out_hi = 1.0;
  return 0;
}

static double recording_blend(void *user, double a, double b, double *out_by_a, double *out_by_b) {
  (void)user, (void)b;
  blend_word = word();
  *out_by_a = 1.0, *out_by_b = 0.0;
  return a;
}

static int32_t recording_progress(void *user, double fraction) {
  (void)user;
  (void)fraction;
  progress_word = word();
  return 0;
}

static void recording_drop(void *user) {
  (void)user;
  drop_word = word();
}

static void recording_executor(void *user, size_t tasks, void (*task)(void *context, size_t index), void *context) {
  size_t i;
  (void)user;
  executor_word = word();
  for (i = 0; i < tasks; i++) {
    task(context, i);
  }
}

/* The word that every call must leave as it was, and the environment that callbacks must see. */
static uint32_t outside;
#define SAME(call)                                       \
  do {                                                   \
    outside = word();                                    \
    CHECK_OK(call);                                      \
    CHECK(!keeps_word || word() == outside);             \
  } while (0)
#define SAME_VOID(statement)                             \
  do {                                                   \
    outside = word();                                    \
    statement;                                           \
    CHECK(!keeps_word || word() == outside);             \
  } while (0)

/* Shapes, maps, blends and an expression. */
static emb_geom *tree(void) {
  const double center[3] = {0.1, 0.2, 0.3}, axes[3] = {0.6, 0.3, 0.2}, up[3] = {0.1, 0.2, 1.0}, a[3] = {-0.5, 0, 0};
  const double shear[9] = {1, 0.25, 0, 0, 1, 0, 0, 0.125, 1};
  emb_blend blend;
  emb_geom *ellipsoid, *torus, *prism, *wavy, *turned, *sheared, *smooth, *all;
  const emb_geom *parts[3];
  SAME(emb_blend_init(&blend, sizeof blend));
  blend.width = 0.15;
  SAME(emb_geom_ellipsoid(center, axes, NULL, &ellipsoid));
  SAME(emb_geom_torus(center, up, 0.5, 0.1, &torus));
  SAME(emb_geom_prism(a, center, up, 5, 0.2, &prism));
  SAME(emb_geom_expression("sqrt(x^2 + y^2) - 0.2*exp(-z^2) - 0.05*sin(9*z)", NULL, &wavy));
  SAME(emb_geom_rotate(torus, up, 40, center, &turned));
  SAME(emb_geom_affine(prism, shear, NULL, &sheared));
  parts[0] = ellipsoid, parts[1] = turned, parts[2] = sheared;
  SAME(emb_geom_smooth_union(3, parts, &blend, &smooth));
  parts[0] = smooth, parts[1] = wavy;
  SAME(emb_geom_difference_of_many(smooth, 1, parts + 1, &all));
  emb_geom_free(ellipsoid), emb_geom_free(torus), emb_geom_free(prism), emb_geom_free(wavy), emb_geom_free(turned);
  emb_geom_free(sheared), emb_geom_free(smooth);
  return all;
}

/* What callbacks find besides the value. */
static void callbacks_see_the_callers_environment(const emb_geom *other, const emb_callback_options *plain) {
  const double lo[3] = {-2, -2, -2}, hi[3] = {2, 2, 2};
  emb_callback_options options = *plain;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  emb_blend blend;
  emb_closest_out closest;
  emb_geom *function, *blended;
  const emb_geom *parts[2];
  double values[POINTS], gradient[POINTS];
  run.pool = pool;
  options.values = recording_values, options.gradient = recording_gradient, options.range = recording_range;
  options.kind = EMB_LOWER_BOUND;
  SAME(emb_geom_callback(recording_function, NULL, NULL, &options, &function));
  SAME(emb_geom_values(function, POINTS, points, points + 1, points + 2, 3, &run, values));
  CHECK(!keeps_word || values_word == outside);
  memset(&closest, 0, sizeof closest);
  closest.struct_size = sizeof closest;
  closest.gradient[0] = gradient, closest.vector_stride = 1;
  SAME(emb_geom_closest(function, POINTS, points, points + 1, points + 2, 3, INFINITY, &run, &closest));
  CHECK(!keeps_word || gradient_word == outside);
  SAME_VOID(CHECK(emb_geom_classify_box(function, lo, hi) == 0));
  CHECK(!keeps_word || range_word == outside);
  SAME(emb_blend_init(&blend, sizeof blend));
  blend.kind = EMB_BLEND_CUSTOM, blend.blend = recording_blend, blend.thread_safe = 1, blend.drop = recording_drop;
  blend.depth = 0.0, blend.lipschitz = 1.0;
  parts[0] = function, parts[1] = other;
  SAME(emb_geom_smooth_union(2, parts, &blend, &blended));
  SAME_VOID(emb_geom_value(blended, 0.1, 0.2, 0.3));
  CHECK(!keeps_word || blend_word == outside);
  blend_word = 0;
  SAME(emb_geom_values(blended, POINTS, points, points + 1, points + 2, 3, &run, values));
  CHECK(!keeps_word || blend_word == outside);
  emb_geom_free(function);
  drop_word = 0;
  SAME_VOID(emb_geom_free(blended));
  CHECK(!keeps_word || drop_word == outside);
}

static void compute(results *r) {
  const double center[3] = {0.1, 0.2, 0.3}, lo[3] = {-0.3, -0.3, -0.3}, hi[3] = {0.4, 0.4, 0.4};
  const double turn[9] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
  emb_mesh_options mesh_options;
  emb_sdf_options sdf_options;
  emb_callback_options callback_options;
  emb_mesh *mesh;
  emb_geom *g, *sphere, *box, *united, *placed, *function;
  const emb_geom *parts[2];
  emb_run run = {sizeof run, NULL, NULL, NULL};
  emb_lattice lattice = {sizeof lattice, {N, N, N}, axis, axis, axis};
  emb_array out = {sizeof out, NULL, EMB_F64, {0, 0, 0}};
  emb_crossings_out crossings;
  emb_closest_out closest;
  emb_hit_out hit;
  int i;
  memset(r, 0, sizeof *r);
  run.pool = pool;
  run.progress = recording_progress;
  SAME(emb_mesh_options_init(&mesh_options, sizeof mesh_options));
  SAME(emb_sdf_options_init(&sdf_options, sizeof sdf_options));
  SAME(emb_callback_options_init(&callback_options, sizeof callback_options));
  SAME(emb_mesh_from_triangles(ball.vertices, ball.xyz, ball.triangles, ball.indices, ball.tags, &mesh_options, &mesh));
  r->report.struct_size = sizeof r->report;
  SAME(emb_mesh_report_get(mesh, &r->report));
  SAME(emb_geom_from_mesh(mesh, &sdf_options, &run, &g));
  SAME_VOID(emb_mesh_free(mesh));
  SAME(emb_geom_sphere(center, 0.7, &sphere));
  SAME(emb_geom_box(lo, hi, &box));
  parts[0] = g, parts[1] = box;
  SAME(emb_geom_union(2, parts, &united));
  SAME(emb_geom_place(united, turn, center, &placed));
  SAME(emb_geom_values(placed, POINTS, points, points + 1, points + 2, 3, &run, r->values));
  CHECK(!keeps_word || progress_word == outside);
  for (i = 0; i < POINTS; i++) {
    SAME_VOID(r->one[i] = emb_geom_value(placed, points[3 * i], points[3 * i + 1], points[3 * i + 2]));
  }
  out.data = r->fill;
  SAME(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, &run, &out));
  out.data = r->band;
  SAME(emb_geom_fill(placed, &lattice, EMB_FILL_BAND, 0.2, &run, &out));
  out.data = r->floats, out.type = EMB_F32;
  SAME(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, &run, &out));
  out.data = r->signs, out.type = EMB_I32;
  SAME(emb_geom_fill(placed, &lattice, EMB_FILL_SIGN, 0.0, &run, &out));
  memset(&crossings, 0, sizeof crossings);
  crossings.struct_size = sizeof crossings;
  crossings.where = out;
  crossings.where.data = r->where, crossings.where.type = EMB_F64;
  SAME(emb_geom_crossings(g, &lattice, 1, &run, &crossings));
  memset(&closest, 0, sizeof closest);
  closest.struct_size = sizeof closest;
  for (i = 0; i < 3; i++) {
    closest.point[i] = r->point + i;
  }
  closest.vector_stride = 3;
  SAME(emb_geom_closest(placed, POINTS, points, points + 1, points + 2, 3, INFINITY, &run, &closest));
  memset(&hit, 0, sizeof hit);
  hit.struct_size = sizeof hit;
  hit.t = r->t;
  SAME(emb_geom_intercepts(g, POINTS, points, ends, &run, &hit));
  for (i = 0; i < POINTS; i++) {
    SAME_VOID(r->classes[i] = emb_geom_classify_box(g, points + 3 * i, ends + 3 * i));
  }
  SAME(emb_geom_bounds(placed, r->bounds, r->bounds + 3));
  SAME_VOID(r->fingerprint = emb_geom_fingerprint(placed));
  /* lengths whose squares and whose differences are denormal */
  SAME_VOID(emb_geom_free(sphere));
  SAME(emb_geom_sphere(center, 0.7, &sphere));
  lattice.x = lattice.y = lattice.z = tiny_axis;
  {
    const double origin[3] = {0, 0, 0};
    emb_geom *small;
    SAME(emb_geom_sphere(origin, 1e-310, &small));
    out.data = r->tiny, out.type = EMB_F64;
    SAME(emb_geom_fill(small, &lattice, EMB_FILL_EXACT, 0.0, &run, &out));
    SAME_VOID(emb_geom_free(small));
  }
  SAME(emb_geom_callback(recording_function, NULL, recording_drop, &callback_options, &function));
  callback_word = 0;
  SAME_VOID(emb_geom_value(function, 0.1, 0.2, 0.3));
  CHECK(!keeps_word || (callback_word == outside));
  SAME_VOID(emb_geom_free(function));
  CHECK(!keeps_word || drop_word == outside);
  callback_options.thread_safe = 1;
  SAME(emb_geom_callback(recording_function, NULL, NULL, &callback_options, &function));
  lattice.x = lattice.y = lattice.z = axis;
  out.data = r->signs, out.type = EMB_I32;
  SAME(emb_geom_fill(function, &lattice, EMB_FILL_SIGN, 0.0, &run, &out));
  CHECK(!keeps_word || callback_word == outside);
  CHECK(!keeps_word || !has_executor || executor_word == outside);
  callbacks_see_the_callers_environment(sphere, &callback_options);
  {
    emb_geom *g = tree();
    SAME(emb_geom_values(g, POINTS, points, points + 1, points + 2, 3, &run, r->tree));
    SAME_VOID(r->tree_fingerprint = emb_geom_fingerprint(g));
    emb_geom_free(g);
  }
  /* errors too */
  SAME_VOID(CHECK(emb_geom_sphere(NULL, 1.0, &sphere) == EMB_ERROR_NULL_ARGUMENT));
  SAME_VOID(CHECK(strcmp(emb_last_error(), "center: NULL") == 0));
  SAME_VOID(emb_geom_free(emb_geom_clone(sphere)));
  emb_geom_free(g);
  emb_geom_free(sphere);
  emb_geom_free(box);
  emb_geom_free(united);
  emb_geom_free(placed);
  emb_geom_free(function);
}

static results reference, again;

/* Computes in the present environment and compares. */
static void compare(const char *environment) {
  compute(&again);
  if (!check_that(memcmp(&reference, &again, sizeof again) == 0, environment, __FILE__, __LINE__)) {
    printf("    other bits\n");
  }
}

static void in_every_environment(void) {
  static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  static const char *const names[4] = {"to nearest", "upward", "downward", "toward zero"};
  int i;
  compute(&reference);
  for (i = 0; i < 4; i++) {
    CHECK(fesetround(modes[i]) == 0);
    compare(names[i]);
    flush_denormals(1);
    compare(names[i]);
    flush_denormals(0);
  }
  fesetround(FE_TONEAREST);
  feclearexcept(FE_ALL_EXCEPT);
  feraiseexcept(FE_DIVBYZERO | FE_UNDERFLOW);
  compare("sticky flags");
  CHECK(!keeps_word || fetestexcept(FE_ALL_EXCEPT) == (FE_DIVBYZERO | FE_UNDERFLOW));
  feclearexcept(FE_ALL_EXCEPT);
#if defined(__GLIBC__)
  if (feenableexcept(FE_ALL_EXCEPT) != -1) {
    compare("traps");
    flush_denormals(1);
    fesetround(FE_DOWNWARD);
    compare("traps, flushing, downward");
    fesetround(FE_TONEAREST);
    flush_denormals(0);
    fedisableexcept(FE_ALL_EXCEPT);
  }
#endif
}

int main(void) {
  int i;
  uint32_t before = word();
  flush_denormals(1);
  keeps_word = word() != before;
  flush_denormals(0);
  if (!keeps_word) {
    printf("environment: the control word is not kept here; only results are compared\n");
  }
  ball = soup_sphere(1.0, 16);
  for (i = 0; i < 3 * POINTS; i++) {
    points[i] = random_between(-1.5, 1.5);
    ends[i] = points[i] + random_between(0, 0.5);
  }
  for (i = 0; i < N; i++) {
    axis[i] = -1.2 + 2.4 * i / (N - 1);
    tiny_axis[i] = (i - 5) * 4e-311;
  }
  in_every_environment();
  CHECK_OK(emb_pool_new(2, &pool));
  in_every_environment();
  emb_pool_free(pool);
  has_executor = 1;
  CHECK_OK(emb_pool_from_callback(3, recording_executor, NULL, NULL, &pool));
  in_every_environment();
  emb_pool_free(pool);
  soup_free(&ball);
  return checks_done("environment");
}
