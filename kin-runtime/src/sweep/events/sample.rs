//! The value of a condition at one instant.

use crate::equations::{Equations, finite};
use crate::error::SolveError;
use crate::signal::{Instant, Signal};
use crate::state::State;

/// Largest condition number that enters the estimate of the rounding error.
const WORST_CONDITION: f64 = 1e4;

/// The condition number assumed where none was computed: that of a mechanism far from singular configurations.
const USUAL_CONDITION: f64 = 100.0;

/// Factor of the width to which events are located: several of them may belong to one instant.
const AT_EVENT: f64 = 2.0;

/// g at an instant with its derivatives and an estimate of its rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) t: f64,
    /// g.
    pub(crate) value: f64,
    /// ġ, set to 0 within rounding; NaN where g has no derivative.
    pub(crate) rate: f64,
    /// g̈, set to 0 within rounding; NaN where g has no second derivative.
    pub(crate) acceleration: f64,
    /// Rounding error of g: smaller values count as zero.
    pub(crate) noise: f64,
}

impl Sample {
    /// The side of the limit on which the motion continues in the direction of `h`: true where the condition is
    /// satisfied.
    ///
    /// At the limit the sign of ġ decides, or the sign of g̈ where ġ = 0; a motion that stays at the limit does not
    /// satisfy the condition.
    pub(crate) fn side_after(&self, h: f64) -> bool {
        let (rate, acceleration) = (self.rate * h.signum(), self.acceleration);
        if self.value.abs() > self.noise || rate.is_nan() || acceleration.is_nan() {
            return self.value > 0.0;
        }
        let turns = acceleration * rate < 0.0 && rate * rate <= 2.0 * acceleration.abs() * self.noise;
        if rate == 0.0 || turns { acceleration > 0.0 } else { rate > 0.0 }
    }

    /// Counts g as zero at the start of a sweep that begins at an event of an earlier one, located to `dt`, so that it does not
    /// meet the same event again. An extremum that was located has passed.
    pub(super) fn start_at_event(&mut self, dt: f64) {
        if self.value.abs() <= AT_EVENT * dt * self.rate.abs() {
            self.noise = self.noise.max(self.value.abs());
        }
        if self.touches(AT_EVENT * dt) && self.rate.abs() <= AT_EVENT * dt * self.acceleration.abs() {
            self.noise = self.noise.max(self.value.abs());
            self.rate = 0.0;
        }
    }

    /// True if an extremum of g is zero within rounding, where this sample is the best known approximation of the
    /// extremum.
    ///
    /// The instant is accurate to about `dt`, so that g here may differ from its extremum by ½|g̈|dt². This matters
    /// where g has no rounding error: the rounding error of an exact square vanishes with the square.
    pub(super) fn touches(&self, dt: f64) -> bool {
        let beside = 0.5 * self.acceleration.abs() * (2.0 * dt).powi(2);
        // Without a second derivative only the rounding error counts.
        self.value.abs() <= self.noise + if beside.is_finite() { beside } else { 0.0 }
    }

    /// True where g does not move within rounding.
    pub(super) fn rests(&self) -> bool {
        self.rate == 0.0 && self.acceleration == 0.0
    }

    /// True where g is so near to zero that the last digits of the configuration matter.
    pub(crate) fn is_near(&self) -> bool {
        self.value.abs() <= 1e6 * self.noise
    }
}

/// The samples of all conditions at a state, and after them those of the expressions at whose zeros these have corners.
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
    let conditions = model.conditions.iter().enumerate();
    let corners = conditions.clone().flat_map(|(k, c)| (1..=c.corners).map(move |corner| (k, c.observable + corner)));
    let rows = conditions.map(|(k, condition)| (k, condition.observable)).chain(corners);
    let mut all = Vec::with_capacity(model.conditions.len());
    for (index, row) in rows {
        let condition = &model.conditions[index];
        let pattern = &model.observable_pattern;
        let Signal { value, rate, acceleration } = parts.rates(pattern, row, &state.q_dot, &state.q_ddot);
        finite("conditions", index, condition.name, value).map_err(|error| error.at(state.t))?;
        // Sizes of the terms in g, ġ and g̈, to which their rounding errors are proportional.
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
