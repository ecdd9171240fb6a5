// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one way a caller's array over a lattice is read: under the rules of the arrays that results go to.

use super::constants::{EMB_F32, EMB_F64, EMB_I8, EMB_I32};
use super::versioned;
use super::writer::{Layout, emb_array, layout};
use crate::error::{Error, Result, try_with_capacity};
use crate::mesh::FieldType;

/// The floating-point numbers of an array over `extent` points, x fastest; `name` is the argument's.
///
/// # Safety
/// `given` is NULL or points to a struct of the size that it states, whose array holds the elements it says.
pub(super) unsafe fn reals(name: &str, given: *const emb_array, extent: [usize; 3]) -> Result<Vec<f64>> {
    // SAFETY: the caller's promise.
    let array = unsafe { versioned::read(name, given) }?;
    match array.r#type {
        // SAFETY: the caller's promise.
        EMB_F64 => unsafe { elements::<f64>(name, &array, extent) },
        // SAFETY: the caller's promise.
        EMB_F32 => unsafe { elements::<f32>(name, &array, extent) },
        EMB_I32 | EMB_I8 => Err(Error::invalid(format!("{name}.type: neither EMB_F64 nor EMB_F32"))),
        other => Err(Error::invalid(format!("{name}.type: {other} is not one of EMB_F64, _F32, _I32, _I8"))),
    }
}

/// # Safety
/// The array holds elements of type `T` where it says.
unsafe fn elements<T: Copy + Into<f64>>(name: &str, array: &emb_array, extent: [usize; 3]) -> Result<Vec<f64>> {
    let layout = layout::<T>(name, array, extent)?;
    let [nx, ny, nz] = layout.extent;
    let mut copy = try_with_capacity(name, nx * ny * nz)?;
    for k in 0..nz {
        for j in 0..ny {
            // SAFETY: inside the extent, every element of which the caller lets us read.
            copy.extend(unsafe { row(&layout, j, k) });
        }
    }
    Ok(copy)
}

/// # Safety
/// (0, j, k) is within the extent, which holds elements.
unsafe fn row<T: Copy + Into<f64>>(layout: &Layout<T>, j: usize, k: usize) -> impl Iterator<Item = f64> + use<T> {
    let [sx, sy, sz] = layout.stride;
    let first = layout.data.wrapping_offset(j as isize * sy + k as isize * sz);
    // SAFETY: the caller's promise.
    (0..layout.extent[0]).map(move |i| unsafe { first.wrapping_offset(i as isize * sx).read() }.into())
}

/// What gives the values of a row: those of (0, j, k), (1, j, k), ...
type Rows<'a> = Box<dyn Fn(usize, usize, &mut [f64]) + 'a>;

/// The numbers of an array of any type over `extent` points, and the type; nothing is copied.
///
/// # Safety
/// `given` is NULL or points to a struct of the size that it states, whose array holds the elements it says as long
/// as they are read.
pub(super) unsafe fn rows<'a>(
    name: &str,
    given: *const emb_array,
    extent: [usize; 3],
) -> Result<(FieldType, Rows<'a>)> {
    // SAFETY: the caller's promise.
    let array = unsafe { versioned::read(name, given) }?;
    match array.r#type {
        // SAFETY: the caller's promise.
        EMB_F64 => Ok((FieldType::F64, unsafe { rows_of::<f64>(name, &array, extent) }?)),
        // SAFETY: the caller's promise.
        EMB_F32 => Ok((FieldType::F32, unsafe { rows_of::<f32>(name, &array, extent) }?)),
        // SAFETY: the caller's promise.
        EMB_I32 => Ok((FieldType::I32, unsafe { rows_of::<i32>(name, &array, extent) }?)),
        // SAFETY: the caller's promise.
        EMB_I8 => Ok((FieldType::I8, unsafe { rows_of::<i8>(name, &array, extent) }?)),
        other => Err(Error::invalid(format!("{name}.type: {other} is not one of EMB_F64, _F32, _I32, _I8"))),
    }
}

/// # Safety
/// The array holds elements of type `T` where it says.
unsafe fn rows_of<'a, T: Copy + Into<f64> + 'a>(name: &str, array: &emb_array, extent: [usize; 3]) -> Result<Rows<'a>> {
    let layout = layout::<T>(name, array, extent)?;
    Ok(Box::new(move |j, k, out| {
        let [_, ny, nz] = layout.extent;
        assert!(j < ny && k < nz, "a row outside the array");
        // SAFETY: inside the extent, every element of which the caller lets us read.
        out.iter_mut().zip(unsafe { row(&layout, j, k) }).for_each(|(slot, x)| *slot = x);
    }))
}
