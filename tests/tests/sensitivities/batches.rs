//! Derivatives of batches compared with those of single states.

use kin_runtime::batch::{
    BatchError, Column, Modes, Problems, SensitivitySolutions, Solutions, always, sensitivities, solve,
};
use kin_runtime::model::Level;
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Measure, Mechanism, Signal, State, mechanism};
use kin_tests::mechanisms::{FourbarLectureMid, loaded};

/// Configurations of a batch: more than one block, the last one not full.
const COUNT: usize = 11;

/// In a batch of equal configurations each has the values and derivatives of its state.
pub(crate) fn are_those_of_the_state(mechanism: &dyn crate::varied::Varied, state: &State) {
    let model = mechanism.model();
    let mut measures = Measure::all(model);
    measures.retain(|measure| measure.source(model).is_some());
    let all: Vec<usize> = (0..model.parameters.len()).collect();
    let parameters: Vec<Column> = mechanism.parameters().into_iter().map(Column::Shared).collect();
    let start: Vec<Column> = state.q.iter().map(|q| Column::Shared(*q)).collect();
    let inputs: Vec<Signal<Column>> = state.inputs.iter().map(|input| input.map(Column::Shared)).collect();
    let (t, modes) = (Column::Shared(state.t), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &inputs, modes, start: &start };
    let mut out = SensitivitySolutions::new(COUNT, measures.len(), all.len());
    let solved = match mechanism.batch(&problems, &measures, &all, &mut out) {
        Err(BatchError::NoPlan(_)) => return assert!(model.plan.absent.is_some()),
        Err(BatchError::NoSensitivities(why)) => {
            let integrated = model.rows.iter().any(|row| row.level == Level::Velocity);
            return assert!(integrated || model.plan.has_redundant_rows(), "{}: {why}", model.name);
        }
        other => other.unwrap(),
    };
    if !solved.into_iter().all(|solved| solved) {
        return assert!(out.solved().all(|solved| !solved));
    }
    assert!(out.solved().all(|solved| solved), "{}", model.name);
    let values = mechanism.measure(state, &measures);
    let by = mechanism.measure_sensitivities(state, &measures, &all);
    for (k, measure) in measures.iter().enumerate() {
        let close = |found: f64, exact: f64, what: &dyn std::fmt::Display| {
            let size = 1.0 + by[k].iter().chain([&values[k]]).fold(0.0, |size: f64, x| size.max(x.abs()));
            let same = (found.is_nan() && exact.is_nan()) || (found - exact).abs() <= 1e-8 * size;
            assert!(same, "{}, {} {what}: {found} instead of {exact}", model.name, measure.name());
        };
        out.value(k).for_each(|found| close(found, values[k], &"itself"));
        for (&p, &exact) in all.iter().zip(&by[k]) {
            out.by(k, p).for_each(|found| close(found, exact, &model.parameters[p].name));
        }
    }
}

/// A crank with a load that an input says, of a length that varies, with more parameters than are taken at once.
#[mechanism]
#[input(load)]
#[bodies(crank, rod, slider)]
#[point(tip = rod @ (tip_x, tip_y))]
#[revolute(O: ground @ (0, o), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[guess(rod.phi = -0.1, slider.x = 0.9)]
#[gravity(0, -9.81)]
#[mass(rod @ (0.3, 0.01), mass = m, inertia = j)]
#[force(press: slider @ (0, 0), (-load, 0))]
#[derive(Clone, Copy)]
struct Crank {
    #[param(0.2)]
    r: f64,
    #[param(0.7)]
    l: f64,
    #[param(0.02)]
    o: f64,
    #[param(0.3)]
    tip_x: f64,
    #[param(0.1)]
    tip_y: f64,
    #[param(0.1)]
    phi0: f64,
    #[param(3)]
    omega: f64,
    #[param(0.4)]
    m: f64,
    #[param(0.01)]
    j: f64,
}

#[test]
fn every_configuration_has_derivatives_of_its_own() {
    let names = ["tip.x", "tip.speed", "slider.x_ddot", "drive.effort", "B.force", "rod.phi", "load", "t"];
    let measures: Vec<Measure> = names.iter().map(|name| Measure::named(Crank::model(), name).unwrap()).collect();
    // One of them does not close.
    let lengths: Vec<f64> = (0..COUNT).map(|k| if k == 5 { 40.0 } else { 0.1 + 0.01 * k as f64 }).collect();
    let loads: Vec<f64> = (0..COUNT).map(|k| 10.0 * k as f64).collect();
    let mut crank = Crank::default();
    let mut parameters: Vec<Column> = crank.parameters::<f64>().into_iter().map(Column::Shared).collect();
    parameters[0] = Column::Each(&lengths);
    let still = Column::Shared(0.0);
    let inputs = [Signal { value: Column::Each(&loads), rate: still, acceleration: still }];
    let start = [0.0, 0.0, 0.9, 0.1, 0.0, -0.1, 0.9, 0.0, 0.0].map(Column::Shared);
    let (t, modes) = (Column::Shared(0.3), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &inputs, modes, start: &start };
    let mut solutions = Solutions::<Crank>::new(COUNT);
    solve(&crank, Depth::Acceleration, &problems, &mut solutions, &always).unwrap();
    let wanted = [8, 0, 1, 2, 3, 4, 5, 6, 7];
    let mut out = SensitivitySolutions::new(COUNT, names.len(), wanted.len());
    sensitivities(&crank, &problems, &solutions, &measures, &wanted, &mut out, &always).unwrap();
    for (k, solved) in out.solved().enumerate() {
        assert_eq!(k != 5, solved);
        if !solved {
            assert!((0..names.len()).all(|m| out.value(m).nth(k) == Some(0.0) && out.by(m, 0).nth(k) == Some(0.0)));
            continue;
        }
        crank.r = lengths[k];
        let inputs = [Signal::constant(loads[k])];
        let q: Vec<f64> = (0..9).map(|i| solutions.q(i).nth(k).unwrap()).collect();
        let solver = crank.solver();
        let state = solver.state_from(&Instant { t: 0.3, inputs: &inputs }, &q).unwrap();
        let values = solver.measure(&state, &measures).unwrap();
        let by = solver.measure_sensitivities(&state, &measures, &wanted).unwrap();
        for m in 0..names.len() {
            let found: Vec<f64> = (0..wanted.len()).map(|p| out.by(m, p).nth(k).unwrap()).collect();
            let pairs = found.iter().zip(&by[m]).chain([(&values[m], &values[m])]);
            let size = pairs.clone().fold(1.0, |size: f64, (_, x)| size.max(x.abs()));
            assert!(pairs.clone().all(|(a, b)| (a - b).abs() <= 1e-10 * size), "{}: {found:?} {:?}", names[m], by[m]);
            assert!((out.value(m).nth(k).unwrap() - values[m]).abs() <= 1e-10 * size);
        }
    }
    // Values alone.
    let mut values = SensitivitySolutions::new(COUNT, names.len(), 0);
    sensitivities(&crank, &problems, &solutions, &measures, &[], &mut values, &always).unwrap();
    assert!((0..names.len()).all(|m| values.value(m).eq(out.value(m))));
    // What does not fit.
    let ask = |measures: &[Measure], wanted: &[usize], out: &mut SensitivitySolutions| {
        sensitivities(&crank, &problems, &solutions, measures, wanted, out, &always).unwrap_err()
    };
    assert!(matches!(ask(&measures[1..], &wanted, &mut out), BatchError::Length(_)));
    assert!(matches!(ask(&measures, &wanted[1..], &mut out), BatchError::Length(_)));
    let mut short = SensitivitySolutions::new(COUNT - 1, names.len(), wanted.len());
    assert!(matches!(ask(&measures, &wanted, &mut short), BatchError::Length(_)));
    let mut one = SensitivitySolutions::new(COUNT, 1, 1);
    let unknown = BatchError::UnknownParameter { index: 9, parameters: 9 };
    assert_eq!(unknown, ask(&measures[..1], &[9], &mut one));
    assert_eq!("no parameter 9 among 9", unknown.to_string());
    let ratio = [Measure::named(Crank::model(), "tip.x/drive").unwrap()];
    assert!(matches!(ask(&ratio, &[0], &mut one), BatchError::NoSensitivities(_)));
    assert_eq!("sensitivities of 11 configurations", out.to_string());
}

/// The law for a mechanism with loads and the same without.
#[test]
fn forces_of_a_batch_are_those_of_the_state() {
    let mechanism = loaded::FourbarLectureMid::default();
    are_those_of_the_state(&mechanism, &mechanism.solver().state(&0.4.into()).unwrap());
    let plain = FourbarLectureMid::default();
    are_those_of_the_state(&plain, &plain.solver().state(&0.4.into()).unwrap());
}
