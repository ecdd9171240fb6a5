// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact sums of products of doubles, for the signs of predicates that rounding leaves open (Shewchuk 1997).

use super::double_double::{two_product, two_sum};

/// `a - b` exactly, as a sum of two.
#[inline]
pub fn difference(a: f64, b: f64) -> [f64; 2] {
    let (hi, lo) = two_sum(a, -b);
    [hi, lo]
}

/// `a * b` exactly, as a sum of two, where nothing over- or underflows.
#[inline]
pub fn product(a: f64, b: f64) -> [f64; 2] {
    let (hi, lo) = two_product(a, b);
    [hi, lo]
}

/// An exact sum of up to `N` doubles: as parts that do not overlap, the least first, none of them zero.
pub struct Expansion<const N: usize> {
    part: [f64; N],
    length: usize,
}

impl<const N: usize> Expansion<N> {
    /// Nothing.
    pub const ZERO: Expansion<N> = Expansion { part: [0.0; N], length: 0 };

    /// Adds a number.
    pub fn add(&mut self, number: f64) {
        let (mut sum, mut kept) = (number, 0);
        for k in 0..self.length {
            let (above, rest) = two_sum(sum, self.part[k]);
            if rest != 0.0 {
                self.part[kept] = rest;
                kept += 1;
            }
            sum = above;
        }
        if sum != 0.0 {
            self.part[kept] = sum;
            kept += 1;
        }
        self.length = kept;
    }

    /// Adds the product of three numbers.
    pub fn add_product(&mut self, a: f64, b: f64, c: f64) {
        if a == 0.0 || b == 0.0 || c == 0.0 {
            return;
        }
        for of_two in product(a, b).into_iter().filter(|p| *p != 0.0) {
            product(of_two, c).into_iter().filter(|p| *p != 0.0).for_each(|p| self.add(p));
        }
    }

    /// -1, 0 or +1.
    pub fn sign(&self) -> i32 {
        match self.length {
            0 => 0,
            length if self.part[length - 1] > 0.0 => 1,
            _ => -1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_that_rounding_loses_keep_their_sign() {
        let mut sum = Expansion::<16>::ZERO;
        for x in [1e30, 1.0, -1e30, 1e-30, -1.0] {
            sum.add(x);
        }
        assert_eq!(sum.sign(), 1);
        sum.add(-1e-30);
        assert_eq!(sum.sign(), 0);
        sum.add_product(0.1, 0.1, 10.0);
        sum.add_product(-0.1, 1.0, 1.0);
        // 0.1 is a little more than a tenth.
        assert_eq!(sum.sign(), 1);
    }
}
