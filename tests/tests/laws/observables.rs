//! Laws of the quantities that a mechanism reports besides q: poses, points, defines, joint quantities and ratios.

use crate::motion::swept;
use kin_runtime::model::{Level, Model, Observable, Point, RowInfo};
use kin_runtime::{Instant, Motion, Signal, State};
use kin_tests::compare::{Differences, largest};
use kin_tests::stencil::Stencil;
use kin_tests::subject::Subject;

/// The name of every observable with its value, rate and acceleration.
fn reported(model: &Model, motion: &Motion) -> Vec<(String, [f64; 3])> {
    let mut all = Vec::new();
    for (info, body) in model.bodies.iter().zip(&motion.bodies) {
        all.push((format!("{}.x", info.name), [body.x, body.x_dot, body.x_ddot]));
        all.push((format!("{}.y", info.name), [body.y, body.y_dot, body.y_ddot]));
        all.push((format!("{}.phi", info.name), [body.phi, body.phi_dot, body.phi_ddot]));
    }
    for (info, point) in model.points.iter().zip(&motion.points) {
        for (axis, name) in ["x", "y"].iter().enumerate() {
            all.push((format!("point {}.{name}", info.name), [point.r[axis], point.v[axis], point.a[axis]]));
        }
    }
    for (info, define) in model.defines.iter().zip(&motion.defines) {
        all.push((format!("define {}", info.name), [define.value, define.rate, define.acceleration]));
    }
    for (info, rates) in model.joints.iter().zip(&motion.joints) {
        for (quantity, rates) in info.quantities.iter().zip(rates) {
            let name = format!("{} of joint {}", quantity.name, info.name);
            all.push((name, [rates.value, rates.rate, rates.acceleration]));
        }
    }
    for (info, g) in model.conditions.iter().zip(&motion.conditions) {
        all.push((format!("condition {}", info.name), [g.value, g.rate, g.acceleration]));
    }
    assert_eq!(model.observables.len(), all.len(), "{:?}", model.observables);
    all
}

/// Rates and accelerations of all observables are the derivatives of their values.
pub(crate) fn observables_are_differentiated(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    if model.observables.is_empty() {
        return;
    }
    let mut differences = Differences::new();
    for stencil in Stencil::several(from, to) {
        let trajectory = swept(mechanism, &stencil.times(from));
        let states = &trajectory.states[1..];
        let middle = &states[Stencil::REACH];
        if middle.degrees_of_freedom_left > 0 {
            return;
        }
        let samples: Vec<_> = states
            .iter()
            .map(|state| reported(model, &mechanism.solver().motion(state).expect("a solved state")))
            .collect();
        differences.at(format_args!("t = {}", middle.t));
        let (slow, slower) = (largest(&middle.q_dot), largest(&middle.q_ddot));
        for (place, (name, found)) in samples[Stencil::REACH].iter().enumerate() {
            let values: Vec<f64> = samples.iter().map(|sample| sample[place].1[0]).collect();
            stencil.compare(&mut differences, name, &values, [found[1], found[2]], [slow, slower]);
        }
    }
    differences.finish();
}

/// ∂r/∂q · q̇ is the velocity of a point, where its position does not depend on time explicitly.
pub(crate) fn point_jacobians_give_velocities(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let solver = mechanism.solver();
    for state in &swept(mechanism, &[from, 0.5 * (from + to)]) {
        let motion = solver.motion(state).unwrap();
        for (place, point) in model.points.iter().enumerate() {
            let jacobian = solver.point_jacobian(&state.instant(), &state.q, Point(place)).unwrap();
            for (row, expected) in jacobian.iter().zip(motion.points[place].v) {
                let terms: Vec<f64> = row.iter().zip(&state.q_dot).map(|(entry, rate)| entry * rate).collect();
                let found = terms.iter().sum::<f64>();
                let tolerance = 1e-13 * largest(&terms).max(1.0);
                assert!((found - expected).abs() <= tolerance, "{}: {found} and {expected}", point.name);
            }
        }
    }
    let named = model.observables.iter().filter(|o| matches!(o, Observable::Point { .. })).count();
    assert_eq!(2 * model.points.len(), named);
}

/// True for a row of a joint that depends on a moving held coordinate: it is rheonomic and not driving.
fn is_moved(row: &RowInfo) -> bool {
    row.rheonomic && !row.driving
}

/// The product of Φ_q and a vector.
fn times_phi_q(mechanism: &dyn Subject, state: &State, vector: &[f64]) -> Vec<f64> {
    let model = mechanism.model();
    let phi_q = mechanism.jacobian(&state.instant(), &state.q).unwrap();
    let mut product = vec![0.0; model.rows.len()];
    for (&(row, column), entry) in model.constraint_pattern.entries.iter().zip(&phi_q) {
        product[row] += entry * vector[column];
    }
    product
}

/// The contributions of the driving rows to q̇ add up to q̇, except for the contribution of moving held coordinates.
/// That one only appears in the rows of the joints that these coordinates move.
pub(crate) fn velocity_ratios_add_up(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let driving = model.rows.iter().filter(|row| row.driving).count();
    let mut differences = Differences::new();
    for state in &swept(mechanism, &[from, 0.5 * (from + to)]) {
        let ratios = mechanism.solver().velocity_ratios(state).unwrap().drivers;
        assert_eq!(driving, ratios.len());
        let sum: Vec<f64> =
            (0..model.coordinates.len()).map(|k| ratios.iter().map(|ratio| ratio.q_dot[k]).sum()).collect();
        differences.at(format_args!("t = {}", state.t));
        if model.rows.iter().any(is_moved) {
            let rest = state.q_dot.iter().zip(&sum).map(|(whole, shares)| whole - shares);
            let rest = times_phi_q(mechanism, state, &rest.collect::<Vec<_>>());
            let phi_t = mechanism.time_derivative(&state.instant(), &state.q).unwrap();
            let expected = model.rows.iter().zip(&phi_t);
            let expected: Vec<f64> = expected.map(|(row, phi_t)| if is_moved(row) { -phi_t } else { 0.0 }).collect();
            let name = |place: usize| model.rows[place].name;
            differences.vector("Φ_q times the rest", name, &expected, &rest, 1e-11 * largest(&state.q_dot).max(1.0));
            continue;
        }
        let name = |place: usize| model.coordinates[place].name;
        differences.vector("sum of shares", name, &state.q_dot, &sum, 1e-11 * largest(&state.q_dot));
        if let [only] = &ratios[..] {
            differences.vector(
                "only share",
                name,
                &state.q_ddot,
                &only.q_ddot,
                1e-10 * largest(&state.q_ddot).max(1.0),
            );
        }
    }
    differences.finish();
}

/// ∂q/∂u and ∂²q/∂u² of every input agree with differences of neighbouring configurations. The contributions of the
/// inputs add up to q̇ where nothing depends on time explicitly.
pub(crate) fn input_ratios_are_derivatives(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let solver = mechanism.solver();
    let mut differences = Differences::new();
    let name = |place: usize| model.coordinates[place].name;
    for state in &swept(mechanism, &[from, 0.5 * (from + to)]) {
        let ratios = solver.velocity_ratios(state).unwrap().inputs;
        assert_eq!(model.inputs.len(), ratios.len());
        // With rows of velocity level, there are no neighbouring configurations to compare with.
        let holonomic = model.rows.iter().all(|row| row.level == Level::Position);
        for (k, ratio) in ratios.iter().enumerate().filter(|_| holonomic) {
            let h = 2e-3;
            let samples: Vec<Vec<f64>> = (-3..=3)
                .map(|shift| {
                    let mut inputs = state.inputs.clone();
                    inputs[k].value += f64::from(shift) * h;
                    solver.position(&Instant { t: state.t, inputs: &inputs }, &state.q).unwrap().q
                })
                .collect();
            differences.at(format_args!("t = {}, input {}", state.t, ratio.name));
            for (place, (first_ratio, second_ratio)) in ratio.first.iter().zip(&ratio.second).enumerate() {
                let [a, b, c, d, e, f, g] = std::array::from_fn(|sample| samples[sample][place]);
                let first = (45.0 * (e - c) - 9.0 * (f - b) + (g - a)) / (60.0 * h);
                let second = (270.0 * (e + c) - 27.0 * (f + b) + 2.0 * (g + a) - 490.0 * d) / (180.0 * h * h);
                let sizes = [largest(&ratio.first).max(1.0), largest(&ratio.second).max(1.0)];
                differences.number(format_args!("∂{}", name(place)), first, *first_ratio, 1e-9 * sizes[0]);
                differences.number(format_args!("∂²{}", name(place)), second, *second_ratio, 1e-6 * sizes[1]);
            }
        }
        let still: Vec<Signal> = state.inputs.iter().map(|u| Signal::constant(u.value)).collect();
        let rest = solver.velocity(&Instant { t: state.t, inputs: &still }, &state.q).unwrap();
        let sum = |k: usize| rest[k] + ratios.iter().map(|ratio| ratio.q_dot[k]).sum::<f64>();
        let sum: Vec<f64> = (0..model.coordinates.len()).map(sum).collect();
        differences.at(format_args!("t = {}", state.t));
        differences.vector("sum of shares", name, &state.q_dot, &sum, 1e-11 * largest(&state.q_dot).max(1.0));
    }
    differences.finish();
}
