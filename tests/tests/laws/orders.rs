//! Laws of derivatives of orders above the second.

use crate::motion::swept;
use kin_runtime::model::{Level, Model};
use kin_runtime::{Derivatives, MotionDerivatives, Options, SolveError, State};
use kin_tests::compare::{Differences, largest};
use kin_tests::stencil::Stencil;
use kin_tests::subject::{Setup, Subject};

/// The third and fourth derivatives of the inputs, by differences of their accelerations.
fn further(mechanism: &dyn Subject, t: f64) -> Vec<[f64; 2]> {
    let h = 1e-2;
    let samples: Vec<_> = (-3..=3).map(|k| mechanism.signals(t + f64::from(k) * h)).collect();
    (0..mechanism.model().inputs.len())
        .map(|input| {
            let [a, b, c, d, e, f, g] = std::array::from_fn(|k| samples[k][input].acceleration);
            let first = (45.0 * (e - c) - 9.0 * (f - b) + (g - a)) / (60.0 * h);
            let second = (270.0 * (e + c) - 27.0 * (f + b) + 2.0 * (g + a) - 490.0 * d) / (180.0 * h * h);
            [first, second]
        })
        .collect()
}

/// All derivatives up to the fourth; `None` where those of a supplied function are unknown, which must be the error
/// reported.
fn to_the_fourth(mechanism: &dyn Subject, state: &State) -> Option<Derivatives> {
    let model = mechanism.model();
    let further = further(mechanism, state.t);
    let further: Vec<&[f64]> = further.iter().map(|list| &list[..]).collect();
    match mechanism.solver().derivatives_with(state, 4, &further) {
        Ok(derivatives) => Some(derivatives),
        Err(SolveError::UnknownDerivative { order: 3, what: "function", name, known: 2, .. }) => {
            assert!(model.functions.contains(&name), "{name}");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// The third and fourth derivatives of q are the first and second derivatives of q̈.
pub(crate) fn third_and_fourth_are_derivatives(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let mut differences = Differences::new();
    for stencil in Stencil::several(from, to).map(Stencil::halved) {
        let states = swept(mechanism, &stencil.times(from)).states;
        let states = &states[1..];
        let middle = &states[Stencil::REACH];
        let Some(found) = to_the_fourth(mechanism, middle) else { return };
        assert_eq!([&middle.q, &middle.q_dot, &middle.q_ddot], [&found.q[0], &found.q[1], &found.q[2]]);
        if middle.degrees_of_freedom_left > 0 {
            return;
        }
        differences.at(format_args!("t = {}", middle.t));
        let scales = [largest(&found.q[3]), largest(&found.q[4])];
        for place in 0..model.coordinates.len() {
            let samples: Vec<f64> = states.iter().map(|state| state.q_ddot[place]).collect();
            let found = [found.q[3][place], found.q[4][place]];
            stencil.compare(&mut differences, model.coordinates[place].name, &samples, found, scales);
        }
    }
    differences.finish();
}

/// The highest order that is tested.
const HIGHEST: usize = 10;

/// Taylor's formula with all orders gives the neighbouring positions found by position analysis, and every order agrees
/// with that from a factorisation of the whole Φ_q. The unit of time is the step at which the highest orders are as
/// small as 1e-9 of the coordinates.
pub(crate) fn series_reach_the_motion(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let known = model.inputs.is_empty() && model.functions.is_empty();
    if !known || model.rows.iter().any(|row| row.level == Level::Velocity) {
        return;
    }
    let whole =
        mechanism.solver_with(Setup { options: Options { use_plan: false, ..Options::default() }, ..Setup::default() });
    for state in &swept(mechanism, &[from, from + 0.4 * (to - from)]) {
        if state.degrees_of_freedom_left > 0 {
            return;
        }
        let found = mechanism.solver().derivatives(state, HIGHEST).unwrap();
        let expected = whole.derivatives(state, HIGHEST).unwrap();
        assert!(!expected.by_plan && (!found.by_plan || model.plan.exists()));
        let size = largest(&state.q).max(1e-3);
        let factorials: Vec<f64> = (0..=HIGHEST)
            .scan(1.0, |f, k| {
                *f *= k.max(1) as f64;
                Some(*f)
            })
            .collect();
        let root = |k: usize| (1e-9 * size * factorials[k] / largest(&found.q[k])).powf(1.0 / k as f64);
        let h = (6..=HIGHEST).map(root).fold(0.1 * (to - from), f64::min);
        for (order, (found, expected)) in found.q.iter().zip(&expected.q).enumerate() {
            let part = h.powi(order as i32) / factorials[order];
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) * part;
            assert!(off <= 1e-12 * size, "order {order} at t = {}: {off:e} of {size:e}", state.t);
        }
        for h in [h, -h] {
            let term = |k: usize, place: usize| found.q[k][place] * h.powi(k as i32) / factorials[k];
            let series = (0..model.coordinates.len()).map(|place| (0..=HIGHEST).rev().map(|k| term(k, place)).sum());
            let series: Vec<f64> = series.collect();
            let reached = mechanism.solver().position(&(state.t + h).into(), &series).unwrap().q;
            for (place, (series, reached)) in series.iter().zip(&reached).enumerate() {
                let name = model.coordinates[place].name;
                assert!((series - reached).abs() <= 1e-9 * size, "{name} at {} + {h}: {series} {reached}", state.t);
            }
        }
    }
}

/// The name of every observable with its derivatives.
fn reported(model: &Model, motion: &MotionDerivatives) -> Vec<(String, Vec<f64>)> {
    let mut all = Vec::new();
    for (info, orders) in model.bodies.iter().zip(&motion.bodies) {
        for (k, name) in ["x", "y", "phi"].iter().enumerate() {
            all.push((format!("{}.{name}", info.name), orders.iter().map(|order| order[k]).collect()));
        }
    }
    for (info, orders) in model.points.iter().zip(&motion.points) {
        for (k, name) in ["x", "y"].iter().enumerate() {
            all.push((format!("{}.{name}", info.name), orders.iter().map(|order| order[k]).collect()));
        }
    }
    all.extend(model.defines.iter().zip(&motion.defines).map(|(info, orders)| (info.name.to_owned(), orders.clone())));
    for (info, quantities) in model.joints.iter().zip(&motion.joints) {
        all.extend(quantities.iter().map(|orders| (info.name.to_owned(), orders.clone())));
    }
    all.extend(model.conditions.iter().zip(&motion.conditions).map(|(i, orders)| (i.name.to_owned(), orders.clone())));
    assert_eq!(model.observables.len(), all.len());
    all
}

/// The reported quantities agree with the motion up to the second order, and their third and fourth derivatives are the
/// derivatives of the second.
pub(crate) fn reported_orders_are_derivatives(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    if model.observables.is_empty() {
        return;
    }
    let solver = mechanism.solver();
    let mut differences = Differences::new();
    for stencil in Stencil::several(from, to).map(Stencil::halved) {
        let states = swept(mechanism, &stencil.times(from)).states;
        let Some(middle) = to_the_fourth(mechanism, &states[1 + Stencil::REACH]) else { return };
        if states[0].degrees_of_freedom_left > 0 {
            return;
        }
        let motion = |derivatives: &Derivatives| {
            reported(model, &solver.motion_derivatives(derivatives).unwrap_or_else(|error| panic!("{error}")))
        };
        let samples: Vec<_> =
            states[1..].iter().map(|state| motion(&solver.derivatives(state, 2).expect("a solved state"))).collect();
        let found = motion(&middle);
        differences.at(format_args!("t = {}", middle.t));
        let scales =
            [3, 4].map(|order| found.iter().fold(largest(&middle.q[order]), |most, (_, o)| most.max(o[order].abs())));
        for (place, (name, orders)) in found.iter().enumerate() {
            assert_eq!(samples[Stencil::REACH][place].1[..], orders[..3], "{name}");
            let second: Vec<f64> = samples.iter().map(|sample| sample[place].1[2]).collect();
            stencil.compare(&mut differences, name, &second, [orders[3], orders[4]], scales);
        }
    }
    differences.finish();
}

/// Up to the second order, the reported quantities are those of the motion.
pub(crate) fn low_orders_are_the_motion(mechanism: &dyn Subject, from: f64, to: f64) {
    let solver = mechanism.solver();
    for state in &swept(mechanism, &[from, 0.5 * (from + to)]) {
        let motion = solver.motion(state).unwrap();
        let orders = solver.motion_derivatives(&solver.derivatives(state, 2).unwrap()).unwrap();
        let close =
            |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs() + largest(&state.q_ddot)), "{a} {b}");
        for (body, orders) in motion.bodies.iter().zip(&orders.bodies) {
            let expected = [
                [body.x, body.y, body.phi],
                [body.x_dot, body.y_dot, body.phi_dot],
                [body.x_ddot, body.y_ddot, body.phi_ddot],
            ];
            expected.iter().flatten().zip(orders.iter().flatten()).for_each(|(a, b)| close(*a, *b));
        }
        for (point, orders) in motion.points.iter().zip(&orders.points) {
            let expected = [point.r, point.v, point.a];
            expected.iter().flatten().zip(orders.iter().flatten()).for_each(|(a, b)| close(*a, *b));
        }
        let rates = motion.defines.iter().chain(motion.joints.iter().flatten());
        for (rates, orders) in rates.zip(orders.defines.iter().chain(orders.joints.iter().flatten())) {
            [rates.value, rates.rate, rates.acceleration].iter().zip(orders).for_each(|(a, b)| close(*a, *b));
        }
        for (g, orders) in motion.conditions.iter().zip(&orders.conditions) {
            [g.value, g.rate, g.acceleration].iter().zip(orders).for_each(|(a, b)| close(*a, *b));
        }
    }
}
