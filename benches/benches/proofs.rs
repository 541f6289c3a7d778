//! Certificates against one step of the plan, for the lecture's four-bar, joint by joint; and all closures of a 3-RRR robot
//! whose cranks are given, against its ranges over a whole turn of one of them: `cargo bench -p kin-benches --bench proofs`.

use kin_benches::four_bar::FourBar;
use kin_benches::paired::{Contender, compare_rounds};
use kin_runtime::{Instant, Mechanism, Planned, Solver, State, mechanism};
use std::hint::black_box;

/// Three legs with given cranks, of which one turns.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (base*cos(2*pi*i/3 - 5*pi/6), base*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (l, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (l, 0), platform @ (size*cos(2*pi*i/3 - 5*pi/6), size*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(a: crank[0].phi = 0.9 + t)]
#[driver(b: crank[1].phi = 3.1)]
#[driver(c: crank[2].phi = -1.2)]
struct Robot {
    #[param(0.5)]
    base: f64,
    #[param(0.25)]
    size: f64,
    #[param(0.3)]
    l: f64,
}

/// Instants.
const STEPS: usize = 64;

fn at(step: usize) -> f64 {
    1e-5 * step as f64
}

fn proofs<M: Mechanism>(title: &str, solver: &Solver<'_, M>) {
    let states: Vec<State> = (0..STEPS).map(|k| solver.state(&Instant::at(at(k))).expect("it closes")).collect();
    let mut planned: Planned<'_, M> = solver.planned(&Instant::at(0.0)).expect("a plan");
    compare_rounds(
        title,
        100,
        STEPS,
        &mut [
            Contender {
                name: "the plan's step",
                work: Box::new(|| {
                    for step in 0..STEPS {
                        black_box(planned.at(&Instant::at(at(step))).expect("it closes"));
                    }
                }),
            },
            Contender {
                name: "Solver::certify",
                work: Box::new(|| {
                    for state in &states {
                        black_box(solver.certify(black_box(state)).expect("a regular state"));
                    }
                }),
            },
        ],
    );
}

fn main() {
    let four_bar = FourBar::default();
    proofs("the lecture's four-bar", &Solver::new(&four_bar).with_guess(5, 0.9).with_guess(8, 5.0));
    let robot = Robot::default();
    let solver = Solver::new(&robot);
    let all = || {
        black_box(solver.assemblies(&Instant::at(0.0)).expect("it can be searched"));
    };
    let ranges = || {
        black_box(solver.ranges(&Instant::at(0.0), std::f64::consts::TAU).expect("it can be searched"));
    };
    compare_rounds(
        "all closures of a 3-RRR robot",
        10,
        1,
        &mut [
            Contender { name: "Solver::assemblies", work: Box::new(all) },
            Contender { name: "Solver::ranges over a turn", work: Box::new(ranges) },
        ],
    );
}
