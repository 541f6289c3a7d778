//! Tolerances and limits of the analyses.

use crate::error::SolveError;
use core::fmt;

/// Tolerances and limits; the default suits mechanisms of any size and unit.
///
/// All tolerances are relative. Rows and coordinates are first brought to a common scale, on which one unit is a
/// rotation of one radian or the displacement that such a rotation causes in this mechanism; a mechanism in millimetres
/// is therefore solved exactly as the same one in metres, provided that joints, points or curves show how large it is.
/// Equations over scalar coordinates alone do not show that: there one unit of a coordinate counts as one, and
/// coordinates of very different size need other limits.
///
/// ```
/// use kin_runtime::Options;
/// let options = Options { restarts: 100, ..Options::default() };
/// assert!(options.tolerance < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Options {
    /// Iterations of one position analysis.
    pub max_iterations: usize,
    /// Largest scaled residual of a row that counts as closed. The iteration continues until the residual no longer
    /// decreases, so it is usually far smaller than this.
    pub tolerance: f64,
    /// Smallest pivot, relative to the largest, that counts towards the rank of the scaled Φ_q. It is above the square
    /// root of the machine precision, because a position at the end of a range of motion is known no more accurately
    /// than that.
    pub rank_tolerance: f64,
    /// Largest scaled residual, relative to the right-hand side, of velocity and acceleration equations.
    pub consistency_tolerance: f64,
    /// Attempts of assembly with other values of the coordinates that have no guess.
    pub restarts: usize,
    /// Radius of the trust region of the first iteration of a position analysis, on the common scale.
    pub trust_radius: f64,
    /// Largest rotation (rad) of a body in one internal step of a sweep, or of the gradient of a row that the plan
    /// solves by iteration; for full Newton also the largest displacement on the common scale.
    pub max_rotation_per_step: f64,
    /// Largest correction of the predicted position, relative to the predicted motion, that a step of a sweep accepts.
    pub prediction_tolerance: f64,
    /// Smallest internal step of a sweep, relative to the distance to the next instant or to the step that
    /// `max_rotation_per_step` allows, whichever is shorter; at least four units in the last place of t. Limits of groups
    /// that are solved by iteration are located to about this fraction of a step, others to rounding.
    pub min_step: f64,
    /// Largest estimated error of one internal step in a coordinate, if a sweep must integrate rows of velocity level:
    /// absolute on the common scale for coordinates up to one, relative for larger ones. In a typical sweep the total
    /// error stays below about a hundred times this.
    pub integration_tolerance: f64,
    /// Largest number of internal steps of a sweep between two neighbouring instants.
    pub max_steps: usize,
    /// True to end a sweep at the first event of a unilateral condition.
    pub stop_at_events: bool,
    /// False to correct every step of a sweep or a tracker by full Newton even if the mechanism has a plan. Answers are
    /// the same to rounding, but full Newton may refuse to pass a crossing of branches that the plan passes. The plan
    /// then only names and locates the limit at which a motion ends, for the error.
    pub use_plan: bool,
    /// False to factorise Φ_q densely, with its rank revealed, at every instant. Otherwise this is done only if a
    /// sparse elimination in the fixed pattern of Φ_q is not certain: if there are fewer or more rows than coordinates,
    /// if no pivots are good enough, or if 10 √n max(‖A‖₁, 1) ‖A⁻¹‖₁ of the scaled Φ_q exceeds 1 / `rank_tolerance`.
    /// The results are the same.
    pub use_sparse: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            max_iterations: 200,
            tolerance: 1e-11,
            rank_tolerance: 1e-7,
            consistency_tolerance: 1e-8,
            restarts: 30,
            trust_radius: 0.5,
            max_rotation_per_step: 0.3,
            prediction_tolerance: 0.1,
            integration_tolerance: 1e-12,
            min_step: 1e-13,
            max_steps: 200_000,
            stop_at_events: false,
            use_plan: true,
            use_sparse: true,
        }
    }
}

impl Options {
    /// Checks that every number but `restarts` is positive and finite, that relative ones are at most 1, and that
    /// `max_rotation_per_step` is at most π/2.
    ///
    /// # Errors
    /// [`SolveError::Option`] with the first that is not.
    pub(crate) fn check(&self) -> Result<(), SolveError> {
        let below = |name, value: f64, most: f64| {
            if value > 0.0 && value <= most { Ok(()) } else { Err(SolveError::Option { name, value, most }) }
        };
        below("tolerance", self.tolerance, 1.0)?;
        below("rank_tolerance", self.rank_tolerance, 1.0)?;
        below("consistency_tolerance", self.consistency_tolerance, 1.0)?;
        below("trust_radius", self.trust_radius, f64::MAX)?;
        below("max_rotation_per_step", self.max_rotation_per_step, core::f64::consts::FRAC_PI_2)?;
        below("prediction_tolerance", self.prediction_tolerance, 1.0)?;
        below("min_step", self.min_step, 1.0)?;
        below("integration_tolerance", self.integration_tolerance, 1.0)?;
        below("max_iterations", self.max_iterations as f64, f64::MAX)?;
        below("max_steps", self.max_steps as f64, f64::MAX)
    }
}

/// `name = value` for every one of them.
impl fmt::Display for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { max_iterations, tolerance, rank_tolerance, consistency_tolerance, restarts, trust_radius, .. } =
            self;
        let Self { max_rotation_per_step, prediction_tolerance, min_step, integration_tolerance, max_steps, .. } = self;
        let Self { stop_at_events, use_plan, use_sparse, .. } = self;
        write!(
            f,
            "max_iterations = {max_iterations}, tolerance = {tolerance:e}, rank_tolerance = {rank_tolerance:e}, "
        )?;
        write!(f, "consistency_tolerance = {consistency_tolerance:e}, restarts = {restarts}, ")?;
        write!(f, "trust_radius = {trust_radius}, max_rotation_per_step = {max_rotation_per_step}, ")?;
        write!(f, "prediction_tolerance = {prediction_tolerance}, min_step = {min_step:e}, ")?;
        write!(f, "integration_tolerance = {integration_tolerance:e}, max_steps = {max_steps}, ")?;
        write!(f, "stop_at_events = {stop_at_events}, use_plan = {use_plan}, use_sparse = {use_sparse}")
    }
}
