//! Mechanisms evaluated directly, joint by joint, with complex numbers: an oracle that builds no expressions.

use super::Number;
use kin_core::joints::{
    Angle, Belt, Constraint, Distance, Driver, Fixed, FlatFollower, Gear, OnCurve, PointOnLine, RackPinion,
    RelativeAngle, Revolute, RollingOnDisc, RollingOnLine, Rope, Screw, Translational, X, Y,
};
use kin_core::mechanism::{
    Axis, BodyOrigin, BodyRef, Component, Curve, CurveVariable, Formula, Function, Mechanism, Member, Operands, Place,
    Range, TypedOperands,
};
use std::cell::Cell;
use std::collections::HashMap;
use std::ops::{Add, Mul, Sub};

/// x + iy.
#[derive(Clone, Copy, Debug)]
pub struct Complex<S> {
    pub x: S,
    pub y: S,
}

impl<S: Number> Complex<S> {
    fn turn(angle: S) -> Self {
        Self { x: angle.call(Function::Cos), y: angle.call(Function::Sin) }
    }

    fn conjugate(self) -> Self {
        Self { x: self.x, y: -self.y }
    }

    fn square_of_length(self) -> S {
        (self * self.conjugate()).x
    }
}

impl<S: Number> Add for Complex<S> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { x: self.x + b.x, y: self.y + b.y }
    }
}

impl<S: Number> Sub for Complex<S> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self { x: self.x - b.x, y: self.y - b.y }
    }
}

impl<S: Number> Mul for Complex<S> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self { x: self.x * b.x - self.y * b.y, y: self.x * b.y + self.y * b.x }
    }
}

/// A mechanism at one instant.
pub struct Direct<'m, S> {
    pub mechanism: &'m Mechanism,
    /// Element by element.
    pub parameters: &'m [f64],
    pub t: S,
    pub inputs: Vec<S>,
    pub q: Vec<S>,
    /// Set when t or an input has been looked at.
    pub saw_time: Cell<bool>,
    poses: HashMap<(usize, usize, Component), usize>,
    scalars: HashMap<(usize, usize), usize>,
    /// What θ, X and Y stand for.
    variables: Cell<[Option<S>; 3]>,
}

/// The names of q as the language defines them: bodies in order of declaration, then scalars.
pub fn coordinate_names(mechanism: &Mechanism) -> Vec<String> {
    layout(mechanism).0
}

type Layout = (Vec<String>, HashMap<(usize, usize, Component), usize>, HashMap<(usize, usize), usize>);

fn layout(mechanism: &Mechanism) -> Layout {
    let (mut names, mut poses, mut scalars) = (Vec::new(), HashMap::new(), HashMap::new());
    let name_of = |name: &str, len: Option<usize>, i: usize| match len {
        Some(_) => format!("{name}[{i}]"),
        None => name.to_owned(),
    };
    for (family, body) in mechanism.bodies.iter().enumerate() {
        for i in 0..body.len.unwrap_or(1) {
            for component in Component::ALL {
                let held = match (&body.origin_at, component) {
                    (_, Component::Phi) => body.phi.is_some(),
                    (BodyOrigin::Carried(_), _) => true,
                    (BodyOrigin::Free { x, .. }, Component::X) => x.is_some(),
                    (BodyOrigin::Free { y, .. }, Component::Y) => y.is_some(),
                };
                if !held {
                    poses.insert((family, i, component), names.len());
                    names.push(format!("{}.{component}", name_of(&body.name, body.len, i)));
                }
            }
        }
    }
    for (family, scalar) in mechanism.scalars.iter().enumerate() {
        for i in 0..scalar.len.unwrap_or(1) {
            scalars.insert((family, i), names.len());
            names.push(name_of(&scalar.name, scalar.len, i));
        }
    }
    (names, poses, scalars)
}

impl<'m, S: Number> Direct<'m, S> {
    pub fn new(mechanism: &'m Mechanism, parameters: &'m [f64], t: S, inputs: Vec<S>, q: Vec<S>) -> Self {
        let (_, poses, scalars) = layout(mechanism);
        Self {
            mechanism,
            parameters,
            t,
            inputs,
            q,
            saw_time: Cell::new(false),
            poses,
            scalars,
            variables: Cell::new([None; 3]),
        }
    }

    fn index(member: Member, i: i64) -> usize {
        usize::try_from(member.index.scale * i + member.index.offset).expect("an index in range")
    }

    pub fn formula(&self, formula: &Formula, i: i64) -> S {
        let of = |a: &Formula| self.formula(a, i);
        match formula {
            Formula::Number(value) => S::real(*value),
            Formula::Pi => S::real(std::f64::consts::PI),
            Formula::Index(index) => S::real((index.scale * i + index.offset) as f64),
            Formula::Time => {
                self.saw_time.set(true);
                self.t
            }
            Formula::Parameter(member) => {
                let before: usize = self.mechanism.parameters[..member.family].iter().map(|p| p.len.unwrap_or(1)).sum();
                S::real(self.parameters[before + Self::index(*member, i)])
            }
            Formula::Input(member) => {
                self.saw_time.set(true);
                self.inputs[member.family]
            }
            Formula::Pose(body, component) => {
                let (r, angle) = self.pose(body, i);
                match component {
                    Component::X => r.x,
                    Component::Y => r.y,
                    Component::Phi => angle,
                }
            }
            Formula::Scalar(member) => self.q[self.scalars[&(member.family, Self::index(*member, i))]],
            Formula::PointCoordinate(place, Component::X) => self.point(place, i).x,
            Formula::PointCoordinate(place, _) => self.point(place, i).y,
            Formula::Distance(p, q) => (self.point(q, i) - self.point(p, i)).square_of_length().call(Function::Sqrt),
            Formula::Define(member) => {
                let define = &self.mechanism.defines[member.family];
                self.formula(&define.formula, Self::index(*member, i) as i64)
            }
            Formula::Curve(variable) => self.variables.get()[*variable as usize].expect("a formula of a curve"),
            Formula::Neg(a) => -of(a),
            Formula::Add(a, b) => of(a) + of(b),
            Formula::Sub(a, b) => of(a) - of(b),
            Formula::Mul(a, b) => of(a) * of(b),
            Formula::Div(a, b, _) => of(a) / of(b),
            Formula::Pow(a, n) if n.fract() == 0.0 => of(a).powi(*n as i32),
            Formula::Pow(a, n) => of(a).powf(*n),
            Formula::Call(f, a) => of(a).call(*f),
            Formula::Atan2(y, x) => of(y).atan2(of(x)),
            Formula::Supplied(member, a) => of(a).supplied(member.family as u32, 0),
            Formula::Dot(..) => panic!("rates have tests of their own"),
        }
    }

    /// r and φ of a body.
    pub fn pose(&self, body: &BodyRef, i: i64) -> (Complex<S>, S) {
        let BodyRef::Body { family, index, origin } = body else {
            return (Complex { x: S::real(0.0), y: S::real(0.0) }, S::real(0.0));
        };
        let i = Self::index(Member { family: *family, index: *index, origin: *origin }, i);
        let declared = &self.mechanism.bodies[*family];
        let own = |held: &Option<Formula>, component: Component| match held {
            Some(held) => self.formula(held, i as i64),
            None => self.q[self.poses[&(*family, i, component)]],
        };
        let r = match &declared.origin_at {
            BodyOrigin::Free { x, y } => Complex { x: own(x, Component::X), y: own(y, Component::Y) },
            BodyOrigin::Carried(carrier) => self.point(carrier, i as i64),
        };
        (r, own(&declared.phi, Component::Phi))
    }

    /// r + e^{iφ} s.
    pub fn point(&self, place: &Place, i: i64) -> Complex<S> {
        let (r, angle) = self.pose(&place.body, i);
        r + Complex::turn(angle) * Complex { x: self.formula(&place.x, i), y: self.formula(&place.y, i) }
    }

    /// d along and across an axis of the first body: conj(u) d = u·d + i perp(u)·d.
    fn by_axis(&self, p: &Place, q: &Place, axis: &Axis, i: i64) -> Complex<S> {
        let v = Complex { x: self.formula(&axis.x, i), y: self.formula(&axis.y, i) };
        let length = v.square_of_length().call(Function::Sqrt);
        let unit = Complex { x: v.x / length, y: v.y / length };
        let u = Complex::turn(self.pose(&p.body, i).1) * unit;
        u.conjugate() * (self.point(q, i) - self.point(p, i))
    }

    /// All rows of Φ, by name.
    pub fn rows(&self) -> Vec<(String, S)> {
        let mut rows = Vec::new();
        for joint in &self.mechanism.joints {
            for i in members(joint.range) {
                let name = match joint.range {
                    Some(_) => format!("{}[{i}]", joint.name),
                    None => joint.name.clone(),
                };
                for (part, value) in self.residuals(&joint.operands, i) {
                    rows.push((format!("{name}{part}"), value));
                }
            }
        }
        rows
    }

    fn residuals(&self, joint: &Operands, i: i64) -> Vec<(&'static str, S)> {
        let turn = |p: &BodyRef, q: &BodyRef| self.pose(q, i).1 - self.pose(p, i).1;
        if let Some(Revolute { p, q }) = &Revolute::of(joint) {
            return {
                let d = self.point(q, i) - self.point(p, i);
                vec![(".x", d.x), (".y", d.y)]
            };
        }
        if let Some(Translational { p, q, axis, angle }) = &Translational::of(joint) {
            return vec![
                (".normal", self.by_axis(p, q, axis, i).y),
                (".angle", turn(&p.body, &q.body) - self.formula(angle, i)),
            ];
        }
        if let Some(Fixed { p, q, angle }) = &Fixed::of(joint) {
            return {
                let d = self.point(q, i) - self.point(p, i);
                vec![(".x", d.x), (".y", d.y), (".angle", turn(&p.body, &q.body) - self.formula(angle, i))]
            };
        }
        if let Some(PointOnLine { p, q, axis, offset }) = &PointOnLine::of(joint) {
            return vec![("", self.by_axis(p, q, axis, i).y - self.formula(offset, i))];
        }
        if let Some(Distance { p, q, length }) = &Distance::of(joint) {
            return vec![("", self.distance(p, q, &length.value, i))];
        }
        if let Some(X { p, value }) = &X::of(joint) {
            return vec![("", self.point(p, i).x - self.formula(value, i))];
        }
        if let Some(Y { p, value }) = &Y::of(joint) {
            return vec![("", self.point(p, i).y - self.formula(value, i))];
        }
        if let Some(Angle { body, value }) = &Angle::of(joint) {
            return vec![("", self.pose(body, i).1 - self.formula(value, i))];
        }
        if let Some(RelativeAngle { a, b, value }) = &RelativeAngle::of(joint) {
            return vec![("", turn(a, b) - self.formula(value, i))];
        }
        if let Some(OnCurve { p, q, curve }) = &OnCurve::of(joint) {
            return {
                let d = self.point(q, i) - self.point(p, i);
                let w = Complex::turn(self.pose(&p.body, i).1).conjugate() * d;
                match curve {
                    Curve::Polar { radius, .. } => {
                        let theta = w.y.atan2(w.x);
                        let radius = self.within(radius, &[(CurveVariable::Theta, theta)], i);
                        vec![("", w.square_of_length().call(Function::Sqrt) - radius)]
                    }
                    Curve::Implicit { value, .. } => {
                        vec![("", self.within(value, &[(CurveVariable::X, w.x), (CurveVariable::Y, w.y)], i))]
                    }
                    Curve::Parametric { x, y, roller, .. } => {
                        assert!(roller.is_none(), "the parallel curve needs a derivative");
                        let c = Complex { x: self.formula(x, i), y: self.formula(y, i) };
                        let gap = d - Complex::turn(self.pose(&p.body, i).1) * c;
                        vec![(".x", gap.x), (".y", gap.y)]
                    }
                }
            };
        }
        if let Some(FlatFollower { p, q, axis, support }) = &FlatFollower::of(joint) {
            return {
                // conj(u) d = u·d + i n·d.
                let lift = self.by_axis(q, p, axis, i).y;
                let v = Complex { x: self.formula(&axis.x, i), y: self.formula(&axis.y, i) };
                let theta = turn(&p.body, &q.body) + v.x.atan2(-v.y);
                vec![("", -lift - self.within(support, &[(CurveVariable::Theta, theta)], i))]
            };
        }
        if let Some(Gear { a, b, radii, carrier, offset }) = &Gear::of(joint) {
            return {
                let arcs =
                    [(a, &radii.i), (b, &radii.j)].map(|(body, r)| self.formula(&r.value, i) * turn(carrier, body));
                vec![("", arcs[0] + arcs[1] - self.formula(offset, i))]
            };
        }
        if let Some(Belt { a, b, radii, carrier, offset }) = &Belt::of(joint) {
            return {
                let arcs =
                    [(a, &radii.i), (b, &radii.j)].map(|(body, r)| self.formula(&r.value, i) * turn(carrier, body));
                vec![("", arcs[0] - arcs[1] - self.formula(offset, i))]
            };
        }
        if let Some(RackPinion { p, q, axis, pinion, radius, offset }) = &RackPinion::of(joint) {
            return {
                let arc = self.formula(&radius.value, i) * turn(&p.body, pinion);
                vec![("", self.by_axis(p, q, axis, i).x - arc - self.formula(offset, i))]
            };
        }
        if let Some(RollingOnLine { p, q, axis, radius, offset }) = &RollingOnLine::of(joint) {
            return {
                let (d, r) = (self.by_axis(p, q, axis, i), self.formula(&radius.value, i));
                let arc = r * turn(&p.body, &q.body);
                vec![(".normal", d.y - r), (".roll", d.x + arc - self.formula(offset, i))]
            };
        }
        if let Some(RollingOnDisc { p, q, radii, along, offset }) = &RollingOnDisc::of(joint) {
            return {
                let psi = self.formula(&Formula::Scalar(*along), i);
                let [ri, rj] = [&radii.i, &radii.j].map(|r| self.formula(&r.value, i));
                let centres = Complex::turn(psi) * Complex { x: ri + rj, y: S::real(0.0) };
                let gap = self.point(q, i) - self.point(p, i) - centres;
                let rolled = ri * (self.pose(&p.body, i).1 - psi) + rj * (self.pose(&q.body, i).1 - psi);
                vec![(".x", gap.x), (".y", gap.y), (".roll", rolled - self.formula(offset, i))]
            };
        }
        if let Some(Driver { left: Formula::Distance(p, q), right }) = &Driver::of(joint) {
            return vec![("", self.distance(p, q, &right.value, i))];
        }
        if let Some(Constraint { left, right }) = &Constraint::of(joint) {
            return vec![("", self.formula(left, i) - self.formula(right, i))];
        }
        if let Some(Driver { left, right }) = &Driver::of(joint) {
            return vec![("", self.formula(left, i) - self.formula(&right.value, i))];
        }
        if let Some(Screw { p, q, axis, lead, nut, offset }) = &Screw::of(joint) {
            let turns = turn(&p.body, nut) * S::real(1.0 / core::f64::consts::TAU);
            let stroke = self.by_axis(p, q, axis, i).x;
            return vec![("", stroke - self.formula(&lead.value, i) * turns - self.formula(offset, i))];
        }
        if let Some(Rope { points, length }) = &Rope::of(joint) {
            let parts = points.windows(2).map(|ends| self.point(&ends[1], i) - self.point(&ends[0], i));
            let lengths = parts.map(|d| d.square_of_length().call(Function::Sqrt));
            let whole = lengths.fold(S::real(0.0), |sum, length| sum + length);
            return vec![("", whole - self.formula(&length.value, i))];
        }
        panic!(
            "this kind has no rows here: add them, or, if they are of velocity level, do not draw the kind at random"
        )
    }

    /// A formula of a curve whose variables have these values.
    fn within(&self, formula: &Formula, values: &[(CurveVariable, S)], i: i64) -> S {
        let mut variables = [None; 3];
        values.iter().for_each(|(variable, value)| variables[*variable as usize] = Some(*value));
        self.variables.set(variables);
        self.formula(formula, i)
    }

    fn distance(&self, p: &Place, q: &Place, length: &Formula, i: i64) -> S {
        let length = self.formula(length, i);
        (self.point(q, i) - self.point(p, i)).square_of_length() - length * length
    }
}

/// The indices of a repeated thing; a single thing is its own only member.
pub fn members(range: Option<Range>) -> std::ops::Range<i64> {
    range.map_or(0..1, |range| range.start..range.end)
}
