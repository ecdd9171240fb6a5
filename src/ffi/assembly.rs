// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes taken apart and put together.

use super::arrays::{elements, path, slice};
use super::constants::{EMB_JOIN_BY_MESH, EMB_JOIN_KEEP, EMB_JOIN_RENUMBER, EMB_SPLIT_COMPONENT, EMB_SPLIT_TAG};
use super::error::{emb_status, guard};
use super::handle::{give, lend, writable};
use super::mesh::{emb_mesh, emb_mesh_options, options};
use super::run::{emb_run, with_run};
use crate::error::{Error, Result, try_with_capacity};
use crate::io;
use crate::mesh::{JoinTags, Mesh, SplitBy};
use std::ffi::c_char;
use std::path::Path;

fn join_tags(tags: i32) -> Result<JoinTags> {
    match tags {
        EMB_JOIN_KEEP => Ok(JoinTags::Keep),
        EMB_JOIN_RENUMBER => Ok(JoinTags::Renumber),
        EMB_JOIN_BY_MESH => Ok(JoinTags::ByMesh),
        other => Err(Error::invalid(format!("tags: {other} is not an EMB_JOIN_*"))),
    }
}

/// Reads several files into one mesh. `tags` is EMB_JOIN_KEEP, EMB_JOIN_RENUMBER or EMB_JOIN_BY_MESH; with RENUMBER a
/// file without tags of its own lends its name, without folder and extension, to its tag, with BY_MESH every file does.
/// Face f of a file has the number f plus the faces of the files before it. Named data of one name become one; where a
/// file has none, its values are NaN. Everything else, and the errors, as in emb_mesh_read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_read_files(
    count: usize,
    paths: *const *const c_char,
    tags: i32,
    options: *const emb_mesh_options,
    run: *const emb_run,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let count = elements::<&Path>("count", count, 1)?;
        let mut files = try_with_capacity("paths", count)?;
        for (k, p) in slice("paths", paths, count)?.iter().enumerate() {
            files.push(path(&format!("paths[{k}]"), *p)?);
        }
        let tags = join_tags(tags)?;
        let (options, format) = self::options(options)?;
        writable("out_mesh", out_mesh)?;
        with_run(run, |run| {
            run.tell(0.0)?;
            let mesh = io::read_files(&files, format, tags, &options)?;
            run.tell(1.0)?;
            give(out_mesh, mesh);
            Ok(())
        })
    })
}

/// Several meshes as one, placed as `options` say (NULL: defaults). `tags` as in emb_mesh_read_files. Face f of mesh k
/// has the number f plus emb_mesh_face_count of those before it. Unlike when reading, the defaults weld and turn nothing:
/// each mesh keeps its vertices (those that EMB_REPAIR_SPLIT made, too) and its orientation. An options->weld_tolerance
/// above 0 welds all of them together, as parts of one surface want (1e-12: equal positions), and orients as
/// options->orient says; without it EMB_ORIENT_AUTO turns nothing. Nothing is intersected: bodies that pass through each
/// other still do (emb_geom_union is for those). Cost: near linear.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (count 0, tags, options, data of one name that differ in
/// components), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_join(
    count: usize,
    meshes: *const *const emb_mesh,
    tags: i32,
    options: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let count = elements::<*const emb_mesh>("count", count, 1)?;
        let mut parts = try_with_capacity("meshes", count)?;
        for (k, mesh) in slice("meshes", meshes, count)?.iter().enumerate() {
            parts.push(lend(&format!("meshes[{k}]"), *mesh)?);
        }
        let tags = join_tags(tags)?;
        let (options, _) = self::options(options)?;
        writable("out_mesh", out_mesh)?;
        give(out_mesh, Mesh::join(&parts, tags, &options)?);
        Ok(())
    })
}

/// The same surface, scaled, rotated and shifted as `options` say; EMB_ORIENT_FLIP turns it over. Face numbers, tags and
/// data stay, vectors among the data as they are: they are not rotated along. As in emb_mesh_join the defaults weld and
/// turn nothing. (Reflections are refused, so what was outward stays so.) Cost: near linear.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (options), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_transform(
    mesh: *const emb_mesh,
    options: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let (options, _) = self::options(options)?;
        writable("out_mesh", out_mesh)?;
        give(out_mesh, mesh.rebuilt(&options)?);
        Ok(())
    })
}

/// The mesh in parts: EMB_SPLIT_TAG, one a tag by rising tag, or EMB_SPLIT_COMPONENT, one for what edges connect by the
/// lowest face of each. Parts keep vertices, orientation, tags with their names, and data; their vertices and faces are
/// numbered anew from 0, in their order. *out_count is how many there are; with `capacity` 0 that is all, else out_meshes takes so many
/// handles, each to be freed with emb_mesh_free. Cost: near linear.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (by; a capacity below the count), EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_split(
    mesh: *const emb_mesh,
    by: i32,
    capacity: usize,
    out_meshes: *mut *mut emb_mesh,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let by = match by {
            EMB_SPLIT_TAG => SplitBy::Tag,
            EMB_SPLIT_COMPONENT => SplitBy::Component,
            other => return Err(Error::invalid(format!("by: {other} is not an EMB_SPLIT_*"))),
        };
        writable("out_count", out_count)?;
        let count = mesh.part_count(by)?;
        if capacity > 0 {
            if capacity < count {
                return Err(Error::invalid(format!("capacity: {capacity} is less than {count} parts")));
            }
            writable("out_meshes", out_meshes)?;
            for (k, part) in mesh.split(by)?.into_iter().enumerate() {
                give(out_meshes.add(k), part);
            }
        }
        out_count.write(count);
        Ok(())
    })
}
