//! The declarations of a mechanism, each with the range of its index variable.

use crate::error::Origin;
use crate::mechanism::{
    Body, BodyOrigin, BodyRef, Condition, Formula, GuessTarget, Index, Mechanism, Member, Place, Range, Statement,
    nodes,
};

/// The content of one declaration.
#[derive(Debug, Default)]
pub(super) struct Scope<'a> {
    /// The range of the index variable.
    pub(super) range: Option<Range>,
    /// The formulas, including those of points.
    pub(super) formulas: Vec<&'a Formula>,
    /// The bodies that are named outside formulas.
    pub(super) bodies: Vec<BodyRef>,
    /// The scalar coordinates that are named outside formulas.
    pub(super) scalars: Vec<Member>,
}

/// A reference to a member of a family.
#[derive(Debug)]
pub(super) struct Use<'a> {
    pub(super) name: &'a str,
    /// The indices that exist.
    pub(super) members: core::ops::Range<i64>,
    pub(super) index: Index,
    pub(super) origin: Origin,
}

impl Use<'_> {
    /// An end of the range at which the member does not exist, and the invalid index there.
    pub(super) fn outside(&self, range: Option<Range>) -> Option<(i64, i128)> {
        let (first, last) = range.map_or((0, 0), |range| (range.start, range.end.saturating_sub(1)));
        [first, last].into_iter().find_map(|i| {
            let value = i128::from(self.index.scale) * i128::from(i) + i128::from(self.index.offset);
            let exists = (i128::from(self.members.start)..i128::from(self.members.end)).contains(&value);
            (!exists).then_some((i, value))
        })
    }
}

/// All declarations; points and defines come before the declarations that use them.
pub(super) fn scopes(mechanism: &Mechanism) -> Vec<Scope<'_>> {
    let bodies = mechanism.bodies.iter().map(Scope::of_body);
    let points = mechanism.points.iter().map(|point| Scope::new(point.range).place(&point.place));
    let defines = mechanism.defines.iter().map(|define| Scope::new(define.range).formula(&define.formula));
    let joints = mechanism.joints.iter().chain(&mechanism.loads).map(Scope::of_joint);
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

    /// The scope of a body, whose index variable is the number of the member.
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

    /// The scope of a joint, driver or equation.
    pub(super) fn of_joint(joint: &'a Statement) -> Self {
        let mut scope = Self::new(joint.range);
        for (_, operand) in joint.operands.iter() {
            scope.bodies.extend(operand.bodies());
            scope.formulas.extend(operand.formulas());
            scope.scalars.extend(operand.scalar());
        }
        scope
    }

    /// The scope of a unilateral condition.
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

    /// All nodes of all formulas.
    pub(super) fn nodes(&self) -> impl Iterator<Item = &'a Formula> {
        self.formulas.iter().flat_map(|formula| nodes(formula))
    }

    /// All references to members of families.
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
