//! q, q̇, q̈ of a chain of a hundred four-bar loops, 900 coordinates, from one instant to the next: by trackers with
//! dense factorisations, with sparse factorisations in the fixed pattern of Φ_q, and with the plan; and by `Planned`.
//! `cargo bench -p kin-benches --bench large`.

use kin_benches::chain::{Chain, LOOPS};
use kin_benches::paired::{Contender, compare_rounds};
use kin_benches::placed::Placed;
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, Planned, Tracker};
use std::hint::black_box;

const N: usize = 9 * LOOPS;
/// The number of rounds; a dense step takes about a second.
const ROUNDS: usize = 3;
/// The number of steps in a round.
const STEPS: usize = 2;
/// The time of a step, in which the first crank turns by a twentieth of a degree.
const STEP: f64 = 1e-3;

fn main() {
    let chain = Chain::default();
    let at = Instant::at(0.0);
    // The closed forms need no guesses, and the trackers start at their solution.
    let plan = &Chain::model().plan;
    let (mut q, mut q_dot, mut q_ddot) = (vec![0.0; N], vec![0.0; N], vec![0.0; N]);
    let (mut margins, modes) = (vec![0.0; plan.margins], vec![1.0; plan.modes.len()]);
    let parameters = chain.parameters::<f64>();
    let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut margins };
    chain.solve_with(&parameters, &at, &modes, &[0.0; N], Depth::Acceleration, solved).expect("900 coordinates");

    let tracker = |use_plan, use_sparse| {
        let options = Options { use_plan, use_sparse, ..Options::default() };
        let tracker = chain.solver().with_options(options).tracker_from(&Instant::at(0.0), &q);
        tracker.expect("it closes at t = 0")
    };
    let dense = &mut tracker(false, false);
    let mut others = [false, true].map(|use_plan| Placed::new(move || tracker(use_plan, true)));
    let [newton, by_plan] = &mut others;
    let mut planned = Placed::new(|| Planned::new(&chain, &Instant::at(0.0), &q).expect("there is a plan"));
    // The steps go back and forth, so that all rounds are the same.
    let follow = |tracker: &mut Tracker<'_>| {
        for k in 1..=STEPS {
            black_box(tracker.update(&Instant::at(black_box(STEP * (k % 2) as f64))).expect("the crank turns"));
        }
    };
    let mut contenders = [
        Contender { name: "a tracker by full Newton, dense", work: Box::new(|| follow(dense)) },
        Contender { name: "a tracker by full Newton", work: Box::new(|| follow(newton.here())) },
        Contender { name: "a tracker by the plan", work: Box::new(|| follow(by_plan.here())) },
        Contender {
            name: "Planned",
            work: Box::new(|| {
                let planned = planned.here();
                for k in 1..=STEPS {
                    black_box(planned.at(&Instant::at(black_box(STEP * (k % 2) as f64))).expect("the crank turns"));
                }
            }),
        },
    ];
    compare_rounds("q, q̇, q̈ of a hundred loops in a chain, per instant", ROUNDS, STEPS, &mut contenders);
}
