// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether two geometries are the same in all that can be asked.

use crate::common::random::Random;
use embound::geometry::Geometry;
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query::{self, Crossing, CrossingForm, FillMode, Lattice};
use std::sync::Mutex;

fn lattice_axis(n: usize) -> Vec<f64> {
    (0..n).map(|k| -1.6 + 3.2 * k as f64 / (n - 1) as f64).collect()
}

/// Values, closest points, boxes, fills, crossings: everything as bits.
pub fn answers(g: &Geometry) -> Vec<u64> {
    few_answers(g, 120, 10)
}

/// At so many points, and over a lattice of so many along each axis.
pub fn few_answers(g: &Geometry, points: usize, side: usize) -> Vec<u64> {
    let mut random = Random(11);
    let mut all = Vec::new();
    for k in 0..points {
        let reach = if k % 5 == 0 { 20.0 } else { 1.5 };
        let p = Vec3::from_array(random.point([-reach; 3], [reach; 3]));
        let c = g.closest(p);
        all.extend([c.point, c.gradient, c.barycentric].iter().flat_map(|v| v.to_array()).map(f64::to_bits));
        all.extend([c.value.to_bits(), g.value(p).to_bits()]);
        all.extend([c.primitive as u64, c.piece as u64, c.tag as u64, c.feature as u64, c.part as u64]);
        let q = Vec3::from_array(random.point([-1.0; 3], [1.0; 3])) * if k % 3 == 0 { 0.1 } else { 1.0 };
        all.push(g.classify(Aabb::of([p, p + q])) as u64);
    }
    let x = lattice_axis(side);
    let lattice = Lattice::new(&x, &x, &x).expect("a lattice");
    let found = Mutex::new(Vec::new());
    let add = |bits: &mut dyn Iterator<Item = u64>| found.lock().expect("no panic").extend(bits);
    for mode in [FillMode::Exact, FillMode::Band(0.2), FillMode::Sign] {
        let filled = query::fill(g, &lattice, mode, &Run::SERIAL, &|at, values| {
            add(&mut at.into_iter().map(|k| k as u64).chain(values.iter().map(|x| x.to_bits())));
        });
        add(&mut filled.err().map(|error| error.status() as u64).into_iter());
    }
    for axis in 0..3 {
        let crossed = query::crossings(g, &lattice, axis, CrossingForm::Coordinate, &Run::SERIAL, &|at, count, met| {
            add(&mut at.into_iter().chain([count]).map(|k| k as u64));
            let one =
                |(k, c): &(usize, Crossing)| [*k as u64, c.at.to_bits(), c.count as u64, c.tag as u64, c.part as u64];
            add(&mut met.iter().flat_map(one));
        });
        add(&mut crossed.err().map(|error| error.status() as u64).into_iter());
    }
    all.extend(found.into_inner().expect("no panic"));
    all
}

/// Panics where they differ.
pub fn assert_same(name: &str, a: &Geometry, b: &Geometry) {
    let (p, q) = (a.properties(), b.properties());
    assert_eq!(a.fingerprint(), b.fingerprint(), "{name}");
    assert_eq!((p.kind, p.sign_method, p.primitives), (q.kind, q.sign_method, q.primitives), "{name}");
    assert_eq!((p.lipschitz.to_bits(), p.bytes), (q.lipschitz.to_bits(), q.bytes), "{name}");
    assert_eq!(a.bounds(), b.bounds(), "{name}");
    let (a, b) = (answers(a), answers(b));
    assert_eq!(a.len(), b.len(), "{name}");
    let differs = a.iter().zip(&b).position(|(a, b)| a != b);
    assert_eq!(differs, None, "{name}: {:?}", differs.map(|k| (f64::from_bits(a[k]), f64::from_bits(b[k]))));
}
