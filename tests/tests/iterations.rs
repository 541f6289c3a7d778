//! How often iterations inside plans correct: once, at small steps.

use kin_runtime::{Instant, Kinematics, ScalarFunction, mechanism};
use std::cell::Cell;

/// A sine that counts how often it is asked.
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

/// Kepler's equation, and what a point on the orbit sees.
#[mechanism]
#[coordinates(mean, eccentric)]
#[function(f)]
#[driver(drive: mean = t)]
#[constraint(kepler: eccentric - 0.4 * f(eccentric) = mean)]
struct Orbit {
    f: Counted,
}

/// Calls at `steps` instants `h` apart.
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
    // So small a step that nothing is left to correct.
    let once = calls(10, 1e-7, 3);
    let found = calls(360, 1_f64.to_radians(), 3);
    assert!(found <= once + 0.02, "{found} calls where {once} are one correction");
    // Half a radian, for comparison: it does count corrections.
    let far = calls(100, 0.5, 3);
    assert!(far > once + 0.9, "{far} calls where {once} are one correction");
}
