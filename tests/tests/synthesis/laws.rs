//! Laws of every search: the same seed gives the same result, conditions are met, equal parameters stay equal, and
//! invalid input is an error.

use crate::published::{LENGTHS, four_bar, timed};
use kin_runtime::design::{Design, DesignError, Direction, Number, Progress, Search};
use kin_runtime::{Kinematics, Measure, Mechanism, Scalar, mechanism};
use std::ops::ControlFlow;

const FEW: Search<'_> = Search { starts: 2, seed: 7, watch: None };

#[test]
fn a_seed_gives_the_same_design_again() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    let [first, second] = [(); 2].map(|()| design.search(&FEW).unwrap());
    assert_eq!(first.parameters, second.parameters);
    assert_eq!(first.errors, second.errors);
}

#[test]
fn conditions_are_kept() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    let design = design.at_least(&[("r4", 1.0), ("r1", -1.0)], 0.5).unwrap();
    let design = design.turns(std::f64::consts::TAU, 13, 0.05).unwrap();
    let design = design.range("P.x", -4.0..=4.0, std::f64::consts::TAU, 13).unwrap();
    let found = design.search(&FEW).unwrap();
    let value = |name: &str| found.parameters.iter().find(|(other, _)| *other == name).unwrap().1;
    assert!(value("r4") - value("r1") >= 0.5, "{found}");
    assert!(value("r2") + value("r4") <= value("r1") + value("r3"), "{found}");
    assert_eq!(6, found.slacks.len());
    assert!(found.slacks.iter().all(|slack| slack.slack > 0.0), "{found}");
}

/// A range that is asked for at five instants of a turn holds at all of them.
#[test]
fn conditions_are_kept_between_instants() {
    let turn = std::f64::consts::TAU;
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    let design = design.turns(turn, 5, 0.05).unwrap().range("P.x", -3.0..=4.0, turn, 5).unwrap();
    let least = 35_f64.to_radians();
    let found = design.transmission("B", least, turn, 5).unwrap().search(&FEW).unwrap();
    let times: Vec<f64> = (0..=2000).map(|k| turn * f64::from(k) / 2000.0).collect();
    let modes: Vec<_> = found.modes.iter().map(|(name, sign)| (*name, *sign)).collect();
    let solver = modes.iter().fold(found.mechanism.solver(), |solver, (name, sign)| solver.with_mode(*name, *sign));
    let angle: Vec<Measure> =
        Measure::named(crate::published::FourBar::model(), "B.transmission").into_iter().collect();
    let (mut low, mut high, mut worst) = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY);
    for state in solver.sweep(&times).unwrap().states {
        (low, high) = (low.min(state.points[0].r[0]), high.max(state.points[0].r[0]));
        let angle = solver.measure(&state, &angle).unwrap()[0];
        worst = worst.min(angle).min(std::f64::consts::PI - angle);
    }
    assert!(low >= -3.0 && high <= 4.0 && worst >= least, "{low} {high} {worst}: {found}");
    // Bounds of angles are told in degrees.
    assert!(found.slacks.iter().any(|slack| slack.condition == "B.transmission in 35°..145°"), "{found}");
    // The slack that is told is the least between instants.
    let told = found.slacks.iter().find(|slack| slack.condition.starts_with("P.x")).unwrap();
    let exact = ((low + 3.0) / 7.0).min((4.0 - high) / 7.0);
    assert!((told.slack - exact).abs() < 1e-5 && told.slack <= exact && told.at.is_some(), "{told} instead of {exact}");
}

/// The stroke in x of a point is to be 3: a number of my own over the motion, with its derivatives.
#[test]
fn own_residuals_are_followed_downhill() {
    let begin = four_bar([0.5, 5.0], &["rcx", "rcy"], 5.0).unwrap();
    let stroke = |at: &[Vec<Number>]| vec![at[0][0] - at[1][0] - Number::from_f64(3.0), at[0][1] - at[1][1]];
    let design = begin.residuals(&["P.x", "P.y"], &[0.5, 2.5], stroke).unwrap();
    let found = design.search(&FEW).unwrap();
    assert!(found.error < 1e-12, "{found}");
    let solver = found.modes.iter().fold(found.mechanism.solver(), |s, (name, sign)| s.with_mode(*name, *sign));
    let states = solver.sweep(&[0.5, 2.5]).unwrap().states;
    assert!((states[0].points[0].r[0] - states[1].points[0].r[0] - 3.0).abs() < 1e-5, "{found}");
}

#[test]
fn equal_parameters_stay_equal() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    // It is free no more.
    let design = design.equal("x0", "y0");
    assert_eq!(Some(DesignError::NotFree { parameter: "y0".to_owned() }), design.err());
    let free =
        |name: &str, design: kin_runtime::design::Design<crate::published::FourBar>| design.free(name, 0.1..=10.0);
    let begin = kin_runtime::design::Design::new(&crate::published::FourBar::default());
    let design = LENGTHS[..3].iter().try_fold(begin, |design, name| free(name, design)).unwrap();
    let found = design.equal("r4", "r3").unwrap().path_at("P", &timed(2)).unwrap().search(&FEW).unwrap();
    let value = |name: &str| found.parameters.iter().find(|(other, _)| *other == name).unwrap().1;
    assert_eq!(value("r3"), value("r4"));
}

/// Bounds of its own would contradict those of the parameter that it is equal to.
#[test]
fn a_parameter_is_free_or_equal_to_another_once() {
    let begin = || kin_runtime::design::Design::new(&crate::published::FourBar::default());
    let twice = |name: &str| Some(DesignError::Twice { parameter: name.to_owned() });
    let free = || begin().free("r3", 0.1..=0.2).unwrap().free("r4", 0.5..=0.7).unwrap();
    assert_eq!(twice("r4"), free().equal("r4", "r3").err());
    assert_eq!(twice("r3"), free().equal("r3", "r3").err());
    assert_eq!(twice("r3"), free().free("r3", 0.3..=0.4).err());
    let equal = begin().free("r3", 0.1..=0.2).unwrap().equal("r4", "r3").unwrap();
    assert_eq!(twice("r4"), equal.free("r4", 0.5..=0.7).err());
}

#[test]
fn a_search_stops_when_it_is_told() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    // It is asked all the time, so that a search that has found nothing yet stops, too.
    let at_once = |_: Progress| ControlFlow::Break(());
    let nothing = design.search(&Search { starts: 40, seed: 1, watch: Some(&at_once) });
    assert!(matches!(nothing, Err(DesignError::Stopped)), "{nothing:?}");
    let stop = |progress: Progress| if progress.done > 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let found = design.search(&Search { starts: 40, seed: 1, watch: Some(&stop) }).unwrap();
    assert!(found.stopped && found.assembled < 40, "{found}");
}

#[test]
fn what_cannot_be_searched_for_is_refused() {
    let begin = || four_bar([0.1, 10.0], &[], 10.0).unwrap();
    assert!(matches!(begin().free("r9", 0.0..=1.0), Err(DesignError::UnknownParameter { .. })));
    assert!(matches!(begin().free("r1", 1.0..=1.0), Err(DesignError::Bounds { .. })));
    assert!(matches!(begin().path_at("Q", &[]), Err(DesignError::UnknownQuantity { .. })));
    let turn = std::f64::consts::TAU;
    assert!(matches!(begin().transmission("D", 0.5, turn, 9), Err(DesignError::NoTransmission { .. })));
    assert!(matches!(begin().transmission("B", 2.0, turn, 9), Err(DesignError::Bounds { .. })));
    assert!(matches!(begin().range("t", 0.0..=1.0, turn, 9), Err(DesignError::NoDerivatives { .. })));
    assert!(matches!(begin().function("P.x/drive", &[(0.0, 1.0)]), Err(DesignError::NoDerivatives { .. })));
    assert!(matches!(begin().mode("Q", None), Err(DesignError::UnknownMode { .. })));
    assert!(matches!(begin().function("P.x", &[(f64::NAN, 0.0)]), Err(DesignError::NotFinite { .. })));
    assert!(matches!(begin().path("P", &[], 0.0, Direction::Forward), Err(DesignError::NotFinite { .. })));
    assert!(matches!(begin().search(&FEW), Err(DesignError::Nothing { .. })));
    let apart = begin().at_least(&[("r1", 1.0)], 20.0).unwrap().path_at("P", &timed(2)).unwrap();
    let Err(DesignError::NoStart { sampled, open: 0, why: None, missed, .. }) = apart.search(&FEW) else {
        panic!("a length of at most 10 is not 20")
    };
    let all = |missed: &kin_runtime::design::Missed| {
        missed.designs == sampled && missed.closest.is_some_and(|lack| lack > 0.0)
    };
    assert!(missed.iter().any(all), "{missed:?}");
}

/// An arm that a cylinder lifts.
#[kin_runtime::mechanism]
#[input(stroke)]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[distance(cylinder: ground @ (0.5, -0.2), arm @ (0.8, 0.1), length = stroke)]
#[point(tip = arm @ (reach, 0))]
#[guess(arm.phi = 0.8)]
struct Lift {
    #[param(2)]
    reach: f64,
}

#[test]
fn a_mechanism_with_inputs_is_refused_by_name() {
    let design = kin_runtime::design::Design::new(&Lift::default()).free("reach", 1.0..=3.0).unwrap();
    let design = design.path_at("tip", &[(0.0, [1.0, 1.0])]).unwrap();
    assert_eq!(Err(DesignError::Inputs { inputs: vec!["stroke"] }), design.search(&FEW).map(|_| ()));
}

/// An arm with a counterweight: at a constant speed the motor holds g (m l − M c) cos φ.
#[kin_runtime::mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[point(weight = arm @ (-c, 0))]
#[driver(motor: arm.phi = t)]
#[gravity(0, -9.81)]
#[mass(arm @ (0.5, 0), mass = 1)]
#[mass(arm @ (-c, 0), mass = 2)]
#[derive(Clone, Debug, PartialEq)]
struct Balanced {
    #[param(0.1)]
    c: f64,
}

/// A torque is an aim as any other quantity, and a condition.
#[test]
fn designs_have_the_torque_that_is_wanted() {
    let design = || kin_runtime::design::Design::new(&Balanced::default()).free("c", 0.01..=0.6).unwrap();
    let found =
        design().function("motor.effort", &[(0.0, 2.0), (1.0, 2.0 * 1_f64.cos())]).unwrap().search(&FEW).unwrap();
    let exact = (0.5 - 2.0 / 9.81) / 2.0;
    assert!((found.mechanism.c - exact).abs() < 1e-9, "{found}");
    // The weight is to be near the pin, and the motor holds 1 at most.
    let near = design().function("weight.x", &[(0.0, 0.0)]).unwrap();
    let found = near.range("motor.effort", -1.0..=1.0, std::f64::consts::TAU, 9).unwrap().search(&FEW).unwrap();
    let least = (0.5 - 1.0 / 9.81) / 2.0;
    assert!(found.mechanism.c >= least && found.mechanism.c < least + 1e-3, "{found} {least}");
}

/// What is to be least need not be a sum of squares: the greatest torque, and a hollow that is the deepest of many.
#[test]
fn the_least_is_found_without_derivatives() {
    let design = || kin_runtime::design::Design::new(&Balanced::default()).free("c", 0.01..=0.6).unwrap();
    let times: Vec<f64> = (0..5).map(|k| 0.7 * f64::from(k)).collect();
    let greatest = |at: &[Vec<f64>]| at.iter().map(|torque| torque[0].abs()).fold(0.0, f64::max);
    let search = Search { starts: 8, seed: 3, watch: None };
    let found = design().least(&["motor.effort"], &times, greatest).unwrap().search(&FEW).unwrap();
    assert!((found.mechanism.c - 0.25).abs() < 1e-6, "{found}");
    assert_eq!(found.least, Some(found.error));
    // c² + sin² 20 (c − 0.3): hollows near 0, 0.143, 0.3, 0.457, of which the first that the bounds leave is the deepest.
    let depth = |c: f64| c * c + (20.0 * (c - 0.3)).sin().powi(2);
    let wavy = move |at: &[Vec<f64>]| depth(-at[0][0]);
    let wide = kin_runtime::design::Design::new(&Balanced::default()).free("c", 0.05..=0.6).unwrap();
    let found = wide.least(&["weight.x"], &[0.0], wavy).unwrap().search(&search).unwrap();
    let grid = (0..=55_000).map(|k| 0.05 + 1e-5 * f64::from(k)).map(depth).fold(f64::INFINITY, f64::min);
    assert!(found.error <= grid + 1e-9 && found.error >= grid - 1e-6, "{found} instead of {grid}");
    // A condition holds, and the least is at its limit.
    let held = || {
        let least = design().least(&["motor.effort"], &times, greatest).unwrap();
        least.range("weight.x", -0.2..=0.2, std::f64::consts::TAU, 5).unwrap().search(&FEW).unwrap()
    };
    let found = held();
    assert!(found.mechanism.c < 0.2 && found.mechanism.c > 0.2 - 1e-4, "{found}");
    assert_eq!(found, held(), "a seed repeats");
}

/// A crank that moves a slider by a rod of 0.7, to the right of the crank unless a guess says otherwise.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[distance(rod: crank @ (r, 0), slider @ (0, 0), length = 0.7)]
#[driver(drive: crank.phi = t)]
#[guess(slider.x = 0.7)]
struct Slider {
    #[param(0.1)]
    r: f64,
}

/// Modes that are not prescribed are those of the design's own guesses.
#[test]
fn a_guess_leads_to_its_mode() {
    let x = Slider::model().coordinates.iter().position(|info| info.name == "slider.x").expect("it is free");
    let found = Design::new(&Slider::default())
        .free("r", 0.05..=0.5)
        .and_then(|design| design.function("slider.x", &[(0.0, -0.5)]))
        .map(|design| design.guess(x, -0.7))
        .and_then(|design| design.search(&Search { starts: 2, ..Search::default() }))
        .unwrap_or_else(|error| panic!("{error}"));
    assert!((found.mechanism.r - 0.2).abs() < 1e-9 && found.error < 1e-18, "{found}");
}

/// A path without places asks for nothing.
#[test]
fn an_empty_path_changes_nothing() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    let with_empty = design.clone().path("P", &[], 1.0, Direction::Either).unwrap();
    assert_eq!(design.search(&FEW).unwrap().parameters, with_empty.search(&FEW).unwrap().parameters);
}
