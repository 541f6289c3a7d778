//! Special places between two neighbouring places of the curve: dead centres and cusps.

use super::bordered::{ArcNode, Bordered};
use crate::analysis::by_plan;
use crate::arc::{ArcPlace, ArcPlaceKind};
use crate::equations::Equations;
use crate::linear::null_space;
use crate::nonlinear::root::{Value, bracket};
use crate::signal::Instant;
use crate::workspace::Subset;

/// Largest number of places between two that are looked at in the search for the least rate of t.
const MAX_TRIALS: usize = 60;
/// If the least rate of t between two places may be below this fraction of the rates at both, it is looked for.
const MUCH_SMALLER: f64 = 0.5;
/// Ratio of the rates at two places below which the places between them are looked at.
const UNEVEN_RATIO: f64 = 0.2;
/// Rate of t, on the common scale, below which t stands still.
const STANDING: f64 = 1e-9;
/// How far a place between two others may be from the cubic through them, relative to their distance.
const MAX_CUBIC_ERROR: f64 = 0.1;
/// Relative pivot below which rows of Φ_q count as dependent.
const DEPENDENT_PIVOT: f64 = 1e-5;
/// Largest speed of a point at a cusp, per length of arc, relative to its speed beside the cusp.
const CUSP_SPEED: f64 = 1e-6;
/// How far on both sides of a cusp its tangents are compared.
const TANGENT_OFFSET: f64 = 1e-3;
/// If the unit velocities before and after a place add up to less than this, the point returns along its own path,
/// which is no cusp. At a cusp the sum is about as long as `TANGENT_OFFSET`.
const RETRACED: f64 = 1e-5;

/// The place on the curve at a length s between two neighbours: predicted by the cubic through both with their
/// tangents.
pub(super) fn between(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    a: &ArcNode,
    b: &ArcNode,
    s: f64,
) -> Option<ArcNode> {
    let h = b.s - a.s;
    let x = (s - a.s) / h;
    let (mut z, mut direction) = (Vec::with_capacity(a.z.len()), Vec::with_capacity(a.z.len()));
    for k in 0..a.z.len() {
        let (from, change) = (a.z[k], b.z[k] - a.z[k]);
        let (first, last) = (h * a.tangent[k], h * b.tangent[k]);
        let (c2, c3) = (3.0 * change - 2.0 * first - last, first + last - 2.0 * change);
        z.push(from + x * (first + x * (c2 + x * c3)));
        direction.push((first + x * (2.0 * c2 + x * 3.0 * c3)) / h);
    }
    let length = bordered.norm(&direction);
    direction.iter_mut().for_each(|x| *x /= length);
    Some(bordered.node(equations, &z, &direction, MAX_CUBIC_ERROR * h.abs())?.at(s))
}

/// The places at which t turns back: one where its rate has different signs at both ends, and two where it has the same sign
/// at both, and another in between. Each with a place before it, and the width to which it was enclosed.
pub(super) fn turnings(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    a: &ArcNode,
    b: &ArcNode,
    within: f64,
) -> Vec<([ArcNode; 2], f64)> {
    let mut ends = vec![a.clone(), b.clone()];
    if let Some(low) = reversal(equations, bordered, a, b, &mut { MAX_TRIALS }) {
        ends.insert(1, low);
    }
    let turning = |pair: &[ArcNode]| {
        let (node, width) = turning(equations, bordered, &pair[0], &pair[1], within)?;
        Some(([pair[0].clone(), node], width))
    };
    ends.windows(2).filter_map(turning).collect()
}

/// A place between two at which t runs in the other direction, if it runs in the same one at both. It is looked for where the
/// cubic through both suggests that the rate is much smaller in between, and where the rates at both differ so much that this
/// cubic says little.
fn reversal(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    a: &ArcNode,
    b: &ArcNode,
    trials: &mut usize,
) -> Option<ArcNode> {
    let sign = a.t_rate().signum();
    let [first, last] = [a, b].map(|node| sign * node.t_rate());
    let (low, high) = (first.min(last), first.max(last));
    // The comparison is written so that NaN counts as standing still.
    let is_moving = low > 0.0 && high > STANDING * bordered.columns[a.q().len()];
    let place = match least_rate(sign, a, b) {
        _ if !is_moving => return None,
        Some((place, least)) if least <= MUCH_SMALLER * low => place,
        _ if low < UNEVEN_RATIO * high => 0.5 * (a.s + b.s),
        _ => return None,
    };
    *trials = trials.checked_sub(1)?;
    let middle = between(equations, bordered, a, b, place)?;
    if sign * middle.t_rate() <= 0.0 {
        return Some(middle);
    }
    let first = reversal(equations, bordered, a, &middle, trials);
    first.or_else(|| reversal(equations, bordered, &middle, b, trials))
}

/// The place between two, and the value, of the least rate of t, times a sign, on the cubic through both; `None` where it is
/// at one of the ends.
fn least_rate(sign: f64, a: &ArcNode, b: &ArcNode) -> Option<(f64, f64)> {
    let h = b.s - a.s;
    let [mean, first, last] = [(b.t() - a.t()) / h, a.t_rate(), b.t_rate()].map(|rate| sign * rate);
    // The rate is first + x (linear + x square).
    let (linear, square) = (6.0 * mean - 4.0 * first - 2.0 * last, 3.0 * (first + last - 2.0 * mean));
    let x = -0.5 * linear / square;
    (square > 0.0 && x > 0.0 && x < 1.0).then_some((a.s + h * x, first + 0.5 * linear * x))
}

/// The place at which t turns back, with the width to which it was enclosed.
fn turning(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    a: &ArcNode,
    b: &ArcNode,
    within: f64,
) -> Option<(ArcNode, f64)> {
    if (a.t_rate() > 0.0) == (b.t_rate() > 0.0) {
        return None;
    }
    let sign = if a.t_rate() > 0.0 { 1.0 } else { -1.0 };
    let slope = sign * (b.t_rate() - a.t_rate()) / (b.s - a.s);
    let value = |node: &ArcNode| Value { t: node.s, f: sign * node.t_rate(), rate: slope };
    let [low, high] =
        bracket(value(a), value(b), within, |s| between(equations, bordered, a, b, s).map(|node| value(&node)));
    // Where branches cross at the same place, the middle may not be solved.
    let places = [0.5, 0.0, 1.0].map(|x| low.t + x * (high.t - low.t));
    let node = places.into_iter().find_map(|s| between(equations, bordered, a, b, s))?;
    Some((node, high.t - low.t))
}

/// What is known of a singular place; `beside` is a place before it. `beyond` is added to t to get an instant at which
/// the group does not close, and `within` is the width to which the place was enclosed.
pub(super) fn singular_place(
    equations: &mut Equations<'_>,
    kind: ArcPlaceKind,
    beside: &ArcNode,
    node: &ArcNode,
    (beyond, within): (f64, f64),
) -> ArcPlace {
    let q = node.q().to_vec();
    let (mut joints, mut drivers) = (Vec::new(), Vec::new());
    let mut signs = Vec::new();
    if equations.model.plan.exists() && equations.move_to(beside.t()).is_ok() {
        by_plan::modes(equations, beside.q(), &mut signs);
    }
    let limit = equations.move_to(node.t() + beyond).ok().and_then(|()| by_plan::limit_in(equations, &signs, &q));
    if let Some(limit) = limit {
        joints = limit.joints().collect();
        if kind == ArcPlaceKind::DeadCentre {
            drivers = limit.drivers().collect();
        }
    } else if equations.move_to(node.t()).is_ok() && equations.evaluate(Subset::JACOBIAN, &q, None).is_ok() {
        let all: Vec<usize> = (0..equations.rows()).collect();
        let null_vectors = null_space(&equations.scaled(&all).transpose(), DEPENDENT_PIVOT);
        let largest = null_vectors.amax();
        let dependent = (0..null_vectors.nrows()).filter(|&row| null_vectors.row(row).amax() > 1e-3 * largest);
        joints = dependent.map(|row| equations.joint_name(row)).collect();
        joints.dedup();
    }
    ArcPlace { kind, t: node.t(), s: node.s, within, q, joints, drivers }
}

/// Adds the cusps of named points between two places, and at the first of them where it is the start.
pub(super) fn cusps(
    equations: &mut Equations<'_>,
    bordered: &Bordered,
    (a, b): (&ArcNode, &ArcNode),
    at_start: bool,
    within: f64,
    places: &mut Vec<ArcPlace>,
) {
    let points = equations.model.points;
    if points.is_empty() {
        return;
    }
    let (Some(before), Some(after)) = (rates(equations, a), rates(equations, b)) else { return };
    for (place, point) in points.iter().enumerate() {
        let kind = ArcPlaceKind::Cusp { point: point.name };
        let [from, to] = [before[place], after[place]];
        let (first, last) = (from[0].hypot(from[1]), to[0].hypot(to[1]));
        let along = |rate: [f64; 2]| rate[0] * from[0] + rate[1] * from[1];
        let (node, within, size) = if at_start && first <= CUSP_SPEED * last {
            (a.clone(), 0.0, last)
        } else if along(to) < 0.0 {
            let value = |s: f64, rate: [f64; 2]| Value { t: s, f: along(rate), rate: f64::NAN };
            let [low, high] = bracket(value(a.s, from), value(b.s, to), within, |s| {
                let node = between(equations, bordered, a, b, s)?;
                let rate = rates(equations, &node)?[place];
                Some(value(s, rate))
            });
            let Some(node) = between(equations, bordered, a, b, 0.5 * (low.t + high.t)) else { continue };
            (node, high.t - low.t, first.max(last))
        } else {
            continue;
        };
        let rate = rates(equations, &node).map_or(f64::NAN, |all| all[place][0].hypot(all[place][1]));
        // A path that returns along itself has the same tangents on both sides.
        let turn = [-TANGENT_OFFSET, TANGENT_OFFSET].map(|beside| {
            let node = between(equations, bordered, a, b, node.s + beside)?;
            let [x, y] = rates(equations, &node)?[place];
            let length = x.hypot(y);
            Some([x / length, y / length])
        });
        let [Some(before), Some(after)] = turn else { continue };
        let turn = (before[0] + after[0]).hypot(before[1] + after[1]);
        if rate <= CUSP_SPEED * size && turn > RETRACED {
            let (t, s, q) = (node.t(), node.s, node.q().to_vec());
            places.push(ArcPlace { kind, t, s, within, q, joints: Vec::new(), drivers: Vec::new() });
        }
    }
}

/// The derivatives of all named points with respect to the length of the arc.
fn rates(equations: &mut Equations<'_>, node: &ArcNode) -> Option<Vec<[f64; 2]>> {
    equations.move_to(node.t()).ok()?;
    let at = Instant { t: equations.t, inputs: &equations.inputs };
    equations.system.observe(&at, node.q(), &equations.still).ok()?;
    let parts = equations.system.observables();
    let model = equations.model;
    let rate = |row: usize| {
        let by_time = node.t_rate() * parts.phi_t[row];
        parts.gradient(&model.observable_pattern, row).fold(by_time, |sum, (k, entry)| sum + entry * node.tangent[k])
    };
    Some(model.points.iter().map(|point| point.observables.map(rate)).collect())
}
