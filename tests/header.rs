// SPDX-License-Identifier: MIT OR Apache-2.0
//! The committed header is what cbindgen makes of the sources, declares exactly what the libraries
//! export, and compiles alone in every C and C++ that solvers use. EMBOUND_BLESS=1 rewrites the header
//! and the list of symbols.

mod common;

use common::native::{Language, compile, deps, root, work};
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// The sources of the C ABI, in the header's order.
const SOURCES: [&str; 30] = [
    "constants",
    "error",
    "callback",
    "pool",
    "run",
    "writer",
    "results",
    "mesh",
    "topology",
    "data",
    "assembly",
    "repair",
    "polygon",
    "diagnosis_structs",
    "diagnosis",
    "diagnosis_lists",
    "geometry",
    "refit",
    "pack",
    "shapes",
    "sampled",
    "function",
    "transforms",
    "blend",
    "combine",
    "query",
    "rays",
    "faces",
    "bounding",
    "lattice",
];

fn generate() -> String {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).expect("cbindgen.toml");
    let builder = SOURCES.iter().fold(cbindgen::Builder::new().with_config(config), |builder, name| {
        builder.with_src(root().join(format!("src/ffi/{name}.rs")))
    });
    let mut header = Vec::new();
    builder.generate().expect("the sources").write(&mut header);
    without_tags(&String::from_utf8(header).expect("UTF-8"))
}

/// `const emb_geom *` instead of `const struct emb_geom *`, which means the same after the typedefs.
fn without_tags(header: &str) -> String {
    let lines = header.lines().map(|line| match line.starts_with("typedef struct emb_") {
        true => line.to_owned(),
        false => line.replace("struct emb_", "emb_"),
    });
    lines.fold(String::new(), |text, line| text + &line + "\n")
}

/// Compares with a committed file, or rewrites it where that is asked for.
fn compare(path: &str, content: &str) {
    let file = root().join(path);
    if env::var_os("EMBOUND_BLESS").is_some() {
        fs::write(&file, content).expect(path);
    }
    let committed = fs::read_to_string(&file).unwrap_or_default();
    assert!(committed == content, "{path} is out of date: EMBOUND_BLESS=1 cargo test --test header\n{content}");
}

#[test]
fn the_committed_header_is_generated_from_the_sources() {
    compare("include/embound.h", &generate());
}

/// The names that the header declares as functions.
fn declared() -> BTreeSet<String> {
    let name = |line: &str| {
        let before = line.split_once('(')?.0;
        let name = before.rsplit([' ', '*']).next()?;
        (name.starts_with("emb_") && !line.starts_with(['/', '#', ' ']) && !line.starts_with("typedef"))
            .then(|| name.to_owned())
    };
    generate().lines().filter_map(name).collect()
}

/// The symbols that a library defines for its users.
fn exported(library: &Path, dynamic: bool) -> BTreeSet<String> {
    let table = if dynamic { "--dynamic" } else { "--extern-only" };
    let output =
        Command::new("nm").args([table, "--defined-only", "--format=posix"]).arg(library).output().expect("nm");
    assert!(output.status.success(), "nm {}", library.display());
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().filter_map(|line| line.split_once(' ')).map(|(name, _)| name.to_owned()).collect()
}

#[test]
fn the_libraries_export_what_the_header_declares() {
    let declared = declared();
    assert!(declared.len() > 40, "{declared:?}");
    compare("tests/symbols.txt", &declared.iter().fold(String::new(), |list, name| list + name + "\n"));
    // A shared library exports nothing else; an archive holds the standard library as well.
    assert_eq!(exported(&deps().join("libembound.so"), true), declared);
    let archive = exported(&deps().join("libembound.a"), false);
    let own: BTreeSet<String> = archive.into_iter().filter(|name| name.starts_with("emb_")).collect();
    assert_eq!(own, declared);
}

#[test]
fn the_header_compiles_alone_in_every_dialect() {
    let dialects = [
        (Language::C, "c", ["c99", "c11", "c17", "c2x"]),
        (Language::Cpp, "cpp", ["c++11", "c++14", "c++17", "c++20"]),
    ];
    for (language, extension, standards) in dialects {
        let source = work().join(format!("header.{extension}"));
        fs::write(&source, "#include <embound.h>\n#include <embound.h>\nemb_status answer(void);\n").expect("a source");
        for standard in standards {
            let standard = format!("-std={standard}");
            let flags = ["-fsyntax-only", &standard, "-Wall", "-Wextra", "-Wpedantic", "-Werror"];
            let arguments: Vec<OsString> = flags.iter().map(OsString::from).chain([source.clone().into()]).collect();
            compile(language, &arguments);
        }
    }
}
