//! Curves with a sharp, rounded corner: regular motions around it, and motions that end within it.

use kin_runtime::{Instant, Kinematics, Limit, mechanism};

/// A pin against the curve Y = m X − a √((X − c)² + w²) of a plate that rises: two straight lines of the slopes m ± a,
/// which a corner of the size w joins.
#[mechanism]
#[body(pin, y = 0, phi = 0)]
#[body(plate, x = 0, phi = 0)]
#[on_curve(slot: plate @ (0, 0), pin @ (0, 0), implicit(X, Y) = Y - m * X + a * sqrt(pow(X - c, 2) + w * w))]
#[driver(lift: plate.y = h + r * t)]
#[derive(Clone, Debug)]
struct Corner {
    m: f64,
    a: f64,
    c: f64,
    w: f64,
    h: f64,
    r: f64,
}

impl Corner {
    /// The height of the plate with the pin at x.
    fn height(&self, x: f64) -> f64 {
        -self.m * x + self.a * (x - self.c).hypot(self.w)
    }

    /// The time at which the pin is at x.
    fn time(&self, x: f64) -> f64 {
        (self.height(x) - self.h) / self.r
    }

    /// The same slot, with the pin at x when t = 0.
    fn at(self, x: f64) -> Self {
        Self { h: self.height(x), ..self }
    }
}

/// Behind the corner both slopes are nearly the same, so that the contact is near its limit but comes no nearer.
#[test]
fn around_a_sharp_corner() {
    for (m, a, w, r, c, start, far) in [
        (0.956, 0.790, 2.9e-4, -0.22, 1.027, -0.98, 1.12),
        (0.956, 0.790, 2.9e-4, -0.22, 1.027, -0.98, 6.8),
        (0.841, 0.827, 1.9e-5, 0.53, 0.516, -0.34, 108.0),
        (0.5, 0.49, 1e-4, 1.0, 2.0, -1.0, 2.3),
    ] {
        let corner = Corner { m, a, c, w, h: 0.0, r }.at(start);
        let solver = corner.solver().with_guess(0, start);
        let t = corner.time(far);
        let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes");
        let found = planned.at(&Instant::at(t)).expect("the motion is regular");
        assert!((found.q()[0] - far).abs() < 1e-8 * far, "{corner:?} {:?}", found.q());
        let swept = solver.sweep(&[0.0, t]).expect("the motion is regular");
        assert!((swept.states[1].q[0] - far).abs() < 1e-8 * far, "{corner:?} {:?}", swept.states[1].q);
    }
}

/// Seen from afar the contact comes to its limit where the corner begins.
#[test]
fn the_dead_centre_within_a_sharp_corner_is_located() {
    for (m, a, w, r, c, start) in [
        (0.40, -0.44, 3.5e-5, -0.72, 1.9, -0.64),
        (0.40, -0.44, 1.5e-4, 0.72, 1.9, -0.64),
        (1.0, 1.5, 1e-4, -1.0, 1.0, -1.0),
        (0.3, 0.9, 2e-4, 0.5, 2.5, 0.0),
    ] {
        let corner = Corner { m, a, c, w, h: 0.0, r }.at(start);
        // dY/dX = 0
        let end = corner.time(c + w * (m / a) / (1.0 - m * m / (a * a)).sqrt());
        let solver = corner.solver().with_guess(0, start);
        let refused = solver.sweep(&[0.0, 0.8 * end, 1.3 * end]).expect_err("a dead centre");
        let at = refused.source.limit().and_then(Limit::at).expect("it is located");
        assert!((at - end).abs() < 2e-6 * end.abs(), "{corner:?}: {at} instead of {end}");
        let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes");
        planned.at(&Instant::at(0.8 * end)).expect("before the dead centre");
        let refused = planned.at(&Instant::at(1.3 * end)).expect_err("a dead centre");
        let at = refused.limit().and_then(Limit::at).expect("it is located");
        assert!((at - end).abs() < 2e-6 * end.abs(), "{corner:?}: {at} instead of {end}");
    }
}
