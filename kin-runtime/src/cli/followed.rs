//! What the parts of a motion share: how it is followed, what its rows show, and its outcome.

use super::engine::Engine;
use super::failure::Failure;
use super::instants::Instants;
use super::options::FreedomArgs;
use super::setup::Setup;
use super::watch::ProgressWatch;
use crate::error::SolveError;
use crate::forces::ContactChange;
use crate::measure::Measure;
use crate::motion::Motion;
use crate::present::record::InstantRow;
use crate::state::State;
use crate::trajectory::Trajectory;
use std::ops::ControlFlow;

/// A motion up to its end.
pub(super) struct Moved {
    /// Its states, if they were kept.
    pub(super) trajectory: Trajectory,
    /// Points, defines and joint quantities of the states, if they were kept.
    pub(super) motions: Vec<Motion>,
    /// The values of every requested quantity, if they were kept.
    pub(super) columns: Vec<Vec<f64>>,
    /// Why it ended early.
    pub(super) ended: Option<Failure>,
    /// Notes about its ends.
    pub(super) notes: Vec<String>,
    /// True if it ended at or near a limit before its last instant and this is no failure.
    pub(super) at_its_end: bool,
    /// Degrees of freedom that the drivers leave open at the first instant.
    pub(super) open: usize,
    /// Contacts that lift off or press again during the motion, and ropes that go slack or are taut again.
    pub(super) contacts: Vec<ContactChange>,
}

/// How a motion is followed.
#[derive(Clone, Copy)]
pub(super) struct FollowedMotion<'a> {
    pub(super) engine: &'a dyn Engine,
    pub(super) setup: &'a Setup,
    pub(super) instants: &'a Instants,
    pub(super) stop_at_events: bool,
    /// No end is given: a motion that ends at a limit is complete.
    pub(super) open_end: bool,
    pub(super) freedom: FreedomArgs,
    /// Whether points, defines and joint quantities are computed as well.
    pub(super) reported: bool,
    /// Whether a note says why forces among the quantities are not determined.
    pub(super) tells_missing: bool,
    /// The requested quantities.
    pub(super) measures: &'a [Measure],
    /// Whether angles among their values are in degrees.
    pub(super) degrees: bool,
    pub(super) watch: &'a ProgressWatch,
}

/// Called with every row; may end the motion.
pub(super) type Visit<'v> = &'v mut dyn FnMut(&InstantRow<'_>) -> ControlFlow<()>;

impl FollowedMotion<'_> {
    /// What a row has beside its state: the motion of points and the like, if it is reported, and the requested values.
    pub(super) fn row(&self, state: &State) -> Result<(Option<Motion>, Vec<f64>), SolveError> {
        let motion = self.reported.then(|| self.engine.motion(self.setup, state)).transpose()?;
        Ok((motion, self.values(state)?))
    }

    /// The values of the requested quantities, with angles in degrees if that is requested.
    pub(super) fn values(&self, state: &State) -> Result<Vec<f64>, SolveError> {
        self.values_of(state, self.measures)
    }

    /// The values of some quantities, with angles in degrees if that is requested.
    pub(super) fn values_of(&self, state: &State, measures: &[Measure]) -> Result<Vec<f64>, SolveError> {
        let mut values = self.engine.measure(self.setup, state, measures)?;
        if self.degrees {
            values.iter_mut().zip(measures).for_each(|(value, measure)| *value *= measure.in_degrees());
        }
        Ok(values)
    }
}
