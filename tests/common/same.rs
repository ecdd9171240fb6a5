// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether two meshes are the same: positions, polygons, tags, names, and data at every corner, to the bit.

use embound::math::Vec3;
use embound::mesh::{Field, Mesh};

/// The corners of each face, as positions.
pub fn faces(mesh: &Mesh) -> Vec<Vec<[f64; 3]>> {
    let topology = mesh.half_edges();
    let position = |v: &u32| mesh.vertices()[*v as usize].to_array();
    (0..topology.face_count() as u32).map(|f| topology.corners(f).iter().map(position).collect()).collect()
}

/// Name, components and the bits of all values.
type Bits = (String, usize, Vec<u64>);

fn bits(field: &Field) -> Bits {
    (field.name.clone(), field.components, field.values.iter().map(|x| x.to_bits()).collect())
}

/// A vertex field at every corner of every face, and at the three corners of every triangle.
fn at_corners(mesh: &Mesh, field: &Field) -> Vec<u64> {
    let mut out = vec![0.0; field.components];
    let rows = (0..mesh.half_edges().count() as u32).map(|h| mesh.vertex_data_row(h) as usize);
    let mut all: Vec<u64> = rows.flat_map(|row| field.item(row)).map(|x| x.to_bits()).collect();
    for f in 0..mesh.half_edges().face_count() as u32 {
        for piece in 0..mesh.triangles_of(f).len() {
            for corner in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)] {
                mesh.interpolate(field, mesh.half_edges().input_face(f).into(), piece as i32, corner, &mut out);
                all.extend(out.iter().map(|x| x.to_bits()));
            }
        }
    }
    all
}

/// Whether `back` is `mesh`; the types of data may differ where the file holds none.
pub fn assert_same_but_types(back: &Mesh, mesh: &Mesh) {
    assert_eq!(back.vertices(), mesh.vertices());
    assert_eq!(back.report(), mesh.report());
    let topology = |m: &Mesh| {
        let h = m.half_edges();
        (0..h.face_count() as u32).map(|f| (h.corners(f).to_vec(), h.input_face(f))).collect::<Vec<_>>()
    };
    assert_eq!(topology(back), topology(mesh));
    let tags = |m: &Mesh| (0..m.face_count() as u32).map(|f| m.tag(f)).collect::<Vec<_>>();
    assert_eq!(tags(back), tags(mesh));
    assert_eq!(back.tag_names(), mesh.tag_names());
    let all = |fields: &[Field]| fields.iter().map(bits).collect::<Vec<_>>();
    assert_eq!(all(back.vertex_fields()), all(mesh.vertex_fields()));
    assert_eq!(all(back.face_fields()), all(mesh.face_fields()));
    for (a, b) in back.vertex_fields().iter().zip(mesh.vertex_fields()) {
        assert_eq!(at_corners(back, a), at_corners(mesh, b), "{}", a.name);
    }
}

/// Whether `back` is `mesh`.
pub fn assert_same(back: &Mesh, mesh: &Mesh) {
    assert_same_but_types(back, mesh);
    let kinds = |fields: &[Field]| fields.iter().map(|f| f.kind).collect::<Vec<_>>();
    assert_eq!(kinds(back.vertex_fields()), kinds(mesh.vertex_fields()));
    assert_eq!(kinds(back.face_fields()), kinds(mesh.face_fields()));
}
