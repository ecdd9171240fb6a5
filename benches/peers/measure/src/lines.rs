// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines that all peers printed (`case/src/report.rs` says what they hold), gathered over the rounds.

use std::collections::BTreeMap;

/// One question of one peer on one case, in every round.
#[derive(Default)]
pub struct Measured {
    numbers: Vec<f64>,
    /// Rows that came before its first.
    pub place: usize,
    pub unit: String,
    /// Worst of all rounds, in diagonals; None where nothing is checked.
    pub worst: Option<f64>,
    pub wrong_signs: Option<usize>,
    tolerance: f64,
}

impl Measured {
    pub fn median(&self) -> f64 {
        let mut sorted = self.numbers.clone();
        sorted.sort_by(f64::total_cmp);
        let half = sorted.len() / 2;
        if sorted.len() % 2 == 1 { sorted[half] } else { 0.5 * (sorted[half - 1] + sorted[half]) }
    }

    pub fn rounds(&self) -> usize {
        self.numbers.len()
    }

    /// Whether every answer that was checked was right.
    pub fn holds(&self) -> bool {
        self.worst.is_none_or(|worst| worst <= self.tolerance) && self.wrong_signs.unwrap_or(0) == 0
    }
}

/// All of them.
#[derive(Default)]
pub struct Lines {
    /// Name and triangles, in the order they were measured.
    pub cases: Vec<(String, usize)>,
    /// Name, version and what it is, in the order they were measured.
    pub peers: Vec<[String; 3]>,
    /// Name and reason.
    pub skipped: Vec<[String; 2]>,
    pub facts: BTreeMap<String, String>,
    /// By case, question and peer.
    pub rows: BTreeMap<[String; 3], Measured>,
}

impl Lines {
    /// Reads the lines; one that is not understood is an error.
    pub fn read(text: &str) -> Result<Lines, String> {
        let mut lines = Lines::default();
        for (at, line) in text.lines().enumerate() {
            let fields: Vec<&str> = line.split('\t').collect();
            lines.add(&fields).ok_or_else(|| format!("line {}: {line}", at + 1))?;
        }
        Ok(lines)
    }

    fn add(&mut self, fields: &[&str]) -> Option<()> {
        match *fields {
            ["case", name, triangles, _] => self.cases.push((name.into(), triangles.parse().ok()?)),
            ["peer", name, version, what] => {
                let peer = [name, version, what].map(String::from);
                if !self.peers.contains(&peer) {
                    self.peers.push(peer);
                }
            }
            ["skipped", name, reason] => {
                let skipped = [name, reason].map(String::from);
                if !self.skipped.contains(&skipped) {
                    self.skipped.push(skipped);
                }
            }
            ["fact", name, text] => _ = self.facts.insert(name.into(), text.into()),
            ["row", case, question, peer, number, unit, worst, wrong, tolerance] => {
                let place = self.rows.len();
                let key = [case, question, peer].map(String::from);
                let row = self.rows.entry(key).or_insert_with(|| Measured { place, ..Measured::default() });
                row.numbers.push(number.parse().ok()?);
                row.unit = unit.into();
                if worst != "-" {
                    let worst: f64 = worst.parse().ok()?;
                    row.worst = Some(row.worst.map_or(worst, |before| before.max(worst)));
                    row.tolerance = tolerance.parse().ok()?;
                }
                if wrong != "-" {
                    let wrong: usize = wrong.parse().ok()?;
                    row.wrong_signs = Some(row.wrong_signs.map_or(wrong, |before| before.max(wrong)));
                }
            }
            _ => return None,
        }
        Some(())
    }

    pub fn get(&self, case: &str, question: &str, peer: &str) -> Option<&Measured> {
        self.rows.get(&[case, question, peer].map(String::from))
    }

    /// embound's median.
    pub fn ours(&self, case: &str, question: &str) -> Option<f64> {
        self.get(case, question, "embound").map(Measured::median)
    }

    /// Names of the peers that are not embound.
    pub fn others(&self) -> impl Iterator<Item = &str> {
        self.peers.iter().map(|p| p[0].as_str()).filter(|name| !name.starts_with("embound"))
    }

    /// The fastest of the others whose distances are right, and its median; wrong signs are forgiven.
    pub fn fastest(&self, case: &str, question: &str) -> Option<(&str, f64)> {
        let right = |m: &&Measured| m.worst.is_none_or(|worst| worst <= m.tolerance);
        let medians =
            self.others().filter_map(|peer| Some((peer, self.get(case, question, peer).filter(right)?.median())));
        medians.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// embound's rows that were wrong.
    pub fn faults(&self) -> Vec<String> {
        let ours = self.rows.iter().filter(|([_, _, peer], m)| peer.starts_with("embound") && !m.holds());
        ours.map(|([case, question, peer], m)| {
            format!("{case}, {question}, {peer}: worst error {:?}, wrong signs {:?}", m.worst, m.wrong_signs)
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_taken_and_faults_are_seen() {
        let row = |peer: &str, number: &str, worst: &str| {
            format!("row\tcube\tnear\t{peer}\t{number}\tns\t{worst}\t0\t1e-9\n")
        };
        let right = ["1e1", "3e1", "2e1"].map(|n| row("embound", n, "0e0")).concat();
        let text = format!("peer\tbvh\t1\tf64\n{right}{}", row("bvh", "4e1", "0e0"));
        let lines = Lines::read(&text).unwrap();
        assert_eq!(lines.ours("cube", "near"), Some(20.0));
        assert_eq!(lines.fastest("cube", "near"), Some(("bvh", 40.0)));
        assert!(lines.faults().is_empty());
        let wrong = Lines::read(&(text + &row("embound", "2e1", "1e-3"))).unwrap();
        assert_eq!(wrong.faults().len(), 1);
        assert!(Lines::read("what is this").is_err());
    }
}
