// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bounds on the distance to eight triangles, computed in f32: what is farther at least than another is at most need
//! not be looked at in f64.
//!
//! Each triangle has a frame: origin in a corner, x along its longest edge, z off its plane (after Jones 1995, "3D
//! distance from a point to a triangle"). Frames are made in f64 and rounded once, so the bounds hold for slivers
//! as for any other triangle.
//!
//! The error, for a point at distance d from a triangle with longest edge b, in roundings of f32: 2.5 (1 + the largest
//! coordinate) for the point's and the corner's own; 9 (d + b) for the turn into the frame, 1.5 b for the corners
//! there; 7 d + 14 b for the point of an edge, 6 d + 12 b for a point that is inside or not (the foot is over the
//! longest edge, so what is mistaken for inside is near the other edges, not beyond a tip), 3 d for squares and root; 8.5 b
//! where a triangle is so thin that its frame lies any way round its longest edge: 25 d + 45 b.

use crate::math::{Vec3, length, unit};
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::{F32x8, WIDTH};
use crate::store::plain;

/// Bound on the error but for what rounding the points adds, relative to the distance plus the longest edge; see
/// above.
const ERROR: f32 = 48.0 * f32::EPSILON / 2.0;

/// Squares of what is farther may be infinite; then no more is known.
const FARTHEST: f32 = 1.8e19;

/// Where unused lanes are.
const FAR: f32 = 1e30;

/// Eight triangles side by side.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Estimates {
    pub(super) origin: [F32x8; 3],
    pub(super) axes: [[F32x8; 3]; 3],
    /// The corners in the frame: (0, 0), (b, 0), (c\[0\], c\[1\]).
    pub(super) b: F32x8,
    pub(super) c: [F32x8; 2],
    /// One over the squared lengths of the edges from b to c and from c to the origin.
    inverse: [F32x8; 2],
}

plain! {
    Estimates { origin: [F32x8; 3], axes: [[F32x8; 3]; 3], b: F32x8, c: [F32x8; 2], inverse: [F32x8; 2] }
}

impl Estimates {
    /// Of no triangle: infinitely far, as far as f32 goes.
    pub(crate) const NONE: Estimates = Estimates {
        origin: [F32x8([FAR; WIDTH]); 3],
        axes: [[F32x8([1.0; WIDTH]); 3]; 3],
        b: F32x8([0.0; WIDTH]),
        c: [F32x8([0.0; WIDTH]); 2],
        inverse: [F32x8([0.0; WIDTH]); 2],
    };

    /// Puts a triangle into a lane. Corners lie within one of the origin.
    pub(crate) fn set(&mut self, lane: usize, corners: [Vec3; 3]) {
        let squared = |k: usize| (corners[(k + 1) % 3] - corners[k]).length_squared();
        let longest = (1..3).fold(0, |best, k| if squared(k) > squared(best) { k } else { best });
        let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
        // A triangle of one point has any frame.
        let x = if a == b { Vec3::X } else { unit(b - a) };
        let across = (c - a) - x * x.dot(c - a);
        let y = unit(across - x * x.dot(across));
        // Of a triangle without width that is rounding, which may point along x; any direction across will do.
        let y = if y == Vec3::ZERO || x.dot(y).abs() > 1e-9 { x.any_orthonormal_vector() } else { y };
        let z = x.cross(y);
        for axis in 0..3 {
            self.origin[axis].0[lane] = a[axis] as f32;
            self.axes[0][axis].0[lane] = x[axis] as f32;
            self.axes[1][axis].0[lane] = y[axis] as f32;
            self.axes[2][axis].0[lane] = z[axis] as f32;
        }
        let (width, tip) = (length(b - a), [x.dot(c - a), y.dot(c - a)]);
        self.b.0[lane] = width as f32;
        self.c[0].0[lane] = tip[0] as f32;
        self.c[1].0[lane] = tip[1] as f32;
        let inverse = |u: f64, v: f64| {
            let squared = u * u + v * v;
            if squared > 1e-36 { (1.0 / squared) as f32 } else { 0.0 }
        };
        self.inverse[0].0[lane] = inverse(tip[0] - width, tip[1]);
        self.inverse[1].0[lane] = inverse(tip[0], tip[1]);
    }

    /// Whether the first lanes are of triangles within a little more than one of the origin, and the others of none.
    pub(crate) fn are_sound(&self, used: usize) -> bool {
        let within = |lanes: &F32x8, lo: f32, hi: f32| lanes.0[..used].iter().all(|x| lo <= *x && *x <= hi);
        let is = |lanes: &F32x8, none: &F32x8| lanes.0[used..] == none.0[used..];
        let none = &Estimates::NONE;
        (0..3).all(|k| within(&self.origin[k], -2.0, 2.0) && is(&self.origin[k], &none.origin[k]))
            && (0..9).all(|k| {
                let axis = &self.axes[k / 3][k % 3];
                within(axis, -2.0, 2.0) && is(axis, &none.axes[k / 3][k % 3])
            })
            && within(&self.b, 0.0, 4.0)
            && is(&self.b, &none.b)
            && (0..2).all(|k| within(&self.c[k], -4.0, 4.0) && is(&self.c[k], &none.c[k]))
            && (0..2).all(|k| within(&self.inverse[k], 0.0, 2e36) && is(&self.inverse[k], &none.inverse[k]))
    }

    /// The least and the most that the distances of a point can be, as the kernel in f64 has them. `slack` is that of the
    /// point.
    #[inline(always)]
    pub(crate) fn between<S: Simd>(&self, simd: S, at: [f32; 3], slack: f32) -> [S::Float; 2] {
        let distance = self.distances(simd, at);
        let constant = load(simd, &self.b).mul(S::Float::splat(simd, ERROR)).add(S::Float::splat(simd, slack));
        // (No difference of infinities, where a lane is unused.)
        let lower = distance.mul(S::Float::splat(simd, 1.0 - ERROR)).sub(constant);
        // (What is no number stays so.)
        let lower = S::Float::splat(simd, FARTHEST).min(lower);
        [lower, distance.mul(S::Float::splat(simd, 1.0 + ERROR)).add(constant)]
    }

    #[inline(always)]
    fn distances<S: Simd>(&self, simd: S, at: [f32; 3]) -> S::Float {
        let mut frame = [S::Float::splat(simd, 0.0); 3];
        for axis in 0..3 {
            let to = S::Float::splat(simd, at[axis]).sub(load(simd, &self.origin[axis]));
            for row in 0..3 {
                let part = to.mul(load(simd, &self.axes[row][axis]));
                frame[row] = if axis == 0 { part } else { frame[row].add(part) };
            }
        }
        let c = [load(simd, &self.c[0]), load(simd, &self.c[1])];
        let inverse = [load(simd, &self.inverse[0]), load(simd, &self.inverse[1])];
        distances(simd, frame, load(simd, &self.b), c, inverse)
    }

    /// One of them, for eight points at once.
    #[inline(always)]
    pub(crate) fn one<S: Simd>(&self, simd: S, lane: usize) -> Estimate<S::Float> {
        let splat = |lanes: &F32x8| S::Float::splat(simd, lanes.0[lane]);
        let mut one = Estimate {
            origin: [splat(&self.origin[0]), splat(&self.origin[1]), splat(&self.origin[2])],
            axes: [[S::Float::splat(simd, 0.0); 3]; 3],
            b: splat(&self.b),
            c: [splat(&self.c[0]), splat(&self.c[1])],
            inverse: [splat(&self.inverse[0]), splat(&self.inverse[1])],
        };
        for row in 0..3 {
            for axis in 0..3 {
                one.axes[row][axis] = splat(&self.axes[row][axis]);
            }
        }
        one
    }

    /// Of one of them, what its estimates are off by beside [`BELOW`] and [`ABOVE`].
    #[inline(always)]
    pub(crate) fn margin(&self, lane: usize, slack: f32) -> f32 {
        self.b.0[lane] * ERROR + slack
    }
}

/// The least that a distance can be is its estimate times this less the margin.
pub(crate) const BELOW: f32 = 1.0 - ERROR;

/// The most that a distance can be is its estimate times this and the margin.
pub(crate) const ABOVE: f32 = 1.0 + ERROR;

/// One triangle, the same in all lanes.
#[derive(Clone, Copy)]
pub(crate) struct Estimate<F> {
    origin: [F; 3],
    axes: [[F; 3]; 3],
    b: F,
    c: [F; 2],
    inverse: [F; 2],
}

impl<F: Copy> Estimate<F> {
    /// What a coordinate of eight points adds to theirs in the frame, whose sum goes to [`Estimate::distances`].
    #[inline(always)]
    pub(crate) fn along<S: Simd<Float = F>>(&self, axis: usize, at: F) -> [F; 3]
    where
        F: Float8<S>,
    {
        let to = at.sub(self.origin[axis]);
        [to.mul(self.axes[0][axis]), to.mul(self.axes[1][axis]), to.mul(self.axes[2][axis])]
    }

    /// The distances, near the truth by [`BELOW`], [`ABOVE`] and the margin, which hold for sums in any order.
    #[inline(always)]
    pub(crate) fn distances<S: Simd<Float = F>>(&self, simd: S, frame: [F; 3]) -> F
    where
        F: Float8<S>,
    {
        distances(simd, frame, self.b, self.c, self.inverse)
    }
}

/// The distances of points in their triangles' frames.
#[inline(always)]
fn distances<S: Simd>(
    simd: S,
    [x, y, z]: [S::Float; 3],
    b: S::Float,
    [cx, cy]: [S::Float; 2],
    inverse: [S::Float; 2],
) -> S::Float {
    let zero = S::Float::splat(simd, 0.0);
    let beyond = x.sub(x.max(zero).min(b));
    let base = beyond.mul(beyond).add(y.mul(y));
    let (ex, qx) = (cx.sub(b), x.sub(b));
    let right = segment(simd, [qx, y], [ex, cy], inverse[0]);
    let left = segment(simd, [x, y], [cx, cy], inverse[1]);
    let edges = base.min(right).min(left);

    let inside_right = ex.mul(y).sub(cy.mul(qx));
    let inside_left = cy.mul(x).sub(cx.mul(y));
    let inside = y.min(inside_right).min(inside_left);
    let planar = edges.zero_where_positive(inside);
    planar.add(z.mul(z)).sqrt()
}

#[inline(always)]
fn load<S: Simd>(simd: S, lanes: &F32x8) -> S::Float {
    S::Float::load(simd, &lanes.0)
}

/// Squared distance of a point from the segment from the origin to `end`.
#[inline(always)]
fn segment<S: Simd>(simd: S, [x, y]: [S::Float; 2], end: [S::Float; 2], inverse: S::Float) -> S::Float {
    let (zero, one) = (S::Float::splat(simd, 0.0), S::Float::splat(simd, 1.0));
    let at = x.mul(end[0]).add(y.mul(end[1])).mul(inverse).max(zero).min(one);
    let (p, q) = (x.sub(end[0].mul(at)), y.sub(end[1].mul(at)));
    p.mul(p).add(q.mul(q))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::triangle::{self, Prepared, V3};
    use crate::simd::float8::slack;

    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        }

        fn vector(&mut self) -> Vec3 {
            Vec3::new(self.next(), self.next(), self.next())
        }
    }

    struct Distances<'a>(&'a Estimates, Vec3);

    impl crate::simd::Kernel for Distances<'_> {
        type Output = [[f32; WIDTH]; 3];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [[f32; WIDTH]; 3] {
            let at = self.1.to_array().map(|c| c as f32);
            let [lower, upper] = self.0.between(simd, at, slack(self.1.abs().max_element()));
            [self.0.distances(simd, at).lanes(), lower.lanes(), upper.lanes()]
        }
    }

    fn assert_within(corners: [Vec3; 3], p: Vec3, worst: &mut f64) {
        let mut lanes = Estimates::NONE;
        lanes.set(3, corners);
        let [found, lower, upper] = crate::simd::dispatch(Distances(&lanes, p)).map(|lanes| f64::from(lanes[3]));
        let exact = triangle::nearest(&Prepared::new(corners), V3::from_vec(p)).squared.sqrt();
        let error = (found - exact).abs();
        *worst = worst.max(error / (exact - lower).min(upper - exact));
        // No more than two thirds of what is allowed are reached.
        let within = lower + 0.5 * error <= exact && exact <= upper - 0.5 * error;
        assert!(within, "{corners:?} {p}: {lower} to {upper}, {exact}");
    }

    #[test]
    fn the_error_is_within_half_of_its_bound() {
        let mut random = Random(5);
        let mut worst = 0.0;
        for k in 0..200_000 {
            // From fat triangles to slivers and specks.
            let size = [1.0, 1e-2, 1e-5, 1e-9][k % 4];
            let thin = [1.0, 1e-3, 1e-7, 0.0][k / 4 % 4];
            let a = random.vector();
            let (long, short) = (random.vector() * size, random.vector() * size);
            let b = (a + long).clamp(Vec3::splat(-0.5), Vec3::splat(0.5));
            let c = a + (b - a) * (random.next() + 0.5) + short * thin;
            let c = c.clamp(Vec3::splat(-0.5), Vec3::splat(0.5));
            let reach = [1e-7, 1e-3, 1.0, 30.0, 1e4][k / 16 % 5];
            let p = a + (b - a) * random.next() + (c - a) * random.next() + random.vector() * reach;
            assert_within([a, b, c], p, &mut worst);
        }
        assert!(worst > 0.05, "{worst}");
    }

    #[test]
    fn corners_on_a_line_are_a_segment() {
        let mut random = Random(9);
        let mut worst = 0.0;
        for _ in 0..200_000 {
            let whole = |v: Vec3| (v * 16.0).round();
            let (a, d) = (whole(random.vector()), whole(random.vector()));
            let steps = [random.next(), random.next()].map(|s| (s * 8.0).round());
            // On the line in thirtieths, and so but for rounding on it when scaled.
            let corners = [a, a + d * steps[0], a + d * steps[1]].map(|c| c * (1.0 / 150.0));
            assert_within(corners, random.vector() * 4.0, &mut worst);
        }
    }

    #[test]
    fn coincident_corners_are_a_segment_or_a_point() {
        let mut worst = 0.0;
        let (a, b) = (Vec3::new(-0.25, 0.5, 0.125), Vec3::new(0.375, -0.5, 0.25));
        for corners in [[a, b, b], [a, a, b], [a, b, a], [a, a, a]] {
            for p in [Vec3::ZERO, Vec3::X, a, b * 2.0, (a + b) * 0.5] {
                assert_within(corners, p, &mut worst);
            }
        }
    }
}
