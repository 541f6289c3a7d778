//! Every later run: one more coefficient of everything.
//!
//! A value is two numbers: what the coefficient before changes by, now that those of q are known, and the new
//! coefficient, in which those of q that are not yet known count as 0.

use super::arithmetic::Arithmetic;
use super::inputs::Inputs;
use super::news::News;
use super::recurrence::{
    Absolute, Arc, ArcTangent, ArcTangent2, Exponential, KEPT, LANES, Logarithm, Power, Product, Quotient, Recurrence,
    Root, Sign, Square, Tangent, Turning, lanes,
};
use super::supplied::Supplied;
use super::tape::{Missing, Tape};
use crate::workspace::Array;

/// Coefficient `order` of everything.
pub(super) struct Next<'a, N, R> {
    pub(super) inputs: &'a Inputs,
    pub(super) news: N,
    pub(super) tape: &'a mut Tape,
    pub(super) place: usize,
    pub(super) order: usize,
    /// Where the opposite of every row goes.
    pub(super) rows: &'a mut R,
    pub(super) missing: &'a mut Option<Missing>,
}

impl<N, R> Next<'_, N, R> {
    #[inline(always)]
    fn apply<const I: usize, const O: usize, F: Recurrence<I, O>>(
        &mut self,
        function: &F,
        x: [[f64; 2]; I],
    ) -> [[f64; 2]; O] {
        let mut region = self.tape.room(&mut self.place, F::KEPT * self.tape.stride);
        let changes = function.correct(self.order - 1, x.map(|x| x[0]), &mut region);
        let coefficients = function.step(self.order, x.map(|x| x[1]), &mut region);
        core::array::from_fn(|k| [changes[k], coefficients[k]])
    }
}

impl<N: News, R: Array<f64>> Arithmetic for Next<'_, N, R> {
    type Value = [f64; 2];

    #[inline(always)]
    fn constants<const K: usize>(&mut self, _: impl FnOnce() -> [f64; K]) -> [f64; K] {
        let kept = self.tape.room(&mut self.place, K);
        core::array::from_fn(|k| kept.numbers[k])
    }

    #[inline(always)]
    fn constant(_: f64) -> [f64; 2] {
        [0.0; 2]
    }

    #[inline(always)]
    fn time(&mut self) -> [f64; 2] {
        [0.0; 2]
    }

    #[inline(always)]
    fn coordinate(&mut self, k: usize) -> [f64; 2] {
        self.news.coordinate(k)
    }

    #[inline(always)]
    fn rate(&mut self, k: usize) -> [f64; 2] {
        self.news.rate(k)
    }

    #[inline(always)]
    fn input(&mut self, k: usize, order: usize) -> [f64; 2] {
        let coefficient = self.inputs.input(k, order, self.order);
        if coefficient.is_nan() {
            self.missing.get_or_insert(self.inputs.missing(k));
        }
        [0.0, coefficient]
    }

    #[inline(always)]
    fn row(&mut self, row: usize, value: [f64; 2]) {
        self.rows.as_mut()[row] = -value[1];
    }

    #[inline(always)]
    fn neg(&mut self, a: [f64; 2]) -> [f64; 2] {
        a.map(|a| -a)
    }

    #[inline(always)]
    fn add(&mut self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        [a[0] + b[0], a[1] + b[1]]
    }

    #[inline(always)]
    fn sub(&mut self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        [a[0] - b[0], a[1] - b[1]]
    }

    #[inline(always)]
    fn shift(&mut self, a: [f64; 2], _: f64) -> [f64; 2] {
        a
    }

    #[inline(always)]
    fn below(&mut self, a: [f64; 2], _: f64) -> [f64; 2] {
        a.map(|a| -a)
    }

    #[inline(always)]
    fn scale(&mut self, a: [f64; 2], c: f64) -> [f64; 2] {
        a.map(|a| c * a)
    }

    #[inline(always)]
    fn over(&mut self, a: [f64; 2], c: f64) -> [f64; 2] {
        a.map(|a| a / c)
    }

    #[inline(always)]
    fn sin_cos<const A: usize>(&mut self, angles: [[f64; 2]; A]) -> [([f64; 2], [f64; 2]); A] {
        let mut out = [([0.0; 2], [0.0; 2]); A];
        for first in (0..A).step_by(LANES) {
            let turning = self.tape.room(&mut self.place, KEPT * self.tape.stride).numbers.as_chunks_mut().0;
            let [d, x] = [0, 1].map(|k| lanes(first, A, |a| angles[a][k]));
            let [changes, found] = turning.correct_and_step(self.order, d, x);
            for (lane, (sin, cos)) in out[first..].iter_mut().take(LANES).enumerate() {
                (*sin, *cos) = ([changes.sin[lane], found.sin[lane]], [changes.cos[lane], found.cos[lane]]);
            }
        }
        out
    }

    #[inline(always)]
    fn supplied(
        &mut self,
        number: usize,
        used: usize,
        a: [f64; 2],
        _: &impl Fn(f64, &mut [f64]) -> usize,
    ) -> [[f64; 2]; 3] {
        let function = Supplied { used };
        let mut region = self.tape.room(&mut self.place, function.size(self.tape.stride));
        let changes = function.correct(self.order - 1, a[0], &mut region);
        let coefficients = function.step(self.order, a[1], &mut region);
        if coefficients.iter().any(|c| c.is_nan()) {
            self.missing.get_or_insert(Missing::Function { number, known: function.known(&region) });
        }
        core::array::from_fn(|p| [changes[p], coefficients[p]])
    }

    super::functions!([f64; 2]);
}
