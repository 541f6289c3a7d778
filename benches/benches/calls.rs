//! Calls of typical programs, on the lecture's four-bar: states from a guess and from the last state, a tracker, sweeps
//! that store their states or only pass them on, position analysis alone, and the follower of the plan. They are
//! compared with a hand-written step: Newton's iteration with a dense LU from the last solution. The hand-written step,
//! the tracker and the follower keep turning in one direction. `cargo bench -p kin-benches --bench calls`.

use kin_benches::four_bar::{ByHand, FourBar, HeldFourBar, by_hand};
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::nalgebra::{SMatrix, SVector};
use kin_runtime::{Instant, Kinematics, State};
use std::hint::black_box;
use std::ops::ControlFlow;

const STEPS: usize = 360;

type Matrix = SMatrix<f64, 9, 9>;
type Vector = SVector<f64, 9>;

/// A hand-written solver of q, q̇, q̈ from the last solution.
struct Step {
    q: [f64; 9],
    q_dot: [f64; 9],
    q_ddot: [f64; 9],
    hand: ByHand,
}

impl Step {
    fn to(&mut self, four_bar: &FourBar, t: f64) {
        let jacobian = |hand: &ByHand| Matrix::from_fn(|i, j| hand.phi_q[i][j]);
        for _ in 0..8 {
            by_hand(four_bar, t, &self.q, &self.q_dot, &mut self.hand);
            let Some(step) = jacobian(&self.hand).lu().solve(&Vector::from_row_slice(&self.hand.phi)) else { return };
            self.q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
            if step.amax() < 1e-9 {
                break;
            }
        }
        by_hand(four_bar, t, &self.q, &self.q_dot, &mut self.hand);
        let lu = jacobian(&self.hand).lu();
        let Some(q_dot) = lu.solve(&-Vector::from_row_slice(&self.hand.phi_t)) else { return };
        self.q_dot.copy_from_slice(q_dot.as_slice());
        by_hand(four_bar, t, &self.q, &self.q_dot, &mut self.hand);
        let Some(q_ddot) = lu.solve(&Vector::from_row_slice(&self.hand.gamma)) else { return };
        self.q_ddot.copy_from_slice(q_ddot.as_slice());
    }
}

fn main() {
    let four_bar = FourBar::default();
    let at = Instant::at(0.0);
    let first = four_bar.state_at(&at).expect("it closes at t = 0");
    let times: Vec<f64> = (0..STEPS).map(|k| (k as f64).to_radians() / four_bar.omega).collect();
    let array = |v: &[f64]| -> [f64; 9] { v.try_into().expect("nine coordinates") };
    let mut hand = Placed::new(|| Step {
        q: array(&first.q),
        q_dot: array(&first.q_dot),
        q_ddot: array(&first.q_ddot),
        hand: ByHand::default(),
    });
    let turn = 360_f64.to_radians() / four_bar.omega;
    let solver = four_bar.solver();
    let mut tracker = Placed::new(|| solver.tracker(&at).expect("it closes at t = 0"));
    let held = HeldFourBar.solver();
    let mut held_tracker = Placed::new(|| held.tracker(&at).expect("it closes at t = 0"));
    let mut planned = Placed::new(|| solver.planned(&at).expect("there is a plan"));
    let guessed = four_bar.solver().with_guess(5, first.q[5]).with_guess(8, first.q[8]);
    let each = |work: &dyn Fn(f64)| times.iter().for_each(|t| work(black_box(*t)));
    compare(
        "the lecture's four-bar at steps of one degree, per instant",
        STEPS,
        &mut [
            Contender {
                name: "a step by hand: evaluation by hand, Newton with dense LU 9×9 from the last solution",
                work: Box::new(|| {
                    let hand = hand.carried();
                    for &t in &times {
                        hand.to(black_box(&four_bar), black_box(t));
                        black_box(&hand.q_ddot);
                    }
                    hand.q[2] -= 360_f64.to_radians();
                }),
            },
            Contender {
                name: "state_at, from the mechanism's guess",
                work: Box::new(|| {
                    each(&|t| drop(black_box(black_box(&four_bar).state_at(&Instant::at(t)).expect("it closes"))));
                }),
            },
            Contender {
                name: "Solver::state, from other guesses",
                work: Box::new(|| each(&|t| drop(black_box(guessed.state(&Instant::at(t)).expect("it closes"))))),
            },
            Contender {
                name: "Solver::state_from the last state",
                work: Box::new(|| {
                    let mut last: Option<State> = None;
                    for &t in &times {
                        let start = last.as_ref().map_or(&first.q, |state| &state.q);
                        last = Some(solver.state_from(&Instant::at(black_box(t)), start).expect("it closes"));
                    }
                    black_box(last);
                }),
            },
            Contender {
                name: "position_analysis from the last position",
                work: Box::new(|| {
                    let mut last = first.q.clone();
                    for &t in &times {
                        last = four_bar.position_analysis(&Instant::at(black_box(t)), &last).expect("it closes");
                    }
                    black_box(last);
                }),
            },
            Contender {
                name: "velocity_analysis and acceleration_analysis of one position, together",
                work: Box::new(|| {
                    for &t in &times {
                        let at = Instant::at(black_box(t));
                        let q_dot = four_bar.velocity_analysis(&at, &first.q).expect("it is regular");
                        black_box(four_bar.acceleration_analysis(&at, &first.q, &q_dot).expect("it is regular"));
                    }
                }),
            },
            Contender {
                name: "Tracker::update",
                work: Box::new(|| {
                    let tracker = tracker.carried();
                    let turned = turn * (tracker.state().t / turn).ceil();
                    for t in times.iter().map(|t| turned + t) {
                        black_box(tracker.update(&Instant::at(black_box(t))).expect("the crank turns"));
                    }
                }),
            },
            Contender {
                name: "the same with a crank held at its pin, and a named point",
                work: Box::new(|| {
                    let tracker = held_tracker.carried();
                    let turned = turn * (tracker.state().t / turn).ceil();
                    for t in times.iter().map(|t| turned + t) {
                        black_box(tracker.update(&Instant::at(black_box(t))).expect("the crank turns"));
                    }
                }),
            },
            Contender {
                name: "Solver::sweep, full states",
                work: Box::new(|| drop(black_box(solver.sweep(black_box(&times)).expect("the crank turns")))),
            },
            Contender {
                name: "Solver::sweep_each, the same states lent",
                work: Box::new(|| {
                    let seen = solver.sweep_each(black_box(&times), |state| {
                        black_box(state);
                        ControlFlow::Continue(())
                    });
                    drop(black_box(seen.expect("the crank turns")));
                }),
            },
            Contender {
                name: "Planned::at",
                work: Box::new(|| {
                    let planned = planned.carried();
                    let turned = turn * (planned.t() / turn).ceil();
                    for t in times.iter().map(|t| turned + t) {
                        black_box(planned.at(&Instant::at(black_box(t))).expect("the crank turns"));
                    }
                }),
            },
        ],
    );
}
