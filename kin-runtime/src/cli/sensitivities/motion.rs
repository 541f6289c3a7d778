//! Derivatives along a motion, and the deviations that tolerances cause along it.

use crate::cli::engine::Engine;
use crate::cli::failure::Failure;
use crate::cli::followed::{FollowedMotion, Moved};
use crate::cli::motion_notes::note_motion;
use crate::cli::options::FreedomArgs;
use crate::cli::output::{Form, json};
use crate::cli::session::Session;
use crate::cli::solved::note_freedom;
use crate::cli::task::MotionTask;
use crate::cli::tolerance::Slopes;
use crate::measure::Measure;
use crate::model::Model;
use crate::present::grid::exact;
use crate::present::json::record;
use crate::present::number::{plain, rounded};
use crate::present::table::Table;
use crate::present::text::section;
use crate::present::units::ResultUnits;
use crate::sensitivities::Deviation;
use crate::serial::NamedValues;
use serde::Serialize;

/// Number of steps without `--steps`.
pub(super) const STEPS: usize = 180;

/// A motion along which derivatives are requested.
pub(super) struct VariedMotion<'o> {
    pub(super) task: MotionTask<'o>,
    /// The quantities; an empty list stands for the default outputs.
    pub(super) measures: Vec<Measure>,
    /// One per parameter, 0 where none is given.
    pub(super) tolerances: Vec<f64>,
    pub(super) freedom: FreedomArgs,
    pub(super) degrees: bool,
}

/// A quantity along the motion.
#[derive(Serialize)]
struct VariedQuantity {
    value: Vec<f64>,
    by: NamedValues<Vec<f64>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    deviations: Vec<Deviation>,
    #[serde(skip)]
    name: String,
}

impl VariedMotion<'_> {
    pub(super) fn run(self, engine: &dyn Engine, session: &mut Session<'_>) -> Result<(), Failure> {
        let MotionTask { requested, setup, output } = &self.task;
        let model = engine.model();
        let instants = requested.instants(engine, setup)?;
        let watch = session.watch();
        watch.begin("instants", instants.len());
        let are_named = !self.measures.is_empty();
        let measures = if self.measures.is_empty() { Measure::default_outputs(model) } else { self.measures };
        let walk = FollowedMotion {
            engine,
            setup,
            instants: &instants,
            stop_at_events: false,
            open_end: requested.is_open(),
            freedom: self.freedom,
            reported: false,
            tells_missing: are_named,
            measures: &measures,
            degrees: self.degrees,
            watch: &watch,
        };
        let moved = walk.with_states()?;
        note_motion(session, &moved, None);
        let Moved { trajectory, columns, ended, open, .. } = moved;
        note_freedom(session, open);
        let slopes = Slopes::along(engine, setup, &trajectory.states, &measures, self.degrees);
        watch.end();
        let slopes = slopes?;
        let missing = slopes.missing(&measures).join(", ");
        if are_named {
            slopes.all_exist(model, &measures)?;
        } else if !missing.is_empty() {
            session.note(&format!("note: without derivatives by dimensions: {missing}"));
        }
        let toleranced = self.tolerances.iter().any(|tolerance| *tolerance != 0.0);
        let quantity = |(k, (measure, value)): (usize, (&Measure, Vec<f64>))| {
            let parameters = model.parameters.iter().enumerate();
            let by = parameters.map(|(index, info)| (info.name, slopes.by(k, index).collect())).collect();
            let deviations = if toleranced { slopes.deviations(k, &self.tolerances) } else { Vec::new() };
            VariedQuantity { value, by, deviations, name: measure.name().to_owned() }
        };
        let quantities: Vec<VariedQuantity> = measures.iter().zip(columns).enumerate().map(quantity).collect();
        let times: Vec<f64> = trajectory.states.iter().map(|state| state.t).collect();
        let text = match output.form {
            Form::Json => {
                let quantities: NamedValues<_, _> =
                    quantities.iter().map(|quantity| (&quantity.name, quantity)).collect();
                let units = ResultUnits::of(model).in_degrees(self.degrees).record();
                json(&record! { mechanism: model.name, units: units, t: times, quantities: quantities })?
            }
            Form::Csv => csv(&times, &quantities),
            _ => text((model, self.degrees), &times, &quantities, &engine.parameters()),
        };
        session.deliver(output, &text)?;
        ended.map_or(Ok(()), Err)
    }
}

/// The index and the value of the greatest finite number.
fn greatest(numbers: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    numbers.enumerate().filter(|(_, x)| x.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// For every quantity, the parameter that matters most and when; and the largest deviations that tolerances cause.
fn text((model, degrees): (&Model, bool), times: &[f64], quantities: &[VariedQuantity], values: &[f64]) -> String {
    let [from, to] = [times.first(), times.last()].map(|t| t.copied().map_or_else(String::new, rounded));
    let when = if times.len() == 1 { format!("at t = {from}") } else { format!("from t = {from} to t = {to}") };
    let angles = if degrees { ", angles in degrees" } else { "" };
    let mut out = format!("{}, sensitivities {when}{angles}\n", model.name);
    let t = |index: usize| times.get(index).copied().map_or_else(String::new, rounded);
    // Along a motion the parameter that matters most; at one instant all that matter, in this order.
    let ranked = |quantity: &VariedQuantity| {
        let percent = |k: usize| 0.01 * values.get(k).copied().unwrap_or(0.0).abs();
        let all = quantity.by.iter().enumerate().filter_map(|(k, (name, by))| {
            let (index, slope) = greatest(by.iter().map(|by| by.abs()))?;
            (slope > 0.0).then(|| (*name, index, slope * percent(k), by[index]))
        });
        let mut all: Vec<_> = all.collect();
        // One percent of a parameter that is 0 is nothing, but the parameter may matter.
        all.sort_by(|a, b| b.2.total_cmp(&a.2).then(b.3.abs().total_cmp(&a.3.abs())));
        all.truncate(if times.len() == 1 { all.len() } else { 1 });
        all
    };
    let rows = quantities.iter().flat_map(|quantity| ranked(quantity).into_iter().map(move |most| (quantity, most)));
    let rows: Vec<_> = rows.collect();
    let table = Table::new()
        .words("quantity", rows.iter().map(|(quantity, _)| quantity.name.as_str()))
        .words("parameter", rows.iter().map(|(_, most)| most.0))
        .right("1 % moves it by", rows.iter().map(|(_, most)| rounded(most.2)))
        .right("derivative", rows.iter().map(|(_, most)| rounded(most.3)))
        .right("at t", rows.iter().map(|(_, most)| t(most.1)));
    if rows.is_empty() {
        out.push_str("\n  no parameter changes any of these quantities\n");
    }
    out += &section("Which dimension matters most, and where", &table);
    let rows: Vec<_> = quantities
        .iter()
        .filter_map(|quantity| {
            let greatest_of = |number: fn(&Deviation) -> f64| greatest(quantity.deviations.iter().map(number));
            Some((
                quantity,
                greatest_of(|deviation| deviation.worst)?,
                greatest_of(|deviation| deviation.root_sum_square)?,
            ))
        })
        .collect();
    let table = Table::new()
        .words("quantity", rows.iter().map(|(quantity, ..)| quantity.name.as_str()))
        .right("worst case", rows.iter().map(|(_, worst, _)| rounded(worst.1)))
        .right("at t", rows.iter().map(|(_, worst, _)| t(worst.0)))
        .right("root sum of squares", rows.iter().map(|(.., squares)| rounded(squares.1)))
        .right("at t", rows.iter().map(|(.., squares)| t(squares.0)));
    out + &section("Greatest deviations for these tolerances", &table)
}

/// A row per instant: t, then for every quantity its value and either its deviations by tolerances or its derivatives.
fn csv(times: &[f64], quantities: &[VariedQuantity]) -> String {
    let mut header = vec!["t".to_owned()];
    for VariedQuantity { name, by, deviations, .. } in quantities {
        header.push(name.clone());
        match deviations.is_empty() {
            true => header.extend(by.names().map(|parameter| format!("{name} by {parameter}"))),
            false => header.extend([format!("{name}_worst"), format!("{name}_root_sum_square")]),
        }
    }
    let mut out = header.join(",") + "\n";
    for (k, t) in times.iter().enumerate() {
        let mut row = vec![plain(*t)];
        for VariedQuantity { value, by, deviations, .. } in quantities {
            row.push(exact(value[k]));
            match deviations.get(k) {
                None => row.extend(by.iter().map(|(_, by)| exact(by[k]))),
                Some(deviation) => row.extend([exact(deviation.worst), exact(deviation.root_sum_square)]),
            }
        }
        out += &(row.join(",") + "\n");
    }
    out
}
