// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whatever the bytes of a file are, reading ends soon with a mesh or an error of one line, and takes memory in
//! proportion to the file.
//!
//! Good files are made wrong, again and again, for two seconds a format; EMBOUND_FUZZ_SECONDS asks for more and
//! EMBOUND_FUZZ_SEED for others. A file that fails is kept and named.

#[path = "../common/mod.rs"]
mod common;

mod inflated;
mod memory;
mod mutate;
mod seeds;

use common::random::Random;
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{MeshOptions, Orient};
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

/// No file takes longer.
const LONGEST: Duration = Duration::from_secs(5);

/// Reading takes at most so many bytes for each of the file, and so many more.
const TIMES: usize = 20;
const MORE: usize = 16 << 20;

fn number(variable: &str, default: u64) -> u64 {
    env::var(variable).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{variable}: {text}")))
}

/// A file that is being read, since when.
type Current = Arc<Mutex<Option<(Instant, Vec<u8>)>>>;

/// Reads wrong files for as long as is asked for.
fn fuzz(name: &str, format: Format, corpus: Vec<Vec<u8>>) {
    let seconds = Duration::from_secs(number("EMBOUND_FUZZ_SECONDS", 2));
    let seed = number("EMBOUND_FUZZ_SEED", 1);
    let current: Current = Arc::default();
    let shared = current.clone();
    let label = name.to_owned();
    let reading = thread::spawn(move || {
        let mut random = Random(seed);
        let (begin, mut cases, mut meshes) = (Instant::now(), 0u64, 0u64);
        while begin.elapsed() < seconds {
            let bytes = mutate::mutated(&corpus, &mut random);
            let options = options(&mut random);
            let format = if random.below(8) == 0 { Format::Detect } else { format };
            *shared.lock().unwrap() = Some((Instant::now(), bytes.clone()));
            let outcome = check(&bytes, format, &options);
            *shared.lock().unwrap() = None;
            match outcome {
                Ok(is_mesh) => meshes += u64::from(is_mesh),
                Err(what) => panic!("{what}: seed {seed}, case {cases}, kept as {}", keep(&label, &bytes).display()),
            }
            cases += 1;
        }
        (cases, meshes)
    });
    while !reading.is_finished() {
        thread::sleep(Duration::from_millis(20));
        let stuck = current.lock().unwrap().take_if(|(since, _)| since.elapsed() > LONGEST);
        if let Some((_, bytes)) = stuck {
            panic!("still reading after {LONGEST:?}: seed {seed}, kept as {}", keep(name, &bytes).display());
        }
    }
    let (cases, meshes) = reading.join().unwrap_or_else(|e| panic::resume_unwind(e));
    // Else the mutations destroy everything, or nothing.
    assert!(meshes > 0 && meshes < cases, "{meshes} of {cases} are meshes");
}

/// Whether the file is a mesh; what is wrong with reading it, if anything.
fn check(bytes: &[u8], format: Format, options: &MeshOptions) -> Result<bool, String> {
    let read = || io::read_memory(bytes, format, options);
    let (outcome, peak) = memory::peak_of(|| panic::catch_unwind(AssertUnwindSafe(read)));
    let outcome = outcome.map_err(|_| "a panic".to_owned())?;
    let allowed = |size: usize| TIMES * size + MORE;
    if peak > allowed(bytes.len()) && peak > allowed(bytes.len() + inflated::size(bytes)) {
        return Err(format!("{peak} bytes for a file of {}", bytes.len()));
    }
    let Err(e) = outcome else { return Ok(true) };
    let expected = matches!(e.status(), Status::Parse | Status::Unsupported | Status::InvalidArgument);
    if !expected || e.message().is_empty() || e.message().contains(['\n', '\r']) {
        return Err(format!("the error {:?} {:?}", e.status(), e.message()));
    }
    Ok(false)
}

fn options(random: &mut Random) -> MeshOptions {
    MeshOptions {
        weld_tolerance: [0.0, 0.0, -1.0, 1e-9, 0.1][random.below(5)],
        orient: [Orient::Auto, Orient::Auto, Orient::Keep, Orient::Flip][random.below(4)],
        ..MeshOptions::default()
    }
}

/// Writes a file that fails where it can be found.
fn keep(name: &str, bytes: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}"));
    fs::write(&path, bytes).expect("the folder of tests can be written to");
    path
}

/// Whether the files that are to be made wrong are right.
fn assert_good(format: Format, corpus: &[Vec<u8>]) {
    for (k, bytes) in corpus.iter().enumerate() {
        for format in [format, Format::Detect] {
            let outcome = io::read_memory(bytes, format, &MeshOptions::default());
            assert!(outcome.is_ok(), "file {k}: {}", outcome.unwrap_err());
        }
    }
}

#[test]
fn wrong_stl_files_are_survived() {
    assert_good(Format::Stl, &seeds::stl());
    fuzz("stl", Format::Stl, seeds::stl());
}

#[test]
fn wrong_obj_files_are_survived() {
    assert_good(Format::Obj, &seeds::obj());
    fuzz("obj", Format::Obj, seeds::obj());
}

#[test]
fn wrong_vtp_files_are_survived() {
    assert_good(Format::Vtp, &seeds::vtp());
    fuzz("vtp", Format::Vtp, seeds::vtp());
}

#[test]
fn wrong_ply_files_are_survived() {
    assert_good(Format::Ply, &seeds::ply());
    fuzz("ply", Format::Ply, seeds::ply());
}

#[test]
fn wrong_vtk_files_are_survived() {
    assert_good(Format::Vtk, &seeds::vtk());
    fuzz("vtk", Format::Vtk, seeds::vtk());
}

/// Large files whose every byte asks for memory: what a small one may take beyond proportion shows here.
#[test]
fn large_files_take_memory_in_proportion() {
    for (name, format, bytes) in seeds::large() {
        if let Err(what) = check(&bytes, format, &MeshOptions::default()) {
            panic!("{name}: {what}");
        }
    }
}

/// The memory of a thread is counted, and no other's.
#[test]
fn memory_is_counted_by_thread() {
    let (kept, peak) = memory::peak_of(|| {
        let large = vec![1u8; 5000];
        let other = thread::spawn(|| vec![2u8; 1 << 20].len()).join().unwrap();
        drop(large);
        (vec![3u8; 1000], other)
    });
    assert!((5000..100_000).contains(&peak), "{peak}");
    let (_, peak) = memory::peak_of(|| drop(kept));
    assert_eq!(peak, 0);
}
