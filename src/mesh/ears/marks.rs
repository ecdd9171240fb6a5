// SPDX-License-Identifier: MIT OR Apache-2.0
//! A set of numbers that finds the next one: a bit each, a bit for each word of bits, and so on.

use crate::error::{Result, filled, try_with_capacity};

/// The set; every level has a bit for each word of the one before.
pub(super) struct Marks {
    levels: Vec<Vec<u64>>,
}

impl Marks {
    /// Of numbers below `count`, which is not 0: all of them, or none.
    pub(super) fn new(count: usize, all: bool) -> Result<Marks> {
        let mut levels = try_with_capacity("levels", 6)?;
        let mut bits = count;
        loop {
            let words = bits.div_ceil(64);
            let mut level = filled("marks", words, if all { u64::MAX } else { 0 })?;
            if all && !bits.is_multiple_of(64) {
                level[words - 1] = (1 << (bits % 64)) - 1;
            }
            levels.push(level);
            bits = words;
            if words == 1 {
                return Ok(Marks { levels });
            }
        }
    }

    pub(super) fn set(&mut self, k: u32) {
        let mut k = k as usize;
        for level in &mut self.levels {
            level[k / 64] |= 1 << (k % 64);
            k /= 64;
        }
    }

    pub(super) fn clear(&mut self, k: u32) {
        let mut k = k as usize;
        for level in &mut self.levels {
            level[k / 64] &= !(1 << (k % 64));
            if level[k / 64] != 0 {
                return;
            }
            k /= 64;
        }
    }

    /// The lowest number from `at` on, or else the lowest of all.
    pub(super) fn next(&self, at: u32) -> Option<u32> {
        self.from(at as usize).or_else(|| self.from(0)).map(|k| k as u32)
    }

    fn from(&self, at: usize) -> Option<usize> {
        let mut at = at;
        for (height, level) in self.levels.iter().enumerate() {
            let word = level.get(at / 64)? & (u64::MAX << (at % 64));
            if word != 0 {
                let top = at / 64 * 64 + word.trailing_zeros() as usize;
                let down = |k: usize, level: &Vec<u64>| k * 64 + level[k].trailing_zeros() as usize;
                return Some(self.levels[..height].iter().rev().fold(top, down));
            }
            at = at / 64 + 1;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_number_is_that_of_a_plain_search() {
        for count in [1u32, 63, 64, 65, 4096, 4097, 300_000] {
            let mut marks = Marks::new(count as usize, true).unwrap();
            assert_eq!((marks.next(count - 1), marks.next(count)), (Some(count - 1), Some(0)));
            (0..count).filter(|k| k % 997 != 3).for_each(|k| marks.clear(k));
            let numbers: Vec<u32> = (0..count).filter(|k| k % 997 == 3).collect();
            for at in (0..count).step_by(61) {
                let wanted = numbers.iter().find(|k| **k >= at).or(numbers.first()).copied();
                assert_eq!(marks.next(at), wanted);
            }
            numbers.iter().for_each(|k| marks.clear(*k));
            assert_eq!(marks.next(0), None);
            marks.set(count / 2);
            assert_eq!((marks.next(0), marks.next(count - 1)), (Some(count / 2), Some(count / 2)));
            assert_eq!(Marks::new(count as usize, false).unwrap().next(0), None);
        }
    }
}
