//! A turn of the lecture's four-bar in steps of one degree through the public interface: by `Planned`, by a sweep and
//! by a tracker, with the plan and by full Newton alone, with sparse and with dense factorisations of Φ_q. `cargo bench
//! -p kin-benches --bench sweep`.

use kin_benches::four_bar::FourBar;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::{Instant, Kinematics, Options};
use std::hint::black_box;

const STEPS: usize = 360;

fn main() {
    let four_bar = FourBar::default();
    let times: Vec<f64> = (0..=STEPS).map(|k| (k as f64).to_radians() / four_bar.omega).collect();
    let by_plan = four_bar.solver();
    let newton = four_bar.solver().with_options(Options { use_plan: false, ..Options::default() });
    let dense = four_bar.solver().with_options(Options { use_plan: false, use_sparse: false, ..Options::default() });
    let at = Instant::at(0.0);
    let mut planned = Placed::new(|| by_plan.planned(&at).expect("there is a plan"));
    let mut trackers = [&newton, &by_plan]
        .map(|solver| Placed::new(move || solver.tracker(&Instant::at(0.0)).expect("it closes at t = 0")));
    let [tracker_newton, tracker_plan] = &mut trackers;
    let follow = |tracker: &mut kin_runtime::Tracker<'_>| {
        tracker.restart(&at).expect("it closes at t = 0");
        for &t in &times[1..] {
            black_box(tracker.update(&Instant::at(black_box(t))).expect("the crank turns"));
        }
    };
    let sweep = |solver: &kin_runtime::Solver<'_, FourBar>| {
        black_box(solver.sweep(black_box(&times)).expect("the crank turns"));
    };
    compare(
        "q, q̇, q̈ over a turn in steps of one degree, per instant",
        STEPS,
        &mut [
            Contender { name: "a sweep by full Newton, dense", work: Box::new(|| sweep(&dense)) },
            Contender { name: "a sweep by full Newton", work: Box::new(|| sweep(&newton)) },
            Contender { name: "a sweep by the plan", work: Box::new(|| sweep(&by_plan)) },
            Contender { name: "a tracker by full Newton", work: Box::new(|| follow(tracker_newton.here())) },
            Contender { name: "a tracker by the plan", work: Box::new(|| follow(tracker_plan.here())) },
            Contender {
                name: "Planned",
                work: Box::new(|| {
                    let planned = planned.here();
                    for &t in &times[1..] {
                        black_box(planned.at(&Instant::at(black_box(t))).expect("the crank turns"));
                    }
                }),
            },
        ],
    );
}
