// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measures of single faces, edges and vertices, and distances to them.

use super::*;
use embound::geometry::{Geometry, SdfOptions};
use embound::mesh::Element;
use embound::parallel::Run;

#[test]
fn a_cube_is_measured() {
    // Six squares, as polygons.
    let mesh = cube();
    let topology = mesh.half_edges();
    for f in 0..6 {
        let m = mesh.measure(Element::Face(f));
        assert_eq!((m.size, m.normal.length()), (4.0, 1.0));
        assert_eq!(m.centroid, m.normal, "the centre of a side lies where its normal points");
    }
    for h in 0..topology.count() as u32 {
        let m = mesh.measure(Element::Edge(h));
        assert_eq!(m.size, 2.0);
        assert!((m.normal * 2f64.sqrt() - m.centroid).length() < 1e-15, "{m:?}");
    }
    for v in 0..8 {
        let m = mesh.measure(Element::Vertex(v));
        assert_eq!((m.size, m.centroid), (0.0, mesh.vertices()[v as usize]));
        assert!((m.normal * 3f64.sqrt() - m.centroid).length() < 1e-15, "{m:?}");
    }
}

fn cube() -> Mesh {
    let xyz: Vec<f64> = (0..8).flat_map(|k| [1, 2, 4].map(|b| if k & b == 0 { -1.0 } else { 1.0 })).collect();
    let sides = [[0u32, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let offsets: Vec<usize> = (0..7).map(|k| 4 * k).collect();
    Mesh::from_polygons(&xyz, &offsets, &sides.concat(), None, &MeshOptions::default()).unwrap()
}

#[test]
fn normals_are_those_that_decide_the_sign() {
    for body in [bodies::leaning_pyramid(), bodies::bracket(), bodies::icosphere(1).flipped()] {
        let mesh = body.mesh();
        let known = mesh.pseudonormals().unwrap();
        for f in 0..mesh.triangle_count() as u32 {
            assert_eq!(mesh.measure(Element::Face(f)).normal, known.triangle[f as usize]);
            for k in 0..3 {
                let edge = mesh.measure(Element::Edge(3 * f + k)).normal;
                let wanted = known.edge[f as usize][k as usize];
                assert!((edge * wanted.length() - wanted).length() < 1e-14);
            }
        }
        for v in 0..mesh.vertices().len() as u32 {
            let wanted = known.vertex[v as usize];
            let found = mesh.measure(Element::Vertex(v)).normal;
            assert!((found * wanted.length() - wanted).length() < 1e-13);
        }
    }
}

/// The distance to a surface is the least to its elements, and an element that attains it has its sign.
#[test]
fn the_least_distance_to_an_element_is_the_distance() {
    for mesh in [
        bodies::leaning_pyramid().mesh(),
        cube(),
        bodies::bracket().scaled(1e-6).mesh(),
        bodies::torus(3e3, 1e3, 8, 6).mesh(),
    ] {
        let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::default()).unwrap();
        let (center, size) = (mesh.bounds().center(), mesh.bounds().diagonal());
        let mut random = Random(3);
        for _ in 0..300 {
            let p = center + Vec3::from_array(random.point([-0.7 * size; 3], [0.7 * size; 3]));
            let value = g.value(p);
            let faces = (0..mesh.half_edges().face_count() as u32).map(Element::Face);
            let edges = (0..mesh.half_edges().count() as u32).map(Element::Edge);
            let vertices = (0..mesh.vertices().len() as u32).map(Element::Vertex);
            let known: Vec<_> = faces.chain(edges).chain(vertices).map(|e| mesh.distance(e, p)).collect();
            let least = known.iter().map(|d| d.0.abs()).fold(f64::INFINITY, f64::min);
            assert!((least - value.abs()).abs() <= 1e-13 * size, "{least} {value}");
            for (distance, foot) in known {
                assert!((foot.distance(p) - distance.abs()).abs() <= 1e-13 * size);
            }
            let c = g.closest(p);
            let f = mesh.half_edges().face_of_input(c.primitive as u32).unwrap();
            if c.feature == 0 {
                let (distance, _) = mesh.distance(Element::Face(f), p);
                assert_eq!(distance < 0.0, value < 0.0);
            } else if c.feature >= 4 && mesh.half_edges().corners(f).len() == 3 {
                let corner = mesh.half_edges().corners(f)[(c.feature - 4) as usize];
                let (distance, foot) = mesh.distance(Element::Vertex(corner), p);
                assert_eq!(foot, mesh.vertices()[corner as usize]);
                assert_eq!((distance < 0.0, distance.abs()), (value < 0.0, foot.distance(p)));
            }
        }
    }
}

#[test]
fn faces_without_area_have_no_normal_and_still_a_distance() {
    let mut body = bodies::icosphere(0);
    let n = body.vertices.len() as u32;
    body.vertices.extend([[4.0, 0.0, 0.0], [5.0, 0.0, 0.0], [6.0, 0.0, 0.0]]);
    body.triangles.push([n, n + 1, n + 2]);
    let mesh = body.mesh();
    let m = mesh.measure(Element::Face(20));
    assert_eq!((m.normal, m.size, m.centroid), (Vec3::ZERO, 0.0, Vec3::new(5.0, 0.0, 0.0)));
    assert_eq!(mesh.distance(Element::Face(20), Vec3::new(7.0, 0.0, 0.0)), (1.0, Vec3::new(6.0, 0.0, 0.0)));
}
