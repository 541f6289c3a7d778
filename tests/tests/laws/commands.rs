//! All commands on the pages run successfully.

use crate::press::Press;
use kin_runtime::cli;
use kin_tests::examples;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(page: &str) -> String {
    fs::read_to_string(root().join(page)).unwrap_or_else(|error| panic!("{page}: {error}"))
}

/// The commands in a text, up to a comment or the end of the quotation.
fn commands(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let rest = &line[line.find("cargo run")?..];
        let end = [rest.find('`'), rest.find(" # ")].into_iter().flatten().min();
        Some(rest[..end.unwrap_or(rest.len())].trim_end())
    })
}

/// Runs the program with this name.
fn start(program: &str, arguments: &[String]) -> Option<ExitCode> {
    match program {
        "press" => Some(cli::run_from::<Press>(arguments)),
        example => examples::run(example, arguments),
    }
}

/// Runs a command with its result in a file of `scratch`, and returns an error text if it fails. A command without a
/// program name runs `own`.
fn run(command: &str, own: &str, scratch: &Path) -> Result<(), String> {
    let words = command.split_whitespace().skip(2);
    if let Some(word) = words.clone().find(|word| word.contains(['[', '*', '?']) && !word.starts_with('\'')) {
        return Err(format!("a shell takes {word} for a pattern"));
    }
    let mut words = words.map(|word| word.trim_matches('\'').to_owned());
    let of_cargo = words.by_ref().take_while(|word| word != "--").filter(|word| word != "--release");
    let of_cargo: Vec<String> = of_cargo.collect();
    let (program, feature) = match &of_cargo[..] {
        [] => (own, None),
        [example, name, features @ ..] if example == "--example" => match features {
            [] => (name.as_str(), None),
            [word, feature] if word == "--features" => (name.as_str(), Some(feature)),
            _ => return Err("it has more than a feature".to_owned()),
        },
        _ => return Err("it starts no example".to_owned()),
    };
    // The examples are built without diagrams and equations unless these features are requested.
    let needs = ["plot", "equations"].into_iter().find(|command| words.clone().next().as_deref() == Some(command));
    if !of_cargo.is_empty() && needs != feature.map(String::as_str) {
        return Err(format!("it needs {needs:?} and asks for the feature {feature:?}"));
    }
    let mut arguments: Vec<String> = ["program".to_owned()].into_iter().chain(words).collect();
    if arguments.len() == 1 && read(&format!("examples/{program}.rs")).contains("std::env::args()") {
        // Without arguments, the example prints its own output.
        return Ok(());
    }
    if !arguments.iter().any(|word| word == "--out") {
        arguments.extend(["--out", "result.txt"].map(str::to_owned));
    }
    let place = arguments.iter().position(|word| word == "--out").map_or(0, |place| place + 1);
    let file = scratch.join(arguments.get(place).ok_or("--out has no file")?);
    arguments[place] = file.display().to_string();
    let code = start(program, &arguments).ok_or("there is no such program")?;
    if format!("{code:?}") != format!("{:?}", ExitCode::SUCCESS) {
        return Err(format!("{code:?}"));
    }
    let written = fs::read(&file).map_err(|error| error.to_string())?;
    fs::remove_file(&file).map_err(|error| error.to_string())?;
    if written.is_empty() { Err("nothing is written".to_owned()) } else { Ok(()) }
}

/// Fails with all commands of the pages that do not work, or if there are fewer than `count` commands.
#[track_caller]
fn all_work(name: &str, pages: &[String], own: &str, count: usize) {
    let scratch = std::env::temp_dir().join(format!("kin-commands-{}-{name}", std::process::id()));
    fs::create_dir_all(&scratch).expect("a place for results");
    let (mut ran, mut wrong) = (0, Vec::new());
    for page in pages {
        for command in commands(&read(page)) {
            ran += 1;
            wrong.extend(run(command, own, &scratch).err().map(|why| format!("{page}: `{command}`: {why}")));
        }
    }
    fs::remove_dir_all(&scratch).expect("it is there");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(ran >= count, "only {ran} commands are found");
}

#[test]
fn the_commands_of_the_gallery_work() {
    all_work("gallery", &["examples/README.md".to_owned()], "", 20);
}

#[test]
fn the_commands_in_the_examples_work() {
    let files =
        fs::read_dir(root().join("examples")).expect("the examples").map(|file| file.expect("a file").file_name());
    let pages: Vec<String> = files
        .filter_map(|file| Some(format!("examples/{}", file.to_str().filter(|name| name.ends_with(".rs"))?)))
        .collect();
    for page in pages.iter().filter(|page| *page != "examples/lib.rs") {
        let own = page.replace("examples/", "cargo run --example ").replace(".rs", "");
        let (text, longer) = (read(page), format!("{own} "));
        let mut commands = commands(&text).map(|command| command.replace(" --release", "")).peekable();
        assert!(commands.peek().is_some(), "{page} shows no command");
        commands.for_each(|command| assert!(command == own || command.starts_with(&longer), "{page}: `{command}`"));
    }
    all_work("examples", &pages, "", 50);
}

/// A command without a program name belongs to the program that the page shows.
#[test]
fn the_commands_of_the_readme_and_of_the_first_chapter_work() {
    all_work("readme", &["README.md".to_owned()], "template", 2);
    all_work("start", &["kin-runtime/src/guide/start.md".to_owned()], "template", 8);
}

#[test]
fn the_commands_of_the_guide_work() {
    let mechanism = include_str!("press.rs").split_once("///").expect("its documentation").1;
    assert!(read("kin-runtime/src/guide/writing.md").contains(mechanism), "the press of the guide is another one");
    let pages = ["studies", "writing"].map(|chapter| format!("kin-runtime/src/guide/{chapter}.md"));
    all_work("guide", &pages, "press", 7);
    for chapter in ["lecture", "controller"] {
        all_work(chapter, &[format!("kin-runtime/src/guide/{chapter}.md")], "", 1);
    }
}
