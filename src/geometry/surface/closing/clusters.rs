// SPDX-License-Identifier: MIT OR Apache-2.0
//! Clusters of caps: how they are made, and the winding number they add.

use super::expansion::Expansion;
use super::{Closing, Cluster, MOST_VISITS, Waiting};
use crate::error::{Result, try_with_capacity};
use crate::math::{Aabb, Vec3, length};
use crate::primitive::solid_angle::solid_angle;

/// Caps of a leaf.
const LEAF: usize = 4;

/// All directions.
const SPHERE: f64 = 4.0 * std::f64::consts::PI;

/// What the sum over clusters may leave out of the winding number, at first and at last; then no cluster stands for its
/// caps.
const TOLERANCES: [f64; 3] = [0.25, 0.01, 0.0];

/// The winding number may be off by so much when it is summed cap by cap, times the caps.
const ROUNDING: f64 = 1e-15;

/// Half of all directions, less rounding.
const HALF: f64 = 0.5 * SPHERE * (1.0 - 1e-9);

impl Closing {
    pub(super) fn over(mut corners: Vec<[Vec3; 3]>, loops: usize) -> Result<Closing> {
        let mut clusters = try_with_capacity("clusters", 2 * corners.len().div_ceil(LEAF / 2) + 1)?;
        cluster(&mut corners, 0, &mut clusters);
        Ok(Closing { corners: corners.into(), clusters: clusters.into(), loops })
    }

    /// Whether every point of a finite box sees the caps under less than half of all directions, so that they do not change
    /// which side it is on. None of them meets the box then.
    pub(crate) fn settles(&self, b: Aabb) -> bool {
        let mut waiting = Waiting::new();
        let (mut seen, mut visits) = (0.0, 0);
        while let Some(at) = waiting.pop() {
            let cluster = &self.clusters[at as usize];
            let (apart, area) = (gap(cluster.lo, cluster.hi, b), cluster.expansion.area);
            visits += 1;
            let is_small = (cluster.hi - cluster.lo).length_squared() <= apart;
            if is_small || (at == 0 && area < HALF * apart) {
                seen += area / apart;
            } else if cluster.second != 0 {
                waiting.push(at + 1, cluster.second);
            } else {
                for cap in cluster.first..cluster.first + cluster.count {
                    let corners @ [u, v, w] = self.corners(cap);
                    let own = Aabb::of(corners);
                    seen += 0.5 * length((v - u).cross(w - u)) / gap(own.lo, own.hi, b);
                }
            }
            // NaN, of a cap without area that is met, does not settle.
            if visits > MOST_VISITS || seen.is_nan() || seen >= HALF {
                return false;
            }
        }
        true
    }

    /// Whether all points of a finite box off the surface are on the same side of it as its middle, where the winding number
    /// with the caps is `winding`: along the way that of the surface alone changes by no more than L / (4 pi d^2) a
    /// length, for the edges of the boundary of length L at a distance d.
    pub(crate) fn is_one_sided(&self, b: Aabb, winding: i32) -> bool {
        let middle = b.center();
        let Some((caps, error)) = self.solid_angle(middle, 0.0) else { return false };
        let way = length(Vec3::max(b.hi - middle, middle - b.lo));
        // In solid angles, with room for rounding.
        let most = ((f64::from(winding) - 0.5) * SPHERE - caps).abs() * (1.0 - 1e-9) - error;
        let (mut change, mut visits) = (0.0, 0);
        let mut waiting = Waiting::new();
        while let Some(at) = waiting.pop() {
            let cluster = &self.clusters[at as usize];
            let apart = gap(cluster.lo, cluster.hi, b);
            visits += 1;
            if cluster.second != 0 && (cluster.hi - cluster.lo).length_squared() > apart {
                waiting.push(at + 1, cluster.second);
            } else if cluster.second != 0 {
                change += way * cluster.rim / apart;
            } else {
                for cap in cluster.first..cluster.first + cluster.count {
                    let [u, v, _] = self.corners(cap);
                    change += way * length(v - u) / gap(u.min(v), u.max(v), b);
                }
            }
            if visits > MOST_VISITS || change.is_nan() || change >= most {
                return false;
            }
        }
        true
    }

    /// Whether a point is inside where the winding number with the caps is `winding`: where that of the surface alone is at
    /// least 1/2. None on an edge of a cap.
    pub(crate) fn is_inside(&self, p: Vec3, winding: i32) -> Option<bool> {
        let alone = |caps: f64| f64::from(winding) - caps / SPHERE;
        let mut caps = 0.0;
        for tolerance in TOLERANCES {
            let (sum, error) = self.solid_angle(p, tolerance * SPHERE)?;
            caps = sum;
            if alone(sum + error) >= 0.5 || alone(sum - error) < 0.5 {
                break;
            }
        }
        Some(alone(caps) >= 0.5)
    }

    /// The solid angle of the caps, and how far off it may be, `tolerance` at most but for rounding.
    fn solid_angle(&self, p: Vec3, tolerance: f64) -> Option<(f64, f64)> {
        let share = tolerance / self.clusters[0].expansion.area;
        let (mut sum, mut error) = (0.0, 0.0);
        let mut waiting = Waiting::new();
        while let Some(at) = waiting.pop() {
            let cluster = &self.clusters[at as usize];
            let (angle, off) = cluster.expansion.solid_angle(p);
            if off <= share * cluster.expansion.area {
                sum += angle;
                error += off;
            } else if cluster.second != 0 {
                waiting.push(at + 1, cluster.second);
            } else {
                for cap in cluster.first..cluster.first + cluster.count {
                    sum += solid_angle(self.corners(cap), p)?;
                }
                error += f64::from(cluster.count) * ROUNDING * SPHERE;
            }
        }
        Some((sum, error))
    }
}

/// The least squared distance between two boxes.
fn gap(lo: Vec3, hi: Vec3, b: Aabb) -> f64 {
    Vec3::max(lo - b.hi, b.lo - hi).max(Vec3::ZERO).length_squared()
}

/// Adds the cluster of some caps, the first of which has this number, and those below it.
fn cluster(corners: &mut [[Vec3; 3]], first: u32, clusters: &mut Vec<Cluster>) {
    let (mut hull, mut middles) = (Aabb::EMPTY, Aabb::EMPTY);
    let middle = |t: &[Vec3; 3]| t[0] / 3.0 + t[1] / 3.0 + t[2] / 3.0;
    for t in corners.iter() {
        hull = hull.hull(Aabb::of(*t));
        middles = middles.hull(Aabb::of([middle(t)]));
    }
    let at = clusters.len();
    let expansion = Expansion::of(corners);
    let count = corners.len();
    let rim = corners.iter().map(|[u, v, _]| length(*v - *u)).sum();
    clusters.push(Cluster {
        lo: hull.lo,
        hi: hull.hi,
        expansion,
        first,
        count: count as u32,
        second: 0,
        unused: 0,
        rim,
    });
    if count <= LEAF {
        return;
    }
    let extent = middles.hi - middles.lo;
    let axis = (0..3).fold(0, |most, k| if extent[k] > extent[most] { k } else { most });
    let half = count / 2;
    // Of equal ones any order does: they are the same to every question but for the order of sums, which is fixed by the
    // input.
    corners.select_nth_unstable_by(half, |s, t| middle(s)[axis].total_cmp(&middle(t)[axis]));
    let (low, high) = corners.split_at_mut(half);
    cluster(low, first, clusters);
    clusters[at].second = clusters.len() as u32;
    cluster(high, first + half as u32, clusters);
}
