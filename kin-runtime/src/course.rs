//! The inputs along the path from one instant to the next.
//!
//! A motion is followed along a parameter s. If the inputs are functions of time, s is time. Between two instants at
//! which only the inputs are known, with x = (s − s₀)/(s₁ − s₀), h = t₁ − t₀ and Δu = u₁ − u₀:
//!
//! ```text
//! smooth    s = t:    u = u₀ + h u̇₀ x + ½ h² ü₀ x² + c₃ x³ + c₄ x⁴ + c₅ x⁵
//! straight  s = t:    u = u₀ + Δu x,    u̇ = Δu/h,    ü = 0
//! frozen    s = x:    u = u₀ + Δu x,    t constant, up to a few units in its last place
//! ```
//!
//! with c₃, c₄, c₅ such that the quintic has the values, rates and accelerations of both ends. On a frozen path
//! derivatives are with respect to s, and time does not contribute to them.
//!
//! On smooth and straight paths of inputs [`Between`] counts s from the first instant, s = t − t₀ instead of t: where t is
//! large, neighbouring numbers may be farther apart than the steps that a motion near a limit needs.

use crate::quintic::quintic as interpolated;
use crate::signal::{Instant, Signal};

/// Inputs as functions of time.
#[cfg(feature = "std")]
pub(crate) type InputFunction<'a> = Option<&'a dyn Fn(f64, &mut [Signal])>;

/// Rates and accelerations are used if, from either end, they predict the signal at the other end with an error of at
/// most this fraction of its change.
const AGREEMENT: f64 = 0.25;

/// Up to this difference of t, in units in the last place, time counts as constant: there is no room for steps in time.
const SAME_TIME: f64 = 64.0;

/// The path of the inputs from one instant to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PathShape {
    /// A quintic with the rates and accelerations of both ends.
    Smooth,
    /// Linear in time.
    Straight,
    /// With constant time.
    Frozen,
}

/// The path between two instants with equally many inputs: smooth if t increases and the rates at both ends agree with
/// the change, straight if they do not, frozen if t is constant.
pub(crate) fn kind(from: &Instant<'_>, to: &Instant<'_>) -> PathShape {
    let h = to.t - from.t;
    let agree = |(a, b): (&Signal, &Signal)| {
        let allowed = AGREEMENT * (b.value - a.value).abs();
        (a.after(h).value - b.value).abs() <= allowed && (b.after(-h).value - a.value).abs() <= allowed
    };
    let nothing = SAME_TIME * f64::EPSILON * from.t.abs().max(to.t.abs());
    match h {
        h if h.abs() <= nothing => PathShape::Frozen,
        h if h > 0.0 && from.inputs.iter().zip(to.inputs).all(agree) => PathShape::Smooth,
        _ => PathShape::Straight,
    }
}

/// The time at the parameter s between two times.
fn time(kind: PathShape, [start, end]: [f64; 2], s: f64) -> f64 {
    match kind {
        PathShape::Frozen if s == 1.0 => end,
        PathShape::Frozen => start + s * (end - start),
        PathShape::Smooth | PathShape::Straight => s,
    }
}

/// The first and the last parameter s.
fn ends(kind: PathShape, t: [f64; 2]) -> [f64; 2] {
    if kind == PathShape::Frozen { [0.0, 1.0] } else { t }
}

/// Writes the inputs at a parameter s.
fn write(kind: PathShape, t: [f64; 2], [from, to]: [&[Signal]; 2], s: f64, inputs: &mut [Signal]) {
    let [start, end] = ends(kind, t);
    let x = if s == end { 1.0 } else { (s - start) / (end - start) };
    for ((u, a), b) in inputs.iter_mut().zip(from).zip(to) {
        *u = match kind {
            PathShape::Smooth => quintic(a, b, end - start, x),
            PathShape::Straight | PathShape::Frozen => {
                let change = b.value - a.value;
                let value = if x == 1.0 { b.value } else { a.value + x * change };
                Signal::new(value, change / (end - start), 0.0)
            }
        };
    }
}

/// A path of instants along which a motion is followed.
pub(crate) trait Course {
    /// The first and the last parameter s.
    fn ends(&self) -> [f64; 2];
    /// Writes the inputs at a parameter s and returns the time there.
    fn at(&self, s: f64, inputs: &mut [Signal]) -> f64;
    /// True if time is constant, so that derivatives are with respect to s.
    fn is_frozen(&self) -> bool;
    /// True if the rates at its end are those of the instant to which it leads.
    fn has_rates_of_end(&self) -> bool;
}

/// The path from one instant to another, computed from the inputs at both.
pub(crate) struct Between<'a> {
    pub(crate) kind: PathShape,
    pub(crate) from: Instant<'a>,
    pub(crate) to: Instant<'a>,
}

/// The neighbourhood of one instant, extrapolated from its rates and accelerations.
pub(crate) struct Around<'a> {
    pub(crate) instant: Instant<'a>,
    /// A value of s on the side from which the instant is approached.
    pub(crate) from: f64,
}

impl Course for Around<'_> {
    fn ends(&self) -> [f64; 2] {
        [self.from, self.instant.t]
    }

    fn at(&self, s: f64, inputs: &mut [Signal]) -> f64 {
        let h = s - self.instant.t;
        inputs.iter_mut().zip(self.instant.inputs).for_each(|(to, from)| *to = from.after(h));
        s
    }

    fn is_frozen(&self) -> bool {
        false
    }

    fn has_rates_of_end(&self) -> bool {
        true
    }
}

impl Between<'_> {
    /// The time at s = 0.
    fn origin(&self) -> f64 {
        if self.to.inputs.is_empty() { 0.0 } else { self.from.t }
    }

    /// The times of both ends, from the origin on.
    fn times(&self) -> [f64; 2] {
        [self.from.t - self.origin(), self.to.t - self.origin()]
    }
}

impl Course for Between<'_> {
    fn ends(&self) -> [f64; 2] {
        ends(self.kind, self.times())
    }

    fn at(&self, s: f64, inputs: &mut [Signal]) -> f64 {
        let t = self.times();
        write(self.kind, t, [self.from.inputs, self.to.inputs], s, inputs);
        if s == self.ends()[1] { self.to.t } else { self.origin() + time(self.kind, t, s) }
    }

    fn is_frozen(&self) -> bool {
        self.kind == PathShape::Frozen
    }

    fn has_rates_of_end(&self) -> bool {
        self.kind == PathShape::Smooth || self.to.inputs.is_empty() && self.kind == PathShape::Straight
    }
}

/// The path from one time to another, with inputs that are functions of time.
#[cfg(feature = "std")]
pub(crate) struct Timed<'a> {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) inputs: &'a dyn Fn(f64, &mut [Signal]),
}

#[cfg(feature = "std")]
impl Course for Timed<'_> {
    fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    fn at(&self, s: f64, inputs: &mut [Signal]) -> f64 {
        (self.inputs)(s, inputs);
        s
    }

    fn is_frozen(&self) -> bool {
        false
    }

    fn has_rates_of_end(&self) -> bool {
        true
    }
}

/// The path from one instant to another, with buffers that are reused for the next path.
#[cfg(feature = "std")]
#[derive(Clone, Debug)]
pub(crate) struct InputPath {
    pub(crate) kind: PathShape,
    t: [f64; 2],
    from: Vec<Signal>,
    to: Vec<Signal>,
}

#[cfg(feature = "std")]
impl InputPath {
    /// A path of length 0 at an instant; derivatives are with respect to time.
    pub(crate) fn resting(at: &Instant<'_>) -> Self {
        Self { kind: PathShape::Smooth, t: [at.t; 2], from: at.inputs.to_vec(), to: at.inputs.to_vec() }
    }

    /// A path of length 0 with constant time.
    pub(crate) const fn frozen() -> Self {
        Self { kind: PathShape::Frozen, t: [0.0; 2], from: Vec::new(), to: Vec::new() }
    }

    /// Sets it to the path between two instants with equally many inputs.
    pub(crate) fn lead(&mut self, from: &Instant<'_>, to: &Instant<'_>) {
        self.t = [from.t, to.t];
        self.from.clear();
        self.from.extend_from_slice(from.inputs);
        self.to.clear();
        self.to.extend_from_slice(to.inputs);
        self.kind = kind(from, to);
    }

    /// Makes it straight: rates and accelerations are no longer used.
    pub(crate) fn straighten(&mut self) {
        if self.kind == PathShape::Smooth {
            self.kind = PathShape::Straight;
        }
    }

    /// The first and the last parameter s.
    pub(crate) fn ends(&self) -> [f64; 2] {
        ends(self.kind, self.t)
    }

    /// True if neither time nor an input changes on the path.
    pub(crate) fn is_still(&self) -> bool {
        self.t[0] == self.t[1] && self.from.iter().zip(&self.to).all(|(a, b)| a.value == b.value)
    }

    /// The time at a parameter s.
    pub(crate) fn time(&self, s: f64) -> f64 {
        time(self.kind, self.t, s)
    }

    /// Writes the inputs at the parameter `since` after another one.
    pub(crate) fn write(&self, from: f64, since: f64, inputs: &mut [Signal]) {
        let [first, last] = self.ends();
        if since == 0.0 || self.kind == PathShape::Frozen {
            return write(self.kind, self.t, [&self.from, &self.to], from + since, inputs);
        }
        // Measured from the start of the path, parameters are not rounded to the spacing of numbers near t.
        write(self.kind, [0.0, last - first], [&self.from, &self.to], (from - first) + since, inputs);
    }
}

/// The quintic with value, rate and acceleration of `a` at x = 0 and of `b` at x = 1; derivatives are with respect to h
/// x.
fn quintic(a: &Signal, b: &Signal, h: f64, x: f64) -> Signal {
    if x == 0.0 || x == 1.0 {
        return if x == 0.0 { *a } else { *b };
    }
    let ends = [a, b].map(|u| [u.value, h * u.rate, h * u.acceleration * h]);
    let [value, rate, acceleration] = interpolated(ends, x);
    Signal { value, rate: rate / h, acceleration: acceleration / h / h }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    /// A quintic is its own interpolation.
    #[test]
    fn a_quintic_is_met_everywhere() {
        let u = |t: f64| {
            let value = 0.3 + t * (-0.2 + t * (0.7 + t * (0.4 + t * (-0.9 + t * 0.35))));
            let rate = -0.2 + t * (1.4 + t * (1.2 + t * (-3.6 + t * 1.75)));
            Signal::new(value, rate, 1.4 + t * (2.4 + t * (-10.8 + t * 7.0)))
        };
        let (from, to) = (0.4, 1.7);
        for k in 0..=10 {
            let x = f64::from(k) / 10.0;
            let (found, right) = (quintic(&u(from), &u(to), to - from, x), u(from + x * (to - from)));
            for (a, b) in
                [(found.value, right.value), (found.rate, right.rate), (found.acceleration, right.acceleration)]
            {
                assert!((a - b).abs() <= 1e-13, "{x}: {found:?} and {right:?}");
            }
        }
    }

    #[test]
    fn rates_are_believed_where_they_agree_with_the_values() {
        let mut way = InputPath::resting(&Instant { t: 0.0, inputs: &[Signal::default()] });
        let mut kind = |t: f64, from: Signal, to: Signal| {
            way.lead(&Instant { t: 0.0, inputs: &[from] }, &Instant { t, inputs: &[to] });
            way.kind
        };
        let fall = Signal::new(1.0, 0.0, -2.0);
        assert_eq!(PathShape::Smooth, kind(0.5, fall, fall.after(0.5)));
        assert_eq!(PathShape::Straight, kind(-0.5, fall, fall.after(-0.5)));
        assert_eq!(PathShape::Straight, kind(0.1, Signal::constant(0.2), Signal::constant(0.3)));
        assert_eq!(PathShape::Smooth, kind(0.1, Signal::constant(0.2), Signal::constant(0.2)));
        assert_eq!(PathShape::Frozen, kind(0.0, fall, Signal::constant(2.0)));
        // Either end predicts the other to within a quarter of the change.
        let signal = |value, rate| Signal::new(value, rate, 0.0);
        for (first, last, expected) in [
            (0.8, 1.0, PathShape::Smooth),
            (0.7, 1.0, PathShape::Straight),
            (1.0, 1.2, PathShape::Smooth),
            (1.0, 1.3, PathShape::Straight),
        ] {
            assert_eq!(expected, kind(1.0, signal(0.0, first), signal(1.0, last)), "{first} {last}");
        }
        assert_eq!(PathShape::Straight, kind(1e-9, fall, Signal::constant(2.0)));
    }
}
