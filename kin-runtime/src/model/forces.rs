//! What the numbers of forces are: names and places, as tables.

use super::{Frame, OperationCount};

/// Numbers before the multipliers: shaking (3), inertia (3), energies (3), powers (3), the rate of all energy.
#[cfg(feature = "std")]
pub(crate) const TOTALS: usize = 13;

/// The forces of a mechanism with masses or loads: what [`Mechanism::forces_with`](crate::Mechanism::forces_with) writes.
///
/// The numbers are, in this order: force and moment of shaking, the same of inertia alone; kinetic energy, that of
/// gravity, that of springs; power of drivers, of applied loads, of dampers; the rate of all energy; the multipliers λ of all rows; then two
/// numbers per effort, those of the reactions, five per spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceModel {
    /// How many numbers there are.
    pub count: usize,
    /// True where the closed forms hold the solution for λ, along the plan; otherwise λ is solved from Φ_qᵀ λ = r.
    pub solved: bool,
    /// Operations of one evaluation.
    pub operations: OperationCount,
    /// Drivers.
    pub efforts: &'static [EffortInfo],
    /// Joints.
    pub reactions: &'static [ReactionInfo],
    /// Springs.
    pub springs: &'static [SpringInfo],
}

/// A driver: its effort and the rate of what it drives stand at `place`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffortInfo {
    /// The driver's name, or that of a held coordinate that moves.
    pub name: &'static str,
    /// The first of its two numbers.
    pub place: usize,
}

/// A joint: what it exerts begins at `place` with point and force (4 numbers, where there is one), then the moment, couples
/// and generalized forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReactionInfo {
    /// Its name; `b.x`, `b.y`, `b.phi` or `b.origin` for what holds or carries a body.
    pub name: &'static str,
    /// The body on which force and moment act.
    pub on: Option<Frame>,
    /// The first of its numbers.
    pub place: usize,
    /// It has a point and a force.
    pub has_force: bool,
    /// It has a moment.
    pub has_moment: bool,
    /// The bodies on which it exerts couples.
    pub couples: &'static [Frame],
    /// How many generalized forces it has, one per row of the user's own.
    pub generalized: usize,
}

/// A spring: length or angle, its rate, tension or couple on the second body, energy and power of the damper stand at `place`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringInfo {
    /// Its name.
    pub name: &'static str,
    /// True for a torsion spring.
    pub turns: bool,
    /// The first of its five numbers.
    pub place: usize,
}
