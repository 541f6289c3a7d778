//! Φ, Φ_q, Φ_t, γ of the lecture's 9×9 four-bar in batches: `cargo bench -p kin-benches --features simd --bench batch`,
//! also with `RUSTFLAGS="-C target-cpu=x86-64-v3"`. Angles are random, over several turns.

use kin_benches::four_bar::{ByHand, FourBar, by_hand};
use kin_benches::paired::{Contender, compare};
use kin_runtime::batch::{Column, Configurations, Evaluations, always, evaluate};
use kin_runtime::{Instant, Lanes, Mechanism, Subset};
use std::hint::black_box;

/// So many that their results stay in the cache of the second level.
const CONFIGURATIONS: usize = 512;

/// Numbers in −6 … 6 by a linear congruence, the same in every run.
fn drawn(seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        12.0 * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    (0..CONFIGURATIONS).map(|_| next()).collect()
}

fn main() {
    let four_bar = FourBar::default();
    let t = drawn(1);
    let q: [Vec<f64>; 9] = core::array::from_fn(|k| drawn(2 + k as u64));
    let w: [Vec<f64>; 9] = core::array::from_fn(|k| drawn(20 + k as u64));
    let at = |columns: &[Vec<f64>; 9], i: usize| -> [f64; 9] { columns.each_ref().map(|column| column[i]) };
    let one_by_one: Vec<_> = (0..CONFIGURATIONS).map(|i| (t[i], at(&q, i), at(&w, i))).collect();
    let block = |columns: &[Vec<f64>; 9], first: usize| -> [Lanes; 9] {
        columns.each_ref().map(|column| Lanes::generate(|lane| column[first + lane]))
    };
    let blocks: Vec<_> = (0..CONFIGURATIONS)
        .step_by(Lanes::COUNT)
        .map(|first| (Lanes::generate(|lane| t[first + lane]), block(&q, first), block(&w, first)))
        .collect();
    let columns = Configurations {
        parameters: &four_bar.parameters::<f64>().map(Column::Shared),
        t: Column::Each(&t),
        inputs: &[],
        q: &q.each_ref().map(|column| Column::Each(column)),
        q_dot: &w.each_ref().map(|column| Column::Each(column)),
    };
    let mut hand = ByHand::default();
    let (mut workspace, mut lanes) = (FourBar::workspace::<f64>(), FourBar::workspace::<Lanes>());
    let mut evaluations = Evaluations::<FourBar>::new(CONFIGURATIONS);
    let parameters = four_bar.parameters::<Lanes>();
    let mut contenders = [
        Contender {
            name: "by hand, sin and cos of the standard library",
            work: Box::new(|| {
                for (t, q, w) in &one_by_one {
                    by_hand(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), &mut hand);
                    black_box(&hand);
                }
            }),
        },
        Contender {
            name: "kin, one by one",
            work: Box::new(|| {
                for (t, q, w) in &one_by_one {
                    let at = Instant::at(black_box(*t));
                    // References to arrays: a slice through `black_box` is two words that come back as one.
                    let (q, w): (&[f64; 9], &[f64; 9]) = (black_box(q), black_box(w));
                    black_box(&four_bar).evaluate(Subset::ALL, &at, q, w, &mut workspace).expect("nine coordinates");
                    black_box(&workspace);
                }
            }),
        },
        Contender {
            name: "kin, four at once, block by block",
            work: Box::new(|| {
                for (t, q, w) in &blocks {
                    let at = Instant::at(*t);
                    let (q, w): (&[Lanes; 9], &[Lanes; 9]) = (black_box(q), black_box(w));
                    four_bar.evaluate_with(&parameters, Subset::ALL, &at, q, w, &mut lanes).expect("nine coordinates");
                    black_box(&lanes);
                }
            }),
        },
        Contender {
            name: "kin, a batch of columns, all results kept",
            work: Box::new(|| {
                evaluate(&four_bar, Subset::ALL, black_box(&columns), &mut evaluations, &always).expect("nine columns");
                black_box(evaluations.blocks());
            }),
        },
    ];
    compare("Φ, Φ_q, Φ_t, γ of the 9×9 four-bar, per configuration of a batch", CONFIGURATIONS, &mut contenders);
}
