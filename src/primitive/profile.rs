// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signed distance in the half plane (r >= 0, z) of solids of revolution, after Quilez, "Distance functions"
//! (iquilezles.org), with the interior made exact: the axis r = 0 is no surface.

use crate::math::{Vec3, length, unit};

/// Length of (x, y) without overflow.
pub(crate) fn length2(x: f64, y: f64) -> f64 {
    length(Vec3::new(x, y, 0.0))
}

/// (x, y) scaled to unit length; `otherwise` where it is zero.
pub(crate) fn unit2(x: f64, y: f64, otherwise: [f64; 2]) -> [f64; 2] {
    let u = unit(Vec3::new(x, y, 0.0));
    if u == Vec3::ZERO { otherwise } else { [u.x, u.y] }
}

/// A rectangle r <= radius, lo <= z <= hi, grown by `rounding`: cylinders (no rounding), capsules (radius 0)
/// and all between; infinite `lo` and `hi` make an infinite cylinder.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    pub(crate) radius: f64,
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) rounding: f64,
}

impl Slab {
    fn excess(&self, r: f64, z: f64) -> (f64, f64) {
        (r - self.radius, (self.lo - z).max(z - self.hi))
    }

    pub(crate) fn value(&self, r: f64, z: f64) -> f64 {
        let (q, s) = self.excess(r, z);
        let inside = q.max(s);
        // The distance to a convex core less its rounding is exact inside too: both only move planes.
        if inside <= 0.0 { inside - self.rounding } else { length2(q.max(0.0), s.max(0.0)) - self.rounding }
    }

    /// On the medial axis: the side wall first, then the cap at `hi`.
    pub(crate) fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        let (q, s) = self.excess(r, z);
        let along = if z - self.hi >= self.lo - z { 1.0 } else { -1.0 };
        if q.max(s) > 0.0 {
            let [u, v] = unit2(q.max(0.0), s.max(0.0), [1.0, 0.0]);
            [u, v * along]
        } else if q >= s {
            [1.0, 0.0]
        } else {
            [0.0, along]
        }
    }
}

/// A disc of radius `minor` around (`major`, 0): the torus.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) major: f64,
    pub(crate) minor: f64,
}

impl Ring {
    pub(crate) fn value(&self, r: f64, z: f64) -> f64 {
        length2(r - self.major, z) - self.minor
    }

    /// In the middle of the tube: away from the axis.
    pub(crate) fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        unit2(r - self.major, z, [1.0, 0.0])
    }
}

/// The points within a half angle of the z axis: the infinite cone, its tip at the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wedge {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Wedge {
    /// Height over the side, negative inside.
    fn above(&self, r: f64, z: f64) -> f64 {
        r * self.cos - z * self.sin
    }

    /// Place along the side, from the tip.
    fn along(&self, r: f64, z: f64) -> f64 {
        r * self.sin + z * self.cos
    }

    pub(crate) fn value(&self, r: f64, z: f64) -> f64 {
        let above = self.above(r, z);
        if above <= 0.0 || self.along(r, z) >= 0.0 { above } else { length2(r, z) }
    }

    pub(crate) fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        let side = [self.cos, -self.sin];
        if self.above(r, z) <= 0.0 || self.along(r, z) >= 0.0 { side } else { unit2(r, z, side) }
    }
}

/// The triangle (0, 0), (0, height), (radius, height): a cone with its tip at the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    pub(crate) wedge: Wedge,
    pub(crate) height: f64,
    pub(crate) radius: f64,
    /// Of the side, tip to rim.
    pub(crate) slant: f64,
}

impl Cone {
    /// None where the base is no circle.
    pub(crate) fn new(sin: f64, cos: f64, height: f64) -> Option<Cone> {
        let (radius, slant) = (height * (sin / cos), height / cos);
        (radius > 0.0 && slant.is_finite()).then_some(Cone { wedge: Wedge { sin, cos }, height, radius, slant })
    }

    pub(crate) fn value(&self, r: f64, z: f64) -> f64 {
        let (above, beyond) = (self.wedge.above(r, z), z - self.height);
        let inside = above.max(beyond);
        if inside <= 0.0 {
            return inside;
        }
        let base = length2((r - self.radius).max(0.0), beyond);
        self.side_distance(r, z, above).min(base)
    }

    /// Distance from a point outside to the side.
    fn side_distance(&self, r: f64, z: f64, above: f64) -> f64 {
        let along = self.wedge.along(r, z);
        if along <= 0.0 {
            length2(r, z)
        } else if along >= self.slant {
            length2(r - self.radius, z - self.height)
        } else {
            above.abs()
        }
    }

    /// On the medial axis: the side first.
    pub(crate) fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        let (above, beyond) = (self.wedge.above(r, z), z - self.height);
        let side = [self.wedge.cos, -self.wedge.sin];
        if above.max(beyond) <= 0.0 {
            return if above >= beyond { side } else { [0.0, 1.0] };
        }
        let base = length2((r - self.radius).max(0.0), beyond);
        let along = self.wedge.along(r, z);
        if base <= self.side_distance(r, z, above) {
            unit2((r - self.radius).max(0.0), beyond, [0.0, 1.0])
        } else if along <= 0.0 {
            unit2(r, z, side)
        } else if along >= self.slant {
            unit2(r - self.radius, z - self.height, side)
        } else {
            side
        }
    }
}
