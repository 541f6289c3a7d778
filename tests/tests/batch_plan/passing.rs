//! Limits of the rows that the plan uses, which a redundant mechanism passes because its other rows have no limit
//! there.

use kin_runtime::batch::{Column, Modes, Moment, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, PlanError, Planned, mechanism};
use std::f64::consts::{PI, TAU};

/// A platform on three parallel cranks whose pins are not on one line.
#[mechanism(allow_redundant)]
#[bodies(first, second, third, platform)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (0.8, 0), second @ (0, 0))]
#[revolute(C: ground @ (0.3, 0.4), third @ (0, 0))]
#[revolute(D: first @ (r, 0), platform @ (0, 0))]
#[revolute(E: second @ (r, 0), platform @ (0.8, 0))]
#[revolute(F: third @ (last, 0), platform @ (0.3, 0.4))]
#[driver(drive: first.phi = t)]
#[guess(second.phi = 0.6, third.phi = 0.6)]
#[derive(Clone)]
struct Platform {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    last: f64,
}

/// Two such platforms on top of one another, which lie flat at the same instants.
#[mechanism(allow_redundant)]
#[bodies(first, second, third, platform, upper[3], top)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (0.8, 0), second @ (0, 0))]
#[revolute(C: ground @ (0.3, 0.4), third @ (0, 0))]
#[revolute(D: first @ (r, 0), platform @ (0, 0))]
#[revolute(E: second @ (r, 0), platform @ (0.8, 0))]
#[revolute(F: third @ (last, 0), platform @ (0.3, 0.4))]
#[revolute(G: platform @ (0, 0), upper[0] @ (0, 0))]
#[revolute(H: platform @ (0.8, 0), upper[1] @ (0, 0))]
#[revolute(I: platform @ (0.2, 0.5), upper[2] @ (0, 0))]
#[revolute(J: upper[0] @ (0.5, 0), top @ (0, 0))]
#[revolute(K: upper[1] @ (0.5, 0), top @ (0.8, 0))]
#[revolute(L: upper[2] @ (0.5, 0), top @ (0.2, 0.5))]
#[driver(drive: first.phi = t)]
#[driver(follow: upper[0].phi = t)]
#[guess(second.phi = 0.6, third.phi = 0.6, upper[1].phi = 0.6, upper[2].phi = 0.6)]
#[derive(Clone)]
struct Tower {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    last: f64,
}

/// A parallelogram with a rod between its cranks, beside their lines; a separate dyad is attached to its coupler.
#[mechanism(allow_redundant)]
#[bodies(left, coupler, right, arm, rocker)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (r, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.8, 0), right @ (last, 0))]
#[revolute(D: ground @ (0.8, 0), right @ (0, 0))]
#[distance(rod: left @ (r/2, 0.15), right @ (r/2, 0.15), length = 0.8)]
#[revolute(E: coupler @ (0.4, 0.1), arm @ (0, 0))]
#[revolute(F: arm @ (0.7, 0), rocker @ (0.5, 0))]
#[revolute(G: rocker @ (0, 0), ground @ (1.1, 0.4))]
#[driver(drive: left.phi = t)]
#[guess(right.phi = 0.6, coupler.phi = 0, arm.phi = -0.6, rocker.phi = 1.2)]
#[derive(Clone)]
struct Locomotive {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    last: f64,
}

/// The same mechanism with a dyad that is nearly stretched when the cranks lie flat, so that its prediction is on the
/// other branch: the redundant rows of the parallelogram do not depend on the dyad.
#[mechanism(allow_redundant)]
#[bodies(left, coupler, right, arm, rocker)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (r, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.8, 0), right @ (last, 0))]
#[revolute(D: ground @ (0.8, 0), right @ (0, 0))]
#[distance(rod: left @ (r/2, 0.15), right @ (r/2, 0.15), length = 0.8)]
#[revolute(E: coupler @ (0.4, 0.1), arm @ (0, 0))]
#[revolute(F: arm @ (r + 0.3, 0), rocker @ (r + 0.2001, 0))]
#[revolute(G: rocker @ (0, 0), ground @ (r + 0.9, 0.1))]
#[driver(drive: left.phi = t)]
#[guess(right.phi = 0.6, coupler.phi = 0, arm.phi = -0.6, rocker.phi = 1.2)]
#[derive(Clone)]
struct Stretched {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    last: f64,
}

/// Compares more than two turns in steps of `step`, by the plan and in a batch, with a sweep that checks every state
/// with Φ; the angles `turned` are equal to that of the crank.
fn passes<M: Kinematics + Clone + Sync>(mechanism: &M, turned: &[usize], step: f64) {
    let name = M::model().name;
    let count = (2.2 * TAU / step.abs()) as i32;
    let times: Vec<f64> = (0..=count).map(|k| 0.6 + step * f64::from(k)).collect();
    let reference = mechanism.solver().sweep(&times).unwrap();
    let first = reference.iter().next().unwrap().q.clone();
    let mut planned = Planned::new(mechanism, &Instant::at(times[0]), &first).unwrap();
    let mut flips = 0_u8;
    for state in reference.iter().skip(1) {
        let before: Vec<_> = planned.modes().collect();
        let found = planned.at(&Instant::at(state.t));
        let found = found.unwrap_or_else(|error| panic!("{name}, steps of {step}: {error}"));
        let margin = found.margins().iter().fold(1.0_f64, |least, margin| least.min(*margin));
        flips += u8::from(!before.into_iter().eq(found.modes()));
        for (q, expected) in found.q().iter().zip(&state.q) {
            assert!((q - expected).abs() < 1e-11 / margin, "{name} at t = {}: {q} for {expected}", state.t);
        }
        for &k in turned {
            assert!((found.q()[k] - state.t).abs() < 1e-11 / margin, "{name} at t = {}: {}", state.t, found.q()[k]);
        }
    }
    // The cranks lie along the line through their pins twice per turn.
    let halves = |t: f64| (t / PI).floor();
    assert_eq!(f64::from(flips), (halves(times[times.len() - 1]) - halves(0.6)).abs(), "{name}, steps of {step}");
    // Neighbouring sets, one of which contradicts the redundant rows before and after the first limit.
    let sizes = [0.3, 0.2, 0.25, 0.3, 0.31];
    let lasts = [0.3, 0.2, 0.25, 0.3 + 1e-6, 0.31];
    let start: Vec<Column<'_>> = first.iter().map(|q| Column::Shared(*q)).collect();
    let parameters = [Column::Each(&sizes), Column::Each(&lasts)];
    let sweeps = Sweeps { parameters: &parameters, times: &times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(sizes.len(), [Lanes::default(); 2]);
    let see = |turns: &mut [Lanes; 2], moment: &Moment<'_>| {
        let of = |k: usize| moment.keep(turns[k], moment.q[turned[k % turned.len()]]);
        *turns = [of(0), of(1)];
    };
    sweep(mechanism, &sweeps, &mut out, &always, see).unwrap();
    for (set, end) in out.ends().enumerate() {
        assert_eq!(end.map(|end| end.instant), (set == 3).then_some(0), "{name}, steps of {step}: {end:?}");
    }
    for k in 0..2 {
        for (set, angle) in out.scores(|turns| turns[k]).enumerate().filter(|(set, _)| *set != 3) {
            assert!((angle - times[times.len() - 1]).abs() < 1e-8, "{name} {set}: {angle}");
        }
    }
}

#[test]
fn closures_go_on_behind_limits_that_only_the_kept_rows_have() {
    for step in [0.05, 0.11, -0.07, 0.3] {
        passes(&Platform::default(), &[5, 8], step);
        passes(&Tower::default(), &[5, 8, 17, 20], step);
        passes(&Locomotive::default(), &[8], step);
        passes(&Stretched::default(), &[8], step);
    }
}

#[test]
fn flat_itself_is_a_limit_and_the_next_instant_goes_on() {
    let platform = Platform::default();
    let mut planned = platform.solver().planned(&Instant::at(0.6)).unwrap();
    planned.at(&Instant::at(1.8)).unwrap();
    planned.at(&Instant::at(3.0)).unwrap();
    for (flat, behind) in [(PI, 3.3), (TAU, 6.4), (3.0 * PI, 9.6)] {
        let before = planned.q().to_vec();
        match planned.at(&Instant::at(flat)) {
            Err(PlanError::Limit { limit, .. }) => {
                assert!(limit.step.closes() && limit.margin.abs() < 1e-12, "{limit}")
            }
            other => panic!("{other:?}"),
        }
        assert_eq!(before, planned.q());
        let found = planned.at(&Instant::at(behind)).unwrap();
        for k in [5, 8] {
            assert!((found.q()[k] - behind).abs() < 1e-11, "{behind}: {}", found.q()[k]);
        }
        planned.at(&Instant::at(behind + 1.4)).unwrap();
        planned.at(&Instant::at(behind + 2.8)).unwrap();
    }
}

#[test]
fn a_mode_that_is_asked_for_stays_what_it_is() {
    let platform = Platform::default();
    let mut planned = platform.solver().planned(&Instant::at(0.6)).unwrap();
    planned.at(&Instant::at(1.8)).unwrap();
    planned.at(&Instant::at(3.1)).unwrap();
    planned.flip(0).unwrap();
    assert!(matches!(planned.at(&Instant::at(3.11)), Err(PlanError::Contradiction { .. })));
    planned.flip(0).unwrap();
    planned.at(&Instant::at(3.11)).unwrap();
}

#[test]
fn asking_for_one_closure_does_not_hold_the_others() {
    let locomotive = Locomotive::default();
    let mut planned = locomotive.solver().planned(&Instant::at(0.6)).unwrap();
    planned.at(&Instant::at(1.8)).unwrap();
    planned.at(&Instant::at(3.0)).unwrap();
    let dyad = Locomotive::model().plan.modes.iter().position(|mode| mode.name == "E-F-G").unwrap();
    let sign = |planned: &Planned<'_, Locomotive>| planned.modes().nth(dyad).unwrap();
    let before = sign(&planned);
    planned.flip(dyad).unwrap();
    // The cranks pass their line at π; the dyad continues on its other branch.
    assert!((planned.at(&Instant::at(3.3)).unwrap().q()[8] - 3.3).abs() < 1e-11);
    assert_ne!(before, sign(&planned));
    // Requesting the current mode changes nothing.
    let other = (0..Locomotive::model().plan.modes.len()).find(|mode| *mode != dyad).unwrap();
    planned.at(&Instant::at(6.2)).unwrap();
    let present = planned.modes().nth(other).unwrap();
    planned.set_mode(other, present).unwrap();
    assert!((planned.at(&Instant::at(6.4)).unwrap().q()[8] - 6.4).abs() < 1e-11);
}
