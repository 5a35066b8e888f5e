// SPDX-License-Identifier: BSD-3-Clause
//! Replays the scenarios of the folder CAIRN_CONFORMANCE by the public interface, and compares with the output of the C
//! replayer in the folder CAIRN_CONFORMANCE_OUTPUT: to the last bit, and errors with their status and text.
mod support {
    #[rustfmt::skip]
    pub mod fields;
    pub mod json;
    pub mod models;
    pub mod replay;
}
use std::fs;
use std::path::PathBuf;
use support::json::Value;
use support::replay::Replay;

#[test]
fn scenarios_give_the_same_bits_as_in_c() {
    let folders =
        ["CAIRN_CONFORMANCE", "CAIRN_CONFORMANCE_OUTPUT"].map(|name| std::env::var_os(name).map(PathBuf::from));
    let (scenarios, outputs) = match folders {
        [Some(scenarios), Some(outputs)] => (scenarios, outputs),
        _ => return println!("skipped: CAIRN_CONFORMANCE and CAIRN_CONFORMANCE_OUTPUT name no folders"),
    };
    let mut paths: Vec<PathBuf> = fs::read_dir(&scenarios).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().map_or(false, |extension| extension == "json"));
    paths.sort();
    assert!(!paths.is_empty(), "no scenarios in {}", scenarios.display());
    let (mut calls, mut errors, mut impossible, mut failures) = (0, 0, 0, 0);
    for path in &paths {
        let scenario = Value::parse(&fs::read_to_string(path).unwrap());
        let output = outputs.join(path.file_name().unwrap());
        let output = Value::parse(&fs::read_to_string(&output).unwrap());
        let (planned, expected) = (scenario.get("calls").unwrap().list(), output.get("calls").unwrap().list());
        assert_eq!(planned.len(), expected.len(), "{}", path.display());
        let mut replay = Replay::new();
        for (index, (call, expected)) in planned.iter().zip(expected).enumerate() {
            let name = call.get("call").unwrap().text();
            calls += 1;
            errors += usize::from(expected.get("status").is_some());
            match replay.call(call) {
                Some(got) if &got == expected => {}
                None if expected.get("status").is_some() => impossible += 1,
                got => {
                    println!("{}, call {index}, {name}:\n  {got:?}\n  instead of\n  {expected:?}", path.display());
                    failures += 1;
                }
            }
        }
    }
    println!("{} scenarios, {calls} calls ({errors} wrong ones, {impossible} of these do not compile)", paths.len());
    assert_eq!(failures, 0, "calls that do not give what they give in C");
}
