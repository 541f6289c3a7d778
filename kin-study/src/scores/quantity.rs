//! The quantities of a mechanism by name: those that kin reports, and others that a score may use.

use crate::suggest::unknown;
use kin_runtime::Measure;
use kin_runtime::measure::Source;
use kin_runtime::model::Model;

/// The suffixes of names for a value, its rate and its acceleration.
const SUFFIXES: [&str; 3] = ["", "_dot", "_ddot"];

/// A function of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Made {
    /// The value itself.
    Value,
    /// How far an angle is from π/2.
    Deviation,
}

/// A quantity, or its magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quantity {
    pub(super) source: Source,
    pub(super) made: Made,
    pub(super) magnitude: bool,
}

impl Quantity {
    /// The quantity with a name.
    pub(super) fn find(model: &'static Model, name: &str) -> Result<Self, String> {
        let (base, magnitude) = match name.strip_prefix('|').and_then(|rest| rest.strip_suffix('|')) {
            Some(inner) => (inner.trim(), true),
            None => (name, false),
        };
        let all = all(model);
        if let Some((_, source, made)) = all.iter().find(|(known, ..)| known == base) {
            return Ok(Self { source: *source, made: *made, magnitude });
        }
        match Measure::named(model, base) {
            Some(_) => Err(format!(
                "`{base}` cannot be scored: studies have no velocity ratios, and forces only if they are computed in \
                 closed form"
            )),
            None => Err(unknown("quantity", base, all.iter().map(|(name, ..)| name.as_str()))),
        }
    }
}

/// The names of all quantities of a mechanism.
pub(crate) fn names(model: &'static Model) -> Vec<String> {
    all(model).into_iter().map(|(name, ..)| name).collect()
}

/// All quantities with their names.
fn all(model: &'static Model) -> Vec<(String, Source, Made)> {
    let mut all = Vec::new();
    for measure in Measure::all(model) {
        let Some(source) = measure.source(model) else { continue };
        all.push((measure.name().to_owned(), source, Made::Value));
        if matches!(source, Source::Transmission(_)) {
            all.push((measure.name().replace(".transmission", ".deviation"), source, Made::Deviation));
        }
    }
    let mut with_rates = |name: &str, row: usize| {
        let rates = SUFFIXES.iter().enumerate();
        all.extend(
            rates.map(|(order, suffix)| (format!("{name}{suffix}"), Source::Observable { row, order }, Made::Value)),
        );
    };
    // Poses that follow from other coordinates, and the conditions that a motion is watched for.
    for body in model.bodies {
        for (k, axis) in ["x", "y", "phi"].into_iter().enumerate() {
            if body.coordinates[k].is_none() {
                with_rates(&format!("{}.{axis}", body.name), body.observables[k]);
            }
        }
    }
    for condition in model.conditions {
        with_rates(condition.name, condition.observable);
    }
    all
}
