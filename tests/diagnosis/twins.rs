// SPDX-License-Identifier: MIT OR Apache-2.0
//! Edges, fans, components and copies of random meshes against plain twins that look everything up in maps.

use super::*;
use std::collections::{BTreeMap, BTreeSet};

/// The faces at each edge with the way they run, of faces of three different positions, by position.
type EdgeMap = BTreeMap<[usize; 2], Vec<(u32, bool)>>;

struct Plain {
    /// The position number of each corner.
    triangles: Vec<[usize; 3]>,
    left: Vec<u32>,
    edges: EdgeMap,
}

impl Plain {
    /// Positions are numbered in the order in which faces' vertices are given.
    fn of(soup: &Soup, mesh: &Mesh) -> Plain {
        let number: BTreeMap<[u64; 3], usize> =
            mesh.vertices().iter().enumerate().map(|(k, p)| (p.to_array().map(f64::to_bits), k)).collect();
        let at = |v: u32| number.get(&soup.vertices[v as usize].map(|c| (c + 0.0).to_bits())).copied();
        let triangles: Vec<[usize; 3]> =
            soup.triangles.iter().map(|t| t.map(|v| at(v).unwrap_or(usize::MAX))).collect();
        let distinct = |t: &[usize; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let left: Vec<u32> = (0..triangles.len() as u32).filter(|t| distinct(&triangles[*t as usize])).collect();
        let mut edges = EdgeMap::new();
        for &t in &left {
            for k in 0..3 {
                let (a, b) = (triangles[t as usize][k], triangles[t as usize][(k + 1) % 3]);
                edges.entry([a.min(b), a.max(b)]).or_default().push((t, a < b));
            }
        }
        Plain { triangles, left, edges }
    }

    /// Sets of `items` that `links` connect, each sorted, by lowest member.
    fn sets(items: &[u32], links: &BTreeSet<[u32; 2]>) -> Vec<Vec<u32>> {
        let mut open: BTreeSet<u32> = items.iter().copied().collect();
        let mut all = Vec::new();
        while let Some(first) = open.pop_first() {
            let (mut set, mut next) = (vec![first], 0);
            while next < set.len() {
                let at = set[next];
                next += 1;
                let near: Vec<u32> =
                    open.iter().copied().filter(|g| links.contains(&[at.min(*g), at.max(*g)])).collect();
                near.iter().for_each(|g| {
                    open.remove(g);
                });
                set.extend(near);
            }
            set.sort_unstable();
            all.push(set);
        }
        all
    }

    fn links(&self, wanted: impl Fn(&[usize; 2], &[(u32, bool)]) -> bool) -> BTreeSet<[u32; 2]> {
        let mut links = BTreeSet::new();
        for (_, faces) in self.edges.iter().filter(|(e, f)| wanted(e, f)) {
            for (a, _) in faces {
                links.extend(faces.iter().map(|(b, _)| [*a.min(b), *a.max(b)]));
            }
        }
        links
    }

    fn fans_at(&self, v: usize) -> usize {
        let at: Vec<u32> = self.left.iter().copied().filter(|t| self.triangles[*t as usize].contains(&v)).collect();
        Plain::sets(&at, &self.links(|e, faces| e.contains(&v) && faces.len() == 2)).len()
    }
}

fn soups() -> Vec<Soup> {
    let mut random = Random(51);
    let mut all = vec![
        bodies::sheet(3).without(|k| k == 4 || k == 9),
        bodies::cubes_sharing_an_edge().flipped_where(|k| k % 5 == 0),
        bodies::nested_shells(1).flipped_where(|k| k % 7 == 3),
        bodies::moebius_strip(9),
        bodies::tetrahedron().duplicated().and(&bodies::unit_cube()),
        bodies::book(5).and(&bodies::book(4).translated([0.0, 0.0, 1.0])),
    ];
    for (count, points) in [(30, 3), (60, 3), (60, 4), (120, 6)] {
        all.extend((0..5).map(|_| grid_soup(count, points, &mut random)));
    }
    all
}

#[test]
fn edges_are_those_of_a_map() {
    for soup in soups() {
        for mesh in [soup.mesh(), soup.mesh_kept(), soup.mesh_with(&flip())] {
            let (plain, found) = (Plain::of(&soup, &mesh), diagnosis(&mesh));
            let sorted = |faces: &[(u32, bool)]| {
                let mut numbers: Vec<u32> = faces.iter().map(|(t, _)| *t).collect();
                numbers.sort_unstable();
                numbers
            };
            let crowded: Vec<_> = plain.edges.iter().filter(|(_, f)| f.len() > 2).collect();
            let edges: Vec<[usize; 2]> = found.nonmanifold_edges.iter().map(|e| e.map(|v| v as usize)).collect();
            assert_eq!(edges, crowded.iter().map(|(e, _)| **e).collect::<Vec<_>>());
            assert_eq!(found.nonmanifold_edge_faces.len(), crowded.len());
            for (list, (_, faces)) in found.nonmanifold_edge_faces.iter().zip(&crowded) {
                assert_eq!(list, sorted(faces));
            }
            let disagree = plain.edges.iter().filter(|(_, f)| f.len() == 2 && f[0].1 == f[1].1);
            let wanted: Vec<_> = disagree.map(|(e, f)| (*e, sorted(f))).collect();
            let listed: Vec<_> =
                found.inconsistent_edges.iter().map(|e| (e.vertices.map(|v| v as usize), e.faces.to_vec())).collect();
            assert_eq!(listed, wanted);
            let report = mesh.report();
            assert_eq!(
                (report.nonmanifold_edges, report.inconsistent_edges),
                (found.nonmanifold_edges.len(), found.inconsistent_edges.len())
            );
        }
    }
}

fn flip() -> embound::mesh::MeshOptions {
    embound::mesh::MeshOptions { orient: embound::mesh::Orient::Flip, ..Default::default() }
}

#[test]
fn fans_at_vertices_are_those_of_a_search() {
    let mut several = 0;
    for soup in soups() {
        let mesh = soup.mesh();
        let (plain, found) = (Plain::of(&soup, &mesh), diagnosis(&mesh));
        let wanted: Vec<(u32, u32)> = (0..mesh.vertices().len())
            .map(|v| (v as u32, plain.fans_at(v) as u32))
            .filter(|(_, fans)| *fans > 1)
            .collect();
        several += wanted.len();
        let listed: Vec<(u32, u32)> = found.nonmanifold_vertices.iter().map(|v| (v.vertex, v.fans)).collect();
        assert_eq!(listed, wanted);
    }
    assert!(several > 100, "{several}");
}

#[test]
fn components_are_those_of_a_search() {
    for soup in soups() {
        for mesh in [soup.mesh(), soup.mesh_kept()] {
            let (plain, found) = (Plain::of(&soup, &mesh), diagnosis(&mesh));
            let sets = Plain::sets(&plain.left, &plain.links(|_, _| true));
            assert_eq!(found.components.len(), sets.len());
            assert_eq!(mesh.report().components, sets.len());
            for (k, (component, set)) in found.components.iter().zip(&sets).enumerate() {
                assert_eq!((component.lowest_face, component.faces), (set[0], set.len()));
                assert!(set.iter().all(|t| found.component_of_face[*t as usize] == k as u32));
                let edges = plain.edges.values().filter(|f| set.contains(&f[0].0));
                let (mut boundary, mut crowded, mut disagree, mut balanced) = (0, 0, 0, true);
                for faces in edges {
                    boundary += usize::from(faces.len() == 1);
                    crowded += usize::from(faces.len() > 2);
                    disagree += usize::from(faces.len() == 2 && faces[0].1 == faces[1].1);
                    balanced &= 2 * faces.iter().filter(|f| f.1).count() == faces.len();
                }
                assert_eq!((component.boundary_edges, component.nonmanifold_edges), (boundary, crowded));
                assert_eq!((component.inconsistent_edges, component.is_closed()), (disagree, boundary == 0));
                let corners = |t: &u32| soup.corners(*t as usize).map(Vec3::from_array);
                let volume: f64 = set
                    .iter()
                    .map(corners)
                    .map(|[a, b, c]| a.x + b.x + c.x)
                    .zip(set.iter().map(corners))
                    .map(|(x, [a, b, c])| x * (b - a).cross(c - a).x / 6.0)
                    .sum();
                let area: f64 = set.iter().map(corners).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
                assert!((component.volume - volume).abs() <= 1e-9 * (1.0 + area), "{} {volume}", component.volume);
                assert!((component.area - area).abs() <= 1e-9 * area, "{} {area}", component.area);
                assert_eq!(component.inside_out, balanced && component.volume < 0.0);
                let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
                for p in set.iter().flat_map(corners) {
                    lo = [0, 1, 2].map(|d| lo[d].min(p[d]));
                    hi = [0, 1, 2].map(|d| hi[d].max(p[d]));
                }
                assert_eq!((component.lo, component.hi), (lo, hi));
            }
            let gone = found.component_of_face.iter().filter(|c| **c == embound::mesh::NO_COMPONENT).count();
            assert_eq!(gone, soup.triangles.len() - plain.left.len());
        }
    }
}

#[test]
fn copies_name_the_earliest_and_the_way_they_run() {
    for soup in soups() {
        for mesh in [soup.mesh(), soup.mesh_kept()] {
            let (plain, found) = (Plain::of(&soup, &mesh), diagnosis(&mesh));
            let mut seen: BTreeMap<Vec<usize>, u32> = BTreeMap::new();
            let mut wanted = Vec::new();
            for &t in &plain.left {
                let corners = plain.triangles[t as usize];
                let mut key = corners.to_vec();
                key.sort_unstable();
                let first = *seen.entry(key).or_insert(t);
                if first != t {
                    let of = plain.triangles[first as usize];
                    let turned = (0..3).any(|k| corners == [of[k], of[(k + 1) % 3], of[(k + 2) % 3]]);
                    wanted.push((t, first, turned));
                }
            }
            let listed: Vec<_> = found.duplicates.iter().map(|d| (d.face, d.original, d.same_way)).collect();
            assert_eq!(listed, wanted);
            assert_eq!(mesh.report().duplicate_faces, wanted.len());
        }
    }
}
