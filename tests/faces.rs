// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces that overlap a box, against exact clipping in fractions, and faces within a distance, against the distances
//! to each face alone.

mod common;

use common::random::Random;
use common::{Soup, bodies};
use embound::Status;
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::mesh::Mesh;
use embound::parallel::Run;
use embound::query;
use std::cmp::Ordering;

fn baffle(soup: &Soup, accelerator: Accelerator) -> Geometry {
    let options = SdfOptions { sign: SignMethod::None, accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh_kept(), &options, &Run::SERIAL).unwrap()
}

/// A fraction in lowest terms, the denominator positive.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fraction(i128, i128);

impl Fraction {
    fn new(n: i128, d: i128) -> Fraction {
        let (mut a, mut b) = (n.abs(), d.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let sign = if d < 0 { -1 } else { 1 };
        Fraction(sign * n / a.max(1), sign * d / a.max(1))
    }

    fn plus(self, o: Fraction) -> Fraction {
        Fraction::new(self.0 * o.1 + o.0 * self.1, self.1 * o.1)
    }

    fn minus(self, o: Fraction) -> Fraction {
        self.plus(Fraction(-o.0, o.1))
    }

    fn times(self, o: Fraction) -> Fraction {
        Fraction::new(self.0 * o.0, self.1 * o.1)
    }

    fn over(self, o: Fraction) -> Fraction {
        self.times(Fraction::new(o.1, o.0))
    }

    fn sign(self) -> Ordering {
        self.0.cmp(&0)
    }
}

/// Whether something is left of a triangle of whole numbers that is cut down to a box of whole numbers.
fn is_met(corners: [[f64; 3]; 3], lo: [f64; 3], hi: [f64; 3]) -> bool {
    let whole = |c: f64| Fraction(c as i128, 1);
    let mut polygon: Vec<[Fraction; 3]> = corners.map(|p| p.map(whole)).to_vec();
    for axis in 0..3 {
        for (bound, way) in [(lo[axis], 1), (hi[axis], -1)] {
            let depth = |p: &[Fraction; 3]| p[axis].minus(whole(bound)).times(Fraction(way, 1));
            let mut cut = Vec::new();
            for (k, p) in polygon.iter().enumerate() {
                let q = &polygon[(k + 1) % polygon.len()];
                let (a, b) = (depth(p), depth(q));
                if a.sign() != Ordering::Less {
                    cut.push(*p);
                }
                if a.sign() != Ordering::Equal && b.sign() != Ordering::Equal && a.sign() != b.sign() {
                    let t = a.over(a.minus(b));
                    cut.push([0, 1, 2].map(|d| p[d].plus(q[d].minus(p[d]).times(t))));
                }
            }
            polygon = cut;
        }
    }
    !polygon.is_empty()
}

#[test]
fn faces_overlap_a_box_exactly_as_clipping_says() {
    // Coordinates from -4 to 4, some triangles flat; boxes between the same points, some of them flat, too.
    let once = 300;
    let soup = bodies::lattice_soup(once as u32).duplicated();
    let geometries = [Accelerator::None, Accelerator::Auto, Accelerator::Compact].map(|a| baffle(&soup, a));
    let mut random = Random(81);
    let mut found = [0; 2];
    for _ in 0..400 {
        let (a, b) = ([0; 3].map(|_| random.below(9) as f64 - 4.0), [0; 3].map(|_| random.below(3) as f64));
        let (lo, hi) = (a, [0, 1, 2].map(|k| a[k] + b[k]));
        let faces = query::faces_overlapping(&geometries[0], Aabb::new(lo.into(), hi.into())).unwrap();
        for g in &geometries[1..] {
            assert_eq!(query::faces_overlapping(g, Aabb::new(lo.into(), hi.into())).unwrap(), faces);
        }
        for t in 0..soup.triangles.len() {
            // Of two that are alike, the geometry has the first.
            let is_met = t < once && is_met(soup.corners(t), lo, hi);
            let has_area = soup.has_area(t);
            // What has no area may be left out of a geometry.
            if has_area || faces.contains(&(t as i64)) {
                assert_eq!(faces.contains(&(t as i64)), is_met, "face {t}, {:?}, {lo:?} to {hi:?}", soup.corners(t));
                found[usize::from(is_met)] += 1;
            }
        }
    }
    assert!(found[0] > 10_000 && found[1] > 1000, "{found:?}");
}

trait HasArea {
    fn has_area(&self, t: usize) -> bool;
}

impl HasArea for Soup {
    fn has_area(&self, t: usize) -> bool {
        let [a, b, c] = self.corners(t).map(Vec3::from);
        (b - a).cross(c - a) != Vec3::ZERO
    }
}

#[test]
fn a_box_that_touches_by_the_last_digit_overlaps_and_one_further_does_not() {
    for scale in [1.0, 1e-6, 1e6] {
        let body = bodies::icosphere(2).scaled(scale);
        let g = baffle(&body, Accelerator::Auto);
        for p in &body.vertices {
            let (lo, hi) = (*p, p.map(|c| c + scale * 1e-3 * c.signum().max(0.0)));
            assert!(query::faces_overlapping(&g, Aabb::new(lo.into(), hi.into())).unwrap().len() >= 5);
        }
        let top = body.bounds().1[2];
        let above = |z: f64| Aabb::new(Vec3::new(-scale, -scale, z), Vec3::splat(f64::INFINITY));
        assert!(!query::faces_overlapping(&g, above(top)).unwrap().is_empty());
        assert!(query::faces_overlapping(&g, above(top.next_up())).unwrap().is_empty());
    }
    let g = baffle(&bodies::icosphere(1), Accelerator::Auto);
    assert_eq!(query::faces_overlapping(&g, Aabb::ALL).unwrap(), (0..80).collect::<Vec<i64>>());
}

#[test]
fn faces_within_a_distance_are_those_whose_own_distance_is_no_more() {
    let mut random = Random(82);
    for scale in [1.0, 1e-6, 1e6] {
        let body = bodies::torus(0.8, 0.3, 24, 12).scaled(scale);
        let alone: Vec<Geometry> =
            (0..body.triangles.len()).map(|t| baffle(&body.without(|k| k != t), Accelerator::None)).collect();
        let geometries = [Accelerator::None, Accelerator::Auto, Accelerator::Compact].map(|a| baffle(&body, a));
        let mut found = 0;
        for k in 0..60 {
            let p = random.point([-2.0 * scale; 3], [2.0 * scale; 3]).into();
            let distances: Vec<f64> = alone.iter().map(|g| g.value(p)).collect();
            // Exactly that of a face, of the nearest, or any.
            let radius = match k % 3 {
                0 => distances[random.below(distances.len())],
                1 => geometries[1].value(p),
                _ => random.range(0.0, 2.0 * scale),
            };
            let expected: Vec<i64> = (0..).zip(&distances).filter(|(_, d)| **d <= radius).map(|(t, _)| t).collect();
            assert!(k % 3 == 2 || !expected.is_empty());
            for g in &geometries {
                assert_eq!(query::faces_within(g, p, radius).unwrap(), expected);
            }
            found += expected.len();
        }
        assert!(found > 1000, "{found}");
        assert_eq!(query::faces_within(&geometries[1], Vec3::ZERO, f64::INFINITY).unwrap().len(), body.triangles.len());
    }
}

/// A box of quadrangles that are cut into triangles: three by three by three cells' worth of each side.
fn quadrangles() -> (Vec<f64>, Vec<u32>) {
    let (mut xyz, mut corners) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let (axis, is_high) = (side / 2, side % 2 == 1);
        for k in 0..9 {
            let (i, j) = ((k % 3) as f64, (k / 3) as f64);
            let mut square = [[i, j], [i + 1.0, j], [i + 1.0, j + 1.0], [i, j + 1.0]];
            if !is_high {
                square.reverse();
            }
            for [a, b] in square {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (if is_high { 3.0 } else { 0.0 }, a, b);
                corners.push((xyz.len() / 3) as u32);
                xyz.extend(p);
            }
        }
    }
    (xyz, corners)
}

#[test]
fn a_polygon_of_several_triangles_counts_once() {
    let (xyz, corners) = quadrangles();
    let offsets: Vec<usize> = (0..=54).map(|k| 4 * k).collect();
    let mesh = Mesh::from_polygons(&xyz, &offsets, &corners, None, &Default::default()).unwrap();
    let of = |accelerator| {
        let options = SdfOptions { accelerator, ..SdfOptions::default() };
        Geometry::from_mesh(&mesh, &options, &Run::SERIAL).unwrap()
    };
    let geometries = [Accelerator::None, Accelerator::Auto, Accelerator::Compact].map(of);
    let mut random = Random(83);
    let mut found = 0;
    for _ in 0..300 {
        let lo = [0; 3].map(|_| random.below(9) as f64 * 0.5 - 0.5);
        let hi = lo.map(|c| c + random.below(4) as f64 * 0.5);
        let p = [0; 3].map(|_| random.below(17) as f64 * 0.25 - 0.5);
        let radius = random.below(9) as f64 * 0.25;
        // Flat along one axis, a face is a box itself: everything below is exact.
        let of_face = |f: usize| {
            let at = (4 * f..4 * f + 4).map(|c| Vec3::from_slice(&xyz[3 * corners[c] as usize..][..3]));
            Aabb::of(at)
        };
        let overlapping: Vec<i64> = (0..54)
            .filter(|f| !of_face(*f).intersection(Aabb::new(lo.into(), hi.into())).is_empty())
            .map(|f| f as i64)
            .collect();
        let within: Vec<i64> = (0..54)
            .filter(|f| {
                let p = Vec3::from(p);
                let b = of_face(*f);
                (p - p.max(b.lo).min(b.hi)).length_squared() <= radius * radius
            })
            .map(|f| f as i64)
            .collect();
        for g in &geometries {
            assert_eq!(query::faces_overlapping(g, Aabb::new(lo.into(), hi.into())).unwrap(), overlapping);
            assert_eq!(query::faces_within(g, p.into(), radius).unwrap(), within, "{p:?} {radius}");
        }
        found += overlapping.len() + within.len();
    }
    assert!(found > 3000, "{found}");
}

#[test]
fn bodies_that_are_moved_tell_of_their_faces_where_they_are() {
    let mut random = Random(84);
    for scale in [1.0, 1e-6, 1e6] {
        let body = bodies::torus(0.8, 0.3, 24, 12).scaled(scale);
        let geometries = [Accelerator::None, Accelerator::Auto, Accelerator::Compact].map(|a| {
            let turn = [0.36, 0.48, -0.8, -0.8, 0.60, 0.0, 0.48, 0.64, 0.60];
            let g = baffle(&body, a).part(3).unwrap().place(turn, [4.0 * scale, 0.0, 0.0]).unwrap();
            [g.translate([0.1 * scale, 5.0 * scale, 0.0]).unwrap(), g.complement().unwrap().scale(3.0).unwrap()]
        });
        let mut found = [0; 2];
        for k in 0..200 {
            let moved = k % 2;
            let p = random.point([-2.0 * scale; 3], [2.0 * scale; 3]);
            let p = match moved {
                0 => [p[0] + 4.1 * scale, p[1] + 5.0 * scale, p[2]],
                _ => [3.0 * (p[0] + 4.0 * scale), 3.0 * p[1], 3.0 * p[2]],
            };
            let [brute, others @ ..] = [0, 1, 2].map(|k| &geometries[k][moved]);
            let value = brute.value(p.into()).abs();
            let radius = if k % 4 < 2 { value } else { random.range(0.0, 2.0 * scale) };
            let within = query::faces_within(brute, p.into(), radius).unwrap();
            // The nearest is among them exactly where the value says so.
            assert_eq!(within.is_empty(), value > radius);
            let size = [0.0, 0.3 * scale, f64::INFINITY][k % 3];
            let corner = match size {
                0.0 => query_nearest(brute, p),
                _ => p,
            };
            let b = Aabb::new(corner.into(), corner.map(|c| c + size).into());
            let overlapping = query::faces_overlapping(brute, b).unwrap();
            for g in others {
                assert_eq!(query::faces_within(g, p.into(), radius).unwrap(), within);
                assert_eq!(query::faces_overlapping(g, b).unwrap(), overlapping);
            }
            found[0] += within.len();
            found[1] += overlapping.len();
        }
        assert!(found[0] > 1000 && found[1] > 1000, "{found:?}");
        let g = geometries[1][0].clone();
        assert_eq!(query::faces_overlapping(&g, Aabb::ALL).unwrap().len(), body.triangles.len());
    }
}

/// The nearest point of the surface.
fn query_nearest(g: &Geometry, p: [f64; 3]) -> [f64; 3] {
    g.closest(p.into()).point.to_array()
}

#[test]
fn what_is_not_one_mesh_is_refused() {
    let g = baffle(&bodies::unit_cube(), Accelerator::Auto);
    let around = Aabb::new(Vec3::splat(-1.0), Vec3::splat(2.0));
    let two = Geometry::union(&[g.clone(), g.translate([2.0, 0.0, 0.0]).unwrap()]).unwrap();
    for (g, words) in
        [(two, "2 meshes"), (g.offset(0.1).unwrap(), "offset"), (Geometry::sphere([0.0; 3], 1.0).unwrap(), "a shape")]
    {
        let errors = [query::faces_overlapping(&g, around), query::faces_within(&g, Vec3::ZERO, 1.0)];
        for error in errors.map(Result::unwrap_err) {
            assert_eq!(error.status(), Status::Unsupported);
            assert!(error.message().contains(words), "{}", error.message());
        }
    }
    for b in [Aabb::EMPTY, Aabb::new(Vec3::NAN, Vec3::ONE)] {
        assert_eq!(query::faces_overlapping(&g, b).unwrap_err().status(), Status::InvalidArgument);
    }
    for (p, radius) in [(Vec3::NAN, 1.0), (Vec3::ZERO, -1.0), (Vec3::ZERO, f64::NAN)] {
        assert_eq!(query::faces_within(&g, p, radius).unwrap_err().status(), Status::InvalidArgument);
    }
}
