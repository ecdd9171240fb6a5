// SPDX-License-Identifier: MIT OR Apache-2.0
//! All that faces say of themselves: where their corners are, their tags, names of tags and data, bit for bit.

use embound::mesh::Mesh;

/// Positions of the corners, the tag and its name, and the data of the corners and of the face.
pub type Described = (Vec<[u64; 3]>, i32, Option<String>, Vec<u64>);

/// The faces as they stand, in their order.
pub fn described(mesh: &Mesh) -> Vec<Described> {
    let topology = mesh.half_edges();
    let of = |f: u32| {
        let (number, corners) = (topology.input_face(f), topology.corners(f));
        let positions = corners.iter().map(|v| mesh.vertices()[*v as usize].to_array().map(f64::to_bits)).collect();
        let tag = mesh.tag(number);
        let mut data = Vec::new();
        for h in topology.around_face(f) {
            let row = mesh.vertex_data_row(h) as usize;
            data.extend(mesh.vertex_fields().iter().flat_map(|d| d.item(row)).map(|x| x.to_bits()));
        }
        data.extend(mesh.face_fields().iter().flat_map(|d| d.item(number as usize)).map(|x| x.to_bits()));
        (positions, tag, mesh.tag_name(tag).map(str::to_owned), data)
    };
    (0..topology.face_count() as u32).map(of).collect()
}
