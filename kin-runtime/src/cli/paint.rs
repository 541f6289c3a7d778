//! Colours for terminals; the caller decides whether to use them.

const BOLD: &str = "\u{1b}[1m";
const HEADING: &str = "\u{1b}[1m\u{1b}[4m";
const RED: &str = "\u{1b}[1m\u{1b}[31m";
const GREEN: &str = "\u{1b}[1m\u{1b}[32m";
const YELLOW: &str = "\u{1b}[1m\u{1b}[33m";
const RESET: &str = "\u{1b}[0m";

/// A heading of the help, as clap shows it.
pub(super) fn heading(text: &str) -> String {
    format!("{HEADING}{text}{RESET}")
}

/// Text to be typed, as clap shows it.
pub(super) fn literal(text: &str) -> String {
    format!("{BOLD}{text}{RESET}")
}

/// Colours the headings of a text, which are its lines without indentation, and the words `passed` and `FAILED`.
pub(super) fn result(text: &str) -> String {
    let line = |line: &str| match line.trim_end() {
        "  passed" => format!("  {GREEN}passed{RESET}\n"),
        "  FAILED" => format!("  {RED}FAILED{RESET}\n"),
        heading if heading.starts_with(|c: char| !c.is_whitespace()) => format!("{BOLD}{heading}{RESET}\n"),
        other => format!("{other}\n"),
    };
    text.lines().map(line).collect()
}

/// Colours the first word of a message, which says how serious it is.
pub(super) fn remark(text: &str) -> String {
    let Some((kind, rest)) = text.split_once(':') else { return text.to_owned() };
    let colour = match kind {
        "error" => RED,
        "interrupted" => YELLOW,
        "note" | "event" => BOLD,
        _ => return text.to_owned(),
    };
    format!("{colour}{kind}:{RESET}{rest}")
}
