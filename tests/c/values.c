/* SPDX-License-Identifier: MIT OR Apache-2.0
 * One point, one value: the same bits from value, values, closest and fill, with every layout, lattice and number of
 * threads; crossings and intercepts agree; callbacks and handles live as long as they must. The last line is a hash of
 * all results, to be compared between libraries and instruction sets. */
#include "check.h"

#define POINTS 2000
#define NX 19
#define NY 11
#define NZ 7
#define CELLS (NX * NY * NZ)

static uint64_t hash = HASH_START;
static emb_pool *pool;
static double axis_x[NX], axis_y[NY], axis_z[NZ];

/* Stretched cells of unequal sides; y falls. */
static void make_axes(void) {
  int i;
  for (i = 0; i < NX; i++) {
    axis_x[i] = -1.5 + 3.0 * i / (NX - 1);
  }
  for (i = 0; i < NY; i++) {
    axis_y[i] = 1.3 - 0.02 * i * i - 0.05 * i;
  }
  for (i = 0; i < NZ; i++) {
    axis_z[i] = -1.1 + 0.37 * i;
  }
}

static emb_lattice lattice_of(size_t nx, size_t ny, size_t nz) {
  emb_lattice lattice = {sizeof lattice, {nx, ny, nz}, axis_x, axis_y, axis_z};
  return lattice;
}

static emb_array array_of(void *data, int32_t type) {
  emb_array array = {sizeof array, data, type, {0, 0, 0}};
  return array;
}

/* What a float result must be: the value rounded, with its sign kept. */
static float to_float(double value) {
  float f = (float)value;
  if (value != 0.0 && fabsf(f) < 1.17549435e-38f) {
    return value < 0 ? -1.17549435e-38f : 1.17549435e-38f;
  }
  return f;
}

static void batches_agree_with_single_points(const emb_geom *g) {
  static double p[3 * POINTS], x[POINTS], y[POINTS], z[POINTS], one[POINTS], separate[POINTS], together[POINTS], pooled[POINTS];
  static float pf[3 * POINTS], single_f[POINTS], batch_f[POINTS];
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int i;
  run.pool = pool;
  for (i = 0; i < POINTS; i++) {
    x[i] = p[3 * i] = random_between(-2, 2);
    y[i] = p[3 * i + 1] = random_between(-2, 2);
    z[i] = p[3 * i + 2] = random_between(-2, 2);
    one[i] = emb_geom_value(g, x[i], y[i], z[i]);
    CHECK(same_double(one[i], emb_geom_value_fn((void *)(uintptr_t)g, x[i], y[i], z[i])));
    pf[3 * i] = (float)x[i], pf[3 * i + 1] = (float)y[i], pf[3 * i + 2] = (float)z[i];
    single_f[i] = emb_geom_value_f32(g, pf[3 * i], pf[3 * i + 1], pf[3 * i + 2]);
    CHECK(single_f[i] == to_float(emb_geom_value(g, pf[3 * i], pf[3 * i + 1], pf[3 * i + 2])));
  }
  CHECK_OK(emb_geom_values(g, POINTS, x, y, z, 1, NULL, separate));
  CHECK_OK(emb_geom_values(g, POINTS, p, p + 1, p + 2, 3, NULL, together));
  CHECK_OK(emb_geom_values(g, POINTS, p, p + 1, p + 2, 3, &run, pooled));
  CHECK(same_bits(one, separate, POINTS) && same_bits(one, together, POINTS) && same_bits(one, pooled, POINTS));
  CHECK_OK(emb_geom_values_f32(g, POINTS, pf, pf + 1, pf + 2, 3, &run, batch_f));
  CHECK(memcmp(single_f, batch_f, sizeof batch_f) == 0);
  hash = hash_bytes(hash, one, sizeof one);
  hash = hash_bytes(hash, single_f, sizeof single_f);
}

static void closest_points_agree(const emb_geom *g, int is_mesh) {
  static double p[3 * POINTS], value[POINTS], plain[POINTS], vectors[3][3 * POINTS], apart[3][POINTS];
  static int64_t primitive[POINTS];
  static int32_t part[POINTS], tag[POINTS], feature[POINTS];
  emb_closest_out out, separate;
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int i, k;
  run.pool = pool;
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.value = value;
  for (k = 0; k < 3; k++) {
    out.point[k] = vectors[0] + k;
    out.gradient[k] = vectors[1] + k;
    out.barycentric[k] = vectors[2] + k;
  }
  out.vector_stride = 3;
  out.primitive = primitive, out.part = part, out.tag = tag, out.feature = feature;
  for (i = 0; i < 3 * POINTS; i++) {
    p[i] = random_between(-2, 2);
  }
  CHECK_OK(emb_geom_values(g, POINTS, p, p + 1, p + 2, 3, NULL, plain));
  CHECK_OK(emb_geom_closest(g, POINTS, p, p + 1, p + 2, 3, INFINITY, &run, &out));
  CHECK(same_bits(plain, value, POINTS));
  for (i = 0; i < POINTS; i++) {
    const double *c = vectors[0] + 3 * i, *w = vectors[2] + 3 * i, *n = vectors[1] + 3 * i;
    double dx = p[3 * i] - c[0], dy = p[3 * i + 1] - c[1], dz = p[3 * i + 2] - c[2];
    CHECK(fabs(sqrt(dx * dx + dy * dy + dz * dz) - fabs(value[i])) < 1e-9);
    CHECK(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0) < 1e-9);
    CHECK(part[i] == -1);
    if (is_mesh) {
      CHECK(primitive[i] >= 0 && tag[i] == (int32_t)(primitive[i] % 7) && feature[i] >= 0 && feature[i] <= 6);
      CHECK(fabs(w[0] + w[1] + w[2] - 1.0) < 1e-9);
    } else {
      CHECK(tag[i] == -1 && feature[i] == -1 && isnan(w[0]));
    }
  }
  hash = hash_bytes(hash, vectors[0], sizeof vectors[0]);
  hash = hash_bytes(hash, primitive, sizeof primitive);
  /* another layout, fewer wishes */
  memset(&separate, 0, sizeof separate);
  separate.struct_size = sizeof separate;
  separate.vector_stride = 1;
  for (k = 0; k < 3; k++) {
    separate.point[k] = apart[k];
  }
  CHECK_OK(emb_geom_closest(g, POINTS, p, p + 1, p + 2, 3, INFINITY, NULL, &separate));
  for (i = 0; i < POINTS; i++) {
    CHECK(same_double(apart[0][i], vectors[0][3 * i]) && same_double(apart[2][i], vectors[0][3 * i + 2]));
  }
  /* a limit */
  CHECK_OK(emb_geom_closest(g, POINTS, p, p + 1, p + 2, 3, 0.25, &run, &out));
  for (i = 0; i < POINTS; i++) {
    if (fabs(plain[i]) < 0.25) {
      CHECK(same_double(plain[i], value[i]));
    } else {
      CHECK(value[i] == (plain[i] > 0 ? 0.25 : -0.25) && isnan(vectors[0][3 * i]) && primitive[i] == -1 &&
            tag[i] == -1 && feature[i] == -1);
    }
  }
}

static void fills_agree_with_single_points(const emb_geom *g) {
  static double exact[CELLS], pooled[CELLS], turned[CELLS], band[CELLS], wide[2 * CELLS];
  static float floats[CELLS], float_band[CELLS];
  static int32_t signs[CELLS];
  static int8_t bytes[CELLS];
  emb_lattice lattice = lattice_of(NX, NY, NZ);
  emb_array out = array_of(exact, EMB_F64);
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int i, j, k, at = 0;
  run.pool = pool;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, NAN, NULL, &out));
  out.data = pooled;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, &run, &out));
  CHECK(same_bits(exact, pooled, CELLS));
  out.data = band;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_BAND, 0.3, &run, &out));
  /* from the other end in x, z fastest */
  out.data = turned + (NX - 1) * NY * NZ;
  out.stride[0] = -NY * NZ, out.stride[1] = NZ, out.stride[2] = 1;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, &run, &out));
  /* every second element of a larger array */
  for (i = 0; i < 2 * CELLS; i++) {
    wide[i] = -77.0;
  }
  out.data = wide, out.stride[0] = 2, out.stride[1] = 2 * NX, out.stride[2] = 2 * NX * NY;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, NULL, &out));
  out = array_of(floats, EMB_F32);
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, NULL, &out));
  out.data = float_band;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_BAND, 0.3, NULL, &out));
  out = array_of(signs, EMB_I32);
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_SIGN, 0.0, &run, &out));
  out = array_of(bytes, EMB_I8);
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_SIGN, 0.0, NULL, &out));
  for (k = 0; k < NZ; k++) {
    for (j = 0; j < NY; j++) {
      for (i = 0; i < NX; i++, at++) {
        double v = emb_geom_value(g, axis_x[i], axis_y[j], axis_z[k]);
        double b = fabs(v) < 0.3 ? v : v > 0 ? 0.3 : -0.3;
        int s = v > 0 ? 1 : v < 0 ? -1 : 0;
        CHECK(same_double(exact[at], v) && same_double(turned[((NX - 1 - i) * NY + j) * NZ + k], v));
        CHECK(same_double(wide[2 * at], v) && wide[2 * at + 1] == -77.0);
        CHECK(same_double(band[at], b) && floats[at] == to_float(v) && float_band[at] == to_float(b));
        CHECK(signs[at] == s && bytes[at] == s);
      }
    }
  }
  hash = hash_bytes(hash, exact, sizeof exact);
  hash = hash_bytes(hash, band, sizeof band);
}

/* A plane of nodes: z NULL is z = 0. */
static void plane_lattices_work(const emb_geom *g) {
  static double plane[NX * NY];
  static double edges[NX * NY];
  emb_lattice lattice = lattice_of(NX, NY, 1);
  emb_array out = array_of(plane, EMB_F64);
  emb_crossings_out crossings;
  int i, j;
  lattice.z = NULL;
  CHECK_OK(emb_geom_fill(g, &lattice, EMB_FILL_EXACT, 0.0, NULL, &out));
  for (j = 0; j < NY; j++) {
    for (i = 0; i < NX; i++) {
      CHECK(same_double(plane[j * NX + i], emb_geom_value(g, axis_x[i], axis_y[j], 0.0)));
    }
  }
  memset(&crossings, 0, sizeof crossings);
  crossings.struct_size = sizeof crossings;
  crossings.none = -9.0;
  crossings.where = array_of(edges, EMB_F64);
  CHECK_OK(emb_geom_crossings(g, &lattice, 1, NULL, &crossings));
  for (j = 0; j + 1 < NY; j++) {
    for (i = 0; i < NX; i++) {
      double at = edges[j * NX + i];
      int crossed = (plane[j * NX + i] <= 0) != (plane[(j + 1) * NX + i] <= 0);
      CHECK(crossed == (at != -9.0));
      CHECK(!crossed || (at <= axis_y[j] && at >= axis_y[j + 1]));
    }
  }
  /* no edge leaves a plane */
  memset(edges, 0xA5, sizeof edges);
  memcpy(plane, edges, sizeof edges);
  CHECK_OK(emb_geom_crossings(g, &lattice, 2, NULL, &crossings));
  CHECK(same_bits(plane, edges, NX * NY));
}

static void crossings_agree_with_intercepts(const emb_geom *g) {
  static double where[CELLS], fraction[CELLS], left[CELLS], a[3 * CELLS], b[3 * CELLS], t[CELLS], back[CELLS];
  static float where_f[CELLS];
  static int32_t count[CELLS], tag[CELLS], part[CELLS], hit_count[CELLS], hit_status[CELLS], hit_tag[CELLS];
  static int8_t count8[CELLS];
  const double *axes[3];
  emb_run run = {sizeof run, NULL, NULL, NULL};
  int axis, i, j, k, crossed = 0;
  axes[0] = axis_x, axes[1] = axis_y, axes[2] = axis_z;
  run.pool = pool;
  for (axis = 0; axis < 3; axis++) {
    emb_lattice lattice = lattice_of(NX, NY, NZ);
    int n[3] = {NX, NY, NZ}, at = 0, edges;
    emb_crossings_out out;
    emb_hit_out hit;
    n[axis]--;
    edges = n[0] * n[1] * n[2];
    memset(&out, 0, sizeof out);
    out.struct_size = sizeof out;
    out.none = NAN;
    out.where = array_of(where, EMB_F64);
    out.count = array_of(count, EMB_I32);
    out.tag = array_of(tag, EMB_I32);
    out.part = array_of(part, EMB_I32);
    CHECK_OK(emb_geom_crossings(g, &lattice, axis, &run, &out));
    memset(&out.tag, 0, sizeof out.tag);
    memset(&out.part, 0, sizeof out.part);
    out.form = EMB_CROSSING_FRACTION;
    out.where.data = fraction;
    out.count = array_of(count8, EMB_I8);
    CHECK_OK(emb_geom_crossings(g, &lattice, axis, NULL, &out));
    memset(&out.count, 0, sizeof out.count);
    for (i = 0; i < CELLS; i++) {
      left[i] = -5.0;
    }
    out.where.data = left;
    out.elsewhere = EMB_ELSEWHERE_LEAVE;
    CHECK_OK(emb_geom_crossings(g, &lattice, axis, &run, &out));
    out.form = EMB_CROSSING_COORDINATE, out.elsewhere = EMB_ELSEWHERE_WRITE;
    out.where = array_of(where_f, EMB_F32);
    CHECK_OK(emb_geom_crossings(g, &lattice, axis, &run, &out));
    for (k = 0; k < n[2]; k++) {
      for (j = 0; j < n[1]; j++) {
        for (i = 0; i < n[0]; i++, at++) {
          double *p = a + 3 * at, *q = b + 3 * at;
          p[0] = q[0] = axis_x[i], p[1] = q[1] = axis_y[j], p[2] = q[2] = axis_z[k];
          q[axis] = axes[axis][(axis == 0 ? i : axis == 1 ? j : k) + 1];
        }
      }
    }
    memset(&hit, 0, sizeof hit);
    hit.struct_size = sizeof hit;
    hit.t = t, hit.count = hit_count, hit.status = hit_status, hit.tag = hit_tag;
    CHECK_OK(emb_geom_intercepts(g, (size_t)edges, a, b, &run, &hit));
    memset(&hit, 0, sizeof hit);
    hit.struct_size = sizeof hit;
    hit.t = back;
    CHECK_OK(emb_geom_intercepts(g, (size_t)edges, b, a, NULL, &hit));
    for (at = 0; at < edges; at++) {
      int sides = (emb_geom_value(g, a[3 * at], a[3 * at + 1], a[3 * at + 2]) <= 0) !=
                  (emb_geom_value(g, b[3 * at], b[3 * at + 1], b[3 * at + 2]) <= 0);
      CHECK(sides == !isnan(t[at]) && sides == !isnan(back[at]) && sides == !isnan(where[at]));
      CHECK(count[at] == hit_count[at] && count8[at] == hit_count[at] && tag[at] == hit_tag[at] && part[at] == -1);
      CHECK(same_double(fraction[at], t[at]) || (isnan(t[at]) && isnan(fraction[at])));
      if (sides) {
        double lo = fmin(a[3 * at + axis], b[3 * at + axis]), hi = fmax(a[3 * at + axis], b[3 * at + axis]);
        CHECK(t[at] >= 0 && t[at] <= 1 && where[at] >= lo && where[at] <= hi && fabs(t[at] + back[at] - 1) < 1e-12);
        CHECK(same_double(left[at], t[at]) && where_f[at] == to_float(where[at]) && hit_status[at] > 0);
        crossed++;
      } else {
        CHECK(left[at] == -5.0 && isnan(where_f[at]) && hit_status[at] == 0);
      }
    }
    hash = hash_bytes(hash, where, (size_t)edges * sizeof *where);
  }
  CHECK(crossed > 20);
}

static void boxes_are_classified(const emb_geom *g) {
  static double lo[300], hi[300];
  int32_t single, classes[100];
  int i, k, c, uniform = 0;
  for (i = 0; i < 300; i++) {
    lo[i] = random_between(-2, 2);
    hi[i] = lo[i] + random_between(0, 0.4);
  }
  CHECK_OK(emb_geom_classify_boxes(g, 100, lo, hi, NULL, classes));
  for (i = 0; i < 100; i++) {
    single = emb_geom_classify_box(g, lo + 3 * i, hi + 3 * i);
    CHECK(single == classes[i] && single >= -1 && single <= 1);
    uniform += single != 0;
    for (k = 0; single != 0 && k < 100; k++) {
      double p[3];
      for (c = 0; c < 3; c++) {
        p[c] = random_between(lo[3 * i + c], hi[3 * i + c]);
      }
      CHECK(emb_geom_value(g, p[0], p[1], p[2]) * single > 0);
    }
  }
  CHECK(uniform > 10);
}

static void describes_itself(const emb_geom *g, int32_t kind) {
  emb_geom_properties properties;
  double lo[3], hi[3];
  memset(&properties, 0, sizeof properties);
  properties.struct_size = sizeof properties;
  CHECK_OK(emb_geom_properties_get(g, &properties));
  CHECK(properties.kind == kind && properties.lipschitz >= 1.0 && properties.primitives > 0 && properties.bytes > 0);
  CHECK_OK(emb_geom_bounds(g, lo, hi));
  CHECK(lo[0] < hi[0] && lo[1] < hi[1] && lo[2] < hi[2]);
  CHECK(emb_geom_fingerprint(g) != 0);
}

/* Handles are freed in the wrong order; the composite lives on. */
static emb_geom *composite(void) {
  const double center[3] = {0.2, -0.1, 0.1}, lo[3] = {-0.9, -0.8, -0.7}, hi[3] = {0.1, 0.9, 0.6};
  const double shift[3] = {0.1, 0.2, -0.3}, quarter[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  emb_geom *sphere, *box, *both, *moved, *placed, *cut, *outer, *again;
  const emb_geom *parts[2];
  CHECK_OK(emb_geom_sphere(center, 0.8, &sphere));
  CHECK_OK(emb_geom_box(lo, hi, &box));
  parts[0] = sphere, parts[1] = box;
  CHECK_OK(emb_geom_union(2, parts, &both));
  emb_geom_free(sphere);
  CHECK_OK(emb_geom_translate(both, shift, &moved));
  emb_geom_free(both);
  CHECK_OK(emb_geom_place(moved, quarter, shift, &placed));
  CHECK_OK(emb_geom_difference(placed, box, &cut));
  emb_geom_free(box);
  emb_geom_free(moved);
  again = emb_geom_clone(cut);
  emb_geom_free(cut);
  CHECK_OK(emb_geom_complement(again, &outer));
  CHECK(emb_geom_value(outer, 0.3, 0.2, 0.1) == 0.0 - emb_geom_value(again, 0.3, 0.2, 0.1));
  emb_geom_free(outer);
  emb_geom_free(placed);
  return again;
}

static void parts_are_labelled(void) {
  const double left[3] = {-2, 0, 0}, right[3] = {2, 0, 0}, x[2] = {-2.5, 2.5}, zero[2] = {0, 0};
  emb_geom *a, *b, *a7, *both, *all;
  const emb_geom *parts[2];
  int32_t part[2];
  emb_closest_out out;
  CHECK_OK(emb_geom_sphere(left, 1.0, &a));
  CHECK_OK(emb_geom_sphere(right, 1.0, &b));
  CHECK_OK(emb_geom_part(a, 7, &a7));
  parts[0] = a7, parts[1] = b;
  CHECK_OK(emb_geom_union(2, parts, &both));
  CHECK_OK(emb_geom_part(both, 9, &all));
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.part = part;
  CHECK_OK(emb_geom_closest(all, 2, x, zero, zero, 1, INFINITY, NULL, &out));
  CHECK(part[0] == 7 && part[1] == 9);
  emb_geom_free(a);
  emb_geom_free(b);
  emb_geom_free(a7);
  emb_geom_free(both);
  emb_geom_free(all);
}

static double failing_function(void *user, double x, double y, double z) {
  (void)user;
  return x > 0.5 ? NAN : sqrt(x * x + y * y + z * z) - 1.0;
}

static void callbacks_live_as_long_as_they_must(void) {
  int drops = 0, calls = 0;
  const double x[3] = {0, 0.4, 0.6}, zero[3] = {0, 0, 0}, lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
  double out[3];
  emb_callback_options options;
  emb_geom *counted, *joined, *failing, *box;
  const emb_geom *parts[2];
  emb_lattice lattice = lattice_of(NX, NY, NZ);
  static int8_t signs[CELLS];
  emb_array array = array_of(signs, EMB_I8);
  CHECK_OK(emb_callback_options_init(&options, sizeof options));
  CHECK(options.kind == EMB_SIGN_ONLY && options.thread_safe == 0 && options.lo[0] == -INFINITY &&
        options.hi[2] == INFINITY && options.lipschitz == 0.0);
  options.kind = EMB_EXACT;
  options.lipschitz = 1.0;
  CHECK_OK(emb_geom_callback(sphere_function, &calls, NULL, &options, &counted));
  CHECK(emb_geom_value(counted, 0.25, 0, 0) == -0.75 && calls == 1);
  emb_geom_free(counted);
  CHECK_OK(emb_geom_callback(sphere_function, &drops, count_drop, NULL, &counted));
  emb_geom_free(counted);
  CHECK(drops == 1); /* never called, dropped once */
  CHECK_OK(emb_geom_callback(failing_function, &drops, count_drop, &options, &failing));
  CHECK_OK(emb_geom_box(lo, hi, &box));
  parts[0] = failing, parts[1] = box;
  CHECK_OK(emb_geom_union(2, parts, &joined));
  CHECK(emb_geom_fingerprint(joined) == 0);
  emb_geom_free(failing);
  emb_geom_free(box);
  CHECK(drops == 1);
  CHECK(emb_geom_value(joined, 0.4, 0, 0) <= 0 && isnan(emb_geom_value(joined, 0.6, 0, 0)));
  CHECK_OK(emb_geom_values(joined, 2, x, zero, zero, 1, NULL, out));
  CHECK_STATUS(emb_geom_values(joined, 3, x, zero, zero, 1, NULL, out), EMB_ERROR_CALLBACK);
  CHECK_STATUS(emb_geom_fill(joined, &lattice, EMB_FILL_SIGN, 0.0, NULL, &array), EMB_ERROR_CALLBACK);
  emb_geom_free(joined);
  CHECK(drops == 2);
}

static void everything_agrees(const emb_geom *g, int is_mesh, int is_exact) {
  batches_agree_with_single_points(g);
  fills_agree_with_single_points(g);
  plane_lattices_work(g);
  crossings_agree_with_intercepts(g);
  boxes_are_classified(g);
  if (is_exact) {
    closest_points_agree(g, is_mesh);
    describes_itself(g, EMB_EXACT);
  }
}

/* What a mesh says of itself; a mesh turned inside out is turned back, unless it is to be kept. */
static void meshes_are_reported(const soup *s) {
  emb_mesh_report report;
  emb_mesh_options options;
  emb_mesh *mesh, *kept, *same;
  emb_geom *g;
  size_t i;
  soup inward = soup_cube(-1, 1);
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  mesh = soup_mesh(s);
  same = emb_mesh_clone(mesh);
  emb_mesh_free(mesh);
  CHECK_OK(emb_mesh_report_get(same, &report));
  CHECK(report.closed == 1 && report.consistent == 1 && report.inside_out == 0 && report.components == 1);
  CHECK(report.vertices == s->vertices && report.faces == s->triangles && report.triangles == s->triangles);
  CHECK(report.boundary_edges == 0 && report.self_intersections == UINT64_MAX && report.volume > 0 && report.area > 0);
  emb_mesh_free(same);
  for (i = 0; i < inward.triangles; i++) {
    uint32_t v = inward.indices[3 * i];
    inward.indices[3 * i] = inward.indices[3 * i + 1];
    inward.indices[3 * i + 1] = v;
  }
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  CHECK(options.scale == 1.0 && options.rotation[0] == 1.0 && options.rotation[1] == 0.0);
  CHECK_OK(emb_mesh_from_triangles(inward.vertices, inward.xyz, inward.triangles, inward.indices, NULL, &options, &mesh));
  options.orient = EMB_ORIENT_KEEP;
  CHECK_OK(emb_mesh_from_triangles(inward.vertices, inward.xyz, inward.triangles, inward.indices, NULL, &options, &kept));
  CHECK_OK(emb_mesh_report_get(mesh, &report));
  CHECK(report.inside_out == 1 && report.volume == -8.0 && report.area == 24.0 && report.hi[2] == 1.0);
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  CHECK(emb_geom_value(g, 0, 0, 0) == -1.0);
  emb_geom_free(g);
  CHECK_OK(emb_geom_from_mesh(kept, NULL, NULL, &g));
  CHECK(emb_geom_value(g, 0, 0, 0) == 1.0);
  emb_geom_free(g);
  emb_mesh_free(mesh);
  emb_mesh_free(kept);
  soup_free(&inward);
}

int main(void) {
  const double center[3] = {0.1, -0.2, 0.05}, lo[3] = {-1, -0.9, -0.8}, hi[3] = {0.7, 0.8, 0.9};
  soup ball = soup_sphere(1.0, 24), cube = soup_cube(-0.75, 0.75);
  emb_geom *g;
  make_axes();
  CHECK_OK(emb_pool_new(2, &pool));
  CHECK(emb_pool_width(pool) == 2);
  CHECK_OK(emb_geom_sphere(center, 1.1, &g));
  everything_agrees(g, 0, 1);
  emb_geom_free(g);
  CHECK_OK(emb_geom_box(lo, hi, &g));
  everything_agrees(g, 0, 1);
  emb_geom_free(g);
  g = composite();
  everything_agrees(g, 0, 0);
  emb_geom_free(g);
  g = soup_geometry(&ball);
  everything_agrees(g, 1, 1);
  emb_geom_free(g);
  g = soup_geometry(&cube);
  everything_agrees(g, 1, 1);
  emb_geom_free(g);
  meshes_are_reported(&ball);
  parts_are_labelled();
  callbacks_live_as_long_as_they_must();
  emb_pool_free(pool);
  soup_free(&ball);
  soup_free(&cube);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("values");
}
