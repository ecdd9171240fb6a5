// SPDX-License-Identifier: MIT OR Apache-2.0
//! A large file, from disk to signed distance: seconds of each step and the peak memory of the process.
//!
//!     cargo bench --bench large -- [triangles] [threads]      (10,000,000 and 2)
//!
//! The file is a binary STL of a bumpy torus, written to the temporary directory and removed.

use embound::geometry::{Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::MeshOptions;
use embound::parallel::{Pool, Run};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Instant;

/// A point of the torus: `i` of `n` around, `j` of `m` across.
fn point(i: usize, n: usize, j: usize, m: usize) -> [f32; 3] {
    let turn = |k: usize, of: usize| std::f64::consts::TAU * (k % of) as f64 / of as f64;
    let (a, b) = (turn(i, n), turn(j, m));
    let r = 0.3 + 0.02 * libm::sin(40.0 * a) * libm::sin(15.0 * b);
    let d = 1.0 + r * libm::cos(b);
    [(d * libm::cos(a)) as f32, (d * libm::sin(a)) as f32, (r * libm::sin(b)) as f32]
}

fn write(path: &Path, triangles: usize) -> std::io::Result<usize> {
    let n = (((triangles / 2) as f64).sqrt() as usize).max(3);
    let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
    out.write_all(&[b' '; 80])?;
    out.write_all(&((2 * n * n) as u32).to_le_bytes())?;
    for i in 0..n {
        let row = |i: usize| (0..n).map(|j| point(i, n, j, n)).collect::<Vec<_>>();
        let (low, high) = (row(i), row(i + 1));
        for j in 0..n {
            let k = (j + 1) % n;
            for t in [[low[j], high[j], high[k]], [low[j], high[k], low[k]]] {
                out.write_all(&[0; 12])?;
                for c in t.concat() {
                    out.write_all(&c.to_le_bytes())?;
                }
                out.write_all(&[0; 2])?;
            }
        }
    }
    out.flush()?;
    Ok(2 * n * n)
}

/// The most memory that the process has had, in MB; Linux alone tells.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with("VmHWM")).unwrap_or("");
    line.split_whitespace().nth(1).and_then(|n| n.parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1024.0)
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|a| a.parse::<usize>().ok());
    let (triangles, threads) = (numbers.next().unwrap_or(10_000_000), numbers.next().unwrap_or(2));
    let path = std::env::temp_dir().join(format!("embound-large-{}.stl", std::process::id()));
    let count = write(&path, triangles).expect("the temporary directory takes the file");
    println!("{count} triangles, {threads} threads, {:.0} MB before", peak());
    let start = Instant::now();
    let mesh = io::read(&path, Format::Detect, &MeshOptions::default()).expect("the file is right");
    println!("{:8.2} s  read, welded, reported   {:6.0} MB", start.elapsed().as_secs_f64(), peak());
    let report = mesh.report();
    assert!(report.closed && report.consistent && report.triangles == count);
    let pool = Pool::new(threads, || ()).expect("threads");
    let run = Run { pool: Some(&pool), progress: None };
    let build = Instant::now();
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &run).expect("the mesh is clean");
    println!("{:8.2} s  built                    {:6.0} MB", build.elapsed().as_secs_f64(), peak());
    let ask = Instant::now();
    let sum: f64 = (0..100_000)
        .map(|k| g.value(Vec3::new((k % 47) as f64 / 20.0 - 1.2, (k % 53) as f64 / 22.0 - 1.2, (k % 31) as f64 / 50.0)))
        .sum();
    println!("{:8.2} us a value (sum {sum:.6})", 10.0 * ask.elapsed().as_secs_f64());
    println!("{:8.2} s in all, {:.0} MB at most", start.elapsed().as_secs_f64(), peak());
    let _ = std::fs::remove_file(&path);
}
