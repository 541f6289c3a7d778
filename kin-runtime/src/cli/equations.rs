//! `equations`: the derivation, joint by joint.

use std::path::{Path, PathBuf};

use super::engine::Engine;
use super::failure::Failure;
use super::session::Session;
use crate::present::equations;

/// The equations Φ, Φ_q, Φ_t and γ, joint by joint, as text, LaTeX or a page with MathML
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "\
Examples, after the program's name:
  equations
  equations A B                                         of some joints only
  equations --out motion.tex                            a LaTeX document that compiles as it is
  equations --format latex                              the inside of one, to be included
  equations --out equations.html                        for a browser, without network access

Each joint begins with its own equation, in vectors: r is the origin of a body, A its rotation, s′ a point in its frame,
index 0 the ground. Then follow its rows of Φ as they were derived, their partial derivatives that are not 0, and γ.")]
pub(super) struct EquationsArgs {
    /// Joints, constraints and drivers; all of them without any
    #[arg(value_name = "JOINT")]
    joints: Vec<String>,
    /// text, latex or html [default: text, or what the ending of --out says: .txt, .tex, .html]
    #[arg(long, value_name = "FORMAT", value_enum, hide_possible_values = true)]
    format: Option<Form>,
    /// Write the result to a file, whole or not at all; a .tex file is a whole document
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// How equations are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Form {
    Text,
    Latex,
    Html,
}

pub(super) fn run(args: &EquationsArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    if model.equations.is_empty() {
        let what = "its tables have no equations: it was written by hand, or compiled without the feature `equations`";
        return Err(Failure::Analysis(format!("{}: {what}", model.name)));
    }
    let names: Vec<&str> = model.joints.iter().map(|joint| joint.name).collect();
    let mut chosen = Vec::new();
    for name in &args.joints {
        chosen.push(super::names::find("JOINT", super::names::Kind::Joint, name, &names)?);
    }
    let file = args.out.as_deref().filter(|path| *path != Path::new("-"));
    let ending = file.and_then(Path::extension).and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let document = ending.as_deref() == Some("tex");
    let form = args.format.unwrap_or(match ending.as_deref() {
        Some("tex") => Form::Latex,
        Some("html" | "htm") => Form::Html,
        _ => Form::Text,
    });
    let sheet = equations::sheet(model, &chosen);
    let text = match form {
        Form::Text => sheet.text(),
        Form::Latex if document => sheet.latex(),
        Form::Latex => sheet.latex_fragment(),
        Form::Html => sheet.page(),
    };
    session.deliver_to(file, text.as_bytes())
}
