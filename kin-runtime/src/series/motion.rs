//! Higher derivatives of everything that a mechanism reports.

use super::derivatives::{Derivatives, unknown};
use super::inputs::{Inputs, Setting, factorial};
use super::orders::array;
use super::tape::{Missing, Series, Tape};
use crate::equations::{Equations, length};
use crate::error::SolveError;
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::motion::{name, report};
use crate::solver::Solver;
use crate::text::{number, numbers, separated};
use crate::workspace::Array;
use core::fmt;

/// Derivatives of bodies, points, defines, joints and conditions at one instant, order by order.
///
/// Indexed by the handles of the mechanism: `motion[FourBar::tip][3]` is the jerk of the point `tip`, (x, y) in the
/// inertial frame.
#[derive(Clone, PartialEq)]
pub struct MotionDerivatives {
    /// The mechanism's names.
    pub model: &'static Model,
    /// Bodies, in the order of [`Model::bodies`]: (x, y, φ) for every order.
    pub bodies: Vec<Vec<[f64; 3]>>,
    /// Points, in the order of [`Model::points`]: (x, y) for every order.
    pub points: Vec<Vec<[f64; 2]>>,
    /// Defines, in the order of [`Model::defines`].
    pub defines: Vec<Vec<f64>>,
    /// Per joint of [`Model::joints`], its quantities in the order of
    /// [`JointInfo::quantities`](crate::model::JointInfo::quantities).
    pub joints: Vec<Vec<Vec<f64>>>,
    /// Unilateral conditions, in the order of [`Model::conditions`].
    pub conditions: Vec<Vec<f64>>,
}

report!(MotionDerivatives, body: [[f64; 3]], point: [[f64; 2]]);

impl<M: Mechanism> Solver<'_, M> {
    /// Derivatives of bodies, points, defines and joints, to the order of those of q.
    ///
    /// # Errors
    /// [`UnknownDerivative`](SolveError::UnknownDerivative) where an input or a supplied function is not known far
    /// enough; [`NonFinite`](SolveError::NonFinite) and [`Length`](SolveError::Length).
    pub fn motion_derivatives(&self, derivatives: &Derivatives) -> Result<MotionDerivatives, SolveError> {
        let observe = || observe(self.mechanism, derivatives);
        motion(&mut self.equations(&derivatives.instant())?, &observe, derivatives)
    }
}

/// Coefficients of all observables, order by order, and the first derivative that was missing for one of them.
type Observed = (Vec<f64>, Option<Missing>);

/// The observables of q as a power series.
fn observe<M: Mechanism>(mechanism: &M, derivatives: &Derivatives) -> Result<Observed, LengthError> {
    let order = derivatives.order();
    let (mut inputs, tape) = (Inputs::new(order, M::INPUTS), Tape::new(order));
    inputs.begin(&derivatives.instant(), &derivatives.further());
    let mut q: Vec<M::Coordinates<f64>> = Vec::with_capacity(derivatives.q.len());
    for derivative in &derivatives.q {
        q.push(*array("q", M::COORDINATES, derivative)?);
    }
    tape.start(0..=order);
    let setting = Setting::<M>::new(mechanism, &inputs, &q, &tape);
    // Rates are used for time derivatives only, which the series contain already.
    let rest = M::Coordinates::filled(Series::Number(0.0));
    let mut observations = M::observations::<Series<'_>>();
    let (parameters, q) = (setting.parameters.as_ref(), setting.q.as_ref());
    mechanism.observe_with(parameters, &setting.at(), q, rest.as_ref(), &mut observations)?;
    Ok((coefficients(observations.phi(), &tape, order), tape.missing()))
}

/// The coefficients of series on a tape, order by order.
fn coefficients(rows: &[Series<'_>], tape: &Tape, order: usize) -> Vec<f64> {
    let places = (0..=order).flat_map(|k| rows.iter().map(move |row| (k, *row)));
    places.map(|(k, row)| tape.coefficient(row, k)).collect()
}

fn motion(
    equations: &mut Equations<'_>,
    observe: &dyn Fn() -> Result<Observed, LengthError>,
    derivatives: &Derivatives,
) -> Result<MotionDerivatives, SolveError> {
    length("derivatives of inputs", equations.inputs.len().min(derivatives.further.len()), derivatives.further.len())?;
    length("orders of q", derivatives.q.len().max(1), derivatives.q.len())?;
    for vector in &derivatives.q {
        equations.check("q", vector)?;
    }
    let (rows, missing) = observe()?;
    let model = equations.model;
    let count = model.observables.len();
    if let Some((place, value)) = rows.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        let (order, index) = (place / count, place % count);
        let error = SolveError::NonFinite { what: "observables", index, name: name(model, index), t: None };
        let error = unknown(equations, missing, order).filter(|_| value.is_nan()).unwrap_or(error);
        return Err(error.at(equations.t));
    }
    let at = |observable: usize, order: usize| rows[order * count + observable] * factorial(order);
    let all = |observable: usize| -> Vec<f64> { (0..=derivatives.order()).map(|k| at(observable, k)).collect() };
    let bodies = model.bodies.iter().map(|body| {
        let orders = 0..=derivatives.order();
        orders.map(|order| body.observables.map(|observable| at(observable, order))).collect()
    });
    let points = model.points.iter().map(|point| {
        let orders = 0..=derivatives.order();
        orders.map(|order| point.observables.map(|observable| at(observable, order))).collect()
    });
    let joints =
        model.joints.iter().map(|joint| joint.quantities.iter().map(|quantity| all(quantity.observable)).collect());
    Ok(MotionDerivatives {
        model,
        bodies: bodies.collect(),
        points: points.collect(),
        defines: model.defines.iter().map(|define| all(define.observable)).collect(),
        joints: joints.collect(),
        conditions: model.conditions.iter().map(|condition| all(condition.observable)).collect(),
    })
}

/// A line for everything that is reported, order by order.
impl fmt::Display for MotionDerivatives {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let model = self.model;
        f.write_str(model.name)?;
        for (info, orders) in model.bodies.iter().zip(&self.bodies) {
            write!(f, "\nbody {}: ", info.name)?;
            separated(f, orders, |f, values| numbers(f, values))?;
        }
        for (info, orders) in model.points.iter().zip(&self.points) {
            write!(f, "\npoint {}: ", info.name)?;
            separated(f, orders, |f, values| numbers(f, values))?;
        }
        for (info, orders) in model.defines.iter().zip(&self.defines) {
            write!(f, "\n{}: ", info.name)?;
            separated(f, orders, number)?;
        }
        for (info, quantities) in model.joints.iter().zip(&self.joints) {
            for (quantity, orders) in info.quantities.iter().zip(quantities) {
                write!(f, "\n{} of {}: ", quantity.name, info.name)?;
                separated(f, orders, number)?;
            }
        }
        for (info, orders) in model.conditions.iter().zip(&self.conditions) {
            write!(f, "\ncondition {}: ", info.name)?;
            separated(f, orders, number)?;
        }
        Ok(())
    }
}
