//! Tests of lanes: comparison with std, in units in the last place.

use super::{Lanes, Octet, Pack};
use crate::random::Random;
use crate::scalar::Scalar;
use crate::scalar::compare::Compare;

const SPECIAL: [f64; 22] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    1e-310,
    1e-20,
    1e20,
    f64::MAX,
    f64::MIN,
    1e300,
    -1e300,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// The distance between two numbers of the same sign in units in the last place; 0 between two NaN.
fn ulps(a: f64, b: f64) -> u64 {
    if a.is_nan() && b.is_nan() { 0 } else { a.to_bits().abs_diff(b.to_bits()) }
}

/// Four random numbers of different orders of magnitude.
fn numbers(random: &mut Random) -> [f64; 4] {
    core::array::from_fn(|_| random.symmetric() * 10_f64.powf(4.0 * random.symmetric()))
}

#[track_caller]
fn compare(what: &str, most: u64, of: &[f64], found: Lanes, expected: [f64; 4]) {
    for (lane, (found, expected)) in found.to_array().into_iter().zip(expected).enumerate() {
        let steps = ulps(found, expected);
        assert!(steps <= most, "{what} of {of:?}, lane {lane}: {found:e} and {expected:e}, {steps} ulp");
    }
}

/// Compares a function of one argument with std, at random numbers up to `size` and at special values.
#[track_caller]
fn unary(what: &str, most: u64, size: f64, lanes: impl Fn(Lanes) -> Lanes, std: impl Fn(f64) -> f64) {
    let mut random = Random::new(11);
    let check = |x: [f64; 4]| compare(what, most, &x, lanes(Lanes::new(x)), x.map(&std));
    for _ in 0..10_000 {
        check(core::array::from_fn(|_| size * random.symmetric()));
        check(numbers(&mut random).map(|x| x.clamp(-size, size)));
    }
    for special in SPECIAL {
        // Special values beside ordinary ones, to test that lanes are independent.
        check([0.3, special, -0.7, special]);
        check([special; 4]);
    }
}

#[test]
fn arithmetic_is_that_of_f64() {
    let mut random = Random::new(3);
    for _ in 0..10_000 {
        let (a, b) = (numbers(&mut random), numbers(&mut random));
        let (x, y) = (Lanes::new(a), Lanes::new(b));
        let each = |f: fn(f64, f64) -> f64| core::array::from_fn(|lane| f(a[lane], b[lane]));
        compare("sum", 0, &a, x + y, each(|a, b| a + b));
        compare("difference", 0, &a, x - y, each(|a, b| a - b));
        compare("product", 0, &a, x * y, each(|a, b| a * b));
        compare("quotient", 0, &a, x / y, each(|a, b| a / b));
        compare("negative", 0, &a, -x, a.map(|a| -a));
    }
}

#[test]
fn exact_functions() {
    unary("sqrt", 0, 1e300, Scalar::sqrt, f64::sqrt);
    unary("abs", 0, 1e300, Scalar::abs, f64::abs);
    unary("signum", 0, 1e300, Scalar::signum, f64::signum);
    unary("exp", 0, 700.0, Scalar::exp, f64::exp);
    unary("ln", 0, 1e300, Scalar::ln, f64::ln);
    unary("powf", 0, 1e3, |x| x.powf(2.5), |x| x.powf(2.5));
}

#[test]
fn sines_and_cosines() {
    for size in [1.0, 7.0, 1e4, 1e9] {
        unary("sin", 1, size, |x| x.sin_cos().0, f64::sin);
        unary("cos", 1, size, |x| x.sin_cos().1, f64::cos);
        unary("tan", 3, size, Scalar::tan, f64::tan);
    }
}

/// The list function agrees with single evaluations for lists of any lengths; elements without a partner are unchanged.
#[test]
fn sines_and_cosines_of_lists() {
    fn check<T: Scalar + PartialEq + core::fmt::Debug>(value: impl Fn(usize) -> T, tolerance: impl Fn(T, T) -> bool) {
        for (angles, cosines) in [(0, 3), (1, 1), (2, 2), (3, 3), (7, 9), (17, 17), (40, 37)] {
            let list: Vec<T> = (0..angles).map(&value).collect();
            let (mut sines, mut found) = (list.clone(), vec![T::from_f64(7.0); cosines]);
            T::sin_cos_in_place(&mut sines, &mut found);
            for k in 0..angles.max(cosines) {
                if k < angles.min(cosines) {
                    let (sin, cos) = list[k].sin_cos();
                    assert!(tolerance(sines[k], sin) && tolerance(found[k], cos), "{k} of {angles}, {cosines}");
                } else {
                    assert!(sines.get(k) == list.get(k) && found.get(k).is_none_or(|cos| *cos == T::from_f64(7.0)));
                }
            }
        }
    }
    let angle = |k: usize| 1.7 * k as f64 - if k == 5 { 4e7 } else { 9.0 };
    check(angle, |a, b| (a - b).abs() < 2e-16);
    check(|k| angle(k) as f32, |a, b| (a - b).abs() < 2e-7);
    check(
        |k| Lanes::generate(|lane| angle(k + lane)),
        |a, b| a.to_array().iter().zip(b.to_array()).all(|(a, b)| (a - b).abs() < 2e-16),
    );
}

#[test]
fn inverse_functions() {
    unary("atan", 2, 1e6, Scalar::atan, f64::atan);
    unary("asin", 3, 1.0, Scalar::asin, f64::asin);
    unary("acos", 3, 1.0, Scalar::acos, f64::acos);
}

#[test]
fn angles_of_vectors() {
    let mut random = Random::new(5);
    let check = |y: [f64; 4], x: [f64; 4]| {
        let expected = core::array::from_fn(|lane| y[lane].atan2(x[lane]));
        let of: Vec<f64> = y.into_iter().zip(x).flat_map(|(y, x)| [y, x]).collect();
        compare("atan2 (y, x)", 2, &of, Lanes::new(y).atan2(Lanes::new(x)), expected);
    };
    for _ in 0..20_000 {
        check(core::array::from_fn(|_| random.symmetric()), core::array::from_fn(|_| random.symmetric()));
        check(numbers(&mut random), numbers(&mut random));
        // Ratios near 1/2, where the reduction changes, and near 1.
        let x: [f64; 4] = core::array::from_fn(|_| random.symmetric());
        check(x.map(|x| x * (0.5 + 1e-3 * random.symmetric())), x);
        check(x, x.map(|x| x * (1.0 + 1e-9 * random.symmetric())));
    }
    for y in SPECIAL {
        for x in SPECIAL {
            check([y, 0.1, y, -0.2], [x, -0.3, x, 0.4]);
        }
    }
}

#[test]
fn no_lane_sees_another() {
    let functions: [fn(Lanes) -> Lanes; 4] =
        [|x| x.sin_cos().0, |x| x.sin_cos().1, |x| x.atan2(Lanes::from(0.9)), |x| Lanes::from(0.9).atan2(x)];
    let mut random = Random::new(9);
    for function in functions {
        for _ in 0..2_000 {
            let x = numbers(&mut random);
            let alone = x.map(|x| function(Lanes::from(x)).to_array()[0]);
            for special in SPECIAL {
                let beside = function(Lanes::new([x[0], special, x[2], x[3]])).to_array();
                assert_eq!([alone[0], alone[2], alone[3]], [beside[0], beside[2], beside[3]], "{x:?} beside {special}");
            }
        }
    }
}

#[test]
fn turns_of_angles() {
    unary("nearest", 0, 1e3, |x| x.nearest(Lanes::from(-2.5)), |x| x.nearest(-2.5));
    assert_eq!(Lanes::from(0.1 + 3.0 * core::f64::consts::TAU), Lanes::from(0.1).nearest(Lanes::from(19.0)));
}

#[test]
fn within_a_bound_in_all_lanes() {
    assert!(Lanes::new([-2.0, 2.0, 1.0, -0.0]).is_within(2.0));
    for outside in [2.1, -2.1, f64::NAN, f64::NEG_INFINITY] {
        assert!(!Lanes::new([0.0, 0.0, outside, 1.0]).is_within(2.0));
    }
}

#[test]
fn integer_powers() {
    for n in [-7_i32, -2, -1, 0, 1, 2, 3, 4, 5, 10, 31] {
        let most = u64::from(n.unsigned_abs()) / 2 + 1;
        unary("powi", most, 30.0, |x| x.powi(n), |x| x.powi(n));
    }
    assert_eq!(Lanes::from(2.0).powi(i32::MIN), Lanes::from(0.0));
}

#[test]
fn supplied_functions_see_one_number_at_a_time() {
    let x = Lanes::new([1.0, 2.0, 3.0, 4.0]);
    let [f, f1, f2] = x.lift(|x| [x * x, 2.0 * x, x + 10.0]);
    assert_eq!([1.0, 4.0, 9.0, 16.0], f.to_array());
    assert_eq!([2.0, 4.0, 6.0, 8.0], f1.to_array());
    assert_eq!([11.0, 12.0, 13.0, 14.0], f2.to_array());
}

#[test]
fn octets_agree_with_lanes() {
    let mut random = Random::new(13);
    let mut special = SPECIAL.into_iter().cycle();
    let mut drawn = |is_special: bool| -> [f64; 8] {
        let numbers: [f64; 8] = core::array::from_fn(|_| random.symmetric() * 10_f64.powf(4.0 * random.symmetric()));
        if is_special { numbers.map(|x| if x < 0.0 { special.next().unwrap_or(x) } else { x }) } else { numbers }
    };
    let halves = |x: [f64; 8]| {
        let [a, b, c, d, e, f, g, h] = x;
        [Lanes::new([a, b, c, d]), Lanes::new([e, f, g, h])]
    };
    let octet = |x: [f64; 8]| Octet::generate(|lane| x[lane]);
    macro_rules! same {
        ($what:literal, $most:literal, $f:expr, $g:expr) => {
            for round in 0..2_000 {
                let (x, y) = (drawn(round % 4 == 0), drawn(round % 4 == 1));
                let (f, g): (fn(Octet, Octet) -> Octet, fn(Lanes, Lanes) -> Lanes) = ($f, $g);
                let (found, [a, b], [c, d]) = (f(octet(x), octet(y)), halves(x), halves(y));
                let expected = [g(a, c), g(b, d)];
                for lane in 0..8 {
                    let (found, expected) = (found.lane(lane), expected[lane / 4].to_array()[lane % 4]);
                    assert!(ulps(found, expected) <= $most, "{} of {x:?} and {y:?}: {found} for {expected}", $what);
                }
            }
        };
        ($($what:literal $most:literal $f:expr);*) => { $(same!($what, $most, $f, $f);)* };
    }
    // Where the instruction set is chosen at run time, octets may use another one than lanes.
    same!(
        "sum" 0 |x, y| x + y; "difference" 0 |x, y| x - y; "product" 0 |x, y| x * y; "quotient" 0 |x, y| x / y;
        "opposite" 0 |x, _| -x; "sine" 1 |x, _| x.sin_cos().0; "cosine" 1 |x, _| x.sin_cos().1;
        "sine of several" 1 |x, y| Scalar::sin_cos_all([y, x])[1].0; "angle" 2 |x, y| x.atan2(y);
        "angle of several" 2 |x, y| Scalar::atan2_all([(y, x), (x, y), (x, x)])[1]; "nearest" 0 |x, y| x.nearest(y);
        "tan" 3 |x, _| x.tan(); "asin" 2 |x, _| x.asin(); "acos" 2 |x, _| x.acos(); "atan" 2 |x, _| x.atan();
        "sqrt" 0 |x, _| x.sqrt(); "exp" 0 |x, _| x.exp(); "ln" 0 |x, _| x.ln(); "abs" 0 |x, _| x.abs();
        "signum" 0 |x, _| x.signum(); "powi" 0 |x, _| x.powi(-3); "powf" 0 |x, _| x.powf(1.5);
        "lift" 0 |x, _| x.lift(|x| [x, x * x, 2.0 * x])[1]
    );
    for lane in 0..8 {
        let mut x = Octet::from_f64(1.0);
        x.set(lane, -3.0);
        assert!((0..8).all(|other| x.lane(other) == if other == lane { -3.0 } else { 1.0 }) && !x.is_within(2.0));
    }
}

#[test]
fn octets_are_compared_number_by_number() {
    let numbers = [2.0, -5e-324, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, f64::NAN, -3.0];
    let octet = Octet::generate(|lane| numbers[lane]);
    let directions: [f64; 8] = core::array::from_fn(|lane| octet.direction().lane(lane));
    assert_eq!([1.0, -1.0, 1.0, -1.0, -1.0], [0, 1, 2, 3, 7].map(|lane| directions[lane]));
    assert!([4, 5, 6].into_iter().all(|lane| directions[lane].is_nan()));
    let one = Octet::from_f64(1.0);
    let (least, greatest) = (octet.least(one), octet.greatest(one));
    for lane in (0..8).filter(|lane| !numbers[*lane].is_nan()) {
        assert_eq!((numbers[lane].min(1.0), numbers[lane].max(1.0)), (least.lane(lane), greatest.lane(lane)));
    }
}

#[test]
fn numbers_are_read_in_blocks() {
    let numbers: Vec<f64> = (0..19).map(f64::from).collect();
    let (mut fours, mut eights) = (Vec::new(), Vec::new());
    assert_eq!(&numbers[16..], Lanes::read(&numbers, |k, x| fours.push((k, x))));
    assert_eq!(&numbers[16..], Octet::read(&numbers, |k, x| eights.push((k, x))));
    assert!(fours.into_iter().eq((0..4).map(|k| (k, Lanes::generate(|lane| (4 * k + lane) as f64)))));
    assert!(eights.into_iter().eq((0..2).map(|k| (k, Octet::generate(|lane| (8 * k + lane) as f64)))));
}
