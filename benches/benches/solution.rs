//! q, q̇, q̈ of the lecture's four-bar in steps of one degree: the plan compared with Newton's iteration on all
//! coordinates with a hand-written evaluation. `cargo bench -p kin-benches --bench solution`.

use kin_benches::four_bar::{ByHand, FourBar, by_hand};
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::nalgebra::{SMatrix, SVector};
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Mechanism, Scalar};
use std::f64::consts::TAU;
use std::hint::black_box;

const STEPS: usize = 360;

/// A hand-written solver of q, q̇, q̈: Newton with dense LU, from the prediction q + h q̇ + ½ h² q̈ or from the last
/// solution.
struct Newton {
    predicts: bool,
    q: [f64; 9],
    q_dot: [f64; 9],
    q_ddot: [f64; 9],
    t: f64,
    hand: ByHand,
}

type Matrix = SMatrix<f64, 9, 9>;
type Vector = SVector<f64, 9>;

impl Newton {
    fn step(&mut self, four_bar: &FourBar, t: f64) {
        let h = if self.predicts { t - self.t } else { 0.0 };
        let mut q: [f64; 9] = core::array::from_fn(|k| self.q[k] + h * (self.q_dot[k] + 0.5 * h * self.q_ddot[k]));
        let jacobian = |hand: &ByHand| Matrix::from_fn(|i, j| hand.phi_q[i][j]);
        for _ in 0..8 {
            by_hand(four_bar, t, &q, &self.q_dot, &mut self.hand);
            let Some(step) = jacobian(&self.hand).lu().solve(&Vector::from_row_slice(&self.hand.phi)) else { return };
            q.iter_mut().zip(step.iter()).for_each(|(q, s)| *q -= s);
            if step.amax() < 1e-9 {
                break;
            }
        }
        by_hand(four_bar, t, &q, &self.q_dot, &mut self.hand);
        let lu = jacobian(&self.hand).lu();
        let nu = -Vector::from_row_slice(&self.hand.phi_t);
        let Some(q_dot) = lu.solve(&nu) else { return };
        self.q_dot.copy_from_slice(q_dot.as_slice());
        by_hand(four_bar, t, &q, &self.q_dot, &mut self.hand);
        let Some(q_ddot) = lu.solve(&Vector::from_row_slice(&self.hand.gamma)) else { return };
        self.q_ddot.copy_from_slice(q_ddot.as_slice());
        (self.q, self.t) = (q, t);
    }
}

/// The closed form that an expert derives for this four-bar: the dyad A B D, all nine coordinates and their rates, with
/// the functions of the standard library.
#[inline(never)]
fn dyad_by_hand(m: &FourBar, t: f64, q: &mut [f64; 9], v: &mut [f64; 9], a: &mut [f64; 9], start: &[f64; 9]) {
    let near = |angle: f64, start: f64| angle + TAU * ((start - angle) * (1.0 / TAU)).round_ties_even();
    dyad(m, t, [q, v, a], start, f64::sin_cos, |vectors| vectors.map(|(y, x)| y.atan2(x)), near);
}

/// The same closed form with the sines and angles of kin, to separate their effect.
#[inline(never)]
fn dyad_in_lanes(m: &FourBar, t: f64, q: &mut [f64; 9], v: &mut [f64; 9], a: &mut [f64; 9], start: &[f64; 9]) {
    dyad(m, t, [q, v, a], start, Scalar::sin_cos, Scalar::atan2_all, Scalar::nearest);
}

#[inline(always)]
fn dyad(
    m: &FourBar,
    t: f64,
    [q, v, a]: [&mut [f64; 9]; 3],
    start: &[f64; 9],
    sin_cos: impl Fn(f64) -> (f64, f64),
    angles: impl Fn([(f64, f64); 2]) -> [f64; 2],
    near: impl Fn(f64, f64) -> f64,
) {
    let phi1 = m.phi0 + m.omega * t;
    let (s1, c1) = sin_cos(phi1);
    let (ax, ay) = (m.l1 * c1, m.l1 * s1);
    let (kx, ky) = (m.d1 - ax, m.d2 - ay);
    let k2 = kx * kx + ky * ky;
    // Solves l2 (cos, sin) + l3 (cos, sin) = k.
    let c = (k2 + m.l2 * m.l2 - m.l3 * m.l3) / (2.0 * m.l2);
    let w = (k2 - c * c).sqrt();
    let inverse = 1.0 / k2;
    let (c2, s2) = ((kx * c + ky * w) * inverse, (ky * c - kx * w) * inverse);
    let (x2, y2) = (m.l2 * c2, m.l2 * s2);
    let (x3, y3) = (kx - x2, ky - y2);
    let [phi2, phi3] = angles([(y2, x2), (y3, x3)]);
    let (phi2, phi3) = (near(phi2, start[5]), near(phi3, start[8]));
    *q = [0.5 * ax, 0.5 * ay, phi1, ax + 0.5 * x2, ay + 0.5 * y2, phi2, m.d1 - 0.5 * x3, m.d2 - 0.5 * y3, phi3];
    let det = 1.0 / (x2 * y3 - y2 * x3);
    let (bx, by) = (ay * m.omega, -ax * m.omega);
    let (w2, w3) = ((-bx * x3 - by * y3) * -det, (bx * x2 + by * y2) * -det);
    let half = |x: f64, y: f64, w: f64| (-0.5 * y * w, 0.5 * x * w);
    let ((v1x, v1y), (v2x, v2y), (v3x, v3y)) = (half(ax, ay, m.omega), half(x2, y2, w2), half(x3, y3, w3));
    *v = [v1x, v1y, m.omega, 2.0 * v1x + v2x, 2.0 * v1y + v2y, w2, -v3x, -v3y, w3];
    let (q1, q2, q3) = (m.omega * m.omega, w2 * w2, w3 * w3);
    let (gx, gy) = (ax * q1 + x2 * q2 + x3 * q3, ay * q1 + y2 * q2 + y3 * q3);
    let (e2, e3) = ((gx * x3 + gy * y3) * det, -(gx * x2 + gy * y2) * det);
    let accelerate = |x: f64, y: f64, e: f64, s: f64| (0.5 * (-y * e - x * s), 0.5 * (x * e - y * s));
    let ((a1x, a1y), (a2x, a2y), (a3x, a3y)) =
        (accelerate(ax, ay, 0.0, q1), accelerate(x2, y2, e2, q2), accelerate(x3, y3, e3, q3));
    *a = [a1x, a1y, 0.0, 2.0 * a1x + a2x, 2.0 * a1y + a2y, e2, -a3x, -a3y, e3];
}

/// The plan for four instants at once, a quarter of a turn apart.
#[cfg(feature = "simd")]
fn in_lanes<'a>(four_bar: &'a FourBar, q: &[f64], mode: f64) -> Contender<'a> {
    use kin_runtime::Lanes;
    let parameters = four_bar.parameters::<Lanes>();
    let mut start: [Lanes; 9] = core::array::from_fn(|k| Lanes::from(q[k]));
    let modes = [Lanes::from(mode)];
    let mut out = Placed::new(move || (start, start, start, [Lanes::from(0.0)]));
    let times: Vec<Lanes> = (0..STEPS / 4)
        .map(|k| {
            Lanes::new(
                [0.0, 0.25, 0.5, 0.75].map(|part| (k as f64 + part * STEPS as f64).to_radians() / four_bar.omega),
            )
        })
        .collect();
    let work = move || {
        let (q, q_dot, q_ddot, margins) = out.here();
        for &t in &times {
            let solved = Solved { q, q_dot, q_ddot, margins };
            let at = Instant::at(black_box(t));
            four_bar
                .solve_with(black_box(&parameters), &at, &modes, &start, Depth::Acceleration, solved)
                .expect("nine coordinates");
            black_box((&*q, &*q_dot, &*q_ddot, &*margins));
            start = *q;
        }
    };
    Contender { name: "kin, the plan in four lanes", work: Box::new(work) }
}

/// Batches: by `solve`, random crank angles and random lengths, as many as there are steps; by `sweep`, a part of a
/// turn for 24 parameter sets.
#[cfg(feature = "simd")]
fn in_batches<'a>(four_bar: &'a FourBar, q: &[f64], mode: f64) -> Vec<Contender<'a>> {
    use kin_benches::random::Draws;
    use kin_runtime::Lanes;
    use kin_runtime::batch::{Column, Modes, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
    /// The same number as the steps of the other contenders.
    const CONFIGURATIONS: usize = STEPS;
    const SETS: usize = 24;
    let mut draws = Draws::new(1);
    let mut drawn =
        |middle: f64, size: f64, count: usize| -> Vec<f64> { (0..count).map(|_| draws.about(middle, size)).collect() };
    let own = four_bar.parameters::<f64>();
    let parameters: Vec<Vec<f64>> = own.iter().map(|p| drawn(*p, 0.01 * p.abs(), CONFIGURATIONS)).collect();
    let t = drawn(0.0, core::f64::consts::TAU / four_bar.omega, CONFIGURATIONS);
    let start: Vec<f64> = q.to_vec();
    let mut out = Placed::new(|| Solutions::<FourBar>::new(CONFIGURATIONS));
    let solve_all = {
        let start = start.clone();
        move || {
            let parameters: Vec<_> = parameters.iter().map(|p| Column::Each(p)).collect();
            let start: Vec<_> = start.iter().map(|q| Column::Shared(*q)).collect();
            let modes = Modes::Signs(&[Column::Shared(mode)]);
            let problems = Problems { parameters: &parameters, t: Column::Each(&t), inputs: &[], modes, start: &start };
            let out = out.here();
            solve(four_bar, Depth::Acceleration, black_box(&problems), out, &always).expect("nine columns");
            black_box(&*out);
        }
    };
    let parameters: Vec<Vec<f64>> = own.iter().map(|p| drawn(*p, 0.01 * p.abs(), SETS)).collect();
    // Fifteen steps for each set give as many solutions as the other contenders compute.
    let times: Vec<f64> = (0..STEPS / SETS).map(|k| (k as f64).to_radians() / four_bar.omega).collect();
    let sweep_all = move || {
        let parameters: Vec<_> = parameters.iter().map(|p| Column::Each(p)).collect();
        let start: Vec<_> = start.iter().map(|q| Column::Shared(*q)).collect();
        let modes = Modes::Signs(&[Column::Shared(mode)]);
        let sweeps = Sweeps { parameters: &parameters, times: black_box(&times), inputs: &[], modes, start: &start };
        let mut out = Motions::new(SETS, Lanes::from(0.0));
        let score = |sum: &mut Lanes, moment: &kin_runtime::batch::Moment<'_>| {
            black_box((moment.q, moment.q_dot, moment.q_ddot));
            *sum = moment.keep(*sum, *sum + moment.q_ddot[8].abs());
        };
        sweep(four_bar, &sweeps, &mut out, &always, score).expect("nine columns");
        black_box(&out);
    };
    vec![
        Contender { name: "kin, `solve` of a batch, random lengths and angles", work: Box::new(solve_all) },
        Contender { name: "kin, `sweep` of 24 sets, 15 instants each", work: Box::new(sweep_all) },
    ]
}

fn main() {
    let four_bar = FourBar::default();
    let state = four_bar.solver().state(&Instant::at(0.0)).expect("it closes at t = 0");
    let array = |v: &[f64]| -> [f64; 9] { v.try_into().expect("nine coordinates") };
    let newton = |predicts| Newton {
        predicts,
        q: array(&state.q),
        q_dot: array(&state.q_dot),
        q_ddot: array(&state.q_ddot),
        t: 0.0,
        hand: ByHand::default(),
    };
    let [mut newton, mut unpredicted] = [true, false].map(|predicts| Placed::new(move || newton(predicts)));
    let parameters = four_bar.parameters::<f64>();
    let mut modes = [0.0; 1];
    four_bar.branches_with(&parameters, &Instant::at(0.0), &state.q, &mut modes).expect("one mode");
    let modes = modes.map(f64::signum);
    let mut planned = Placed::new(|| (array(&state.q), [0.0; 9], [0.0; 9], [0.0; 1]));
    let [mut dyad, mut dyad_lanes] = [(); 2].map(|()| Placed::new(|| (array(&state.q), [0.0; 9], [0.0; 9])));
    let times: Vec<f64> = (0..STEPS).map(|k| (k as f64).to_radians() / four_bar.omega).collect();
    let contenders = [
        Contender {
            name: "evaluation by hand, Newton with dense LU 9×9",
            work: Box::new(|| {
                let newton = newton.carried();
                for &t in &times {
                    newton.step(black_box(&four_bar), black_box(t));
                    black_box(&newton.q_ddot);
                }
                newton.q[2] -= 360_f64.to_radians();
                newton.t = -1_f64.to_radians() / four_bar.omega;
            }),
        },
        Contender {
            name: "the same from the last solution, as without a prediction",
            work: Box::new(|| {
                let newton = unpredicted.carried();
                for &t in &times {
                    newton.step(black_box(&four_bar), black_box(t));
                    black_box(&newton.q_ddot);
                }
                newton.q[2] -= 360_f64.to_radians();
            }),
        },
        Contender {
            name: "kin, the plan",
            work: Box::new(|| {
                let (q, q_dot, q_ddot, margins) = planned.carried();
                for &t in &times {
                    let start = *q;
                    let solved = Solved { q, q_dot, q_ddot, margins };
                    let at = Instant::at(black_box(t));
                    let parameters = black_box(&four_bar).parameters::<f64>();
                    four_bar
                        .solve_with(&parameters, &at, &modes, &start, Depth::Acceleration, solved)
                        .expect("nine coordinates");
                    black_box((&*q, &*q_dot, &*q_ddot, &*margins));
                }
                q[2] -= 360_f64.to_radians();
            }),
        },
        Contender {
            name: "the dyad by hand, functions of the standard library",
            work: Box::new(|| {
                let (q, q_dot, q_ddot) = dyad.carried();
                for &t in &times {
                    let start = *q;
                    dyad_by_hand(black_box(&four_bar), black_box(t), q, q_dot, q_ddot, &start);
                    black_box((&*q, &*q_dot, &*q_ddot));
                }
                q[2] -= 360_f64.to_radians();
            }),
        },
        Contender {
            name: "the dyad by hand, kin's sines, cosines and angles",
            work: Box::new(|| {
                let (q, q_dot, q_ddot) = dyad_lanes.carried();
                for &t in &times {
                    let start = *q;
                    dyad_in_lanes(black_box(&four_bar), black_box(t), q, q_dot, q_ddot, &start);
                    black_box((&*q, &*q_dot, &*q_ddot));
                }
                q[2] -= 360_f64.to_radians();
            }),
        },
    ];
    #[allow(unused_mut, reason = "only lanes are added")]
    let mut contenders: Vec<Contender<'_>> = contenders.into_iter().collect();
    #[cfg(feature = "simd")]
    {
        contenders.push(in_lanes(&four_bar, &state.q, modes[0]));
        contenders.extend(in_batches(&four_bar, &state.q, modes[0]));
    }
    compare("q, q̇, q̈ of the 9×9 four-bar at steps of one degree", STEPS, &mut contenders);
    drop(contenders);
    let worst = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (by_hand, by_plan) = (dyad.here(), planned.here());
    println!(
        "  by hand less kin at the end: {:.1e} {:.1e} {:.1e}",
        worst(&by_hand.0, &by_plan.0),
        worst(&by_hand.1, &by_plan.1),
        worst(&by_hand.2, &by_plan.2)
    );
}
