//! NaN, infinity and wrong lengths in arguments cause an error in every analysis.

use crate::When;
use kin_runtime::{Instant, LengthError, Options, Signal, SolveError, State};
use kin_tests::subject::{Setup, Subject};
use std::fmt::Debug;

/// NaN or infinity in time, q, q̇, guesses or parameters.
pub(crate) fn nothing_comes_of_what_is_not_finite(mechanism: &dyn Subject, t: f64) {
    let model = mechanism.model();
    let good = mechanism.state_at(&When::of(mechanism, t).at()).unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        at_a_bad_time(mechanism, &good, bad);
        for place in [0, model.coordinates.len() / 2, model.coordinates.len() - 1] {
            with_a_bad_coordinate(mechanism, &good, place, bad);
        }
        for parameter in 0..model.parameters.len() {
            let mut broken = mechanism.anew();
            assert!(broken.set_parameter(parameter, bad), "{}", model.parameters[parameter].name);
            let at = good.instant();
            refused("state with a bad parameter", broken.state_at(&at));
            refused("position with a bad parameter", broken.position_analysis(&at, &good.q));
            refused("velocity with a bad parameter", broken.velocity_analysis(&at, &good.q));
            refused("acceleration with a bad parameter", broken.acceleration_analysis(&at, &good.q, &good.q_dot));
            refused("mobility with a bad parameter", broken.mobility(&at, &good.q));
        }
    }
}

fn at_a_bad_time(mechanism: &dyn Subject, good: &State, bad: f64) {
    let at = Instant { t: bad, inputs: &good.inputs };
    let solver = mechanism.driven(Options::default());
    refused("state", solver.state(&at));
    refused("assemble", solver.assemble(&at));
    refused("position", solver.position(&at, &good.q));
    refused("velocity", solver.velocity(&at, &good.q));
    refused("acceleration", solver.acceleration(&at, &good.q, &good.q_dot));
    refused("mobility", solver.mobility(&at, &good.q));
    refused("transmission angles", solver.transmission_angles(&at, &good.q));
    refused("motion", solver.motion(&State { t: bad, ..good.clone() }));
    refused("velocity ratios", solver.velocity_ratios(&State { t: bad, ..good.clone() }));
    for times in [&[bad][..], &[good.t, bad], &[bad, good.t]] {
        refused("sweep", solver.sweep(times).map_err(|error| error.source));
        refused("sweep_from", solver.sweep_from(&good.q, times).map_err(|error| error.source));
    }
}

fn with_a_bad_coordinate(mechanism: &dyn Subject, good: &State, place: usize, bad: f64) {
    let at = good.instant();
    let solver = mechanism.solver();
    let mut q = good.q.clone();
    q[place] = bad;
    let mut q_dot = good.q_dot.clone();
    q_dot[place] = bad;
    refused("position", solver.position(&at, &q));
    refused("state_from", solver.state_from(&at, &q));
    refused("sweep_from", solver.sweep_from(&q, &[good.t]).map_err(|error| error.source));
    refused("velocity", solver.velocity(&at, &q));
    refused("acceleration", solver.acceleration(&at, &q, &good.q_dot));
    refused("acceleration, q_dot", solver.acceleration(&at, &good.q, &q_dot));
    refused("mobility", solver.mobility(&at, &q));
    refused("transmission angles", solver.transmission_angles(&at, &q));
    let guessed = mechanism.solver_with(Setup { guess: Some((place, bad)), ..Setup::default() });
    refused("guess", guessed.assemble(&at));
    refused("motion", solver.motion(&State { q: q.clone(), ..good.clone() }));
    refused("motion, q_dot", solver.motion(&State { q_dot: q_dot.clone(), ..good.clone() }));
    refused("velocity ratios", solver.velocity_ratios(&State { q, ..good.clone() }));
}

/// Asserts that the result is an error with a message.
fn refused<T: Debug>(what: &str, answer: Result<T, SolveError>) {
    match answer {
        Ok(answer) => panic!("{what} answered {answer:?}"),
        Err(error) => assert!(!error.to_string().is_empty(), "{what}"),
    }
}

/// Lists that are one element too short or too long, and inputs that the mechanism does not have.
pub(crate) fn wrong_lengths_are_errors(mechanism: &dyn Subject, t: f64) {
    let model = mechanism.model();
    let when = When::of(mechanism, t);
    let at = when.at();
    let solver = mechanism.driven(Options::default());
    wrong_inputs_are_named(mechanism, &when);
    let right = vec![0.1; model.coordinates.len()];
    for length in [0, model.coordinates.len() - 1, model.coordinates.len() + 1] {
        if length == model.coordinates.len() {
            continue;
        }
        let wrong = vec![0.1; length];
        let answers = [
            solver.position(&at, &wrong).map(|_| ()),
            solver.velocity(&at, &wrong).map(|_| ()),
            solver.acceleration(&at, &wrong, &right).map(|_| ()),
            solver.acceleration(&at, &right, &wrong).map(|_| ()),
            solver.state_from(&at, &wrong).map(|_| ()),
            solver.mobility(&at, &wrong).map(|_| ()),
            solver.sweep_from(&wrong, &[t]).map(|_| ()).map_err(|error| error.source),
        ];
        for (place, answer) in answers.into_iter().enumerate() {
            assert!(matches!(answer, Err(SolveError::Length(_))), "analysis {place}: {answer:?}");
        }
        assert!(mechanism.constraints(&at, &wrong).is_err());
        assert!(mechanism.gamma(&at, &right, &wrong).is_err());
    }
}

/// One input too many, one too few, and inputs that are not finite.
fn wrong_inputs_are_named(mechanism: &dyn Subject, when: &When) {
    let model = mechanism.model();
    let mut more = when.inputs.clone();
    more.push(Signal::default());
    for inputs in [&more[..], when.inputs.get(1..).unwrap_or(&more)] {
        let error = mechanism.state_at(&Instant { t: when.t, inputs }).unwrap_err();
        let right = LengthError { what: "inputs", expected: model.inputs.len(), found: inputs.len() };
        assert_eq!(SolveError::Length(right), error);
    }
    for (place, input) in model.inputs.iter().enumerate() {
        for part in 0..3 {
            let mut inputs = when.inputs.clone();
            let broken = &mut inputs[place];
            *[&mut broken.value, &mut broken.rate, &mut broken.acceleration][part] = f64::NAN;
            let error = mechanism.state_at(&Instant { t: when.t, inputs: &inputs }).unwrap_err();
            assert_eq!(SolveError::NonFinite { what: "inputs", index: place, name: input, t: None }, error);
        }
    }
}
