// SPDX-License-Identifier: MIT OR Apache-2.0
//! The C and C++ compilers, and where cargo leaves the libraries.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;

/// What a source is compiled as.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Language {
    C,
    Cpp,
}

/// The repository.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Where tests may write.
pub fn work() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
}

/// Where cargo leaves the libraries: beside the test.
pub fn deps() -> PathBuf {
    let test = env::current_exe().expect("the path of this test");
    test.parent().expect("a directory").to_owned()
}

/// Runs the compiler, which must succeed, with the header's directory among its arguments.
pub fn compile(language: Language, arguments: &[OsString]) {
    let target = format!("{}-unknown-linux-gnu", env::consts::ARCH);
    let compiler = cc::Build::new()
        .cpp(language == Language::Cpp)
        .opt_level(1)
        .host(&target)
        .target(&target)
        .cargo_metadata(false)
        .no_default_flags(true)
        .get_compiler();
    let mut command = compiler.to_command();
    command.arg("-I").arg(root().join("include")).args(arguments);
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    assert!(output.status.success(), "{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
}
