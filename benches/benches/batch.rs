//! Φ, Φ_q, Φ_t, γ of the lecture's 9×9 four-bar in batches: `cargo bench -p kin-benches --bench batch`, as in
//! `benches/table.sh` for other instruction sets. Angles are random, over several turns, and differ in every pass: if
//! they were repeated, the branch predictor would learn the branches in the sines of the standard library, which does
//! not happen in a real batch.

use kin_benches::four_bar::{ByHand, FourBar, by_hand};
use kin_benches::library;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_benches::random::Draws;
use kin_runtime::batch::{Column, Configurations, Evaluations, always, evaluate};
use kin_runtime::{Instant, Lanes, Mechanism, Subset};
use std::hint::black_box;

/// The number of configurations in a batch, whose results fit into the second-level cache.
const CONFIGURATIONS: usize = 512;
/// The number of batches; every pass uses another one, including the untimed pass before each timed pass.
const SETS: u64 = 8;

/// One batch in the data layouts that the contenders need.
struct Set {
    t: Vec<f64>,
    q: [Vec<f64>; 9],
    w: [Vec<f64>; 9],
    one_by_one: Vec<(f64, [f64; 9], [f64; 9])>,
    blocks: Vec<(Lanes, [Lanes; 9], [Lanes; 9])>,
}

impl Set {
    fn drawn(seed: u64) -> Self {
        let mut draws = Draws::new(seed);
        let mut column = || (0..CONFIGURATIONS).map(|_| draws.about(0.0, 6.0)).collect::<Vec<f64>>();
        let (t, q, w) = (column(), core::array::from_fn(|_| column()), core::array::from_fn(|_| column()));
        let at = |columns: &[Vec<f64>; 9], i: usize| -> [f64; 9] { columns.each_ref().map(|column| column[i]) };
        let one_by_one = (0..CONFIGURATIONS).map(|i| (t[i], at(&q, i), at(&w, i))).collect();
        let block = |columns: &[Vec<f64>; 9], first: usize| -> [Lanes; 9] {
            columns.each_ref().map(|column| Lanes::generate(|lane| column[first + lane]))
        };
        let blocks = (0..CONFIGURATIONS)
            .step_by(Lanes::COUNT)
            .map(|first| (Lanes::generate(|lane| t[first + lane]), block(&q, first), block(&w, first)))
            .collect();
        Self { t, q, w, one_by_one, blocks }
    }
}

fn main() {
    let four_bar = FourBar::default();
    let sets: Vec<Set> = (0..SETS).map(Set::drawn).collect();
    let mut in_turn = [(); 6].map(|()| sets.iter().cycle());
    let [by_hand_sets, kept_sets, single_sets, lane_sets, column_sets, elsewhere_sets] = &mut in_turn;
    let mut hand = Placed::new(ByHand::default);
    let (mut workspace, mut lanes) = (Placed::new(FourBar::workspace::<f64>), Placed::new(FourBar::workspace::<Lanes>));
    // The results of a batch span all offsets within a page, wherever they begin; a single list of them stays in the
    // cache.
    let [mut evaluations, mut more_evaluations] = [(); 2].map(|()| Evaluations::<FourBar>::new(CONFIGURATIONS));
    let mut kept: Vec<ByHand> = (0..CONFIGURATIONS).map(|_| ByHand::default()).collect();
    let parameters = four_bar.parameters::<Lanes>();
    let shared = four_bar.parameters::<f64>().map(Column::Shared);
    let mut contenders = [
        Contender {
            name: "by hand, sin and cos of the standard library",
            work: Box::new(|| {
                let hand = hand.here();
                for (t, q, w) in by_hand_sets.next().into_iter().flat_map(|set| &set.one_by_one) {
                    by_hand(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), hand);
                    black_box(&*hand);
                }
            }),
        },
        Contender {
            name: "by hand, all results kept",
            work: Box::new(|| {
                let configurations = kept_sets.next().into_iter().flat_map(|set| &set.one_by_one);
                for ((t, q, w), kept) in configurations.zip(&mut kept) {
                    by_hand(black_box(&four_bar), black_box(*t), black_box(q), black_box(w), kept);
                }
                black_box(&kept);
            }),
        },
        Contender {
            name: "kin, one by one",
            work: Box::new(|| {
                let workspace = workspace.here();
                for (t, q, w) in single_sets.next().into_iter().flat_map(|set| &set.one_by_one) {
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
            name: "kin, four at once, block by block",
            work: Box::new(|| {
                let lanes = lanes.here();
                for (t, q, w) in lane_sets.next().into_iter().flat_map(|set| &set.blocks) {
                    let at = Instant::at(*t);
                    let (q, w): (&[Lanes; 9], &[Lanes; 9]) = (black_box(q), black_box(w));
                    four_bar.evaluate_with(&parameters, Subset::ALL, &at, q, w, lanes).expect("nine coordinates");
                    black_box(&*lanes);
                }
            }),
        },
        Contender {
            name: "kin, a batch of columns, all results kept",
            work: Box::new(|| {
                let Some(Set { t, q, w, .. }) = column_sets.next() else { return };
                let columns = Configurations {
                    parameters: &shared,
                    t: Column::Each(t),
                    inputs: &[],
                    q: &q.each_ref().map(|column| Column::Each(column)),
                    q_dot: &w.each_ref().map(|column| Column::Each(column)),
                };
                evaluate(&four_bar, Subset::ALL, black_box(&columns), &mut evaluations, &always).expect("nine columns");
                black_box(evaluations.blocks());
            }),
        },
        Contender {
            name: "kin, the same in a function of another crate",
            work: Box::new(|| {
                let Some(Set { t, q, w, .. }) = elsewhere_sets.next() else { return };
                let columns = Configurations {
                    parameters: &shared,
                    t: Column::Each(t),
                    inputs: &[],
                    q: &q.each_ref().map(|column| Column::Each(column)),
                    q_dot: &w.each_ref().map(|column| Column::Each(column)),
                };
                library::columns(&four_bar, black_box(&columns), &mut more_evaluations).expect("nine columns");
                black_box(more_evaluations.blocks());
            }),
        },
    ];
    compare("Φ, Φ_q, Φ_t, γ of the 9×9 four-bar, per configuration of a batch", CONFIGURATIONS, &mut contenders);
}
