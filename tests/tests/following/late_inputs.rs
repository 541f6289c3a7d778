//! Inputs that change at a large t, where the numbers next to t are farther apart than the steps beside a limit.

use kin_runtime::{Instant, Kinematics, Planned, Signal, mechanism};

/// A slider-crank whose slider is an input.
#[mechanism]
#[bodies(crank, bar)]
#[body(slider, y = 0, phi = 0)]
#[input(x)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), bar @ (0, 0))]
#[revolute(B: bar @ (l, 0), slider @ (0, 0))]
#[driver(push: slider.x = x)]
struct Pushed {
    r: f64,
    l: f64,
}

impl Pushed {
    /// The closed form, with the crank up.
    fn at(&self, x: f64) -> [f64; 7] {
        let Self { r, l } = *self;
        let angle = ((x * x + r * r - l * l) / (2.0 * x * r)).acos();
        let (ax, ay) = (r * angle.cos(), r * angle.sin());
        [0.0, 0.0, angle, ax, ay, (-ay).atan2(x - ax), x]
    }
}

#[test]
fn an_input_leaves_its_limit_at_any_time() {
    for (r, l) in [(0.5, 0.8), (0.45, 0.61)] {
        let mechanism = Pushed { r, l };
        let middle = l + 0.1 * r;
        for t0 in [0.0, 1e3, 1e5, 1e6] {
            for dt in [1e-3, 0.1, 1.0] {
                for exponent in 3..13 {
                    let gap = 3.0 * 0.1_f64.powi(exponent);
                    for near in [(r + l) * (1.0 - gap), (l - r) * (1.0 + gap)] {
                        let signal = |x: f64| [Signal::constant(x)];
                        let (start, inputs) = (mechanism.at(middle), signal(middle));
                        let first = Instant { t: t0, inputs: &inputs };
                        let mut tracker = mechanism.solver().tracker_from(&first, &start).expect("regular");
                        let mut planned = Planned::new(&mechanism, &first, &start).expect("regular");
                        for (k, x) in [near, l + 0.3 * r, l].into_iter().enumerate() {
                            let inputs = signal(x);
                            let at = Instant { t: t0 + dt * (k + 1) as f64, inputs: &inputs };
                            let tracked = tracker.update(&at).map(|state| state.q[2]);
                            let planned = planned.at(&at).map(|found| found.q()[2]);
                            let expected = mechanism.at(x)[2];
                            let says = format!("{r} {t0} {dt} {gap:e} {x}: {tracked:?} {planned:?}");
                            let allowed = if k == 0 { 1e-8 + 1e-14 / gap.sqrt() } else { 1e-9 };
                            let is_near = |angle: f64| (angle - expected).abs() < allowed;
                            assert!(tracked.is_ok_and(is_near) && planned.is_ok_and(is_near), "{says}");
                        }
                    }
                }
            }
        }
    }
}
