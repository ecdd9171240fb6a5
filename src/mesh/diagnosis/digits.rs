// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers as a reader of a report expects them.

use crate::math::Vec3;

/// A number with so many significant digits, at least one, without zeros at the end; in scientific notation
/// where it is tiny or huge.
pub(super) fn significant(x: f64, digits: usize) -> String {
    let scientific = format!("{:.*e}", digits - 1, x);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let Ok(exponent) = exponent.parse::<i32>() else { return scientific };
    if !(-5..12).contains(&exponent) {
        return format!("{}e{exponent}", without_zeros(mantissa));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    without_zeros(&format!("{x:.decimals$}")).to_owned()
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// A position.
pub(super) fn point(p: Vec3) -> String {
    let [x, y, z] = p.to_array().map(|c| significant(c, 6));
    format!("({x}, {y}, {z})")
}

/// A number of things: "1 face", "2 faces".
pub(super) fn count(n: usize, what: &str) -> String {
    let plural = match what.strip_suffix("ex") {
        _ if n == 1 => what.to_owned(),
        Some(stem) => format!("{stem}ices"),
        None => format!("{what}s"),
    };
    format!("{n} {plural}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        for (x, text) in [
            (-0.00026341828123, "-0.00026341828"),
            (53.567446, "53.567446"),
            (0.0, "0"),
            (1.0, "1"),
            (123456789.6, "123456790"),
            (1.5e-7, "1.5e-7"),
            (2.5e17, "2.5e17"),
            (9.99999999e11, "1e12"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(significant(x, 8), text);
        }
    }

    #[test]
    fn things_are_counted_in_english() {
        assert_eq!((count(1, "vertex"), count(2, "vertex")), ("1 vertex".into(), "2 vertices".into()));
        assert_eq!((count(0, "edge"), count(1, "edge")), ("0 edges".into(), "1 edge".into()));
    }
}
