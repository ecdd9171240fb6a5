// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes whose vertices move.

use super::arrays::{elements, slice};
use super::constants::{EMB_REFIT_CHECK, EMB_REFIT_TRUST};
use super::error::{emb_status, guard};
use super::geometry::emb_geom;
use super::handle::{give, lend, writable};
use super::run::{emb_run, with_run};
use crate::error::{Error, Result};
use crate::geometry::RefitCheck;

/// The signed distance to the same faces over vertices that have moved. `xyz` holds 3 * vertex_count coordinates, vertex by
/// vertex, in the order of emb_mesh_vertices of the mesh that g was made from (with emb_mesh_options.weld_tolerance -1 that
/// is the order of the arrays that the mesh was made from); what EMB_OPEN_SWEEP made follows. Values, ids and tags are those of emb_geom_from_mesh of such a
/// mesh with the options of g, bit for bit; so is the way the sign is decided, with EMB_REFIT_CHECK. The way that faces run
/// stays, and so do the triangles that options.open made, where other ones might be made anew. g is left as it is, and shares with the new geometry what does not change; each may be freed first, and the mesh
/// long before.
///
/// For a rigid motion take emb_geom_place, which is O(1) and needs no vertices. Make the geometry anew where faces come or
/// go, and now and then where the motion is large: what answers cost grows as faces move away from those they lay beside.
///
/// `check` says what is looked at: EMB_REFIT_CHECK or EMB_REFIT_TRUST. On success *out_geom is the caller's, to be freed
/// with emb_geom_free. Cost: linear in the triangles with EMB_REFIT_TRUST, some six tenths of emb_geom_from_mesh;
/// EMB_REFIT_CHECK looks for faces that meet besides, as emb_geom_from_mesh does, which is about as much again. Either saves
/// making the mesh, too. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (another count, a coordinate that is not finite or beyond
/// 1e100, vertices of one place), EMB_ERROR_UNSUPPORTED (g is not what emb_geom_from_mesh or this made, but a shape, a label,
/// a motion or a combination: refit the mesh within, and make the rest anew, which is O(1) but for combinations),
/// EMB_ERROR_TOPOLOGY (the vertices turn a closed surface inside out, as a reflection does; or g was made with
/// EMB_SIGN_PSEUDONORMAL, which is no longer right), EMB_ERROR_MEMORY, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_refit(
    g: *const emb_geom,
    vertex_count: usize,
    xyz: *const f64,
    check: i32,
    run: *const emb_run,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let vertices = g.vertices_to_move()?;
        if vertex_count != vertices {
            return Err(Error::invalid(format!(
                "vertex_count: {vertex_count} is not {vertices}, the count of vertices of the mesh that g was made from"
            )));
        }
        let xyz = slice("xyz", xyz, elements::<f64>("vertex_count", vertex_count, 3)?)?;
        let check = choice(check)?;
        writable("out_geom", out_geom)?;
        with_run(run, |run| {
            give(out_geom, g.refit(xyz, check, run)?);
            Ok(())
        })
    })
}

fn choice(check: i32) -> Result<RefitCheck> {
    match check {
        EMB_REFIT_CHECK => Ok(RefitCheck::Check),
        EMB_REFIT_TRUST => Ok(RefitCheck::Trust),
        other => Err(Error::invalid(format!("check: {other} is not an EMB_REFIT_*"))),
    }
}
