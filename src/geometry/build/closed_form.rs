// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors of the bodies in closed form. Lengths are in the user's unit; directions need not have
//! length 1; angles are full ones, in degrees.

use crate::error::Result;
use crate::geometry::Geometry;
use crate::geometry::shape::{Ellipsoid, Extruded, Perlin, Plane, Revolved, RoundedBox};

impl Geometry {
    /// The half space behind a plane: `normal` points out of the body. The value is the exact signed distance.
    ///
    /// An error where a number is not finite or the normal is zero.
    pub fn plane(point: [f64; 3], normal: [f64; 3]) -> Result<Geometry> {
        Geometry::leaf(Box::new(Plane::new(point, normal)?))
    }

    /// A torus: the points within `minor` of the circle of radius `major` around `center`, in the plane across
    /// `axis`. The value is the exact signed distance.
    ///
    /// An error unless 0 < minor < major, where a number is not finite or the axis is zero.
    pub fn torus(center: [f64; 3], axis: [f64; 3], major: f64, minor: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::torus(center, axis, major, minor)?))
    }

    /// A cylinder with flat ends at `a` and `b`. The value is the exact signed distance.
    ///
    /// An error where a number is not finite, the radius is not > 0 or `a` is `b`.
    pub fn cylinder(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::cylinder(a, b, radius)?))
    }

    /// A cylinder without ends, around the line through `point` along `axis`. The value is the exact signed
    /// distance.
    ///
    /// An error where a number is not finite, the radius is not > 0 or the axis is zero.
    pub fn infinite_cylinder(point: [f64; 3], axis: [f64; 3], radius: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::infinite_cylinder(point, axis, radius)?))
    }

    /// A capsule: the points within `radius` of the segment from `a` to `b`. The value is the exact signed
    /// distance.
    ///
    /// An error where a number is not finite, the radius is not > 0 or `a` is `b` (a ball:
    /// [`Geometry::sphere`]).
    pub fn capsule(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::capsule(a, b, radius)?))
    }

    /// A capsule by its outermost points: `tip_a` and `tip_b` lie on the surface. The value is the exact signed
    /// distance.
    ///
    /// An error where a number is not finite, the radius is not > 0 or the tips are not more than two radii
    /// apart.
    pub fn capsule_tips(tip_a: [f64; 3], tip_b: [f64; 3], radius: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::capsule_tips(tip_a, tip_b, radius)?))
    }

    /// A cone without end: opens from `tip` along `axis`; `angle` is the full one between opposite sides, in
    /// degrees. The value is the exact signed distance.
    ///
    /// An error unless 0 < angle < 180, where a number is not finite or the axis is zero.
    pub fn infinite_cone(tip: [f64; 3], axis: [f64; 3], angle: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::infinite_cone(tip, axis, angle)?))
    }

    /// A cone with a flat base: opens from `tip` along `axis` and ends `height` from the tip; `angle` is the full
    /// one between opposite sides, in degrees. The value is the exact signed distance.
    ///
    /// An error unless 0 < angle < 180 and height > 0, where a number is not finite or the axis is zero.
    pub fn cone(tip: [f64; 3], axis: [f64; 3], height: f64, angle: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::cone(tip, axis, height, angle)?))
    }

    /// A box around `center`, its edges and corners rounded; `half` are the outer half sizes, the rounding
    /// included. `rotation` (row-major, to within 1e-9; none: along the axes) turns it around its centre. With
    /// radius 0 it is a sharp box in any orientation. The value is the exact signed distance.
    ///
    /// An error unless each half size is > 0 and 0 <= radius <= the least of them, where a number is not finite
    /// or the matrix is no rotation.
    pub fn rounded_box(center: [f64; 3], half: [f64; 3], radius: f64, rotation: Option<[f64; 9]>) -> Result<Geometry> {
        Geometry::leaf(Box::new(RoundedBox::new(center, half, radius, rotation)?))
    }

    /// A cylinder around `center` along `axis`, its edges rounded; `radius` and `height` are the outer ones, the
    /// rounding included. The value is the exact signed distance.
    ///
    /// An error unless radius and height are > 0 and 0 <= rounding <= the lesser of radius and height / 2, where
    /// a number is not finite or the axis is zero.
    pub fn rounded_cylinder(
        center: [f64; 3],
        axis: [f64; 3],
        radius: f64,
        height: f64,
        rounding: f64,
    ) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::rounded_cylinder(center, axis, radius, height, rounding)?))
    }

    /// A solid of revolution: the closed polygon of `points`, each (distance from the axis, place along it from
    /// `origin`), turned around the axis. In either order; edges on the axis are no surface. The value is the
    /// exact signed distance, in time proportional to the number of points.
    ///
    /// An error where there are fewer than 3 points or more than 10000, one lies left of the axis, one repeats
    /// the one before, the polygon touches or crosses itself (tested exactly), a number is not finite or the
    /// axis is zero.
    pub fn revolved_polygon(origin: [f64; 3], axis: [f64; 3], points: &[[f64; 2]]) -> Result<Geometry> {
        Geometry::leaf(Box::new(Revolved::polygon(origin, axis, points)?))
    }

    /// A regular prism with flat ends at `a` and `b`: `radius` is that of the circle through its corners, and
    /// `toward` points from the axis to the first of them (the part along the axis does not count). The value is
    /// the exact signed distance, in time proportional to the number of sides.
    ///
    /// An error unless 3 <= sides <= 1000, where a number is not finite, the radius is not > 0, `a` is `b` or
    /// `toward` is along the axis.
    pub fn prism(a: [f64; 3], b: [f64; 3], toward: [f64; 3], sides: u32, radius: f64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Extruded::prism(a, b, toward, sides, radius)?))
    }

    /// The closed polygon of `points`, in either order, drawn from `z_lo` to `z_hi`: a point (u, v, z) of this
    /// frame comes to `rotation * (u, v, z) + origin` (row-major, to within 1e-9; none: along the axes). The
    /// value is the exact signed distance, in time proportional to the number of points.
    ///
    /// An error where there are fewer than 3 points or more than 10000, one repeats the one before, the polygon
    /// touches or crosses itself (tested exactly), z_hi is not above z_lo, a number is not finite or the matrix
    /// is no rotation.
    pub fn extruded_polygon(
        origin: [f64; 3],
        rotation: Option<[f64; 9]>,
        points: &[[f64; 2]],
        z_lo: f64,
        z_hi: f64,
    ) -> Result<Geometry> {
        Geometry::leaf(Box::new(Extruded::polygon(origin, rotation, points, z_lo, z_hi)?))
    }

    /// An ellipsoid with these semi-axes around `center`, turned by `rotation` (row-major, to within 1e-9; none:
    /// along the axes). The value is the exact signed distance, inside and outside, by a root finder that always
    /// ends and whose bits are the same everywhere (Eberly 2013).
    ///
    /// An error where a semi-axis is not > 0, a number is not finite or the matrix is no rotation.
    pub fn ellipsoid(center: [f64; 3], semi_axes: [f64; 3], rotation: Option<[f64; 9]>) -> Result<Geometry> {
        Geometry::leaf(Box::new(Ellipsoid::new(center, semi_axes, rotation)?))
    }

    /// Perlin noise (2002): `amplitude * sum over k < octaves of persistence^k * noise(frequency * 2^k * p)`,
    /// the product taken axis by axis. |noise| <= 1.5 and mostly below 1; it is 0 where all coordinates of
    /// noise are whole, and repeats every 256. The table is shuffled by `seed`; the bits are the same
    /// everywhere. The value is no distance: only its sign counts, and its Lipschitz constant is known. Where a
    /// product reaches 2^52 (4.5e15) no fraction is left and the noise along that axis is that of a lattice
    /// plane; where it overflows, it counts as 0.
    ///
    /// An error unless amplitude and persistence are > 0, each frequency is >= 0 (0: constant along that axis)
    /// and 1 <= octaves <= 16, or where a number is not finite.
    pub fn perlin(amplitude: f64, frequency: [f64; 3], persistence: f64, octaves: u32, seed: u64) -> Result<Geometry> {
        Geometry::leaf(Box::new(Perlin::new(amplitude, frequency, persistence, octaves, seed)?))
    }
}
