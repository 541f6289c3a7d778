//! Functions of one argument, by the chain rule.

/// In an implementation of [`Scalar`](super::Scalar) for a number with the field `value` and the method `chain(value,
/// slope)`: functions of one argument by their values and slopes, and functions of the user by their derivatives.
macro_rules! functions_by_chain_rule {
    () => {
        functions_by_chain_rule! {
            tan |x, y| 1.0 + y * y;
            asin |x, y| 1.0 / Scalar::sqrt((1.0 - x) * (1.0 + x));
            acos |x, y| -1.0 / Scalar::sqrt((1.0 - x) * (1.0 + x));
            atan |x, y| 1.0 / (1.0 + x * x);
            sqrt |x, y| 0.5 / y;
            exp |x, y| y;
            ln |x, y| 1.0 / x;
            abs |x, y| if x == 0.0 { f64::NAN } else { Scalar::signum(x) };
            signum |x, y| if x == 0.0 { f64::NAN } else { 0.0 };
        }

        fn hypot(self, other: Self) -> Self {
            let length = libm::hypot(self.value, other.value);
            self.chain(length, self.value / length) + other.chain(0.0, other.value / length)
        }

        /// The number of whole turns is the same for variables nearby.
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn nearest(self, reference: Self) -> Self {
            Self { value: Scalar::nearest(self.value, reference.value), ..self }
        }

        /// Tests the value alone: a correction precedes the test, after which derivatives are correct, too.
        #[inline(always)]
        fn is_within(self, bound: f64) -> bool {
            Scalar::is_within(self.value, bound)
        }

        #[cfg_attr(not(debug_assertions), inline(always))]
        fn powi(self, n: i32) -> Self {
            let slope = if n == 0 { 0.0 } else { f64::from(n) * Scalar::powi(self.value, n.saturating_sub(1)) };
            self.chain(Scalar::powi(self.value, n), slope)
        }

        #[cfg_attr(not(debug_assertions), inline(always))]
        fn powf(self, n: f64) -> Self {
            let slope = if n == 0.0 { 0.0 } else { n * Scalar::powf(self.value, n - 1.0) };
            self.chain(Scalar::powf(self.value, n), slope)
        }

        fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
            let [f0, f1, f2] = f(self.value);
            [self.chain(f0, f1), self.chain(f1, f2), self.chain(f2, f64::NAN)]
        }

        fn compose(
            self,
            _: usize,
            f: impl Fn(f64) -> [f64; 3],
            derivatives: impl Fn(f64, &mut [f64]) -> usize,
        ) -> [Self; 3] {
            let mut known = [f64::NAN; 4];
            let third = if derivatives(self.value, &mut known) > 3 { known[3] } else { f64::NAN };
            let [f0, f1, f2] = f(self.value);
            [self.chain(f0, f1), self.chain(f1, f2), self.chain(f2, third)]
        }
    };
    ($($name:ident |$x:ident, $y:ident| $slope:expr;)*) => { $(
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $name(self) -> Self {
            let $x = self.value;
            let $y = Scalar::$name($x);
            self.chain($y, $slope)
        }
    )* };
}
pub(super) use functions_by_chain_rule;
