// SPDX-License-Identifier: MIT OR Apache-2.0
//! Generated surfaces. Closed ones are outward unless said otherwise.

use super::Soup;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A unit sphere of 20 * 4^level triangles around the origin.
pub fn icosphere(level: u32) -> Soup {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let corners = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ];
    let mut sphere = Soup { vertices: corners.map(on_sphere).to_vec(), triangles: ICOSAHEDRON.to_vec() };
    for _ in 0..level {
        sphere = quartered(&sphere);
        let old = std::mem::take(&mut sphere.vertices);
        sphere.vertices = old.into_iter().map(on_sphere).collect();
    }
    sphere
}

const ICOSAHEDRON: [[u32; 3]; 20] = [
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

fn on_sphere(p: [f64; 3]) -> [f64; 3] {
    let r = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|c| c / r)
}

/// Each triangle cut into four at the middles of its edges.
pub fn quartered(soup: &Soup) -> Soup {
    let mut out = Soup { vertices: soup.vertices.clone(), triangles: Vec::new() };
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    for &[a, b, c] in &soup.triangles {
        let mut middle = |p: u32, q: u32| {
            *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                let (u, v) = (soup.vertices[p as usize], soup.vertices[q as usize]);
                out.vertices.push(std::array::from_fn(|k| 0.5 * (u[k] + v[k])));
                out.vertices.len() as u32 - 1
            })
        };
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        out.triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    out
}

/// A sphere of radius `r` around `c`.
pub fn sphere_at(level: u32, c: [f64; 3], r: f64) -> Soup {
    icosphere(level).scaled(r).translated(c)
}

/// A box of 12 triangles.
pub fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Soup {
    cells(&[lo[0], hi[0]], &[lo[1], hi[1]], &[lo[2], hi[2]], |_, _, _| true)
}

/// The unit cube [0,1]^3.
pub fn unit_cube() -> Soup {
    cuboid([0.0; 3], [1.0; 3])
}

/// A tetrahedron: the corner of the unit cube.
pub fn tetrahedron() -> Soup {
    Soup {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

/// The boundary of the cells (i, j, k) of a tensor grid that `solid` names: bodies with square holes and
/// thin walls. Cells that touch in an edge only make it non-manifold.
pub fn cells(x: &[f64], y: &[f64], z: &[f64], solid: impl Fn(usize, usize, usize) -> bool) -> Soup {
    let n = [x.len() - 1, y.len() - 1, z.len() - 1];
    let is_solid = |c: [isize; 3]| {
        (0..3).all(|a| c[a] >= 0 && (c[a] as usize) < n[a]) && solid(c[0] as usize, c[1] as usize, c[2] as usize)
    };
    let mut out = Soup::default();
    let mut index: HashMap<[usize; 3], u32> = HashMap::new();
    for (k, j, i) in (0..n[2]).flat_map(|k| (0..n[1]).flat_map(move |j| (0..n[0]).map(move |i| (k, j, i)))) {
        let c = [i as isize, j as isize, k as isize];
        if !is_solid(c) {
            continue;
        }
        for (axis, up) in [(0, false), (0, true), (1, false), (1, true), (2, false), (2, true)] {
            let mut beyond = c;
            beyond[axis] += if up { 1 } else { -1 };
            if is_solid(beyond) {
                continue;
            }
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let turns = if up { [(0, 0), (1, 0), (1, 1), (0, 1)] } else { [(0, 0), (0, 1), (1, 1), (1, 0)] };
            let q = turns.map(|(du, dv)| {
                let mut at = [i, j, k];
                at[axis] += usize::from(up);
                at[u] += du;
                at[v] += dv;
                *index.entry(at).or_insert_with(|| {
                    out.vertices.push([x[at[0]], y[at[1]], z[at[2]]]);
                    out.vertices.len() as u32 - 1
                })
            });
            out.triangles.extend([[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
        }
    }
    out
}

/// An L-bracket with a square hole through each leg and walls of thickness 0.05 around them.
pub fn bracket() -> Soup {
    let s = [0.0, 0.05, 0.95, 1.0];
    let x = [0.0, 0.1, 0.5, 0.55, 1.45, 1.5];
    cells(&x, &s, &x, |i, j, k| {
        let hole = |along: usize| along == 3 && j == 1;
        (k == 0 && !hole(i)) || (i == 0 && !hole(k))
    })
}

/// A plate `nx` by `ny` by `thickness` with a round through hole of radius `r` (below 0.5) and `4 * quarter`
/// sides in each unit cell: genus `nx * ny`, walls of 1 - 2r between holes.
pub fn plate(nx: usize, ny: usize, thickness: f64, r: f64, quarter: usize) -> Soup {
    let mut out = Soup::default();
    let sides = 4 * quarter;
    let push = |out: &mut Soup, x: f64, y: f64| {
        out.vertices.extend([[x, y, 0.0], [x, y, thickness]]);
        out.vertices.len() as u32 - 2
    };
    // Even indices are the bottom, the odd one after each the top.
    let grid: Vec<u32> =
        (0..(nx + 1) * (ny + 1)).map(|c| push(&mut out, (c % (nx + 1)) as f64, (c / (nx + 1)) as f64)).collect();
    let wall = |out: &mut Soup, a: u32, b: u32| out.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    let flat = |out: &mut Soup, t: [u32; 3]| out.triangles.extend([t.map(|v| v + 1), [t[0], t[2], t[1]]]);
    for (j, i) in (0..ny).flat_map(|j| (0..nx).map(move |i| (j, i))) {
        let circle: Vec<u32> = (0..sides)
            .map(|s| {
                let a = TAU * (s as f64 / sides as f64 - 0.375);
                push(&mut out, i as f64 + 0.5 + r * libm::cos(a), j as f64 + 0.5 + r * libm::sin(a))
            })
            .collect();
        let at = |di: usize, dj: usize| grid[(j + dj) * (nx + 1) + i + di];
        let corner = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
        for q in 0..4 {
            let (here, next) = (corner[q], corner[(q + 1) % 4]);
            let middle = q * quarter + quarter / 2;
            for s in q * quarter..(q + 1) * quarter {
                let nearest = if s < middle { here } else { next };
                flat(&mut out, [nearest, circle[(s + 1) % sides], circle[s]]);
                wall(&mut out, circle[(s + 1) % sides], circle[s]);
            }
            flat(&mut out, [here, next, circle[middle]]);
        }
        for (outer, a, b) in [
            (j == 0, corner[0], corner[1]),
            (i + 1 == nx, corner[1], corner[2]),
            (j + 1 == ny, corner[2], corner[3]),
            (i == 0, corner[3], corner[0]),
        ] {
            if outer {
                wall(&mut out, a, b);
            }
        }
    }
    out
}

/// A torus around the z axis.
pub fn torus(major: f64, minor: f64, around: usize, across: usize) -> Soup {
    let mut out = Soup::default();
    for i in 0..around {
        let a = TAU * i as f64 / around as f64;
        for j in 0..across {
            let b = TAU * j as f64 / across as f64;
            let r = major + minor * libm::cos(b);
            out.vertices.push([r * libm::cos(a), r * libm::sin(a), minor * libm::sin(b)]);
        }
    }
    let at = |i: usize, j: usize| ((i % around) * across + j % across) as u32;
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        out.triangles.extend([[a, b, c], [a, c, d]]);
    }
    out
}

/// The slab [-3,3]^2 x [-0.5,0] whose top carries a pyramid on a square of half-width 0.3 that leans to the
/// apex (2.2, 0, 0.8) and so hangs over the slab: the edge at x = 0.3 is a saddle where vertex normals give
/// the wrong sign.
pub fn leaning_pyramid() -> Soup {
    let square = |h: f64, z: f64| [[-h, -h, z], [h, -h, z], [h, h, z], [-h, h, z]];
    let mut vertices = [square(3.0, -0.5), square(3.0, 0.0), square(0.3, 0.0)].concat();
    vertices.push([2.2, 0.0, 0.8]);
    let mut triangles = vec![[0, 2, 1], [0, 3, 2]];
    for q in 0..4 {
        let n = (q + 1) % 4;
        triangles.extend([[q, n, 4 + n], [q, 4 + n, 4 + q]]);
        triangles.extend([[4 + q, 4 + n, 8 + n], [4 + q, 8 + n, 8 + q]]);
        triangles.push([8 + q, 8 + n, 12]);
    }
    Soup { vertices, triangles }
}

/// Spheres of radius 3, 2 and 1, the middle one inward: a ball in a hollow ball.
pub fn nested_shells(level: u32) -> Soup {
    let shell = |r: f64| sphere_at(level, [0.0; 3], r);
    shell(3.0).and(&shell(2.0).flipped()).and(&shell(1.0))
}

/// Two unit spheres that overlap, as one soup.
pub fn overlapping_spheres(level: u32) -> Soup {
    sphere_at(level, [-0.6, 0.0, 0.0], 1.0).and(&sphere_at(level, [0.6, 0.05, 0.1], 1.0))
}

/// Two cubes that share one edge, which is non-manifold.
pub fn cubes_sharing_an_edge() -> Soup {
    cells(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0], &[0.0, 1.0], |i, j, _| i == j)
}

/// A strip with half a turn in it: one side, one boundary loop.
pub fn moebius_strip(around: usize) -> Soup {
    let mut out = Soup::default();
    for i in 0..around {
        let a = TAU * i as f64 / around as f64;
        for w in [-0.4, 0.4] {
            let r = 1.0 + w * libm::cos(0.5 * a);
            out.vertices.push([r * libm::cos(a), r * libm::sin(a), w * libm::sin(0.5 * a)]);
        }
    }
    for i in 0..around {
        let (a, b) = (2 * i as u32, 2 * i as u32 + 1);
        let (c, d) = if i + 1 < around { (a + 2, b + 2) } else { (1, 0) };
        out.triangles.extend([[a, c, d], [a, d, b]]);
    }
    out
}

/// `leaves` triangles around one edge.
pub fn book(leaves: usize) -> Soup {
    let mut out = Soup { vertices: vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]], triangles: Vec::new() };
    for k in 0..leaves {
        let a = TAU * k as f64 / leaves as f64;
        out.vertices.push([libm::cos(a), libm::sin(a), 0.5]);
        out.triangles.push([0, 1, k as u32 + 2]);
    }
    out
}

/// A square sheet of `n` by `n` unit cells at z = 0, open, normals up.
pub fn sheet(n: usize) -> Soup {
    let row = n + 1;
    let vertices = (0..row * row).map(|c| [(c % row) as f64, (c / row) as f64, 0.0]).collect();
    let mut triangles = Vec::new();
    for c in (0..n).flat_map(|j| (0..n).map(move |i| j * row + i)) {
        let [a, b, d, e] = [c, c + 1, c + row, c + row + 1].map(|v| v as u32);
        triangles.extend([[a, b, e], [a, e, d]]);
    }
    Soup { vertices, triangles }
}

/// The body with triangles halved at the middle of their longest edge, where that of their neighbour is not; a flat
/// triangle closes the gap.
pub fn with_flat_triangles(soup: &Soup) -> Soup {
    let mut out = Soup { vertices: soup.vertices.clone(), triangles: vec![] };
    let mut halved = std::collections::HashSet::new();
    for (t, &triangle) in soup.triangles.iter().enumerate() {
        let squared = |k: usize| {
            let (a, b) = (soup.corners(t)[k], soup.corners(t)[(k + 1) % 3]);
            (0..3).map(|axis| (b[axis] - a[axis]).powi(2)).sum::<f64>()
        };
        let longest = (1..3).fold(0, |best, k| if squared(k) > squared(best) { k } else { best });
        let [i, j, top] = [0, 1, 2].map(|k| triangle[(longest + k) % 3]);
        if !halved.insert((i.min(j), i.max(j))) {
            out.triangles.push(triangle);
            continue;
        }
        let (a, b) = (soup.vertices[i as usize], soup.vertices[j as usize]);
        let middle = out.vertices.len() as u32;
        out.vertices.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
        out.triangles.extend([[i, middle, top], [middle, j, top], [i, j, middle]]);
    }
    out
}

/// Triangles between points of a coarse lattice, of which every third is flat, and some a point.
pub fn lattice_soup(count: u32) -> Soup {
    let mut random = super::random::Random(23);
    let mut soup = Soup { vertices: vec![], triangles: vec![] };
    for t in 0..count {
        let mut whole = || [0; 3].map(|_: i32| random.below(9) as f64 - 4.0);
        let (a, b, c) = (whole(), whole(), whole());
        let c = if t % 3 == 0 { [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * ((t / 3 % 5) as f64 - 1.0)) } else { c };
        soup.vertices.extend([a, b, c]);
        soup.triangles.push([3 * t, 3 * t + 1, 3 * t + 2]);
    }
    soup
}
