// SPDX-License-Identifier: MIT OR Apache-2.0
//! The targets, what has been reached of them, and the figures measured by hand that they need.

use crate::document::{ratio, short, table};
use crate::lines::Lines;
use case::SETS;

const READ_AND_BUILD: &str = "read STL and build";

/// The one that the targets name.
const BY_HAND: &str = "EBGeometry";

/// Figures of peers that no registry has: peer, question, case, number, unit.
pub struct ByHand(Vec<[String; 5]>);

impl ByHand {
    pub fn read(text: &str) -> Result<ByHand, String> {
        let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        let fields = lines.map(|line| {
            let fields: Vec<String> = line.split('\t').map(String::from).collect();
            fields.try_into().map_err(|_| format!("not five fields: {line}"))
        });
        fields.collect::<Result<_, _>>().map(ByHand)
    }

    fn get(&self, peer: &str, question: &str, case: &str) -> Option<f64> {
        let found = self.0.iter().find(|[p, q, c, ..]| p.starts_with(peer) && q == question && c == case)?;
        found[3].parse().ok()
    }

    /// The figures as a table of the document.
    pub fn section(&self) -> String {
        let questions = [SETS[0], SETS[1], SETS[2], READ_AND_BUILD];
        let mut rows: Vec<Vec<String>> = Vec::new();
        for [peer, _, case, ..] in &self.0 {
            if rows.iter().all(|row| row[..2] != [peer.clone(), case.clone()]) {
                let cells = questions.map(|q| self.get(peer, q, case).map_or("-".into(), short));
                rows.push([peer.clone(), case.clone()].into_iter().chain(cells).collect());
            }
        }
        let columns = ["peer", "mesh", "uniform, ns", "near, ns", "grid, ns", "read STL and build, s"];
        table("Measured by hand, July 2026", &columns.map(String::from), &rows)
            + "EBGeometry and TriangleMeshDistance are in no registry. They were measured by hand in July 2026, on \
               one core of a Zen 4, built with -O3 -march=native, EBGeometry as \
               `Parser::readIntoTriangleBVH<double, short>(file, 4, BVH::Build::SAH)`; nothing here builds them. A \
               ratio to them is one between two runs, and no more than an indication.\n"
    }
}

/// One line of the table of targets.
struct Target {
    path: String,
    at_least: &'static str,
    aim: &'static str,
    peer: String,
    ours: Option<(f64, &'static str)>,
    ratio: String,
}

/// Every target with what has been reached.
pub fn section(lines: &Lines, by_hand: &ByHand) -> String {
    let mut targets = Vec::new();
    let meshes = lines.cases.iter().map(|(case, _)| case.as_str());
    for case in meshes.filter(|case| !case.starts_with("icosphere")) {
        points(&mut targets, lines, by_hand, case);
        lattices(&mut targets, lines, by_hand, case);
        build(&mut targets, lines, by_hand, case);
    }
    whole(&mut targets, lines);
    let rows: Vec<Vec<String>> = targets
        .into_iter()
        .map(|t| {
            let ours = t.ours.map_or("not there yet".into(), |(number, unit)| format!("{} {unit}", short(number)));
            vec![t.path, t.at_least.into(), t.aim.into(), t.peer, ours, t.ratio]
        })
        .collect();
    let columns = ["path", "at least", "aim", "peer", "embound", "ratio"].map(String::from);
    table("Targets", &columns, &rows)
}

fn points(targets: &mut Vec<Target>, lines: &Lines, by_hand: &ByHand, case: &str) {
    for (set, at_least, aim) in [(SETS[0], "5x", "15x"), (SETS[1], "3x", "8x")] {
        let Some(ours) = lines.ours(case, set) else { continue };
        targets.push(beside(
            format!("{case}, random point, {set}"),
            [at_least, aim],
            (ours, "ns"),
            &peers(lines, by_hand, case, set),
        ));
    }
}

/// The fastest peer of this run, and the one measured by hand.
fn peers<'a>(lines: &'a Lines, by_hand: &ByHand, case: &str, set: &str) -> Vec<(&'a str, f64)> {
    let by_hand = by_hand.get(BY_HAND, set, case).map(|ns| ("EBGeometry by hand", ns));
    lines.fastest(case, set).into_iter().chain(by_hand).collect()
}

/// A target that is a ratio to peers.
fn beside(
    path: String,
    [at_least, aim]: [&'static str; 2],
    ours: (f64, &'static str),
    peers: &[(&str, f64)],
) -> Target {
    let joined = |cell: &dyn Fn(&(&str, f64)) -> String| peers.iter().map(cell).collect::<Vec<_>>().join("; ");
    let peer = joined(&|(peer, ns)| format!("{peer} {}", short(*ns)));
    let ratio = joined(&|(_, ns)| ratio(Some(*ns), Some(ours.0)));
    Target { path, at_least, aim, peer, ours: Some(ours), ratio }
}

fn lattices(targets: &mut Vec<Target>, lines: &Lines, by_hand: &ByHand, case: &str) {
    let fills = [
        ("exact", 96, "8x", "20x"),
        ("exact", 192, "20x", "60x"),
        ("band", 192, "100x", "1,000x"),
        ("sign", 192, "100x", "1,000x"),
        ("sign, i8", 192, "100x", "1,000x"),
    ];
    for (mode, n, at_least, aim) in fills {
        let Some(ours) = lines.ours(case, &format!("fill {mode} {n}")) else { continue };
        let path = format!("{case}, {mode} fill, {n}^3");
        let peers = peers(lines, by_hand, case, SETS[2]);
        targets.push(beside(path, [at_least, aim], (ours, "ns a point"), &peers));
    }
    let all = lines.ours(case, "fill sign, i8 256").zip(lines.ours(case, "crossings 256"));
    let seconds = all.map(|(sign, edge)| (sign * 256f64.powi(3) + edge * 3.0 * 256.0 * 256.0 * 255.0) * 1e-9);
    targets.push(absolute(format!("{case}, signs and all crossings, 256^3"), "0.2 s", "40 ms", seconds, 0.2, "s"));
    let far = lines.ours(case, "classify far");
    targets.push(absolute(format!("{case}, classify a 32^3 box far away"), "1,000 ns", "20 ns", far, 1_000.0, "ns"));
}

/// A target that is no ratio to a peer.
fn absolute(
    path: String,
    at_least: &'static str,
    aim: &'static str,
    ours: Option<f64>,
    limit: f64,
    unit: &'static str,
) -> Target {
    let reached = ours.map_or("-".into(), |ours| if ours <= limit { "reached".into() } else { "missed".into() });
    Target { path, at_least, aim, peer: "-".into(), ours: ours.map(|ours| (ours, unit)), ratio: reached }
}

fn build(targets: &mut Vec<Target>, lines: &Lines, by_hand: &ByHand, case: &str) {
    let ours = lines.ours(case, READ_AND_BUILD);
    if let Some(theirs) = by_hand.get(BY_HAND, READ_AND_BUILD, case) {
        targets.push(Target {
            path: format!("{case}, read STL and build"),
            at_least: "10x",
            aim: "30 ms for 100k",
            peer: format!("EBGeometry by hand {} s", short(theirs)),
            ours: ours.map(|s| (s, "s")),
            ratio: ratio(Some(theirs), ours),
        });
    }
    let memory = lines.ours(case, "memory");
    targets.push(absolute(format!("{case}, memory"), "250 B", "100 B", memory, 250.0, "B a triangle"));
    let found = lines.rows.keys().filter(|[c, question, _]| c == case && question.starts_with("two threads, fill"));
    for [_, question, _] in found {
        let speedup = lines.ours(case, question);
        let (at_least, limit) = if question.contains("exact") { ("1.9x", 1.9) } else { ("1.4x", 1.4) };
        // More is better here.
        let reached = if speedup >= Some(limit) { "reached" } else { "missed" };
        let path = format!("{case}, {question}");
        let ours = speedup.map(|s| (s, "times"));
        targets.push(Target { path, at_least, aim: "2x", peer: "-".into(), ours, ratio: reached.into() });
    }
}

/// What belongs to no mesh, and what there is nothing of yet.
fn whole(targets: &mut Vec<Target>, lines: &Lines) {
    let balls = lines.ours("balls-64000", "uniform");
    targets.push(absolute("union of 64,000 balls, a query".into(), "5x EBGeometry", "150 ns", balls, 150.0, "ns"));
    let large = lines.ours("icosphere-10000000", READ_AND_BUILD);
    let large = large.map(|s| (s, "s to read and build"));
    targets.push(Target {
        path: "10 M triangles (`--large`)".into(),
        at_least: "within 6 GB (`cargo bench --bench large`)",
        aim: "linear",
        peer: "-".into(),
        ratio: "-".into(),
        ours: large,
    });
    for (path, at_least, aim) in [
        ("EB2::Build through the adapter, 256^3", "10x AMReX's STL reader", "1.3x the sphere's time"),
        ("area of the bunny, 100^3", "1,000x ArEst, 99.9%", "milliseconds, 99.99%"),
    ] {
        let path = path.into();
        targets.push(Target { path, at_least, aim, peer: "-".into(), ours: None, ratio: "-".into() });
    }
}
