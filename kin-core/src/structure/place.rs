//! Random positions in the plane that satisfy the joints for given rotations.
//!
//! The unknowns are the origins of the bodies and every distinct point of a body; points of a body with equal
//! expressions are one point. For known rotations all conditions imposed here are linear with constant coefficients:
//! points joined by revolute and fixed joints coincide, x and y held at a literal have its value, x and y held at equal
//! expressions are equal, and a point lies on a line of exactly known direction if its offset from the line is 0.
//! Undetermined unknowns are random. The body-fixed coordinates of the points are not needed: Φ_q depends only on the
//! vector from the origin to the point.
//!
//! A point is not forced onto a line that rotates. The distance of the point from the line does not affect the rank of
//! the row of this joint, and the condition could make points coincide that are distinct in general. Without the
//! condition the pose is more general, so a dependency that is found still holds at every pose.

use super::field::{Draw, Residue, fraction};
use super::rank::{Elimination, Row, add_to};
use super::turn::PoseTurns;
use crate::constraint::{ConstraintSet, Frame, JointInstance, RowMeaning};
use crate::expr::{Depends, ExprId, Graph, Node, ROUNDING, Rotation};
use crate::system::KinematicSystem;
use crate::vocabulary::Role;
use std::collections::HashMap;

const KIND_PLACE: u64 = 20;

/// A point of a frame, given by its expressions.
type Key = (Frame, ExprId, ExprId);

/// The unknowns: x of each point has an index, y the following one.
#[derive(Default)]
struct Unknowns {
    points: HashMap<Key, usize>,
    held: HashMap<ExprId, usize>,
    count: usize,
}

/// A linear expression in the unknowns: coefficients and constant.
type Linear = (Vec<(usize, Residue)>, Residue);

impl Unknowns {
    /// The index of x of a body's origin; y follows.
    fn origin(body: usize) -> usize {
        2 * body
    }

    /// x and y of a point; the origin of the ground is known.
    fn point(&mut self, graph: &Graph, key: Key) -> [Linear; 2] {
        let is_origin = graph.is_zero(key.1) && graph.is_zero(key.2);
        let first = match key.0 {
            Frame::Ground if is_origin => return [(Vec::new(), Residue::ZERO), (Vec::new(), Residue::ZERO)],
            Frame::Body(body) if is_origin => Self::origin(body),
            _ => *self.points.entry(key).or_insert_with(|| {
                self.count += 2;
                self.count - 2
            }),
        };
        [first, first + 1].map(|k| (vec![(k, Residue::ONE)], Residue::ZERO))
    }

    /// The value at which a coordinate is held: a literal, or one unknown for all uses of the same expression.
    fn value(&mut self, graph: &Graph, id: ExprId) -> Linear {
        if let Some(value) = graph.literal(id) {
            return (Vec::new(), Residue::number(value));
        }
        let k = *self.held.entry(id).or_insert_with(|| {
            self.count += 1;
            self.count - 1
        });
        (vec![(k, Residue::ONE)], Residue::ZERO)
    }
}

/// The positions of a random pose.
pub(super) struct RandomPositions {
    origins: Vec<[Residue; 2]>,
    points: HashMap<Key, [Residue; 2]>,
    /// The points of each body, by which rotated vectors in expressions are recognised.
    of_body: Vec<Vec<(ExprId, ExprId)>>,
    /// The body whose angle an expression is; `None` if several bodies have it.
    turning: HashMap<ExprId, Option<usize>>,
}

/// A literal direction, if possible as a ratio of small integers; the length of the vector is arbitrary.
pub(super) fn literal_direction(graph: &Graph, [x, y]: [ExprId; 2]) -> Option<[Residue; 2]> {
    let (x, y) = (graph.literal(x)?, graph.literal(y)?);
    let (big, small) = if x.abs() >= y.abs() { (x, y) } else { (y, x) };
    let ratio = match fraction(small / big, ROUNDING) {
        Some((p, q)) => [Residue::integer(q), Residue::integer(p)],
        None => [Residue::number(big), Residue::number(small)],
    };
    // Both forms agree up to sign, which does not affect the rank.
    Some(if x.abs() >= y.abs() { ratio } else { [ratio[1], ratio[0]] })
}

/// The body-fixed expressions of a joint's point.
pub(super) fn local(set: &ConstraintSet, joint: &JointInstance, role: Role) -> Option<Key> {
    let geometry = joint.geometry.iter().find(|geometry| geometry.role == role)?;
    Some((geometry.frame, *set.geometry.get(geometry.offset)?, *set.geometry.get(geometry.offset + 1)?))
}

/// The value of a joint: its length, offset or right-hand side.
fn value(set: &ConstraintSet, joint: &JointInstance) -> Option<ExprId> {
    let geometry = joint.geometry.iter().find(|geometry| geometry.role == Role::Value)?;
    set.geometry.get(geometry.offset).copied()
}

impl RandomPositions {
    /// Draws positions that satisfy the joints.
    pub(super) fn new(system: &KinematicSystem, turns: &PoseTurns, draw: Draw) -> Self {
        let set = &system.set;
        let mut unknowns = Unknowns { count: 2 * set.bodies.len(), ..Unknowns::default() };
        let equations = equations(system, turns, &mut unknowns);
        // The last column is that of the constants.
        let one = unknowns.count;
        let mut elimination = Elimination::new(vec![1; one + 1]);
        for (k, row) in equations.iter().enumerate() {
            // An equation that contradicts earlier ones is ignored; such a mechanism cannot be assembled.
            let _ = elimination.push(k, row, one);
        }
        let x = elimination.solve(|k| draw.residue(KIND_PLACE, k as u64));
        let at = |k: usize| [x[k], x[k + 1]];
        let mut of_body = vec![Vec::new(); set.bodies.len()];
        for &(frame, ex, ey) in unknowns.points.keys() {
            if let Frame::Body(body) = frame {
                of_body[body].push((ex, ey));
            }
        }
        of_body.iter_mut().for_each(|points| points.sort_unstable());
        let mut turning: HashMap<ExprId, Option<usize>> = HashMap::new();
        for (index, body) in set.bodies.iter().enumerate() {
            turning.entry(body.pose[2]).and_modify(|found| *found = None).or_insert(Some(index));
        }
        Self {
            origins: (0..set.bodies.len()).map(|body| at(Unknowns::origin(body))).collect(),
            points: unknowns.points.iter().map(|(key, k)| (*key, at(*k))).collect(),
            of_body,
            turning,
        }
    }

    pub(super) fn origin(&self, body: usize) -> [Residue; 2] {
        self.origins.get(body).copied().unwrap_or_default()
    }

    pub(super) fn point(&self, graph: &Graph, key: Key) -> [Residue; 2] {
        match key.0 {
            Frame::Body(body) if graph.is_zero(key.1) && graph.is_zero(key.2) => self.origin(body),
            _ => self.points.get(&key).copied().unwrap_or_default(),
        }
    }

    /// The rotated vector from the origin of a body to a point with a random position, or the negative of such a
    /// vector.
    pub(super) fn vector(&self, set: &ConstraintSet, r: Rotation) -> Option<[Residue; 2]> {
        let body = (*self.turning.get(&r.angle)?)?;
        let graph = &set.graph;
        let points = self.of_body.get(body)?;
        let origin = self.origin(body);
        let to = |x: ExprId, y: ExprId| {
            let place = self.point(graph, (Frame::Body(body), x, y));
            [place[0] - origin[0], place[1] - origin[1]]
        };
        if points.contains(&(r.x, r.y)) {
            return Some(to(r.x, r.y));
        }
        let opposite = |a: ExprId, b: ExprId| match (graph.literal(a), graph.literal(b)) {
            (Some(a), Some(b)) => a == -b,
            _ => graph.node(a) == Node::Neg(b) || graph.node(b) == Node::Neg(a),
        };
        let (x, y) = points.iter().copied().find(|&(x, y)| opposite(x, r.x) && opposite(y, r.y))?;
        Some(to(x, y).map(|component| -component))
    }
}

/// Σ factor · linear expression as a row, with the constant in the last column.
fn difference(terms: &[(Residue, &Linear)], one: usize) -> Row {
    let mut row = Row::new();
    for (factor, (unknowns, constant)) in terms {
        unknowns.iter().for_each(|(k, c)| add_to(&mut row, *k, *factor * *c));
        add_to(&mut row, one, *factor * *constant);
    }
    row
}

fn equations(system: &KinematicSystem, turns: &PoseTurns, unknowns: &mut Unknowns) -> Vec<Row> {
    let set = &system.set;
    let graph = &set.graph;
    let plus = Residue::ONE;
    let mut pairs: Vec<Vec<(Residue, Linear)>> = Vec::new();
    let equal = |a: Linear, b: Linear| vec![(plus, a), (-plus, b)];
    for (index, body) in set.bodies.iter().enumerate() {
        let origin = [0, 1].map(|c| (vec![(Unknowns::origin(index) + c, plus)], Residue::ZERO));
        match (body.carried_by, body.carried_at) {
            (Some(carrier), Some([x, y])) => {
                let [x, y] = unknowns.point(graph, (carrier, x, y));
                let [own_x, own_y] = origin;
                pairs.push(equal(own_x, x));
                pairs.push(equal(own_y, y));
            }
            _ => {
                for (c, origin) in origin.into_iter().enumerate() {
                    if body.coordinates[c].is_none() {
                        pairs.push(equal(origin, unknowns.value(graph, body.pose[c])));
                    }
                }
            }
        }
    }
    for joint in &set.joints {
        let [p, q] = [Role::P, Role::Q].map(|role| local(set, joint, role).map(|key| unknowns.point(graph, key)));
        let driving = system.classes.get(joint.first_row).is_some_and(|class| class.driving);
        for meaning in set.meanings(joint) {
            match (meaning, &p, &q) {
                (RowMeaning::Coincidence(c), Some(p), Some(q)) => pairs.push(equal(p[c].clone(), q[c].clone())),
                (RowMeaning::Coordinate(c), Some(p), _) if !driving => {
                    let held = value(set, joint).filter(|value| !graph.depends(*value).on(Depends::COORDINATE));
                    if let Some(held) = held {
                        pairs.push(equal(p[c].clone(), unknowns.value(graph, held)));
                    }
                }
                (RowMeaning::AcrossAxis(offset), Some([px, py]), Some([qx, qy])) => {
                    let through = offset.is_none_or(|offset| graph.is_zero(offset));
                    if let Some([ux, uy]) = fixed_direction(set, turns, joint).filter(|_| through) {
                        // The row perp(u)·(r_Q − r_P) = 0.
                        let terms = [(-uy, qx), (uy, px), (ux, qy), (-ux, py)];
                        pairs.push(terms.map(|(factor, coordinate)| (factor, coordinate.clone())).to_vec());
                    }
                }
                _ => {}
            }
        }
    }
    let one = unknowns.count;
    pairs
        .into_iter()
        .map(|terms| {
            let terms: Vec<(Residue, &Linear)> = terms.iter().map(|(factor, linear)| (*factor, linear)).collect();
            difference(&terms, one)
        })
        .collect()
}

/// The direction of a line that is literal and does not rotate.
fn fixed_direction(set: &ConstraintSet, turns: &PoseTurns, joint: &JointInstance) -> Option<[Residue; 2]> {
    let (frame, x, y) = local(set, joint, Role::Axis)?;
    let direction = literal_direction(&set.graph, [x, y])?;
    match frame {
        Frame::Ground => Some(direction),
        Frame::Body(body) => {
            let turn = turns.rotation(&set.graph, set.bodies.get(body)?.pose[2]);
            turn.exact.then(|| turn.apply(direction))
        }
    }
}
