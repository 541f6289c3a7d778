//! Guides whose direction is given by parameters: the plan solves them in every direction.

use kin_runtime::{Instant, Kinematics, mechanism};

/// A slider-crank whose rod is a distance and whose guide is tilted.
#[mechanism]
#[bodies(crank, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[distance(rod: crank @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (cos(tilt), sin(tilt)))]
#[driver(drive: crank.phi = 3 * t)]
#[guess(crank.phi = 0.1, slider.x = 0.9 * cos(tilt), slider.y = 0.9 * sin(tilt))]
struct Tilted {
    tilt: f64,
}

/// A pin on two lines.
#[mechanism]
#[bodies(pin)]
#[constraint(first: p * pin.x + q * pin.y = 0.1)]
#[constraint(second: q * pin.x - p * pin.y = 0.2 * t)]
#[driver(turn: pin.phi = t)]
struct Lines {
    p: f64,
    q: f64,
}

#[test]
fn a_slider_runs_along_a_guide_in_any_direction() {
    for tilt in [0.0, 1e-9, 0.3, std::f64::consts::FRAC_PI_2, std::f64::consts::PI, -1.2] {
        let tilted = Tilted { tilt };
        let mut planned = tilted.solver().planned(&Instant::at(0.0)).expect("it closes");
        for k in 1..30 {
            let t = 0.1 * f64::from(k);
            // Along the guide the law of cosines holds for the crank's angle from it.
            let angle = 3.0 * t - tilt;
            let along = 0.2 * angle.cos() + (0.49 - (0.2 * angle.sin()).powi(2)).sqrt();
            let q = planned.at(&Instant::at(t)).expect("the crank turns").q();
            let off = (q[3] - along * tilt.cos()).hypot(q[4] - along * tilt.sin());
            assert!(off < 1e-14, "tilt {tilt}, t = {t}: {off:e}");
        }
        let all = tilted.solver().ranges(&Instant::at(0.0), 3.0).expect("ranges");
        assert!(all.is_complete() && all.ranges.len() == 2, "{all}");
    }
}

#[test]
fn a_pin_lies_where_two_lines_meet() {
    for (p, q) in [(0.0, 1.0), (1.0, 0.0), (0.6, 0.8)] {
        let lines = Lines { p, q };
        let mut planned = lines.solver().planned(&Instant::at(0.0)).expect("the lines meet");
        let found = planned.at(&Instant::at(0.7)).expect("the lines meet").q().to_vec();
        let exact = [0.1 * p + 0.14 * q, 0.1 * q - 0.14 * p];
        assert!((found[0] - exact[0]).hypot(found[1] - exact[1]) < 1e-15, "{p} {q}: {found:?}");
    }
}
