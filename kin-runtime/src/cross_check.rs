//! Closed forms held against dual numbers.
//!
//! The generic Φ alone is differentiated: Φ_q column by column and Φ_t with first-order dual numbers, γ as the negative
//! second derivative of s ↦ Φ(q + s q̇, t + s) at 0 with second-order ones. Inputs move with their rates and
//! accelerations. Entries that the sparsity pattern calls zero are compared as well.

use crate::error::SolveError;
use crate::mechanism::{LengthError, Mechanism};
use crate::model::{Component, CoordinateKind, Model};
use crate::random::Random;
use crate::workspace::{Instant, Signal, Subset};
use core::fmt;
use num_dual::{Dual2_64, Dual64};

/// How a cross-check chooses its configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossCheckOptions {
    /// Number of random configurations.
    pub configurations: usize,
    /// Seed of the random numbers; the same seed gives the same configurations.
    pub seed: u64,
    /// Configurations of the caller, compared before the random ones.
    pub given: Vec<Configuration>,
    /// Also perturb the parameters, by up to ten per cent.
    pub perturb_parameters: bool,
}

impl Default for CrossCheckOptions {
    fn default() -> Self {
        Self { configurations: 32, seed: 0x6b69_6e00, given: Vec::new(), perturb_parameters: true }
    }
}

/// A configuration to compare at; it need not be assembled.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Time.
    pub t: f64,
    /// q, n numbers.
    pub q: Vec<f64>,
    /// q̇, n numbers.
    pub q_dot: Vec<f64>,
    /// The inputs; empty where the mechanism has none.
    pub inputs: Vec<Signal>,
}

/// The entry with the largest error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorstEntry {
    /// `Φ_q`, `Φ_t` or `γ`.
    pub matrix: &'static str,
    /// Row.
    pub row_name: &'static str,
    /// Column of Φ_q; empty for Φ_t and γ.
    pub column_name: &'static str,
    /// The closed form's value.
    pub closed_form: f64,
    /// The dual numbers' value.
    pub automatic: f64,
    /// The error, see [`CrossCheck::max_error`].
    pub error: f64,
    /// q of that configuration.
    pub q: Vec<f64>,
    /// q̇ of that configuration.
    pub q_dot: Vec<f64>,
    /// Time of that configuration.
    pub t: f64,
}

/// Result of a cross-check.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossCheck {
    /// Configurations compared.
    pub configurations: usize,
    /// Configurations skipped because Φ itself is not finite there.
    pub skipped: usize,
    /// Numbers compared.
    pub entries: usize,
    /// The entry with the largest error; without names where a mechanism has no rows.
    pub worst: WorstEntry,
    /// Largest error over all entries: |closed form − automatic|, relative to the largest entry of that row of Φ_q,
    /// to Φ_t, or to γ (or that row of Φ_q times the largest q̇ squared, if larger), but to no less than one. Whatever
    /// is not a number has an infinite error.
    pub max_error: f64,
}

impl CrossCheck {
    /// True when no error exceeds `tolerance`.
    pub fn passes(&self, tolerance: f64) -> bool {
        self.max_error <= tolerance
    }
}

impl fmt::Display for CrossCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} entries at {} configurations", self.entries, self.configurations)?;
        if self.skipped > 0 {
            write!(f, " ({} skipped)", self.skipped)?;
        }
        let worst = &self.worst;
        write!(f, ": worst error {:.1e} in {}[{}", worst.error, worst.matrix, worst.row_name)?;
        if !worst.column_name.is_empty() {
            write!(f, ", {}", worst.column_name)?;
        }
        write!(f, "] at t = {}: closed form {}, automatic {}", worst.t, worst.closed_form, worst.automatic)
    }
}

/// Largest perturbation of a parameter, relative.
const PERTURBATION: f64 = 0.1;

/// What differentiating Φ with dual numbers gives at one configuration.
struct Automatic {
    phi: Vec<f64>,
    /// s×n, row by row.
    phi_q: Vec<f64>,
    phi_t: Vec<f64>,
    gamma: Vec<f64>,
}

/// Compares the closed forms of `mechanism` at the configurations that `options` ask for.
///
/// `centre` is the configuration around which random ones are drawn, `length` the width of x and y.
pub(crate) fn cross_check<M: Mechanism>(
    mechanism: &M,
    options: &CrossCheckOptions,
    centre: &[f64],
    length: f64,
) -> Result<CrossCheck, SolveError> {
    let mut random = Random::new(options.seed);
    let exact = mechanism.parameters::<f64>();
    let mut comparison = Comparison::new(M::model());
    for configuration in &options.given {
        comparison.compare(mechanism, exact.as_ref(), configuration)?;
    }
    for number in 0..options.configurations {
        let configuration = random_configuration(M::model(), &mut random, number, centre, length);
        let mut parameters = exact;
        if options.perturb_parameters && number % 2 == 1 {
            for parameter in parameters.as_mut() {
                *parameter *= 1.0 + PERTURBATION * random.symmetric();
            }
        }
        comparison.compare(mechanism, parameters.as_ref(), &configuration)?;
    }
    comparison.finish()
}

/// A configuration near the centre, or a wide one, by turns.
fn random_configuration(
    model: &Model,
    random: &mut Random,
    number: usize,
    centre: &[f64],
    length: f64,
) -> Configuration {
    let width = if number % 4 < 2 { 0.2 } else { 2.0 };
    let mut draw = |k: usize| {
        let unit = match model.coordinates[k].kind {
            CoordinateKind::Pose { component: Component::X | Component::Y, .. } => length,
            _ => 1.0,
        };
        unit * random.symmetric()
    };
    let q = centre.iter().enumerate().map(|(k, c)| c + width * draw(k)).collect();
    let q_dot = (0..centre.len()).map(|k| 2.0 * draw(k)).collect();
    let mut signal = || random.symmetric();
    let inputs = model.inputs.iter().map(|_| Signal { value: signal(), rate: signal(), acceleration: signal() });
    let inputs = inputs.collect();
    Configuration { t: signal(), q, q_dot, inputs }
}

/// Φ, Φ_q, Φ_t and γ by dual numbers, from the generic Φ alone.
///
/// Rows of velocity level have no Φ to differentiate; what they have, η(q, q̇, t), will be differentiated here.
fn automatic<M: Mechanism>(mechanism: &M, parameters: &[f64], at: &Configuration) -> Result<Automatic, LengthError> {
    let n = M::COORDINATES;
    let (phi, mut phi_q) = (first::<M>(mechanism, parameters, at, None, 0.0)?.0, vec![0.0; M::ROWS * n]);
    for column in 0..n {
        let derivative = first::<M>(mechanism, parameters, at, Some(column), 0.0)?.1;
        derivative.iter().enumerate().for_each(|(row, value)| phi_q[row * n + column] = *value);
    }
    let phi_t = first::<M>(mechanism, parameters, at, None, 1.0)?.1;
    Ok(Automatic { phi, phi_q, phi_t, gamma: second(mechanism, parameters, at)? })
}

/// Φ and its derivative by one coordinate, or (with `time` = 1) by t, inputs moving with their rates.
fn first<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    at: &Configuration,
    column: Option<usize>,
    time: f64,
) -> Result<(Vec<f64>, Vec<f64>), LengthError> {
    let parameters: Vec<Dual64> = parameters.iter().map(|&p| Dual64::from_re(p)).collect();
    let q: Vec<Dual64> = at.q.iter().enumerate().map(|(k, &x)| Dual64::new(x, f64::from(column == Some(k)))).collect();
    let inputs: Vec<Signal<Dual64>> = at
        .inputs
        .iter()
        .map(|u| Signal {
            value: Dual64::new(u.value, time * u.rate),
            rate: Dual64::new(u.rate, time * u.acceleration),
            acceleration: Dual64::from_re(u.acceleration),
        })
        .collect();
    let instant = Instant { t: Dual64::new(at.t, time), inputs: &inputs };
    let rest = vec![Dual64::from_re(0.0); at.q.len()];
    let mut workspace = M::workspace::<Dual64>();
    mechanism.evaluate_with(&parameters, Subset::PHI, &instant, &q, &rest, &mut workspace)?;
    let phi: &[Dual64] = workspace.phi();
    Ok((phi.iter().map(|p| p.re).collect(), phi.iter().map(|p| p.eps).collect()))
}

/// γ = −d²/ds² Φ(q + s q̇, t + s) at s = 0, inputs moving as u + s u̇ + ½ s² ü.
fn second<M: Mechanism>(mechanism: &M, parameters: &[f64], at: &Configuration) -> Result<Vec<f64>, LengthError> {
    let constant = Dual2_64::from_re;
    let parameters: Vec<Dual2_64> = parameters.iter().map(|&p| constant(p)).collect();
    let q: Vec<Dual2_64> = at.q.iter().zip(&at.q_dot).map(|(&x, &v)| Dual2_64::new(x, v, 0.0)).collect();
    let inputs: Vec<Signal<Dual2_64>> = at
        .inputs
        .iter()
        .map(|u| Signal {
            value: Dual2_64::new(u.value, u.rate, u.acceleration),
            rate: constant(u.rate),
            acceleration: constant(u.acceleration),
        })
        .collect();
    let instant = Instant { t: Dual2_64::new(at.t, 1.0, 0.0), inputs: &inputs };
    let rest = vec![constant(0.0); q.len()];
    let mut workspace = M::workspace::<Dual2_64>();
    mechanism.evaluate_with(&parameters, Subset::PHI, &instant, &q, &rest, &mut workspace)?;
    let phi: &[Dual2_64] = workspace.phi();
    Ok(phi.iter().map(|p| -p.v2).collect())
}

/// Errors collected over configurations.
struct Comparison {
    model: &'static Model,
    result: CrossCheck,
}

impl Comparison {
    fn new(model: &'static Model) -> Self {
        let worst = WorstEntry {
            matrix: "",
            row_name: "",
            column_name: "",
            closed_form: 0.0,
            automatic: 0.0,
            error: -1.0,
            q: Vec::new(),
            q_dot: Vec::new(),
            t: 0.0,
        };
        Self { model, result: CrossCheck { configurations: 0, skipped: 0, entries: 0, worst, max_error: 0.0 } }
    }

    /// One configuration.
    fn compare<M: Mechanism>(
        &mut self,
        mechanism: &M,
        parameters: &[f64],
        at: &Configuration,
    ) -> Result<(), SolveError> {
        let dual = automatic(mechanism, parameters, at)?;
        if dual.phi.iter().any(|p| !p.is_finite()) {
            self.result.skipped += 1;
            return Ok(());
        }
        let mut workspace = M::workspace::<f64>();
        let instant = Instant { t: at.t, inputs: &at.inputs };
        mechanism.evaluate_with(parameters, Subset::ALL, &instant, &at.q, &at.q_dot, &mut workspace)?;
        self.entries(at, &dual, workspace.phi_q(), workspace.phi_t(), workspace.gamma());
        Ok(())
    }

    /// All entries of one configuration.
    fn entries(&mut self, at: &Configuration, dual: &Automatic, non_zeros: &[f64], phi_t: &[f64], gamma: &[f64]) {
        let (s, n) = (self.model.rows.len(), self.model.coordinates.len());
        let mut phi_q = vec![0.0; s * n];
        for (&(row, column), &value) in self.model.constraint_pattern.entries.iter().zip(non_zeros) {
            phi_q[row * n + column] += value;
        }
        self.result.configurations += 1;
        for (row, (closed, automatic)) in phi_q.chunks(n.max(1)).zip(dual.phi_q.chunks(n.max(1))).enumerate() {
            let size = largest(closed).max(largest(automatic));
            for (column, (&a, &b)) in closed.iter().zip(automatic).enumerate() {
                self.entry(at, "Φ_q", row, self.model.coordinates[column].name, [a, b], size);
            }
        }
        let speed = largest(&at.q_dot).powi(2).max(1.0);
        for (row, phi_q) in phi_q.chunks(n.max(1)).take(s).enumerate() {
            let curvature = largest(phi_q) * speed;
            self.entry(at, "Φ_t", row, "", [phi_t[row], dual.phi_t[row]], dual.phi_t[row].abs());
            self.entry(at, "γ", row, "", [gamma[row], dual.gamma[row]], dual.gamma[row].abs().max(curvature));
        }
    }

    /// One entry; whatever is not a number never agrees.
    fn entry(
        &mut self,
        at: &Configuration,
        matrix: &'static str,
        row: usize,
        column_name: &'static str,
        [closed_form, automatic]: [f64; 2],
        size: f64,
    ) {
        self.result.entries += 1;
        let error = (closed_form - automatic).abs() / size.max(1.0);
        let error = if error.is_finite() { error } else { f64::INFINITY };
        if error > self.result.worst.error {
            let row_name = self.model.rows.get(row).map_or("", |r| r.name);
            let (q, q_dot, t) = (at.q.clone(), at.q_dot.clone(), at.t);
            self.result.worst =
                WorstEntry { matrix, row_name, column_name, closed_form, automatic, error, q, q_dot, t };
        }
    }

    /// The result, unless nothing could be compared.
    fn finish(mut self) -> Result<CrossCheck, SolveError> {
        if self.result.configurations == 0 {
            return Err(SolveError::NothingCompared { skipped: self.result.skipped });
        }
        self.result.worst.error = self.result.worst.error.max(0.0);
        self.result.max_error = self.result.worst.error;
        Ok(self.result)
    }
}

/// Largest finite absolute value.
fn largest(values: &[f64]) -> f64 {
    values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
}
