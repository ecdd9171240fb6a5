// SPDX-License-Identifier: MIT OR Apache-2.0
//! The C ABI: convert, call, convert. The files are named as the core modules they serve; the header
//! `include/embound.h` is generated from them, so what is documented here is the reference manual.
//!
//! Every entry goes through one guard: panics become a status, results are computed in the default
//! floating-point environment, and the caller's environment is as it was on return.

// The names and the safety rules are C's; the header's preamble states what callers must keep.
#![allow(non_camel_case_types, clippy::missing_safety_doc)]

mod affinity;
mod arrays;
mod assembly;
mod blend;
mod bounding;
mod callback;
mod combine;
mod constants;
mod data;
mod diagnosis;
mod diagnosis_lists;
mod diagnosis_structs;
mod error;
mod faces;
mod function;
mod geometry;
mod handle;
mod lattice;
mod lists;
mod mesh;
mod pack;
mod polygon;
mod pool;
mod query;
mod rays;
mod reader;
mod refit;
mod repair;
mod results;
mod run;
mod sampled;
mod shapes;
mod topology;
mod transforms;
mod versioned;
mod writer;

pub use assembly::*;
pub use blend::{emb_blend, emb_blend_fn, emb_blend_init};
pub use bounding::*;
pub use callback::{emb_drop_fn, emb_parallel_for_fn, emb_progress_fn, emb_value_fn};
pub use combine::*;
pub use constants::*;
pub use data::*;
pub use diagnosis::*;
pub use diagnosis_lists::*;
pub use diagnosis_structs::{emb_diagnosis_options, emb_diagnosis_summary, emb_mesh_component, emb_mesh_loop};
pub use error::{emb_isa, emb_last_error, emb_status, emb_version_number};
pub use faces::*;
pub use function::*;
pub use geometry::*;
pub use lattice::emb_lattice_write;
pub use mesh::*;
pub use pack::*;
pub use polygon::*;
pub use pool::{emb_pool, emb_pool_clone, emb_pool_free, emb_pool_from_callback, emb_pool_new, emb_pool_width};
pub use query::*;
pub use rays::*;
pub use refit::emb_geom_refit;
pub use repair::*;
pub use results::{emb_closest_out, emb_crossings_out, emb_hit_out};
pub use run::emb_run;
pub use sampled::*;
pub use shapes::*;
pub use topology::*;
pub use transforms::*;
pub use writer::{emb_array, emb_lattice};
