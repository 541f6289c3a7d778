//! Φ, Φ_q, Φ_t, γ of the lecture's 9×9 four-bar: `cargo bench -p kin-benches`, also with
//! `--features simd` and `RUSTFLAGS="-C target-cpu=native"`.

use kin_benches::four_bar::{ByHand, FourBar, by_hand};
use kin_benches::paired::{Contender, compare};
use kin_runtime::{Instant, Mechanism, Subset};
use std::hint::black_box;

const CONFIGURATIONS: usize = 512;

/// Configurations with angles over several turns: (t, q, q̇).
fn configurations() -> Vec<(f64, [f64; 9], [f64; 9])> {
    let some = |i: usize, k: usize| ((i * 31 + k * 17) as f64 * 0.7).sin() * 6.0;
    (0..CONFIGURATIONS)
        .map(|i| (some(i, 20), core::array::from_fn(|k| some(i, k)), core::array::from_fn(|k| some(i, k + 9))))
        .collect()
}

fn main() {
    let four_bar = FourBar::default();
    let configurations = configurations();
    let mut hand = ByHand::default();
    let mut workspace = FourBar::workspace::<f64>();
    let mut phi = FourBar::workspace::<f64>();
    let mut contenders = [
        Contender {
            name: "by hand, sin and cos of the standard library",
            work: Box::new(|| {
                for (t, q, w) in &configurations {
                    by_hand(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), &mut hand);
                    black_box(&hand);
                }
            }),
        },
        Contender {
            name: "kin, evaluate",
            work: Box::new(|| {
                for (t, q, w) in &configurations {
                    let at = Instant::at(black_box(*t));
                    // References to arrays: a slice through `black_box` is two words that come back as one.
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    black_box(&four_bar).evaluate(Subset::ALL, &at, q, w, &mut workspace).expect("nine coordinates");
                    black_box(&workspace);
                }
            }),
        },
        Contender {
            name: "kin, Φ and Φ_q only (a Newton step)",
            work: Box::new(|| {
                for (t, q, w) in &configurations {
                    let at = Instant::at(black_box(*t));
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    black_box(&four_bar).evaluate(Subset::POSITION, &at, q, w, &mut phi).expect("nine coordinates");
                    black_box(&phi);
                }
            }),
        },
    ];
    compare("Φ, Φ_q, Φ_t, γ of the 9×9 four-bar, one configuration", CONFIGURATIONS, &mut contenders);
}
