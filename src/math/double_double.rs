// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cross and triple products carried in twice the precision, for the normals of slivers (Dekker 1971).

use super::Vec3;

#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a;
    let hi = c - (c - a);
    (hi, a - hi)
}

#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// `(a.0 + a.1) * (b.0 + b.1)`, the last product left out.
#[inline(always)]
fn multiply(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (p, e) = two_product(a.0, b.0);
    two_sum(p, e + (a.0 * b.1 + a.1 * b.0))
}

#[inline(always)]
fn subtract(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (s, e) = two_sum(a.0, -b.0);
    two_sum(s, e + (a.1 - b.1))
}

/// `(b - a) x (c - a)` with a relative error near the last digit even for slivers, where plain
/// arithmetic cancels. Magnitudes from 1e-100 to 1e100 neither overflow nor underflow.
pub fn cross_of_differences(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let d = |p: f64, q: f64| two_sum(p, -q);
    let (ux, uy, uz) = (d(b.x, a.x), d(b.y, a.y), d(b.z, a.z));
    let (vx, vy, vz) = (d(c.x, a.x), d(c.y, a.y), d(c.z, a.z));
    let minor = |p, q, r, s| {
        let (hi, lo) = subtract(multiply(p, q), multiply(r, s));
        hi + lo
    };
    Vec3::new(minor(uy, vz, uz, vy), minor(uz, vx, ux, vz), minor(ux, vy, uy, vx))
}

/// `(b - a) x (c - a) . (d - a)` for several points d, with an error of about 1e-30 of its largest terms. Not finite
/// where its terms are beyond 1e290.
#[inline]
pub fn volumes_of_differences<const N: usize>(a: Vec3, b: Vec3, c: Vec3, d: [Vec3; N]) -> [f64; N] {
    let from_a = |p: Vec3| -> Twice3 { [two_sum(p.x, -a.x), two_sum(p.y, -a.y), two_sum(p.z, -a.z)] };
    let (u, v) = (from_a(b), from_a(c));
    let minor = |i: usize, j: usize| subtract(multiply(u[i], v[j]), multiply(u[j], v[i]));
    let area = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let add = |p: Twice, q: Twice| subtract(p, (-q.0, -q.1));
    d.map(|d| {
        let w = from_a(d);
        let (hi, lo) = add(add(multiply(area[0], w[0]), multiply(area[1], w[1])), multiply(area[2], w[2]));
        hi + lo
    })
}

/// With n = `(b - a) x (c - a)`, what n has in common with `a - origin` and with `direction`: as precise as
/// [`volumes_of_differences`]. Their ratio is where the ray meets the plane.
#[inline]
pub fn plane_and_ray(a: Vec3, b: Vec3, c: Vec3, origin: Vec3, direction: Vec3) -> [f64; 2] {
    let between = |p: Vec3, q: Vec3| -> Twice3 { [two_sum(p.x, -q.x), two_sum(p.y, -q.y), two_sum(p.z, -q.z)] };
    let (u, v, w) = (between(b, a), between(c, a), between(a, origin));
    let minor = |i: usize, j: usize| subtract(multiply(u[i], v[j]), multiply(u[j], v[i]));
    let area = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let add = |p: Twice, q: Twice| subtract(p, (-q.0, -q.1));
    let across = |w: Twice3| {
        let (hi, lo) = add(add(multiply(area[0], w[0]), multiply(area[1], w[1])), multiply(area[2], w[2]));
        hi + lo
    };
    // (No `map`, which is not always inlined.)
    [across(w), across([(direction.x, 0.0), (direction.y, 0.0), (direction.z, 0.0)])]
}

/// A number as a sum of two.
type Twice = (f64, f64);
type Twice3 = [Twice; 3];
