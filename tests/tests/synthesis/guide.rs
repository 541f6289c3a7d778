//! The search for dimensions in the guide, command by command.

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
        // Without optimisation a start takes seconds; the first six lead to a design without misses, too.
        let command =
            if cfg!(debug_assertions) { command.replace("--starts 20", "--starts 6") } else { command.into() };
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

#[test]
fn drivers_quantities_and_columns_are_taken_by_their_names() {
    let folder = std::env::temp_dir().join(format!("kin-pusher-options-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
        folder.join(name).to_string_lossy().into_owned()
    };
    let places = file("places.csv", "t,pad.x,pad.y\n0,80,-40\n0.2,78,-35\n");
    let wrong = file("wrong.csv", "x,z\n0,1\n");
    let out = folder.join("best.txt").to_string_lossy().into_owned();
    let run = |path: &str, options: &[&str]| {
        let path = format!("pad={path}");
        let common = ["pusher", "design", "--path", &path, "--free", "u,v", "--starts", "2", "--out", &out];
        run_from::<Pusher>([&common[..], options].concat())
    };
    let found = |options: &[&str]| {
        assert_eq!(ExitCode::SUCCESS, run(&places, options), "{options:?}");
        std::fs::read_to_string(&out).unwrap()
    };
    let text = found(&["--turns", "drive", "--range", "B.transmission=10deg..170deg"]);
    assert!(text.contains("turns with margins above 0.01") && text.contains("B.transmission in 10°..170°"), "{text}");
    assert!(text.contains("mm") && text.contains("40 to 160"), "{text}");
    found(&["--turns"]);
    assert_ne!(ExitCode::SUCCESS, run(&places, &["--turns", "drvie"]));
    assert_ne!(ExitCode::SUCCESS, run(&places, &["--grashof", "r,l,c,r", "--shortest", "frame"]));
    assert_ne!(ExitCode::SUCCESS, run(&wrong, &[]));
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
