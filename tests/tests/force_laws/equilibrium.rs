//! Newton's and Euler's equations of every body, from the reported reactions alone, and the resultant of all forces on
//! the ground.

use crate::bodies::{Loaded, Sum, named, poses, slot};
use crate::{Weighted, forces_at, swept};
use kin_runtime::model::{CoordinateKind, Frame, JointInfo, JointKind, Model, OriginKind, Role};
use kin_runtime::{Forces, Reaction, State};
use kin_tests::compare::Differences;

/// Relative to the largest force, or moment, of the body.
const EXACT: f64 = 1e-9;

/// What reactions exert on a body, together with springs and loads, is what its inertia needs; and what they exert on
/// the ground is the shaking force with its moment.
pub(crate) fn reactions_balance_every_body<M: Weighted>(from: f64, to: f64) {
    let mechanism = M::default();
    let mut differences = Differences::new();
    let [a, b, c, d] = TIMES;
    let times = [from + a * (to - from), from + b * (to - from), from + c * (to - from), from + d * (to - from)];
    for state in &swept(&mechanism, &times) {
        let Some(forces) = forces_at(&mechanism, state) else { return };
        let phi_q = mechanism.jacobian(&state.instant(), &state.q).expect("a solved state");
        balance((M::model(), phi_q.as_ref()), state, &forces, &M::LOADS.at(state), &mut differences);
    }
    differences.finish();
}

/// When forces are compared, as shares of a motion.
const TIMES: [f64; 4] = [0.0, 0.31, 0.64, 0.97];

/// The same at a state, with Φ_q there.
fn balance(
    (model, phi_q): (&Model, &[f64]),
    state: &State,
    forces: &Forces,
    loaded: &Loaded,
    differences: &mut Differences,
) {
    differences.at(format_args!("t = {}", state.t));
    let exerted = exerted((model, phi_q), state, forces);
    let size = |c: usize| {
        let lists = [&exerted, &loaded.outside, &loaded.springs, &loaded.inertia];
        lists.into_iter().flatten().fold(1e-9, |size: f64, sum| size.max(sum.size[c]))
    };
    let sizes = [size(0), size(1)];
    let mut close = |what: &str, name: &str, expected: [f64; 3], found: [f64; 3]| {
        for (c, component) in ["force x", "force y", "moment"].into_iter().enumerate() {
            let what = format_args!("{what}, {component} of {name}");
            differences.number(what, expected[c], found[c], EXACT * sizes[usize::from(c == 2)]);
        }
    };
    let all = |sum: &Sum| [sum.force[0], sum.force[1], sum.moment];
    let mut total = [[0.0; 3]; 2];
    for (k, body) in model.bodies.iter().enumerate() {
        let lists = [&exerted, &loaded.outside, &loaded.springs].map(|list| all(&list[k]));
        let found = [0, 1, 2].map(|c| lists.iter().map(|sum| sum[c]).sum());
        let needed = all(&loaded.inertia[k]);
        close("equilibrium", body.name, needed, found);
        for c in 0..3 {
            total[0][c] += lists[1][c] - needed[c];
            total[1][c] -= needed[c];
        }
    }
    let ground = model.bodies.len();
    let [joints, springs] = [&exerted, &loaded.springs].map(|list| all(&list[ground]));
    let wrench = |wrench: &kin_runtime::Wrench| [wrench.force[0], wrench.force[1], wrench.moment];
    close("shaking", "the bodies", total[0], wrench(&forces.shaking));
    close("inertia", "the bodies", total[1], wrench(&forces.inertia));
    close("shaking", "ground", [0, 1, 2].map(|c| joints[c] + springs[c]), wrench(&forces.shaking));
    differences.number("kinetic energy", loaded.kinetic, forces.kinetic, 1e-11 * loaded.kinetic.max(1.0));
    differences.number("energy of gravity", loaded.gravity, forces.gravity, 1e-11 * loaded.gravity.abs().max(1.0));
    for (law, spring) in loaded.laws.iter().zip(&forces.springs) {
        let found = [spring.length, spring.rate, spring.force];
        let tolerance = 1e-10 * law.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        differences.vector(spring.name, |k| ["length", "rate", "force"][k], law, &found, tolerance);
    }
}

/// What joints, drivers and held coordinates exert on every body and, behind them, on the ground.
fn exerted((model, phi_q): (&Model, &[f64]), state: &State, forces: &Forces) -> Vec<Sum> {
    let mut sums = vec![Sum::default(); model.bodies.len() + 1];
    for reaction in &forces.reactions {
        let joint = model.joints.iter().find(|joint| joint.name == reaction.name);
        assert!(reaction.determined || model.allow_redundant, "{reaction}");
        for (frame, couple) in &reaction.couples {
            sums[slot(model, *frame)].add([0.0; 2], [0.0; 2], *couple);
        }
        // Of a rope, the reaction is the force on its last point alone: its tension, which is the effort, too.
        let Some(on) = reaction.on.filter(|_| !joint.is_some_and(is_rope)) else { continue };
        let (point, force) = (reaction.point.unwrap_or_default(), reaction.force.unwrap_or_default());
        let moment = reaction.moment.unwrap_or(0.0);
        sums[slot(model, on)].add(point, force, moment);
        let back = if reaction.couples.is_empty() { -moment } else { 0.0 };
        sums[slot(model, opposite(model, joint, reaction))].add(point, force.map(|f| -f), back);
    }
    for joint in model.joints.iter().filter(|joint| is_free(joint, forces) || is_rope(joint)) {
        by_rows((model, phi_q), state, forces, joint, &mut sums);
    }
    sums
}

/// The body that receives the opposite of a reaction.
fn opposite(model: &Model, joint: Option<&JointInfo>, reaction: &Reaction) -> Frame {
    let Some(joint) = joint else {
        // What holds or carries a body: `b.x` is held by the ground.
        let body = reaction.name.rsplit_once('.').map_or("", |(body, _)| body);
        return match model.bodies[named(model, body)].origin {
            OriginKind::Carried(carrier) if reaction.name.ends_with(".origin") => carrier,
            _ => Frame::Ground,
        };
    };
    // Of a rack and of a screw, the guide is the frame of the axis.
    let guide = joint.geometry.iter().find(|piece| piece.role == Role::Axis).map(|piece| piece.frame);
    match (reaction.couples.is_empty(), guide) {
        (false, Some(guide)) => guide,
        _ if joint.frames[1].is_some() => joint.frames[0].unwrap_or(Frame::Ground),
        _ => Frame::Ground,
    }
}

fn is_rope(joint: &JointInfo) -> bool {
    joint.kind == JointKind::Rope
}

/// True for a joint without a point of its own: a formula of the user.
fn is_free(joint: &JointInfo, forces: &Forces) -> bool {
    joint.kind.is_free_equation() && forces.reaction(joint.name).is_none_or(|reaction| reaction.on.is_none())
}

/// What the rows of a formula or a rope exert: a generalized force, an effort, or a tension, along each coordinate of the
/// bodies in it. The ground receives the opposite.
fn by_rows((model, phi_q): (&Model, &[f64]), state: &State, forces: &Forces, joint: &JointInfo, sums: &mut [Sum]) {
    let poses = poses(state);
    let reported = forces.reaction(joint.name).map(|reaction| reaction.generalized.clone());
    let reported = reported.filter(|generalized| !generalized.is_empty());
    for row in joint.first_row..joint.first_row + joint.rows {
        let along = match &reported {
            Some(generalized) => generalized[row - joint.first_row],
            None => forces.effort(joint.name).unwrap_or_else(|| panic!("no effort of {}", joint.name)),
        };
        let entries = model.constraint_pattern.entries.iter().zip(phi_q);
        for (&(_, column), entry) in entries.filter(|((place, _), _)| *place == row) {
            let CoordinateKind::Pose { body, component } = model.coordinates[column].kind else {
                // What drives the direction from disc to disc turns the first of them, as the second feels the contact alone.
                if let Some(disc) = along_discs(model, column) {
                    sums[slot(model, disc)].add([0.0; 2], [0.0; 2], along * entry);
                    sums[model.bodies.len()].add([0.0; 2], [0.0; 2], -along * entry);
                }
                continue;
            };
            let mut wrench = [0.0; 3];
            wrench[component as usize] = along * entry;
            let [x, y, _] = poses[body].at;
            let ground = model.bodies.len();
            sums[body].add([x, y], [wrench[0], wrench[1]], wrench[2]);
            sums[ground].add([x, y], [-wrench[0], -wrench[1]], -wrench[2]);
        }
    }
}

/// The first of two discs that roll on one another whose direction ψ is this coordinate.
fn along_discs(model: &Model, column: usize) -> Option<Frame> {
    let holds = |joint: &&JointInfo| {
        let rows = joint.first_row..joint.first_row + joint.rows;
        let entries = model.constraint_pattern.entries;
        joint.kind == JointKind::RollingOnDisc && entries.iter().any(|(row, k)| *k == column && rows.contains(row))
    };
    model.joints.iter().find(holds)?.frames[0]
}
