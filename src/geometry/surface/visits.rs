// SPDX-License-Identifier: MIT OR Apache-2.0
//! How much of a surface a search looks at, for benchmarks: no answer comes from here.

use super::Surface;
use super::waiting::Waiting;
use crate::bvh::{self, LeafDistance};
use crate::math::Vec3;
use crate::simd::float8::{Plain, Simd};

/// The search as it goes from leaf to leaf, counting them.
struct Counting<'a> {
    surface: &'a Surface,
    waiting: Waiting<'a>,
    leaves: usize,
}

impl<S: Simd> LeafDistance<S> for Counting<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: usize, at: [f32; 3], slack: f32) -> f32 {
        self.leaves += 1;
        self.waiting.look(simd, &self.surface.leaves[leaf], at, slack)
    }
}

impl Surface {
    /// Leaves that the search for the triangle nearest to a finite point looks at, and leaves in all; None where that
    /// search is another: without a hierarchy, in the compact layout, from far away.
    pub(crate) fn leaves_visited(&self, p: Vec3) -> Option<(usize, usize)> {
        let tree = self.tree.as_ref().filter(|tree| self.compact.is_none() && !tree.is_far(p))?;
        // The boxes and their order are the same at every level.
        let mut search = Counting { surface: self, waiting: Waiting::new(self, p), leaves: 0 };
        bvh::nearest::<Plain, bvh::Around>(Plain, tree, p, f32::INFINITY, &mut search);
        Some((search.leaves, self.leaves.len()))
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
    use crate::math::Vec3;
    use crate::mesh::{Mesh, MeshOptions};
    use crate::parallel::Run;

    #[test]
    fn a_search_looks_at_some_leaves_and_says_where_there_is_none() {
        // A plate of 800 triangles.
        let n = 20u32;
        let at = |i: u32, j: u32| (n + 1) * i + j;
        let xyz: Vec<f64> =
            (0..=n).flat_map(|i| (0..=n).flat_map(move |j| [f64::from(i), f64::from(j), 0.0])).collect();
        let squares = (0..n * n).map(|k| (k / n, k % n));
        let indices: Vec<u32> = squares
            .flat_map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)])
            .collect();
        let mesh = Mesh::from_triangles(&xyz, &indices, None, &MeshOptions::default()).expect("a plate");
        let build = |accelerator| {
            let options = SdfOptions { accelerator, sign: SignMethod::None, ..SdfOptions::default() };
            Geometry::from_mesh(&mesh, &options, &Run::SERIAL).expect("any mesh")
        };
        let g = build(Accelerator::Auto);
        let (near, all) = g.leaves_visited(Vec3::new(3.3, 4.4, 0.1)).expect("a hierarchy");
        assert!((1..10).contains(&near) && all >= 100, "{near} of {all}");
        let (above, _) = g.leaves_visited(Vec3::new(10.0, 10.0, 500.0)).expect("a hierarchy");
        assert!(above >= near && above <= all, "{above}");
        assert_eq!(g.leaves_visited(Vec3::splat(1e9)), None);
        assert_eq!(build(Accelerator::None).leaves_visited(Vec3::ONE), None);
        assert_eq!(build(Accelerator::Compact).leaves_visited(Vec3::ONE), None);
    }
}
