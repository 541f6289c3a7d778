//! Mechanisms with redundant rows, solved by their plans: closed forms, and an error where the rows contradict one
//! another.

use kin_runtime::plan::{Plan, StepKind};
use kin_runtime::series::HigherOrders;
use kin_runtime::{Instant, Kinematics, Options, PlanError, Planned, SolveError, Trajectory, cli, mechanism};
use kin_tests::mechanisms::RedundantParallelogram;

/// A platform on three parallel cranks whose fixed pins are not collinear.
#[mechanism(allow_redundant)]
#[bodies(first, second, third, platform)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (b, 0), second @ (0, 0))]
#[revolute(C: ground @ (c, h), third @ (-r/2, 0))]
#[revolute(D: first @ (r, 0), platform @ (0, 0))]
#[revolute(E: second @ (r, 0), platform @ (b, 0))]
#[revolute(F: third @ (last - r/2, 0), platform @ (c, h))]
#[driver(drive: first.phi = start + 1.4 * t)]
#[guess(second.phi = start, third.phi = start)]
struct Platform {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    last: f64,
    #[param(0.8)]
    b: f64,
    #[param(0.3)]
    c: f64,
    #[param(0.4)]
    h: f64,
    #[param(0.6)]
    start: f64,
}

/// A slider-crank whose slider has two guides.
#[mechanism(allow_redundant)]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(lower: ground @ (0, 0.05), slider @ (0, 0), axis = (1, 0))]
#[translational(upper: ground @ (0, 0.05 + gap), slider @ (0, height), axis = (1, 0))]
#[driver(drive: crank.phi = 0.3 + 2 * t)]
#[guess(slider.x = 0.8)]
struct TwoGuides {
    #[param(0.1)]
    gap: f64,
    #[param(0.1)]
    height: f64,
}

/// A parallelogram both of whose cranks are driven.
#[mechanism(allow_redundant)]
#[bodies(left, coupler, right)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (0.3, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.8, 0), right @ (0.3, 0))]
#[revolute(D: ground @ (0.8, 0), right @ (0, 0))]
#[driver(one: left.phi = 0.7 + 1.4 * t)]
#[driver(other: right.phi = 0.7 + ahead + faster * t + sooner * pow(t, 2))]
struct TwoDrivers {
    #[param(0)]
    ahead: f64,
    #[param(1.4)]
    faster: f64,
    #[param(0)]
    sooner: f64,
}

/// A platform on two parallel cranks and a third one that is a redundant distance: the platform does not turn.
#[mechanism(allow_redundant)]
#[bodies(crank, platform)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.3, 0), platform @ (0, 0))]
#[distance(link: ground @ (0.8, 0.1), platform @ (0.8, 0.1), length = length)]
#[distance(again: ground @ (0.4, 0.5), platform @ (0.4, 0.5), length = 0.3)]
#[angle(level: platform = 0)]
#[driver(drive: crank.phi = 0.7 + 1.4 * t)]
struct Links {
    #[param(0.3)]
    length: f64,
}

fn times() -> Vec<f64> {
    (0..=40).map(|k| 0.02 * f64::from(k)).collect()
}

fn same(a: &Trajectory, b: &Trajectory) {
    for (a, b) in a.iter().zip(b) {
        for (what, a, b) in [("q", &a.q, &b.q), ("q_dot", &a.q_dot, &b.q_dot), ("q_ddot", &a.q_ddot, &b.q_ddot)] {
            assert!(off(a, b) <= 1e-12, "{what}: {a:?} and {b:?}");
        }
    }
}

/// max |a − b|, relative to the largest |b|, at least to 1.
fn off(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / size
}

/// The plan, which has no iteration, finds the same as Newton's method on all rows; `redundant` are the rows that it
/// only checks.
fn agrees<M: Kinematics + Default>(redundant: &[&str]) {
    let (mechanism, plan) = (M::default(), &M::model().plan);
    let name = M::model().name;
    let found: Vec<&str> = plan.redundant_rows().map(|row| M::model().rows[row].name).collect();
    assert_eq!(found, redundant, "{name}");
    assert!(!plan.steps.iter().any(|step| matches!(step.kind, StepKind::Newton(_))), "{name}: {plan:?}");
    let options = Options { use_plan: false, ..Options::default() };
    let expected = mechanism.solver().with_options(options).sweep(&times()).unwrap();
    let found = mechanism.solver().sweep(&times()).unwrap();
    assert!(found.fallbacks.is_empty(), "{name}: {:?}", found.fallbacks);
    assert!(found.iter().skip(1).all(|state| state.iterations == 1));
    same(&found, &expected);
    let mut planned = Planned::new(&mechanism, &Instant::at(0.0), &expected.iter().next().unwrap().q).unwrap();
    let mut orders = HigherOrders::new(&mechanism, 5);
    for state in &expected {
        let at = Instant::at(state.t);
        planned.at(&at).unwrap();
        assert!(planned.margins().iter().rev().take(redundant.len()).all(|margin| (margin - 1.0).abs() < 1e-6));
        assert!(off(planned.q_ddot(), &state.q_ddot) <= 1e-12, "{name} at t = {}", state.t);
        // Higher orders by the factors of the rows that are kept.
        let all = mechanism.solver().derivatives(state, 5).unwrap().q;
        orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
        assert!(orders.factorise(&at).unwrap());
        for (order, expected) in all.iter().enumerate().skip(3) {
            let mut derivative = vec![f64::NAN; M::COORDINATES];
            orders.solve(&mut derivative).unwrap();
            let off = off(&derivative, expected);
            assert!(off <= 1e-9, "{name}: order {order} at t = {}: {off:e}", state.t);
            orders.advance(&derivative).unwrap();
        }
    }
}

#[test]
fn plans_of_redundant_mechanisms_are_full_newton() {
    agrees::<RedundantParallelogram>(&["C.y"]);
    agrees::<Platform>(&["F.y"]);
    agrees::<TwoGuides>(&["upper.normal", "upper.angle"]);
    agrees::<TwoDrivers>(&["other"]);
    agrees::<Links>(&["again", "level"]);
}

/// The residual that the plan reports for `bad` in the configuration of `good` if the redundant rows contradict; `None`
/// if they do not.
fn contradiction<M: Kinematics>(good: &M, bad: &M, joint: &str) -> Option<f64> {
    let at = Instant::at(0.0);
    let q = good.solver().assemble(&at).unwrap();
    match Planned::new(bad, &at, &q) {
        Ok(_) => None,
        Err(error @ PlanError::Contradiction { limit, .. }) => {
            assert!(limit.step.joints().any(|name| name == joint) && limit.margin < 0.0, "{error}");
            let words = error.to_string();
            assert!(words.contains("redundant row") && words.contains(joint), "{words}");
            limit.contradiction()
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn rows_that_contradict_are_an_error_with_its_size() {
    let seen = |of: &dyn Fn(f64) -> Option<f64>| {
        assert_eq!(of(0.0), None);
        for error in [1e-9, 1e-7, 1e-4] {
            let miss = of(error).unwrap_or_else(|| panic!("{error:e} is not seen"));
            assert!(miss > 0.05 * error && miss < 20.0 * error, "{miss:e} of {error:e}");
        }
    };
    let platform = Platform::default();
    seen(&|e| contradiction(&platform, &Platform { last: 0.3 * (1.0 + e), ..Platform::default() }, "F"));
    let guides = TwoGuides::default();
    seen(&|e| contradiction(&guides, &TwoGuides { gap: 0.1 + e, ..TwoGuides::default() }, "upper"));
    let links = Links::default();
    seen(&|e| contradiction(&links, &Links { length: 0.3 * (1.0 + e) }, "again"));
    // At this instant only q̇ or q̈ is inconsistent.
    let drivers = TwoDrivers::default();
    seen(&|e| contradiction(&drivers, &TwoDrivers { ahead: e, ..TwoDrivers::default() }, "other"));
    seen(&|e| contradiction(&drivers, &TwoDrivers { faster: 1.4 + e, ..TwoDrivers::default() }, "other"));
    seen(&|e| contradiction(&drivers, &TwoDrivers { sooner: e, ..TwoDrivers::default() }, "other"));
}

#[test]
fn no_length_unit_hides_a_contradiction_or_makes_one() {
    for unit in [1e-6, 1.0, 1e3, 1e6] {
        let of = |last: f64| Platform {
            r: 0.3 * unit,
            last: last * unit,
            b: 0.8 * unit,
            c: 0.3 * unit,
            h: 0.4 * unit,
            start: 0.6,
        };
        assert_eq!(contradiction(&of(0.3), &of(0.3), "F"), None);
        let miss = contradiction(&of(0.3), &of(0.3 + 1e-9), "F").unwrap();
        assert!((miss / 4e-9 - 1.0).abs() < 0.5, "{miss:e}");
    }
}

#[test]
fn limits_that_only_the_kept_rows_have_are_passed() {
    let platform = Platform::default();
    let times: Vec<f64> = (0..=240).map(|k| 0.02 * f64::from(k)).collect();
    let by_plan = platform.solver().sweep(&times).unwrap();
    // The two links of the dyad are collinear twice per turn: the plan is used again after each of these instants.
    assert!(by_plan.fallbacks.len() < 30, "{:?}", by_plan.fallbacks);
    let options = Options { use_plan: false, ..Options::default() };
    let by_newton = platform.solver().with_options(options).sweep(&times).unwrap();
    for state in by_plan.iter().chain(&by_newton) {
        let turned = 0.6 + 1.4 * state.t;
        let expected = [turned, turned, turned, 0.0];
        for (k, expected) in expected.into_iter().enumerate() {
            assert!((state.q[3 * k + 2] - expected).abs() < 1e-9, "t = {}: {:?}", state.t, state.q);
        }
    }
}

#[test]
fn tolerances_of_both_crates_are_one() {
    assert_eq!(Plan::CONSISTENCY, kin_core::plan::TOLERANCE);
}

fn printed<M: Kinematics + Default + Sync>(arguments: &[&str]) -> String {
    let name = format!("kin-redundant-{}-{}.txt", arguments.join("-").replace('/', ""), std::process::id());
    let file = std::env::temp_dir().join(name);
    let all = ["it"].iter().chain(arguments).copied().chain(["--out", file.to_str().expect("a path of characters")]);
    let _ = cli::run_from::<M>(all);
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn info_and_check_speak_of_rows_that_are_not_used() {
    let info = printed::<Platform>(&["info"]);
    assert!(info.contains("F.y is redundant and not used: its residual is checked"), "{info}");
    let both = printed::<TwoGuides>(&["info"]);
    assert!(
        both.contains("upper.normal and upper.angle are redundant and not used: their residual is checked"),
        "{both}"
    );
    let json: serde_json::Value = serde_json::from_str(&printed::<Platform>(&["info", "--format", "json"])).unwrap();
    let step = json["plan"]["steps"].as_array().and_then(|steps| steps.last()).unwrap();
    assert_eq!((step["kind"].as_str(), step["redundant_rows"][0].as_str()), (Some("redundant_rows"), Some("F.y")));
    let check = printed::<Platform>(&["check"]);
    assert!(check.contains("of the plan's q, q̇, q̈ at") && check.contains("passed"), "{check}");
}

/// Two equivalent drivers in different expressions, which reverse their direction.
#[mechanism(allow_redundant)]
#[bodies(left, right, bar)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: ground @ (1, 0), right @ (0, 0))]
#[revolute(C: left @ (0.5, 0), bar @ (0, 0))]
#[revolute(D: right @ (0.5, 0), bar @ (1, 0))]
#[driver(one: left.phi = 1.5 + sin(t))]
#[driver(other: right.phi = 1.5 + 2 * sin(t / 2) * cos(t / 2) + faster * t)]
#[guess(left.phi = 1.8, right.phi = 1.8, bar.phi = 0)]
struct Motors {
    #[param(0)]
    faster: f64,
}

#[test]
fn a_motion_that_turns_round_is_no_contradiction() {
    let motors = Motors::default();
    let mut planned = motors.solver().planned(&Instant::at(0.3)).unwrap();
    for k in 1..=3 {
        let turn = (f64::from(k) - 0.5) * std::f64::consts::PI;
        for off in [-1e-2, -1e-5, -1e-7, 0.0, 1e-9, 1e-6, 1e-3] {
            let found = planned.at(&Instant::at(turn + off)).unwrap_or_else(|error| panic!("{off:e}: {error}"));
            assert!(found.q_dot()[2].abs() <= 2.0 * f64::abs(off) + 1e-15);
        }
    }
    // A slightly faster second driver is detected there, too.
    let turn = Instant::at(0.5 * std::f64::consts::PI);
    let found = Planned::new(&Motors { faster: 1e-12 }, &turn, planned.at(&turn).unwrap().q());
    assert!(matches!(found, Err(PlanError::Contradiction { .. })), "{found:?}");
}

/// A batch of platforms of which some have a third crank of a different length.
#[cfg(feature = "simd")]
#[test]
fn contradictions_are_seen_lane_by_lane() {
    use kin_runtime::Lanes;
    use kin_runtime::batch::{Column, Modes, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
    use kin_runtime::plan::Depth;

    let platform = Platform::default();
    let errors = [0.0, 1e-9, 0.0, 1e-3, 1e-6, 0.0, 0.0];
    let last: Vec<f64> = errors.iter().map(|e| 0.3 * (1.0 + e)).collect();
    let shared = [0.3, 0.3, 0.8, 0.3, 0.4, 0.6].map(Column::Shared);
    let mut parameters = shared;
    parameters[1] = Column::Each(&last);
    let q = platform.solver().assemble(&Instant::at(0.0)).unwrap();
    let start: Vec<Column<'_>> = q.iter().map(|q| Column::Shared(*q)).collect();
    let (t, modes) = (Column::Shared(0.0), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
    let mut out = Solutions::<Platform>::new(errors.len());
    for depth in [Depth::Position, Depth::Acceleration] {
        solve(&platform, depth, &problems, &mut out, &always).unwrap();
        let good: Vec<bool> = errors.iter().map(|e| *e == 0.0).collect();
        assert_eq!(out.solved().collect::<Vec<_>>(), good);
        assert!(out.margin().zip(&good).all(|(margin, good)| (margin > 0.0) == *good));
    }
    let sweeps = Sweeps { parameters: &parameters, times: &times(), inputs: &[], modes, start: &start };
    let mut motions = Motions::new(errors.len(), Lanes::from(0.0));
    sweep(&platform, &sweeps, &mut motions, &always, |_, _| ()).unwrap();
    for (end, error) in motions.ends().zip(errors) {
        let words = end.and_then(|end| end.limit).map(|limit| limit.to_string());
        assert_eq!(words.is_some(), error != 0.0, "{end:?}");
        assert!(words.is_none_or(|words| words.starts_with("redundant row of F violated by")), "{end:?}");
    }
}

/// All cranks turn as the first one does, and the platform does not turn. The rows of two cranks alone are singular
/// where these lie flat; with the third crank the rates are as accurate as anywhere else.
#[test]
fn rates_are_accurate_beside_a_limit_of_the_plan_alone() {
    let speed = 1.4;
    for exponent in 1..=14 {
        let (start, before) = (2.5, 10.0_f64.powf(-0.5 * f64::from(exponent)));
        let platform = Platform { start, ..Platform::default() };
        let at = Instant::at((std::f64::consts::PI - start - before) / speed);
        let from = Instant::at(0.0);
        let solver = platform.solver();
        let mut tracker = solver.tracker(&from).unwrap_or_else(|error| panic!("{error}"));
        let swept = solver.sweep(&[0.0, 0.3 * at.t, at.t]).unwrap_or_else(|error| panic!("{error}"));
        let states = [
            platform.state_at(&at).unwrap_or_else(|error| panic!("{error}")),
            swept.states[2].clone(),
            tracker.update(&at).unwrap_or_else(|error| panic!("{error}")).clone(),
        ];
        for (way, state) in ["state", "sweep", "tracker"].into_iter().zip(&states) {
            let of = |rates: &[f64]| [2, 5, 8, 11].map(|phi| rates[phi]);
            let off = |rates: &[f64], expected: f64| off(&of(rates), &[expected, expected, expected, 0.0]);
            let [first, second] = [off(&state.q_dot, speed), off(&state.q_ddot, 0.0) / (speed * speed)];
            assert!(first < 1e-11 && second < 1e-10, "{way}, {before:e} before: {first:e}, {second:e}");
        }
    }
}

/// A table on three equal cranks, which stays level, is pushed by a cylinder and pulls a slider.
#[mechanism(allow_redundant)]
#[bodies(table, k1, rod, s, k2, k3)]
#[revolute(A: ground @ (0, 0), k1 @ (0, 0))]
#[revolute(B: k1 @ (0.485, 0), table @ (0, 0))]
#[revolute(R: table @ (0.308, 0.016), rod @ (0, 0))]
#[revolute(S: rod @ (1.053, 0), s @ (0, 0))]
#[translational(G: ground @ (0, 0.113), s @ (0, 0), axis = (1, 0.2))]
#[driver(cyl: distance(ground @ (-0.434, -0.525), table @ (0.1, 0.05)) = 0.981 + 0.103*t)]
#[revolute(A2: ground @ (0.6, 0), k2 @ (0, 0))]
#[revolute(B2: k2 @ (0.485, 0), table @ (0.6, 0))]
#[revolute(A3: ground @ (0.3, 0.4), k3 @ (0, 0))]
#[revolute(B3: k3 @ (0.485, 0), table @ (0.3, 0.4))]
#[angle(level: table = 0)]
#[guess(k1.phi = -0.6, k2.phi = -0.6, k3.phi = -0.6, table.x = 0.4, table.y = -0.28)]
struct LevelTable;

/// Where the plan's own rows have a branch point, redundant rows lead on. Full Newton passes it, too, and the motion ends
/// at the dead centre that comes later within the same interval.
#[test]
fn a_branch_point_that_redundant_rows_lead_through_is_not_the_end() {
    let start = LevelTable.state_at(&Instant::at(0.0)).expect("it closes").q;
    for times in [vec![0.0, 4.0], vec![0.0, 1.0, 4.0], (0..=40).map(|k| 0.1 * f64::from(k)).collect::<Vec<_>>()] {
        let ends: Vec<f64> = [true, false]
            .into_iter()
            .map(|use_plan| {
                let options = Options { use_plan, ..Options::default() };
                let error = LevelTable.solver().with_options(options).sweep_from(&start, &times).unwrap_err();
                let SolveError::Singular { t, limit, .. } = error.source else { panic!("{error}") };
                let told = limit.and_then(|limit| limit.at());
                assert!(told.is_none_or(|told| (told - t).abs() < 1e-5), "{times:?}: {told:?} and {t}");
                t
            })
            .collect();
        assert!((ends[0] - ends[1]).abs() < 1e-5, "{times:?}: {ends:?}");
    }
}
