//! Mechanisms whose kernels are longer than one block of generated code.

use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Subset, mechanism};
use kin_tests::works;

/// A chain of forty links, each driven relative to the previous one, with a slider at its end.
#[mechanism]
#[bodies(link[40], slider)]
#[revolute(root: ground @ (0, 0), link[0] @ (-l[0]/2, 0.01))]
#[revolute(pin[i in 0..39]: link[i] @ (l[i]/2, 0.01), link[i + 1] @ (-l[i + 1]/2, 0.01))]
#[driver(first: link[0].phi = 0.2*sin(t))]
#[relative_angle(bend[i in 0..39]: link[i], link[i + 1] = 0.1*t + 0.05*cos(2*t))]
#[revolute(end: link[39] @ (l[39]/2, 0), slider @ (0, 0))]
#[relative_angle(level: link[39], slider = 0.3)]
#[point(joint[i in 0..40] = link[i] @ (l[i]/2, 0.01))]
struct Chain {
    #[param(0.1)]
    l: [f64; 40],
}

#[test]
fn a_long_chain_closes_and_agrees_with_dual_numbers() {
    let chain = Chain::default();
    let operations = Chain::model().operations;
    assert!(operations.add + operations.mul > 900, "no longer than one block: {operations:?}");
    works(&chain);
    let state = chain.state_at(&Instant::at(0.7)).unwrap();
    assert!(state.residual < 1e-12, "{}", state.residual);
    let motion = chain.solver().motion(&state).unwrap();
    // The same chain by adding up its links.
    let (mut x, mut y, mut phi) = (0.0, 0.0, 0.2 * 0.7_f64.sin());
    for k in 0..40 {
        (x, y) = (x + 0.1 * phi.cos(), y + 0.1 * phi.sin());
        let [found_x, found_y] = motion[Chain::joint[k]].r;
        assert!((found_x - x).abs() < 1e-12 && (found_y - y).abs() < 1e-12, "joint[{k}]");
        phi += 0.07 + 0.05 * 1.4_f64.cos();
    }
}

#[test]
fn every_subset_of_a_long_kernel_agrees_with_the_whole() {
    let chain = Chain::default();
    let n = Chain::COORDINATES;
    let q: Vec<f64> = (0..n).map(|k| (k as f64 * 0.7).sin()).collect();
    let w: Vec<f64> = (0..n).map(|k| (k as f64 * 1.3).cos()).collect();
    let evaluate = |subset| {
        let mut workspace = Chain::workspace::<f64>();
        chain.evaluate(subset, &Instant::at(0.4), &q, &w, &mut workspace).unwrap();
        workspace
    };
    let whole = evaluate(Subset::ALL);
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(close(evaluate(Subset::PHI).phi(), whole.phi()));
    assert!(close(evaluate(Subset::POSITION).phi_q(), whole.phi_q()));
    assert!(close(evaluate(Subset::VELOCITY).phi_t(), whole.phi_t()));
    assert!(close(evaluate(Subset::GAMMA).gamma(), whole.gamma()));
}

/// Long tables are packed by the macro and unpacked when the model is first used; their contents are the same as those
/// of short tables.
#[test]
fn long_tables_say_what_short_ones_would() {
    use kin_runtime::model::{
        Component, CoordinateKind, Frame, JointKind, Level, Observable, OriginKind, ParameterInfo, Role, RowInfo,
    };
    let model = Chain::model();
    let body = |k: usize| if k < 40 { format!("link[{k}]") } else { "slider".to_owned() };
    assert_eq!((model.coordinates.len(), model.bodies.len(), model.joints.len()), (123, 41, 82));
    for (place, coordinate) in model.coordinates.iter().enumerate() {
        let component = [Component::X, Component::Y, Component::Phi][place % 3];
        assert_eq!(coordinate.name, format!("{}.{}", body(place / 3), ["x", "y", "phi"][place % 3]));
        assert_eq!(coordinate.kind, CoordinateKind::Pose { body: place / 3, component });
    }
    for (k, found) in model.bodies.iter().enumerate() {
        assert_eq!((found.name.to_owned(), found.origin), (body(k), OriginKind::Free));
        assert_eq!(found.coordinates, [Some(3 * k), Some(3 * k + 1), Some(3 * k + 2)]);
        for (c, observable) in found.observables.into_iter().enumerate() {
            let component = [Component::X, Component::Y, Component::Phi][c];
            assert_eq!(model.observables[observable], Observable::Pose { body: k, component });
        }
    }
    for (k, parameter) in model.parameters.iter().enumerate() {
        assert_eq!(parameter.name, format!("l[{k}]"));
        assert_eq!(*parameter, ParameterInfo { name: parameter.name, unit: None, default: Some(0.1), doc: "" });
    }
    // Rows and joints refer to one another; every joint has its name, its kind and its frames.
    let mut row = 0;
    for (number, joint) in model.joints.iter().enumerate() {
        let (name, kind, frames) = match number {
            0 => ("root".to_owned(), JointKind::Revolute, [Some(Frame::Ground), Some(Frame::Body(0))]),
            1..40 => {
                let k = number - 1;
                (format!("pin[{k}]"), JointKind::Revolute, [Some(Frame::Body(k)), Some(Frame::Body(k + 1))])
            }
            40 => ("first".to_owned(), JointKind::Driver, [None, None]),
            41..80 => {
                let k = number - 41;
                (format!("bend[{k}]"), JointKind::RelativeAngle, [Some(Frame::Body(k)), Some(Frame::Body(k + 1))])
            }
            80 => ("end".to_owned(), JointKind::Revolute, [Some(Frame::Body(39)), Some(Frame::Body(40))]),
            81 => ("level".to_owned(), JointKind::RelativeAngle, [Some(Frame::Body(39)), Some(Frame::Body(40))]),
            _ => unreachable!("82 joints"),
        };
        assert_eq!((joint.name.to_owned(), joint.kind, joint.frames, joint.first_row), (name, kind, frames, row));
        for (part, own) in model.rows[row..row + joint.rows].iter().enumerate() {
            let name =
                if joint.rows == 1 { joint.name.to_owned() } else { format!("{}.{}", joint.name, ["x", "y"][part]) };
            let driving = joint.name.starts_with("first") || joint.name.starts_with("bend");
            assert_eq!(own.name, name);
            let expected = RowInfo {
                name: own.name,
                joint: number,
                level: Level::Position,
                rheonomic: driving,
                driving,
                bilateral: true,
            };
            assert_eq!(*own, expected);
        }
        row += joint.rows;
        for quantity in joint.quantities {
            let observable = model.observables[quantity.observable];
            let place = joint.quantities.iter().position(|other| other == quantity).unwrap();
            assert_eq!(observable, Observable::Joint { joint: number, quantity: place }, "{}", quantity.name);
        }
    }
    assert_eq!(row, model.rows.len());
    // Points are consecutive in the geometry, with their bodies.
    let pin = &model.joints[7];
    let places: Vec<_> = pin.geometry.iter().map(|entry| (entry.role, entry.frame)).collect();
    assert_eq!(places, [(Role::P, Frame::Body(6)), (Role::Q, Frame::Body(7))]);
    let offsets: Vec<usize> = model.joints.iter().flat_map(|joint| joint.geometry).map(|entry| entry.offset).collect();
    assert!(offsets.windows(2).all(|two| two[0] < two[1]), "{offsets:?}");
    // The entries of Φ_q are sorted, and evaluations do not write constant entries.
    let pattern = model.constraint_pattern;
    assert!(pattern.entries.windows(2).all(|two| two[0] < two[1]) && pattern.entries.len() > 400);
    let workspace = Chain::workspace::<f64>();
    let mut evaluated = workspace;
    let q = vec![0.3; Chain::COORDINATES];
    Chain::default().evaluate(Subset::ALL, &Instant::at(0.2), &q, &q, &mut evaluated).unwrap();
    for &(place, value) in pattern.constants {
        assert_eq!((workspace.phi_q()[place], evaluated.phi_q()[place]), (value, value));
    }
    let revolute = pattern.entries.iter().position(|entry| *entry == (2, 0)).expect("a pin holds both bodies");
    assert!(pattern.constants.contains(&(revolute, -1.0)));
}

/// The third derivatives of a chain with different lengths, which loops read from arrays, agree with differences of q̈.
#[test]
fn the_jerk_of_a_long_chain_is_the_slope_of_its_acceleration() {
    let mut chain = Chain::default();
    (0..40).for_each(|k| chain.l[k] = 0.1 + 0.01 * (k * k % 7) as f64);
    let solver = chain.solver();
    let state = |t: f64| chain.state_at(&Instant::at(t)).unwrap();
    let h = 1e-4;
    let (before, after) = (state(0.7 - h), state(0.7 + h));
    let derivatives = solver.derivatives(&state(0.7), 3).unwrap();
    for (k, jerk) in derivatives.q[3].iter().enumerate() {
        let slope = (after.q_ddot[k] - before.q_ddot[k]) / (2.0 * h);
        assert!((jerk - slope).abs() < 1e-5 * (1.0 + slope.abs()), "{k}: {jerk} and {slope}");
    }
    assert!(derivatives.q[3].iter().any(|jerk| jerk.abs() > 1e-2));
}

/// A regular linear system with variable coefficients, whose condition number is 5 for any length.
#[mechanism]
#[coordinates(x[40])]
#[constraint(first: (3 + 0.1*sin(t))*x[0] + (1 + 0.1*cos(t))*x[1] = 1)]
#[constraint(row[i in 1..39]: (1 + 0.1*cos(t))*x[i-1] + (3 + 0.1*sin(t))*x[i] + (1 + 0.1*cos(t))*x[i+1] = 1)]
#[constraint(last: (3 + 0.1*sin(t))*x[39] + (1 + 0.1*cos(t))*x[38] = 1)]
struct Band;

#[test]
fn the_margin_of_a_system_does_not_shrink_with_its_size() {
    let state = Band.solver().state(&Instant::at(0.3)).unwrap();
    let planned = Planned::new(&Band, &Instant::at(0.3), &state.q).unwrap();
    assert!(planned.margins().iter().all(|margin| *margin > 0.1), "{:?}", planned.margins());
    assert!(planned.q().iter().zip(&state.q).all(|(a, b)| (a - b).abs() < 1e-14));
}
