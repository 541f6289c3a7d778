//! Where the units of a mechanism do not agree.

use super::{Unit, near, parse};
use crate::error::{ModelError, Origin};
use crate::mechanism::check::order_of_defines;
use crate::mechanism::{
    Axis, BodyOrigin, Component, Curve, Formula, Function, GuessTarget, Joint, JointKind, Mechanism, Place,
};

/// What is known of a quantity.
#[derive(Clone, Copy, Debug)]
enum Quantity {
    /// Anything.
    Any,
    /// A plain number, of whatever unit is wanted.
    Plain,
    /// Of this unit.
    Of(Unit),
}

use Quantity::{Any, Of, Plain};

/// Every place where quantities of different units are added, compared or equated. The mechanism is sound: indices
/// exist and defines end somewhere.
pub fn check(mechanism: &Mechanism) -> Vec<ModelError> {
    let units: Vec<Option<Unit>> =
        mechanism.parameters.iter().map(|p| p.unit.as_deref().and_then(|unit| parse(unit).ok())).collect();
    let first = |kind: usize| (mechanism.parameters.iter()).find_map(|p| base(p.unit.as_deref()?, kind));
    let mut checker = Checker {
        mechanism,
        units,
        length: Unit { powers: [1.0, 0.0, 0.0], scale: first(0) },
        time: Unit { powers: [0.0, 1.0, 0.0], scale: Some(first(1).unwrap_or(1.0)) },
        defines: vec![None; mechanism.defines.len()],
        at: Origin::default(),
        errors: Vec::new(),
    };
    checker.mechanism();
    let mut errors = checker.errors;
    errors.sort_by_key(|error| error.origin);
    errors.dedup_by_key(|error| error.origin);
    errors
}

/// The scale of the first symbol of a length (0) or time (1) in a unit, as in `mm/s`.
fn base(unit: &str, kind: usize) -> Option<f64> {
    let symbols = unit.split(|c: char| !c.is_alphabetic());
    let mut bases = symbols.filter_map(|symbol| parse(symbol).ok()).filter(|unit| near(unit.powers[kind], 1.0));
    bases.find(|unit| unit.powers.iter().sum::<f64>() == 1.0).and_then(|unit| unit.scale)
}

struct Checker<'m> {
    mechanism: &'m Mechanism,
    /// Of the parameters, where they have one.
    units: Vec<Option<Unit>>,
    /// Of positions.
    length: Unit,
    /// Of t.
    time: Unit,
    /// Of the defines that have been looked at.
    defines: Vec<Option<Quantity>>,
    /// Where the formula at hand stands.
    at: Origin,
    errors: Vec<ModelError>,
}

impl Checker<'_> {
    fn mechanism(&mut self) {
        let m = self.mechanism;
        // What others use comes first: a long chain of defines must not become deep recursion.
        for k in order_of_defines(m).order {
            self.define(k);
        }
        for body in &m.bodies {
            match &body.origin_at {
                BodyOrigin::Carried(place) => self.place(place),
                BodyOrigin::Free { x, y } => {
                    for value in [x, y].into_iter().flatten() {
                        self.expect(value, self.length, body.origin);
                    }
                }
            }
            if let Some(phi) = &body.phi {
                self.expect(phi, Unit::NUMBER, body.origin);
            }
        }
        m.points.iter().for_each(|point| self.place(&point.place));
        m.joints.iter().for_each(|joint| self.joint(joint));
        for condition in &m.conditions {
            self.at = condition.origin;
            self.same(&condition.left, &condition.right);
        }
        for guess in &m.guesses {
            match guess.target {
                GuessTarget::Pose(_, Component::Phi) => self.expect(&guess.value, Unit::NUMBER, guess.origin),
                GuessTarget::Pose(..) => self.expect(&guess.value, self.length, guess.origin),
                GuessTarget::Scalar(_) => {
                    self.at = guess.origin;
                    self.quantity(&guess.value);
                }
            }
        }
    }

    fn joint(&mut self, joint: &Joint) {
        use JointKind as Kind;
        let (length, angle, at) = (self.length, Unit::NUMBER, joint.origin);
        match &joint.kind {
            Kind::Revolute { p, q } => self.places([p, q]),
            Kind::Translational { p, q, axis, angle: value } => {
                self.places([p, q]);
                self.axis(axis);
                self.expect(value, angle, at);
            }
            Kind::Fixed { p, q, angle: value } => {
                self.places([p, q]);
                self.expect(value, angle, at);
            }
            Kind::PointOnLine { p, q, axis, offset } => {
                self.places([p, q]);
                self.axis(axis);
                self.expect(offset, length, at);
            }
            Kind::Distance { p, q, length: value, length_origin } => {
                self.places([p, q]);
                self.expect(value, length, *length_origin);
            }
            Kind::Coordinate { p, value, .. } => {
                self.place(p);
                self.expect(value, length, at);
            }
            Kind::Angle { value, .. } | Kind::RelativeAngle { value, .. } => self.expect(value, angle, at),
            Kind::OnCurve { p, q, curve } => {
                self.places([p, q]);
                self.curve(curve);
            }
            Kind::FlatFollower { p, q, axis, support } => {
                self.places([p, q]);
                self.axis(axis);
                self.expect(support, length, at);
            }
            // Numbers of teeth do as well as radii.
            Kind::Gear { radii, offset, .. } | Kind::Belt { radii, offset, .. } => {
                self.at = radii.j.origin;
                // The unit that both agree on; where they do not, the offset goes by the first.
                let agreed = match self.same(&radii.i.value, &radii.j.value) {
                    Of(unit) => Of(unit),
                    _ => self.quantity(&radii.i.value),
                };
                if let Of(unit) = agreed {
                    if unit != Unit::NUMBER {
                        self.expect(&radii.i.value, length, radii.i.origin);
                        self.expect(&radii.j.value, length, radii.j.origin);
                    }
                    self.expect(offset, unit, at);
                }
            }
            Kind::RackPinion { p, q, axis, radius, offset, .. }
            | Kind::RollingOnLine { p, q, axis, radius, offset } => {
                self.places([p, q]);
                self.axis(axis);
                self.expect(&radius.value, length, radius.origin);
                self.expect(offset, length, at);
            }
            Kind::RollingOnDisc { p, q, radii, offset, .. } => {
                self.places([p, q]);
                self.expect(&radii.i.value, length, radii.i.origin);
                self.expect(&radii.j.value, length, radii.j.origin);
                self.expect(offset, length, at);
            }
            Kind::KnifeEdge { p, angle: value } => {
                self.place(p);
                self.expect(value, angle, at);
            }
            Kind::Speed { p, angle: direction, value } => {
                self.place(p);
                self.expect(direction, angle, at);
                self.expect(value, length.times(self.time.power(-1.0)), at);
            }
            Kind::Constraint { left, right }
            | Kind::Nonholonomic { left, right }
            | Kind::Driver { left, right, .. } => {
                self.at = at;
                self.same(left, right);
            }
        }
    }

    fn places(&mut self, places: [&Place; 2]) {
        places.into_iter().for_each(|place| self.place(place));
    }

    fn place(&mut self, place: &Place) {
        for value in [&place.x, &place.y] {
            self.expect(value, self.length, place.origin);
        }
    }

    fn axis(&mut self, axis: &Axis) {
        self.at = axis.origin;
        self.same(&axis.x, &axis.y);
    }

    fn curve(&mut self, curve: &Curve) {
        match curve {
            Curve::Polar { radius, origin } => self.expect(radius, self.length, *origin),
            Curve::Implicit { value, origin } => {
                self.at = *origin;
                self.quantity(value);
            }
            Curve::Parametric { x, y, roller, origin, .. } => {
                for value in [x, y].into_iter().chain(roller) {
                    self.expect(value, self.length, *origin);
                }
            }
        }
    }

    /// `formula` is in `unit`; `at` is where it stands when none of its names does.
    fn expect(&mut self, formula: &Formula, unit: Unit, at: Origin) {
        self.at = at;
        if let Of(found) = self.quantity(formula)
            && !found.agrees(unit)
        {
            let wanted = match unit.scale {
                None => "a length".to_owned(),
                Some(_) if unit.is_number() => "an angle in rad".to_owned(),
                Some(_) => unit.to_string(),
            };
            let message = format!("the units do not agree: this is {found}, and {wanted} is wanted");
            self.errors.push(ModelError::new(first_origin(formula).unwrap_or(at), message));
        }
    }

    /// Both are in one unit, which they give; the second is to blame, if it has a name.
    fn same(&mut self, a: &Formula, b: &Formula) -> Quantity {
        let (left, right) = (self.quantity(a), self.quantity(b));
        match (left, right) {
            (Of(one), Of(other)) if !one.agrees(other) => {
                let (this, that, origin) = match (first_origin(a), first_origin(b)) {
                    (_, Some(origin)) => (other, one, origin),
                    (Some(origin), None) => (one, other, origin),
                    (None, None) => (other, one, self.at),
                };
                let message = format!("the units do not agree: this is {this}, and what it meets is {that}");
                self.errors.push(ModelError::new(origin, message));
                // Said once.
                Any
            }
            (Of(one), Of(other)) => Of(if one.scale.is_some() { one } else { other }),
            (Of(unit), _) | (_, Of(unit)) => Of(unit),
            (Any, _) | (_, Any) => Any,
            (Plain, Plain) => Plain,
        }
    }

    fn define(&mut self, k: usize) -> Quantity {
        if let Some(known) = self.defines.get(k).copied().flatten() {
            return known;
        }
        let Some(define) = self.mechanism.defines.get(k) else { return Any };
        let before = std::mem::replace(&mut self.at, define.origin);
        let quantity = self.quantity(&define.formula);
        self.at = before;
        self.defines[k] = Some(quantity);
        quantity
    }

    fn quantity(&mut self, formula: &Formula) -> Quantity {
        match formula {
            Formula::Number(_) | Formula::Pi | Formula::Index(_) => Plain,
            Formula::Time => Of(self.time),
            Formula::Parameter(member) => self.units.get(member.family).copied().flatten().map_or(Any, Of),
            Formula::Input(_) | Formula::Scalar(_) => Any,
            Formula::Pose(_, Component::Phi) => Of(Unit::NUMBER),
            Formula::Pose(..) => Of(self.length),
            Formula::PointCoordinate(place, _) => {
                self.place(place);
                Of(self.length)
            }
            Formula::Distance(p, q) => {
                self.places([p, q]);
                Of(self.length)
            }
            Formula::Define(member) => self.define(member.family),
            Formula::Curve(crate::mechanism::CurveVariable::Theta) => Of(Unit::NUMBER),
            Formula::Curve(_) => Of(self.length),
            Formula::Neg(a) => self.quantity(a),
            Formula::Add(a, b) | Formula::Sub(a, b) => self.same(a, b),
            Formula::Mul(a, b) => {
                let (left, right) = (self.quantity(a), self.quantity(b));
                product([(left, a), (right, b)])
            }
            Formula::Div(a, b, _) => {
                let (left, right) = (self.quantity(a), self.quantity(b));
                let inverse = match right {
                    Of(unit) => Of(unit.power(-1.0)),
                    other => other,
                };
                product([(left, a), (inverse, b)])
            }
            Formula::Pow(a, n) => match self.quantity(a) {
                Of(unit) => Of(unit.power(*n)),
                other => other,
            },
            Formula::Call(function, a) => self.call(*function, a),
            Formula::Atan2(y, x) => {
                self.same(y, x);
                Of(Unit::NUMBER)
            }
            Formula::Supplied(_, a) => {
                self.quantity(a);
                Any
            }
            Formula::Dot(a, _) => match self.quantity(a) {
                Of(unit) => Of(unit.times(self.time.power(-1.0))),
                other => other,
            },
        }
    }

    fn call(&mut self, function: Function, a: &Formula) -> Quantity {
        match function {
            Function::Abs => self.quantity(a),
            Function::Sqrt => match self.quantity(a) {
                Of(unit) => Of(unit.power(0.5)),
                other => other,
            },
            _ => {
                if let Of(unit) = self.quantity(a)
                    && !unit.agrees(Unit::NUMBER)
                {
                    let name = function.name();
                    let message = format!("the units do not agree: this is {unit}, and `{name}` takes a number or rad");
                    self.errors.push(ModelError::new(first_origin(a).unwrap_or(self.at), message));
                }
                // A number of a number is as free as that.
                if a.literal().is_some() { Plain } else { Of(Unit::NUMBER) }
            }
        }
    }
}

/// A product: a plain number keeps what it multiplies, but a conversion opens its scale; times a number it is as free as
/// before, and times time it may be a rate, so that nothing is known.
fn product(factors: [(Quantity, &Formula); 2]) -> Quantity {
    match factors.map(|(quantity, _)| quantity) {
        [Of(a), Of(b)] => Of(a.times(b)),
        [Any, _] | [_, Any] => Any,
        [Plain, Plain] => Plain,
        [Plain, Of(unit)] | [Of(unit), Plain] => {
            let plain = factors.iter().find(|(quantity, _)| matches!(quantity, Plain)).map(|(_, formula)| *formula);
            if unit.is_time() {
                Any
            } else if unit.agrees(Unit::NUMBER) {
                Plain
            } else if plain.is_some_and(converts) {
                Of(Unit { scale: None, ..unit })
            } else {
                Of(unit)
            }
        }
    }
}

/// True for a number with a factor of a conversion in it.
fn converts(formula: &Formula) -> bool {
    const FACTORS: [f64; 8] = [12.0, 25.4, 2.54, 30.0, 60.0, 180.0, 360.0, 3600.0];
    match formula {
        Formula::Number(v) => {
            let large = if *v < 1.0 { 1.0 / v } else { *v };
            let is_ten = large > 1.5 && near(large.log10(), large.log10().round());
            is_ten || FACTORS.iter().any(|factor| near(*factor, large)) || near(0.3048, *v)
        }
        Formula::Neg(a) | Formula::Pow(a, _) => converts(a),
        Formula::Mul(a, b) | Formula::Div(a, b, _) => converts(a) || converts(b),
        _ => false,
    }
}

/// The first name in a formula.
fn first_origin(formula: &Formula) -> Option<Origin> {
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Time | Formula::Index(_) | Formula::Curve(_) => None,
        Formula::Parameter(member) | Formula::Input(member) | Formula::Scalar(member) | Formula::Define(member) => {
            Some(member.origin)
        }
        Formula::Pose(body, _) => Some(body.origin()),
        Formula::PointCoordinate(place, _) => Some(place.origin),
        Formula::Distance(p, _) => Some(p.origin),
        Formula::Neg(a) | Formula::Pow(a, _) | Formula::Call(_, a) => first_origin(a),
        Formula::Add(a, b) | Formula::Sub(a, b) | Formula::Mul(a, b) | Formula::Div(a, b, _) | Formula::Atan2(a, b) => {
            first_origin(a).or_else(|| first_origin(b))
        }
        Formula::Supplied(member, _) => Some(member.origin),
        Formula::Dot(_, origin) => Some(*origin),
    }
}
