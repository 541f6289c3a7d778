//! Angles that occur in one loop only, eliminated.
//!
//! The angle φ of a body that is pinned to its neighbours occurs in the two closure equations of a loop as
//!
//! ```text
//! f = a(u) + M (cos φ, sin φ)        M constant
//! ```
//!
//! where a depends on the other coordinates u. So f = 0 has a solution φ exactly if g = −M⁻¹ a is a unit vector, and φ is its
//! direction:
//!
//! ```text
//! h(u) = g·g − 1 = 0        dh = 2 g·dg        d²h = 2 dg·dg + 2 g·d²g
//! ```
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
}

impl EliminatedAngle {
    /// Given the derivatives of the two equations by φ at φ = 0 and at φ = π/2; none if M may be singular.
    pub(super) fn new(angle: usize, rows: [usize; 2], at_zero: Pair, at_quarter: Pair) -> Option<Self> {
        let (by_cosine, by_sine) = (at_quarter.map(|x| -x), at_zero);
        let ([a, c], [b, d]) = (by_cosine, by_sine);
        let determinant = a * d - b * c;
        let inverse = [[d / determinant, -b / determinant], [-c / determinant, a / determinant]];
        let bounded = inverse.iter().flatten().all(|x| x.is_bounded());
        (bounded && !determinant.contains(0.0)).then_some(Self { angle, rows, by_cosine, by_sine, inverse })
    }

    /// The derivatives of the two equations by φ.
    pub(super) fn derivatives(&self, angle: Interval) -> Pair {
        let (sin, cos) = angle.sin_cos();
        [0, 1].map(|i| self.by_sine[i] * cos - self.by_cosine[i] * sin)
    }

    /// g, given the values of the two equations at φ = 0.
    pub(super) fn vector(&self, at_zero: Pair) -> Pair {
        self.change([0, 1].map(|i| at_zero[i] - self.by_cosine[i]))
    }

    /// dg, given da.
    pub(super) fn change(&self, da: Pair) -> Pair {
        self.inverse.map(|[a, b]| -(a * da[0] + b * da[1]))
    }

    /// φ over a whole turn around `near`, given g; undefined where g may vanish.
    pub(super) fn direction(g: Pair, near: f64) -> Interval {
        // Measured from the middle, so that the jump of the angle at π is far away.
        let middle = Interval::from(g[1].midpoint().atan2(g[0].midpoint()));
        let (sin, cos) = middle.sin_cos();
        let angle = middle + (g[1] * cos - g[0] * sin).atan2(g[0] * cos + g[1] * sin);
        let turns = ((near - angle.midpoint()) / core::f64::consts::TAU).round();
        angle + Interval::from(turns) * Interval::new(core::f64::consts::TAU, core::f64::consts::TAU.next_up())
    }
}

/// h.
pub(super) fn closure(g: Pair) -> Interval {
    Scalar::powi(g[0], 2) + Scalar::powi(g[1], 2) - ONE
}

/// dh.
pub(super) fn derivative(g: Pair, dg: Pair) -> Interval {
    TWO * product(g, dg)
}

/// d²h.
pub(super) fn second_derivative(g: Pair, dg: Pair, ddg: Pair) -> Interval {
    TWO * (Scalar::powi(dg[0], 2) + Scalar::powi(dg[1], 2) + product(g, ddg))
}

fn product(a: Pair, b: Pair) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::{EliminatedAngle, Pair, closure, derivative, second_derivative};
    use crate::scalar::Interval;

    const M: [[f64; 2]; 2] = [[0.4, -0.1], [0.2, 0.3]];

    fn points(numbers: [f64; 2]) -> Pair {
        numbers.map(Interval::from)
    }

    /// M (cos φ, sin φ), and its derivative by φ.
    fn turned(phi: f64) -> [[f64; 2]; 2] {
        let (sin, cos) = phi.sin_cos();
        [M.map(|[a, b]| a * cos + b * sin), M.map(|[a, b]| b * cos - a * sin)]
    }

    fn angle() -> EliminatedAngle {
        let [at_zero, at_quarter] = [0.0, core::f64::consts::FRAC_PI_2].map(|phi| points(turned(phi)[1]));
        EliminatedAngle::new(0, [0, 1], at_zero, at_quarter).unwrap()
    }

    /// g where the constant part of the equations is a.
    fn g(a: [f64; 2]) -> Pair {
        let at_zero = turned(0.0)[0];
        angle().vector(points([0, 1].map(|i| a[i] + at_zero[i])))
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
            let g = g(of_angle.map(|x| -x));
            same(closure(g), 0.0, 1e-14);
            for near in [0.0, phi + 3.0, -40.0] {
                let found = EliminatedAngle::direction(g, near);
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
        let h = |t: f64| closure(g(a(t))).midpoint();
        for t in [-0.7, 0.1, 0.4, 0.9] {
            let angle = angle();
            let (dg, ddg) = (angle.change(points([0.3, -1.2 * t])), angle.change(points([0.0, -1.2])));
            let e = 1e-4;
            same(derivative(g(a(t)), dg), (h(t + e) - h(t - e)) / (2.0 * e), 1e-6);
            same(second_derivative(g(a(t)), dg, ddg), (h(t + e) - 2.0 * h(t) + h(t - e)) / (e * e), 1e-5);
        }
    }

    #[test]
    fn an_angle_whose_equations_depend_on_one_another_is_kept() {
        let (at_zero, at_quarter) = (points([0.1, 0.2]), points([0.3, 0.6]));
        assert!(EliminatedAngle::new(0, [0, 1], at_zero, at_quarter).is_none());
    }
}
