//! Laws of the equations at configurations that do not satisfy Φ = 0.

use crate::{When, random_configuration};
use kin_runtime::model::{BodyInfo, CoordinateKind, Frame, JointKind};
use kin_runtime::{Instant, Subset};
use kin_tests::compare::{Differences, largest};
use kin_tests::random::Random;
use kin_tests::subject::Subject;
use std::collections::BTreeSet;

/// Φ_q, Φ_t and γ agree with dual numbers, at configurations that do not satisfy Φ = 0.
pub(crate) fn closed_forms_equal_duals(mechanism: &dyn Subject) {
    let check = mechanism.cross_check().unwrap();
    assert!(check.configurations > 0 && check.passes(1e-12), "{check}");
}

/// Φ, Φ_q, Φ_t and γ alone, and the pairs that analyses request, agree with the complete evaluation bit by bit.
pub(crate) fn subsets_equal_the_whole(mechanism: &dyn Subject) {
    let (when, q, q_dot) = random_configuration(mechanism, &mut Random::new(3));
    let at = when.at();
    let whole = mechanism.evaluate(Subset::ALL, &at, &q, &q_dot);
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&whole.phi), bits(&mechanism.constraints(&at, &q).unwrap()));
    assert_eq!(bits(&whole.phi_q), bits(&mechanism.jacobian(&at, &q).unwrap()));
    assert_eq!(bits(&whole.phi_t), bits(&mechanism.time_derivative(&at, &q).unwrap()));
    assert_eq!(bits(&whole.gamma), bits(&mechanism.gamma(&at, &q, &q_dot).unwrap()));
    for subset in [Subset::POSITION, Subset::VELOCITY] {
        let part = mechanism.evaluate(subset, &at, &q, &q_dot);
        assert_eq!(bits(&whole.phi_q), bits(&part.phi_q));
        if subset.phi {
            assert_eq!(bits(&whole.phi), bits(&part.phi));
        }
        if subset.phi_t {
            assert_eq!(bits(&whole.phi_t), bits(&part.phi_t));
        }
    }
}

/// The equations in `f32` agree with those in `f64`, up to the precision of `f32`.
pub(crate) fn single_precision_agrees(mechanism: &dyn Subject) {
    let mut random = Random::new(11);
    let mut differences = Differences::new();
    for round in 0..5 {
        let (when, q, q_dot) = random_configuration(mechanism, &mut random);
        let single = |values: &[f64]| values.iter().map(|&value| value as f32).collect::<Vec<_>>();
        let (t, q, q_dot) = (when.t as f32, single(&q), single(&q_dot));
        let inputs: Vec<_> = when.inputs.iter().map(|u| u.map(|value| value as f32)).collect();
        let double = |values: &[f32]| values.iter().map(|&value| f64::from(value)).collect::<Vec<_>>();
        let rounded = When { t: f64::from(t), inputs: inputs.iter().map(|u| u.map(f64::from)).collect() };
        let expected = mechanism.evaluate(Subset::ALL, &rounded.at(), &double(&q), &double(&q_dot));
        let found = mechanism.evaluate_single(&Instant { t, inputs: &inputs }, &q, &q_dot);
        differences.at(format_args!("configuration {round}"));
        let parts = [
            ("Φ", &expected.phi, &found.phi),
            ("Φ_q", &expected.phi_q, &found.phi_q),
            ("Φ_t", &expected.phi_t, &found.phi_t),
            ("γ", &expected.gamma, &found.gamma),
        ];
        for (what, expected, found) in parts {
            let tolerance = 2e-5 * largest(expected).max(1.0);
            differences.vector(what, |place| place, expected, &double(found), tolerance);
        }
    }
    differences.finish();
}

/// The norm of the residual of a joint between moving bodies does not change under a common rigid motion of all its
/// bodies.
pub(crate) fn joints_do_not_feel_rigid_motion(mechanism: &dyn Subject) {
    let model = mechanism.model();
    let mut random = Random::new(29);
    for joint in model.joints {
        let [Some(Frame::Body(first)), Some(Frame::Body(second))] = joint.frames else { continue };
        if matches!(joint.kind, JointKind::Constraint) {
            continue;
        }
        // For axles in the ground, the row depends on the angles relative to the ground.
        let frames = joint.geometry.iter().map(|geometry| geometry.frame);
        let coupled = matches!(joint.kind, JointKind::Gear | JointKind::Belt);
        if coupled && frames.into_iter().any(|frame| frame == Frame::Ground) {
            continue;
        }
        // A carrier, a pinion or a nut is a third body.
        let rows = joint.first_row..joint.first_row + joint.rows;
        let columns: BTreeSet<usize> = model
            .constraint_pattern
            .entries
            .iter()
            .filter(|entry| rows.contains(&entry.0))
            .map(|entry| entry.1)
            .collect();
        let touches = |body: &BodyInfo| body.coordinates.iter().flatten().any(|place| columns.contains(place));
        let third = model.bodies.iter().enumerate().filter(|(_, body)| touches(body)).map(|(place, _)| place);
        let bodies: BTreeSet<usize> = [first, second].into_iter().chain(third).collect();
        let poses: Vec<_> = bodies.into_iter().map(|body| model.bodies[body].coordinates).collect();
        if poses.iter().flatten().any(Option::is_none) {
            continue;
        }
        let (when, q, _) = random_configuration(mechanism, &mut random);
        let (turn, shift) = (random.between(-3.0, 3.0), random.vector(2, -2.0, 2.0));
        let (sin, cos) = turn.sin_cos();
        let mut moved = q.clone();
        for pose in &poses {
            let [x, y, phi] = pose.map(|place| place.expect("checked above"));
            moved[x] = shift[0] + cos * q[x] - sin * q[y];
            moved[y] = shift[1] + sin * q[x] + cos * q[y];
            moved[phi] = q[phi] + turn;
        }
        if joint.kind == JointKind::RollingOnDisc {
            // The coordinate of the direction of the line of centres is rotated, too.
            let entries = model.constraint_pattern.entries.iter().filter(|entry| rows.contains(&entry.0));
            let scalars: BTreeSet<usize> = entries.map(|entry| entry.1).collect();
            for psi in scalars.into_iter().filter(|&k| model.coordinates[k].kind == CoordinateKind::Scalar) {
                moved[psi] = q[psi] + turn;
            }
        }
        let norm = |q: &[f64]| {
            let phi = mechanism.constraints(&when.at(), q).expect("lengths agree");
            let rows = &phi[joint.first_row..joint.first_row + joint.rows];
            rows.iter().map(|row| row * row).sum::<f64>().sqrt()
        };
        let (before, after) = (norm(&q), norm(&moved));
        assert!((before - after).abs() <= 1e-13 * before.max(1.0), "joint {}: {before} and {after}", joint.name);
    }
}
