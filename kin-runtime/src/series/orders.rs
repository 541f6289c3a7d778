//! Right-hand sides order by order, and what is known of q so far.

use super::arithmetic::PowerSeries;
use super::course::{Course, factorial};
use super::next::{News, Next};
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
    mechanism: &'m M,
    parameters: M::Parameters<f64>,
    course: Course<M::Coordinates<f64>>,
    constraints: Tape,
    velocities: Tape,
    observables: Tape,
    /// Coefficients of Φ or η, and what they make.
    phi: M::Rows<f64>,
    eta: M::Rows<f64>,
    right: M::Rows<f64>,
    factors: M::Factors<f64>,
    missing: Option<Missing>,
    /// The order of `right`, and its factorial.
    order: usize,
    factorial: f64,
    highest: usize,
    /// Rows of velocity level.
    of_velocity: Vec<usize>,
}

impl<'m, M: PowerSeries> HigherOrders<'m, M> {
    /// Room for derivatives up to `highest`.
    pub fn new(mechanism: &'m M, highest: usize) -> Self {
        let rows = M::model().rows;
        let is_of_velocity = |row: &usize| rows.get(*row).is_some_and(|info| info.level == Level::Velocity);
        Self {
            mechanism,
            parameters: mechanism.parameters(),
            course: Course::new(highest, M::INPUTS),
            constraints: Tape::new(highest.max(3)),
            velocities: Tape::new(highest.max(3)),
            observables: Tape::new(highest.max(3)),
            phi: Array::generate(|_| 0.0),
            eta: Array::generate(|_| 0.0),
            right: Array::generate(|_| 0.0),
            factors: Array::generate(|_| 0.0),
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
        let length = |what, expected, found| {
            if expected == found { Ok(()) } else { Err(LengthError { what, expected, found }) }
        };
        length("inputs", M::INPUTS, at.inputs.len())?;
        for (what, vector) in ["q", "q_dot", "q_ddot"].into_iter().zip(known) {
            length(what, M::COORDINATES, vector.len())?;
        }
        self.course.begin(at, further);
        for (order, (factorial, vector)) in [1.0, 1.0, 2.0].into_iter().zip(known).enumerate() {
            self.course.take(order, factorial, vector);
        }
        (self.order, self.factorial, self.missing) = (3, 6.0, None);
        let keep = self.highest > 3;
        let mut start = Start::<_, _, 4, false> {
            course: &self.course,
            q: self.course.from(0),
            tape: &mut self.constraints,
            keep,
            place: 0,
            rows: core::slice::from_mut(&mut self.phi),
            missing: &mut self.missing,
        };
        self.mechanism.constraint_series(self.parameters.as_ref(), &mut start)?;
        if !self.of_velocity.is_empty() {
            let mut start = Start::<_, _, 3, false> {
                course: &self.course,
                q: self.course.from(0),
                tape: &mut self.velocities,
                keep,
                place: 0,
                rows: core::slice::from_mut(&mut self.eta),
                missing: &mut self.missing,
            };
            self.mechanism.velocity_series(self.parameters.as_ref(), &mut start)?;
        }
        self.write_right();
        Ok(())
    }

    /// The order k of [`right`](Self::right).
    pub fn order(&self) -> usize {
        self.order
    }

    /// b, s numbers, with Φ_q q⁽ᵏ⁾ = b.
    pub fn right(&self) -> &[f64] {
        self.right.as_ref()
    }

    /// Takes the factors of Φ_q by the blocks of the plan, at the instant and the q that it began with, for
    /// [`solve`](Self::solve); false where there is no plan.
    ///
    /// # Errors
    /// When the inputs have the wrong length.
    pub fn factorise(&mut self, at: &Instant<'_>) -> Result<bool, LengthError> {
        let [q] = self.course.from(0);
        self.mechanism.factorise_with(self.parameters.as_ref(), at, q.as_ref(), &mut self.factors)?;
        Ok(M::model().plan.absent.is_none())
    }

    /// q⁽ᵏ⁾ with the factors of [`factorise`](Self::factorise), n numbers, to hand to [`advance`](Self::advance). As in
    /// [`Mechanism::solve_factorised`] it is only good where Φ_q is not singular: where the margins of a solution by
    /// the plan are positive.
    ///
    /// # Errors
    /// When the vector has the wrong length.
    ///
    /// [`Mechanism::solve_factorised`]: crate::Mechanism::solve_factorised
    pub fn solve(&self, derivative: &mut [f64]) -> Result<(), LengthError> {
        M::solve_factorised(&self.factors, self.right.as_ref(), derivative)
    }

    /// Takes q⁽ᵏ⁾, n numbers, and goes on to the next order, where one was asked for.
    ///
    /// # Errors
    /// When the vector has the wrong length.
    pub fn advance(&mut self, derivative: &[f64]) -> Result<(), LengthError> {
        if derivative.len() != M::COORDINATES {
            let (expected, found) = (M::COORDINATES, derivative.len());
            return Err(LengthError { what: "derivative", expected, found });
        }
        if self.order < 3 || self.order > self.highest {
            return Ok(());
        }
        self.course.take(self.order, self.factorial, derivative);
        self.order += 1;
        self.factorial *= self.order as f64;
        if self.order > self.highest {
            return Ok(());
        }
        let mut next = Next {
            course: &self.course,
            q: self.course.from(self.order - 1),
            tape: &mut self.constraints,
            place: 0,
            order: self.order,
            news: News::Coordinates,
            rows: &mut self.phi,
            missing: &mut self.missing,
        };
        self.mechanism.constraint_series(self.parameters.as_ref(), &mut next)?;
        if !self.of_velocity.is_empty() {
            let mut next = Next {
                course: &self.course,
                q: self.course.from(self.order - 2),
                tape: &mut self.velocities,
                place: 0,
                order: self.order - 1,
                news: News::Rates,
                rows: &mut self.eta,
                missing: &mut self.missing,
            };
            self.mechanism.velocity_series(self.parameters.as_ref(), &mut next)?;
        }
        self.write_right();
        Ok(())
    }

    /// b = −k! [τᵏ] Φ, and −(k − 1)! [τ^{k−1}] η.
    fn write_right(&mut self) {
        let (right, phi) = (self.right.as_mut(), self.phi.as_ref());
        right.iter_mut().zip(phi).for_each(|(right, phi)| *right = -self.factorial * phi);
        for &row in &self.of_velocity {
            right[row] = -self.factorial / self.order as f64 * self.eta.as_ref()[row];
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

    fn observe(&mut self, at: &Instant<'_>, further: &[&[f64]], q: &[Vec<f64>]) -> Result<Vec<f64>, LengthError> {
        self.course.begin(at, further);
        q.iter().enumerate().for_each(|(order, vector)| self.course.take(order, factorial(order), vector));
        self.missing = None;
        let mut rows = vec![<M::Observables<f64> as Array<f64>>::generate(|_| 0.0); self.highest.max(3) + 1];
        let mut start = Start::<_, _, 4, true> {
            course: &self.course,
            q: self.course.from(0),
            tape: &mut self.observables,
            keep: self.highest > 3,
            place: 0,
            rows: &mut rows,
            missing: &mut self.missing,
        };
        self.mechanism.observable_series(self.parameters.as_ref(), &mut start)?;
        for (order, rows) in rows.iter_mut().enumerate().skip(4) {
            let mut next = Next {
                course: &self.course,
                q: self.course.from(order - 1),
                tape: &mut self.observables,
                place: 0,
                order,
                news: News::Nothing,
                rows,
                missing: &mut self.missing,
            };
            self.mechanism.observable_series(self.parameters.as_ref(), &mut next)?;
        }
        Ok(rows.iter().take(self.highest + 1).flat_map(|order| order.as_ref()).copied().collect())
    }
}
