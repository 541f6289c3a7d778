//! The design of the guide, command by command.

#[path = "../../../examples/design/pusher.rs"]
#[allow(dead_code, unreachable_pub, reason = "a program of its own")]
mod pusher;

use kin_runtime::cli::run_from;
use pusher::Pusher;
use std::process::ExitCode;

const PAGE: &str = include_str!("../../../kin-runtime/src/guide/designing.md");
const START: &str = "$ cargo run --release --example pusher --features design -- ";

#[test]
fn the_commands_of_the_chapter_lead_to_a_drawing() {
    let folder = std::env::temp_dir().join(format!("kin-pusher-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let places = PAGE.split("```text\n").find(|block| block.starts_with("x,y\n")).unwrap();
    std::fs::write(folder.join("places.csv"), places.split("```").next().unwrap()).unwrap();
    let commands: Vec<&str> = PAGE.lines().filter_map(|line| line.strip_prefix(START)).collect();
    assert!(commands.len() >= 4 && PAGE.matches("cargo run").count() == commands.len(), "{commands:?}");
    // Files stand in the folder.
    let in_folder = |word: &str| {
        let word = word.trim_matches('\'');
        let file = word.rsplit(['=', '@']).next().unwrap();
        match file.rsplit_once('.').is_some_and(|(_, ending)| ["csv", "json", "svg", "txt"].contains(&ending)) {
            true => word.replace(file, &folder.join(file).to_string_lossy()),
            false => word.to_owned(),
        }
    };
    for command in commands {
        let words = ["pusher".to_owned()].into_iter().chain(command.split(' ').map(in_folder));
        assert_eq!(ExitCode::SUCCESS, run_from::<Pusher>(words), "{command}");
    }
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let best: serde_json::Value = serde_json::from_str(&read("best.json")).unwrap();
    assert!(best["error"].as_f64().unwrap() < 1e-9, "{best}");
    assert!(best["slacks"].as_array().unwrap().iter().all(|slack| slack["slack"].as_f64().unwrap() >= 0.0), "{best}");
    assert!(read("pusher.svg").starts_with("<svg"));
    assert!(read("tolerances.txt").contains("worst case"));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The page has the mechanism of the example.
#[test]
fn the_mechanism_of_the_chapter_is_the_example() {
    let example = include_str!("../../../examples/design/pusher.rs");
    for line in PAGE.lines().filter(|line| line.starts_with("#[") || line.trim_start().starts_with("#[param")) {
        assert!(example.contains(line), "{line}");
    }
}
