//! Drivers that pass a dead centre, or stop short of it, by 1e-12 to 1e-8 of the length: two folds close to one another, or
//! a near crossing of the branches. The limit that is told must be the right one on every grid.

use kin_runtime::{Instant, Kinematics, Limit, LimitKind, Options, Planned, mechanism};
use std::f64::consts::FRAC_PI_2;

/// A slider that nearly stretches a crank and a bar, at t = π/2.
#[mechanism]
#[bodies(crank, bar)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), bar @ (0, 0))]
#[revolute(B: bar @ (l, 0), slider @ (0, 0))]
#[driver(pull: slider.x = base + 0.05 * sin(t))]
#[guess(crank.phi = 0.5, bar.phi = -0.5)]
struct Stretched {
    r: f64,
    l: f64,
    base: f64,
}

impl Stretched {
    /// The driver passes the stretched position by the part `beyond` of the length.
    fn new(r: f64, beyond: f64) -> Self {
        Self { r, l: 1.0 - r, base: 1.0 + beyond - 0.05 }
    }

    /// How long before π/2 the mechanism is stretched.
    fn before(&self) -> f64 {
        (2.0 * (1.0 - (self.r + self.l - self.base) / 0.05)).sqrt()
    }

    /// The closed form, with the elbow up.
    fn start(&self, t: f64) -> Vec<f64> {
        let d = self.base + 0.05 * t.sin();
        let a = ((d * d + self.r * self.r - self.l * self.l) / (2.0 * d * self.r)).acos();
        let (x, y) = (self.r * a.cos(), self.r * a.sin());
        vec![0.0, 0.0, a, x, y, (-y).atan2(d - x), d]
    }
}

/// The instants from 0 to 3 in n steps, or back.
fn times(n: u32, is_back: bool) -> Vec<f64> {
    let forth = (0..=n).map(|k| 3.0 * f64::from(k) / f64::from(n));
    if is_back { forth.map(|t| 3.0 - t).collect() } else { forth.collect() }
}

/// The limit at which a motion through these instants ends: by sweeps with the plan and without it, and by the plan alone.
fn limits(mechanism: &Stretched, times: &[f64], says: &str) -> [Option<Limit>; 3] {
    let start = mechanism.start(times[0]);
    let [swept, newton] = [true, false].map(|use_plan| {
        let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
        let error = solver.sweep_from(&start, times).err()?;
        let limit = error.source.limit().copied();
        Some(limit.unwrap_or_else(|| panic!("{says}, plan {use_plan}: {error}")))
    });
    let mut planned = Planned::new(mechanism, &Instant::at(times[0]), &start).expect(says);
    let refused = times.iter().find_map(|&t| planned.at(&Instant::at(t)).err());
    let limit = refused.map(|error| *error.limit().unwrap_or_else(|| panic!("{says}: {error}")));
    [swept, newton, limit]
}

#[test]
fn the_first_of_two_close_dead_centres_is_told_on_every_grid() {
    for beyond in [2e-12, 1e-11, 1e-10, 1e-9, 1e-8] {
        for r in [0.3, 0.5, 0.6] {
            let mechanism = Stretched::new(r, beyond);
            for n in [7, 100, 157, 1000, 5000] {
                for is_back in [false, true] {
                    let fold = if is_back { FRAC_PI_2 + mechanism.before() } else { FRAC_PI_2 - mechanism.before() };
                    let says = format!("{beyond} {r} {n} {is_back}");
                    for limit in limits(&mechanism, &times(n, is_back), &says) {
                        let limit = limit.unwrap_or_else(|| panic!("{says}: passed the dead centre"));
                        let at = limit.at().unwrap_or_else(|| panic!("{says}: {limit}"));
                        // The place is √(2 beyond/0.05) from π/2, so that it is known to ε over that.
                        let known = 4.0 * f64::EPSILON / (0.05 * mechanism.before());
                        assert!((at - fold).abs() < 1e-9_f64.max(known), "{says}: {limit:?}, not {fold}");
                        assert_eq!(Some(LimitKind::DeadCentre), limit.kind(), "{says}");
                    }
                }
            }
        }
    }
}

/// Where the branches nearly cross, an instant beside the crossing has no accurate rates, and the motion ends there; what
/// is told is the place at which the branches are nearest to one another.
#[test]
fn a_near_crossing_is_told_where_it_is() {
    for short in [1e-11, 1e-10, 1e-9, 1e-8] {
        for r in [0.342, 0.5, 0.639] {
            let mechanism = Stretched::new(r, -short);
            for n in [1, 10, 100, 300, 1000, 3000] {
                let says = format!("{short} {r} {n}");
                let [swept, newton, planned] = limits(&mechanism, &times(n, false), &says);
                assert_eq!(swept.is_some(), planned.is_some(), "{says}");
                if n <= 100 || short >= 1e-8 {
                    assert!([swept, newton, planned].iter().all(Option::is_none), "{says}: {swept:?} {newton:?}");
                }
                for limit in [swept, newton, planned].into_iter().flatten() {
                    let at = limit.at().unwrap_or_else(|| panic!("{says}: {limit}"));
                    assert!((at - FRAC_PI_2).abs() < 2e-6, "{says}: {limit:?}");
                }
            }
        }
    }
}

/// Two equal links whose outer pins meet at the instant `meets`.
#[mechanism]
#[bodies(left, right)]
#[body(slider, y = 0, phi = 0)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(C: slider @ (0, 0), right @ (0, 0))]
#[revolute(K: left @ (l, 0), right @ (l, 0))]
#[driver(push: slider.x = 0.7 * (t - meets))]
struct Meeting {
    l: f64,
    meets: f64,
}

#[test]
fn pins_that_meet_at_an_instant_of_the_grid_are_told_to_meet_there() {
    for meets in [0.0, 1.0, 0.731_058_5] {
        for (before, n) in [(0.01, 1_u32), (0.3, 2), (0.9, 30)] {
            let mechanism = Meeting { l: 0.6, meets };
            let times: Vec<f64> = (0..=n).map(|k| meets - before * f64::from(n - k) / f64::from(n)).collect();
            let x = 0.7 * (times[0] - meets);
            let angle = (x / 1.2).acos();
            let start = [0.0, 0.0, angle, x, 0.0, std::f64::consts::PI - angle, x];
            let error = mechanism.solver().sweep_from(&start, &times).expect_err("pins that meet").source;
            let swept = error.limit().and_then(Limit::at);
            let mut planned = Planned::new(&mechanism, &Instant::at(times[0]), &start).expect("apart");
            let error = times.iter().find_map(|&t| planned.at(&Instant::at(t)).err()).expect("pins that meet");
            for at in [swept, error.limit().and_then(Limit::at)] {
                assert!(at.is_some_and(|at| (at - meets).abs() < 1e-12), "{meets} {before} {n}: {at:?} {error}");
            }
        }
    }
}

/// A table on two parallel rods, which slides without turning.
#[mechanism]
#[bodies(table)]
#[distance(p: ground @ (0, 0), table @ (0, 0), length = l)]
#[distance(q: ground @ (b, 0), table @ (b, 0), length = l)]
#[driver(pull: table.x = x0 + (l * (1 - gap) - x0) * sin(t))]
struct Table {
    b: f64,
    l: f64,
    x0: f64,
    gap: f64,
}

#[test]
fn rounding_errors_of_a_table_that_does_not_turn_end_no_motion() {
    for k in 0..60 {
        let (l, b) = (0.5 + 0.017 * f64::from(k), 0.2 + 0.006 * f64::from(k));
        for gap in [4e-3, 1e-3, 3e-4] {
            let x0 = 0.1 * l;
            let mechanism = Table { b, l, x0, gap };
            let start = [x0, (l * l - x0 * x0).sqrt(), 0.0];
            let mut planned = Planned::new(&mechanism, &Instant::at(0.0), &start).expect("regular");
            for n in 1..=200 {
                let t = 0.015 * f64::from(n);
                let x = x0 + (l * (1.0 - gap) - x0) * t.sin();
                let state = planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{l} {b} {gap}: {error}"));
                let y = (l * l - x * x).sqrt();
                assert!((state.q()[1] - y).abs() < 1e-9 && state.q()[2].abs() < 1e-9, "{l} {b} {gap} {t}");
            }
        }
    }
}

/// A slider that passes the stretched position flatly: as the fourth power of time.
#[mechanism]
#[bodies(crank, bar)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), bar @ (0, 0))]
#[revolute(B: bar @ (l, 0), slider @ (0, 0))]
#[driver(pull: slider.x = top - c * pow(t - 1, 4))]
#[guess(crank.phi = 0.5, bar.phi = -0.5)]
struct Flat {
    r: f64,
    l: f64,
    top: f64,
    c: f64,
}

/// On coarse grids one step may lead across the gap in which the mechanism does not close.
#[test]
fn no_step_leads_across_a_dead_centre_and_back() {
    for (r, l, c) in [(0.25, 0.75, 0.295), (0.5, 0.8, 0.256), (0.2, 0.9, 0.128)] {
        for beyond in [1e-14, 1e-12, 1e-10, 1e-8, 1e-6] {
            for n in [1_u32, 2, 3, 4, 6, 7, 11, 20] {
                let mechanism = Flat { r, l, top: (r + l) * (1.0 + beyond), c };
                let x = mechanism.top - c;
                let angle = ((x * x + r * r - l * l) / (2.0 * x * r)).acos();
                let (ax, ay) = (r * angle.cos(), r * angle.sin());
                let start = [0.0, 0.0, angle, ax, ay, (-ay).atan2(x - ax), x];
                let times: Vec<f64> = (0..=n).map(|k| 2.1 * f64::from(k) / f64::from(n)).collect();
                for use_plan in [true, false] {
                    let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
                    let swept = solver.sweep_from(&start, &times);
                    assert!(swept.is_err(), "{r} {beyond} {n} {use_plan}");
                }
            }
        }
    }
}
