// SPDX-License-Identifier: MIT OR Apache-2.0
//! What AUTO takes where a mesh is open, and what it refuses.

use crate::bodies::{bowl, pipe, terrain};
use crate::common::{Soup, bodies};
use crate::geometry;
use embound::Status;
use embound::geometry::{Geometry, SdfOptions, SignMethod};
use embound::parallel::Run;

fn refused(soup: &Soup, sign: SignMethod) -> String {
    let options = SdfOptions { sign, ..SdfOptions::default() };
    let error = Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).err().expect("refused");
    assert_eq!(error.status(), Status::Topology);
    error.message().to_owned()
}

#[test]
fn small_holes_are_closed_and_said_to_be() {
    let ball = bodies::icosphere(3);
    for (body, sign) in [
        (ball.clone(), SignMethod::Pseudonormal),
        (ball.without(|t| t == 3), SignMethod::Winding),
        (ball.without(|t| t % 97 == 3), SignMethod::Winding),
        (ball.flipped_where(|t| t % 2 == 0), SignMethod::Pseudonormal),
        (ball.duplicated(), SignMethod::Pseudonormal),
        (ball.duplicated().without(|t| t == 3), SignMethod::Pseudonormal),
        (bodies::overlapping_spheres(3), SignMethod::Ray),
        (bodies::overlapping_spheres(3).without(|t| t == 3), SignMethod::Winding),
        (ball.and(&pipe(12, 1, 1e-3).scaled(1e-2)), SignMethod::Winding),
    ] {
        for scale in [1e-6, 1.0, 1e6] {
            let g = geometry(&body.scaled(scale), SignMethod::Auto);
            assert_eq!(g.properties().sign_method, sign);
            assert_eq!(g.properties().lipschitz.is_finite(), sign != SignMethod::Winding);
        }
    }
}

#[test]
fn more_than_small_holes_are_named() {
    for (body, words) in [
        (pipe(24, 40, 6.0), vec!["2 of 2 loops: 24 edges around (", "100% of the mesh across"]),
        (bowl(3, 0.0), vec!["1 of 1 loops: ", "EMB_OPEN_CAP"]),
        (terrain(10, 0.0), vec!["40 edges around (", "EMB_SIGN_AXIS"]),
        (bodies::sheet(5), vec!["1 of 1 loops: 20 edges around (2.5", "EMB_SIGN_NONE"]),
        (bodies::unit_cube().without(|t| t == 0), vec!["3 edges", "a cap of "]),
        (bodies::moebius_strip(30), vec!["boundary edges"]),
        (bodies::lattice_soup(40), vec!["; ...", "take sign EMB_SIGN_WINDING"]),
    ] {
        let message = refused(&body, SignMethod::Auto);
        for words in words {
            assert!(message.contains(words), "{message}");
        }
        assert!(!message.contains('\n'));
        assert!(refused(&body, SignMethod::Pseudonormal).contains("closed surface"));
    }
}
