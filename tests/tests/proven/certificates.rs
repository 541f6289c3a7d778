//! Certificates are proofs: isolated solutions have correct ones; points that are no solution, or no isolated one, have
//! none.

use kin_runtime::{Certificate, Instant, Kinematics, Solver, State, Uncertified, mechanism};

/// Two circles of radius 1 whose centres are 2 − `gap` apart: they meet in two points, touch, or miss one another.
#[mechanism]
#[coordinates(x, y)]
#[constraint(left: x*x + y*y = 1)]
#[constraint(right: (x - 2 + gap)*(x - 2 + gap) + y*y = 1)]
#[guess(x = 1, y = 1)]
#[derive(Clone, Copy)]
struct Circles {
    #[param(0.5)]
    gap: f64,
}

impl Circles {
    /// The upper intersection, up to rounding: x = 1 − gap/2, y² = 1 − x² = gap − gap²/4.
    fn upper(self) -> Option<[f64; 2]> {
        (self.gap > 0.0).then(|| [1.0 - 0.5 * self.gap, (self.gap * (1.0 - 0.25 * self.gap)).sqrt()])
    }

    fn certify(self, q: [f64; 2]) -> Result<Certificate, Uncertified> {
        Solver::new(&self).certify(&state::<Self>(q.to_vec()))
    }
}

/// A state at rest.
fn state<M: Kinematics>(q: Vec<f64>) -> State {
    let rest = vec![0.0; q.len()];
    State {
        model: M::model(),
        t: 0.0,
        inputs: Vec::new(),
        q_dot: rest.clone(),
        q_ddot: rest,
        q,
        bodies: Vec::new(),
        points: Vec::new(),
        residual: 0.0,
        iterations: 0,
        condition: None,
        degrees_of_freedom_left: 0,
    }
}

/// A generator of deterministic numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// ±10ⁿ with n between −17 and −1.
    fn small(&mut self) -> f64 {
        let size = 10_f64.powf(-17.0 + 16.0 * self.unit());
        if self.unit() < 0.5 { -size } else { size }
    }
}

/// Wrong, nearly right and double solutions: a certificate is issued only if its box contains one intersection and not
/// the other.
#[test]
fn there_is_never_one_certificate_too_many() {
    let tries = if cfg!(debug_assertions) { 20_000 } else { 1_000_000 };
    let (mut draw, mut given, mut refused) = (Draw(20), 0, 0);
    for k in 0..tries {
        let gap = match k % 8 {
            0 => 0.0,
            1 => -draw.small().abs(),
            2 => 2.0 * draw.unit(),
            _ => draw.small().abs(),
        };
        // The gap as the rows evaluate it: 2 − gap is rounded.
        let gap = 2.0 - (2.0 - gap);
        let circles = Circles { gap };
        let [x, y] = circles.upper().unwrap_or([1.0, 0.0]);
        let off = if k % 3 == 0 { [0.0; 2] } else { [draw.small(), draw.small()] };
        let Ok(certificate) = circles.certify([x + off[0], y + off[1]]) else {
            refused += 1;
            continue;
        };
        given += 1;
        let exact = circles.upper();
        assert!(exact.is_some(), "gap {gap:e}: a certificate without a solution");
        let holds = |interval: kin_runtime::scalar::Interval, value: f64| {
            interval.lower() <= value + 4e-16 * value.abs() && value - 4e-16 * value.abs() <= interval.upper()
        };
        let near = |sign: f64| {
            let box_ = &certificate.q;
            holds(box_[0], x) && holds(box_[1], sign * y)
        };
        // The certified point is one of the two intersections, and the box that is proven to contain it does not
        // contain the other.
        assert!(near(1.0) || near(-1.0), "gap {gap:e}, off {off:?}: {:?}", certificate.q);
        assert!(!(certificate.covers(&[x, y]) && certificate.covers(&[x, -y])), "gap {gap:e}: two solutions");
    }
    assert!(given > tries / 4 && refused > tries / 4, "{given} {refused}");
}

/// The four-bar of the lecture.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (d1, 0))]
#[driver(drive: crank.phi = omega * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
struct FourBar {
    #[param(0.1)]
    l1: f64,
    #[param(0.35)]
    l2: f64,
    #[param(0.3)]
    l3: f64,
    #[param(0.4)]
    d1: f64,
    #[param(2)]
    omega: f64,
}

/// The angles of coupler and rocker by the law of cosines, with rates by finite differences: a solution that is
/// independent of kin.
fn diagonal(bar: &FourBar, t: f64) -> [f64; 2] {
    let (x, y) = (bar.d1 - bar.l1 * (bar.omega * t).cos(), -bar.l1 * (bar.omega * t).sin());
    let square = x * x + y * y;
    let cosine = (bar.l2 * bar.l2 + square - bar.l3 * bar.l3) / (2.0 * bar.l2 * square.sqrt());
    let coupler = y.atan2(x) + cosine.acos();
    let (bx, by) = (bar.l2 * coupler.cos(), bar.l2 * coupler.sin());
    [coupler, (y - by).atan2(x - bx) + std::f64::consts::TAU]
}

#[test]
fn certificates_hold_position_velocity_and_acceleration() {
    let bar = FourBar::default();
    let solver = bar.solver();
    for k in 0..200 {
        let t = 0.05 * f64::from(k);
        let state = solver.state(&Instant::at(t)).unwrap();
        let certificate = solver.certify(&state).unwrap();
        assert!(certificate.radius() < 1e-13, "{certificate}");
        assert!(certificate.isolation() > 1e-8 && certificate.covers(&state.q), "{certificate}");
        let turned = |angle: f64| (angle / std::f64::consts::TAU).rem_euclid(1.0);
        let at = |t: f64| diagonal(&bar, t);
        let (h, step) = (1e-4, 1e-4 * 1e-4);
        for (place, angle) in [(5, 0), (8, 1)] {
            let near = turned(certificate.q[place].midpoint()) - turned(at(t)[angle]);
            assert!(near.abs().min(1.0 - near.abs()) < 1e-13, "{near}");
            let wound = |t: f64| {
                let d = at(t)[angle] - at(0.0)[angle];
                d - (d / std::f64::consts::TAU).round() * std::f64::consts::TAU
            };
            let [before, here, after] = [wound(t - h), wound(t), wound(t + h)];
            let rate = certificate.q_dot[place];
            assert!((rate.midpoint() - (after - before) / (2.0 * h)).abs() < 1e-6 && rate.radius() < 1e-12, "{rate}");
            let acceleration = certificate.q_ddot[place];
            assert!((acceleration.midpoint() - (after - 2.0 * here + before) / step).abs() < 1e-5);
            assert!(acceleration.radius() < 1e-11, "{acceleration}");
        }
        // The intervals contain the solver's numbers up to a few roundings.
        for (list, intervals) in
            [(&state.q, &certificate.q), (&state.q_dot, &certificate.q_dot), (&state.q_ddot, &certificate.q_ddot)]
        {
            for (x, interval) in list.iter().zip(intervals) {
                assert!((x - interval.midpoint()).abs() < 1e-12 * (1.0 + x.abs()), "{x} {interval}");
            }
        }
    }
}

#[test]
fn what_cannot_be_certified_says_why() {
    let bar = FourBar::default();
    let solver = bar.solver();
    let state = solver.state(&Instant::at(0.3)).unwrap();
    let mut off = state.clone();
    off.q[8] += 1e-3;
    let error = solver.certify(&off).unwrap_err();
    assert!(matches!(error, Uncertified::NotASolution { what: "q", .. }), "{error}");
    let mut off = state.clone();
    off.q_dot[5] += 1e-3;
    let error = solver.certify(&off).unwrap_err();
    assert!(
        matches!(error, Uncertified::NotASolution { what: "q̇", coordinate: "coupler.phi", by } if (by - 1e-3).abs() < 1e-9),
        "{error}"
    );
    let mut off = state.clone();
    off.q_ddot[5] += 1e-3;
    assert!(matches!(solver.certify(&off), Err(Uncertified::NotASolution { what: "q̈", .. })));
    let mut off = state.clone();
    off.q.pop();
    assert_eq!(solver.certify(&off), Err(Uncertified::Malformed));

    // Coupler and rocker are collinear: a double solution.
    let folded = FourBar { l1: 0.25, l2: 0.2, l3: 0.05, d1: 0.4, ..FourBar::default() };
    let q = vec![0.125, 0.0, 0.0, 0.35, 0.0, 0.0, 0.425, 0.0, std::f64::consts::PI];
    let error = folded.solver().certify(&self::state::<FourBar>(q)).unwrap_err();
    assert!(matches!(error, Uncertified::Singular { nearness } if nearness < 1e-10), "{error}");
}

/// A parallelogram whose third link is redundant.
#[mechanism(allow_redundant)]
#[bodies(crank, coupler, rocker, third)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (1, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (2, 0), rocker @ (1, 0))]
#[revolute(D: ground @ (2, 0), rocker @ (0, 0))]
#[revolute(E: coupler @ (1, 0), third @ (1, 0))]
#[revolute(F: ground @ (1, 0), third @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[guess(coupler.phi = 0, rocker.phi = 1, third.phi = 1)]
struct Parallel;

#[test]
fn redundant_rows_are_left_out_and_named() {
    let solver = Parallel.solver();
    let state = solver.state(&Instant::at(1.0)).unwrap();
    let certificate = solver.certify(&state).unwrap();
    assert_eq!(certificate.left_out.len(), 1, "{certificate}");
    assert!(certificate.radius() < 1e-14, "{certificate}");
    assert!(certificate.to_string().contains("redundant and left out: "), "{certificate}");
}

/// Two arms in series, the second one undriven.
#[mechanism]
#[bodies(first, second)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: first @ (1, 0), second @ (0, 0))]
#[driver(drive: first.phi = t)]
struct Open;

#[test]
fn open_degrees_of_freedom_have_no_certificate_until_they_are_given() {
    let solver = Open.solver();
    let state = solver.state(&Instant::at(0.5)).unwrap();
    assert_eq!(solver.certify(&state), Err(Uncertified::Open { degrees_of_freedom: 1 }));
    let solver = solver.with_given(5, kin_runtime::Signal::new(0.3, 1.0, 0.5));
    let state = solver.state(&Instant::at(0.5)).unwrap();
    let certificate = solver.certify(&state).unwrap();
    assert!(
        certificate.q[5].contains(0.3) && certificate.q_dot[5].contains(1.0) && certificate.q_ddot[5].contains(0.5)
    );
}

/// At a large angle the rounding of the angle is the reason, far from every singular configuration.
#[test]
fn rounding_is_not_called_singular() {
    let turns = FourBar { omega: 1.0, ..FourBar::default() };
    let solver = turns.solver();
    let at = |t: f64| solver.certify(&solver.state(&Instant::at(t)).expect("it closes"));
    assert!(at(1.0).is_ok());
    let said = at(1e9).expect_err("an angle of 10⁹ radians is rounded by 10⁻⁷").to_string();
    assert!(said.starts_with("rounding errors, as those of large angles, are too large"), "{said}");
}

/// A platform on three cylinders of equal lengths, with its centre at the origin.
#[mechanism]
#[bodies(platform)]
#[driver(first: distance(ground @ (0, 1), platform @ (0, 0.4)) = sqrt(1.16 - 0.8*cos(0.5 + t)))]
#[driver(second: distance(ground @ (-h, -0.5), platform @ (-0.4*h, -0.2)) = sqrt(1.16 - 0.8*cos(0.5 + t)))]
#[driver(third: distance(ground @ (h, -0.5), platform @ (0.4*h, -0.2)) = sqrt(1.16 - 0.8*cos(0.5 + t)))]
#[guess(platform.phi = 0.5)]
#[define(h = 0.5*sqrt(3))]
struct Platform;

/// The coordinates of a body at the origin tell nothing about the size of the mechanism.
#[test]
fn a_body_at_the_origin_is_not_called_singular() {
    let solver = Platform.solver();
    for offset in [0.0, 1e-300, 1e-17, -3e-16] {
        let mut state = solver.state(&Instant::at(0.0)).unwrap();
        state.q.copy_from_slice(&[offset, -offset, 0.5]);
        let certificate = solver.certify(&state).unwrap_or_else(|none| panic!("{offset}: {none}"));
        assert!(certificate.radius() < 1e-14 && certificate.isolation() > 1e-9, "{offset}: {certificate}");
        assert!(certificate.covers(&[0.0, 0.0, 0.5]), "{offset}: {certificate}");
    }
}
