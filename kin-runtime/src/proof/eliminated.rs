//! Angles that occur in one loop only, eliminated.
//!
//! The angle φ of a body that is pinned to its neighbours occurs in the two closure equations of a loop as
//!
//! ```text
//! f = a(u) + M (cos φ, sin φ)        M constant
//! ```
//!
//! where a depends on the other coordinates u. So f = 0 has a solution φ exactly if −M⁻¹ a is a unit vector, and φ is its
//! direction:
//!
//! ```text
//! h(u) = a·N a − 1 = 0        N = M⁻ᵀ M⁻¹        dh = 2 N a·da        d²h = 2 da·N da + 2 N a·d²a
//! ```
//!
//! Where both equations are sums of the same pins, M is a rotation times a length, and N nearly a multiple of the
//! identity.
//!
//! For the coupler of a four-bar this is the equation of F. Freudenstein (An analytical approach to the design of four-link
//! mechanisms, Transactions of the ASME 76 (1954)). One equation takes the place of two, and a search has one coordinate
//! less to divide.

use crate::scalar::{Interval, Scalar};

const TWO: Interval = Interval::new(2.0, 2.0);
const ONE: Interval = Interval::new(1.0, 1.0);

/// Two numbers, one for each equation, or a vector.
type Pair = [Interval; 2];

/// An angle φ that occurs in two equations only.
pub(super) struct EliminatedAngle {
    /// Its index among the remaining coordinates.
    pub(super) angle: usize,
    /// Its equations.
    pub(super) rows: [usize; 2],
    /// The columns of M.
    by_cosine: Pair,
    by_sine: Pair,
    /// M⁻¹.
    inverse: [Pair; 2],
    /// N₀₀, 2 N₀₁ and N₁₁.
    form: [Interval; 3],
}

impl EliminatedAngle {
    /// Given the derivatives of the two equations with respect to φ at φ = 0 and at φ = π/2; `None` if M may be
    /// singular.
    pub(super) fn new(angle: usize, rows: [usize; 2], at_zero: Pair, at_quarter: Pair) -> Option<Self> {
        let (by_cosine, by_sine) = (at_quarter.map(|x| -x), at_zero);
        let ([a, c], [b, d]) = (by_cosine, by_sine);
        let determinant = a * d - b * c;
        let inverse = [[d / determinant, -b / determinant], [-c / determinant, a / determinant]];
        let bounded = inverse.iter().flatten().all(|x| x.is_bounded());
        let [[a, b], [c, d]] = inverse;
        let form = [square(a) + square(c), TWO * (a * b + c * d), square(b) + square(d)];
        (bounded && !determinant.contains(0.0)).then_some(Self { angle, rows, by_cosine, by_sine, inverse, form })
    }

    /// The derivatives of the two equations with respect to φ.
    pub(super) fn derivatives(&self, angle: Interval) -> Pair {
        let (sin, cos) = angle.sin_cos();
        [0, 1].map(|i| self.by_sine[i] * cos - self.by_cosine[i] * sin)
    }

    /// a, given the values of the two equations at φ = 0.
    pub(super) fn constant_part(&self, at_zero: Pair) -> Pair {
        [0, 1].map(|i| at_zero[i] - self.by_cosine[i])
    }

    /// h, given a.
    pub(super) fn closure(&self, a: Pair) -> Interval {
        self.product(a) - ONE
    }

    /// 2 N a, of which dh is the product with da.
    pub(super) fn slope(&self, a: Pair) -> Pair {
        let [p, q, r] = self.form;
        [TWO * p * a[0] + q * a[1], q * a[0] + TWO * r * a[1]]
    }

    /// d²h, given 2 N a, da and d²a.
    pub(super) fn second_derivative(&self, slope: Pair, da: Pair, dda: Pair) -> Interval {
        TWO * self.product(da) + dot(slope, dda)
    }

    /// φ over a whole turn around `near`, given a; undefined where a may vanish.
    pub(super) fn direction(&self, a: Pair, near: f64) -> Interval {
        let g = self.inverse.map(|row| -dot(row, a));
        // Measured from the middle, so that the jump of the angle at π is far away.
        let middle = Interval::from(g[1].midpoint().atan2(g[0].midpoint()));
        let (sin, cos) = middle.sin_cos();
        let angle = middle + (g[1] * cos - g[0] * sin).atan2(g[0] * cos + g[1] * sin);
        let turns = ((near - angle.midpoint()) / core::f64::consts::TAU).round();
        angle + Interval::from(turns) * Interval::new(core::f64::consts::TAU, core::f64::consts::TAU.next_up())
    }

    /// a·N a.
    fn product(&self, a: Pair) -> Interval {
        let [p, q, r] = self.form;
        p * square(a[0]) + r * square(a[1]) + q * (a[0] * a[1])
    }
}

fn square(x: Interval) -> Interval {
    Scalar::powi(x, 2)
}

pub(super) fn dot(a: Pair, b: Pair) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::{EliminatedAngle, Pair, dot};
    use crate::scalar::Interval;

    const M: [[f64; 2]; 2] = [[0.4, -0.1], [0.2, 0.3]];

    fn points(numbers: [f64; 2]) -> Pair {
        numbers.map(Interval::from)
    }

    /// M (cos φ, sin φ), and its derivative with respect to φ.
    fn turned(phi: f64) -> [[f64; 2]; 2] {
        let (sin, cos) = phi.sin_cos();
        [M.map(|[a, b]| a * cos + b * sin), M.map(|[a, b]| b * cos - a * sin)]
    }

    fn angle() -> EliminatedAngle {
        let [at_zero, at_quarter] = [0.0, core::f64::consts::FRAC_PI_2].map(|phi| points(turned(phi)[1]));
        EliminatedAngle::new(0, [0, 1], at_zero, at_quarter).unwrap()
    }

    /// The constant part of the equations, found from their values at φ = 0.
    fn found(a: [f64; 2]) -> Pair {
        let at_zero = turned(0.0)[0];
        angle().constant_part(points([0, 1].map(|i| a[i] + at_zero[i])))
    }

    #[track_caller]
    fn same(found: Interval, expected: f64, tolerance: f64) {
        assert!((found.midpoint() - expected).abs() < tolerance && found.radius() < tolerance, "{found} {expected}");
    }

    #[test]
    fn an_angle_that_closes_the_loop_is_found_again() {
        for k in 0..100 {
            let phi = 0.0628 * f64::from(k) - 3.1;
            let [of_angle, by_angle] = turned(phi);
            let a = found(of_angle.map(|x| -x));
            same(angle().closure(a), 0.0, 1e-14);
            for near in [0.0, phi + 3.0, -40.0] {
                let found = angle().direction(a, near);
                let turns = (found.midpoint() - phi) / core::f64::consts::TAU;
                same(found, phi + core::f64::consts::TAU * turns.round(), 1e-12);
                assert!((found.midpoint() - near).abs() < 3.15, "{found} near {near}");
            }
            angle().derivatives(Interval::from(phi)).into_iter().zip(by_angle).for_each(|(x, d)| same(x, d, 1e-14));
        }
    }

    #[test]
    fn derivatives_are_those_of_the_equation() {
        let a = |t: f64| [0.3 * t - 0.2, 0.25 - 0.6 * t * t];
        let h = |t: f64| angle().closure(found(a(t))).midpoint();
        for t in [-0.7, 0.1, 0.4, 0.9] {
            let angle = angle();
            let (slope, da, dda) = (angle.slope(found(a(t))), points([0.3, -1.2 * t]), points([0.0, -1.2]));
            let e = 1e-4;
            same(dot(slope, da), (h(t + e) - h(t - e)) / (2.0 * e), 1e-6);
            same(angle.second_derivative(slope, da, dda), (h(t + e) - 2.0 * h(t) + h(t - e)) / (e * e), 1e-5);
        }
    }

    #[test]
    fn an_angle_whose_equations_depend_on_one_another_is_kept() {
        let (at_zero, at_quarter) = (points([0.1, 0.2]), points([0.3, 0.6]));
        assert!(EliminatedAngle::new(0, [0, 1], at_zero, at_quarter).is_none());
    }
}
