//! Supplied functions of a series.
//!
//! With g_p = f⁽ᵖ⁾(x(τ)) the chain rule g_p′ = g_{p+1} x′ gives
//!
//! ```text
//! j g_p[j] = Σ i x_i g_{p+1}[j − i],  i = 1 … j
//! ```
//!
//! so that order k of f needs the j-th coefficients of g_p with p + j = k, and f⁽ᵏ⁾ only where x has moved at first
//! order. A derivative that nobody knows is NaN, and is multiplied with what moves alone: an argument at rest asks for
//! none.

use super::tape::Region;

/// Sequence 0 holds i x_i, sequence 1 + p holds g_p.
pub(super) struct Supplied {
    /// The highest derivative that is asked for.
    pub(super) used: usize,
}

impl Supplied {
    /// Numbers that it keeps, with series of `stride` coefficients.
    pub(super) fn size(&self, stride: usize) -> usize {
        (1 + stride + self.used) * stride + self.derivatives(stride)
    }

    /// Derivatives that the highest order needs, the value included.
    fn derivatives(&self, stride: usize) -> usize {
        stride + self.used
    }

    /// The values at x.
    pub(super) fn start(&self, x: f64, f: &impl Fn(f64, &mut [f64]) -> usize, region: &mut Region<'_>) -> [f64; 3] {
        let count = self.derivatives(region.stride);
        let first = region.numbers.len() - count;
        region.numbers[first..].fill(f64::NAN);
        let known = f(x, &mut region.numbers[first..]).min(count);
        region.numbers[first + known..].fill(f64::NAN);
        for p in 0..count {
            region.put(1 + p, 0, region.numbers[first + p]);
        }
        region.put(0, 0, 0.0);
        self.results(0, region)
    }

    /// The k-th coefficients.
    pub(super) fn step(&self, k: usize, x: f64, region: &mut Region<'_>) -> [f64; 3] {
        region.put(0, k, k as f64 * x);
        for p in (0..k + self.used).rev() {
            let j = (k + self.used - p).min(k);
            let terms = (1..=j).filter(|&i| region.at(0, i) != 0.0);
            let sum: f64 = terms.map(|i| region.at(0, i) * region.at(2 + p, j - i)).sum();
            region.put(1 + p, j, sum / j as f64);
        }
        self.results(k, region)
    }

    /// What the k-th coefficients change by when that of the argument changes by `d`.
    pub(super) fn correct(&self, k: usize, d: f64, region: &mut Region<'_>) -> [f64; 3] {
        let mut changes = [0.0; 3];
        if d == 0.0 {
            return changes;
        }
        region.put(0, k, region.at(0, k) + k as f64 * d);
        for (p, change) in changes.iter_mut().enumerate().take(1 + self.used) {
            *change = region.at(2 + p, 0) * d;
            region.put(1 + p, k, region.at(1 + p, k) + *change);
        }
        changes
    }

    fn results(&self, k: usize, region: &Region<'_>) -> [f64; 3] {
        core::array::from_fn(|p| if p <= self.used { region.at(1 + p, k) } else { 0.0 })
    }

    /// The highest derivative that is known.
    pub(super) fn known(&self, region: &Region<'_>) -> usize {
        (1..self.derivatives(region.stride)).take_while(|&p| !region.at(1 + p, 0).is_nan()).count()
    }
}
