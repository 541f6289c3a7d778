//! Contenders timed in turns, round after round, so that whatever slows the machine slows all of them.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Rounds; the median over them is what is reported.
const ROUNDS: usize = 300;

/// The round that is under way: [`Placed`](crate::placed::Placed) results stand elsewhere in the next one.
static ROUND: AtomicUsize = AtomicUsize::new(0);

/// The number of the round that is under way.
pub fn round() -> usize {
    ROUND.load(Ordering::Relaxed)
}

/// A piece of work with its name; it does everything once for each of its configurations.
pub struct Contender<'a> {
    /// What it is.
    pub name: &'static str,
    /// The work. What it writes belongs into [`Placed`](crate::placed::Placed).
    pub work: Box<dyn FnMut() + 'a>,
}

/// Prints, for every contender, the median of its ratios to the first, the ratio of their best times, which is less
/// disturbed where others use the machine, and its best time per configuration. In every round each of them works twice:
/// untimed, which brings its results to where they stand in this round, then timed.
pub fn compare(title: &str, configurations: usize, contenders: &mut [Contender<'_>]) {
    compare_rounds(title, ROUNDS, configurations, contenders);
}

/// [`compare`] with fewer rounds, for what takes long.
pub fn compare_rounds(title: &str, rounds: usize, configurations: usize, contenders: &mut [Contender<'_>]) {
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for _ in 0..rounds {
        ROUND.fetch_add(1, Ordering::Relaxed);
        for (contender, times) in contenders.iter_mut().zip(&mut times) {
            (contender.work)();
            let start = Instant::now();
            (contender.work)();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    println!("{title}");
    let best = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    println!("  median    best");
    for (contender, own) in contenders.iter().zip(&times) {
        let mut ratios: Vec<f64> = own.iter().zip(&times[0]).map(|(a, b)| a / b).collect();
        ratios.sort_by(f64::total_cmp);
        let (least, each) = (best(own) / best(&times[0]), best(own) * 1e9 / configurations as f64);
        println!("  {:6.3}  {least:6.3}  {each:9.1} ns  {}", ratios[rounds / 2], contender.name);
    }
}
