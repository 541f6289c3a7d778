//! Motions that begin at a large t: what is relative to their start must not depend on when that is.

use super::jumps::reached;
use kin_runtime::mechanism;

/// A slider pulls a bar and a crank, whose lengths may be equal, so that the slider may pass the crank's pivot.
#[mechanism]
#[bodies(bar, crank)]
#[body(slider, y = 0, phi = 0)]
#[revolute(A: bar @ (0, 0), slider @ (0, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), bar @ (l, 0))]
#[driver(pull: slider.x = -0.438 - 0.271 * (t - start) - 0.0463 * sin(1.06 * (t - start)))]
#[guess(bar.phi = 1.27, crank.phi = 1.96, slider.x = -0.4)]
struct Pulled {
    l: f64,
    r: f64,
    start: f64,
}

#[test]
fn a_limit_does_not_depend_on_when_the_motion_begins() {
    let steps = [0.0, 0.57, 0.9, 1.1, 2.2, 2.5, 3.0, 3.5];
    for (l, r) in [(0.64, 0.64), (0.639_952_282_479, 0.639_952_283_198), (0.7, 0.58)] {
        let mut all = [0.0, 1e4, 1e5, -1e6].map(|start| {
            let times = steps.map(|step| start + step);
            reached(&Pulled { l, r, start }, &times)
        });
        // The crank and the bar are stretched at about t − start = 3.14.
        assert_eq!([[7; 5]; 4], all, "{l} {r}");
        all = [0.0, 1e4, 1e5, -1e6].map(|start| {
            let times = steps[..6].iter().rev().map(|step| start + step).collect::<Vec<f64>>();
            reached(&Pulled { l, r, start }, &times)
        });
        assert_eq!([[6; 5]; 4], all, "backwards {l} {r}");
    }
}

/// The same slider, uniformly accelerated.
#[mechanism]
#[bodies(bar, crank)]
#[body(slider, y = 0, phi = 0)]
#[revolute(A: bar @ (0, 0), slider @ (0, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), bar @ (l, 0))]
#[driver(pull: slider.x = 0.08 * pow(t - start, 2) - 1)]
#[guess(bar.phi = 0.57, crank.phi = 2.44, slider.x = -1)]
struct Accelerated {
    l: f64,
    r: f64,
    start: f64,
}

#[test]
fn a_limit_does_not_depend_on_when_an_accelerated_motion_begins() {
    let steps = [0.0, 0.57, 0.9, 1.1, 2.2, 2.5, 3.0, 3.5];
    // The crank lies on the bar at 0.08 (t − start)² = 0.88; bars of equal length pass the pivot.
    for (l, r, reaches) in [(0.7, 0.58, 7), (0.58, 0.7, 7), (0.64, 0.64, 8)] {
        for start in [0.0, 1e3, 1e4, 1e5, -1e6] {
            let times = steps.map(|step| start + step);
            assert_eq!([reaches; 5], reached(&Accelerated { l, r, start }, &times), "{l} {r} from {start}");
            let times = steps[..reaches - 1].iter().rev().map(|step| start + step).collect::<Vec<f64>>();
            assert_eq!([reaches - 1; 5], reached(&Accelerated { l, r, start }, &times), "backwards {l} {r} to {start}");
        }
    }
}
