// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether the triangles round a vertex keep clear of each other, proved at once: seen along a line through the
//! vertex they lie in wedges that follow one another and go round less than once, or once and meet. An
//! orientation test in the manner of Shewchuk (1997) for each wedge, with his bound on its rounding; one that
//! comes out too small proves nothing.

use crate::math::{Vec3, length};

/// Shewchuk's bound for a determinant of differences, rounded up.
const BOUND: f64 = 8.0 * f64::EPSILON;

/// Whether the triangles between the vertex and the ends of two spokes that follow one another, and, where `closed`, of the
/// last and the first spoke, are proved to meet in nothing but the edges and the vertex that neighbours share, and
/// whether the ends of the spokes are farther than `slack` from all the triangles that they are no corners of.
/// Spokes lead from the vertex. False proves nothing.
pub(crate) fn is_clear(spokes: &[Vec3], closed: bool, slack: f64) -> bool {
    let count = spokes.len();
    if count < 2 {
        return false;
    }
    let spoke = |k: usize| spokes[k];
    let wedges = if closed { count } else { count - 1 };
    let next = |k: usize| if k + 1 == count { 0 } else { k + 1 };
    let (mut axis, mut reach) = (Vec3::ZERO, 0.0f64);
    for k in 0..wedges {
        axis += spoke(k).cross(spoke(next(k)));
    }
    for k in 0..count {
        reach = reach.max(spoke(k).abs().max_element());
    }
    // The lengths of spokes are at most 1.8 times their largest components; a determinant over the length of the
    // axis and of a spoke is the distance of one spoke's end from the plane of the other.
    let margin = 4.0 * slack * length(axis) * reach;
    // Determinants below the range of f64 prove nothing.
    let least = margin.max(1e-280);
    let turn = |p: Vec3, q: Vec3| {
        let (xy, yx) = (p.x * q.y, p.y * q.x);
        let (yz, zy) = (p.y * q.z, p.z * q.y);
        let (zx, xz) = (p.z * q.x, p.x * q.z);
        let determinant = axis.x * (yz - zy) + axis.y * (zx - xz) + axis.z * (xy - yx);
        let permanent = axis.x.abs() * (yz.abs() + zy.abs())
            + axis.y.abs() * (zx.abs() + xz.abs())
            + axis.z.abs() * (xy.abs() + yx.abs());
        (determinant, BOUND * permanent + least)
    };
    let first = spoke(0);
    // On which side of the first spoke the spoke at hand lies: 1 left of it, -1 right of it, 0 not proved.
    let side = |(determinant, bound): (f64, f64)| i32::from(determinant > bound) - i32::from(determinant < -bound);
    let mut from = first;
    let mut at = 0;
    for k in 0..wedges {
        let to = spoke(next(k));
        let (determinant, bound) = turn(from, to);
        // What is no number proves nothing either.
        if determinant <= bound || determinant.is_nan() || bound.is_nan() {
            return false;
        }
        if k + 1 < count {
            let beyond = side(turn(first, to));
            // A wedge that holds the first spoke: the fan has come round.
            if k > 0 && at != 1 && beyond != -1 {
                return false;
            }
            at = beyond;
        }
        from = to;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clear(center: Vec3, ring: &[Vec3], closed: bool, slack: f64) -> bool {
        let spokes: Vec<Vec3> = ring.iter().map(|p| p - center).collect();
        is_clear(&spokes, closed, slack)
    }

    /// Points at these turns round the z axis, on a cone.
    fn ring(turns: &[f64]) -> Vec<Vec3> {
        let at = |t: &f64| {
            let a = std::f64::consts::TAU * t.rem_euclid(1.0);
            Vec3::new(libm::cos(a), libm::sin(a), -0.3)
        };
        turns.iter().map(at).collect()
    }

    #[test]
    fn fans_and_discs_are_clear_whichever_way_they_turn() {
        for turns in [&[0.0, 0.2][..], &[0.1, 0.3, 0.5, 0.9], &[0.7, 0.9, 1.2, 1.5], &[0.0, 0.4, 0.8, 0.99]] {
            assert!(clear(Vec3::ZERO, &ring(turns), false, 1e-9), "{turns:?}");
            let back: Vec<f64> = turns.iter().rev().copied().collect();
            assert!(clear(Vec3::ZERO, &ring(&back), false, 1e-9), "{back:?}");
        }
        for turns in [&[0.0, 0.3, 0.6][..], &[0.1, 0.2, 0.3, 0.6, 0.9], &[0.25, 0.5, 0.75, 1.0]] {
            assert!(clear(Vec3::ZERO, &ring(turns), true, 1e-9), "{turns:?}");
        }
        // The corner of a cube, whose faces project to nothing along the axes.
        let corner = [Vec3::X, Vec3::X + Vec3::Y, Vec3::Y, Vec3::Y + Vec3::Z, Vec3::Z, Vec3::Z + Vec3::X];
        assert!(clear(Vec3::ZERO, &corner, true, 1e-9));
    }

    #[test]
    fn folds_and_fans_that_come_round_again_are_not() {
        for turns in [&[0.0, 0.2, 0.1][..], &[0.0, 0.4, 0.8, 1.2], &[0.0, 0.4, 0.8, 1.2, 1.6]] {
            assert!(!clear(Vec3::ZERO, &ring(turns), false, 0.0), "{turns:?}");
        }
        // Once round, to the bits of the first spoke; a whole turn through sine and cosine falls short of it.
        let mut round = ring(&[0.0, 0.4, 0.8]);
        round.push(round[0]);
        assert!(!clear(Vec3::ZERO, &round, false, 0.0));
        // Twice round, closed, with and without a spoke that repeats the first.
        assert!(!clear(Vec3::ZERO, &ring(&[0.0, 0.4, 0.8, 1.2, 1.6]), true, 0.0));
        assert!(!clear(Vec3::ZERO, &ring(&[0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75]), true, 0.0));
        // Flat triangles.
        assert!(!clear(Vec3::ZERO, &ring(&[0.0, 0.0, 0.4, 0.8]), true, 0.0));
        assert!(!clear(Vec3::ZERO, &[Vec3::X, -Vec3::X], false, 0.0));
    }

    #[test]
    fn what_is_nearer_than_the_slack_is_not_clear() {
        let narrow = ring(&[0.0, 0.4, 0.8, 1.0 - 1e-6]);
        assert!(clear(Vec3::ZERO, &narrow, false, 1e-8) && !clear(Vec3::ZERO, &narrow, false, 1e-5));
        let thin = ring(&[0.0, 1e-6, 0.4, 0.8]);
        assert!(clear(Vec3::ZERO, &thin, true, 1e-8) && !clear(Vec3::ZERO, &thin, true, 1e-5));
    }
}
