// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes joined, split and rebuilt, with tags, names and data.

use super::*;
use common::{Described, described};
use embound::mesh::{Field, FieldType, JoinTags, RepairOptions, SplitBy};

/// Two spheres and a cube, tagged -3 (ball), 7 and 12, with data whose values say where they belong.
fn scene() -> Mesh {
    let ball = bodies::sphere_at(1, [0.0; 3], 1.0);
    let soup = ball
        .and(&bodies::sphere_at(1, [5.0, 0.0, 0.0], 1.0))
        .and(&bodies::cuboid([-1.0; 3], [1.0; 3]).translated([9.0, 0.0, 0.0]));
    let n = ball.triangles.len();
    let tags: Vec<i32> = (0..soup.triangles.len())
        .map(|f| {
            if f < n {
                12
            } else if f < 2 * n {
                -3
            } else {
                7
            }
        })
        .collect();
    let mesh = Mesh::from_triangles(&soup.xyz(), &soup.indices(), Some(&tags), &MeshOptions::default()).unwrap();
    let mesh = mesh.with_tags(&tags, vec![(12, "outlet".into()), (-3, "ball".into())]).unwrap();
    let x = mesh.vertices().iter().flat_map(|p| [p.x, 2.0 * p.y]).collect();
    let mesh = mesh.with_field(false, field("xy", 2, x)).unwrap();
    let number = (0..mesh.face_count()).map(|f| f as f64).collect();
    mesh.with_field(true, field("number", 1, number)).unwrap()
}

fn field(name: &str, components: usize, values: Vec<f64>) -> Field {
    Field { name: name.into(), kind: FieldType::F64, components, values }
}

#[test]
fn parts_keep_faces_tags_names_and_data() {
    let mesh = scene();
    let all = described(&mesh);
    for (by, wanted) in [(SplitBy::Tag, [-3, 7, 12]), (SplitBy::Component, [12, -3, 7])] {
        let parts = mesh.split(by).unwrap();
        assert_eq!((parts.len(), mesh.part_count(by).unwrap()), (3, 3));
        for (part, tag) in parts.iter().zip(wanted) {
            let same: Vec<Described> = all.iter().filter(|f| f.1 == tag).cloned().collect();
            assert_eq!(described(part), same, "{by:?} {tag}");
            assert!(part.report().closed && part.face_count() == same.len());
        }
    }
}

#[test]
fn what_is_split_and_joined_is_the_same_again() {
    let mesh = scene();
    let parts = mesh.split(SplitBy::Component).unwrap();
    let whole = Mesh::join(&parts.iter().collect::<Vec<_>>(), JoinTags::Keep, &MeshOptions::default()).unwrap();
    assert_eq!(described(&whole), described(&mesh));
    assert_eq!(whole.report(), mesh.report());
}

#[test]
fn tags_are_kept_numbered_anew_or_those_of_the_meshes() {
    let (a, b) = (scene(), scene());
    let plain = bodies::icosphere(0).mesh();
    let tags = |how| {
        let joined = Mesh::join(&[&a, &plain, &b], how, &options(|o| o.weld_tolerance = -1.0)).unwrap();
        let mut seen: Vec<(i32, Option<String>)> = described(&joined).into_iter().map(|f| (f.1, f.2)).collect();
        seen.dedup();
        seen
    };
    let name = |n: &str| Some(n.to_owned());
    let (outlet, ball) = (name("outlet"), name("ball"));
    let kept = [
        (12, outlet.clone()),
        (-3, ball.clone()),
        (7, None),
        (0, None),
        (12, outlet.clone()),
        (-3, ball.clone()),
        (7, None),
    ];
    assert_eq!(tags(JoinTags::Keep), kept);
    let anew =
        [(2, outlet.clone()), (0, ball.clone()), (1, None), (3, None), (6, outlet), (4, ball.clone()), (5, None)];
    assert_eq!(tags(JoinTags::Renumber), anew);
    assert_eq!(tags(JoinTags::ByMesh), [(0, ball.clone()), (1, None), (2, ball)]);
}

#[test]
fn fields_that_a_mesh_lacks_are_not_numbers_and_faces_count_on() {
    let (mesh, plain) = (scene(), bodies::icosphere(0).translated([0.0, 9.0, 0.0]).mesh());
    let joined = Mesh::join(&[&plain, &mesh], JoinTags::Keep, &MeshOptions::default()).unwrap();
    let number = &joined.face_fields()[0];
    assert!(number.values[..20].iter().all(|x| x.is_nan()));
    assert_eq!(number.values[20..], mesh.face_fields()[0].values);
    assert_eq!(joined.face_count(), 20 + mesh.face_count());
    let other = mesh.with_field(true, field("number", 2, vec![0.0; 2 * mesh.face_count()])).unwrap();
    let refused = Mesh::join(&[&mesh, &other], JoinTags::Keep, &MeshOptions::default()).unwrap_err();
    assert_eq!(refused.message(), "meshes: the field \"number\" has 1 components in one and 2 in another");
    assert_eq!(Mesh::join(&[], JoinTags::Keep, &MeshOptions::default()).unwrap_err().status(), Status::InvalidArgument);
}

#[test]
fn a_rebuilt_mesh_is_turned_over_and_moved_with_its_data() {
    let mesh = scene();
    let flipped = mesh.rebuilt(&options(|o| o.orient = Orient::Flip)).unwrap();
    assert!(close(flipped.report().volume, mesh.report().volume) && flipped.surface().volume < 0.0);
    let back = flipped.rebuilt(&options(|o| o.orient = Orient::Flip)).unwrap();
    assert_eq!(described(&back), described(&mesh));
    let moved = mesh.rebuilt(&options(|o| (o.scale, o.shift) = (2.0, [1.0, 0.0, 0.0]))).unwrap();
    assert_eq!(moved.bounds().hi.x, 2.0 * mesh.bounds().hi.x + 1.0);
    assert_eq!(moved.vertex_fields(), mesh.vertex_fields());
}

#[test]
fn numbers_of_faces_stay_where_welding_collapsed_some() {
    let mut body = bodies::icosphere(0);
    let [a, b, _] = body.triangles[0];
    body.triangles.insert(3, [a, a, b]);
    body.triangles.push([b, b, a]);
    let mesh = body.mesh();
    let joined = Mesh::join(&[&mesh, &mesh], JoinTags::Keep, &options(|o| o.weld_tolerance = -1.0)).unwrap();
    assert_eq!((mesh.face_count(), joined.face_count()), (22, 44));
    let numbers: Vec<u32> = joined.triangles().iter().map(|t| t.face).collect();
    let once = (0..22).filter(|f| ![3, 21].contains(f));
    assert_eq!(numbers, once.clone().chain(once.map(|f| f + 22)).collect::<Vec<u32>>());
}

#[test]
fn what_stands_keeps_its_vertices_and_its_orientation() {
    // Two cubes that share an edge, parted by repair, the second turned inward by the caller.
    let repair = RepairOptions { split: true, ..RepairOptions::NOTHING };
    let (apart, done) = bodies::cubes_sharing_an_edge().mesh().repaired(&repair).unwrap();
    assert!(done.vertices_split > 0 && apart.surface().nonmanifold_edges == 0);
    let inward = bodies::unit_cube().flipped().translated([5.0, 0.0, 0.0]).mesh_kept();
    let moved = apart.rebuilt(&options(|o| (o.scale, o.shift) = (2.0, [0.0, 1.0, 0.0]))).unwrap();
    assert_eq!((moved.vertices().len(), moved.surface().nonmanifold_edges), (apart.vertices().len(), 0));
    assert!(inward.rebuilt(&MeshOptions::default()).unwrap().surface().volume < 0.0);
    let joined = Mesh::join(&[&apart, &inward], JoinTags::Keep, &MeshOptions::default()).unwrap();
    assert_eq!(joined.vertices().len(), apart.vertices().len() + 8);
    assert!(close(joined.surface().volume, apart.surface().volume - 1.0));
    // Asked to weld, it welds, and orients with it.
    let welded = Mesh::join(&[&apart, &inward], JoinTags::Keep, &options(|o| o.weld_tolerance = 1e-12)).unwrap();
    assert_eq!(welded.surface().nonmanifold_edges, 1);
    assert!(close(welded.surface().volume, apart.surface().volume + 1.0));
}
