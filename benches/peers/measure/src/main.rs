// SPDX-License-Identifier: MIT OR Apache-2.0
//! embound's side of the comparison, and the table. scripts/performance calls it; by hand:
//!
//!     measure points OUT [--count N] [--grid N] [--lattice N,N,...] MESH|icosphere:N ...
//!     measure ask CASE_DIRECTORY [--lattice N,N,...] [--edges N,N,...]
//!     measure threads CASE_DIRECTORY [--lattice N,N,...]
//!     measure balls COUNT
//!     measure centre TRIANGLES
//!     measure count CASE_DIRECTORY QUESTION N
//!     measure table LINES [--by-hand FILE] [--tried FILE] [--out FILE]
//!
//! `points` makes a case of each mesh (`case/src/lib.rs` says what its files hold), `ask` times embound on
//! one thread and holds every answer against brute force, `threads` compares two threads with one, `centre`
//! asks at the centre of a sphere alone, `count` asks N questions and stops, so that a counter of
//! instructions sees nothing else, and `table` turns all lines into docs/performance.md.

mod ask;
mod centre;
mod composite;
mod count;
mod document;
mod edges;
mod files;
mod icosphere;
mod lattice;
mod lines;
mod moved;
mod points;
#[path = "../../../../tests/common/random.rs"]
#[allow(dead_code)]
mod random;
mod targets;
mod threads;

use lexopt::prelude::*;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// What this was built with.
const LOCK: &str = include_str!("../../Cargo.lock");

type Outcome = Result<(), Box<dyn Error>>;

/// Everything that can stand on the command line.
struct Arguments {
    rest: Vec<String>,
    /// Points of the uniform and of the near set.
    count: usize,
    /// Points along each axis of the grid set.
    grid: usize,
    /// Points along each axis of the lattices that are filled.
    lattices: Vec<usize>,
    /// Points along each axis of the lattices whose edges are asked about.
    edges: Vec<usize>,
    by_hand: Option<PathBuf>,
    tried: Option<PathBuf>,
    out: Option<PathBuf>,
}

fn arguments() -> Result<Arguments, Box<dyn Error>> {
    let mut given = Arguments {
        rest: Vec::new(),
        count: 200_000,
        grid: 96,
        lattices: vec![64, 96, 192, 256],
        edges: vec![64, 256],
        by_hand: None,
        tried: None,
        out: None,
    };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("count") => given.count = parser.value()?.parse()?,
            Long("grid") => given.grid = parser.value()?.parse()?,
            Long("lattice") => given.lattices = numbers(&parser.value()?.string()?)?,
            Long("edges") => given.edges = numbers(&parser.value()?.string()?)?,
            Long("by-hand") => given.by_hand = Some(parser.value()?.into()),
            Long("tried") => given.tried = Some(parser.value()?.into()),
            Long("out") => given.out = Some(parser.value()?.into()),
            Value(value) => given.rest.push(value.string()?),
            other => return Err(other.unexpected().into()),
        }
    }
    Ok(given)
}

fn numbers(list: &str) -> Result<Vec<usize>, std::num::ParseIntError> {
    list.split(',').map(str::parse).collect()
}

fn run() -> Outcome {
    let given = arguments()?;
    let rest: Vec<&str> = given.rest.iter().map(String::as_str).collect();
    match rest[..] {
        ["points", out, ref meshes @ ..] if !meshes.is_empty() => points::write(out.as_ref(), meshes, &given),
        ["ask", case] => ask::ask(case.as_ref(), &given.lattices, &given.edges),
        ["threads", case] => threads::compare(case.as_ref(), &given.lattices),
        ["balls", count] => composite::balls(count.parse()?),
        ["centre", triangles] => centre::alone(triangles.parse()?),
        ["count", case, question, n] => count::only(case.as_ref(), question, n.parse()?),
        ["table", lines] => document::write(lines.as_ref(), &given),
        _ => Err("usage: see the first lines of benches/peers/measure/src/main.rs".into()),
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("measure: {error}");
            ExitCode::FAILURE
        }
    }
}
