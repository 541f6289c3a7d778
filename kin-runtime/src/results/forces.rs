//! Forces at one instant: efforts of drivers, reactions of joints, springs, shaking, energies and powers.

use crate::model::Frame;
use core::fmt;

/// The force of a contact or a rope below this, relative to the largest force, is a rounding error.
const ROUNDING: f64 = 1e-12;

/// A force and its moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Wrench {
    /// Components in the inertial frame.
    pub force: [f64; 2],
    /// The moment, counter-clockwise; of shaking about the origin of the inertial frame.
    pub moment: f64,
}

/// What a driver or an input supplies.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// The driver or the input; `b.x`, `b.y` or `b.phi` for a held coordinate that moves, the coordinate for one that is
    /// given.
    pub name: &'static str,
    /// Torque along an angle, force along a length; positive when it does positive work while the driven quantity
    /// grows. None if redundant rows leave it undetermined, unless forces of least norm are requested.
    pub effort: Option<f64>,
    /// The rate of the driven quantity; effort · rate is the power supplied.
    pub rate: f64,
    /// False where redundant rows share the load in a way that equilibrium alone does not determine.
    pub determined: bool,
}

/// What a joint exerts. The other body receives the opposite force at the same place and the opposite moment. If two
/// discs roll on one another along a ψ that is driven, the first also receives the driver's torque. Of a rope, this is the
/// pull on the body of the last point; the bodies of other points receive its tension along both of its parts there.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The joint; `b.x`, `b.y`, `b.phi` or `b.origin` for held coordinates and the carried origin of a body `b`.
    pub name: &'static str,
    /// The body on which force and moment act, that of the joint's second operand; `None` if there are only couples.
    pub on: Option<Frame>,
    /// The joint's point in the inertial frame; none for a pure couple.
    pub point: Option<[f64; 2]>,
    /// The force in the inertial frame; none for a pure couple, and if redundant rows leave it undetermined, unless
    /// forces of least norm are requested ([`Solver::forces_of_least_norm`](crate::Solver::forces_of_least_norm)).
    pub force: Option<[f64; 2]>,
    /// The moment about that point, or the couple; `None` if there is none or if it is undetermined.
    pub moment: Option<f64>,
    /// Couples on gears, pulleys, pinions, nuts and their carriers; empty if undetermined.
    pub couples: Vec<(Frame, f64)>,
    /// −λ of the user's own rows, conjugate to left minus right.
    pub generalized: Vec<f64>,
    /// For contacts (cams, flat followers, rolling discs): the normal component of the contact force, positive while
    /// the bodies press on one another; a real contact would open where it becomes negative. It points to the outer
    /// side: outside of a polar curve, where the left side of an implicit curve grows, to the right of a parametric
    /// curve or on the side of its roller, and for lines and discs on the side of the rolling disc.
    pub normal: Option<f64>,
    /// For discs that roll without slipping: the component of the contact force on the second body along the line's
    /// axis, or in the direction of growing ψ. Rolling needs a coefficient of friction of at least |tangential| /
    /// normal.
    pub tangential: Option<f64>,
    /// Of a rope: its tension, the same along all of it, negative where it would have to push. It is λ of the rope's row, the
    /// Φ of which is a length.
    pub tension: Option<f64>,
    /// False where redundant rows share the load in a way that equilibrium alone does not determine.
    pub determined: bool,
}

/// The instant at which the bodies of a contact stop pressing on one another, or begin to again; or at which a rope goes
/// slack, or is taut again.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactChange {
    /// The joint.
    pub name: &'static str,
    /// When its normal force or its tension changes its sign.
    pub t: f64,
    /// True if after this instant, in the direction of the motion, the contact would have to pull or the rope to push;
    /// false if the contact presses again or the rope is taut again.
    pub lifts_off: bool,
    /// Width of the interval of time in which the sign changes; 0 for a force that has the wrong sign at the first
    /// instant.
    pub within: f64,
    /// True for a rope, false for a contact.
    pub rope: bool,
}

/// `contact lifts off at t = 0.3`, `stay goes slack at t = 0.3`.
impl fmt::Display for ContactChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} at t = ", self.name, self.event())?;
        crate::text::number(f, &self.t)
    }
}

impl ContactChange {
    /// `lifts off`.
    pub(crate) const fn event(&self) -> &'static str {
        match (self.rope, self.lifts_off) {
            (false, true) => "lifts off",
            (false, false) => "presses again",
            (true, true) => "goes slack",
            (true, false) => "is taut again",
        }
    }
}

/// A spring.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringForce {
    /// Its name.
    pub name: &'static str,
    /// True for a torsion spring.
    pub turns: bool,
    /// ℓ, or the angle.
    pub length: f64,
    /// Its rate.
    pub rate: f64,
    /// Tension; of a torsion spring the couple on its second body.
    pub force: f64,
    /// Stored energy.
    pub energy: f64,
    /// Power of the damper, never positive.
    pub damper_power: f64,
}

/// The force or couple of gravity, an applied load or a spring on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Its name; `gravity` for the weight of a mass.
    pub name: &'static str,
    /// The body on which it acts.
    pub on: Frame,
    /// The point and the force there, in the inertial frame; none for a couple.
    pub force: Option<[[f64; 2]; 2]>,
    /// The couple; none for a force.
    pub couple: Option<f64>,
}

/// `S: force (1, 2) at (0.3, 0)`, `brake: couple 1.5`.
impl fmt::Display for Load {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.name)?;
        if let Some([[x, y], [fx, fy]]) = self.force {
            write!(f, " force ({fx}, {fy}) at ({x}, {y})")?;
        }
        self.couple.map_or(Ok(()), |couple| write!(f, " couple {couple}"))
    }
}

/// Forces at one instant, from M q̈ + Φ_qᵀ λ = Q.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Time.
    pub t: f64,
    /// The mechanism's names.
    pub model: &'static crate::model::Model,
    /// Drivers, rows of velocity level that prescribe a constant speed, held coordinates that move, and coordinates that
    /// are given.
    pub efforts: Vec<Effort>,
    /// Inputs u, with u̇: the product is the power that enters with u through drivers and held coordinates. If one of
    /// these moves by `2*u`, its effort counts twice. An input that is a speed has the effort 0: its driver has the power.
    /// The powers of inputs are parts of the powers of drivers and not to be added to them; what an input changes in springs
    /// and loads is part of the applied power.
    pub inputs: Vec<Effort>,
    /// Joints.
    pub reactions: Vec<Reaction>,
    /// Springs.
    pub springs: Vec<SpringForce>,
    /// The resultant of all that the mechanism exerts on the ground: Σ m (g − a) + Σ F, and its moment.
    pub shaking: Wrench,
    /// The part of it that inertia causes: −Σ m a, and −Σ (r × m a + J α).
    pub inertia: Wrench,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Potential energy of gravity, −Σ m g·r, 0 at the origin.
    pub gravity: f64,
    /// Energy of springs.
    pub elastic: f64,
    /// Power of all [`efforts`](Self::efforts).
    pub driver_power: f64,
    /// Power of applied forces and couples, and that which changes of a spring's stiffness and free length and of the
    /// field of gravity supply.
    pub applied_power: f64,
    /// Power of dampers, not positive unless a damping is negative.
    pub damper_power: f64,
    /// d/dt of the total energy, from the derivatives of the energies themselves. It equals the power of drivers,
    /// applied loads and dampers together.
    pub energy_rate: f64,
    /// λ of all rows of Φ; those of the forces of least norm if redundant rows leave them open. They depend on how rows
    /// are scaled.
    pub multipliers: Vec<f64>,
}

impl Forces {
    /// Whether the reaction of the joint with this index has all of its numbers, because it is determined or of least
    /// norm.
    #[cfg(feature = "serde")]
    pub(crate) fn has_numbers(&self, joint: usize) -> bool {
        let Some(name) = self.model.joints.get(joint).map(|joint| joint.name) else { return true };
        let lacks = |found: &Reaction| {
            let info = self.model.forces.and_then(|forces| forces.reactions.iter().find(|info| info.name == name));
            info.is_some_and(|info| {
                info.has_force && found.force.is_none()
                    || info.has_moment && found.moment.is_none()
                    || info.has_normal && found.normal.is_none()
                    || info.couples.len() > found.couples.len()
                    || info.generalized > found.generalized.len()
            })
        };
        !self.reactions.iter().any(|found| found.name == name && lacks(found))
            && !self.efforts.iter().any(|effort| effort.name == name && effort.effort.is_none())
    }

    /// The difference between the power of drivers, applied loads and dampers and the rate of the total energy,
    /// relative to the largest of these. If all of them are 0, as of a balanced rotor, this is a quotient of rounding
    /// errors.
    pub fn power_miss(&self) -> f64 {
        self.power_miss_above(0.0)
    }

    /// As [`power_miss`](Self::power_miss), but relative to no less than `least`.
    pub(crate) fn power_miss_above(&self, least: f64) -> f64 {
        let powers = [self.driver_power, self.applied_power, self.damper_power];
        let largest = powers.iter().fold(self.energy_rate.abs().max(least), |largest, power| largest.max(power.abs()));
        let miss = (self.energy_rate - powers.iter().sum::<f64>()).abs();
        if miss == 0.0 { 0.0 } else { miss / largest }
    }

    /// The effort of a driver, or of an input.
    pub fn effort(&self, driver: &str) -> Option<f64> {
        self.efforts.iter().chain(&self.inputs).find(|effort| effort.name == driver)?.effort
    }

    /// The reaction of a joint.
    pub fn reaction(&self, joint: &str) -> Option<&Reaction> {
        self.reactions.iter().find(|reaction| reaction.name == joint)
    }

    /// The contacts whose normal force is negative: the bodies would have to pull on one another. A real contact, which
    /// can only press, has lifted off.
    pub fn pulling(&self) -> impl Iterator<Item = &Reaction> {
        let violated = self.reactions.iter().zip(self.one_sided()).filter(|(_, force)| force.is_some_and(|f| f < 0.0));
        violated.map(|(reaction, _)| reaction).filter(|reaction| reaction.normal.is_some())
    }

    /// The ropes that would have to push, each with its tension, which is negative: a real rope is slack there. A tension that
    /// redundant rows leave undetermined does not count.
    pub fn slack_ropes(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        let ropes = self.reactions.iter().zip(self.one_sided()).filter(|(reaction, _)| reaction.tension.is_some());
        ropes.filter_map(|(reaction, force)| Some((reaction.name, force.filter(|&tension| tension < 0.0)?)))
    }

    /// For every reaction the normal force of a contact or the tension of a rope, which real contacts and ropes can only
    /// supply where it is positive; 0 if it is a rounding error. None for other joints, and where it is undetermined.
    pub(crate) fn one_sided(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        let size = |reaction: &Reaction| reaction.force.map_or(0.0, |[x, y]| x.hypot(y));
        let largest = self.reactions.iter().map(size).fold(0.0, f64::max);
        let forces = self.reactions.iter().map(|reaction| reaction.normal.or(reaction.tension));
        forces.map(move |force| force.map(|f| if f.abs() <= ROUNDING * largest { 0.0 } else { f }))
    }

    /// The name of the body that something acts on, or `ground`.
    pub fn body(&self, frame: Frame) -> &'static str {
        match frame {
            Frame::Ground => "ground",
            Frame::Body(index) => self.model.bodies.get(index).map_or("", |body| body.name),
        }
    }
}

/// A number, or a mark that there is none.
struct NumberOrMark(Option<f64>);

impl fmt::Display for NumberOrMark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(value) => value.fmt(f),
            None => f.write_str("undetermined"),
        }
    }
}

/// `force (1, 2), moment 3`.
impl fmt::Display for Wrench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.force;
        write!(f, "force ({x}, {y}), moment {}", self.moment)
    }
}

/// `drive: effort 1.5, rate 2`.
impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: effort {}, rate {}", self.name, NumberOrMark(self.effort), self.rate)
    }
}

/// `B: force (1, 2), moment 0`, with couples and generalized forces where there are any.
impl fmt::Display for Reaction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.name)?;
        if !self.determined {
            f.write_str(" undetermined, redundant rows share the load")?;
            let lacks_numbers =
                self.point.is_some() && self.force.is_none() || self.on.is_some() && self.moment.is_none();
            // The numbers that follow are what is determined nevertheless, or only one possibility.
            if self.force.is_some() || self.moment.is_some() {
                f.write_str(if lacks_numbers { "; determined:" } else { "; of least norm:" })?;
            }
        }
        if let Some([x, y]) = self.force {
            write!(f, " force ({x}, {y})")?;
        }
        if let Some(moment) = self.moment {
            write!(f, " moment {moment}")?;
        }
        self.couples.iter().try_for_each(|(_, couple)| write!(f, " couple {couple}"))?;
        self.generalized.iter().try_for_each(|value| write!(f, " generalized force {value}"))?;
        self.normal.map_or(Ok(()), |normal| write!(f, " normal {normal}"))?;
        self.tangential.map_or(Ok(()), |tangential| write!(f, " tangential {tangential}"))?;
        self.tension.map_or(Ok(()), |tension| write!(f, " tension {tension}"))
    }
}

/// `S: 12.5 at a length of 0.3`.
impl fmt::Display for SpringForce {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let coordinate = if self.turns { "an angle" } else { "a length" };
        write!(f, "{}: {} at {coordinate} of {}", self.name, self.force, self.length)
    }
}

/// A line per driver, joint and spring, then shaking, energy and power.
impl fmt::Display for Forces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.efforts.iter().try_for_each(|effort| writeln!(f, "driver {effort}"))?;
        self.inputs.iter().try_for_each(|effort| writeln!(f, "input {effort}"))?;
        self.reactions.iter().try_for_each(|reaction| writeln!(f, "joint {reaction}"))?;
        self.springs.iter().try_for_each(|spring| writeln!(f, "spring {spring}"))?;
        writeln!(f, "shaking: {}", self.shaking)?;
        writeln!(f, "energy: kinetic {}, gravity {}, springs {}", self.kinetic, self.gravity, self.elastic)?;
        let [drivers, applied, dampers] = [self.driver_power, self.applied_power, self.damper_power];
        write!(f, "power: drivers {drivers}, applied {applied}, dampers {dampers}")
    }
}
