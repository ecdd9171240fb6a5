/* SPDX-License-Identifier: MIT OR Apache-2.0
 * The layout of every struct as the C compiler sees it, one line a member: struct, member, offset, size. The
 * lines are compared with what the Rust compiler says; alone, the program checks what the header promises. */
#include "check.h"

#include <stddef.h>

#define STRUCT(type)                                 \
  CHECK(offsetof(type, struct_size) == 0);           \
  CHECK(sizeof(((type *)0)->struct_size) == sizeof(size_t)); \
  printf("%s %u\n", #type, (unsigned)sizeof(type))
#define MEMBER(type, member) \
  printf("%s.%s %u %u\n", #type, #member, (unsigned)offsetof(type, member), (unsigned)sizeof(((type *)0)->member))

static void runs_and_lattices(void) {
  STRUCT(emb_run);
  MEMBER(emb_run, struct_size);
  MEMBER(emb_run, pool);
  MEMBER(emb_run, progress);
  MEMBER(emb_run, user);
  STRUCT(emb_lattice);
  MEMBER(emb_lattice, struct_size);
  MEMBER(emb_lattice, n);
  MEMBER(emb_lattice, x);
  MEMBER(emb_lattice, y);
  MEMBER(emb_lattice, z);
  STRUCT(emb_array);
  MEMBER(emb_array, struct_size);
  MEMBER(emb_array, data);
  MEMBER(emb_array, type);
  MEMBER(emb_array, stride);
}

static void meshes(void) {
  STRUCT(emb_mesh_options);
  MEMBER(emb_mesh_options, struct_size);
  MEMBER(emb_mesh_options, scale);
  MEMBER(emb_mesh_options, rotation);
  MEMBER(emb_mesh_options, shift);
  MEMBER(emb_mesh_options, weld_tolerance);
  MEMBER(emb_mesh_options, orient);
  MEMBER(emb_mesh_options, format);
  MEMBER(emb_mesh_options, index_base);
  STRUCT(emb_mesh_report);
  MEMBER(emb_mesh_report, struct_size);
  MEMBER(emb_mesh_report, closed);
  MEMBER(emb_mesh_report, consistent);
  MEMBER(emb_mesh_report, inside_out);
  MEMBER(emb_mesh_report, components);
  MEMBER(emb_mesh_report, vertices);
  MEMBER(emb_mesh_report, faces);
  MEMBER(emb_mesh_report, triangles);
  MEMBER(emb_mesh_report, boundary_edges);
  MEMBER(emb_mesh_report, nonmanifold_edges);
  MEMBER(emb_mesh_report, inconsistent_edges);
  MEMBER(emb_mesh_report, degenerate_faces);
  MEMBER(emb_mesh_report, duplicate_faces);
  MEMBER(emb_mesh_report, self_intersections);
  MEMBER(emb_mesh_report, volume);
  MEMBER(emb_mesh_report, area);
  MEMBER(emb_mesh_report, lo);
  MEMBER(emb_mesh_report, hi);
  MEMBER(emb_mesh_report, warped_faces);
  STRUCT(emb_mesh_measure);
  MEMBER(emb_mesh_measure, struct_size);
  MEMBER(emb_mesh_measure, normal);
  MEMBER(emb_mesh_measure, centroid);
  MEMBER(emb_mesh_measure, size);
  STRUCT(emb_mesh_field);
  MEMBER(emb_mesh_field, struct_size);
  MEMBER(emb_mesh_field, components);
  MEMBER(emb_mesh_field, count);
}

static void repairs(void) {
  STRUCT(emb_repair_options);
  MEMBER(emb_repair_options, struct_size);
  MEMBER(emb_repair_options, flags);
  MEMBER(emb_repair_options, fill_tag_rule);
  MEMBER(emb_repair_options, fill_tag);
  MEMBER(emb_repair_options, weld_tolerance);
  MEMBER(emb_repair_options, hole_edges);
  MEMBER(emb_repair_options, hole_length);
  STRUCT(emb_repair_result);
  MEMBER(emb_repair_result, struct_size);
  MEMBER(emb_repair_result, vertices_welded);
  MEMBER(emb_repair_result, faces_collapsed);
  MEMBER(emb_repair_result, degenerate_faces);
  MEMBER(emb_repair_result, corners_added);
  MEMBER(emb_repair_result, duplicate_faces);
  MEMBER(emb_repair_result, vertices_split);
  MEMBER(emb_repair_result, faces_turned);
  MEMBER(emb_repair_result, components_turned);
  MEMBER(emb_repair_result, holes_filled);
  MEMBER(emb_repair_result, holes_left);
  MEMBER(emb_repair_result, faces_added);
}

static void diagnoses(void) {
  STRUCT(emb_diagnosis_options);
  MEMBER(emb_diagnosis_options, struct_size);
  MEMBER(emb_diagnosis_options, sliver_ratio);
  MEMBER(emb_diagnosis_options, off_plane_ratio);
  MEMBER(emb_diagnosis_options, intersection_limit);
  STRUCT(emb_diagnosis_summary);
  MEMBER(emb_diagnosis_summary, struct_size);
  MEMBER(emb_diagnosis_summary, nonmanifold_vertices);
  MEMBER(emb_diagnosis_summary, shrunk_faces);
  MEMBER(emb_diagnosis_summary, flat_faces);
  MEMBER(emb_diagnosis_summary, slivers);
  MEMBER(emb_diagnosis_summary, off_plane_faces);
  MEMBER(emb_diagnosis_summary, components);
  MEMBER(emb_diagnosis_summary, boundary_loops);
  MEMBER(emb_diagnosis_summary, open_chains);
  MEMBER(emb_diagnosis_summary, listed_intersections);
  MEMBER(emb_diagnosis_summary, turned_faces);
  MEMBER(emb_diagnosis_summary, unbalanced_edges);
  MEMBER(emb_diagnosis_summary, intersections_complete);
  STRUCT(emb_mesh_component);
  MEMBER(emb_mesh_component, struct_size);
  MEMBER(emb_mesh_component, lowest_face);
  MEMBER(emb_mesh_component, faces);
  MEMBER(emb_mesh_component, triangles);
  MEMBER(emb_mesh_component, boundary_edges);
  MEMBER(emb_mesh_component, nonmanifold_edges);
  MEMBER(emb_mesh_component, inconsistent_edges);
  MEMBER(emb_mesh_component, turned_faces);
  MEMBER(emb_mesh_component, closed);
  MEMBER(emb_mesh_component, consistent);
  MEMBER(emb_mesh_component, inside_out);
  MEMBER(emb_mesh_component, volume);
  MEMBER(emb_mesh_component, area);
  MEMBER(emb_mesh_component, lo);
  MEMBER(emb_mesh_component, hi);
  STRUCT(emb_mesh_loop);
  MEMBER(emb_mesh_loop, struct_size);
  MEMBER(emb_mesh_loop, edges);
  MEMBER(emb_mesh_loop, component);
  MEMBER(emb_mesh_loop, closed);
  MEMBER(emb_mesh_loop, length);
  MEMBER(emb_mesh_loop, diagonal);
  MEMBER(emb_mesh_loop, lo);
  MEMBER(emb_mesh_loop, hi);
}

static void geometries(void) {
  STRUCT(emb_sdf_options);
  MEMBER(emb_sdf_options, struct_size);
  MEMBER(emb_sdf_options, sign);
  MEMBER(emb_sdf_options, open);
  MEMBER(emb_sdf_options, axis);
  MEMBER(emb_sdf_options, accelerator);
  MEMBER(emb_sdf_options, open_lo);
  MEMBER(emb_sdf_options, open_hi);
  STRUCT(emb_callback_options);
  MEMBER(emb_callback_options, struct_size);
  MEMBER(emb_callback_options, lo);
  MEMBER(emb_callback_options, hi);
  MEMBER(emb_callback_options, lipschitz);
  MEMBER(emb_callback_options, gradient_step);
  MEMBER(emb_callback_options, kind);
  MEMBER(emb_callback_options, thread_safe);
  MEMBER(emb_callback_options, values);
  MEMBER(emb_callback_options, gradient);
  MEMBER(emb_callback_options, range);
  STRUCT(emb_expression_options);
  MEMBER(emb_expression_options, struct_size);
  MEMBER(emb_expression_options, lo);
  MEMBER(emb_expression_options, hi);
  MEMBER(emb_expression_options, lipschitz);
  STRUCT(emb_blend);
  MEMBER(emb_blend, struct_size);
  MEMBER(emb_blend, kind);
  MEMBER(emb_blend, thread_safe);
  MEMBER(emb_blend, width);
  MEMBER(emb_blend, blend);
  MEMBER(emb_blend, user);
  MEMBER(emb_blend, drop);
  MEMBER(emb_blend, support);
  MEMBER(emb_blend, depth);
  MEMBER(emb_blend, lipschitz);
  STRUCT(emb_geom_properties);
  MEMBER(emb_geom_properties, struct_size);
  MEMBER(emb_geom_properties, kind);
  MEMBER(emb_geom_properties, sign_method);
  MEMBER(emb_geom_properties, lipschitz);
  MEMBER(emb_geom_properties, primitives);
  MEMBER(emb_geom_properties, bytes);
}

static void outputs(void) {
  STRUCT(emb_closest_out);
  MEMBER(emb_closest_out, struct_size);
  MEMBER(emb_closest_out, value);
  MEMBER(emb_closest_out, point);
  MEMBER(emb_closest_out, gradient);
  MEMBER(emb_closest_out, barycentric);
  MEMBER(emb_closest_out, vector_stride);
  MEMBER(emb_closest_out, primitive);
  MEMBER(emb_closest_out, part);
  MEMBER(emb_closest_out, tag);
  MEMBER(emb_closest_out, feature);
  MEMBER(emb_closest_out, piece);
  STRUCT(emb_hit_out);
  MEMBER(emb_hit_out, struct_size);
  MEMBER(emb_hit_out, t);
  MEMBER(emb_hit_out, count);
  MEMBER(emb_hit_out, status);
  MEMBER(emb_hit_out, normal);
  MEMBER(emb_hit_out, vector_stride);
  MEMBER(emb_hit_out, primitive);
  MEMBER(emb_hit_out, part);
  MEMBER(emb_hit_out, tag);
  STRUCT(emb_ray_out);
  MEMBER(emb_ray_out, struct_size);
  MEMBER(emb_ray_out, t);
  MEMBER(emb_ray_out, side);
  MEMBER(emb_ray_out, normal);
  MEMBER(emb_ray_out, vector_stride);
  MEMBER(emb_ray_out, primitive);
  MEMBER(emb_ray_out, part);
  MEMBER(emb_ray_out, tag);
  STRUCT(emb_crossings_out);
  MEMBER(emb_crossings_out, struct_size);
  MEMBER(emb_crossings_out, form);
  MEMBER(emb_crossings_out, elsewhere);
  MEMBER(emb_crossings_out, none);
  MEMBER(emb_crossings_out, where);
  MEMBER(emb_crossings_out, count);
  MEMBER(emb_crossings_out, tag);
  MEMBER(emb_crossings_out, part);
}

int main(void) {
  CHECK(emb_version_number() == EMB_VERSION_MAJOR * 10000 + EMB_VERSION_MINOR * 100 + EMB_VERSION_PATCH);
  CHECK(strcmp(emb_last_error(), "") == 0);
  CHECK(strcmp(emb_isa(), "scalar") == 0 || strcmp(emb_isa(), "avx2") == 0 || strcmp(emb_isa(), "avx512") == 0 ||
        strcmp(emb_isa(), "neon") == 0);
  runs_and_lattices();
  meshes();
  repairs();
  diagnoses();
  geometries();
  outputs();
  return checks_done("layout");
}
