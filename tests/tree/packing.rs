// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random trees come back out of blocks as they were, or name the function that keeps them from being packed.

use super::trees;
use embound::Status;
use embound::geometry::{Geometry, UnpackCheck};
use embound::math::Aabb;
use embound::parallel::Run;

fn assert_same(k: u64, g: &Geometry, back: &Geometry, at: &[embound::math::Vec3]) {
    assert_eq!((g.fingerprint(), g.bounds()), (back.fingerprint(), back.bounds()), "{k}");
    assert_eq!(format!("{:?}", g.properties()), format!("{:?}", back.properties()), "{k}");
    for pair in at.windows(2) {
        let p = pair[0];
        assert_eq!(g.value(p).to_bits(), back.value(p).to_bits(), "{k} {p}");
        assert_eq!(format!("{:?}", g.closest(p)), format!("{:?}", back.closest(p)), "{k} {p}");
        let b = Aabb::of([p, p + (pair[1] - p) * 0.2]);
        assert_eq!(g.classify(b), back.classify(b), "{k} {b:?}");
    }
}

#[test]
fn trees_come_back_as_they_were() {
    let (mut packed, mut refused) = (0, 0);
    trees::each(77, 400, |k, g, random| {
        let bytes = match g.pack() {
            Ok(bytes) => bytes,
            Err(error) => {
                assert!(g.has_functions() && error.status() == Status::Unsupported, "{k}: {error}");
                refused += 1;
                return;
            }
        };
        let at = trees::places(g, 12, random);
        let back = Geometry::unpack(&bytes, UnpackCheck::Check, &Run::SERIAL).unwrap_or_else(|e| panic!("{k}: {e}"));
        assert_same(k, g, &back, &at);
        assert!(back.pack().expect("packed") == bytes, "{k}");
        // What is cut out of a tree is a tree.
        let b = Aabb::of([at[0], at[1]]);
        let part = g.simplified(b).expect("a finite box");
        let again = Geometry::unpack(&part.pack().expect("packed"), UnpackCheck::Check, &Run::SERIAL)
            .unwrap_or_else(|e| panic!("{k}: {e}"));
        let inside = [b.center(), b.lo, b.hi, b.center().lerp(b.hi, 0.3)];
        assert_same(k, &part, &again, &inside);
        packed += 1;
    });
    assert!(packed > 150 && refused > 50, "{packed} {refused}");
}
