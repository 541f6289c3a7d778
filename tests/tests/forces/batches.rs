//! Forces of batches compared with those of single states.

use crate::machines::*;
use kin_runtime::batch::{
    BatchError, Column, ForceSolutions, Modes, Motions, Problems, Solutions, Sweeps, always, forces, solve, sweep,
};
use kin_runtime::model::ForceModel;
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, Signal, mechanism};
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
