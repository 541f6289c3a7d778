//! How the coefficients of a function of power series follow from those of its arguments.
//!
//! With x(τ) = Σ x_k τᵏ every function of the language satisfies a differential equation with rational terms, which is
//! given beside it below. Comparing the coefficients of τᵏ gives the k-th from the lower ones in O(k) operations
//! (Griewank and Walther, *Evaluating Derivatives*, 2nd edition, 2008, chapter 13).

use super::Scalar;

/// A function of `I` series that gives `O` series: the results, then the auxiliary series of their recurrence.
pub(crate) trait Recurrence<const I: usize, const O: usize> {
    /// The k-th coefficients of all `O`, given those of the arguments `x` up to the k-th and of `y` below it.
    fn coefficient<X: AsRef<[f64]>, Y: AsRef<[f64]>>(&self, k: usize, x: &[X; I], y: &[Y; O]) -> [f64; O];
}

/// Σ a_i b_{k−i} over first ≤ i < end.
#[inline(always)]
fn convolution(a: &[f64], b: &[f64], k: usize, first: usize, end: usize) -> f64 {
    let mut sum = 0.0;
    for i in first..end {
        sum += a[i] * b[k - i];
    }
    sum
}

/// Σ i a_i b_{k−i} over 1 ≤ i < end, divided by k: the integral of a′ b, k ≥ 1.
#[inline(always)]
fn integral(a: &[f64], b: &[f64], k: usize, end: usize) -> f64 {
    let mut sum = 0.0;
    for i in 1..end {
        sum += i as f64 * a[i] * b[k - i];
    }
    sum * (1.0 / k as f64)
}

/// A recurrence that uses only coefficients of the same order: sums, and products with a number.
pub(crate) struct Each<F>(F);

/// `f` of the order and of the coefficients of that order.
#[inline(always)]
pub(crate) fn each<F: Fn(usize, [f64; I]) -> f64, const I: usize>(f: F) -> Each<F> {
    Each(f)
}

impl<F: Fn(usize, [f64; I]) -> f64, const I: usize> Recurrence<I, 1> for Each<F> {
    #[inline(always)]
    fn coefficient<X: AsRef<[f64]>, Y: AsRef<[f64]>>(&self, k: usize, x: &[X; I], _: &[Y; 1]) -> [f64; 1] {
        [self.0(k, core::array::from_fn(|i| x[i].as_ref()[k]))]
    }
}

/// `Name: arguments -> results, |self, k, [arguments], [results so far]| { the k-th coefficients }`.
macro_rules! recurrences {
    ($($(#[$doc:meta])* $Name:ident $({ $field:ident: $ty:ty })?: $inputs:literal -> $outputs:literal,
     |$this:ident, $k:ident, [$($x:ident),*], [$($y:ident),*]| $body:expr;)*) => { $(
        $(#[$doc])*
        pub(crate) struct $Name { $(pub(crate) $field: $ty)? }

        impl Recurrence<$inputs, $outputs> for $Name {
            #[inline(always)]
            fn coefficient<X: AsRef<[f64]>, Y: AsRef<[f64]>>(
                &self,
                $k: usize,
                x: &[X; $inputs],
                y: &[Y; $outputs],
            ) -> [f64; $outputs] {
                let ($this, [$($x),*], [$($y),*]) =
                    (self, x.each_ref().map(AsRef::as_ref), y.each_ref().map(AsRef::as_ref));
                let _ = ($this, $($y),*);
                $body
            }
        }
    )* };
}

recurrences! {
    /// c = a b: c_k = Σ a_i b_{k−i}.
    Product: 2 -> 1, |this, k, [a, b], [c]| [convolution(a, b, k, 0, k + 1)];

    /// c = a/b: from c b = a.
    Quotient: 2 -> 1, |this, k, [a, b], [c]| match k {
        0 => [a[0] / b[0]],
        _ => [(a[k] - convolution(b, c, k, 1, k + 1)) * (1.0 / b[0])],
    };

    /// r = √x: from r² = x. At x = 0 there is no derivative, and the division by 0 gives no finite number.
    Root: 1 -> 1, |this, k, [x], [r]| match k {
        0 => [Scalar::sqrt(x[0])],
        _ => [(x[k] - convolution(r, r, k, 1, k)) * (0.5 / r[0])],
    };

    /// p = xⁿ: from x p′ = n p x′. At x = 0 the derivatives of an order below n vanish, and those above do not exist
    /// unless x stays 0.
    Power { n: f64 }: 1 -> 1, |this, k, [x], [p]| match k {
        0 => [Scalar::powf(x[0], this.n)],
        _ if x[0] == 0.0 => {
            let vanishes = (k as f64) < this.n || this.n > 0.0 && x[1..=k].iter().all(|x| *x == 0.0);
            [if vanishes { 0.0 } else { f64::NAN }]
        }
        _ => [((this.n + 1.0) * integral(x, p, k, k + 1) - convolution(x, p, k, 1, k + 1)) / x[0]],
    };

    /// e = exp x: from e′ = e x′.
    Exponential: 1 -> 1, |this, k, [x], [e]| match k {
        0 => [Scalar::exp(x[0])],
        _ => [integral(x, e, k, k + 1)],
    };

    /// l = ln x: from x l′ = x′.
    Logarithm: 1 -> 1, |this, k, [x], [l]| match k {
        0 => [Scalar::ln(x[0])],
        _ => [(x[k] - integral(l, x, k, k)) / x[0]],
    };

    /// s = sin x and c = cos x: from s′ = c x′, c′ = −s x′; `at_zero` has both at τ = 0.
    Turning { at_zero: (f64, f64) }: 1 -> 2, |this, k, [x], [s, c]| match k {
        0 => this.at_zero.into(),
        _ => [integral(x, c, k, k + 1), -integral(x, s, k, k + 1)],
    };

    /// t = tan x, and w = 1 + t²: from t′ = w x′.
    Tangent: 1 -> 2, |this, k, [x], [t, w]| match k {
        0 => {
            let t = Scalar::tan(x[0]);
            [t, 1.0 + t * t]
        }
        _ => {
            let next = integral(x, w, k, k + 1);
            [next, 2.0 * t[0] * next + convolution(t, t, k, 1, k)]
        }
    };

    /// y = atan x, and w = 1 + x²: from w y′ = x′.
    ArcTangent: 1 -> 2, |this, k, [x], [y, w]| match k {
        0 => [Scalar::atan(x[0]), 1.0 + x[0] * x[0]],
        _ => [(x[k] - integral(y, w, k, k)) / w[0], convolution(x, x, k, 0, k + 1)],
    };

    /// θ = atan2(y, x), and w = x² + y²: from w θ′ = x y′ − y x′; `at_zero` has θ at τ = 0.
    ArcTangent2 { at_zero: f64 }: 2 -> 2, |this, k, [y, x], [theta, w]| {
        let square = convolution(x, x, k, 0, k + 1) + convolution(y, y, k, 0, k + 1);
        match k {
            0 => [this.at_zero, square],
            _ => {
                let turning = integral(y, x, k, k + 1) - integral(x, y, k, k + 1);
                [(turning - integral(theta, w, k, k)) * (1.0 / w[0]), square]
            }
        }
    };

    /// y = asin x, or with the sign −1 acos x, and u = √(1 − x²): from u y′ = ±x′.
    Arc { sign: f64 }: 1 -> 2, |this, k, [x], [y, u]| match k {
        0 => {
            let angle = if this.sign < 0.0 { Scalar::acos(x[0]) } else { Scalar::asin(x[0]) };
            [angle, Scalar::sqrt((1.0 - x[0]) * (1.0 + x[0]))]
        }
        _ => [
            (this.sign * x[k] - integral(y, u, k, k)) / u[0],
            (convolution(x, x, k, 0, k + 1) + convolution(u, u, k, 1, k)) * (-0.5 / u[0]),
        ],
    };

    /// |x|: x with the sign that it has at τ = 0.
    Absolute: 1 -> 1, |this, k, [x], [a]| [if k == 0 { Scalar::abs(x[0]) } else { sign(x, k) * x[k] }];

    /// The sign of x: constant, where it has a derivative.
    Sign: 1 -> 1, |this, k, [x], [s]| [if k == 0 { Scalar::signum(x[0]) } else { 0.0 * sign(x, k) }];
}

/// The sign of x where it has one, 0 where x stays 0, and NaN where x passes through 0.
#[inline]
fn sign(x: &[f64], k: usize) -> f64 {
    if x[0] != 0.0 {
        return Scalar::signum(x[0]);
    }
    if x[1..=k].iter().all(|x| *x == 0.0) { 0.0 } else { f64::NAN }
}

/// f(x(τ)), f′(x(τ)) and f″(x(τ)), given f, f′, f″, … at x_0: Σ f⁽ᵐ⁾(x_0)/m! uᵐ with u = x − x_0. `powers` is a buffer
/// for the powers of u.
///
/// An unknown derivative is NaN. It is multiplied only by coefficients of uᵐ other than 0, so that a constant argument
/// needs none.
pub(crate) fn compose(x: &[f64], derivatives: &[f64], powers: &mut [f64], results: &mut [&mut [f64]; 3]) {
    for (order, result) in results.iter_mut().enumerate() {
        result.fill(0.0);
        result[0] = derivatives[order];
    }
    powers.fill(0.0);
    powers[0] = 1.0;
    let mut factorial = 1.0;
    for m in 1..x.len() {
        factorial *= m as f64;
        // The lowest power of τ in uᵐ is m, and m − 1 in uᵐ⁻¹.
        for k in (m..x.len()).rev() {
            powers[k] = convolution(x, powers, k, 1, k - m + 2);
        }
        powers[m - 1] = 0.0;
        for (order, result) in results.iter_mut().enumerate() {
            let part = derivatives[order + m] / factorial;
            for (result, power) in result.iter_mut().zip(&*powers).skip(m).filter(|(_, power)| **power != 0.0) {
                *result += part * power;
            }
        }
    }
}
