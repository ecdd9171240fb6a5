// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one way results reach a caller's array: a writer with an extent and strides, which the threads of
//! a call share because each element is written once.

use super::arrays::{elements, slice};
use super::constants::{EMB_F32, EMB_F64, EMB_I8, EMB_I32};
use super::handle::{aligned, null};
use super::versioned::{self, Versioned};
use crate::error::{Error, Result};
use crate::query::Lattice;
use std::ffi::c_void;
use std::mem::{offset_of, size_of};
use std::ptr;

/// A tensor grid: the point (i, j, k) is (x[i], y[j], z[k]). Coordinates are the caller's own doubles;
/// the library never recomputes lo + i * dx. Each axis is finite and monotone, rising or falling, repeats
/// allowed. A lattice with a zero in n has no points, and a call on it writes nothing; an axis of length 0
/// may be NULL. z NULL with n[2] = 1 is the plane z = 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_lattice {
    /// sizeof(emb_lattice)
    pub struct_size: usize,
    /// Points along each axis.
    pub n: [usize; 3],
    /// n[0] coordinates.
    pub x: *const f64,
    /// n[1] coordinates.
    pub y: *const f64,
    /// n[2] coordinates, or NULL.
    pub z: *const f64,
}

// SAFETY: repr(C), size first, numbers and pointers.
unsafe impl Versioned for emb_lattice {
    const FIRST_SIZE: usize = offset_of!(emb_lattice, z) + size_of::<*const f64>();
    const DEFAULT: emb_lattice = emb_lattice {
        struct_size: size_of::<emb_lattice>(),
        n: [0; 3],
        x: ptr::null(),
        y: ptr::null(),
        z: ptr::null(),
    };
}

/// The caller's array over a lattice: the element of (i, j, k) is data[i*stride[0] + j*stride[1] +
/// k*stride[2]], strides in elements, of either sign. All strides zero: tight, x fastest. Otherwise the
/// axes must nest, in any order: a step along one goes beyond all the elements that the axes of smaller
/// strides reach, so that no element is written twice. data may be NULL where the lattice has no points. An
/// array that is an input is under the same rules and only read.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_array {
    /// sizeof(emb_array)
    pub struct_size: usize,
    /// The element of (0, 0, 0).
    pub data: *mut c_void,
    /// EMB_F64, EMB_F32, EMB_I32 or EMB_I8.
    pub r#type: i32,
    /// Elements from one point to the next along each axis.
    pub stride: [isize; 3],
}

// SAFETY: repr(C), size first, numbers and pointers.
unsafe impl Versioned for emb_array {
    const FIRST_SIZE: usize = offset_of!(emb_array, stride) + size_of::<[isize; 3]>();
    const DEFAULT: emb_array = emb_array::NONE;
}

impl emb_array {
    /// No array.
    pub(super) const NONE: emb_array =
        emb_array { struct_size: size_of::<emb_array>(), data: ptr::null_mut(), r#type: EMB_F64, stride: [0; 3] };
}

/// The lattice that a caller describes.
///
/// # Safety
/// `lattice` is NULL or points to a struct of the size that it states, with axes as it says.
pub(super) unsafe fn lattice<'a>(given: *const emb_lattice) -> Result<Lattice<'a>> {
    // SAFETY: the caller's promise.
    let lattice = unsafe { versioned::read("lattice", given) }?;
    let [nx, ny, nz] = lattice.n;
    // SAFETY: the caller's promise.
    let (x, y) = unsafe { (axis("x", lattice.x, nx, 0)?, axis("y", lattice.y, ny, 1)?) };
    let z = match lattice.z.is_null() && nz == 1 {
        true => &[0.0],
        // SAFETY: the caller's promise.
        false => unsafe { axis("z", lattice.z, nz, 2) }?,
    };
    Lattice::new(x, y, z)
}

/// # Safety
/// `data` is NULL or holds `n` coordinates during `'a`.
unsafe fn axis<'a>(name: &str, data: *const f64, n: usize, at: usize) -> Result<&'a [f64]> {
    let n = elements::<f64>(&format!("lattice.n[{at}]"), n, 1)?;
    // SAFETY: the caller's promise.
    unsafe { slice(&format!("lattice.{name}"), data, n) }
}

/// An array that results go to.
pub(super) struct Writer<T> {
    data: *mut T,
    extent: [usize; 3],
    stride: [isize; 3],
}

// SAFETY: different threads write disjoint sets of elements, and nothing is read.
unsafe impl<T: Send> Send for Writer<T> {}
// SAFETY: as above.
unsafe impl<T: Send> Sync for Writer<T> {}

impl<T: Copy> Writer<T> {
    /// `count` elements, `stride` apart; none where `data` is NULL.
    pub(super) fn line(name: &str, data: *mut T, count: usize, stride: (&str, usize)) -> Result<Option<Writer<T>>> {
        if data.is_null() {
            return Ok(None);
        }
        aligned(name, data)?;
        if stride.1 == 0 {
            return Err(Error::invalid(format!("{}: 0 is not at least 1", stride.0)));
        }
        elements::<T>(if stride.1 == 1 { "count" } else { stride.0 }, count, stride.1)?;
        Ok(Some(Writer { data, extent: [count, 1, 1], stride: [stride.1 as isize, 0, 0] }))
    }

    /// [`Writer::line`] of a tight array that is wanted unless it is empty.
    pub(super) fn required(name: &str, data: *mut T, count: usize) -> Result<Writer<T>> {
        match Writer::line(name, data, count, ("stride", 1))? {
            Some(writer) => Ok(writer),
            None if count == 0 => Ok(Writer { data, extent: [0; 3], stride: [0; 3] }),
            None => Err(null(name)),
        }
    }

    /// An array over `extent` points.
    fn over(name: &str, array: &emb_array, extent: [usize; 3]) -> Result<Writer<T>> {
        let Layout { data, extent, stride } = layout(name, array, extent)?;
        Ok(Writer { data, extent, stride })
    }

    /// Where the elements of (i, j, k), (i+1, j, k), ... begin, of which there are that many.
    #[inline(always)]
    fn at(&self, [i, j, k]: [usize; 3], count: usize) -> *mut T {
        let [nx, ny, nz] = self.extent;
        assert!(i <= nx && count <= nx - i && j < ny && k < nz, "a result outside the array");
        let [sx, sy, sz] = self.stride;
        self.data.wrapping_offset(i as isize * sx + j as isize * sy + k as isize * sz)
    }

    /// Writes the elements of (i, j, k), (i+1, j, k), ... Each element is written by one thread during a call.
    pub(super) fn put(&self, at: [usize; 3], items: impl ExactSizeIterator<Item = T>) {
        let count = items.len();
        if count == 0 {
            return;
        }
        let (mut at, step) = (self.at(at, count), self.stride[0]);
        if step == 1 {
            for (k, item) in items.take(count).enumerate() {
                // SAFETY: inside the extent, whose every element the caller lets us write, and this one is
                // written by this thread alone.
                unsafe { at.wrapping_add(k).write(item) };
            }
            return;
        }
        for item in items.take(count) {
            // SAFETY: as above.
            unsafe { at.write(item) };
            at = at.wrapping_offset(step);
        }
    }

    /// [`Writer::put`] of items that lie side by side.
    pub(super) fn put_copy(&self, at: [usize; 3], items: &[T]) {
        if self.stride[0] != 1 || items.is_empty() {
            return self.put(at, items.iter().copied());
        }
        let to = self.at(at, items.len());
        // SAFETY: as in `put`; the items are the library's own.
        unsafe { ptr::copy_nonoverlapping(items.as_ptr(), to, items.len()) };
    }
}

/// Where the elements of an array are.
pub(super) struct Layout<T> {
    pub(super) data: *mut T,
    pub(super) extent: [usize; 3],
    pub(super) stride: [isize; 3],
}

/// Checks an array over `extent` points; one without points is nowhere.
pub(super) fn layout<T>(name: &str, array: &emb_array, extent: [usize; 3]) -> Result<Layout<T>> {
    let data = array.data.cast::<T>();
    if extent.contains(&0) {
        return Ok(Layout { data, extent: [0; 3], stride: [0; 3] });
    }
    if data.is_null() {
        return Err(null(&format!("{name}.data")));
    }
    aligned(&format!("{name}.data"), data)?;
    let stride = check_strides::<T>(name, array.stride, extent)?;
    Ok(Layout { data, extent, stride })
}

/// The strides to use, where no two points share an element and the array can exist.
fn check_strides<T>(name: &str, stride: [isize; 3], extent: [usize; 3]) -> Result<[isize; 3]> {
    let [nx, ny, nz] = extent;
    if stride == [0; 3] {
        let points = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
        elements::<T>("lattice.n", points.unwrap_or(usize::MAX), 1)?;
        return Ok([1, nx as isize, (nx * ny) as isize]);
    }
    let mut axes = [0, 1, 2];
    axes.sort_by_key(|a| stride[*a].unsigned_abs());
    // How far the axes so far reach, in elements.
    let mut reach = 0usize;
    for a in axes.into_iter().filter(|a| extent[*a] > 1) {
        let step = stride[a].unsigned_abs();
        if step <= reach {
            return Err(Error::invalid(format!("{name}.stride[{a}]: {} makes two points share an element", stride[a])));
        }
        let beyond = step.checked_mul(extent[a] - 1).and_then(|n| n.checked_add(reach));
        reach = beyond
            .filter(|n| *n < isize::MAX as usize / size_of::<T>())
            .ok_or_else(|| Error::invalid(format!("{name}.stride[{a}]: {} is more than memory can hold", stride[a])))?;
    }
    Ok(stride)
}

/// A [`Writer`] of one of the types of floating-point numbers.
pub(super) enum Reals {
    F64(Writer<f64>),
    F32(Writer<f32>),
}

/// A [`Writer`] of one of the integer types.
pub(super) enum Integers {
    I32(Writer<i32>),
    I8(Writer<i8>),
}

/// A [`Writer`] of any type.
pub(super) enum Numbers {
    Reals(Reals),
    Integers(Integers),
}

impl Numbers {
    /// The writer of an array; `name` is the argument's.
    pub(super) fn over(name: &str, array: &emb_array, extent: [usize; 3]) -> Result<Numbers> {
        Ok(match array.r#type {
            EMB_F64 => Numbers::Reals(Reals::F64(Writer::over(name, array, extent)?)),
            EMB_F32 => Numbers::Reals(Reals::F32(Writer::over(name, array, extent)?)),
            EMB_I32 => Numbers::Integers(Integers::I32(Writer::over(name, array, extent)?)),
            EMB_I8 => Numbers::Integers(Integers::I8(Writer::over(name, array, extent)?)),
            other => {
                return Err(Error::invalid(format!("{name}.type: {other} is not one of EMB_F64, _F32, _I32, _I8")));
            }
        })
    }

    /// The writer, where it takes floating-point numbers.
    pub(super) fn reals(self, name: &str) -> Result<Reals> {
        match self {
            Numbers::Reals(writer) => Ok(writer),
            Numbers::Integers(_) => Err(Error::invalid(format!("{name}.type: neither EMB_F64 nor EMB_F32"))),
        }
    }

    /// The writer, where it takes integers.
    pub(super) fn integers(self, name: &str) -> Result<Integers> {
        match self {
            Numbers::Integers(writer) => Ok(writer),
            Numbers::Reals(_) => Err(Error::invalid(format!("{name}.type: neither EMB_I32 nor EMB_I8"))),
        }
    }
}
