//! The README's first output is what its first command prints.

use std::process::ExitCode;

#[allow(dead_code, unreachable_pub, reason = "a program of its own, read as a module")]
#[path = "../../examples/four_bar.rs"]
mod four_bar;

/// The first code block of the README, without the command.
fn first_output() -> String {
    let readme = include_str!("../../README.md");
    let block = readme.split("```console\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let (command, output) = block.split_once('\n').unwrap();
    assert_eq!(command, "$ cargo run --release --example four_bar");
    output.trim_end().to_owned()
}

#[test]
fn the_first_command_prints_what_the_readme_shows() {
    let path = std::env::temp_dir().join(format!("kin-readme-{}.txt", std::process::id()));
    let arguments = ["four_bar".into(), "--out".into(), path.clone().into_os_string()];
    let code = kin_runtime::cli::run_from::<four_bar::FourBar>(arguments);
    assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS));
    let printed = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    // The last digits of rounding errors are the machine's own.
    let comparable = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.contains("e-1")).map(|line| line.trim_end().to_owned()).collect()
    };
    assert_eq!(comparable(&first_output()), comparable(printed.trim_end()));
}
