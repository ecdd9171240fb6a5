// SPDX-License-Identifier: MIT OR Apache-2.0
//! One file, several processes: one copy in memory, and the same bits.

use super::same::{answers, assert_same};
use super::scenes::mesh;
use crate::common::bodies;
use embound::Status;
use embound::geometry::{Accelerator, Geometry, UnpackCheck};
use embound::parallel::Run;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::{env, fs};

const VARIABLE: &str = "EMBOUND_TEST_PACKED_FILE";

struct Temporary(PathBuf);

impl Temporary {
    fn new(name: &str, bytes: &[u8]) -> Temporary {
        let path = env::temp_dir().join(format!("embound-{}-{name}", std::process::id()));
        fs::write(&path, bytes).expect("a file");
        Temporary(path)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
fn a_file_is_opened_and_outlives_its_name() {
    let g = mesh(Accelerator::Auto);
    let bytes = g.pack().expect("packed");
    let file = Temporary::new("outlives", &bytes);
    let back = Geometry::open(&file.0, UnpackCheck::Check, &Run::SERIAL).expect("opened");
    let trusted = Geometry::open(&file.0, UnpackCheck::Trust, &Run::SERIAL).expect("opened");
    drop(file);
    assert_same("mapped", &g, &back);
    assert_same("mapped", &g, &trusted);
}

#[test]
fn files_that_are_none_are_named() {
    let missing = Path::new("/no/such/file");
    let error = Geometry::open(missing, UnpackCheck::Check, &Run::SERIAL).err().expect("there is none");
    assert_eq!(error.status(), Status::Io);
    assert!(error.message().contains("/no/such/file"), "{error}");
    let error = Geometry::open(&env::temp_dir(), UnpackCheck::Check, &Run::SERIAL).err().expect("a folder");
    assert_eq!(error.status(), Status::Io, "{error}");
    let bytes = mesh(Accelerator::Auto).pack().expect("packed");
    for (name, content) in [("empty", &bytes[..0]), ("cut", &bytes[..bytes.len() - 64]), ("text", &b"solid"[..])] {
        let file = Temporary::new(name, content);
        let error = Geometry::open(&file.0, UnpackCheck::Trust, &Run::SERIAL).err().expect("damaged");
        assert_eq!(error.status(), Status::Parse, "{error}");
        assert!(error.message().contains(name), "{error}");
    }
}

/// Sizes of what a process maps of a file, in kB: resident, and its share of what several have.
#[cfg(target_os = "linux")]
fn mapped(path: &Path) -> (u64, u64) {
    let maps = fs::read_to_string("/proc/self/smaps").expect("Linux");
    let own = maps.split_once(path.to_str().expect("a name")).expect("it is mapped").1;
    let number = |name: &str| {
        let line = own.lines().find(|line| line.starts_with(name)).expect("a line");
        line.split_whitespace().nth(1).and_then(|n| n.parse().ok()).expect("a number")
    };
    (number("Rss:"), number("Pss:"))
}

/// What the child does: opens, asks, waits until the others have, and tells.
#[cfg(target_os = "linux")]
#[test]
fn child() {
    let Some(path) = env::var_os(VARIABLE).map(PathBuf::from) else { return };
    let g = Geometry::open(&path, UnpackCheck::Trust, &Run::SERIAL).expect("opened");
    let sum = answers(&g).iter().fold(g.fingerprint(), |sum, x| sum.rotate_left(5) ^ x);
    println!("\nsum {sum}");
    std::io::stdin().read_line(&mut String::new()).expect("the parent's word");
    let (resident, share) = mapped(&path);
    println!("\nmemory {resident} {share}");
    std::io::stdin().read_line(&mut String::new()).expect("the parent's word");
}

/// The numbers of the line that begins so.
#[cfg(target_os = "linux")]
fn told(out: &mut impl BufRead, name: &str) -> Vec<u64> {
    let mut line = String::new();
    while !line.starts_with(name) {
        line.clear();
        assert!(out.read_line(&mut line).expect("text") > 0, "{name}");
    }
    line.split_whitespace().skip(1).map(|n| n.parse().expect("a number")).collect()
}

#[cfg(target_os = "linux")]
#[test]
fn two_processes_share_one_copy() {
    let soup = bodies::torus(0.8, 0.3, 300, 160);
    let g = Geometry::from_mesh(&soup.mesh(), &Default::default(), &Run::SERIAL).expect("a geometry");
    let file = Temporary::new("shared", &g.pack().expect("packed"));
    let spawn = |_| {
        let mut command = Command::new(env::current_exe().expect("a test"));
        command.args(["processes::child", "--exact", "--nocapture"]).env(VARIABLE, &file.0);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("a process")
    };
    let mut children: Vec<Child> = (0..2).map(spawn).collect();
    let mut outs: Vec<_> = children.iter_mut().map(|c| BufReader::new(c.stdout.take().expect("piped"))).collect();
    let go_on = |children: &mut [Child]| {
        children.iter_mut().for_each(|c| c.stdin.as_mut().expect("piped").write_all(b"\n").expect("written"));
    };
    let own = answers(&g).iter().fold(g.fingerprint(), |sum, x| sum.rotate_left(5) ^ x);
    outs.iter_mut().for_each(|out| assert_eq!(told(out, "sum"), [own], "other bits"));
    go_on(&mut children);
    let memory: Vec<Vec<u64>> = outs.iter_mut().map(|out| told(out, "memory")).collect();
    go_on(&mut children);
    for (child, memory) in children.iter_mut().zip(&memory) {
        assert!(child.wait().expect("it ends").success());
        let (resident, share) = (memory[0], memory[1]);
        assert!(resident > 10_000 && 100 * share <= 55 * resident, "{resident} kB, of which {share} count");
    }
}
