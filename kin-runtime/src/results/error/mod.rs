//! Errors of analyses, with numbers.

use crate::arc::ArcFault;
use crate::certificate::Uncertified;
use crate::mechanism::LengthError;
use crate::planned::{Limit, PlanError, Sign};

mod degeneracy;
mod refusal;
mod sweep;
mod text;

pub use degeneracy::{Degeneracy, GeometryFault};
pub use refusal::Refusal;
pub use sweep::SweepError;

/// An analysis without an answer.
///
/// Rows are named as in [`Model::rows`](crate::model::Model::rows). A coordinate that the caller prescribes adds a row
/// behind them, named like the coordinate, whose joint is `given`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolveError {
    /// The mechanism does not close at this instant, from these guesses.
    NotAssembled {
        /// Time.
        t: f64,
        /// Largest scaled residual of the best attempt (see [`Options`](crate::Options)).
        gap: f64,
        /// The row's residual Φ_i, in its own unit.
        residual: f64,
        /// The row with that residual.
        row: usize,
        /// Its name.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
        /// Iterations of that attempt.
        iterations: u32,
        /// Whether assembly had nothing to vary, since every coordinate had a guess.
        all_guessed: bool,
        /// The group of the plan that cannot close, in the modes of the best attempt; `None` if all can, or without a
        /// plan.
        limit: Option<Limit>,
    },
    /// Φ_q loses rank in this configuration, though not in its neighbourhood.
    Singular {
        /// Time.
        t: f64,
        /// Rank of all rows here.
        rank: usize,
        /// Rank of all rows nearby.
        expected_rank: usize,
        /// Rows that became dependent on one another.
        rows: Vec<&'static str>,
        /// Estimated condition number of the scaled Φ_q; infinite where it is exactly singular.
        condition: f64,
        /// The group of the plan that is at its limit or cannot close beyond it; `None` if all can, or without a plan.
        limit: Option<Limit>,
    },
    /// No q̇ satisfies Φ_q q̇ = −Φ_t.
    InconsistentVelocity {
        /// Time.
        t: f64,
        /// Largest scaled residual, relative to the right-hand side.
        residual: f64,
        /// The row with that residual.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
        /// Rank of all rows.
        rank: usize,
    },
    /// No q̈ satisfies Φ_q q̈ = γ.
    InconsistentAcceleration {
        /// Time.
        t: f64,
        /// Largest scaled residual, relative to the right-hand side.
        residual: f64,
        /// The row with that residual.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
        /// Rank of all rows.
        rank: usize,
    },
    /// Rounding errors dominate a coordinate or its rates, because the rows that determine it are nearly dependent there,
    /// or their slopes change too fast.
    Rounded {
        /// Time.
        t: f64,
        /// The name of the coordinate.
        coordinate: &'static str,
    },
    /// No derivative of this order satisfies all rows.
    InconsistentDerivative {
        /// Time.
        t: f64,
        /// The order.
        order: usize,
        /// Largest scaled residual, relative to the right-hand side.
        residual: f64,
        /// The row with that residual.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
        /// Rank of all rows.
        rank: usize,
    },
    /// A derivative needs a higher one of an input or a supplied function than is known.
    UnknownDerivative {
        /// Time.
        t: f64,
        /// The requested order.
        order: usize,
        /// `input` or `function`.
        what: &'static str,
        /// Its name.
        name: &'static str,
        /// The highest of its derivatives that is known; 0 for the value alone.
        known: usize,
    },
    /// A row has no derivative of this order here: a root, a divisor or an absolute value is 0.
    NotSmooth {
        /// Time.
        t: f64,
        /// The order.
        order: usize,
        /// The row.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
    },
    /// A derivative is more than an `f64` can hold.
    OutOfRange {
        /// Time.
        t: f64,
        /// Its order.
        order: usize,
    },
    /// A sweep cannot go on without leaving its branch.
    StepRefused {
        /// Time of the last good configuration.
        t: f64,
        /// Time at which there is none.
        t_refused: f64,
        /// The row with the largest residual.
        row_name: &'static str,
        /// Its joint.
        joint: &'static str,
        /// Why.
        reason: Refusal,
        /// The group of the plan that cannot close at `t_refused`; `None` if all can, or without a plan.
        limit: Option<Limit>,
    },
    /// Bodies touch where the contact equation is degenerate.
    DegenerateContact {
        /// Time.
        t: f64,
        /// The joint.
        joint: &'static str,
        /// Its row.
        row_name: &'static str,
        /// What is degenerate.
        what: Degeneracy,
    },
    /// The values of the parameters leave a joint without a direction or a length.
    DegenerateGeometry {
        /// Time.
        t: f64,
        /// The joint.
        joint: &'static str,
        /// What is degenerate.
        fault: Degeneracy,
    },
    /// Forces were requested, and the mechanism has neither masses nor loads.
    NoLoads {
        /// Its name.
        mechanism: &'static str,
    },
    /// Forces were requested, and a mass or a moment of inertia is negative.
    NegativeMass {
        /// Its body.
        body: &'static str,
        /// Whether it is the moment of inertia.
        is_inertia: bool,
        /// Its value.
        value: f64,
    },
    /// Loads or inertia act along degrees of freedom that no constraint or driver holds.
    NotHeld {
        /// Time.
        t: f64,
        /// How many are left open.
        open: usize,
        /// Coordinates that could be given.
        could_be_given: Vec<&'static str>,
    },
    /// The configuration is singular: loads act against a dead centre, and forces grow without bounds near it.
    UnboundedForces {
        /// Time.
        t: f64,
        /// The joints and drivers whose forces grow.
        joints: Vec<&'static str>,
        /// Estimated condition number of the scaled Φ_q; infinite where it is exactly singular.
        condition: f64,
        /// The group of the plan that is at its limit; none where there is no plan.
        limit: Option<Limit>,
    },
    /// Derivatives with respect to parameters were requested, but the parameters do not determine the configuration:
    /// degrees of freedom are left open, or rows of velocity level make the position depend on the motion so far.
    NotDetermined {
        /// Time.
        t: f64,
        /// How many degrees of freedom are left open; 0 if rows of velocity level are the reason.
        open: usize,
        /// Coordinates that could be given.
        could_be_given: Vec<&'static str>,
    },
    /// The configuration has no derivative with respect to a parameter.
    NoSensitivity {
        /// Time.
        t: f64,
        /// The parameter.
        parameter: &'static str,
        /// A redundant row that agrees with the others at this value of the parameter only; `None` if the reason is a
        /// function or a quantity without a (known) derivative here.
        row_name: Option<&'static str>,
    },
    /// No parameter has this index.
    UnknownParameter {
        /// The index.
        index: usize,
        /// Number of parameters.
        parameters: usize,
    },
    /// Nothing can be proven of these equations ([`Solver::assemblies`](crate::Solver::assemblies)).
    NotCertified {
        /// Time.
        t: f64,
        /// Why.
        why: Uncertified,
    },
    /// There is no single curve of solutions to follow ([`Solver::sweep_along_arc`](crate::Solver::sweep_along_arc)).
    NoArc {
        /// Time.
        t: f64,
        /// Why.
        why: ArcFault,
    },
    /// NaN or infinity in an argument, a parameter or a result.
    NonFinite {
        /// The list it is in: `q`, `t`, `parameters`, `inputs`, `Φ`, ….
        what: &'static str,
        /// Index in that list.
        index: usize,
        /// Name of the coordinate, parameter, input or row.
        name: &'static str,
        /// Time, if the number was computed for an instant.
        t: Option<f64>,
    },
    /// An argument of the wrong length.
    Length(LengthError),
    /// One of the [`Options`](crate::Options) is out of range.
    Option {
        /// Its name.
        name: &'static str,
        /// The value it was given.
        value: f64,
        /// The largest possible value.
        most: f64,
    },
    /// No coordinate has this index.
    UnknownCoordinate {
        /// The index.
        index: usize,
        /// Number of coordinates.
        coordinates: usize,
    },
    /// A prescribed coordinate contradicts the constraints, or repeats them.
    GivenConflict {
        /// Time.
        t: f64,
        /// The coordinate.
        coordinate: &'static str,
        /// Prescribed value.
        value: f64,
        /// Degrees of freedom that the mechanism leaves open without prescribed coordinates.
        open: usize,
        /// Number of prescribed coordinates.
        given: usize,
    },
    /// The plan has no answer.
    Plan(PlanError),
    /// The observer ended the analysis ([`Solver::with_observer`](crate::Solver::with_observer)), or the closure of
    /// [`Solver::sweep_each`](crate::Solver::sweep_each) did.
    Stopped {
        /// The time reached.
        t: f64,
        /// Instants or configurations that are finished.
        done: usize,
        /// Their total number.
        total: usize,
    },
    /// No mode has the requested name or index.
    UnknownMode {
        /// The requested mode.
        mode: String,
        /// The modes of the mechanism.
        modes: Vec<&'static str>,
    },
    /// The mechanism has no configuration in the requested modes, with all other modes as the guesses have them.
    ModeNotAssembled {
        /// Time.
        t: f64,
        /// The requested modes.
        modes: Vec<(&'static str, Sign)>,
        /// The group that cannot close; `None` if the plan closes and the mechanism does not.
        limit: Option<Limit>,
    },
    /// No configuration could be compared.
    NothingCompared {
        /// Configurations skipped because Φ is not finite there.
        skipped: usize,
    },
}

impl From<PlanError> for SolveError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}

impl From<LengthError> for SolveError {
    fn from(error: LengthError) -> Self {
        Self::Length(error)
    }
}

impl SolveError {
    /// The group of the plan that is at its limit or cannot close, if that is the reason of the error.
    pub const fn limit(&self) -> Option<&Limit> {
        match self {
            Self::NotAssembled { limit, .. }
            | Self::Singular { limit, .. }
            | Self::UnboundedForces { limit, .. }
            | Self::StepRefused { limit, .. }
            | Self::ModeNotAssembled { limit, .. } => limit.as_ref(),
            Self::Plan(error) => error.limit(),
            _ => None,
        }
    }

    /// The error with the time of the instant that it was computed for.
    pub(crate) fn at(mut self, now: f64) -> Self {
        if let Self::NonFinite { t, .. } = &mut self {
            *t = Some(now);
        }
        self
    }
}

/// The message contains that of the source, which is the error of the plan or of a length, if one of them is the
/// reason.
impl core::error::Error for SolveError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Length(error) => Some(error),
            Self::Plan(error) => Some(error),
            _ => None,
        }
    }
}
