//! The results of `Planned` for controllers, a point with its Jacobian with respect to the inputs and forces, agree
//! with the solver.

use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Signal};
use kin_tests::mechanisms::{MeasuredExcavator, loaded, signals};

fn excavator_at(inputs: &[Signal], start: &[f64]) -> [[f64; 2]; 3] {
    let excavator = MeasuredExcavator;
    let solver = excavator.solver();
    let state = solver.state_from(&Instant { t: 0.0, inputs }, start).unwrap();
    let tip = solver.motion(&state).unwrap()[MeasuredExcavator::tip];
    [tip.r, tip.v, tip.a]
}

#[test]
fn a_point_and_its_jacobian_are_those_of_the_solver() {
    let excavator = MeasuredExcavator;
    let mut inputs: Vec<Signal> = signals::<MeasuredExcavator>(0.0);
    for (k, input) in inputs.iter_mut().enumerate() {
        (input.rate, input.acceleration) = (0.1 - 0.07 * k as f64, 0.3 + 0.1 * k as f64);
    }
    let at = Instant { t: 0.0, inputs: &inputs };
    let state = excavator.state_at(&at).unwrap();
    let planned = Planned::new(&excavator, &at, &state.q).unwrap();
    let found = planned.point(MeasuredExcavator::tip).unwrap();
    let exact = excavator_at(&inputs, &state.q);
    for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
        assert!((found - exact).abs() < 1e-11 * (1.0 + exact.abs()), "{found} instead of {exact}");
    }
    let mut jacobian = [[0.0; 2]; MeasuredExcavator::INPUTS];
    planned.point_jacobian(MeasuredExcavator::tip, &mut jacobian).unwrap();
    const STEP: f64 = 1e-5;
    for (k, column) in jacobian.iter().enumerate() {
        let moved = |step: f64| {
            let mut inputs = inputs.clone();
            inputs[k].value += step;
            excavator_at(&inputs, &state.q)[0]
        };
        let (after, before) = (moved(STEP), moved(-STEP));
        for c in 0..2 {
            let difference = (after[c] - before[c]) / (2.0 * STEP);
            assert!((column[c] - difference).abs() < 1e-6, "input {k}: {column:?} instead of {difference}");
        }
    }
    // The velocity is the sum of the columns times the rates of the inputs.
    for (c, speed) in found[1].iter().enumerate() {
        let sum: f64 = jacobian.iter().zip(&inputs).map(|(column, input)| column[c] * input.rate).sum();
        assert!((sum - speed).abs() < 1e-11, "{sum} instead of {speed}");
    }
    assert!(planned.point_jacobian(MeasuredExcavator::tip, &mut [[0.0; 2]; 1]).is_err());
}

#[test]
fn forces_of_a_tick_are_those_of_the_solver() {
    let four_bar = loaded::FourbarLectureMid::default();
    let state = four_bar.state_at(&Instant::at(0.0)).unwrap();
    let mut planned = Planned::new(&four_bar, &Instant::at(0.0), &state.q).unwrap();
    planned.at(&Instant::at(0.1)).unwrap();
    let model = loaded::FourbarLectureMid::model().forces.unwrap();
    let mut numbers = vec![0.0; model.count];
    assert_eq!(Some(model), planned.forces(&mut numbers).unwrap());
    let state = four_bar.solver().state_from(&Instant::at(0.1), planned.q()).unwrap();
    let forces = four_bar.solver().forces(&state).unwrap();
    let effort = numbers[model.efforts[0].place];
    assert!((effort - forces.efforts[0].effort.unwrap()).abs() < 1e-11 * effort.abs());
    assert!(planned.forces(&mut []).is_err());
}
