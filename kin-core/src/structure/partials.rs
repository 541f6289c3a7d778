//! The rows of Φ_q at a random pose.
//!
//! For joints whose points have random positions (see `place`) the rows are computed from ∂r/∂φ = perp(r − r_i);
//! factors that scale a whole row are omitted. All other rows are residues of the symbolic partial derivatives;
//! subexpressions without a residue have random values. In both cases the sparsity pattern is correct and literal
//! coefficients are exact.

use super::field::Residue;
use super::place::local;
use super::rank::{Row, add_to};
use super::residue::Residues;
use crate::constraint::{ConstraintSet, Frame, JointInstance, RowMeaning};
use crate::expr::Depends;
use crate::system::KinematicSystem;
use crate::vocabulary::Role;

/// The partial derivatives of the position r of a point with respect to each coordinate that moves the point.
type Motion = Vec<(usize, [Residue; 2])>;

/// A row of Φ_q at the random pose.
pub(super) fn row(system: &KinematicSystem, residues: &mut Residues<'_>, row: usize) -> Row {
    of_joint(system, residues, row).unwrap_or_else(|| {
        let mut entries = Row::new();
        for &(k, e) in &system.equations[row].phi_q {
            add_to(&mut entries, k as usize, residues.of(e));
        }
        entries
    })
}

/// The row, if its joint is one whose points have random positions.
fn of_joint(system: &KinematicSystem, residues: &mut Residues<'_>, row: usize) -> Option<Row> {
    let set = &system.set;
    let joint = &set.joints[set.rows[row].joint];
    let p = local(set, joint, Role::P)?;
    if [Role::P, Role::Q, Role::Axis].into_iter().any(|role| moves_with_scalars(set, joint, role)) {
        return None;
    }
    let r_p = residues.places.point(&set.graph, p);
    let motion_p = motion(residues, p.0, r_p);
    if let RowMeaning::Coordinate(component) = set.rows[row].meaning {
        return Some(combined(&[(&motion_p, unit(component))]));
    }
    let q = local(set, joint, Role::Q)?;
    let r_q = residues.places.point(&set.graph, q);
    let motion_q = motion(residues, q.0, r_q);
    let minus = |v: [Residue; 2]| v.map(|component| -component);
    match set.rows[row].meaning {
        RowMeaning::Coincidence(number) => {
            Some(combined(&[(&motion_q, unit(number)), (&motion_p, minus(unit(number)))]))
        }
        RowMeaning::AcrossAxis(_) => {
            let (frame, x, y) = local(set, joint, Role::Axis)?;
            let direction = residues.direction([x, y]);
            let (u, angle) = match frame {
                Frame::Ground => (direction, None),
                Frame::Body(body) => {
                    let turn = residues.turns.rotation(&set.graph, set.bodies[body].pose[2]);
                    (turn.apply(direction), set.bodies[body].coordinates[2])
                }
            };
            let normal = [-u[1], u[0]];
            let mut entries = combined(&[(&motion_q, normal), (&motion_p, minus(normal))]);
            if let Some(k) = angle {
                // The line rotates with its body: ∂(perp(u)·d)/∂φ_i = −u·d.
                let d = [r_q[0] - r_p[0], r_q[1] - r_p[1]];
                add_to(&mut entries, k as usize, -(u[0] * d[0] + u[1] * d[1]));
            }
            Some(entries)
        }
        // The right-hand side of a driver may contain coordinates, whose partial derivatives belong to the row.
        RowMeaning::SquaredDistance if !follows_coordinates(set, joint) => {
            let d = [r_q[0] - r_p[0], r_q[1] - r_p[1]];
            Some(combined(&[(&motion_q, d), (&motion_p, minus(d))]))
        }
        _ => None,
    }
}

/// True if a point or an axis of a joint belongs to a body that is held at scalar coordinates, or is carried by such a body.
/// Then the point moves with these coordinates, too.
fn moves_with_scalars(set: &ConstraintSet, joint: &JointInstance, role: Role) -> bool {
    let mut frame = local(set, joint, role).map(|(frame, ..)| frame);
    for _ in 0..=set.bodies.len() {
        let Some(Frame::Body(index)) = frame else { break };
        let body = &set.bodies[index];
        let held = (0..3).filter(|&component| {
            // The origin of a carried body is where its carrier has it.
            body.coordinates[component].is_none() && (component == 2 || body.carried_by.is_none())
        });
        if held.map(|component| body.pose[component]).any(|e| set.graph.depends(e).on(Depends::COORDINATE)) {
            return true;
        }
        frame = body.carried_by;
    }
    false
}

/// True if the length of a joint depends on coordinates.
fn follows_coordinates(set: &ConstraintSet, joint: &JointInstance) -> bool {
    let values = joint.geometry.iter().filter(|geometry| geometry.role == Role::Value);
    values.map(|geometry| set.geometry[geometry.offset]).any(|e| set.graph.depends(e).on(Depends::COORDINATE))
}

fn unit(component: usize) -> [Residue; 2] {
    if component == 0 { [Residue::ONE, Residue::ZERO] } else { [Residue::ZERO, Residue::ONE] }
}

/// Σ weight · ∂r, one term per point.
fn combined(terms: &[(&Motion, [Residue; 2])]) -> Row {
    let mut row = Row::new();
    for (motion, weight) in terms {
        for (k, v) in motion.iter() {
            add_to(&mut row, *k, weight[0] * v[0] + weight[1] * v[1]);
        }
    }
    row
}

/// The partial derivatives of a point at `r` with respect to the coordinates of its body and of the bodies that carry
/// this body.
fn motion(residues: &Residues<'_>, frame: Frame, r: [Residue; 2]) -> Motion {
    let set: &ConstraintSet = residues.set;
    let (mut moved, mut r, mut frame) = (Motion::new(), r, frame);
    // A chain of carrying bodies has at most as many members as there are bodies.
    for _ in 0..=set.bodies.len() {
        let Frame::Body(index) = frame else { break };
        let body = &set.bodies[index];
        let origin = residues.places.origin(index);
        if let Some(k) = body.coordinates[2] {
            moved.push((k as usize, [-(r[1] - origin[1]), r[0] - origin[0]]));
        }
        for component in 0..2 {
            if let Some(k) = body.coordinates[component] {
                moved.push((k as usize, unit(component)));
            }
        }
        match body.carried_by {
            Some(carrier) => {
                r = origin;
                frame = carrier;
            }
            None => break,
        }
    }
    moved
}
