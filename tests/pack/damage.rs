// SPDX-License-Identifier: MIT OR Apache-2.0
//! Damage is an error: any byte, any length, anything else.

use super::scenes::{crowd, meshes, small};
use crate::common::random::Random;
use embound::Status;
use embound::geometry::{Geometry, UnpackCheck};
use embound::parallel::Run;

fn status(bytes: &[u8], check: UnpackCheck) -> Option<Status> {
    Geometry::unpack(bytes, check, &Run::SERIAL).err().map(|error| error.status())
}

fn is_refused(bytes: &[u8], check: UnpackCheck) -> bool {
    matches!(status(bytes, check), Some(Status::Parse | Status::Unsupported))
}

/// Blocks small enough for all of their bytes.
fn blocks() -> Vec<(String, Vec<u8>)> {
    let trees = small().into_iter().chain([("crowd", crowd())]);
    let meshes = meshes().into_iter().filter(|(name, _)| ["tetrahedron", "two triangles", "rays"].contains(name));
    trees.chain(meshes).map(|(name, g)| (name.to_owned(), g.pack().expect("packed"))).collect()
}

#[test]
fn every_byte_counts() {
    let mut count = 0;
    for (name, mut bytes) in blocks() {
        for k in 0..bytes.len() {
            for flip in [0xFF, 1 << (k % 8)] {
                bytes[k] ^= flip;
                assert!(is_refused(&bytes, UnpackCheck::Check), "{name}: byte {k} of {}", bytes.len());
                bytes[k] ^= flip;
                count += 1;
            }
        }
        assert_eq!(status(&bytes, UnpackCheck::Check), None, "{name}");
    }
    assert!(count > 140_000, "{count}");
}

#[test]
fn every_length_counts() {
    for (name, bytes) in blocks() {
        for size in 0..bytes.len() {
            for check in [UnpackCheck::Check, UnpackCheck::Trust] {
                assert!(is_refused(&bytes[..size], check), "{name}: {size} of {}", bytes.len());
            }
        }
        for more in [1, 63, 64, 4096] {
            let longer = [&bytes[..], &vec![0; more]].concat();
            assert!(is_refused(&longer, UnpackCheck::Check), "{name}: {more} more");
        }
    }
}

#[test]
fn bytes_of_large_blocks_count_too() {
    let mut random = Random(5);
    for (name, g) in meshes() {
        let mut bytes = g.pack().expect("packed");
        for _ in 0..300 {
            let (k, bit) = (random.below(bytes.len()), random.below(8));
            bytes[k] ^= 1 << bit;
            assert!(is_refused(&bytes, UnpackCheck::Check), "{name}: bit {bit} of byte {k}");
            bytes[k] ^= 1 << bit;
            let size = random.below(bytes.len());
            assert!(is_refused(&bytes[..size], UnpackCheck::Check), "{name}: {size}");
        }
    }
}

#[test]
fn trust_looks_at_what_is_in_front() {
    for (name, mut bytes) in blocks() {
        let words = |at: usize| u64::from_ne_bytes(bytes[8 * at..8 * at + 8].try_into().expect("a word")) as usize;
        let front = 128 + 24 * words(3) + 8 * words(4);
        for k in 0..front {
            bytes[k] ^= 0x10;
            assert!(is_refused(&bytes, UnpackCheck::Trust), "{name}: byte {k} of {front}");
            bytes[k] ^= 0x10;
        }
        // Beyond, it looks at nothing, and nothing crashes.
        for k in front..bytes.len() {
            bytes[k] ^= 0x10;
            let _ = status(&bytes, UnpackCheck::Trust);
            bytes[k] ^= 0x10;
        }
    }
}

#[test]
fn other_bytes_are_no_block() {
    let mut random = Random(9);
    assert!(is_refused(&[], UnpackCheck::Check));
    for size in [1, 7, 64, 127, 128, 192, 4096] {
        let noise: Vec<u8> = (0..size).map(|_| random.bits() as u8).collect();
        assert!(is_refused(&noise, UnpackCheck::Check) && is_refused(&vec![0; size], UnpackCheck::Trust), "{size}");
    }
    assert_eq!(status(b"solid a file of another kind", UnpackCheck::Check), Some(Status::Parse));
}
