//! Certificates of solutions.

use super::Solver;
use super::any_solver::AnySolver;
use crate::certificate::{Certificate, Uncertified};
use crate::mechanism::Mechanism;
use crate::mobility::mobility;
use crate::proof::{Prover, Square};
use crate::signal::{Instant, Signal};
use crate::state::State;

impl<M: Mechanism> Solver<'_, M> {
    /// Proves that a state is a solution: a box around it with exactly one, and an interval for every coordinate, rate
    /// and acceleration, by Krawczyk's operator over interval arithmetic. The proof accounts for all rounding, in the
    /// state and in its own arithmetic. Prescribed coordinates are rows with their given values.
    ///
    /// ```
    /// use kin_runtime::{Instant, Kinematics, mechanism};
    ///
    /// #[mechanism]
    /// #[bodies(crank, rod, slider)]
    /// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
    /// #[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
    /// #[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
    /// #[driver(drive: crank.phi = 3 * t)]
    /// #[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = 0.9)]
    /// struct SliderCrank;
    ///
    /// let solver = SliderCrank.solver();
    /// let mut state = solver.state(&Instant::at(0.5))?;
    /// let certificate = solver.certify(&state)?;
    /// assert!(certificate.radius() < 1e-14 && certificate.isolation() > 1e-9);
    /// assert!(certificate.covers(&state.q));
    ///
    /// state.q[5] += 0.01;
    /// let refused = solver.certify(&state).unwrap_err();
    /// assert!(refused.to_string().starts_with("q is no solution: rod.phi is off by "));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The reason why there is no certificate; prescribed coordinates are those of the state. Only
    /// [`NotASolution`](Uncertified::NotASolution) and [`Violated`](Uncertified::Violated) mean that the state is wrong.
    pub fn certify(&self, state: &State) -> Result<Certificate, Uncertified> {
        (self as &dyn AnySolver).certificate(state)
    }
}

impl dyn AnySolver + '_ {
    fn certificate(&self, state: &State) -> Result<Certificate, Uncertified> {
        let square = self.square_with(&self.settings().given_at(state), &state.instant(), &state.q)?;
        let mut system = self.boxes(&state.instant());
        Prover::new(&square).certify(&mut *system, [&state.q, &state.q_dot, &state.q_ddot])
    }

    /// The rows to which a certificate applies.
    pub(super) fn square(&self, at: &Instant<'_>, q: &[f64]) -> Result<Square, Uncertified> {
        self.square_with(&self.settings().given, at, q)
    }

    fn square_with(&self, given: &[(usize, Signal)], at: &Instant<'_>, q: &[f64]) -> Result<Square, Uncertified> {
        let model = self.model();
        if at.inputs.len() != model.inputs.len() || given.iter().any(|&(k, _)| k >= model.coordinates.len()) {
            return Err(Uncertified::Malformed);
        }
        Square::new(model, self.redundant(at, q), given)
    }

    /// Rows that a certificate leaves out, because there are more rows than coordinates and others imply them.
    fn redundant(&self, at: &Instant<'_>, q: &[f64]) -> Vec<usize> {
        self.redundant_everywhere().unwrap_or_else(|| {
            let mobility = self.equations_at(at).and_then(|mut equations| mobility(&mut equations, q));
            mobility.map_or_else(|_| Vec::new(), |mobility| mobility.redundant.iter().map(|row| row.row).collect())
        })
    }

    /// The rows of `redundant` if they are the same in every configuration: those that the plan leaves out, or none.
    pub(super) fn redundant_everywhere(&self) -> Option<Vec<usize>> {
        let (model, given) = (self.model(), &self.settings().given);
        match (model.rows.len() + given.len()).checked_sub(model.coordinates.len()) {
            None | Some(0) => Some(Vec::new()),
            Some(too_many) => {
                let redundant: Vec<usize> = model.plan.redundant_rows().collect();
                (given.is_empty() && redundant.len() == too_many).then_some(redundant)
            }
        }
    }
}
