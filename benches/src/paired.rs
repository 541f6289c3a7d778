//! Contenders are timed in turn, round after round, so that disturbances of the machine affect all of them.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The number of rounds; the reported numbers are medians over them.
const ROUNDS: usize = 300;

/// The current round; results in [`Placed`](crate::placed::Placed) have another address in every round.
static ROUND: AtomicUsize = AtomicUsize::new(0);

/// The number of the current round.
pub fn round() -> usize {
    ROUND.load(Ordering::Relaxed)
}

/// A named piece of work, which processes each of its configurations once.
pub struct Contender<'a> {
    /// The name of the work.
    pub name: &'static str,
    /// The work, which should write its results to a [`Placed`](crate::placed::Placed).
    pub work: Box<dyn FnMut() + 'a>,
}

/// Prints, for every contender, the median of its time ratios to the first contender, the ratio of their best times,
/// which is less disturbed by other programs, and its best time per configuration. In every round each contender works
/// twice: untimed, which loads the addresses of this round into the cache, and then timed.
pub fn compare(title: &str, configurations: usize, contenders: &mut [Contender<'_>]) {
    compare_rounds(title, ROUNDS, configurations, contenders);
}

/// As [`compare`] with fewer rounds, for slow contenders.
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
