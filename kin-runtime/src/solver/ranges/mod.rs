//! Ranges of motion: the intervals of t in which a mechanism closes.

mod by_plan;
mod by_search;

use super::Solver;
use super::any_solver::AnySolver;
use crate::certificate::Uncertified;
use crate::equations::{finite, geometry};
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::ranges::Ranges;
use crate::signal::Instant;

/// Largest number of modes whose combinations are all examined.
const MODES: usize = 12;

impl<M: Mechanism> Solver<'_, M> {
    /// Where the mechanism closes between the time of an instant and another, in every combination of its modes, and
    /// the limits at which that ends: dead centres, which come with the joints that are in line, and branch points.
    /// Inputs continue from the instant with constant acceleration ([`Signal::after`](crate::Signal::after)), as in a
    /// sweep from the command line.
    ///
    /// Where every group has a closed form and closes in one way for each combination of signs, the plan is evaluated
    /// over intervals of t. Where all its margins are positive on an interval the mechanism closes on all of it, where
    /// one is negative it closes nowhere; an interval for which neither is proven is halved. All other mechanisms are
    /// searched for every t and configuration in which two closures come together: boxes without such a place are
    /// excluded, and in every other box it is proven to be the only one. Between such places no closure begins or ends,
    /// so that those of one t represent all ([`assemblies`](Self::assemblies)). So ranges are proven, and limits are
    /// enclosed to about ten digits of the interval.
    ///
    /// ```
    /// use kin_runtime::planned::LimitKind;
    /// use kin_runtime::{Instant, Kinematics, mechanism};
    ///
    /// /// Crank 0.3, coupler 0.25, rocker 0.2, pivots 0.5 apart: the crank goes as far as cos φ = 0.458333….
    /// #[mechanism]
    /// #[bodies(crank, coupler, rocker)]
    /// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.3, 0), coupler @ (0, 0))]
    /// #[revolute(B: coupler @ (0.25, 0), rocker @ (0.2, 0))]
    /// #[revolute(C: ground @ (0.5, 0), rocker @ (0, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// struct FourBar;
    ///
    /// let all = FourBar.solver().ranges(&Instant::at(-0.1), 3.0)?;
    /// let end = (0.1375_f64 / 0.3).acos();
    /// assert!(all.is_complete() && all.limits.iter().all(|limit| limit.kind == Some(LimitKind::DeadCentre)));
    /// assert!(all.limits[0].t.contains(end) && all.limits[0].joints == ["A", "B", "C"]);
    /// // Two modes, which are one motion: at the dead centre it goes from one into the other.
    /// assert_eq!((all.ranges.len(), all.circuits), (2, 1));
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// [`NotCertified`](SolveError::NotCertified) where coordinates are prescribed, rows are redundant or use supplied
    /// functions, degrees of freedom are left, and where there are too many modes;
    /// [`DegenerateGeometry`](SolveError::DegenerateGeometry) where a length is negative;
    /// [`NonFinite`](SolveError::NonFinite), [`Length`](SolveError::Length) and
    /// [`UnknownCoordinate`](SolveError::UnknownCoordinate).
    pub fn ranges(&self, from: &Instant<'_>, to: f64) -> Result<Ranges, SolveError> {
        (self as &dyn AnySolver).ranges_to(from, to)
    }
}

impl dyn AnySolver + '_ {
    fn ranges_to(&self, from: &Instant<'_>, to: f64) -> Result<Ranges, SolveError> {
        let guess = self.start()?;
        let equations = self.equations_at(from)?;
        equations.check("guess", &guess)?;
        geometry::check(&equations)?;
        // What the inputs are at the end, and whether lengths are positive there, the search sees.
        finite("t", 0, "t", to)?;
        if let Some(why) = self.unproven() {
            return Err(SolveError::NotCertified { t: from.t, why });
        }
        // A supplied function has no enclosure over an interval, which the search reports.
        let has_functions = !self.model().arguments.is_empty();
        if let (false, Some(turning)) = (has_functions, self.angles_with_free_turns(from, &guess))
            && let Some(ranges) = self.ranges_by_plan(from, to, &guess, turning)?
        {
            return Ok(ranges);
        }
        self.ranges_by_search(from, to, &guess)
    }

    /// Why nothing can be proven along t.
    fn unproven(&self) -> Option<Uncertified> {
        let model = self.model();
        let plan = &model.plan;
        if !self.settings().given.is_empty() {
            return Some(Uncertified::Prescribed);
        }
        if let Some(row) = plan.redundant_rows().next() {
            return Some(Uncertified::Redundant { row: model.rows.get(row).map_or("", |row| row.name) });
        }
        let modes = plan.modes.len();
        (modes > MODES).then_some(Uncertified::TooManyModes { modes, most: MODES })
    }
}

/// The value of the coordinate that a driver drives; `None` if its row contains several coordinates.
fn driven(model: &Model, name: &str, q: &[f64]) -> Option<f64> {
    let row = model.rows.iter().position(|row| model.joints.get(row.joint).is_some_and(|joint| joint.name == name))?;
    let mut entries = model.constraint_pattern.entries.iter().filter(|(entry_row, _)| *entry_row == row);
    let (Some(&(_, column)), None) = (entries.next(), entries.next()) else { return None };
    q.get(column).copied()
}
