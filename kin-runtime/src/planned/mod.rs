//! The follower of a plan: from one instant to the next it predicts, solves by the plan, checks that the solution is on
//! the branch of the motion, and takes shorter steps where that is not certain. Sweeps, trackers and batches use it, too;
//! [`Planned`] is its public form for controllers and fast loops, without an allocator.

pub(crate) mod accurate_solution;
pub(crate) mod branch;
pub(crate) mod coincident;
mod error;
mod extrapolate;
pub(crate) mod follower;
pub(crate) mod gradient_turns;
mod group_limit;
pub(crate) mod hidden_motion;
pub(crate) mod ill_conditioned;
pub(crate) mod inputs;
pub(crate) mod interior;
mod limit;
pub(crate) mod lists;
mod mode;
pub(crate) mod mode_changes;
pub(crate) mod narrow_curves;
pub(crate) mod parts;
pub(crate) mod predict;
mod range;
pub(crate) mod rates;
mod report;
pub(crate) mod row_end;
pub(crate) mod steep_rows;
mod step;
pub(crate) mod step_length;
mod substeps;
mod text;
mod trial;
pub(crate) mod turning_rows;
mod update;

pub use error::PlanError;
pub use group_limit::{Limit, LimitKind, Located};
pub use mode::{ModeKey, Sign};
pub use range::{InputRange, OutOfRange};
pub use step::Step;

use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::signal::Instant;
use follower::{Control, PlanFollower};

/// A mechanism that is solved by its plan ([`Model::plan`]) at one instant after the other: q, q̇ and q̈ in closed form
/// where there is one, without Φ, without an allocator and without `std`.
///
/// It starts from a complete configuration, which determines the assembly modes, and follows the branch of the motion
/// on which this configuration lies: a solution returned by [`at`](Self::at) is never on another branch. From the last
/// accepted state it predicts
///
/// ```text
/// q(t + h) ≈ q + h q̇ + ½ h² q̈
/// ```
///
/// and the plan solves from there, with angles within half a turn of the prediction. A *group* is the set of bodies
/// that one step of the plan places, a dyad for example; it is at its *limit* where two of its closures meet. A step of
/// the motion is accepted if no body turns by more than 0.3 rad, nor the gradient of a row that is solved for lengths or
/// scalars, no scalar s changes by more than 0.3 (1 + |s|), the solution is near the prediction, and every group that
/// closes in two ways, is solved by iteration, or is a linear system that may be singular, is either too far from its
/// limit to have reached it or at the predicted distance from it. Otherwise the motion to the instant is divided into
/// shorter steps, in which the inputs change as described at [`Tracker`](crate::Tracker). So instants may be far apart,
/// in either direction of time; the nearer they are, the fewer steps are needed.
///
/// Where a group reaches its limit on the way – a dead centre, or a crossing of two branches of the motion – the result
/// is [`PlanError::Limit`] with the location of the limit, even if the group could close again at the instant
/// requested. The same error is returned if that instant is so near to a crossing that rounding errors would dominate
/// the rates. A solution is valid when all margins exceed [`Plan::SMALLEST_MARGIN`](crate::plan::Plan::SMALLEST_MARGIN)
/// and every number is finite. After an error the last accepted state remains, and the next instant is reached from
/// there.
///
/// Φ itself is not evaluated: [`Tracker`](crate::Tracker) and [`Solver::sweep`](crate::Solver::sweep) use the same
/// algorithm, check every solution with Φ, and switch to full Newton where a plan is singular. Redundant rows
/// (`allow_redundant`) have margins of their own, which show whether they contradict the other rows. Where the other
/// rows alone have a limit that the mechanism passes, as a parallelogram with a third crank does when it lies flat, the
/// redundant rows determine that the closure continues with the opposite sign. At the limit itself the result is
/// [`PlanError::Limit`], and later instants can be reached. At a distance of δ radians from it, rounding errors are
/// magnified by about 1/δ in q, 1/δ² in q̇ and 1/δ³ in q̈; trackers and sweeps compute the rates from all rows there.
/// Beside limits in general, and where a rod is more than a hundred times as long as its crank, trackers and sweeps also
/// correct q by all rows; `Planned` finds the angle of a crank of length c on a rod of length 1 with an error of ε/c².
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
    mechanism: MaybeOwned<'m, M>,
    follower: PlanFollower<M>,
}

/// A mechanism that is borrowed or owned.
#[derive(Clone, Copy)]
enum MaybeOwned<'m, M> {
    Borrowed(&'m M),
    Owned(M),
}

impl<'m, M: Mechanism> Planned<'m, M> {
    /// Starts from a configuration q, n numbers, which determines the modes and need not satisfy Φ = 0 accurately. The
    /// parameters are copied from the mechanism.
    ///
    /// # Errors
    /// [`PlanError`]: there is no plan, it has no solution at this instant in these modes, q does not determine the
    /// modes ([`PlanError::Undecided`]), or an iteration leads from q to another closure than that of q, or more than half
    /// a turn away ([`PlanError::OtherClosure`]).
    pub fn new(mechanism: &'m M, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        Self::begin(MaybeOwned::Borrowed(mechanism), at, q)
    }

    /// As [`new`](Self::new), but takes ownership of the mechanism, so that a controller can store the result.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn owned(mechanism: M, at: &Instant<'_>, q: &[f64]) -> Result<Planned<'static, M>, PlanError> {
        Planned::begin(MaybeOwned::Owned(mechanism), at, q)
    }

    fn begin(mechanism: MaybeOwned<'m, M>, at: &Instant<'_>, q: &[f64]) -> Result<Self, PlanError> {
        let follower = PlanFollower::new(mechanism.get(), at, q)?;
        Ok(Self { mechanism, follower })
    }

    /// Starts again from a configuration q, n numbers, in the modes of q.
    ///
    /// # Errors
    /// As [`new`](Self::new); then the state and the modes remain unchanged.
    pub fn restart(&mut self, at: &Instant<'_>, q: &[f64]) -> Result<&Self, PlanError> {
        self.follower.restart(self.mechanism.get(), at, q)?;
        Ok(self)
    }

    /// Computes q, q̇ and q̈ at another instant.
    ///
    /// # Errors
    /// [`PlanError::Limit`] where a group reaches its limit on the way, [`PlanError::Singular`] where a step is
    /// singular, [`PlanError::Contradiction`] where redundant rows contradict the others, [`PlanError::Jump`] where a
    /// row or an input jumps, [`PlanError::TooManySteps`]; [`PlanError::Rounded`], [`PlanError::NegativeLength`],
    /// [`PlanError::NonFinite`] and [`PlanError::Length`]. The last accepted state then remains;
    /// [`out_of_range`](Self::out_of_range) finds the input that is the cause, and its range.
    #[inline]
    pub fn at(&mut self, at: &Instant<'_>) -> Result<&Self, PlanError> {
        self.follower.update(self.mechanism.get(), at, &Control::USUAL)?;
        Ok(self)
    }

    /// Requests a mode from the next instant on.
    ///
    /// At the next instant the mechanism has this mode, as if it had been disassembled and assembled again; angles are
    /// still within half a turn of the prediction. A Newton iteration in the plan starts in the old mode and may not
    /// converge to the new one; in that case call [`restart`](Self::restart) with a configuration that
    /// [`Solver::with_mode`](crate::Solver::with_mode) assembles. A request for the current mode changes nothing.
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

    /// Requests the other closure of a mode from the next instant on, as [`set_mode`](Self::set_mode) does.
    ///
    /// # Errors
    /// [`PlanError::UnknownMode`].
    pub fn flip<'k>(&mut self, mode: impl Into<ModeKey<'k>>) -> Result<(), PlanError> {
        let (sign, requested) = self.mode_mut(mode.into())?;
        *sign = -*sign;
        // A second request takes the first one back.
        *requested = 1.0 - *requested;
        self.follower.starts_anew = self.follower.requested.as_ref().contains(&1.0);
        Ok(())
    }

    /// The sign of a mode, and its flag in `requested`.
    fn mode_mut(&mut self, mode: ModeKey<'_>) -> Result<(&mut f64, &mut f64), PlanError> {
        let modes = M::model().plan.modes;
        let index = mode.index_in(modes).ok_or(PlanError::UnknownMode { modes })?;
        let follower = &mut self.follower;
        let sign_and_request =
            follower.branch.modes.as_mut().get_mut(index).zip(follower.requested.as_mut().get_mut(index));
        sign_and_request.ok_or(PlanError::UnknownMode { modes })
    }

    /// The sign of a mode: as requested since the last accepted state, or else that of this state.
    pub fn mode<'k>(&self, mode: impl Into<ModeKey<'k>>) -> Option<Sign> {
        let index = mode.into().index_in(M::model().plan.modes)?;
        self.follower.modes().as_ref().get(index).copied().and_then(Sign::of)
    }

    /// The signs of all modes, in the order of [`Plan::modes`](crate::plan::Plan::modes).
    pub fn modes(&self) -> impl Iterator<Item = Sign> + '_ {
        self.follower.modes().of_closures().iter().copied().filter_map(Sign::of)
    }

    /// The time of the last accepted state.
    pub const fn t(&self) -> f64 {
        self.follower.t()
    }

    /// q of the last accepted state, n numbers.
    #[inline]
    pub fn q(&self) -> &[f64] {
        self.follower.state().q.as_ref()
    }

    /// q̇ of the last accepted state, n numbers.
    #[inline]
    pub fn q_dot(&self) -> &[f64] {
        self.follower.state().q_dot.as_ref()
    }

    /// q̈ of the last accepted state, n numbers.
    #[inline]
    pub fn q_ddot(&self) -> &[f64] {
        self.follower.state().q_ddot.as_ref()
    }

    /// The margins of the last accepted state, [`Plan::margins`](crate::plan::Plan::margins) numbers: the distance of
    /// each step from singularity.
    #[inline]
    pub fn margins(&self) -> &[f64] {
        self.follower.state().margins.as_ref()
    }

    /// q at the limit itself, where the closures of the group meet, n numbers: after a [`PlanError::Limit`] whose
    /// location was found; otherwise `None`.
    ///
    /// ```
    /// use kin_runtime::{Instant, Kinematics, mechanism};
    ///
    /// /// A rod of 0.3 m that is pulled along by its slider until it is upright.
    /// #[mechanism]
    /// #[bodies(crank, rod)]
    /// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.4, 0), rod @ (0, 0))]
    /// #[point_on_line(slide: ground @ (0, 0), rod @ (0.3, 0), axis = (1, 0))]
    /// #[driver(drive: crank.phi = 0.5 + t)]
    /// #[guess(rod.phi = -0.8)]
    /// struct Rocker;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut rocker = Rocker.solver().planned(&Instant::at(0.0))?;
    /// let error = rocker.at(&Instant::at(1.0)).unwrap_err();
    /// let limit = error.limit().ok_or("no limit")?;
    /// assert!((limit.at().ok_or("no place")? - (0.75_f64.asin() - 0.5)).abs() < 1e-12);
    /// let q = rocker.q_at_limit().ok_or("no configuration")?;
    /// assert!((q[5] + 90_f64.to_radians()).abs() < 1e-9);
    /// # Ok(())
    /// # }
    /// ```
    pub fn q_at_limit(&self) -> Option<&[f64]> {
        self.follower.q_at_limit()
    }

    /// The mechanism.
    pub const fn mechanism(&self) -> &M {
        self.mechanism.get()
    }

    /// The names, the rows and the plan.
    pub fn model(&self) -> &'static Model {
        M::model()
    }
}

impl<M> MaybeOwned<'_, M> {
    #[inline]
    const fn get(&self) -> &M {
        match self {
            Self::Borrowed(mechanism) => mechanism,
            Self::Owned(mechanism) => mechanism,
        }
    }
}
