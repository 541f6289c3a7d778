//! Dual numbers of num-dual as [`Scalar`]: first derivatives ([`Dual`]), second ([`Dual2`]), mixed ([`HyperDual`]), and
//! each of them nested in another.

use crate::scalar::Scalar;
use num_dual::{Dual, Dual2, DualNum, HyperDual};

/// An unknown derivative.
fn unknown<T: Scalar>() -> T {
    <T as Scalar>::from_f64(f64::NAN)
}

/// (f, f′, f″) at a dual number.
fn lift_dual<T: Scalar>(x: Dual<T>, f: impl Fn(f64) -> [f64; 3]) -> [Dual<T>; 3] {
    let [f0, f1, f2] = x.re.lift(f);
    [Dual::new(f0, f1 * x.eps), Dual::new(f1, f2 * x.eps), Dual::new(f2, unknown())]
}

/// (f, f′, f″) at a dual number of second order.
fn lift_dual2<T: Scalar>(x: Dual2<T>, f: impl Fn(f64) -> [f64; 3]) -> [Dual2<T>; 3] {
    let [f0, f1, f2] = x.re.lift(f);
    [
        Dual2::new(f0, f1 * x.v1, f1 * x.v2 + f2 * x.v1 * x.v1),
        Dual2::new(f1, f2 * x.v1, unknown()),
        Dual2::new(f2, unknown(), unknown()),
    ]
}

/// (f, f′, f″) at a hyper-dual number.
fn lift_hyper<T: Scalar>(x: HyperDual<T>, f: impl Fn(f64) -> [f64; 3]) -> [HyperDual<T>; 3] {
    let [f0, f1, f2] = x.re.lift(f);
    let mixed = f1 * x.eps1eps2 + f2 * x.eps1 * x.eps2;
    [
        HyperDual::new(f0, f1 * x.eps1, f1 * x.eps2, mixed),
        HyperDual::new(f1, f2 * x.eps1, f2 * x.eps2, unknown()),
        HyperDual::new(f2, unknown(), unknown(), unknown()),
    ]
}

/// The functions that num-dual has, under the names that generated code uses.
macro_rules! dual {
    ($($dual:ident $lift:ident),*) => { $(
        impl<T: Scalar + DualNum<Primitive = f64>> Scalar for $dual<T> {
            fn from_f64(value: f64) -> Self {
                Self::from_re(<T as Scalar>::from_f64(value))
            }

            fn sin_cos(self) -> (Self, Self) {
                DualNum::sin_cos(&self)
            }

            dual!(@unary tan asin acos atan sqrt exp ln);

            fn atan2(self, x: Self) -> Self {
                // num-dual's own divides by x even where x is 0. The angles of the two quotients differ by a constant,
                // so that their derivatives agree.
                let steep = Scalar::abs(x) < Scalar::abs(self);
                let quotient = if steep { -DualNum::atan(&(x / self)) } else { DualNum::atan(&(self / x)) };
                Self { re: Scalar::atan2(self.re, x.re), ..quotient }
            }

            fn abs(self) -> Self {
                if self < 0.0 { -self } else { self }
            }

            fn signum(self) -> Self {
                <Self as Scalar>::from_f64(if self < 0.0 { -1.0 } else { 1.0 })
            }

            fn powi(self, n: i32) -> Self {
                DualNum::powi(&self, n)
            }

            fn powf(self, n: f64) -> Self {
                DualNum::powf(&self, n)
            }

            fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
                $lift(self, f)
            }
        }
    )* };
    (@unary $($name:ident)*) => { $(
        fn $name(self) -> Self {
            DualNum::$name(&self)
        }
    )* };
}

dual!(Dual lift_dual, Dual2 lift_dual2, HyperDual lift_hyper);

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::{Dual2_64, Dual64};

    /// x³ with two derivatives, as a supplied function gives them.
    fn cube(x: f64) -> [f64; 3] {
        [x.powi(3), 3.0 * x * x, 6.0 * x]
    }

    #[test]
    fn supplied_functions_follow_the_chain_rule() {
        let [f, f1, f2] = Dual64::new(2.0, 5.0).lift(cube);
        assert_eq!((f.re, f.eps), (8.0, 60.0));
        assert_eq!((f1.re, f1.eps), (12.0, 60.0));
        assert!(f2.re == 12.0 && f2.eps.is_nan());

        let [f, ..] = Dual2_64::new(2.0, 5.0, 7.0).lift(cube);
        let direct = Scalar::powi(Dual2_64::new(2.0, 5.0, 7.0), 3);
        assert_eq!((f.re, f.v1, f.v2), (direct.re, direct.v1, direct.v2));

        let inner = Dual64::new(2.0, 1.0);
        let [f, ..] = Dual::new(inner, Dual64::from_re(1.0)).lift(cube);
        assert_eq!(f.eps.eps, 12.0);
    }

    #[test]
    fn functions_have_their_derivatives() {
        let x = Dual64::new(0.3, 1.0);
        let check = |f: Dual64, slope: f64| assert!((f.eps - slope).abs() < 1e-15, "{f} {slope}");
        check(Scalar::sin_cos(x).0, 0.3_f64.cos());
        check(Scalar::tan(x), 1.0 / 0.3_f64.cos().powi(2));
        check(Scalar::atan2(x, Dual64::from_f64(2.0)), 2.0 / (4.0 + 0.09));
        // Straight up, where x is 0; and beside it the second derivative, 2xy/(x² + y²)².
        check(Scalar::atan2(Dual64::from_f64(2.0), x - 0.3), -0.5);
        let bent = Scalar::atan2(Dual2_64::from_f64(2.0), Dual2_64::new(0.5, 1.0, 0.0));
        assert!((bent.v2 - 2.0 * 0.5 * 2.0 / 4.25_f64.powi(2)).abs() < 1e-15, "{bent}");
        check(Scalar::abs(-x), 1.0);
        check(Scalar::powf(x, 2.5), 2.5 * 0.3_f64.powf(1.5));
        assert_eq!(Scalar::signum(-x).re, -1.0);
    }
}
