//! `equations`: the derivation, joint by joint.

use super::engine::Engine;
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::names::{NameKind, find};
use super::output::{Form, OutputArgs};
use super::session::Session;
use crate::present::equations::{self, SheetPart};

/// Φ, Φ_q, Φ_t and γ joint by joint, and how they are solved: text, LaTeX, MathML
#[derive(Clone, Debug, clap::Args)]
pub(super) struct EquationsArgs {
    /// Joints, constraints and drivers [default: all]
    #[arg(value_name = "JOINT")]
    joints: Vec<String>,
    /// rows (of Φ), matrices or solution (steps of the plan) [default: all]
    #[arg(long, value_name = "PART", value_enum, hide_possible_values = true)]
    part: Option<ChosenPart>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        let document = |out: &str| format!("equations --out {out}");
        vec![
            Some(("equations".to_owned(), "")),
            Some((format!("equations {}", names.joints.join(" ")), "of some joints only")),
            Some(("equations --part matrices".to_owned(), "Φ, Φ_q, Φ_t and γ of the whole mechanism")),
            Some(("equations --part solution".to_owned(), "how they are solved, step by step")),
            Some((document("motion.tex"), "a LaTeX document that compiles as it is")),
            Some((document("equations.html"), "for a browser, without network access")),
            Some(("equations --format latex".to_owned(), "the inside of a document, to be included")),
        ]
    },
    details: "\
Each joint begins with its own equation, in vectors: r is the origin of a body, A its rotation,
s′ a point in its frame, index 0 the ground. Then follow its rows of Φ as they were derived, their
partial derivatives that are not 0, and γ. After the joints stand Φ, Φ_q, Φ_t and γ of the whole
mechanism as matrices, up to 24 coordinates; --part matrices writes them at any size.
The solution plan comes last: the formulas of each step for q, q̇ and q̈, in which coordinates of
earlier steps are known. σ is the sign of an assembly mode; of the values of an angle that differ
by 2π the one nearest to the last position is taken.
A mechanism with masses or loads has M and Q of M q̈ + Φ_qᵀ λ = Q at the end.",
};

/// The part of the derivation that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum ChosenPart {
    Rows,
    Matrices,
    Solution,
}

pub(super) fn run(args: &EquationsArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let model = engine.model();
    if model.equations.is_empty() {
        let message =
            "its tables have no equations: it was written by hand, or compiled without the feature `equations`";
        return Err(Failure::Analysis(format!("{}: {message}", model.name)));
    }
    let mut ledger = Ledger::default();
    let output = ledger.take(session.destination(&args.output, "equations"));
    let chosen: Vec<usize> =
        args.joints.iter().filter_map(|name| ledger.take(find(model, "JOINT", NameKind::Joint, name))).collect();
    if args.part == Some(ChosenPart::Matrices) && !args.joints.is_empty() {
        ledger.fault("--part matrices", "they are of all joints; leave out JOINT");
    }
    let output = ledger.close(output)?;
    // A .tex file is a complete document; other output is a fragment to be included in one.
    let document = output.ending == Some(Form::Latex);
    let part = match args.part {
        None => SheetPart::All,
        Some(ChosenPart::Rows) => SheetPart::Rows,
        Some(ChosenPart::Matrices) => SheetPart::Matrices,
        Some(ChosenPart::Solution) => SheetPart::Solution,
    };
    let sheet = equations::sheet(model, &chosen, part);
    let text = match output.form {
        Form::Latex if document => sheet.latex(),
        Form::Latex => sheet.latex_fragment(),
        Form::Html => sheet.page(),
        _ => sheet.text(),
    };
    session.deliver(&output, &text)
}
