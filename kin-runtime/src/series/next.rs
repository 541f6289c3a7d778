//! Every later run: one more coefficient of everything.
//!
//! A value is two numbers: what the coefficient before changes by, now that those of q are known, and the new
//! coefficient, in which those of q that are not yet known count as 0.

use super::arithmetic::Arithmetic;
use super::course::Course;
use super::recurrence::{
    Absolute, Arc, ArcTangent, ArcTangent2, Exponential, Logarithm, Power, Product, Quotient, Recurrence, Root, Sign,
    SineCosine, Square, Tangent,
};
use super::supplied::Supplied;
use super::tape::{Missing, Tape};
use crate::workspace::Array;

/// What of q and q̇ has become known since the last run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum News {
    /// q_{k−1}, for rows of position level.
    Coordinates,
    /// q̇_{k−1} = k q_k, for rows of velocity level.
    Rates,
    /// Nothing: the series of q is complete.
    Nothing,
}

/// Coefficient `order` of everything.
pub(super) struct Next<'a, C, R> {
    pub(super) course: &'a Course<C>,
    /// The coefficients of q before this one, this one, and the next.
    pub(super) q: [&'a C; 3],
    pub(super) tape: &'a mut Tape,
    pub(super) place: usize,
    pub(super) order: usize,
    pub(super) news: News,
    pub(super) rows: &'a mut R,
    pub(super) missing: &'a mut Option<Missing>,
}

impl<C, R> Next<'_, C, R> {
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

impl<C: Array<f64>, R: Array<f64>> Arithmetic for Next<'_, C, R> {
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
        let before = if self.news == News::Coordinates { self.q[0].as_ref()[k] } else { 0.0 };
        [before, self.q[1].as_ref()[k]]
    }

    #[inline(always)]
    fn rate(&mut self, k: usize) -> [f64; 2] {
        let before = if self.news == News::Rates { self.order as f64 * self.q[1].as_ref()[k] } else { 0.0 };
        [before, (self.order + 1) as f64 * self.q[2].as_ref()[k]]
    }

    #[inline(always)]
    fn input(&mut self, k: usize, order: usize) -> [f64; 2] {
        let coefficient = self.course.input(k, order, self.order);
        if coefficient.is_nan() {
            self.missing.get_or_insert(self.course.missing_input(k));
        }
        [0.0, coefficient]
    }

    #[inline(always)]
    fn row(&mut self, row: usize, value: [f64; 2]) {
        self.rows.as_mut()[row] = value[1];
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
    fn turns<const A: usize>(&mut self, _: [[f64; 2]; A]) -> [(f64, f64); A] {
        [(0.0, 0.0); A]
    }

    #[inline(always)]
    fn sin_cos(&mut self, angle: [f64; 2], at_zero: (f64, f64)) -> ([f64; 2], [f64; 2]) {
        let [sin, cos] = self.apply(&SineCosine { at_zero }, [angle]);
        (sin, cos)
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
