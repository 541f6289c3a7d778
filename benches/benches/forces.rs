//! Forces of the lecture's four-bar with masses, gravity and a spring, compared with its motion alone and with the
//! usual method: `cargo bench -p kin-benches --bench forces`, as in `benches/table.sh` for other instruction sets.
//!
//! The usual method takes q and q̇ as given and solves the 18×18 system of M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ for q̈ and λ
//! with nalgebra's dense LU of a size known at compile time; M and Q are written by hand; efforts and reactions follow
//! from λ.

use kin_benches::loaded::LoadedFourBar;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::batch::{self, Column, ForceSolutions, Modes, Problems, Solutions};
use kin_runtime::nalgebra::{SMatrix, SVector};
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Mechanism, Subset, Workspace};
use std::hint::black_box;

/// The steps of one revolution.
const STEPS: usize = 360;

/// A motion solved by the plan.
struct Motion {
    parameters: [f64; 7],
    modes: [f64; 1],
    q: [f64; 9],
    q_dot: [f64; 9],
    q_ddot: [f64; 9],
    forces: Vec<f64>,
    workspace: Workspace<LoadedFourBar>,
}

impl Motion {
    fn new(four_bar: &LoadedFourBar) -> Self {
        let start = four_bar.state_at(&0.0.into()).expect("it closes");
        let array = |v: &[f64]| -> [f64; 9] { v.try_into().expect("nine coordinates") };
        let (parameters, mut modes) = (four_bar.parameters::<f64>(), [0.0]);
        four_bar.branches_with(&parameters, &Instant::at(0.0), &start.q, &mut modes).expect("one mode");
        let count = LoadedFourBar::model().forces.expect("it has masses").count;
        Self {
            parameters,
            modes: modes.map(f64::signum),
            q: array(&start.q),
            q_dot: array(&start.q_dot),
            q_ddot: array(&start.q_ddot),
            forces: vec![0.0; count],
            workspace: LoadedFourBar::workspace(),
        }
    }

    fn step(&mut self, four_bar: &LoadedFourBar, t: f64, depth: Depth) {
        let (at, start, mut margins) = (Instant::at(t), self.q, [0.0]);
        let solved = Solved { q: &mut self.q, q_dot: &mut self.q_dot, q_ddot: &mut self.q_ddot, margins: &mut margins };
        four_bar.solve_with(&self.parameters, &at, &self.modes, &start, depth, solved).expect("nine coordinates");
        black_box(&margins);
    }

    fn forces(&mut self, four_bar: &LoadedFourBar, t: f64) {
        let (at, q, q_dot, q_ddot) = (Instant::at(t), &self.q, &self.q_dot, &self.q_ddot);
        four_bar.forces_with(&self.parameters, &at, q, q_dot, q_ddot, &[], &mut self.forces).expect("nine coordinates");
    }

    /// q̈ and λ from one linear system.
    fn peer(&mut self, four_bar: &LoadedFourBar, t: f64) -> SVector<f64, 18> {
        let at = Instant::at(t);
        let subset = Subset { phi_q: true, gamma: true, ..Subset::GAMMA };
        four_bar
            .evaluate_with(&self.parameters, subset, &at, &self.q, &self.q_dot, &mut self.workspace)
            .expect("nine coordinates");
        let mut matrix = SMatrix::<f64, 18, 18>::zeros();
        let masses = [0.5, 0.5, 0.0004, 2.0, 2.0, 0.027, 1.5, 1.5, 0.011];
        for (k, mass) in masses.into_iter().enumerate() {
            matrix[(k, k)] = mass;
        }
        let entries = LoadedFourBar::model().constraint_pattern.entries;
        for (&(row, column), &value) in entries.iter().zip(self.workspace.phi_q()) {
            matrix[(9 + row, column)] = value;
            matrix[(column, 9 + row)] = value;
        }
        let mut right = SVector::<f64, 18>::zeros();
        for k in [1, 4, 7] {
            right[k] = -9.81 * masses[k];
        }
        let (x, y) = (self.q[6], self.q[7] - 0.4);
        let length = x.hypot(y);
        let rate = (x * self.q_dot[6] + y * self.q_dot[7]) / length;
        let tension = 120.0 * (length - 0.25) + 2.0 * rate;
        right[6] -= tension * x / length;
        right[7] -= tension * y / length;
        for (row, gamma) in self.workspace.gamma().iter().enumerate() {
            right[9 + row] = *gamma;
        }
        matrix.lu().solve(&right).expect("a regular position")
    }
}

/// Number of configurations of a batch, whose results fit into the second-level cache.
const BATCH: usize = STEPS;

/// A solved batch over a turn.
struct Batch {
    times: Vec<f64>,
    start: Vec<f64>,
    modes: [f64; 1],
    parameters: [f64; 7],
    solutions: Solutions<LoadedFourBar>,
    forces: ForceSolutions<LoadedFourBar>,
}

impl Batch {
    fn new(four_bar: &LoadedFourBar) -> Self {
        let turn = std::f64::consts::TAU / four_bar.omega;
        let motion = Motion::new(four_bar);
        Self {
            times: (0..BATCH).map(|k| turn * k as f64 / BATCH as f64).collect(),
            start: motion.q.to_vec(),
            modes: motion.modes,
            parameters: motion.parameters,
            solutions: Solutions::new(BATCH),
            forces: ForceSolutions::new(BATCH),
        }
    }

    fn solve(&mut self, four_bar: &LoadedFourBar, and_forces: bool) {
        let Self { times, start, modes, parameters, solutions, forces } = self;
        let start: Vec<Column<'_>> = start.iter().map(|x| Column::Shared(*x)).collect();
        let (parameters, modes) = (parameters.map(Column::Shared), modes.map(Column::Shared));
        let t = Column::Each(black_box(times));
        let problems = Problems { parameters: &parameters, t, inputs: &[], modes: Modes::Signs(&modes), start: &start };
        batch::solve(four_bar, Depth::Acceleration, &problems, solutions, &batch::always).expect("nine columns");
        if and_forces {
            batch::forces(four_bar, &problems, solutions, forces, &batch::always).expect("it has masses");
        }
        black_box((solutions, forces));
    }
}

fn main() {
    let four_bar = &LoadedFourBar::default();
    let dt = std::f64::consts::TAU / STEPS as f64 / four_bar.omega;
    let of = |work: fn(&mut Motion, &LoadedFourBar, f64)| {
        let mut motion = Placed::new(|| Motion::new(four_bar));
        let mut t = 0.0;
        move || {
            let motion = motion.carried();
            for _ in 0..STEPS {
                t += dt;
                work(motion, four_bar, black_box(t));
                black_box((&motion.q, &motion.q_dot, &motion.q_ddot, &motion.forces));
            }
        }
    };
    let [mut alone, mut with_forces] = [(); 2].map(|()| Batch::new(four_bar));
    let mut contenders = [
        Contender {
            name: "q, q̇, q̈ by the plan",
            work: Box::new(of(|motion, four_bar, t| motion.step(four_bar, t, Depth::Acceleration))),
        },
        Contender {
            name: "and all forces",
            work: Box::new(of(|motion, four_bar, t| {
                motion.step(four_bar, t, Depth::Acceleration);
                motion.forces(four_bar, t);
            })),
        },
        Contender { name: "forces alone", work: Box::new(of(|motion, four_bar, t| motion.forces(four_bar, t))) },
        Contender {
            name: "q, q̇ by the plan, q̈ and λ by a dense LU of 18×18",
            work: Box::new(of(|motion, four_bar, t| {
                motion.step(four_bar, t, Depth::Velocity);
                black_box(motion.peer(four_bar, t));
            })),
        },
    ];
    compare("Forces of the four-bar", STEPS, &mut contenders);
    let mut contenders = [
        Contender { name: "batch::solve", work: Box::new(move || alone.solve(four_bar, false)) },
        Contender { name: "and batch::forces", work: Box::new(move || with_forces.solve(four_bar, true)) },
    ];
    compare("Forces of the four-bar in batches", BATCH, &mut contenders);
}
