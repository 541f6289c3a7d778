//! Output that appears on terminals only: colours, and a progress bar for commands of more than a second.
//!
//! The tests create a pseudo-terminal by `script` of util-linux; without it they report that they are skipped.

use std::io::{Read, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const ESCAPE: char = '\u{1b}';

/// The command that runs the program on a pseudo-terminal.
fn on_a_terminal(line: &str) -> Option<Command> {
    let version = Command::new("script").arg("--version").output();
    if !version.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("util-linux")) {
        eprintln!("skipped: there is no `script` of util-linux to make a terminal");
        return None;
    }
    let mut command = Command::new("script");
    let inside = format!("'{}' {line}", env!("CARGO_BIN_EXE_several"));
    command.args(["--quiet", "--return", "--command", &inside, "/dev/null"]);
    command.env("TERM", "xterm-256color").env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").env_remove("CLICOLOR");
    Some(command)
}

fn seen(line: &str, variables: &[(&str, &str)]) -> Option<String> {
    let mut command = on_a_terminal(line)?;
    let output = command.envs(variables.iter().copied()).stdin(Stdio::null()).output().expect("it starts");
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn colours_are_for_terminals() {
    let Some(solved) = seen("fourbar solve", &[]) else { return };
    assert!(solved.contains("\u{1b}[1mFourbarLectureMid at t = 0\u{1b}[0m"), "{solved:?}");
    assert!(seen("fourbar check", &[]).is_some_and(|text| text.contains("\u{1b}[32mpassed")));
    assert!(seen("fourbar -h", &[]).is_some_and(|text| text.contains("\u{1b}[4mExamples:")));
    assert!(
        seen("fourbar solve --at x", &[]).is_some_and(|text| text.starts_with("\u{1b}[1m\u{1b}[31merror:\u{1b}[0m "))
    );
    for line in ["fourbar solve", "fourbar check", "fourbar -h", "fourbar solve --at x", "fourbar sole"] {
        let plain = seen(line, &[("NO_COLOR", "1")]).unwrap_or_default();
        assert!(!plain.is_empty() && !plain.contains(ESCAPE), "{line}: {plain:?}");
    }
    let json = seen("fourbar solve --format json", &[]).unwrap_or_default();
    assert!(!json.contains(ESCAPE), "what programs read has no colours: {json:?}");
}

#[test]
fn pictures_are_nothing_for_a_terminal() {
    for (line, ending) in [("animate", "html"), ("plot --format png", "png"), ("equations --format html", "html")] {
        let Some(text) = seen(&format!("fourbar {line}"), &[("NO_COLOR", "1")]) else { return };
        let expected = format!("error: --out: {ending} is not shown on a terminal; write --out FILE.{ending}, or pipe");
        assert!(text.starts_with(&expected) && text.lines().count() == 1, "{line}: {text}");
    }
}

#[test]
fn colours_can_be_forced_into_a_pipe() {
    let run = |force: Option<&str>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_several"));
        command.args(["fourbar", "info"]).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        let output = command.envs(force.map(|value| ("CLICOLOR_FORCE", value))).output().expect("the program starts");
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    assert!(!run(None).contains(ESCAPE) && run(Some("1")).contains("\u{1b}[1mFourbarLectureMid"));
}

#[test]
fn what_takes_long_has_a_bar_until_ctrl_c() {
    let line = "fourbar sweep --to 10000 --steps 1000000 --out /dev/null";
    let Some(mut command) = on_a_terminal(line) else { return };
    let began = Instant::now();
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it starts");
    let (mut keys, mut screen) = (child.stdin.take().expect("stdin"), child.stdout.take().expect("stdout"));
    let (mut text, mut buffer) = (Vec::new(), [0; 4096]);
    let mut first = None;
    loop {
        let count = screen.read(&mut buffer).expect("a terminal");
        text.extend_from_slice(&buffer[..count]);
        first = first.or_else(|| (count > 0).then(|| began.elapsed()));
        let drawn = String::from_utf8_lossy(&text).into_owned();
        if drawn.matches(" left").count() >= 2 {
            break;
        }
        assert!(count > 0, "it ends without a bar: {drawn:?}");
    }
    assert!(first.is_some_and(|first| first >= Duration::from_secs(1)), "too early: {first:?}");
    let drawn = String::from_utf8_lossy(&text).into_owned();
    assert!(drawn.contains(" of 1 000 001 instants, ") && drawn.contains("/s, "), "{drawn:?}");
    keys.write_all(b"\x03").expect("a key");
    screen.read_to_end(&mut text).expect("a terminal");
    let end = String::from_utf8_lossy(&text).into_owned();
    let last = end.rsplit('\r').find(|line| line.contains("instants finished")).unwrap_or_default();
    assert!(last.contains("interrupted:"), "{end:?}");
    assert_eq!(child.wait().expect("it ends").code(), Some(130), "{end:?}");
}

#[test]
fn what_is_quick_has_no_bar() {
    let Some(text) = seen("fourbar sweep --to 1 --format csv", &[]) else { return };
    assert!(text.starts_with("t,crank.x") && !text.contains(ESCAPE) && !text.contains(" left"), "{text:?}");
}
