//! Degrees of freedom, independent coordinates and redundant rows.

use crate::fixture::{FiveBar, FlatParallelogram, FourBarLoop, Parallelogram, Squeezer};
use crate::{Instant, Kinematics};

#[test]
fn the_lecture_four_bar_has_the_driven_angle_independent() {
    let mechanism = FourBarLoop::default();
    let at = Instant::at(0.0);
    let q = mechanism.state_at(&at).unwrap().q;
    let mobility = mechanism.mobility(&at, &q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left, mobility.rank), (1, 0, 3));
    assert_eq!((mobility.independent, mobility.dependent), (vec![0], vec![1, 2]));
    assert!(mobility.redundant.is_empty() && mobility.could_be_given.is_empty());
    assert!(mobility.condition > 1.0 && mobility.condition < 100.0);
}

#[test]
fn the_later_joint_of_a_circuit_is_redundant() {
    let at = Instant::at(0.0);
    let mechanism = Parallelogram { length: 0.27 };
    let q = mechanism.state_at(&at).unwrap().q;
    let mobility = mechanism.mobility(&at, &q).unwrap();
    assert_eq!((mobility.rows, mobility.rank, mobility.rank_without_driving), (13, 12, 11));
    assert_eq!((mobility.degrees_of_freedom, mobility.driving_rows), (1, 1));
    let [row] = &mobility.redundant[..] else { panic!("{:?}", mobility.redundant) };
    assert_eq!((row.joint, row.consistent), ("C", true));
    assert_eq!(row.circuit, ["O1", "A", "B", "O2", "O3"]);
}

#[test]
fn what_still_moves_could_be_given() {
    let at = Instant::at(0.0);
    let q = FiveBar.state_at(&at).unwrap().q;
    let mobility = FiveBar.mobility(&at, &q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (2, 1));
    assert_eq!(mobility.could_be_given, (3..12).collect::<Vec<_>>());
    assert_eq!(mobility.independent.len(), 2);
    assert!(mobility.independent.contains(&2), "the driven crank angle is independent: {:?}", mobility.independent);
}

#[test]
fn small_mechanisms_are_no_more_singular_than_large_ones() {
    let at = Instant::at(0.0);
    let q = Squeezer.state_at(&at).unwrap().q;
    let mobility = Squeezer.mobility(&at, &q).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (1, 0));
    assert_eq!(mobility.independent, [2]);
    assert!(mobility.condition < 1e4, "{}", mobility.condition);
}

#[test]
fn a_singular_configuration_shows_one_more_freedom() {
    let flat = FlatParallelogram { start: 0.0 };
    let q = [0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.5, 0.0, 0.0];
    let mobility = flat.mobility(&Instant::at(0.0), &q).unwrap();
    assert_eq!((mobility.rank, mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (8, 2, 1));
    assert_eq!(flat.degrees_of_freedom(&Instant::at(0.0), &q), Ok(2));
}
