//! The format of a result and its target: `--format` and `--out` of every command.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::names::nearest;

/// The format of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Text,
    Json,
    Csv,
    #[cfg(feature = "equations")]
    Latex,
    Html,
    Svg,
    #[cfg(feature = "plot")]
    Png,
}

impl Form {
    const ALL: &[Self] = &[
        Self::Text,
        Self::Json,
        Self::Csv,
        #[cfg(feature = "equations")]
        Self::Latex,
        Self::Html,
        Self::Svg,
        #[cfg(feature = "plot")]
        Self::Png,
    ];

    /// Its name in `--format`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Json => "json",
            Self::Csv => "csv",
            #[cfg(feature = "equations")]
            Self::Latex => "latex",
            Self::Html => "html",
            Self::Svg => "svg",
            #[cfg(feature = "plot")]
            Self::Png => "png",
        }
    }

    /// Whether it can be read on a terminal.
    pub(super) const fn is_readable(self) -> bool {
        match self {
            Self::Text | Self::Json | Self::Csv => true,
            #[cfg(feature = "equations")]
            Self::Latex => true,
            Self::Html | Self::Svg => false,
            #[cfg(feature = "plot")]
            Self::Png => false,
        }
    }

    /// The extensions of its files, the usual one first.
    pub(super) const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Text => &["txt"],
            Self::Json => &["json"],
            Self::Csv => &["csv"],
            #[cfg(feature = "equations")]
            Self::Latex => &["tex"],
            Self::Html => &["html", "htm"],
            Self::Svg => &["svg"],
            #[cfg(feature = "plot")]
            Self::Png => &["png"],
        }
    }
}

/// The formats of every command, the default first. The report has the empty name.
const WRITERS: &[(&str, &[Form])] = &[
    ("", &[Form::Text, Form::Json]),
    ("info", &[Form::Text, Form::Json]),
    ("solve", &[Form::Text, Form::Json, Form::Csv]),
    ("forces", &[Form::Text, Form::Json, Form::Csv]),
    ("sensitivities", &[Form::Text, Form::Json, Form::Csv]),
    ("sweep", &[Form::Text, Form::Json, Form::Csv]),
    #[cfg(feature = "design")]
    ("design", &[Form::Text, Form::Json]),
    ("extremes", &[Form::Text, Form::Json, Form::Csv]),
    ("modes", &[Form::Text, Form::Json]),
    ("limits", &[Form::Text, Form::Json]),
    ("check", &[Form::Text, Form::Json]),
    #[cfg(feature = "equations")]
    ("equations", &[Form::Text, Form::Latex, Form::Html]),
    ("animate", &[Form::Html, Form::Svg]),
    #[cfg(feature = "plot")]
    ("plot", &[Form::Svg, Form::Png]),
];

/// The formats of a command.
pub(super) fn forms(command: &str) -> &'static [Form] {
    WRITERS.iter().find(|(name, _)| *name == command).map_or(&[], |(_, forms)| forms)
}

/// How results are written, and where to.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct OutputArgs {
    /// The format of the result
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    format: Option<String>,
    /// Write the result to a file, which is replaced only when complete
    #[arg(
        long,
        value_name = "FILE",
        value_hint = clap::ValueHint::FilePath,
        long_help = "\
Write the result to a file; its ending chooses the format. An existing file is
replaced only when all of the new result is written.
`-` is stdout; pipes and devices are written to directly"
    )]
    out: Option<PathBuf>,
}

/// Where the bytes of a result go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target<'p> {
    Out,
    Err,
    File(&'p Path),
}

/// The format of a result and its target.
#[derive(Clone, Debug)]
pub(super) struct Destination<'p> {
    pub(super) form: Form,
    pub(super) target: Target<'p>,
    /// The format of the extension of the file, if it has one.
    pub(super) ending: Option<Form>,
}

impl Destination<'_> {
    /// Whether it is text on stdout.
    pub(super) fn is_for_people(&self) -> bool {
        self.form == Form::Text && self.target == Target::Out
    }

    /// A note about a file with the extension of another format; `.txt` fits every format.
    pub(super) fn contradiction(&self) -> Option<String> {
        let (Target::File(path), Some(ending)) = (self.target, self.ending) else { return None };
        let differs = ending != self.form && ending != Form::Text;
        differs.then(|| {
            format!("note: {} is {}, as --format says, in spite of its name", path.display(), self.form.name())
        })
    }
}

impl OutputArgs {
    /// The format and the target of the result of `command`.
    pub(super) fn destination(&self, command: &str) -> Result<Destination<'_>, Failure> {
        let forms = forms(command);
        let target = self.out.as_deref().map_or(Target::Out, target);
        let extension = |path: &Path| path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let written = match target {
            Target::File(path) => extension(path),
            _ => None,
        };
        let form_of =
            |ending: &String| Form::ALL.iter().copied().find(|form| form.endings().contains(&ending.as_str()));
        let ending = written.as_ref().and_then(form_of);
        let destination = |form| Destination { form, target, ending };
        if let Some(name) = &self.format {
            return form_named(command, name).map(destination);
        }
        if let Some(form) = ending.filter(|form| forms.contains(form)) {
            return Ok(destination(form));
        }
        let first = forms.first().copied().unwrap_or(Form::Text);
        match target {
            Target::File(path)
                if ending.is_some() || !(is_special_file(path) || written.is_none() && first == Form::Text) =>
            {
                Err(Failure::option("--out", wrong_ending(command, path, ending)))
            }
            _ => Ok(destination(first)),
        }
    }
}

/// A file, or stdout or stderr if the path is a name of it.
fn target(path: &Path) -> Target<'_> {
    match path.to_str() {
        Some("-") => Target::Out,
        #[cfg(unix)]
        Some("/dev/stdout" | "/dev/fd/1" | "/proc/self/fd/1") => Target::Out,
        #[cfg(unix)]
        Some("/dev/stderr" | "/dev/fd/2" | "/proc/self/fd/2") => Target::Err,
        _ => Target::File(path),
    }
}

/// True for a device or a pipe, whose name needs no extension.
fn is_special_file(path: &Path) -> bool {
    path.metadata().is_ok_and(|m| !m.is_file())
}

/// The format that `--format` names.
fn form_named(command: &str, name: &str) -> Result<Form, Failure> {
    let lower = name.trim().to_lowercase();
    let known = Form::ALL.iter().copied().find(|form| form.name() == lower || form.endings().contains(&lower.as_str()));
    let writer = writer(command);
    let named: Vec<&str> = forms(command).iter().map(|form| form.name()).collect();
    match known {
        Some(form) if forms(command).contains(&form) => Ok(form),
        Some(form) => {
            let form = form.name();
            Err(Failure::option(
                "--format",
                format!("{writer} has no {form} form; write {}{}", either(&named), commands_with(form)),
            ))
        }
        None => {
            let suggestion = nearest(&lower, &named).map_or(String::new(), |near| format!(" (did you mean {near}?)"));
            Err(Failure::option(
                "--format",
                format!("`{name}` is no form{suggestion}; {writer} writes {}", either(&named)),
            ))
        }
    }
}

fn wrong_ending(command: &str, path: &Path, ending: Option<Form>) -> String {
    let endings: Vec<String> = forms(command).iter().map(|form| format!(".{}", form.endings()[0])).collect();
    let right = format!("`{}` should end in {}", path.display(), either(&endings));
    match ending {
        Some(form) => format!("{right}{}", commands_with(form.name())),
        None => format!("{right}, or --format must say what it is"),
    }
}

/// The commands that write a format.
fn commands_with(form: &str) -> String {
    let writes = |(name, forms): &&(&str, &[Form])| !name.is_empty() && forms.iter().any(|f| f.name() == form);
    let names: Vec<String> = WRITERS.iter().filter(writes).map(|(name, _)| format!("`{name}`")).collect();
    format!("; {form} is written by {}", together(&names, "and"))
}

fn writer(command: &str) -> String {
    if command.is_empty() { "the report".to_owned() } else { format!("`{command}`") }
}

/// A result as JSON, a line per value, with a final line break.
pub(super) fn json(record: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(record);
    text.map(|text| text + "\n").map_err(|error| Failure::Output(format!("cannot write JSON: {error}")))
}

/// `a, b or c`.
pub(super) fn either<S: AsRef<str>>(words: &[S]) -> String {
    together(words, "or")
}

fn together<S: AsRef<str>>(words: &[S], last: &str) -> String {
    match words {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [all @ .., end] => {
            let all: Vec<&str> = all.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", all.join(", "), end.as_ref())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn destination(command: &str, format: Option<&str>, out: Option<&str>) -> Result<(Form, bool), String> {
        let args = OutputArgs { format: format.map(str::to_owned), out: out.map(PathBuf::from) };
        let found = args.destination(command).map_err(|failure| failure.to_string())?;
        Ok((found.form, found.contradiction().is_some()))
    }

    #[test]
    fn the_ending_says_the_form_unless_format_does() {
        assert_eq!(destination("sweep", None, None), Ok((Form::Text, false)));
        assert_eq!(destination("sweep", None, Some("a.b/Motion.CSV")), Ok((Form::Csv, false)));
        assert_eq!(destination("animate", None, Some("page.htm")), Ok((Form::Html, false)));
        assert_eq!(destination("sweep", None, Some("result")), Ok((Form::Text, false)));
        assert_eq!(destination("sweep", Some("JSON"), Some("x.csv")), Ok((Form::Json, true)));
        assert_eq!(destination("sweep", Some("csv"), Some("x.txt")), Ok((Form::Csv, false)));
        assert_eq!(destination("sweep", Some("csv"), Some("x.dat")), Ok((Form::Csv, false)));
        assert_eq!(destination("animate", Some("svg"), Some("picture")), Ok((Form::Svg, false)));
        #[cfg(unix)]
        for device in ["/dev/null", "/dev/stdout", "-"] {
            assert_eq!(destination("animate", None, Some(device)), Ok((Form::Html, false)));
        }
    }

    #[test]
    fn what_no_command_writes_is_told_with_what_would_be_right() {
        let bad = |command, format, out| destination(command, format, out).err().unwrap_or_default();
        let ends = "--out: `x.dat` should end in .txt, .json or .csv, or --format must say what it is";
        assert_eq!(bad("solve", None, Some("x.dat")), ends);
        let ends = "--out: `x.svg` should end in .txt or .json; svg is written by `animate`";
        assert!(bad("info", None, Some("x.svg")).starts_with(ends));
        let ends = "--out: `picture` should end in .html or .svg, or --format must say what it is";
        assert_eq!(bad("animate", None, Some("picture")), ends);
        let none = "--format: `info` has no csv form; write text or json; csv is written by `solve`, `forces`, \
                    `sensitivities`, `sweep` and `extremes`";
        assert_eq!(bad("info", Some("csv"), None), none);
        let none = "--format: `jsno` is no form (did you mean json?); the report writes text or json";
        assert_eq!(bad("", Some("jsno"), None), none);
    }
}
