//! Φ, Φ_q, Φ_t, γ of a hundred four-bar loops geared in series, per loop, against one loop:
//! `cargo bench -p kin-benches --bench chain`, as in `benches/table.sh` for other instruction sets.

use kin_benches::chain::{Chain, LOOPS};
use kin_benches::four_bar::FourBar;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::{Instant, Mechanism, Subset};
use std::hint::black_box;

/// Chains that are evaluated in a round.
const CHAINS: usize = 8;

/// Numbers over several turns.
fn some(i: usize, k: usize) -> f64 {
    ((i * 31 + k * 17) as f64 * 0.7).sin() * 6.0
}

fn main() {
    let (four_bar, chain) = (FourBar::default(), Chain::default());
    let loops: Vec<(f64, [f64; 9], [f64; 9])> = (0..CHAINS * LOOPS)
        .map(|i| (some(i, 20), core::array::from_fn(|k| some(i, k)), core::array::from_fn(|k| some(i, k + 9))))
        .collect();
    type State = [f64; 9 * LOOPS];
    let chains: Vec<(f64, State, State)> = (0..CHAINS)
        .map(|i| (some(i, 20), core::array::from_fn(|k| some(i, k)), core::array::from_fn(|k| some(i, k + 9))))
        .collect();
    for (title, subset) in [("Φ, Φ_q, Φ_t, γ", Subset::ALL), ("Φ and Φ_q", Subset::POSITION)] {
        let mut one = Placed::new(FourBar::workspace::<f64>);
        let mut all = Placed::new(Chain::workspace::<f64>);
        let (parameters, parameters_of_chain) = (four_bar.parameters::<f64>(), chain.parameters::<f64>());
        let mut contenders = [
            Contender {
                name: "one loop",
                work: Box::new(|| {
                    let one = one.here();
                    for (t, q, w) in &loops {
                        let (at, p) = (Instant::at(black_box(*t)), black_box(&parameters));
                        (four_bar.evaluate_with(p, subset, &at, black_box(q), black_box(w), one))
                            .expect("nine coordinates");
                        black_box(&*one);
                    }
                }),
            },
            Contender {
                name: "one of a hundred loops in a chain",
                work: Box::new(|| {
                    let all = all.here();
                    for (t, q, w) in &chains {
                        let (at, p) = (Instant::at(black_box(*t)), black_box(&parameters_of_chain));
                        (chain.evaluate_with(p, subset, &at, black_box(q), black_box(w), all))
                            .expect("nine hundred coordinates");
                        black_box(&*all);
                    }
                }),
            },
        ];
        compare(&format!("{title} of geared four-bar loops, per loop"), CHAINS * LOOPS, &mut contenders);
    }
}
