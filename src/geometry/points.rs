// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finite points that are asked together, coordinate by coordinate: a node asks each child for all of them at once.

use crate::math::Vec3;
use std::cell::OnceCell;

/// One array for each coordinate, all of one length.
#[derive(Clone, Copy)]
pub(super) struct Points<'a>(pub(super) [&'a [f64]; 3]);

impl Points<'_> {
    pub(super) fn iter(&self) -> impl Iterator<Item = Vec3> + '_ {
        let [x, y, z] = self.0;
        x.iter().zip(y).zip(z).map(|((x, y), z)| Vec3::new(*x, *y, *z))
    }
}

/// Points, as a lattice where they are one: meshes take lattices whole.
pub(super) enum Place {
    /// Axes, and the points made of them when somebody asks, x fastest.
    Lattice([Vec<f64>; 3], OnceCell<[Vec<f64>; 3]>),
    Scattered([Vec<f64>; 3]),
}

impl Place {
    pub(super) fn lattice(axes: [Vec<f64>; 3]) -> Place {
        Place::Lattice(axes, OnceCell::new())
    }

    pub(super) fn scattered(count: usize, points: impl Iterator<Item = Vec3>) -> Place {
        let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; count]);
        let slots = x.iter_mut().zip(&mut y).zip(&mut z);
        slots.zip(points).for_each(|(((x, y), z), p)| (*x, *y, *z) = (p.x, p.y, p.z));
        Place::Scattered([x, y, z])
    }

    pub(super) fn axes(&self) -> Option<[&[f64]; 3]> {
        match self {
            Place::Lattice(axes, _) => Some(axes.each_ref().map(|axis| &axis[..])),
            Place::Scattered(_) => None,
        }
    }

    pub(super) fn points(&self) -> Points<'_> {
        let points = match self {
            Place::Lattice(axes, points) => points.get_or_init(|| spread(axes)),
            Place::Scattered(points) => points,
        };
        Points(points.each_ref().map(|c| &c[..]))
    }

    /// All of them less `shift`.
    pub(super) fn less(&self, shift: Vec3) -> Place {
        let less = |from: &[Vec<f64>; 3]| [0, 1, 2].map(|k| from[k].iter().map(|c| c - shift[k]).collect());
        match self {
            Place::Lattice(axes, _) => Place::lattice(less(axes)),
            Place::Scattered(points) => Place::Scattered(less(points)),
        }
    }

    pub(super) fn mapped(&self, map: impl Fn(Vec3) -> Vec3) -> Place {
        let points = self.points();
        Place::scattered(points.0[0].len(), points.iter().map(map))
    }
}

fn spread([x, y, z]: &[Vec<f64>; 3]) -> [Vec<f64>; 3] {
    let count = x.len() * y.len() * z.len();
    let mut all = [0; 3].map(|_| Vec::with_capacity(count));
    for z in z {
        for y in y {
            all[0].extend_from_slice(x);
            all[1].resize(all[0].len(), *y);
        }
        all[2].resize(all[0].len(), *z);
    }
    all
}
