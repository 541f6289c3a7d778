//! Derivatives of all orders at once: the generated plan evaluated over Taylor series.

use super::inputs::{Inputs, factorial};
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Solved};
use crate::scalar::{Scalar, Taylor};
use crate::solver::Solver;
use crate::state::State;
use crate::workspace::{Array, Instant, Signal};

/// Largest number of coefficients of all coordinates together for which the series are on the stack: a plan computes
/// about twenty values for each of them.
const LARGEST: usize = 1500;

/// Smallest power of a margin, with the order as exponent, for which rounding errors of all orders stay below 1e-10: the
/// error of order k is about ε margin^(−k/2).
const ACCURATE: f64 = 1e-12;

/// How far the plan's q, q̇ and q̈ may be from those of the state, relative to the largest number of each.
const SAME: f64 = 1e-8;

impl<M: Mechanism> Solver<'_, M> {
    /// The derivatives of q up to `order`, which is at least 3, at a state: the plan is evaluated over [`Taylor`] series,
    /// whose coefficients give all orders. Those up to the second are the state's own.
    ///
    /// `None` if they must be computed order by order: without a plan, for redundant rows, whose higher derivatives the
    /// plan does not check, near singular configurations, at a q that is no solution of the plan, above the tenth
    /// order, for mechanisms of hundreds of coordinates, and where a derivative is unknown or not finite.
    pub(super) fn expanded(&self, state: &State, order: usize, further: &[&[f64]]) -> Option<Vec<Vec<f64>>> {
        let at = state.instant();
        if M::model().plan.has_redundant_rows() || !self.goes_by_plan(&at) {
            return None;
        }
        match order {
            _ if M::COORDINATES * (order + 1) > LARGEST => None,
            ..4 => self.expand::<4>(state, order, further),
            4..6 => self.expand::<6>(state, order, further),
            6..11 => self.expand::<11>(state, order, further),
            _ => None,
        }
    }

    /// The plan over series with `N` coefficients.
    fn expand<const N: usize>(&self, state: &State, order: usize, further: &[&[f64]]) -> Option<Vec<Vec<f64>>> {
        let (mechanism, at) = (self.mechanism, state.instant());
        let parameters = mechanism.parameters::<f64>();
        let modes = self.modes_at(&parameters, &at, &state.q)?;
        let mut signals = Inputs::new(order, M::INPUTS);
        signals.begin(&at, further);
        let number = Taylor::<N>::from_f64;
        let inputs = M::Inputs::<Taylor<N>>::generate(Signal::constant(number(0.0)), |k| {
            signals.signal(k, |coefficient| Taylor::new(core::array::from_fn(coefficient)))
        });
        let at = Instant { t: Taylor::variable(at.t), inputs: inputs.as_ref() };
        // There are never more modes than coordinates, nor more margins than rows.
        let signs = modes.of_closures();
        let series_of_signs =
            M::Coordinates::<Taylor<N>>::generate(number(0.0), |k| number(signs.get(k).copied().unwrap_or(0.0)));
        // Iterations start at their solution.
        let start = M::Coordinates::<Taylor<N>>::generate(number(0.0), |k| number(state.q[k]));
        let [mut q, mut q_dot, mut q_ddot] = [M::Coordinates::filled(number(0.0)); 3];
        let mut margins = M::Rows::filled(number(0.0));
        let solved = Solved {
            q: q.as_mut(),
            q_dot: q_dot.as_mut(),
            q_ddot: q_ddot.as_mut(),
            margins: &mut margins.as_mut()[..M::model().plan.margins],
        };
        let (parameters, signs) = (mechanism.parameters::<Taylor<N>>(), &series_of_signs.as_ref()[..signs.len()]);
        mechanism.solve_with(parameters.as_ref(), &at, signs, start.as_ref(), Depth::Position, solved).ok()?;
        // Every order divides by the root of a margin once more.
        let power = i32::try_from(order).unwrap_or(i32::MAX);
        let is_regular = |margin: &Taylor<N>| {
            let margin = margin.coefficients()[0];
            margin > 0.0 && margin.powi(power) >= ACCURATE
        };
        if !margins.as_ref()[..M::model().plan.margins].iter().all(is_regular) {
            return None;
        }
        let derivative = |k: usize| q.as_ref().iter().map(move |q| factorial(k) * q.coefficients()[k]);
        for (k, known) in [&state.q, &state.q_dot, &state.q_ddot].into_iter().enumerate() {
            let largest = known.iter().fold(1.0, |largest: f64, x| largest.max(x.abs()));
            if !derivative(k).zip(known).all(|(found, known)| (found - known).abs() <= SAME * largest) {
                return None;
            }
        }
        let mut all = Vec::with_capacity(order + 1);
        all.extend([&state.q, &state.q_dot, &state.q_ddot].map(Vec::clone));
        all.extend((3..=order).map(|k| derivative(k).collect::<Vec<f64>>()));
        Some(all).filter(|all| all[3..].iter().flatten().all(|x| x.is_finite()))
    }
}
