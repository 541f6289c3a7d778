//! The kinematic system: Φ with its derivatives Φ_q, Φ_t and γ, and the class of every row.
//!
//! The derivatives are obtained by [`total_derivatives`]: Φ̇ = Φ_q q̇ + Φ_t and Φ̈ = Φ_q q̈ − γ. The velocity
//! equations are Φ_q q̇ = ν = −Φ_t, the acceleration equations Φ_q q̈ = γ.
//!
//! A row of velocity level, η = B q̇ + b = 0, is differentiated once: η̇ = B q̈ − γ. B and b are stored as its rows of
//! Φ_q and Φ_t, so the velocity and acceleration equations have the same form for all rows.

use crate::constraint::{ConstraintRow, ConstraintSet, ObservableKind, VelocityRow};
use crate::error::{ModelError, Origin};
use crate::expr::{ExprId, Jet, MAX_ORDER, Node, Symbol, total_derivatives, velocity_derivatives};
use core::fmt;

/// A row and its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// Φ, or the value of an observable; 0 for a row of velocity level.
    pub phi: ExprId,
    /// The non-zero entries of the row of Φ_q with their coordinates; for a row of velocity level the row of B.
    pub phi_q: Vec<(u32, ExprId)>,
    /// Φ_t; for a row of velocity level b.
    pub phi_t: ExprId,
    /// γ = −(Φ_q q̇)_q q̇ − 2 Φ_qt q̇ − Φ_tt; for a row of velocity level −η_q q̇ − η_t for constant q̇.
    pub gamma: ExprId,
}

/// The class of a row (lecture, slides 27–34). All rows are equations, that is, bilateral constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowClass {
    /// True for a row Φ(q, t) = 0, false for a row of velocity level.
    pub holonomic: bool,
    /// True if t or an input appears; otherwise the row is scleronomic.
    pub rheonomic: bool,
    /// True if the row is declared by `driver` or `speed`, or if its own operands contain t or an input. A row that is
    /// rheonomic only because a held coordinate of a body varies with time is not driving.
    pub driving: bool,
}

impl RowClass {
    /// True if the row transmits motion into the mechanism: it is driving, or a held coordinate of one of its bodies
    /// varies with time.
    pub fn leads(self) -> bool {
        self.driving || self.rheonomic
    }
}

/// Φ, Φ_q, Φ_t, γ of a mechanism, and the same derivatives of everything that it reports.
#[derive(Clone, Debug)]
pub struct KinematicSystem {
    /// The constraint set; its graph contains all expressions.
    pub set: ConstraintSet,
    /// The rows of Φ.
    pub equations: Vec<Equation>,
    /// The class of every row.
    pub classes: Vec<RowClass>,
    /// The observables with their derivatives.
    pub observables: Vec<Equation>,
}

/// Differentiates a constraint set.
///
/// # Errors
/// Rows and observables that need a third derivative of an input or a supplied function. The caller provides only the
/// value, the rate and the acceleration.
pub fn differentiate(mut set: ConstraintSet) -> Result<KinematicSystem, Vec<ModelError>> {
    let rows: Vec<ExprId> = set.rows.iter().map(|row| row.phi).collect();
    let observed: Vec<ExprId> = set.observables.iter().map(|o| o.value).collect();
    let classes = set.rows.iter().map(|row| class(&set, row)).collect();
    let all: Vec<ExprId> = rows.iter().chain(&observed).copied().collect();
    let jets = total_derivatives(&mut set.graph, &all);
    let equation = |(phi, jet): (ExprId, Jet)| Equation {
        phi,
        phi_q: jet.gradient,
        phi_t: jet.partial_t,
        gamma: set.graph.neg(jet.rest),
    };
    let mut equations: Vec<Equation> = all.into_iter().zip(jets).map(equation).collect();
    let observables = equations.split_off(rows.len());
    velocity_level(&mut set, &mut equations);
    let system = KinematicSystem { set, equations, classes, observables };
    let errors = needs_what_is_not_supplied(&system);
    if errors.is_empty() { Ok(system) } else { Err(errors) }
}

/// An error for every row and observable that needs more derivatives of an input or supplied function than the caller
/// provides.
fn needs_what_is_not_supplied(system: &KinematicSystem) -> Vec<ModelError> {
    let set = &system.set;
    let beyond = |id: &ExprId| match set.graph.node(*id) {
        Node::Symbol(Symbol::Input(k, order)) if order > MAX_ORDER => Some(set.input_name(k)),
        Node::Supplied(f, order, _) if order > MAX_ORDER => set.functions.get(f as usize).map(String::as_str),
        _ => None,
    };
    if !set.graph.ids().any(|id| beyond(&id).is_some()) {
        return Vec::new();
    }
    let rows = set.rows.iter().map(|row| (&row.name, set.joints[row.joint].keyword));
    let observed = set.observables.iter().map(|observable| match observable.kind {
        ObservableKind::Define(k) => (&set.defines[k].name, set.defines[k].origin),
        ObservableKind::Condition(k) => (&set.conditions[k].name, set.conditions[k].origin),
        ObservableKind::Joint(k, _) => (&set.joints[k].name, set.joints[k].keyword),
        ObservableKind::Pose(k, _) => (&set.bodies[k].name, Origin::default()),
        ObservableKind::Point(k, _) => (&set.points[k].name, Origin::default()),
    });
    let mut errors = Vec::new();
    for ((name, origin), equation) in rows.chain(observed).zip(system.equations.iter().chain(&system.observables)) {
        let outputs = [equation.phi, equation.phi_t, equation.gamma];
        let needed = set.graph.reachable(outputs.into_iter().chain(equation.phi_q.iter().map(|(_, e)| *e)));
        if let Some(missing) = needed.iter().find_map(beyond) {
            let message = format!(
                "`{name}` needs the third derivative of `{missing}`; only its value, rate and acceleration \
                 are available"
            );
            errors.push(ModelError::new(origin, message));
        }
    }
    errors.dedup();
    errors
}

fn class(set: &ConstraintSet, row: &ConstraintRow) -> RowClass {
    let holonomic = row.velocity.is_none();
    let value = row.velocity.map_or(row.phi, |velocity| velocity.eta);
    let rheonomic = set.graph.depends(value).is_rheonomic();
    let declared = set.joints[row.joint].kind.drives();
    RowClass { holonomic, rheonomic, driving: declared || (rheonomic && row.operands_move) }
}

/// Stores B, b and γ of the rows of velocity level.
fn velocity_level(set: &mut ConstraintSet, equations: &mut [Equation]) {
    let rows: Vec<(usize, VelocityRow)> =
        set.rows.iter().enumerate().filter_map(|(k, row)| row.velocity.map(|velocity| (k, velocity))).collect();
    let etas: Vec<ExprId> = rows.iter().map(|(_, velocity)| velocity.eta).collect();
    let jets = velocity_derivatives(&mut set.graph, &etas);
    for ((row, velocity), jet) in rows.into_iter().zip(jets) {
        let gamma = set.graph.neg(jet.rest);
        equations[row] = Equation { phi_q: jet.gradient, phi_t: velocity.b, gamma, ..equations[row].clone() };
    }
}

impl fmt::Display for KinematicSystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (row, equation) in self.set.rows.iter().zip(&self.equations) {
            writeln!(f, "{}", row.name)?;
            match row.velocity {
                None => writeln!(f, "  Φ   = {}", self.set.show(equation.phi))?,
                Some(velocity) => writeln!(f, "  η   = {}", self.set.show(velocity.eta))?,
            }
            for (k, e) in &equation.phi_q {
                writeln!(f, "  ∂Φ/∂{} = {}", self.set.coordinate_name(*k), self.set.show(*e))?;
            }
            writeln!(f, "  Φ_t = {}", self.set.show(equation.phi_t))?;
            writeln!(f, "  γ   = {}", self.set.show(equation.gamma))?;
        }
        Ok(())
    }
}
