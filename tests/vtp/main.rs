// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading and writing VTP: every encoding, every refusal, numbering, data and tags, and what comes back of a mesh.

#[path = "../common/mod.rs"]
mod common;

mod cells;
mod data;
mod encodings;
mod refusals;
mod round_trips;

use common::vtp_files::{Array, Form, Piece, Style, Vtp, base64, file, rich, rich_piece};
use common::{bodies, same};
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{FieldType, Mesh, MeshOptions, Orient};

const ASCII: Style = Style::new(Form::Ascii);

/// Faces as the file runs them.
fn read(bytes: &[u8]) -> embound::Result<Mesh> {
    io::read_memory(bytes, Format::Detect, &MeshOptions { orient: Orient::Keep, ..MeshOptions::default() })
}

fn mesh(bytes: &[u8]) -> Mesh {
    read(bytes).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(bytes)))
}

/// The message of a file that is not read, of this status.
fn refused_with(bytes: &[u8], status: Status) -> String {
    let error = read(bytes).expect_err("the file is not valid");
    assert_eq!(error.status(), status, "{error}");
    assert!(!error.message().contains(['\n', '\r']), "{error}");
    error.message().to_owned()
}

fn refused(bytes: &[u8]) -> String {
    refused_with(bytes, Status::Parse)
}

/// One triangle.
fn triangle() -> Piece {
    Piece { points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], polys: vec![vec![0, 1, 2]], ..Piece::default() }
}

/// The text of a file of one piece, to be changed.
fn text(piece: &Piece) -> String {
    String::from_utf8(file(ASCII, std::slice::from_ref(piece))).expect("ASCII")
}

fn numbers_of_faces(mesh: &Mesh) -> Vec<u32> {
    (0..mesh.half_edges().face_count() as u32).map(|f| mesh.half_edges().input_face(f)).collect()
}
