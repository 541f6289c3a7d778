//! Sensitivities: derivatives of a solved state with respect to parameters.

use crate::forces::Forces;
use crate::model::Model;
use crate::motion::{BodyMotion, PointMotion, report};
use crate::signal::Signal;
use crate::text::{number, numbers};
use core::fmt;
use core::ops::Index;

/// Derivatives of a solved state with respect to parameters, from
/// [`Solver::sensitivities`](crate::Solver::sensitivities).
///
/// Indexed by the name of a parameter; the [`Sensitivity`] found so is indexed by the handles of the mechanism:
/// `sensitivities["l1"][FourBar::tip].v`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    /// Time.
    pub t: f64,
    /// The mechanism's names.
    pub model: &'static Model,
    /// The margins of the plan's steps, [`Plan::margins`](crate::plan::Plan::margins) numbers: how far each is from its
    /// limit. Empty if Φ_q was factorised as a whole.
    pub margins: Vec<f64>,
    /// One per requested parameter, in the order of the request.
    pub by: Vec<Sensitivity>,
}

impl Sensitivities {
    /// The derivatives with respect to a parameter; none if they were not requested.
    pub fn by(&self, parameter: &str) -> Option<&Sensitivity> {
        self.by.iter().find(|by| by.parameter == parameter)
    }
}

impl Index<&str> for Sensitivities {
    type Output = Sensitivity;

    /// # Panics
    /// If no derivatives with respect to a parameter of this name were requested.
    fn index(&self, parameter: &str) -> &Sensitivity {
        self.by(parameter).unwrap_or_else(|| panic!("no derivatives by `{parameter}`"))
    }
}

/// Derivatives with respect to one parameter: every number is the derivative of the corresponding number of the
/// state, or of its motion, at a fixed instant and in a fixed assembly mode.
#[derive(Clone, PartialEq)]
pub struct Sensitivity {
    /// The mechanism's names.
    pub model: &'static Model,
    /// The parameter.
    pub parameter: &'static str,
    /// ∂q/∂p, n numbers.
    pub q: Vec<f64>,
    /// ∂q̇/∂p, n numbers.
    pub q_dot: Vec<f64>,
    /// ∂q̈/∂p, n numbers.
    pub q_ddot: Vec<f64>,
    /// The margins of the plan's steps; empty where Φ_q was factorised as a whole.
    pub margins: Vec<f64>,
    /// Bodies, in the order of [`Model::bodies`].
    pub bodies: Vec<BodyMotion>,
    /// Points, in the order of [`Model::points`]; the change of a point's place in its body is included.
    pub points: Vec<PointMotion>,
    /// Defines, in the order of [`Model::defines`].
    pub defines: Vec<Signal>,
    /// Per joint of [`Model::joints`], its quantities in the order of
    /// [`JointInfo::quantities`](crate::model::JointInfo::quantities).
    pub joints: Vec<Vec<Signal>>,
    /// Unilateral conditions, in the order of [`Model::conditions`].
    pub conditions: Vec<Signal>,
    /// Efforts, reactions, energies and powers, where the state has forces and they have derivatives. What redundant rows
    /// leave open has none, forces of least norm included; such multipliers are NaN.
    pub forces: Option<Forces>,
}

report!(Sensitivity, body: BodyMotion, point: PointMotion);

impl Sensitivity {
    /// True where q, q̇, q̈ and what is reported of the motion have derivatives.
    pub(crate) fn is_finite(&self) -> bool {
        let coordinates = [&self.q, &self.q_dot, &self.q_ddot].into_iter().flatten().copied();
        let points = self.points.iter().flat_map(|point| [point.r, point.v, point.a].into_iter().flatten());
        let joints = self.joints.iter().flatten();
        let signals = self.defines.iter().chain(joints).chain(&self.conditions);
        let signals = signals.flat_map(|signal| [signal.value, signal.rate, signal.acceleration]);
        coordinates.chain(points).chain(signals).all(f64::is_finite)
    }
}

/// Three lines per parameter: the derivatives of q, q̇ and q̈.
impl fmt::Display for Sensitivities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at t = {}", self.model.name, self.t)?;
        self.by.iter().try_for_each(|by| write!(f, "\n{by}"))
    }
}

/// The derivatives of q, q̇ and q̈.
impl fmt::Display for Sensitivity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (name, list)) in [("q", &self.q), ("q̇", &self.q_dot), ("q̈", &self.q_ddot)].into_iter().enumerate() {
            let separator = if k == 0 { "" } else { "\n" };
            write!(f, "{separator}∂{name}/∂{}: ", self.parameter)?;
            numbers(f, list)?;
        }
        Ok(())
    }
}

/// The deviation of a quantity that tolerances of dimensions cause, to first order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Deviation {
    /// Σ |∂y/∂p| δ: all dimensions at their limits, each on its worse side.
    pub worst: f64,
    /// √(Σ (∂y/∂p δ)²): the root sum of squares, for independent deviations.
    pub root_sum_square: f64,
}

impl Deviation {
    /// The deviation with the contributions ∂y/∂p δ of all dimensions.
    pub(crate) fn of(parts: impl Iterator<Item = f64>) -> Self {
        let (worst, squares) = parts.fold((0.0, 0.0), |(sum, squares), part| (sum + part.abs(), squares + part * part));
        Self { worst, root_sum_square: squares.sqrt() }
    }
}

/// `±0.002, ±0.0015 as root sum of squares`.
impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("±").and_then(|()| number(f, &self.worst))?;
        f.write_str(", ±").and_then(|()| number(f, &self.root_sum_square))?;
        f.write_str(" as root sum of squares")
    }
}

impl Sensitivities {
    /// By how much a quantity deviates where every parameter may deviate by its tolerance on either side.
    ///
    /// `tolerances` has a number for every parameter of [`by`](Self::by), in the unit of the parameter; if there are fewer,
    /// the others count as exact. `derivative` selects the derivative of the quantity from those with respect to one
    /// parameter.
    ///
    /// ```
    /// use kin_runtime::{Kinematics, mechanism};
    ///
    /// #[mechanism]
    /// #[bodies(crank)]
    /// #[point(tip = crank @ (a + b, 0))]
    /// #[revolute(pin: ground @ (0, 0), crank @ (0, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// struct Crank {
    ///     #[param(0.2)]
    ///     a: f64,
    ///     #[param(0.3)]
    ///     b: f64,
    /// }
    ///
    /// let crank = Crank::default();
    /// let solver = crank.solver();
    /// let by = solver.sensitivities(&solver.state(&0.0.into())?)?;
    /// let deviation = by.deviation(&[0.003, 0.004], |by| by[Crank::tip].r[0]);
    /// assert!((deviation.worst - 0.007).abs() < 1e-15);
    /// assert!((deviation.root_sum_square - 0.005).abs() < 1e-15);
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    pub fn deviation(&self, tolerances: &[f64], derivative: impl Fn(&Sensitivity) -> f64) -> Deviation {
        Deviation::of(self.by.iter().zip(tolerances).map(|(by, tolerance)| derivative(by) * tolerance))
    }
}
