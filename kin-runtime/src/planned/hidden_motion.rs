//! The motion between the ends of a step, solved by the plan.
//!
//! A function of a coordinate, of time or of an input may rise and fall within a step although its values and rates at
//! both ends show nothing of it, as sin³(8θ) does between θ = 0 and θ = π/8; a mechanism may then pass its dead centre
//! and return. Where rows contain such functions the plan is therefore also solved at instants within the step, from the
//! cubic through q and q̇ of both ends (see [`interior`](super::interior)). Everywhere it must have a solution, and the
//! solution must be near the cubic.

use super::follower::{Control, NEGLIGIBLE_CORRECTION, PlanFollower, PlanSolution};
use super::inputs::spread_inputs;
use super::interior::{IRREGULAR_FRACTIONS, on_cubic};
use super::lists::{Margins, Modes};
use super::narrow_curves::{Resolution, narrow_curves_are_followed};
use super::parts::Span;
use super::predict::{largest_turn, turned};
use crate::course::{Between, Course, PathShape, kind};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::plan::{Depth, Plan, Solved};
use crate::scalar::compare::{Compare, least_or_nan};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Distances from the cubic up to this, relative to the largest coordinate that is a length, are always accepted: kinks,
/// at which velocities jump, are passed in steps that are as short.
const NEGLIGIBLE_LENGTH: f64 = 1e-9;

/// A step of a course: its first and last parameter, and q, q̇ of both.
#[derive(Clone, Copy)]
pub(crate) struct CourseStep<'a, V> {
    /// The path of the inputs.
    pub(crate) course: &'a dyn Course,
    /// The parameters of its first and last point.
    pub(crate) interval: [f64; 2],
    /// q₀, q̇₀, q₁ and q̇₁, with rates along the course.
    pub(crate) ends: [&'a [V]; 4],
}

/// A measure that is negative if at a fraction of the step the plan has no solution in these modes, or
/// one that is farther from the cubic than `allowed`, in radians; `weights` converts coordinates to radians. Lengths, which
/// have no radians, are compared with the farthest motion of a length.
#[cold]
#[inline(never)]
pub(crate) fn certainty_within<M: Mechanism, V: Compare>(
    mechanism: &M,
    parameters: &[V],
    (stretch, fraction): (CourseStep<'_, V>, f64),
    modes: &Modes<M, V>,
    (weights, allowed): (&[V], V),
    control: &Control,
) -> Result<V, LengthError> {
    let CourseStep { course, interval: [s, next], ends } = stretch;
    let zeros = M::Coordinates::<V>::filled(V::from_f64(0.0));
    let (mut cubic, mut found, mut rates) = (zeros, zeros, [zeros; 2]);
    let mut margins = Margins::<M, V>::filled(V::from_f64(0.0));
    let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
    let t = course.at(s + fraction * (next - s), inputs.as_mut());
    let mut inputs_of_lanes = M::Inputs::<V>::filled(Signal::constant(V::from_f64(0.0)));
    spread_inputs(inputs_of_lanes.as_mut(), inputs.as_ref());
    on_cubic(cubic.as_mut(), ends, next - s, fraction);
    let [q_dot, q_ddot] = &mut rates;
    let solved =
        Solved { q: found.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
    let at = Instant { t: V::from_f64(t), inputs: inputs_of_lanes.as_ref() };
    mechanism.solve_with(parameters, &at, modes.of_closures(), cubic.as_ref(), Depth::Position, solved)?;
    let away = turned(found.as_ref(), cubic.as_ref(), weights);
    let margin = least_number(margins.as_ref());
    let lengths = certainty_of_lengths(M::model(), found.as_ref(), cubic.as_ref(), ends, (next - s, control));
    let certainty = least_or_nan(least_or_nan(margin - V::from_f64(Plan::SMALLEST_MARGIN), allowed - away), lengths);
    // Distances may not show that a coordinate is not finite.
    Ok(certainty + zero_if_finite(found.as_ref()))
}

/// True if an input moves otherwise than the rates at the first instant say, so that these tell nothing of the motion between
/// both: at a fixed time any input that jumps, and where inputs curve also one whose rates do not fit its values.
pub(crate) fn leaves_its_rates<M: Mechanism>(path: &Between<'_>) -> bool {
    let is_left = path.is_frozen() || M::INPUTS_CURVE && path.kind == PathShape::Straight;
    is_left && path.from.inputs.iter().zip(path.to.inputs).any(|(before, now)| before.value != now.value)
}

/// True if `is_near` is true wherever known functions may have a narrow feature within a step.
pub(crate) fn curves_are_followed<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    CourseStep { course, interval, ends }: CourseStep<'_, f64>,
    is_near: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<bool, LengthError> {
    let [mut first, mut last] = [M::Inputs::<f64>::filled(Signal::constant(0.0)); 2];
    let from = Instant { t: course.at(interval[0], first.as_mut()), inputs: first.as_ref() };
    let to = Instant { t: course.at(interval[1], last.as_mut()), inputs: last.as_ref() };
    let span = Span { ends, inputs: from.inputs, h: interval[1] - interval[0] };
    narrow_curves_are_followed(mechanism, parameters, [&from, &to], span, Resolution::OF_POSITIONS, is_near)
}

/// The least of these numbers and 1; NaN where one of them is not finite.
fn least_number<V: Compare>(numbers: &[V]) -> V {
    numbers.iter().fold(V::from_f64(1.0), |least, number| least_or_nan(least, *number))
}

/// 0, or NaN where a number is not finite.
fn zero_if_finite<V: Compare>(numbers: &[V]) -> V {
    numbers.iter().fold(V::from_f64(0.0), |sum, number| sum + V::from_f64(0.0) * *number)
}

/// A measure that is negative if a length is farther from the cubic than the motions of lengths in the step of the length h
/// tell, as where a driver jumps.
fn certainty_of_lengths<V: Compare>(
    model: &Model,
    found: &[V],
    cubic: &[V],
    [q0, v0, q1, v1]: [&[V]; 4],
    (h, control): (f64, &Control),
) -> V {
    let zero = V::from_f64(0.0);
    let (mut away, mut motion, mut size) = (zero, zero, zero);
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        if coordinate.kind.is_length() {
            away = away.greatest((found[k] - cubic[k]).abs());
            motion = motion.greatest(v0[k].abs()).greatest(v1[k].abs());
            size = size.greatest(q0[k].abs()).greatest(q1[k].abs());
        }
    }
    // As far as the ends of unit links that turn as far as a step may.
    let share = control.correction * control.rotation;
    let allowed = V::from_f64(share * h.abs()) * motion + V::from_f64(NEGLIGIBLE_LENGTH) * size;
    allowed - away
}

impl<M: Mechanism> PlanFollower<M> {
    /// True if the step from the accepted state to the trial state, in the same modes, hides no motion.
    #[cold]
    #[inline(never)]
    pub(super) fn hides_nothing_until(
        &self,
        mechanism: &M,
        at: &Instant<'_>,
        course: Option<&dyn Course>,
        control: &Control,
    ) -> Result<bool, LengthError> {
        let from = Instant { t: self.t, inputs: self.inputs.as_ref() };
        let between = Between { kind: kind(&from, at), from, to: *at };
        let leaves = leaves_its_rates::<M>(&between);
        if course.is_none() && (leaves || between.is_frozen()) {
            return Ok(!leaves);
        }
        let before = (self.state(), &self.branch.modes);
        let course = course.unwrap_or(&between);
        self.hides_nothing(mechanism, course, course.ends(), before, control)
    }

    /// True if a step from a state in its modes to the trial state hides no motion; `interval` has its ends on the course.
    /// Where redundant rows let the motion pass limits of the rows that the plan uses, either modes may hold in between.
    #[inline]
    pub(super) fn hides_nothing(
        &self,
        mechanism: &M,
        course: &dyn Course,
        interval: [f64; 2],
        (here, before): (&PlanSolution<M>, &Modes<M>),
        control: &Control,
    ) -> Result<bool, LengthError> {
        if !M::KNOWN_VALUES_CURVE {
            return Ok(true);
        }
        let (tried, weights) = (self.trial(), self.weights.as_ref());
        let turn = largest_turn([here.q_dot.as_ref(), here.q_ddot.as_ref()], weights, interval[1] - interval[0]);
        let allowed = control.correction * turn + NEGLIGIBLE_CORRECTION;
        let ends = [here.q.as_ref(), here.q_dot.as_ref(), tried.q.as_ref(), tried.q_dot.as_ref()];
        let stretch = CourseStep { course, interval, ends };
        let is_near = |fraction: f64, modes: &Modes<M>| {
            let parameters = self.parameters.as_ref();
            let certainty =
                certainty_within(mechanism, parameters, (stretch, fraction), modes, (weights, allowed), control)?;
            Ok(certainty >= 0.0)
        };
        let after = &self.branch.modes;
        let have_changed = after.as_ref() != before.as_ref();
        let mut is_near = |fraction: f64| Ok(is_near(fraction, after)? || have_changed && is_near(fraction, before)?);
        for fraction in IRREGULAR_FRACTIONS {
            if !is_near(fraction)? {
                return Ok(false);
            }
        }
        let parameters = self.parameters.as_ref();
        curves_are_followed(mechanism, parameters, stretch, &mut is_near)
    }
}
