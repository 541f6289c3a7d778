//! What holds of every search: seeds repeat, conditions are kept, equal parameters stay equal, and bad input is refused.

use crate::published::{LENGTHS, four_bar, timed};
use kin_runtime::design::{DesignError, Direction, Progress, Search};
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

#[test]
fn a_search_stops_when_it_is_told() {
    let design = four_bar([0.1, 10.0], &["rcx", "rcy"], 10.0).unwrap().path_at("P", &timed(2)).unwrap();
    let stop = |_: Progress| ControlFlow::Break(());
    let found = design.search(&Search { starts: 40, seed: 1, watch: Some(&stop) }).unwrap();
    assert!(found.stopped && found.assembled < 40, "{found}");
}

#[test]
fn what_cannot_be_searched_for_is_refused() {
    let begin = || four_bar([0.1, 10.0], &[], 10.0).unwrap();
    assert!(matches!(begin().free("r9", 0.0..=1.0), Err(DesignError::UnknownParameter { .. })));
    assert!(matches!(begin().free("r1", 1.0..=1.0), Err(DesignError::Bounds { .. })));
    assert!(matches!(begin().path_at("Q", &[]), Err(DesignError::UnknownQuantity { .. })));
    assert!(matches!(begin().mode("Q", None), Err(DesignError::UnknownMode { .. })));
    assert!(matches!(begin().function("P.x", &[(f64::NAN, 0.0)]), Err(DesignError::NotFinite { .. })));
    assert!(matches!(begin().path("P", &[], 0.0, Direction::Forward), Err(DesignError::NotFinite { .. })));
    assert!(matches!(begin().search(&FEW), Err(DesignError::Nothing { .. })));
    let apart = begin().at_least(&[("r1", 1.0)], 20.0).unwrap().path_at("P", &timed(2)).unwrap();
    assert!(matches!(apart.search(&FEW), Err(DesignError::NoStart { .. })));
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
