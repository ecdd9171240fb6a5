// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors of bodies from samples over a lattice, and from expressions.

use super::error::{emb_status, guard};
use super::geometry::{construct, emb_geom};
use super::handle::null;
use super::reader;
use super::versioned::{self, Versioned};
use super::writer::{emb_array, emb_lattice, lattice};
use crate::error::{Error, Result};
use crate::geometry::{ExpressionOptions, Geometry};
use crate::math::{Aabb, Vec3};
use crate::query::Lattice;
use std::ffi::{CStr, c_char};
use std::mem::{offset_of, size_of};

/// What the caller knows of an expression; fill it with emb_expression_options_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_expression_options {
    /// sizeof(emb_expression_options)
    pub struct_size: usize,
    /// Lower corner of a box that the body is cut off at; -INFINITY by default.
    pub lo: [f64; 3],
    /// Upper corner of that box; +INFINITY by default.
    pub hi: [f64; 3],
    /// A constant L with |f(p) - f(q)| <= L |p - q| within the box, vouched for by the caller; 0, the default: it is
    /// looked for where the box is finite.
    pub lipschitz: f64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_expression_options {
    const FIRST_SIZE: usize = offset_of!(emb_expression_options, lipschitz) + size_of::<f64>();
    const DEFAULT: emb_expression_options = emb_expression_options {
        struct_size: size_of::<emb_expression_options>(),
        lo: [f64::NEG_INFINITY; 3],
        hi: [f64::INFINITY; 3],
        lipschitz: 0.0,
    };
}

/// The lengths of the axes, of which the first `dimensions` need two points or more.
fn sampled_extent(lattice: &Lattice, dimensions: usize) -> Result<[usize; 3]> {
    let n = lattice.n();
    match (0..dimensions).find(|&k| n[k] < 2) {
        Some(k) => Err(Error::invalid(format!("lattice.n[{k}]: {} is not at least 2", n[k]))),
        None => Ok(n),
    }
}

/// Terrain: solid below z = h(x, y), bilinear between `heights`, which is an array of EMB_F64 or EMB_F32 over a
/// lattice of two axes (z NULL, n[2] 1), each of at least two coordinates that rise or fall strictly. Beyond the
/// lattice the edge's heights go on; the body has no end to the sides and below: intersect it with a box. The sign is
/// exactly that of z - h; the value is (z - h) / sqrt(1 + g^2), g the greatest slope: a lower bound of the distance
/// (Hart 1996). The samples are copied. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (the lattice, a
/// height that is not finite: `heights[i + nx j]`, a slope above 1e150), EMB_ERROR_MEMORY. Cost: linear in the
/// samples; a value takes O(1) where the axes are even, else O(log n).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_height_field(
    lattice: *const emb_lattice,
    heights: *const emb_array,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let plane = unsafe { versioned::read("lattice", lattice) }?;
        if plane.n[2] != 1 {
            return Err(Error::invalid(format!("lattice.n[2]: {} is not 1", plane.n[2])));
        }
        if !plane.z.is_null() {
            return Err(Error::invalid("lattice.z: not NULL, and heights have none"));
        }
        // SAFETY: pointers as the header asks.
        let lattice = unsafe { self::lattice(lattice) }?;
        // SAFETY: as above.
        let heights = unsafe { reader::reals("heights", heights, sampled_extent(&lattice, 2)?) }?;
        let [x, y, _] = lattice.axes;
        Geometry::height_field([x, y], &heights)
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// A function sampled on a lattice, negative inside: trilinear between `values`, which is an array of EMB_F64 or
/// EMB_F32 over it; each axis has at least two coordinates that rise or fall strictly. Beyond the lattice the value is
/// that at its nearest point, so a body that reaches the border goes on without end. The Lipschitz constant comes from
/// the values; where it is at most 1 they are a lower bound of the distance, else EMB_SIGN_ONLY. The samples are
/// copied. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (the lattice, a value that is not finite:
/// `values[i + nx (j + ny k)]`, a slope above 1e150), EMB_ERROR_MEMORY. Cost: linear in the samples; a value takes
/// O(1) where the axes are even, else O(log n).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_grid(
    lattice: *const emb_lattice,
    values: *const emb_array,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        // SAFETY: pointers as the header asks.
        let lattice = unsafe { self::lattice(lattice) }?;
        // SAFETY: as above.
        let values = unsafe { reader::reals("values", values, sampled_extent(&lattice, 3)?) }?;
        Geometry::grid(lattice.axes, &values)
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_expression_options_init(options: *mut emb_expression_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// The body where an expression of x, y and z is negative, such as `sqrt(x^2+y^2) - 0.3*sin(4*z)`: operators + - * / ^
/// with the usual priorities (-x^2 is -(x^2), a^b^c is a^(b^c)), numbers such as 1.5e-3, the constants pi and e,
/// the functions sqrt abs exp ln log10 sin cos tan asin acos atan sinh cosh tanh, pow(a, b), atan2(y, x), and min and
/// max of two or more. A whole exponent up to 64 multiplies out. At most 65536 bytes and 200 parentheses within each
/// other. Values have the same bits on every machine; where the expression has none, emb_geom_value gives NaN and
/// batches give EMB_ERROR_CALLBACK. The body is cut off at options->lo and hi. A lower bound of the distance where its
/// Lipschitz constant is at most 1, else EMB_SIGN_ONLY, and then so is all that is made with it: give it finite bounds,
/// over which the constant is found, and take emb_geom_lower_bound of it first. `options` may be NULL. Names are
/// case-sensitive.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (the options; the text, naming what is wrong and its
/// byte, counted from 0), EMB_ERROR_MEMORY. Cost: linear in the text, and where the Lipschitz constant is looked for up to some
/// thousand evaluations.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_expression(
    expression: *const c_char,
    options: *const emb_expression_options,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        if expression.is_null() {
            return Err(null("expression"));
        }
        // SAFETY: a text that ends with a zero byte, as the header asks.
        let text = unsafe { CStr::from_ptr(expression) };
        let text =
            text.to_str().map_err(|e| Error::invalid(format!("expression: byte {} is not UTF-8", e.valid_up_to())))?;
        // SAFETY: pointers as the header asks.
        let options = unsafe { versioned::read_or_default("options", options) }?;
        let bounds = Aabb::new(Vec3::from(options.lo), Vec3::from(options.hi));
        Geometry::expression(text, &ExpressionOptions { bounds, lipschitz: options.lipschitz })
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}
