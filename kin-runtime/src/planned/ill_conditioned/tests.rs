//! Tests of the detection of rates dominated by rounding: every criterion beside its threshold.

use super::*;
use crate::fixture::{FourBarLoop, PlannedFourBar};

/// A state of the group of the four-bar: w, ẇ, √margin and its rate, the rates of the crank and of the group, its
/// acceleration.
#[derive(Clone, Copy)]
struct Beside {
    w: f64,
    w_dot: f64,
    distance: f64,
    approach: f64,
    crank: f64,
    group: f64,
    acceleration: f64,
}

impl Beside {
    /// A crossing at which w is proportional to the angle.
    fn crossing(w: f64) -> Self {
        Self { w, w_dot: 1.0, distance: w.abs(), approach: 1.0, crank: 1.0, group: 1.0, acceleration: 0.0 }
    }

    fn is_ill_conditioned(self) -> bool {
        let (mut q_dot, mut q_ddot) = ([1e9; 9], [1e9; 9]);
        // Angles of the crank, the coupler and the rocker; rates of x and y are ignored.
        (q_dot[2], q_dot[5], q_dot[8]) = (self.crank, 0.5 * self.group, -self.group);
        (q_ddot[2], q_ddot[5], q_ddot[8]) = (1e9, -self.acceleration, 0.5 * self.acceleration);
        let found = ill_conditioned_group(
            PlannedFourBar::model(),
            [&[self.w], &[self.w_dot]],
            [&[self.distance], &[self.approach]],
            [&q_dot, &q_ddot],
            &[],
        );
        assert!(found.is_none_or(|group| group == 0));
        found.is_some()
    }
}

/// The w at which the rounding of w², ε/(w x²) of the acceleration, is 4·10⁻⁶ of it.
fn edge(x_by_w: f64) -> f64 {
    (f64::EPSILON / 4e-6).cbrt() / x_by_w.powf(2.0 / 3.0)
}

#[test]
fn rates_mean_nothing_where_rounding_makes_too_much_of_them() {
    let crossing = Beside::crossing;
    let of = |change: fn(&mut Beside), x_by_w: f64| {
        for (factor, expected) in [(0.99, true), (1.01, false)] {
            for side in [1.0, -1.0] {
                let mut beside = crossing(side * factor * edge(x_by_w));
                change(&mut beside);
                assert_eq!(expected, beside.is_ill_conditioned(), "{x_by_w} {factor} {side}");
            }
        }
    };
    of(|_| (), 1.0);
    of(|beside| beside.w_dot = -1.0, 1.0);
    // A group whose w changes twice as fast is half as far from the crossing; one that turns twice as fast is twice as
    // far.
    of(|beside| beside.w_dot = 2.0, 0.5);
    of(|beside| (beside.crank, beside.group) = (2.0, 2.0), 2.0);
    // The tolerance is relative to the drive down to a twentieth of the group's rate; if the drive is faster than the
    // group or stands still, it has no effect.
    of(|beside| beside.crank = -0.5, 0.5);
    of(|beside| beside.crank = 0.03, 0.05);
    of(|beside| beside.crank = 3.0, 1.0);
    of(|beside| beside.crank = 0.0, 1.0);
    of(|beside| (beside.crank, beside.group) = (1.0, 2.0), 1.0);
}

/// Beside a fold the acceleration grows as w goes to 0, so that a fold is not taken for a crossing, however near it is.
#[test]
fn a_fold_is_not_taken_for_a_crossing() {
    for (velocity, w) in [(1.0, 3e-4), (-2.0, 2e-4)] {
        let at = |share: f64| {
            let acceleration = share * velocity * velocity / w;
            Beside { crank: velocity, group: velocity, acceleration, ..Beside::crossing(w) }.is_ill_conditioned()
        };
        assert!(at(0.029) && !at(0.031) && !at(1.0) && at(0.0), "{velocity}");
        assert!(at(-0.029) && !at(-0.031), "{velocity}");
    }
}

/// The product of a group's rate and its angle from the limit is about the rate of the drive at a fold, and small at a
/// crossing. Where it clearly belongs to one of the two, accelerations have no effect.
#[test]
fn what_drives_a_group_tells_folds_from_crossings() {
    let at =
        |crank: f64, acceleration: f64| Beside { crank, acceleration, ..Beside::crossing(3e-4) }.is_ill_conditioned();
    assert!(at(-0.0031, 0.0) && !at(-0.0029, 0.0));
    assert!(at(3.1, 1e9) && !at(2.9, 1e9));
}

#[test]
fn where_nothing_moves_rates_are_right() {
    let at = |w: f64, crank: f64| Beside { crank, group: 0.0, w_dot: 0.0, ..Beside::crossing(w) }.is_ill_conditioned();
    assert!(!at(1e-6, 0.0) && !at(0.05, 0.0));
}

/// The angle between a standing group and the crossing is measured by the motion of its drive.
#[test]
fn a_group_that_stands_still_may_cross() {
    let at = |w: f64, group: f64| Beside { group, acceleration: 1e9, ..Beside::crossing(w) }.is_ill_conditioned();
    for group in [0.0, 1e-3, -9e-3] {
        assert!(at(0.99 * edge(1.0), group) && !at(1.01 * edge(1.0), group), "{group}");
    }
    // A group that moves slowly is nearer to the crossing.
    assert!(at(1.01 * edge(1.0), 0.011));
}

#[test]
fn only_near_groups_are_asked() {
    // With such a fast w the angle to the crossing is as small as possible.
    let at = |w: f64| Beside { w_dot: 1e9, ..Beside::crossing(w) }.is_ill_conditioned();
    assert!(at(0.099) && !at(0.101));
}

/// Where √margin is less than half of |w|, the closures are apart, and the outer pins nearly coincide.
#[test]
fn pins_that_meet_are_found_by_the_margin_alone() {
    let at = |w: f64, distance: f64| {
        // All other criteria say that this is far from a crossing.
        Beside { distance, w_dot: 1e-9, ..Beside::crossing(w) }.is_ill_conditioned()
    };
    for side in [1.0, -1.0] {
        assert!(at(side * 0.1, 0.049) && !at(side * 0.1, 0.051), "{side}");
        // The margin itself must be small, too.
        assert!(at(side * 0.9, 0.099) && !at(side * 0.9, 0.101), "{side}");
    }
}

/// Pins that pass each other at a small distance turn their group so fast that rounding does not matter. Below a certain
/// distance the angle itself has too few digits.
#[test]
fn pins_that_pass_each_other_have_rates() {
    let at = |distance: f64, group: f64, acceleration: f64| {
        Beside { distance, w_dot: 1e-9, group, acceleration, ..Beside::crossing(0.9) }.is_ill_conditioned()
    };
    // The error of q̈ at a distance of 10⁻⁵ of the terms is 0.22 times the square of the rate of the drive.
    assert!(at(0.01, 1.0, 0.0) && at(0.01, 31.0, 900.0) && !at(0.01, 33.0, 0.0) && !at(0.01, 31.0, 1.1e3));
    assert!(at(1.9e-4, 1e9, 1e18) && !at(2.1e-4, 1e9, 1e18));
    // A group that is not much faster than its drive does not pass, and nor does one without a drive that turns.
    assert!(at(0.05, 29.0, 1e9) && !at(0.05, 31.0, 1e9) && at(0.01, f64::NAN, 0.0));
    let without =
        Beside { distance: 0.05, crank: 0.0, w_dot: 1e-9, group: 31.0, acceleration: 1e9, ..Beside::crossing(0.9) };
    assert!(without.is_ill_conditioned());
}

/// Pins that keep their distance belong to a small group, which is not near its limit.
#[test]
fn small_groups_have_rates() {
    let at = |distance: f64, approach: f64, crank: f64, group: f64| {
        Beside { distance, approach, w_dot: 1e-9, crank, group, ..Beside::crossing(0.9) }.is_ill_conditioned()
    };
    for side in [1.0, -1.0] {
        assert!(!at(0.05, side * 0.049, 1.0, 1.0) && at(0.05, side * 0.051, 1.0, 1.0), "{side}");
        assert!(!at(0.05, side * 0.099, -2.0, 1.0) && at(0.05, side * 0.101, -2.0, 1.0), "{side}");
    }
    // Its angles still need digits.
    assert!(at(1.9e-4, 0.0, 1.0, 1.0) && !at(2.1e-4, 0.0, 1.0, 1.0));
    assert!(!at(0.05, 0.0, 0.0, 0.0) && at(0.05, 0.0, 0.0, 1.0) && at(0.05, f64::NAN, 1.0, 1.0));
}

#[test]
fn angles_and_scalars_have_rates_that_count_and_places_have_none() {
    let mut rates = [0.0; 9];
    (rates[0], rates[4], rates[5], rates[8]) = (7.0, -9.0, -3.0, 2.0);
    assert_eq!(3.0, largest_angle(PlannedFourBar::model(), &[], &rates));
    assert_eq!(4.0, largest_angle(FourBarLoop::model(), &[], &[1.0, -4.0, 2.0]));
    // A length counts with the turn of the rows.
    let mut turns = [0.0; 9];
    turns[0] = 2.5;
    assert_eq!(2.5 * rates[0], largest_angle(PlannedFourBar::model(), &turns, &rates));
}
