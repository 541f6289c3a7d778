//! All orders at once by the plan: with q, q̇, q̈ it leaves sines, cosines and the factors of every block, from which the
//! coefficients go on.
//!
//! Everything here is one function after inlining: right-hand sides and solutions go from one kernel to the next in
//! registers, as coefficients; factorials come last.

use super::arithmetic::PowerSeries;
use super::at_zero::Known;
use super::news::Found;
use super::next::Next;
use super::orders::{HigherOrders, array};
use super::start::Start;
use crate::mechanism::LengthError;
use crate::plan::{Depth, Plan, Solved};
use crate::planned::PlanError;
use crate::workspace::{Array, Instant};

impl<M: PowerSeries> HigherOrders<'_, M> {
    /// q, q̇, q̈ by the plan, and all orders up to the highest: what was computed for the ones
    /// ([`Mechanism::solve_and_factorise`]) the others begin with. Then [`derivative`](Self::derivative) has the orders
    /// from the third on; as q, q̇ and q̈ they are only good where all margins are positive.
    ///
    /// What [`begin`](Self::begin) left is gone then: [`order`](Self::order) is 0.
    ///
    /// # Errors
    /// [`PlanError::NoPlan`], and [`PlanError::Length`] when an argument has the wrong length.
    ///
    /// [`Mechanism::solve_and_factorise`]: crate::Mechanism::solve_and_factorise
    pub fn solve_by_plan(
        &mut self,
        at: &Instant<'_>,
        modes: &[f64],
        start: &[f64],
        solved: Solved<'_, f64>,
    ) -> Result<(), PlanError> {
        if let Some(why) = M::model().plan.absent {
            return Err(PlanError::NoPlan { why });
        }
        let Solved { q, q_dot, q_ddot, margins } = solved;
        let solved = Solved { q: &mut *q, q_dot: &mut *q_dot, q_ddot: &mut *q_ddot, margins };
        let (parameters, factors) = (self.parameters.as_ref(), Some(&mut self.factors));
        self.mechanism.solve_and_factorise(parameters, at, modes, start, Depth::Acceleration, solved, factors)?;
        Ok(self.solve_all(at, &[], [q, q_dot, q_ddot])?)
    }

    /// All orders from the third on at a known position, velocity and acceleration; false where there is no plan, where
    /// a block is singular or nearly so, and where something is no number.
    pub(super) fn solve_at(
        &mut self,
        at: &Instant<'_>,
        further: &[&[f64]],
        known: [&[f64]; 3],
    ) -> Result<bool, LengthError> {
        self.mechanism.factorise_with(self.parameters.as_ref(), at, known[0], &mut self.factors)?;
        if !self.is_regular() {
            return Ok(false);
        }
        self.solve_all(at, further, known)?;
        Ok(self.derivatives.iter().all(|derivative| derivative.as_ref().iter().all(|value| value.is_finite())))
    }

    /// True where there are factors, taken at a position, and all of them are far from singular.
    pub(super) fn is_regular(&self) -> bool {
        let (first, end) = M::REGULAR;
        let margins = self.factors.as_ref().get(first..end).unwrap_or_default();
        M::model().plan.exists() && margins.iter().all(|margin| *margin > Plan::SMALLEST_MARGIN)
    }

    /// All orders from the third on, with the factors that are there.
    pub(super) fn solve_all(
        &mut self,
        at: &Instant<'_>,
        further: &[&[f64]],
        known: [&[f64]; 3],
    ) -> Result<(), LengthError> {
        (self.missing, self.solved, self.order) = (None, 0, 0);
        let [q, q_dot, q_ddot] = known;
        let q: &M::Coordinates<f64> = array("q", M::COORDINATES, q)?;
        let (q_dot, q_ddot) = (array("q_dot", M::COORDINATES, q_dot)?, array("q_ddot", M::COORDINATES, q_ddot)?);
        self.q = *q;
        if self.highest < 3 {
            return Ok(());
        }
        if M::INPUTS > 0 {
            self.inputs.begin(at, further);
        }
        self.inputs.t = at.t;
        let zero = M::Coordinates::<f64>::filled(0.0);
        let mut right = M::Rows::<f64>::filled(0.0);
        let (first, end) = M::TURNS;
        let mut run = Start::<_, _, _, 4, false> {
            inputs: &self.inputs,
            q: [q, q_dot, q_ddot, &zero, &zero],
            at_zero: Known(self.factors.as_ref().get(first..end).unwrap_or_default()),
            tape: &mut self.constraints,
            keep: self.highest > 3,
            place: 0,
            rows: core::slice::from_mut(&mut right),
            missing: &mut self.missing,
        };
        self.mechanism.constraint_series(self.parameters.as_ref(), &mut run)?;
        let (mut found, mut order, mut factorial) = (zero, 3, 6.0);
        loop {
            M::solve_factorised(&self.factors, right.as_ref(), found.as_mut())?;
            if let Some(derivative) = self.derivatives.get_mut(order - 3) {
                *derivative = Array::generate(|k| factorial * found.as_ref()[k]);
            }
            self.solved = order;
            if order == self.highest {
                return Ok(());
            }
            order += 1;
            factorial *= order as f64;
            let mut run = Next {
                inputs: &self.inputs,
                news: Found(&found),
                tape: &mut self.constraints,
                place: 0,
                order,
                rows: &mut right,
                missing: &mut self.missing,
            };
            self.mechanism.constraint_series(self.parameters.as_ref(), &mut run)?;
        }
    }

    /// q⁽ᵏ⁾ for an order k ≥ 3 that [`solve_by_plan`](Self::solve_by_plan) has found, n numbers.
    pub fn derivative(&self, order: usize) -> Option<&[f64]> {
        let place = order.checked_sub(3).filter(|_| order <= self.solved)?;
        self.derivatives.get(place).map(AsRef::as_ref)
    }
}
