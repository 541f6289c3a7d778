use super::*;
use kin_core::vocabulary::UnknownKind;

/// For every function, the series of f(x(τ)) at τ = h agrees with the value of f there.
#[test]
fn series_reach_the_values_around() {
    type T = Taylor<16>;
    fn check(name: &str, f: fn(T) -> T, at: f64) {
        let series = f(T::variable(at));
        for h in [0.05, -0.05] {
            let reached = series.coefficients().iter().rev().fold(0.0, |sum, c| sum * h + c);
            let expected = f(T::from_f64(at + h)).value();
            assert!((reached - expected).abs() < 1e-13 * (1.0 + expected.abs()), "{name}: {reached} {expected}");
        }
    }
    check("sine", |x| (x * x).sin_cos().0, 0.7);
    check("cosine", |x| (x * x).sin_cos().1, 0.7);
    check("tangent", |x| (x * x).tan(), 0.4);
    check("arc sine", |x| (x * x).asin(), 0.4);
    check("arc cosine", |x| (x * x).acos(), 0.4);
    check("arc tangent", |x| (x * x).atan(), 0.4);
    check("angle", |x| x.atan2(T::from_f64(1.0) - x * x), 1.3);
    check("root", |x| (T::from_f64(1.0) + x * x).sqrt(), 0.4);
    check("exponential", |x| (x * x).exp(), 0.4);
    check("logarithm", |x| (T::from_f64(1.0) + x * x).ln(), 0.4);
    check("absolute value", |x| (x - T::from_f64(2.0)).abs(), 0.4);
    check("sign", |x| (x - T::from_f64(2.0)).signum(), 0.4);
    check("power", |x| x.powf(2.5), 0.9);
    check("whole power", |x| x.powi(7), 0.0);
    check("negative power", |x| x.powi(-3), 0.9);
    check("quotients", |x| T::from_f64(1.0) / x - x / (T::from_f64(3.0) - x) - x / T::from_f64(3.0), 0.9);
    check("sums", |x| T::from_f64(1.0) - (x - T::from_f64(3.0)) + (-x - x) * T::from_f64(3.0), 0.9);
    check("nearest angle", |x| x.nearest(x + T::from_f64(13.0)), 0.9);
}

/// A cube composed from its derivatives, as supplied functions are; and functions whose higher derivatives are unknown.
#[test]
fn supplied_functions_are_composed() {
    let x = Taylor::<6>::variable(0.5);
    let inner = x * x;
    let cube = |x: f64| [x.powi(3), 3.0 * x * x, 6.0 * x];
    let all = |x: f64, out: &mut [f64]| {
        out.fill(0.0);
        out[..3].copy_from_slice(&cube(x));
        out[3] = 6.0;
        out.len()
    };
    let found = inner.compose(0, cube, all);
    let expected = [inner.powi(3), inner.powi(2) * Taylor::from_f64(3.0), inner * Taylor::from_f64(6.0)];
    for (found, expected) in found.iter().zip(&expected) {
        let pairs = found.coefficients().into_iter().zip(expected.coefficients());
        pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-14, "{found} {expected}"));
    }
    let [value, slope, _] = inner.lift(cube);
    assert_eq!(found[0].coefficients()[..3], value.coefficients()[..3]);
    assert!(value.coefficients()[3].is_nan() && slope.coefficients()[2].is_nan());
    assert_eq!(2.0_f64.powi(3), Taylor::<6>::from_f64(2.0).lift(cube)[0].value());
}

/// From a start with a correct first coefficient, the given number of corrections finds all other coefficients.
#[test]
fn iterations_find_every_coefficient() {
    fn root<const N: usize>() {
        // The equation x² = 4 + τ.
        let square = Taylor::<N>::variable(4.0);
        let mut x = [Taylor::from_f64(2.0)];
        let two = Taylor::from_f64(2.0);
        let good = crate::plan::iterate(&mut x, [0], [UnknownKind::Length], |[x]| [(*x * *x - square) / (two * *x)]);
        let expected = square.sqrt().coefficients();
        assert_eq!(1.0, good.value());
        let pairs = x[0].coefficients().into_iter().zip(expected);
        pairs.for_each(|(a, b)| assert!((a - b).abs() <= 1e-14 * b.abs(), "{N}: {} {expected:?}", x[0]));
    }
    root::<4>();
    root::<5>();
    root::<11>();
    root::<16>();
}
