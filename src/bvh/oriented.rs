// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boxes turned to fit what is in them (Gottschalk, Lin & Manocha 1996, "OBBTree"): a patch of a surface is flat, and a
//! box along its normal is thin where one along the axes is not. They stand beside a hierarchy's own boxes, for searches
//! of the nearest.

use super::{LEAF, Leaves, Tree};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Swizzles, Vec3, f32_above, unit};
use crate::parallel::Run;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};
use crate::store::{Array, plain};

/// Eight oriented boxes side by side: for each row of the matrix that turns a point into the frame of a box, its three
/// places; the middles; half the edges. An unused child's box is never reached.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Oriented {
    rows: [[[f32; WIDTH]; 3]; 3],
    middle: [[f32; WIDTH]; 3],
    half: [[f32; WIDTH]; 3],
    pub(super) child: [u32; WIDTH],
}

plain! {
    Oriented {
        rows: [[[f32; WIDTH]; 3]; 3],
        middle: [[f32; WIDTH]; 3],
        half: [[f32; WIDTH]; 3],
        child: [u32; WIDTH],
    }
}

pub(super) const NONE: Oriented = Oriented {
    rows: [[[0.0; WIDTH]; 3]; 3],
    middle: [[0.0; WIDTH]; 3],
    half: [[0.0; WIDTH]; 3],
    child: [u32::MAX; WIDTH],
};

/// What half edges are widened by, relative to the radius: the turn of a point into a frame is off by up to 7
/// roundings of its distance from the middle, which is at most its distance from what is in the box plus the radius.
const WIDENED: f64 = 8.0 * f32::EPSILON as f64 / 2.0;

/// Leaves, and nodes, that a thread does in one go.
const PIECE: usize = 512;
const NODES: usize = 16;

/// One oriented box.
#[derive(Clone, Copy)]
struct Fit {
    rows: [Vec3; 3],
    middle: Vec3,
    half: Vec3,
    /// Sum of the normals of what is in it, as long as twice the areas; those of the other side of a thin wall turned.
    normal: Vec3,
    /// The longest edge of the largest triangle, and twice its area.
    edge: Vec3,
    area: f64,
    /// Of its points the sum and the sums of products: xx, yy, zz, yz, zx, xy.
    sum: Vec3,
    products: [Vec3; 2],
    /// Its points.
    from: usize,
    to: usize,
}

impl Tree {
    /// Fits oriented boxes around triangles; `triangle(k)` is the one of number k in the order of the leaves.
    pub(crate) fn fit(
        &mut self,
        leaves: &Leaves,
        triangle: &(dyn Fn(u32) -> [Vec3; 3] + Sync),
        run: &Run,
    ) -> Result<()> {
        // What stands under a node is side by side.
        let mut points = Points::new(3 * leaves.order.len())?;
        for &t in &leaves.order {
            triangle(t).into_iter().for_each(|corner| points.push(self.place(corner)));
        }
        let mut of_leaves = filled("leaves", leaves.start.len() - 1, Fit::NONE)?;
        run.for_each_piece(&mut of_leaves, PIECE, &|from, fits| {
            for (k, fit) in (from..).zip(fits) {
                *fit = Fit::around_triangles(&points, 3 * leaves.start[k] as usize, 3 * leaves.start[k + 1] as usize);
            }
            Ok(())
        })?;
        // Children come after their parent.
        let mut of_nodes = filled("nodes", self.nodes.len(), Fit::NONE)?;
        for (k, node) in self.nodes.iter().enumerate().rev() {
            let below = node.child.iter().filter(|child| **child != u32::MAX).map(|&child| match child & LEAF {
                0 => of_nodes[child as usize],
                _ => of_leaves[(child & !LEAF) as usize],
            });
            of_nodes[k] = Fit::of_all(below);
        }
        let mut oriented = filled("nodes", self.nodes.len(), NONE)?;
        run.for_each_piece(&mut oriented, NODES, &|from, oriented| {
            for (node, oriented) in self.nodes[from..].iter().zip(oriented) {
                oriented.child = node.child;
                for (lane, &child) in node.child.iter().enumerate().filter(|(_, child)| **child != u32::MAX) {
                    let fit = match child & LEAF {
                        0 => of_nodes[child as usize].around(&points),
                        _ => of_leaves[(child & !LEAF) as usize],
                    };
                    oriented.set(lane, &fit);
                }
            }
            Ok(())
        })?;
        self.oriented = oriented.into();
        Ok(())
    }

    /// Without the oriented boxes: a third of the memory.
    pub(crate) fn without_fit(self) -> Tree {
        Tree { oriented: Array::default(), ..self }
    }
}

/// Points, coordinate by coordinate.
struct Points([Vec<f64>; 3]);

impl Points {
    fn new(count: usize) -> Result<Points> {
        Ok(Points([
            try_with_capacity("points", count)?,
            try_with_capacity("points", count)?,
            try_with_capacity("points", count)?,
        ]))
    }

    fn push(&mut self, p: Vec3) {
        (0..3).for_each(|k| self.0[k].push(p[k]));
    }

    fn at(&self, k: usize) -> Vec3 {
        Vec3::new(self.0[0][k], self.0[1][k], self.0[2][k])
    }
}

/// The least and the greatest that points come to along an axis.
struct Extent<'a> {
    points: [&'a [f64]; 3],
    axis: Vec3,
}

impl Kernel for Extent<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; 2] {
        let Extent { points: [x, y, z], axis } = self;
        let (mut lo, mut hi) = ([f64::INFINITY; WIDTH], [f64::NEG_INFINITY; WIDTH]);
        let ((xs, x), (ys, y), (zs, z)) = (x.as_chunks::<WIDTH>(), y.as_chunks::<WIDTH>(), z.as_chunks::<WIDTH>());
        for ((x, y), z) in xs.iter().zip(ys).zip(zs) {
            for k in 0..WIDTH {
                let at = axis.x * x[k] + axis.y * y[k] + axis.z * z[k];
                lo[k] = if at < lo[k] { at } else { lo[k] };
                hi[k] = if at > hi[k] { at } else { hi[k] };
            }
        }
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            let at = axis.x * x + axis.y * y + axis.z * z;
            lo[0] = if at < lo[0] { at } else { lo[0] };
            hi[0] = if at > hi[0] { at } else { hi[0] };
        }
        let (mut least, mut most) = (lo[0], hi[0]);
        for k in 1..WIDTH {
            least = if lo[k] < least { lo[k] } else { least };
            most = if hi[k] > most { hi[k] } else { most };
        }
        [least, most]
    }
}

impl Oriented {
    /// Whether every child has a box, of rows of unit vectors and of numbers up to `largest`, and what is no child none.
    pub(super) fn is_sound(&self, largest: f32) -> bool {
        (0..WIDTH).all(|lane| {
            let is_child = self.child[lane] != u32::MAX;
            let (most, unit) = if is_child { (largest, 2.0) } else { (0.0, 0.0) };
            (0..3).all(|k| {
                self.middle[k][lane].abs() <= most
                    && (0.0..=most).contains(&self.half[k][lane])
                    && self.rows[k].iter().all(|row| row[lane].abs() <= unit)
            })
        })
    }

    fn set(&mut self, lane: usize, fit: &Fit) {
        for k in 0..3 {
            for j in 0..3 {
                self.rows[k][j][lane] = fit.rows[k][j] as f32;
            }
            self.middle[k][lane] = fit.middle[k] as f32;
            self.half[k][lane] = f32_above(fit.half[k] + WIDENED * fit.half.length());
        }
    }

    /// Copies a box, not its child.
    pub(super) fn copy(&mut self, lane: usize, from: &Oriented, from_lane: usize) {
        for k in 0..3 {
            for j in 0..3 {
                self.rows[k][j][lane] = from.rows[k][j][from_lane];
            }
            self.middle[k][lane] = from.middle[k][from_lane];
            self.half[k][lane] = from.half[k][from_lane];
        }
    }

    /// Squared distances of a point from the boxes, off by fewer than 24 roundings of those of what is in them.
    #[inline(always)]
    pub(super) fn squares<S: Simd>(&self, simd: S, at: [f32; 3]) -> S::Float {
        let zero = S::Float::splat(simd, 0.0);
        let mut to = [zero; 3];
        for j in 0..3 {
            to[j] = S::Float::splat(simd, at[j]).sub(S::Float::load(simd, &self.middle[j]));
        }
        let mut squares = [zero; 3];
        for k in 0..3 {
            let mut along = S::Float::load(simd, &self.rows[k][0]).mul(to[0]);
            for j in 1..3 {
                along = along.add(S::Float::load(simd, &self.rows[k][j]).mul(to[j]));
            }
            let outside = along.abs().sub(S::Float::load(simd, &self.half[k])).max(zero);
            squares[k] = outside.mul(outside);
        }
        squares[0].add(squares[1]).add(squares[2])
    }
}

impl Fit {
    const NONE: Fit = Fit {
        rows: [Vec3::X, Vec3::Y, Vec3::Z],
        middle: Vec3::ZERO,
        half: Vec3::ZERO,
        normal: Vec3::ZERO,
        edge: Vec3::ZERO,
        area: 0.0,
        sum: Vec3::ZERO,
        products: [Vec3::ZERO; 2],
        from: 0,
        to: 0,
    };

    /// Around the triangles, of which there is at least one, that some points are the corners of. They lie within one of
    /// the origin.
    fn around_triangles(points: &Points, from: usize, to: usize) -> Fit {
        let (mut normal, mut most, mut edges) = (Vec3::ZERO, 0.0, [Vec3::ZERO; 3]);
        for t in (from..to).step_by(3) {
            let [a, b, c] = [points.at(t), points.at(t + 1), points.at(t + 2)];
            let across = (b - a).cross(c - a);
            normal += if normal.dot(across) < 0.0 { -across } else { across };
            if across.length_squared() >= most {
                (most, edges) = (across.length_squared(), [b - a, c - b, a - c]);
            }
        }
        let longest =
            edges.into_iter().fold(Vec3::ZERO, |e, f| if f.length_squared() > e.length_squared() { f } else { e });
        let mut plain = Fit { from, to, normal, edge: longest, area: most.sqrt(), ..Fit::NONE };
        for k in from..to {
            let p = points.at(k);
            plain.sum += p;
            plain.products[0] += p * p;
            plain.products[1] += p.yzx() * p.zxy();
        }
        plain.smallest(edges.map(|edge| frame(normal, edge)), points)
    }

    /// What others have, side by side and at least one, together; around nothing yet.
    fn of_all(fits: impl Iterator<Item = Fit>) -> Fit {
        fits.fold(Fit { from: usize::MAX, to: 0, ..Fit::NONE }, |all, fit| Fit {
            normal: all.normal + if all.normal.dot(fit.normal) < 0.0 { -fit.normal } else { fit.normal },
            edge: if fit.area > all.area { fit.edge } else { all.edge },
            area: all.area.max(fit.area),
            sum: all.sum + fit.sum,
            products: [all.products[0] + fit.products[0], all.products[1] + fit.products[1]],
            from: all.from.min(fit.from),
            to: all.to.max(fit.to),
            ..all
        })
    }

    /// The smallest around its points along the axes, along normal and edge, or along the principal axes.
    fn around(self, points: &Points) -> Fit {
        self.smallest([frame(self.normal, self.edge), self.principal()], points)
    }

    /// The smallest around its points along the axes or in one of these frames.
    fn smallest<const N: usize>(self, frames: [Option<[Vec3; 3]>; N], points: &Points) -> Fit {
        frames.into_iter().flatten().fold(self.tight(points), |best, rows| {
            let turned = Fit { rows, ..self }.tight(points);
            if turned.surface() < best.surface() { turned } else { best }
        })
    }

    /// The principal axes of its points, by Jacobi's rotations.
    fn principal(&self) -> Option<[Vec3; 3]> {
        let count = (self.to - self.from) as f64;
        let middle = self.sum / count;
        let square = self.products[0] / count - middle * middle;
        let mixed = self.products[1] / count - middle.yzx() * middle.zxy();
        let mut m = [[square.x, mixed.z, mixed.y], [mixed.z, square.y, mixed.x], [mixed.y, mixed.x, square.z]];
        let mut axes = [Vec3::X, Vec3::Y, Vec3::Z];
        for (i, j) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(12) {
            if m[i][j] == 0.0 {
                continue;
            }
            let theta = (m[j][j] - m[i][i]) / (2.0 * m[i][j]);
            let tangent = if theta < 0.0 { -1.0 } else { 1.0 } / (theta.abs() + (theta * theta + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            for k in 0..3 {
                (m[k][i], m[k][j]) = (cosine * m[k][i] - sine * m[k][j], sine * m[k][i] + cosine * m[k][j]);
            }
            for k in 0..3 {
                (m[i][k], m[j][k]) = (cosine * m[i][k] - sine * m[j][k], sine * m[i][k] + cosine * m[j][k]);
            }
            (axes[i], axes[j]) = (axes[i] * cosine - axes[j] * sine, axes[i] * sine + axes[j] * cosine);
        }
        frame(axes[2], axes[0])
    }

    /// The smallest with these rows around its points.
    fn tight(self, points: &Points) -> Fit {
        let Fit { rows, from, to, .. } = self;
        let of = [0, 1, 2].map(|k| &points.0[k][from..to]);
        let [x, y, z] = rows.map(|axis| dispatch(Extent { points: of, axis }));
        let (lo, hi) = (Vec3::new(x[0], y[0], z[0]), Vec3::new(x[1], y[1], z[1]));
        let back = (lo + hi) * 0.5;
        let middle = (rows[0] * back.x + rows[1] * back.y + rows[2] * back.z).as_vec3().as_dvec3();
        let at = Vec3::new(rows[0].dot(middle), rows[1].dot(middle), rows[2].dot(middle));
        Fit { middle, half: (hi - at).max(at - lo), ..self }
    }

    /// An eighth of it.
    fn surface(&self) -> f64 {
        self.half.x * self.half.y + self.half.y * self.half.z + self.half.z * self.half.x
    }
}

/// The frame along an edge and a normal, as it is rounded; none where they have no directions.
fn frame(normal: Vec3, edge: Vec3) -> Option<[Vec3; 3]> {
    let z = unit(normal);
    let x = unit(edge - z * z.dot(edge));
    let has_directions = z != Vec3::ZERO && x != Vec3::ZERO && z.dot(x).abs() < 1e-9;
    has_directions.then(|| [x, z.cross(x), z].map(|row| row.as_vec3().as_dvec3()))
}
