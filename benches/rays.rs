// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays on one thread: what the first face, and counting all faces, along one cost, beside Embree where it is installed
//! (Debian's libembree-dev), which is asked about the same rays in the same run and whose answers are held against
//! embound's:
//!
//!     cargo bench --bench rays -- [--count N] [mesh ...]     (spheres of 20,480 and 327,680 triangles by default)
//!
//! And whether rays ever come out of a closed mesh more or less often than they go in:
//!
//!     cargo bench --bench rays -- parity [--count N] [mesh ...]
//!
//! asks about so many random rays, a million by default, and as many aimed at edges and corners, and fails where one is
//! wrong.

#[path = "../tests/common/mod.rs"]
mod common;

use common::random::Random;
use common::rays::{Asked, aimed, length, minus, outside};
use common::{Soup, bodies};
use embound::geometry::{Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use embound::query::{self, RayHit};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Instant;
use std::{env, fs};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Rounds, of which the fastest counts.
const ROUNDS: usize = 3;

/// By how much Embree, in f32, may be off, in diagonals.
const TOLERANCE: f64 = 1e-5;

fn main() -> Outcome<()> {
    let (mut count, mut is_parity, mut files) = (None, false, Vec::new());
    let mut arguments = env::args().skip(1).filter(|a| a != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--count" => count = Some(arguments.next().ok_or("--count: no number")?.parse()?),
            "parity" => is_parity = true,
            _ => files.push(argument),
        }
    }
    let mut meshes = Vec::new();
    for file in &files {
        let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        meshes.push((name, io::read(Path::new(file), Format::Detect, &MeshOptions::default())?));
    }
    if is_parity {
        if files.is_empty() {
            let (torus, shells) = (bodies::torus(0.8, 0.3, 96, 48), bodies::nested_shells(3));
            meshes.extend([("torus".into(), torus.mesh()), ("shells".into(), shells.mesh())]);
            meshes.push(("bracket".into(), bodies::bracket().mesh()));
        }
        return parity(&meshes, count.unwrap_or(1_000_000));
    }
    if files.is_empty() {
        meshes.extend([5, 7].map(|level| (format!("icosphere {level}"), bodies::icosphere(level).mesh())));
    }
    throughput(&meshes, count.unwrap_or(200_000))
}

/// The surface as it stands.
fn standing(mesh: &Mesh) -> Soup {
    Soup {
        vertices: mesh.vertices().iter().map(|v| v.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    }
}

fn geometry(mesh: &Mesh) -> Outcome<Geometry> {
    Ok(Geometry::from_mesh(mesh, &SdfOptions::default(), &Run::SERIAL)?)
}

// --- parity ---------------------------------------------------------------------------------------

fn parity(meshes: &[(String, Mesh)], count: usize) -> Outcome<()> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = Pool::new(threads, || ())?;
    let run = Run { pool: Some(&pool), progress: None };
    println!("isa {}, {threads} threads", embound::isa());
    let mut wrong = 0;
    for (name, mesh) in meshes {
        if mesh.report().boundary_edges > 0 {
            println!("{name}: left out, {} of its edges have one face", mesh.report().boundary_edges);
            continue;
        }
        let (soup, g, mut random) = (standing(mesh), geometry(mesh)?, Random(7));
        let bounds = soup.bounds();
        for is_aimed in [false, true] {
            let (mut asked_about, mut hits, mut odd, mut turned, mut spent) = (0, 0, 0, 0, 0.0);
            while asked_about < count {
                let mut asked = Asked::default();
                while asked.count() < count.min(asked_about + 100_000) - asked_about {
                    let (a, b) = (outside(&mut random, bounds), outside(&mut random, bounds));
                    let (origin, direction) =
                        if is_aimed { aimed(&mut random, &soup, bounds) } else { (a, minus(b, a)) };
                    if direction != [0.0; 3] {
                        asked.push(origin, direction);
                    }
                }
                let start = Instant::now();
                let all = asked.all(&g, &run);
                spent += start.elapsed().as_secs_f64();
                asked_about += all.len();
                hits += all.iter().map(Vec::len).sum::<usize>();
                odd += all.iter().filter(|hits| hits.len() % 2 != 0).count();
                turned += all.iter().filter(|hits| hits.iter().map(|h| h.side).sum::<i32>() != 0).count();
            }
            let kind = if is_aimed { "aimed at edges and corners" } else { "random" };
            println!(
                "{name}, {} triangles: {asked_about} rays {kind}, {hits} hits, {odd} odd, {turned} unbalanced, {spent:.2} s",
                soup.triangles.len()
            );
            wrong += odd + turned;
        }
    }
    if wrong > 0 { Err(format!("{wrong} rays are wrong").into()) } else { Ok(()) }
}

// --- throughput -----------------------------------------------------------------------------------

/// Rays of a kind.
fn rays(kind: &str, soup: &Soup, count: usize) -> Asked {
    let (mut random, mut asked) = (Random(3), Asked::default());
    let (lo, hi) = soup.bounds();
    let (center, size) = ([0, 1, 2].map(|k| 0.5 * (lo[k] + hi[k])), length(minus(hi, lo)));
    let mut around = || loop {
        let p = random.point([-1.0; 3], [1.0; 3]);
        if length(p) > 0.1 && length(p) < 1.0 {
            return [0, 1, 2].map(|k| center[k] + p[k] * size / length(p));
        }
    };
    let mut towards = |from: [f64; 3], to: [f64; 3]| {
        let way = minus(to, from);
        asked.push(from, way.map(|c| c / length(way)));
    };
    let mut other = Random(5);
    match kind {
        "through the box" => (0..count).for_each(|_| towards(around(), other.point(lo, hi))),
        "at the surface" => (0..count).for_each(|_| {
            let [a, b, c] = soup.corners(other.below(soup.triangles.len()));
            let (u, v) = (other.unit(), other.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            towards(around(), [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k])));
        }),
        // A picture.
        _ => {
            let n = (count as f64).sqrt() as usize;
            let eye = [center[0] + 0.5 * size, center[1] + 0.4 * size, center[2] + 0.9 * size];
            for k in 0..n * n {
                let (u, v) = ((k % n) as f64 / n as f64 - 0.5, (k / n) as f64 / n as f64 - 0.5);
                towards(eye, [center[0] + 0.7 * u * size, center[1] + 0.7 * v * size, center[2]]);
            }
        }
    }
    asked
}

const KINDS: [&str; 3] = ["through the box", "at the surface", "a picture"];

fn throughput(meshes: &[(String, Mesh)], count: usize) -> Outcome<()> {
    let embree = embree()?;
    println!("isa {}, one thread, ns a ray, the fastest of {ROUNDS} rounds", embound::isa());
    for (name, mesh) in meshes {
        let (soup, g) = (standing(mesh), geometry(mesh)?);
        for kind in KINDS {
            let asked = rays(kind, &soup, count);
            let (mut first, mut all, mut theirs) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
            let (mut found, mut answers) = (Vec::new(), Vec::new());
            for _ in 0..ROUNDS {
                let each = |start: Instant| start.elapsed().as_secs_f64() * 1e9 / asked.count() as f64;
                let out = Mutex::new(vec![RayHit::NONE; asked.count()]);
                let start = Instant::now();
                query::first_hits(&g, &asked.rays(), &Run::SERIAL, &|start, hits| {
                    out.lock().expect("no panic")[start..start + hits.len()].copy_from_slice(hits);
                })?;
                first = first.min(each(start));
                found = out.into_inner()?;
                let start = Instant::now();
                query::count_hits(&g, &asked.rays(), &Run::SERIAL, &|_, _| {})?;
                all = all.min(each(start));
                if let Some(program) = &embree {
                    let (time, said) = ask_embree(program, &soup, &asked)?;
                    (theirs, answers) = (theirs.min(time), said);
                }
            }
            let met = found.iter().filter(|h| h.side != 0).count();
            print!(
                "{name}, {} triangles, {kind}: {} rays, {met} hit; first {first:.0}, counting all {all:.0}",
                soup.triangles.len(),
                asked.count()
            );
            if embree.is_some() {
                print!(", Embree's first {theirs:.0} ({:.2} times embound's)", theirs / first);
                compare(mesh, &soup, &found, &answers)?;
            }
            println!();
        }
    }
    Ok(())
}

/// What Embree says: t, and the triangle or none.
type Said = (f64, u32);

/// Holds Embree's answers against embound's. Rounding of f32 may turn a hit into a miss, or into another face's, where
/// a ray passes near an edge: of one in a thousand at most.
fn compare(mesh: &Mesh, soup: &Soup, found: &[RayHit], answers: &[Said]) -> Outcome<()> {
    let (lo, hi) = soup.bounds();
    let diagonal = length(minus(hi, lo));
    let (mut same, mut beside, mut other) = (0, 0, 0);
    for (hit, (t, triangle)) in found.iter().zip(answers) {
        let face = mesh.triangles().get(*triangle as usize).map_or(-1, |t| i64::from(t.face));
        let is_near = hit.primitive >= 0 && face >= 0 && (hit.t - t).abs() <= TOLERANCE * diagonal;
        match hit.primitive == face {
            true if is_near || face < 0 => same += 1,
            _ if is_near => beside += 1,
            _ => other += 1,
        }
    }
    print!("; {same} answers the same, {beside} of another face in the same place, {other} others");
    match 1000 * other > found.len() {
        true => Err(format!("{other} answers differ by more than f32 can explain").into()),
        false => Ok(()),
    }
}

/// The program that asks Embree, where it can be built.
fn embree() -> Outcome<Option<PathBuf>> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/cpp/embree.cpp");
    let work = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rays");
    fs::create_dir_all(&work)?;
    let program = work.join("embree");
    for version in ["4", "3"] {
        let built = Command::new("c++")
            .args(["-O3", "-march=native", "-std=c++17", &format!("-DEMBREE={version}")])
            .arg(&source)
            .arg("-o")
            .arg(&program)
            .arg(format!("-lembree{version}"))
            .output();
        if built.is_ok_and(|output| output.status.success()) {
            return Ok(Some(program));
        }
    }
    println!("skipped Embree: libembree-dev is not here, or benches/peers/cpp/embree.cpp does not build");
    Ok(None)
}

/// Nanoseconds a ray, and the answers.
fn ask_embree(program: &Path, soup: &Soup, asked: &Asked) -> Outcome<(f64, Vec<Said>)> {
    let work = program.parent().ok_or("no directory")?;
    let bytes = |numbers: &[f64]| numbers.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<u8>>();
    fs::write(work.join("vertices.f64"), bytes(&soup.xyz()))?;
    fs::write(work.join("triangles.u32"), soup.indices().iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>())?;
    fs::write(work.join("origin.f64"), bytes(&asked.origin))?;
    fs::write(work.join("direction.f64"), bytes(&asked.direction))?;
    let output = Command::new(program).arg(work).output()?;
    if !output.status.success() {
        return Err(format!("Embree: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    let time = String::from_utf8(output.stdout)?.trim().parse()?;
    let (t, triangle) = (fs::read(work.join("t.f32"))?, fs::read(work.join("triangle.u32"))?);
    let t = t.as_chunks().0.iter().map(|b| f64::from(f32::from_le_bytes(*b)));
    Ok((time, t.zip(triangle.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b))).collect()))
}
