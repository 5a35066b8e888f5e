// SPDX-License-Identifier: BSD-3-Clause
//! Finds libcairn: in the folder CAIRN_LIBRARY_DIR, or where pkg-config says. A library of another version is refused
//! here, with both versions in the message.
use std::env;
use std::fs;
use std::path::Path;
use std::process::{exit, Command};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    for variable in ["CAIRN_LIBRARY_DIR", "PKG_CONFIG", "PKG_CONFIG_PATH", "PKG_CONFIG_LIBDIR"] {
        println!("cargo:rerun-if-env-changed={variable}");
    }
    if env::var_os("DOCS_RS").is_some() {
        return; // documentation needs no library
    }
    match env::var_os("CAIRN_LIBRARY_DIR") {
        Some(folder) => in_folder(Path::new(&folder)),
        None => by_pkg_config(),
    }
}

/// Ends the build with one line.
fn refuse(found: &str, remedy: &str) -> ! {
    let wanted = env!("CARGO_PKG_VERSION");
    eprintln!("cairn-sys {wanted} needs libcairn {}, but {found}; {remedy}", series());
    exit(1)
}

/// Major and minor version: the library's file carries both in its name, for minor versions differ in their interface.
fn series() -> String {
    format!("{}.{}", env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR"))
}

fn libraries() -> Vec<&'static str> {
    if env::var_os("CARGO_FEATURE_SIM").is_some() {
        vec!["cairn", "cairn_sim"]
    } else {
        vec!["cairn"]
    }
}

fn in_folder(folder: &Path) {
    let remedy = "set CAIRN_LIBRARY_DIR to the folder that holds the library";
    let names: Vec<String> = match fs::read_dir(folder) {
        Ok(entries) => entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect(),
        Err(error) => refuse(&format!("the folder {} cannot be read ({error})", folder.display()), remedy),
    };
    for library in libraries() {
        let numbered = format!("lib{library}.so.");
        let versions: Vec<&str> = names.iter().filter_map(|name| name.strip_prefix(&numbered)).collect();
        let has = |name: String| names.contains(&name);
        let unnumbered = ["dylib", "a", "dll.a"].iter().any(|suffix| has(format!("lib{library}.{suffix}")))
            || has(format!("{library}.lib"));
        if versions.is_empty() && !unnumbered && !has(format!("lib{library}.so")) {
            refuse(&format!("{} holds no lib{library}", folder.display()), remedy);
        }
        if !versions.is_empty() && !versions.contains(&series().as_str()) {
            let found = versions.iter().max_by_key(|version| version.len()).unwrap_or(&"");
            refuse(&format!("{} holds lib{library} {found}", folder.display()), remedy);
        }
        println!("cargo:rustc-link-lib={library}");
    }
    println!("cargo:rustc-link-search=native={}", folder.display());
}

fn by_pkg_config() {
    let program = env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".into());
    let ask = |arguments: &[&str]| -> Option<String> {
        let output = Command::new(&program).args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_string())
    };
    let remedy = "install the library with its pkg-config file, or set CAIRN_LIBRARY_DIR";
    for library in libraries() {
        let module = library.replace('_', "-");
        let version = match ask(&["--modversion", &module]) {
            Some(version) => version,
            None => refuse(&format!("{program} finds no {module}"), remedy),
        };
        if version != series() && !version.starts_with(&format!("{}.", series())) {
            refuse(&format!("{program} finds {module} {version}"), remedy);
        }
        if let Some(folder) = ask(&["--variable=libdir", &module]) {
            println!("cargo:rustc-link-search=native={folder}");
        }
        println!("cargo:rustc-link-lib={library}");
    }
}
