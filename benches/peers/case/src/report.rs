// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a peer prints: tab-separated lines that the table is made of, and the verdict on its answers.
//!
//! | line | fields |
//! |---|---|
//! | `peer` | name, version, what it is |
//! | `row` | case, question, peer, number, unit, worst error in diagonals, wrong signs, tolerance |
//! | `skipped` | name, reason |
//! | `fact` | name, text |
//!
//! A dash stands for what does not apply.

/// How answers compare with exact ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Largest difference of the magnitudes, in diagonals; infinite where an answer is NaN.
    pub worst: f64,
    /// Answers with the wrong sign, farther from the surface than the tolerance; None where none is given.
    pub wrong_signs: Option<usize>,
    /// What the worst error may be.
    pub tolerance: f64,
}

impl Verdict {
    /// Of (answer, exact) pairs.
    pub fn of(pairs: impl Iterator<Item = (f64, f64)>, diagonal: f64, signed: bool, tolerance: f64) -> Verdict {
        let mut verdict = Verdict { worst: 0.0, wrong_signs: signed.then_some(0), tolerance };
        for (got, exact) in pairs {
            let error = (got.abs() - exact.abs()).abs() / diagonal;
            verdict.worst = verdict.worst.max(if error.is_nan() { f64::INFINITY } else { error });
            if let Some(wrong) = &mut verdict.wrong_signs
                && exact.abs() > tolerance * diagonal
                && (got < 0.0) != (exact < 0.0)
            {
                *wrong += 1;
            }
        }
        verdict
    }

    /// Whether the answers are right.
    pub fn holds(&self) -> bool {
        self.worst <= self.tolerance && self.wrong_signs.unwrap_or(0) == 0
    }
}

/// Prints what a peer is.
pub fn peer(name: &str, version: &str, what: &str) {
    println!("peer\t{name}\t{version}\t{what}");
}

/// Prints one measurement.
pub fn row(case: &str, question: &str, peer: &str, number: f64, unit: &str, verdict: Option<Verdict>) {
    let (worst, wrong, tolerance) = match verdict {
        None => ("-".into(), "-".into(), "-".into()),
        Some(v) => (
            format!("{:e}", v.worst),
            v.wrong_signs.map_or("-".into(), |n| n.to_string()),
            format!("{:e}", v.tolerance),
        ),
    };
    println!("row\t{case}\t{question}\t{peer}\t{number:e}\t{unit}\t{worst}\t{wrong}\t{tolerance}");
}

/// The version of a package in the text of a Cargo.lock.
pub fn version<'a>(lock: &'a str, package: &str) -> &'a str {
    let name = format!("name = \"{package}\"\nversion = \"");
    lock.split_once(&name).and_then(|(_, rest)| rest.split('"').next()).unwrap_or("unknown")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_sees_errors_signs_and_missing_answers() {
        let of = |pairs: &[(f64, f64)], signed| Verdict::of(pairs.iter().copied(), 2.0, signed, 1e-9);
        assert!(of(&[(1.0, 1.0), (-0.5, -0.5)], true).holds());
        assert_eq!(of(&[(1.0, 1.25), (0.5, 0.5)], true).worst, 0.125);
        assert_eq!(of(&[(1.0, -1.0)], true).wrong_signs, Some(1));
        assert!(of(&[(1.0, -1.0)], false).holds());
        assert!(of(&[(1e-10, -1e-10)], true).holds());
        assert!(!of(&[(f64::NAN, 1.0), (1.0, 1.0)], true).holds());
    }

    #[test]
    fn a_version_is_that_of_the_lock() {
        assert_eq!(version("[[package]]\nname = \"bvh\"\nversion = \"0.13.0\"\n", "bvh"), "0.13.0");
        assert_eq!(version("", "bvh"), "unknown");
    }
}
