//! Higher-order analysis: one order after another, with the factorisation of velocity and acceleration analysis.

use super::orders::{HigherOrders, Orders};
use super::tape::Missing;
use crate::analysis::acceleration::acceleration;
use crate::analysis::by_plan;
use crate::analysis::rounding::dominated_coordinate;
use crate::analysis::velocity::{self, factorize, inconsistency, scaled};
use crate::equations::Equations;
use crate::equations::scale::Scale;
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::mechanism::LengthError;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::scalar::compare::all_finite;
use crate::signal::{Instant, Signal};
use crate::solver::Solver;
use crate::state::State;
use crate::text::numbers;
use core::fmt;
use nalgebra::DVector;

/// Derivatives of q with respect to time at one instant: position, velocity, acceleration, jerk, snap, ….
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Derivatives {
    /// Time.
    pub t: f64,
    /// The inputs, in the order of declaration.
    pub inputs: Vec<Signal>,
    /// Their derivatives from the third on, as far as they were given.
    pub further: Vec<Vec<f64>>,
    /// q, q̇, q̈, q⃛, …: n numbers for every order, in the user's unit over the unit of time to that power.
    pub q: Vec<Vec<f64>>,
    /// True if the orders from the third on were solved by the plan; false without a plan, and if a step of the plan is
    /// singular at this configuration, so that Φ_q was factorised as a whole.
    pub by_plan: bool,
}

impl Derivatives {
    fn new(state: &State, further: &[&[f64]], q: Vec<Vec<f64>>, by_plan: bool) -> Self {
        let further = further.iter().map(|list| list.to_vec()).collect();
        Self { t: state.t, inputs: state.inputs.clone(), further, q, by_plan }
    }

    /// The highest order; 0 also if `q` is empty.
    pub fn order(&self) -> usize {
        self.q.len().saturating_sub(1)
    }

    /// The instant, to hand to other analyses.
    pub fn instant(&self) -> Instant<'_> {
        Instant { t: self.t, inputs: &self.inputs }
    }

    /// The inputs' derivatives from the third on.
    pub(super) fn further(&self) -> Vec<&[f64]> {
        self.further.iter().map(Vec::as_slice).collect()
    }
}

impl<M: Mechanism> Solver<'_, M> {
    /// All derivatives of q up to `order` at a solved state: the third is jerk.
    ///
    /// Orders 0, 1, 2 are those of the state. Up to the tenth order a plan that uses all rows gives all orders at once:
    /// it is a formula for q(t), which is evaluated over truncated power series. Otherwise every order is one more
    /// right-hand side for Φ_q q⁽ᵏ⁾ = …, with the factorisation that gives q̇ and q̈; see [`series`](crate::series). The
    /// factors are those of the plan's blocks if no block is nearly singular; otherwise Φ_q is factorised as a whole
    /// ([`Derivatives::by_plan`] shows which). If degrees of freedom are open, every order is the one of least norm, as
    /// q̇ and q̈ are.
    ///
    /// Inputs are known with value, rate and acceleration, supplied functions up to the order that they provide
    /// ([`ScalarFunction::derivatives`](crate::ScalarFunction::derivatives)): an order that needs higher derivatives of
    /// them is an error that names them, and [`derivatives_with`](Self::derivatives_with) takes further derivatives of
    /// inputs. Prescribed coordinates continue with constant acceleration.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, mechanism};
    ///
    /// /// A crank of length 2 that turns once in 2π.
    /// #[mechanism]
    /// #[bodies(crank)]
    /// #[revolute(pin: ground @ (0, 0), crank @ (-2, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// struct Crank;
    ///
    /// let solver = Crank.solver();
    /// let state = solver.state(&0.0.into())?;
    /// let derivatives = solver.derivatives(&state, 4)?;
    /// // x = 2 cos t, y = 2 sin t, φ = t.
    /// let expected = [[2.0, 0.0, 0.0], [0.0, 2.0, 1.0], [-2.0, 0.0, 0.0], [0.0, -2.0, 0.0], [2.0, 0.0, 0.0]];
    /// for (found, expected) in derivatives.q.iter().zip(expected) {
    ///     assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-14));
    /// }
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity); [`UnknownDerivative`](SolveError::UnknownDerivative) where an input or a
    /// supplied function is not known far enough, [`NotSmooth`](SolveError::NotSmooth) where a row has no such
    /// derivative, [`OutOfRange`](SolveError::OutOfRange) where it exceeds the range of `f64`, which is possible for
    /// all derivatives beyond order [`HigherOrders::MOST`],
    /// [`InconsistentDerivative`](SolveError::InconsistentDerivative) where redundant rows disagree, and
    /// [`Rounded`](SolveError::Rounded) near a singular configuration, where rounding errors dominate: at a distance of δ
    /// radians from a crossing of branches they are magnified by about 1/δ²ᵏ⁻¹ in order k.
    pub fn derivatives(&self, state: &State, order: usize) -> Result<Derivatives, SolveError> {
        self.derivatives_with(state, order, &[])
    }

    /// [`derivatives`](Self::derivatives) with, for every input in the order of declaration, its derivatives from the
    /// third on as far as they are known: `&[&[u⃛, u⁗]]`.
    ///
    /// # Errors
    /// As [`derivatives`](Self::derivatives), and [`Length`](SolveError::Length) for more lists than inputs.
    pub fn derivatives_with(&self, state: &State, order: usize, further: &[&[f64]]) -> Result<Derivatives, SolveError> {
        if order > HigherOrders::<M>::MOST {
            return Err(SolveError::OutOfRange { t: state.t, order });
        }
        check_further(M::model(), further)?;
        if order > 2
            && are_finite(state, M::COORDINATES)
            && let Some(q) = self.expanded(state, order, further)
        {
            return Ok(Derivatives::new(state, further, q, true));
        }
        let mut orders = HigherOrders::new(self.mechanism, order);
        derivatives(&mut self.equations_of(state)?, &mut orders, state, order, further)
    }
}

/// Checks that there are no more lists than inputs, and that their numbers are finite.
fn check_further(model: &Model, further: &[&[f64]]) -> Result<(), SolveError> {
    if further.len() > model.inputs.len() {
        let (what, expected, found) = ("inputs", model.inputs.len(), further.len());
        return Err(SolveError::Length(LengthError { what, expected, found }));
    }
    match further.iter().position(|list| !all_finite(list)) {
        Some(index) => Err(SolveError::NonFinite { what: "inputs", index, name: model.inputs[index], t: None }),
        None => Ok(()),
    }
}

/// Whether the coordinates of a state and their rates are n finite numbers each.
fn are_finite(state: &State, n: usize) -> bool {
    [&state.q, &state.q_dot, &state.q_ddot].iter().all(|list| list.len() == n && all_finite(list))
}

/// All orders at a state.
fn derivatives(
    equations: &mut Equations<'_>,
    orders: &mut dyn Orders,
    state: &State,
    order: usize,
    further: &[&[f64]],
) -> Result<Derivatives, SolveError> {
    let known = [&state.q, &state.q_dot, &state.q_ddot];
    for (what, vector) in ["q", "q_dot", "q_ddot"].into_iter().zip(known) {
        equations.check(what, vector)?;
    }
    let mut q: Vec<Vec<f64>> = known.into_iter().take(order + 1).cloned().collect();
    let mut by_plan = false;
    if order > 2 {
        orders.begin_with(&state.instant(), further, known.map(Vec::as_slice))?;
        // The plan does not check higher orders of rows that it leaves out: with such rows, the whole Φ_q shows whether
        // they agree.
        let all_rows = !equations.model.plan.has_redundant_rows();
        let may_use_plan = all_rows && equations.options.use_plan && by_plan::exists(equations);
        by_plan = may_use_plan && orders.factorise(&state.instant())?;
    }
    if order > 2 {
        equations.scale = Scale::around(equations, &state.q);
        let factor = factorize(equations, &state.q, None)?;
        let whole = if by_plan { None } else { Some(&factor) };
        add_orders(equations, orders, whole, order, &mut q)?;
        check_rounding(equations, orders, (state, further), &factor, order)?;
    }
    Ok(Derivatives::new(state, further, q, by_plan))
}

/// Adds the derivatives from the third to `order` to the known ones.
fn add_orders(
    equations: &Equations<'_>,
    orders: &mut dyn Orders,
    whole: Option<&Factorization>,
    order: usize,
    q: &mut Vec<Vec<f64>>,
) -> Result<(), SolveError> {
    for k in 3..=order {
        if let Some(error) = undefined(equations, orders, k, &q[k - 1]) {
            return Err(error);
        }
        let derivative = solve(equations, orders, whole, k)?;
        if k < order {
            orders.advance(&derivative)?;
        }
        q.push(derivative);
    }
    Ok(())
}

/// Largest deviation of q̇ and q̈ from those at q, relative to the largest of each, for which they count as the rates there.
/// Others are numbers of the caller's own, or more accurate than rounding at q allows.
const OF_SOLUTION: f64 = 1e-3;

/// The error if rounding dominates a derivative of the third order or above; `factor` is the factorisation of Φ_q at q.
fn check_rounding(
    equations: &mut Equations<'_>,
    orders: &mut dyn Orders,
    (state, further): (&State, &[&[f64]]),
    factor: &Factorization,
    order: usize,
) -> Result<(), SolveError> {
    let rates = |equations: &mut Equations<'_>, q: &[f64]| {
        let factor = factorize(equations, q, Some(factor.rank))?;
        let q_dot = velocity::solve(equations, &factor)?.as_slice().to_vec();
        let q_ddot = acceleration(equations, q, &q_dot, &factor)?;
        Ok::<_, SolveError>((factor, q_dot, q_ddot))
    };
    let is_near = |equations: &Equations<'_>, found: &[f64], known: &[f64]| {
        let off: Vec<f64> = found.iter().zip(known).map(|(found, known)| found - known).collect();
        equations.scale.size(&off) <= OF_SOLUTION * equations.scale.size(known)
    };
    let mut derivatives_at = |equations: &mut Equations<'_>, beside: Vec<f64>, own: bool| {
        let (factor_beside, q_dot, q_ddot) = match own {
            true => (factorize(equations, &beside, Some(factor.rank))?, state.q_dot.clone(), state.q_ddot.clone()),
            false => rates(equations, &beside)?,
        };
        orders.begin_with(&state.instant(), further, [&beside, &q_dot, &q_ddot])?;
        let mut all = vec![beside, q_dot, q_ddot];
        add_orders(equations, orders, Some(&factor_beside), order, &mut all)?;
        Ok(all)
    };
    // Without rates at q there is nothing with which those of the state, which the caller may have set, can be compared.
    let Ok(mut all) = derivatives_at(equations, state.q.clone(), false) else { return Ok(()) };
    // Rates of the caller's own, and those that are more accurate than rounding at q allows, are kept beside q.
    let own = !is_near(equations, &all[1], &state.q_dot) || !is_near(equations, &all[2], &state.q_ddot);
    if own {
        let Ok(with_own) = derivatives_at(equations, state.q.clone(), true) else { return Ok(()) };
        all = with_own;
    }
    let mut beside_at = |equations: &mut Equations<'_>, beside: Vec<f64>| derivatives_at(equations, beside, own);
    match dominated_coordinate(equations, &all, 3, factor, &mut beside_at) {
        Some(k) => Err(SolveError::Rounded { t: state.t, coordinate: equations.model.coordinates[k].name }),
        None => Ok(()),
    }
}

/// q⁽ᵏ⁾ with Φ_q q⁽ᵏ⁾ = b: by the blocks of the plan, unless Φ_q is factorised as a whole. Right-hand sides of
/// prescribed coordinates are 0.
fn solve(
    equations: &Equations<'_>,
    orders: &dyn Orders,
    whole: Option<&Factorization>,
    k: usize,
) -> Result<Vec<f64>, SolveError> {
    let right_side = orders.right();
    let right = DVector::from_fn(equations.rows(), |row, _| right_side.get(row).copied().unwrap_or(0.0));
    let right = scaled(equations, &right);
    let solution = match whole {
        Some(factor) => factor.solve(&right),
        None => {
            let mut solution = DVector::zeros(equations.coordinates());
            orders.solve(solution.as_mut_slice())?;
            solution
        }
    };
    // If the solution is not finite, consistency cannot be tested.
    if !solution.iter().all(|x| x.is_finite()) {
        return Err(SolveError::OutOfRange { t: equations.t, order: k });
    }
    if let Some(factor) = whole
        && let Some((row, residual)) = inconsistency(equations, &solution, &right, 0.0)
    {
        let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
        let (t, rank) = (equations.t, factor.rank);
        return Err(SolveError::InconsistentDerivative { t, order: k, residual, row_name, joint, rank });
    }
    Ok(solution.as_slice().to_vec())
}

/// If a derivative exceeds this, a next one that is not finite is out of range; otherwise a divisor is 0.
const HUGE_DERIVATIVE: f64 = 1e200;

/// The reason why the k-th derivatives of the rows are not finite, if they are not, given q⁽ᵏ⁻¹⁾.
fn undefined(equations: &Equations<'_>, orders: &dyn Orders, k: usize, before: &[f64]) -> Option<SolveError> {
    let row = orders.right().iter().position(|b| !b.is_finite())?;
    let t = equations.t;
    // An unknown derivative is NaN; so is the difference of two infinite numbers.
    let missing = unknown(equations, orders.missing(), k).filter(|_| orders.right()[row].is_nan());
    if missing.is_none() && before.iter().any(|x| x.abs() > HUGE_DERIVATIVE) {
        return Some(SolveError::OutOfRange { t, order: k });
    }
    let (row_name, joint) = (equations.row_name(row), equations.joint_name(row));
    Some(missing.unwrap_or(SolveError::NotSmooth { t, order: k, row_name, joint }))
}

/// The error for an input or a function whose derivatives are not known up to order k.
pub(super) fn unknown(equations: &Equations<'_>, missing: Option<Missing>, order: usize) -> Option<SolveError> {
    let (model, t) = (equations.model, equations.t);
    Some(match missing? {
        Missing::Input { index, known } => {
            let name = model.inputs.get(index).copied().unwrap_or_default();
            SolveError::UnknownDerivative { t, order, what: "input", name, known }
        }
        Missing::Function { number, known } => {
            let name = model.functions.get(number).copied().unwrap_or_default();
            SolveError::UnknownDerivative { t, order, what: "function", name, known }
        }
    })
}

/// A line per order.
impl fmt::Display for Derivatives {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "t = {}", self.t)?;
        self.q.iter().enumerate().try_for_each(|(order, values)| {
            write!(f, "\norder {order}: ")?;
            numbers(f, values)
        })
    }
}
