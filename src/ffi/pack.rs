// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometries as blocks of bytes, and as files that processes share.

use super::arrays::path as path_of;
use super::callback::{Keepsake, emb_drop_fn};
use super::constants::{EMB_UNPACK_BORROW, EMB_UNPACK_TRUST};
use super::error::{emb_status, guard};
use super::geometry::{construct, emb_geom};
use super::handle::{give, lend, null, writable};
use super::run::{emb_run, with_run};
use crate::error::{Error, Result};
use crate::geometry::{Geometry, UnpackCheck};
use crate::io;
use crate::parallel::Run;
use crate::store::Block;
use std::ffi::{c_char, c_void};
use std::ptr::NonNull;
use std::slice;

/// Writes a geometry as a block of bytes, from which emb_geom_unpack makes one of the same answers, to the bit: to be sent to
/// other ranks, or put into a window of memory that the ranks of a node share.
///
/// *out_size becomes the size in bytes. With `capacity` 0 that is all, and out_block may be NULL; else the block is written to
/// out_block, which has room for `capacity` bytes, at least *out_size of them. It is made of what the geometry is made of and
/// of nothing else: its bytes are the same in every process and for every instruction set and number of threads. Bodies that
/// are used more than once stand there once. A block is read by the versions of embound that write the same version of it,
/// on machines with the same order of bytes.
///
/// A tree that a callback takes part in (emb_geom_callback, emb_blend.function) cannot be packed: EMB_ERROR_UNSUPPORTED.
/// Cost: O(nodes) for the size, O(bytes) for the block. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (capacity is neither 0 nor enough), EMB_ERROR_UNSUPPORTED,
/// EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_pack(
    g: *const emb_geom,
    capacity: usize,
    out_block: *mut c_void,
    out_size: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        writable("out_size", out_size)?;
        let packed = g.packed()?;
        let size = packed.size();
        if capacity > 0 {
            if capacity < size {
                return Err(Error::invalid(format!("capacity: {capacity} bytes are fewer than the {size} needed")));
            }
            let out = NonNull::new(out_block.cast::<u8>()).ok_or_else(|| null("out_block"))?;
            packed.write(slice::from_raw_parts_mut(out.as_ptr(), size), &Run::SERIAL)?;
        }
        out_size.write(size);
        Ok(())
    })
}

/// Makes the geometry of a block that emb_geom_pack wrote: the same answers, to the bit, the same fingerprint and properties.
/// `size` is exactly what emb_geom_pack put into *out_size.
///
/// `flags` are 0 or any of these together. EMB_UNPACK_BORROW: the block is not copied; it must begin at a multiple of 64
/// bytes, and stay, unchanged, until `drop` is run. So one block in memory that the ranks of a node share (MPI's
/// MPI_Win_allocate_shared) serves all of them. EMB_UNPACK_TRUST: the arrays of the block are not looked at, so that this
/// takes no time for their size; the caller knows that they are whole.
///
/// `drop` (may be NULL) is run with `user` when the block is no longer needed: with EMB_UNPACK_BORROW with the last geometry
/// that uses it, which may be one made of this (one that needs nothing of the block does not count), else before this
/// returns. Not if this fails.
///
/// Without EMB_UNPACK_TRUST every byte is looked at, on the calling thread: a damaged block, one that was cut off, and any
/// other bytes are an error, and what is accepted never leads out of the block. Cost: O(bytes), some GB a second; with both
/// flags O(nodes). Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (unknown flags, a borrowed block begins elsewhere),
/// EMB_ERROR_PARSE (not a block, or damaged), EMB_ERROR_UNSUPPORTED (a block of another version, or of a machine with
/// another order of bytes), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_unpack(
    block: *const c_void,
    size: usize,
    flags: i32,
    drop: emb_drop_fn,
    user: *mut c_void,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        let at = NonNull::new(block.cast_mut().cast::<u8>()).ok_or_else(|| null("block"))?;
        if size > isize::MAX as usize {
            return Err(Error::invalid(format!("size: {size} bytes are more than memory can hold")));
        }
        let check = checked(flags)?;
        let keepsake = Keepsake::new(user, drop);
        let block = match flags & EMB_UNPACK_BORROW {
            // SAFETY: the caller lends so many bytes, here until the copy is made.
            0 => Block::copy_of(unsafe { slice::from_raw_parts(at.as_ptr(), size) })?,
            // SAFETY: the caller lends so many bytes until the keepsake is dropped.
            _ => unsafe { Block::lent(at, size, keepsake.clone()) }?,
        };
        let geometry = Geometry::unpacked(block, check, &Run::SERIAL)?;
        keepsake.keep();
        Ok(geometry)
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}

/// Writes the block of emb_geom_pack to a file, without a copy of it in memory. It is written beside and renamed, so that
/// whoever has a file of this name open keeps the one that was. `run` may be NULL.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (run), EMB_ERROR_UNSUPPORTED as of emb_geom_pack,
/// EMB_ERROR_IO, EMB_ERROR_CANCELLED, EMB_ERROR_MEMORY. O(bytes). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_save(g: *const emb_geom, path: *const c_char, run: *const emb_run) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let (g, path) = (lend("g", g)?, path_of("path", path)?);
        with_run(run, |run| {
            run.tell(0.0)?;
            let sealed = g.sealed(run)?;
            io::write_with(path, |file| sealed.write_to(file))?;
            run.tell(1.0)
        })
    })
}

/// Makes the geometry of a file that emb_geom_save wrote, or that holds the block of emb_geom_pack. The file is mapped, not
/// read: all processes of a node that open it share one copy in memory. Nobody may change the file or cut it off while a
/// geometry of it is in use, by this process or another; emb_geom_save never does (it renames), and neither does removing it.
///
/// `flags` is 0 or EMB_UNPACK_TRUST, as of emb_geom_unpack: with it opening takes milliseconds for any size, and what is never
/// asked for is never read; without it every byte is looked at first, on the pool of `run`, which may be NULL.
/// (EMB_UNPACK_BORROW may be given; it is what this does.) Systems other than Unix with 64 bits read the file into memory of
/// their own. Any thread.
/// Errors: as of emb_geom_unpack, and EMB_ERROR_IO, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_open(
    path: *const c_char,
    flags: i32,
    run: *const emb_run,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let path = path_of("path", path)?;
        let check = checked(flags)?;
        writable("out_geom", out_geom)?;
        with_run(run, |run| {
            run.tell(0.0)?;
            let geometry = Geometry::open(path, check, run)?;
            run.tell(1.0)?;
            give(out_geom, geometry);
            Ok(())
        })
    })
}

/// What the flags say of the arrays.
fn checked(flags: i32) -> Result<UnpackCheck> {
    match flags & !(EMB_UNPACK_BORROW | EMB_UNPACK_TRUST) {
        0 if flags & EMB_UNPACK_TRUST != 0 => Ok(UnpackCheck::Trust),
        0 => Ok(UnpackCheck::Check),
        unknown => Err(Error::invalid(format!("flags: {flags:#x} has bits ({unknown:#x}) that are no EMB_UNPACK_*"))),
    }
}
