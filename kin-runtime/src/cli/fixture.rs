//! A mechanism written by hand for the tests of this program: a crank and a cross-head, s = r cos φ.

use crate::mechanism::{LengthError, Mechanism, Observations, Workspace};
use crate::model::{
    BodyInfo, Component, CoordinateInfo, CoordinateKind, DefineInfo, Frame, JointInfo, JointKind, Level, Model,
    Observable, OperationCount, OriginKind, ParameterInfo, Pattern, PointInfo, RowInfo, Units,
};
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Subset;

/// What the second row is.
pub(super) const DRIVEN: u8 = 0;
pub(super) const WITH_INPUT: u8 = 1;
pub(super) const FREE: u8 = 2;

#[derive(Clone, Copy, Debug)]
pub(super) struct CrossHead<const KIND: u8> {
    r: f64,
    phi0: f64,
    omega: f64,
}

impl<const KIND: u8> Default for CrossHead<KIND> {
    fn default() -> Self {
        Self { r: 0.1, phi0: 0.3, omega: 2.0 }
    }
}

const fn parameter(name: &'static str, unit: &'static str, default: f64, doc: &'static str) -> ParameterInfo {
    ParameterInfo { name, unit: Some(unit), default: Some(default), doc }
}

const fn row(name: &'static str, joint: usize, driving: bool) -> RowInfo {
    RowInfo { name, joint, level: Level::Position, rheonomic: driving, driving, bilateral: true }
}

const fn joint(name: &'static str, kind: JointKind, first_row: usize, q: &'static [DefineInfo]) -> JointInfo {
    JointInfo { name, kind, frames: [None, None], first_row, rows: 1, geometry: &[], quantities: q }
}

const fn pose(component: Component) -> Observable {
    Observable::Pose { body: 0, component }
}

const STROKE: &[DefineInfo] = &[DefineInfo { name: "stroke", observable: 6, varies: true }];

const MODEL: Model = Model {
    name: "CrossHead",
    doc: "A crank moves a cross-head.",
    coordinates: &[
        CoordinateInfo { name: "crank.phi", kind: CoordinateKind::Pose { body: 0, component: Component::Phi } },
        CoordinateInfo { name: "s", kind: CoordinateKind::Scalar },
    ],
    parameters: &[
        parameter("r", "m", 0.1, "Crank radius"),
        parameter("phi0", "rad", 0.3, "Angle at t = 0"),
        parameter("omega", "rad/s", 2.0, "Speed of the crank"),
    ],
    inputs: &[],
    forces: None,
    input_defaults: &[],
    units: Units { length: Some("m"), time: Some("s"), named: &[("s", "m"), ("twice", "m")] },
    functions: &[],
    arguments: &[],
    bodies: &[BodyInfo {
        name: "crank",
        coordinates: [None, None, Some(0)],
        origin: OriginKind::Free,
        observables: [0, 1, 2],
    }],
    points: &[PointInfo { name: "tip", frame: Frame::Body(0), local: 0, observables: [3, 4] }],
    defines: &[DefineInfo { name: "twice", observable: 5, varies: true }],
    joints: &[joint("slide", JointKind::Constraint, 0, STROKE), joint("drive", JointKind::Driver, 1, &[])],
    rows: &[row("slide", 0, false), row("drive", 1, true)],
    conditions: &[],
    constraint_pattern: Pattern { rows: 2, entries: &[(0, 0), (0, 1), (1, 0), (1, 1)], constants: &[] },
    observables: &[
        pose(Component::X),
        pose(Component::Y),
        pose(Component::Phi),
        Observable::Point { point: 0, component: Component::X },
        Observable::Point { point: 0, component: Component::Y },
        Observable::Define(0),
        Observable::Joint { joint: 0, quantity: 0 },
    ],
    observable_pattern: Pattern {
        rows: 7,
        entries: &[(2, 0), (3, 0), (4, 0), (5, 1), (6, 1)],
        constants: &[(0, 1.0), (3, 2.0), (4, 1.0)],
    },
    guesses: &[0],
    geometry: 2,
    has_curves: false,
    has_sizes: false,
    least_sizes: &[],
    allow_redundant: false,
    plan: crate::plan::Plan::absent("written by hand"),
    structure: None,
    operations: OperationCount { add: 4, mul: 5, neg: 1, div: 0, sqrt: 0, sincos: 1, function: 0 },
    equations: &[],
    solution: &[],
};

static DRIVEN_MODEL: Model = MODEL;
static INPUT_MODEL: Model = Model { inputs: &["u"], ..MODEL };
static FREE_MODEL: Model = Model {
    joints: &[joint("slide", JointKind::Constraint, 0, STROKE), joint("again", JointKind::Constraint, 1, &[])],
    rows: &[row("slide", 0, false), row("again", 1, false)],
    ..MODEL
};

fn length(what: &'static str, expected: usize, found: usize) -> Result<(), LengthError> {
    if expected == found { Ok(()) } else { Err(LengthError { what, expected, found }) }
}

impl<const KIND: u8> Mechanism for CrossHead<KIND> {
    const COORDINATES: usize = 2;
    const ROWS: usize = 2;
    const PARAMETERS: usize = 3;
    const INPUTS: usize = if KIND == WITH_INPUT { 1 } else { 0 };

    type Parameters<T: Scalar> = [T; 3];
    type Inputs<T: Scalar> = [Signal<T>; 1];
    type Coordinates<T: Scalar> = [T; 2];
    type Rows<T: Scalar> = [T; 2];
    type NonZeros<T: Scalar> = [T; 4];
    type Observables<T: Scalar> = [T; 7];
    type ObservableNonZeros<T: Scalar> = [T; 5];
    type Factors<T: Scalar> = [T; 0];
    type KnownCurves<T: Scalar> = [T; 0];

    fn model() -> &'static Model {
        match KIND {
            WITH_INPUT => &INPUT_MODEL,
            FREE => &FREE_MODEL,
            _ => &DRIVEN_MODEL,
        }
    }

    fn parameters<T: Scalar>(&self) -> [T; 3] {
        [self.r, self.phi0, self.omega].map(T::from_f64)
    }

    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        match index {
            0 => self.r = value,
            1 => self.phi0 = value,
            2 => self.omega = value,
            _ => return false,
        }
        true
    }

    fn evaluate_with<T: Scalar>(
        &self,
        parameters: &[T],
        _subset: Subset,
        at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        workspace: &mut Workspace<Self, T>,
    ) -> Result<(), LengthError> {
        length("inputs", Self::INPUTS, at.inputs.len())?;
        let (&[r, phi0, omega], &[phi, s], &[phi_dot, _]) = (parameters, q, q_dot) else {
            return Err(LengthError { what: "parameters, q or q_dot", expected: 2, found: q.len() });
        };
        let [zero, one, two] = [0.0, 1.0, 2.0].map(T::from_f64);
        let (sin, cos) = phi.sin_cos();
        let (f, f_q) = (s - r * cos, r * sin);
        let g = -(r * cos * phi_dot * phi_dot);
        let (value, rate, acceleration) = match at.inputs {
            [u, ..] => (u.value, u.rate, u.acceleration),
            [] => (zero, zero, zero),
        };
        let (phi_rows, phi_q, phi_t, gamma) = workspace.parts_mut();
        if KIND == FREE {
            *phi_rows = [f, two * f];
            *phi_q = [f_q, one, two * f_q, two];
            *phi_t = [zero, zero];
            *gamma = [g, two * g];
        } else {
            *phi_rows = [f, phi - (phi0 + omega * at.t + value)];
            *phi_q = [f_q, one, one, zero];
            *phi_t = [zero, -(omega + rate)];
            *gamma = [g, acceleration];
        }
        Ok(())
    }

    fn observe_with<T: Scalar>(
        &self,
        parameters: &[T],
        _at: &Instant<'_, T>,
        q: &[T],
        q_dot: &[T],
        observations: &mut Observations<Self, T>,
    ) -> Result<(), LengthError> {
        let (&[r, _, _], &[phi, s], &[phi_dot, _]) = (parameters, q, q_dot) else {
            return Err(LengthError { what: "parameters, q or q_dot", expected: 2, found: q.len() });
        };
        let [zero, one, two] = [0.0, 1.0, 2.0].map(T::from_f64);
        let (sin, cos) = phi.sin_cos();
        let (x, y) = (r * cos, r * sin);
        let square = phi_dot * phi_dot;
        let (e, e_q, e_t, gamma) = observations.parts_mut();
        *e = [zero, zero, phi, x, y, two * s, s];
        *e_q = [one, -y, x, two, one];
        *e_t = [zero; 7];
        *gamma = [zero, zero, zero, x * square, y * square, zero, zero];
        Ok(())
    }

    fn write_geometry<T: Scalar>(
        &self,
        parameters: &[T],
        _: &Instant<'_, T>,
        out: &mut [T],
    ) -> Result<(), LengthError> {
        length("geometry", 2, out.len())?;
        if let (Some(&r), [x, y]) = (parameters.first(), out) {
            (*x, *y) = (r, T::from_f64(0.0));
        }
        Ok(())
    }

    fn write_guesses<T: Scalar>(&self, parameters: &[T], guesses: &mut [T]) -> Result<(), LengthError> {
        length("guesses", 1, guesses.len())?;
        if let (Some(&phi0), [first]) = (parameters.get(1), guesses) {
            *first = phi0;
        }
        Ok(())
    }
}
