// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every kind of node comes back as it was.

use super::same::assert_same;
use super::scenes::{mesh, meshes, small};
use crate::common::bodies;
use embound::Status;
use embound::geometry::{
    Accelerator, Blend, BlendFunction, CustomBlend, Function, FunctionOptions, Geometry, RefitCheck, UnpackCheck,
};
use embound::math::Vec3;
use embound::parallel::{Pool, Run};
use std::sync::Arc;

fn unpacked(bytes: &[u8], check: UnpackCheck) -> Geometry {
    Geometry::unpack(bytes, check, &Run::SERIAL).expect("it was packed")
}

#[test]
fn what_was_packed_answers_alike_and_packs_alike() {
    for (name, g) in small().into_iter().chain(meshes()) {
        let bytes = g.pack().unwrap_or_else(|e| panic!("{name}: {e}"));
        let back = Geometry::unpack(&bytes, UnpackCheck::Check, &Run::SERIAL).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_same(name, &g, &back);
        assert!(back.pack().expect("packed") == bytes, "{name}: other bytes");
        let trusted = unpacked(&bytes, UnpackCheck::Trust);
        assert!(trusted.pack().expect("packed") == bytes, "{name}: other bytes");
        let mut streamed = Vec::new();
        let pool = Pool::new(3, || ()).expect("a pool");
        g.pack_to(&mut streamed, &Run { pool: Some(&pool), progress: None }).expect("packed");
        assert!(streamed == bytes, "{name}: a stream is another block");
        assert!(bytes.len().is_multiple_of(64), "{name}");
    }
}

#[test]
fn a_body_that_is_used_often_stands_there_once() {
    let body = mesh(Accelerator::Auto);
    let one = body.pack().expect("packed").len();
    let copies: Vec<Geometry> = (0..1000).map(|k| body.translate([f64::from(k), 0.0, 0.5]).expect("a copy")).collect();
    let all = Geometry::union(&copies).expect("a union");
    let bytes = all.pack().expect("packed");
    // Of each copy a few words, and a place in the hierarchy.
    assert!(bytes.len() < one + 1000 * 200, "{} {one}", bytes.len());
    let back = unpacked(&bytes, UnpackCheck::Check);
    assert_eq!(back.properties().bytes, all.properties().bytes, "it is shared again");
    let at = Vec3::new(17.3, 0.4, 0.6);
    assert_eq!(back.value(at).to_bits(), all.value(at).to_bits());
}

#[test]
fn an_unpacked_mesh_can_be_moved_placed_and_combined() {
    let soup = bodies::icosphere(2);
    let xyz: Vec<f64> = soup.xyz().iter().enumerate().map(|(k, x)| x * (1.0 + 0.1 * (k % 3) as f64)).collect();
    for (name, g) in meshes() {
        let back = unpacked(&g.pack().expect("packed"), UnpackCheck::Check);
        let turned = |g: &Geometry| {
            let placed = g.rotate([1.0, 2.0, 0.5], 33.0, [0.1; 3])?.scale(0.7)?;
            Geometry::union(&[placed, g.offset(-0.1)?])?.difference(&Geometry::sphere([0.3; 3], 0.2)?)
        };
        assert_same(name, &turned(&g).expect("made"), &turned(&back).expect("made"));
    }
    for check in [RefitCheck::Check, RefitCheck::Trust] {
        let g = Geometry::from_mesh(&soup.mesh(), &Default::default(), &Run::SERIAL).expect("a geometry");
        let back = unpacked(&g.pack().expect("packed"), UnpackCheck::Trust);
        let moved = back.refit(&xyz, check, &Run::SERIAL).expect("moved");
        assert_same("refit", &g.refit(&xyz, check, &Run::SERIAL).expect("moved"), &moved);
        assert_same("what was refit", &g, &back);
        let again = unpacked(&moved.pack().expect("packed"), UnpackCheck::Check);
        assert_same("packed again", &moved, &again);
    }
}

struct Users;

impl Function for Users {
    fn value(&self, p: Vec3) -> f64 {
        p.x
    }
}

impl BlendFunction for Users {
    fn blend(&self, a: f64, _: f64) -> (f64, f64, f64) {
        (a, 1.0, 0.0)
    }
}

#[test]
fn functions_of_the_users_cannot_be_packed() {
    let f = Geometry::function(Arc::new(Users), &FunctionOptions::default()).expect("a function");
    let ball = Geometry::sphere([0.0; 3], 1.0).expect("a ball");
    let blend = CustomBlend { function: Arc::new(Users), support: 0.1, depth: 0.0, lipschitz: 1.0, thread_safe: true };
    let blended = Geometry::smooth_union(&[ball.clone(), ball.clone()], &Blend::Custom(blend)).expect("a blend");
    for (g, named) in
        [(f.clone(), "emb_geom_callback"), (ball.difference(&f).unwrap(), "emb_geom_callback"), (blended, "emb_blend")]
    {
        let error = g.pack().expect_err("refused");
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().contains(named), "{error}");
    }
}

#[test]
fn labels_and_depth_come_back() {
    let mut g = Geometry::sphere([0.0; 3], 1.0).expect("a ball");
    for k in 0..998 {
        g = if k % 2 == 0 { g.part(k).expect("a label") } else { g.complement().expect("a complement") };
    }
    let back = unpacked(&g.pack().expect("packed"), UnpackCheck::Check);
    let at = Vec3::new(0.2, 0.3, 0.4);
    assert_eq!(back.value(at), g.value(at));
    assert_eq!(back.closest(at).part, g.closest(at).part);
}
