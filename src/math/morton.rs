// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places along a curve that fills space (Morton 1966).

/// Bits of a place along an axis.
pub const MORTON_BITS: u32 = 10;

/// The bits of three places below 2^10, by turns, the first axis before the others.
pub fn morton(place: [u32; 3]) -> u32 {
    let [x, y, z] = place.map(spread);
    x << 2 | y << 1 | z
}

/// Two zeros between the bits of a number of [`MORTON_BITS`].
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00FF;
    let x = (x | x << 8) & 0x0300_F00F;
    let x = (x | x << 4) & 0x030C_30C3;
    (x | x << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_come_by_turns() {
        assert_eq!(morton([0, 0, 0]), 0);
        assert_eq!([morton([1, 0, 0]), morton([0, 1, 0]), morton([0, 0, 1])], [4, 2, 1]);
        assert_eq!(morton([1023; 3]), (1 << (3 * MORTON_BITS)) - 1);
        for bit in 0..MORTON_BITS {
            assert_eq!(morton([0, 1 << bit, 0]), 2 << (3 * bit));
        }
    }
}
