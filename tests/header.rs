// SPDX-License-Identifier: MIT OR Apache-2.0
//! The committed header is what cbindgen makes of the sources.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// The sources of the C ABI, in the header's order.
const SOURCES: [&str; 10] =
    ["constants", "error", "callback", "pool", "run", "writer", "results", "mesh", "geometry", "query"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

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

#[test]
fn the_committed_header_is_generated_from_the_sources() {
    let path = root().join("include/embound.h");
    let generated = generate();
    if env::var_os("EMBOUND_BLESS").is_some() {
        fs::write(&path, &generated).expect("include/embound.h");
    }
    assert!(
        fs::read_to_string(&path).is_ok_and(|committed| committed == generated),
        "{}: run EMBOUND_BLESS=1 cargo test --test header",
        Path::new("include/embound.h").display()
    );
}
