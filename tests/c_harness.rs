// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles each program of tests/c and runs it against the shared and the static library that cargo
//! leaves beside this test, at each instruction set; with EMBOUND_VALGRIND=1 under valgrind as well.

mod common;

use common::native::{Language, compile, deps, root, work};
use embound::ffi::*;
use std::ffi::OsString;
use std::mem::{offset_of, size_of};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What Rust must be linked with on Linux when it is a static library.
const SYSTEM: [&str; 7] = ["-lgcc_s", "-lutil", "-lrt", "-lpthread", "-lm", "-ldl", "-lc"];

/// The directory to link the shared library from, under the name that programs look for.
fn shared_directory() -> PathBuf {
    let directory = work().join("shared");
    fs::create_dir_all(&directory).expect("a directory for the shared library");
    let version = (env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR"));
    for name in ["libembound.so".to_owned(), format!("libembound.so.{}.{}", version.0, version.1)] {
        let link = directory.join(name);
        // Tests run at once: each makes its own link and moves it into place.
        let own = directory.join(format!("{}-{:?}", link.display(), std::thread::current().id()));
        let _ = fs::remove_file(&own);
        std::os::unix::fs::symlink(deps().join("libembound.so"), &own).expect("a link");
        fs::rename(&own, &link).expect("a link");
    }
    directory
}

fn link_shared() -> Vec<OsString> {
    let directory = shared_directory().into_os_string();
    let [mut search, mut rpath] = ["-L", "-Wl,-rpath,"].map(OsString::from);
    search.push(&directory);
    rpath.push(&directory);
    vec![search, "-lembound".into(), rpath, "-lm".into(), "-lpthread".into()]
}

fn link_static() -> Vec<OsString> {
    let library = deps().join("libembound.a").into_os_string();
    [library].into_iter().chain(SYSTEM.map(OsString::from)).collect()
}

/// Builds tests/c/NAME.c.
fn build(name: &str, kind: &str, link: &[OsString]) -> PathBuf {
    let source = root().join(format!("tests/c/{name}.c"));
    let program = work().join(format!("{name}_{kind}"));
    let mut arguments: Vec<OsString> =
        ["-O1", "-g", "-Wall", "-Wextra", "-Wpedantic", "-Werror"].map(OsString::from).into();
    arguments.extend([source.into(), "-o".into(), program.clone().into()]);
    arguments.extend(link.iter().cloned());
    compile(Language::C, &arguments);
    program
}

/// Runs a program, which must succeed, and returns what it printed.
fn run(program: &Path, isa: Option<&str>, valgrind: bool) -> String {
    let mut command = if valgrind { Command::new("valgrind") } else { Command::new(program) };
    if valgrind {
        let leaks =
            ["--leak-check=full", "--show-leak-kinds=definite,indirect", "--errors-for-leak-kinds=definite,indirect"];
        command.args(["--quiet", "--error-exitcode=99", "--fair-sched=yes"]).args(leaks).arg(program);
    }
    command.env("TMPDIR", work());
    match isa {
        Some(isa) => command.env("EMBOUND_ISA", isa),
        None => command.env_remove("EMBOUND_ISA"),
    };
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{text}{errors}", output.status);
    text
}

/// Both libraries, the instruction sets, and valgrind where it is asked for; what each printed.
fn harness(name: &str) -> Vec<String> {
    let shared = build(name, "shared", &link_shared());
    let linked = build(name, "static", &link_static());
    let mut outputs = vec![run(&shared, None, false), run(&linked, None, false)];
    outputs.extend(["scalar", "avx2"].map(|isa| run(&shared, Some(isa), false)));
    if env::var_os("EMBOUND_VALGRIND").is_some() {
        outputs.push(run(&shared, Some("avx2"), true));
    }
    outputs
}

#[test]
fn misuse_is_answered_with_a_status_and_a_message() {
    harness("misuse");
}

#[test]
fn misuse_of_constructors_is_answered_with_a_status_and_a_message() {
    harness("misuse_shapes");
}

#[test]
fn values_over_lattices_are_written_to_files() {
    harness("lattice");
}

#[test]
fn misuse_of_meshes_is_answered_with_a_status_and_a_message() {
    harness("misuse_meshes");
}

#[test]
fn rays_are_answered_and_their_misuse_with_a_status_and_a_message() {
    harness("misuse_rays");
}

/// [`harness`] of a program that prints a hash of its results, which must be the same each time.
fn same_hashes(name: &str) {
    let outputs = harness(name);
    let hash = |text: &str| text.lines().find(|line| line.starts_with("hash ")).map(str::to_owned);
    let hashes: Vec<_> = outputs.iter().map(|text| hash(text).expect("a hash")).collect();
    assert!(hashes.iter().all(|h| *h == hashes[0]), "shared, static, scalar, avx2, ...: {hashes:?}");
}

#[test]
fn values_have_the_same_bits_however_they_are_asked_for() {
    same_hashes("values");
}

#[test]
fn meshes_tell_their_topology_and_measures() {
    same_hashes("meshes");
}

#[test]
fn data_of_meshes_have_the_same_bits_at_closest_points() {
    same_hashes("mesh_data");
}

#[test]
fn meshes_are_put_together_and_taken_apart() {
    harness("mesh_parts");
}

#[test]
fn trees_of_every_constructor_have_the_same_bits_however_they_are_asked_for() {
    same_hashes("trees");
}

#[test]
fn meshes_are_repaired_and_polygons_hold_points() {
    harness("repair");
}

#[test]
fn vertices_of_meshes_move() {
    harness("refit");
}

#[test]
fn open_meshes_have_the_same_signs_however_they_are_asked_for() {
    same_hashes("signs");
}

#[test]
fn geometries_are_packed_into_the_same_bytes_and_come_back() {
    same_hashes("pack");
}

#[test]
fn diagnoses_of_meshes_have_the_same_bits_however_they_are_asked_for() {
    same_hashes("diagnosis");
}

#[test]
fn results_do_not_depend_on_the_floating_point_environment() {
    harness("environment");
}

#[test]
fn pools_and_executors_give_the_same_bits() {
    harness("pools");
}

#[test]
fn memory_that_cannot_be_had_is_a_status() {
    harness("memory");
}

/// The lines of layout.c, from the Rust compiler.
macro_rules! layout {
    ($lines:ident, $type:ident: $($member:ident),+) => {
        $lines.push(format!("{} {}", stringify!($type), size_of::<$type>()));
        $($lines.push(format!(
            "{}.{} {} {}",
            stringify!($type),
            stringify!($member).trim_start_matches("r#"),
            offset_of!($type, $member),
            size_of_member(|s: &$type| &s.$member)
        ));)+
    };
}

fn size_of_member<S, M>(_: impl Fn(&S) -> &M) -> usize {
    size_of::<M>()
}

#[test]
fn structs_have_one_layout_on_both_sides() {
    let mut lines = Vec::new();
    layout!(lines, emb_run: struct_size, pool, progress, user);
    layout!(lines, emb_lattice: struct_size, n, x, y, z);
    layout!(lines, emb_array: struct_size, data, r#type, stride);
    layout!(lines, emb_mesh_options: struct_size, scale, rotation, shift, weld_tolerance, orient, format, index_base);
    layout!(lines, emb_mesh_report: struct_size, closed, consistent, inside_out, components, vertices, faces,
        triangles, boundary_edges, nonmanifold_edges, inconsistent_edges, degenerate_faces, duplicate_faces,
        self_intersections, volume, area, lo, hi, warped_faces);
    layout!(lines, emb_mesh_measure: struct_size, normal, centroid, size);
    layout!(lines, emb_mesh_field: struct_size, components, count);
    layout!(lines, emb_repair_options: struct_size, flags, fill_tag_rule, fill_tag, weld_tolerance, hole_edges,
        hole_length);
    layout!(lines, emb_repair_result: struct_size, vertices_welded, faces_collapsed, degenerate_faces,
        corners_added, duplicate_faces, vertices_split, faces_turned, components_turned, holes_filled, holes_left, faces_added);
    layout!(lines, emb_diagnosis_options: struct_size, sliver_ratio, off_plane_ratio, intersection_limit);
    layout!(lines, emb_diagnosis_summary: struct_size, nonmanifold_vertices, shrunk_faces, flat_faces, slivers,
        off_plane_faces, components, boundary_loops, open_chains, listed_intersections, turned_faces, unbalanced_edges,
        intersections_complete);
    layout!(lines, emb_mesh_component: struct_size, lowest_face, faces, triangles, boundary_edges, nonmanifold_edges,
        inconsistent_edges, turned_faces, closed, consistent, inside_out, volume, area, lo, hi);
    layout!(lines, emb_mesh_loop: struct_size, edges, component, closed, length, diagonal, lo, hi);
    layout!(lines, emb_sdf_options: struct_size, sign, open, axis, accelerator, open_lo, open_hi);
    layout!(lines, emb_callback_options: struct_size, lo, hi, lipschitz, gradient_step, kind, thread_safe, values,
        gradient, range);
    layout!(lines, emb_expression_options: struct_size, lo, hi, lipschitz);
    layout!(lines, emb_blend: struct_size, kind, thread_safe, width, blend, user, drop, support, depth, lipschitz);
    layout!(lines, emb_geom_properties: struct_size, kind, sign_method, lipschitz, primitives, bytes);
    layout!(lines, emb_closest_out: struct_size, value, point, gradient, barycentric, vector_stride, primitive,
        part, tag, feature, piece);
    layout!(lines, emb_hit_out: struct_size, t, count, status, normal, vector_stride, primitive, part, tag);
    layout!(lines, emb_ray_out: struct_size, t, side, normal, vector_stride, primitive, part, tag);
    layout!(lines, emb_crossings_out: struct_size, form, elsewhere, none, r#where, count, tag, part);
    let header = fs::read_to_string(root().join("include/embound.h")).expect("the header");
    let structs = header.lines().filter(|line| line.starts_with("typedef struct") && line.ends_with('{')).count();
    assert_eq!(
        lines.iter().filter(|line| !line.contains('.')).count(),
        structs,
        "a struct of the header is missing here"
    );
    for output in harness("layout") {
        let printed: Vec<&str> = output.lines().filter(|line| line.starts_with("emb_")).collect();
        assert_eq!(printed, lines);
    }
}
