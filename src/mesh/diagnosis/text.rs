// SPDX-License-Identifier: MIT OR Apache-2.0
//! A diagnosis in words: totals, what is wrong and where, components, loops, and what to do.

use super::digits::{count, point, significant};
use super::examples::SHOWN;
use super::{BoundaryLoop, Component, Diagnosis};
use crate::math::{Aabb, Vec3};
use crate::mesh::RepairOptions;

/// Rows of a table.
const ROWS: usize = 20;

impl Diagnosis {
    /// The diagnosis as English text, a fact a line, each ending with a line feed: a dozen lines or so, and at
    /// most twenty rows each for components and loops. Volume and area have eight significant digits.
    pub fn text(&self) -> String {
        let mut lines = self.totals();
        lines.extend(self.topology());
        lines.extend(self.faults());
        lines.extend(self.component_table());
        lines.extend(self.loop_table());
        lines.push(format!("to do: {}", self.advice()));
        lines.join("\n") + "\n"
    }

    fn totals(&self) -> Vec<String> {
        let r = &self.report;
        let bounds = Aabb::new(Vec3::from_array(r.lo), Vec3::from_array(r.hi));
        let meaning = if r.closed { "" } else { " (of an open surface: it depends on where the mesh lies)" };
        vec![
            format!(
                "{}, {}, {}, {}",
                count(r.faces, "face"),
                count(r.triangles, "triangle"),
                count(r.vertices, "vertex"),
                count(r.components, "component")
            ),
            format!("box {} to {}, diagonal {}", point(bounds.lo), point(bounds.hi), significant(bounds.diagonal(), 6)),
            format!("area {}", significant(r.area, 8)),
            format!("signed volume {}{meaning}", significant(r.volume, 8)),
        ]
    }

    fn topology(&self) -> Vec<String> {
        let r = &self.report;
        let closed = match r.closed {
            true => "closed: yes".to_owned(),
            false => {
                let open = self.loops.iter().filter(|l| !l.closed).count();
                let chains = match open {
                    0 => String::new(),
                    1 => ", 1 chain that does not close".to_owned(),
                    _ => format!(", {open} chains that do not close"),
                };
                let loops = count(self.loops.len() - open, "loop");
                format!("closed: no, {} in {loops}{chains}", count(r.boundary_edges, "boundary edge"))
            }
        };
        let edges = self.inconsistent_edges.iter().zip(&self.examples.inconsistent_edges);
        let shown = edges.map(|(e, p)| format!("{} and {} at {}", e.faces[0], e.faces[1], point(*p)));
        let consistent = match r.inconsistent_edges {
            0 => "consistent: yes".to_owned(),
            n => format!(
                "consistent: no, faces run the same way along {}: {}",
                count(n, "edge"),
                examples(n, "faces", shown)
            ),
        };
        let mut lines = vec![closed, consistent];
        if r.inside_out {
            lines.push("inside out: yes".to_owned());
        }
        lines
    }

    /// A line for each kind of fault that there is, and one for all that there are not.
    fn faults(&self) -> Vec<String> {
        let (mut lines, mut absent, mut unsought) = (Vec::new(), Vec::new(), Vec::new());
        let mut tell = |what: &str, n: usize, shown: String| match n {
            0 => absent.push(what.to_owned()),
            _ => lines.push(format!("{what}: {n}: {shown}")),
        };
        let at = |label: String, p: &Vec3| format!("{label} at {}", point(*p));
        let e = &self.examples;
        let n = self.nonmanifold_edges.len();
        let faces_at = |k: usize| self.nonmanifold_edge_faces.get(k).map_or(0, <[u32]>::len);
        let edges = self.nonmanifold_edges.iter().zip(&e.nonmanifold_edges).enumerate();
        let shown = edges.map(|(k, ([a, b], p))| at(format!("{a}-{b} of {} faces", faces_at(k)), p));
        tell("non-manifold edges", n, examples(n, "vertices", shown));
        let n = self.nonmanifold_vertices.len();
        let vertices = self.nonmanifold_vertices.iter().zip(&e.nonmanifold_vertices);
        let shown = vertices.map(|(v, p)| at(format!("{} of {} fans", v.vertex, v.fans), p));
        tell("non-manifold vertices", n, examples(n, "", shown));
        let n = self.shrunk_faces.len();
        let shown = self.shrunk_faces.iter().take(SHOWN).map(u32::to_string);
        tell("faces that lost corners in welding", n, examples(n, "faces", shown));
        let n = self.flat_faces.len();
        let shown = self.flat_faces.iter().zip(&e.flat_faces).map(|(f, p)| at(f.to_string(), p));
        tell("faces of zero area", n, examples(n, "faces", shown));
        let n = self.duplicates.len();
        let way = |same: bool| if same { "the same way" } else { "the other way" };
        let duplicates = self.duplicates.iter().zip(&e.duplicates);
        let shown = duplicates.map(|(d, p)| at(format!("{} as {} {}", d.face, d.original, way(d.same_way)), p));
        tell("duplicate faces", n, examples(n, "faces", shown));
        let n = self.slivers.len();
        let slivers = self.slivers.iter().zip(&e.slivers);
        let shown = slivers.map(|(s, p)| at(format!("{} of ratio {}", s.face, significant(s.ratio, 2)), p));
        match self.sought.sliver_ratio {
            0.0 => unsought.push("slivers"),
            _ => tell("slivers", n, examples(n, "faces", shown)),
        }
        let n = self.warped_faces.len();
        let faces = self.warped_faces.iter().zip(&e.warped_faces);
        let shown = faces.map(|(s, p)| at(format!("{} off a plane by {}", s.face, significant(s.ratio, 2)), p));
        tell("warped faces", n, examples(n, "faces", shown));
        let n = self.off_plane_faces.len();
        let faces = self.off_plane_faces.iter().zip(&e.off_plane_faces);
        let shown = faces.map(|(s, p)| at(format!("{} by {}", s.face, significant(s.ratio, 2)), p));
        match self.sought.off_plane_ratio {
            0.0 => unsought.push("faces off a plane"),
            _ => tell("faces off a plane", n, examples(n, "faces", shown)),
        }
        match &self.intersections {
            Some(found) if found.count == 0 => absent.push("intersections".to_owned()),
            Some(found) => {
                let least = if found.complete { "" } else { "at least " };
                let shown =
                    found.pairs.iter().zip(&e.intersections).map(|(p, x)| at(format!("{} and {}", p[0], p[1]), x));
                let n = usize::try_from(found.count).unwrap_or(usize::MAX);
                lines.push(format!("pairs of faces that intersect: {least}{n}: {}", examples(n, "faces", shown)));
            }
            None => lines.push("pairs of faces that intersect: not looked for".to_owned()),
        }
        if !absent.is_empty() {
            lines.push(format!("none found: {}", absent.join(", ")));
        }
        if !unsought.is_empty() {
            lines.push(format!("not looked for: {}", unsought.join(", ")));
        }
        lines
    }

    fn component_table(&self) -> Vec<String> {
        if self.components.len() < 2 {
            return Vec::new();
        }
        let mut lines = vec![heading("components", self.components.len())];
        lines.extend(self.components.iter().take(ROWS).enumerate().map(|(k, c)| {
            let bounds = Aabb::new(Vec3::from_array(c.lo), Vec3::from_array(c.hi));
            format!(
                "  {k}: {} from face {}, {}, volume {}, area {}, box {} to {}",
                count(c.faces, "face"),
                c.lowest_face,
                state(c),
                significant(c.volume, 8),
                significant(c.area, 8),
                point(bounds.lo),
                point(bounds.hi)
            )
        }));
        lines
    }

    fn loop_table(&self) -> Vec<String> {
        if self.loops.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![heading("boundary loops", self.loops.len())];
        lines.extend(self.loops.iter().take(ROWS).enumerate().map(|(k, l)| {
            let bounds = Aabb::new(Vec3::from_array(l.lo), Vec3::from_array(l.hi));
            format!(
                "  {k}: {}{}, length {}, across {} around {}, component {}",
                count(l.edges, "edge"),
                if l.closed { "" } else { " that do not close" },
                significant(l.length, 6),
                significant(l.diagonal(), 6),
                point(bounds.center()),
                l.component
            )
        }));
        lines
    }

    /// What to do, in one line.
    fn advice(&self) -> String {
        let crosses = self.intersections.as_ref().is_some_and(|found| found.count > 0);
        let balanced = self.surface.unbalanced_edges == 0;
        let mut parts = Vec::new();
        parts.extend(if balanced { self.advice_on_orientation() } else { Some(self.advice_for_open()) });
        if balanced && (crosses || self.surface.nonmanifold_edges > 0) {
            parts.push(String::from(if crosses {
                "faces touch or pass through each other: EMB_SIGN_AUTO takes the sign near them from crossings"
            } else {
                "edges have more than two faces: EMB_SIGN_AUTO takes the sign from crossings, as EMB_SIGN_RAY does"
            }));
        }
        if balanced && !self.duplicates.is_empty() {
            let repeat = if self.duplicates.len() == 1 { "repeats another" } else { "repeat others" };
            let copies = count(self.duplicates.len(), "face");
            parts.push(format!("{copies} {repeat}: a signed distance takes one of each"));
        }
        if self.solid_within > 0 {
            let (n, one) = (self.solid_within, self.solid_within == 1);
            let shells = count(n, "closed component");
            let (faces, encloses) = if one { ("faces", "is") } else { ("face", "are") };
            parts.push(format!(
                "{shells} within another {faces} outward, too, and {encloses} no cavity: EMB_REPAIR_ORIENT or \
                 EMB_ORIENT_ALTERNATE makes it one"
            ));
        }
        if parts.is_empty() {
            let sought = if self.intersections.is_some() { "" } else { ", but for intersections, not looked for" };
            parts.push(format!("nothing{sought}: closed, consistent, outward, fit for a signed distance as it is"));
        }
        parts.join("; ")
    }

    fn advice_on_orientation(&self) -> Option<String> {
        let inside_out = self.report.inside_out;
        match self.turned_faces {
            0 if inside_out => {
                Some("inside out, and kept so: read it with EMB_ORIENT_AUTO unless inward is meant".to_owned())
            }
            0 => None,
            all if inside_out && all == self.faces_left() => {
                Some("closed, consistent, inside out: EMB_ORIENT_AUTO has turned it".to_owned())
            }
            some => Some(format!("EMB_ORIENT_AUTO has turned {} over", count(some, "face"))),
        }
    }

    /// Where the surface has no inside: loops can be filled, other edges without a partner cannot.
    fn advice_for_open(&self) -> String {
        let unsigned =
            "ask for the sign by the winding number (EMB_SIGN_WINDING) or the unsigned distance (EMB_SIGN_NONE)";
        if let Some((tolerance, joined)) = self.weldable {
            let boundary = count(self.report.boundary_edges, "boundary edge");
            return format!(
                "{joined} of {boundary} nearly coincide: weld with weld_tolerance {tolerance:e}, at reading or with \
                 EMB_REPAIR_WELD, before holes are filled"
            );
        }
        let fillable = !self.loops.is_empty() && self.loops.iter().all(|l| l.closed);
        if fillable && self.surface.unbalanced_edges == self.report.boundary_edges {
            let largest = self.loops.iter().map(|l| l.edges).max().unwrap_or(0);
            let rest = if self.loops.len() > 1 { ", the largest" } else { "" };
            let (holes, edges) = (count(self.loops.len(), "hole"), count(largest, "edge"));
            let how = self.hole_limits().unwrap_or_else(|| " (hole_length says how long a rim)".to_owned());
            return format!("{holes}{rest} of {edges}: repair with EMB_REPAIR_HOLES{how} or {unsigned}");
        }
        let n = self.surface.unbalanced_edges;
        let (edges, do_not) = (count(n, "edge"), if n == 1 { "does not" } else { "do not" });
        format!("{edges} {do_not} have as many faces one way as the other: no inside; {unsigned}")
    }

    /// What the options must say so that all holes are filled, where the defaults leave some.
    fn hole_limits(&self) -> Option<String> {
        let defaults = RepairOptions::default();
        // Three edges are a missing triangle, however long.
        let holes = || self.loops.iter().filter(|l| l.edges > 3);
        let share = |l: &BoundaryLoop| {
            let c = &self.components[l.component as usize];
            l.length / Aabb::new(Vec3::from_array(c.lo), Vec3::from_array(c.hi)).diagonal()
        };
        let longest = holes().map(share).fold(0.0, f64::max);
        let most = holes().map(|l| l.edges).max().unwrap_or(0);
        let mut raised = Vec::new();
        if longest > defaults.hole_length {
            let n = holes().filter(|l| share(l) > defaults.hole_length).count();
            let (rims, are) = (count(n, "rim"), if n == 1 { "is" } else { "are" });
            let (limit, enough) = (defaults.hole_length, (1e3 * longest * (1.0 + 1e-9)).ceil() / 1e3);
            raised.push(format!(
                "hole_length {enough} ({rims} {are} longer than the {limit} component diagonals of the default; if not meant open)"
            ));
        }
        if most > RepairOptions::MOST_HOLE_EDGES {
            raised.push(format!("no way to fill those of more than {} edges", RepairOptions::MOST_HOLE_EDGES));
        } else if most > defaults.hole_edges {
            raised.push(format!("hole_edges {most} (by default {})", defaults.hole_edges));
        }
        (!raised.is_empty()).then(|| format!(" and {}", raised.join(" and ")))
    }

    /// Faces that are left after welding.
    fn faces_left(&self) -> usize {
        self.components.iter().map(|c| c.faces).sum()
    }
}

fn state(c: &Component) -> String {
    let closed = if c.is_closed() { "closed".to_owned() } else { count(c.boundary_edges, "boundary edge") };
    let consistent = if c.is_consistent() { "" } else { ", inconsistent" };
    let inside_out = if c.inside_out { ", inside out" } else { "" };
    let turned = if c.turned_faces > 0 { format!(", {} turned", c.turned_faces) } else { String::new() };
    format!("{closed}{consistent}{inside_out}{turned}")
}

fn heading(what: &str, n: usize) -> String {
    if n > ROWS { format!("{what}, the first {ROWS} of {n}:") } else { format!("{what}:") }
}

/// The first few of `n`.
fn examples(n: usize, what: &str, shown: impl Iterator<Item = String>) -> String {
    let shown: Vec<String> = shown.collect();
    let more = if n > shown.len() { ", ..." } else { "" };
    let gap = if what.is_empty() { "" } else { " " };
    format!("{what}{gap}{}{more}", shown.join(", "))
}
