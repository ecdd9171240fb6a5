// SPDX-License-Identifier: MIT OR Apache-2.0
//! One geometry for several processes: how large its block is, how long it takes to write and to open, and how much
//! memory two processes have that map one file.
//!
//!     cargo bench --bench pack -- [triangles] [threads]      (10,000,000 and 2)
//!
//! The mesh is a bumpy torus; the file goes to the temporary directory and is removed. Memory is told on Linux alone.

use embound::geometry::{Geometry, SdfOptions, UnpackCheck};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use std::fs::File;
use std::hint::black_box;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

/// The torus, `n` around and across.
fn torus(n: usize) -> Mesh {
    let mut xyz = Vec::with_capacity(3 * n * n);
    let mut indices = Vec::with_capacity(6 * n * n);
    for i in 0..n {
        for j in 0..n {
            let turn = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
            let (a, b) = (turn(i), turn(j));
            let r = 0.3 + 0.02 * libm::sin(40.0 * a) * libm::sin(15.0 * b);
            let d = 1.0 + r * libm::cos(b);
            xyz.extend([d * libm::cos(a), d * libm::sin(a), r * libm::sin(b)]);
            let at = |i: usize, j: usize| (n * (i % n) + j % n) as u32;
            let [p, q, s, t] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            indices.extend([p, q, s, p, s, t]);
        }
    }
    Mesh::from_triangles(&xyz, &indices, None, &MeshOptions::default()).expect("a mesh")
}

/// Points all over, the same each time.
fn answers(g: &Geometry, count: usize) -> u64 {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        3.0 * ((state >> 11) as f64 / (1u64 << 53) as f64 - 0.5)
    };
    (0..count).fold(0, |sum: u64, _| sum.rotate_left(7) ^ g.value(Vec3::new(next(), next(), 0.3 * next())).to_bits())
}

/// What this process maps of a file, in MB: resident, and its share of what several have.
fn mapped(path: &Path) -> (f64, f64) {
    let maps = std::fs::read_to_string("/proc/self/smaps").unwrap_or_default();
    let own = path.to_str().and_then(|path| maps.split_once(path)).map_or("", |(_, own)| own);
    let number = |name: &str| {
        let line = own.lines().find(|line| line.starts_with(name)).unwrap_or("");
        line.split_whitespace().nth(1).and_then(|n| n.parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1024.0)
    };
    (number("Rss:"), number("Pss:"))
}

fn wait() {
    std::io::stdin().read_line(&mut String::new()).expect("the parent's word");
}

/// Opens, asks, and waits for the others before it tells of its memory.
fn child(path: &Path) {
    let start = Instant::now();
    let g = Geometry::open(path, UnpackCheck::Trust, &Run::SERIAL).expect("opened");
    let opened = start.elapsed().as_secs_f64() * 1e3;
    let sum = answers(&g, 20_000);
    // Every byte once.
    black_box(Geometry::open(path, UnpackCheck::Check, &Run::SERIAL).expect("opened").fingerprint());
    println!("{opened:.2} {sum}");
    // Every page of the first map, too.
    black_box(g.pack_to(&mut std::io::sink(), &Run::SERIAL)).expect("packed");
    wait();
    let (resident, share) = mapped(path);
    println!("{resident:.0} {share:.0}");
    wait();
}

struct Other {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

impl Other {
    fn new(path: &Path) -> Other {
        let mut command = Command::new(std::env::current_exe().expect("a program"));
        let mut child =
            command.arg("child").arg(path).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("a process");
        let (to, from) = (child.stdin.take().expect("piped"), child.stdout.take().expect("piped"));
        Other { child, to, from: BufReader::new(from) }
    }

    fn tells(&mut self) -> [String; 2] {
        let mut line = String::new();
        self.from.read_line(&mut line).expect("a line");
        let mut words = line.split_whitespace().map(str::to_owned);
        [words.next().expect("two words"), words.next().expect("two words")]
    }

    fn go_on(&mut self) {
        self.to.write_all(b"\n").expect("it waits");
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, path] = &arguments[..]
        && word == "child"
    {
        return child(Path::new(path));
    }
    let mut numbers = arguments.iter().filter_map(|a| a.parse::<usize>().ok());
    let (triangles, threads) = (numbers.next().unwrap_or(10_000_000), numbers.next().unwrap_or(2));
    let path = std::env::temp_dir().join(format!("embound-pack-{}", std::process::id()));
    let pool = Pool::new(threads, || ()).expect("a pool");
    let run = Run { pool: Some(&pool), progress: None };
    let timed = |what: &str, work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        println!("{what:<44} {:>10.2} ms", start.elapsed().as_secs_f64() * 1e3);
    };

    let mesh = torus(((triangles / 2) as f64).sqrt() as usize);
    let mut made = None;
    timed("made of the mesh", &mut || made = Geometry::from_mesh(&mesh, &SdfOptions::default(), &run).ok());
    drop(mesh);
    let g = made.expect("a geometry");
    println!("{:<44} {:>10}", "triangles", g.properties().primitives);
    timed("saved", &mut || g.pack_to(&mut File::create(&path).expect("a file"), &run).expect("saved"));
    let size = std::fs::metadata(&path).expect("a file").len();
    println!("{:<44} {:>10.1} MB", "block", size as f64 / 1e6);
    let own = answers(&g, 20_000);
    drop(g);
    let open = |check, run: &Run| drop(black_box(Geometry::open(&path, check, run).expect("opened")));
    timed("opened, trusted", &mut || open(UnpackCheck::Trust, &Run::SERIAL));
    timed("opened, checked by one thread", &mut || open(UnpackCheck::Check, &Run::SERIAL));
    timed("opened, checked by all", &mut || open(UnpackCheck::Check, &run));

    let mut others = [Other::new(&path), Other::new(&path)];
    for other in &mut others {
        let [opened, sum] = other.tells();
        assert_eq!(sum, own.to_string(), "other bits");
        println!("{:<44} {opened:>10} ms", "opened by another process, trusted");
    }
    others.iter_mut().for_each(Other::go_on);
    for other in &mut others {
        let [resident, share] = other.tells();
        println!("{:<44} {resident:>10} MB, its share {share} MB", "that process has of the file in memory");
    }
    for other in &mut others {
        other.go_on();
        assert!(other.child.wait().expect("it ends").success());
    }
    std::fs::remove_file(&path).expect("it was there");
}
