// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one way a caller's array over a lattice is read: under the rules of the arrays that results go to.

use super::constants::{EMB_F32, EMB_F64, EMB_I8, EMB_I32};
use super::versioned;
use super::writer::{emb_array, layout};
use crate::error::{Error, Result, try_with_capacity};

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
    let ([nx, ny, nz], [sx, sy, sz]) = (layout.extent, layout.stride);
    let mut copy = try_with_capacity(name, nx * ny * nz)?;
    for k in 0..nz {
        for j in 0..ny {
            let row = layout.data.wrapping_offset(j as isize * sy + k as isize * sz);
            // SAFETY: inside the extent, every element of which the caller lets us read.
            copy.extend((0..nx).map(|i| unsafe { row.wrapping_offset(i as isize * sx).read() }.into()));
        }
    }
    Ok(copy)
}
