//! A solved configuration.

use crate::model::Model;
use crate::workspace::{Instant, Signal};
use core::fmt;

/// Position, velocity and acceleration at one instant.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct State {
    /// Time.
    pub t: f64,
    /// The inputs, in the order of declaration.
    pub inputs: Vec<Signal>,
    /// q, n numbers; angles in radians, never wrapped.
    pub q: Vec<f64>,
    /// q̇, n numbers; the least-norm one where degrees of freedom are left.
    pub q_dot: Vec<f64>,
    /// q̈, n numbers; the least-norm one where degrees of freedom are left.
    pub q_ddot: Vec<f64>,
    /// Largest |Φ_i|, in the rows' own units.
    pub residual: f64,
    /// Iterations of the position analysis.
    pub iterations: usize,
    /// Estimated condition number of the scaled Φ_q: ‖A‖₁ ‖A⁻¹‖₁ where it is square and regular, hardly ever too small by
    /// more than a factor of three; otherwise largest over smallest pivot within the rank.
    pub condition: f64,
    /// n − rank of all rows; 0 when fully driven.
    pub degrees_of_freedom_left: usize,
}

impl State {
    /// The instant, to hand to other analyses.
    pub fn instant(&self) -> Instant<'_> {
        Instant { t: self.t, inputs: &self.inputs }
    }

    /// The state with the coordinates' names, one line each, for reading.
    pub fn display<'a>(&'a self, model: &'static Model) -> impl fmt::Display + 'a {
        Named { state: self, model }
    }
}

struct Named<'a> {
    state: &'a State,
    model: &'static Model,
}

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let state = self.state;
        let width = self.model.coordinates.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
        writeln!(f, "t = {}", state.t)?;
        for (k, coordinate) in self.model.coordinates.iter().enumerate() {
            let [q, q_dot, q_ddot] =
                [&state.q, &state.q_dot, &state.q_ddot].map(|v| v.get(k).copied().unwrap_or(f64::NAN));
            writeln!(f, "{:width$}  {q:>15.9}  {q_dot:>15.9}  {q_ddot:>15.9}", coordinate.name)?;
        }
        Ok(())
    }
}
