//! A mechanism as text, in the user's language: what was understood.

use super::{
    Axis, BodyOrigin, BodyRef, Component, Curve, Formula, GuessTarget, Index, Joint, JointKind, Mechanism, Member,
    Place, Radii,
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
        for joint in &self.joints {
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

    fn joint(&self, joint: &Joint) -> String {
        let range = joint.range.map(|r| format!("[i in {}..{}]", r.start, r.end)).unwrap_or_default();
        let (p, t) = (|place: &Place| self.place(place), |formula: &Formula| self.text(formula));
        let operands = match &joint.kind {
            JointKind::Revolute { p: a, q: b } => format!("{}, {}", p(a), p(b)),
            JointKind::Translational { p: a, q: b, axis, angle } => {
                format!("{}, {}, {}, angle = {}", p(a), p(b), self.axis(axis), t(angle))
            }
            JointKind::Fixed { p: a, q: b, angle } => format!("{}, {}, angle = {}", p(a), p(b), t(angle)),
            JointKind::PointOnLine { p: a, q: b, axis, offset } => {
                format!("{}, {}, {}, offset = {}", p(a), p(b), self.axis(axis), t(offset))
            }
            JointKind::Distance { p: a, q: b, length, .. } => format!("{}, {}, length = {}", p(a), p(b), t(length)),
            JointKind::Coordinate { p: a, value, .. } => format!("{} = {}", p(a), t(value)),
            JointKind::Angle { body, value } => format!("{} = {}", self.body(body), t(value)),
            JointKind::RelativeAngle { a, b, value } => format!("{}, {} = {}", self.body(a), self.body(b), t(value)),
            JointKind::OnCurve { p: a, q: b, curve } => format!("{}, {}, {}", p(a), p(b), self.curve(curve)),
            JointKind::FlatFollower { p: a, q: b, axis, support } => {
                format!("{}, {}, {}, support(theta) = {}", p(a), p(b), self.axis(axis), t(support))
            }
            JointKind::Gear { a, b, radii, carrier, offset } | JointKind::Belt { a, b, radii, carrier, offset } => {
                let [a, b, carrier] = [a, b, carrier].map(|body| self.body(body));
                let (radii, offset) = (self.radii(radii), t(offset));
                format!("{a}, {b}, {radii}, carrier = {carrier}, offset = {offset}")
            }
            JointKind::RackPinion { p: a, q: b, axis, pinion, radius, offset } => {
                let (axis, pinion) = (self.axis(axis), self.body(pinion));
                let (radius, offset) = (t(&radius.value), t(offset));
                format!("{}, {}, {axis}, pinion = {pinion}, radius = {radius}, offset = {offset}", p(a), p(b))
            }
            JointKind::RollingOnLine { p: a, q: b, axis, radius, offset } => {
                let (axis, radius, offset) = (self.axis(axis), t(&radius.value), t(offset));
                format!("{}, {}, {axis}, radius = {radius}, offset = {offset}", p(a), p(b))
            }
            JointKind::RollingOnDisc { p: a, q: b, radii, along, offset } => {
                let along = self.member(self.scalars.get(along.family).map(|s| &s.name), along);
                format!("{}, {}, {}, along = {along}, offset = {}", p(a), p(b), self.radii(radii), t(offset))
            }
            JointKind::KnifeEdge { p: a, angle } => format!("{}, angle = {}", p(a), t(angle)),
            JointKind::Speed { p: a, angle, value } => {
                format!("{}, angle = {}, value = {}", p(a), t(angle), t(value))
            }
            JointKind::Constraint { left, right }
            | JointKind::Nonholonomic { left, right }
            | JointKind::Driver { left, right, .. } => {
                format!("{} = {}", t(left), t(right))
            }
        };
        format!("{} {}{range}: {operands}", joint.kind.keyword(), joint.name)
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
    fn axis(&self, axis: &Axis) -> String {
        format!("axis = ({}, {})", self.text(&axis.x), self.text(&axis.y))
    }

    fn radii(&self, radii: &Radii) -> String {
        format!("radii = ({}, {})", self.text(&radii.i.value), self.text(&radii.j.value))
    }

    /// A formula with every operation in brackets, as it was understood.
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
