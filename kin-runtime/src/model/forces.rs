//! What the numbers of forces are: names and places, as tables.

use super::{Frame, OperationCount};

/// Numbers before the multipliers: shaking (3), inertia (3), energies (3), powers (3), the rate of all energy.
#[cfg(feature = "std")]
pub(crate) const TOTALS: usize = ForceModel::MULTIPLIERS;

/// The forces of a mechanism with masses or loads: what [`Mechanism::forces_with`](crate::Mechanism::forces_with) writes.
///
/// The numbers are, in this order: force and moment of shaking, the same of inertia alone; kinetic energy, that of
/// gravity, that of springs; power of drivers, of applied loads, of dampers; the rate of all energy; the multipliers λ of all rows; then two
/// numbers per effort, those of the reactions, five per spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceModel {
    /// How many numbers there are.
    pub count: usize,
    /// True where the closed forms hold the solution for λ, along the plan; otherwise λ must be solved from Φ_qᵀ λ = r.
    pub solved: bool,
    /// Operations of one evaluation.
    pub operations: OperationCount,
    /// Drivers.
    pub efforts: &'static [EffortInfo],
    /// Joints.
    pub reactions: &'static [ReactionInfo],
    /// Springs.
    pub springs: &'static [SpringInfo],
    /// What gravity, applied loads and springs exert on bodies.
    #[doc(hidden)]
    pub loads: &'static [LoadInfo],
    /// Units.
    pub units: ForceUnits,
    /// Entries of the symmetric mass matrix M that are not 0, as texts: row, column, not before the row, and the entry;
    /// empty without the feature `equations`.
    #[doc(hidden)]
    pub mass_matrix: &'static [(usize, usize, &'static str)],
    /// Q of M q̈ + Φ_qᵀ λ = Q, a text for every coordinate; empty likewise.
    #[doc(hidden)]
    pub generalized: &'static [&'static str],
}

/// The units of forces, from those of masses, lengths and times that are written; none where these do not tell them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ForceUnits {
    /// Of forces: `N`.
    pub force: Option<&'static str>,
    /// Of moments: `N·m`.
    pub moment: Option<&'static str>,
    /// Of energies: `J`.
    pub energy: Option<&'static str>,
    /// Of powers: `W`.
    pub power: Option<&'static str>,
}

/// `forces in N, moments in N·m, energies in J, powers in W`; nothing where they are not known.
impl core::fmt::Display for ForceUnits {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let all = [("forces", self.force), ("moments", self.moment), ("energies", self.energy), ("powers", self.power)];
        let known = all.into_iter().filter_map(|(what, unit)| Some((what, unit?)));
        known
            .enumerate()
            .try_for_each(|(k, (what, unit))| write!(f, "{}{what} in {unit}", if k > 0 { ", " } else { "" }))
    }
}

impl ForceModel {
    /// The place of the force of shaking, x and y, and of its moment behind them.
    pub const SHAKING: usize = 0;
    /// That of inertia alone.
    pub const INERTIA: usize = 3;
    /// Kinetic energy.
    pub const KINETIC: usize = 6;
    /// Potential energy of gravity.
    pub const GRAVITY: usize = 7;
    /// Energy of springs.
    pub const SPRINGS: usize = 8;
    /// Power of drivers.
    pub const DRIVER_POWER: usize = 9;
    /// Power of applied loads.
    pub const APPLIED_POWER: usize = 10;
    /// Power of dampers.
    pub const DAMPER_POWER: usize = 11;
    /// The rate of all energy.
    pub const ENERGY_RATE: usize = 12;
    /// The first multiplier.
    pub const MULTIPLIERS: usize = 13;

    /// Whether bodies touch, so that their normal forces may change their sign.
    pub fn has_contacts(&self) -> bool {
        self.reactions.iter().any(|reaction| reaction.has_normal)
    }

    /// A driver by its name.
    pub fn effort(&self, driver: &str) -> Option<&'static EffortInfo> {
        self.efforts.iter().find(|effort| effort.name == driver)
    }

    /// A joint by its name.
    pub fn reaction(&self, joint: &str) -> Option<&'static ReactionInfo> {
        self.reactions.iter().find(|reaction| reaction.name == joint)
    }

    /// A spring by its name.
    pub fn spring(&self, name: &str) -> Option<&'static SpringInfo> {
        self.springs.iter().find(|spring| spring.name == name)
    }
}

impl ReactionInfo {
    /// The place of the force, x, and y behind it; none where there are only couples.
    pub fn force(&self) -> Option<usize> {
        self.has_force.then_some(self.place + 2)
    }

    /// The place of the moment.
    pub fn moment(&self) -> Option<usize> {
        self.has_moment.then_some(self.place + if self.has_force { 4 } else { 0 })
    }

    /// The place of the normal part of a contact force.
    pub fn normal(&self) -> Option<usize> {
        let before = usize::from(self.has_force) * 4 + usize::from(self.has_moment);
        self.has_normal.then_some(self.place + before + self.couples.len() + self.generalized)
    }
}

/// A driver: its effort and the rate of what it drives stand at `place`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffortInfo {
    /// The driver's name, or that of a held coordinate that moves.
    pub name: &'static str,
    /// The first of its two numbers.
    pub place: usize,
}

/// A joint: what it exerts begins at `place` with point and force (4 numbers, where there is one), then the moment, couples,
/// generalized forces, and the normal and the tangential part of a contact force.
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
    /// Its bodies touch, and the force has a normal part.
    pub has_normal: bool,
    /// They roll on one another, and it has a tangential part.
    pub has_tangential: bool,
}

/// What a load exerts on a body: a force with its point, four numbers, or a couple, from `place` on among the numbers of
/// [`Mechanism::loads_with`](crate::Mechanism::loads_with).
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadInfo {
    /// Its name; `gravity` for the weight of a mass.
    pub name: &'static str,
    /// The body on which it acts.
    pub on: Frame,
    /// The first of its numbers.
    pub place: usize,
    /// True for a force, false for a couple.
    pub is_force: bool,
}

#[cfg(feature = "std")]
impl LoadInfo {
    /// The place behind its numbers.
    pub(crate) const fn end(&self) -> usize {
        self.place + if self.is_force { 4 } else { 1 }
    }
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
