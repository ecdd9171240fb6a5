// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading and writing OBJ: every form of its statements, every refusal, tags, and what comes back of a mesh.

#[path = "../common/mod.rs"]
mod common;

mod forms;
mod refusals;
mod round_trips;
mod tags;

use common::{bodies, obj_files, same};
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{Mesh, MeshOptions, Orient};

/// Faces as the file runs them.
fn read(text: &str) -> embound::Result<Mesh> {
    io::read_memory(text.as_bytes(), Format::Obj, &MeshOptions { orient: Orient::Keep, ..MeshOptions::default() })
}

fn mesh(text: &str) -> Mesh {
    read(text).unwrap_or_else(|e| panic!("{e}: {text}"))
}

/// Four vertices that the texts of these tests put faces on.
const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The positions of the corners of the faces of a text after [`VERTICES`].
fn faces(text: &str) -> Vec<Vec<[f64; 3]>> {
    same::faces(&mesh(&format!("{VERTICES}{text}")))
}
