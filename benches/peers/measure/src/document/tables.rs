// SPDX-License-Identifier: MIT OR Apache-2.0
//! The measured figures as tables.

use crate::lines::{Lines, Measured};
use case::SETS;

/// Every table of measurements.
pub fn all(lines: &Lines) -> String {
    [random(lines), accuracy(lines), solver(lines), building(lines), centre(lines)].concat()
}

/// A markdown table under a heading; nothing where there are no rows.
pub fn table(heading: &str, columns: &[String], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = format!("|{}\n", "---|".repeat(columns.len()));
    let body: String = rows.iter().map(|row| line(row)).collect();
    format!("## {heading}\n\n{}{rule}{body}\n", line(columns))
}

/// A number to three digits.
pub fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let digits = x.abs().log10().floor() as i32;
    if !(-3..9).contains(&digits) {
        return format!("{x:.2e}");
    }
    if digits < 2 {
        return format!("{x:.*}", (2 - digits) as usize);
    }
    let unit = 10f64.powi(digits - 2);
    let whole = format!("{}", ((x / unit).round() * unit) as u64);
    let groups: Vec<&str> = whole.as_bytes().rchunks(3).rev().map(|g| str::from_utf8(g).unwrap_or("")).collect();
    groups.join(",")
}

/// How many times as much `theirs` is.
pub fn ratio(theirs: Option<f64>, ours: Option<f64>) -> String {
    match (theirs, ours) {
        (Some(theirs), Some(ours)) => format!("{}x", short(theirs / ours)),
        _ => "-".into(),
    }
}

fn cell(measured: Option<&Measured>) -> String {
    measured.map_or("-".into(), |m| format!("{}{}", short(m.median()), if m.holds() { "" } else { "*" }))
}

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| name.to_string()).collect()
}

fn random(lines: &Lines) -> String {
    let mut columns = names(&["mesh", "set", "embound", "in one call", "compact, in one call", "closest, in one call"]);
    columns.extend(lines.others().map(String::from));
    columns.extend(names(&["fastest peer", "ratio", "ratio in one call"]));
    let mut rows = Vec::new();
    for (case, triangles) in &lines.cases {
        for set in SETS {
            let ours = ["embound", "embound-batch", "embound-compact", "embound-closest"]
                .map(|peer| lines.get(case, set, peer));
            let mut row = vec![format!("{case}, {triangles}"), set.to_string()];
            row.extend(ours.map(cell));
            row.extend(lines.others().map(|peer| cell(lines.get(case, set, peer))));
            let fastest = lines.fastest(case, set);
            row.push(fastest.map_or("-".into(), |(peer, _)| peer.into()));
            row.extend([0, 1].map(|k| ratio(fastest.map(|f| f.1), ours[k].map(Measured::median))));
            rows.push(row);
        }
    }
    let note = "An asterisk: answers were wrong, see the next table. One whose distances were wrong is not \"fastest\". \
                Compact: `EMB_ACCELERATOR_COMPACT`, the same answers in less memory. Closest: with the point, the \
                gradient, the triangle and its tag.\n\n";
    table("Distance at given points, ns a point", &columns, &rows) + note
}

/// Worst error over all sets, and wrong signs among the points that were checked.
fn accuracy(lines: &Lines) -> String {
    let peers: Vec<&str> = std::iter::once("embound").chain(lines.others()).collect();
    let mut rows = Vec::new();
    for (case, _) in &lines.cases {
        let mut row = vec![case.clone()];
        for peer in &peers {
            let asked: Vec<&Measured> = SETS.iter().filter_map(|set| lines.get(case, set, peer)).collect();
            let worst = asked.iter().filter_map(|m| m.worst).fold(0.0, f64::max);
            let wrong: Option<usize> = asked.iter().map(|m| m.wrong_signs).sum();
            row.push(match (asked.is_empty(), wrong) {
                (true, _) => "-".into(),
                (_, None) => format!("{worst:.1e}"),
                (_, Some(wrong)) => format!("{worst:.1e}, {wrong}"),
            });
        }
        rows.push(row);
    }
    let mut columns = vec!["mesh".to_owned()];
    columns.extend(peers.iter().map(|peer| peer.to_string()));
    table("Worst error in diagonals, and wrong signs at the points checked", &columns, &rows)
}

/// What only embound answers, beside the fastest peer asked point by point.
fn solver(lines: &Lines) -> String {
    let mut rows = Vec::new();
    for (case, _) in &lines.cases {
        let peer = lines.fastest(case, "grid");
        let is_ours = |[c, question, peer]: &[String; 3]| c == case && peer == "embound" && is_query(question);
        let mut ours: Vec<_> = lines.rows.iter().filter(|(key, _)| is_ours(key)).collect();
        ours.sort_by_key(|(_, m)| m.place);
        for ([_, question, _], m) in ours {
            let is_fill = question.starts_with("fill");
            let against = if is_fill { ratio(peer.map(|p| p.1), Some(m.median())) } else { "-".into() };
            rows.push(vec![case.clone(), question.clone(), cell(Some(m)), m.unit.clone(), against]);
        }
    }
    let note = "Fills: ns a point of a lattice of that many points an axis over the box scaled 1.2, beside the fastest \
                peer on the grid set; the band is two cells wide, and signs are written as doubles or as bytes (i8). \
                Crossings: ns an edge, of all edges along the three axes; intercepts: the crossed ones among them, asked \
                for as segments. Boxes of 32^3 cells of 256^3: far ones lie farther from the surface than their corners \
                from their centre. Two threads: how many times faster than one.\n\n";
    let columns = names(&["mesh", "question", "embound", "unit", "ratio to the fastest peer"]);
    let table = table("Lattices, boxes and edges", &columns, &rows);
    if table.is_empty() { table } else { table + note }
}

fn is_query(question: &str) -> bool {
    ["fill", "classify", "crossings", "intercept", "two threads", "instructions"]
        .iter()
        .any(|k| question.starts_with(k))
}

fn building(lines: &Lines) -> String {
    let mut columns = names(&[
        "mesh",
        "read STL",
        "read STL and build",
        "build",
        "compact: build",
        "refit, checked",
        "refit, trusted",
        "B a triangle",
        "compact: B a triangle",
    ]);
    columns.extend(lines.others().map(|peer| format!("{peer}: build")));
    let rows: Vec<Vec<String>> = lines
        .cases
        .iter()
        .map(|(case, triangles)| {
            let ours = [
                "read STL",
                "read STL and build",
                "build",
                "build, compact",
                "refit checked",
                "refit trusted",
                "memory",
                "memory, compact",
            ];
            let mut row = vec![format!("{case}, {triangles}")];
            row.extend(ours.map(|question| cell(lines.get(case, question, "embound"))));
            row.extend(lines.others().map(|peer| cell(lines.get(case, "build", peer))));
            row
        })
        .collect();
    let note = "Refit: to vertices that have moved, with and without a look for faces that meet each other. Memory is all \
                that the geometry holds, the corners and normals of the triangles included.\n\n";
    let table = table("Reading, building and refitting, seconds; memory", &columns, &rows);
    if table.is_empty() { table } else { table + note }
}

/// The centre of a sphere beside looking at every triangle.
fn centre(lines: &Lines) -> String {
    let mut rows = Vec::new();
    for (case, triangles) in &lines.cases {
        let [all, exact, near] =
            ["centre, every triangle", "centre", "centre within 1e-6"].map(|q| lines.ours(case, q));
        if let (Some(all), Some(exact), Some(near)) = (all, exact, near) {
            let mut row = vec![triangles.to_string()];
            row.extend([all, exact, near].map(|ns| short(ns / 1e3)));
            row.extend([exact, near].map(|ns| ratio(Some(ns), Some(all))));
            row.extend(
                ["centre, leaves in all", "centre, leaves visited", "centre within 1e-6, leaves visited"]
                    .map(|q| lines.ours(case, q).map_or("-".into(), short)),
            );
            rows.push(row);
        }
    }
    let columns = [
        "triangles",
        "every triangle",
        "at the centre",
        "within 1e-6 of it",
        "centre / every",
        "within / every",
        "leaves",
        "visited at the centre",
        "visited within 1e-6",
    ];
    let note = "All triangles of an icosphere are nearly as near to its centre, so that no box can be left out. Every \
                triangle: the plain loop over all of them. A leaf holds up to eight triangles.\n\n";
    let table = table("The worst case: the centre of a sphere, us a query", &names(&columns), &rows);
    if table.is_empty() { table } else { table + note }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_keep_three_digits() {
        let cases =
            [(1234567.0, "1,230,000"), (999.6, "1,000"), (12.345, "12.3"), (0.012345, "0.0123"), (100.0, "100")];
        for (number, text) in cases {
            assert_eq!(short(number), text);
        }
    }
}
