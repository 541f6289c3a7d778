//! Every example in the help of every example mechanism has a good answer.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Where cargo puts the programs of this package.
fn programs() -> PathBuf {
    let own = std::env::current_exe().expect("a program has a path");
    own.ancestors().nth(2).expect("it is in deps").join("examples")
}

fn run(program: &Path, args: &[String], place: &Path) -> Output {
    let started = Command::new(program).args(args).current_dir(place).output();
    started.unwrap_or_else(|error| panic!("{}: {error}; `cargo build -p kin-examples --examples`", program.display()))
}

/// What a shell makes of a line of an example, without its comment.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for letter in line.trim().chars() {
        match letter {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(std::mem::take(&mut word)),
            other => word.push(other),
        }
    }
    words.push(word);
    // Two spaces end the command.
    let end = words.iter().position(String::is_empty).unwrap_or(words.len());
    words.truncate(end);
    words
}

/// The examples of a program that fail, and how many there are.
fn failures(name: &str, place: &Path) -> (usize, Vec<String>) {
    const COMMANDS: [&str; 15] = [
        "",
        "info",
        "solve",
        "sweep",
        "extremes",
        "forces",
        "sensitivities",
        "design",
        "modes",
        "limits",
        "check",
        "equations",
        "animate",
        "plot",
        "completions",
    ];
    let place = place.join(name);
    std::fs::create_dir_all(&place).expect("a directory");
    let program = programs().join(name);
    let (mut tried, mut failed) = (BTreeSet::new(), Vec::new());
    for command in COMMANDS {
        let mut args = vec![command.to_owned(), "--help".to_owned()];
        args.retain(|arg| !arg.is_empty());
        let help = run(&program, &args, &place);
        let help = String::from_utf8_lossy(&help.stdout).into_owned();
        // A program without a feature has no help for its command.
        let Some(examples) = help.split("\nExamples:\n").nth(1) else { continue };
        let examples = examples.split("\n\n").next().unwrap_or_default();
        let lead = format!("  {name}");
        for example in examples.lines().filter(|line| line.starts_with(&lead) && !line.contains('>')) {
            let words = words(example);
            let ran = (!tried.contains(&words)).then(|| run(&program, &words[1..], &place));
            if let Some(ran) = ran.filter(|ran| !ran.status.success()) {
                failed.push(format!("{name}: {example}\n{}", String::from_utf8_lossy(&ran.stderr)));
            }
            tried.insert(words);
        }
    }
    (tried.len(), failed)
}

#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "takes minutes without optimisation: cargo test --release -p kin-examples --test help"
)]
fn the_examples_of_every_help_run() {
    let manifest = include_str!("../Cargo.toml");
    // Those that need a feature are not built with the others.
    let parts = manifest.split("[[example]]").skip(1).filter(|part| !part.contains("required-features"));
    let names: Vec<&str> = parts.filter_map(|part| part.split('"').nth(1)).collect();
    let place = std::env::temp_dir().join(format!("kin-example-help-{}", std::process::id()));
    let (next, found) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                while let Some(name) = names.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let failures = failures(name, &place);
                    found.lock().expect("nobody panicked").push(failures);
                }
            });
        }
    });
    std::fs::remove_dir_all(place).expect("the directory goes");
    let found = found.into_inner().expect("nobody panicked");
    let tried: usize = found.iter().map(|(tried, _)| tried).sum();
    let failed: Vec<String> = found.into_iter().flat_map(|(_, failed)| failed).collect();
    assert!(failed.is_empty(), "{} of {tried}:\n{}", failed.len(), failed.join("\n"));
    assert!(tried > 10 * names.len(), "{tried} examples");
}
