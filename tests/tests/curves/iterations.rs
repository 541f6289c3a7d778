//! The number of corrections in the iterations of plans, which is one for small steps; and their accuracy in `f32`.

use kin_runtime::plan::{Depth, Plan, Solved};
use kin_runtime::{Instant, Kinematics, ScalarFunction, mechanism};
use kin_tests::mechanisms::{
    AndrewsPins, DwellPress, FourbarLectureMid, KlannLeg, MarghituSixLink, Peaucellier, PlanetaryBasic, QuickReturn,
    RedundantParallelogram, Robot3rrr, ScotchYoke, TogglePress, WattSixbar,
};
use std::cell::Cell;

/// A sine that counts its evaluations.
#[derive(Default)]
struct Counted {
    calls: Cell<usize>,
}

impl ScalarFunction for Counted {
    fn evaluate(&self, x: f64) -> [f64; 3] {
        self.calls.set(self.calls.get() + 1);
        let (sin, cos) = x.sin_cos();
        [sin, cos, -sin]
    }
}

/// Kepler's equation, and a point that depends on its solution.
#[mechanism]
#[coordinates(mean, eccentric)]
#[function(f)]
#[driver(drive: mean = t)]
#[constraint(kepler: eccentric - 0.4 * f(eccentric) = mean)]
struct Orbit {
    f: Counted,
}

/// The number of evaluations per instant for `steps` instants at the distance `h`, after `early` others.
fn calls(steps: usize, h: f64, early: usize) -> f64 {
    let orbit = Orbit { f: Counted::default() };
    let mut planned = orbit.solver().planned(&Instant::at(0.0)).unwrap();
    for k in 1..=early + steps {
        if k == early + 1 {
            orbit.f.calls.set(0);
        }
        let t = h * k as f64;
        let state = planned.at(&Instant::at(t)).unwrap();
        let e = state.q()[1];
        assert!((e - 0.4 * e.sin() - t).abs() < 1e-14 * (1.0 + t), "{t}: {e}");
    }
    orbit.f.calls.get() as f64 / steps as f64
}

#[test]
fn one_correction_is_enough_at_one_degree() {
    // The steps are so small that nothing remains to be corrected.
    let once = calls(10, 1e-7, 3);
    let found = calls(360, 1_f64.to_radians(), 3);
    assert!(found <= once + 0.02, "{found} calls where {once} are one correction");
    // With steps of half a radian, there are more corrections, which shows that the count works.
    let far = calls(100, 0.5, 3);
    assert!(far > once + 0.9, "{far} calls where {once} are one correction");
}

/// Compares q, q̇ and q̈ in `f32`, from a start slightly beside the solution, with those in `f64`; the margins agree
/// and are positive.
fn single<M: Kinematics + Default>() {
    let (mechanism, plan) = (M::default(), &M::model().plan);
    let name = M::model().name;
    assert!(plan.exists(), "{name}");
    for t in [0.0, 0.1, 0.25] {
        let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
        (0..=10).for_each(|k| _ = planned.at(&Instant::at(0.1 * t * f64::from(k))).unwrap());
        let least = planned.margins().iter().fold(1.0_f64, |least, margin| least.min(*margin));
        let modes: Vec<f32> = planned.modes().map(|sign| sign.value() as f32).collect();
        let start: Vec<f32> = planned.q().iter().map(|q| (q + 0.01) as f32).collect();
        let [mut q, mut q_dot, mut q_ddot] = [(); 3].map(|()| vec![f32::NAN; M::COORDINATES]);
        let mut margins = vec![f32::NAN; plan.margins];
        let parameters = mechanism.parameters::<f32>();
        let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut margins };
        let at = Instant::at(t as f32);
        mechanism.solve_with(parameters.as_ref(), &at, &modes, &start, Depth::Acceleration, solved).unwrap();
        for (margin, expected) in margins.iter().zip(planned.margins()) {
            let off = (f64::from(*margin) - expected).abs();
            assert!(off < 1e-2 && f64::from(*margin) > Plan::SMALLEST_MARGIN, "{name}, {t}: {margin} for {expected}");
        }
        let pairs = [(&q, planned.q()), (&q_dot, planned.q_dot()), (&q_ddot, planned.q_ddot())];
        for (order, (found, expected)) in pairs.into_iter().enumerate() {
            let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            let off = found.iter().zip(expected).map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-5 * size / least.powi(order as i32 + 1), "{name}, {t}: order {order} off by {off:e}");
        }
    }
}

#[test]
fn plans_in_single_precision_are_those_in_double() {
    single::<FourbarLectureMid>();
    single::<QuickReturn>();
    single::<DwellPress>();
    single::<KlannLeg>();
    single::<Robot3rrr>();
    single::<AndrewsPins>();
    single::<TogglePress>();
    single::<Peaucellier>();
    single::<RedundantParallelogram>();
    single::<PlanetaryBasic>();
    single::<WattSixbar>();
    single::<MarghituSixLink>();
    single::<ScotchYoke>();
}
