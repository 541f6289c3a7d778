//! The generic rank, which follows from the structure of a mechanism, is distinguished from the rank for its
//! dimensions.

use kin_runtime::{Cause, GeometryFault, Instant, Kinematics, Mechanism, SolveError, mechanism};
use kin_tests::random::Random;

/// A four-bar whose lengths are parameters.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = 0.6 + t)]
struct FourBar {
    #[param(0.3)]
    a: f64,
    #[param(0.7)]
    b: f64,
    #[param(0.3)]
    c: f64,
    #[param(0.7)]
    d: f64,
}

/// A table on three parallel links: rigid, unless the links are equal.
#[mechanism]
#[bodies(p, q, r, table)]
#[revolute(A: ground @ (0, 0), p @ (0, 0))]
#[revolute(B: ground @ (b, 0), q @ (0, 0))]
#[revolute(C: ground @ (c, 0), r @ (0, 0))]
#[revolute(D: table @ (0, 0), p @ (a, 0))]
#[revolute(E: table @ (b, 0), q @ (a, 0))]
#[revolute(F: table @ (c, 0), r @ (last, 0))]
struct Table {
    #[param(0.3)]
    a: f64,
    #[param(0.5)]
    b: f64,
    #[param(0.8)]
    c: f64,
    #[param(0.3)]
    last: f64,
}

/// Three prismatic joints in a loop; the angle of the last one is redundant.
#[mechanism(allow_redundant)]
#[bodies(lower, upper)]
#[translational(floor: ground @ (0, 0), lower @ (0, 0), axis = (1, 0))]
#[translational(slope: lower @ (0, 0), upper @ (0, 0), axis = (4, 3), angle = tilt)]
#[translational(wall: ground @ (1, 0), upper @ (0, 0), axis = (0, 1))]
#[driver(push: lower.x = t)]
struct Wedges {
    #[param(0)]
    tilt: f64,
}

#[test]
fn the_model_knows_its_generic_ranks() {
    let structure = FourBar::model().structure.unwrap();
    assert_eq!((structure.rank, structure.rank_without_driving, structure.redundant.len()), (9, 8, 0));
    let structure = Wedges::model().structure.unwrap();
    assert_eq!((structure.rank, structure.rank_without_driving), (6, 5));
    let [redundant] = structure.redundant else { panic!("{structure:?}") };
    assert_eq!(Wedges::model().rows[redundant.row].name, "wall.angle");
    assert_eq!(redundant.circuit, ["floor", "slope"]);
}

/// Redundant by structure: consistent if the angles of the wedges agree, inconsistent otherwise.
#[test]
fn a_loop_of_wedges_is_redundant_whatever_its_dimensions() {
    for (tilt, consistent) in [(0.0, true), (0.1, false)] {
        let mobility = Wedges { tilt }.mobility(&Instant::at(0.2), &[0.2, 0.0, 0.0, 1.0, 0.6, 0.0]).unwrap();
        assert_eq!((mobility.rank, mobility.generic_rank), (6, Some(6)));
        assert_eq!((mobility.degrees_of_freedom, mobility.generic_degrees_of_freedom), (1, Some(1)));
        let [row] = &mobility.redundant[..] else { panic!("{mobility}") };
        assert_eq!(
            (row.name, row.cause, row.consistent),
            ("wall.angle", Some(Cause::Structure), consistent),
            "{mobility}"
        );
        assert_eq!(row.circuit, ["floor", "slope"]);
        assert!(mobility.to_string().ends_with("whatever the dimensions"), "{mobility}");
    }
    assert!(Wedges { tilt: 0.0 }.state_at(&Instant::at(0.2)).is_ok());
    let error = Wedges { tilt: 0.1 }.state_at(&Instant::at(0.2)).unwrap_err();
    assert!(matches!(error, SolveError::NotAssembled { .. }), "{error}");
}

/// Redundant because of its lengths: the joints of the circuit are named, and the length of the last link decides
/// whether the rows are consistent.
#[test]
fn a_parallelogram_with_a_fifth_bar_moves_because_of_its_lengths() {
    let (at, phi) = (Instant::at(0.0), 0.6_f64);
    let place = |x: f64| [x, 0.0, phi];
    let table = [0.3 * phi.cos(), 0.3 * phi.sin(), 0.0];
    let q = [place(0.0), place(0.5), place(0.8), table].concat();
    for (last, consistent) in [(0.3, true), (0.31, false)] {
        let table = Table { last, ..Table::default() };
        let mobility = table.mobility(&at, &q).unwrap();
        assert_eq!((mobility.degrees_of_freedom, mobility.generic_degrees_of_freedom), (1, Some(0)), "{mobility}");
        let [row] = &mobility.redundant[..] else { panic!("{mobility}") };
        assert_eq!((row.joint, row.consistent), ("F", consistent), "{mobility}");
        assert_ne!(row.cause, Some(Cause::Structure), "{mobility}");
        assert_eq!(row.circuit, ["A", "B", "C", "D", "E"]);
        assert!(mobility.to_string().contains("1 left; 0 in general; row `F.y`"), "{mobility}");
        // Near a configuration that does not close there is no generic rank to compare with.
        assert!(!consistent || row.cause == Some(Cause::Dimensions), "{mobility}");
    }
    // With links of different lengths it can be assembled in another configuration, where it is rigid.
    let other = Table { last: 0.34, a: 0.31, ..Table::default() };
    let q = other.state_at(&at).unwrap().q;
    let mobility = other.mobility(&at, &q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.redundant.len()), (0, 0), "{mobility}");
}

/// Redundant in one configuration: where a parallelogram is stretched, two branches of its motion meet.
#[test]
fn a_stretched_parallelogram_is_singular_in_this_configuration() {
    let flat = FourBar::default();
    let q = [0.0, 0.0, 0.0, 0.3, 0.0, 0.0, 0.7, 0.0, 0.0];
    let mobility = flat.mobility(&Instant::at(-0.6), &q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.generic_degrees_of_freedom), (2, Some(1)));
    let [row] = &mobility.redundant[..] else { panic!("{mobility}") };
    assert_eq!((row.cause, row.consistent), (Some(Cause::Configuration), true), "{mobility}");
    assert!(mobility.to_string().ends_with("in this singular configuration"), "{mobility}");
}

/// With random lengths the actual rank is the generic one; no lengths give a larger rank.
#[test]
fn random_dimensions_have_the_generic_rank() {
    let mut random = Random::new(11);
    let mut assembled = 0;
    for _ in 0..40 {
        let mut length = || random.between(0.2, 1.0);
        let linkage = FourBar { a: length(), b: length(), c: length(), d: length() };
        let Ok(state) = linkage.state_at(&Instant::at(0.0)) else { continue };
        let mobility = linkage.mobility(&Instant::at(0.0), &state.q).unwrap();
        assert_eq!(Some(mobility.rank), mobility.generic_rank, "{mobility}");
        assert!(mobility.redundant.is_empty());
        assembled += 1;
    }
    assert!(assembled >= 10, "{assembled}");
}

/// A direction and a length that are parameters.
#[mechanism]
#[bodies(crank, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (u, v))]
#[distance(rod: crank @ (0.1, 0), slider @ (0, 0), length = rod)]
#[driver(drive: crank.phi = t)]
struct Guided {
    #[param(1)]
    u: f64,
    #[param(0)]
    v: f64,
    #[param(0.3)]
    rod: f64,
}

#[test]
fn parameters_without_direction_or_length_are_errors_by_name() {
    let at = Instant::at(0.0);
    assert!(Guided::default().state_at(&at).is_ok());
    let error = Guided { u: 0.0, ..Guided::default() }.state_at(&at).unwrap_err();
    assert!(
        matches!(error, SolveError::DegenerateGeometry { joint: "guide", fault: GeometryFault::Axis, .. }),
        "{error}"
    );
    assert!(error.to_string().contains("no direction"), "{error}");
    // |v|² overflows, or loses digits by underflow, long before v itself does.
    for a in [1e155, 1e-162, 1e-160] {
        let error = Guided { u: a, v: a, ..Guided::default() }.state_at(&at).unwrap_err();
        let fault = GeometryFault::Axis;
        assert_eq!(error, SolveError::DegenerateGeometry { t: 0.0, joint: "guide", fault }, "{a:e}");
        assert!(error.to_string().contains("cannot be normalised"), "{error}");
    }
    assert!(Guided { u: 1e100, ..Guided::default() }.state_at(&at).is_ok());
    let error = Guided { rod: 0.0, ..Guided::default() }.state_at(&at).unwrap_err();
    let fault = GeometryFault::Length { length: 0.0 };
    assert_eq!(error, SolveError::DegenerateGeometry { t: 0.0, joint: "rod", fault }, "{error}");
    assert!(error.to_string().contains("`revolute`"), "{error}");
}

/// A slider whose distance from the origin is driven, beginning with 0.
#[mechanism]
#[body(slider, y = 0, phi = 0)]
#[driver(push: distance(ground @ (0, 0), slider @ (0, 0)) = 0.3 * t)]
#[guess(slider.x = 0.1)]
struct Pushed;

#[test]
fn a_driven_distance_of_nothing_is_an_error_by_name() {
    let error = Pushed.velocity_analysis(&Instant::at(0.0), &[0.0]).unwrap_err();
    let fault = GeometryFault::Length { length: 0.0 };
    assert_eq!(error, SolveError::DegenerateGeometry { t: 0.0, joint: "push", fault }, "{error}");
    assert!((Pushed.state_at(&Instant::at(1.0)).unwrap().q_dot[0] - 0.3).abs() < 1e-14);
}

/// A knife edge along a prismatic joint's axis is redundant, wherever it is declared.
#[mechanism(allow_redundant)]
#[bodies(sledge)]
#[knife_edge(blade: sledge @ (0, 0))]
#[translational(guide: ground @ (0, 0), sledge @ (0, 0), axis = (1, 0))]
#[driver(push: sledge.x = t)]
struct Guarded;

#[test]
fn rows_of_velocity_level_yield_to_those_of_position() {
    let structure = Guarded::model().structure.unwrap();
    let mobility = Guarded.mobility(&Instant::at(0.0), &[0.0; 3]).unwrap();
    let [generic] = structure.redundant else { panic!("{structure:?}") };
    let [found] = &mobility.redundant[..] else { panic!("{mobility}") };
    assert_eq!(Guarded::model().rows[generic.row].name, "blade");
    assert_eq!(generic.circuit, ["guide"]);
    assert_eq!((found.name, &found.circuit[..], found.consistent), ("blade", &["guide"][..], true), "{mobility}");
}

/// For a body that does not turn, a knife edge keeps y constant; a driver of y is redundant with it.
#[mechanism(allow_redundant)]
#[body(sledge, phi = 0)]
#[knife_edge(blade: sledge @ (0, 0))]
#[driver(lift: sledge.y = 1)]
struct Level;

/// A row of position level whose derivative follows from rows of velocity level: it is redundant, but no position
/// contradicts it.
#[test]
fn velocities_imply_no_position() {
    let mobility = Level.mobility(&Instant::at(0.0), &[0.0, 0.3]).unwrap();
    let [row] = &mobility.redundant[..] else { panic!("{mobility}") };
    assert_eq!((row.name, &row.circuit[..], row.consistent), ("lift", &["blade"][..], true), "{mobility}");
}

/// The table on three links, and two arms that turn in opposite directions.
#[mechanism(allow_redundant)]
#[bodies(p, q, r, table)]
#[body(arm, x = 0, y = 0)]
#[body(other, x = 0, y = 0)]
#[revolute(A: ground @ (0, 0), p @ (0, 0))]
#[revolute(B: ground @ (b, 0), q @ (0, 0))]
#[revolute(C: ground @ (c, 0), r @ (0, 0))]
#[revolute(D: table @ (0, 0), p @ (a, 0))]
#[revolute(E: table @ (b, 0), q @ (a, 0))]
#[revolute(F: table @ (c, 0), r @ (a, 0))]
#[constraint(against: arm.phi + other.phi = 0)]
#[driver(lift: sin(arm.phi) + other.phi = t)]
struct Beside {
    #[param(0.3)]
    a: f64,
    #[param(0.5)]
    b: f64,
    #[param(0.8)]
    c: f64,
}

/// Where the arms are collinear, the driver is redundant with the row that ties them; the third link is redundant
/// everywhere.
#[test]
fn passive_and_driving_rows_are_redundant_for_reasons_of_their_own() {
    let (sin, cos) = 0.6_f64.sin_cos();
    let place = |x: f64| [x, 0.0, 0.6];
    let q = [&[place(0.0), place(0.5), place(0.8), [0.3 * cos, 0.3 * sin, 0.0]].concat()[..], &[0.0; 2]].concat();
    let mobility = Beside::default().mobility(&Instant::at(0.0), &q).unwrap();
    let found: Vec<_> = mobility.redundant.iter().map(|row| (row.joint, row.cause)).collect();
    let expected = [("F", Some(Cause::Dimensions)), ("lift", Some(Cause::Configuration))];
    assert_eq!(found, expected, "{mobility}");
}

/// Two meshing wheels; `a` is driven.
#[mechanism]
#[body(a, x = 0, y = 0)]
#[body(b, x = 1, y = 0)]
#[constraint(mesh: a.phi + 2 * b.phi = 0)]
#[driver(drive: a.phi = t)]
struct ByFirst;

/// The same wheels; `b` is driven.
#[mechanism]
#[body(a, x = 0, y = 0)]
#[body(b, x = 1, y = 0)]
#[constraint(mesh: a.phi + 2 * b.phi = 0)]
#[driver(drive: b.phi = t)]
struct BySecond;

#[test]
fn what_is_driven_is_independent() {
    assert_eq!(ByFirst.mobility(&Instant::at(0.0), &[0.0; 2]).unwrap().independent, [0]);
    assert_eq!(BySecond.mobility(&Instant::at(0.0), &[0.0; 2]).unwrap().independent, [1]);
}
