// SPDX-License-Identifier: MIT OR Apache-2.0
//! What diagnoses of meshes are asked for and what they tell, as structs.

use super::versioned::Versioned;
use crate::mesh::{BoundaryLoop, Component, Diagnosis};
use std::mem::{offset_of, size_of};

/// What a diagnosis looks for; fill it with emb_diagnosis_options_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_diagnosis_options {
    /// sizeof(emb_diagnosis_options)
    pub struct_size: usize,
    /// A triangle is a sliver where its smallest height is below this times its longest edge; a polygon where twice
    /// its area is below this times its squared length. From 0, which finds none, to 1; 0.001 by default.
    pub sliver_ratio: f64,
    /// A polygon is off a plane where half the room between two planes around its corners is above this times the
    /// diagonal of its box. From 0 to 1; 0, the default: not looked for.
    pub off_plane_ratio: f64,
    /// Most pairs of faces that intersect to list: where there are more the search ends, and their number is one that
    /// there are at least. 0: not looked for; 1000000 by default (16 MB when copied).
    pub intersection_limit: u64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_diagnosis_options {
    const FIRST_SIZE: usize = offset_of!(emb_diagnosis_options, intersection_limit) + size_of::<u64>();
    const DEFAULT: emb_diagnosis_options = emb_diagnosis_options {
        struct_size: size_of::<emb_diagnosis_options>(),
        sliver_ratio: 1e-3,
        off_plane_ratio: 0.0,
        intersection_limit: 1_000_000,
    };
}

/// The counts of a diagnosis beyond those of emb_mesh_report.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_diagnosis_summary {
    /// sizeof(emb_diagnosis_summary), set by the caller
    pub struct_size: usize,
    /// Vertices at which the faces do not form one fan or one disc.
    pub nonmanifold_vertices: u64,
    /// Faces that welding took corners from. With flat_faces they are emb_mesh_report.degenerate_faces.
    pub shrunk_faces: u64,
    /// Faces of exactly zero area.
    pub flat_faces: u64,
    /// Faces of hardly any area.
    pub slivers: u64,
    /// Faces whose corners are off a plane.
    pub off_plane_faces: u64,
    /// Sets of faces connected over edges.
    pub components: u64,
    /// Chains of boundary edges.
    pub boundary_loops: u64,
    /// Those that do not close: they end where an odd number of faces meets in an edge.
    pub open_chains: u64,
    /// Pairs of faces that intersect and are listed.
    pub listed_intersections: u64,
    /// Faces that orientation has turned over since.
    pub turned_faces: u64,
    /// Edges of the surface as it stands that do not have as many faces one way as the other: where there is any it has
    /// no inside.
    pub unbalanced_edges: u64,
    /// 1: the search for intersections went to its end, so that emb_mesh_report.self_intersections is exact; 0: there
    /// are at least as many, or they were not looked for.
    pub intersections_complete: i32,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_diagnosis_summary {
    const FIRST_SIZE: usize = offset_of!(emb_diagnosis_summary, intersections_complete) + size_of::<i32>();
    const DEFAULT: emb_diagnosis_summary = emb_diagnosis_summary {
        struct_size: size_of::<emb_diagnosis_summary>(),
        nonmanifold_vertices: 0,
        shrunk_faces: 0,
        flat_faces: 0,
        slivers: 0,
        off_plane_faces: 0,
        components: 0,
        boundary_loops: 0,
        open_chains: 0,
        listed_intersections: 0,
        turned_faces: 0,
        unbalanced_edges: 0,
        intersections_complete: 0,
    };
}

impl emb_diagnosis_summary {
    pub(super) fn of(diagnosis: &Diagnosis) -> emb_diagnosis_summary {
        let found = diagnosis.intersections.as_ref();
        emb_diagnosis_summary {
            nonmanifold_vertices: diagnosis.nonmanifold_vertices.len() as u64,
            shrunk_faces: diagnosis.shrunk_faces.len() as u64,
            flat_faces: diagnosis.flat_faces.len() as u64,
            slivers: diagnosis.slivers.len() as u64,
            off_plane_faces: diagnosis.off_plane_faces.len() as u64,
            components: diagnosis.components.len() as u64,
            boundary_loops: diagnosis.loops.len() as u64,
            open_chains: diagnosis.loops.iter().filter(|l| !l.closed).count() as u64,
            listed_intersections: found.map_or(0, |found| found.pairs.len() as u64),
            turned_faces: diagnosis.turned_faces as u64,
            unbalanced_edges: diagnosis.surface.unbalanced_edges as u64,
            intersections_complete: found.is_some_and(|found| found.complete).into(),
            ..emb_diagnosis_summary::DEFAULT
        }
    }
}

/// A set of faces connected over edges, as read.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_component {
    /// sizeof(emb_mesh_component), set by the caller
    pub struct_size: usize,
    /// Its lowest face.
    pub lowest_face: i64,
    /// Its faces, copies included.
    pub faces: u64,
    /// The triangles they are cut into.
    pub triangles: u64,
    /// Edges of one face.
    pub boundary_edges: u64,
    /// Edges of more than two faces.
    pub nonmanifold_edges: u64,
    /// Edges that two faces run along the same way.
    pub inconsistent_edges: u64,
    /// Faces that orientation has turned over since.
    pub turned_faces: u64,
    /// 1: no boundary edges.
    pub closed: i32,
    /// 1: no inconsistent edges.
    pub consistent: i32,
    /// 1: every edge has as many faces one way as the other, and the volume is negative.
    pub inside_out: i32,
    /// Signed volume, cubed units of the coordinates; it means something where the component is closed.
    pub volume: f64,
    /// Area, squared units of the coordinates.
    pub area: f64,
    /// Bounds, lower corner.
    pub lo: [f64; 3],
    /// Bounds, upper corner.
    pub hi: [f64; 3],
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_component {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_component, hi) + size_of::<[f64; 3]>();
    const DEFAULT: emb_mesh_component = emb_mesh_component {
        struct_size: size_of::<emb_mesh_component>(),
        lowest_face: 0,
        faces: 0,
        triangles: 0,
        boundary_edges: 0,
        nonmanifold_edges: 0,
        inconsistent_edges: 0,
        turned_faces: 0,
        closed: 0,
        consistent: 0,
        inside_out: 0,
        volume: 0.0,
        area: 0.0,
        lo: [0.0; 3],
        hi: [0.0; 3],
    };
}

impl emb_mesh_component {
    pub(super) fn of(known: &Component) -> emb_mesh_component {
        emb_mesh_component {
            lowest_face: known.lowest_face.into(),
            faces: known.faces as u64,
            triangles: known.triangles as u64,
            boundary_edges: known.boundary_edges as u64,
            nonmanifold_edges: known.nonmanifold_edges as u64,
            inconsistent_edges: known.inconsistent_edges as u64,
            turned_faces: known.turned_faces as u64,
            closed: known.is_closed().into(),
            consistent: known.is_consistent().into(),
            inside_out: known.inside_out.into(),
            volume: known.volume,
            area: known.area,
            lo: known.lo,
            hi: known.hi,
            ..emb_mesh_component::DEFAULT
        }
    }
}

/// A chain of boundary edges that passes no vertex twice.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_loop {
    /// sizeof(emb_mesh_loop), set by the caller
    pub struct_size: usize,
    /// Its edges: as many as vertices; one fewer where it does not close.
    pub edges: u64,
    /// The component that its faces belong to.
    pub component: u32,
    /// 1: it comes back to where it begins.
    pub closed: i32,
    /// Sum of the lengths of its edges.
    pub length: f64,
    /// Diagonal of the box around it.
    pub diagonal: f64,
    /// That box, lower corner.
    pub lo: [f64; 3],
    /// Upper corner.
    pub hi: [f64; 3],
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_loop {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_loop, hi) + size_of::<[f64; 3]>();
    const DEFAULT: emb_mesh_loop = emb_mesh_loop {
        struct_size: size_of::<emb_mesh_loop>(),
        edges: 0,
        component: 0,
        closed: 0,
        length: 0.0,
        diagonal: 0.0,
        lo: [0.0; 3],
        hi: [0.0; 3],
    };
}

impl emb_mesh_loop {
    pub(super) fn of(known: &BoundaryLoop) -> emb_mesh_loop {
        emb_mesh_loop {
            edges: known.edges as u64,
            component: known.component,
            closed: known.closed.into(),
            length: known.length,
            diagonal: known.diagonal(),
            lo: known.lo,
            hi: known.hi,
            ..emb_mesh_loop::DEFAULT
        }
    }
}
