//! Integrated motions whose error grows until it dominates the rates.

use super::{close, grid};
use kin_runtime::{Instant, Kinematics, Options, Refusal, SolveError, State, mechanism};

/// y = h √(1 − t²) ends at t = ±1. An error of y before grows as 1/y.
#[mechanism]
#[coordinates(y)]
#[nonholonomic(circle: y * dot(y) = -h * h * t)]
#[guess(y = h)]
struct Circle {
    h: f64,
}

/// The state at `t`, by a sweep in one step and by a tracker, which agree.
fn reached(circle: &Circle, t: f64) -> Result<State, SolveError> {
    let mut tracker = circle.solver().tracker(&Instant::at(0.0)).expect("it begins");
    let tracked = tracker.update(&Instant::at(t)).cloned();
    let swept = circle.kinematic_analysis(&[0.0, t]);
    assert_eq!(tracked.is_ok(), swept.is_ok(), "{t}");
    let state = swept.map_err(|error| error.source)?.states.swap_remove(1);
    close("the state of the tracker", state.q[0], tracked?.q[0], 1e-12 * circle.h);
    Ok(state)
}

#[test]
fn what_is_reached_before_a_square_root_ends_is_right() {
    for h in [1.0, 40.0] {
        for distance in [0.5, 1e-2, 1e-3, 1e-6, 1e-8] {
            for t in [1.0 - distance, distance - 1.0] {
                let state = reached(&Circle { h }, t).unwrap_or_else(|error| panic!("{h}, {t}: {error}"));
                let y = h * ((1.0 - t) * (1.0 + t)).sqrt();
                // An error of 1e-12 in y² is shared by all instants.
                close("y", y, state.q[0], 1e-11 / distance * y);
                close("y_dot", -h * h * t / y, state.q_dot[0], 1e-11 / distance * (h * h * t / y).abs());
            }
        }
    }
}

#[test]
fn where_a_square_root_ends_there_is_no_state() {
    for h in [1.0, 40.0] {
        for beyond in [-1e-12, 0.0, 1e-12, 1e-11, 1e-9, 1e-3, 1.0] {
            for t in [1.0 + beyond, -1.0 - beyond] {
                match reached(&Circle { h }, t) {
                    Err(SolveError::Singular { t: at, .. } | SolveError::StepRefused { t: at, .. }) => {
                        close("the end", t.signum(), at, 1e-8);
                    }
                    other => panic!("{h}, {t}: {other:?}"),
                }
            }
        }
        let ended = Circle { h }.kinematic_analysis(&grid(0.0, 1.0, 100)).expect_err("it ends at 1");
        assert_eq!(ended.trajectory.len(), 100, "{ended}");
    }
}

/// ẏ = ±(y − sin t): errors grow or decay as exp(±t). From y = ½ the motion is ½ (sin t + cos t) if they grow.
macro_rules! with_sign {
    ($name:ident: $($sign:tt)?) => {
        #[mechanism]
        #[coordinates(y)]
        #[nonholonomic(rate: dot(y) = $($sign)? (y - sin(t)))]
        #[guess(y = 0.5)]
        struct $name;
    };
}

with_sign!(Unstable: );
with_sign!(Stable: -);

#[test]
fn a_motion_ends_where_its_error_dominates_it() {
    let state = Unstable.kinematic_analysis(&[0.0, 10.0]).expect("it is known").states.swap_remove(1);
    close("y", 0.5 * (10.0_f64.sin() + 10.0_f64.cos()), state.q[0], 1e-6);
    for tolerance in [1e-12, 1e-9] {
        let options = Options { integration_tolerance: tolerance, ..Options::default() };
        let ended = Unstable.solver().with_options(options).sweep(&[0.0, 10.0, 60.0]).expect_err("it is unknown");
        assert_eq!(ended.trajectory.len(), 2, "{ended}");
        let SolveError::StepRefused { t, reason: Refusal::GlobalError, .. } = ended.source else { panic!("{ended}") };
        // There the error is e^t tolerances.
        assert!((-tolerance.ln() - 12.0..-tolerance.ln()).contains(&t), "{tolerance:e}: {t}");
    }
    // It lasts as long as wanted where errors decay.
    let state = Stable.kinematic_analysis(&[0.0, 1000.0]).expect("it is known").states.swap_remove(1);
    close("y", 0.5 * (1000.0_f64.sin() - 1000.0_f64.cos()), state.q[0], 1e-9);
}

/// Both solutions of sin y = ½, at which y rests; rates there are rounding.
#[mechanism]
#[coordinates(y)]
#[nonholonomic(rate: dot(y) = sin(y) - 0.5)]
#[guess(y = start)]
struct Resting {
    start: f64,
}

#[test]
fn a_motion_may_rest() {
    let unstable = 0.5_f64.asin();
    for start in [unstable, std::f64::consts::PI - unstable] {
        let rested = Resting { start }.kinematic_analysis(&grid(0.0, 10.0, 20));
        let states = rested.unwrap_or_else(|error| panic!("{start}: {error}")).states;
        close("y", start, states[20].q[0], 1e-9);
    }
}
