//! Prints a mechanism in the user's language, as it was understood.

use super::{
    BodyOrigin, BodyRef, Component, Curve, Formula, GuessTarget, Index, Mechanism, Member, Operand, OperandType, Place,
    Statement, Written,
};
use core::fmt;

impl fmt::Display for Mechanism {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.name)?;
        for parameter in &self.parameters {
            writeln!(f, "  parameter {}{}", parameter.name, length(parameter.len))?;
        }
        for input in &self.inputs {
            writeln!(f, "  input {}{}", input.name, length(input.len))?;
        }
        for body in &self.bodies {
            write!(f, "  body {}{}", body.name, length(body.len))?;
            match &body.origin_at {
                BodyOrigin::Free { x, y } => {
                    for (name, held) in [("x", x), ("y", y)] {
                        if let Some(held) = held {
                            write!(f, ", {name} = {}", self.text(held))?;
                        }
                    }
                }
                BodyOrigin::Carried(place) => write!(f, ", origin = {}", self.place(place))?,
            }
            match &body.phi {
                Some(held) => writeln!(f, ", phi = {}", self.text(held))?,
                None => writeln!(f)?,
            }
        }
        for scalar in &self.scalars {
            writeln!(f, "  coordinate {}{}", scalar.name, length(scalar.len))?;
        }
        for point in &self.points {
            writeln!(f, "  point {} = {}", point.name, self.place(&point.place))?;
        }
        for define in &self.defines {
            writeln!(f, "  define {} = {}", define.name, self.text(&define.formula))?;
        }
        for joint in self.joints.iter().chain(&self.loads) {
            writeln!(f, "  {}", self.joint(joint))?;
        }
        for condition in &self.conditions {
            let range = condition.range.map(|r| format!("[i in {}..{}]", r.start, r.end)).unwrap_or_default();
            let (left, right) = (self.text(&condition.left), self.text(&condition.right));
            writeln!(f, "  unilateral {}{range}: {left} {} {right}", condition.name, condition.relation)?;
        }
        for guess in &self.guesses {
            let target = match &guess.target {
                GuessTarget::Pose(body, component) => format!("{}.{component}", self.body(body)),
                GuessTarget::Scalar(member) => self.member(self.scalars.get(member.family).map(|s| &s.name), member),
            };
            writeln!(f, "  guess {target} = {}", self.text(&guess.value))?;
        }
        Ok(())
    }
}

fn length(len: Option<usize>) -> String {
    len.map(|len| format!("[{len}]")).unwrap_or_default()
}

fn index(index: Index) -> String {
    match (index.scale, index.offset) {
        (0, 0) => String::new(),
        (0, offset) => format!("[{offset}]"),
        (scale, offset) => format!("[{scale}*i{offset:+}]"),
    }
}

impl Mechanism {
    fn member(&self, name: Option<&String>, member: &Member) -> String {
        format!("{}{}", name.map_or("?", String::as_str), index(member.index))
    }

    fn body(&self, body: &BodyRef) -> String {
        match body {
            BodyRef::Ground(_) => "ground".to_owned(),
            BodyRef::Body { family, index: at, .. } => {
                format!("{}{}", self.bodies.get(*family).map_or("?", |b| b.name.as_str()), index(*at))
            }
        }
    }

    fn place(&self, place: &Place) -> String {
        format!("{} @ ({}, {})", self.body(&place.body), self.text(&place.x), self.text(&place.y))
    }

    fn joint(&self, joint: &Statement) -> String {
        let range = joint.range.map(|r| format!("[i in {}..{}]", r.start, r.end)).unwrap_or_default();
        let mut operands = String::new();
        for (k, (slot, operand)) in joint.operands.iter().enumerate() {
            let key = match (slot.written, operand) {
                (Written::Operand, _) | (_, Operand::Curve(_)) => String::new(),
                (Written::Right, _) => " = ".to_owned(),
                (Written::Option, _) if slot.takes == OperandType::Support => format!("{}(theta) = ", slot.key),
                (Written::Option, _) => format!("{} = ", slot.key),
            };
            let comma = if k == 0 || slot.written == Written::Right { "" } else { ", " };
            operands += &format!("{comma}{key}{}", self.operand(operand));
        }
        format!("{} {}{range}: {operands}", joint.operands.keyword(), joint.name)
    }

    fn operand(&self, operand: &Operand) -> String {
        match operand {
            Operand::Point(place) => self.place(place),
            Operand::Points(places) => places.iter().map(|place| self.place(place)).collect::<Vec<_>>().join(", "),
            Operand::Body(body) => self.body(body),
            Operand::Scalar(member) => self.member(self.scalars.get(member.family).map(|s| &s.name), member),
            Operand::Bodies(bodies) => bodies.iter().map(|body| self.body(body)).collect::<Vec<_>>().join(", "),
            Operand::Vector(vector) => format!("({}, {})", self.text(&vector.x), self.text(&vector.y)),
            Operand::Axis(axis) => format!("({}, {})", self.text(&axis.x), self.text(&axis.y)),
            Operand::Value(value) => self.text(&value.value),
            Operand::Radii(radii) => format!("({}, {})", self.text(&radii.i.value), self.text(&radii.j.value)),
            Operand::Curve(curve) => self.curve(curve),
        }
    }

    fn curve(&self, curve: &Curve) -> String {
        match curve {
            Curve::Polar { radius, .. } => format!("polar(theta) = {}", self.text(radius)),
            Curve::Implicit { value, .. } => format!("implicit(X, Y) = {}", self.text(value)),
            Curve::Parametric { parameter, x, y, roller, .. } => {
                let u = self.member(self.scalars.get(parameter.family).map(|s| &s.name), parameter);
                let roller = roller.as_ref().map(|r| format!(", roller = {}", self.text(r))).unwrap_or_default();
                format!("parametric({u}) = ({}, {}){roller}", self.text(x), self.text(y))
            }
        }
    }

    /// A formula with explicit brackets around every operation.
    fn text(&self, formula: &Formula) -> String {
        let binary =
            |a: &Formula, operator: &str, b: &Formula| format!("({} {operator} {})", self.text(a), self.text(b));
        match formula {
            Formula::Number(value) => value.to_string(),
            Formula::Pi => "pi".to_owned(),
            Formula::Time => "t".to_owned(),
            Formula::Index(at) => format!("({}*i{:+})", at.scale, at.offset),
            Formula::Parameter(m) => self.member(self.parameters.get(m.family).map(|p| &p.name), m),
            Formula::Input(m) => self.member(self.inputs.get(m.family).map(|i| &i.name), m),
            Formula::Scalar(m) => self.member(self.scalars.get(m.family).map(|s| &s.name), m),
            Formula::Define(m) => self.member(self.defines.get(m.family).map(|d| &d.name), m),
            Formula::Curve(variable) => variable.name().to_owned(),
            Formula::Pose(body, component) => format!("{}.{component}", self.body(body)),
            Formula::PointCoordinate(place, Component::X) => format!("({}).x", self.place(place)),
            Formula::PointCoordinate(place, _) => format!("({}).y", self.place(place)),
            Formula::Distance(p, q) => format!("distance({}, {})", self.place(p), self.place(q)),
            Formula::Neg(a) => format!("(-{})", self.text(a)),
            Formula::Add(a, b) => binary(a, "+", b),
            Formula::Sub(a, b) => binary(a, "-", b),
            Formula::Mul(a, b) => binary(a, "*", b),
            Formula::Div(a, b, _) => binary(a, "/", b),
            Formula::Pow(a, n) => format!("pow({}, {n})", self.text(a)),
            Formula::Call(function, a) => format!("{}({})", function.name(), self.text(a)),
            Formula::Atan2(y, x) => format!("atan2({}, {})", self.text(y), self.text(x)),
            Formula::Dot(a, _) => format!("dot({})", self.text(a)),
            Formula::Supplied(m, a) => {
                format!("{}({})", self.member(self.functions.get(m.family).map(|f| &f.name), m), self.text(a))
            }
        }
    }
}
