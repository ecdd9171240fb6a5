/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Repair and points in polygons: what comes out, what is refused, and that a refusal writes nothing. */
#include "check.h"

#include <math.h>
#include <string.h>

/* A unit cube of twelve triangles, of which the first is given twice, the third turned over and the last missing. */
static emb_mesh *broken(void) {
  static const double xyz[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  static const uint32_t indices[36] = {0, 2, 3, 0, 3, 1, 4, 7, 5, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                       0, 4, 6, 0, 6, 2, 1, 3, 7, 0, 2, 3};
  emb_mesh_options options;
  emb_mesh *mesh = NULL;
  CHECK(emb_mesh_options_init(&options, sizeof options) == EMB_OK);
  options.orient = EMB_ORIENT_KEEP;
  CHECK(emb_mesh_from_triangles(8, xyz, 12, indices, NULL, &options, &mesh) == EMB_OK);
  return mesh;
}

static void repairs(void) {
  emb_mesh *mesh = broken(), *whole = NULL, *same = NULL;
  emb_repair_options options;
  emb_repair_result result;
  emb_mesh_report report;
  int32_t tag = 0;
  memset(&result, 0, sizeof result);
  memset(&report, 0, sizeof report);
  result.struct_size = sizeof result;
  report.struct_size = sizeof report;
  CHECK(emb_repair_options_init(&options, sizeof options) == EMB_OK);
  options.hole_edges = 2;
  CHECK(emb_mesh_repair(mesh, &options, NULL, &result, &whole) == EMB_OK);
  CHECK(result.holes_left == 1 && result.holes_filled == 0 && result.duplicate_faces == 1);
  emb_mesh_free(whole);
  CHECK(emb_mesh_repair(mesh, NULL, NULL, &result, &whole) == EMB_OK);
  CHECK(result.duplicate_faces == 1 && result.faces_turned == 1 && result.holes_filled == 1 && result.faces_added == 1);
  CHECK(result.vertices_split == 0 && result.degenerate_faces == 0 && result.holes_left == 0);
  CHECK(emb_mesh_report_get(whole, &report) == EMB_OK);
  CHECK(report.closed == 1 && report.consistent == 1 && report.volume == 1.0 && report.faces == 12);
  CHECK(emb_mesh_face_count(whole) == 13); /* numbers: eleven are kept, one is gone, one is new */
  CHECK(emb_mesh_face_corner_count(whole, 11) == 0 && emb_mesh_face_corner_count(whole, 12) == 3);

  options.flags = 0;
  options.hole_edges = 1000;
  CHECK(emb_mesh_repair(mesh, &options, NULL, &result, &same) == EMB_OK);
  CHECK(result.duplicate_faces == 0 && result.faces_turned == 0 && result.holes_filled == 0);
  CHECK(emb_mesh_report_get(same, &report) == EMB_OK && report.duplicate_faces == 1 && report.inconsistent_edges > 0);
  emb_mesh_free(same);
  emb_mesh_free(whole);

  options.flags = EMB_REPAIR_ALL;
  options.fill_tag_rule = EMB_FILL_TAG_GIVEN;
  options.fill_tag = 42;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &whole) == EMB_OK);
  CHECK(emb_mesh_face_tags(whole, 12, 1, &tag) == EMB_OK && tag == 42);
  emb_mesh_free(whole);
  emb_mesh_free(mesh);
}

static void refusals(void) {
  emb_mesh *mesh = broken(), *out = NULL;
  emb_repair_options options;
  emb_repair_result result;
  memset(&result, 0, sizeof result);
  CHECK(emb_repair_options_init(NULL, sizeof options) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(emb_repair_options_init(&options, 3) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(emb_repair_options_init(&options, sizeof options) == EMB_OK);
  CHECK(emb_mesh_repair(NULL, NULL, NULL, NULL, &out) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(emb_mesh_repair(mesh, NULL, NULL, NULL, NULL) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "out_mesh: NULL") == 0);
  CHECK(emb_mesh_repair(mesh, NULL, NULL, &result, &out) == EMB_ERROR_INVALID_ARGUMENT); /* no struct_size */
  options.flags = 64;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &out) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.flags: 64") != NULL);
  options.flags = EMB_REPAIR_ALL;
  options.hole_length = -1.0;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &out) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.hole_length: -1") != NULL);
  options.hole_length = 1.0;
  options.hole_edges = 2049;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &out) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.hole_edges: 2049") != NULL);
  options.hole_edges = 1000;
  options.weld_tolerance = NAN;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &out) == EMB_ERROR_INVALID_ARGUMENT);
  options.weld_tolerance = 0.0;
  options.fill_tag_rule = 7;
  CHECK(emb_mesh_repair(mesh, &options, NULL, NULL, &out) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strstr(emb_last_error(), "options.fill_tag_rule: 7") != NULL);
  CHECK(out == NULL);
  emb_mesh_free(mesh);
}

static void polygons(void) {
  static const double square[8] = {0, 0, 2, 0, 2, 2, 0, 2}, in[2] = {0.5, 1.5}, off[2] = {2.5, 1.0}, bad[2] = {0.5, NAN};
  static const double above[3] = {0.25, 0.25, 9.0};
  emb_mesh *mesh = broken();
  int32_t method, inside = 7;
  for (method = EMB_POLYGON_CROSSING; method <= EMB_POLYGON_ANGLE; ++method) {
    CHECK(emb_polygon_contains(4, square, in, method, &inside) == EMB_OK && inside == 1);
    CHECK(emb_polygon_contains(4, square, off, method, &inside) == EMB_OK && inside == 0);
    CHECK(emb_polygon_contains(0, NULL, in, method, &inside) == EMB_OK && inside == 0);
    CHECK(emb_mesh_face_contains(mesh, 0, above, method, &inside) == EMB_OK);
    CHECK(emb_mesh_face_contains(mesh, 0, above, method, NULL) == EMB_ERROR_NULL_ARGUMENT);
  }
  inside = 7;
  CHECK(emb_polygon_contains(4, square, in, 3, &inside) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "method: 3 is not an EMB_POLYGON_*") == 0);
  CHECK(emb_polygon_contains(4, NULL, in, 0, &inside) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(emb_polygon_contains(4, square, NULL, 0, &inside) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(emb_polygon_contains(4, square, bad, 0, &inside) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(emb_polygon_contains((size_t)1 << 62, square, in, 0, &inside) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(emb_mesh_face_contains(mesh, 99, above, 0, &inside) == EMB_ERROR_INVALID_ARGUMENT);
  CHECK(strcmp(emb_last_error(), "face: the mesh as it stands has no face 99") == 0);
  CHECK(emb_mesh_face_contains(NULL, 0, above, 0, &inside) == EMB_ERROR_NULL_ARGUMENT);
  CHECK(inside == 7);
  emb_mesh_free(mesh);
}

int main(void) {
  repairs();
  refusals();
  polygons();
  return checks_done("repair");
}
