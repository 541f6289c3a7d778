//! Right-hand sides order by order, and what is known of q so far.

use super::arithmetic::PowerSeries;
use super::at_zero::Computed;
use super::inputs::{Inputs, factorial};
use super::news::{Found, FoundRates, Known};
use super::next::Next;
use super::start::Start;
use super::tape::{Missing, Tape};
use crate::mechanism::LengthError;
use crate::model::Level;
use crate::workspace::{Array, Instant};

/// The equations of derivatives of order 3 and higher, for a caller with a linear solver of its own.
///
/// [`begin`](Self::begin) at an instant with q, q̇, q̈; then [`right`](Self::right) is the right-hand side b of
///
/// ```text
/// Φ_q q⁽ᵏ⁾ = b
/// ```
///
/// for [`order`](Self::order) k = 3, with Φ_q of that q; [`advance`](Self::advance) takes the solution and goes on to
/// k + 1. After the first instant nothing is allocated. [`Solver::derivatives`](crate::Solver::derivatives) does all of
/// this, with its own factorisation and its errors; here a b that cannot be computed is not finite.
///
/// ```
/// use kin_runtime::series::HigherOrders;
/// use kin_runtime::{Instant, mechanism};
///
/// /// A wheel that speeds up: φ = t³, so that the third derivative of its angle is 6.
/// #[mechanism]
/// #[coordinates(phi)]
/// #[driver(drive: phi = t.powi(3))]
/// struct Wheel;
///
/// let mut orders = HigherOrders::new(&Wheel, 3);
/// orders.begin(&Instant::at(2.0), &[8.0], &[12.0], &[12.0])?;
/// assert_eq!((orders.order(), orders.right()), (3, &[6.0][..]));
/// # Ok::<(), kin_runtime::LengthError>(())
/// ```
pub struct HigherOrders<'m, M: PowerSeries> {
    pub(super) mechanism: &'m M,
    pub(super) parameters: M::Parameters<f64>,
    pub(super) inputs: Inputs,
    pub(super) constraints: Tape,
    velocities: Tape,
    observables: Tape,
    /// q of the last instant.
    pub(super) q: M::Coordinates<f64>,
    right: M::Rows<f64>,
    pub(super) factors: M::Factors<f64>,
    /// From the third on, as far as they are solved.
    pub(super) derivatives: Vec<M::Coordinates<f64>>,
    pub(super) solved: usize,
    pub(super) missing: Option<Missing>,
    /// The order of `right`, and its factorial; 0 where it means nothing.
    pub(super) order: usize,
    factorial: f64,
    pub(super) highest: usize,
    /// Rows of velocity level.
    of_velocity: Vec<usize>,
}

/// A vector as the array that it must be.
pub(super) fn array<'a, C: Array<f64>>(
    what: &'static str,
    expected: usize,
    list: &'a [f64],
) -> Result<&'a C, LengthError> {
    C::view(list).ok_or(LengthError { what, expected, found: list.len() })
}

impl<'m, M: PowerSeries> HigherOrders<'m, M> {
    /// The highest order that there is: 171! is more than an `f64` can hold.
    pub const MOST: usize = 170;

    /// Room for derivatives up to `highest`, or up to [`MOST`](Self::MOST).
    pub fn new(mechanism: &'m M, highest: usize) -> Self {
        let (rows, highest) = (M::model().rows, highest.min(Self::MOST));
        let is_of_velocity = |row: &usize| rows.get(*row).is_some_and(|info| info.level == Level::Velocity);
        Self {
            mechanism,
            parameters: mechanism.parameters(),
            inputs: Inputs::new(highest, M::INPUTS),
            constraints: Tape::new(highest.max(3)),
            velocities: Tape::new(highest.max(3)),
            observables: Tape::new(highest.max(3)),
            q: Array::filled(0.0),
            right: Array::filled(0.0),
            factors: Array::filled(0.0),
            derivatives: vec![Array::filled(0.0); (highest + 1).saturating_sub(3)],
            solved: 0,
            missing: None,
            order: 0,
            factorial: 1.0,
            highest,
            of_velocity: (0..M::ROWS).filter(is_of_velocity).collect(),
        }
    }

    /// Begins with q, q̇, q̈ at an instant; inputs are known with value, rate and acceleration.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    pub fn begin(&mut self, at: &Instant<'_>, q: &[f64], q_dot: &[f64], q_ddot: &[f64]) -> Result<(), LengthError> {
        self.begin_with(at, &[], [q, q_dot, q_ddot])
    }

    /// [`begin`](Self::begin) with q, q̇, q̈ and, for every input, its derivatives from the third on as far as they are
    /// known.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    pub fn begin_with(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<(), LengthError> {
        self.check_inputs(at)?;
        let [q, q_dot, q_ddot] = known;
        let q: &M::Coordinates<f64> = array("q", M::COORDINATES, q)?;
        let (q_dot, q_ddot) = (array("q_dot", M::COORDINATES, q_dot)?, array("q_ddot", M::COORDINATES, q_ddot)?);
        if M::INPUTS > 0 {
            self.inputs.begin(at, further);
        }
        self.inputs.t = at.t;
        (self.q, self.order, self.factorial, self.missing, self.solved) = (*q, 3, 6.0, None, 0);
        let keep = self.highest > 3;
        let zero = M::Coordinates::<f64>::filled(0.0);
        let known = [q, q_dot, q_ddot, &zero, &zero];
        let (mut phi, mut eta) = (self.right, self.right);
        let mut start = Start::<_, _, _, 4, false> {
            inputs: &self.inputs,
            q: known,
            at_zero: Computed,
            tape: &mut self.constraints,
            keep,
            place: 0,
            rows: core::slice::from_mut(&mut phi),
            missing: &mut self.missing,
        };
        self.mechanism.constraint_series(self.parameters.as_ref(), &mut start)?;
        if !self.of_velocity.is_empty() {
            let mut start = Start::<_, _, _, 3, false> {
                inputs: &self.inputs,
                q: known,
                at_zero: Computed,
                tape: &mut self.velocities,
                keep,
                place: 0,
                rows: core::slice::from_mut(&mut eta),
                missing: &mut self.missing,
            };
            self.mechanism.velocity_series(self.parameters.as_ref(), &mut start)?;
        }
        self.write_right(&phi, &eta);
        Ok(())
    }

    pub(super) fn check_inputs(&self, at: &Instant<'_>) -> Result<(), LengthError> {
        let (expected, found) = (M::INPUTS, at.inputs.len());
        if expected == found { Ok(()) } else { Err(LengthError { what: "inputs", expected, found }) }
    }

    /// The order k of [`right`](Self::right); 0 where nothing has begun, and after the last order that was asked for.
    pub fn order(&self) -> usize {
        self.order
    }

    /// b, s numbers, with Φ_q q⁽ᵏ⁾ = b; none where [`order`](Self::order) is 0.
    pub fn right(&self) -> &[f64] {
        if self.order == 0 { &[] } else { self.right.as_ref() }
    }

    /// Takes the factors of Φ_q by the blocks of the plan, at the instant and the q that it began with, for
    /// [`solve`](Self::solve); false where there is no plan, and where a block is singular or nearly so.
    ///
    /// # Errors
    /// When the inputs have the wrong length.
    pub fn factorise(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        self.mechanism.factorise_with(self.parameters.as_ref(), at, self.q.as_ref(), &mut self.factors)?;
        Ok(self.is_regular())
    }

    /// q⁽ᵏ⁾ with the factors of [`factorise`](Self::factorise), n numbers, to hand to [`advance`](Self::advance). As in
    /// [`Mechanism::solve_factorised`] it is only good where Φ_q is not singular: where
    /// [`factorise`](Self::factorise) was true.
    ///
    /// # Errors
    /// When the vector has the wrong length, and where there is no right-hand side: where [`order`](Self::order) is 0.
    ///
    /// [`Mechanism::solve_factorised`]: crate::Mechanism::solve_factorised
    pub fn solve(&self, derivative: &mut [f64]) -> Result<(), LengthError> {
        M::solve_factorised(&self.factors, self.right(), derivative)
    }

    /// Takes q⁽ᵏ⁾, n numbers, and goes on to the next order, where one was asked for; after the last one
    /// [`order`](Self::order) is 0.
    ///
    /// # Errors
    /// When the vector has the wrong length.
    pub fn advance(&mut self, derivative: &[f64]) -> Result<(), LengthError> {
        let derivative: &M::Coordinates<f64> = array("derivative", M::COORDINATES, derivative)?;
        if self.order == 0 || self.order >= self.highest {
            self.order = 0;
            return Ok(());
        }
        let part = 1.0 / self.factorial;
        let found = M::Coordinates::<f64>::generate(|k| part * derivative.as_ref()[k]);
        self.order += 1;
        self.factorial *= self.order as f64;
        let (mut phi, mut eta) = (self.right, self.right);
        let mut next = Next {
            inputs: &self.inputs,
            news: Found(&found),
            tape: &mut self.constraints,
            place: 0,
            order: self.order,
            rows: &mut phi,
            missing: &mut self.missing,
        };
        self.mechanism.constraint_series(self.parameters.as_ref(), &mut next)?;
        if !self.of_velocity.is_empty() {
            let order = self.order - 1;
            let mut next = Next {
                inputs: &self.inputs,
                news: FoundRates { found: &found, order },
                tape: &mut self.velocities,
                place: 0,
                order,
                rows: &mut eta,
                missing: &mut self.missing,
            };
            self.mechanism.velocity_series(self.parameters.as_ref(), &mut next)?;
        }
        self.write_right(&phi, &eta);
        Ok(())
    }

    /// b = −k! [τᵏ] Φ, and −(k − 1)! [τ^{k−1}] η, given the opposites of both.
    fn write_right(&mut self, phi: &M::Rows<f64>, eta: &M::Rows<f64>) {
        let (right, phi) = (self.right.as_mut(), phi.as_ref());
        right.iter_mut().zip(phi).for_each(|(right, phi)| *right = self.factorial * phi);
        for &row in &self.of_velocity {
            right[row] = self.factorial / self.order as f64 * eta.as_ref()[row];
        }
    }
}

/// The same without the type of the mechanism, for analyses that are compiled once.
pub(super) trait Orders {
    /// [`HigherOrders::begin_with`].
    fn begin_with(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<(), LengthError>;
    /// [`HigherOrders::right`].
    fn right(&self) -> &[f64];
    /// [`HigherOrders::advance`].
    fn advance(&mut self, derivative: &[f64]) -> Result<(), LengthError>;
    /// What some coefficient would have needed.
    fn missing(&self) -> Option<Missing>;
    /// [`HigherOrders::solve_at`].
    fn solve_at(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<bool, LengthError>;
    /// [`HigherOrders::derivative`].
    fn derivative(&self, order: usize) -> Option<&[f64]>;
    /// The coefficients of all observables, order by order, where q is known with `q` to the highest order.
    fn observe(&mut self, at: &Instant<'_>, further: &[&[f64]], q: &[Vec<f64>]) -> Result<Vec<f64>, LengthError>;
}

impl<M: PowerSeries> Orders for HigherOrders<'_, M> {
    fn begin_with(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<(), LengthError> {
        HigherOrders::begin_with(self, at, further, known)
    }

    fn right(&self) -> &[f64] {
        HigherOrders::right(self)
    }

    fn advance(&mut self, derivative: &[f64]) -> Result<(), LengthError> {
        HigherOrders::advance(self, derivative)
    }

    fn missing(&self) -> Option<Missing> {
        self.missing
    }

    fn solve_at(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<bool, LengthError> {
        HigherOrders::solve_at(self, at, further, known)
    }

    fn derivative(&self, order: usize) -> Option<&[f64]> {
        HigherOrders::derivative(self, order)
    }

    fn observe(&mut self, at: &Instant<'_>, further: &[&[f64]], q: &[Vec<f64>]) -> Result<Vec<f64>, LengthError> {
        if M::INPUTS > 0 {
            self.inputs.begin(at, further);
        }
        self.inputs.t = at.t;
        self.missing = None;
        let zero = M::Coordinates::<f64>::filled(0.0);
        let mut known = [&zero; 5];
        for (known, derivative) in known.iter_mut().zip(q) {
            *known = array("q", M::COORDINATES, derivative)?;
        }
        let mut rows = vec![<M::Observables<f64> as Array<f64>>::filled(0.0); self.highest.max(3) + 1];
        let mut start = Start::<_, _, _, 4, true> {
            inputs: &self.inputs,
            q: known,
            at_zero: Computed,
            tape: &mut self.observables,
            keep: self.highest > 3,
            place: 0,
            rows: &mut rows,
            missing: &mut self.missing,
        };
        self.mechanism.observable_series(self.parameters.as_ref(), &mut start)?;
        let at = |order: usize| q.get(order).map_or(zero.as_ref(), Vec::as_slice);
        for (order, rows) in rows.iter_mut().enumerate().skip(4) {
            let mut next = Next {
                inputs: &self.inputs,
                news: Known { derivatives: [at(order), at(order + 1)], factorial: factorial(order) },
                tape: &mut self.observables,
                place: 0,
                order,
                rows,
                missing: &mut self.missing,
            };
            self.mechanism.observable_series(self.parameters.as_ref(), &mut next)?;
        }
        Ok(rows.iter().take(self.highest + 1).flat_map(|order| order.as_ref()).map(|opposite| -opposite).collect())
    }
}

/// Of what, and to which order it is solved.
impl<M: PowerSeries> core::fmt::Display for HigherOrders<'_, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "derivatives of {} up to order {}", M::model().name, self.highest)
    }
}
