// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a geometry says of itself, and the options it is built with.

use crate::math::{Aabb, Interval, Vec3};

/// What the magnitude of a value means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
pub enum Kind {
    /// The distance to the surface.
    Exact = 0,
    /// Not above the distance to the surface.
    LowerBound = 1,
    /// Nothing: only the sign counts.
    SignOnly = 2,
}

/// How the sign of a mesh is decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum SignMethod {
    /// Pseudonormals where they are right everywhere, exact crossings elsewhere; what was chosen stands
    /// in [`Properties::sign_method`].
    #[default]
    Auto = 0,
    /// Angle-weighted pseudonormals.
    Pseudonormal = 1,
    /// Generalised winding number.
    Winding = 2,
    /// Exact crossings of a ray.
    Ray = 3,
    /// Solid behind the first hit along an axis (terrain sheets).
    Axis = 4,
    /// Unsigned: never inside (baffles).
    None = 5,
}

/// What to do about boundary loops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Open {
    /// An open mesh is an error.
    #[default]
    Error = 0,
    /// Loops are capped.
    Cap = 1,
    /// Loops are swept beyond a box.
    Sweep = 2,
}

/// How the nearest triangle is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Accelerator {
    /// A bounding volume hierarchy.
    #[default]
    Auto = 0,
    /// Every triangle is looked at: slow, and the reference for every other choice.
    None = 1,
    /// A hierarchy of small memory.
    Compact = 2,
}

/// What is looked at when the vertices of a mesh have moved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum RefitCheck {
    /// Where the surface meets itself now.
    #[default]
    Check = 0,
    /// Nothing: it is known to meet itself nowhere but where it did. If it does, signs are wrong wherever such a place is
    /// the nearest, and questions may disagree there.
    Trust = 1,
}

/// What is looked at when a geometry is unpacked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum UnpackCheck {
    /// All of it: damage is an error, and so is what no geometry is made of.
    #[default]
    Check = 0,
    /// Its front, but not its arrays, of which nothing is read: they are known to be whole, because another process looked
    /// at them, say. If they are not, answers are wrong, fail, or may not end.
    Trust = 1,
}

/// How a mesh becomes a geometry.
#[derive(Clone, Debug, Default)]
pub struct SdfOptions {
    /// Sign method.
    pub sign: SignMethod,
    /// Boundary loops.
    pub open: Open,
    /// Axis of [`SignMethod::Axis`].
    pub axis: i32,
    /// Acceleration.
    pub accelerator: Accelerator,
    /// Box of [`Open::Sweep`], lower corner.
    pub open_lo: [f64; 3],
    /// Box of [`Open::Sweep`], upper corner.
    pub open_hi: [f64; 3],
}

/// What a geometry says of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Meaning of the magnitude.
    pub kind: Kind,
    /// How the sign of the mesh is decided; [`SignMethod::Auto`] where there is no mesh or several methods.
    pub sign_method: SignMethod,
    /// |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown.
    pub lipschitz: f64,
    /// Triangles and shapes.
    pub primitives: u64,
    /// Memory of the tree in bytes, shared parts counted once.
    pub bytes: u64,
}

/// A user's implicit function.
pub trait Function: Send + Sync {
    /// The value; NaN says that the function failed.
    fn value(&self, p: Vec3) -> f64;

    /// The values at many points: those of [`Function::value`], to the bit.
    fn values(&self, points: &[Vec3], out: &mut [f64]) {
        points.iter().zip(out).for_each(|(p, value)| *value = self.value(*p));
    }

    /// Whether [`Function::values`] is more than a loop, so that points should be gathered for it.
    fn is_batched(&self) -> bool {
        false
    }

    /// The gradient where the function knows it; centred differences are taken where it does not.
    fn gradient(&self, _p: Vec3) -> Option<Vec3> {
        None
    }

    /// Numbers between which every value in a box lies, where the function knows some.
    fn range(&self, _b: Aabb) -> Option<Interval> {
        None
    }
}

/// What the user knows of a function.
#[derive(Clone, Debug)]
pub struct FunctionOptions {
    /// A box around the body; all of space by default. The caller vouches for it.
    pub bounds: Aabb,
    /// Lipschitz constant; 0 where unknown.
    pub lipschitz: f64,
    /// Step of the centred differences of the gradient; 0: 1e-6 of the bounds' diagonal, or 1e-6.
    pub gradient_step: f64,
    /// Meaning of the magnitude.
    pub kind: Kind,
    /// Whether several threads may call it at once.
    pub thread_safe: bool,
}

impl Default for FunctionOptions {
    fn default() -> FunctionOptions {
        FunctionOptions {
            bounds: Aabb::ALL,
            lipschitz: 0.0,
            gradient_step: 0.0,
            kind: Kind::SignOnly,
            thread_safe: false,
        }
    }
}
