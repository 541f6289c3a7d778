//! The first run: several coefficients at once, from τ = 0 on.
//!
//! With a constant number of coefficients everything lies in registers, and what a row's last coefficient does not need
//! is never computed.

use super::arithmetic::Arithmetic;
use super::at_zero::AtZero;
use super::inputs::Inputs;
use super::recurrence::{
    Absolute, Arc, ArcTangent, ArcTangent2, Exponential, KEPT, LANES, Logarithm, Pairs, Power, Product, Quotient,
    Recurrence, Root, SEQUENCES, Sequences, Sign, Square, Tangent, Turning, lanes,
};
use super::supplied::Supplied;
use super::tape::{Missing, Tape};
use crate::workspace::Array;

/// 1/k!
const RECIPROCALS: [f64; 4] = [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0];

/// Coefficients 0 … N − 1 of everything; `ALL` says whether rows are wanted with all of them or with the last alone.
pub(super) struct Start<'a, Z, C, R, const N: usize, const ALL: bool> {
    pub(super) inputs: &'a Inputs,
    /// q, q̇, q̈, …, one more than N at most.
    pub(super) q: [&'a C; 5],
    /// Sines and cosines at τ = 0.
    pub(super) at_zero: Z,
    pub(super) tape: &'a mut Tape,
    /// Whether a next run will come.
    pub(super) keep: bool,
    pub(super) place: usize,
    /// The opposites of rows, order by order; the last alone, where no other is wanted.
    pub(super) rows: &'a mut [R],
    pub(super) missing: &'a mut Option<Missing>,
}

/// The sequences of one operation, in registers.
struct Local<const N: usize>([[f64; N]; SEQUENCES]);

impl<const N: usize> Sequences for Local<N> {
    #[inline(always)]
    fn get(&self, s: usize, i: usize) -> f64 {
        self.0[s][i]
    }

    #[inline(always)]
    fn set(&mut self, s: usize, i: usize, value: f64) {
        self.0[s][i] = value;
    }

    #[inline(always)]
    fn convolution(&self, a: usize, b: usize, k: usize, first: usize, last: usize) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            if i >= first && i <= last {
                sum += self.0[a][i] * self.0[b][k - i];
            }
        }
        sum
    }
}

impl<Z, C, R, const N: usize, const ALL: bool> Start<'_, Z, C, R, N, ALL> {
    #[inline(always)]
    fn apply<const I: usize, const O: usize, F: Recurrence<I, O>>(
        &mut self,
        function: &F,
        x: [[f64; N]; I],
    ) -> [[f64; N]; O] {
        let mut local = Local([[0.0; N]; SEQUENCES]);
        let mut out = [[0.0; N]; O];
        for k in 0..N {
            let operands = core::array::from_fn(|i| x[i][k]);
            let results = match k {
                0 => function.start(operands, &mut local),
                _ => function.step(k, operands, &mut local),
            };
            for (series, coefficient) in out.iter_mut().zip(results) {
                series[k] = coefficient;
            }
        }
        if self.keep {
            let region = self.tape.room(&mut self.place, F::KEPT * self.tape.stride);
            let sequences = region.numbers.chunks_exact_mut(region.stride);
            for (kept, computed) in sequences.zip(&local.0) {
                kept[..N].copy_from_slice(computed);
            }
        }
        out
    }

    #[inline(always)]
    fn each(a: [f64; N], f: impl Fn(f64) -> f64) -> [f64; N] {
        a.map(f)
    }

    #[inline(always)]
    fn pairs(a: [f64; N], b: [f64; N], f: impl Fn(f64, f64) -> f64) -> [f64; N] {
        core::array::from_fn(|k| f(a[k], b[k]))
    }
}

impl<Z: AtZero, C: Array<f64>, R: Array<f64>, const N: usize, const ALL: bool> Arithmetic
    for Start<'_, Z, C, R, N, ALL>
{
    type Value = [f64; N];

    #[inline(always)]
    fn constants<const K: usize>(&mut self, compute: impl FnOnce() -> [f64; K]) -> [f64; K] {
        let numbers = compute();
        if self.keep {
            self.tape.room(&mut self.place, K).numbers.copy_from_slice(&numbers);
        }
        numbers
    }

    #[inline(always)]
    fn constant(c: f64) -> [f64; N] {
        core::array::from_fn(|k| if k == 0 { c } else { 0.0 })
    }

    #[inline(always)]
    fn time(&mut self) -> [f64; N] {
        core::array::from_fn(|k| match k {
            0 => self.inputs.t,
            1 => 1.0,
            _ => 0.0,
        })
    }

    #[inline(always)]
    fn coordinate(&mut self, k: usize) -> [f64; N] {
        core::array::from_fn(|order| RECIPROCALS[order] * self.q[order].as_ref()[k])
    }

    #[inline(always)]
    fn rate(&mut self, k: usize) -> [f64; N] {
        core::array::from_fn(|order| RECIPROCALS[order] * self.q[order + 1].as_ref()[k])
    }

    #[inline(always)]
    fn input(&mut self, k: usize, order: usize) -> [f64; N] {
        let series: [f64; N] = core::array::from_fn(|i| self.inputs.input(k, order, i));
        if series[N - 1].is_nan() {
            self.missing.get_or_insert(self.inputs.missing(k));
        }
        series
    }

    #[inline(always)]
    fn row(&mut self, row: usize, value: [f64; N]) {
        if ALL {
            for (order, coefficient) in value.into_iter().enumerate() {
                self.rows[order].as_mut()[row] = -coefficient;
            }
        } else {
            self.rows[0].as_mut()[row] = -value[N - 1];
        }
    }

    #[inline(always)]
    fn neg(&mut self, a: [f64; N]) -> [f64; N] {
        Self::each(a, |a| -a)
    }

    #[inline(always)]
    fn add(&mut self, a: [f64; N], b: [f64; N]) -> [f64; N] {
        Self::pairs(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(&mut self, a: [f64; N], b: [f64; N]) -> [f64; N] {
        Self::pairs(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn shift(&mut self, mut a: [f64; N], c: f64) -> [f64; N] {
        a[0] += c;
        a
    }

    #[inline(always)]
    fn below(&mut self, a: [f64; N], c: f64) -> [f64; N] {
        let mut out = Self::each(a, |a| -a);
        out[0] = c - a[0];
        out
    }

    #[inline(always)]
    fn scale(&mut self, a: [f64; N], c: f64) -> [f64; N] {
        Self::each(a, |a| c * a)
    }

    #[inline(always)]
    fn over(&mut self, a: [f64; N], c: f64) -> [f64; N] {
        Self::each(a, |a| a / c)
    }

    #[inline(always)]
    fn sin_cos<const A: usize>(&mut self, angles: [[f64; N]; A]) -> [([f64; N], [f64; N]); A] {
        let at_zero = self.at_zero.next(angles.map(|angle| angle[0]));
        let mut out = [([0.0; N], [0.0; N]); A];
        for first in (0..A).step_by(LANES) {
            let mut turning = [Pairs::ZERO; N];
            turning.start(lanes(first, A, |a| at_zero[a].0), lanes(first, A, |a| at_zero[a].1));
            let angle = |k: usize| lanes(first, A, |a| angles[a][k]);
            if N == 4 {
                // Accelerations are what became known last.
                turning.step(1, angle(1));
                turning.step(2, [-0.0; LANES]);
                turning.correct_and_step(3, angle(2), angle(3));
            } else {
                for k in 1..N {
                    turning.step(k, angle(k));
                }
            }
            if self.keep {
                let region = self.tape.room(&mut self.place, KEPT * self.tape.stride);
                region.numbers.as_chunks_mut().0.iter_mut().zip(&turning).for_each(|(kept, pairs)| pairs.keep(kept));
            }
            for (lane, (sin, cos)) in out[first..].iter_mut().take(LANES).enumerate() {
                (*sin, *cos) = (turning.map(|pairs| pairs.sin[lane]), turning.map(|pairs| pairs.cos[lane]));
            }
        }
        out
    }

    #[inline(always)]
    fn supplied(
        &mut self,
        number: usize,
        used: usize,
        a: [f64; N],
        f: &impl Fn(f64, &mut [f64]) -> usize,
    ) -> [[f64; N]; 3] {
        let function = Supplied { used };
        let mut region = self.tape.room(&mut self.place, function.size(self.tape.stride));
        let mut out = [[0.0; N]; 3];
        for (k, &coefficient) in a.iter().enumerate() {
            let results = match k {
                0 => function.start(coefficient, f, &mut region),
                _ => function.step(k, coefficient, &mut region),
            };
            for (series, result) in out.iter_mut().zip(results) {
                series[k] = result;
            }
        }
        if out.iter().any(|series| series[N - 1].is_nan()) {
            self.missing.get_or_insert(Missing::Function { number, known: function.known(&region) });
        }
        out
    }

    super::functions!([f64; N]);
}
