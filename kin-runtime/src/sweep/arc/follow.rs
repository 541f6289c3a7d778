//! The steps along the solution curve, in both directions from a start.

use super::bordered::{ArcNode, Bordered};
use super::places::{between, cusps, singular_place, turnings};
use super::rows;
use crate::arc::{ArcEnd, ArcFault, ArcPlace, ArcPlaceKind, SolutionArc};
use crate::equations::scale::Scale;
use crate::equations::{Equations, contact};
use crate::error::SolveError;
use crate::model::{Component, CoordinateKind, Level};
use crate::nonlinear::root::{Value, bracket};
use crate::state::State;
use crate::workspace::Subset;

/// Length of the first step, on the common scale.
const FIRST: f64 = 0.05;
/// If only steps shorter than this are accepted, the curve ends, or another branch crosses it.
const MIN_STEP: f64 = 1e-7;
/// Relative pivot below which the rows count as dependent where steps become too short.
const CROSSING: f64 = 1e-5;
/// Largest number of steps in one direction.
const MAX_STEPS: usize = 20_000;
/// Cosines of the angle between neighbouring tangents: below the first a step is rejected, above the second the next
/// one is longer.
const COSINES: [f64; 2] = [0.95, 0.99];
/// Largest distance from its origin at which the curve counts as closed, on the common scale.
const CLOSED_DISTANCE: f64 = 1e-7;
/// Smallest cosine of the angle between the directions in which q moves at both ends of a curve that counts as closed.
const SAME_WAY: f64 = 1.0 - 1e-6;
/// The width to which places on the curve are enclosed.
const ENCLOSED: f64 = 1e-12;
/// Smallest share of q in the unit tangent at which the mechanism counts as moving.
const MOVING: f64 = 0.1;

/// The t of the start, and the other end of the interval of t in which the curve is followed, if that is bounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) from: f64,
    pub(crate) to: Option<f64>,
}

/// The curve in one direction from its start.
struct ArcLeg {
    nodes: Vec<ArcNode>,
    places: Vec<ArcPlace>,
    end: ArcEnd,
}

/// States at equal distances on the curve through a configuration of the current instant, and the special places
/// and ends of the curve.
pub(crate) fn solution_arc(
    equations: &mut Equations<'_>,
    q: &[f64],
    window: Window,
    steps: usize,
) -> Result<(Vec<State>, SolutionArc), SolveError> {
    let t = equations.t;
    let refuse = |why| Err(SolveError::NoArc { t, why });
    if equations.model.rows.iter().any(|row| row.level == Level::Velocity) {
        return refuse(ArcFault::VelocityLevel);
    }
    equations.scale = Scale::around(equations, q);
    let bordered = Bordered::new(equations, q)?;
    let z: Vec<f64> = q.iter().copied().chain([t]).collect();
    let mut directions = bordered.directions(equations, &z)?;
    let (Some(mut direction), 0) = (directions.pop(), directions.len()) else {
        return refuse(match directions.len() {
            0 => ArcFault::Fixed,
            others => ArcFault::Directions { count: others + 1 },
        });
    };
    // The driver moves forwards first, or towards the requested end.
    let onwards = if window.to.is_some_and(|to| to < window.from) { -1.0 } else { 1.0 };
    if onwards * direction[q.len()] < 0.0 {
        direction.iter_mut().for_each(|x| *x = -*x);
    }
    let Some(start) = bordered.node(equations, &z, &direction, FIRST) else {
        return refuse(ArcFault::Directions { count: 2 });
    };
    let walk = ArcFollower { bordered: &bordered, window, turns: turns(equations, q)? };
    let start = start.start();
    let mut leg = walk.leg(equations, start.clone())?;
    let mut first = leg.end;
    if leg.end == ArcEnd::Closed {
        listed_once(&mut leg);
    } else {
        let back = walk.leg(equations, start.reversed())?;
        first = back.end;
        leg = joined(back, leg);
    }
    rows::states(equations, &bordered, leg.nodes, leg.places, [first, leg.end], steps)
}

/// Drops the last place of a closed curve if it is the first one, after a whole turn along the curve.
fn listed_once(leg: &mut ArcLeg) {
    let length = leg.nodes.last().map_or(0.0, |node| node.s);
    if let [first, .., last] = &leg.places[..]
        && first.kind == last.kind
        && (last.s - length - first.s).abs() <= MIN_STEP
    {
        leg.places.pop();
    }
}

/// Joins two legs from one start; `back` is reversed.
fn joined(back: ArcLeg, onwards: ArcLeg) -> ArcLeg {
    let mut nodes: Vec<ArcNode> = back.nodes.into_iter().skip(1).rev().map(ArcNode::reversed).collect();
    nodes.extend(onwards.nodes);
    let mut places: Vec<ArcPlace> = back.places;
    places.reverse();
    places.iter_mut().for_each(|place| place.s = -place.s);
    places.extend(onwards.places);
    // A place at the start is in both legs.
    places.dedup_by(|a, b| a.kind == b.kind && (a.s - b.s).abs() <= MIN_STEP);
    ArcLeg { nodes, places, end: onwards.end }
}

struct ArcFollower<'b> {
    bordered: &'b Bordered,
    window: Window,
    /// For coordinates that are equivalent after a whole turn, that turn in their unit.
    turns: Vec<Option<f64>>,
}

impl ArcFollower<'_> {
    /// The curve from a place on in the direction of its tangent.
    fn leg(&self, equations: &mut Equations<'_>, start: ArcNode) -> Result<ArcLeg, SolveError> {
        let mut leg = ArcLeg { nodes: vec![start.at(0.0)], places: Vec::new(), end: ArcEnd::TooLong };
        let (mut length, mut shortened) = (FIRST, false);
        // The first place at which the mechanism moves; the curve is closed when it returns there.
        let mut origin: Option<ArcNode> = None;
        for _ in 0..MAX_STEPS {
            let node = leg.nodes[leg.nodes.len() - 1].clone();
            equations.observed.pass(node.t())?;
            if origin.is_none() && self.moves(&node) {
                origin = Some(node.clone());
            }
            length = length.min(self.longest(equations, &node));
            if let Some((next, cosine)) = self.step(equations, &node, length) {
                if let Some(end) = self.settle(equations, &mut leg, next, origin.as_ref()) {
                    leg.end = end;
                    return Ok(leg);
                }
                if !shortened && cosine > COSINES[1] {
                    length *= 2.0;
                }
                shortened = false;
                continue;
            }
            (length, shortened) = (0.5 * length, true);
            if length < MIN_STEP {
                leg.end = if self.bordered.is_singular(equations, &node.z, CROSSING) {
                    let before = leg.nodes.len().saturating_sub(5);
                    let kind = ArcPlaceKind::BranchPoint;
                    let place = singular_place(equations, kind, &leg.nodes[before], &node, (0.0, MIN_STEP));
                    leg.places.push(place);
                    ArcEnd::BranchPoint
                } else {
                    ArcEnd::Ended
                };
                return Ok(leg);
            }
        }
        Ok(leg)
    }

    /// The next place, and the cosine of the angle between the tangents; `None` where a step of this length is not
    /// accepted.
    fn step(&self, equations: &mut Equations<'_>, node: &ArcNode, length: f64) -> Option<(ArcNode, f64)> {
        let predicted: Vec<f64> = node.z.iter().zip(&node.tangent).map(|(z, rate)| z + length * rate).collect();
        let allowed = equations.options.prediction_tolerance * length;
        let mut next = self.bordered.node(equations, &predicted, &node.tangent, allowed)?;
        let cosine = self.bordered.dot(&node.tangent, &next.tangent);
        let is_smooth = cosine >= COSINES[0];
        if !is_smooth
            || contact::turned_about(equations, node.q(), next.q()).is_some()
            || !self.bordered.on_one_branch(equations, node, &next)
        {
            return None;
        }
        let way: Vec<f64> = next.z.iter().zip(&node.z).map(|(a, b)| a - b).collect();
        // An arc of a circle is longer than its chord by this fraction.
        next.s = node.s + self.bordered.norm(&way) * (1.0 + (1.0 - cosine).max(0.0) / 12.0);
        Some((next, cosine))
    }

    /// The longest step in which no body turns by more than the options allow.
    fn longest(&self, equations: &Equations<'_>, node: &ArcNode) -> f64 {
        let n = node.q().len();
        let turn = equations.scale.turn(&node.tangent[..n]).max((node.t_rate() / self.bordered.columns[n]).abs());
        equations.options.max_rotation_per_step / turn
    }

    /// True where q changes along the curve, and not t alone.
    fn moves(&self, node: &ArcNode) -> bool {
        let n = node.q().len();
        self.bordered.dot(&node.tangent[..n], &node.tangent[..n]) > MOVING * MOVING
    }

    /// Adds a step and its special places. Returns the reason if the curve ends in this step.
    fn settle(
        &self,
        equations: &mut Equations<'_>,
        leg: &mut ArcLeg,
        next: ArcNode,
        origin: Option<&ArcNode>,
    ) -> Option<ArcEnd> {
        let here = leg.nodes[leg.nodes.len() - 1].clone();
        let mut pieces = Vec::new();
        for ([before, node], within) in turnings(equations, self.bordered, &here, &next, ENCLOSED) {
            let beyond = 1e-6 * self.bordered.columns[here.q().len()] * before.t_rate().signum();
            let kind = ArcPlaceKind::DeadCentre;
            let place = singular_place(equations, kind, &before, &node, (beyond, within));
            pieces.push((node, Some(place)));
        }
        pieces.push((next, None));
        for (piece, place) in pieces {
            let here = leg.nodes[leg.nodes.len() - 1].clone();
            if let Some(last) = self.bound(equations, &here, &piece) {
                if last.s > here.s + MIN_STEP {
                    cusps(equations, self.bordered, (&here, &last), leg.nodes.len() == 1, ENCLOSED, &mut leg.places);
                    leg.nodes.push(last);
                }
                return Some(ArcEnd::Bound);
            }
            if let Some(last) = origin.and_then(|origin| self.closing(equations, origin, &here, &piece)) {
                cusps(equations, self.bordered, (&here, &last), false, ENCLOSED, &mut leg.places);
                leg.nodes.push(last);
                return Some(ArcEnd::Closed);
            }
            cusps(equations, self.bordered, (&here, &piece), leg.nodes.len() == 1, ENCLOSED, &mut leg.places);
            leg.nodes.push(piece);
            leg.places.extend(place);
        }
        None
    }

    /// The place at which t leaves the interval, if it lies between these.
    fn bound(&self, equations: &mut Equations<'_>, a: &ArcNode, b: &ArcNode) -> Option<ArcNode> {
        let Window { from, to } = self.window;
        let to = to?;
        let bound = if b.t() > from.max(to) {
            from.max(to)
        } else if b.t() < from.min(to) {
            from.min(to)
        } else {
            return None;
        };
        let found = self.root(equations, a, b, |node| (node.t() - bound) * (b.t() - a.t()).signum());
        let mut last = found.unwrap_or_else(|| a.clone());
        // The bound itself, to the last digit.
        let mut direction = vec![0.0; a.z.len()];
        direction[a.q().len()] = self.bordered.columns[a.q().len()] * a.t_rate().signum();
        let mut at_bound = last.z.clone();
        at_bound[a.q().len()] = bound;
        if let Some(node) = self.bordered.node(equations, &at_bound, &direction, CLOSED_DISTANCE.sqrt()) {
            let sign = self.bordered.dot(&node.tangent, &last.tangent).signum();
            last.tangent = node.tangent.iter().map(|x| sign * x).collect();
            last.z = node.z;
            last.z[a.q().len()] = bound;
        }
        Some(last)
    }

    /// The place between these at which the mechanism is where it began, up to whole turns of bodies.
    fn closing(&self, equations: &mut Equations<'_>, origin: &ArcNode, a: &ArcNode, b: &ArcNode) -> Option<ArcNode> {
        let (bordered, n) = (self.bordered, origin.q().len());
        let along = |node: &ArcNode| bordered.dot(&self.apart(origin, node), &origin.tangent[..n]);
        let is_passed = along(a) < 0.0 && along(b) >= 0.0;
        if !is_passed || bordered.norm(&self.apart(origin, b)) > 2.0 * (b.s - a.s) + CLOSED_DISTANCE {
            return None;
        }
        let found = self.root(equations, a, b, along)?;
        let same_place = bordered.norm(&self.apart(origin, &found)) <= CLOSED_DISTANCE;
        // A curve may come back to a place in another direction: as that of sin ½φ, where φ counts up to whole turns.
        let [way, first] = [&found, origin].map(|node| &node.tangent[..n]);
        let same_way = bordered.dot(way, first) > SAME_WAY * bordered.norm(way) * bordered.norm(first);
        (same_place && same_way).then_some(found)
    }

    /// The difference of two places in q, up to whole turns.
    fn apart(&self, origin: &ArcNode, node: &ArcNode) -> Vec<f64> {
        let pairs = node.q().iter().zip(origin.q()).zip(&self.turns);
        let difference = pairs.map(|((a, b), turn)| {
            let turns = turn.map_or(0.0, |turn| ((a - b) / turn).round() * turn);
            a - b - turns
        });
        difference.collect()
    }

    /// The place between two at which a function, which grows from negative to positive, is 0.
    fn root(
        &self,
        equations: &mut Equations<'_>,
        a: &ArcNode,
        b: &ArcNode,
        f: impl Fn(&ArcNode) -> f64,
    ) -> Option<ArcNode> {
        let slope = (f(b) - f(a)) / (b.s - a.s);
        let value = |node: &ArcNode| Value { t: node.s, f: -f(node), rate: -slope };
        let [low, _] = bracket(value(a), value(b), ENCLOSED, |s| {
            between(equations, self.bordered, a, b, s).map(|node| value(&node))
        });
        between(equations, self.bordered, a, b, low.t)
    }
}

/// A whole turn, for every coordinate that is equivalent after it: the angle of a body, or a scalar in which all rows that
/// do not drive are periodic.
fn turns(equations: &mut Equations<'_>, q: &[f64]) -> Result<Vec<Option<f64>>, SolveError> {
    let model = equations.model;
    let rows = equations.rows_where(|equations, row| !equations.drives(row));
    equations.evaluate(Subset::PHI, q, None)?;
    let phi = equations.phi.clone();
    let mut turned = q.to_vec();
    let mut turns = Vec::with_capacity(q.len());
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        let turn = model.turn(k);
        let repeats = match coordinate.kind {
            CoordinateKind::Pose { component, .. } => component == Component::Phi,
            CoordinateKind::Scalar => {
                turned[k] += turn;
                let evaluated = equations.evaluate(Subset::PHI, &turned, None).is_ok();
                turned[k] = q[k];
                let same =
                    |&row: &usize| (equations.phi[row] - phi[row]).abs() * equations.scale.rows[row] <= CLOSED_DISTANCE;
                evaluated && rows.iter().all(same)
            }
        };
        turns.push(repeats.then_some(turn));
    }
    Ok(turns)
}
