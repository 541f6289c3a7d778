//! Forces of batches compared with those of single states.

use crate::machines::*;
use kin_runtime::batch::{
    BatchError, Column, ForceSolutions, Modes, Motions, Problems, SensitivitySolutions, Solutions, Sweeps, always,
    forces, sensitivities, solve, sweep,
};
use kin_runtime::model::ForceModel;
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Lanes, Measure, Mechanism, PlanError, Planned, Signal, mechanism};
use kin_tests::mechanisms::loaded;

/// A crank with a load that an input says, of a length that varies.
#[mechanism]
#[input(load)]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 3 * t)]
#[guess(rod.phi = -0.1, slider.x = 0.9)]
#[gravity(0, -9.81)]
#[mass(rod @ (0.3, 0.01), mass = 2*r, inertia = 0.01)]
#[force(press: slider @ (0, 0), (-load, 0))]
struct Crank {
    #[param(0.2)]
    r: f64,
}

const COUNT: usize = 21;

fn crank_lengths() -> Vec<f64> {
    // One of them does not close.
    (0..COUNT).map(|k| if k == 5 { 40.0 } else { 0.1 + 0.01 * k as f64 }).collect()
}

#[test]
fn a_batch_has_the_forces_of_its_states() {
    let (lengths, loads) = (crank_lengths(), (0..COUNT).map(|k| 10.0 * k as f64).collect::<Vec<_>>());
    let start = [0.0, 0.0, 0.9, 0.1, 0.0, -0.1, 0.9, 0.0, 0.0].map(Column::Shared);
    let parameters = [Column::Each(&lengths)];
    let still = Column::Shared(0.0);
    let inputs = [Signal { value: Column::Each(&loads), rate: still, acceleration: still }];
    let modes = Modes::OfStart;
    let problems = Problems { parameters: &parameters, t: Column::Shared(0.3), inputs: &inputs, modes, start: &start };
    let mut solutions = Solutions::<Crank>::new(COUNT);
    let mut out = ForceSolutions::new(COUNT);
    solve(&Crank::default(), Depth::Acceleration, &problems, &mut solutions, &always).unwrap();
    forces(&Crank::default(), &problems, &solutions, &mut out, &always).unwrap();
    let model = Crank::model().forces.unwrap();
    let drive = model.effort("drive").unwrap().place;
    let pin = model.reaction("B").unwrap().force().unwrap();
    let columns = [drive, pin, pin + 1, ForceModel::KINETIC, ForceModel::DRIVER_POWER];
    let columns: Vec<Vec<f64>> = columns.iter().map(|place| out.numbers(*place).collect()).collect();
    let mut compared = 0;
    for (k, solved) in solutions.solved().enumerate() {
        if !solved {
            assert!(columns.iter().all(|column| column[k] == 0.0));
            continue;
        }
        let crank = Crank { r: lengths[k] };
        let inputs = [Signal::constant(loads[k])];
        let q: Vec<f64> = (0..9).map(|i| solutions.q(i).nth(k).unwrap()).collect();
        let state = crank.solver().state_from(&Instant { t: 0.3, inputs: &inputs }, &q).unwrap();
        let single = crank.solver().forces(&state).unwrap();
        let [x, y] = single.reaction("B").unwrap().force.unwrap();
        let exact = [single.effort("drive").unwrap(), x, y, single.kinetic, single.driver_power];
        for (column, exact) in columns.iter().zip(exact) {
            assert!((column[k] - exact).abs() <= 1e-11 * (10.0 + exact.abs()), "{k}: {} {exact}", column[k]);
        }
        compared += 1;
    }
    assert_eq!(COUNT - 1, compared);
    let mut short = ForceSolutions::new(COUNT - 1);
    assert!(matches!(
        forces(&Crank::default(), &problems, &solutions, &mut short, &always),
        Err(BatchError::Length(_))
    ));
}

#[test]
fn a_sweep_of_a_batch_scores_efforts() {
    let lengths: Vec<f64> = (0..COUNT).map(|k| 0.1 + 0.01 * k as f64).collect();
    let times: Vec<f64> = (0..=60).map(|k| 0.02 * f64::from(k)).collect();
    let loads: Vec<f64> = times.iter().map(|t| 100.0 * t).collect();
    let start = [0.0, 0.0, 0.0, 0.1, 0.0, -0.1, 0.9, 0.0, 0.0].map(Column::Shared);
    let load = Signal { value: Column::Each(&loads), rate: Column::Shared(0.0), acceleration: Column::Shared(0.0) };
    let sweeps = Sweeps {
        parameters: &[Column::Each(&lengths)],
        times: &times,
        inputs: &[load],
        modes: Modes::OfStart,
        start: &start,
    };
    let model = Crank::model().forces.unwrap();
    let drive = model.effort("drive").unwrap().place;
    let mut out = Motions::new(COUNT, Lanes::from(0.0));
    let crank = Crank::default();
    sweep(&crank, &sweeps, &mut out, &always, |sum: &mut Lanes, moment| {
        let mut numbers = vec![Lanes::default(); model.count];
        moment.forces(&crank, &mut numbers).unwrap();
        *sum = moment.keep(*sum, *sum + numbers[drive] * numbers[drive]);
    })
    .unwrap();
    for (k, score) in out.scores(|sum| *sum).enumerate() {
        let crank = Crank { r: lengths[k] };
        let mut exact = 0.0;
        let inputs = |t: f64, out: &mut [Signal]| out[0] = Signal::constant(100.0 * t);
        let solver = crank.solver().with_inputs(&inputs);
        for state in &solver.sweep(&times).unwrap().states {
            exact += solver.forces(state).unwrap().effort("drive").unwrap().powi(2);
        }
        assert!((score - exact).abs() <= 1e-9 * exact, "{k}: {score} {exact}");
    }
}

#[test]
fn a_mechanism_without_closed_forms_of_forces_says_so() {
    let start = vec![Column::Shared(0.0); 15];
    let problems =
        Problems { parameters: &[], t: Column::Shared(0.0), inputs: &[], modes: Modes::OfStart, start: &start };
    let solutions = Solutions::<Parallelogram>::new(1);
    let failed = forces(&Parallelogram, &problems, &solutions, &mut ForceSolutions::new(1), &always);
    assert!(matches!(failed, Err(BatchError::NoForces(_))), "{failed:?}");
    let words = failed.unwrap_err().to_string();
    assert!(words.contains("redundant rows share the load") && words.contains("`Solver::forces`"), "{words}");
    assert!(loaded::FourbarLectureMid::model().forces.unwrap().solved);
}

/// An arm with a spring, the ends of which coincide at one angle.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(motor: arm.phi = t)]
#[spring(S: ground @ (a, 0), arm @ (1, 0), stiffness = 10, free_length = 0.1)]
struct Sprung {
    #[param(1)]
    a: f64,
}

/// Where a force is not defined, there is no number: `Solver::forces` has an error there.
#[test]
fn a_spring_without_length_has_no_forces() {
    let (places, times) = ([1.0, 0.9, 1.0], [0.0, 0.0, 0.5]);
    let start = [Column::Shared(0.0); 3];
    let parameters = [Column::Each(&places)];
    let (t, modes) = (Column::Each(&times), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
    let (mut solutions, mut out) = (Solutions::<Sprung>::new(3), ForceSolutions::new(3));
    solve(&Sprung::default(), Depth::Acceleration, &problems, &mut solutions, &always).unwrap();
    assert!(solutions.solved().all(|solved| solved));
    forces(&Sprung::default(), &problems, &solutions, &mut out, &always).unwrap();
    assert!(out.solved().eq([false, true, true]));
    let model = Sprung::model().forces.unwrap();
    for place in 0..model.count {
        assert!(out.numbers(place).all(f64::is_finite), "{place}");
        assert_eq!(Some(0.0), out.numbers(place).next());
    }
    let torque = out.numbers(model.effort("motor").unwrap().place).nth(2).unwrap();
    let length = 2.0 * 0.25_f64.sin();
    // The arm of the force about O is cos(t/2).
    assert!((torque - 10.0 * (length - 0.1) * 0.25_f64.cos()).abs() < 1e-12, "{torque}");

    let sprung = Sprung::default();
    let planned = Planned::new(&sprung, &Instant::at(0.0), &[0.0; 3]).unwrap();
    let error = planned.forces(&mut vec![0.0; model.count]);
    assert!(matches!(error, Err(PlanError::NonFinite { what: "forces", .. })), "{error:?}");

    let measures: Vec<Measure> =
        ["motor.effort", "S.tension"].map(|name| Measure::named(Sprung::model(), name).unwrap()).into();
    let mut by = SensitivitySolutions::new(3, 2, 1);
    sensitivities(&Sprung::default(), &problems, &solutions, &measures, &[0], &mut by, &always).unwrap();
    assert!(by.solved().eq([false, true, true]));
    assert!((0..2).all(|measure| by.value(measure).all(f64::is_finite)));
}

/// A pair of gears.
#[mechanism]
#[body(motor, x = 0, y = 0)]
#[body(wheel, x = 1, y = 0)]
#[gear(pair: motor, wheel, radii = (r1, r2))]
#[constraint(count: counter = 2 * wheel.phi)]
#[coordinates(counter)]
#[driver(drive: motor.phi = t)]
#[torque(load: wheel = -3 * dot(wheel.phi))]
struct Gears {
    #[param(1)]
    r1: f64,
    #[param(2)]
    r2: f64,
}

/// Couples have closed forms like other forces.
#[test]
fn batches_have_the_couples_of_gears() {
    let start = [Column::Shared(0.0); 3];
    let parameters = [Column::Shared(1.0), Column::Shared(2.0)];
    let (t, modes) = (Column::Shared(0.4), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
    let gears = Gears::default();
    let mut solutions = Solutions::<Gears>::new(1);
    solve(&gears, Depth::Acceleration, &problems, &mut solutions, &always).unwrap();
    let names = ["pair.torque_motor", "pair.torque_wheel", "pair.torque_ground", "count.generalized"];
    let measures: Vec<Measure> = names.map(|name| Measure::named(Gears::model(), name).unwrap()).into();
    let mut by = SensitivitySolutions::new(1, measures.len(), 2);
    sensitivities(&gears, &problems, &solutions, &measures, &[0, 1], &mut by, &always).unwrap();
    // φ̇ of the wheel is −r1/r2, and the couple on it balances the load.
    let exact = [(-0.75, [-1.5, 0.75]), (-1.5, [-1.5, 0.75]), (2.25, [3.0, -1.5]), (0.0, [0.0, 0.0])];
    for (k, (value, slopes)) in exact.into_iter().enumerate() {
        assert!((by.value(k).next().unwrap() - value).abs() < 1e-12, "{}", names[k]);
        for (parameter, slope) in slopes.into_iter().enumerate() {
            assert!((by.by(k, parameter).next().unwrap() - slope).abs() < 1e-12, "{} {parameter}", names[k]);
        }
    }
}
