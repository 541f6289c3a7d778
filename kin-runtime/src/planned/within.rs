//! The motion between the ends of a step, solved by the plan.
//!
//! A function of a coordinate, of time or of an input may rise and fall within a step although its values and rates at
//! both ends show nothing of it, as sin³(8θ) does between θ = 0 and θ = π/8; a mechanism may then pass its dead centre
//! and return. Where rows contain such functions the plan is therefore also solved at places within the step, from the
//! cubic through q and q̇ of both ends (see [`between`](super::between)). Everywhere it must have a solution, and the
//! solution must be near the cubic.
//!
//! The places are the fractional parts of the multiples of (√5 − 1)/2, which have no common period with functions that
//! repeat themselves within the step.

use super::between::on_cubic;
use super::follower::{Control, NEGLIGIBLE, PlanFollower, PlanSolution};
use super::lists::{Margins, Modes};
use super::predict::{largest_turn, turned};
use crate::course::{Between, Course, kind};
use crate::mechanism::{LengthError, Mechanism};
use crate::plan::{Depth, Plan, Solved};
use crate::scalar::Scalar;
use crate::scalar::compare::Compare;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// Number of places at which the plan is solved.
const PLACES: u32 = 7;

/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The places within a step, relative to its length.
pub(crate) fn places_within() -> impl Iterator<Item = f64> {
    (1..=PLACES).map(|place| f64::from(place) * GOLDEN % 1.0)
}

/// True if the plan is to be solved within steps. With redundant rows the motion may pass limits of the rows that the
/// plan uses, so that it has no solution in the same modes everywhere.
pub(crate) fn solves_within<M: Mechanism>() -> bool {
    M::KNOWN_VALUES_CURVE && !M::model().plan.has_redundant_rows()
}

/// A step of a course: its first and last place, and q, q̇ of both.
#[derive(Clone, Copy)]
pub(crate) struct Stretch<'a, V> {
    /// The path of the inputs.
    pub(crate) course: &'a dyn Course,
    /// The first and the last place.
    pub(crate) places: [f64; 2],
    /// q₀, q̇₀, q₁ and q̇₁, with rates along the course.
    pub(crate) ends: [&'a [V]; 4],
}

/// A measure that is negative if at a place within the step the plan has no solution, or one that is farther from the
/// cubic than `allowed`, in radians; `weights` converts coordinates to radians.
#[cold]
#[inline(never)]
pub(crate) fn certainty_within<M: Mechanism, V: Compare>(
    mechanism: &M,
    parameters: &[V],
    stretch: Stretch<'_, V>,
    modes: &Modes<M, V>,
    (weights, allowed): (&[V], V),
) -> Result<V, LengthError> {
    let Stretch { course, places: [s, next], ends } = stretch;
    let zeros = M::Coordinates::<V>::filled(V::from_f64(0.0));
    let (mut cubic, mut found, mut rates) = (zeros, zeros, [zeros; 2]);
    let mut margins = Margins::<M, V>::filled(V::from_f64(0.0));
    let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
    let (mut certainty, smallest) = (V::from_f64(1.0), V::from_f64(Plan::SMALLEST_MARGIN));
    for place in places_within() {
        let t = course.at(s + place * (next - s), inputs.as_mut());
        let inputs = M::Inputs::<V>::generate(|k| inputs.as_ref()[k].map(V::from_f64));
        on_cubic(cubic.as_mut(), ends, next - s, place);
        let [q_dot, q_ddot] = &mut rates;
        let solved =
            Solved { q: found.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: margins.as_mut() };
        let at = Instant { t: V::from_f64(t), inputs: inputs.as_ref() };
        mechanism.solve_with(parameters, &at, modes.of_closures(), cubic.as_ref(), Depth::Position, solved)?;
        let away = turned(found.as_ref(), cubic.as_ref(), weights);
        let margin = margins.as_ref().iter().fold(smallest, |least, margin| or_nan(least.least(*margin), *margin));
        certainty = or_nan(certainty.least(allowed - away).least(margin - smallest), away + margin);
    }
    Ok(certainty)
}

/// A number, or NaN if the other one is not finite. The smaller one of two numbers need not be NaN if one of them is.
fn or_nan<V: Scalar>(number: V, other: V) -> V {
    number + V::from_f64(0.0) * other
}

impl<M: Mechanism> PlanFollower<M> {
    /// True if the step from the accepted state to the trial state hides no motion.
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
        if course.is_none() && between.is_frozen() {
            // An input may have jumped; the rates in time do not belong to its path.
            let mut inputs = from.inputs.iter().zip(at.inputs);
            return Ok(inputs.all(|(before, now)| before.value == now.value));
        }
        self.hides_nothing(mechanism, course.unwrap_or(&between), [self.t, at.t], self.state(), control)
    }

    /// True if a step from `here` to the trial state hides no motion; `places` are its ends on the course.
    #[inline]
    pub(super) fn hides_nothing(
        &self,
        mechanism: &M,
        course: &dyn Course,
        places: [f64; 2],
        here: &PlanSolution<M>,
        control: &Control,
    ) -> Result<bool, LengthError> {
        if !solves_within::<M>() {
            return Ok(true);
        }
        let (tried, weights) = (self.trial(), self.weights.as_ref());
        let turn = largest_turn([here.q_dot.as_ref(), here.q_ddot.as_ref()], weights, places[1] - places[0]);
        let allowed = control.correction * turn + NEGLIGIBLE;
        let ends = [here.q.as_ref(), here.q_dot.as_ref(), tried.q.as_ref(), tried.q_dot.as_ref()];
        let stretch = Stretch { course, places, ends };
        let parameters = self.parameters.as_ref();
        Ok(certainty_within(mechanism, parameters, stretch, &self.branch.modes, (weights, allowed))? >= 0.0)
    }
}
