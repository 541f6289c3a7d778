//! The embedded Runge–Kutta pair 5(4) of Dormand and Prince for ẏ = f(t, y), independent of mechanisms.
//!
//! ```text
//! k_i = f(t + c_i h, y + h Σ_{j<i} a_ij k_j),   y⁺ = y + h Σ_i b_i k_i,   e = h Σ_i (b_i − b*_i) k_i
//! ```
//!
//! y⁺ is of order five, e the difference from the embedded solution of order four. Within the step the solution of order
//! four is the cubic through both ends and, with the fraction θ of the step, a term that vanishes at both:
//!
//! ```text
//! y(t + θ h) = cubic(θ) + θ² (1 − θ)² d,   d = h Σ_i d_i k_i
//! ```
//!
//! Coefficients: J. R. Dormand and P. J. Prince, A family of embedded Runge–Kutta formulae, J. Comput. Appl. Math. 6 (1980)
//! 19–26; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I (1993), table II.5.2 and section II.6.

/// Number of stages; the last one is evaluated at the end of the step.
const STAGES: usize = 7;

const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

const A: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    // The weights b of the result: the last stage of a step is the first stage of the next one.
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// b − b*.
const E: [f64; STAGES] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// The weights d of the quartic within a step.
const D: [f64; STAGES] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// The result of a step and its error estimate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StepResult {
    pub(crate) y: Vec<f64>,
    pub(crate) error: Vec<f64>,
}

/// One step of length `h` from y; `first` is ẏ there. `f` is given the time since the start of the step, to which a large
/// time would add its rounding.
pub(crate) fn runge_kutta_step<E>(
    h: f64,
    y: &[f64],
    first: &[f64],
    mut f: impl FnMut(f64, &[f64]) -> Result<Vec<f64>, E>,
) -> Result<StepResult, E> {
    let mut stages = vec![first.to_vec()];
    let mut end = y.to_vec();
    for (row, c) in A.iter().zip(C).skip(1) {
        end = advanced(y, h, row, &stages);
        stages.push(f(c * h, &end)?);
    }
    let zero = vec![0.0; y.len()];
    Ok(StepResult { y: end, error: advanced(&zero, h, &E, &stages) })
}

/// The factor d of the quartic within a step, from all stages of the step.
pub(crate) fn bow(h: f64, stages: &[Vec<f64>]) -> Vec<f64> {
    advanced(&vec![0.0; stages[0].len()], h, &D, stages)
}

/// y + h Σ w_i k_i.
fn advanced(y: &[f64], h: f64, weights: &[f64], stages: &[Vec<f64>]) -> Vec<f64> {
    let sum = |component: usize| weights.iter().zip(stages).map(|(w, k)| w * k[component]).sum::<f64>();
    y.iter().enumerate().map(|(component, y)| y + h * sum(component)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row sums are the nodes, and the error estimate vanishes for polynomials that the lower order integrates exactly.
    #[test]
    fn coefficients_satisfy_the_order_conditions() {
        for (row, c) in A.iter().zip(C) {
            assert!((row.iter().sum::<f64>() - c).abs() < 1e-14);
        }
        for power in 0..4 {
            let moment: f64 = E.iter().zip(C).map(|(e, c)| e * c.powi(power)).sum();
            assert!(moment.abs() < 1e-14, "{power}: {moment}");
        }
        for power in 0..5 {
            let moment: f64 = A[6].iter().zip(C).map(|(b, c)| b * c.powi(power)).sum();
            assert!((moment - 1.0 / f64::from(power + 1)).abs() < 1e-14, "{power}: {moment}");
        }
    }

    /// The quartic has no such term where y is a cubic, and is exact where it is of fourth degree: τ⁴ differs from the cubic
    /// through both ends by τ² (1 − τ)².
    #[test]
    fn the_quartic_within_a_step_is_of_order_four() {
        let bow_of = |f: &dyn Fn(f64) -> f64| bow(0.5, &C.map(|c| vec![f(0.5 * c)]))[0];
        for power in 0..3 {
            assert!(bow_of(&|t| t.powi(power)).abs() < 1e-14, "{power}");
        }
        assert!((bow_of(&|t| 4.0 * t.powi(3)) - 0.5_f64.powi(4)).abs() < 1e-14);
    }

    /// ÿ = −y: halving the step divides the error after a fixed time by 2⁵.
    #[test]
    fn global_error_is_of_order_five() {
        let f = |_: f64, y: &[f64]| Ok::<_, ()>(vec![y[1], -y[0]]);
        let error = |steps: u32| {
            let h = 2.0 / f64::from(steps);
            let mut y = vec![1.0, 0.0];
            for _ in 0..steps {
                let first = f(0.0, &y).unwrap();
                y = runge_kutta_step(h, &y, &first, f).unwrap().y;
            }
            (y[0] - 2.0_f64.cos()).hypot(y[1] + 2.0_f64.sin())
        };
        let ratio = error(16) / error(32);
        assert!((ratio / 32.0 - 1.0).abs() < 0.15, "{ratio}");
    }

    /// ẏ = t y depends on the nodes c as well.
    #[test]
    fn time_is_taken_at_the_nodes() {
        let f = |since: f64, y: &[f64]| Ok::<_, ()>(vec![(0.5 + since) * y[0]]);
        let result = runge_kutta_step(0.05, &[1.0], &[0.5], f).unwrap();
        let exact = ((0.55_f64.powi(2) - 0.25) / 2.0).exp();
        assert!((result.y[0] - exact).abs() < 1e-11, "{} {exact}", result.y[0]);
        assert!((result.y[0] - exact).abs() < result.error[0].abs() && result.error[0].abs() < 1e-8);
    }
}
