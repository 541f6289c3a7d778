//! Φ, Φ_q, Φ_t, γ of the lecture's 9×9 four-bar, one configuration at a time: kin, by hand and by dual numbers.
//! `cargo bench -p kin-benches --bench evaluation`, as in `benches/table.sh` for other instruction sets.
//!
//! Twice: at angles in steps of a degree, as a motion has them, and at random angles over several turns. The sines and
//! cosines of the standard library choose their polynomials by branches, which are foreseen in a motion and not at
//! random angles. A processor learns a few hundred of them by heart, so there are more, some of them in every round.

use kin_benches::dual::{ByDuals, by_duals, by_few_duals};
use kin_benches::four_bar::{ByHand, FourBar, by_hand, by_hand_in_lanes};
use kin_benches::library;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_benches::random::Draws;
use kin_runtime::{Instant, Mechanism, Subset};
use std::hint::black_box;

const CONFIGURATIONS: usize = 4096;
/// So many in a round: short enough to be over before the scheduler looks, on a machine that others use, too.
const IN_A_ROUND: usize = 256;

/// t, q, q̇.
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
                    // References to arrays: a slice through `black_box` is two words that come back as one.
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
            // The crank turns, coupler and rocker swing; places and speeds are of no consequence for how long it takes.
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
