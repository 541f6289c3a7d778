//! Φ, Φ_q, Φ_t, γ of ten and of a hundred four-bar loops geared in series, per loop, compared with one loop: `cargo
//! bench -p kin-benches --bench chain`, as in `benches/table.sh` for other instruction sets.

use kin_benches::chain::{self, Chain};
use kin_benches::four_bar::FourBar;
use kin_benches::library;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_benches::ten::{self, Ranged, WrittenOut};
use kin_runtime::{Instant, LengthError, Mechanism, Subset, Workspace};
use std::hint::black_box;

/// The number of loops that are evaluated in a round.
const LOOPS: usize = 800;

/// Configurations t, q, q̇ of a mechanism, with angles over several turns.
fn configurations<const N: usize>(count: usize) -> Vec<(f64, [f64; N], [f64; N])> {
    let some = |i: usize, k: usize| ((i * 31 + k * 17) as f64 * 0.7).sin() * 6.0;
    (0..count)
        .map(|i| (some(i, 20), core::array::from_fn(|k| some(i, k)), core::array::from_fn(|k| some(i, k + 9))))
        .collect()
}

/// A contender that evaluates a mechanism of `loops` loops with `N` coordinates by `evaluate`.
fn contender<'a, M: Mechanism + 'a, const N: usize>(
    name: &'static str,
    loops: usize,
    evaluate: impl Fn(f64, &[f64; N], &[f64; N], &mut Workspace<M>) -> Result<(), LengthError> + 'a,
) -> Contender<'a> {
    let configurations = configurations::<N>(LOOPS / loops);
    let mut workspace = Placed::new(M::workspace::<f64>);
    let work = move || {
        let workspace = workspace.here();
        for (t, q, w) in &configurations {
            evaluate(black_box(*t), black_box(q), black_box(w), workspace).expect("as many coordinates");
            black_box(&*workspace);
        }
    };
    Contender { name, work: Box::new(work) }
}

/// A contender whose mechanism is compiled in the crate of the bench itself.
fn here<'a, M: Mechanism + Default + 'a, const N: usize>(
    name: &'static str,
    loops: usize,
    subset: Subset,
) -> Contender<'a> {
    let mechanism = M::default();
    contender::<M, N>(name, loops, move |t, q, w, workspace| {
        black_box(&mechanism).evaluate(subset, &Instant::at(t), q, w, workspace)
    })
}

fn main() {
    const TEN: usize = 9 * ten::LOOPS;
    const HUNDRED: usize = 9 * chain::LOOPS;
    for (title, subset) in [("Φ, Φ_q, Φ_t, γ", Subset::ALL), ("Φ and Φ_q", Subset::POSITION)] {
        let mut contenders = [
            here::<FourBar, 9>("one loop", 1, subset),
            here::<WrittenOut, TEN>("one of ten loops, written out", ten::LOOPS, subset),
            here::<Ranged, TEN>("one of ten loops, with ranges", ten::LOOPS, subset),
            here::<Chain, HUNDRED>("one of a hundred loops, with ranges", chain::LOOPS, subset),
        ];
        compare(&format!("{title} of geared four-bar loops, per loop"), LOOPS, &mut contenders);
    }
    let (four_bar, written_out, ranged, chain) =
        (FourBar::default(), WrittenOut::default(), Ranged::default(), Chain::default());
    let mut contenders = [
        contender::<FourBar, 9>("one loop", 1, |t, q, w, out| library::four_bar(&four_bar, t, q, w, out)),
        contender::<WrittenOut, TEN>("one of ten loops, written out", ten::LOOPS, |t, q, w, out| {
            library::written_out(&written_out, t, q, w, out)
        }),
        contender::<Ranged, TEN>("one of ten loops, with ranges", ten::LOOPS, |t, q, w, out| {
            library::ranged(&ranged, t, q, w, out)
        }),
        contender::<Chain, HUNDRED>("one of a hundred loops, with ranges", chain::LOOPS, |t, q, w, out| {
            library::chain(&chain, t, q, w, out)
        }),
    ];
    compare("Φ, Φ_q, Φ_t, γ of the same by functions of another crate, per loop", LOOPS, &mut contenders);
}
