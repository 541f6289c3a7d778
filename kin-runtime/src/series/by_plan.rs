//! Derivatives of all orders at once: the generated plan evaluated over Taylor series.

use super::inputs::{Inputs, factorial};
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Solved};
use crate::scalar::{Scalar, Taylor};
use crate::signal::{Instant, Signal};
use crate::solver::Solver;
use crate::state::State;
use crate::workspace::Array;

/// Largest number of coefficients of all coordinates together for which the series are on the stack: a plan computes
/// about twenty values for each of them.
const MAX_STACK_COEFFICIENTS: usize = 1500;

/// Smallest power 2k − 1 of a margin for which rounding errors of order k stay below 1e-10: at a crossing of branches the
/// error is about ε/w²ᵏ⁻¹, where w² is the margin.
const MIN_MARGIN_POWER: f64 = 5e-12;

/// How far the plan's q, q̇ and q̈ may be from those of the state, relative to the largest number of each.
const SAME_STATE: f64 = 1e-8;

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
            _ if M::COORDINATES * (order + 1) > MAX_STACK_COEFFICIENTS => None,
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
        let mut inputs = M::Inputs::<Taylor<N>>::filled(Signal::constant(number(0.0)));
        write_signals(inputs.as_mut(), &signals);
        let at = Instant { t: Taylor::variable(at.t), inputs: inputs.as_ref() };
        // There are never more modes than coordinates, nor more margins than rows.
        let signs = modes.of_closures();
        let [mut series_of_signs, mut start] = [M::Coordinates::<Taylor<N>>::filled(number(0.0)); 2];
        write_constants(series_of_signs.as_mut(), signs);
        // Iterations start at their solution.
        write_constants(start.as_mut(), &state.q);
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
        let margins = &margins.as_ref()[..M::model().plan.margins];
        if are_accurate(margins, order) { derivatives_of(q.as_ref(), state, order) } else { None }
    }
}

/// Writes the series of all inputs.
fn write_signals<const N: usize>(to: &mut [Signal<Taylor<N>>], signals: &Inputs) {
    for (k, to) in to.iter_mut().enumerate() {
        *to = signals.signal(k, |coefficient| Taylor::new(core::array::from_fn(coefficient)));
    }
}

/// Writes constants.
fn write_constants<const N: usize>(to: &mut [Taylor<N>], numbers: &[f64]) {
    to.iter_mut().zip(numbers).for_each(|(to, number)| *to = Taylor::from_f64(*number));
}

/// Whether all margins are so large that derivatives up to this order are accurate: every order divides by a margin once
/// more.
fn are_accurate<const N: usize>(margins: &[Taylor<N>], order: usize) -> bool {
    let power = i32::try_from(2 * order - 1).unwrap_or(i32::MAX);
    let is_accurate = |margin: f64| margin > 0.0 && margin.powi(power) >= MIN_MARGIN_POWER;
    margins.iter().all(|margin| is_accurate(margin.coefficients()[0]))
}

/// The derivatives of q up to an order; `None` if they do not begin as those of the state, or are not finite.
fn derivatives_of<const N: usize>(q: &[Taylor<N>], state: &State, order: usize) -> Option<Vec<Vec<f64>>> {
    let derivative = |k: usize| q.iter().map(move |q| factorial(k) * q.coefficients()[k]);
    let mut all = Vec::with_capacity(order + 1);
    for (k, known) in [&state.q, &state.q_dot, &state.q_ddot].into_iter().enumerate() {
        let largest = known.iter().fold(1.0, |largest: f64, x| largest.max(x.abs()));
        if !derivative(k).zip(known).all(|(found, known)| (found - known).abs() <= SAME_STATE * largest) {
            return None;
        }
        all.push(known.clone());
    }
    all.extend((3..=order).map(|k| derivative(k).collect::<Vec<f64>>()));
    Some(all).filter(|all| all[3..].iter().flatten().all(|x| x.is_finite()))
}
