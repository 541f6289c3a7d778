//! The parts of a mechanism with the range that their indices run over.

use crate::error::Origin;
use crate::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Condition, Curve, Formula, GuessTarget, Index, Joint, JointKind, Mechanism,
    Member, Place, Radii, Range,
};

/// What one declaration is made of.
#[derive(Debug, Default)]
pub(super) struct Scope<'a> {
    /// The range of its index variable.
    pub(super) range: Option<Range>,
    /// Its formulas, those of its points included.
    pub(super) formulas: Vec<&'a Formula>,
    /// The bodies it names outside of formulas.
    pub(super) bodies: Vec<BodyRef>,
    /// Scalar coordinates it names outside of formulas.
    pub(super) scalars: Vec<Member>,
}

/// Use of a member of a family.
#[derive(Debug)]
pub(super) struct Use<'a> {
    pub(super) name: &'a str,
    /// The indices that exist.
    pub(super) members: core::ops::Range<i64>,
    pub(super) index: Index,
    pub(super) origin: Origin,
}

impl Use<'_> {
    /// A step of the range at which the member does not exist, and the index there.
    pub(super) fn outside(&self, range: Option<Range>) -> Option<(i64, i128)> {
        let (first, last) = range.map_or((0, 0), |range| (range.start, range.end.saturating_sub(1)));
        [first, last].into_iter().find_map(|i| {
            let value = i128::from(self.index.scale) * i128::from(i) + i128::from(self.index.offset);
            let exists = (i128::from(self.members.start)..i128::from(self.members.end)).contains(&value);
            (!exists).then_some((i, value))
        })
    }
}

/// Everything that can name something; declarations of points and defines come before their uses.
pub(super) fn scopes(mechanism: &Mechanism) -> Vec<Scope<'_>> {
    let bodies = mechanism.bodies.iter().map(Scope::of_body);
    let points = mechanism.points.iter().map(|point| Scope::new(point.range).place(&point.place));
    let defines = mechanism.defines.iter().map(|define| Scope::new(define.range).formula(&define.formula));
    let joints = mechanism.joints.iter().map(Scope::of_joint);
    let guesses = mechanism.guesses.iter().map(|guess| {
        let scope = Scope::new(guess.range).formula(&guess.value);
        match guess.target {
            GuessTarget::Pose(body, _) => scope.body(body),
            GuessTarget::Scalar(member) => scope.scalar(member),
        }
    });
    let conditions = mechanism.conditions.iter().map(Scope::of_condition);
    points.chain(defines).chain(bodies).chain(joints).chain(conditions).chain(guesses).collect()
}

impl<'a> Scope<'a> {
    fn new(range: Option<Range>) -> Self {
        Self { range, ..Self::default() }
    }

    /// The index variable of a family of bodies is the number of the member.
    fn of_body(body: &'a Body) -> Self {
        let range = body.len.map(|len| Range { start: 0, end: i64::try_from(len).unwrap_or(i64::MAX) });
        let mut scope = Self::new(range);
        scope.formulas.extend(&body.phi);
        match &body.origin_at {
            BodyOrigin::Free { x, y } => scope.formulas.extend(x.iter().chain(y)),
            BodyOrigin::Carried(place) => scope = scope.place(place),
        }
        scope
    }

    /// A joint, driver or equation.
    pub(super) fn of_joint(joint: &'a Joint) -> Self {
        let scope = Self::new(joint.range);
        match &joint.kind {
            JointKind::Revolute { p, q } => scope.place(p).place(q),
            JointKind::Translational { p, q, axis, angle } => scope.place(p).place(q).axis(axis).formula(angle),
            JointKind::Fixed { p, q, angle } => scope.place(p).place(q).formula(angle),
            JointKind::PointOnLine { p, q, axis, offset } => scope.place(p).place(q).axis(axis).formula(offset),
            JointKind::Distance { p, q, length, .. } => scope.place(p).place(q).formula(length),
            JointKind::Coordinate { p, value, .. } => scope.place(p).formula(value),
            JointKind::Angle { body, value } => scope.body(*body).formula(value),
            JointKind::RelativeAngle { a, b, value } => scope.body(*a).body(*b).formula(value),
            JointKind::OnCurve { p, q, curve } => {
                let scope = scope.place(p).place(q);
                let scope = curve.formulas().into_iter().fold(scope, Self::formula);
                match curve {
                    Curve::Parametric { parameter, .. } => scope.scalar(*parameter),
                    Curve::Polar { .. } | Curve::Implicit { .. } => scope,
                }
            }
            JointKind::FlatFollower { p, q, axis, support } => scope.place(p).place(q).axis(axis).formula(support),
            JointKind::KnifeEdge { p, angle } => scope.place(p).formula(angle),
            JointKind::Speed { p, angle, value } => scope.place(p).formula(angle).formula(value),
            JointKind::Constraint { left, right }
            | JointKind::Nonholonomic { left, right }
            | JointKind::Driver { left, right, .. } => scope.formula(left).formula(right),
            JointKind::Gear { a, b, radii, carrier, offset } | JointKind::Belt { a, b, radii, carrier, offset } => {
                scope.body(*a).body(*b).radii(radii).body(*carrier).formula(offset)
            }
            JointKind::RackPinion { p, q, axis, pinion, radius, offset } => {
                scope.place(p).place(q).axis(axis).body(*pinion).formula(&radius.value).formula(offset)
            }
            JointKind::RollingOnLine { p, q, axis, radius, offset } => {
                scope.place(p).place(q).axis(axis).formula(&radius.value).formula(offset)
            }
            JointKind::RollingOnDisc { p, q, radii, along, offset } => {
                scope.place(p).place(q).radii(radii).scalar(*along).formula(offset)
            }
        }
    }

    /// A unilateral condition.
    fn of_condition(condition: &'a Condition) -> Self {
        Self::new(condition.range).formula(&condition.left).formula(&condition.right)
    }

    fn formula(mut self, formula: &'a Formula) -> Self {
        self.formulas.push(formula);
        self
    }

    fn body(mut self, body: BodyRef) -> Self {
        self.bodies.push(body);
        self
    }

    fn scalar(mut self, member: Member) -> Self {
        self.scalars.push(member);
        self
    }

    fn place(self, place: &'a Place) -> Self {
        self.body(place.body).formula(&place.x).formula(&place.y)
    }

    fn axis(self, axis: &'a Axis) -> Self {
        self.formula(&axis.x).formula(&axis.y)
    }

    fn radii(self, radii: &'a Radii) -> Self {
        self.formula(&radii.i.value).formula(&radii.j.value)
    }

    /// Every node of every formula.
    pub(super) fn nodes(&self) -> impl Iterator<Item = &'a Formula> {
        self.formulas.iter().flat_map(|formula| nodes(formula))
    }

    /// Every member of a family that is named.
    pub(super) fn uses<'m>(&self, mechanism: &'m Mechanism) -> Vec<Use<'m>> {
        let bodies = self.bodies.iter().filter_map(|body| body_use(mechanism, *body));
        let scalars = self.scalars.iter().filter_map(|member| scalar_use(mechanism, *member));
        let mut uses: Vec<Use<'m>> = bodies.chain(scalars).collect();
        for node in self.nodes() {
            match node {
                Formula::Parameter(member) => uses.extend(parameter_use(mechanism, *member)),
                Formula::Input(member) => uses.extend(input_use(mechanism, *member)),
                Formula::Scalar(member) => uses.extend(scalar_use(mechanism, *member)),
                Formula::Define(member) => uses.extend(define_use(mechanism, *member)),
                Formula::Supplied(member, _) => uses.extend(function_use(mechanism, *member)),
                Formula::Pose(body, _) => uses.extend(body_use(mechanism, *body)),
                Formula::PointCoordinate(place, _) => uses.extend(body_use(mechanism, place.body)),
                Formula::Distance(p, q) => {
                    uses.extend([p, q].into_iter().filter_map(|place| body_use(mechanism, place.body)));
                }
                _ => {}
            }
        }
        uses
    }
}

/// The formula and everything in it, the coordinates of its points included.
pub(super) fn nodes(formula: &Formula) -> Vec<&Formula> {
    let mut open = vec![formula];
    let mut all = Vec::new();
    while let Some(node) = open.pop() {
        all.push(node);
        match node {
            Formula::Neg(a)
            | Formula::Pow(a, _)
            | Formula::Call(_, a)
            | Formula::Supplied(_, a)
            | Formula::Dot(a, _) => open.push(a),
            Formula::Add(a, b)
            | Formula::Sub(a, b)
            | Formula::Mul(a, b)
            | Formula::Div(a, b, _)
            | Formula::Atan2(a, b) => open.extend([&**a, &**b]),
            Formula::PointCoordinate(place, _) => open.extend([&place.x, &place.y]),
            Formula::Distance(p, q) => open.extend([&p.x, &p.y, &q.x, &q.y]),
            Formula::Number(_)
            | Formula::Pi
            | Formula::Time
            | Formula::Index(_)
            | Formula::Parameter(_)
            | Formula::Input(_)
            | Formula::Pose(..)
            | Formula::Scalar(_)
            | Formula::Curve(_)
            | Formula::Define(_) => {}
        }
    }
    all
}

fn within(len: Option<usize>) -> core::ops::Range<i64> {
    0..len.map_or(1, |len| i64::try_from(len).unwrap_or(i64::MAX))
}

fn body_use(mechanism: &Mechanism, body: BodyRef) -> Option<Use<'_>> {
    let BodyRef::Body { family, index, origin } = body else { return None };
    mechanism.bodies.get(family).map(|body| Use { name: &body.name, members: within(body.len), index, origin })
}

fn scalar_use(mechanism: &Mechanism, member: Member) -> Option<Use<'_>> {
    let Member { family, index, origin } = member;
    mechanism.scalars.get(family).map(|scalar| Use { name: &scalar.name, members: within(scalar.len), index, origin })
}

fn parameter_use(mechanism: &Mechanism, member: Member) -> Option<Use<'_>> {
    let Member { family, index, origin } = member;
    let parameter = mechanism.parameters.get(family)?;
    Some(Use { name: &parameter.name, members: within(parameter.len), index, origin })
}

fn input_use(mechanism: &Mechanism, member: Member) -> Option<Use<'_>> {
    let Member { family, index, origin } = member;
    mechanism.inputs.get(family).map(|input| Use { name: &input.name, members: within(input.len), index, origin })
}

fn function_use(mechanism: &Mechanism, member: Member) -> Option<Use<'_>> {
    let Member { family, index, origin } = member;
    let function = mechanism.functions.get(family)?;
    Some(Use { name: &function.name, members: within(function.len), index, origin })
}

fn define_use(mechanism: &Mechanism, member: Member) -> Option<Use<'_>> {
    let Member { family, index, origin } = member;
    let define = mechanism.defines.get(family)?;
    let members = define.range.map_or(0..1, |range| range.start..range.end);
    Some(Use { name: &define.name, members, index, origin })
}
