//! Derivatives of all orders at once: the generated plan evaluated over Taylor series.

use super::inputs::factorial;
use super::orders::{HigherOrders, array};
use crate::mechanism::LengthError;
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Solved};
use crate::planned::PlanError;
use crate::scalar::{Scalar, Taylor};
use crate::workspace::{Array, Instant};

/// Largest number of coefficients of all coordinates together for which the series are on the stack: a plan computes
/// about twenty values for each of them.
const LARGEST: usize = 1500;

impl<M: Mechanism> HigherOrders<'_, M> {
    /// q, q̇, q̈ by the plan, and all orders up to the highest: [`derivative`](Self::derivative) returns those from the
    /// third on. They are valid only if all margins are positive.
    ///
    /// The plan is evaluated over [`Taylor`] series, whose coefficients give all orders. Above the tenth order, and for
    /// mechanisms of hundreds of coordinates, it computes one order after another, by [`right`](Self::right) and
    /// [`solve`](Self::solve). The state of [`begin`](Self::begin) is lost then: [`order`](Self::order) is 0.
    ///
    /// # Errors
    /// [`PlanError::NoPlan`], and [`PlanError::Length`] when an argument has the wrong length.
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
        (self.order, self.solved) = (0, 0);
        let Solved { q, q_dot, q_ddot, margins } = solved;
        let solved = Solved { q: &mut *q, q_dot, q_ddot, margins };
        match self.highest {
            3.. if M::COORDINATES * (self.highest + 1) > LARGEST => self.solve_one_by_one(at, modes, start, solved)?,
            0..3 => {
                let parameters = self.parameters.as_ref();
                self.mechanism.solve_with(parameters, at, modes, start, Depth::Acceleration, solved)?;
            }
            3 => self.expand::<4>(at, modes, start, solved)?,
            4..6 => self.expand::<6>(at, modes, start, solved)?,
            6..8 => self.expand::<8>(at, modes, start, solved)?,
            8..11 => self.expand::<11>(at, modes, start, solved)?,
            _ => self.solve_one_by_one(at, modes, start, solved)?,
        }
        self.derivatives[0] = *array("q", M::COORDINATES, q)?;
        self.solved = self.highest;
        Ok(())
    }

    /// The plan over series with `N` coefficients.
    #[inline]
    fn expand<const N: usize>(
        &mut self,
        at: &Instant<'_>,
        modes: &[f64],
        start: &[f64],
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError> {
        let (mechanism, plan) = (self.mechanism, &M::model().plan);
        let Solved { q, q_dot, q_ddot, margins } = solved;
        let length = |what, expected, found| {
            if expected == found { Ok(()) } else { Err(LengthError { what, expected, found }) }
        };
        length("inputs", M::INPUTS, at.inputs.len())?;
        length("modes", plan.modes.len(), modes.len())?;
        length("margins", plan.margins, margins.len())?;
        let mut start: M::Coordinates<f64> = *array("start", M::COORDINATES, start)?;
        // Iterations start from their solution for plain numbers, and redundant rows are checked with q̇ and q̈ of
        // plain numbers.
        let by_numbers = !plan.orientations.is_empty() || plan.watched().next().is_some();
        if by_numbers {
            let solved = Solved { q: &mut *q, q_dot: &mut *q_dot, q_ddot: &mut *q_ddot, margins: &mut *margins };
            let parameters = self.parameters.as_ref();
            mechanism.solve_with(parameters, at, modes, start.as_ref(), Depth::Acceleration, solved)?;
            start = *array("q", M::COORDINATES, q)?;
        }
        self.inputs.begin(at, &[]);
        let number = Taylor::<N>::from_f64;
        let inputs = M::Inputs::<Taylor<N>>::generate(|k| {
            self.inputs.signal(k, |coefficient| Taylor::new(core::array::from_fn(coefficient)))
        });
        let at = Instant { t: Taylor::variable(at.t), inputs: inputs.as_ref() };
        // There are never more modes than coordinates, nor more margins than rows.
        let all_modes = M::Coordinates::<Taylor<N>>::generate(|k| number(modes.get(k).copied().unwrap_or(0.0)));
        let start = M::Coordinates::<Taylor<N>>::generate(|k| number(start.as_ref()[k]));
        let [mut found, mut rates, mut accelerations] = [M::Coordinates::filled(number(0.0)); 3];
        let mut found_margins = M::Rows::filled(number(0.0));
        let solved = Solved {
            q: found.as_mut(),
            q_dot: rates.as_mut(),
            q_ddot: accelerations.as_mut(),
            margins: &mut found_margins.as_mut()[..plan.margins],
        };
        let (parameters, modes) = (mechanism.parameters::<Taylor<N>>(), &all_modes.as_ref()[..modes.len()]);
        mechanism.solve_with(parameters.as_ref(), &at, modes, start.as_ref(), Depth::Position, solved)?;
        let found = found.as_ref();
        if !by_numbers {
            for (derivative, order) in [q, q_dot, q_ddot].into_iter().zip(0..) {
                length(["q", "q_dot", "q_ddot"][order], M::COORDINATES, derivative.len())?;
                let values = found.iter().map(|series| factorial(order) * series.coefficients()[order]);
                derivative.iter_mut().zip(values).for_each(|(place, value)| *place = value);
            }
            for (margin, found) in margins.iter_mut().zip(found_margins.as_ref()) {
                *margin = found.coefficients()[0];
            }
        }
        for (order, derivative) in self.derivatives.iter_mut().enumerate().skip(3) {
            let factorial = factorial(order);
            let values = found.iter().map(|series| factorial * series.coefficients()[order]);
            derivative.as_mut().iter_mut().zip(values).for_each(|(place, value)| *place = value);
        }
        Ok(())
    }

    /// q, q̇ and q̈ by the plan, then order after order with the factors of Φ_q.
    fn solve_one_by_one(
        &mut self,
        at: &Instant<'_>,
        modes: &[f64],
        start: &[f64],
        solved: Solved<'_, f64>,
    ) -> Result<(), LengthError> {
        let Solved { q, q_dot, q_ddot, margins } = solved;
        let solved = Solved { q: &mut *q, q_dot: &mut *q_dot, q_ddot: &mut *q_ddot, margins };
        self.mechanism.solve_with(self.parameters.as_ref(), at, modes, start, Depth::Acceleration, solved)?;
        self.begin(at, q, q_dot, q_ddot)?;
        self.factorise(at)?;
        while self.order > 0 {
            let mut derivative = M::Coordinates::<f64>::filled(0.0);
            self.solve(derivative.as_mut())?;
            self.derivatives[self.order] = derivative;
            self.advance(derivative.as_ref())?;
        }
        Ok(())
    }

    /// q⁽ᵏ⁾ for an order k ≥ 3 that [`solve_by_plan`](Self::solve_by_plan) has found, n numbers.
    pub fn derivative(&self, order: usize) -> Option<&[f64]> {
        let is_found = (3..=self.solved).contains(&order);
        self.derivatives.get(order).filter(|_| is_found).map(AsRef::as_ref)
    }
}
