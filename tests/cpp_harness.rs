// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the C++ layer on its own with every warning an error, and runs tests/cpp against the shared
//! library that cargo built beside this test.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const WARNINGS: [&str; 6] = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The C++ compiler that the cc crate finds.
fn compiler() -> PathBuf {
    let target = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
    cc::Build::new().cpp(true).opt_level(1).host(&target).target(&target).get_compiler().path().to_path_buf()
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{text}", output.status);
    text
}

fn with_extension(directory: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension() == Some(OsStr::new(extension)))
        .collect();
    files.sort();
    files
}

fn works(compiler: &Path, arguments: &[&str]) -> bool {
    Command::new(compiler).args(arguments).output().is_ok_and(|output| output.status.success())
}

/// A directory of this test's own, with the shared library under the name that programs look for.
fn directory_with_library() -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cpp_harness");
    fs::create_dir_all(&directory).unwrap();
    let built = std::env::current_exe().unwrap().with_file_name("libembound.so");
    let soname = format!("libembound.so.{}.{}", env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR"));
    for name in ["libembound.so", &soname] {
        fs::copy(&built, directory.join(name)).unwrap_or_else(|e| panic!("{}: {e}", built.display()));
    }
    directory
}

#[test]
fn every_header_compiles_alone_without_a_warning() {
    let include = root().join("include");
    let mut headers = with_extension(&include.join("embound"), "hpp");
    headers.retain(|header| !header.ends_with("openmp.hpp")); // needs -fopenmp: tests/cpp/openmp.cpp includes it
    let umbrella = [include.join("embound.hpp")];
    let default = compiler();
    let check = |compiler: &Path, standard: &str, header: &Path| {
        let mut command = Command::new(compiler);
        command
            .args(["-x", "c++", "-fsyntax-only", standard])
            .args(WARNINGS)
            .arg("-include")
            .arg(header)
            .arg("/dev/null");
        run(&mut command);
    };
    for header in &headers {
        check(&default, "-std=c++17", header);
    }
    for name in [default.as_path(), Path::new("clang++")] {
        if works(name, &["--version"]) {
            for standard in ["-std=c++17", "-std=c++20"] {
                umbrella.iter().for_each(|header| check(name, standard, header));
            }
        }
    }
}

#[test]
fn the_cpp_harness_passes_against_the_shared_library() {
    let directory = directory_with_library();
    let sources = root().join("tests/cpp");
    let compiler = compiler();
    let openmp = works(&compiler, &["-fopenmp", "-x", "c++", "-E", "-o", "/dev/null", "/dev/null"]);
    let compile = |source: &Path| {
        let object = directory.join(source.file_name().unwrap()).with_extension("o");
        let mut command = Command::new(&compiler);
        command.args(["-std=c++17", "-O1", "-c"]).args(WARNINGS).arg("-I").arg(root().join("include"));
        if openmp && source.ends_with("openmp.cpp") {
            command.arg("-fopenmp");
        }
        run(command.arg(source).arg("-o").arg(&object));
        object
    };
    let support: Vec<PathBuf> = with_extension(&sources.join("support"), "cpp").iter().map(|s| compile(s)).collect();
    let programs = with_extension(&sources, "cpp");
    assert!(!programs.is_empty() && !support.is_empty());
    for source in programs {
        let program = directory.join(source.file_stem().unwrap());
        let mut link = Command::new(&compiler);
        link.arg(compile(&source)).args(&support).arg("-L").arg(&directory).args(["-lembound", "-pthread"]);
        if openmp && source.ends_with("openmp.cpp") {
            link.arg("-fopenmp");
        }
        run(link.arg(format!("-Wl,-rpath,{}", directory.display())).arg("-o").arg(&program));
        let text = run(Command::new(&program).current_dir(&directory));
        assert!(text.contains(" 0 checks failed"), "{}: {text}", program.display());
    }
}
