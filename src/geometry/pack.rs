// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometries in relocatable blocks. Nodes stand there in the order in which they are made, children first, and one that
//! is shared once; each is a number of its kind and the numbers it is made of. Small ones are made anew, which takes no
//! arithmetic that could come out otherwise; the arrays of large ones are views.

use super::blend::Blend;
use super::level::Level;
use super::linear::Linear;
use super::map::Map;
use super::node::Node;
use super::parts::Parts;
use super::placement::Placement;
use super::properties::UnpackCheck;
use super::shape;
use super::smooth::Smooth;
use super::stencil::Stencil;
use super::surface::Surface;
use super::twist::Twist;
use super::{Geometry, kinds};
use crate::error::{Error, Result, Status, filled, try_with_capacity};
use crate::parallel::Run;
use crate::store::{Block, Packed, Packer, Sealed, Unpacker, wrong};
use std::collections::HashMap;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

impl Geometry {
    /// The bytes from which [`Geometry::unpack`] makes a geometry of the same answers, to the bit, on any machine with
    /// the same order of bytes and by any process. They depend on nothing but what the geometry is made of, and hold no
    /// addresses.
    ///
    /// # Errors
    /// [`Status::Unsupported`] where a function of the user's takes part.
    pub fn pack(&self) -> Result<Vec<u8>> {
        let packed = self.packed()?;
        let mut bytes = filled("bytes", packed.size(), 0)?;
        packed.write(&mut bytes, &Run::SERIAL)?;
        Ok(bytes)
    }

    /// Writes those bytes.
    ///
    /// # Errors
    /// As [`Geometry::pack`]; [`Status::Io`] where writing fails.
    pub fn pack_to(&self, out: &mut dyn Write, run: &Run) -> Result<()> {
        let written = self.sealed(run)?.write_to(out);
        written.map_err(|e| Error::new(Status::Io, format!("out: {e}")))
    }

    /// The geometry that was packed; the bytes are copied.
    ///
    /// # Errors
    /// [`Status::Parse`] where they are not those of a geometry, or damaged; [`Status::Unsupported`] where another version or
    /// a machine with another order of bytes made them.
    pub fn unpack(bytes: &[u8], check: UnpackCheck, run: &Run) -> Result<Geometry> {
        Geometry::unpacked(Block::copy_of(bytes)?, check, run)
    }

    /// The geometry whose packed bytes are a file. The file is mapped: processes that open it share its memory, and only what
    /// is asked for is read where it is trusted. Nobody may change the file while it is in use; to write it anew and
    /// rename is no change.
    ///
    /// # Errors
    /// As [`Geometry::unpack`]; [`Status::Io`] where the file cannot be opened.
    pub fn open(path: &Path, check: UnpackCheck, run: &Run) -> Result<Geometry> {
        let failure = |e: std::io::Error| Error::new(Status::Io, format!("{}: cannot open: {e}", path.display()));
        let file = File::open(path).map_err(failure)?;
        let size = file.metadata().map_err(failure)?.len();
        let size = usize::try_from(size).map_err(|_| Error::memory("bytes", usize::MAX))?;
        let named = |e: Error| Error::new(e.status(), format!("{}: {}", path.display(), e.message()));
        Geometry::unpacked(Block::of_file(&file, size).map_err(named)?, check, run).map_err(named)
    }

    /// A block of it, of which nothing is made yet.
    pub(crate) fn packed(&self) -> Result<Packed<'_>> {
        let (mut out, mut seen) = (Packer::default(), HashMap::new());
        out.word(self.count(&mut HashMap::new()));
        self.pack_node(&mut out, &mut seen)?;
        out.packed()
    }

    pub(crate) fn sealed(&self, run: &Run) -> Result<Sealed<'_>> {
        self.packed()?.sealed(run)
    }

    /// Nodes not seen before.
    fn count(&self, seen: &mut HashMap<usize, u64>) -> u64 {
        if seen.insert(Arc::as_ptr(&self.inner).addr(), 0).is_some() {
            return 0;
        }
        1 + self.node().children().iter().map(|g| g.count(seen)).sum::<u64>()
    }

    /// The number of the node, which is packed where it is not yet.
    fn pack_node<'a>(&'a self, out: &mut Packer<'a>, seen: &mut HashMap<usize, u64>) -> Result<u64> {
        let key = Arc::as_ptr(&self.inner).addr();
        if let Some(number) = seen.get(&key) {
            return Ok(*number);
        }
        let children = self.node().children();
        let mut numbers = try_with_capacity("nodes", children.len())?;
        for child in children {
            numbers.push(child.pack_node(out, seen)?);
        }
        self.node().pack(&numbers, out)?;
        let number = seen.len() as u64;
        seen.insert(key, number);
        Ok(number)
    }

    /// What stands in a block.
    pub(crate) fn unpacked(block: Arc<Block>, check: UnpackCheck, run: &Run) -> Result<Geometry> {
        let mut from = Unpacker::new(block, check == UnpackCheck::Check, run)?;
        // A node takes two words at least.
        let count = from.count(2, "nodes")?;
        let mut nodes: Vec<Geometry> = try_with_capacity("nodes", count)?;
        for k in 0..count {
            let keep = (k + 1 == count).then(|| from.block());
            // What constructors refuse stands in no block that was packed.
            let damage = |e: Error| if e.status() == Status::InvalidArgument { wrong(e.message()) } else { e };
            let node = unpack_node(&mut from, &nodes).map_err(damage)?;
            nodes.push(Geometry::kept(node, keep)?);
        }
        match nodes.pop() {
            Some(root) if from.left() == 0 => Ok(root),
            _ => Err(wrong("it does not end where its nodes do")),
        }
    }
}

impl Node {
    /// Its kind, its children and its own numbers.
    fn pack<'a>(&'a self, children: &[u64], out: &mut Packer<'a>) -> Result<()> {
        let mut begin = |kind: u64| {
            out.word(kind);
            children.iter().for_each(|&child| out.word(child));
        };
        match self {
            Node::Sphere(_) | Node::Shape(_) => {
                if let Some(shape) = self.shape() {
                    shape.pack(out);
                }
            }
            Node::Surface(surface) => {
                begin(kinds::SURFACE);
                surface.pack(out);
            }
            Node::Function { .. } => {
                return Err(Error::unsupported(
                    "g: a function of the user's (emb_geom_callback) takes part, which cannot be packed",
                ));
            }
            Node::Union(parts) | Node::Intersection(parts) => {
                out.word(if parts.is_turned() { kinds::INTERSECTION } else { kinds::UNION });
                parts.pack(children, out);
            }
            Node::Smooth(smooth) => {
                out.word(kinds::SMOOTH);
                match smooth.blend() {
                    Blend::Smooth(width) => [1, width.to_bits()].into_iter().for_each(|word| out.word(word)),
                    Blend::Exponential(width) => [2, width.to_bits()].into_iter().for_each(|word| out.word(word)),
                    Blend::Custom(_) => {
                        return Err(Error::unsupported(
                            "g: a blend of the user's (emb_blend.function) takes part, which cannot be packed",
                        ));
                    }
                }
                smooth.parts().pack(children, out);
            }
            Node::Repeat(repeat) => {
                begin(kinds::REPEAT);
                repeat.pack(out);
            }
            Node::Complement(_) => begin(kinds::COMPLEMENT),
            Node::Translate(_, shift) => {
                begin(kinds::TRANSLATE);
                out.vector(*shift);
            }
            Node::Place(_, placement) => {
                begin(kinds::PLACE);
                placement.pack(out);
            }
            Node::Map(_, map) => {
                begin(kinds::MAP);
                map.pack(out);
            }
            Node::Level(_, level) => {
                begin(kinds::LEVEL);
                let (way, number) = match level {
                    Level::Offset(d) => (0, d),
                    Level::Annular(d) => (1, d),
                    Level::Divided(c) => (2, c),
                };
                out.word(way);
                out.number(*number);
            }
            Node::Stencil(_, stencil) => {
                begin(kinds::STENCIL);
                stencil.pack(out);
            }
            Node::Part(_, label) => {
                begin(kinds::PART);
                out.word(u64::from(label.cast_unsigned()));
            }
        }
        Ok(())
    }
}

impl Map {
    fn pack(&self, out: &mut Packer) {
        match self {
            Map::Linear(linear) => {
                out.word(0);
                linear.pack(out);
            }
            Map::Elongate(e) => {
                out.word(1);
                out.vector(*e);
            }
            Map::Twist(twist) => {
                out.word(2);
                twist.pack(out);
            }
        }
    }

    fn unpack(from: &mut Unpacker) -> Result<Map> {
        match from.index(3, "map")? {
            0 => Linear::unpack(from).map(Map::Linear),
            1 => {
                let e = from.vector()?;
                // The sides of a box that is clamped to.
                if e.min_element() >= 0.0 { Ok(Map::Elongate(e)) } else { Err(wrong("an extent is below 0")) }
            }
            _ => Twist::unpack(from).map(Map::Twist),
        }
    }
}

/// The next node; the ones before it are there.
fn unpack_node(from: &mut Unpacker, nodes: &[Geometry]) -> Result<Node> {
    let kind = from.word()?;
    let child = |from: &mut Unpacker| from.index(nodes.len(), "node").map(|k| nodes[k].clone());
    Ok(match kind {
        kinds::SURFACE => Node::Surface(Box::new(Surface::unpack(from)?)),
        kinds::UNION => Node::Union(Parts::unpack(from, nodes, false)?),
        kinds::INTERSECTION => Node::Intersection(Parts::unpack(from, nodes, true)?),
        kinds::SMOOTH => {
            let is_exponential = from.index(3, "blend")? == 2;
            let width = from.finite()?;
            let blend = if is_exponential { Blend::Exponential(width) } else { Blend::Smooth(width) };
            blend.check()?;
            Node::Smooth(Smooth::new(Parts::unpack(from, nodes, false)?, blend))
        }
        kinds::REPEAT => return repeat(child(from)?, from),
        kinds::COMPLEMENT => Node::Complement(child(from)?),
        kinds::TRANSLATE => Node::Translate(child(from)?, from.vector()?),
        kinds::PLACE => Node::Place(child(from)?, Placement::unpack(from)?),
        kinds::MAP => Node::Map(child(from)?, Map::unpack(from)?),
        kinds::LEVEL => {
            let (child, way, number) = (child(from)?, from.index(3, "level")?, from.finite()?);
            let level = [Level::Offset(number), Level::Annular(number), Level::Divided(number)][way];
            if way > 0 && number <= 0.0 {
                return Err(wrong("a level is not above 0"));
            }
            Node::Level(child, level)
        }
        kinds::STENCIL => Node::Stencil(child(from)?, Stencil::unpack(from)?),
        kinds::PART => Node::Part(child(from)?, (from.index(1 << 32, "label")? as u32).cast_signed()),
        _ => return shape::unpack(kind, from),
    })
}

/// Checked as when it was made.
fn repeat(child: Geometry, from: &mut Unpacker) -> Result<Node> {
    let period = from.numbers()?;
    let mut counts = [0; 3];
    for count in &mut counts {
        *count = from.index(1 << 31, "count")? as i32;
    }
    child.repeat_node(period, counts).map(Node::Repeat)
}
