// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shapes in relocatable blocks: the kind of each and the numbers it is made of.

use super::outline::Outline;
use super::revolved::Profile;
use super::{Cuboid, Ellipsoid, Expression, Extruded, Grid, HeightField, Perlin, Plane, Revolved, RoundedBox, Sphere};
use crate::error::Result;
use crate::geometry::node::Node;
use crate::math::{Aabb, Vec3};
use crate::primitive::profile::{Cone, Ring, Slab, Wedge};
use crate::store::{Packer, Unpacker, wrong};

pub(super) const SPHERE: u64 = 1;
pub(super) const CUBOID: u64 = 2;
pub(super) const PLANE: u64 = 20;
pub(super) const ROUNDED_BOX: u64 = 26;
pub(super) const EXTRUDED: u64 = 27;
pub(super) const ELLIPSOID: u64 = 28;
pub(super) const PERLIN: u64 = 29;
pub(super) const HEIGHT_FIELD: u64 = 40;
pub(super) const GRID: u64 = 41;
pub(super) const EXPRESSION: u64 = 42;

/// The shape of this kind that follows.
pub(in crate::geometry) fn unpack(kind: u64, from: &mut Unpacker) -> Result<Node> {
    Ok(Node::Shape(match kind {
        SPHERE => return Ok(Node::Sphere(Sphere::new(from.numbers()?, from.finite()?)?)),
        CUBOID => Box::new(Cuboid::new(from.numbers()?, from.numbers()?)?),
        PLANE => Box::new(Plane::unpack(from)?),
        Ring::KIND => Box::new(revolved(from, ring)?),
        Slab::KIND => Box::new(revolved(from, slab)?),
        Wedge::KIND => Box::new(revolved(from, wedge)?),
        Cone::KIND => Box::new(revolved(from, cone)?),
        Outline::KIND => Box::new(revolved(from, Outline::unpack)?),
        ROUNDED_BOX => Box::new(RoundedBox::unpack(from)?),
        EXTRUDED => Box::new(Extruded::unpack(from)?),
        ELLIPSOID => Box::new(Ellipsoid::unpack(from)?),
        PERLIN => Box::new(Perlin::unpack(from)?),
        HEIGHT_FIELD => Box::new(HeightField::unpack(from)?),
        GRID => Box::new(Grid::unpack(from)?),
        EXPRESSION => Box::new(Expression::unpack(from)?),
        _ => return Err(wrong(&format!("a node is of kind {kind}, which there is not"))),
    }))
}

fn revolved<P: Profile>(from: &mut Unpacker, profile: impl FnOnce(&mut Unpacker) -> Result<P>) -> Result<Revolved<P>> {
    let (origin, axis) = (from.vector()?, unit(from)?);
    Ok(Revolved { origin, axis, profile: profile(from)? })
}

fn ring(from: &mut Unpacker) -> Result<Ring> {
    let [major, minor] = not_negative(from)?;
    Ok(Ring { major, minor })
}

fn slab(from: &mut Unpacker) -> Result<Slab> {
    let ([radius], lo, hi, [rounding]) = (not_negative(from)?, from.number()?, from.number()?, not_negative(from)?);
    if lo <= hi { Ok(Slab { radius, lo, hi, rounding }) } else { Err(wrong("a cylinder ends before it begins")) }
}

fn wedge(from: &mut Unpacker) -> Result<Wedge> {
    let [sin, cos] = not_negative(from)?;
    Ok(Wedge { sin, cos })
}

fn cone(from: &mut Unpacker) -> Result<Cone> {
    let (Wedge { sin, cos }, [height]) = (wedge(from)?, not_negative(from)?);
    Cone::new(sin, cos, height).ok_or_else(|| wrong("a cone has no base"))
}

/// A direction, as it was made.
pub(super) fn unit(from: &mut Unpacker) -> Result<Vec3> {
    let v = from.vector()?;
    if (v.dot(v) - 1.0).abs() < 1e-9 { Ok(v) } else { Err(wrong("a direction has another length than 1")) }
}

/// Numbers none of which is below 0.
pub(super) fn not_negative<const N: usize>(from: &mut Unpacker) -> Result<[f64; N]> {
    let all = from.numbers::<N>()?;
    if all.iter().all(|x| *x >= 0.0) { Ok(all) } else { Err(wrong("a length is below 0")) }
}

/// A box that may be infinite, or none.
pub(super) fn aabb(from: &mut Unpacker) -> Result<Aabb> {
    let mut corner = || Ok(Vec3::new(from.number()?, from.number()?, from.number()?));
    Ok(Aabb::new(corner()?, corner()?))
}

pub(super) fn pack_box(b: Aabb, out: &mut Packer) {
    out.vector(b.lo);
    out.vector(b.hi);
}
