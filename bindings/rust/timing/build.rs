// SPDX-License-Identifier: BSD-3-Clause
//! Compiles drive.c with the compiler CC (cc if it is not set) and the headers of the project.
use std::env;
use std::path::Path;
use std::process::Command;

fn run(program: &str, arguments: &[&str]) {
    let status = Command::new(program).args(arguments).status();
    assert!(status.map_or(false, |status| status.success()), "{program} {arguments:?} failed");
}

fn main() {
    println!("cargo:rerun-if-changed=drive.c");
    let folder = env::var("OUT_DIR").unwrap();
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../include");
    let object = format!("{folder}/drive.o");
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".into());
    run(&compiler, &["-std=c99", "-O2", "-fPIC", "-I", include.to_str().unwrap(), "-c", "drive.c", "-o", &object]);
    run("ar", &["crs", &format!("{folder}/libdrive.a"), &object]);
    println!("cargo:rustc-link-search=native={folder}");
    println!("cargo:rustc-link-lib=static=drive");
}
