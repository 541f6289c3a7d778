//! The layout of the numbers of forces: names and indices, as tables.

use super::{Frame, OperationCount};
#[cfg(feature = "std")]
use super::{Level, Model};

/// Number of entries before the multipliers: shaking (3), inertia (3), energies (3), powers (3), the rate of the total
/// energy.
#[cfg(feature = "std")]
pub(crate) const TOTALS: usize = ForceModel::MULTIPLIERS;

/// The forces of a mechanism with masses or loads: what [`Mechanism::forces_with`](crate::Mechanism::forces_with)
/// writes.
///
/// The numbers are, in this order: the shaking force and moment, the parts of these that inertia causes; kinetic
/// energy, energy of gravity and of springs; power of drivers, of applied loads and of dampers; the rate of the total
/// energy; the multipliers λ of all rows; then two numbers per driver ([`EffortInfo`]), those of each joint
/// ([`ReactionInfo`]), five per spring ([`SpringInfo`]), and every mass with its moment of inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceModel {
    /// The number of all entries.
    pub count: usize,
    /// True if closed forms along the plan compute λ; otherwise λ must be solved from Φ_qᵀ λ = r.
    pub solved: bool,
    /// The operations of one evaluation.
    pub operations: OperationCount,
    /// Drivers.
    pub efforts: &'static [EffortInfo],
    /// Joints.
    pub reactions: &'static [ReactionInfo],
    /// Springs.
    pub springs: &'static [SpringInfo],
    /// Masses.
    #[doc(hidden)]
    pub masses: &'static [MassInfo],
    /// What gravity, applied loads and springs exert on bodies.
    #[doc(hidden)]
    pub loads: &'static [LoadInfo],
    /// Units.
    pub units: ForceUnits,
    /// The non-zero entries of the symmetric mass matrix M on and above the diagonal: row, column, and the entry as
    /// text; empty without the feature `equations`.
    #[doc(hidden)]
    pub mass_matrix: &'static [(usize, usize, &'static str)],
    /// Q of M q̈ + Φ_qᵀ λ = Q, a text for every coordinate; empty without the feature `equations`.
    #[doc(hidden)]
    pub generalized: &'static [&'static str],
}

/// The units of forces, derived from the units of masses, lengths and times in the description; `None` where these do
/// not determine them.
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
        let known = all.into_iter().filter_map(|(noun, unit)| Some((noun, unit?)));
        known
            .enumerate()
            .try_for_each(|(k, (noun, unit))| write!(f, "{}{noun} in {unit}", if k > 0 { ", " } else { "" }))
    }
}

impl ForceModel {
    /// The index of the shaking force, x and y, which its moment follows.
    pub const SHAKING: usize = 0;
    /// The index of the part of these that inertia causes.
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
    /// The rate of the total energy.
    pub const ENERGY_RATE: usize = 12;
    /// The first multiplier.
    pub const MULTIPLIERS: usize = 13;

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

#[cfg(feature = "std")]
impl Model {
    /// Whether there are forces of contacts or ropes, which may change their sign.
    #[cfg(feature = "cli")]
    pub(crate) fn has_one_sided_forces(&self) -> bool {
        let is_one_sided = |reaction: &ReactionInfo| reaction.has_normal || reaction.has_tension;
        self.forces.is_some_and(|forces| forces.reactions.iter().any(is_one_sided))
    }

    /// The row whose effort has this name: a driving row, or one of velocity level that prescribes a speed. None for a
    /// held coordinate that moves.
    pub(crate) fn row_of_effort(&self, name: &str) -> Option<usize> {
        let is_named = |row: &super::RowInfo| row.name == name || row.driving && self.joints[row.joint].name == name;
        self.rows.iter().position(|row| (row.driving || row.level == Level::Velocity) && is_named(row))
    }
}

impl ReactionInfo {
    /// The index of the x component of the force, which y follows; `None` where there are only couples.
    pub fn force(&self) -> Option<usize> {
        self.has_force.then_some(self.place + 2)
    }

    /// The index of the moment.
    pub fn moment(&self) -> Option<usize> {
        self.has_moment.then_some(self.place + if self.has_force { 4 } else { 0 })
    }

    /// The index of the first couple, which the others and the generalized forces follow.
    pub fn couples(&self) -> usize {
        self.place + usize::from(self.has_force) * 4 + usize::from(self.has_moment)
    }

    /// The index of the normal component of a contact force.
    pub fn normal(&self) -> Option<usize> {
        self.has_normal.then_some(self.couples() + self.couples.len() + self.generalized)
    }

    /// The index of the tension of a rope.
    pub fn tension(&self) -> Option<usize> {
        let contact = usize::from(self.has_normal) + usize::from(self.has_tangential);
        self.has_tension.then_some(self.couples() + self.couples.len() + self.generalized + contact)
    }
}

/// A driver: the numbers at `place` are its effort and the rate of the quantity that it drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffortInfo {
    /// The driver's name, that of a row of velocity level that prescribes a constant speed, or that of a held coordinate whose
    /// value changes.
    pub name: &'static str,
    /// The first of its two numbers.
    pub place: usize,
}

/// A joint. The numbers from `place` on are point and force (4 numbers, if it has a force), the moment, couples,
/// generalized forces, the normal and the tangential component of a contact force, and the tension of a rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReactionInfo {
    /// Its name; `b.x`, `b.y`, `b.phi` or `b.origin` for a held coordinate of a body b or its carried origin.
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
    /// The number of generalized forces: one per row of an equation that the user wrote.
    pub generalized: usize,
    /// Its bodies touch, and the force has a normal component.
    pub has_normal: bool,
    /// Its bodies roll on one another, and the force has a tangential component.
    pub has_tangential: bool,
    /// It is a rope, and has a tension.
    pub has_tension: bool,
}

/// A mass and its moment of inertia: two numbers from `place` on.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassInfo {
    /// Its body.
    pub on: Frame,
    /// The first of its numbers.
    pub place: usize,
}

/// What a load exerts on a body: a point and a force there (four numbers), or a couple, from `place` on among the
/// numbers of [`Mechanism::loads_with`](crate::Mechanism::loads_with).
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
    /// One past the index of its last number.
    pub(crate) const fn end(&self) -> usize {
        self.place + if self.is_force { 4 } else { 1 }
    }
}

/// A spring. The numbers from `place` on are its length or angle, the rate of this, the tension or the couple on the
/// second body, the energy, and the power of the damper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringInfo {
    /// Its name.
    pub name: &'static str,
    /// True for a torsion spring.
    pub turns: bool,
    /// The first of its five numbers.
    pub place: usize,
}
