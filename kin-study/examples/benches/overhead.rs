//! What a study costs beside `batch::sweep` in a loop of rayon's that keeps only a score: `cargo bench --bench overhead`.
//!
//! Both take the same numbers on the same number of threads, one after the other in turns; what is compared is the time of
//! the processors, which other programs on the machine hardly change.

// Its `main` is not called here.
#[allow(dead_code, unreachable_pub)]
#[path = "../four_bar.rs"]
mod four_bar;

use four_bar::FourBar;
use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism};
use kin_study::{Limits, Range, Score, Study, Watch, run};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::f64::consts::TAU;
use std::num::NonZero;

/// Sets in one piece of the loop's work, as a study has them.
const PIECE: u64 = 4096;
const TURNS: usize = 3;

fn main() {
    // `cargo test --benches` only wants to know whether it runs.
    let is_bench = std::env::args().any(|arg| arg == "--bench");
    let rows: u64 = if is_bench { 1_000_000 } else { 10_000 };
    let study = Study::new()
        .rows(rows)
        .parameter("l2", Range::Uniform { from: 0.35, to: 0.5 })
        .parameter("l3", Range::Uniform { from: 0.28, to: 0.4 })
        .turn(0.0, TAU, 199)
        .score("fastest", Score::Greatest("rocker.phi_dot".to_owned()));
    let everything = study.clone();
    let study = study.keep_best(100, "fastest");
    let threads = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let limits = Limits { threads: Some(threads), resume: false };
    let mut figures = Vec::new();
    for _ in 0..TURNS {
        let alone = processor_time(|| assert!(by_hand(rows) > 0.0));
        let best = processor_time(|| measured(&study, limits));
        let kept = if is_bench { processor_time(|| measured(&everything, limits)) } else { best };
        println!(
            "the loop alone {alone:.2} s, best rows {best:.2} s (× {:.2}), all rows {kept:.2} s (× {:.2})",
            best / alone,
            kept / alone
        );
        figures.push([best / alone, kept / alone, 1e9 * best / (rows as f64 * 200.0)]);
    }
    figures.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let [best, kept, each] = figures[TURNS / 2];
    println!(
        "{rows} four-bars at 200 instants on {threads} threads: × {best:.2}, all rows kept × {kept:.2}, {each:.0} ns per set and instant"
    );
}

fn measured(study: &Study, limits: Limits) {
    let target = tempfile::tempdir().expect("there is room for temporary files");
    let report = run::<FourBar>(study, target.path(), limits, &Watch::default()).expect("it runs");
    assert!(report.is_complete());
}

/// Random numbers, a motion of each set, and the least of the greatest rates.
fn by_hand(rows: u64) -> f64 {
    let four_bar = FourBar::default();
    let times: Vec<f64> = (0..200).map(|k| TAU * f64::from(k) / 199.0).collect();
    let at = Instant::at(0.0);
    let state = four_bar.state_at(&at).expect("it closes");
    let start: Vec<Column<'_>> = state.q.iter().map(|number| Column::Shared(*number)).collect();
    let mut closures = [0.0];
    let parameters = four_bar.parameters::<f64>();
    four_bar.branches_with(&parameters, &at, &state.q, &mut closures).expect("the lists fit");
    let piece = |piece: u64| {
        let sets = PIECE.min(rows - piece * PIECE) as usize;
        let mut random = piece.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut draw = |from: f64, to: f64| -> Vec<f64> {
            let next = |_| {
                random ^= random << 13;
                random ^= random >> 7;
                random ^= random << 17;
                from + (to - from) * (random >> 11) as f64 / (1_u64 << 53) as f64
            };
            (0..sets).map(next).collect()
        };
        let (l2, l3) = (draw(0.35, 0.5), draw(0.28, 0.4));
        let mut columns = parameters.map(Column::Shared);
        (columns[1], columns[2]) = (Column::Each(&l2), Column::Each(&l3));
        let modes = [Column::Shared(closures[0])];
        let sweeps =
            Sweeps { parameters: &columns, times: &times, inputs: &[], modes: Modes::Signs(&modes), start: &start };
        let mut out = Motions::new(sets, Lanes::from(0.0));
        sweep(&four_bar, &sweeps, &mut out, &always, |most: &mut Lanes, moment| {
            let (old, new) = (most.to_array(), moment.q_dot[8].to_array());
            let greater = Lanes::generate(|lane| if new[lane] > old[lane] { new[lane] } else { old[lane] });
            *most = moment.keep(*most, greater);
        })
        .expect("it can be swept");
        let turning = out.scores(|most| *most).zip(out.ends()).filter(|(_, end)| end.is_none());
        turning.map(|(most, _)| most).fold(f64::INFINITY, f64::min)
    };
    (0..rows.div_ceil(PIECE)).into_par_iter().map(piece).reduce(|| f64::INFINITY, f64::min)
}

/// Seconds that all threads of this process spend on some work; of the clock, where the system does not say.
fn processor_time(work: impl FnOnce()) -> f64 {
    let ticks = || -> Option<f64> {
        let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
        let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
        let [user, system] = [fields.next()?, fields.next()?].map(|field| field.parse::<f64>().ok());
        // Linux counts in hundredths of a second.
        Some((user? + system?) / 100.0)
    };
    let (clock, before) = (std::time::Instant::now(), ticks());
    work();
    match (before, ticks()) {
        (Some(before), Some(after)) if after > before => after - before,
        _ => clock.elapsed().as_secs_f64(),
    }
}
