//! Random dimensions, time grids and distances from limits.

use crate::closure::{FourBar, dyadic};
use kin_tests::random::Random;

/// Random quantities for the families of mechanisms.
pub(crate) trait Draw {
    /// True with the given probability.
    fn chance(&mut self, probability: f64) -> bool;
    /// +1 or −1.
    fn sign(&mut self) -> f64;
    /// A power of ten with an exponent between `low` and `high`, with a random sign.
    fn small(&mut self, low: f64, high: f64) -> f64;
    /// A length with few binary places, so that sums are exact.
    fn length(&mut self) -> f64;
    /// An integer from `low` to `high`.
    fn whole(&mut self, low: usize, high: usize) -> usize;
    /// A time between these fractions of the grid at which a place is met: usually between two instants, sometimes at
    /// an instant or just beside one.
    fn meeting(&mut self, times: &[f64], low: f64, high: f64) -> f64;
    /// Sometimes moves the instant nearest to `place` to it, or just beside it.
    fn hit(&mut self, times: &mut [f64], place: f64);
    /// Times from 0 to `end`, in equal or random steps of a random size.
    fn grid(&mut self, end: f64) -> Vec<f64>;
}

impl Draw for Random {
    fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    fn small(&mut self, low: f64, high: f64) -> f64 {
        self.sign() * 10_f64.powf(self.between(low, high))
    }

    fn length(&mut self) -> f64 {
        dyadic(self.between(0.15, 1.0))
    }

    fn whole(&mut self, low: usize, high: usize) -> usize {
        self.between(low as f64, high as f64 + 1.0) as usize
    }

    fn meeting(&mut self, times: &[f64], low: f64, high: f64) -> f64 {
        let end = times[times.len() - 1];
        if self.chance(0.8) {
            return end * self.between(low, high);
        }
        let inner = |t: &&f64| (low..high).contains(&(**t / end));
        let inner: Vec<&f64> = times.iter().filter(inner).collect();
        if inner.is_empty() {
            return end * self.between(low, high);
        }
        let beside = if self.chance(0.3) { 0.0 } else { self.small(-9.0, -2.0) };
        inner[self.whole(0, inner.len() - 1)] + beside
    }

    fn hit(&mut self, times: &mut [f64], place: f64) {
        let last = times.len() - 1;
        let distance = |k: &usize| (times[*k] - place).abs();
        let Some(k) = (1..last).min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return };
        let beside = if self.chance(0.3) { 0.0 } else { self.small(-9.0, -2.0) };
        let way = times[last].signum();
        let fits = |t: f64| (t - times[k - 1]) * way > 0.0 && (times[k + 1] - t) * way > 0.0;
        if self.chance(0.2) && fits(place + beside) {
            times[k] = place + beside;
        }
    }

    fn grid(&mut self, end: f64) -> Vec<f64> {
        let step = 10_f64.powf(self.between(-1.4, -0.3));
        let count = ((end.abs() / step).ceil() as usize).max(2);
        let uneven = if self.chance(0.5) { 0.9 } else { 0.0 };
        let width = end / count as f64;
        let inner = |k: usize, share: f64| width * (k as f64 + uneven * (share - 0.5));
        let mut times = vec![0.0];
        times.extend((1..count).map(|k| inner(k, self.between(0.0, 1.0))));
        times.push(end);
        times
    }
}

/// A four-bar with a crossing if `off` is 0, and with a limit that is near a crossing otherwise.
pub(crate) fn near_a_crossing(random: &mut Random, outer: bool, off: f64) -> FourBar {
    loop {
        let (a, b, c) = (random.length(), random.length(), random.length());
        let d = if outer { b + c - a } else { a + random.sign() * (b - c).abs() };
        // If the crank is as long as the ground link, its pin passes through the ground pin.
        if d > 0.1 && (a - d).abs() > 0.02 {
            return FourBar { a, b, c, d: d + off, sign: random.sign() };
        }
    }
}
