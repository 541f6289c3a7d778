//! Contenders timed in turns, round after round, so that whatever slows the machine slows all of them.

use std::time::Instant;

/// Rounds; the median over them is what is reported.
const ROUNDS: usize = 300;

/// A piece of work with its name; it does everything once for each of its configurations.
pub struct Contender<'a> {
    /// What it is.
    pub name: &'static str,
    /// The work.
    pub work: Box<dyn FnMut() + 'a>,
}

/// Prints, for every contender, its best time per configuration and the median of its ratios to the first.
pub fn compare(title: &str, configurations: usize, contenders: &mut [Contender<'_>]) {
    let mut times = vec![Vec::with_capacity(ROUNDS); contenders.len()];
    for _ in 0..ROUNDS {
        for (contender, times) in contenders.iter_mut().zip(&mut times) {
            let start = Instant::now();
            (contender.work)();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    println!("{title}");
    for (contender, own) in contenders.iter().zip(&times) {
        let mut ratios: Vec<f64> = own.iter().zip(&times[0]).map(|(a, b)| a / b).collect();
        ratios.sort_by(f64::total_cmp);
        let best = own.iter().copied().fold(f64::INFINITY, f64::min) * 1e9 / configurations as f64;
        println!("  {:6.3}  {best:9.1} ns  {}", ratios[ROUNDS / 2], contender.name);
    }
}
