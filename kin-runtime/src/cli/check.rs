//! `check`: compares the closed forms with dual numbers and the solution with the equations.

use serde::Serialize;

use super::engine::{Engine, Miss};
use super::examples::{Help, Names};
use super::failure::{Failure, Ledger};
use super::force_notes::unilateral_violations;
use super::options::{FreedomArgs, SetupArgs};
use super::output::{Form, OutputArgs, json};
use super::session::Session;
use super::setup::Setup;
use super::solved::{analysis, driven_state, note_freedom};
use super::task::{At, AtArgs};
use super::values;
use super::watch::ProgressWatch;
use crate::certificate::Uncertified;
use crate::cross_check::{Configuration, CrossCheck, CrossCheckOptions};
use crate::error::SolveError;
use crate::forces::Forces;
use crate::motion::BodyMotion;
use crate::present::certificate::{self, Certified};
use crate::present::number::{magnitude, rounded};
use crate::present::text::{Facts, count};
use crate::state::State;

/// Largest error of a closed form, relative to the size of its terms.
const CLOSED_FORM_TOLERANCE: f64 = 1e-10;
/// Largest error of the velocity and acceleration equations, relative to their terms.
const CLOSURE_TOLERANCE: f64 = 1e-9;

/// Compare the closed forms with dual numbers, and the solution with the equations
#[derive(Clone, Debug, clap::Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    at: AtArgs,
    /// Number of random configurations
    #[arg(long, value_name = "N", default_value = "100")]
    configurations: String,
    #[command(flatten)]
    freedom: FreedomArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// What a check found.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Findings {
    t: f64,
    mechanism: &'static str,
    passed: bool,
    cross_check: CrossCheck,
    /// None if there is no plan.
    plan: Option<CrossCheck>,
    /// None if the mechanism could not be solved, or inputs have no value.
    closure: Option<Closure>,
    /// The relative difference between the power of drivers, loads and dampers and the rate of the total energy; none
    /// without masses and loads, and where forces do not exist.
    power: Option<f64>,
    /// Why forces do not exist although there are masses or loads.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_forces: Option<String>,
    /// False if forces do not exist because loads act along coordinates that are open, which is no error.
    #[serde(skip)]
    held: bool,
    /// Contacts whose normal force is negative, and ropes that would have to push, in words; they are no error of the
    /// solution.
    pulling: Vec<String>,
    /// The proof that the solution exists; `None` if the mechanism could not be solved.
    #[serde(serialize_with = "proof")]
    certificate: Option<Certified>,
}

fn proof<S: serde::Serializer>(certified: &Option<Certified>, serializer: S) -> Result<S::Ok, S::Error> {
    certified.as_ref().map(certificate::record).serialize(serializer)
}

impl Findings {
    pub(super) fn passed(&self) -> bool {
        self.passed
    }
}

/// How well the solution satisfies the equations.
#[derive(Clone, Debug, Serialize)]
struct Closure {
    position: f64,
    velocity: Option<Miss>,
    acceleration: Option<Miss>,
}

pub(super) const HELP: Help = Help {
    examples: |names: &Names| {
        vec![
            names.analysis("check", ""),
            names.with("check --at 0.5 --set", &names.set, "at another instant, with a dimension of your own"),
            names.analysis("check --configurations 1000 --format json", "for another program"),
        ]
    },
    details: "\
The closed forms of Φ_q, Φ_t and γ are compared with automatic differentiation by dual numbers,
the plan with full Newton, and the power supplied with the rate of the energy. The residuals of the
solution are computed for positions, velocities and accelerations. The status is 0 only when
everything passes. Where inputs have no value (--input), no solution is checked; where the drivers
leave degrees of freedom open, it is that of least norm. With masses, a note names contacts whose
normal force is negative, and ropes that would have to push.",
};

pub(super) fn run(args: &CheckArgs, engine: &mut dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let at = args.at.read(&mut ledger, ("check", &args.output), SetupArgs::apply, engine, session);
    let configurations = ledger.take(values::configurations(&args.configurations));
    let (At { t, setup, output }, configurations) = ledger.close(at.zip(configurations))?;
    let engine = &*engine;
    // The closed forms can be checked without values of inputs; a solution needs them.
    let solved = match setup.missing_inputs.as_slice() {
        // Open degrees of freedom are no error here: the answer of least norm satisfies the same equations.
        [] => driven_state(engine, &setup, t, true).map(|(state, _)| Some(state)),
        missing => {
            let missing = missing.join(", ");
            session.note(&format!("note: no solution is checked: inputs without a value: {missing}"));
            Ok(None)
        }
    };
    let state = solved.as_ref().ok().and_then(Option::as_ref);
    note_freedom(session, state.map_or(0, |state| state.degrees_of_freedom_left));
    let findings = match find(engine, &setup, t, state, configurations, &session.watch()) {
        // There is nothing to compare, because there is no solution.
        Err(_) if configurations == 0 && solved.is_err() => return solved.map(|_| ()),
        found => found?,
    };
    let text = match output.form {
        Form::Json => json(&Findings { passed: findings.passed && solved.is_ok(), ..findings.clone() })?,
        _ => {
            let heading = format!("{}, check at t = {}\n\n", engine.model().name, rounded(t));
            let verdict = if solved.is_ok() && findings.passed { "passed" } else { "FAILED" };
            format!("{heading}{}\n  {verdict}\n", facts(&findings).render())
        }
    };
    if let Some(why) = findings.no_forces.as_ref().filter(|_| !findings.held) {
        session.note(&format!("note: forces are not checked: {why}"));
    }
    findings.pulling.iter().for_each(|contact| session.note(&format!("note: {contact}")));
    session.deliver(&output, &text)?;
    solved?;
    if findings.passed { Ok(()) } else { Err(Failure::Analysis(complaint(&findings))) }
}

/// Compares at the solved configuration, if there is one, and at random ones.
pub(super) fn find(
    engine: &dyn Engine,
    setup: &Setup,
    t: f64,
    state: Option<&State>,
    configurations: usize,
    watch: &ProgressWatch,
) -> Result<Findings, Failure> {
    let say = |error| match error {
        SolveError::Stopped { done, total, .. } => {
            Failure::Interrupted(format!("{done} of {} of one check compared", count(total, "configuration")))
        }
        error => analysis(engine, &error),
    };
    let configuration =
        |s: &State| Configuration { t, q: s.q.clone(), q_dot: s.q_dot.clone(), inputs: s.inputs.clone() };
    let given = state.map(configuration).into_iter().collect();
    let options = CrossCheckOptions { configurations, given, ..CrossCheckOptions::default() };
    // Both checks go through all configurations.
    let all = options.given.len() + configurations;
    let checks = if engine.model().plan.exists() { 2 } else { 1 };
    watch.begin("configurations", checks * all);
    let cross_check = engine.cross_check(&options, &|reached| watch.observe(reached)).map_err(say)?;
    watch.go_on(all);
    let plan = engine.plan_check(&options, &|reached| watch.observe(reached)).map_err(say)?;
    watch.end();
    let closure = match state {
        None => None,
        Some(state) => {
            let [velocity, acceleration] = engine.misses(state).map_err(say)?;
            Some(Closure { position: state.residual, velocity, acceleration })
        }
    };
    let close = |m: &Option<Miss>| m.is_none_or(|m| m.error <= CLOSURE_TOLERANCE);
    let closed = closure.as_ref().is_none_or(|c| close(&c.velocity) && close(&c.acceleration));
    let planned = plan.as_ref().is_none_or(|plan| plan.max_error <= CLOSURE_TOLERANCE);
    let has_loads = engine.model().forces.is_some();
    let found = state.filter(|_| has_loads).map(|state| engine.forces(setup, state)).transpose();
    let held = !matches!(found, Err(SolveError::NotHeld { .. }));
    let no_forces = found.as_ref().err().map(ToString::to_string);
    let forces = found.ok().flatten();
    let power = forces.as_ref().zip(state).map(|(forces, state)| forces.power_miss_above(power_within(forces, state)));
    let pulling = forces.as_ref().map(unilateral_violations).unwrap_or_default();
    let balanced = power.is_none_or(|miss| miss <= CLOSURE_TOLERANCE);
    let certificate = state.map(|state| engine.certify(setup, state));
    // A missing certificate is a failure only if the reason is that the state is not a solution.
    let solution = !matches!(certificate, Some(Err(Uncertified::NotASolution { .. } | Uncertified::Violated { .. })));
    let loaded = no_forces.is_none() || !held;
    let passed = closed && planned && balanced && loaded && solution && cross_check.passes(CLOSED_FORM_TOLERANCE);
    let mechanism = engine.model().name;
    Ok(Findings { t, mechanism, passed, cross_check, plan, closure, power, no_forces, held, pulling, certificate })
}

/// The power that flows to and fro within the mechanism, also where its powers add up to 0: the kinetic energy times the
/// fastest relative rate of a body.
fn power_within(forces: &Forces, state: &State) -> f64 {
    let largest = |number: &dyn Fn(&BodyMotion) -> f64| state.bodies.iter().map(number).fold(0.0, f64::max);
    let turns = largest(&|body| body.phi_dot.abs());
    let [size, speed] = [largest(&|body| body.x.hypot(body.y)), largest(&|body| body.x_dot.hypot(body.y_dot))];
    forces.kinetic * if size > 0.0 { turns.max(speed / size) } else { turns }
}

/// The findings, line by line.
pub(super) fn facts(findings: &Findings) -> Facts {
    let mut facts = Facts::default();
    let check = &findings.cross_check;
    let skipped = (check.skipped > 0).then(|| format!("{} skipped where Φ has no value", check.skipped));
    let compared = format!("entries of Φ_q, Φ_t, γ at {}", count(check.configurations, "configuration"));
    facts.add("compared with dual numbers", check.entries, std::iter::once(compared).chain(skipped));
    let worst = &check.worst;
    let column = if worst.column_name.is_empty() { String::new() } else { format!(", {}", worst.column_name) };
    let place = (!worst.row_name.is_empty()).then(|| format!("{}[{}{column}]", worst.matrix, worst.row_name));
    facts.add("  worst error", magnitude(check.max_error), place);
    if let Some(function) = check.worst_function() {
        let arguments = check.functions.iter().map(|f| f.arguments).sum::<usize>();
        let place = (function.error > 0.0).then(|| format!("{} of `{}`", function.derivative, function.function));
        facts.add("supplied functions by differences", arguments, ["arguments"]).add(
            "  worst error",
            magnitude(function.error),
            place,
        );
    }
    if let Some(plan) = &findings.plan {
        add_plan(&mut facts, plan);
    }
    if let Some(closure) = &findings.closure {
        let row = |miss: &Option<Miss>| miss.map(|m| format!("row {}", m.row));
        let size = |miss: &Option<Miss>| magnitude(miss.map_or(0.0, |m| m.error));
        facts
            .add("solution", "", [""])
            .add("  position Φ = 0", magnitude(closure.position), ["largest |Φ|"])
            .add("  velocity Φ_q q̇ = −Φ_t", size(&closure.velocity), row(&closure.velocity))
            .add("  acceleration Φ_q q̈ = γ", size(&closure.acceleration), row(&closure.acceleration));
    }
    if let Some(certified) = &findings.certificate {
        let words = certificate::words(certified);
        facts.add("  certificate", "", words.split(", "));
    }
    if let Some(power) = findings.power {
        facts.add("forces", "", [""]).add("  power balance", magnitude(power), ["of the rate of the energy"]);
    }
    if findings.no_forces.is_some() {
        facts.add("forces", "none", ["not checked"]);
    }
    facts
}

/// How well the plan agrees with full Newton. If it has no answer, the text says so instead of showing an error of 0.
fn add_plan(facts: &mut Facts, plan: &CrossCheck) {
    let label = "compared with full Newton";
    if plan.configurations == 0 {
        let words = ["all configurations are at or beyond limits of the plan", "where full Newton solves"];
        facts.add(label, "nothing", words);
        return;
    }
    let skipped = (plan.skipped > 0).then(|| format!("{} skipped beside or beyond limits", plan.skipped));
    let solved = format!("of the plan's q, q̇, q̈ at {}", count(plan.configurations, "configuration"));
    let place = (!plan.worst.row_name.is_empty()).then(|| format!("{} of {}", plan.worst.matrix, plan.worst.row_name));
    facts.add(label, plan.entries, std::iter::once(solved).chain(skipped)).add(
        "  worst error",
        magnitude(plan.max_error),
        place,
    );
}

fn complaint(findings: &Findings) -> String {
    let check = &findings.cross_check;
    if let Some(Err(wrong @ (Uncertified::NotASolution { .. } | Uncertified::Violated { .. }))) = &findings.certificate
    {
        return format!("not certified: {wrong}");
    }
    if let Some(why) = findings.no_forces.as_ref().filter(|_| findings.held) {
        return format!("there are no forces: {why}");
    }
    if let Some(miss) = findings.power.filter(|miss| *miss > CLOSURE_TOLERANCE) {
        return format!(
            "the power of drivers, loads and dampers differs from the rate of the energy by {miss:.1e} of it"
        );
    }
    if let Some(plan) = findings.plan.as_ref().filter(|plan| plan.max_error > CLOSURE_TOLERANCE) {
        return format!("the plan's answer differs by more than {CLOSURE_TOLERANCE:e}: {plan}");
    }
    if check.passes(CLOSED_FORM_TOLERANCE) {
        return format!("the relative residual of a row, at the solution, is above {CLOSURE_TOLERANCE:e}");
    }
    if check.max_error > CLOSED_FORM_TOLERANCE {
        return format!("a closed form differs from the dual numbers by more than {CLOSED_FORM_TOLERANCE:e}: {check}");
    }
    let wrong = check.worst_function().map(ToString::to_string).unwrap_or_default();
    format!("the derivatives of a supplied function differ from its difference quotients: {wrong}")
}
