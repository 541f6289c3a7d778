//! The limits of four-bars driven by the sum of their cranks' angles, whose closure the plan iterates. In nearly
//! parallelograms other solutions come near: the curve of solutions bends sharply beside its fold.

use kin_runtime::{Instant, Kinematics, Limit, LimitKind, Options, PlanError, Planned, mechanism};
use kin_tests::random::Random;

#[mechanism]
#[body(left, x = 0, y = 0)]
#[bodies(coupler)]
#[body(right, x = d, y = 0)]
#[revolute(A: left @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), right @ (c, 0))]
#[driver(sum: left.phi + right.phi = s + v * t)]
struct Sum {
    b: f64,
    c: f64,
    d: f64,
    s: f64,
    v: f64,
}

impl Sum {
    /// By hand: the square of the distance between the pins minus that of the coupler, at the angle θ of the left crank
    /// and the sum u; and its derivatives by θ, by u, by θ twice, and by both.
    fn loop_of(&self, theta: f64, u: f64) -> [f64; 5] {
        let ((s, k), (sp, kp)) = (theta.sin_cos(), (u - theta).sin_cos());
        let (x, y) = (self.d + self.c * kp - k, self.c * sp - s);
        let (x_theta, y_theta) = (self.c * sp + s, -self.c * kp - k);
        let (x_u, y_u) = (-self.c * sp, self.c * kp);
        let (x_tt, y_tt) = (-self.c * kp + k, -self.c * sp + s);
        let (x_tu, y_tu) = (self.c * kp, self.c * sp);
        [
            x * x + y * y - self.b * self.b,
            2.0 * (x * x_theta + y * y_theta),
            2.0 * (x * x_u + y * y_u),
            2.0 * (x_theta * x_theta + y_theta * y_theta + x * x_tt + y * y_tt),
            2.0 * (x_theta * x_u + y_theta * y_u + x * x_tu + y * y_tu),
        ]
    }

    /// The fold near (θ, u), where the loop closes and its derivative by θ vanishes: Newton's iteration in θ and u.
    fn fold(&self, mut theta: f64, mut u: f64) -> Option<[f64; 2]> {
        for _ in 0..50 {
            let [f, f_theta, f_u, f_tt, f_tu] = self.loop_of(theta, u);
            let det = f_theta * f_tu - f_u * f_tt;
            let (d_theta, d_u) = ((f * f_tu - f_u * f_theta) / det, (f_theta * f_theta - f_tt * f) / det);
            (theta, u) = (theta - d_theta, u - d_u);
            // Near the change point of a parallelogram the loop hardly depends on u, so that rounding moves the fold.
            if d_theta.abs() < 1e-9 && d_u.abs() < 1e-12 {
                return Some([theta, u]);
            }
        }
        None
    }

    /// The coordinates at the angles of the left crank and of the coupler's start.
    fn start(&self, theta: f64) -> Vec<f64> {
        let right = self.s - theta;
        let (x, y) = (theta.cos(), theta.sin());
        let coupler = (self.c * right.sin() - y).atan2(self.d + self.c * right.cos() - x);
        vec![theta, x, y, coupler, right]
    }
}

/// The limits at which the motion to these instants ends, with the configurations there: by sweeps with the plan and without
/// it, and by `planned`.
fn limits(
    bar: &Sum,
    start: &[f64],
    times: &[f64],
    mut planned: Planned<'_, Sum>,
) -> Vec<(&'static str, Limit, Vec<f64>)> {
    let mut found = Vec::new();
    for (way, use_plan) in [("sweep", true), ("full Newton", false)] {
        let solver = bar.solver().with_options(Options { use_plan, ..Options::default() });
        if let Err(error) = solver.sweep_from(start, times) {
            let limit = error.source.limit().unwrap_or_else(|| panic!("{way}: {error}"));
            found.push((way, *limit, error.q_at_limit().unwrap_or_else(|| panic!("{way}: {error}")).to_vec()));
        }
    }
    if let Some(error) = times.iter().find_map(|&t| planned.at(&Instant::at(t)).err()) {
        if let PlanError::Singular { .. } = error {
            return found; // It has come to cranks that are parallel.
        }
        let limit = error.limit().unwrap_or_else(|| panic!("Planned: {error}"));
        found.push(("Planned", *limit, planned.q_at_limit().unwrap_or_else(|| panic!("Planned: {error}")).to_vec()));
    }
    found
}

#[test]
fn folds_of_nearly_parallelograms_are_met_with_their_kind() {
    let mut random = Random::new(17);
    let (mut folds, mut sharp) = (0, 0);
    for round in 0..700 {
        let near = 10.0_f64.powf(random.between(-4.0, -1.0));
        let d = random.between(1.2, 2.0);
        let (b, c) = (d * (1.0 + near * random.between(-1.0, 1.0)), 1.0 + near * random.between(-1.0, 1.0));
        let mut bar = Sum { b, c, d, s: 0.0, v: random.between(-0.5, 0.5) };
        // A sum at which the loop closes at some angle of the left crank.
        let theta = random.between(-3.0, 3.0);
        let closes = |s: f64| bar.loop_of(theta, s)[0];
        let sums: Vec<f64> = (0..=60).map(|k| theta - 3.1 + 0.1 * f64::from(k)).collect();
        let Some(pair) = sums.windows(2).find(|pair| closes(pair[0]) * closes(pair[1]) < 0.0) else { continue };
        let (mut low, mut high) = (pair[0], pair[1]);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if closes(low) * closes(middle) > 0.0 { low = middle } else { high = middle }
        }
        bar.s = low;
        // Where the cranks of a parallelogram are parallel, the angle of the coupler determines nothing: the plan has no
        // solution, and full Newton follows the motion.
        let start = bar.start(theta);
        let Ok(planned) = Planned::new(&bar, &Instant::at(0.0), &start) else { continue };
        let times: Vec<f64> = (0..=random.between(5.0, 60.0) as u32).map(|k| 0.3 * f64::from(k)).collect();
        for (way, limit, q) in limits(&bar, &start, &times, planned) {
            let at = limit.at().unwrap_or_else(|| panic!("{round}, {way}: {limit}"));
            let [theta, u] = bar.fold(q[0], bar.s + bar.v * at).unwrap_or_else(|| panic!("{round}, {way}: {limit}"));
            let curvature = bar.loop_of(theta, u)[3].abs();
            let error = (bar.s + bar.v * at - u).abs();
            assert!(error < 1e-10, "{round}, {way}, near {near:e}: off by {error:e}, curvature {curvature:e}: {limit}");
            assert_eq!(Some(LimitKind::DeadCentre), limit.kind(), "{round}, {way}, near {near:e}: {limit}");
            assert!((q[0] - theta).abs() < 1e-6, "{round}, {way}, near {near:e}: {} for {theta}", q[0]);
            folds += 1;
            sharp += u32::from(near < 1e-3);
        }
    }
    assert!(folds > 500 && sharp > 100, "{folds} folds, {sharp} of them with another solution near");
}

/// A platform on three rods. At the limit its angle is 0, and the rods point to its middle.
#[mechanism]
#[bodies(platform)]
#[distance(a: ground @ (x + 1, y), platform @ (0.5, 0), length = 0.5 + 0.3 * t)]
#[distance(b: ground @ (x - 0.5, y + h), platform @ (-0.25, 0.5 * h), length = 0.5 + 0.3 * t)]
#[distance(c: ground @ (x - 0.5, y - h), platform @ (-0.25, -0.5 * h), length = 0.5 + 0.3 * t)]
#[guess(platform.phi = 0.8, platform.x = x, platform.y = y)]
struct Tripod {
    h: f64,
    x: f64,
    y: f64,
}

/// A fold is found wherever the origin is, and however near to it the last step ends. By hand: from rod a
/// the middle is at −0.3 t, and from rod b (0.25 − 0.3 t)² + h²/4 = (0.5 + 0.3 t)².
#[test]
fn folds_are_found_at_the_origin_and_close_to_a_step() {
    for (x, y) in [(0.0, 0.0), (1e-6, 0.0), (0.01, 0.0), (3.0, 2.0), (1e3, 1e3)] {
        for h in [0.75_f64.sqrt(), 0.87, 0.9] {
            let limit = (0.25 * h * h - 0.1875) / 0.45;
            for steps in [3, 7, 11, 39] {
                let times: Vec<f64> = (0..=steps).map(|k| 1.0 - 2.0 * f64::from(k) / f64::from(steps)).collect();
                let error = Tripod { h, x, y }.kinematic_analysis(&times).expect_err("the rods are too short");
                let found = error.source.limit().and_then(|limit| limit.located).unwrap_or_else(|| panic!("{error}"));
                assert_eq!(Some(LimitKind::DeadCentre), found.kind, "{x} {h} {steps}: {error}");
                assert!((found.at - limit).abs() < 1e-12, "{x} {h} {steps}: {found:?}");
                let q = error.q_at_limit().expect("a configuration");
                let expected = [x - 0.3 * limit, y, 0.0];
                let off = q.iter().zip(expected).fold(0.0, |most: f64, (q, e)| most.max((q - e).abs()));
                assert!(off < 1e-9, "{x} {h} {steps}: {q:?}");
            }
        }
    }
}
