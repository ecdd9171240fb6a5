// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points along a curve that fills space (Morton 1966): neighbours one after another find the hierarchy's memory near.
//! No answer depends on it.

use super::{PointSource, check};
use crate::error::{Result, filled, try_with_capacity};
use crate::geometry::{Closest, Geometry};
use crate::math::{Aabb, MORTON_BITS, Vec3, morton};
use crate::parallel::Run;

/// What is said of a point.
pub(super) trait Answer: Copy + Send + Sync {
    fn of_value(value: f64) -> Self;
    fn value(&self) -> f64;
}

impl Answer for f64 {
    fn of_value(value: f64) -> f64 {
        value
    }

    fn value(&self) -> f64 {
        *self
    }
}

impl Answer for Closest {
    fn of_value(value: f64) -> Closest {
        Closest::only(value)
    }

    fn value(&self) -> f64 {
        self.value
    }
}

/// [`super::at_points`] in runs of up to `most` points, which `answer` gets in an order of their own; `emit` gets
/// what it answers in that of the source.
pub(super) fn at_sorted_points<T: Answer>(
    run: &Run,
    g: &Geometry,
    points: &dyn PointSource,
    most: usize,
    answer: &(dyn Fn(&[Vec3], &mut [T]) + Sync),
    emit: &(dyn Fn(usize, &mut [T]) + Sync),
) -> Result<()> {
    let count = points.count();
    run.for_each_chunk(count.div_ceil(most), &|chunk| {
        let first = chunk * most;
        let mut all = filled("points", most.min(count - first), Vec3::ZERO)?;
        points.load(first, &mut all);
        let order = order(&all)?;
        let mut sorted = try_with_capacity("points", all.len())?;
        sorted.extend(order.iter().map(|&k| all[k as u32 as usize]));
        let mut answers = filled("answers", all.len(), T::of_value(0.0))?;
        answer(&sorted, &mut answers);
        let mut placed = filled("answers", all.len(), T::of_value(0.0))?;
        order.iter().zip(&answers).for_each(|(&k, answer)| placed[k as u32 as usize] = *answer);
        for (answer, p) in placed.iter().zip(&all) {
            check(g, answer.value(), *p)?;
        }
        emit(first, &mut placed);
        Ok(())
    })
}

/// The points along the curve: codes in the upper, indices in the lower halves.
fn order(points: &[Vec3]) -> Result<Vec<u64>> {
    let bounds = Aabb::of(points.iter().copied().filter(|p| p.is_finite()));
    let scale = f64::from(1u32 << MORTON_BITS) / (bounds.hi - bounds.lo);
    let mut order = try_with_capacity("points", points.len())?;
    order.extend(points.iter().enumerate().map(|(k, p)| {
        // What is no number, or an extent of none, becomes zero.
        let at = ((*p - bounds.lo) * scale).to_array().map(|c| (c as u32).min((1 << MORTON_BITS) - 1));
        u64::from(morton(at)) << 32 | k as u64
    }));
    let mut other = filled("points", points.len(), 0)?;
    for pass in 0..3 {
        let digit = |code: &u64| (code >> (32 + MORTON_BITS * pass)) as usize & ((1 << MORTON_BITS) - 1);
        let mut start = [0; 1 << MORTON_BITS];
        order.iter().for_each(|code| start[digit(code)] += 1);
        start.iter_mut().fold(0, |sum, count| sum + std::mem::replace(count, sum));
        for code in &order {
            let slot = &mut start[digit(code)];
            other[*slot] = *code;
            *slot += 1;
        }
        std::mem::swap(&mut order, &mut other);
    }
    Ok(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_point_comes_once_and_neighbours_are_near() {
        let mut points: Vec<Vec3> = (0..4096)
            .map(|k: u64| {
                let at = k.wrapping_mul(0x9E37_79B9_7F4A_7C15);
                Vec3::new((at >> 52) as f64, (at >> 40 & 0xFFF) as f64, (at >> 28 & 0xFFF) as f64)
            })
            .collect();
        points.push(Vec3::NAN);
        points.push(Vec3::new(f64::INFINITY, 0.0, 0.0));
        let order: Vec<usize> = order(&points).unwrap().into_iter().map(|k| k as u32 as usize).collect();
        let mut seen = order.clone();
        seen.sort_unstable();
        assert_eq!(seen, (0..points.len()).collect::<Vec<_>>());
        let steps = |order: &[usize]| {
            let finite = order.windows(2).map(|w| points[w[0]].distance(points[w[1]])).filter(|d| d.is_finite());
            finite.sum::<f64>()
        };
        assert!(steps(&order) < 0.2 * steps(&(0..points.len()).collect::<Vec<_>>()));
    }

    #[test]
    fn one_place_is_no_trouble() {
        assert_eq!(order(&[Vec3::ONE; 3]).unwrap().len(), 3);
        assert!(order(&[]).unwrap().is_empty());
        assert_eq!(order(&[Vec3::NAN]).unwrap(), [0]);
    }
}
