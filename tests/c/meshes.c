/* SPDX-License-Identifier: MIT OR Apache-2.0
 * What meshes tell of themselves: half-edges walked round faces and vertices, measures and distances of single faces,
 * edges and vertices, triangles, points in faces and polygons; also where edges are open, faces are gone and nothing is
 * welded. The last line is a hash of all numbers, the same with every library and instruction set. */
#include "check.h"

static uint64_t hash = HASH_START;

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int near(double a, double b) {
  return fabs(a - b) <= 1e-14 * (1.0 + fabs(b));
}

static int near_vector(const double a[3], double x, double y, double z) {
  return near(a[0], x) && near(a[1], y) && near(a[2], z);
}

/* The half-edge from one vertex to another. */
static uint32_t half_edge_between(const emb_mesh *mesh, uint32_t from, uint32_t to) {
  size_t k;
  for (k = 0; k < emb_mesh_vertex_half_edge_count(mesh, from); k++) {
    uint32_t h = emb_mesh_vertex_half_edge(mesh, from, k);
    if (emb_mesh_half_edge_target(mesh, h) == to) {
      return h;
    }
  }
  return EMB_NO_INDEX;
}

static void a_cube_is_walked_round_its_faces(const emb_mesh *cube) {
  uint64_t f;
  int c;
  CHECK(emb_mesh_vertex_count(cube) == 8 && emb_mesh_face_count(cube) == 6);
  CHECK(emb_mesh_triangle_count(cube) == 12 && emb_mesh_half_edge_count(cube) == 24);
  for (f = 0; f < 6; f++) {
    uint32_t first = emb_mesh_face_half_edge(cube, f), h = first;
    CHECK(first == 4 * f && emb_mesh_face_corner_count(cube, f) == 4);
    for (c = 0; c < 4; c++) {
      uint32_t next = emb_mesh_half_edge_next(cube, h), twin = emb_mesh_half_edge_twin(cube, h);
      CHECK(emb_mesh_half_edge_origin(cube, h) == cube_sides[f][c]);
      CHECK(emb_mesh_half_edge_target(cube, h) == cube_sides[f][(c + 1) % 4]);
      CHECK(emb_mesh_half_edge_previous(cube, next) == h && emb_mesh_half_edge_face(cube, h) == (int64_t)f);
      CHECK(emb_mesh_half_edge_twin(cube, twin) == h && emb_mesh_half_edge_face(cube, twin) != (int64_t)f);
      CHECK(emb_mesh_half_edge_origin(cube, twin) == emb_mesh_half_edge_target(cube, h));
      CHECK(emb_mesh_half_edge_target(cube, twin) == emb_mesh_half_edge_origin(cube, h));
      h = next;
    }
    CHECK(h == first);
  }
}

/* Counter-clockwise seen from outside: from one edge to the next turns about the outward diagonal. */
static void a_cube_is_walked_round_its_vertices(const emb_mesh *cube, const double *xyz) {
  uint32_t v;
  for (v = 0; v < 8; v++) {
    const double *p = xyz + 3 * v;
    uint32_t first = emb_mesh_vertex_half_edge(cube, v, 0), h = first, seen[3] = {0, 0, 0};
    int k, j;
    CHECK(emb_mesh_vertex_half_edge_count(cube, v) == 3);
    for (k = 0; k < 3; k++) {
      uint32_t next = emb_mesh_half_edge_around(cube, h), listed = emb_mesh_vertex_half_edge(cube, v, (size_t)k);
      const double *a = xyz + 3 * emb_mesh_half_edge_target(cube, h);
      const double *b = xyz + 3 * emb_mesh_half_edge_target(cube, next);
      double u[3], w[3], turn[3], out[3];
      for (j = 0; j < 3; j++) {
        u[j] = a[j] - p[j], w[j] = b[j] - p[j], out[j] = p[j] - 0.5;
      }
      turn[0] = u[1] * w[2] - u[2] * w[1], turn[1] = u[2] * w[0] - u[0] * w[2], turn[2] = u[0] * w[1] - u[1] * w[0];
      CHECK(dot(turn, out) > 0.0);
      CHECK(emb_mesh_half_edge_origin(cube, h) == v && emb_mesh_half_edge_origin(cube, listed) == v);
      CHECK(k == 0 || listed > emb_mesh_vertex_half_edge(cube, v, (size_t)k - 1));
      for (j = 0; j < 3; j++) {
        seen[j] += emb_mesh_vertex_half_edge(cube, v, (size_t)j) == h;
      }
      h = next;
    }
    CHECK(h == first && seen[0] == 1 && seen[1] == 1 && seen[2] == 1);
  }
}

/* Any portion of the arrays is what the getters say; triangles are those of the faces, outward, of the same volume. */
static void arrays_hold_what_the_getters_say(const emb_mesh *cube, const double *xyz) {
  double positions[24], portion[9] = {0}, six_volumes = 0.0;
  uint32_t origin[24], twin[24], corners[36], h, t;
  int64_t face[24], of[12];
  CHECK_OK(emb_mesh_vertices(cube, 0, 8, positions));
  CHECK_OK(emb_mesh_vertices(cube, 5, 2, portion));
  CHECK(same_bits(positions, xyz, 24) && same_bits(portion, xyz + 15, 6) && portion[6] == 0.0);
  CHECK_OK(emb_mesh_half_edges(cube, 0, 24, origin, twin, face));
  for (h = 0; h < 24; h++) {
    CHECK(origin[h] == emb_mesh_half_edge_origin(cube, h) && twin[h] == emb_mesh_half_edge_twin(cube, h));
    CHECK(face[h] == emb_mesh_half_edge_face(cube, h));
  }
  CHECK_OK(emb_mesh_half_edges(cube, 23, 1, NULL, twin, NULL));
  CHECK(twin[0] == emb_mesh_half_edge_twin(cube, 23) && twin[1] == emb_mesh_half_edge_twin(cube, 1));
  CHECK_OK(emb_mesh_triangles(cube, 0, 12, corners, of));
  for (t = 0; t < 12; t++) {
    const double *a = xyz + 3 * corners[3 * t], *b = xyz + 3 * corners[3 * t + 1], *c = xyz + 3 * corners[3 * t + 2];
    six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
    CHECK(of[t] == (int64_t)(t / 2));
  }
  CHECK(six_volumes == 6.0);
  CHECK_OK(emb_mesh_triangles(cube, 7, 1, corners, of));
  CHECK(of[0] == 3 && of[1] == 0);
  hash = hash_bytes(hash, corners, sizeof corners);
}

static emb_mesh_measure measured(const emb_mesh *mesh, int32_t element, uint64_t index) {
  emb_mesh_measure measure;
  memset(&measure, 0xA5, sizeof measure);
  measure.struct_size = sizeof measure;
  CHECK_OK(emb_mesh_measure_get(mesh, element, index, &measure));
  CHECK(measure.struct_size == sizeof measure);
  hash = hash_bytes(hash, &measure, sizeof measure);
  return measure;
}

static double distance_to(const emb_mesh *mesh, int32_t element, uint64_t index, double x, double y, double z,
                          double foot[3]) {
  double distance = NAN, point[3], alone = NAN;
  point[0] = x, point[1] = y, point[2] = z;
  CHECK_OK(emb_mesh_distance(mesh, element, index, point, &distance, foot));
  CHECK_OK(emb_mesh_distance(mesh, element, index, point, &alone, NULL));
  CHECK(same_double(distance, alone));
  hash = hash_bytes(hash, &distance, sizeof distance);
  return distance;
}

static void faces_edges_and_vertices_are_measured(const emb_mesh *cube) {
  const double half = sqrt(0.5), third = 1.0 / sqrt(3.0);
  const uint32_t edge = half_edge_between(cube, 0, 4);
  emb_mesh_measure m = measured(cube, EMB_ELEMENT_FACE, 1);
  double foot[3];
  CHECK(near_vector(m.normal, 0, 0, 1) && near_vector(m.centroid, 0.5, 0.5, 1) && near(m.size, 1.0));
  m = measured(cube, EMB_ELEMENT_FACE, 4);
  CHECK(near_vector(m.normal, -1, 0, 0) && near_vector(m.centroid, 0, 0.5, 0.5));
  m = measured(cube, EMB_ELEMENT_EDGE, edge);
  CHECK(near_vector(m.normal, -half, -half, 0) && near_vector(m.centroid, 0, 0, 0.5) && m.size == 1.0);
  m = measured(cube, EMB_ELEMENT_EDGE, emb_mesh_half_edge_twin(cube, edge));
  CHECK(near_vector(m.normal, -half, -half, 0) && near_vector(m.centroid, 0, 0, 0.5));
  m = measured(cube, EMB_ELEMENT_VERTEX, 6);
  CHECK(near_vector(m.normal, -third, third, third) && near_vector(m.centroid, 0, 1, 1) && m.size == 0.0);

  CHECK(distance_to(cube, EMB_ELEMENT_FACE, 1, 0.25, 0.5, 3, foot) == 2.0 && near_vector(foot, 0.25, 0.5, 1));
  CHECK(distance_to(cube, EMB_ELEMENT_FACE, 1, 0.25, 0.5, 0.25, foot) == -0.75 && near_vector(foot, 0.25, 0.5, 1));
  CHECK(distance_to(cube, EMB_ELEMENT_FACE, 1, 4, 0.5, 5, foot) == 5.0 && near_vector(foot, 1, 0.5, 1));
  CHECK(distance_to(cube, EMB_ELEMENT_EDGE, edge, -3, -4, 0.5, foot) == 5.0 && near_vector(foot, 0, 0, 0.5));
  CHECK(distance_to(cube, EMB_ELEMENT_EDGE, edge, 3, 4, -12, foot) == -13.0 && near_vector(foot, 0, 0, 0));
  CHECK(distance_to(cube, EMB_ELEMENT_VERTEX, 7, 3, 3, 2, foot) == 3.0 && near_vector(foot, 1, 1, 1));
  CHECK(distance_to(cube, EMB_ELEMENT_VERTEX, 7, -1, -1, 0, foot) == -3.0);
  CHECK(same_double(distance_to(cube, EMB_ELEMENT_VERTEX, 7, 1, 1, 1, foot), 0.0));
}

/* A cube without its top, and with a face between that welding leaves two corners. */
static void boundaries_and_faces_that_are_gone_have_no_neighbours(void) {
  static const size_t offsets[7] = {0, 4, 7, 11, 15, 19, 23};
  uint32_t indices[23], v;
  emb_mesh_options options;
  emb_mesh_measure measure = {sizeof measure, {0, 0, 0}, {0, 0, 0}, 0};
  emb_mesh *mesh = NULL;
  double xyz[24];
  int64_t of[2];
  size_t boundary = 0;
  cube_corners(0, 1, xyz);
  memcpy(indices, cube_sides[0], sizeof cube_sides[0]);
  indices[4] = indices[5] = 3, indices[6] = 1;
  memcpy(indices + 7, cube_sides[2], 16 * sizeof *indices);
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  options.orient = EMB_ORIENT_KEEP;
  CHECK_OK(emb_mesh_from_polygons(8, xyz, 6, offsets, indices, NULL, &options, &mesh));
  CHECK(emb_mesh_face_count(mesh) == 6 && emb_mesh_half_edge_count(mesh) == 20 && emb_mesh_triangle_count(mesh) == 10);
  CHECK(emb_mesh_face_corner_count(mesh, 1) == 0 && emb_mesh_face_half_edge(mesh, 1) == EMB_NO_INDEX);
  CHECK(emb_mesh_face_half_edge(mesh, 2) == 4 && emb_mesh_half_edge_face(mesh, 4) == 2);
  CHECK_OK(emb_mesh_triangles(mesh, 1, 2, NULL, of));
  CHECK(of[0] == 0 && of[1] == 2);
  CHECK_STATUS(emb_mesh_measure_get(mesh, EMB_ELEMENT_FACE, 1, &measure), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "index: the mesh as it stands has no face 1") == 0);
  for (v = 0; v < 20; v++) {
    boundary += emb_mesh_half_edge_twin(mesh, v) == EMB_NO_INDEX;
  }
  CHECK(boundary == 4);
  /* at the rim the fan ends, after as many half-edges as there are faces */
  for (v = 4; v < 8; v++) {
    size_t ends = 0, k;
    CHECK(emb_mesh_vertex_half_edge_count(mesh, v) == 2);
    for (k = 0; k < 2; k++) {
      uint32_t next = emb_mesh_half_edge_around(mesh, emb_mesh_vertex_half_edge(mesh, v, k));
      ends += next == EMB_NO_INDEX;
      CHECK(next == EMB_NO_INDEX || next == emb_mesh_vertex_half_edge(mesh, v, 1 - k));
    }
    CHECK(ends == 1);
  }
  emb_mesh_free(mesh);
}

/* Two triangles of three vertices of their own each: one sheet when welded, two when not. */
static void nothing_is_welded_where_the_tolerance_is_minus_one(void) {
  static const double xyz[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  static const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
  emb_mesh_report report = {0};
  emb_mesh_options options;
  emb_mesh *apart = NULL, *together = NULL, *again = NULL;
  CHECK_OK(emb_mesh_options_init(&options, sizeof options));
  options.weld_tolerance = -1.0;
  CHECK_OK(emb_mesh_from_triangles(6, xyz, 2, indices, NULL, &options, &apart));
  report.struct_size = sizeof report;
  CHECK_OK(emb_mesh_report_get(apart, &report));
  CHECK(report.vertices == 6 && report.components == 2 && report.boundary_edges == 6);
  CHECK(half_edge_between(apart, 1, 2) == 1 && emb_mesh_half_edge_twin(apart, 1) == EMB_NO_INDEX);
  CHECK_OK(emb_mesh_transform(apart, &options, &again));
  CHECK(emb_mesh_vertex_count(again) == 6);
  emb_mesh_free(again);
  again = NULL;
  CHECK_OK(emb_mesh_transform(apart, NULL, &again)); /* nor by the defaults: the mesh stands */
  CHECK(emb_mesh_vertex_count(again) == 6);
  options.weld_tolerance = 1e-12;
  CHECK_OK(emb_mesh_transform(apart, &options, &together));
  options.weld_tolerance = -1.0;
  CHECK_OK(emb_mesh_report_get(together, &report));
  CHECK(report.vertices == 4 && report.components == 1 && report.boundary_edges == 4);
  CHECK(emb_mesh_half_edge_twin(together, 1) == 5);
  emb_mesh_free(again);
  /* what was joined stays joined, though equal positions are not looked for */
  CHECK_OK(emb_mesh_transform(together, &options, &again));
  CHECK(emb_mesh_vertex_count(again) == 4);
  emb_mesh_free(apart);
  emb_mesh_free(together);
  emb_mesh_free(again);
}

static void points_in_polygons_are_refused_beyond_what_the_library_handles(const emb_mesh *cube) {
  static const double wrong[5] = {NAN, INFINITY, -INFINITY, 1.1e100, -1e300};
  static const char *const names[5] = {"NaN is not finite", "inf is not finite", "-inf is not finite",
                                       "1.1e100 is beyond 1e100", "-1e300 is beyond 1e100"};
  int32_t method, inside = 7;
  int k, c;
  for (method = EMB_POLYGON_CROSSING; method <= EMB_POLYGON_ANGLE; method++) {
    for (k = 0; k < 5; k++) {
      for (c = 0; c < 3; c++) {
        double square[8] = {0, 0, 1e100, 0, 1e100, 1e100, 0, 1e100}, at[3] = {0.5, 0.5, 0.5};
        char wanted[64];
        at[c] = wrong[k];
        snprintf(wanted, sizeof wanted, "point[%d]: %s", c, names[k]);
        CHECK(emb_mesh_face_contains(cube, 1, at, method, &inside) == EMB_ERROR_INVALID_ARGUMENT);
        CHECK(strcmp(emb_last_error(), wanted) == 0);
        if (c < 2) {
          CHECK(emb_polygon_contains(4, square, at, method, &inside) == EMB_ERROR_INVALID_ARGUMENT);
          CHECK(strcmp(emb_last_error(), wanted) == 0);
        }
        at[c] = 0.5;
        square[5 - c] = wrong[k];
        snprintf(wanted, sizeof wanted, "xy[%d]: %s", 5 - c, names[k]);
        CHECK(emb_polygon_contains(4, square, at, method, &inside) == EMB_ERROR_INVALID_ARGUMENT);
        CHECK(strcmp(emb_last_error(), wanted) == 0);
      }
    }
    CHECK(inside == 7);
    {
      /* the largest there may be, and far off the face */
      static const double square[8] = {-1e100, -1e100, 1e100, -1e100, 1e100, 1e100, -1e100, 1e100};
      static const double in[2] = {9e99, -1e100}, on[2] = {1e100, 0}, far[3] = {0.5, 0.25, -1e100};
      CHECK_OK(emb_polygon_contains(4, square, in, method, &inside));
      CHECK(inside == 1);
      CHECK_OK(emb_polygon_contains(4, square, on, method, &inside));
      CHECK(inside == 0);
      CHECK_OK(emb_mesh_face_contains(cube, 1, far, method, &inside));
      CHECK(inside == 1);
      inside = 7;
    }
  }
}

int main(void) {
  double xyz[24];
  emb_mesh *cube = cube_of_squares(0, 1, NULL, NULL);
  cube_corners(0, 1, xyz);
  a_cube_is_walked_round_its_faces(cube);
  a_cube_is_walked_round_its_vertices(cube, xyz);
  arrays_hold_what_the_getters_say(cube, xyz);
  faces_edges_and_vertices_are_measured(cube);
  boundaries_and_faces_that_are_gone_have_no_neighbours();
  nothing_is_welded_where_the_tolerance_is_minus_one();
  points_in_polygons_are_refused_beyond_what_the_library_handles(cube);
  emb_mesh_free(cube);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("meshes");
}
