// SPDX-License-Identifier: MIT OR Apache-2.0
//! Transforms. They act on the body, in the order in which they are called. Chains of placements collapse
//! into one.

use super::{direction, finite, finite_number, positive};
use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::geometry::level::Level;
use crate::geometry::linear::Linear;
use crate::geometry::map::Map;
use crate::geometry::node::Node;
use crate::geometry::placement::Placement;
use crate::geometry::stencil::Stencil;
use crate::geometry::twist::Twist;
use crate::math::{Vec3, length, unit};

/// Most samples along an axis of [`Geometry::mollify`].
const MOST_SAMPLES: usize = 32;

impl Geometry {
    /// Moved by `shift`. Shifts of shifts and of placements collapse into one.
    pub fn translate(&self, shift: [f64; 3]) -> Result<Geometry> {
        let shift = finite("shift", shift)?;
        match self.node() {
            Node::Translate(g, before) => g.translate((*before + shift).to_array()),
            Node::Place(g, before) => Geometry::placed(g, Placement::translation(shift).after(before)),
            _ => Geometry::new(Node::Translate(self.clone(), shift)),
        }
    }

    /// Placed rigidly: a point q of the body comes to `rotation * q + shift`. The matrix is row-major and
    /// a rotation to within 1e-9. O(1): the body is shared; placements of placements collapse into one.
    pub fn place(&self, rotation: [f64; 9], shift: [f64; 3]) -> Result<Geometry> {
        self.moved(Placement::new(rotation, finite("shift", shift)?)?)
    }

    /// Rotated by `degrees`, right-handed, about the axis through `point`.
    pub fn rotate(&self, axis: [f64; 3], degrees: f64, point: [f64; 3]) -> Result<Geometry> {
        let (degrees, point) = (finite_number("degrees", degrees)?, finite("point", point)?);
        self.moved(Placement::turn(direction("axis", axis)?, degrees, point))
    }

    /// Scaled by `factor` > 0 about the origin; values are scaled with it and stay exact.
    pub fn scale(&self, factor: f64) -> Result<Geometry> {
        self.moved(Placement::scaling(positive("factor", factor)?))
    }

    /// Reflected in the plane of coordinates 0 (yz), 1 (xz) or 2 (xy).
    pub fn reflect(&self, plane: i32) -> Result<Geometry> {
        let normal = match plane {
            0 => Vec3::X,
            1 => Vec3::Y,
            2 => Vec3::Z,
            _ => return Err(Error::invalid(format!("plane: {plane} is not 0, 1 or 2"))),
        };
        self.moved(Placement::reflection(Vec3::ZERO, normal))
    }

    /// Reflected in the plane through `point` with this normal.
    pub fn reflect_in(&self, point: [f64; 3], normal: [f64; 3]) -> Result<Geometry> {
        self.moved(Placement::reflection(finite("point", point)?, direction("normal", normal)?))
    }

    fn moved(&self, placement: Placement) -> Result<Geometry> {
        let (body, placement) = match self.node() {
            Node::Place(g, before) => (g, placement.after(before)),
            Node::Translate(g, before) => (g, placement.after(&Placement::translation(*before))),
            _ => (self, placement),
        };
        Geometry::placed(body, placement)
    }

    /// The shifts of collapsed placements may add up to more than a number holds, and scales multiply to it.
    fn placed(body: &Geometry, placement: Placement) -> Result<Geometry> {
        finite("shift", placement.shift().to_array())?;
        let (scale, inverse) = (placement.scale(), 1.0 / placement.scale());
        if !(scale.is_normal() && inverse.is_normal()) {
            return Err(Error::invalid(format!(
                "factor: all scales together, {scale}, are beyond the range of numbers"
            )));
        }
        Geometry::new(Node::Place(body.clone(), placement))
    }

    /// Any invertible linear map with a shift: a point q of the body comes to `matrix * q + shift`, row-major.
    /// The value is multiplied by the least factor by which the matrix lengthens, so that a distance becomes
    /// a lower bound of the distance.
    pub fn affine(&self, matrix: [f64; 9], shift: [f64; 3]) -> Result<Geometry> {
        let map = Linear::affine(matrix, finite("shift", shift)?)?;
        Geometry::new(Node::Map(self.clone(), Map::Linear(map)))
    }

    /// Grown by `distance`, or shrunk where it is negative: f - distance. Exact where the surface has no edge
    /// or curvature in the way; else a lower bound where the value is 1-Lipschitz.
    pub fn offset(&self, distance: f64) -> Result<Geometry> {
        let distance = finite_number("distance", distance)?;
        Geometry::new(Node::Level(self.clone(), Level::Offset(distance)))
    }

    /// The shell of points within `half_thickness` of the surface: |f| - half_thickness.
    pub fn annular(&self, half_thickness: f64) -> Result<Geometry> {
        let d = positive("half_thickness", half_thickness)?;
        Geometry::new(Node::Level(self.clone(), Level::Annular(d)))
    }

    /// Divided by its Lipschitz constant: a value of which only the sign counted becomes a lower bound of the
    /// distance. Where the constant is unknown it is [`crate::Status::Unsupported`].
    pub fn lower_bound(&self) -> Result<Geometry> {
        let lipschitz = self.summary().lipschitz;
        if !(lipschitz.is_finite() && lipschitz > 0.0) {
            return Err(Error::unsupported(format!(
                "g: its Lipschitz constant is {lipschitz}: nothing to divide by (give an expression finite bounds, a callback its constant)"
            )));
        }
        Geometry::new(Node::Level(self.clone(), Level::Divided(lipschitz)))
    }

    /// Blurred: the mean of 27 values at 0 and +-h along each axis, where one that is displaced along n axes
    /// weighs alpha^(3-n) ((1-alpha)/2)^n.
    pub fn blur(&self, h: f64, alpha: f64) -> Result<Geometry> {
        let h = positive("h", h)?;
        if !(0.0..=1.0).contains(&alpha) {
            return Err(Error::invalid(format!("alpha: {alpha} is not between 0 and 1")));
        }
        Geometry::new(Node::Stencil(self.clone(), Stencil::blur(h, alpha)?))
    }

    /// Mollified: the mean of the values at samples^3 points evenly in [-d, d] along each axis, with binomial
    /// weights.
    pub fn mollify(&self, d: f64, samples: i32) -> Result<Geometry> {
        let d = positive("d", d)?;
        let count = usize::try_from(samples).unwrap_or(0);
        if !(1..=MOST_SAMPLES).contains(&count) {
            return Err(Error::invalid(format!("samples: {samples} is not between 1 and {MOST_SAMPLES}")));
        }
        Geometry::new(Node::Stencil(self.clone(), Stencil::mollify(d, count)?))
    }

    /// Cut at the coordinate planes and pulled apart by +-`extent` along each axis: f(p - clamp(p, -e, e)).
    pub fn elongate(&self, extent: [f64; 3]) -> Result<Geometry> {
        let e = finite("extent", extent)?;
        match (0..3).find(|&k| e[k] < 0.0) {
            Some(k) => Err(Error::invalid(format!("extent[{k}]: {} is not >= 0", e[k]))),
            None => Geometry::new(Node::Map(self.clone(), Map::Elongate(e))),
        }
    }

    /// Twisted about the z axis by `degrees` a unit of height. Of a body within bounds the value is divided by
    /// the most by which they are stretched, and is a lower bound of the distance where the body's is
    /// 1-Lipschitz; of others only its sign counts.
    pub fn twist(&self, degrees: f64) -> Result<Geometry> {
        let rate = finite_number("degrees", degrees)? * (std::f64::consts::PI / 180.0);
        Geometry::new(Node::Map(self.clone(), Map::Twist(Twist::new(rate, self.summary()))))
    }

    /// The section by a plane, as a body of the plane of x and y (the same at every z): the value at (x, y) is
    /// that at `origin + x u + y v`, where u and v are made unit vectors at a right angle from `u_axis` and
    /// `v_axis`.
    pub fn slice(&self, origin: [f64; 3], u_axis: [f64; 3], v_axis: [f64; 3]) -> Result<Geometry> {
        let origin = finite("origin", origin)?;
        let u = direction("u_axis", u_axis)?;
        let v = direction("v_axis", v_axis)?;
        let across = v - u * v.dot(u);
        if length(across) < 1e-9 {
            return Err(Error::invalid(format!(
                "v_axis: ({}, {}, {}) is parallel to u_axis",
                v_axis[0], v_axis[1], v_axis[2]
            )));
        }
        Geometry::new(Node::Map(self.clone(), Map::Linear(Linear::slice(origin, u, unit(across)))))
    }
}
