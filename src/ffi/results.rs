// SPDX-License-Identifier: MIT OR Apache-2.0
//! Results that come in several arrays, each of which the caller may leave out.

use super::constants::{EMB_CROSSING_COORDINATE, EMB_CROSSING_FRACTION, EMB_ELSEWHERE_LEAVE, EMB_ELSEWHERE_WRITE};
use super::versioned::{self, Versioned};
use super::writer::{Integers, Numbers, Reals, Writer, emb_array};
use crate::error::{Error, Result};
use crate::math::{Vec3, f32_same_sign};
use crate::query::{Closest, Crossing, CrossingForm, Intercept};
use std::mem::{offset_of, size_of};
use std::ptr;

/// What emb_geom_closest writes, item i of each array for point i. Every array may be NULL: not wanted. The
/// three components of a vector are three arrays with one stride: three separate arrays with stride 1, or
/// p, p+1, p+2 with stride 3; a component may be NULL. The arrays must not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_closest_out {
    /// sizeof(emb_closest_out)
    pub struct_size: usize,
    /// The value at the point, the bits that emb_geom_value gives; +-max_distance where nothing is so near.
    pub value: *mut f64,
    /// The closest point of the surface; NaN where nothing is so near, and at a function that is not EMB_EXACT. In a
    /// composite it is the closest point of the part that decides the value: where the composite is EMB_LOWER_BOUND it
    /// may lie off the composite's surface (outside an intersection or a difference, inside a union). It lies on it
    /// where the value there, asked for with emb_geom_values, is zero to rounding.
    pub point: [*mut f64; 3],
    /// The gradient of the value: of length 1, and the outward normal on the surface; by centred differences, and
    /// not normalised, at a function. NaN where nothing is so near.
    pub gradient: [*mut f64; 3],
    /// Weights of the corners of the closest triangle, which sum to 1, in the order in which the input gave them,
    /// whatever orientation did to the face; of a face of more than three corners, of the triangle it was cut into.
    /// NaN where there is no mesh.
    pub barycentric: [*mut f64; 3],
    /// Elements from one vector to the next, at least 1 where a vector is wanted.
    pub vector_stride: usize,
    /// Index of the input face, whatever welding or repair did to it; ties go to the lowest; -1: none.
    pub primitive: *mut i64,
    /// Label of the body (emb_geom_part); -1: none.
    pub part: *mut i32,
    /// Tag of the input face; -1 where there is no mesh, or none so near.
    pub tag: *mut i32,
    /// 0: the inside of the triangle; 1, 2, 3: its edge from corner 0 to 1, 1 to 2, 2 to 0; 4, 5, 6: its corner 0, 1, 2
    /// (corners as for barycentric); -1: not a mesh, or none so near.
    pub feature: *mut i32,
    /// Which of the triangles that the input face was cut into, from 0 in the order of emb_mesh_triangles: 0 where the
    /// face is a triangle; -1: not a mesh, or none so near.
    pub piece: *mut i32,
}

// SAFETY: repr(C), size first, numbers and pointers.
unsafe impl Versioned for emb_closest_out {
    const FIRST_SIZE: usize = offset_of!(emb_closest_out, feature) + size_of::<*mut i32>();
    const DEFAULT: emb_closest_out = emb_closest_out {
        struct_size: size_of::<emb_closest_out>(),
        value: ptr::null_mut(),
        point: [ptr::null_mut(); 3],
        gradient: [ptr::null_mut(); 3],
        barycentric: [ptr::null_mut(); 3],
        vector_stride: 0,
        primitive: ptr::null_mut(),
        part: ptr::null_mut(),
        tag: ptr::null_mut(),
        feature: ptr::null_mut(),
        piece: ptr::null_mut(),
    };
}

/// What emb_geom_intercepts writes, item i of each array for segment i. Every array may be NULL: not wanted.
/// Vectors as in emb_closest_out. The arrays must not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_hit_out {
    /// sizeof(emb_hit_out)
    pub struct_size: usize,
    /// Where the surface is crossed: 0 at a, 1 at b; NaN where both ends are on one side.
    pub t: *mut f64,
    /// How often the surface was met, also where both ends are on one side (baffles, thin walls).
    pub count: *mut i32,
    /// 0: no crossing, 1: found by a ray, 2: the one of several nearest the outside end, 3: bisected on the value.
    pub status: *mut i32,
    /// The surface's unit normal at the crossing, pointing outside; NaN where there is no crossing.
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
unsafe impl Versioned for emb_hit_out {
    const FIRST_SIZE: usize = offset_of!(emb_hit_out, tag) + size_of::<*mut i32>();
    const DEFAULT: emb_hit_out = emb_hit_out {
        struct_size: size_of::<emb_hit_out>(),
        t: ptr::null_mut(),
        count: ptr::null_mut(),
        status: ptr::null_mut(),
        normal: [ptr::null_mut(); 3],
        vector_stride: 0,
        primitive: ptr::null_mut(),
        part: ptr::null_mut(),
        tag: ptr::null_mut(),
    };
}

/// What emb_geom_crossings writes, over the n[axis] - 1 edges along the axis and the points of the other two
/// axes. An array whose data is NULL is not wanted, and the rest of it is not looked at. The arrays must not
/// overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_crossings_out {
    /// sizeof(emb_crossings_out)
    pub struct_size: usize,
    /// EMB_CROSSING_COORDINATE or EMB_CROSSING_FRACTION.
    pub form: i32,
    /// EMB_ELSEWHERE_WRITE or EMB_ELSEWHERE_LEAVE.
    pub elsewhere: i32,
    /// Written to `where` on edges that the surface does not cross: set it, to NAN say, since 0 may be a crossing.
    pub none: f64,
    /// The crossing: EMB_F64 or EMB_F32.
    pub r#where: emb_array,
    /// How often the surface was met, also where both ends are on one side: EMB_I32 or EMB_I8.
    pub count: emb_array,
    /// Tag of the input face, -1: none: EMB_I32.
    pub tag: emb_array,
    /// Label of the body, -1: none: EMB_I32.
    pub part: emb_array,
}

// SAFETY: repr(C), size first, numbers and pointers.
unsafe impl Versioned for emb_crossings_out {
    const FIRST_SIZE: usize = offset_of!(emb_crossings_out, part) + size_of::<emb_array>();
    const DEFAULT: emb_crossings_out = emb_crossings_out {
        struct_size: size_of::<emb_crossings_out>(),
        form: EMB_CROSSING_COORDINATE,
        elsewhere: EMB_ELSEWHERE_WRITE,
        none: 0.0,
        r#where: emb_array::NONE,
        count: emb_array::NONE,
        tag: emb_array::NONE,
        part: emb_array::NONE,
    };
}

/// The three components of a vector.
pub(super) struct Vectors([Option<Writer<f64>>; 3]);

impl Vectors {
    pub(super) fn new(name: &str, data: [*mut f64; 3], count: usize, stride: usize) -> Result<Vectors> {
        let stride = ("out.vector_stride", stride);
        let component = |k: usize| Writer::line(&format!("out.{name}[{k}]"), data[k], count, stride);
        Ok(Vectors([component(0)?, component(1)?, component(2)?]))
    }

    pub(super) fn put<R>(&self, start: usize, results: &[R], vector: impl Fn(&R) -> Vec3) {
        for (axis, writer) in self.0.iter().enumerate() {
            put(writer, start, results, |r| vector(r).to_array()[axis]);
        }
    }
}

/// Writes one member of each result, where it is wanted.
pub(super) fn put<R, T: Copy>(writer: &Option<Writer<T>>, start: usize, results: &[R], member: impl Fn(&R) -> T) {
    if let Some(writer) = writer {
        writer.put([start, 0, 0], results.iter().map(member));
    }
}

/// A tight array that may be left out.
pub(super) fn optional<T: Copy>(name: &str, data: *mut T, count: usize) -> Result<Option<Writer<T>>> {
    Writer::line(name, data, count, ("stride", 1))
}

/// Where [`Closest`] results go.
pub(super) struct ClosestWriter {
    value: Option<Writer<f64>>,
    point: Vectors,
    gradient: Vectors,
    barycentric: Vectors,
    primitive: Option<Writer<i64>>,
    part: Option<Writer<i32>>,
    tag: Option<Writer<i32>>,
    feature: Option<Writer<i32>>,
    piece: Option<Writer<i32>>,
}

impl ClosestWriter {
    /// # Safety
    /// `out` is NULL or points to a struct of the size that it states.
    pub(super) unsafe fn new(out: *const emb_closest_out, count: usize) -> Result<ClosestWriter> {
        // SAFETY: the caller's promise.
        let out = unsafe { versioned::read("out", out) }?;
        Ok(ClosestWriter {
            value: optional("out.value", out.value, count)?,
            point: Vectors::new("point", out.point, count, out.vector_stride)?,
            gradient: Vectors::new("gradient", out.gradient, count, out.vector_stride)?,
            barycentric: Vectors::new("barycentric", out.barycentric, count, out.vector_stride)?,
            primitive: optional("out.primitive", out.primitive, count)?,
            part: optional("out.part", out.part, count)?,
            tag: optional("out.tag", out.tag, count)?,
            feature: optional("out.feature", out.feature, count)?,
            piece: optional("out.piece", out.piece, count)?,
        })
    }

    pub(super) fn put(&self, start: usize, results: &[Closest]) {
        put(&self.value, start, results, |r| r.value);
        self.point.put(start, results, |r| r.point);
        self.gradient.put(start, results, |r| r.gradient);
        self.barycentric.put(start, results, |r| r.barycentric);
        put(&self.primitive, start, results, |r| r.primitive);
        put(&self.part, start, results, |r| r.part);
        put(&self.tag, start, results, |r| r.tag);
        put(&self.feature, start, results, |r| r.feature);
        put(&self.piece, start, results, |r| r.piece);
    }
}

/// Where [`Intercept`] results go.
pub(super) struct HitWriter {
    t: Option<Writer<f64>>,
    count: Option<Writer<i32>>,
    status: Option<Writer<i32>>,
    normal: Vectors,
    primitive: Option<Writer<i64>>,
    part: Option<Writer<i32>>,
    tag: Option<Writer<i32>>,
}

impl HitWriter {
    /// # Safety
    /// `out` is NULL or points to a struct of the size that it states.
    pub(super) unsafe fn new(out: *const emb_hit_out, count: usize) -> Result<HitWriter> {
        // SAFETY: the caller's promise.
        let out = unsafe { versioned::read("out", out) }?;
        Ok(HitWriter {
            t: optional("out.t", out.t, count)?,
            count: optional("out.count", out.count, count)?,
            status: optional("out.status", out.status, count)?,
            normal: Vectors::new("normal", out.normal, count, out.vector_stride)?,
            primitive: optional("out.primitive", out.primitive, count)?,
            part: optional("out.part", out.part, count)?,
            tag: optional("out.tag", out.tag, count)?,
        })
    }

    pub(super) fn put(&self, start: usize, results: &[Intercept]) {
        put(&self.t, start, results, |r| r.t);
        put(&self.count, start, results, |r| r.count);
        put(&self.status, start, results, |r| r.status);
        self.normal.put(start, results, |r| r.normal);
        put(&self.primitive, start, results, |r| r.primitive);
        put(&self.part, start, results, |r| r.part);
        put(&self.tag, start, results, |r| r.tag);
    }
}

/// Where [`Crossing`] results go.
pub(super) struct CrossingsWriter {
    pub(super) form: CrossingForm,
    leave: bool,
    none: f64,
    place: Option<Reals>,
    count: Option<Integers>,
    tag: Option<Writer<i32>>,
    part: Option<Writer<i32>>,
}

impl CrossingsWriter {
    /// # Safety
    /// `out` is NULL or points to a struct of the size that it states.
    pub(super) unsafe fn new(out: *const emb_crossings_out, edges: [usize; 3]) -> Result<CrossingsWriter> {
        // SAFETY: the caller's promise.
        let out = unsafe { versioned::read("out", out) }?;
        let form = match out.form {
            EMB_CROSSING_COORDINATE => CrossingForm::Coordinate,
            EMB_CROSSING_FRACTION => CrossingForm::Fraction,
            other => return Err(Error::invalid(format!("out.form: {other} is not an EMB_CROSSING_*"))),
        };
        let leave = match out.elsewhere {
            EMB_ELSEWHERE_WRITE => false,
            EMB_ELSEWHERE_LEAVE => true,
            other => return Err(Error::invalid(format!("out.elsewhere: {other} is not an EMB_ELSEWHERE_*"))),
        };
        let place = embedded("out.where", &out.r#where, edges)?.map(|w| w.reals("out.where")).transpose()?;
        let count = embedded("out.count", &out.count, edges)?.map(|w| w.integers("out.count")).transpose()?;
        let (tag, part) = (label("out.tag", &out.tag, edges)?, label("out.part", &out.part, edges)?);
        Ok(CrossingsWriter { form, leave, none: out.none, place, count, tag, part })
    }

    /// Writes a row of edges, of which `found` meet the surface. With EMB_ELSEWHERE_LEAVE only what it crosses.
    pub(super) fn put(&self, at: [usize; 3], edges: usize, found: &[(usize, Crossing)]) {
        if !self.leave {
            self.put_same(at, edges, &Crossing { at: f64::NAN, count: 0, tag: -1, part: -1 });
        }
        for (k, crossing) in found {
            if !(self.leave && crossing.at.is_nan()) {
                self.put_same([at[0] + k, at[1], at[2]], 1, crossing);
            }
        }
    }

    /// Writes the same to each of a run of edges.
    fn put_same(&self, at: [usize; 3], edges: usize, crossing: &Crossing) {
        let place = if crossing.at.is_nan() { self.none } else { crossing.at };
        match &self.place {
            Some(Reals::F64(writer)) => writer.put(at, (0..edges).map(|_| place)),
            Some(Reals::F32(writer)) => writer.put(at, (0..edges).map(|_| f32_same_sign(place))),
            None => {}
        }
        match &self.count {
            Some(Integers::I32(writer)) => writer.put(at, (0..edges).map(|_| crossing.count)),
            Some(Integers::I8(writer)) => writer.put(at, (0..edges).map(|_| crossing.count.min(127) as i8)),
            None => {}
        }
        if let Some(writer) = &self.tag {
            writer.put(at, (0..edges).map(|_| crossing.tag));
        }
        if let Some(writer) = &self.part {
            writer.put(at, (0..edges).map(|_| crossing.part));
        }
    }
}

/// The writer of an array inside another struct, which cannot grow there.
fn embedded(name: &str, array: &emb_array, edges: [usize; 3]) -> Result<Option<Numbers>> {
    if array.data.is_null() {
        return Ok(None);
    }
    if array.struct_size != size_of::<emb_array>() {
        let (given, size) = (array.struct_size, size_of::<emb_array>());
        return Err(Error::invalid(format!("{name}.struct_size: {given} is not {size}")));
    }
    Numbers::over(name, array, edges).map(Some)
}

/// The writer of an array of labels, which 8 bits cannot hold.
fn label(name: &str, array: &emb_array, edges: [usize; 3]) -> Result<Option<Writer<i32>>> {
    match embedded(name, array, edges)? {
        None => Ok(None),
        Some(Numbers::Integers(Integers::I32(writer))) => Ok(Some(writer)),
        Some(_) => Err(Error::invalid(format!("{name}.type: {} is not EMB_I32", array.r#type))),
    }
}
