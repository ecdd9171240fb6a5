/* SPDX-License-Identifier: MIT OR Apache-2.0
 * What the C harness needs, without a framework: counted checks, bodies that code generates, points.
 * Each .c file here is one program that takes no arguments and exits with 0 where every check held. */
#ifndef EMBOUND_TEST_CHECK_H
#define EMBOUND_TEST_CHECK_H

#include "embound.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define UNUSED __attribute__((unused))
#else
#define UNUSED
#endif

static int checks_made, checks_failed;

/* One check. The first failures of a program are printed, all are counted. */
#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)

/* A call that must return `status`. */
#define CHECK_STATUS(call, status) check_status((call), (status), #call, __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(call, EMB_OK)

static UNUSED int check_that(int holds, const char *what, const char *file, int line) {
  checks_made++;
  if (!holds && ++checks_failed <= 50) {
    printf("%s:%d: %s\n", file, line, what);
  }
  return holds;
}

static UNUSED int check_status(emb_status got, emb_status wanted, const char *call, const char *file, int line) {
  if (!check_that(got == wanted, call, file, line)) {
    printf("    status %d, not %d: %s\n", (int)got, (int)wanted, emb_last_error());
    return 0;
  }
  return 1;
}

/* The program's exit code. */
static UNUSED int checks_done(const char *program) {
  printf("%s: %d checks, %d failed\n", program, checks_made, checks_failed);
  return checks_failed != 0 || checks_made == 0;
}

static UNUSED void *need(void *memory) {
  if (memory == NULL) {
    printf("out of memory\n");
    exit(2);
  }
  return memory;
}

/* Bits. */

static UNUSED int same_bits(const double *a, const double *b, size_t count) {
  return memcmp(a, b, count * sizeof *a) == 0;
}

static UNUSED int same_double(double a, double b) {
  return same_bits(&a, &b, 1);
}

/* FNV-1a, to compare results between programs. */
static UNUSED uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size) {
  const unsigned char *at = (const unsigned char *)bytes;
  size_t i;
  for (i = 0; i < size; i++) {
    hash = (hash ^ at[i]) * UINT64_C(1099511628211);
  }
  return hash;
}
#define HASH_START UINT64_C(14695981039346656037)

/* Numbers in [0, 1) that are the same everywhere (xorshift64*). */
static uint64_t random_state = 88172645463325252u;

static UNUSED double random_unit(void) {
  random_state ^= random_state >> 12;
  random_state ^= random_state << 25;
  random_state ^= random_state >> 27;
  return (double)((random_state * UINT64_C(2685821657736338717)) >> 11) * (1.0 / 9007199254740992.0);
}

static UNUSED double random_between(double lo, double hi) {
  return lo + (hi - lo) * random_unit();
}

/* Bodies. */

typedef struct soup {
  size_t vertices, triangles;
  double *xyz;
  uint32_t *indices;
  int32_t *tags;
} soup;

static UNUSED soup soup_new(size_t vertices, size_t triangles) {
  soup s;
  size_t t;
  s.vertices = vertices;
  s.triangles = triangles;
  s.xyz = (double *)need(malloc(3 * vertices * sizeof *s.xyz));
  s.indices = (uint32_t *)need(malloc(3 * triangles * sizeof *s.indices));
  s.tags = (int32_t *)need(malloc(triangles * sizeof *s.tags));
  for (t = 0; t < triangles; t++) {
    s.tags[t] = (int32_t)(t % 7);
  }
  return s;
}

static UNUSED void soup_free(soup *s) {
  free(s->xyz);
  free(s->indices);
  free(s->tags);
}

/* The sides of a box with the vertices (lo or hi, lo or hi, lo or hi), x first; z lo, z hi, y lo, y hi, x lo, x hi. */
static UNUSED const uint32_t cube_sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

static UNUSED void cube_corners(double lo, double hi, double xyz[24]) {
  int i, c;
  for (i = 0; i < 8; i++) {
    for (c = 0; c < 3; c++) {
      xyz[3 * i + c] = (i >> c) & 1 ? hi : lo;
    }
  }
}

/* The box [lo, hi]^3, normals outward. */
static UNUSED soup soup_cube(double lo, double hi) {
  soup s = soup_new(8, 12);
  int f;
  cube_corners(lo, hi, s.xyz);
  for (f = 0; f < 6; f++) {
    const uint32_t *q = cube_sides[f];
    uint32_t *t = s.indices + 6 * f;
    t[0] = q[0], t[1] = q[1], t[2] = q[2];
    t[3] = q[0], t[4] = q[2], t[5] = q[3];
  }
  return s;
}

/* A sphere cut into n slices and n/2 stacks, normals outward. */
static UNUSED soup soup_sphere(double radius, size_t n) {
  const double pi = 3.14159265358979323846;
  size_t stacks = n / 2, i, k, t = 0;
  soup s = soup_new(n * (stacks - 1) + 2, 2 * n * (stacks - 1));
  uint32_t south = (uint32_t)(s.vertices - 2), north = south + 1;
  for (k = 1; k < stacks; k++) {
    for (i = 0; i < n; i++) {
      double polar = pi * (double)k / (double)stacks, around = 2 * pi * (double)i / (double)n;
      double *p = s.xyz + 3 * ((k - 1) * n + i);
      p[0] = radius * sin(polar) * cos(around);
      p[1] = radius * sin(polar) * sin(around);
      p[2] = -radius * cos(polar);
    }
  }
  s.xyz[3 * south] = s.xyz[3 * south + 1] = s.xyz[3 * north] = s.xyz[3 * north + 1] = 0.0;
  s.xyz[3 * south + 2] = -radius;
  s.xyz[3 * north + 2] = radius;
  for (i = 0; i < n; i++) {
    uint32_t a = (uint32_t)i, b = (uint32_t)((i + 1) % n), last = (uint32_t)((stacks - 2) * n);
    uint32_t *p = s.indices + 3 * t;
    p[0] = south, p[1] = b, p[2] = a;
    p[3] = north, p[4] = last + a, p[5] = last + b;
    t += 2;
    for (k = 0; k + 2 < stacks; k++, t += 2) {
      uint32_t row = (uint32_t)(k * n), up = row + (uint32_t)n;
      p = s.indices + 3 * t;
      p[0] = row + a, p[1] = row + b, p[2] = up + b;
      p[3] = row + a, p[4] = up + b, p[5] = up + a;
    }
  }
  return s;
}

/* The box of six squares. */
static UNUSED emb_mesh *cube_of_squares(double lo, double hi, const int32_t *tags, const emb_mesh_options *options) {
  static const size_t offsets[7] = {0, 4, 8, 12, 16, 20, 24};
  double xyz[24];
  emb_mesh *mesh = NULL;
  cube_corners(lo, hi, xyz);
  CHECK_OK(emb_mesh_from_polygons(8, xyz, 6, offsets, cube_sides[0], tags, options, &mesh));
  return mesh;
}

static UNUSED emb_mesh *soup_mesh(const soup *s) {
  emb_mesh *mesh = NULL;
  CHECK_OK(emb_mesh_from_triangles(s->vertices, s->xyz, s->triangles, s->indices, s->tags, NULL, &mesh));
  return mesh;
}

static UNUSED emb_geom *soup_geometry(const soup *s) {
  emb_mesh *mesh = soup_mesh(s);
  emb_geom *g = NULL;
  CHECK_OK(emb_geom_from_mesh(mesh, NULL, NULL, &g));
  emb_mesh_free(mesh);
  return g;
}

/* A function for emb_geom_callback: the sphere of radius 1 about the origin; `user` counts the calls, or is NULL. */
static UNUSED double sphere_function(void *user, double x, double y, double z) {
  if (user != NULL) {
    ++*(int *)user;
  }
  return sqrt(x * x + y * y + z * z) - 1.0;
}

/* A drop function: counts. */
static UNUSED void count_drop(void *user) {
  ++*(int *)user;
}

#endif
