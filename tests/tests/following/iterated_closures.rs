//! Four-bars that are nearly parallelograms, driven by the sum of their cranks' angles: the plan iterates on the angle of the
//! coupler, which is itself nearly 0, and the cranks follow from it with a large factor. The closure that is meant is the one
//! near the whole start, and the iteration goes on until the cranks are accurate, too.

use kin_runtime::batch::{self, Column, Modes, Problems, Solutions};
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Mechanism, Options, PlanError, Planned, Signal, mechanism};

#[mechanism]
#[body(left, x = 0, y = 0)]
#[bodies(coupler)]
#[body(right, x = d, y = 0)]
#[revolute(A: left @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), right @ (c, 0))]
#[driver(sum: left.phi + right.phi = 2 + t)]
#[guess(left.phi = 1, right.phi = 1, coupler.phi = 0)]
struct Sum {
    b: f64,
    c: f64,
    d: f64,
}

impl Sum {
    fn nearly_parallelogram(k: f64) -> Self {
        Self { b: 2.0 - 0.3 * k, c: 1.0 + k, d: 2.0 }
    }

    /// The largest distance between the pins of a joint, by hand, relative to the length of a crank.
    fn gap(&self, q: &[f64]) -> f64 {
        let at = |name: &str| q[Self::model().coordinates.iter().position(|c| c.name == name).expect("a coordinate")];
        let [left, right, x, y, phi] = ["left.phi", "right.phi", "coupler.x", "coupler.y", "coupler.phi"].map(at);
        let a = (x - left.cos()).hypot(y - left.sin());
        let b = (x + self.b * phi.cos() - self.d - self.c * right.cos())
            .hypot(y + self.b * phi.sin() - self.c * right.sin());
        a.max(b)
    }
}

/// The configuration by full Newton.
fn near(bar: &Sum, t: f64) -> Vec<f64> {
    let options = Options { use_plan: false, ..Options::default() };
    bar.solver().with_options(options).state(&Instant::at(t)).expect("it closes").q
}

fn configuration(found: &Solutions<Sum>, index: usize) -> Vec<f64> {
    (0..Sum::COORDINATES).filter_map(|k| found.q(k).nth(index)).collect()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Asserts that a batch from one start closes the pins wherever it solves, and solves at the start.
fn assert_accurate_in_batch(bar: &Sum, times: &[f64], start: &[f64], allowed: f64) {
    let columns: Vec<Column<'_>> = start.iter().map(|q| Column::Shared(*q)).collect();
    let parameters = [bar.b, bar.c, bar.d].map(Column::Shared);
    let mut found = Solutions::<Sum>::new(times.len());
    let t = Column::Each(times);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes: Modes::OfStart, start: &columns };
    batch::solve(bar, Depth::Acceleration, &problems, &mut found, &batch::always).expect("the columns fit");
    let solved: Vec<bool> = found.solved().collect();
    assert!(solved[0], "{}", bar.b);
    for index in (0..times.len()).filter(|index| solved[*index]) {
        let q = configuration(&found, index);
        assert!(bar.gap(&q) <= allowed, "{}, {}: {:e}", bar.b, times[index], bar.gap(&q));
    }
}

#[test]
fn a_start_leads_to_its_own_closure() {
    for k in [0.1, -0.1, 0.03, 1e-2, 1e-3, -1e-3, 1e-4, 1e-6, -1e-6] {
        let bar = Sum::nearly_parallelogram(k);
        let expected = near(&bar, 0.0);
        let is_near = |q: &[f64]| largest_difference(q, &expected) < 1e-6;
        let state = bar.state_at(&Instant::at(0.0)).expect("it closes");
        assert!(is_near(&state.q), "{k}: {:?} for {expected:?}", state.q);
        let start = [1.0, 1.0_f64.cos(), 1.0_f64.sin(), 0.0, 1.0];
        let state = bar.solver().state_from(&Instant::at(0.0), &start).expect("it closes");
        assert!(is_near(&state.q), "{k}: {:?}", state.q);
        let position = bar.solver().position(&Instant::at(0.0), &start).expect("it closes");
        assert!(is_near(&position.q), "{k}: {:?}", position.q);
        match Planned::new(&bar, &Instant::at(0.0), &start) {
            Ok(planned) => assert!(is_near(planned.q()), "{k}: {:?}", planned.q()),
            Err(error) => assert!(matches!(error, PlanError::OtherClosure { t: 0.0, .. }), "{k}: {error}"),
        }
        assert!(Planned::new(&bar, &Instant::at(0.0), &expected).is_ok_and(|planned| is_near(planned.q())), "{k}");
        let columns = start.map(Column::Shared);
        let parameters = [bar.b, bar.c, bar.d].map(Column::Shared);
        let mut found = Solutions::<Sum>::new(1);
        let t = Column::Shared(0.0);
        let problems = Problems { parameters: &parameters, t, inputs: &[], modes: Modes::OfStart, start: &columns };
        batch::solve(&bar, Depth::Acceleration, &problems, &mut found, &batch::always).expect("the columns fit");
        let q = configuration(&found, 0);
        assert!(found.solved().next() == Some(false) || is_near(&q), "{k}: {q:?}");
    }
}

#[test]
fn an_iteration_goes_on_until_all_coordinates_are_accurate() {
    for k in [1e-3, 1e-4, -1e-4, 1e-5, 1e-6] {
        let bar = Sum::nearly_parallelogram(k);
        let allowed = 1e-15 / k.abs() + 1e-11;
        let start = near(&bar, 0.0);
        for step in 1..=40 {
            let t = 0.025 * f64::from(step);
            let mut planned = Planned::new(&bar, &Instant::at(0.0), &start).expect("it closes");
            if let Ok(planned) = planned.at(&Instant::at(t)) {
                assert!(bar.gap(planned.q()) <= allowed, "{k}, {t}: {:e}", bar.gap(planned.q()));
            }
        }
        let times: Vec<f64> = (0..=40).map(|step| 0.025 * f64::from(step)).collect();
        assert_accurate_in_batch(&bar, &times, &start, allowed);
    }
}

/// The rod turns by about 1/b of the cranks' angles, however far its group is from singular configurations.
#[test]
fn cranks_on_a_long_rod_are_accurate() {
    for b in [3.0, 1e2, 1e3, 1e4, 1e5] {
        let bar = Sum { b, c: 1.1, d: b + 0.3 };
        // The rounding of the rod's angle.
        let allowed = 1e-15 * b.max(10.0);
        let times: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
        let states = bar.solver().sweep(&times).expect("it closes");
        let start = states.states[0].q.clone();
        let mut planned = Planned::new(&bar, &Instant::at(0.0), &start).expect("it closes");
        for state in states.iter() {
            let at = Instant::at(state.t);
            let near = bar.solver().state_from(&at, &state.q).expect("it closes").q;
            let position = bar.position_analysis(&at, &state.q).expect("it closes");
            planned.at(&at).expect("it closes");
            for q in [&state.q, planned.q(), &near, &position] {
                assert!(bar.gap(q) <= allowed, "{b}, {}: {:e}", state.t, bar.gap(q));
            }
        }
        assert_accurate_in_batch(&bar, &times, &start, allowed);
    }
}

/// The same rod, moved by a measured sum of the angles.
#[mechanism]
#[body(left, x = 0, y = 0)]
#[bodies(coupler)]
#[body(right, x = b + 0.3, y = 0)]
#[input(sum)]
#[revolute(A: left @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), right @ (1.1, 0))]
#[driver(push: left.phi + right.phi = sum)]
#[guess(left.phi = 1, right.phi = 1, coupler.phi = 0)]
struct Measured {
    b: f64,
}

/// Inputs without rates leave the mechanism at rest, where rates do not show how much faster the cranks turn.
#[test]
fn cranks_on_a_long_rod_are_accurate_at_rest() {
    for b in [1e3, 1e4, 1e5] {
        let (rod, bar) = (Measured { b }, Sum { b, c: 1.1, d: b + 0.3 });
        let inputs = |sum: f64| [Signal::constant(sum)];
        let mut before = rod.state_at(&Instant { t: 0.0, inputs: &inputs(2.0) }).expect("it closes").q;
        for step in 1..=20 {
            let at = Instant { t: 0.0, inputs: &inputs(2.0 + 0.05 * f64::from(step)) };
            let state = rod.solver().state_from(&at, &before).expect("it closes");
            let position = rod.position_analysis(&at, &before).expect("it closes");
            let planned = Planned::new(&rod, &at, &before).expect("it closes");
            for q in [&state.q, &position, planned.q()] {
                assert!(bar.gap(q) <= 1e-15 * b, "{b}, {step}: {:e}", bar.gap(q));
            }
            before = state.q;
        }
    }
}
