//! Every example in the help of every example mechanism has a good answer.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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

#[test]
fn the_examples_of_every_help_run() {
    let manifest = include_str!("../Cargo.toml");
    let names = manifest.split("[[example]]").skip(1).filter_map(|part| part.split('"').nth(1));
    let commands = ["", "info", "solve", "sweep", "check", "equations", "animate", "plot", "completions"];
    let place = std::env::temp_dir().join(format!("kin-example-help-{}", std::process::id()));
    std::fs::create_dir_all(&place).expect("a directory");
    let (mut tried, mut failed) = (0, Vec::new());
    for name in names {
        let program = programs().join(name);
        for command in commands {
            let mut args = vec![command.to_owned(), "--help".to_owned()];
            args.retain(|arg| !arg.is_empty());
            let help = run(&program, &args, &place);
            let help = String::from_utf8_lossy(&help.stdout).into_owned();
            // A program without a feature has no help for its command.
            let Some(examples) = help.split("\nExamples:\n").nth(1) else { continue };
            let examples = examples.split("\n\n").next().unwrap_or_default();
            let lead = format!("  {name}");
            for example in examples.lines().filter(|line| line.starts_with(&lead) && !line.contains('>')) {
                tried += 1;
                let ran = run(&program, &words(example)[1..], &place);
                if !ran.status.success() {
                    failed.push(format!("{name}: {example}\n{}", String::from_utf8_lossy(&ran.stderr)));
                }
            }
        }
    }
    std::fs::remove_dir_all(place).expect("the directory goes");
    assert!(failed.is_empty(), "{} of {tried}:\n{}", failed.len(), failed.join("\n"));
    assert!(tried > 400, "{tried} examples");
}
