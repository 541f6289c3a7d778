//! What is public can be printed: every type that a user can name has a `Display`, and what it says is right.

use crate::fixture::PlannedFourBar;
use crate::kinematics::Kinematics;
use crate::model::{Body, Component};
use crate::{Instant, Mechanism, Options, Signal, Subset};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Every line of the crate's own source that may be compiled into what users see.
fn lines(folder: &Path, out: &mut Vec<String>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // Presentation is no type that users hold; the tables and `private` are for generated code.
        let hidden = ["tests", "fixture", "cli", "present", "tables.rs", "tables", "private.rs"];
        if hidden.contains(&name.as_str()) {
            continue;
        }
        if path.is_dir() {
            lines(&path, out);
        } else if path.extension().is_some_and(|end| end == "rs") {
            out.extend(fs::read_to_string(&path).unwrap().lines().map(str::to_owned));
        }
    }
}

/// The identifier at the start of some text.
fn identifier(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

#[test]
fn every_public_type_displays() {
    let mut source = Vec::new();
    lines(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut source);
    let mut types = BTreeSet::new();
    let mut shown = BTreeSet::new();
    let mut hidden = false;
    for line in &source {
        // What the documentation hides is for generated code alone.
        let attribute = line == "#[doc(hidden)]" || hidden && line.starts_with("#[");
        if std::mem::replace(&mut hidden, attribute) {
            continue;
        }
        for start in ["pub struct ", "pub enum "] {
            types.extend(line.strip_prefix(start).map(identifier));
        }
        if let Some((_, of)) = line.split_once("Display for ") {
            shown.insert(identifier(of));
        }
        // `display!` of the model's texts.
        if let Some((of, _)) = line.trim_start().split_once(": |it, f|") {
            shown.insert(identifier(of));
        }
    }
    assert!(types.len() > 75, "{types:?}");
    let mute: Vec<_> = types.difference(&shown).collect();
    assert!(mute.is_empty(), "without Display: {mute:?}");
}

#[test]
fn texts_say_what_is_there() {
    let mechanism = PlannedFourBar::default();
    let state = mechanism.state_at(&Instant::at(0.0)).unwrap();
    let solver = mechanism.solver();
    let model = PlannedFourBar::model();
    assert_eq!(model.coordinates.len() + 1, state.to_string().lines().count());
    assert!(state.to_string().starts_with("t = 0\n"), "{state}");
    assert_eq!("0.500 (rate 1.000, acceleration -2.000)", format!("{:.3}", Signal::new(0.5, 1.0, -2.0)));
    assert_eq!("0.5 (rate 1, acceleration -2)", Signal { value: 0.5, rate: 1.0, acceleration: -2.0 }.to_string());
    assert_eq!("Φ, Φ_q", Subset::POSITION.to_string());
    assert_eq!("nothing", Subset::default().to_string());
    assert_eq!("body 2", Body(2).to_string());
    assert_eq!("phi", Component::Phi.to_string());
    let motion = solver.motion(&state).unwrap().to_string();
    for body in model.bodies {
        assert!(motion.contains(&format!("\nbody {}: (x, y, φ) = (", body.name)), "{motion}");
    }
    let trajectory = solver.sweep(&[0.0, 0.1, 0.2]).unwrap();
    assert!(trajectory.to_string().ends_with(": 3 states from t = 0 to t = 0.2"), "{trajectory}");
    let plan = model.plan.to_string();
    assert_eq!(model.plan.steps.len(), plan.lines().count(), "{plan}");
    assert!(plan.contains("in closed form"), "{plan}");
    // Every option is there, by the name it is set with.
    let options = Options::default();
    let (text, fields) = (options.to_string(), format!("{options:?}"));
    let names = fields.split_once("{ ").unwrap().1.split(", ").map(|field| field.split(": ").next().unwrap());
    for name in names {
        assert!(text.contains(&format!("{name} = ")), "{name} in {text}");
    }
}

/// What went wrong underneath comes as a type, down to the first cause.
#[test]
fn errors_have_sources() {
    use crate::{LengthError, PlanError, SolveError};
    use core::error::Error;
    let length = LengthError { what: "q", expected: 9, found: 8 };
    let plan = PlanError::from(length);
    let solve = SolveError::from(plan);
    let below = solve.source().expect("the plan's error");
    assert_eq!(below.downcast_ref::<PlanError>(), Some(&plan));
    assert_eq!(below.source().and_then(|error| error.downcast_ref::<LengthError>()), Some(&length));
    assert!(SolveError::from(length).source().is_some_and(|error| error.is::<LengthError>()));
    let error = PlannedFourBar::default().solver().sweep(&[0.0, f64::NAN]).unwrap_err();
    assert_eq!(error.source().and_then(|source| source.downcast_ref::<SolveError>()), Some(&error.source));
    assert!(error.source.source().is_none());
}
