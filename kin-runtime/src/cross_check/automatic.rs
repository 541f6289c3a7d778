//! Derivatives of the generic Φ by dual numbers.

use super::Configuration;
use crate::mechanism::{LengthError, Mechanism};
use crate::workspace::{Array, Instant, Signal};
use num_dual::{Dual2_64, Dual64};

/// What differentiating Φ with dual numbers gives at one configuration.
pub(super) struct Automatic {
    pub(super) phi: Vec<f64>,
    /// s×n, row by row.
    pub(super) phi_q: Vec<f64>,
    pub(super) phi_t: Vec<f64>,
    pub(super) gamma: Vec<f64>,
}

/// Φ, Φ_q, Φ_t and γ by dual numbers, from the generic Φ alone.
///
/// Rows of velocity level have no Φ to differentiate; what they have, η(q, q̇, t), will be differentiated here.
pub(super) fn automatic<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    at: &Configuration,
) -> Result<Automatic, LengthError> {
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
    let mut phi = M::Rows::<Dual64>::generate(|_| Dual64::from_re(0.0));
    mechanism.constraints_with(&parameters, &instant, &q, &mut phi)?;
    let phi = phi.as_ref();
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
    let mut phi = M::Rows::<Dual2_64>::generate(|_| constant(0.0));
    mechanism.constraints_with(&parameters, &instant, &q, &mut phi)?;
    Ok(phi.as_ref().iter().map(|p| -p.v2).collect())
}
