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

/// An arm of the length l on a carriage that moves along x at the height y, its tip on the curve Y = k √(X² + w²): the
/// unknown is the arm's angle.
#[mechanism]
#[body(carriage, x = t, y = y, phi = 0)]
#[bodies(arm)]
#[revolute(A: carriage @ (0, 0), arm @ (0, 0))]
#[on_curve(tip: ground @ (0, 0), arm @ (l, 0), implicit(X, Y) = Y - k * sqrt(X * X + w * w))]
#[guess(arm.phi = g)]
#[derive(Clone, Debug)]
struct Arm {
    l: f64,
    y: f64,
    k: f64,
    w: f64,
    g: f64,
}

impl Arm {
    /// With the tip behind the carriage, at u.
    fn behind(mut self, u: f64) -> Self {
        self.g = (self.rise(u)).atan2(u - self.time(u));
        self
    }

    /// The height of the tip at u above the carriage.
    fn rise(&self, u: f64) -> f64 {
        self.k * u.hypot(self.w) - self.y
    }

    /// The time at which the tip, behind the carriage, is at u.
    fn time(&self, u: f64) -> f64 {
        u + (self.l * self.l - self.rise(u).powi(2)).sqrt()
    }

    /// dt/du
    fn slowness(&self, u: f64) -> f64 {
        1.0 - self.rise(u) * self.k * u / u.hypot(self.w) / (self.l * self.l - self.rise(u).powi(2)).sqrt()
    }
}

#[test]
fn an_arm_passes_a_sharp_corner() {
    for w in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
        for (l, y, k) in [(1.5, 0.3, 0.3), (1.5, 0.3, -0.5), (1.5, 0.3, 0.9), (0.9, -0.2, 0.4)] {
            let arm = Arm { l, y, k, w, g: 0.0 }.behind(-0.4);
            for offset in 0..10 {
                let (begin, end) = (arm.time(-0.4), arm.time(0.4));
                let mut planned = arm.solver().planned(&Instant::at(begin)).expect("it closes");
                let mut t = begin + 0.0005 * (f64::from(offset) + 0.37);
                while t < end {
                    planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{arm:?} {offset}: {error}"));
                    t += 0.005;
                }
                let tip = planned.q()[2];
                let u = planned.q()[0] + l * tip.cos();
                assert!((arm.time(u) - (t - 0.005)).abs() < 1e-9, "{arm:?}: {u}");
            }
        }
    }
}

#[test]
fn the_dead_centre_of_an_arm_within_a_sharp_corner_is_located() {
    for w in [1e-3, 1e-4, 1e-5] {
        for (l, y, k) in [(1.0, -0.6, 2.0), (1.2, -0.5, 2.5)] {
            let arm = Arm { l, y, k, w, g: 0.0 }.behind(-0.15);
            let (mut low, mut high) = (0.0, 100.0 * w);
            assert!(arm.slowness(low) > 0.0 && arm.slowness(high) < 0.0, "{arm:?}");
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if arm.slowness(middle) > 0.0 { low = middle } else { high = middle }
            }
            let (begin, end) = (arm.time(-0.15), arm.time(low));
            let mut planned = arm.solver().planned(&Instant::at(begin)).expect("it closes");
            let step = planned.at(&Instant::at(end + 0.05)).expect_err("a dead centre");
            let sweep = arm.solver().sweep(&[begin, end + 0.05]).expect_err("a dead centre").source;
            for limit in [step.limit().and_then(Limit::at), sweep.limit().and_then(Limit::at)] {
                let at = limit.expect("it is located");
                assert!((at - end).abs() < 1e-10, "{arm:?}: {at} instead of {end}");
            }
        }
    }
}
