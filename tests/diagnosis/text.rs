// SPDX-License-Identifier: MIT OR Apache-2.0
//! The diagnosis in words.

use super::*;

fn text(soup: &Soup) -> String {
    diagnosis(&soup.mesh()).text()
}

fn last_line(soup: &Soup) -> String {
    text(soup).lines().last().unwrap_or("").to_owned()
}

#[test]
fn a_clean_body_is_told_in_a_few_lines() {
    let expected = "\
12 faces, 12 triangles, 8 vertices, 1 component
box (0, 0, 0) to (1, 1, 1), diagonal 1.73205
area 6
signed volume 1
closed: yes
consistent: yes
none found: non-manifold edges, non-manifold vertices, faces that lost corners in welding, faces of zero area, \
duplicate faces, slivers, warped faces, faces off a plane, intersections
to do: nothing: closed, consistent, outward, fit for a signed distance as it is
";
    assert_eq!(text(&bodies::unit_cube()), expected);
}

#[test]
fn faults_are_told_with_faces_and_places() {
    let mut soup = bodies::unit_cube().without(|t| t == 11);
    soup = soup.and(&bodies::book(3).translated([4.0, 0.0, 0.0]));
    let told = text(&soup);
    for line in [
        "14 faces, 14 triangles, 13 vertices, 2 components",
        "closed: no, 9 boundary edges in 2 loops, 1 chain that does not close",
        "consistent: yes",
        "non-manifold edges: 1: vertices 8-9 of 3 faces at (4, 0, 0.5)",
        "non-manifold vertices: 2: 8 of 3 fans at (4, 0, 0), 9 of 3 fans at (4, 0, 1)",
        "components:",
        "boundary loops:",
    ] {
        assert!(told.lines().any(|l| l == line), "{line}\n{told}");
    }
    assert!(told.ends_with('\n') && told.is_ascii());
}

#[test]
fn the_last_line_says_what_to_do() {
    let sphere = bodies::icosphere(1);
    for (soup, advice) in [
        (sphere.flipped(), "to do: closed, consistent, inside out: EMB_ORIENT_AUTO has turned it"),
        (sphere.flipped_where(|t| t == 3), "to do: EMB_ORIENT_AUTO has turned 1 face over"),
        (
            sphere.without(|t| t == 3 || t == 40),
            "to do: 2 holes, the largest of 3 edges: repair with EMB_REPAIR_HOLES (hole_length says how long a rim) or \
             ask for the unsigned distance (EMB_SIGN_NONE)",
        ),
        (
            bodies::overlapping_spheres(1),
            "to do: faces pass through each other: EMB_SIGN_AUTO takes the sign from crossings, as EMB_SIGN_RAY does",
        ),
        (
            bodies::cubes_sharing_an_edge(),
            "to do: edges have more than two faces: EMB_SIGN_AUTO takes the sign from crossings, as EMB_SIGN_RAY does",
        ),
        (
            bodies::book(3),
            "to do: 7 edges do not have as many faces one way as the other: no inside; ask for the unsigned distance \
             (EMB_SIGN_NONE)",
        ),
        (sphere.duplicated(), "to do: 80 faces repeat others: a signed distance takes one of each"),
    ] {
        assert_eq!(last_line(&soup), advice);
    }
    let kept = diagnosis(&sphere.flipped().mesh_kept()).text();
    assert!(kept.ends_with("to do: inside out, and kept so: read it with EMB_ORIENT_AUTO unless inward is meant\n"));
}

#[test]
fn numbers_have_the_digits_they_need() {
    let told = text(&bodies::icosphere(1).scaled(1e-3).flipped());
    let mesh = bodies::icosphere(1).scaled(1e-3).flipped().mesh();
    let volume = |line: &str| line.strip_prefix("signed volume ").and_then(|v| v.parse::<f64>().ok());
    let read = told.lines().find_map(volume).expect("a volume");
    assert!((read / mesh.report().volume - 1.0).abs() < 1e-7, "{read} {}", mesh.report().volume);
}

#[test]
fn long_lists_are_cut() {
    let mut soup = Soup::default();
    for k in 0..100 {
        soup = soup.and(&bodies::tetrahedron().without(|t| t == 0).translated([2.0 * f64::from(k), 0.0, 0.0]));
    }
    let told = text(&soup);
    assert!(told.contains("components, the first 20 of 100:") && told.contains("boundary loops, the first 20 of 100:"));
    assert!(told.lines().count() < 60, "{told}");
    let limited = DiagnosisOptions { intersection_limit: 5, ..DiagnosisOptions::default() };
    let told = diagnosis_with(&bodies::overlapping_spheres(2).mesh(), &limited).text();
    assert!(told.contains("pairs of faces that intersect: at least 6: faces "), "{told}");
    let none = DiagnosisOptions { intersection_limit: 0, ..DiagnosisOptions::default() };
    let told = diagnosis_with(&bodies::unit_cube().mesh(), &none).text();
    assert!(told.contains("pairs of faces that intersect: not looked for"), "{told}");
}
