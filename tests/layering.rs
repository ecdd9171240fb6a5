// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rules of the source tree, checked by reading it: which module may use which, where glam, rayon
//! and `unsafe` may stand, that nothing prints, that no result's bits depend on the platform's libm,
//! and the SPDX line of every file.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Each module with what it may use; `error` and `parallel` serve all, and nothing uses `ffi`.
const MAY_USE: [(&str, &[&str]); 13] = [
    ("error", &[]),
    ("math", &[]),
    ("parallel", &["simd"]),
    ("simd", &[]),
    ("primitive", &["math", "simd", "store"]),
    ("mesh", &["math", "primitive"]),
    ("io", &["math", "mesh"]),
    ("store", &["math", "simd"]),
    ("bvh", &["math", "simd", "store"]),
    ("scan", &["math", "primitive"]),
    ("geometry", &["math", "primitive", "mesh", "bvh", "scan", "simd", "store"]),
    ("query", &["math", "primitive", "mesh", "bvh", "scan", "geometry", "simd"]),
    ("ffi", &["math", "mesh", "io", "geometry", "query", "simd", "store"]),
];

/// Functions of std whose bits differ between platforms, and fused operations, which differ from unfused ones.
const PLATFORM_MATH: [&str; 21] = [
    ".sin(",
    ".cos(",
    ".tan(",
    ".sin_cos(",
    ".asin(",
    ".acos(",
    ".atan(",
    ".atan2(",
    ".sinh(",
    ".cosh(",
    ".tanh(",
    ".exp(",
    ".exp2(",
    ".ln(",
    ".log2(",
    ".log10(",
    ".powf(",
    ".powi(",
    ".cbrt(",
    ".hypot(",
    "mul_add",
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Every file below a directory, by its path from the repository's root.
fn files(directory: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![root().join(directory)];
    while let Some(place) = open.pop() {
        for entry in fs::read_dir(&place).into_iter().flatten() {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.push(path.strip_prefix(root()).expect("below the root").to_owned());
            }
        }
    }
    found.sort();
    found
}

fn read(path: &Path) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A source of the library.
struct Source {
    path: PathBuf,
    /// Its top-level module; `lib` for the root.
    module: String,
    /// How many modules it lies below the root.
    depth: usize,
    text: String,
}

fn sources() -> Vec<Source> {
    let paths = files("src").into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs"));
    let sources: Vec<Source> = paths.map(source).collect();
    assert!(sources.len() > 20, "the sources were not found");
    sources
}

fn source(path: PathBuf) -> Source {
    let stem = path.with_extension("");
    let parts: Vec<&str> = stem.iter().skip(1).filter_map(|part| part.to_str()).collect();
    let depth = parts.iter().filter(|part| !["mod", "lib"].contains(part)).count();
    Source { module: parts[0].to_owned(), depth, text: read(&path), path }
}

impl Source {
    /// The lines of code, numbered, without comments.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines = self.text.lines().enumerate();
        lines
            .map(|(at, line)| (at + 1, line.split("//").next().unwrap_or("")))
            .filter(|(_, line)| !line.trim().is_empty())
    }
}

/// Whether `word` stands in `line` by itself.
fn names(line: &str, word: &str) -> bool {
    let letter = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word)
        .any(|(at, _)| !line[..at].ends_with(letter) && !line[at + word.len()..].starts_with(letter))
}

/// What follows each `path` in `line`: `crate::{a, b::c}` gives a and b.
fn named_after(line: &str, path: &str) -> Vec<String> {
    let first = |text: &str| text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let each = |rest: &str| match rest.strip_prefix('{') {
        Some(list) => list.split(['}']).next().unwrap_or("").split(',').map(first).collect(),
        None => vec![first(rest)],
    };
    line.match_indices(path)
        .flat_map(|(at, _)| each(&line[at + path.len()..]))
        .filter(|name| !name.is_empty())
        .collect()
}

/// Fails with every breach, not the first alone.
fn none(breaches: Vec<String>) {
    assert!(breaches.is_empty(), "\n{}", breaches.join("\n"));
}

/// The lines of code outside the `allowed` modules that `breach`.
fn outside(allowed: &[&str], breach: impl Fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources().iter().filter(|source| !allowed.contains(&source.module.as_str())) {
        let lines = source.code().filter(|(_, line)| breach(line));
        found.extend(lines.map(|(at, line)| format!("{}:{at}: {}", source.path.display(), line.trim())));
    }
    found
}

#[test]
fn modules_use_only_what_lies_before_them() {
    let mut breaches = Vec::new();
    for source in sources().iter().filter(|source| source.module != "lib") {
        let rule = MAY_USE.iter().find(|(module, _)| *module == source.module);
        let (_, allowed) = rule.unwrap_or_else(|| panic!("{}: no rule for this module", source.path.display()));
        // `use` may span lines, so the file is one text here.
        let code: String = source.code().map(|(_, line)| format!("{line} ")).collect();
        for used in named_after(&code, "crate::") {
            let free = used == source.module || ["error", "parallel"].contains(&used.as_str());
            if !free && !allowed.contains(&used.as_str()) {
                breaches.push(format!("{}: {} must not use {used}", source.path.display(), source.module));
            }
        }
        // `super` must not lead out of a top-level module past these rules; `super::*` is that of inner tests.
        let out = "super::".repeat(source.depth);
        if named_after(&code, &out).iter().any(|name| name != "super") {
            breaches.push(format!("{}: {out} leaves the module: write crate::", source.path.display()));
        }
    }
    none(breaches);
}

#[test]
fn only_math_names_glam() {
    none(outside(&["math"], |line| names(line, "glam")));
}

#[test]
fn only_parallel_names_rayon() {
    none(outside(&["parallel"], |line| names(line, "rayon")));
}

#[test]
fn unsafe_stands_only_where_it_must() {
    none(outside(&["simd", "ffi", "store"], |line| names(line, "unsafe")));
}

#[test]
fn every_unsafe_block_says_why_it_is_sound() {
    let mut breaches = Vec::new();
    for source in sources() {
        let lines: Vec<&str> = source.text.lines().collect();
        for (at, line) in source.code().filter(|(_, line)| line.contains("unsafe {") || line.contains("unsafe impl")) {
            let reasons = lines[at.saturating_sub(7)..at].iter().any(|before| before.contains("SAFETY:"));
            if !reasons {
                breaches.push(format!("{}:{at}: {}", source.path.display(), line.trim()));
            }
        }
    }
    none(breaches);
}

#[test]
fn the_library_prints_nothing() {
    none(outside(&[], |line| {
        ["println", "print", "eprintln", "eprint", "dbg"].iter().any(|name| line.contains(&format!("{name}!")))
    }));
}

#[test]
fn no_result_depends_on_the_platform() {
    none(outside(&[], |line| PLATFORM_MATH.iter().any(|name| line.contains(name))));
}

#[test]
fn nothing_is_left_to_do() {
    none(outside(&[], |line| ["todo!", "unimplemented!"].iter().any(|name| line.contains(name))));
}

#[test]
fn every_file_names_its_licence_first() {
    let kinds = ["rs", "c", "h", "cpp", "hpp", "f90", "cmake", "in", "sh", "py", "txt", "toml"];
    let directories = ["src", "tests", "include", "cpp-examples", "cmake", "scripts", "benches", "examples", ".ci"];
    let mut breaches = Vec::new();
    let places = directories.iter().flat_map(|directory| files(directory));
    for path in places.chain(["build.rs", "CMakeLists.txt", "cbindgen.toml"].map(PathBuf::from)) {
        let extension = path.extension().and_then(|e| e.to_str());
        let listed = path.ends_with("symbols.txt");
        if listed || !extension.is_none_or(|e| kinds.contains(&e)) {
            continue;
        }
        let text = read(&path);
        // A script's first line names its interpreter.
        let first = text.lines().find(|line| !line.starts_with("#!")).unwrap_or("");
        if !first.contains("SPDX-License-Identifier: MIT OR Apache-2.0") {
            breaches.push(format!("{}: {first}", path.display()));
        }
    }
    none(breaches);
}
