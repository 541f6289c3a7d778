//! `--out`: the format is chosen by the extension, and files are written completely or not at all.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{failed, good, kin};

/// A temporary directory, which is removed after the test.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("kin-files-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }

    fn file(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    fn names(&self) -> Vec<String> {
        let names = fs::read_dir(&self.0).expect("a directory").map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<String> = names.map(|name| name.to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn the_ending_says_the_form() {
    let place = Place::new("endings");
    let starts = [
        ("sweep --to 1 --steps 2", "motion.csv", "t,crank.x,"),
        ("sweep --to 1 --steps 2", "motion.JSON", "{\"mechanism\":"),
        ("sweep --to 1 --steps 2", "motion.txt", "FourbarLectureMid, 3 instants"),
        ("solve", "state.csv", "t,crank.x,"),
        ("solve", "state.json", "{\n  \"t\""),
        ("solve", "state", "FourbarLectureMid at t = 0"),
        ("info", "info.json", "{\n  \"mechanism\""),
        ("", "report.json", "{\n  \"info\""),
        ("equations", "all.tex", "\\documentclass"),
        ("equations", "all.html", "<!doctype html"),
        ("equations", "all.txt", "FourbarLectureMid"),
        ("animate --steps 5", "page.html", "<!doctype html"),
        ("animate --steps 5", "page.svg", "<svg"),
        ("plot", "plot.svg", "<svg"),
    ];
    for (command, name, start) in starts {
        assert_eq!(good(&format!("fourbar {command} --out {}", place.file(name))), "", "{command} {name}");
        let text = fs::read_to_string(place.0.join(name)).expect("a text");
        assert!(text.to_lowercase().starts_with(&start.to_lowercase()), "{name}: {}", &text[..text.len().min(80)]);
    }
    good(&format!("fourbar plot --out {}", place.file("plot.png")));
    assert!(fs::read(place.0.join("plot.png")).expect("a file").starts_with(b"\x89PNG"));
    assert_eq!(place.names().len(), starts.len() + 1, "nothing else is left: {:?}", place.names());
}

#[test]
fn format_is_right_where_the_ending_says_something_else() {
    let place = Place::new("contradiction");
    let ran = kin(&format!("fourbar solve --format json --out {}", place.file("state.csv")));
    assert_eq!(ran.status, Some(0));
    let note = "state.csv is json, as --format says, in spite of its name\n";
    assert!(ran.err.starts_with("note: ") && ran.err.ends_with(note), "{}", ran.err);
    assert!(fs::read_to_string(place.0.join("state.csv")).expect("a file").starts_with("{\n  \"t\""));
    good(&format!("fourbar solve --format csv --out {}", place.file("state.dat")));
    good(&format!("fourbar plot --format png --out {}", place.file("picture")));
    let both = ["--format: `xml` is no form; `solve` writes text, json or csv"];
    failed("fourbar solve --format xml", 2, &both);
    failed(
        &format!("fourbar sweep --to 1 --out {}", place.file("motion.xlsx")),
        2,
        &["motion.xlsx` should end in .txt, .json or .csv, or --format must say what it is"],
    );
    assert!(!place.0.join("motion.xlsx").exists());
}

#[test]
fn what_is_there_stays_when_anything_fails() {
    let place = Place::new("whole");
    let file = place.file("motion.csv");
    fs::write(&file, "old").expect("a file");
    failed(&format!("infeasible sweep --to 1 --out {file}"), 1, &["not assembled"]);
    failed(&format!("fourbar sweep --to 1 --steps 0 --out {file}"), 2, &["--steps"]);
    assert_eq!((fs::read_to_string(&file).expect("a file"), place.names()), ("old".into(), vec!["motion.csv".into()]));
    failed(&format!("fourbar solve --out {}", place.file("none/x.csv")), 1, &["--out: cannot write ", "No such file"]);
    failed(&format!("fourbar solve --format csv --out {}", place.0.display()), 1, &["it is a directory"]);
}

#[cfg(unix)]
#[test]
fn devices_and_pipes_are_written_to_directly() {
    let place = Place::new("devices");
    let line = "fourbar sweep --to 1 --steps 2 --format csv";
    let expected = good(line);
    for name in ["-", "/dev/stdout", "/dev/fd/1"] {
        assert_eq!(good(&format!("{line} --out {name}")), expected, "{name}");
    }
    let err = kin(&format!("{line} --out /dev/stderr"));
    assert_eq!((err.status, err.out.as_str(), err.err), (Some(0), "", expected.clone()));
    // A file that a shell has opened for several programs must not be replaced.
    let log = place.file("log");
    let script = format!("{{ echo first; '{}' {line} --out /dev/stdout; echo last; }} > '{log}'", several());
    assert!(Command::new("sh").args(["-c", &script]).status().expect("a shell").success());
    assert_eq!(fs::read_to_string(&log).expect("a file"), format!("first\n{expected}last\n"));
    let pipe = place.file("pipe.csv");
    if Command::new("mkfifo").arg(&pipe).status().is_ok_and(|status| status.success()) {
        let reader = Command::new("cat").arg(&pipe).stdout(Stdio::piped()).spawn().expect("a reader");
        assert_eq!(good(&format!("fourbar sweep --to 1 --steps 2 --out {pipe}")), "");
        let output = reader.wait_with_output().expect("it ends");
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected);
        assert_eq!(place.names(), ["log", "pipe.csv"]);
    }
    if Path::new("/dev/full").exists() {
        failed(&format!("{line} --out /dev/full"), 1, &["--out: cannot write /dev/full: No space left on device\n"]);
        let script = format!("'{}' {line} > /dev/full", several());
        let output = Command::new("sh").args(["-c", &script]).output().expect("a shell");
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(err, "error: cannot write to stdout: No space left on device\n");
        assert_eq!(output.status.code(), Some(1));
    }
}

fn several() -> &'static str {
    env!("CARGO_BIN_EXE_several")
}

/// A closed pipe, as in `… | head`, causes neither a message nor a panic, but an exit status for incomplete output, for
/// any command.
#[test]
fn a_reader_that_leaves_is_told_nothing_and_the_status_says_so() {
    let lines = [
        "",
        "-h",
        "info",
        "solve",
        "sweep --to 1 --steps 5000 --format csv",
        "sweep --to 1 --steps 2000 --format json",
        "check",
        "equations",
        "animate",
        "plot",
        "completions bash",
        "sweep --to 1 --steps 5000 --out -",
    ];
    for line in lines {
        // The reader is closed before anything is written.
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let child = Command::new(several())
            .arg("fourbar")
            .args(line.split_whitespace())
            .stdout(writer)
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let output = child.wait_with_output().expect("the program ends");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), said.as_str()), (Some(141), ""), "{line}");
    }
}

/// One reader reads only the first line of an output that does not fit into a pipe, another reads everything.
#[test]
fn the_status_is_0_only_when_all_was_written() {
    let sweep = "fourbar sweep --to 1 --steps 5000 --format csv";
    for (whole, status) in [(false, 141), (true, 0)] {
        let mut child = Command::new(several())
            .args(sweep.split_whitespace())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut out = BufReader::new(child.stdout.take().expect("a pipe"));
        let mut first = String::new();
        out.read_line(&mut first).expect("a line");
        assert!(first.starts_with("t,"), "{first}");
        if whole {
            assert_eq!(out.lines().count(), 5001);
        } else {
            drop(out);
        }
        let output = child.wait_with_output().expect("the program ends");
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(status), &b""[..]));
    }
}

#[test]
fn a_page_tells_an_early_end_in_one_short_sentence() {
    let file = std::env::temp_dir().join(format!("kin-early-{}.html", std::process::id()));
    let ran = kin(&format!("fourbar animate --to 2 --set l1=0.35 --out {}", file.display()));
    assert_eq!(ran.status, Some(1), "{}", ran.err);
    let page = fs::read_to_string(&file).expect("the finished part is written");
    fs::remove_file(&file).expect("it is there");
    let note = page.split("\"note\":\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a note");
    assert!(note.starts_with("The motion ends early: ") && note.ends_with('.') && note.len() < 100, "{note}");
    assert_eq!(note.matches(": ").count(), 1, "{note}");
}

/// What is wanted must be numbers, in files as elsewhere.
#[test]
fn a_file_with_numbers_that_are_not_finite_is_refused() {
    let place = Place::new("not-finite");
    let file = place.file("places.csv");
    fs::write(&file, "x,y\n0.2,0.1\n0.1,nan\n").expect("a file");
    let drawing = format!("fourbar animate --targets {file} --out {}", place.file("x.svg"));
    let wanted = format!("fourbar design --free l1=0.1..0.3 --path tip={file}");
    for line in [drawing, wanted] {
        failed(&line, 2, &["places.csv", "line 3 has NaN, which is not finite"]);
    }
    assert_eq!(["places.csv"], place.names()[..]);
    let values = place.file("values.csv");
    fs::write(&values, "rocker.phi,t\n5.1,0\n5.2,0.1\n").expect("a file");
    let wanted = format!("fourbar design --free l1=0.1..0.3 --function rocker.phi={values}");
    failed(&wanted, 2, &["values.csv", "its columns are rocker.phi,t, not t,value or t,rocker.phi"]);
    let line = "fourbar design --free l1=0.1..0.3 --peak crank.y --period=-1 --starts 0";
    failed(line, 2, &["--period: a turn takes a time that is finite and positive", "--starts: a search has at least"]);
}
