/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Diagnoses of meshes through C: every getter, its two calls and its misuse; the same with any pool. The last line is a
 * hash of all results, to be compared between libraries and instruction sets. */
#include "check.h"

#include <stddef.h>

#define MOST 4096

static uint64_t hash = HASH_START;

/* Two spheres through each other, one of them inside out and with a hole, three faces at one edge, a copy, a needle, a
 * face without area and one that welding collapses. */
static emb_mesh *dirty(void) {
  soup a = soup_sphere(1.0, 24), b = soup_sphere(0.9, 20), s;
  size_t i, v, t;
  emb_mesh *mesh;
  s = soup_new(a.vertices + b.vertices + 9, a.triangles + b.triangles - 1 + 7);
  for (i = 0; i < 3 * a.vertices; i++) {
    s.xyz[i] = a.xyz[i];
  }
  for (i = 0; i < 3 * b.vertices; i++) {
    s.xyz[3 * a.vertices + i] = b.xyz[i] + (i % 3 == 0 ? 0.8 : 0.01);
  }
  for (i = 0; i < 3 * a.triangles; i++) {
    s.indices[i] = a.indices[i];
  }
  for (t = 0; t + 1 < b.triangles; t++) {
    for (i = 0; i < 3; i++) {
      s.indices[3 * (a.triangles + t) + i] = (uint32_t)(b.indices[3 * t + 2 - i] + a.vertices);
    }
  }
  t = a.triangles + b.triangles - 1;
  v = a.vertices + b.vertices;
  {
    static const double xyz[27] = {9, 0, 0, 9, 0, 1, 10, 0, 0, 8, 0, 0, 9, 1, 0, 20, 0, 0, 24, 0, 0, 21, 0.001, 0, 22, 0, 0};
    static const uint32_t faces[18] = {0, 1, 2, 0, 1, 3, 0, 1, 4, 4, 1, 0, 5, 6, 7, 5, 6, 8};
    for (i = 0; i < 27; i++) {
      s.xyz[3 * v + i] = xyz[i];
    }
    for (i = 0; i < 18; i++) {
      s.indices[3 * t + i] = (uint32_t)(v + faces[i]);
    }
    s.indices[3 * t + 18] = s.indices[3 * t + 19] = 0;
    s.indices[3 * t + 20] = 1;
  }
  mesh = soup_mesh(&s);
  soup_free(&a);
  soup_free(&b);
  soup_free(&s);
  return mesh;
}

/* Both calls of a getter; the items are hashed. `size` is in bytes. */
#define LIST(count, size, call, array) \
  do {                                               \
    size_t n = 99, capacity = 0;                     \
    CHECK_OK(call);                                  \
    CHECK(n == (count) && n <= MOST);                \
    capacity = n;                                    \
    CHECK_OK(call);                                  \
    CHECK(n == (count));                             \
    hash = hash_bytes(hash, array, n * (size));      \
    if (n > 1) {                                     \
      capacity = n - 1;                              \
      CHECK_STATUS(call, EMB_ERROR_INVALID_ARGUMENT); \
      CHECK(strstr(emb_last_error(), "capacity") != NULL); \
    }                                                \
  } while (0)

static void every_list_is_had_by_two_calls(const emb_mesh *mesh, const emb_diagnosis *d) {
  static uint32_t vertices[2 * MOST], fans[MOST];
  static int64_t faces[2 * MOST], originals[MOST];
  static uint64_t counts[MOST];
  static int32_t ways[MOST];
  static double ratios[MOST];
  emb_diagnosis_summary summary = {sizeof summary, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  emb_mesh_report report, of_mesh;
  size_t k, face_count = emb_mesh_face_count(mesh);
  report.struct_size = of_mesh.struct_size = sizeof report;
  CHECK_OK(emb_diagnosis_report(d, &report));
  CHECK_OK(emb_mesh_report_get(mesh, &of_mesh));
  CHECK(of_mesh.self_intersections == UINT64_MAX && report.self_intersections > 20);
  of_mesh.self_intersections = report.self_intersections;
  CHECK(memcmp(&report, &of_mesh, sizeof report) == 0);
  CHECK_OK(emb_diagnosis_summary_get(d, &summary));
  hash = hash_bytes(hash, &summary, offsetof(emb_diagnosis_summary, intersections_complete) + sizeof(int32_t));
  CHECK(summary.components == 4 && summary.components == (uint64_t)report.components);
  CHECK(summary.shrunk_faces == 1 && summary.flat_faces == 1 && report.degenerate_faces == 2 && summary.slivers == 1);
  CHECK(summary.intersections_complete == 1 && summary.listed_intersections == report.self_intersections);
  CHECK(summary.unbalanced_edges > 0 && summary.nonmanifold_vertices >= 2);
  LIST(report.nonmanifold_edges, 2 * sizeof *vertices, emb_diagnosis_nonmanifold_edges(d, capacity, vertices, counts, &n),
       vertices);
  CHECK(report.nonmanifold_edges > 0);
  for (k = 0; k < report.nonmanifold_edges; k++) {
    LIST(counts[k], sizeof *faces, emb_diagnosis_nonmanifold_edge_faces(d, k, capacity, faces, &n), faces);
    CHECK(counts[k] > 2);
  }
  LIST(report.inconsistent_edges, 2 * sizeof *faces,
       emb_diagnosis_inconsistent_edges(d, capacity, vertices, faces, &n), faces);
  LIST(summary.nonmanifold_vertices, sizeof *fans,
       emb_diagnosis_nonmanifold_vertices(d, capacity, vertices, fans, &n), fans);
  LIST(1, sizeof *faces, emb_diagnosis_shrunk_faces(d, capacity, faces, &n), faces);
  CHECK(faces[0] == (int64_t)face_count - 1);
  LIST(1, sizeof *faces, emb_diagnosis_flat_faces(d, capacity, faces, &n), faces);
  LIST(1, sizeof *faces, emb_diagnosis_duplicates(d, capacity, faces, originals, ways, &n), originals);
  CHECK(originals[0] == faces[0] - 1 && ways[0] == 0);
  LIST(1, sizeof *ratios, emb_diagnosis_slivers(d, capacity, faces, ratios, &n), ratios);
  CHECK(fabs(ratios[0] - 0.00025) < 1e-9);
  LIST(0, sizeof *ratios, emb_diagnosis_warped_faces(d, capacity, faces, ratios, &n), ratios);
  LIST(0, sizeof *ratios, emb_diagnosis_off_plane_faces(d, capacity, faces, ratios, &n), ratios);
  LIST(report.self_intersections, 2 * sizeof *faces, emb_diagnosis_intersections(d, capacity, faces, &n), faces);
  for (k = 0; k < report.self_intersections; k++) {
    CHECK(faces[2 * k] < faces[2 * k + 1] && faces[2 * k] >= 0);
  }
  LIST(face_count, sizeof *fans, emb_diagnosis_face_components(d, capacity, fans, &n), fans);
  CHECK(fans[0] == 0 && fans[face_count - 1] == EMB_NO_INDEX);
  for (k = 0; k < summary.components; k++) {
    emb_mesh_component c;
    memset(&c, 0, sizeof c);
    c.struct_size = sizeof c;
    CHECK_OK(emb_diagnosis_component(d, k, &c));
    CHECK(c.closed == (c.boundary_edges == 0) && fans[c.lowest_face] == k);
    CHECK(c.lo[0] <= c.hi[0] && c.area >= 0);
    /* without what lies between the members */
    hash = hash_bytes(hash, &c, offsetof(emb_mesh_component, inside_out) + sizeof c.inside_out);
    hash = hash_bytes(hash, &c.volume, sizeof c - offsetof(emb_mesh_component, volume));
  }
  for (k = 0; k < summary.boundary_loops; k++) {
    emb_mesh_loop l;
    memset(&l, 0, sizeof l);
    l.struct_size = sizeof l;
    CHECK_OK(emb_diagnosis_loop(d, k, &l));
    LIST(l.edges + (l.closed == 0), sizeof *vertices, emb_diagnosis_loop_vertices(d, k, capacity, vertices, &n), vertices);
    CHECK(l.length >= l.diagonal && l.component < summary.components);
    hash = hash_bytes(hash, &l, sizeof l);
  }
}

static void the_text_ends_with_what_to_do(const emb_diagnosis *d) {
  static char text[1 << 14];
  size_t size = 0, again = 0;
  CHECK_OK(emb_diagnosis_text(d, 0, NULL, &size));
  CHECK(size > 100 && size < sizeof text);
  CHECK_OK(emb_diagnosis_text(d, size, text, &again));
  CHECK(again == size && strlen(text) == size - 1 && text[size - 2] == '\n');
  CHECK(strstr(text, "\nto do: ") != NULL && strstr(text, "boundary loops:\n") != NULL);
  CHECK_STATUS(emb_diagnosis_text(d, size - 1, text, &again), EMB_ERROR_INVALID_ARGUMENT);
  hash = hash_bytes(hash, text, size);
}

static void misuse_is_answered(const emb_mesh *mesh, const emb_diagnosis *d) {
  emb_diagnosis_options options, wrong;
  emb_diagnosis *out = NULL;
  emb_mesh_component component;
  emb_mesh_loop boundary;
  size_t n = 77;
  int64_t faces[4];
  CHECK_OK(emb_diagnosis_options_init(&options, sizeof options));
  CHECK(options.sliver_ratio == 1e-3 && options.off_plane_ratio == 0.0 && options.intersection_limit == 1000000);
  CHECK_STATUS(emb_diagnosis_options_init(NULL, sizeof options), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_options_init(&options, 3), EMB_ERROR_INVALID_ARGUMENT);
  wrong = options, wrong.sliver_ratio = -1.0;
  CHECK_STATUS(emb_mesh_diagnose(mesh, &wrong, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.sliver_ratio: -1") != NULL);
  wrong = options, wrong.off_plane_ratio = NAN;
  CHECK_STATUS(emb_mesh_diagnose(mesh, &wrong, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.off_plane_ratio: NaN") != NULL);
  wrong = options, wrong.struct_size = 5000;
  CHECK_STATUS(emb_mesh_diagnose(mesh, &wrong, NULL, &out), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_mesh_diagnose(NULL, NULL, NULL, &out), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_mesh_diagnose(mesh, NULL, NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK(strstr(emb_last_error(), "out_diagnosis") != NULL && out == NULL);
  CHECK_STATUS(emb_diagnosis_report(d, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_summary_get(NULL, NULL), EMB_ERROR_NULL_ARGUMENT);
  component.struct_size = sizeof component, boundary.struct_size = sizeof boundary;
  CHECK_STATUS(emb_diagnosis_component(d, 4, &component), EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "index: 4") != NULL);
  CHECK_STATUS(emb_diagnosis_component(d, 0, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_loop(d, SIZE_MAX, &boundary), EMB_ERROR_INVALID_ARGUMENT);
  boundary.struct_size = 8;
  CHECK_STATUS(emb_diagnosis_loop(d, 0, &boundary), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_loop_vertices(d, 99, 0, NULL, &n), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_nonmanifold_edge_faces(d, 99, 0, NULL, &n), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_shrunk_faces(d, 1, NULL, &n), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_shrunk_faces(d, 0, faces, NULL), EMB_ERROR_NULL_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_shrunk_faces(d, 1, (int64_t *)(void *)((char *)faces + 1), &n), EMB_ERROR_INVALID_ARGUMENT);
  CHECK_STATUS(emb_diagnosis_text(NULL, 0, NULL, &n), EMB_ERROR_NULL_ARGUMENT);
  CHECK(n == 77);
  /* side by side, each array may be left out */
  CHECK_OK(emb_diagnosis_duplicates(d, 1, NULL, NULL, NULL, &n));
  CHECK(n == 1);
  emb_diagnosis_free(NULL);
  CHECK(emb_diagnosis_clone(NULL) == NULL);
}

static int32_t stop_at_once(void *user, double fraction) {
  (void)fraction;
  ++*(int *)user;
  return 1;
}

static void runs_and_limits(const emb_mesh *mesh, const emb_diagnosis *d) {
  emb_run run = {sizeof run, NULL, NULL, NULL};
  emb_pool *pool = NULL;
  emb_diagnosis *other = NULL, *copy;
  emb_diagnosis_options options;
  emb_mesh_report report;
  static char first[1 << 14], second[1 << 14];
  size_t size, n = 0;
  int calls = 0;
  report.struct_size = sizeof report;
  CHECK_OK(emb_pool_new(3, &pool));
  run.pool = pool;
  CHECK_OK(emb_mesh_diagnose(mesh, NULL, &run, &other));
  CHECK_OK(emb_diagnosis_text(d, sizeof first, first, &size));
  CHECK_OK(emb_diagnosis_text(other, sizeof second, second, &size));
  CHECK(strcmp(first, second) == 0);
  copy = emb_diagnosis_clone(other);
  emb_diagnosis_free(other);
  CHECK_OK(emb_diagnosis_report(copy, &report));
  emb_diagnosis_free(copy);
  CHECK_OK(emb_diagnosis_options_init(&options, sizeof options));
  options.intersection_limit = 3;
  CHECK_OK(emb_mesh_diagnose(mesh, &options, &run, &other));
  CHECK_OK(emb_diagnosis_intersections(other, 0, NULL, &n));
  CHECK_OK(emb_diagnosis_report(other, &report));
  CHECK(n == 3 && report.self_intersections > 3);
  emb_diagnosis_free(other);
  options.intersection_limit = 0;
  CHECK_OK(emb_mesh_diagnose(mesh, &options, NULL, &other));
  CHECK_OK(emb_diagnosis_report(other, &report));
  CHECK(report.self_intersections == UINT64_MAX);
  emb_diagnosis_free(other);
  other = NULL;
  run.progress = stop_at_once, run.user = &calls;
  CHECK_STATUS(emb_mesh_diagnose(mesh, NULL, &run, &other), EMB_ERROR_CANCELLED);
  CHECK(calls == 1 && other == NULL);
  emb_pool_free(pool);
}

int main(void) {
  emb_mesh *mesh = dirty();
  emb_diagnosis *d = NULL;
  CHECK_OK(emb_mesh_diagnose(mesh, NULL, NULL, &d));
  every_list_is_had_by_two_calls(mesh, d);
  the_text_ends_with_what_to_do(d);
  misuse_is_answered(mesh, d);
  runs_and_limits(mesh, d);
  emb_mesh_free(mesh);
  /* the diagnosis does not need the mesh */
  the_text_ends_with_what_to_do(d);
  emb_diagnosis_free(d);
  printf("hash %016llx\n", (unsigned long long)hash);
  return checks_done("diagnosis");
}
