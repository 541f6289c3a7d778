//! Positions, velocities and accelerations from Φ, Φ_q, Φ_t and γ by a dense Newton iteration on all coordinates.

use super::super::evaluate;
use kin_core::expr::{ExprId, Symbol};
use kin_core::{KinematicSystem, Mechanism, assemble, differentiate};

/// What holds at an instant.
#[derive(Clone, Debug)]
pub struct Instant {
    pub t: f64,
    pub q: Vec<f64>,
    pub q_dot: Vec<f64>,
    pub q_ddot: Vec<f64>,
    /// ‖Φ_q⁻¹‖∞: by how much errors of Φ grow in q.
    pub amplification: f64,
    /// Where the iteration began.
    pub start: Vec<f64>,
}

impl Instant {
    /// Far from a singular configuration: neither do errors grow much, nor does anything speed up.
    pub fn is_calm(&self) -> bool {
        self.amplification <= 80.0 && largest(&self.q_ddot) <= 30.0
    }

    /// q at another time, from q, q̇ and q̈.
    pub fn ahead(&self, t: f64) -> Vec<f64> {
        let h = t - self.t;
        (0..self.q.len()).map(|k| self.q[k] + h * (self.q_dot[k] + h / 2.0 * self.q_ddot[k])).collect()
    }
}

pub struct Oracle {
    pub system: KinematicSystem,
    pub parameters: Vec<f64>,
    roots: Vec<ExprId>,
}

/// Φ, Φ_q, Φ_t, γ at one instant.
struct Values {
    phi: Vec<f64>,
    phi_q: Vec<Vec<f64>>,
    phi_t: Vec<f64>,
    gamma: Vec<f64>,
}

/// What an expression is evaluated with.
pub fn environment<'a>(parameters: &'a [f64], t: f64, q: &'a [f64], q_dot: &'a [f64]) -> impl Fn(Symbol) -> f64 + 'a {
    move |symbol| match symbol {
        Symbol::Parameter(k) => parameters[k as usize],
        Symbol::Time => t,
        Symbol::Coordinate(k) => q[k as usize],
        Symbol::Rate(k) => q_dot.get(k as usize).copied().unwrap_or(f64::NAN),
        _ => f64::NAN,
    }
}

impl Oracle {
    pub fn new(mechanism: &Mechanism, parameters: &[f64]) -> Self {
        let set = assemble(mechanism).unwrap_or_else(|errors| panic!("{mechanism}{errors:?}"));
        let system = differentiate(set).expect("no third derivatives");
        let mut roots = Vec::new();
        for equation in &system.equations {
            roots.extend([equation.phi, equation.phi_t, equation.gamma]);
            roots.extend(equation.phi_q.iter().map(|(_, e)| *e));
        }
        Self { system, parameters: parameters.to_vec(), roots }
    }

    fn values(&self, t: f64, q: &[f64], q_dot: &[f64]) -> Values {
        let n = self.system.set.coordinates.len();
        let all = evaluate(&self.system.set.graph, &self.roots, &environment(&self.parameters, t, q, q_dot));
        let mut next = all.into_iter();
        let mut take = || next.next().expect("as many values as roots");
        let mut out = Values { phi: Vec::new(), phi_q: Vec::new(), phi_t: Vec::new(), gamma: Vec::new() };
        for equation in &self.system.equations {
            out.phi.push(take());
            out.phi_t.push(take());
            out.gamma.push(take());
            let mut row = vec![0.0; n];
            equation.phi_q.iter().for_each(|(column, _)| row[*column as usize] = take());
            out.phi_q.push(row);
        }
        out
    }

    /// max |Φ|.
    pub fn residual(&self, t: f64, q: &[f64]) -> f64 {
        largest(&self.values(t, q, &vec![0.0; q.len()]).phi)
    }

    /// The assembled pose near `start`, with its rates and accelerations; `None` where the iteration does not settle
    /// or Φ_q is singular.
    pub fn solve(&self, t: f64, start: &[f64]) -> Option<Instant> {
        let mut q = start.to_vec();
        let still = vec![0.0; q.len()];
        let mut last = f64::INFINITY;
        for _ in 0..20 {
            let values = self.values(t, &q, &still);
            let step = Lu::new(values.phi_q)?.solve(&values.phi);
            q.iter_mut().zip(&step).for_each(|(q, step)| *q -= step);
            let size = largest(&step);
            // Settled: at rounding, and no longer shrinking.
            if size < 1e-9 && size >= 0.5 * last || size == 0.0 {
                return self.rates(t, q, start.to_vec());
            }
            if size.is_nan() || size > 10.0 {
                return None;
            }
            last = size;
        }
        None
    }

    /// x with Φ_q x = b at the configuration q; `None` where Φ_q is singular.
    pub fn resolve(&self, t: f64, q: &[f64], b: &[f64]) -> Option<Vec<f64>> {
        let phi_q = self.values(t, q, &vec![0.0; q.len()]).phi_q;
        Some(Lu::new(phi_q.clone())?.refined(&phi_q, b))
    }

    fn rates(&self, t: f64, q: Vec<f64>, start: Vec<f64>) -> Option<Instant> {
        let still = vec![0.0; q.len()];
        let values = self.values(t, &q, &still);
        let matrix = values.phi_q.clone();
        let lu = Lu::new(values.phi_q)?;
        let nu: Vec<f64> = values.phi_t.iter().map(|e| -e).collect();
        let q_dot = lu.refined(&matrix, &nu);
        let q_ddot = lu.refined(&matrix, &self.values(t, &q, &q_dot).gamma);
        let amplification = lu.norm_of_inverse();
        Some(Instant { t, q, q_dot, q_ddot, amplification, start })
    }

    /// From one instant to another in steps of at most `step`, on the same branch; `None` where the motion is not calm.
    pub fn follow(&self, from: &Instant, to: f64, step: f64) -> Option<Instant> {
        let steps = ((to - from.t).abs() / step).ceil().max(1.0) as usize;
        let mut now = from.clone();
        for k in 1..=steps {
            let t = if k == steps { to } else { from.t + (to - from.t) * k as f64 / steps as f64 };
            let next = self.solve(t, &now.ahead(t))?;
            // What was predicted is off by h³/6 of a third derivative; far more would be another branch.
            if !next.is_calm() || difference(&next.q, &next.start) > 5e-3 {
                return None;
            }
            now = next;
        }
        Some(now)
    }
}

/// max |v_k|; NaN where one is.
pub fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |most: f64, e| if e.is_nan() || most.is_nan() { f64::NAN } else { most.max(e.abs()) })
}

/// max |a_k − b_k| relative to the largest of `a`, or to 1.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    largest(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>()) / largest(a).max(1.0)
}

/// P A = L U, by rows, with the largest pivot of every column.
struct Lu {
    rows: Vec<Vec<f64>>,
    order: Vec<usize>,
}

impl Lu {
    fn new(mut rows: Vec<Vec<f64>>) -> Option<Self> {
        let n = rows.len();
        assert!(rows.iter().all(|row| row.len() == n), "as many rows as coordinates");
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
            rows.swap(k, pivot);
            order.swap(k, pivot);
            if rows[k][k] == 0.0 || !rows[k][k].is_finite() {
                return None;
            }
            let (above, below) = rows.split_at_mut(k + 1);
            for row in below.iter_mut().filter(|row| row[k] != 0.0) {
                let factor = row[k] / above[k][k];
                row[k] = factor;
                row[k + 1..].iter_mut().zip(&above[k][k + 1..]).for_each(|(e, p)| *e -= factor * p);
            }
        }
        Some(Self { rows, order })
    }

    fn solve(&self, b: &[f64]) -> Vec<f64> {
        let dot = |row: &[f64], x: &[f64]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        let mut x: Vec<f64> = self.order.iter().map(|&k| b[k]).collect();
        for k in 0..x.len() {
            x[k] -= dot(&self.rows[k][..k], &x[..k]);
        }
        for k in (0..x.len()).rev() {
            x[k] = (x[k] - dot(&self.rows[k][k + 1..], &x[k + 1..])) / self.rows[k][k];
        }
        x
    }

    /// With one step of iterative refinement.
    fn refined(&self, matrix: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
        let mut x = self.solve(b);
        let left = |(row, b): (&Vec<f64>, &f64)| b - row.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>();
        let residual: Vec<f64> = matrix.iter().zip(b).map(left).collect();
        x.iter_mut().zip(self.solve(&residual)).for_each(|(x, d)| *x += d);
        x
    }

    fn norm_of_inverse(&self) -> f64 {
        let n = self.rows.len();
        let mut sums = vec![0.0; n];
        for k in 0..n {
            let mut unit = vec![0.0; n];
            unit[k] = 1.0;
            sums.iter_mut().zip(self.solve(&unit)).for_each(|(sum, e)| *sum += e.abs());
        }
        largest(&sums)
    }
}
