//! A mechanism solved by its plan, instant by instant, without an allocator: for controllers and fast loops.

mod error;
mod explain;
mod mode;
pub(crate) mod passed;
pub(crate) mod predict;
mod step;
mod text;

pub use error::{Limit, PlanError};
pub use mode::{ModeKey, Sign};
pub use step::Step;

use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::plan::{Depth, Plan, Solved, StepKind};
use crate::signal::Instant;
use crate::workspace::Array;
use passed::Passed;

/// A mechanism that is solved by its plan ([`Model::plan`]) at one instant after the other: q, q̇ and q̈ in closed form
/// wherever there is one, without Φ, without an allocator and without `std`.
///
/// It is made from a complete configuration, which decides the assembly modes, and keeps them by their signs: where
/// [`at`](Self::at) has an answer, it is never one in another mode. From the last good state it predicts
///
/// ```text
/// q(t + h) ≈ q + h q̇ + ½ h² q̈
/// ```
///
/// and the plan starts there, iterations even nearer, on the quintic that the last two states have in common: angles come
/// out within half a turn of the prediction, so that they go on counting as long as no body turns by more than that away from it between two instants; where the plan has Newton iterations, they
/// converge to the closure near the prediction, so that instants lie near one another (a few degrees of the fastest body
/// for one correction or two). Plans without such iterations may go as far as angles allow, in either direction of time.
/// Beside a limit, where q̈ grows without bounds, a prediction far ahead means nothing: where ½ h² φ̈ of an angle is more
/// than 1 and more than h φ̇, the prediction is the last good q itself. Scalar coordinates are judged as angles; x and y are
/// not, because no unit of length has a meaning of its own, and nothing far from its place closes anyway.
///
/// A solution counts when all margins exceed [`Plan::SMALLEST_MARGIN`] and every number is finite. After an error the
/// last good state stays, and the next instant is predicted from there: as far away as the prediction holds. Behind a longer
/// gap the closures are still those of the modes, but an angle may come out by whole turns beside what it would have counted to,
/// and an iteration may find another closure or none: [`restart`](Self::restart) there with a configuration that is known.
///
/// Nothing else is checked: [`Tracker`](crate::Tracker) and [`Solver::sweep`](crate::Solver::sweep) hold every answer
/// against Φ, walk long ways in steps and change over to full Newton where a plan is singular. Redundant rows
/// (`allow_redundant`) have margins of their own, which say when they contradict the others. Where these others alone have
/// a limit that the mechanism passes, as a parallelogram with a third crank does when it lies flat, the closure goes on
/// with the other sign, because the redundant rows say so; at the limit itself there is [`PlanError::Limit`], and the next
/// instant goes on.
///
/// ```
/// use kin_runtime::{Instant, Kinematics, mechanism};
///
/// #[mechanism]
/// #[bodies(crank, coupler, rocker)]
/// #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
/// #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
/// #[revolute(B: coupler @ (0.4, 0), rocker @ (0, 0))]
/// #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
/// #[driver(drive: crank.phi = 2.3 * t)]
/// #[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
/// struct FourBar;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut planned = FourBar.solver().planned(&Instant::at(0.0))?;
/// for tick in 1..=1000 {
///     let state = planned.at(&Instant::at(0.001 * f64::from(tick)))?;
///     assert!(state.q_dot()[2] == 2.3);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Planned<'m, M: Mechanism> {
    mechanism: Held<'m, M>,
    parameters: M::Parameters<f64>,
    /// A sign for every mode.
    modes: M::Coordinates<f64>,
    t: f64,
    /// The last good state, and one that is being tried.
    states: [Poses<M>; 2],
    /// Which of them is the good one.
    good: usize,
    /// When the other one was good, on the way to this one; not a number where it was not.
    before: f64,
    /// The next state has nothing to do with the last one.
    anew: bool,
    /// Not 0 for every mode that was asked for since the last good state.
    asked: M::Coordinates<f64>,
    /// The plan has iterations.
    iterates: bool,
    predicted: M::Coordinates<f64>,
}

#[derive(Clone, Copy)]
enum Held<'m, M> {
    Borrowed(&'m M),
    Owned(M),
}

struct Poses<M: Mechanism> {
    q: M::Coordinates<f64>,
    q_dot: M::Coordinates<f64>,
    q_ddot: M::Coordinates<f64>,
    /// There are never more margins than rows.
    margins: M::Rows<f64>,
}

impl<M: Mechanism> Clone for Poses<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Poses<M> {}

impl<'m, M: Mechanism> Planned<'m, M> {
    /// A mechanism in a configuration q, n numbers, which decides the modes; it need not be closed to the last digit.
    /// Parameters are those that the mechanism has now.
    ///
    /// # Errors
    /// [`PlanError`]: there is no plan, or it has no answer at this instant in these modes, or q does not say in which
    /// ([`PlanError::Undecided`]).
    pub fn new(mechanism: &'m M, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        Self::begin(Held::Borrowed(mechanism), at, q)
    }

    /// [`new`](Self::new) with a mechanism of its own, so that a controller can keep it.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn owned(mechanism: M, at: &Instant<'_>, q: &[f64]) -> Result<Planned<'static, M>, PlanError> {
        Planned::begin(Held::Owned(mechanism), at, q)
    }

    fn begin(mechanism: Held<'m, M>, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        if let Some(why) = M::model().plan.absent {
            return Err(PlanError::NoPlan { why });
        }
        let zeros = M::Coordinates::<f64>::filled(0.0);
        let margins = M::Rows::<f64>::filled(0.0);
        let nothing = Poses { q: zeros, q_dot: zeros, q_ddot: zeros, margins };
        let parameters = mechanism.get().parameters();
        let steps = M::model().plan.steps;
        let mut planned = Self {
            mechanism,
            parameters,
            modes: zeros,
            t: at.t,
            states: [nothing; 2],
            good: 0,
            before: f64::NAN,
            anew: true,
            asked: zeros,
            iterates: steps.iter().any(|step| matches!(step.kind, StepKind::Newton(_))),
            predicted: zeros,
        };
        planned.restart(at, q)?;
        Ok(planned)
    }

    /// Begins anew from a configuration q, n numbers, in the modes that it has.
    ///
    /// # Errors
    /// As [`new`](Self::new); state and modes stay what they were then.
    pub fn restart(&mut self, at: &Instant<'_>, q: &[f64]) -> Result<&Self, PlanError> {
        if q.len() != M::COORDINATES {
            return Err(LengthError { what: "q", expected: M::COORDINATES, found: q.len() }.into());
        }
        let count = M::model().plan.modes.len();
        let mut modes = M::Coordinates::<f64>::filled(0.0);
        let closures = &mut modes.as_mut()[..count];
        self.mechanism.get().closures_with(self.parameters.as_ref(), at, q, closures)?;
        for mode in closures {
            // None where it is not decided: whatever depends on it is no number then.
            *mode = Sign::of(*mode).map_or(f64::NAN, Sign::value);
        }
        let before = core::mem::replace(&mut self.modes, modes);
        self.predicted.as_mut().copy_from_slice(q);
        let anew = core::mem::replace(&mut self.anew, true);
        let asked = core::mem::replace(&mut self.asked, M::Coordinates::filled(1.0));
        if let Err(error) = self.solve(at) {
            (self.modes, self.anew, self.asked) = (before, anew, asked);
            return Err(error);
        }
        Ok(self)
    }

    /// q, q̇ and q̈ at another instant.
    ///
    /// # Errors
    /// [`PlanError::Limit`] where a group is at its limit or cannot close, [`PlanError::Singular`] where a step says
    /// nothing, [`PlanError::Contradiction`] where redundant rows do not agree; [`PlanError::NonFinite`] and [`PlanError::Length`]. The last good state stays then.
    #[inline]
    pub fn at(&mut self, at: &Instant<'_>) -> Result<&Self, PlanError> {
        let h = at.t - self.t;
        let half = 0.5 * h;
        let Poses { q, q_dot, q_ddot, .. } = &self.states[self.good];
        let rates = q_dot.as_ref().iter().zip(q_ddot.as_ref());
        // A quick look that may see trouble where there is none.
        let mut wild = false;
        for ((to, q), (v, a)) in self.predicted.as_mut().iter_mut().zip(q.as_ref()).zip(rates) {
            let bend = (half * a).abs();
            wild |= bend > v.abs() && h.abs() * bend > 1.0;
            *to = q + h * (v + half * a);
        }
        if wild && predict::is_wild(M::model(), h, [q_dot.as_ref(), q_ddot.as_ref()]) {
            self.predicted = *q;
        } else if self.iterates {
            self.predict_unknowns(h);
        }
        self.solve(at)?;
        Ok(self)
    }

    /// The unknowns of iterations, nearer.
    fn predict_unknowns(&mut self, h: f64) {
        let (now, before) = (&self.states[self.good], &self.states[1 - self.good]);
        let of = |state: &Poses<M>, k: usize| [state.q.as_ref()[k], state.q_dot.as_ref()[k], state.q_ddot.as_ref()[k]];
        for step in M::model().plan.steps {
            let StepKind::Newton(unknowns) = step.kind else { continue };
            for &(k, _) in step.coordinates.iter().take(unknowns) {
                let beyond = predict::beyond_parabola(of(before, k), of(now, k), self.t - self.before, h);
                self.predicted.as_mut()[k] += beyond;
            }
        }
    }

    /// Solves from the prediction.
    #[inline]
    fn solve(&mut self, at: &Instant<'_>) -> Result<(), PlanError> {
        if !self.ask(at)? && !self.pass(at)? {
            self.before = f64::NAN;
            return Err(self.explain(at));
        }
        self.before = self.t;
        if core::mem::take(&mut self.anew) {
            self.before = f64::NAN;
            self.asked = M::Coordinates::filled(0.0);
        }
        self.good = 1 - self.good;
        self.t = at.t;
        Ok(())
    }

    /// What the plan gives in the modes that are kept; true where it is good.
    #[inline]
    fn ask(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        let Self { mechanism, parameters, modes, states, good, predicted, .. } = self;
        let Poses { q, q_dot, q_ddot, margins } = &mut states[1 - *good];
        let margins = &mut margins.as_mut()[..plan.margins];
        let solved = Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins };
        let modes = &modes.as_ref()[..plan.modes.len()];
        let depth = Depth::Acceleration;
        mechanism.get().solve_with(parameters.as_ref(), at, modes, predicted.as_ref(), depth, solved)?;
        let Poses { q, q_dot, q_ddot, margins } = &states[1 - *good];
        // Without early ends, so that the loops run in lanes.
        let finite = |numbers: &[f64]| numbers.iter().fold(true, |all, x| all & x.is_finite());
        let good_margins =
            margins.as_ref()[..plan.margins].iter().fold(true, |all, m| all & (*m > Plan::SMALLEST_MARGIN));
        let all = good_margins & finite(q.as_ref()) & finite(q_dot.as_ref()) & finite(q_ddot.as_ref());
        Ok(all & at.t.is_finite())
    }

    /// What the plan gives where the motion has passed limits that only the kept rows have, with the signs that closures
    /// have behind them; true where it is good. Modes that were asked for stay what they are.
    #[cold]
    #[inline(never)]
    fn pass(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        let plan = &M::model().plan;
        let margins = self.states[1 - self.good].margins;
        if !passed::is_missed(plan, |place| margins.as_ref()[place]) {
            return Ok(false);
        }
        let count = plan.modes.len();
        let (kept, mut closures) = (self.modes, M::Coordinates::<f64>::filled(0.0));
        let closures = &mut closures.as_mut()[..count];
        self.mechanism.get().closures_with(self.parameters.as_ref(), at, self.predicted.as_ref(), closures)?;
        let passed = Passed::new(&kept.as_ref()[..count], closures, self.asked.as_ref());
        for attempt in passed.attempts() {
            passed.signs(attempt, &mut self.modes.as_mut()[..count]);
            if self.ask(at)? {
                return Ok(true);
            }
        }
        // Once more, for what is said of it.
        self.modes = kept;
        self.ask(at)
    }

    /// Asks for a mode from the next instant on.
    ///
    /// The mechanism is there at once, as if it had been taken apart and put together again; angles still come out within
    /// half a turn of the prediction. Where a Newton iteration follows in the plan, it starts at the old mode and may not
    /// find the new one: [`restart`](Self::restart) with a configuration that
    /// [`Solver::with_mode`](crate::Solver::with_mode) assembles then. Asking for what is there already changes nothing.
    ///
    /// # Errors
    /// [`PlanError::UnknownMode`].
    pub fn set_mode<'k>(&mut self, mode: impl Into<ModeKey<'k>>, sign: Sign) -> Result<(), PlanError> {
        let mode = mode.into();
        let (have, _) = self.mode_mut(mode)?;
        if *have != sign.value() {
            self.flip(mode)?;
        }
        Ok(())
    }

    /// Asks for the other closure of a mode from the next instant on, as [`set_mode`](Self::set_mode) does.
    ///
    /// # Errors
    /// [`PlanError::UnknownMode`].
    pub fn flip<'k>(&mut self, mode: impl Into<ModeKey<'k>>) -> Result<(), PlanError> {
        let (sign, asked) = self.mode_mut(mode.into())?;
        *sign = -*sign;
        *asked = 1.0;
        self.anew = true;
        Ok(())
    }

    /// The sign of a mode, and whether it was asked for.
    fn mode_mut(&mut self, mode: ModeKey<'_>) -> Result<(&mut f64, &mut f64), PlanError> {
        let modes = M::model().plan.modes;
        let place = mode.place(modes).ok_or(PlanError::UnknownMode { modes })?;
        let both = self.modes.as_mut().get_mut(place).zip(self.asked.as_mut().get_mut(place));
        both.ok_or(PlanError::UnknownMode { modes })
    }

    /// The sign of a mode: that of the last good state, or what was asked for since.
    pub fn mode<'k>(&self, mode: impl Into<ModeKey<'k>>) -> Option<Sign> {
        let place = mode.into().place(M::model().plan.modes)?;
        self.modes.as_ref().get(place).copied().and_then(Sign::of)
    }

    /// The signs of all modes, in the order of [`Plan::modes`].
    pub fn modes(&self) -> impl Iterator<Item = Sign> + '_ {
        self.modes.as_ref()[..M::model().plan.modes.len()].iter().copied().filter_map(Sign::of)
    }

    /// Time of the last good state.
    pub const fn t(&self) -> f64 {
        self.t
    }

    /// q of the last good state, n numbers.
    #[inline]
    pub fn q(&self) -> &[f64] {
        self.states[self.good].q.as_ref()
    }

    /// q̇ of the last good state, n numbers.
    #[inline]
    pub fn q_dot(&self) -> &[f64] {
        self.states[self.good].q_dot.as_ref()
    }

    /// q̈ of the last good state, n numbers.
    #[inline]
    pub fn q_ddot(&self) -> &[f64] {
        self.states[self.good].q_ddot.as_ref()
    }

    /// The margins of the last good state, [`Plan::margins`] numbers: how far each step is from where it says nothing.
    #[inline]
    pub fn margins(&self) -> &[f64] {
        &self.states[self.good].margins.as_ref()[..M::model().plan.margins]
    }

    /// The mechanism.
    pub const fn mechanism(&self) -> &M {
        self.mechanism.get()
    }

    /// Names, rows and the plan.
    pub fn model(&self) -> &'static Model {
        M::model()
    }
}

impl<M> Held<'_, M> {
    #[inline]
    const fn get(&self) -> &M {
        match self {
            Self::Borrowed(mechanism) => mechanism,
            Self::Owned(mechanism) => mechanism,
        }
    }
}
