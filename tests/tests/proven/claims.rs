//! Claims that there are no more closures, and ranges, where start values, formulas and single instants could hide some.

use super::ranges::closures;
use kin_runtime::function::Polynomial;
use kin_runtime::planned::LimitKind;
use kin_runtime::{Instant, Kinematics, Ranges, Signal, SolveError, Uncertified, mechanism};
use std::f64::consts::PI;

/// An angle that occurs doubled has four directions, and the dyad on it closes only with the two that point to its pivot.
#[mechanism]
#[bodies(a, b)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[constraint(double: cos(2*a.phi) = 0.3 + 0.5*t)]
#[revolute(P: ground @ (-1.5, 0), b @ (0, 0))]
#[distance(D: a @ (1, 0), b @ (0.5, 0), length = 0.6)]
struct Chosen;

/// The plan takes the directions nearest to the guess, with which the dyad does not close.
#[test]
fn a_group_that_does_not_close_may_close_with_another_choice() {
    for guess in [0.0, 3.0] {
        let all = Chosen.solver().with_guess(2, guess).assemblies(&Instant::at(0.0)).unwrap();
        assert!(all.is_complete() && all.found.len() == 4, "{all}");
        let ranges = Chosen.solver().with_guess(2, guess).ranges(&Instant::at(0.0), 1.0).unwrap();
        assert!(ranges.is_complete() && closures(&ranges, 0.5) == 4, "{ranges}");
    }
}

/// An angle that occurs as its multiple only, and a length that is its cosine.
#[mechanism]
#[body(a, x = 0, y = 0)]
#[coordinates(s)]
#[constraint(c: cos(2*a.phi) = s)]
#[driver(d: s = t)]
struct Double;

/// At t = −2 there is no closure that could show the choices.
#[test]
fn ranges_may_begin_where_nothing_closes() {
    let all = Double.solver().ranges(&Instant::at(-2.0), 0.9).unwrap();
    assert!(all.is_complete() && all.limits.len() == 4, "{all}");
    assert_eq!([-1.5, -0.5, 0.5].map(|t| closures(&all, t)), [0, 4, 4], "{all}");
}

/// No margin shows that a root has no value.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[driver(d: a.x = sqrt(t))]
struct Root;

#[test]
fn a_formula_without_a_value_has_no_range_and_no_closure() {
    let all: Ranges = Root.solver().ranges(&Instant::at(-1.0), 1.0).unwrap();
    assert!(!all.is_complete() && [-0.9, -0.01, 0.01, 0.9].map(|t| closures(&all, t)) == [0, 0, 1, 1], "{all}");
    let refused = Root.solver().assemblies(&Instant::at(-1.0)).unwrap_err();
    assert!(matches!(refused, SolveError::NonFinite { what: "Φ", name: "d", .. }), "{refused:?}");
    assert!(Root.solver().assemblies(&Instant::at(1.0)).unwrap().is_complete());
}

/// A crank whose direction, an angle in (−π, π], moves a slider; a dyad closes if the slider is between 2 and 4.
#[mechanism]
#[bodies(crank, link)]
#[body(slider, y = 0, phi = 0)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[point(A = crank @ (1, 0))]
#[driver(d: crank.phi = t)]
#[constraint(c: u = atan2(A.y, A.x))]
#[constraint(e: slider.x = u)]
#[revolute(P: ground @ (5, 0), link @ (0, 0))]
#[distance(D: link @ (2, 0), slider @ (0, 0), length = 1)]
struct Jump;

/// Half a turn later the direction jumps by a whole turn. The limit is no dead centre at which two ranges meet.
#[test]
fn a_range_ends_where_the_direction_of_a_vector_jumps() {
    let all = Jump.solver().ranges(&Instant::at(2.5), 4.0).unwrap();
    assert!(Jump.solver().state(&Instant::at(3.2)).is_err());
    assert_eq!([2.6, 3.1, 3.2, 3.9].map(|t| closures(&all, t)), [2, 2, 0, 0], "{all}");
    assert!(all.ranges.iter().all(|range| (range.to - PI).abs() < 1e-6), "{all}");
    assert!(all.circuits == 2 && all.limits.iter().all(|limit| limit.kind != Some(LimitKind::DeadCentre)), "{all}");
}

/// The equation repeats after two turns of p; at p = 0 and p = 2π its values are the same.
#[mechanism]
#[coordinates(p, s)]
#[constraint(c: sin(p/2) + 0.3*sin(p) = s)]
#[driver(d: s = t)]
struct Half;

#[test]
fn an_angle_counts_as_repeating_only_if_its_equations_do_everywhere() {
    let all = Half.solver().ranges(&Instant::at(0.5), 1.12).unwrap();
    let [("p", within)] = all.searched[..] else { panic!("{all}") };
    let closures_at = |t: f64| {
        let miss = |k: u32| {
            let p = within.lower() + (within.upper() - within.lower()) * f64::from(k) / 100_000.0;
            (0.5 * p).sin() + 0.3 * p.sin() - t
        };
        (0..100_000).filter(|&k| miss(k) * miss(k + 1) < 0.0).count()
    };
    for t in [0.51, 0.9, 1.1] {
        assert_eq!(closures(&all, t), closures_at(t), "{t}: {all}");
    }
}

/// The stroke of a cylinder, whose equation has no closed form.
#[mechanism]
#[coordinates(s, r)]
#[constraint(c: s*sqrt(s*s + l*l) + l*l*exp(s/l/1000) = 10000*l*l)]
#[constraint(e: r = s + l)]
#[guess(s = 90)]
struct Stroke {
    #[param(1.0)]
    l: f64,
}

/// It is 10 away from its guess, and no angle.
#[test]
fn a_scalar_that_is_no_angle_is_searched_as_a_length() {
    let all = Stroke { l: 1.0 }.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 1 && (all.found[0].q[0] - 100.0).abs() < 0.1, "{all}");
    assert!(all.to_string().starts_with("1 closure, all there are, with s from "), "{all}");
}

/// A rod whose length is negative around t = 0.
#[mechanism]
#[body(s, y = 0, phi = 0)]
#[distance(D: ground @ (0.5, 0), s @ (0, 0), length = t*t - 0.1)]
#[guess(s.x = 1)]
struct Negative;

#[test]
fn no_range_has_a_negative_length() {
    let refused = Negative.solver().ranges(&Instant::at(-1.0), 1.0).unwrap_err();
    assert!(matches!(refused, SolveError::DegenerateGeometry { joint: "D", .. }), "{refused:?}");
    assert!(Negative.solver().ranges(&Instant::at(-1.0), -0.4).unwrap().is_complete());
}

/// A rod whose length changes with time as much as with its input.
#[mechanism]
#[body(s, y = 0, phi = 0)]
#[input(u)]
#[distance(D: ground @ (0.5, 0), s @ (0, 0), length = u - t)]
#[guess(s.x = 1)]
struct Kept;

/// Its length is that of the inputs at each time, and the error tells the time.
#[test]
fn lengths_in_a_range_are_those_of_the_moving_inputs() {
    let ranges = |value: f64| {
        let inputs = [Signal::new(value, 1.0, 0.0)];
        Kept.solver().ranges(&Instant { t: 0.0, inputs: &inputs }, 30.0)
    };
    let all = ranges(0.9).unwrap();
    assert!(all.is_complete() && all.ranges.len() == 2 && all.limits.is_empty(), "{all}");
    let refused = ranges(-0.9).unwrap_err();
    assert!(matches!(refused, SolveError::DegenerateGeometry { joint: "D", t: 0.0, .. }), "{refused:?}");
}

/// Closures and ranges name it, and do not merely prove nothing.
#[test]
fn a_guess_that_is_no_number_is_named() {
    let solver = Chosen.solver().with_guess(2, f64::NAN);
    let at = Instant::at(0.0);
    for error in [
        solver.assemblies(&at).unwrap_err(),
        solver.ranges(&at, 1.0).unwrap_err(),
        solver.cross_check(&Default::default()).unwrap_err(),
    ] {
        assert!(matches!(error, SolveError::NonFinite { what: "guess", name: "a.phi", .. }), "{error:?}");
    }
    let refused = Chosen.solver().ranges(&at, f64::INFINITY).unwrap_err();
    assert!(matches!(refused, SolveError::NonFinite { what: "t", .. }), "{refused:?}");
}

/// A driver that a supplied function prescribes.
#[mechanism]
#[bodies(crank)]
#[function(f)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = f(t))]
struct Supplied {
    f: Polynomial<[f64; 2]>,
}

#[test]
fn nothing_is_proven_over_an_interval_of_a_supplied_function() {
    let refused = Supplied { f: Polynomial([0.1, 1.0]) }.solver().ranges(&Instant::at(0.0), 2.0).unwrap_err();
    let why = Uncertified::Unbounded { row: "drive" };
    assert!(matches!(&refused, SolveError::NotCertified { why: found, .. } if *found == why), "{refused:?}");
}

/// A height that is given twice, and rounded in two ways: 0.1 + 0.2 is not 0.3 in binary numbers.
#[mechanism(allow_redundant)]
#[bodies(s)]
#[x(A: s @ (0, 0) = 1 + t)]
#[y(B: s @ (0, 0) = 0.1 + 0.2)]
#[y(C: s @ (0, 0) = 0.3)]
#[angle(D: s = 0)]
struct Twice;

#[test]
fn a_rounding_error_violates_no_redundant_row() {
    let all = Twice.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 1, "{all}");
    assert!(Twice.solver().certify(&Twice.solver().state(&Instant::at(0.0)).unwrap()).is_ok());
}

/// A slider on a line, and a second line that crosses it at x = 1 for a height of 0.5.
#[mechanism(allow_redundant)]
#[body(s, phi = 0)]
#[x(A: s @ (0, 0) = 1)]
#[y(B: s @ (0, 0) = 0.5)]
#[constraint(C: s.x = 2*h)]
struct Crossed {
    #[param(0.5)]
    h: f64,
}

/// The rows that a certificate leaves out have to hold, too.
#[test]
fn a_state_that_violates_a_redundant_row_has_no_certificate() {
    let state = Crossed { h: 0.5 }.solver().state(&Instant::at(0.0)).unwrap();
    let certificate = Crossed { h: 0.5 }.solver().certify(&state).unwrap();
    assert_eq!(certificate.left_out.len(), 1);
    let refused = Crossed { h: 0.6 }.solver().certify(&state).unwrap_err();
    assert!(matches!(refused, Uncertified::Violated { .. }), "{refused}");
    assert!(refused.to_string().contains("is no solution"), "{refused}");
}

/// The drive of a curve that repeats after two turns of p; after one turn it is at the same place, on another way.
#[test]
fn a_curve_closes_in_the_direction_in_which_it_began() {
    let all = Half.solver().sweep_along_arc(0.0, None, 8).unwrap();
    assert!(all.arc.as_ref().is_some_and(kin_runtime::SolutionArc::is_closed));
    let last = &all.states[8].q;
    assert!((last[0] - 4.0 * PI).abs() < 1e-6 && last[1].abs() < 1e-6, "{last:?}");
}

/// Three legs that hold a platform.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3), 0.5*sin(2*pi*i/3)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.3, 0), platform @ (0.25*cos(2*pi*i/3), 0.25*sin(2*pi*i/3)))]
#[driver(a: crank[0].phi = 3 + t)]
#[driver(b: crank[1].phi = 5.2)]
#[driver(c: crank[2].phi = 0.9)]
struct Legs;

#[test]
fn a_single_instant_has_the_ranges_of_its_closures() {
    let at = Instant::at(0.1);
    let (all, ranges) = (Legs.solver().assemblies(&at).unwrap(), Legs.solver().ranges(&at, 0.1).unwrap());
    assert!(all.is_complete() && ranges.is_complete(), "{all}\n{ranges}");
    assert!(!all.found.is_empty() && closures(&ranges, 0.1) == all.found.len(), "{all}\n{ranges}");
}

/// An angle in degrees that no closed form gives, and a crank whose angle is in degrees.
#[mechanism]
#[coordinates(phi, unit = "deg")]
#[constraint(c: cos(phi*pi/180) + 0.1*sin(2*phi*pi/180) = 0.3)]
#[guess(phi = 10)]
struct Degrees;

#[mechanism]
#[coordinates(phi, unit = "deg")]
#[coordinates(x)]
#[constraint(c: x = cos(phi*pi/180))]
#[driver(d: phi = 360*t)]
struct CrankInDegrees;

/// A turn is 360 there: closures are searched within half of it, and a curve closes after it.
#[test]
fn a_turn_of_an_angle_in_degrees_is_360() {
    let all = Degrees.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 2, "{all}");
    let ranges = Degrees.solver().ranges(&Instant::at(0.0), 1.0).unwrap();
    assert!(ranges.is_complete() && ranges.searched.is_empty() && closures(&ranges, 0.5) == 2, "{ranges}");
    let arc = CrankInDegrees.solver().sweep_along_arc(0.0, None, 4).unwrap();
    assert!(arc.arc.as_ref().is_some_and(kin_runtime::SolutionArc::is_closed));
    assert!((arc.states[4].q[0] - 360.0).abs() < 1e-6, "{:?}", arc.states[4].q);
}
