// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where rays meet the faces of meshes.

use super::arrays::{elements, slice};
use super::error::{emb_status, guard};
use super::geometry::emb_geom;
use super::handle::lend;
use super::results::{Vectors, optional, put};
use super::run::{emb_run, with_run};
use super::versioned::{self, Versioned};
use super::writer::Writer;
use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::query::{self, RayHit, Rays};
use std::mem::{offset_of, size_of};
use std::ptr;

/// What emb_geom_rays writes, item i of each array for ray i, and emb_geom_ray_hits, item i for hit i. Every array may
/// be NULL: not wanted. Vectors as in emb_closest_out. The arrays must not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_ray_out {
    /// sizeof(emb_ray_out)
    pub struct_size: usize,
    /// Where the face is met, at origin + t * direction; NaN where none is.
    pub t: *mut f64,
    /// -1: the ray comes in through the outer side of the face, +1: it goes out through it, 0: nothing is met.
    pub side: *mut i32,
    /// The face's unit normal, outward; NaN where nothing is met.
    pub normal: [*mut f64; 3],
    /// Elements from one vector to the next, at least 1 where a vector is wanted.
    pub vector_stride: usize,
    /// Index of the input face; -1: none.
    pub primitive: *mut i64,
    /// Label of the body (emb_geom_part); -1: none.
    pub part: *mut i32,
    /// Tag of the input face; -1: none.
    pub tag: *mut i32,
}

// SAFETY: repr(C), size first, numbers and pointers.
unsafe impl Versioned for emb_ray_out {
    const FIRST_SIZE: usize = offset_of!(emb_ray_out, tag) + size_of::<*mut i32>();
    const DEFAULT: emb_ray_out = emb_ray_out {
        struct_size: size_of::<emb_ray_out>(),
        t: ptr::null_mut(),
        side: ptr::null_mut(),
        normal: [ptr::null_mut(); 3],
        vector_stride: 0,
        primitive: ptr::null_mut(),
        part: ptr::null_mut(),
        tag: ptr::null_mut(),
    };
}

/// Where [`RayHit`]s go.
struct RayWriter {
    t: Option<Writer<f64>>,
    side: Option<Writer<i32>>,
    normal: Vectors,
    primitive: Option<Writer<i64>>,
    part: Option<Writer<i32>>,
    tag: Option<Writer<i32>>,
}

impl RayWriter {
    /// # Safety
    /// `out` is NULL or points to a struct of the size that it states.
    unsafe fn new(out: *const emb_ray_out, count: usize) -> Result<RayWriter> {
        // SAFETY: the caller's promise.
        let out = unsafe { versioned::read("out", out) }?;
        Ok(RayWriter {
            t: optional("out.t", out.t, count)?,
            side: optional("out.side", out.side, count)?,
            normal: Vectors::new("normal", out.normal, count, out.vector_stride)?,
            primitive: optional("out.primitive", out.primitive, count)?,
            part: optional("out.part", out.part, count)?,
            tag: optional("out.tag", out.tag, count)?,
        })
    }

    fn put(&self, start: usize, hits: &[RayHit]) {
        put(&self.t, start, hits, |h| h.t);
        put(&self.side, start, hits, |h| h.side);
        self.normal.put(start, hits, |h| h.normal);
        put(&self.primitive, start, hits, |h| h.primitive);
        put(&self.part, start, hits, |h| h.part);
        put(&self.tag, start, hits, |h| h.tag);
    }
}

/// The geometry that a caller asks, and the rays.
///
/// # Safety
/// `g` is NULL or alive during `'a`; the arrays are NULL or hold what emb_geom_rays says, unwritten during `'a`.
unsafe fn asked<'a>(
    g: *const emb_geom,
    count: usize,
    origin: *const f64,
    direction: *const f64,
    t_min: *const f64,
    t_max: *const f64,
    t_stride: usize,
) -> Result<(&'a Geometry, Rays<'a>)> {
    // SAFETY: the caller's promise.
    let g = unsafe { lend("g", g) }?;
    let length = elements::<f64>("count", count, 3)?;
    if t_stride > 1 {
        return Err(Error::invalid(format!("t_stride: {t_stride} is neither 0 nor 1")));
    }
    let numbers = if t_stride == 0 { count.min(1) } else { count };
    let range = |name: &str, t: *const f64| match t.is_null() {
        true => Ok(&[][..]),
        // SAFETY: the caller's promise.
        false => unsafe { slice(name, t, numbers) },
    };
    // SAFETY: the caller's promise.
    let (origin, direction) = unsafe { (slice("origin", origin, length)?, slice("direction", direction, length)?) };
    Ok((g, Rays::new(origin, direction, range("t_min", t_min)?, range("t_max", t_max)?)?))
}

/// The first face that each of `count` rays meets: the points origin[3i..3i+2] + t * direction[3i..3i+2] with
/// t_min <= t <= t_max. t_min and t_max hold one number for all rays where t_stride is 0, one a ray where it is 1;
/// NULL: 0 and INFINITY. A segment from a to b is the ray with direction b - a and t from 0 to 1; t_min = -INFINITY
/// makes a ray a line. Directions need not be of unit length. Of equal t the lowest face is told of.
/// g is a mesh, or meshes moved, placed, labelled, complemented, in unions, intersections and differences; every face
/// of every one of them is met, those within another body too (emb_geom_intercepts tells where the solid ends). In a
/// complement, and in what a difference takes away, normals and sides are turned over.
/// Watertight: whether a ray meets a face is decided exactly, and a ray through an edge or a corner is moved by an
/// infinitesimal, the same for all faces of a mesh, so that it meets a closed mesh as often inwards as outwards; both
/// ends of its range belong to it exactly. In a body that is moved or placed, that holds of the ray as that body sees
/// it, rounded once. A face that the ray runs within is not met, nor is one without area.
/// Coordinates and their products must be within 1e-90 and 1e90 for exactness. Cost: grows with the faces along the ray
/// and with the meshes of g.
/// Arrays may be NULL where count is 0. The results do not depend on threads, instruction set or accelerator.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (an origin or direction that is not finite, a direction
/// that is zero or subnormal, t_min > t_max or NaN, naming the ray), EMB_ERROR_UNSUPPORTED (g is made of something
/// other than meshes, which the message names), EMB_ERROR_CANCELLED, EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_rays(
    g: *const emb_geom,
    count: usize,
    origin: *const f64,
    direction: *const f64,
    t_min: *const f64,
    t_max: *const f64,
    t_stride: usize,
    run: *const emb_run,
    out: *const emb_ray_out,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let (g, rays) = asked(g, count, origin, direction, t_min, t_max, t_stride)?;
        let out = RayWriter::new(out, count)?;
        with_run(run, |run| query::first_hits(g, &rays, run, &|start, hits| out.put(start, hits)))
    })
}

/// How many faces each of `count` rays, given as for emb_geom_rays, meets within its range: out_offsets, of count + 1
/// elements, gets the running sums from 0 on, so that ray i has out_offsets[i+1] - out_offsets[i] hits, and all rays
/// together out_offsets[count], the length of the arrays that emb_geom_ray_hits fills.
/// Errors: as emb_geom_rays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_ray_counts(
    g: *const emb_geom,
    count: usize,
    origin: *const f64,
    direction: *const f64,
    t_min: *const f64,
    t_max: *const f64,
    t_stride: usize,
    run: *const emb_run,
    out_offsets: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let (g, rays) = asked(g, count, origin, direction, t_min, t_max, t_stride)?;
        let length = elements::<usize>("count", count.saturating_add(1), 1)?;
        let writer = Writer::required("out_offsets", out_offsets, length)?;
        with_run(run, |run| {
            query::count_hits(g, &rays, run, &|start, counts| writer.put([start + 1, 0, 0], counts.iter().copied()))
        })?;
        // Every element but the first was written.
        out_offsets.write(0);
        let offsets = std::slice::from_raw_parts_mut(out_offsets, length);
        (0..count).for_each(|i| offsets[i + 1] += offsets[i]);
        Ok(())
    })
}

/// Every face that each of `count` rays, given as for emb_geom_rays, meets within its range: those of ray i are the items
/// offsets[i] to offsets[i+1] - 1 of the arrays of `out`, sorted by t, then by face. `offsets` are what
/// emb_geom_ray_counts said of the same rays; the arrays hold offsets[count] items.
/// Errors: as emb_geom_rays; EMB_ERROR_INVALID_ARGUMENT, too, where the offsets do not begin at 0, fall, or are not
/// those of these rays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_ray_hits(
    g: *const emb_geom,
    count: usize,
    origin: *const f64,
    direction: *const f64,
    t_min: *const f64,
    t_max: *const f64,
    t_stride: usize,
    offsets: *const usize,
    run: *const emb_run,
    out: *const emb_ray_out,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let (g, rays) = asked(g, count, origin, direction, t_min, t_max, t_stride)?;
        let length = elements::<usize>("count", count.saturating_add(1), 1)?;
        let offsets = slice("offsets", offsets, length)?;
        let out = RayWriter::new(out, offsets[count])?;
        with_run(run, |run| query::all_hits(g, &rays, offsets, run, &|start, hits| out.put(start, hits)))
    })
}
