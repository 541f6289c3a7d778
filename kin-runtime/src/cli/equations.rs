//! `equations`: the derivation, joint by joint.

use super::engine::Engine;
use super::examples::Names;
use super::failure::{Failure, Ledger};
use super::help::Help;
use super::output::{Form, OutputArgs};
use super::session::Session;
use crate::present::equations;

/// The equations Φ, Φ_q, Φ_t and γ, joint by joint, as text, LaTeX or a page with MathML
#[derive(Clone, Debug, clap::Args)]
pub(super) struct EquationsArgs {
    /// Joints, constraints and drivers; all of them without any
    #[arg(value_name = "JOINT")]
    joints: Vec<String>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let document = |out: &str| format!("equations --out {out}");
        vec![
            Some(("equations".to_owned(), "")),
            Some((format!("equations {}", names.joints.join(" ")), "of some joints only")),
            Some((document("motion.tex"), "a LaTeX document that compiles as it is")),
            Some((document("equations.html"), "for a browser, without network access")),
            Some(("equations --format latex".to_owned(), "the inside of a document, to be included")),
        ]
    },
    details: "\
Each joint begins with its own equation, in vectors: r is the origin of a body, A its rotation,
s′ a point in its frame, index 0 the ground. Then follow its rows of Φ as they were derived, their
partial derivatives that are not 0, and γ.",
};

pub(super) fn run(args: &EquationsArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    if model.equations.is_empty() {
        let what = "its tables have no equations: it was written by hand, or compiled without the feature `equations`";
        return Err(Failure::Analysis(format!("{}: {what}", model.name)));
    }
    let names: Vec<&str> = model.joints.iter().map(|joint| joint.name).collect();
    let mut ledger = Ledger::default();
    let output = ledger.take(session.destination(&args.output, "equations"));
    let find = |name: &String| super::names::find("JOINT", super::names::Kind::Joint, name, &names);
    let chosen: Vec<usize> = args.joints.iter().filter_map(|name| ledger.take(find(name))).collect();
    let output = ledger.close(output)?;
    // A file is a document, what goes elsewhere is for one.
    let document = output.ending == Some(Form::Latex);
    let sheet = equations::sheet(model, &chosen);
    let text = match output.form {
        Form::Latex if document => sheet.latex(),
        Form::Latex => sheet.latex_fragment(),
        Form::Html => sheet.page(),
        _ => sheet.text(),
    };
    session.deliver(&output, &text)
}
