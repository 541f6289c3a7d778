//! The derivatives of q, q̇ and q̈ of the lecture's four-bar with respect to all seven parameters, compared with q, q̇ and
//! q̈ alone by the same plan: `cargo bench -p kin-benches --bench sensitivities`.

use kin_benches::four_bar::FourBar;
use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::batch::{self, Column, Modes, Problems, SensitivitySolutions, Solutions, always};
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::scalar::Tangents;
use kin_runtime::{Instant, Kinematics, Measure, Mechanism, Scalar};
use std::hint::black_box;

/// The steps of one revolution.
const STEPS: usize = 360;

/// The plan evaluated over a scalar type, from instant to instant.
struct Steps<'m, T> {
    four_bar: &'m FourBar,
    parameters: [T; 7],
    modes: [T; 1],
    start: [T; 9],
    found: Placed<[[T; 9]; 3]>,
}

impl<'m, T: Scalar> Steps<'m, T> {
    fn new(four_bar: &'m FourBar, parameters: [T; 7]) -> Self {
        let start = four_bar.solver().with_guess(5, 0.9).with_guess(8, 5.0).state(&0.0.into()).expect("it closes");
        let (numbers, mut modes) = (four_bar.parameters::<f64>(), [0.0]);
        four_bar.branches_with(&numbers, &Instant::at(0.0), &start.q, &mut modes).expect("one mode");
        let zero = T::from_f64(0.0);
        Self {
            four_bar,
            parameters,
            modes: modes.map(|mode: f64| T::from_f64(mode.signum())),
            start: std::array::from_fn(|k| T::from_f64(start.q[k])),
            found: Placed::new(|| [[zero; 9]; 3]),
        }
    }

    fn turn(&mut self) {
        for step in 0..STEPS {
            let at = Instant::at(T::from_f64(step as f64 * std::f64::consts::TAU / STEPS as f64));
            let [q, q_dot, q_ddot] = self.found.here();
            let mut margins = [T::from_f64(0.0); 9];
            let solved = Solved { q, q_dot, q_ddot, margins: &mut margins[..FourBar::model().plan.margins] };
            let (parameters, modes) = (black_box(&self.parameters), &self.modes);
            self.four_bar
                .solve_with(parameters, &at, modes, &self.start, Depth::Acceleration, solved)
                .expect("nine coordinates");
            black_box(self.found.here());
        }
    }
}

/// The instants of a turn as a batch.
struct Batch<'m> {
    four_bar: &'m FourBar,
    parameters: Vec<Column<'static>>,
    times: &'m [f64],
    start: Vec<Column<'static>>,
    solutions: Solutions<FourBar>,
    sensitivities: SensitivitySolutions,
}

impl<'m> Batch<'m> {
    fn new(four_bar: &'m FourBar, times: &'m [f64], start: &[f64]) -> Self {
        Self {
            four_bar,
            parameters: four_bar.parameters::<f64>().into_iter().map(Column::Shared).collect(),
            times,
            start: start.iter().map(|x| Column::Shared(*x)).collect(),
            solutions: Solutions::new(STEPS),
            sensitivities: SensitivitySolutions::new(STEPS, 27, 7),
        }
    }

    fn problems(&self) -> Problems<'_> {
        let Self { parameters, times, start, .. } = self;
        Problems { parameters, t: Column::Each(times), inputs: &[], modes: Modes::Signs(&[Column::Shared(1.0)]), start }
    }

    fn solve(&mut self) {
        let mut solutions = std::mem::replace(&mut self.solutions, Solutions::new(0));
        batch::solve(self.four_bar, Depth::Acceleration, &self.problems(), &mut solutions, &always)
            .expect("nine columns");
        self.solutions = solutions;
        black_box(&self.solutions);
    }

    fn derive(&mut self, measures: &[Measure]) {
        let mut out = std::mem::replace(&mut self.sensitivities, SensitivitySolutions::new(0, 0, 0));
        let by = [0, 1, 2, 3, 4, 5, 6];
        batch::sensitivities(self.four_bar, &self.problems(), &self.solutions, measures, &by, &mut out, &always)
            .expect("closed forms");
        self.sensitivities = out;
        black_box(&self.sensitivities);
    }
}

fn main() {
    let four_bar = FourBar::default();
    let numbers = four_bar.parameters::<f64>();
    let mut plain = Steps::new(&four_bar, numbers);
    let mut seven: Steps<'_, Tangents<7>> =
        Steps::new(&four_bar, std::array::from_fn(|k| Tangents::variable(numbers[k], k)));
    let mut eight: Steps<'_, Tangents<8>> =
        Steps::new(&four_bar, std::array::from_fn(|k| Tangents::variable(numbers[k], k)));
    let solver = four_bar.solver();
    let state = solver.with_guess(5, 0.9).with_guess(8, 5.0).state(&0.0.into()).expect("it closes");
    let solver = four_bar.solver().with_guess(5, 0.9).with_guess(8, 5.0);
    let times: Vec<f64> = (0..STEPS).map(|step| step as f64 * std::f64::consts::TAU / STEPS as f64).collect();
    let turn = solver.sweep(&times).expect("it turns").states;
    let wanted: Vec<Measure> =
        ["rocker.phi", "coupler.x"].iter().filter_map(|name| Measure::named(FourBar::model(), name)).collect();
    let weights: Vec<f64> = (0..wanted.len() * STEPS).map(|k| 0.5 + (k % 7) as f64).collect();
    let everything: Vec<Measure> = Measure::all(FourBar::model()).into_iter().skip(1).take(27).collect();
    let mut batch = Batch::new(&four_bar, &times, &turn[0].q);
    let mut alone = Batch::new(&four_bar, &times, &turn[0].q);
    compare(
        "q, q̇, q̈ of the four-bar and their derivatives by seven parameters",
        STEPS,
        &mut [
            Contender { name: "the plan", work: Box::new(|| plain.turn()) },
            Contender { name: "with tangents by seven parameters", work: Box::new(|| seven.turn()) },
            Contender { name: "with tangents in eight lanes", work: Box::new(|| eight.turn()) },
            Contender { name: "batch::solve", work: Box::new(move || alone.solve()) },
            Contender {
                name: "batch::solve and batch::sensitivities, all of q, q̇, q̈ by all seven",
                work: Box::new(move || {
                    batch.solve();
                    batch.derive(&everything);
                }),
            },
            Contender {
                name: "Solver::gradient of one objective by all seven",
                work: Box::new(|| {
                    black_box(solver.gradient(black_box(&turn), &wanted, &weights).expect("regular states"));
                }),
            },
            Contender {
                name: "Solver::sweep, states of a turn",
                work: Box::new(|| {
                    black_box(solver.sweep(black_box(&times)).expect("it turns"));
                }),
            },
            Contender {
                name: "Solver::sensitivities, with points and joints",
                work: Box::new(|| {
                    for _ in 0..STEPS {
                        black_box(solver.sensitivities(black_box(&state)).expect("a regular state"));
                    }
                }),
            },
        ],
    );
}
