// SPDX-License-Identifier: MIT OR Apache-2.0
//! Crossings of a lattice, edge by edge.

use embound::geometry::Geometry;
use embound::parallel::Run;
use embound::query::{self, Crossing, CrossingForm, Lattice};
use std::sync::Mutex;

/// A row of edges, with those that do not meet the surface.
pub fn every_edge(count: usize, found: &[(usize, Crossing)]) -> Vec<Crossing> {
    let mut row = vec![Crossing { at: f64::NAN, count: 0, tag: -1, part: -1 }; count];
    for pair in found.windows(2) {
        assert!(pair[0].0 < pair[1].0, "crossings of a row are in order");
    }
    found.iter().for_each(|(k, crossing)| row[*k] = *crossing);
    row
}

/// Every edge along `axis`, x fastest.
pub fn crossings(g: &Geometry, lattice: &Lattice, axis: usize, form: CrossingForm, run: &Run) -> Vec<Crossing> {
    let mut n = lattice.n();
    n[axis] = n[axis].saturating_sub(1);
    let out = Mutex::new(vec![None; n[0] * n[1] * n[2]]);
    query::crossings(g, lattice, axis, form, run, &|at, count, found| {
        let first = at[0] + n[0] * (at[1] + n[1] * at[2]);
        for (k, c) in every_edge(count, found).into_iter().enumerate() {
            assert!(out.lock().unwrap()[first + k].replace(c).is_none(), "an edge is answered twice");
        }
    })
    .unwrap();
    out.into_inner().unwrap().into_iter().map(|c| c.expect("every edge answered")).collect()
}
