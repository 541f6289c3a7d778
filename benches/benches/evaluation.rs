//! Φ, Φ_q, Φ_t, γ of the lecture's 9×9 four-bar, one configuration at a time: by kin, by hand-written code and by dual
//! numbers. `cargo bench -p kin-benches --bench evaluation`, as in `benches/table.sh` for other instruction sets.
//!
//! Measured twice: at angles in steps of a degree, as in a motion, and at random angles over several turns. The sines
//! and cosines of the standard library choose their polynomials by branches, which are predictable in a motion and not
//! at random angles. A branch predictor can learn a few hundred random angles, so there are more of them, and every
//! round uses a part.

use kin_benches::dual::{ByDuals, by_duals, by_few_duals};
use kin_benches::four_bar::{ByHand, FourBar, by_hand, by_hand_in_lanes};
use kin_benches::library;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_benches::random::Draws;
use kin_runtime::{Instant, Mechanism, Subset};
use std::hint::black_box;

const CONFIGURATIONS: usize = 4096;
/// The number of configurations in a round, few enough for the round to end before the scheduler switches to other
/// programs.
const IN_A_ROUND: usize = 256;

/// A configuration t, q, q̇.
type Configuration = (f64, [f64; 9], [f64; 9]);

fn against_one_another(title: &str, configurations: &[Configuration]) {
    let four_bar = FourBar::default();
    let [mut hand, mut lanes, mut few] = [(); 3].map(|()| Placed::new(ByHand::default));
    let mut duals = Placed::new(ByDuals::default);
    let [mut workspace, mut elsewhere, mut phi] = [(); 3].map(|()| Placed::new(FourBar::workspace::<f64>));
    let mut sets = [(); 7].map(|()| configurations.chunks(IN_A_ROUND).cycle());
    let [by_hand_sets, lane_sets, dual_sets, few_sets, kin_sets, elsewhere_sets, step_sets] = &mut sets;
    let mut contenders = [
        Contender {
            name: "by hand, sin and cos of the standard library",
            work: Box::new(|| {
                let hand = hand.here();
                for (t, q, w) in by_hand_sets.next().into_iter().flatten() {
                    by_hand(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), hand);
                    black_box(&*hand);
                }
            }),
        },
        Contender {
            name: "by hand, kin's sines and cosines",
            work: Box::new(|| {
                let lanes = lanes.here();
                for (t, q, w) in lane_sets.next().into_iter().flatten() {
                    by_hand_in_lanes(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), lanes);
                    black_box(&*lanes);
                }
            }),
        },
        Contender {
            name: "dual numbers, Φ by hand",
            work: Box::new(|| {
                let duals = duals.here();
                for (t, q, w) in dual_sets.next().into_iter().flatten() {
                    by_duals(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), duals);
                    black_box(&*duals);
                }
            }),
        },
        Contender {
            name: "dual numbers, constant columns of Φ_q by hand as well",
            work: Box::new(|| {
                let few = few.here();
                for (t, q, w) in few_sets.next().into_iter().flatten() {
                    by_few_duals(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), few);
                    black_box(&*few);
                }
            }),
        },
        Contender {
            name: "kin, evaluate",
            work: Box::new(|| {
                let workspace = workspace.here();
                for (t, q, w) in kin_sets.next().into_iter().flatten() {
                    let at = Instant::at(black_box(*t));
                    // References to arrays are passed, because `black_box` of a slice would hide the slice's length
                    // from the compiler.
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    black_box(&four_bar).evaluate(Subset::ALL, &at, q, w, workspace).expect("nine coordinates");
                    black_box(&*workspace);
                }
            }),
        },
        Contender {
            name: "kin, evaluate in a function of another crate",
            work: Box::new(|| {
                let workspace = elsewhere.here();
                for (t, q, w) in elsewhere_sets.next().into_iter().flatten() {
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    library::four_bar(black_box(&four_bar), black_box(*t), q, w, workspace).expect("nine coordinates");
                    black_box(&*workspace);
                }
            }),
        },
        Contender {
            name: "kin, Φ and Φ_q only (a Newton step)",
            work: Box::new(|| {
                let phi = phi.here();
                for (t, q, w) in step_sets.next().into_iter().flatten() {
                    let at = Instant::at(black_box(*t));
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    black_box(&four_bar).evaluate(Subset::POSITION, &at, q, w, phi).expect("nine coordinates");
                    black_box(&*phi);
                }
            }),
        },
    ];
    compare(&format!("Φ, Φ_q, Φ_t, γ of the 9×9 four-bar, {title}"), IN_A_ROUND, &mut contenders);
}

fn main() {
    let mut draws = Draws::new(1);
    let motion: Vec<Configuration> = (0..CONFIGURATIONS)
        .map(|degree| {
            let angle = (degree as f64).to_radians();
            // The crank turns, coupler and rocker swing; the positions and velocities do not affect the time.
            let mut q: [f64; 9] = draws.several_turns();
            (q[2], q[5], q[8]) = (angle, 0.9 + 0.3 * angle.cos(), 5.0 + 0.4 * angle.sin());
            (angle, q, draws.several_turns())
        })
        .collect();
    against_one_another("in steps of a degree", &motion);
    let random: Vec<Configuration> =
        (0..CONFIGURATIONS).map(|_| (draws.about(0.0, 6.0), draws.several_turns(), draws.several_turns())).collect();
    against_one_another("random angles", &random);
}
