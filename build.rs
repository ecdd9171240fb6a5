// SPDX-License-Identifier: MIT OR Apache-2.0
//! Gives the shared library its SONAME, libembound.so.MAJOR.MINOR, and nothing else. A cdylib has
//! none by itself, and a program linked against it would then record the path it was built at.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    if variable("CARGO_CFG_TARGET_OS") == "linux" {
        let (major, minor) = (variable("CARGO_PKG_VERSION_MAJOR"), variable("CARGO_PKG_VERSION_MINOR"));
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libembound.so.{major}.{minor}");
    }
}
