//! Following a mechanism whose inputs come one instant at a time: what a controller calls in its loop.

use crate::analysis::forces::Sharing;
use crate::course::{InputPath, PathShape};
use crate::equations::Equations;
use crate::equations::system::{Evaluator, System};
use crate::error::{Degeneracy, SolveError};
use crate::mechanism::Mechanism;
use crate::modes::{WantedAssembly, first_state};
use crate::motion::Motion;
use crate::ratios::{VelocityRatios, velocity_ratios};
use crate::signal::Instant;
use crate::solver::{Settings, Solver, motion_at, scaled_around};
use crate::state::State;
use crate::sweep::continuation::Continuation;
use crate::trajectory::Fallback;
use core::borrow::Borrow;

/// A mechanism that is followed from instant to instant, as its inputs come in.
///
/// It is made by [`Solver::tracker`], which assembles the mechanism at the first instant. Every
/// [`update`](Self::update) follows the branch from the last good instant to the new one and never leaves it, in the
/// same way as a sweep: by the plan where there is one that has a solution, otherwise by Newton's method in steps that
/// are halved until they are certain to stay on the branch. Between the two instants the inputs follow, with x from 0
/// to 1,
///
/// - the quintic with the values, rates and accelerations of both instants, if t increases and the rates agree with the
///   values: if u + h u̇ + ½ h² ü from either instant predicts the other's value to within a quarter of the change;
/// - a straight line, u = u₀ + x (u₁ − u₀), if they do not agree (a noisy signal, a rate that is not measured), if t
///   decreases, and if the quintic leaves the mechanism's range;
/// - a straight line with constant t, if only the inputs have changed.
///
/// The answer is on the branch at the new values, with q̇ and q̈ for the new rates and accelerations, whichever path
/// was taken. The path matters near a singular configuration, from which several branches can be reached, and if rows
/// of velocity level make the position depend on the path.
///
/// After an error, [`state`](Self::state) is still the last good instant, and the next update goes on from there. How
/// long a refused update takes is bounded by [`Options::min_step`](crate::Options::min_step) and
/// [`Options::max_steps`](crate::Options::max_steps), for each of the two paths that are tried: a controller may prefer
/// fewer and larger steps than the default.
///
/// The tracker borrows (or owns) the mechanism and has the parameters of the time when it was made; for other
/// dimensions make another one with [`Solver::tracker_from`] and [`State::q`]. States, workspaces and buffers are
/// reused by every update; solutions with Φ_q, and a dense factorisation if one is needed, still allocate.
///
/// A tracker is not `Send`, because the functions of a mechanism need not be. A mechanism is `Send` if its fields are:
/// send the mechanism, and make the tracker on the thread that updates it.
///
/// ```
/// use kin_runtime::{Instant, Kinematics, Mechanism, Signal, mechanism};
///
/// /// A boom on a cylinder whose length is measured.
/// #[mechanism]
/// #[bodies(boom)]
/// #[input(cylinder)]
/// #[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
/// #[distance(ram: ground @ (1, 0), boom @ (1.2, 0.1), length = cylinder)]
/// #[point(tip = boom @ (3, 0))]
/// #[guess(boom.phi = 0.8)]
/// struct Crane;
///
/// # fn main() -> Result<(), kin_runtime::SolveError> {
/// let mut inputs = [Signal::default(); Crane::INPUTS];
/// inputs[Crane::cylinder] = Signal::new(0.9, 0.0, 0.0);
/// let mut tracker = Crane.solver().tracker(&Instant { t: 0.0, inputs: &inputs })?;
/// for tick in 1..=100 {
///     inputs[Crane::cylinder] = Signal::new(0.9 + 0.002 * f64::from(tick), 0.2, 0.0);
///     tracker.update(&Instant { t: 0.01 * f64::from(tick), inputs: &inputs })?;
/// }
/// assert!(tracker.motion()?[Crane::tip].v[1] > 0.0);
///
/// // Too long: a typed error, and the last good state stays.
/// inputs[Crane::cylinder] = Signal::constant(2.5);
/// assert!(tracker.update(&Instant { t: 1.01, inputs: &inputs }).is_err());
/// assert_eq!(tracker.state().t, 1.0);
/// // What it comes to is the ram in line with both pins.
/// let stretched = tracker.q_at_limit().expect("the limit was found");
/// assert!((stretched[2] - (180_f64.to_radians() - (0.1_f64 / 1.2).atan())).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub struct Tracker<'m> {
    equations: Equations<'m>,
    follower: Continuation,
    wanted: WantedAssembly,
    by_plan: Box<StateByPlan<'m>>,
    sharing: Sharing,
    /// Whether the last update ended at a limit that was located.
    is_at_limit: bool,
}

/// The state that the plan finds near a complete start, or else from the guesses; `None` where the general path must be
/// used.
type StateByPlan<'m> = dyn Fn(&Instant<'_>, Option<&[f64]>) -> Option<State> + 'm;

impl<'m> Tracker<'m> {
    fn new(
        (settings, wanted): (Settings<'_>, WantedAssembly),
        (system, by_plan): (Box<dyn System + 'm>, Box<StateByPlan<'m>>),
        at: &Instant<'_>,
        start: Option<&[f64]>,
    ) -> Result<Self, SolveError> {
        let mut equations = Equations::new(system, settings.options, &settings.given, None, at)?;
        let follower = begin(&mut equations, &wanted, by_plan(at, start), start)?;
        Ok(Self { equations, follower, wanted, by_plan, sharing: settings.sharing, is_at_limit: false })
    }

    /// The last good instant.
    pub const fn state(&self) -> &State {
        self.follower.state()
    }

    /// The internal steps of the last update on which full Newton took over from the plan.
    pub fn fallbacks(&self) -> &[Fallback] {
        &self.follower.fallbacks
    }

    /// q at the limit itself, n numbers, if the last update failed because a group of the plan reached a limit that was
    /// located ([`SolveError::limit`] has its t).
    pub fn q_at_limit(&self) -> Option<&[f64]> {
        self.equations.system.q_at_limit().filter(|_| self.is_at_limit)
    }

    /// Follows the branch to another instant.
    ///
    /// # Errors
    /// [`Singular`](SolveError::Singular) or [`StepRefused`](SolveError::StepRefused) where the branch ends on the way;
    /// [`Length`](SolveError::Length) and [`NonFinite`](SolveError::NonFinite) for inputs, which are named;
    /// [`InconsistentVelocity`](SolveError::InconsistentVelocity) and
    /// [`InconsistentAcceleration`](SolveError::InconsistentAcceleration) where redundant rows disagree.
    pub fn update(&mut self, at: &Instant<'_>) -> Result<&State, SolveError> {
        if let Err(error) = self.advance(at) {
            self.is_at_limit = error.limit().is_some_and(|limit| limit.at().is_some());
            return Err(error);
        }
        self.is_at_limit = false;
        Ok(self.follower.state())
    }

    fn advance(&mut self, at: &Instant<'_>) -> Result<(), SolveError> {
        self.follower.fallbacks.clear();
        let Err(error) = self.equations.check_instant(at) else { return self.follow(at) };
        // If time alone makes a length negative, the motion may end at a limit before.
        let by_time = self.equations.model.inputs.is_empty()
            && matches!(&error, SolveError::DegenerateGeometry { fault: Degeneracy::NegativeLength { .. }, .. });
        match by_time.then(|| self.follow(at)) {
            Some(Err(before)) if before.limit().is_some_and(|limit| limit.at().is_some()) => Err(before),
            _ => Err(error),
        }
    }

    /// Follows the branch to an instant that was checked.
    fn follow(&mut self, at: &Instant<'_>) -> Result<(), SolveError> {
        let Self { equations, follower, .. } = self;
        if follower.advance_by_plan(equations, at)? {
            return Ok(());
        }
        let from = follower.state().instant();
        let path = equations.path.get_or_insert_with(|| InputPath::resting(at));
        path.lead(&from, at);
        if path.kind == PathShape::Smooth {
            follower.depart_in_time();
            if follower.advance(equations, at.t, false).is_ok() {
                return Ok(());
            }
            // These belong to a path that was not taken.
            follower.fallbacks.clear();
        }
        let path = equations.path.get_or_insert_with(|| InputPath::resting(at));
        path.straighten();
        let (still, [start, end]) = (path.is_still(), path.ends());
        if still {
            return follower.stay(equations, at);
        }
        follower.depart(equations, start)?;
        follower.arrive(equations, end, at)
    }

    /// Restarts: assembles the mechanism from the guesses, on the branch to which they lead.
    ///
    /// # Errors
    /// As [`Solver::state`]; the last good instant stays then.
    pub fn restart(&mut self, at: &Instant<'_>) -> Result<&State, SolveError> {
        self.anew(at, None)
    }

    /// Restarts from a complete start, n numbers.
    ///
    /// # Errors
    /// As [`Solver::state_from`]; the last good instant stays then.
    pub fn restart_from(&mut self, at: &Instant<'_>, start: &[f64]) -> Result<&State, SolveError> {
        self.anew(at, Some(start))
    }

    fn anew(&mut self, at: &Instant<'_>, start: Option<&[f64]>) -> Result<&State, SolveError> {
        self.is_at_limit = false;
        self.equations.check_instant(at)?;
        let by_plan = (self.by_plan)(at, start);
        let scale = self.equations.scale.clone();
        let begun = self.equations.begin_at(at.t);
        self.equations.set_instant(at)?;
        match self.equations.by_time(|equations| begin(equations, &self.wanted, by_plan, start)) {
            Ok(follower) => self.follower = follower,
            Err(error) => {
                self.equations.scale = scale;
                self.equations.begin_at(begun);
                return Err(error);
            }
        }
        Ok(self.follower.state())
    }

    /// Motion of bodies, points, defines and joints, and forces, at the last good instant.
    ///
    /// # Errors
    /// [`NonFinite`](SolveError::NonFinite).
    pub fn motion(&mut self) -> Result<Motion, SolveError> {
        let sharing = self.sharing;
        self.look(|equations, state| motion_at(equations, state, sharing))
    }

    /// The derivatives of q with respect to each driving row and each input at the last good instant.
    ///
    /// # Errors
    /// As [`Solver::velocity_ratios`].
    pub fn velocity_ratios(&mut self) -> Result<VelocityRatios, SolveError> {
        self.look(|equations, state| {
            let scale = equations.scale.clone();
            let found = scaled_around(equations, state).and_then(|equations| velocity_ratios(equations, state));
            equations.scale = scale;
            found
        })
    }

    /// Evaluates something at the last good instant.
    fn look<R>(
        &mut self,
        analysis: impl FnOnce(&mut Equations<'_>, &State) -> Result<R, SolveError>,
    ) -> Result<R, SolveError> {
        let state = self.follower.state();
        self.equations.set_instant(&state.instant())?;
        self.equations.by_time(|equations| analysis(equations, state))
    }
}

impl core::fmt::Debug for Tracker<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Tracker").field("state", self.state()).finish_non_exhaustive()
    }
}

impl<'m, M: Mechanism> Solver<'m, M> {
    /// Assembles the mechanism from the guesses and returns a tracker that follows it from there.
    ///
    /// Functions of [`with_inputs`](Self::with_inputs) are not used.
    ///
    /// # Errors
    /// As [`state`](Self::state).
    pub fn tracker(&self, at: &Instant<'_>) -> Result<Tracker<'m>, SolveError> {
        self.tracker_of(self.mechanism, at, None)
    }

    /// [`tracker`](Self::tracker) from a complete start, n numbers.
    ///
    /// # Errors
    /// As [`state_from`](Self::state_from).
    pub fn tracker_from(&self, at: &Instant<'_>, start: &[f64]) -> Result<Tracker<'m>, SolveError> {
        self.tracker_of(self.mechanism, at, Some(start))
    }

    /// [`tracker`](Self::tracker) with a copy of the mechanism, so that a controller can keep it.
    ///
    /// # Errors
    /// As [`state`](Self::state).
    pub fn owned_tracker(&self, at: &Instant<'_>) -> Result<Tracker<'static>, SolveError>
    where
        M: Clone + 'static,
    {
        self.tracker_of(self.mechanism.clone(), at, None)
    }

    /// A tracker that holds the mechanism, or a reference to it, from a complete start or else from the guesses.
    fn tracker_of<'t, B: Borrow<M> + Clone + 't>(
        &self,
        mechanism: B,
        at: &Instant<'_>,
        start: Option<&[f64]>,
    ) -> Result<Tracker<'t>, SolveError>
    where
        M: 't,
    {
        let settings = self.settings.without_functions();
        let (held, held_settings) = (mechanism.clone(), settings.clone());
        let by_plan = move |at: &Instant<'_>, start: Option<&[f64]>| {
            Solver::<M> { mechanism: held.borrow(), settings: held_settings.clone() }.state_by_plan(at, start)
        };
        let system = Box::new(Evaluator::<B, M>::new(mechanism));
        Tracker::new((settings, self.wanted()?), (system, Box::new(by_plan)), at, start)
    }
}

/// The first state, found by the plan or else by position analysis, whose branch will be followed.
fn begin(
    equations: &mut Equations<'_>,
    wanted: &WantedAssembly,
    by_plan: Option<State>,
    start: Option<&[f64]>,
) -> Result<Continuation, SolveError> {
    if let Some(state) = by_plan {
        return Continuation::new(equations, state, None);
    }
    let (state, factor) = first_state(equations, start, || Ok(wanted.clone()))?;
    Continuation::new(equations, state, Some(factor))
}

/// The last good instant.
impl core::fmt::Display for Tracker<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.state().fmt(f)
    }
}
