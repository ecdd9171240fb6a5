// SPDX-License-Identifier: MIT OR Apache-2.0
//! A unit sphere of nearly as many triangles as asked: each side of an icosahedron cut into n by n.

use std::collections::BTreeMap;

pub struct Sphere {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

const SIDES: [[u32; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

fn corners() -> [[f64; 3]; 12] {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let (a, b) = ([-1.0, 1.0, -1.0, 1.0], [g, g, -g, -g]);
    std::array::from_fn(|k| {
        let (p, q) = (a[k % 4], b[k % 4]);
        on_sphere([[p, q, 0.0], [0.0, p, q], [q, 0.0, p]][k / 4])
    })
}

fn on_sphere(p: [f64; 3]) -> [f64; 3] {
    let r = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|c| c / r)
}

/// About `wanted` triangles, outward.
pub fn icosphere(wanted: usize) -> Sphere {
    let n = ((wanted as f64 / 20.0).sqrt().round() as usize).max(1);
    let corner = corners();
    let mut sphere = Sphere { vertices: corner.to_vec(), triangles: Vec::new() };
    let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for side in SIDES {
        let mut numbers = BTreeMap::new();
        for i in 0..=n {
            for j in 0..=n - i {
                // Weights of the three corners; two of them alone on an edge, which two sides share.
                let weights = [n - i - j, i, j];
                let blend = |w: [usize; 3]| {
                    on_sphere(
                        [0, 1, 2]
                            .map(|d| (0..3).map(|c| w[c] as f64 * corner[side[c] as usize][d]).sum::<f64>() / n as f64),
                    )
                };
                let on: Vec<usize> = (0..3).filter(|&c| weights[c] > 0).collect();
                let number = match on[..] {
                    [c] => side[c],
                    [c, d] => {
                        let (c, d) = if side[c] < side[d] { (c, d) } else { (d, c) };
                        let first = *edges.entry((side[c], side[d])).or_insert_with(|| {
                            let first = sphere.vertices.len() as u32;
                            sphere.vertices.extend((1..n).map(|step| {
                                let mut w = [0; 3];
                                (w[c], w[d]) = (n - step, step);
                                blend(w)
                            }));
                            first
                        });
                        first + weights[d] as u32 - 1
                    }
                    _ => {
                        sphere.vertices.push(blend(weights));
                        sphere.vertices.len() as u32 - 1
                    }
                };
                numbers.insert((i, j), number);
            }
        }
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            let [a, b, c] = [(i, j), (i + 1, j), (i, j + 1)].map(|at| numbers[&at]);
            sphere.triangles.push([a, b, c]);
            if i + j + 1 < n {
                sphere.triangles.push([b, numbers[&(i + 1, j + 1)], c]);
            }
        }
    }
    sphere
}

#[cfg(test)]
mod tests {
    use super::icosphere;

    #[test]
    fn a_sphere_is_closed_outward_and_of_radius_1() {
        for (wanted, n) in [(1, 1), (80, 2), (1_000, 7)] {
            let sphere = icosphere(wanted);
            assert_eq!((sphere.vertices.len(), sphere.triangles.len()), (10 * n * n + 2, 20 * n * n));
            let mut edges = std::collections::BTreeMap::new();
            let mut volume = 0.0;
            for &[a, b, c] in &sphere.triangles {
                for edge in [(a, b), (b, c), (c, a)] {
                    assert_eq!(edges.insert(edge, ()), None, "{edge:?} twice the same way");
                }
                let [p, q, r] = [a, b, c].map(|v| sphere.vertices[v as usize]);
                volume += p[0] * (q[1] * r[2] - q[2] * r[1])
                    + p[1] * (q[2] * r[0] - q[0] * r[2])
                    + p[2] * (q[0] * r[1] - q[1] * r[0]);
            }
            assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))));
            assert!(volume > 0.0);
            let radius = |p: &[f64; 3]| p.iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!(sphere.vertices.iter().all(|p| (radius(p) - 1.0).abs() < 1e-15));
        }
    }
}
