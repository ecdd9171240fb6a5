/* SPDX-License-Identifier: MIT OR Apache-2.0
 * A fixed set of operations on bodies that code generates, for a counter of instructions: scripts/counts runs it.
 * Each is one call of `counted`, and one line is printed for each, in that order: name, unit, how many of it. */
#include "check.h"

#define SLICES 100 /* 9,800 triangles */
#define POINTS 2000
#define EDGES 1000
#define BOXES 2000
#define SIDE 32
#define BALLS 1000
#define CENTRES 50

#if defined(__clang__)
#define COUNTED __attribute__((noinline))
#else
#define COUNTED __attribute__((noinline, noclone))
#endif

/* Instructions are collected in here alone. */
COUNTED void counted(void (*operation)(void)) {
  operation();
}

static soup body;
static unsigned char *stl;
static size_t stl_size;
static emb_mesh *mesh, *read_again;
static emb_geom *of_mesh, *compact, *sphere, *balls, *tree, *made;
static emb_geom *ball[BALLS];
static double uniform[3 * POINTS], near_by[3 * POINTS], answers[POINTS], moved[3 * SLICES * SLICES];
static double edge_a[3 * EDGES], edge_b[3 * EDGES], box_lo[3 * BOXES], box_hi[3 * BOXES];
static double axis[SIDE], lattice_values[SIDE * SIDE * SIDE];
static int8_t signs[SIDE * SIDE * SIDE];
static int32_t classes[BOXES];
static int64_t faces[POINTS];

/* A sphere with bumps, as a polynomial, so that no libm is in it but that of the sphere. */
static void make_body(void) {
  size_t v;
  body = soup_sphere(1.0, SLICES);
  for (v = 0; v < body.vertices; v++) {
    double *p = body.xyz + 3 * v;
    const double bumps = 1.0 + 0.2 * p[0] * p[1] + 0.3 * p[1] * p[2] * p[2] * p[2];
    p[0] *= bumps, p[1] *= bumps, p[2] *= bumps;
  }
}

/* The body as a binary STL; callgrind's machine is little-endian. */
static void make_stl(void) {
  size_t t, c;
  const uint32_t count = (uint32_t)body.triangles;
  stl_size = 84 + 50 * body.triangles;
  stl = (unsigned char *)need(calloc(1, stl_size));
  memcpy(stl + 80, &count, 4);
  for (t = 0; t < body.triangles; t++) {
    for (c = 0; c < 9; c++) {
      const float x = (float)body.xyz[3 * body.indices[3 * t + c / 3] + c % 3];
      memcpy(stl + 84 + 50 * t + 12 + 4 * c, &x, 4);
    }
  }
}

/* Points anywhere, points within 2% of the surface, edges across it, boxes, a lattice. */
static void make_questions(void) {
  size_t k, d;
  for (k = 0; k < 3 * POINTS; k++) {
    uniform[k] = random_between(-1.6, 1.6);
  }
  for (k = 0; k < POINTS; k++) {
    const double *v = body.xyz + 3 * (size_t)(random_unit() * (double)body.vertices);
    const double out = random_between(0.98, 1.02);
    for (d = 0; d < 3; d++) {
      near_by[3 * k + d] = v[d] * out + random_between(-0.01, 0.01);
    }
  }
  for (k = 0; k < EDGES; k++) {
    const double *v = body.xyz + 3 * (size_t)(random_unit() * (double)body.vertices);
    for (d = 0; d < 3; d++) {
      const double aside = random_between(-0.01, 0.01);
      edge_a[3 * k + d] = 0.97 * v[d] + aside;
      edge_b[3 * k + d] = 1.03 * v[d] + aside;
    }
  }
  for (k = 0; k < 3 * BOXES; k++) {
    box_lo[k] = random_between(-1.6, 1.4);
    box_hi[k] = box_lo[k] + 0.2;
  }
  for (k = 0; k < SIDE; k++) {
    axis[k] = -1.5 + 3.0 * (double)k / (SIDE - 1);
  }
}

static void make_geometries(void) {
  emb_sdf_options options;
  emb_geom *shell = NULL, *cuts[2];
  const double lo[3] = {-0.7, -0.7, -0.7}, hi[3] = {0.7, 0.7, 0.7}, from[3] = {0, 0, -2}, to[3] = {0, 0, 2};
  size_t k;
  CHECK_OK(emb_mesh_from_triangles(body.vertices, body.xyz, body.triangles, body.indices, NULL, NULL, &mesh));
  CHECK_OK(emb_mesh_vertices(mesh, 0, body.vertices, moved));
  for (k = 0; k < 3 * body.vertices; k++) {
    moved[k] *= 1.0 + 0.01 * (double)(k % 3);
  }
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &of_mesh));
  CHECK_OK(emb_sdf_options_init(&options, sizeof options));
  options.accelerator = EMB_ACCELERATOR_COMPACT;
  CHECK_OK(emb_geom_from_mesh(mesh, &options, NULL, &compact));
  {
    soup round = soup_sphere(1.0, 60); /* 3,480 triangles */
    sphere = soup_geometry(&round);
    soup_free(&round);
  }
  for (k = 0; k < BALLS; k++) {
    double center[3];
    center[0] = random_between(-1, 1), center[1] = random_between(-1, 1), center[2] = random_between(-1, 1);
    CHECK_OK(emb_geom_sphere(center, random_between(0.02, 0.1), &ball[k]));
  }
  CHECK_OK(emb_geom_union(BALLS, (const emb_geom *const *)ball, &balls));
  /* The mesh without the balls, without a bore, and within a box. */
  CHECK_OK(emb_geom_cylinder(from, to, 0.2, &cuts[0]));
  cuts[1] = balls;
  CHECK_OK(emb_geom_difference_of_many(of_mesh, 2, (const emb_geom *const *)cuts, &shell));
  CHECK_OK(emb_geom_box(lo, hi, &cuts[1]));
  {
    const emb_geom *both[2];
    both[0] = shell, both[1] = cuts[1];
    CHECK_OK(emb_geom_intersection(2, both, &tree));
  }
  emb_geom_free(shell), emb_geom_free(cuts[0]), emb_geom_free(cuts[1]);
}

/* The operations. */

static void one_by_one(const emb_geom *g, const double *points) {
  size_t k;
  for (k = 0; k < POINTS; k++) {
    answers[k] = emb_geom_value(g, points[3 * k], points[3 * k + 1], points[3 * k + 2]);
  }
}

/* All triangles of a sphere are nearly as near to its centre: the worst case of a search. */
static void value_centre(void) {
  size_t k;
  for (k = 0; k < CENTRES; k++) {
    answers[k] = emb_geom_value(sphere, 1e-7 * uniform[3 * k], 1e-7 * uniform[3 * k + 1], 1e-7 * uniform[3 * k + 2]);
  }
}

static void in_one_call(const emb_geom *g, const double *points) {
  CHECK_OK(emb_geom_values(g, POINTS, points, points + 1, points + 2, 3, NULL, answers));
}

static void closest(const double *points) {
  static double point[3 * POINTS], gradient[3 * POINTS];
  emb_closest_out out;
  int d;
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.value = answers;
  out.primitive = faces;
  out.vector_stride = 3;
  for (d = 0; d < 3; d++) {
    out.point[d] = point + d;
    out.gradient[d] = gradient + d;
  }
  CHECK_OK(emb_geom_closest(of_mesh, POINTS, points, points + 1, points + 2, 3, INFINITY, NULL, &out));
}

static emb_lattice lattice(void) {
  emb_lattice l;
  memset(&l, 0, sizeof l);
  l.struct_size = sizeof l;
  l.n[0] = l.n[1] = l.n[2] = SIDE;
  l.x = l.y = l.z = axis;
  return l;
}

static emb_array array_of(void *data, int32_t type) {
  emb_array a;
  memset(&a, 0, sizeof a);
  a.struct_size = sizeof a;
  a.data = data;
  a.type = type;
  return a;
}

static void fill(const emb_geom *g, int32_t mode) {
  const emb_lattice l = lattice();
  const emb_array out = mode == EMB_FILL_SIGN ? array_of(signs, EMB_I8) : array_of(lattice_values, EMB_F64);
  CHECK_OK(emb_geom_fill(g, &l, mode, 2.0 * 3.0 / (SIDE - 1), NULL, &out));
}

static void all_crossings(const emb_geom *g) {
  const emb_lattice l = lattice();
  emb_crossings_out out;
  int32_t d;
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.form = EMB_CROSSING_FRACTION;
  out.elsewhere = EMB_ELSEWHERE_WRITE;
  out.none = NAN;
  out.where = array_of(lattice_values, EMB_F64);
  for (d = 0; d < 3; d++) {
    CHECK_OK(emb_geom_crossings(g, &l, d, NULL, &out));
  }
}

static void classify(const emb_geom *g) {
  CHECK_OK(emb_geom_classify_boxes(g, BOXES, box_lo, box_hi, NULL, classes));
}

static void refit(int32_t check) {
  CHECK_OK(emb_geom_refit(of_mesh, body.vertices, moved, check, NULL, &made));
}

static void value_uniform(void) { one_by_one(of_mesh, uniform); }
static void value_near(void) { one_by_one(of_mesh, near_by); }
static void values_uniform(void) { in_one_call(of_mesh, uniform); }
static void values_near(void) { in_one_call(of_mesh, near_by); }
static void values_compact(void) { in_one_call(compact, uniform); }
static void closest_uniform(void) { closest(uniform); }
static void closest_near(void) { closest(near_by); }
static void fill_exact(void) { fill(of_mesh, EMB_FILL_EXACT); }
static void fill_band(void) { fill(of_mesh, EMB_FILL_BAND); }
static void fill_sign(void) { fill(of_mesh, EMB_FILL_SIGN); }
static void crossings(void) { all_crossings(of_mesh); }
static void classify_mesh(void) { classify(of_mesh); }
static void refit_checked(void) { refit(EMB_REFIT_CHECK); }
static void refit_trusted(void) { refit(EMB_REFIT_TRUST); }
static void values_balls(void) { in_one_call(balls, uniform); }
static void values_tree(void) { in_one_call(tree, uniform); }
static void sign_tree(void) { fill(tree, EMB_FILL_SIGN); }
static void classify_tree(void) { classify(tree); }

static void intercepts(void) {
  static double t[EDGES];
  emb_hit_out out;
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.t = t;
  CHECK_OK(emb_geom_intercepts(of_mesh, EDGES, edge_a, edge_b, NULL, &out));
}

static void read_stl(void) { CHECK_OK(emb_mesh_read_memory(stl, stl_size, NULL, NULL, &read_again)); }
static void build(void) { CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &made)); }
static void build_balls(void) { CHECK_OK(emb_geom_union(BALLS, (const emb_geom *const *)ball, &made)); }

int main(void) {
  const size_t points = (size_t)SIDE * SIDE * SIDE, edges = (size_t)3 * SIDE * SIDE * (SIDE - 1);
  const struct {
    const char *name, *unit;
    size_t count;
    void (*run)(void);
  } operations[] = {
      {"value, uniform", "point", POINTS, value_uniform},
      {"value, near", "point", POINTS, value_near},
      {"value, centre of a sphere", "point", CENTRES, value_centre},
      {"values in one call, uniform", "point", POINTS, values_uniform},
      {"values in one call, near", "point", POINTS, values_near},
      {"values in one call, uniform, compact", "point", POINTS, values_compact},
      {"closest in one call, uniform", "point", POINTS, closest_uniform},
      {"closest in one call, near", "point", POINTS, closest_near},
      {"fill exact", "point", points, fill_exact},
      {"fill band", "point", points, fill_band},
      {"fill sign", "point", points, fill_sign},
      {"crossings along three axes", "edge", edges, crossings},
      {"intercepts", "edge", EDGES, intercepts},
      {"classify", "box", BOXES, classify_mesh},
      {"read STL", "triangle", 0, read_stl},
      {"build", "triangle", 0, build},
      {"refit checked", "triangle", 0, refit_checked},
      {"refit trusted", "triangle", 0, refit_trusted},
      {"1,000 balls, build", "ball", BALLS, build_balls},
      {"1,000 balls, values in one call", "point", POINTS, values_balls},
      {"tree, values in one call", "point", POINTS, values_tree},
      {"tree, fill sign", "point", points, sign_tree},
      {"tree, classify", "box", BOXES, classify_tree},
  };
  size_t k;
  emb_isa();
  make_body();
  make_stl();
  make_questions();
  make_geometries();
  for (k = 0; k < sizeof operations / sizeof *operations; k++) {
    counted(operations[k].run);
    printf("%s\t%s\t%lu\n", operations[k].name, operations[k].unit,
           (unsigned long)(operations[k].count != 0 ? operations[k].count : body.triangles));
    emb_geom_free(made);
    emb_mesh_free(read_again);
    made = NULL;
    read_again = NULL;
  }
  return checks_failed != 0;
}
