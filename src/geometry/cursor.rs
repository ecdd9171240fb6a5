// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values at points that follow one another closely, faster than each by itself.

use super::Geometry;
use super::node::Node;
use super::surface::Cells;
use super::value::DEEPEST_BLOCK;
use crate::math::{Vec3, positive_zero};
use std::sync::Mutex;

/// Unions and intersections of more parts are asked as a whole.
const MOST_PARTS: usize = 8;

/// A geometry with what was found around the points it was asked about lately. Values are those of the geometry to the
/// bit. It serves one thread at a time: another that comes while it answers is answered by the geometry itself.
pub struct Cursor {
    geometry: Geometry,
    memory: Mutex<Memory>,
}

/// What is remembered for a node and those below it.
enum Memory {
    Nothing,
    Surface(Box<Cells>),
    Child(Box<Memory>),
    Parts(Vec<Memory>),
}

impl Cursor {
    /// O(1) but for a few nodes.
    pub fn new(geometry: &Geometry) -> Cursor {
        let is_deep = geometry.summary().depth > DEEPEST_BLOCK;
        let memory = if is_deep { Memory::Nothing } else { Memory::of(geometry) };
        Cursor { geometry: geometry.clone(), memory: Mutex::new(memory) }
    }

    /// [`Geometry::value`].
    pub fn value(&self, p: Vec3) -> f64 {
        match self.memory.try_lock() {
            Ok(mut memory) if p.is_finite() => positive_zero(memory.value(&self.geometry, p)),
            _ => self.geometry.value(p),
        }
    }

    /// What it asks.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }
}

impl Memory {
    fn of(g: &Geometry) -> Memory {
        match g.node() {
            Node::Surface(_) => Memory::Surface(Box::default()),
            Node::Union(parts) | Node::Intersection(parts) if parts.list().len() <= MOST_PARTS => {
                let parts: Vec<Memory> = parts.list().iter().map(Memory::of).collect();
                match parts.iter().all(|part| matches!(part, Memory::Nothing)) {
                    true => Memory::Nothing,
                    false => Memory::Parts(parts),
                }
            }
            Node::Complement(g) | Node::Translate(g, _) | Node::Place(g, _) | Node::Level(g, _) | Node::Part(g, _) => {
                match Memory::of(g) {
                    Memory::Nothing => Memory::Nothing,
                    child => Memory::Child(Box::new(child)),
                }
            }
            _ => Memory::Nothing,
        }
    }

    /// The value; the sign of zero is not settled yet.
    fn value(&mut self, g: &Geometry, p: Vec3) -> f64 {
        match (self, g.node()) {
            (Memory::Surface(cells), Node::Surface(surface)) if p.is_finite() => cells.value(surface, p),
            (Memory::Child(memory), node) => match node {
                Node::Complement(g) => 0.0 - memory.value(g, p),
                Node::Translate(g, shift) => memory.value(g, p - *shift),
                Node::Place(g, placement) => placement.scale() * memory.value(g, placement.to_body(p)),
                Node::Level(g, level) => level.value(memory.value(g, p)),
                Node::Part(g, _) => memory.value(g, p),
                _ => g.raw_value(p),
            },
            (Memory::Parts(memories), Node::Union(parts) | Node::Intersection(parts)) => {
                let sign = if parts.is_turned() { -1.0 } else { 1.0 };
                let mut least = f64::INFINITY;
                for (memory, part) in memories.iter_mut().zip(parts.list()) {
                    let value = memory.value(part, p) * sign;
                    // The first NaN stays.
                    if !least.is_nan() && (value < least || value.is_nan()) {
                        least = value;
                    }
                }
                least * sign
            }
            _ => g.raw_value(p),
        }
    }
}
