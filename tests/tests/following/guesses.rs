//! Partial guesses: which closure they mean, and that the plan solves from them. The plan leaves the condition of a
//! state open; full Newton computes it.

use kin_runtime::{Instant, Kinematics, Mechanism, Options, mechanism};
use kin_tests::mechanisms::RedundantParallelogram;

/// A crank, a rod and a slider, of which only the slider's position is guessed. The angle of the rod closes the group,
/// and the position follows from it.
#[mechanism]
#[bodies(crank, rod)]
#[body(slider, y = 0.02, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.4, 0), slider @ (0, 0))]
#[driver(drive: crank.phi = 0.3 + 2 * t)]
struct SliderCrank;

#[test]
fn a_position_that_follows_from_a_closure_determines_it() {
    let slider = SliderCrank::model().coordinate("slider.x").unwrap();
    for k in 0..=40 {
        let at = Instant::at(0.15 * f64::from(k));
        let [sine, cosine] = [(0.3 + 2.0 * at.t).sin(), (0.3 + 2.0 * at.t).cos()];
        let reach = (0.16 - (0.1 * sine - 0.02_f64).powi(2)).sqrt();
        for side in [1.0, -1.0] {
            let state = SliderCrank.solver().with_guess(slider, 0.3 * side).state(&at).unwrap();
            assert!(state.condition.is_none(), "{side} at {}: full Newton took over", at.t);
            assert!((state.q[slider] - (0.1 * cosine + side * reach)).abs() < 1e-12, "{side} at {}", at.t);
        }
    }
}

/// A lever that a link pulls along a guide; the guess of the slider's height is exactly 0.
#[mechanism]
#[bodies(lever)]
#[body(ram, x = 0.3, phi = 0)]
#[revolute(O: ground @ (0, 0.5), lever @ (0, 0))]
#[distance(link: lever @ (0.25, 0), ram @ (0, 0), length = 0.4)]
#[driver(drive: lever.phi = -0.5 + 0.2 * sin(t))]
#[guess(ram.y = 0)]
struct Press;

#[test]
fn a_guess_of_zero_means_the_nearer_closure() {
    for k in 0..=20 {
        let at = Instant::at(0.3 * f64::from(k));
        let state = Press.state_at(&at).unwrap();
        assert!(state.condition.is_none(), "full Newton took over at {}", at.t);
        let angle = -0.5 + 0.2 * at.t.sin();
        let [x, y] = [0.25 * angle.cos(), 0.5 + 0.25 * angle.sin()];
        // The other closure is above the lever.
        let lower = y - (0.16 - (0.3 - x) * (0.3 - x)).sqrt();
        assert!((state.q[Press::model().coordinate("ram.y").unwrap()] - lower).abs() < 1e-12);
    }
}

/// Rows that the plan leaves out are checked in a position analysis, too, and need no full Newton.
#[test]
fn a_position_with_redundant_rows_is_found_by_the_plan() {
    let mechanism = RedundantParallelogram::default();
    let start = mechanism.state_at(&Instant::at(0.0)).unwrap().q;
    for k in 1..=10 {
        let at = Instant::at(0.01 * f64::from(k));
        let by_plan = mechanism.solver().position(&at, &start).unwrap();
        let newton = Options { use_plan: false, ..Options::default() };
        let by_newton = mechanism.solver().with_options(newton).position(&at, &start).unwrap();
        assert!(by_plan.iterations == 1 && by_newton.iterations > 1, "{by_plan}; {by_newton}");
        assert!(by_plan.q.iter().zip(&by_newton.q).all(|(q, other)| (q - other).abs() < 1e-12), "{by_plan}");
    }
}
