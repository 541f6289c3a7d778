//! The poses of bodies, and positions, velocities and accelerations of their points from these alone.

use crate::{Loads, Place};
use kin_runtime::State;
use kin_runtime::model::{Frame, Model};

/// x, y, φ with their rates and accelerations.
#[derive(Clone, Copy, Default)]
pub(crate) struct Pose {
    pub(crate) at: [f64; 3],
    pub(crate) rate: [f64; 3],
    pub(crate) acceleration: [f64; 3],
}

/// The place of a frame in lists of all bodies, behind which the ground stands.
pub(crate) fn slot(model: &Model, frame: Frame) -> usize {
    match frame {
        Frame::Ground => model.bodies.len(),
        Frame::Body(place) => place,
    }
}

/// The place of a body of this name, or of the ground.
pub(crate) fn named(model: &Model, name: &str) -> usize {
    let place = model.bodies.iter().position(|body| body.name == name);
    place.unwrap_or_else(|| if name == "ground" { model.bodies.len() } else { panic!("no body {name}") })
}

/// The poses of all bodies and of the ground.
pub(crate) fn poses(state: &State) -> Vec<Pose> {
    let body = |motion: &kin_runtime::BodyMotion| Pose {
        at: [motion.x, motion.y, motion.phi],
        rate: [motion.x_dot, motion.y_dot, motion.phi_dot],
        acceleration: [motion.x_ddot, motion.y_ddot, motion.phi_ddot],
    };
    state.bodies.iter().map(body).chain([Pose::default()]).collect()
}

impl Pose {
    /// A vector of the body's frame in the inertial frame.
    pub(crate) fn turned(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.at[2].sin_cos();
        [cos * u - sin * v, sin * u + cos * v]
    }

    /// r, v and a of a point of the body.
    pub(crate) fn point(&self, local: [f64; 2]) -> [[f64; 2]; 3] {
        let [x, y] = self.turned(local);
        let (w, w_dot) = (self.rate[2], self.acceleration[2]);
        let sum = |origin: [f64; 3], arm: [f64; 2]| [origin[0] + arm[0], origin[1] + arm[1]];
        [
            sum(self.at, [x, y]),
            sum(self.rate, [-w * y, w * x]),
            sum(self.acceleration, [-w_dot * y - w * w * x, w_dot * x - w * w * y]),
        ]
    }
}

/// A sum of forces with its moment about the origin of the inertial frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    pub(crate) force: [f64; 2],
    pub(crate) moment: f64,
    /// The largest terms of force and moment.
    pub(crate) size: [f64; 2],
}

impl Sum {
    /// Adds a force at a point, and a couple.
    pub(crate) fn add(&mut self, [x, y]: [f64; 2], [fx, fy]: [f64; 2], couple: f64) {
        self.force[0] += fx;
        self.force[1] += fy;
        self.moment += x * fy - y * fx + couple;
        self.size[0] = self.size[0].max(fx.abs()).max(fy.abs());
        self.size[1] = self.size[1].max((x * fy).abs()).max((y * fx).abs()).max(couple.abs());
    }
}

/// A spring: its length or angle, the rate, and the tension or torque that its law gives.
pub(crate) type Spring = [f64; 3];

/// What loads do at a state: weights and applied loads from outside, springs between bodies, and inertia.
pub(crate) struct Loaded {
    pub(crate) outside: Vec<Sum>,
    pub(crate) springs: Vec<Sum>,
    /// Σ m a and Σ (r × m a + J α).
    pub(crate) inertia: Vec<Sum>,
    /// In the order of declaration, torsion springs last.
    pub(crate) laws: Vec<Spring>,
    pub(crate) kinetic: f64,
    pub(crate) gravity: f64,
}

impl Loads {
    /// What they do at a state.
    pub(crate) fn at(&self, state: &State) -> Loaded {
        let (model, poses) = (state.model, poses(state));
        let nothing = vec![Sum::default(); poses.len()];
        let mut out = Loaded {
            outside: nothing.clone(),
            springs: nothing.clone(),
            inertia: nothing,
            laws: Vec::new(),
            kinetic: 0.0,
            gravity: 0.0,
        };
        let place = |(body, local): Place| (named(model, body), local);
        for &(centre, mass, inertia) in self.masses {
            let (body, local) = place(centre);
            let [r, v, a] = poses[body].point(local);
            let spin = inertia * poses[body].acceleration[2];
            out.inertia[body].add(r, a.map(|a| mass * a), spin);
            out.outside[body].add(r, self.gravity.map(|g| mass * g), 0.0);
            out.kinetic += 0.5 * (mass * (v[0] * v[0] + v[1] * v[1]) + inertia * poses[body].rate[2].powi(2));
            out.gravity -= mass * (self.gravity[0] * r[0] + self.gravity[1] * r[1]);
        }
        for &(at, components, turns) in self.forces {
            let (body, local) = place(at);
            let force = if turns { poses[body].turned(components) } else { components };
            out.outside[body].add(poses[body].point(local)[0], force, 0.0);
        }
        for &(from, on, couple) in self.torques {
            out.outside[named(model, on)].add([0.0; 2], [0.0; 2], couple);
            if let Some(from) = from {
                out.outside[named(model, from)].add([0.0; 2], [0.0; 2], -couple);
            }
        }
        for &(a, b, [stiffness, free, damping]) in self.springs {
            let ((a, from), (b, to)) = (place(a), place(b));
            let ([p, v, _], [q, w, _]) = (poses[a].point(from), poses[b].point(to));
            let (d, rates) = ([q[0] - p[0], q[1] - p[1]], [w[0] - v[0], w[1] - v[1]]);
            let length = d[0].hypot(d[1]);
            let unit = d.map(|d| d / length);
            let rate = unit[0] * rates[0] + unit[1] * rates[1];
            let tension = stiffness * (length - free) + damping * rate;
            out.springs[a].add(p, unit.map(|u| tension * u), 0.0);
            out.springs[b].add(q, unit.map(|u| -tension * u), 0.0);
            out.laws.push([length, rate, tension]);
        }
        for &(a, b, [stiffness, free, damping]) in self.torsion_springs {
            let (a, b) = (named(model, a), named(model, b));
            let [angle, rate] = [poses[b].at[2] - poses[a].at[2], poses[b].rate[2] - poses[a].rate[2]];
            let torque = -stiffness * (angle - free) - damping * rate;
            out.springs[b].add([0.0; 2], [0.0; 2], torque);
            out.springs[a].add([0.0; 2], [0.0; 2], -torque);
            out.laws.push([angle, rate, torque]);
        }
        out
    }
}
