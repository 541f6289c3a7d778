//! Forces at one instant: efforts of drivers, reactions of joints, springs, shaking, energies and powers.

use crate::model::Frame;
use core::fmt;

/// A force and its moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Wrench {
    /// Components in the inertial frame.
    pub force: [f64; 2],
    /// The moment, counter-clockwise; of shaking about the origin of the inertial frame.
    pub moment: f64,
}

/// What a driver supplies.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// The driver; `b.x`, `b.y` or `b.phi` for a held coordinate that moves, the coordinate for one that is given.
    pub name: &'static str,
    /// Torque along an angle, force along a length; positive when it does positive work while the driven quantity
    /// grows. None where redundant rows leave it undetermined.
    pub effort: Option<f64>,
    /// The rate of the driven quantity; effort · rate is the power supplied.
    pub rate: f64,
}

/// What a joint exerts. The other body receives the opposite force at the same place and the opposite moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The joint; `b.x`, `b.y`, `b.phi` or `b.origin` for what holds or carries a body.
    pub name: &'static str,
    /// The body on which force and moment act: that of the joint's second operand; none where there are only couples.
    pub on: Option<Frame>,
    /// The joint's point in the inertial frame; none for a pure couple.
    pub point: Option<[f64; 2]>,
    /// The force in the inertial frame; none for a pure couple, and where redundant rows leave it undetermined.
    pub force: Option<[f64; 2]>,
    /// The moment about that point, or the couple; none where there is none or where it is undetermined.
    pub moment: Option<f64>,
    /// Couples on gears, belts, pinions, nuts and what carries them; none of them where undetermined.
    pub couples: Vec<(Frame, f64)>,
    /// −λ of the user's own rows, conjugate to left minus right.
    pub generalized: Vec<f64>,
    /// False where redundant rows share the load in a way that equilibrium alone does not tell.
    pub determined: bool,
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

/// Forces at one instant, from M q̈ + Φ_qᵀ λ = Q.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Time.
    pub t: f64,
    /// Names of the bodies.
    pub model: &'static crate::model::Model,
    /// Drivers.
    pub efforts: Vec<Effort>,
    /// Joints.
    pub reactions: Vec<Reaction>,
    /// Springs.
    pub springs: Vec<SpringForce>,
    /// The resultant of all that the mechanism exerts on the ground: Σ m (g − a) + Σ F, and its moment.
    pub shaking: Wrench,
    /// The same of motion alone: −Σ m a, and −Σ (r × m a + J α).
    pub inertia: Wrench,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Potential energy of gravity, −Σ m g·r, 0 at the origin.
    pub gravity: f64,
    /// Energy of springs.
    pub elastic: f64,
    /// Power that drivers supply.
    pub driver_power: f64,
    /// Power of applied forces and couples.
    pub applied_power: f64,
    /// Power of dampers, never positive.
    pub damper_power: f64,
    /// λ of all rows of Φ; of least norm where redundant rows leave it open. They depend on how rows are scaled.
    pub multipliers: Vec<f64>,
}

impl Forces {
    /// The effort of a driver.
    pub fn effort(&self, driver: &str) -> Option<f64> {
        self.efforts.iter().find(|effort| effort.name == driver)?.effort
    }

    /// The reaction of a joint.
    pub fn reaction(&self, joint: &str) -> Option<&Reaction> {
        self.reactions.iter().find(|reaction| reaction.name == joint)
    }

    /// A body by its name.
    pub(crate) fn body(&self, frame: Frame) -> &'static str {
        match frame {
            Frame::Ground => "ground",
            Frame::Body(place) => self.model.bodies.get(place).map_or("", |body| body.name),
        }
    }
}

/// A line per driver, joint and spring, then shaking, energy and power.
impl fmt::Display for Forces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for effort in &self.efforts {
            match effort.effort {
                Some(value) => writeln!(f, "driver {}: effort {value}, rate {}", effort.name, effort.rate)?,
                None => writeln!(f, "driver {}: undetermined", effort.name)?,
            }
        }
        for reaction in &self.reactions {
            write!(f, "joint {}:", reaction.name)?;
            if !reaction.determined {
                f.write_str(" undetermined, redundant rows share the load")?;
            }
            if let (Some([x, y]), Some(on)) = (reaction.force, reaction.on) {
                write!(f, " force ({x}, {y}) on {}", self.body(on))?;
            }
            if let (Some(moment), Some(on)) = (reaction.moment, reaction.on) {
                write!(f, " moment {moment} on {}", self.body(on))?;
            }
            for (frame, couple) in &reaction.couples {
                write!(f, " couple {couple} on {}", self.body(*frame))?;
            }
            for value in &reaction.generalized {
                write!(f, " generalized {value}")?;
            }
            f.write_str("\n")?;
        }
        for spring in &self.springs {
            writeln!(f, "spring {}: {} at {}", spring.name, spring.force, spring.length)?;
        }
        let Wrench { force: [x, y], moment } = self.shaking;
        writeln!(f, "shaking: force ({x}, {y}), moment {moment}")?;
        writeln!(f, "energy: kinetic {}, gravity {}, springs {}", self.kinetic, self.gravity, self.elastic)?;
        write!(f, "power: drivers {}, applied {}, dampers {}", self.driver_power, self.applied_power, self.damper_power)
    }
}
