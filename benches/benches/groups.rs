//! q, q̇, q̈ in small steps for a group without a closed form: Newton's iteration on the few unknowns of the plan
//! compared with Newton's iteration on all coordinates. `cargo bench -p kin-benches --bench groups`.

use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_benches::robot::Robot;
use kin_runtime::nalgebra::{SMatrix, SVector};
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Mechanism, Subset, Workspace};
use std::f64::consts::TAU as TURN;
use std::hint::black_box;
use std::ops::ControlFlow;

const STEPS: usize = 360;
const N: usize = 21;

type Vector = [f64; N];

/// A state: q, q̇, q̈ and the time.
#[derive(Clone)]
struct Place {
    q: Vector,
    q_dot: Vector,
    q_ddot: Vector,
    t: f64,
}

impl Place {
    fn predicted(&self, t: f64) -> Vector {
        let h = t - self.t;
        core::array::from_fn(|k| self.q[k] + h * (self.q_dot[k] + 0.5 * h * self.q_ddot[k]))
    }
}

/// Newton's iteration from the prediction, with a dense 21×21 LU and generated Φ, Φ_q and γ.
fn newton(robot: &Robot, place: &mut Place, workspace: &mut Workspace<Robot>, t: f64) {
    let entries = Robot::model().constraint_pattern.entries;
    let at = Instant::at(t);
    let mut q = place.predicted(t);
    let evaluate = |subset, q: &Vector, q_dot: &Vector, workspace: &mut Workspace<Robot>| {
        robot.evaluate(subset, &at, q, q_dot, workspace).expect("21 coordinates");
    };
    let factorised = |workspace: &Workspace<Robot>| {
        let mut matrix = SMatrix::<f64, N, N>::zeros();
        entries.iter().zip(workspace.phi_q()).for_each(|(&(row, column), &entry)| matrix[(row, column)] = entry);
        matrix.lu()
    };
    for _ in 0..8 {
        evaluate(Subset::POSITION, &q, &place.q_dot, workspace);
        let phi = SVector::<f64, N>::from_row_slice(workspace.phi());
        let Some(step) = factorised(workspace).solve(&phi) else { return };
        q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
        if step.amax() < 1e-9 {
            break;
        }
    }
    evaluate(Subset::VELOCITY, &q, &place.q_dot, workspace);
    let lu = factorised(workspace);
    let Some(q_dot) = lu.solve(&-SVector::<f64, N>::from_row_slice(workspace.phi_t())) else { return };
    place.q_dot.copy_from_slice(q_dot.as_slice());
    evaluate(Subset::GAMMA, &q, &place.q_dot, workspace);
    let Some(q_ddot) = lu.solve(&SVector::<f64, N>::from_row_slice(workspace.gamma())) else { return };
    place.q_ddot.copy_from_slice(q_ddot.as_slice());
    (place.q, place.t) = (q, t);
}

/// The plan at t from this start of its iteration.
fn by_plan(robot: &Robot, place: &mut Place, margins: &mut [f64], t: f64, start: &Vector) {
    let Place { q, q_dot, q_ddot, .. } = place;
    let solved = Solved { q, q_dot, q_ddot, margins };
    robot.solve_with(&[], &Instant::at(t), &[], start, Depth::Acceleration, solved).expect("21 coordinates");
    place.t = t;
}

fn main() {
    let robot = Robot;
    let state = robot.solver().state(&Instant::at(0.0)).expect("it closes at t = 0");
    let array = |v: &[f64]| -> Vector { v.try_into().expect("21 coordinates") };
    let first = Place { q: array(&state.q), q_dot: array(&state.q_dot), q_ddot: array(&state.q_ddot), t: 0.0 };
    let [mut dense, mut planned, mut from_last, mut from_guess] = [(); 4].map(|()| Placed::new(|| first.clone()));
    let mut workspace = Placed::new(Robot::workspace::<f64>);
    let [mut margins, mut spare, mut other] = [(); 3].map(|()| vec![0.0; Robot::model().plan.margins]);
    let mut guess = [0.0; N];
    let mut guesses = vec![0.0; Robot::model().guesses.len()];
    robot.write_guesses(&[], &mut guesses).expect("one number for each guess");
    Robot::model().guesses.iter().zip(&guesses).for_each(|(&place, value)| guess[place] = *value);
    let times: Vec<f64> = (0..STEPS).map(|k| (k as f64).to_radians()).collect();
    let back = -1_f64.to_radians();
    let mut followed = robot.solver().planned(&Instant::at(0.0)).expect("it closes");
    let solver = robot.solver();
    let mut tracker = solver.tracker(&Instant::at(0.0)).expect("it closes");
    let mut contenders = [
        Contender {
            name: "Newton on all 21 coordinates, dense LU",
            work: Box::new(|| {
                let (dense, workspace) = (dense.carried(), workspace.here());
                for &t in &times {
                    newton(&robot, dense, workspace, black_box(t));
                    black_box(&*dense);
                }
                dense.t = back;
            }),
        },
        Contender {
            name: "kin, the plan: Newton on two angles",
            work: Box::new(|| {
                let planned = planned.carried();
                for &t in &times {
                    let start = planned.predicted(t);
                    by_plan(&robot, planned, &mut margins, black_box(t), &start);
                    black_box((&*planned, &margins));
                }
                planned.t = back;
            }),
        },
        Contender {
            name: "the same from the last solution, without a prediction",
            work: Box::new(|| {
                let place = from_last.carried();
                for &t in &times {
                    let start = place.q;
                    by_plan(&robot, place, &mut spare, black_box(t), &start);
                    black_box((&*place, &spare));
                }
            }),
        },
        Contender {
            name: "the same from the mechanism's guess",
            work: Box::new(|| {
                let place = from_guess.carried();
                for &t in &times {
                    by_plan(&robot, place, &mut other, black_box(t), black_box(&guess));
                    black_box((&*place, &other));
                }
            }),
        },
        Contender {
            name: "kin, `Planned`: predicted and judged, too",
            work: Box::new(|| {
                followed.restart(&Instant::at(0.0), &state.q).expect("it closes");
                for &t in &times[1..] {
                    let found = followed.at(&Instant::at(black_box(t))).expect("it closes");
                    black_box(found.q());
                }
            }),
        },
        Contender {
            name: "kin, `state_at` from the mechanism's guess",
            work: Box::new(|| {
                for &t in &times {
                    black_box(robot.state_at(&Instant::at(black_box(t))).expect("it closes"));
                }
            }),
        },
        Contender {
            name: "kin, `Solver::state_from` the last state",
            work: Box::new(|| {
                let mut last = state.clone();
                for &t in &times {
                    last = solver.state_from(&Instant::at(black_box(t)), &last.q).expect("it closes");
                }
                black_box(last);
            }),
        },
        Contender {
            name: "kin, `Tracker::update`",
            work: Box::new(|| {
                let turned = TURN * (tracker.state().t / TURN).ceil();
                for &t in &times {
                    black_box(tracker.update(&Instant::at(black_box(turned + t))).expect("it closes"));
                }
            }),
        },
        Contender {
            name: "kin, `Solver::sweep_each`: states lent",
            work: Box::new(|| {
                let seen = solver.sweep_each(black_box(&times), |state| {
                    black_box(state);
                    ControlFlow::Continue(())
                });
                drop(black_box(seen.expect("it closes")));
            }),
        },
        Contender {
            name: "kin, `Solver::sweep`: states kept",
            work: Box::new(|| drop(black_box(solver.sweep(black_box(&times)).expect("it closes")))),
        },
    ];
    compare("q, q̇, q̈ of a 3-RRR robot at steps of one degree", STEPS, &mut contenders);
    drop(contenders);
    let worst = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (a, b) = (dense.here(), planned.here());
    println!(
        "  dense less plan at the end: {:.1e} {:.1e} {:.1e}; margins {margins:?}",
        worst(&a.q, &b.q),
        worst(&a.q_dot, &b.q_dot),
        worst(&a.q_ddot, &b.q_ddot)
    );
}
