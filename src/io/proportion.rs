// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files whose few bytes ask for much memory: strips of indices of one byte, faces that lie on one another.

use crate::error::{Error, Result};
use crate::mesh::{Field, Input};

/// Reading takes no more bytes for each of the file, and so many more.
const TIMES: usize = 20;
const MORE: usize = 16 << 20;

/// What a mesh would be built of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Demand {
    pub points: usize,
    pub corners: usize,
    pub vertex_values: usize,
    pub face_values: usize,
}

impl Demand {
    pub fn of(input: &Input) -> Demand {
        let values = |fields: &[Field]| fields.iter().map(|f| f.values.len()).sum();
        Demand {
            points: input.positions.len(),
            corners: input.faces.corners.len(),
            vertex_values: values(&input.vertex_data),
            face_values: values(&input.face_data),
        }
    }

    /// Refuses what a file of so many bytes, once decompressed, is too small for.
    pub fn check(self, bytes: usize) -> Result<()> {
        let Demand { points, corners, vertex_values, face_values } = self;
        // What building takes, measured. A surface has two or three triangles a point; where there are more they lie
        // on one another, and the mesh is built once more without the copies.
        let each = if corners / 15 <= points / 2 { 30 } else { 78 };
        let parts = [(points, 60), (corners, each), (vertex_values, 16), (face_values, 8)];
        let needed = parts.iter().fold(0, |sum: usize, (n, size)| sum.saturating_add(n.saturating_mul(*size)));
        if needed <= bytes.saturating_mul(TIMES).saturating_add(MORE) {
            return Ok(());
        }
        Err(Error::unsupported(format!(
            "faces: {corners} corners over {points} points, with {} values of data, are too many for {bytes} bytes: reading takes at most {TIMES} for each and 16 MB more",
            vertex_values.saturating_add(face_values)
        )))
    }
}
