//! A mechanism put together around a pose: bodies are placed first, joints take their dimensions from where they are.

use super::super::*;
use kin_core::joints::{Angle, Distance, PointOnLine, RelativeAngle, Revolute, Translational};
use kin_core::mechanism::{Axis, Body, BodyOrigin, BodyRef, Formula, Mechanism, Operands, Parameter, Place, Value};
use std::f64::consts::TAU;

/// x, y, φ.
pub type Pose = [f64; 3];
pub type Vector = [f64; 2];

/// The ground's number; bodies count from 1.
pub const FIXED: usize = 0;

pub struct Draft {
    pub random: Random,
    pub mechanism: Mechanism,
    /// Of the parameters, in order.
    pub values: Vec<f64>,
    /// Of the ground and the bodies at t = 0.
    pub poses: Vec<Pose>,
    /// In how many of a hundred cases the pin on a body's origin is written as that origin being carried.
    pub carried: usize,
    /// Frames are as the ground's, moved to a pin, and guides go through the point at `at` without an offset: integers
    /// stay integers.
    pub plain: bool,
}

/// A vector turned by φ.
pub fn turned(phi: f64, [x, y]: Vector) -> Vector {
    let (sin, cos) = phi.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

pub fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn length([x, y]: Vector) -> f64 {
    x.hypot(y)
}

/// The shortest that a link is; sizes are near 1.
pub const SHORTEST: f64 = 0.3;

impl Draft {
    pub fn new(seed: u64) -> Self {
        let mechanism = Mechanism { name: "Drafted".into(), ..Mechanism::default() };
        Self { random: Random(seed), mechanism, values: Vec::new(), poses: vec![[0.0; 3]], carried: 0, plain: false }
    }

    /// The poses as q: x, y, φ of every body, without those that a body does not have as coordinates.
    pub fn q(&self) -> Vec<f64> {
        let own = |(body, pose): (&Body, &Pose)| match body.origin_at {
            BodyOrigin::Free { .. } => pose.to_vec(),
            BodyOrigin::Carried(_) => vec![pose[2]],
        };
        self.mechanism.bodies.iter().zip(&self.poses[1..]).flat_map(own).collect()
    }

    /// A new body at a pose; its number.
    pub fn body(&mut self, pose: Pose) -> usize {
        self.poses.push(pose);
        let name = format!("b{}", self.poses.len() - 1);
        self.mechanism.bodies.push(free(&name, None));
        self.poses.len() - 1
    }

    /// A new body that will be pinned at `points`. Frames as people choose them: with the origin on a pin and the
    /// first axis through the next, with the origin on a pin, or anywhere.
    pub fn link(&mut self, points: &[Vector]) -> usize {
        let [from, to] = [0, 1].map(|k| points[k % points.len()]);
        if self.plain {
            return self.body([from[0], from[1], 0.0]);
        }
        let phi = self.random.between(-TAU, TAU) / 2.0;
        let pose = match self.random.below(3) {
            0 if from != to => {
                let [x, y] = minus(to, from);
                [from[0], from[1], y.atan2(x) + TAU * (self.random.below(3) as f64 - 1.0)]
            }
            1 => [from[0], from[1], phi],
            _ => [from[0] + self.random.between(-0.5, 0.5), from[1] + self.random.between(-0.5, 0.5), phi],
        };
        self.body(pose)
    }

    pub fn named(&self, frame: usize) -> BodyRef {
        if frame == FIXED { GROUND } else { body(frame - 1) }
    }

    /// A new parameter with this value, or the literal 0.
    pub fn value(&mut self, value: f64) -> Formula {
        if value.abs() < 1e-14 {
            return Formula::ZERO;
        }
        self.values.push(value);
        let name = format!("p{}", self.values.len());
        let blank = Parameter { name, len: None, unit: None, default: None, doc: String::new(), origin: AT };
        self.mechanism.parameters.push(blank);
        parameter(self.values.len() - 1)
    }

    /// The point of a body that is at `point`.
    pub fn place(&mut self, frame: usize, point: Vector) -> Place {
        let [x0, y0, phi] = self.poses[frame];
        let [x, y] = turned(-phi, minus(point, [x0, y0]));
        let (x, y) = (self.value(x), self.value(y));
        on(self.named(frame), x, y)
    }

    /// A direction of a body that is at the angle `psi`: an axis of its frame where that fits, otherwise of any length.
    pub fn axis(&mut self, frame: usize, psi: f64) -> Axis {
        let length = self.random.between(0.5, 2.0);
        let [x, y] = turned(psi - self.poses[frame][2], [length, 0.0]);
        let snap = |v: f64| if v.abs() < 1e-14 { 0.0 } else { v };
        let (x, y) = (self.value(snap(x)), self.value(snap(y)));
        axis(x, y)
    }

    pub fn add(&mut self, operands: Operands) {
        let name = format!("J{}", self.mechanism.joints.len());
        self.mechanism.joints.push(joint(&name, operands));
    }

    /// Two places in one or the other order.
    fn either(&mut self, a: usize, b: usize) -> (usize, usize) {
        if self.random.chance(50) { (a, b) } else { (b, a) }
    }

    /// A revolute joint of b with a, which b may be carried by.
    pub fn pin(&mut self, a: usize, b: usize, at: Vector) {
        if self.poses[b][..2] == at && self.random.chance(self.carried) {
            self.mechanism.bodies[b - 1].origin_at = BodyOrigin::Carried(self.place(a, at));
            return;
        }
        let (a, b) = self.either(a, b);
        let (p, q) = (self.place(a, at), self.place(b, at));
        self.add(Revolute { p, q }.into());
    }

    /// A translational joint along the direction ψ through `at`, the second point somewhere else along it.
    pub fn slide(&mut self, a: usize, b: usize, at: Vector, psi: f64) {
        let (a, b) = self.either(a, b);
        let stroke = if self.plain { 0.0 } else { self.random.between(-1.0, 1.0) };
        let other = plus(at, turned(psi, [stroke, 0.0]));
        let (p, q, axis) = (self.place(a, at), self.place(b, other), self.axis(a, psi));
        let angle = self.value(self.poses[b][2] - self.poses[a][2]);
        self.add(Translational { p, q, axis, angle }.into());
    }

    /// The point `at` of b on a line of a with the direction ψ, at a signed offset or none; the offset may grow.
    pub fn on_line(&mut self, a: usize, b: usize, at: Vector, psi: f64) {
        let along = if self.plain { 0.0 } else { self.random.between(-1.0, 1.0) };
        let e = if self.plain || self.random.chance(40) { 0.0 } else { self.random.between(-0.4, 0.4) };
        let foot = minus(at, turned(psi, [along, e]));
        let (p, q, axis) = (self.place(a, foot), self.place(b, at), self.axis(a, psi));
        let offset = self.growing(e, 15);
        self.add(PointOnLine { p, q, axis, offset }.into());
    }

    /// The distance of a point of a and a point of b; the length may grow.
    pub fn rod(&mut self, (a, p): (usize, Vector), (b, q): (usize, Vector)) {
        let length = self.growing(length(minus(q, p)), 25);
        let (p, q) = (self.place(a, p), self.place(b, q));
        let kind = if self.random.chance(80) {
            Distance { p, q, length: Value { value: length, origin: AT } }.into()
        } else {
            driver(Formula::Distance(Box::new(p), Box::new(q)), length)
        };
        self.add(kind);
    }

    /// `value` at t = 0, in some of a hundred cases with a rate.
    fn growing(&mut self, value: f64, percent: usize) -> Formula {
        let value = self.value(value);
        if self.plain || !self.random.chance(percent) {
            return value;
        }
        let rate = self.random.between(-0.1, 0.1);
        let rate = self.value(rate);
        add(value, mul(rate, Formula::Time))
    }

    /// A body driven against another in angle, at the rate ω.
    pub fn drive(&mut self, a: usize, b: usize, omega: f64) {
        let start = self.poses[b][2] - self.poses[a][2];
        let value = self.value(start);
        let omega = self.value(omega);
        let value = add(value, mul(omega, Formula::Time));
        let (a, b) = (self.named(a), self.named(b));
        let kind = match self.random.below(3) {
            0 if a.is_ground() => Angle { body: b, value }.into(),
            1 if a.is_ground() => driver(phi(b), value),
            _ => RelativeAngle { a, b, value }.into(),
        };
        self.add(kind);
    }

    /// Joints in another order.
    pub fn shuffle(&mut self) {
        for k in (1..self.mechanism.joints.len()).rev() {
            let other = self.random.below(k + 1);
            self.mechanism.joints.swap(k, other);
        }
    }
}
