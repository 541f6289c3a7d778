//! Random mechanisms from a seed, in the whole vocabulary.

use super::*;
use kin_core::joints::{
    Angle, Belt, Constraint, Distance, Fixed, FlatFollower, Gear, OnCurve, PointOnLine, RackPinion, RelativeAngle,
    Revolute, RollingOnDisc, RollingOnLine, Rope, Screw, Translational, X, Y,
};
use kin_core::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Component, Condition, Curve, CurveVariable, Define, Formula, Function, Input,
    Mechanism, NamedPoint, Operands, Place, Radii, Range, Relation, Scalar, Statement, SuppliedFunction, Value,
};

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }
}

/// Number of elements of the arrays `link`, `arm`, `l`.
const LEN: i64 = 4;
/// Single bodies after the two families.
const SINGLE: usize = 4;
/// Scalar parameters before the array.
const PLAIN: usize = 4;

/// What a formula may hold.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Holds {
    Parameters,
    Time,
    Everything,
}

struct Builder {
    random: Random,
    /// Place in the mechanism of every family of bodies: `link`, `arm`, and the single ones.
    position: Vec<usize>,
    /// The range that is being described; its indices are non-negative.
    range: Option<Range>,
    /// Defines that may be used.
    defines: usize,
    /// The variables of the curve that is being described.
    variables: Vec<Formula>,
}

/// A mechanism with held and carried origins several levels deep, families, points, defines and all joints.
pub fn mechanism(seed: u64) -> Mechanism {
    let mut random = Random(seed);
    let mut position: Vec<usize> = (0..2 + SINGLE).collect();
    for k in (1..position.len()).rev() {
        position.swap(k, random.below(k + 1));
    }
    let mut builder = Builder { random, position, range: None, defines: 0, variables: Vec::new() };
    let mut bodies: Vec<(usize, Body)> = (0..2 + SINGLE).map(|k| (builder.position[k], builder.body(k))).collect();
    bodies.sort_by_key(|(position, _)| *position);
    let plain = ["p0", "p1", "p2", "p3"].map(|name| (name, None));
    let ranged = Some(Range { start: 0, end: 3 });
    let mut out = Mechanism {
        name: "Random".into(),
        parameters: parameters(&[&plain[..], &[("l", Some(LEN as usize))]].concat()),
        functions: vec![SuppliedFunction { name: "f".into(), len: None, origin: AT }],
        inputs: ["u", "v"]
            .map(|name| Input { name: name.into(), len: None, origin: AT, unit: None, default: None })
            .to_vec(),
        bodies: bodies.into_iter().map(|(_, body)| body).collect(),
        scalars: vec![
            Scalar { name: "s".into(), len: None, origin: AT, unit: None },
            Scalar { name: "w".into(), len: Some(3), origin: AT, unit: None },
        ],
        ..Mechanism::default()
    };
    for (k, range) in [ranged, None, ranged].into_iter().enumerate() {
        builder.range = range;
        let formula = builder.formula(Holds::Everything, 2);
        out.defines.push(Define { name: format!("d{k}"), range, formula, origin: AT, unit: None });
        builder.defines += 1;
        let place = builder.place();
        out.points.push(NamedPoint { name: format!("P{k}"), range, place, origin: AT });
    }
    for k in 0..8 {
        builder.range = match builder.random.below(4) {
            0 => ranged,
            1 => Some(Range { start: 1, end: 3 }),
            _ => None,
        };
        let (name, range) = (format!("N{k}"), builder.range);
        let kind = builder.joint();
        out.joints.push(Statement { range, ..joint(&name, kind) });
    }
    for (k, relation) in [Relation::Greater, Relation::Less].into_iter().enumerate() {
        builder.range = if builder.random.chance(50) { ranged } else { None };
        let (left, right) = (builder.formula(Holds::Everything, 2), builder.formula(Holds::Everything, 1));
        // A condition that comes to parameters alone is an error.
        let left = add(left, mul(Formula::Number(0.37), Formula::Scalar(member(0, index(0, 0)))));
        let (name, range) = (format!("C{k}"), builder.range);
        out.conditions.push(Condition {
            name,
            range,
            text: String::new(),
            left,
            relation,
            right,
            keyword: AT,
            origin: AT,
        });
    }
    out
}

impl Builder {
    /// Bodies are carried by earlier ones (before the families are shuffled), so there is no circle.
    fn body(&mut self, k: usize) -> Body {
        let (name, len) = match k {
            0 => ("link".to_owned(), Some(LEN as usize)),
            1 => ("arm".to_owned(), Some(LEN as usize)),
            _ => (format!("b{}", k - 2), None),
        };
        self.range = len.map(|len| Range { start: 0, end: len as i64 });
        let mut held = |percent: usize| {
            let is_held = self.random.chance(percent);
            is_held.then(|| self.formula(Holds::Time, 1))
        };
        let phi = held(20);
        let origin_at = match (held(25), held(25)) {
            (x, y) if k == 0 => BodyOrigin::Free { x, y },
            (x, y) if self.random.chance(35) => BodyOrigin::Free { x, y },
            _ => {
                let by = self.random.below(k);
                let body = self.body_in(by);
                BodyOrigin::Carried(self.place_on(body))
            }
        };
        Body { name, len, origin_at, phi, origin: AT }
    }

    /// An index into something of `len` elements.
    fn index(&mut self, len: i64) -> (i64, i64) {
        let constant = (0, self.random.below(len as usize) as i64);
        let Some(range) = self.range else { return constant };
        let last = range.end - 1;
        let choices = [constant, (1, 0), (1, len - 1 - last), (-1, last), (-1, len - 1), (1, -range.start)];
        self.random.pick(&choices)
    }

    fn body_in(&mut self, k: usize) -> BodyRef {
        let (scale, offset) = if k < 2 { self.index(LEN) } else { (0, 0) };
        body_of(self.position[k], scale, offset)
    }

    fn any_body(&mut self) -> BodyRef {
        match self.random.below(3 + SINGLE) {
            0 => GROUND,
            k => self.body_in(k - 1),
        }
    }

    fn place(&mut self) -> Place {
        let body = self.any_body();
        self.place_on(body)
    }

    fn place_on(&mut self, body: BodyRef) -> Place {
        let (x, y) = (self.length(), self.length());
        on(body, x, y)
    }

    fn length(&mut self) -> Formula {
        if self.random.chance(40) { Formula::ZERO } else { self.formula(Holds::Parameters, 1) }
    }

    fn axis(&mut self) -> Axis {
        let (p, l) = (self.parameter(), self.parameter());
        match self.random.below(6) {
            0 => axis(number(1.0), Formula::ZERO),
            1 => axis(Formula::ZERO, number(-2.0)),
            2 => axis(number(-3.0), number(4.0)),
            3 => axis(p, Formula::ZERO),
            4 => axis(Formula::ZERO, neg(p)),
            _ => axis(p, neg(l)),
        }
    }

    fn parameter(&mut self) -> Formula {
        if self.random.chance(50) {
            return parameter(self.random.below(PLAIN));
        }
        let (scale, offset) = self.index(LEN);
        element(PLAIN, scale, offset)
    }

    fn leaf(&mut self, holds: Holds) -> Formula {
        if holds == Holds::Time && !self.variables.is_empty() && self.random.chance(50) {
            return self.random.pick(&self.variables.clone());
        }
        match (holds, self.random.below(10)) {
            (_, 0) => number(self.random.pick(&[0.0, 1.0, -1.0, 2.0, 0.5, -0.7, 3.0])),
            (_, 1) => Formula::Pi,
            (Holds::Parameters, _) | (_, 2 | 3) => self.parameter(),
            (_, 4) => Formula::Time,
            (Holds::Time, _) | (_, 5) => Formula::Input(member(self.random.below(2), index(0, 0))),
            (_, 6) => {
                if self.random.chance(40) {
                    return Formula::Scalar(member(0, index(0, 0)));
                }
                let (scale, offset) = self.small_index();
                Formula::Scalar(member(1, index(scale, offset)))
            }
            (_, 7) if self.defines > 0 => {
                let k = self.random.below(self.defines);
                let (scale, offset) = if k == 1 { (0, 0) } else { self.small_index() };
                Formula::Define(member(k, index(scale, offset)))
            }
            (_, 8) => {
                let place = self.place();
                Formula::PointCoordinate(Box::new(place), self.random.pick(&[Component::X, Component::Y]))
            }
            _ => Formula::Pose(self.any_body(), self.random.pick(&Component::ALL)),
        }
    }

    /// An index into something of three elements.
    fn small_index(&mut self) -> (i64, i64) {
        let constant = (0, self.random.below(3) as i64);
        match self.range {
            Some(range) if range.end == 3 => self.random.pick(&[constant, (1, 0), (-1, 2)]),
            _ => constant,
        }
    }

    fn formula(&mut self, holds: Holds, depth: usize) -> Formula {
        if depth == 0 || self.random.chance(30) {
            return self.leaf(holds);
        }
        if holds == Holds::Everything && self.random.chance(12) {
            let (p, q) = (self.place(), self.place());
            return Formula::Distance(Box::new(p), Box::new(q));
        }
        let a = self.formula(holds, depth - 1);
        let choice = self.random.below(11);
        let mut b = || self.formula(holds, depth - 1);
        match choice {
            0 => neg(a),
            1 | 2 => add(a, b()),
            3 | 4 => sub(a, b()),
            5 | 6 => mul(a, b()),
            7 => div(a, self.parameter()),
            8 => Formula::Pow(Box::new(a), self.random.pick(&[2.0, 3.0, -1.0, 1.5, 0.5])),
            9 => {
                let functions =
                    [Function::Sin, Function::Cos, Function::Tan, Function::Atan, Function::Exp, Function::Abs];
                Formula::Call(self.random.pick(&functions), Box::new(a))
            }
            _ if holds == Holds::Everything => match self.random.below(2) {
                0 => Formula::Atan2(Box::new(a), Box::new(self.formula(holds, depth - 1))),
                _ => Formula::Supplied(member(0, index(0, 0)), Box::new(a)),
            },
            _ => half(a),
        }
    }

    /// A formula of parameters, t, inputs and the variables of a curve.
    fn on_curve(&mut self, variables: &[Formula]) -> Formula {
        self.variables = variables.to_vec();
        let formula = self.formula(Holds::Time, 2);
        self.variables.clear();
        formula
    }

    /// A radius that comes to 0 is an error; its sign is either.
    fn radius(&mut self) -> Value {
        let value = positive(self.formula(Holds::Parameters, 1));
        let value = if self.random.below(3) == 0 { Formula::Neg(Box::new(value)) } else { value };
        Value { value, origin: AT }
    }

    fn radii(&mut self) -> Radii {
        Radii { i: self.radius(), j: self.radius(), origin: AT }
    }

    fn joint(&mut self) -> Operands {
        let (p, q) = (self.place(), self.place());
        let choice = self.random.below(22);
        let mut value = || self.formula(Holds::Time, 1);
        match choice {
            15 | 16 => {
                let (a, b, offset) = (p.body, q.body, value());
                let (radii, carrier) = (self.radii(), self.any_body());
                if choice == 15 {
                    Gear { a, b, radii, carrier, offset }.into()
                } else {
                    Belt { a, b, radii, carrier, offset }.into()
                }
            }
            17 => {
                let (offset, axis, radius) = (value(), self.axis(), self.radius());
                RackPinion { p, q, axis, pinion: self.any_body(), radius, offset }.into()
            }
            18 => RollingOnLine { p, q, offset: value(), axis: self.axis(), radius: self.radius() }.into(),
            19 => {
                let (offset, radii) = (value(), self.radii());
                let (scale, at) = self.small_index();
                RollingOnDisc { p, q, radii, along: member(1, index(scale, at)), offset }.into()
            }
            20 => {
                // Neighbours that coincide are an error.
                let between = Place { x: add(number(0.37), q.x), ..q };
                let length = Value { value: positive(value()), origin: AT };
                Rope { points: vec![p.clone(), between, p], length }.into()
            }
            21 => {
                // A lead that comes to 0 is an error.
                let lead = Value { value: positive(value()), origin: AT };
                let (offset, axis) = (value(), self.axis());
                Screw { p, q, axis, lead, nut: self.any_body(), offset }.into()
            }
            0 | 1 => Revolute { p, q }.into(),
            2 => Translational { p, q, angle: value(), axis: self.axis() }.into(),
            3 => Fixed { p, q, angle: value() }.into(),
            4 => PointOnLine { p, q, offset: value(), axis: self.axis() }.into(),
            // A length that comes to 0 is an error.
            5 => Distance { p, q, length: Value { value: positive(value()), origin: AT } }.into(),
            6 => {
                let value = value();
                match self.random.pick(&[Component::X, Component::Y]) {
                    Component::X => X { p, value }.into(),
                    _ => Y { p, value }.into(),
                }
            }
            7 => Angle { body: p.body, value: value() }.into(),
            8 => RelativeAngle { a: p.body, b: q.body, value: value() }.into(),
            9 => {
                let right = value();
                match self.random.below(3) {
                    0 => driver(Formula::Distance(Box::new(p), Box::new(q)), positive(right)),
                    1 => driver(Formula::Pose(p.body, Component::Phi), right),
                    _ => driver(self.formula(Holds::Everything, 2), right),
                }
            }
            10 => {
                let radius = positive(self.on_curve(&[Formula::Curve(CurveVariable::Theta)]));
                OnCurve { p, q, curve: Curve::Polar { radius, origin: AT } }.into()
            }
            11 => {
                let value = self.on_curve(&[CurveVariable::X, CurveVariable::Y].map(Formula::Curve));
                OnCurve { p, q, curve: Curve::Implicit { value, origin: AT } }.into()
            }
            12 => {
                let (scale, offset) = self.small_index();
                let parameter = member(1, index(scale, offset));
                let [x, y] = [0; 2].map(|_| self.on_curve(&[Formula::Scalar(parameter)]));
                OnCurve { p, q, curve: Curve::Parametric { parameter, x, y, roller: None, origin: AT } }.into()
            }
            13 => {
                let support = self.on_curve(&[Formula::Curve(CurveVariable::Theta)]);
                FlatFollower { p, q, support, axis: self.axis() }.into()
            }
            _ => {
                let (left, right) = (self.formula(Holds::Everything, 3), self.formula(Holds::Everything, 2));
                Constraint { left, right }.into()
            }
        }
    }
}

/// 0.2 + value², which never comes to 0.
fn positive(value: Formula) -> Formula {
    add(Formula::Number(0.2), Formula::Pow(Box::new(value), 2.0))
}
