//! Efforts of drivers and reactions of joints, from the multipliers of their rows.
//!
//! A row Φ with its multiplier exerts −λ ∂Φ/∂(x, y, φ) on a body: a force, and a moment about the body's origin. About
//! a point P it is m_P = m − (r_P − r) × f. Force and moment do not depend on the scale and the sign of the row.

use super::equilibrium::{Equilibrium, FreeRow, Hold};
use super::free_bodies::FreeBodies;
use super::load::Wrench;
use crate::constraint::{ConstraintSet, Frame, JointInstance, RowMeaning};
use crate::expr::{ExprId, Graph};
use crate::joints::{Contact, Normal, Reaction, contact_of, reaction_of};
use crate::mechanism::{Component, Function};
use crate::plan::ZeroTest;
use crate::system::KinematicSystem;
use crate::vocabulary::Role;

/// The force or torque of a driver along the quantity that it drives, and the rate of that quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// The name of the driver, or of one of its rows.
    pub name: String,
    /// The index of its first number among the results.
    pub place: usize,
    /// Force or torque, and the rate.
    pub numbers: [ExprId; 2],
}

/// The reaction of a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReactionForce {
    /// The joint's name.
    pub name: String,
    /// The index of its first number among the results.
    pub place: usize,
    /// The rows whose multipliers it depends on; rows of held and carried coordinates come after those of Φ.
    pub rows: Vec<usize>,
    /// The body that force and moment act on.
    pub on: Option<Frame>,
    /// The point at which the force acts, and the force.
    pub force: Option<[[ExprId; 2]; 2]>,
    /// The moment about that point, or the couple.
    pub moment: Option<ExprId>,
    /// Couples on other bodies.
    pub couples: Vec<(Frame, ExprId)>,
    /// −λ of the user's own rows.
    pub generalized: Vec<ExprId>,
    /// For contacts: the normal component of the force, positive if the bodies press on one another.
    pub normal: Option<ExprId>,
    /// For rolling without slipping: the component along the axis of the line, or in the direction of increasing ψ.
    pub tangential: Option<ExprId>,
    /// For ropes: the tension, negative if the rope would have to push.
    pub tension: Option<ExprId>,
}

/// Writes efforts and reactions.
pub(super) struct ReactionWriter<'w, 'm> {
    pub(super) bodies: &'w mut FreeBodies<'m>,
    pub(super) system: &'w KinematicSystem,
    pub(super) equilibrium: &'w Equilibrium,
    /// λ, then the multipliers of held and carried coordinates.
    pub(super) multipliers: Vec<ExprId>,
    pub(super) zero_test: ZeroTest,
}

impl ReactionWriter<'_, '_> {
    fn set(&self) -> &ConstraintSet {
        &self.system.set
    }

    fn row(&self, row: usize) -> &FreeRow {
        let rows = &self.equilibrium.rows;
        rows.get(row).unwrap_or_else(|| &self.equilibrium.holds[row - rows.len()].row)
    }

    /// The wrench of rows on a body, about the origin of the body.
    fn wrench(&mut self, rows: &[usize], frame: Frame) -> Wrench {
        let indices = self.bodies.indices(frame);
        indices.map(|index| {
            let mut sum = self.bodies.a.graph.zero();
            for &row in rows {
                if let Some(&entry) = self.row(row).gradient.get(&index) {
                    let graph = &mut self.bodies.a.graph;
                    let product = graph.mul(self.multipliers[row], entry);
                    sum = graph.sub(sum, product);
                }
            }
            sum
        })
    }

    /// The moment of a wrench about a point; the wrench is about the origin of the body.
    fn about(&mut self, frame: Frame, point: [ExprId; 2], [x, y, moment]: Wrench) -> ExprId {
        let pose = self.bodies.pose(frame);
        let graph = &mut self.bodies.a.graph;
        let arm = [graph.sub(point[0], pose[0]), graph.sub(point[1], pose[1])];
        let turned = graph.plain_cross(arm, [x, y]);
        let moment = graph.sub(moment, turned);
        self.or_zero(moment)
    }

    /// Replaces an expression that is identically zero by the literal 0.
    fn or_zero(&mut self, id: ExprId) -> ExprId {
        let graph = &mut self.bodies.a.graph;
        if self.zero_test.is_zero(graph, id) { graph.zero() } else { id }
    }

    /// The efforts of all drivers, of rows of velocity level that prescribe a speed, and of held coordinates that vary
    /// with time: of all rows that may supply power.
    pub(super) fn efforts(&mut self) -> Vec<Effort> {
        let mut efforts = Vec::new();
        for joint in &self.system.set.joints {
            let rows = joint.first_row..joint.first_row + joint.rows;
            let supplies = |row: &usize| {
                self.system.classes[*row].driving || !self.bodies.a.graph.is_zero(self.row(*row).partial_t)
            };
            let driving: Vec<usize> = rows.filter(supplies).collect();
            for &row in &driving {
                let name = if driving.len() == 1 { &joint.name } else { &self.system.set.rows[row].name };
                let (name, numbers) = (name.clone(), self.effort(row, self.squared_length(joint, row)));
                efforts.push(Effort { name, place: 0, numbers });
            }
        }
        for (k, hold) in self.equilibrium.holds.iter().enumerate() {
            if !self.bodies.a.graph.is_zero(hold.row.partial_t) {
                let name = hold.name(self.bodies, &self.system.set);
                let numbers = self.effort(self.equilibrium.rows.len() + k, None);
                efforts.push(Effort { name, place: 0, numbers });
            }
        }
        efforts
    }

    /// The length ℓ whose square a row of this joint contains, if it contains one.
    fn squared_length(&self, joint: &JointInstance, row: usize) -> Option<ExprId> {
        let is_squared = self.system.set.rows[row].meaning == RowMeaning::SquaredDistance;
        let length = joint.quantities.first().filter(|_| is_squared)?;
        Some(self.system.set.observables[length.observable].value)
    }

    /// −λ and −Φ_t; for a row that contains the square of the length ℓ, −2 ℓ λ and −Φ_t/(2 ℓ).
    fn effort(&mut self, row: usize, length: Option<ExprId>) -> [ExprId; 2] {
        let (lambda, partial_t) = (self.multipliers[row], self.row(row).partial_t);
        let graph = &mut self.bodies.a.graph;
        let (effort, rate) = (graph.neg(lambda), graph.neg(partial_t));
        match length {
            None => [effort, rate],
            Some(length) => {
                let twice = graph.double(length);
                [graph.mul(twice, effort), graph.div(rate, twice)]
            }
        }
    }

    /// The reactions of joints, and those of held and carried coordinates.
    pub(super) fn reactions(&mut self) -> Vec<ReactionForce> {
        let joints = &self.system.set.joints;
        let of_joints: Vec<ReactionForce> = joints.iter().filter_map(|joint| self.reaction(joint)).collect();
        let mut of_holds: Vec<ReactionForce> = Vec::new();
        for (k, hold) in self.equilibrium.holds.iter().enumerate() {
            let (row, name) = (self.equilibrium.rows.len() + k, hold.name(self.bodies, &self.system.set));
            match of_holds.last_mut().filter(|last| last.name == name) {
                Some(last) => last.rows.push(row),
                None => of_holds.push(ReactionForce {
                    name,
                    rows: vec![row],
                    on: Some(Frame::Body(hold.body)),
                    ..ReactionForce::default()
                }),
            }
        }
        for reaction in &mut of_holds {
            self.of_hold(reaction);
        }
        of_joints.into_iter().chain(of_holds).collect()
    }

    fn of_hold(&mut self, reaction: &mut ReactionForce) {
        let Some(frame) = reaction.on else { return };
        let first = reaction.rows[0] - self.equilibrium.rows.len();
        let Hold { component, .. } = self.equilibrium.holds[first];
        let wrench = self.wrench(&reaction.rows, frame);
        if component == Component::Phi {
            reaction.moment = Some(wrench[2]);
        } else {
            let pose = self.bodies.pose(frame);
            reaction.force = Some([[pose[0], pose[1]], [wrench[0], wrench[1]]]);
            reaction.moment = Some(self.bodies.a.graph.zero());
        }
    }

    fn reaction(&mut self, joint: &JointInstance) -> Option<ReactionForce> {
        let rows: Vec<usize> = (joint.first_row..joint.first_row + joint.rows).collect();
        let on = joint.frames[1].or(joint.frames[0]);
        let operands = &self.bodies.a.mechanism.joints.get(joint.family.0)?.operands;
        let kind = match reaction_of(operands) {
            Reaction::Generalized if on.is_some() => Reaction::OnSecond,
            kind => kind,
        };
        let mut reaction = ReactionForce { name: joint.name.clone(), rows, ..ReactionForce::default() };
        match kind {
            Reaction::Generalized if joint.kind.drives() => return None,
            Reaction::Generalized => {
                let graph = &mut self.bodies.a.graph;
                reaction.generalized = reaction.rows.iter().map(|&row| graph.neg(self.multipliers[row])).collect();
            }
            Reaction::Couples => reaction.couples = self.couples(&reaction.rows, None, None),
            Reaction::OnSecond | Reaction::Tension | Reaction::OnSecondAndCouples => {
                let frame = on?;
                reaction.on = on;
                let wrench = self.wrench(&reaction.rows, frame);
                match self.point(joint, frame) {
                    Some(point) => {
                        reaction.force = Some([point, [wrench[0], wrench[1]]]);
                        reaction.moment = Some(self.about(frame, point, wrench));
                        self.touch(joint, frame, [wrench[0], wrench[1]], &mut reaction);
                        if kind == Reaction::OnSecondAndCouples {
                            reaction.couples = self.couples(&reaction.rows, Some(frame), Some(point));
                        }
                    }
                    None => reaction.moment = Some(wrench[2]),
                }
            }
        }
        if kind == Reaction::Tension {
            // What lengthens the rope opposes its tension.
            let [effort, _] = self.effort(joint.first_row, self.squared_length(joint, joint.first_row));
            reaction.tension = Some(self.bodies.a.graph.neg(effort));
        }
        Some(reaction)
    }

    /// The normal and the tangential component of a contact's force on a body.
    fn touch(&mut self, joint: &JointInstance, frame: Frame, force: [ExprId; 2], reaction: &mut ReactionForce) {
        self.bodies.a.index = joint.family.1;
        let mechanism = self.bodies.a.mechanism;
        let Some(family) = mechanism.joints.get(joint.family.0) else { return };
        let Some(Contact { normal, side, sticks }) = contact_of(&mut self.bodies.a, &family.operands) else { return };
        let gradient =
            |row: &FreeRow, graph: &mut Graph, index: u32| row.gradient.get(&index).copied().unwrap_or(graph.zero());
        let [x, y, _] = self.bodies.indices(frame);
        let first = self.row(joint.first_row).clone();
        let second = self.row(joint.first_row + joint.rows.min(2) - 1).clone();
        let graph = &mut self.bodies.a.graph;
        let left = match normal {
            Normal::Gradient | Normal::UnitGradient => [gradient(&first, graph, x), gradient(&first, graph, y)],
            Normal::LeftOf(along) => {
                // The rows contain −A c(u), so their derivative with respect to u is minus the tangent.
                let minus_tangent = [gradient(&first, graph, along), gradient(&second, graph, along)];
                [minus_tangent[1], graph.neg(minus_tangent[0])]
            }
            Normal::Direction(angle) => {
                let unit = [graph.number(1.0), graph.zero()];
                graph.rotate(angle, unit)
            }
        };
        let mut across = graph.plain_dot(left, force);
        if matches!(normal, Normal::Gradient | Normal::LeftOf(_)) {
            let square = graph.plain_dot(left, left);
            let length = graph.call(Function::Sqrt, square);
            across = graph.div(across, length);
        }
        reaction.normal = Some(graph.mul(side, across));
        if sticks {
            // The last row contains the arc R φ of the second body, so −λ of this row is the tangential force on the
            // body at the arm R: along the axis of a line, or against increasing ψ. The total force is not used, since
            // a driver of ψ contributes to it but does not act in the contact.
            let turning = self.multipliers[joint.first_row + joint.rows - 1];
            reaction.tangential =
                Some(if matches!(normal, Normal::Direction(_)) { turning } else { graph.neg(turning) });
        }
    }

    /// The joint's point on a body.
    fn point(&mut self, joint: &JointInstance, frame: Frame) -> Option<[ExprId; 2]> {
        let has = |role: Role| joint.geometry.iter().rev().find(|piece| piece.role == role && piece.frame == frame);
        let piece = has(Role::Q).or_else(|| has(Role::P))?;
        let local = [self.set().geometry[piece.offset], self.set().geometry[piece.offset + 1]];
        let [x, y, angle] = self.bodies.pose(frame);
        let graph = &mut self.bodies.a.graph;
        let rho = graph.rotate(angle, local);
        Some([graph.add(x, rho[0]), graph.add(y, rho[1])])
    }

    /// The couples of rows on all bodies except `but`, about `point` if it is given.
    fn couples(&mut self, rows: &[usize], but: Option<Frame>, point: Option<[ExprId; 2]>) -> Vec<(Frame, ExprId)> {
        let frames = (0..self.set().bodies.len()).map(Frame::Body).chain([Frame::Ground]);
        let frames: Vec<Frame> = frames.filter(|frame| Some(*frame) != but).collect();
        let mut couples = Vec::new();
        for frame in frames {
            let indices = self.bodies.indices(frame);
            let turns = rows.iter().any(|&row| indices.iter().any(|index| self.row(row).gradient.contains_key(index)));
            if turns {
                let wrench = self.wrench(rows, frame);
                let couple = match point {
                    Some(point) => self.about(frame, point, wrench),
                    None => wrench[2],
                };
                couples.push((frame, couple));
            }
        }
        couples
    }
}
