//! What every kind of mass or load has: operands, and what it does to the bodies.

use super::free_bodies::FreeBodies;
use crate::constraint::Frame;
use crate::expr::ExprId;
use crate::mechanism::{Operands, StatementForm, TypedOperands};

/// A force or couple with what it moves: Q_k = force · ∂quantity/∂q_k.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    /// What moves, by the coordinates.
    pub(super) posed: ExprId,
    /// The same with the poses of all bodies free.
    pub(super) free: ExprId,
    /// The force along a length, or the couple along an angle.
    pub(super) force: ExprId,
}

/// A force and its moment about the origin of the inertial frame: f_x, f_y, m.
pub(super) type Wrench = [ExprId; 3];

/// The force or couple of a load on a body, for pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exerted {
    pub(super) on: Frame,
    /// Where, and what force.
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

/// What a mass or a load does; everything that it does not do is 0.
#[derive(Clone, Debug)]
pub(super) struct Acting {
    /// What it is called; `gravity` for the weight of a mass.
    pub(super) name: String,
    pub(super) work: Vec<Work>,
    /// What has inertia: quantities that move, each with its mass or moment of inertia.
    pub(super) inertial: Vec<(ExprId, ExprId)>,
    /// What comes from outside of the mechanism: its weight, applied forces and couples.
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
        }
    }
}

/// A kind of mass or load.
pub(super) trait LoadType: TypedOperands {
    /// What it does.
    fn acts(&self, bodies: &mut FreeBodies<'_>) -> Acting;
}

/// A kind of mass or load as an entry of the table of all kinds.
pub(super) struct Kind {
    pub(super) form: &'static StatementForm,
    pub(super) acts: fn(&mut FreeBodies<'_>, &Operands) -> Option<Acting>,
}

impl Kind {
    pub(super) const fn of<L: LoadType>() -> Self {
        Self { form: L::FORM, acts: |bodies, operands| L::of(operands).map(|load| load.acts(bodies)) }
    }
}

/// Declares the operands of a kind of mass or load: a struct with a field for every slot, and how it is written.
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
