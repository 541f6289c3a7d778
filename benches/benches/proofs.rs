//! Proofs compared with steps of the plan: certificates, and all closures with their certificates, of the lecture's
//! four-bar, joint by joint, and of Andrews' squeezer; all closures of a 3-RRR robot with driven cranks, its ranges
//! over a whole turn of one crank, and all closures of three loops that close together. `cargo bench -p kin-benches
//! --bench proofs`.

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

/// Andrews' squeezing mechanism: seven bodies, three loops, 21 coordinates.
#[mechanism]
#[bodies(K1, K2, K3, K4, K5, K6, K7)]
#[point(P = K2 @ (-0.028, 0))]
#[revolute(O: ground @ (0, 0), K1 @ (0, 0))]
#[revolute(F: K1 @ (0.007, 0), K2 @ (0, 0))]
#[revolute(B: ground @ (-0.03635, 0.03273), K3 @ (0, 0))]
#[revolute(P3: K3 @ (0, -0.035), P)]
#[revolute(A5: ground @ (-0.06934, -0.00227), K5 @ (0, 0))]
#[revolute(G: K5 @ (0.04, 0), K4 @ (0, 0))]
#[revolute(P4: K4 @ (0, -0.02), P)]
#[revolute(A7: ground @ (-0.06934, -0.00227), K7 @ (0, 0))]
#[revolute(H: K7 @ (0, -0.04), K6 @ (0, 0))]
#[revolute(P6: K6 @ (0.02, 0), P)]
#[driver(drive: K1.phi = 0.5 + omega * t)]
#[guess(K2.phi = -0.1, K3.phi = 0.5, K4.phi = 0.7, K5.phi = 0.5, K6.phi = 1.0, K7.phi = 1.2)]
struct Squeezer {
    #[param(40)]
    omega: f64,
}

/// Two ternary links with a common pin, each on two links of its own: three loops that close together, with 18 complex
/// closures.
#[mechanism]
#[bodies(left, right, ba, bb, bc, bd)]
#[revolute(A: ground @ (0, 0), ba @ (0, 0))]
#[revolute(B: ground @ (1, 0.1), bb @ (0, 0))]
#[revolute(C: ground @ (2, -0.2), bc @ (0, 0))]
#[revolute(D: ground @ (3, 0), bd @ (0, 0))]
#[revolute(a: ba @ (0.2, l), left @ (0, 0))]
#[revolute(b: bb @ (0.1, 1.1), left @ (0.9, 0.3))]
#[revolute(c: bc @ (0.1, 1.3), right @ (0.6, -0.5))]
#[revolute(d: bd @ (-0.1, 1), right @ (1.4, -0.6))]
#[revolute(P: left @ (1.3, 0.7), right @ (0, 0))]
struct Couplers {
    #[param(0.9)]
    l: f64,
}

/// The number of instants.
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
            Contender {
                name: "Solver::assemblies, all closures with a certificate each",
                work: Box::new(|| {
                    for step in 0..STEPS {
                        black_box(solver.assemblies(&Instant::at(at(step))).expect("it closes"));
                    }
                }),
            },
        ],
    );
}

fn main() {
    let four_bar = FourBar::default();
    proofs("the lecture's four-bar", &Solver::new(&four_bar).with_guess(5, 0.9).with_guess(8, 5.0));
    let squeezer = Squeezer::default();
    proofs("Andrews' squeezer", &Solver::new(&squeezer));
    let robot = Robot::default();
    let solver = Solver::new(&robot);
    let all = || {
        black_box(solver.assemblies(&Instant::at(0.0)).expect("it can be searched"));
    };
    let couplers = Couplers::default();
    let three_loops = Solver::new(&couplers);
    let found = three_loops.assemblies(&Instant::at(0.0)).expect("it can be searched");
    println!("three loops: {} closures, proven to be all: {}", found.found.len(), found.is_complete());
    let three = || {
        black_box(three_loops.assemblies(&Instant::at(0.0)).expect("it can be searched"));
    };
    let ranges = || {
        black_box(solver.ranges(&Instant::at(0.0), std::f64::consts::TAU).expect("it can be searched"));
    };
    let mut planned = solver.planned(&Instant::at(0.0)).expect("a plan");
    let steps = || {
        for step in 0..1000 {
            black_box(planned.at(&Instant::at(1e-7 * f64::from(step))).expect("it closes"));
        }
    };
    compare_rounds(
        "all closures of a 3-RRR robot",
        10,
        1,
        &mut [
            Contender { name: "a thousand of the plan's steps", work: Box::new(steps) },
            Contender { name: "Solver::assemblies", work: Box::new(all) },
            Contender { name: "Solver::ranges over a turn", work: Box::new(ranges) },
            Contender { name: "Solver::assemblies of three loops that close together", work: Box::new(three) },
        ],
    );
}
