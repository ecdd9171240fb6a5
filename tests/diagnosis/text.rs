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
duplicate faces, slivers, warped faces, intersections
not looked for: faces off a plane
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
             ask for the sign by the winding number (EMB_SIGN_WINDING) or the unsigned distance (EMB_SIGN_NONE)",
        ),
        (
            bodies::overlapping_spheres(1),
            "to do: faces touch or pass through each other: EMB_SIGN_AUTO takes the sign near them from crossings",
        ),
        (
            bodies::cubes_sharing_an_edge(),
            "to do: edges have more than two faces: EMB_SIGN_AUTO takes the sign from crossings, as EMB_SIGN_RAY does",
        ),
        (
            bodies::book(3),
            "to do: 7 edges do not have as many faces one way as the other: no inside; ask for the sign by the winding number (EMB_SIGN_WINDING) or the unsigned distance \
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
    assert!(told.contains("to do: nothing, but for intersections, not looked for: closed"), "{told}");
    let all = DiagnosisOptions { off_plane_ratio: 1e-6, sliver_ratio: 0.0, ..DiagnosisOptions::default() };
    let told = diagnosis_with(&bodies::unit_cube().mesh(), &all).text();
    assert!(told.contains("warped faces, faces off a plane, intersections\nnot looked for: slivers\n"), "{told}");
}

#[test]
fn a_rim_beyond_the_limits_of_repair_is_told_with_what_fills_it() {
    // One side of a cube is away: a rim of 4 edges over a diagonal of 3^(1/2).
    let open = bodies::unit_cube().without(|t| t < 2);
    assert_eq!(
        last_line(&open),
        "to do: 1 hole of 4 edges: repair with EMB_REPAIR_HOLES and hole_length 2.31 (1 rim is longer than the 0.5 \
         component diagonals of the default; if not meant open) or ask for the sign by the winding number (EMB_SIGN_WINDING) or the unsigned distance (EMB_SIGN_NONE)"
    );
    let filled =
        |hole_length| open.mesh().repaired(&RepairOptions { hole_length, ..RepairOptions::default() }).unwrap();
    assert_eq!((filled(2.31).1.holes_filled, filled(2.3).1.holes_filled), (1, 0));
}

#[test]
fn boundaries_that_nearly_coincide_are_told_to_be_welded() {
    let sphere = bodies::icosphere(1);
    let mut noisy = Soup::default();
    for (k, t) in sphere.triangles.iter().enumerate() {
        let apart = t.map(|v| sphere.vertices[v as usize]);
        let noise = 2e-7 * ((k * 37 % 80) as f64 / 80.0 - 0.5);
        let one = Soup { vertices: apart.to_vec(), triangles: vec![[0, 1, 2]] };
        noisy = noisy.and(&one.map(|p| [p[0] + noise, p[1] - noise, p[2]]));
    }
    assert_eq!(
        last_line(&noisy),
        "to do: 240 of 240 boundary edges nearly coincide: weld with weld_tolerance 1e-7, at reading or with \
         EMB_REPAIR_WELD, before holes are filled"
    );
    let near = MeshOptions { weld_tolerance: 1e-7, ..MeshOptions::default() };
    assert!(noisy.mesh_with(&near).report().closed);
}

#[test]
fn a_shell_within_another_that_faces_outward_is_told() {
    let nested = bodies::icosphere(1).and(&bodies::icosphere(1).scaled(0.5));
    let advice = "to do: 1 closed component within another faces outward, too, and is no cavity: EMB_REPAIR_ORIENT or \
                  EMB_ORIENT_ALTERNATE makes it one";
    assert_eq!(last_line(&nested), advice);
    let hollow = bodies::icosphere(1).and(&bodies::icosphere(1).scaled(0.5).flipped());
    let beside = bodies::icosphere(1).and(&bodies::icosphere(1).translated([5.0, 0.0, 0.0]));
    for soup in [hollow, beside] {
        assert!(last_line(&soup).starts_with("to do: nothing"), "{}", last_line(&soup));
    }
}
