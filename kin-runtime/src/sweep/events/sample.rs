//! A condition at one instant.

use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::signal::Signal;
use crate::state::State;
use crate::workspace::Instant;

/// Largest condition number that widens what counts as rounding.
const WORST_CONDITION: f64 = 1e4;

/// What a condition number is taken for where none was computed: that of a mechanism far from singular configurations.
const USUAL_CONDITION: f64 = 100.0;

/// g at an instant with its derivatives and what rounding may make of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) t: f64,
    /// g.
    pub(crate) value: f64,
    /// ġ, 0 within rounding; not a number where g has no derivative.
    pub(crate) rate: f64,
    /// g̈, likewise.
    pub(crate) acceleration: f64,
    /// Values up to this are zero within rounding.
    pub(crate) noise: f64,
}

impl Sample {
    /// The side on which a motion that goes on in the direction of `h` finds itself: true where the condition is satisfied.
    ///
    /// At the limit that is where ġ leads, or g̈ where the motion turns there; one that stays at the limit is not satisfied.
    pub(crate) fn side_after(&self, h: f64) -> bool {
        let (rate, acceleration) = (self.rate * h.signum(), self.acceleration);
        if self.value.abs() > self.noise || rate.is_nan() || acceleration.is_nan() {
            return self.value > 0.0;
        }
        let turns = acceleration * rate < 0.0 && rate * rate <= 2.0 * acceleration.abs() * self.noise;
        if rate == 0.0 || turns { acceleration > 0.0 } else { rate > 0.0 }
    }

    /// True where an extremum of g, of which this is the best instant known, is zero within rounding.
    ///
    /// The instant is right to about `dt`, so that g here may lie ½|g̈|dt² beside its extremum. That counts where g has no
    /// rounding of its own: that of an exact square vanishes with the square.
    pub(super) fn touches(&self, dt: f64) -> bool {
        let beside = 0.5 * self.acceleration.abs() * (2.0 * dt).powi(2);
        // Without a second derivative there is only the rounding.
        self.value.abs() <= self.noise + if beside.is_finite() { beside } else { 0.0 }
    }

    /// Near enough to zero for the last digits of the configuration to matter.
    pub(crate) fn is_near(&self) -> bool {
        self.value.abs() <= 1e6 * self.noise
    }
}

/// All conditions at a state.
///
/// # Errors
/// [`NonFinite`](SolveError::NonFinite) where a condition has no value.
pub(crate) fn samples(equations: &mut Equations<'_>, state: &State) -> Result<Vec<Sample>, SolveError> {
    let model = equations.model;
    let at = Instant { t: state.t, inputs: &state.inputs };
    equations.system.observe(&at, &state.q, &state.q_dot)?;
    let parts = equations.system.observables();
    let rounding = 4.0
        * f64::EPSILON
        * (4.0 + state.condition.map_or(USUAL_CONDITION, |condition| condition.clamp(1.0, WORST_CONDITION)));
    let columns = &equations.scale.columns;
    let largest = |v: &[f64]| v.iter().zip(columns).fold(0.0, |m: f64, (v, d)| m.max((v / d).abs()));
    let (velocity, acceleration_size) = (largest(&state.q_dot), largest(&state.q_ddot));
    let mut all = Vec::with_capacity(model.conditions.len());
    for (index, condition) in model.conditions.iter().enumerate() {
        let row = condition.observable;
        let pattern = &model.observable_pattern;
        let Signal { value, rate, acceleration } = parts.rates(pattern, row, &state.q_dot, &state.q_ddot);
        finite("conditions", index, condition.name, value).map_err(|error| error.at(state.t))?;
        // Sizes of what g, ġ and g̈ are sums of: rounding is relative to these.
        let (by_time, rest) = (parts.phi_t[row], parts.gamma[row]);
        let mut sizes = [value.abs() + (by_time * state.t).abs(), by_time.abs(), rest.abs()];
        for (k, entry) in parts.gradient(pattern, row) {
            let turned = (entry * columns[k]).abs();
            sizes[0] += (entry * state.q[k]).abs() + turned;
            sizes[1] += turned * velocity;
            sizes[2] += turned * (acceleration_size + velocity * velocity);
        }
        let [noise, of_rate, of_acceleration] = sizes.map(|s| if s.is_finite() { rounding * s } else { 0.0 });
        let clear = |v: f64, noise: f64| if v.abs() <= noise { 0.0 } else { v };
        let (rate, acceleration) = (clear(rate, of_rate), clear(acceleration, of_acceleration));
        all.push(Sample { t: state.t, value, rate, acceleration, noise });
    }
    Ok(all)
}
