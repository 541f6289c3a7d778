//! Power series of any length, whose coefficients are computed one after another.
//!
//! Code over [`Series`] executes the same operations in the same order in every run, so that the results of all
//! operations are stored on a tape in that order. A run computes some coefficients of each result from the lower ones
//! that earlier runs have left on the tape.

use crate::scalar::Scalar;
use crate::scalar::expansion::*;
use crate::scalar::recurrence::{ArcTangent2, Recurrence, Turning, compose};
use core::array;
use core::cell::{Cell, RefCell};
use core::ops::RangeInclusive;

/// A derivative that a coefficient needs and that is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// A higher derivative of an input.
    Input {
        /// Its index.
        index: usize,
        /// The highest order that is known.
        known: usize,
    },
    /// A higher derivative of a supplied function.
    Function {
        /// Its number.
        number: usize,
        /// The highest order that is known.
        known: usize,
    },
}

/// The series of a run, one after another.
pub(super) struct Tape {
    /// Coefficients, `stride` of each.
    numbers: RefCell<Vec<f64>>,
    stride: usize,
    /// The index of the next series.
    next: Cell<usize>,
    /// The coefficients that this run computes: the first, and one past the last.
    range: Cell<(usize, usize)>,
    /// Indices of series some of whose coefficients may be unknown.
    sources: RefCell<Vec<(usize, Missing)>>,
    missing: Cell<Option<Missing>>,
}

impl Tape {
    /// A tape for series up to this order; memory is allocated in the first run.
    pub(super) fn new(order: usize) -> Self {
        let (numbers, sources) = (RefCell::default(), RefCell::default());
        Self {
            numbers,
            stride: order + 1,
            next: Cell::new(0),
            range: Cell::new((0, 0)),
            sources,
            missing: Cell::new(None),
        }
    }

    /// Begins a run that computes these coefficients.
    pub(super) fn start(&self, orders: RangeInclusive<usize>) {
        self.next.set(0);
        self.range.set((*orders.start(), orders.end() + 1));
        self.sources.borrow_mut().clear();
        self.missing.set(None);
    }

    /// The derivative that was missing for the last coefficient of the run.
    pub(super) fn missing(&self) -> Option<Missing> {
        self.missing.get()
    }

    /// A series with the coefficients that `coefficient` gives.
    pub(super) fn leaf(&self, coefficient: &dyn Fn(usize) -> f64) -> Series<'_> {
        let [series] = self.record(each(|k, []: [f64; 0]| coefficient(k)), []);
        series
    }

    /// A series whose coefficients are known only up to the order in `missing`.
    pub(super) fn source(&self, missing: Missing, coefficient: &dyn Fn(usize) -> f64) -> Series<'_> {
        self.sources.borrow_mut().push((self.next.get(), missing));
        self.leaf(coefficient)
    }

    /// Coefficient k of a result of this run.
    pub(super) fn coefficient(&self, series: Series<'_>, k: usize) -> f64 {
        match series {
            Series::Number(value) if k == 0 => value,
            Series::Number(_) => 0.0,
            Series::At(_, index) => {
                let value = self.numbers.borrow()[index * self.stride + k];
                if value.is_nan() {
                    self.blame(&[index]);
                }
                value
            }
        }
    }

    /// Reserves room for `count` series; returns the index of the first.
    #[inline]
    fn room(&self, count: usize) -> usize {
        let first = self.next.get();
        self.next.set(first + count);
        let end = (first + count) * self.stride;
        if self.numbers.borrow().len() < end {
            self.grow(end);
        }
        first
    }

    #[cold]
    fn grow(&self, end: usize) {
        self.numbers.borrow_mut().resize(end, 0.0);
    }

    #[inline]
    fn record<const I: usize, const O: usize>(
        &self,
        recurrence: impl Recurrence<I, O>,
        x: [usize; I],
    ) -> [Series<'_>; O] {
        let (first, stride, (from, end)) = (self.room(O), self.stride, self.range.get());
        let mut numbers = self.numbers.borrow_mut();
        let (before, new) = numbers.split_at_mut(first * stride);
        let arguments = x.map(|place| &before[place * stride..][..stride]);
        let mut new = new.chunks_exact_mut(stride);
        let mut results: [&mut [f64]; O] = array::from_fn(|_| new.next().unwrap_or_default());
        for k in from..end {
            let next = recurrence.coefficient(k, &arguments, &results);
            results.iter_mut().zip(next).for_each(|(result, next)| result[k] = next);
        }
        if results.iter().any(|result| result[end - 1].is_nan()) {
            self.blame(&x);
        }
        array::from_fn(|o| Series::At(self, first + o))
    }

    /// Records which of the series at `places` has an unknown coefficient.
    #[cold]
    fn blame(&self, places: &[usize]) {
        let sources = self.sources.borrow();
        let unknown = sources.iter().find(|(index, _)| places.contains(index)).map(|(_, missing)| *missing);
        self.missing.set(self.missing.get().or(unknown));
    }

    /// A supplied function of the series at `x` with its first two derivatives.
    fn supplied(&self, number: usize, derivatives: impl Fn(f64, &mut [f64]) -> usize, x: usize) -> [Series<'_>; 3] {
        // The function's derivatives at x_0, two more than coefficients, need the room of two series; powers need that
        // of one.
        let (first, stride, (_, end)) = (self.room(6), self.stride, self.range.get());
        let mut numbers = self.numbers.borrow_mut();
        let (before, new) = numbers.split_at_mut(first * stride);
        let (x, (results, room)) = (&before[x * stride..][..end], new.split_at_mut(3 * stride));
        let (known, powers) = room[..3 * stride].split_at_mut(2 * stride);
        let known = &mut known[..end + 2];
        let count = derivatives(x[0], known).min(known.len());
        known[count..].fill(f64::NAN);
        let mut results = results.chunks_exact_mut(stride);
        let mut results = array::from_fn(|_| &mut results.next().unwrap_or_default()[..end]);
        compose(x, known, &mut powers[..end], &mut results);
        let known = known.iter().skip(1).take_while(|derivative| !derivative.is_nan()).count();
        let missing = |order| (first + order, Missing::Function { number, known });
        self.sources.borrow_mut().extend((0..3).map(missing));
        array::from_fn(|order| Series::At(self, first + order))
    }
}

/// A number, or a series on a tape by its index.
#[derive(Clone, Copy)]
pub(super) enum Series<'a> {
    Number(f64),
    At(&'a Tape, usize),
}

impl Series<'_> {
    /// The coefficient of τ⁰.
    fn value(self) -> f64 {
        match self {
            Self::Number(value) => value,
            Self::At(tape, index) => tape.numbers.borrow()[index * tape.stride],
        }
    }
}

impl Expansion for Series<'_> {
    #[inline]
    fn number(self) -> Option<f64> {
        if let Self::Number(value) = self { Some(value) } else { None }
    }

    #[inline]
    fn apply<const I: usize, const O: usize>(recurrence: impl Recurrence<I, O>, x: [Self; I]) -> [Self; O] {
        let tape = x.iter().find_map(|x| if let Self::At(tape, _) = x { Some(*tape) } else { None });
        // Operations on plain numbers are handled before: at least one argument is a series.
        let Some(tape) = tape else { return [Self::Number(f64::NAN); O] };
        let places = x.map(|x| match x {
            Self::At(_, index) => index,
            Self::Number(value) => {
                let index = tape.next.get();
                tape.leaf(&|k| if k == 0 { value } else { 0.0 });
                index
            }
        });
        tape.record(recurrence, places)
    }
}

scalar_of_expansion! { ['a] Series<'a> {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::Number(value)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let [sin, cos] = match self {
            Self::Number(value) => <[f64; 2]>::from(Scalar::sin_cos(value)).map(Self::Number),
            Self::At(tape, _) => {
                let is_first = tape.range.get().0 == 0;
                let at_zero = if is_first { Scalar::sin_cos(self.value()) } else { Default::default() };
                Self::apply(Turning { at_zero }, [self])
            }
        };
        (sin, cos)
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        let at_zero = Scalar::atan2(self.value(), x.value());
        match (self, x) {
            (Self::Number(_), Self::Number(_)) => Self::Number(at_zero),
            _ => Self::apply(ArcTangent2 { at_zero }, [self, x])[0],
        }
    }

    fn compose(
        self,
        number: usize,
        f: impl Fn(f64) -> [f64; 3],
        derivatives: impl Fn(f64, &mut [f64]) -> usize,
    ) -> [Self; 3] {
        match self {
            Self::Number(x) => f(x).map(Self::Number),
            Self::At(tape, index) => tape.supplied(number, derivatives, index),
        }
    }
} }
