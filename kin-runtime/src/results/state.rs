//! A solved configuration.

use crate::model::{Body, Coordinate, Model, Point};
use crate::motion::{BodyMotion, PointMotion};
use crate::signal::{Instant, Signal};
use core::fmt;
use core::ops::Index;
use nalgebra::DVectorView;

/// Position, velocity and acceleration at one instant.
///
/// Indexed by the handles of the mechanism: `state[FourBar::coupler].phi`, `state[FourBar::tip].v`, and the value of a
/// scalar coordinate.
#[derive(Clone)]
pub struct State {
    /// The mechanism's names.
    pub model: &'static Model,
    /// Time.
    pub t: f64,
    /// The inputs, in the order of declaration.
    pub inputs: Vec<Signal>,
    /// q, n numbers; angles in radians, never wrapped.
    pub q: Vec<f64>,
    /// q̇, n numbers; the least-norm one where degrees of freedom are left.
    pub q_dot: Vec<f64>,
    /// q̈, n numbers; the least-norm one where degrees of freedom are left.
    pub q_ddot: Vec<f64>,
    /// Bodies, in the order of [`Model::bodies`], including held and carried coordinates.
    pub bodies: Vec<BodyMotion>,
    /// Named points, in the order of [`Model::points`].
    pub points: Vec<PointMotion>,
    /// Largest |Φ_i|, in the rows' own units.
    pub residual: f64,
    /// Iterations of the position analysis.
    pub iterations: usize,
    /// Estimated condition number of the scaled Φ_q: ‖A‖₁ ‖A⁻¹‖₁ where it is square and regular, rarely too small by
    /// more than a factor of three; otherwise largest over smallest pivot within the rank. None if the plan has solved
    /// the state, which needs no factorisation of Φ_q: [`Solver::condition`](crate::Solver::condition) computes it for
    /// any state.
    pub condition: Option<f64>,
    /// n − rank of all rows; 0 when fully driven.
    pub degrees_of_freedom_left: usize,
}

impl State {
    /// The instant, to hand to other analyses.
    pub fn instant(&self) -> Instant<'_> {
        Instant { t: self.t, inputs: &self.inputs }
    }

    /// A scalar coordinate with its rate and acceleration.
    ///
    /// # Panics
    /// With the handle of another mechanism, if the index is out of range.
    pub fn coordinate(&self, coordinate: Coordinate) -> Signal {
        self.rates(coordinate.0)
    }

    /// Keeps the position only: rates and accelerations become NaN.
    pub(crate) fn forget_rates(&mut self) {
        self.q_dot.fill(f64::NAN);
        self.q_ddot.fill(f64::NAN);
        self.bodies.iter_mut().for_each(|body| *body = body.without_rates());
        self.points.iter_mut().for_each(|point| *point = point.without_rates());
    }

    /// The coordinate at an index of q with its rate and acceleration.
    pub(crate) fn rates(&self, index: usize) -> Signal {
        Signal { value: self.q[index], rate: self.q_dot[index], acceleration: self.q_ddot[index] }
    }

    /// q, q̇ and q̈ as nalgebra views, without a copy.
    pub fn columns(&self) -> [DVectorView<'_, f64>; 3] {
        [&self.q, &self.q_dot, &self.q_ddot].map(|column| DVectorView::from_slice(column, column.len()))
    }
}

impl Index<Body> for State {
    type Output = BodyMotion;

    fn index(&self, body: Body) -> &BodyMotion {
        &self.bodies[body.0]
    }
}

impl Index<Point> for State {
    type Output = PointMotion;

    fn index(&self, point: Point) -> &PointMotion {
        &self.points[point.0]
    }
}

/// The value alone; [`State::coordinate`] has it with its rates.
impl Index<Coordinate> for State {
    type Output = f64;

    fn index(&self, coordinate: Coordinate) -> &f64 {
        &self.q[coordinate.0]
    }
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        let Self { model, t, inputs, q, q_dot, q_ddot, bodies, points, residual, iterations, condition, .. } = self;
        // Two states of one mechanism usually share the tables, so compare their addresses first.
        (core::ptr::eq(*model, other.model) || *model == other.model)
            && *t == other.t
            && *inputs == other.inputs
            && [q, q_dot, q_ddot] == [&other.q, &other.q_dot, &other.q_ddot]
            && *bodies == other.bodies
            && *points == other.points
            && (*residual, *condition) == (other.residual, other.condition)
            && [*iterations, self.degrees_of_freedom_left] == [other.iterations, other.degrees_of_freedom_left]
    }
}

impl fmt::Debug for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("State")
            .field("model", &self.model.name)
            .field("t", &self.t)
            .field("inputs", &self.inputs)
            .field("q", &self.q)
            .field("q_dot", &self.q_dot)
            .field("q_ddot", &self.q_ddot)
            .field("bodies", &self.bodies)
            .field("points", &self.points)
            .field("residual", &self.residual)
            .field("iterations", &self.iterations)
            .field("condition", &self.condition)
            .field("degrees_of_freedom_left", &self.degrees_of_freedom_left)
            .finish()
    }
}

/// A line for t, and one per coordinate with its name, value, rate and acceleration.
impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.model.coordinates.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
        write!(f, "t = {}", self.t)?;
        for (k, coordinate) in self.model.coordinates.iter().enumerate() {
            // A state that was constructed by hand may have lists that are too short.
            let [value, rate, acceleration] =
                [&self.q, &self.q_dot, &self.q_ddot].map(|column| column.get(k).copied().unwrap_or(f64::NAN));
            write!(f, "\n{:width$}  {value:>15.9}  {rate:>15.9}  {acceleration:>15.9}", coordinate.name)?;
        }
        Ok(())
    }
}
