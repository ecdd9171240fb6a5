// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whole lattices against their points and edges, one by one.

use super::Soup;
use super::edges::crossings;
use super::random::Random;
use embound::geometry::Geometry;
use embound::math::Vec3;
use embound::parallel::Run;
use embound::query::{self, CrossingForm, FillMode, Lattice};
use std::sync::Mutex;

pub type Axes = [Vec<f64>; 3];

pub fn even(n: usize, lo: f64, hi: f64) -> Vec<f64> {
    (0..n).map(|k| lo + (hi - lo) * k as f64 / (n.max(2) - 1) as f64).collect()
}

pub fn around(body: &Soup, n: [usize; 3], factor: f64) -> Axes {
    let (lo, hi) = body.bounds();
    std::array::from_fn(|k| {
        let (middle, half) = (0.5 * (lo[k] + hi[k]), 0.5 * factor * (hi[k] - lo[k]));
        even(n[k], middle - half, middle + half)
    })
}

/// Axes through so many vertices, with a double or two beside each.
pub fn through(body: &Soup, count: usize, random: &mut Random) -> Axes {
    std::array::from_fn(|axis| {
        let vertex = |random: &mut Random| body.vertices[random.below(body.vertices.len())][axis];
        let mut at: Vec<f64> = (0..count).map(|_| vertex(random)).collect();
        for _ in 0..count / 3 {
            let c = vertex(random);
            at.extend([c.next_up(), c.next_down(), 0.5 * (c + vertex(random))].iter().filter(|c| c.abs() > 1e-300));
        }
        at.sort_by(f64::total_cmp);
        if random.below(2) == 0 {
            at.reverse();
        }
        at
    })
}

pub fn signs(g: &Geometry, axes: &Axes, run: &Run) -> Vec<i8> {
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).unwrap();
    let n = lattice.n();
    let out = Mutex::new(vec![i8::MAX; n[0] * n[1] * n[2]]);
    query::fill_signs(g, &lattice, run, &|[i, j, k], signs| {
        let from = i + n[0] * (j + n[1] * k);
        out.lock().unwrap()[from..from + signs.len()].copy_from_slice(signs);
    })
    .unwrap();
    out.into_inner().unwrap()
}

pub fn banded(g: &Geometry, axes: &Axes, band: f64, run: &Run) -> Vec<f64> {
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).unwrap();
    let n = lattice.n();
    let out = Mutex::new(vec![f64::NAN; n[0] * n[1] * n[2]]);
    query::fill(g, &lattice, FillMode::Band(band), run, &|[i, j, k], values| {
        let from = i + n[0] * (j + n[1] * k);
        out.lock().unwrap()[from..from + values.len()].copy_from_slice(values);
    })
    .unwrap();
    out.into_inner().unwrap()
}

/// How many edges of a lattice meet the surface, after comparing every sign and every edge with single ones.
#[track_caller]
pub fn compared(g: &Geometry, axes: &Axes) -> usize {
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).unwrap();
    let n = lattice.n();
    let point = |at: [usize; 3]| Vec3::new(axes[0][at[0]], axes[1][at[1]], axes[2][at[2]]);
    let points = (0..n[0] * n[1] * n[2]).map(|e| point([e % n[0], e / n[0] % n[1], e / n[0] / n[1]]));
    let values: Vec<(Vec3, f64)> = points.map(|p| (p, g.value(p))).collect();
    for ((p, value), sign) in values.iter().zip(signs(g, axes, &Run::SERIAL)) {
        assert_eq!(f64::from(sign), if *value == 0.0 { 0.0 } else { value.signum() }, "{p}: {value}");
    }
    // Of the values from the least to the greatest: by leaves and by tiles, where that costs less.
    let mut magnitudes: Vec<f64> = values.iter().map(|(_, v)| v.abs()).filter(|v| *v > 0.0 && *v < 1e100).collect();
    magnitudes.sort_by(f64::total_cmp);
    let some =
        [0, 10, 3, 1].map(|part| magnitudes.len().checked_sub(1).map_or(1.0, |last| magnitudes[last * part / 10]));
    for band in some.into_iter().chain([magnitudes.last().map_or(1.0, |most| 1e4 * most)]) {
        for ((p, value), given) in values.iter().zip(banded(g, axes, band, &Run::SERIAL)) {
            let wanted = if value.abs() < band { *value } else { band.copysign(*value) };
            assert_eq!(given.to_bits(), wanted.to_bits(), "{p}, band {band}: {given} instead of {wanted}");
        }
    }
    let mut met = 0;
    for axis in 0..3 {
        let mut n = n;
        n[axis] = n[axis].saturating_sub(1);
        let (mut from, mut to) = (Vec::new(), Vec::new());
        for e in 0..n[0] * n[1] * n[2] {
            let at = [e % n[0], e / n[0] % n[1], e / n[0] / n[1]];
            let mut next = at;
            next[axis] += 1;
            from.extend(point(at).to_array());
            to.extend(point(next).to_array());
        }
        let places = crossings(g, &lattice, axis, CrossingForm::Coordinate, &Run::SERIAL);
        let fractions = crossings(g, &lattice, axis, CrossingForm::Fraction, &Run::SERIAL);
        query::intercepts(g, &from, &to, &Run::SERIAL, &|start, hits| {
            for (k, hit) in (start..).zip(hits) {
                let (fraction, place) = (fractions[k], places[k]);
                let edge = (axis, &from[3 * k..3 * k + 3], &to[3 * k..3 * k + 3]);
                assert_eq!(fraction.at.to_bits(), hit.t.to_bits(), "{edge:?}: {fraction:?} {hit:?}");
                assert_eq!((fraction.count, fraction.tag, fraction.part), (hit.count, hit.tag, hit.part), "{edge:?}");
                assert_eq!((place.count, place.tag, place.part), (hit.count, hit.tag, hit.part));
                assert_eq!(place.at.is_nan(), hit.t.is_nan());
                let (low, high) = (edge.1[axis].min(edge.2[axis]), edge.1[axis].max(edge.2[axis]));
                let t = if edge.1[axis] > edge.2[axis] { 1.0 - hit.t } else { hit.t };
                // The coordinate comes from the fraction counted from the lower end.
                let off = (place.at - (low + (high - low) * t)).abs();
                assert!(place.at.is_nan() || (low <= place.at && place.at <= high), "{edge:?}: {place:?}");
                assert!(place.at.is_nan() || off <= 1e-15 * low.abs().max(high.abs()), "{edge:?}: {off}");
            }
        })
        .unwrap();
        met += fractions.iter().filter(|c| c.count > 0).count();
    }
    met
}
