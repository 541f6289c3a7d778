//! Derivatives of the generic Φ by automatic differentiation with dual numbers.

use super::checked::Checked;
use super::configuration::Configuration;
use crate::mechanism::LengthError;
use crate::model::Level;
use crate::signal::{Instant, Signal};
use num_dual::{Dual2_64, Dual64};

/// Φ and its derivatives by dual numbers at one configuration.
pub(super) struct Automatic {
    pub(super) phi: Vec<f64>,
    /// s×n, stored by rows.
    pub(super) phi_q: Vec<f64>,
    pub(super) phi_t: Vec<f64>,
    pub(super) gamma: Vec<f64>,
}

/// Φ, Φ_q, Φ_t and γ by dual numbers, from the generic Φ alone. Rows of velocity level have B, b and γ from the generic
/// η in these places.
pub(super) fn automatic(
    mechanism: &dyn Checked,
    parameters: &[f64],
    at: &Configuration,
) -> Result<Automatic, LengthError> {
    let (s, n) = (mechanism.model().rows.len(), mechanism.model().coordinates.len());
    let (phi, mut phi_q) = (first(mechanism, parameters, at, None, 0.0)?.0, vec![0.0; s * n]);
    for column in 0..n {
        let derivative = first(mechanism, parameters, at, Some(column), 0.0)?.1;
        derivative.iter().enumerate().for_each(|(row, value)| phi_q[row * n + column] = *value);
    }
    let phi_t = first(mechanism, parameters, at, None, 1.0)?.1;
    let mut all = Automatic { phi, phi_q, phi_t, gamma: second(mechanism, parameters, at)? };
    velocity_level(mechanism, parameters, at, &mut all)?;
    Ok(all)
}

/// B, b and γ of the rows of velocity level from η: B column by column with dual rates, b with all rates zero, and γ as
/// the negative derivative of s ↦ η(q + s q̇, q̇, t + s) at 0.
fn velocity_level(
    mechanism: &dyn Checked,
    parameters: &[f64],
    at: &Configuration,
    all: &mut Automatic,
) -> Result<(), LengthError> {
    let rows = mechanism.model().rows.iter().enumerate().filter(|(_, info)| info.level == Level::Velocity);
    let rows: Vec<usize> = rows.map(|(row, _)| row).collect();
    if rows.is_empty() {
        return Ok(());
    }
    let n = mechanism.model().coordinates.len();
    let rest = vec![Dual64::from_re(0.0); n];
    let rates: Vec<Dual64> = at.q_dot.iter().map(|&v| Dual64::from_re(v)).collect();
    let eta_now = eta(mechanism, parameters, at, 0.0, &rates)?;
    let b = eta(mechanism, parameters, at, 0.0, &rest)?;
    let along = eta(mechanism, parameters, at, 1.0, &rates)?;
    for &row in &rows {
        all.phi[row] = eta_now[row].re;
        all.phi_t[row] = b[row].re;
        all.gamma[row] = -along[row].eps;
    }
    for column in 0..n {
        let mut rates = rates.clone();
        rates[column].eps = 1.0;
        let derivative = eta(mechanism, parameters, at, 0.0, &rates)?;
        rows.iter().for_each(|&row| all.phi_q[row * n + column] = derivative[row].eps);
    }
    Ok(())
}

/// η with its derivative in the direction of the motion, multiplied by `along`, plus that in the direction of the dual
/// parts of `rates`.
fn eta(
    mechanism: &dyn Checked,
    parameters: &[f64],
    at: &Configuration,
    along: f64,
    rates: &[Dual64],
) -> Result<Vec<Dual64>, LengthError> {
    let parameters: Vec<Dual64> = parameters.iter().map(|&p| Dual64::from_re(p)).collect();
    let q: Vec<Dual64> = at.q.iter().zip(&at.q_dot).map(|(&x, &v)| Dual64::new(x, along * v)).collect();
    let inputs: Vec<Signal<Dual64>> = at.inputs.iter().map(|u| moving(u, along)).collect();
    let instant = Instant { t: Dual64::new(at.t, along), inputs: &inputs };
    mechanism.velocity_level(&parameters, &instant, &q, rates)
}

/// An input whose value and rate change with time; `time` multiplies these derivatives.
fn moving(u: &Signal, time: f64) -> Signal<Dual64> {
    Signal {
        value: Dual64::new(u.value, time * u.rate),
        rate: Dual64::new(u.rate, time * u.acceleration),
        acceleration: Dual64::from_re(u.acceleration),
    }
}

/// Φ and its derivative with respect to one coordinate or, with `time` = 1, to t, where inputs change with their rates.
fn first(
    mechanism: &dyn Checked,
    parameters: &[f64],
    at: &Configuration,
    column: Option<usize>,
    time: f64,
) -> Result<(Vec<f64>, Vec<f64>), LengthError> {
    let parameters: Vec<Dual64> = parameters.iter().map(|&p| Dual64::from_re(p)).collect();
    let q: Vec<Dual64> = at.q.iter().enumerate().map(|(k, &x)| Dual64::new(x, f64::from(column == Some(k)))).collect();
    let inputs: Vec<Signal<Dual64>> = at.inputs.iter().map(|u| moving(u, time)).collect();
    let instant = Instant { t: Dual64::new(at.t, time), inputs: &inputs };
    let phi = mechanism.first_order(&parameters, &instant, &q)?;
    Ok((phi.iter().map(|p| p.re).collect(), phi.iter().map(|p| p.eps).collect()))
}

/// γ = −d²/ds² Φ(q + s q̇, t + s) at s = 0, where inputs change as u + s u̇ + ½ s² ü.
fn second(mechanism: &dyn Checked, parameters: &[f64], at: &Configuration) -> Result<Vec<f64>, LengthError> {
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
    let phi = mechanism.second_order(&parameters, &instant, &q)?;
    Ok(phi.iter().map(|p| -p.v2).collect())
}
