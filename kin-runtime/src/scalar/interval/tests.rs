//! Compares intervals with exact fractions, and with series in fixed point with 200 bits.

use super::Interval;
use crate::random::Random;
use crate::scalar::Scalar;
use num_bigint::BigInt;
use num_rational::BigRational;

/// How many operands of every operation are drawn; a million in all with optimisation.
const DRAWN: usize = if cfg!(debug_assertions) { 1_000 } else { 100_000 };
/// Fractional bits of fixed-point numbers.
const BITS: usize = 200;
/// More than the rounding error of a series, in units in the last place of fixed-point numbers.
const SLACK: u32 = 1 << 12;

/// A number of any size up to 2^±`exponents`; now and then a special one.
fn draw(random: &mut Random, exponents: f64) -> f64 {
    const SPECIAL: [f64; 8] = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 1e-300];
    let pick = random.symmetric();
    if pick > 0.9 {
        return SPECIAL[((pick - 0.9) * 80.0) as usize % 8];
    }
    random.symmetric() * (exponents * random.symmetric()).exp2()
}

/// An interval with one of the numbers in it.
fn draw_interval(random: &mut Random, exponents: f64) -> (Interval, f64) {
    let (a, b) = (draw(random, exponents), draw(random, exponents));
    let near = if random.symmetric() > 0.0 { b } else { a + 1e-9 * b };
    let within = a + (near - a) * 0.5 * (1.0 + random.symmetric());
    let interval = Interval::new(a.min(near), a.max(near));
    (interval, within.clamp(interval.lower(), interval.upper()))
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("a finite number")
}

#[track_caller]
fn holds(interval: Interval, value: &BigRational, what: &str) {
    assert!(interval.is_defined(), "{what}: undefined");
    let above = interval.lower() == f64::NEG_INFINITY || exact(interval.lower()) <= *value;
    let below = interval.upper() == f64::INFINITY || *value <= exact(interval.upper());
    assert!(above && below, "{what}: {interval}");
}

#[track_caller]
fn holds_all(intervals: [Interval; 2], value: &BigRational, what: &str) {
    intervals.into_iter().for_each(|interval| holds(interval, value, what));
}

/// 2^`BITS` x, rounded down.
fn fixed(x: f64) -> BigInt {
    (exact(x) * BigRational::from(BigInt::from(1) << BITS)).floor().to_integer()
}

fn times(a: &BigInt, b: &BigInt) -> BigInt {
    (a * b) >> BITS
}

/// π by Machin's formula.
fn pi() -> BigInt {
    let arctan = |n: i32| {
        let (mut term, mut sum, mut k) = ((BigInt::from(1) << BITS) / n, BigInt::from(0), 1);
        while term != BigInt::from(0) {
            sum += if k % 4 == 1 { &term / k } else { -&term / k };
            (term, k) = (term / (n * n), k + 2);
        }
        sum
    };
    (arctan(5) * 4 - arctan(239)) * 4
}

/// The even and the odd part of the exponential series at a small x; with `turn` cosine and sine.
fn series(x: &BigInt, turn: bool) -> (BigInt, BigInt) {
    let (mut sums, mut term) = ([BigInt::from(0), BigInt::from(0)], BigInt::from(1) << BITS);
    for n in 1..200 {
        let sign = if turn && (n - 1) % 4 >= 2 { -1 } else { 1 };
        sums[(n - 1) % 2] += &term * sign;
        term = times(&term, x) / n;
        if term == BigInt::from(0) || term == BigInt::from(-1) {
            break;
        }
    }
    let [even, odd] = sums;
    (even, odd)
}

/// Sine and cosine in fixed point.
fn sin_cos(x: f64, pi: &BigInt) -> (BigInt, BigInt) {
    let x = fixed(x);
    let quarters: BigInt = (&x * 2 + pi / 2) / pi - if x < BigInt::from(0) { 1 } else { 0 };
    let rest = &x - &quarters * pi / 2;
    let (cos, sin) = series(&rest, true);
    let quarter = quarters & BigInt::from(3);
    match () {
        () if quarter == BigInt::from(0) => (sin, cos),
        () if quarter == BigInt::from(1) => (cos, -sin),
        () if quarter == BigInt::from(2) => (-sin, -cos),
        () => (-cos, sin),
    }
}

/// The exponential in fixed point, of numbers up to 40.
fn exp(x: f64) -> BigInt {
    let (even, odd) = series(&fixed(x / 64.0), false);
    (0..6).fold(even + odd, |power, _| times(&power, &power))
}

#[track_caller]
fn holds_fixed(interval: Interval, value: &BigInt, what: &str) {
    assert!(interval.is_defined(), "{what}: undefined");
    let (below, above) = (value - SLACK, value + SLACK);
    assert!(fixed(interval.lower()) <= above && below <= fixed(interval.upper()), "{what}: {interval}");
}

#[test]
fn arithmetic_holds_exact_fractions() {
    let mut random = Random::new(1);
    for k in 0..DRAWN {
        let ((a, x), (b, y)) = (draw_interval(&mut random, 30.0), draw_interval(&mut random, 30.0));
        let (p, q) = (Interval::from(x), Interval::from(y));
        let what = format!("{k}: {x:e} in {a}, {y:e} in {b}");
        let (x, y) = (exact(x), exact(y));
        holds_all([a + b, p + q], &(&x + &y), &what);
        holds_all([a - b, p - q], &(&x - &y), &what);
        holds_all([a * b, p * q], &(&x * &y), &what);
        holds_all([a.square(), p.square()], &(&x * &x), &what);
        assert!(a.square().lower() >= 0.0 && a.square().upper() == (a * a).upper(), "{what}");
        holds(-a, &-&x, &what);
        holds(a.abs(), &if x < exact(0.0) { -&x } else { x.clone() }, &what);
        for n in [0, 2, 3, 5] {
            holds(a.powi(n), &power(&x, n), &what);
        }
        if b.contains(0.0) {
            assert!(!(a / b).is_defined() && !b.powi(-2).is_defined(), "{what}");
        } else {
            holds(a / b, &(&x / &y), &what);
            // Powers that underflow may be 0.
            if b.powi(3).contains(0.0) {
                assert!(!b.powi(-3).is_defined(), "{what}");
            } else {
                holds(b.powi(-3), &(exact(1.0) / power(&y, 3)), &what);
            }
        }
        if a.lower() < 0.0 {
            assert!(!a.sqrt().is_defined(), "{what}");
        } else {
            let root = Interval::from(a.lower()).sqrt();
            let [below, above] = [root.lower(), root.upper()].map(exact);
            let x = exact(a.lower());
            assert!(&below * &below <= x && x <= &above * &above, "{what}");
            assert!(a.sqrt().lower() <= root.lower() && a.sqrt().upper() >= root.upper(), "{what}");
        }
    }
}

fn power(x: &BigRational, n: i32) -> BigRational {
    (0..n).fold(exact(1.0), |product, _| product * x)
}

/// Ends at special cases of rounding: exact sums and products, halves of the last place, subnormal and huge numbers.
#[test]
fn ends_at_borders_are_rounded_outwards() {
    let tiny = f64::from_bits(1);
    let numbers =
        [0.0, tiny, f64::MIN_POSITIVE, f64::MIN_POSITIVE - tiny, f64::EPSILON, 0.5, 1.0, 3.0, 1e308, f64::MAX];
    let near = |x: f64| [x.next_down(), x, x.next_up(), -x].into_iter().filter(|x| x.is_finite());
    let all: Vec<f64> = numbers.into_iter().flat_map(near).collect();
    for &x in &all {
        for &y in &all {
            let what = format!("{x:e}, {y:e}");
            let (p, q) = (Interval::from(x), Interval::from(y));
            let wide = Interval::new(x.min(-y), x.max(-y));
            holds_all([p + q, Interval::new(x.min(1.0), x.max(1.0)) + q], &(exact(x) + exact(y)), &what);
            holds_all([p * q, wide * q], &(exact(x) * exact(y)), &what);
            holds(wide * wide, &(exact(x) * exact(-y)), &what);
            if y != 0.0 {
                holds(p / q, &(exact(x) / exact(y)), &what);
            }
        }
    }
}

/// What is positive stays so, however small it is: its root is defined.
#[test]
fn roots_of_small_products_and_quotients_are_defined() {
    let (one, small) = (Interval::from(1.0), Interval::new(1e-300, 2e-300));
    for positive in
        [small * small, -small * -small, small / Interval::from(1e300), one / Interval::new(1.0, f64::INFINITY)]
    {
        assert!(positive.lower() >= 0.0 && positive.sqrt().is_defined(), "{positive}");
    }
    assert!((one / (Interval::new(1.0, 1e308) * Interval::from(1e10))).sqrt().is_defined());
    assert!((small * -small).lower() < 0.0 && (small * -small).upper() >= 0.0);
}

#[test]
fn sines_and_cosines_hold_their_series() {
    let (mut random, pi) = (Random::new(2), pi());
    for k in 0..DRAWN {
        // Also near multiples of π/2.
        let multiple = (1e5 * random.symmetric()).round() * core::f64::consts::FRAC_PI_2;
        let x = if k % 4 == 0 { multiple } else { draw(&mut random, 19.0) };
        let width = draw(&mut random, 3.0).abs();
        let (within, box_) = (Interval::from(x), Interval::new(x - 0.3 * width, x + width));
        let (sin, cos) = sin_cos(x, &pi);
        for interval in [within, box_] {
            let (s, c) = interval.sin_cos();
            holds_fixed(s, &sin, &format!("sin {x:e} in {interval}"));
            holds_fixed(c, &cos, &format!("cos {x:e} in {interval}"));
            let tan = interval.tan();
            if tan.is_defined() {
                let [below, above] = [tan.lower(), tan.upper()].map(|t| (fixed(t) * &cos) >> BITS);
                let (below, above) = if cos > BigInt::from(0) { (below, above) } else { (above, below) };
                let slack = BigInt::from(1) << (BITS - 90 + 30);
                assert!(below <= &sin + &slack && sin <= above + &slack, "tan {x:e}: {tan}");
            }
        }
        let (s, c) = within.sin_cos();
        assert!(s.radius() < 1e-15 && c.radius() < 1e-15, "{x}: {s} {c}");
        // A narrow interval has the values at its ends, and hardly more than those between them.
        let narrow = Interval::around(x, 10_f64.powf(-10.0 - 6.0 * random.symmetric()));
        let (s, c) = narrow.sin_cos();
        for end in [narrow.lower(), narrow.upper()] {
            let (sin, cos) = sin_cos(end, &pi);
            holds_fixed(s, &sin, &format!("sin {end:e} in {narrow}"));
            holds_fixed(c, &cos, &format!("cos {end:e} in {narrow}"));
        }
        let most = narrow.radius() * (1.0 + narrow.radius()) + 1e-15;
        assert!(s.radius() <= most * (c.magnitude() + narrow.radius()).min(1.0) + 1e-15, "{narrow}: {s}");
        assert!(c.radius() <= most * (s.magnitude() + narrow.radius()).min(1.0) + 1e-15, "{narrow}: {c}");
    }
    let whole = Interval::new(-1.0, 1.0);
    assert_eq!(Interval::new(0.0, 7.0).sin_cos(), (whole, whole));
    assert_eq!(Interval::from(1e9).sin_cos(), (whole, whole));
    assert_eq!(Interval::from(0.0).sin_cos(), (Interval::ZERO, Interval::from(1.0)));
    assert!(!Interval::new(1.0, 2.0).tan().is_defined());
}

#[test]
fn angles_hold_those_of_their_vectors() {
    let (mut random, pi) = (Random::new(3), pi());
    for _ in 0..DRAWN {
        let ((a, y), (b, x)) = (draw_interval(&mut random, 8.0), draw_interval(&mut random, 8.0));
        let what = format!("{y:e} in {a}, {x:e} in {b}");
        let (jumps, origin) =
            (a.lower() < 0.0 && a.upper() >= 0.0 && b.lower() < 0.0, a.contains(0.0) && b.contains(0.0));
        let angle = a.atan2(b);
        assert_eq!(angle.is_defined(), !jumps && !origin, "{what}");
        let pointwise = Interval::from(y + 0.0).atan2(Interval::from(x));
        for angle in [angle, pointwise].into_iter().filter(|angle| angle.is_defined()) {
            // The vector is counter-clockwise of the lower end, and clockwise of the upper one, or far from both.
            let across = |theta: f64| {
                let (sin, cos) = sin_cos(theta, &pi);
                let along: BigInt = times(&fixed(x), &cos) + times(&fixed(y), &sin);
                let across: BigInt = times(&fixed(y), &cos) - times(&fixed(x), &sin);
                (along > BigInt::from(0)).then_some(across)
            };
            let slack = BigInt::from(1) << 60;
            assert!(across(angle.lower()).is_none_or(|across| across >= -&slack), "{what}: {angle}");
            assert!(across(angle.upper()).is_none_or(|across| across <= slack), "{what}: {angle}");
            let library = y.atan2(x);
            assert!(angle.lower() - 1e-9 < library && library < angle.upper() + 1e-9, "{what}: {angle} {library}");
        }
        if pointwise.is_defined() {
            assert!(pointwise.radius() < 4e-15, "{what}: {pointwise}");
        }
        let (s, inside) = (Interval::new(-1.0, 1.0), random.symmetric());
        for arc in [Interval::from(inside).asin(), s.asin(), Interval::from(inside).acos() - s.acos()] {
            assert!(arc.is_defined());
        }
        let arc = Interval::from(inside).asin();
        assert!(
            sin_cos(arc.lower(), &pi).0 <= fixed(inside) + SLACK
                && fixed(inside) <= sin_cos(arc.upper(), &pi).0 + SLACK
        );
        let arc = Interval::from(inside).acos();
        assert!(
            sin_cos(arc.lower(), &pi).1 + SLACK >= fixed(inside)
                && fixed(inside) + SLACK >= sin_cos(arc.upper(), &pi).1
        );
    }
    assert!(!Interval::new(0.5, 1.1).asin().is_defined() && !Interval::from(-1.1).acos().is_defined());
    assert!(Interval::from(0.0).atan2(Interval::from(-2.0)).contains(core::f64::consts::PI));
    // Close to the jump: a y that a division makes 0 still determines the side of the x axis.
    for y in [5e-324, 1e-310, f64::MIN_POSITIVE] {
        for x in [-1.0, -4.0, -3e7, -1e300, -f64::MAX] {
            let [above, below] = [y, -y].map(|y| Interval::from(y).atan2(Interval::from(x)));
            assert!(above.contains(core::f64::consts::PI) && above.radius() < 4e-15, "{y:e} {x:e}: {above}");
            assert!(below.contains(-core::f64::consts::PI) && below.radius() < 4e-15, "{y:e} {x:e}: {below}");
        }
    }
}

#[test]
fn exponentials_and_logarithms_hold_their_series() {
    let mut random = Random::new(4);
    for _ in 0..DRAWN {
        let (a, x) = draw_interval(&mut random, 5.0);
        let value = exp(x);
        for power in [a.exp(), Interval::from(x).exp()] {
            holds_fixed(power, &value, &format!("exp {x} in {a}"));
        }
        let narrow = Interval::from(x).exp();
        assert!(narrow.radius() <= 1e-14 * narrow.lower(), "exp {x}: {narrow}");
        let y = 30.0 * random.symmetric();
        let x = y.exp();
        let log = Interval::from(x).ln();
        assert!(exp(log.lower()) <= fixed(x) + SLACK && fixed(x) <= exp(log.upper()) + SLACK, "ln {x:e}: {log}");
        assert!(log.radius() < 1e-13, "ln {x:e}: {log}");
        // √x is x to the power of one half.
        let [half, root] = [Interval::from(x).powf(0.5), Interval::from(x).sqrt()];
        assert!(half.intersection(root).is_some(), "{half} {root}");
    }
    for x in [-800.0, -745.0, 709.5, 800.0, 1e300] {
        let power = Interval::from(x).exp();
        assert!(power.contains(x.exp()) || power.upper() == f64::INFINITY, "{x}: {power}");
    }
    for x in [5e-324, f64::MIN_POSITIVE, 1.0, f64::MAX] {
        assert!(Interval::from(x).ln().contains(x.ln()), "{x:e}: {}", Interval::from(x).ln());
    }
    assert!(!Interval::new(0.0, 1.0).ln().is_defined());
}

#[test]
fn what_is_not_known_spreads() {
    let one = Interval::from(1.0);
    let unknown = one / Interval::ZERO;
    let results = [unknown + one, one * unknown, Interval::ZERO * unknown, one / unknown, -unknown, unknown.abs()];
    let functions = [unknown.sin_cos().0, unknown.exp(), unknown.atan(), unknown.signum(), unknown.powi(2)];
    assert!(results.into_iter().chain(functions).all(|result| !result.is_defined()));
    assert!(!unknown.is_within(f64::INFINITY) && unknown.intersection(one).is_none());
    assert!(!Interval::from(f64::NAN).is_defined() && !Interval::from(f64::INFINITY).is_defined());
    assert!(!Interval::new(2.0, 1.0).is_defined());
    // A result that overflows is unbounded, but defined.
    let large = Interval::from(f64::MAX) * Interval::from(2.0);
    assert_eq!((large.lower(), large.upper()), (f64::MAX, f64::INFINITY));
    assert!((one / large).contains(0.0) && (Interval::ZERO * Interval::ENTIRE) == Interval::ZERO);
    assert_eq!(Interval::new(-1.0, 2.0).signum(), Interval::new(-1.0, 1.0));
}

#[test]
fn whole_turns_are_the_same_for_all_numbers() {
    let near = Interval::new(0.1, 0.2).nearest(Interval::from(6.3));
    assert!(near.contains(0.15 + core::f64::consts::TAU) && near.radius() < 0.051);
    assert!(!Interval::new(0.1, 0.2).nearest(Interval::from(0.15 + core::f64::consts::PI)).is_defined());
}

#[test]
fn supplied_functions_are_known_at_single_numbers() {
    let square = |x: f64| [x * x, 2.0 * x, 2.0];
    assert_eq!(Interval::from(3.0).lift(square)[1], Interval::from(6.0));
    assert!(!Interval::new(3.0, 3.1).lift(square)[0].is_defined());
}
