// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometries: the handle, what it says of itself, its bounds, and the distance to a mesh. What else they are
//! made of stands in shapes.rs, sampled.rs, function.rs, transforms.rs and combine.rs.

use super::constants::{
    EMB_ACCELERATOR_AUTO, EMB_ACCELERATOR_COMPACT, EMB_ACCELERATOR_NONE, EMB_OPEN_CAP, EMB_OPEN_ERROR, EMB_OPEN_SWEEP,
    EMB_SIGN_AUTO, EMB_SIGN_AXIS, EMB_SIGN_NONE, EMB_SIGN_ONLY, EMB_SIGN_PSEUDONORMAL, EMB_SIGN_RAY, EMB_SIGN_WINDING,
};
use super::error::{emb_status, guard, plain, quiet};
use super::handle::{Handle, give, lend, release, share, writable};
use super::lists::give_text;
use super::mesh::emb_mesh;
use super::run::{emb_run, with_run};
use super::versioned::{self, Versioned};
use crate::error::{Error, Result};
use crate::geometry::{Accelerator, Geometry, Open, SdfOptions, SignMethod};
use std::ffi::c_char;
use std::mem::{offset_of, size_of};

/// An implicit function: negative inside the body, positive outside, zero on the surface and counted as
/// inside. Immutable. A composite keeps its parts alive, so handles may be freed in any order.
pub struct emb_geom {
    _opaque: (),
}

impl Handle for emb_geom {
    type Target = Geometry;
}

/// How a mesh becomes a geometry; fill it with emb_sdf_options_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_sdf_options {
    /// sizeof(emb_sdf_options)
    pub struct_size: usize,
    /// EMB_SIGN_AUTO, the default, or another EMB_SIGN_*.
    pub sign: i32,
    /// EMB_OPEN_ERROR, the default, or another EMB_OPEN_*.
    pub open: i32,
    /// 0, 1 or 2: the axis of EMB_SIGN_AXIS.
    pub axis: i32,
    /// EMB_ACCELERATOR_AUTO, the default, or another EMB_ACCELERATOR_*.
    pub accelerator: i32,
    /// Box of EMB_OPEN_SWEEP, lower corner: the domain of the solver.
    pub open_lo: [f64; 3],
    /// Box of EMB_OPEN_SWEEP, upper corner.
    pub open_hi: [f64; 3],
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_sdf_options {
    const FIRST_SIZE: usize = offset_of!(emb_sdf_options, open_hi) + size_of::<[f64; 3]>();
    const DEFAULT: emb_sdf_options = emb_sdf_options {
        struct_size: size_of::<emb_sdf_options>(),
        sign: EMB_SIGN_AUTO,
        open: EMB_OPEN_ERROR,
        axis: 0,
        accelerator: EMB_ACCELERATOR_AUTO,
        open_lo: [0.0; 3],
        open_hi: [0.0; 3],
    };
}

impl emb_sdf_options {
    fn convert(&self) -> Result<SdfOptions> {
        let sign = match self.sign {
            EMB_SIGN_AUTO => SignMethod::Auto,
            EMB_SIGN_PSEUDONORMAL => SignMethod::Pseudonormal,
            EMB_SIGN_WINDING => SignMethod::Winding,
            EMB_SIGN_RAY => SignMethod::Ray,
            EMB_SIGN_AXIS => SignMethod::Axis,
            EMB_SIGN_NONE => SignMethod::None,
            other => return Err(Error::invalid(format!("options.sign: {other} is not an EMB_SIGN_*"))),
        };
        let open = match self.open {
            EMB_OPEN_ERROR => Open::Error,
            EMB_OPEN_CAP => Open::Cap,
            EMB_OPEN_SWEEP => Open::Sweep,
            other => return Err(Error::invalid(format!("options.open: {other} is not an EMB_OPEN_*"))),
        };
        if !(0..=2).contains(&self.axis) {
            return Err(Error::invalid(format!("options.axis: {} is not 0, 1 or 2", self.axis)));
        }
        let accelerator = match self.accelerator {
            EMB_ACCELERATOR_AUTO => Accelerator::Auto,
            EMB_ACCELERATOR_NONE => Accelerator::None,
            EMB_ACCELERATOR_COMPACT => Accelerator::Compact,
            other => return Err(Error::invalid(format!("options.accelerator: {other} is not an EMB_ACCELERATOR_*"))),
        };
        Ok(SdfOptions { sign, open, axis: self.axis, accelerator, open_lo: self.open_lo, open_hi: self.open_hi })
    }
}

/// What a geometry says of itself.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_geom_properties {
    /// sizeof(emb_geom_properties), set by the caller
    pub struct_size: usize,
    /// EMB_EXACT, EMB_LOWER_BOUND or EMB_SIGN_ONLY.
    pub kind: i32,
    /// How the sign of the mesh is decided, EMB_SIGN_*; EMB_SIGN_AUTO where there is no mesh, or several
    /// with different methods.
    pub sign_method: i32,
    /// |f(p) - f(q)| <= lipschitz * |p - q|; INFINITY where unknown, and where the sign may change across a hole of a
    /// mesh.
    pub lipschitz: f64,
    /// Triangles and shapes, a shared part as often as it is used.
    pub primitives: u64,
    /// Memory in bytes, a shared part counted once.
    pub bytes: u64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_geom_properties {
    const FIRST_SIZE: usize = offset_of!(emb_geom_properties, bytes) + size_of::<u64>();
    const DEFAULT: emb_geom_properties = emb_geom_properties {
        struct_size: size_of::<emb_geom_properties>(),
        kind: EMB_SIGN_ONLY,
        sign_method: EMB_SIGN_AUTO,
        lipschitz: f64::INFINITY,
        primitives: 0,
        bytes: 0,
    };
}

/// Every constructor: checks the place for the result, builds, hands over.
///
/// # Safety
/// `out_geom` is NULL or may be written.
pub(super) unsafe fn construct(out_geom: *mut *mut emb_geom, build: impl FnOnce() -> Result<Geometry>) -> emb_status {
    guard(|| {
        writable("out_geom", out_geom)?;
        let geometry = build()?;
        // SAFETY: checked above, and the caller's promise.
        unsafe { give(out_geom, geometry) };
        Ok(())
    })
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_sdf_options_init(options: *mut emb_sdf_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// The signed distance to a mesh: exact, the same bits with every accelerator, pool and instruction set. The
/// sign is that of angle-weighted pseudonormals (Baerentzen & Aanaes 2005) where they are right everywhere, of
/// exact crossings elsewhere, and across small holes that of the winding number (EMB_SIGN_*). The distance is that to the
/// nearest face, whichever: where a mesh passes through itself also to one within the body, though its kind is EMB_EXACT. `options` may be NULL. The mesh may be freed afterwards.
/// On success *out_geom is the caller's, to be freed with emb_geom_free.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_TOPOLOGY (EMB_SIGN_AUTO on a mesh whose holes
/// are large, with the loops and the counts; EMB_SIGN_PSEUDONORMAL on one that is open, has edges of more than two faces or
/// meets itself; loops that options.open cannot close), EMB_ERROR_MEMORY, EMB_ERROR_CANCELLED. Cost: n log n in the
/// triangles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_from_mesh(
    mesh: *const emb_mesh,
    options: *const emb_sdf_options,
    run: *const emb_run,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let options = versioned::read_or_default("options", options)?.convert()?;
        writable("out_geom", out_geom)?;
        with_run(run, |run| {
            give(out_geom, Geometry::from_mesh(mesh, &options, run)?);
            Ok(())
        })
    })
}

/// How the sign of a geometry's meshes is decided, and why: a line each, separated by line feeds, none where there is no
/// mesh; a shared mesh is told of once. For people: the words may change, emb_geom_properties.sign_method does not.
/// capacity 0: only out_size is written, which counts the zero byte at the end; else out_text holds `capacity` bytes, at
/// least that many. Any thread. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a capacity too small),
/// EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_sign_text(
    g: *const emb_geom,
    capacity: usize,
    out_text: *mut c_char,
    out_size: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe { give_text("out_text", &lend("g", g)?.sign_text(), capacity, out_text, out_size) })
}

/// The same body, labelled: closest points, crossings and intercepts on it report `part`. Of nested labels the
/// innermost wins. `part` is at least 0, or -1 for none. O(1), shares g.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_part(g: *const emb_geom, part: i32, out_geom: *mut *mut emb_geom) -> emb_status {
    let build = || match part {
        // SAFETY: a handle or NULL, as the header asks.
        -1.. => unsafe { lend("g", g) }?.part(part),
        _ => Err(Error::invalid(format!("part: {part} is not -1 or more"))),
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// One more reference to the same geometry, to be freed like the first; NULL for NULL. O(1). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_clone(g: *const emb_geom) -> *mut emb_geom {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { share(g) }
}

/// Gives up a reference. Geometries built from this one live on. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_free(g: *mut emb_geom) {
    // SAFETY: a handle or NULL that is not used again, as the header asks.
    plain((), || unsafe { release(g) });
}

/// A number that is equal for equal content, on every rank, instruction set and run; 0 for NULL and for geometries
/// with user functions or blends in them. Cost: linear in the memory of the geometry at most. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_fingerprint(g: *const emb_geom) -> u64 {
    // SAFETY: a handle or NULL, as the header asks.
    quiet(0, || unsafe { lend("g", g) }.map_or(0, Geometry::fingerprint))
}

/// A box around the body: infinite where it is unbounded; lo = +INFINITY, hi = -INFINITY where there is none. O(1).
/// Any thread. Errors: EMB_ERROR_NULL_ARGUMENT.
/// cbindgen:ptrs-as-arrays=[[out_lo;3], [out_hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_bounds(g: *const emb_geom, out_lo: *mut f64, out_hi: *mut f64) -> emb_status {
    guard(|| {
        // SAFETY: a handle or NULL, as the header asks.
        let g = unsafe { lend("g", g) }?;
        writable("out_lo", out_lo)?;
        writable("out_hi", out_hi)?;
        let bounds = g.bounds();
        // SAFETY: checked above; each holds three numbers, as the header asks.
        unsafe {
            out_lo.cast::<[f64; 3]>().write(bounds.lo.to_array());
            out_hi.cast::<[f64; 3]>().write(bounds.hi.to_array());
        }
        Ok(())
    })
}

/// Writes what the geometry says of itself to *properties, whose struct_size the caller has set; nothing is
/// written beyond that size. Any thread. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_properties_get(
    g: *const emb_geom,
    properties: *mut emb_geom_properties,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let size = versioned::result_size("properties", properties)?;
        let known = g.properties();
        let value = emb_geom_properties {
            kind: known.kind as i32,
            sign_method: known.sign_method as i32,
            lipschitz: known.lipschitz,
            primitives: known.primitives,
            bytes: known.bytes,
            ..emb_geom_properties::DEFAULT
        };
        versioned::write_result(properties, size, value);
        Ok(())
    })
}
