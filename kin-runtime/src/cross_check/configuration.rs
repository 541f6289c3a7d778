//! The configurations of a cross-check: those of the caller, and random ones.

use crate::model::{Component, CoordinateKind, Model};
use crate::random::Random;
use crate::signal::{Instant, Signal};
use crate::text::numbers;
use core::fmt;

/// Options of a cross-check: which configurations are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossCheckOptions {
    /// Number of random configurations.
    pub configurations: usize,
    /// The seed of the random numbers; the same seed gives the same configurations.
    pub seed: u64,
    /// Configurations given by the caller, which are compared before the random ones.
    pub given: Vec<Configuration>,
    /// Whether the parameters are also perturbed, by up to ten per cent.
    pub perturb_parameters: bool,
}

impl Default for CrossCheckOptions {
    fn default() -> Self {
        Self { configurations: 32, seed: 0x6b69_6e00, given: Vec::new(), perturb_parameters: true }
    }
}

/// A configuration at which closed forms are compared; it need not satisfy Φ = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The time.
    pub t: f64,
    /// The n coordinates q.
    pub q: Vec<f64>,
    /// The n velocities q̇.
    pub q_dot: Vec<f64>,
    /// The inputs; empty for a mechanism without inputs.
    pub inputs: Vec<Signal>,
}

/// What random configurations are drawn around.
#[derive(Clone, Debug)]
pub(crate) struct Centre {
    /// The coordinates.
    pub(crate) q: Vec<f64>,
    /// The values of inputs.
    pub(crate) inputs: Vec<f64>,
    /// How far x and y spread.
    pub(crate) length: f64,
}

/// A random configuration: numbers 0 and 1 of every four are near the centre, the other two are spread widely. Inputs
/// are spread less, because a mechanism does not close with a length that is far from its usual value.
pub(super) fn random_configuration(
    model: &Model,
    random: &mut Random,
    number: usize,
    Centre { q: centre, inputs, length }: &Centre,
) -> Configuration {
    let (width, share) = if number % 4 < 2 { (0.2, 0.02) } else { (2.0, 0.2) };
    let mut draw = |k: usize| {
        let unit = match model.coordinates[k].kind {
            CoordinateKind::Pose { component: Component::X | Component::Y, .. } => *length,
            _ => 1.0,
        };
        unit * random.symmetric()
    };
    let q = centre.iter().enumerate().map(|(k, c)| c + width * draw(k)).collect();
    let q_dot = (0..centre.len()).map(|k| 2.0 * draw(k)).collect();
    let mut signal = || random.symmetric();
    let spread = |u: f64| if u == 0.0 { 1.0 } else { share * u.abs() };
    let inputs = inputs.iter().map(|&u| {
        let [value, rate, acceleration] = [(); 3].map(|()| signal());
        Signal { value: u + spread(u) * value, rate, acceleration }
    });
    let inputs = inputs.collect();
    Configuration { t: signal(), q, q_dot, inputs }
}

/// t, q, q̇ and the inputs.
impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, q = ", Instant { t: self.t, inputs: &self.inputs })?;
        numbers(f, &self.q)?;
        f.write_str(", q̇ = ")?;
        numbers(f, &self.q_dot)
    }
}

/// The numbers of configurations and the seed.
impl fmt::Display for CrossCheckOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} given and {} random configurations, seed {}", self.given.len(), self.configurations, self.seed)?;
        f.write_str(if self.perturb_parameters { ", parameters perturbed" } else { "" })
    }
}
