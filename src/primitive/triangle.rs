// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nearest point of a triangle: the plane where the foot of the perpendicular is inside, else the
//! nearest of the three edges (after Ericson, Real-Time Collision Detection, 2005, section 5.1.5,
//! without its branches).
//!
//! There is one kernel, over one or eight triangles; its squared distance defines a mesh's value. A
//! vertex shared by several triangles gives all of them the same bits. The squared distance is off by
//! less than [`RELATIVE_ERROR`] * (distance + twice the longest edge) in the distance.

use crate::math::{Vec3, cross_of_differences, unit};
use crate::simd::lanes::Lanes;

/// Bound on the kernel's error; see above. (About 20 units of rounding are reached.)
pub(crate) const RELATIVE_ERROR: f64 = 64.0 * f64::EPSILON;

/// Three lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct V3<L>(pub(crate) [L; 3]);

impl<L: Lanes> V3<L> {
    #[inline(always)]
    fn sub(self, o: V3<L>) -> V3<L> {
        V3([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }

    #[inline(always)]
    fn scale(self, s: L) -> V3<L> {
        V3([self.0[0] * s, self.0[1] * s, self.0[2] * s])
    }

    #[inline(always)]
    fn dot(self, o: V3<L>) -> L {
        self.0[0] * o.0[0] + self.0[1] * o.0[1] + self.0[2] * o.0[2]
    }

    #[inline(always)]
    fn cross(self, o: V3<L>) -> V3<L> {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        V3([b * f - e * c, c * d - f * a, a * e - d * b])
    }

    #[inline(always)]
    fn select(mask: L::Mask, yes: V3<L>, no: V3<L>) -> V3<L> {
        V3([L::select(mask, yes.0[0], no.0[0]), L::select(mask, yes.0[1], no.0[1]), L::select(mask, yes.0[2], no.0[2])])
    }
}

impl V3<f64> {
    pub(crate) fn from_vec(v: Vec3) -> V3<f64> {
        V3(v.to_array())
    }

    #[inline(always)]
    fn splat<L: Lanes>(&self) -> V3<L> {
        V3([L::splat(self.0[0]), L::splat(self.0[1]), L::splat(self.0[2])])
    }

    pub(crate) fn to_vec(self) -> Vec3 {
        Vec3::from_array(self.0)
    }
}

/// A triangle prepared for the kernel.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Prepared<L> {
    /// Corners.
    pub(crate) corner: [V3<L>; 3],
    /// Unit normal; zero where the area is zero, and then the edges alone count.
    pub(crate) normal: V3<L>,
    /// For the edges 0-1, 1-2, 2-0: the direction in the plane that points inwards.
    pub(crate) inward: [V3<L>; 3],
    /// For each edge, one over its squared length.
    pub(crate) inverse: [L; 3],
}

/// Squared distance and where it was attained.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot<L> {
    pub(crate) squared: L,
    /// 0 face, 1-3 edge 0-1, 1-2, 2-0, 4-6 vertex 0, 1, 2.
    pub(crate) feature: L,
    /// Where along the edge, 0 to 1 (features 1 to 3).
    pub(crate) along: L,
}

/// The unit normal of a triangle; zero where its area is.
pub(crate) fn normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    unit(cross_of_differences(a, b, c))
}

impl<L: Lanes> Prepared<L> {
    /// From corners and unit normal: about 50 operations, three of them divisions.
    #[inline(always)]
    pub(crate) fn of(corner: [V3<L>; 3], normal: V3<L>) -> Prepared<L> {
        let [a, b, c] = corner;
        let edges = [b.sub(a), c.sub(b), a.sub(c)];
        let inward = [normal.cross(edges[0]), normal.cross(edges[1]), normal.cross(edges[2])];
        let inverse = [inverse(edges[0]), inverse(edges[1]), inverse(edges[2])];
        Prepared { corner, normal, inward, inverse }
    }
}

/// One over the squared length; zero where that is next to nothing.
#[inline(always)]
fn inverse<L: Lanes>(edge: V3<L>) -> L {
    let squared = edge.dot(edge);
    L::select(L::splat(1e-290).lt(squared), L::splat(1.0) / squared, L::splat(0.0))
}

impl Prepared<f64> {
    /// The same in all lanes.
    #[inline(always)]
    pub(crate) fn splat<L: Lanes>(&self) -> Prepared<L> {
        let [a, b, c] = &self.corner;
        let [u, v, w] = &self.inward;
        let [x, y, z] = self.inverse;
        Prepared {
            corner: [a.splat(), b.splat(), c.splat()],
            normal: self.normal.splat(),
            inward: [u.splat(), v.splat(), w.splat()],
            inverse: [L::splat(x), L::splat(y), L::splat(z)],
        }
    }

    pub(crate) fn new(corners: [Vec3; 3]) -> Prepared<f64> {
        Prepared::of(corners.map(V3::from_vec), V3::from_vec(normal(corners)))
    }

    /// The barycentric coordinates of the nearest point, given what the kernel and [`point`] say.
    pub(crate) fn barycentric(&self, feature: usize, along: f64, point: Vec3) -> Vec3 {
        let mut weights = [0.0; 3];
        match feature {
            0 => return self.weights(point),
            1..=3 => (weights[feature - 1], weights[feature % 3]) = (1.0 - along, along),
            _ => weights[feature - 4] = 1.0,
        }
        Vec3::from_array(weights)
    }

    /// Barycentric coordinates of a point of the triangle: the height over the longest edge, relative to the
    /// opposite corner's, then the place along that edge, which stays right where the height of a sliver is
    /// rounding.
    fn weights(&self, point: Vec3) -> Vec3 {
        let corner = self.corner.map(V3::to_vec);
        let k = (1..3).fold(0, |longest, k| if self.inverse[k] < self.inverse[longest] { k } else { longest });
        let (i, j, top) = (k, (k + 1) % 3, (k + 2) % 3);
        let (base, offset, apex) = (corner[j] - corner[i], point - corner[i], corner[top] - corner[i]);
        let inward = self.inward[k].to_vec();
        let at = (offset.dot(base) * self.inverse[k]).clamp(0.0, 1.0);
        let below = apex.dot(base) * self.inverse[k];
        // What is no number, 0 / 0, is passed over by `min` and `max`.
        let room = (at / below).min((1.0 - at) / (1.0 - below)).clamp(0.0, 1.0);
        let height = (offset.dot(inward) / apex.dot(inward)).max(0.0).min(room);
        let along = (at - height * below).clamp(0.0, 1.0 - height);
        let mut weights = [0.0; 3];
        (weights[top], weights[j], weights[i]) = (height, along, 1.0 - height - along);
        Vec3::from_array(weights)
    }
}

/// The nearest point, given the kernel's answer for `p`.
pub(crate) fn point(corner: [Vec3; 3], normal: Vec3, p: Vec3, foot: &Foot<f64>) -> Vec3 {
    match foot.feature as usize {
        0 => p - normal * normal.dot(p - corner[0]),
        feature @ 1..=3 => {
            let (i, j) = (feature - 1, feature % 3);
            corner[i] + (corner[j] - corner[i]) * foot.along
        }
        feature => corner[feature - 4],
    }
}

/// The kernel: nearest point of each triangle to `p`. About 100 operations a triangle, no division,
/// root or branch.
#[inline(always)]
pub(crate) fn nearest<L: Lanes>(t: &Prepared<L>, p: V3<L>) -> Foot<L> {
    let to = [p.sub(t.corner[0]), p.sub(t.corner[1]), p.sub(t.corner[2])];
    let zero = L::splat(0.0);
    let mut best = edge(t, &to, 0);
    // Where the foot lies along the longest edge.
    let (mut least, mut beside) = (t.inverse[0], best.along);
    for k in 1..3 {
        let other = edge(t, &to, k);
        let longer = t.inverse[k].lt(least);
        least = L::select(longer, t.inverse[k], least);
        beside = L::select(longer, other.along, beside);
        let nearer = other.squared.lt(best.squared);
        best.squared = L::select(nearer, other.squared, best.squared);
        best.feature = L::select(nearer, other.feature, best.feature);
        best.along = L::select(nearer, other.along, best.along);
    }
    let height = t.normal.dot(to[0]);
    let plane = height * height;
    // Beyond the tip of a sliver the foot is outside its sides by less than rounding: a foot inside is beside
    // the longest edge, too.
    let within = L::and(zero.le(beside), beside.le(L::splat(1.0)));
    let sides = L::and(L::and(is_left(t, &to, 0), is_left(t, &to, 1)), is_left(t, &to, 2));
    let over = L::and(sides, within);
    Foot {
        squared: L::select(over, plane, best.squared),
        feature: L::select(over, zero, best.feature),
        along: best.along,
    }
}

/// Whether the foot is on the inner side of edge `k`. (A function: closures are not always inlined, and what
/// is not inlined is compiled for the baseline.)
#[inline(always)]
fn is_left<L: Lanes>(t: &Prepared<L>, to: &[V3<L>; 3], k: usize) -> L::Mask {
    L::splat(0.0).lt(t.inward[k].dot(to[k]))
}

#[inline(always)]
fn edge<L: Lanes>(t: &Prepared<L>, to: &[V3<L>; 3], k: usize) -> Foot<L> {
    let (i, j) = (k, (k + 1) % 3);
    let direction = t.corner[j].sub(t.corner[i]);
    let along = to[i].dot(direction) * t.inverse[k];
    let after_start = L::splat(0.0).lt(along);
    let at_end = L::splat(1.0).le(along);
    // At the ends the difference to the corner itself, so that all triangles of a vertex agree.
    let between = to[i].sub(direction.scale(along));
    let offset = V3::select(at_end, to[j], V3::select(after_start, between, to[i]));
    let (start, end) = (L::splat(4.0 + i as f64), L::splat(4.0 + j as f64));
    let feature = L::select(at_end, end, L::select(after_start, L::splat(1.0 + k as f64), start));
    Foot { squared: offset.dot(offset), feature, along }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::lanes::{F64s, F64x8};

    fn point_and_weights(corners: [Vec3; 3], p: Vec3) -> (Vec3, Vec3) {
        let prepared = Prepared::new(corners);
        let foot = nearest(&prepared, V3::from_vec(p));
        let point = point(corners, normal(corners), p, &foot);
        (point, prepared.barycentric(foot.feature as usize, foot.along, point))
    }

    fn gathered(lanes: &[Prepared<f64>; 8]) -> Prepared<F64x8> {
        let vector = |get: &dyn Fn(&Prepared<f64>) -> V3<f64>| {
            V3(std::array::from_fn(|axis| F64s(std::array::from_fn(|k| get(&lanes[k]).0[axis]))))
        };
        Prepared {
            corner: std::array::from_fn(|i| vector(&|t| t.corner[i])),
            normal: vector(&|t| t.normal),
            inward: std::array::from_fn(|i| vector(&|t| t.inward[i])),
            inverse: std::array::from_fn(|i| F64s(std::array::from_fn(|k| lanes[k].inverse[i]))),
        }
    }

    struct Eight<'a>(&'a Prepared<F64x8>, Vec3);

    impl crate::simd::Kernel for Eight<'_> {
        type Output = Foot<F64x8>;

        #[inline(always)]
        fn run<S: crate::simd::float8::Simd>(self, _: S) -> Foot<F64x8> {
            let p = V3([F64x8::splat(self.1.x), F64x8::splat(self.1.y), F64x8::splat(self.1.z)]);
            nearest(self.0, p)
        }
    }

    /// Coordinates on a coarse grid, so that edges, corners, ties and flat triangles all occur.
    fn vector(state: &mut u64) -> Vec3 {
        let mut coordinate = || {
            *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((*state >> 33) % 9) as f64 - 4.0
        };
        Vec3::new(coordinate(), coordinate(), coordinate())
    }

    #[test]
    fn eight_lanes_give_the_bits_of_one() {
        let mut state = 7;
        for _ in 0..20_000 {
            let lanes: [Prepared<f64>; 8] =
                std::array::from_fn(|_| Prepared::new([vector(&mut state), vector(&mut state), vector(&mut state)]));
            let p = vector(&mut state) * 1.25;
            let eight = crate::simd::dispatch(Eight(&gathered(&lanes), p));
            for (k, lane) in lanes.iter().enumerate() {
                let one = nearest(lane, V3::from_vec(p));
                assert_eq!(one.squared.to_bits(), eight.squared.0[k].to_bits());
                assert_eq!((one.feature, one.along.to_bits()), (eight.feature.0[k], eight.along.0[k].to_bits()));
            }
        }
    }

    #[test]
    fn slivers_end_at_their_tips() {
        let along = Vec3::new(0.48, 0.6, 0.64);
        for width in [1e-15, 1e-14, 1e-12, 1e-10, 1e-7, 1e-3] {
            for k in 0..200 {
                let start = Vec3::new(0.1 * f64::from(k), 0.3, 0.7);
                let end = start + along;
                let third = start + along * (0.2 + 0.004 * f64::from(k)) + Vec3::new(0.8, 0.0, -0.6) * width;
                let prepared = Prepared::new([start, end, third]);
                for (tip, beyond) in [(start, -along), (end, along), (start, start - third), (end, end - third)] {
                    for reach in [1e-12, 1e-9, 1e-6, 1e-3, 0.25] {
                        let p = tip + beyond * reach;
                        let foot = nearest(&prepared, V3::from_vec(p));
                        let distance = (p - tip).length();
                        assert!((foot.squared.sqrt() - distance).abs() < 2.0 * RELATIVE_ERROR, "{width} {reach}");
                    }
                }
                let inside = start * 0.5 + end * 0.25 + third * 0.25;
                let (point, weights) = point_and_weights([start, end, third], inside);
                let rebuilt = start * weights.x + end * weights.y + third * weights.z;
                assert!((rebuilt - point).length() < 2.0 * width + 1e-14, "{width} {rebuilt} {point}");
            }
        }
    }

    #[test]
    fn the_foot_is_nearer_than_any_sampled_point() {
        let mut state = 8;
        for _ in 0..2000 {
            let corners = [vector(&mut state), vector(&mut state), vector(&mut state)];
            let prepared = Prepared::new(corners);
            let p = vector(&mut state) * 1.5;
            let foot = nearest(&prepared, V3::from_vec(p));
            let (point, weights) = point_and_weights(corners, p);
            let rebuilt = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
            assert!((rebuilt - point).length() < 1e-12 && (weights.element_sum() - 1.0).abs() < 1e-12);
            assert!(((p - point).length() - foot.squared.sqrt()).abs() < 1e-12);
            for i in 0..=10 {
                for j in 0..=10 - i {
                    let (u, v) = (i as f64 / 10.0, j as f64 / 10.0);
                    let sample = corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v;
                    assert!((p - sample).length() >= foot.squared.sqrt() - 1e-12);
                }
            }
        }
    }
}
