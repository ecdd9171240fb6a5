// SPDX-License-Identifier: MIT OR Apache-2.0
//! From lines to docs/performance.md.

mod tables;

use crate::lines::{Lines, Measured};
use crate::{Arguments, Outcome, targets};
use std::fmt::Write;
use std::path::Path;

pub use tables::{ratio, short, table};

/// Prints the tables, writes the document where a file is named, and fails where embound was wrong.
pub fn write(path: &Path, given: &Arguments) -> Outcome {
    let lines = Lines::read(&std::fs::read_to_string(path)?)?;
    let optional = |path: &Option<std::path::PathBuf>| path.as_ref().map_or(Ok(String::new()), std::fs::read_to_string);
    let by_hand = targets::ByHand::read(&optional(&given.by_hand)?)?;
    let measured = tables::all(&lines) + &targets::section(&lines, &by_hand);
    println!("{measured}");
    if let Some(out) = &given.out {
        let tried = optional(&given.tried)?;
        let text = format!("{}{measured}\n{}\n{}", header(&lines), by_hand.section(), tried.trim_start());
        std::fs::write(out, text.trim_end().to_owned() + "\n")?;
    }
    let faults = lines.faults();
    if faults.is_empty() { Ok(()) } else { Err(format!("embound was wrong:\n{}", faults.join("\n")).into()) }
}

/// Rounds that a median needs.
const ROUNDS: usize = 5;

/// What was measured, with what, and how.
fn header(lines: &Lines) -> String {
    // Instructions are counted once: they do not vary.
    let timed = lines.rows.values().filter(|m| m.unit != "instructions");
    let rounds = timed.map(Measured::rounds).min().unwrap_or(0);
    let mut out = String::from(
        "# Performance\n\nMade by `scripts/performance`, which measures everything again; do not edit. Times are \
         medians of one thread on one core, peers taking turns, the same points for all, answers held against \
         a search through all triangles in the same run. A ratio is how many times faster embound is.\n\n",
    );
    let fact = |name: &str| lines.facts.get(name).map_or("unknown", String::as_str);
    let busy = fact("load").split(' ').next().and_then(|n| n.parse::<f64>().ok()).is_none_or(|load| load > 0.5);
    if busy {
        let load = fact("load");
        _ = writeln!(out, "**The machine was busy (load {load}): these figures are not final.**\n");
    }
    if rounds < ROUNDS {
        _ = writeln!(out, "**Fewer than {ROUNDS} rounds: these figures are not final.**\n");
    }
    for name in lines.facts.keys().filter(|name| *name != "load") {
        _ = writeln!(out, "- {name}: {}", fact(name));
    }
    _ = writeln!(out, "- rounds: {rounds} at least");
    for [name, version, what] in &lines.peers {
        _ = writeln!(out, "- {name} {version}: {what}");
    }
    for [name, reason] in &lines.skipped {
        _ = writeln!(out, "- {name} was skipped: {reason}");
    }
    out + POINTS
}

const POINTS: &str = "
Not asked: obvhs (rays and boxes only, no closest point) and nanoflann (the nearest vertex, which is not
the nearest point of the surface). Rust and C++ peers are built for this processor, embound as it ships.

Point sets: *uniform* in the bounding box scaled 1.5; *near*: on the surface, evenly by area, moved along the
triangle's normal by up to 1% of the diagonal; *grid*: a lattice over the box scaled 1.2, x fastest. `measure
points` writes them as bare numbers, for peers measured by hand.

";
