//! The interface of a kind of mass or load: operands, and the forces that it exerts on the bodies.

use super::free_bodies::FreeBodies;
use crate::constraint::Frame;
use crate::expr::ExprId;
use crate::mechanism::{Operands, StatementForm, TypedOperands};

/// A force or couple, and the quantity along which it does work: Q_k = force · ∂quantity/∂q_k.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    /// The quantity, a length or an angle, in terms of q.
    pub(super) posed: ExprId,
    /// The same quantity with all bodies free.
    pub(super) free: ExprId,
    /// The force along a length, or the couple along an angle.
    pub(super) force: ExprId,
}

/// A force and its moment about a point: f_x, f_y, m. In [`Acting`] the point is the origin of the inertial frame.
pub(super) type Wrench = [ExprId; 3];

/// The force or couple of a load on a body, for pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exerted {
    pub(super) on: Frame,
    /// The point at which the force acts, and the force.
    pub(super) force: Option<[[ExprId; 2]; 2]>,
    pub(super) couple: Option<ExprId>,
}

impl Exerted {
    pub(super) fn force(on: Frame, point: [ExprId; 2], force: [ExprId; 2]) -> Self {
        Self { on, force: Some([point, force]), couple: None }
    }

    pub(super) fn couple(on: Frame, couple: ExprId) -> Self {
        Self { on, force: None, couple: Some(couple) }
    }
}

/// The action of a mass or a load; contributions that it does not make are 0.
#[derive(Clone, Debug)]
pub(super) struct Acting {
    /// Its name; `gravity` for the weight of a mass.
    pub(super) name: String,
    pub(super) work: Vec<Work>,
    /// Coordinates of centres of mass and angles of bodies, each with its mass or moment of inertia.
    pub(super) inertial: Vec<(ExprId, ExprId)>,
    /// The load from outside the mechanism: weight, applied forces and couples.
    pub(super) outside: Wrench,
    /// −m a and −J α, as a wrench.
    pub(super) inertia: Wrench,
    pub(super) kinetic: ExprId,
    pub(super) gravity: ExprId,
    pub(super) elastic: ExprId,
    pub(super) applied_power: ExprId,
    pub(super) damper_power: ExprId,
    /// Of a spring: length or angle, its rate, tension or torque, energy, power of the damper.
    pub(super) spring: Option<[ExprId; 5]>,
    pub(super) exerted: Vec<Exerted>,
    /// Of a mass: its body, the mass and the moment of inertia.
    pub(super) mass: Option<(Frame, [ExprId; 2])>,
}

impl Acting {
    pub(super) fn nothing(zero: ExprId) -> Self {
        Self {
            name: String::new(),
            work: Vec::new(),
            inertial: Vec::new(),
            outside: [zero; 3],
            inertia: [zero; 3],
            kinetic: zero,
            gravity: zero,
            elastic: zero,
            applied_power: zero,
            damper_power: zero,
            spring: None,
            exerted: Vec::new(),
            mass: None,
        }
    }
}

/// A kind of mass or load.
pub(super) trait LoadType: TypedOperands {
    /// Its action.
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting;
}

/// A kind of mass or load as an entry of the table of all kinds.
pub(super) struct LoadEntry {
    pub(super) form: &'static StatementForm,
    pub(super) acts: fn(&mut FreeBodies<'_>, &Operands) -> Option<Acting>,
}

impl LoadEntry {
    pub(super) const fn of<L: LoadType>() -> Self {
        Self { form: L::FORM, acts: |bodies, operands| L::of(operands).map(|load| load.acts(bodies)) }
    }
}

/// Declares the operands of a kind of mass or load: a struct with a field for every slot, and its form as a
/// statement.
macro_rules! load {
    (
        $(#[$meta:meta])*
        $name:ident { $($fields:tt)* }
        named: $named:expr, example: $example:expr
    ) => {
        $crate::mechanism::operands! {
            $(#[$meta])*
            $name { $($fields)* }
            kind: $crate::vocabulary::StatementKind::Load($crate::vocabulary::LoadKind::$name),
            named: $named,
            example: $example,
            choice: ""
        }
    };
}
pub(super) use load;
