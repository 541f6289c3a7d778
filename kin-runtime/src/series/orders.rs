//! Right-hand sides order by order, and the derivatives of q that are known so far.

use super::inputs::{Inputs, Setting, coordinates, factorial};
use super::tape::{Missing, Series, Tape};
use crate::mechanism::LengthError;
use crate::mechanism::Mechanism;
use crate::model::{Level, Model};
use crate::plan::Plan;
use crate::signal::Instant;
use crate::workspace::Array;

/// The equations of derivatives of order 3 and higher, for a caller with a linear solver of its own.
///
/// [`begin`](Self::begin) at an instant with q, q̇, q̈; then [`right`](Self::right) is the right-hand side b of
///
/// ```text
/// Φ_q q⁽ᵏ⁾ = b
/// ```
///
/// for [`order`](Self::order) k = 3, with Φ_q of that q; [`advance`](Self::advance) takes the solution and goes on to
/// the next order. After the first instant nothing is allocated. [`Solver::derivatives`](crate::Solver::derivatives)
/// does all of this, with its own factorisation and typed errors; here a b that cannot be computed is not finite.
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
#[doc(hidden)]
pub struct HigherOrders<'m, M: Mechanism> {
    mechanism: &'m M,
    parameters: M::Parameters<f64>,
    inputs: Inputs,
    constraints: Tape,
    velocities: Tape,
    /// q, q̇, q̈ and the higher derivatives that are known; 0 for the others.
    derivatives: Vec<M::Coordinates<f64>>,
    right: M::Rows<f64>,
    factors: M::Factors<f64>,
    missing: Option<Missing>,
    /// The order of `right`; 0 if it is not valid.
    order: usize,
    highest: usize,
    /// Rows of velocity level.
    of_velocity: Vec<usize>,
}

/// A slice as an array of the right length.
pub(super) fn array<'a, C: Array<f64>>(
    what: &'static str,
    expected: usize,
    list: &'a [f64],
) -> Result<&'a C, LengthError> {
    C::view(list).ok_or(LengthError { what, expected, found: list.len() })
}

/// The rows of velocity level.
fn rows_of_velocity(model: &Model) -> Vec<usize> {
    let rows = model.rows.iter().enumerate().filter(|(_, row)| row.level == Level::Velocity);
    rows.map(|(index, _)| index).collect()
}

impl<'m, M: Mechanism> HigherOrders<'m, M> {
    /// The highest order: 171! exceeds the range of `f64`.
    pub const MOST: usize = 170;

    /// Room for derivatives up to `highest`, or up to [`MOST`](Self::MOST).
    pub fn new(mechanism: &'m M, highest: usize) -> Self {
        let highest = highest.min(Self::MOST);
        // The right-hand side of the third order is always computed.
        let room = highest.max(3);
        Self {
            mechanism,
            parameters: mechanism.parameters(),
            inputs: Inputs::new(room, M::INPUTS),
            constraints: Tape::new(room),
            velocities: Tape::new(room),
            derivatives: vec![Array::filled(0.0); room + 1],
            right: Array::filled(0.0),
            factors: Array::filled(0.0),
            missing: None,
            order: 0,
            highest,
            of_velocity: rows_of_velocity(M::model()),
        }
    }

    /// Begins with q, q̇, q̈ at an instant; inputs are known with value, rate and acceleration.
    ///
    /// # Errors
    /// If an argument has the wrong length.
    pub fn begin(&mut self, at: &Instant<'_>, q: &[f64], q_dot: &[f64], q_ddot: &[f64]) -> Result<(), LengthError> {
        self.begin_with(at, &[], [q, q_dot, q_ddot])
    }

    /// [`begin`](Self::begin) with q, q̇, q̈ and, for every input, its derivatives from the third on as far as they are
    /// known.
    ///
    /// # Errors
    /// When an argument has the wrong length.
    pub fn begin_with(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<(), LengthError> {
        let (expected, found) = (M::INPUTS, at.inputs.len());
        if expected != found {
            return Err(LengthError { what: "inputs", expected, found });
        }
        for (order, (what, known)) in ["q", "q_dot", "q_ddot"].into_iter().zip(known).enumerate() {
            self.derivatives[order] = *array(what, M::COORDINATES, known)?;
        }
        self.inputs.begin(at, further);
        (self.order, self.missing) = (3, None);
        self.write_right(0)
    }

    /// The order k of [`right`](Self::right); 0 before [`begin`](Self::begin), and after the last requested order.
    pub fn order(&self) -> usize {
        self.order
    }

    /// b, s numbers, with Φ_q q⁽ᵏ⁾ = b; empty if [`order`](Self::order) is 0.
    pub fn right(&self) -> &[f64] {
        if self.order == 0 { &[] } else { self.right.as_ref() }
    }

    /// Factorises Φ_q by the blocks of the plan, at the instant and the q of [`begin`](Self::begin), for
    /// [`solve`](Self::solve). False without a plan, and if a block is singular or nearly so.
    ///
    /// # Errors
    /// When the inputs have the wrong length.
    pub fn factorise(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        let q = self.derivatives[0].as_ref();
        self.mechanism.factorise_with(self.parameters.as_ref(), at, q, &mut self.factors)?;
        let (first, end) = M::REGULAR;
        let margins = self.factors.as_ref().get(first..end).unwrap_or_default();
        Ok(M::model().plan.exists() && margins.iter().all(|margin| *margin > Plan::SMALLEST_MARGIN))
    }

    /// q⁽ᵏ⁾ with the factors of [`factorise`](Self::factorise), n numbers, to be passed to [`advance`](Self::advance).
    /// As with [`Mechanism::solve_factorised`] it is valid only if Φ_q is not singular, that is, if
    /// [`factorise`](Self::factorise) returned true.
    ///
    /// # Errors
    /// If the vector has the wrong length, and if there is no right-hand side, that is, if [`order`](Self::order) is 0.
    ///
    /// [`Mechanism::solve_factorised`]: crate::Mechanism::solve_factorised
    pub fn solve(&self, derivative: &mut [f64]) -> Result<(), LengthError> {
        M::solve_factorised(&self.factors, self.right(), derivative)
    }

    /// Takes q⁽ᵏ⁾, n numbers, and computes the right-hand side of the next order up to the highest; after the last one
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
        self.derivatives[self.order] = *derivative;
        self.order += 1;
        self.write_right(self.order - 1)
    }

    /// b = −k! [τᵏ] Φ, and −(k − 1)! [τ^{k−1}] η, with q_k = 0 for the current order k. Coefficients from `first` on
    /// are computed; the tapes hold the lower ones already.
    fn write_right(&mut self, first: usize) -> Result<(), LengthError> {
        let (order, right) = (self.order, self.right.as_mut());
        self.derivatives[order] = Array::filled(0.0);
        let (tape, mut phi) = (&self.constraints, M::Rows::filled(Series::Number(0.0)));
        tape.start(first..=order);
        let setting = Setting::<M>::new(self.mechanism, &self.inputs, &self.derivatives, tape);
        let (parameters, q) = (setting.parameters.as_ref(), setting.q.as_ref());
        self.mechanism.constraints_with(parameters, &setting.at(), q, &mut phi)?;
        let scale = -factorial(order);
        for (right, phi) in right.iter_mut().zip(phi.as_ref()) {
            *right = scale * tape.coefficient(*phi, order);
        }
        self.missing = self.missing.or(tape.missing());
        if self.of_velocity.is_empty() {
            return Ok(());
        }
        let (tape, mut eta, order) = (&self.velocities, M::Rows::filled(Series::Number(0.0)), order - 1);
        tape.start(first.saturating_sub(1)..=order);
        let setting = Setting::<M>::new(self.mechanism, &self.inputs, &self.derivatives, tape);
        let rates = coordinates::<M>(&self.derivatives[1..], tape);
        let (parameters, q) = (setting.parameters.as_ref(), setting.q.as_ref());
        self.mechanism.velocity_constraints_with(parameters, &setting.at(), q, rates.as_ref(), eta.as_mut())?;
        let scale = -factorial(order);
        for &row in &self.of_velocity {
            right[row] = scale * tape.coefficient(eta.as_ref()[row], order);
        }
        self.missing = self.missing.or(tape.missing());
        Ok(())
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
    /// [`HigherOrders::factorise`].
    fn factorise(&mut self, at: &Instant<'_>) -> Result<bool, LengthError>;
    /// [`HigherOrders::solve`].
    fn solve(&self, derivative: &mut [f64]) -> Result<(), LengthError>;
    /// The first derivative that was missing for a coefficient.
    fn missing(&self) -> Option<Missing>;
}

impl<M: Mechanism> Orders for HigherOrders<'_, M> {
    fn begin_with(&mut self, at: &Instant<'_>, further: &[&[f64]], known: [&[f64]; 3]) -> Result<(), LengthError> {
        HigherOrders::begin_with(self, at, further, known)
    }

    fn right(&self) -> &[f64] {
        HigherOrders::right(self)
    }

    fn advance(&mut self, derivative: &[f64]) -> Result<(), LengthError> {
        HigherOrders::advance(self, derivative)
    }

    fn factorise(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        HigherOrders::factorise(self, at)
    }

    fn solve(&self, derivative: &mut [f64]) -> Result<(), LengthError> {
        HigherOrders::solve(self, derivative)
    }

    fn missing(&self) -> Option<Missing> {
        self.missing
    }
}

/// The mechanism and the highest order.
impl<M: Mechanism> core::fmt::Display for HigherOrders<'_, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "derivatives of {} up to order {}", M::model().name, self.highest)
    }
}
