// SPDX-License-Identifier: MIT OR Apache-2.0
//! Open surfaces whose vertices move, and which go through a block: the same as made anew.

use crate::bodies::with_holes;
use crate::common::{Soup, random::Random};
use crate::diagonal;
use embound::Status;
use embound::geometry::{Geometry, RefitCheck, SdfOptions, SignMethod, UnpackCheck};
use embound::mesh::{MeshOptions, Orient};
use embound::parallel::Run;

fn options() -> MeshOptions {
    MeshOptions { orient: Orient::Keep, weld_tolerance: -1.0, ..MeshOptions::default() }
}

fn kept(soup: &Soup, sign: SignMethod) -> Geometry {
    let mesh = soup.mesh_with(&options());
    Geometry::from_mesh(&mesh, &SdfOptions { sign, axis: 1, ..SdfOptions::default() }, &Run::SERIAL).unwrap()
}

#[test]
fn moved_and_packed_surfaces_are_the_same_as_made_anew() {
    let mut random = Random(91);
    for (name, body) in with_holes().into_iter().filter(|(name, _)| !["soup", "ball and bowl"].contains(name)) {
        // Vertices that no triangle uses are none of the mesh.
        let mesh = body.mesh_with(&options());
        let vertices = mesh.vertices().iter().map(|v| v.to_array()).collect();
        let body = Soup { vertices, triangles: mesh.triangles().iter().map(|t| t.vertices).collect() };
        let moved = body.map(|[x, y, z]| [1.3 * x + 0.2 * y * y, y + 0.1 * x * z, 0.8 * z]);
        for sign in [SignMethod::Winding, SignMethod::Ray, SignMethod::Axis] {
            let (g, anew) = (kept(&body, sign), kept(&moved, sign));
            let refit = g.refit(&moved.xyz(), RefitCheck::Check, &Run::SERIAL).unwrap();
            let packed = refit.pack().unwrap();
            let back = Geometry::unpack(&packed, UnpackCheck::Check, &Run::SERIAL).unwrap();
            assert_eq!(refit.fingerprint(), anew.fingerprint(), "{name} {sign:?}");
            assert_ne!(refit.fingerprint(), g.fingerprint());
            assert_eq!((back.fingerprint(), back.sign_text()), (anew.fingerprint(), anew.sign_text()));
            let (lo, hi) = moved.bounds();
            for _ in 0..300 {
                let p = random.point(lo.map(|c| c - 0.1), hi.map(|c| c + 0.1)).into();
                let all = [&refit, &back, &anew].map(|g| g.value(p).to_bits());
                assert!(all[0] == all[2] && all[1] == all[2], "{name} {sign:?} {p}");
            }
        }
        // A reflection turns what has an inside over.
        if diagonal(&body) > 0.0 && ["ball without many", "deep bowl", "torus"].contains(&name) {
            let mirrored: Vec<f64> = body.vertices.iter().flat_map(|v| [-v[0], v[1], v[2]]).collect();
            let refused = kept(&body, SignMethod::Winding).refit(&mirrored, RefitCheck::Check, &Run::SERIAL);
            assert_eq!(refused.err().expect("refused").status(), Status::Topology);
            assert!(kept(&body, SignMethod::Axis).refit(&mirrored, RefitCheck::Check, &Run::SERIAL).is_ok());
        }
    }
}
