// SPDX-License-Identifier: MIT OR Apache-2.0
//! One axis of a tensor grid of samples: which cell a coordinate is in, exactly and monotonically.

use crate::error::{Error, Result, try_with_capacity};
use crate::store::{Array, Packer, Unpacker};

/// At least two strictly rising finite coordinates.
pub(super) struct Axis {
    nodes: Array<f64>,
    /// Cells per unit of length where the nodes are near enough to evenly spaced; else 0.
    density: f64,
    /// Whether the caller's axis falls, so that samples along it are to be read backwards.
    pub(super) falling: bool,
}

/// Where a coordinate is along an axis.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// The cell, between the nodes `cell` and `cell + 1`.
    pub(super) cell: usize,
    /// From 0 at the first of them to 1 at the second; monotone in the coordinate.
    pub(super) along: f64,
    /// Whether the coordinate is on the axis, and not beyond an end.
    pub(super) inside: bool,
}

impl Axis {
    /// Of strictly rising or strictly falling coordinates; `name` is the argument's.
    pub(super) fn new(name: &str, given: &[f64]) -> Result<Axis> {
        if given.len() < 2 {
            return Err(Error::invalid(format!("{name}: {} coordinates, at least 2 needed", given.len())));
        }
        if let Some(i) = given.iter().position(|c| !c.is_finite()) {
            return Err(Error::invalid(format!("{name}[{i}]: {} is not finite", given[i])));
        }
        let falling = given[1] < given[0];
        let turn = given.windows(2).position(|w| if falling { w[1] >= w[0] } else { w[1] <= w[0] });
        if let Some(i) = turn {
            let (a, b) = (given[i], given[i + 1]);
            return Err(Error::invalid(format!("{name}[{}]: {b} after {a} is not strictly monotone", i + 1)));
        }
        let mut nodes = try_with_capacity("coordinates", given.len())?;
        nodes.extend_from_slice(given);
        if falling {
            nodes.reverse();
        }
        let mut axis = Axis { nodes: nodes.into(), density: 0.0, falling };
        // Differences of coordinates must not overflow anywhere.
        if !(axis.hi() - axis.lo()).is_finite() {
            return Err(Error::invalid(format!("{name}: {} to {} is too long", axis.lo(), axis.hi())));
        }
        axis.density = axis.even_density();
        Ok(axis)
    }

    /// The array that is packed: rising.
    pub(super) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.nodes);
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Axis> {
        Axis::new("axis", &from.array("axis")?)
    }

    /// Cells per unit of length where every node is within a quarter of a cell of its even place.
    fn even_density(&self) -> f64 {
        let density = self.cells() as f64 / (self.hi() - self.lo());
        let near = |(i, x): (usize, &f64)| ((x - self.lo()) * density - i as f64).abs() < 0.25;
        if density.is_finite() && self.nodes.iter().enumerate().all(near) { density } else { 0.0 }
    }

    /// How many nodes.
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// How many cells.
    pub(super) fn cells(&self) -> usize {
        self.nodes.len() - 1
    }

    /// The least coordinate.
    pub(super) fn lo(&self) -> f64 {
        self.nodes[0]
    }

    /// The greatest coordinate.
    pub(super) fn hi(&self) -> f64 {
        self.nodes[self.nodes.len() - 1]
    }

    /// All coordinates, rising.
    pub(super) fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Length of a cell: > 0.
    pub(super) fn length(&self, cell: usize) -> f64 {
        self.nodes[cell + 1] - self.nodes[cell]
    }

    /// Where `x` is; beyond an end, that end.
    pub(super) fn place(&self, x: f64) -> Place {
        let last = self.cells() - 1;
        if x <= self.lo() {
            return Place { cell: 0, along: 0.0, inside: x == self.lo() };
        }
        if x >= self.hi() {
            return Place { cell: last, along: 1.0, inside: x == self.hi() };
        }
        let cell = if self.density > 0.0 {
            // The guess is off by at most one cell; the nodes themselves decide.
            let guess = (((x - self.lo()) * self.density) as usize).min(last);
            if x < self.nodes[guess] {
                guess.saturating_sub(1)
            } else if x >= self.nodes[guess + 1] {
                (guess + 1).min(last)
            } else {
                guess
            }
        } else {
            self.nodes.partition_point(|&node| node <= x).saturating_sub(1).min(last)
        };
        Place { cell, along: (x - self.nodes[cell]) / self.length(cell), inside: true }
    }

    /// Memory on the heap.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
    }

    /// The index along the caller's axis of node `i`.
    pub(super) fn given_index(&self, i: usize) -> usize {
        if self.falling { self.cells() - i } else { i }
    }
}

/// Between `a` at 0 and `b` at 1: these very numbers at the ends, and within three roundings of the greater
/// magnitude of what lies between.
pub(super) fn between(a: f64, b: f64, along: f64) -> f64 {
    a * (1.0 - along) + b * along
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_in_its_cell_and_monotone() {
        let even: Vec<f64> = (0..101).map(|i| 0.1 * f64::from(i) - 3.0).collect();
        let uneven: Vec<f64> = (0..50).map(|i| f64::from(i * i) * 1e-6).collect();
        for nodes in [even, uneven, vec![-1e300, 1e300 / 4.0], vec![0.0, 5e-324]] {
            let axis = Axis::new("x", &nodes).unwrap();
            let length = axis.hi() - axis.lo();
            let mut before = (0, -1.0);
            let mut samples: Vec<f64> = (0..3000).map(|i| axis.lo() + length * (f64::from(i) / 2999.0)).collect();
            samples.extend(nodes.iter().flat_map(|x| [x.next_down(), *x, x.next_up()]));
            samples.sort_by(f64::total_cmp);
            for x in samples {
                let place = axis.place(x);
                assert!((0.0..=1.0).contains(&place.along), "{x}");
                assert!((place.cell, place.along) >= before, "{x}");
                before = (place.cell, place.along);
                if place.inside {
                    assert!(nodes[place.cell] <= x && x <= nodes[place.cell + 1], "{x}");
                }
            }
        }
    }

    #[test]
    fn unfit_axes_are_named() {
        for (axis, message) in [
            (vec![1.0], "x: 1 coordinates, at least 2 needed"),
            (vec![1.0, f64::NAN], "x[1]: NaN is not finite"),
            (vec![1.0, 2.0, 2.0], "x[2]: 2 after 2 is not strictly monotone"),
            (vec![3.0, 2.0, 2.5], "x[2]: 2.5 after 2 is not strictly monotone"),
        ] {
            assert_eq!(Axis::new("x", &axis).err().unwrap().message(), message);
        }
        assert!(Axis::new("x", &[-1.7e308, 1.7e308]).is_err());
    }
}
