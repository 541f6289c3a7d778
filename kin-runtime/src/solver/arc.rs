//! Sweeps along the arc of the solution curve, through dead centres.

use super::sweep::inputs_at;
use super::{AnySolver, Solver};
use crate::error::{Degeneracy, SolveError};
use crate::mechanism::Mechanism;
use crate::observer::Observed;
use crate::signal::Instant;
use crate::sweep::arc::{Window, solution_arc};
use crate::trajectory::Trajectory;

impl<M: Mechanism> Solver<'_, M> {
    /// The whole motion through the configuration that is assembled at `from`, with time as one more unknown: where the
    /// driver can go no further it turns back, and the mechanism continues in its other closure. So a four-bar whose
    /// crank only rocks is swept through both of its dead centres, and its coupler point traces its whole curve.
    ///
    /// The states, `steps` + 1 of them, or one if the curve is a point, lie at equal distances along the curve of all (q, t) with Φ(q, t) = 0; their
    /// times increase and decrease, and rates are those at the given speed of the driver: they grow without bound
    /// towards a dead centre and are NaN at it, and where rounding errors dominate them. With `to` the curve is followed towards it as long as t stays between
    /// `from` and `to`, otherwise until it closes: until all bodies are where they began, up to whole turns. A curve
    /// that does not close is followed in both directions from the start. [`Trajectory::arc`] has the special places:
    /// every dead centre and cusp with an enclosure. Where branches cross the curve ends, because it is not determined
    /// which of them continues it. Unilateral conditions are not watched.
    ///
    /// ```
    /// use kin_runtime::{ArcPlaceKind, Kinematics, mechanism};
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
    /// let trajectory = FourBar.solver().sweep_along_arc(0.0, None, 200)?;
    /// let arc = trajectory.arc.as_ref().ok_or("it has one")?;
    /// assert!(arc.is_closed() && trajectory.len() == 201);
    /// let end = (0.1375_f64 / 0.3).acos();
    /// assert_eq!(arc.places.len(), 2);
    /// for place in &arc.places {
    ///     assert_eq!((place.kind, place.joints.as_slice()), (ArcPlaceKind::DeadCentre, ["A", "B", "C"].as_slice()));
    ///     assert!((place.t.abs() - end).abs() < 1e-12);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble); [`NoArc`](SolveError::NoArc) where there is no single curve through the start:
    /// degrees of freedom are left, there are rows of velocity level, or branches cross there;
    /// [`Stopped`](SolveError::Stopped) by an observer.
    pub fn sweep_along_arc(&self, from: f64, to: Option<f64>, steps: usize) -> Result<Trajectory, SolveError> {
        along_arc(self, Window { from, to }, steps)
    }
}

/// As [`Solver::sweep_along_arc`].
fn along_arc(solver: &dyn AnySolver, window: Window, steps: usize) -> Result<Trajectory, SolveError> {
    let Window { from, to } = window;
    let settings = solver.settings();
    let inputs = inputs_at(settings.inputs, from, solver.model().inputs.len());
    let at = Instant { t: from, inputs: &inputs };
    if let Some(t) = to {
        match solver.equations_at(&Instant { t, inputs: &inputs }).map(|_| ()) {
            // The curve may turn back before a length becomes negative.
            Err(SolveError::DegenerateGeometry { fault: Degeneracy::NegativeLength { .. }, .. }) => {}
            other => other?,
        }
    }
    let q = solver.assembled(&at)?;
    let mut equations = solver.equations_at(&at)?;
    equations.observed = Observed::new(settings.observer, steps.saturating_add(1));
    let (states, arc) = solution_arc(&mut equations, &q, window, steps)?;
    Ok(Trajectory { reached: states.len(), states, arc: Some(arc), ..Trajectory::new(solver.model()) })
}
