//! Derivatives of higher order of the lecture's four-bar, joint by joint, compared with q, q̇, q̈ by the same linear
//! algebra: `cargo bench -p kin-benches --bench orders`, as in `benches/table.sh` for other instruction sets.
//!
//! q, q̇, q̈ in steps of 1°: predicted from the last instant and corrected by Newton's method on all nine coordinates,
//! with nalgebra's LU of a size known at compile time; the last factorisation is used for q̇, q̈ and every higher
//! order.

use kin_benches::four_bar::FourBar;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::nalgebra::{Const, LU, SMatrix, SVector};
use kin_runtime::series::HigherOrders;
use kin_runtime::{Instant, Kinematics, Mechanism, Subset, Workspace};
use std::hint::black_box;

/// The steps of one revolution.
const STEPS: usize = 360;

type Matrix = SMatrix<f64, 9, 9>;
type Vector = SVector<f64, 9>;
type Factors = LU<f64, Const<9>, Const<9>>;

/// The current state of the motion, and buffers for the next instant.
struct Sweep<'m> {
    four_bar: &'m FourBar,
    workspace: Workspace<FourBar>,
    phi_q: Matrix,
    orders: HigherOrders<'m, FourBar>,
    q: Vector,
    q_dot: Vector,
    q_ddot: Vector,
}

impl<'m> Sweep<'m> {
    fn new(four_bar: &'m FourBar, highest: usize) -> Self {
        let start = four_bar.solver().with_guess(5, 0.9).with_guess(8, 5.0).state(&0.0.into()).expect("it closes");
        Self {
            four_bar,
            workspace: FourBar::workspace(),
            phi_q: Matrix::zeros(),
            orders: HigherOrders::new(four_bar, highest),
            q: Vector::from_column_slice(&start.q),
            q_dot: Vector::from_column_slice(&start.q_dot),
            q_ddot: Vector::from_column_slice(&start.q_ddot),
        }
    }

    /// Evaluates at q, q̇ and factorises Φ_q.
    fn factorise(&mut self, subset: Subset, at: &Instant<'_>) -> Factors {
        let (q, q_dot) = (self.q.as_slice(), self.q_dot.as_slice());
        self.four_bar.evaluate(subset, at, q, q_dot, &mut self.workspace).expect("nine coordinates");
        let entries = FourBar::model().constraint_pattern.entries;
        for (&place, &value) in entries.iter().zip(self.workspace.phi_q()) {
            self.phi_q[place] = value;
        }
        self.phi_q.lu()
    }

    fn vector(of: &[f64]) -> Vector {
        Vector::from_column_slice(of)
    }

    /// Computes q, q̇, q̈ at t, `dt` after the last instant.
    fn second(&mut self, t: f64, dt: f64) -> Factors {
        let at = Instant::at(t);
        self.q += dt * (self.q_dot + 0.5 * dt * self.q_ddot);
        let mut factors = self.factorise(Subset::POSITION, &at);
        loop {
            let step = factors.solve(&Self::vector(self.workspace.phi())).expect("a regular position");
            self.q -= step;
            factors = self.factorise(Subset::ALL, &at);
            if self.workspace.phi().iter().all(|phi: &f64| phi.abs() < 1e-12) {
                break;
            }
        }
        self.q_dot = factors.solve(&-Self::vector(self.workspace.phi_t())).expect("a regular position");
        let (q, q_dot) = (self.q.as_slice(), self.q_dot.as_slice());
        self.four_bar.evaluate(Subset::GAMMA, &at, q, q_dot, &mut self.workspace).expect("nine coordinates");
        self.q_ddot = factors.solve(&Self::vector(self.workspace.gamma())).expect("a regular position");
        factors
    }

    /// Computes all orders from the third to the highest.
    fn higher(&mut self, t: f64, factors: &Factors, highest: usize) {
        let known = [&self.q, &self.q_dot, &self.q_ddot].map(|v| v.as_slice());
        self.orders.begin(&Instant::at(t), known[0], known[1], known[2]).expect("nine coordinates");
        for order in 3..=highest {
            let derivative = factors.solve(&Self::vector(self.orders.right())).expect("a regular position");
            black_box(&derivative);
            if order < highest {
                self.orders.advance(derivative.as_slice()).expect("nine coordinates");
            }
        }
    }
}

fn main() {
    let four_bar = FourBar::default();
    let dt = std::f64::consts::TAU / STEPS as f64 / four_bar.omega;
    let sweep = |highest: usize| {
        let (mut sweep, mut t) = (Placed::new(|| Sweep::new(&four_bar, highest)), 0.0);
        move || {
            let sweep = sweep.carried();
            for _ in 0..STEPS {
                t += dt;
                let factors = sweep.second(black_box(t), dt);
                if highest > 2 {
                    sweep.higher(t, &factors, highest);
                }
                black_box((&sweep.q, &sweep.q_dot, &sweep.q_ddot));
            }
        }
    };
    let mut contenders = [
        Contender { name: "q, q̇, q̈", work: Box::new(sweep(2)) },
        Contender { name: "and the third derivative", work: Box::new(sweep(3)) },
        Contender { name: "and all to the fourth", work: Box::new(sweep(4)) },
        Contender { name: "and all to the tenth", work: Box::new(sweep(10)) },
    ];
    compare("Higher derivatives of the 9×9 four-bar, by the same LU", STEPS, &mut contenders);

    let four_bar = &four_bar;
    let solver = four_bar.solver().with_guess(5, 0.9).with_guess(8, 5.0);
    let state = solver.state(&0.0.into()).expect("it closes");
    let times: Vec<f64> = (0..STEPS).map(|k| k as f64 * dt).collect();
    let states = solver.sweep(&times).expect("the crank turns").states;
    let mut planned = solver.planned(&0.0.into()).expect("it closes");
    let (solver, states) = (&solver, &states);
    let all_orders = |highest: usize| {
        move || {
            for state in states {
                black_box(solver.derivatives(black_box(state), highest).expect("a regular position"));
            }
        }
    };
    let mut contenders = [
        Contender {
            name: "q, q̇, q̈ by `Planned`",
            work: Box::new(|| {
                for &t in &times {
                    black_box(planned.at(&Instant::at(black_box(t))).expect("the crank turns").q_ddot());
                }
            }),
        },
        Contender { name: "`derivatives` to the third order", work: Box::new(all_orders(3)) },
        Contender { name: "`derivatives` to the fourth order", work: Box::new(all_orders(4)) },
        Contender { name: "`derivatives` to the tenth order", work: Box::new(all_orders(10)) },
    ];
    compare("Higher derivatives of the 9×9 four-bar, by its plan", STEPS, &mut contenders);

    let right_hand_sides = |highest: usize| {
        let mut orders = Placed::new(|| HigherOrders::new(four_bar, highest));
        let state = state.clone();
        move || {
            let orders = orders.here();
            for _ in 0..STEPS {
                let at = Instant::at(black_box(state.t));
                orders.begin(&at, black_box(&state.q), &state.q_dot, &state.q_ddot).expect("nine coordinates");
                for _ in 3..highest {
                    orders.advance(black_box(&state.q_ddot)).expect("nine coordinates");
                }
                black_box(orders.right());
            }
        }
    };
    let mut workspace = Placed::new(FourBar::workspace::<f64>);
    let mut contenders = [
        Contender {
            name: "Φ, Φ_q, Φ_t, γ",
            work: Box::new(|| {
                let workspace = workspace.here();
                for _ in 0..STEPS {
                    let at = Instant::at(black_box(state.t));
                    let (q, q_dot) = (black_box(&state.q), &state.q_dot);
                    four_bar.evaluate(Subset::ALL, &at, q, q_dot, workspace).expect("nine coordinates");
                    black_box(&*workspace);
                }
            }),
        },
        Contender { name: "right-hand side of order 3", work: Box::new(right_hand_sides(3)) },
        Contender { name: "right-hand sides of orders 3 and 4", work: Box::new(right_hand_sides(4)) },
        Contender { name: "right-hand sides of orders 3 to 10", work: Box::new(right_hand_sides(10)) },
    ];
    compare("Right-hand sides alone", STEPS, &mut contenders);
}
