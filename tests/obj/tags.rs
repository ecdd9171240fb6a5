// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tags from groups, objects, materials, and from the comments that embound writes.

use super::*;

/// The tag of each face, and the names of tags.
fn tags(text: &str) -> (Vec<i32>, Vec<(i32, String)>) {
    let mesh = mesh(&format!("{VERTICES}{}", text.replace(" F ", "\nf 1 2 3\n").replace("; ", "\n")));
    ((0..mesh.face_count() as u32).map(|f| mesh.tag(f)).collect(), mesh.tag_names().to_vec())
}

fn assert_tags(text: &str, of_faces: &[i32], names: &[(i32, &str)]) {
    let names: Vec<(i32, String)> = names.iter().map(|(tag, name)| (*tag, (*name).to_owned())).collect();
    assert_eq!(tags(text), (of_faces.to_vec(), names), "{text}");
}

#[test]
fn each_combination_of_group_and_material_is_a_tag_in_order_of_use() {
    assert_tags(" F  F ", &[0, 0], &[]);
    assert_tags("g a F  F ", &[0, 0], &[(0, "a")]);
    assert_tags("g a F g b F g a F ", &[0, 1, 0], &[(0, "a"), (1, "b")]);
    assert_tags(" F g b F ", &[0, 1], &[(1, "b")]);
    assert_tags("g unused; g b F ", &[0], &[(0, "b")]);
    assert_tags("usemtl m F usemtl n F ", &[0, 1], &[(0, "m"), (1, "n")]);
    assert_tags("g a; usemtl m F g b F usemtl n F ", &[0, 1, 2], &[(0, "a:m"), (1, "b:m"), (2, "b:n")]);
    assert_tags("usemtl m; g a F usemtl F ", &[0, 1], &[(0, "a:m"), (1, "a")]);
    assert_tags("g inlet  pipe  F ", &[0], &[(0, "inlet  pipe")]);
}

#[test]
fn an_object_counts_where_it_has_no_group() {
    assert_tags("o a F o b F ", &[0, 1], &[(0, "a"), (1, "b")]);
    assert_tags("o a; g x F o b F ", &[0, 1], &[(0, "x"), (1, "b")]);
    assert_tags("o a; g x F g F ", &[0, 1], &[(0, "x"), (1, "a")]);
    assert_tags("o a; usemtl m F ", &[0], &[(0, "a:m")]);
}

#[test]
fn a_comment_before_a_group_gives_its_tag_and_name() {
    assert_tags("# tag 7 hot wall; g hot_wall F ", &[7], &[(7, "hot wall")]);
    assert_tags("# tag -3; g tag_-3 F ", &[-3], &[]);
    assert_tags("# tag 2 a; g a F # tag 0 b; g b F # tag 2 a; g a F ", &[2, 0, 2], &[(0, "b"), (2, "a")]);
    assert_tags("# tag 0 a; g a F ", &[0], &[(0, "a")]);
    assert_tags("g a F # tag 0 b; g b F ", &[1, 0], &[(0, "b"), (1, "a")]);
    assert_tags(" F # tag 5 nothing has this; g x; # tag 1 y; g y F ", &[0, 1], &[(1, "y"), (5, "nothing has this")]);
}

#[test]
fn a_comment_that_is_not_before_a_group_is_a_comment() {
    assert_tags("# tag 7 x; usemtl m; g a F ", &[0], &[(0, "a:m")]);
    assert_tags("#tag 7 x; g a F ", &[0], &[(0, "a")]);
    assert_tags("# tag x 7; g a F ", &[0], &[(0, "a")]);
    assert_tags("# tags 7; g a F ", &[0], &[(0, "a")]);
    assert_tags("# tag 99999999999 x; g a F ", &[0], &[(0, "a")]);
    assert_tags("# tag 7 x; g b; g a F ", &[0], &[(0, "a"), (7, "x")]);
}
