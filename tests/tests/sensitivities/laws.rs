//! Properties of sensitivities, over all test mechanisms: they equal the finite differences of motions solved with a
//! changed parameter; parameters on which a solution does not depend differentiably are refused.

use crate::batches::are_those_of_the_state;
use crate::varied::Varied;
use kin_runtime::model::{Level, Model};
use kin_runtime::{Instant, Kinematics, Measure, Options, SolveError, State};
use kin_tests::compare::{Differences, largest};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::{loaded, *};
use kin_tests::random::Random;

/// The tolerance, relative to the derivative, or to the quantity divided by the parameter's size.
const CLOSE: f64 = 1e-6;
/// The step of the finite differences relative to the parameter's size.
const STEP: f64 = 2e-4;

/// Everything that is compared: q, q̇, q̈ and the points' motions, each list with the size its tolerance is relative
/// to.
fn lists(q: [&[f64]; 3], points: &[kin_runtime::PointMotion]) -> Vec<Vec<f64>> {
    let of = |part: fn(&kin_runtime::PointMotion) -> [f64; 2]| points.iter().flat_map(part).collect::<Vec<f64>>();
    let mut all: Vec<Vec<f64>> = q.into_iter().map(<[f64]>::to_vec).collect();
    all.extend([of(|p| p.r), of(|p| p.v), of(|p| p.a)]);
    all
}

fn of_state(state: &State) -> Vec<Vec<f64>> {
    lists([&state.q, &state.q_dot, &state.q_ddot], &state.points)
}

fn force_numbers(forces: &kin_runtime::Forces) -> Vec<f64> {
    let efforts = forces.efforts.iter().map(|effort| effort.effort.unwrap_or(0.0));
    let reactions = forces.reactions.iter().flat_map(|reaction| {
        let [x, y] = reaction.force.unwrap_or([0.0; 2]);
        let moments = reaction.moment.into_iter().chain(reaction.couples.iter().map(|(_, couple)| *couple));
        [x, y].into_iter().chain(moments).chain(reaction.generalized.iter().copied())
    });
    let total = [forces.kinetic, forces.gravity, forces.elastic, forces.driver_power, forces.shaking.moment];
    efforts.chain(reactions).chain(total).collect()
}

/// Quantities that are functions of those that are reported: transmission angles, speeds, and magnitudes of forces.
fn derived(model: &'static Model) -> Vec<Measure> {
    let is_derived =
        |name: &str| name.contains(".transmission") || name.ends_with(".speed") || name.ends_with(".force");
    Measure::all(model).into_iter().filter(|measure| is_derived(measure.name())).collect()
}

/// The derivatives equal the finite differences of solutions with the parameter changed.
fn are_derivatives(mechanism: &dyn Varied, from: f64, to: f64) {
    let (model, parameters) = (mechanism.model(), mechanism.parameters());
    let mut differences = Differences::new();
    for share in [0.31, 0.77] {
        let t = from + share * (to - from);
        let trajectory = mechanism.sweep(&[from, t]);
        let state = trajectory.states.last().unwrap();
        let found = match mechanism.sensitivities(state, Options::default()) {
            Ok(found) => found,
            Err(error) => return refused(mechanism, state, &error),
        };
        let whole = Options { use_plan: false, ..Options::default() };
        let by_rows = mechanism.sensitivities(state, whole).unwrap();
        let (derived, all) = (derived(model), (0..parameters.len()).collect::<Vec<usize>>());
        let derived_by = mechanism.measure_sensitivities(state, &derived, &all);
        backwards_is_forwards(mechanism, state);
        are_those_of_the_state(mechanism, state);
        for (index, &value) in parameters.iter().enumerate() {
            let (by, by_rows) = (&found.by[index], &by_rows.by[index]);
            let step = STEP * value.abs().max(0.05);
            let at = |k: f64| {
                let changed = mechanism.with_parameter(index, value + k * step);
                let inputs = changed.signals(t);
                let state = changed.state_from(&Instant { t, inputs: &inputs }, &state.q).unwrap();
                let mut all = of_state(&state);
                // The driving efforts and joint forces.
                all.push(changed.forces(&state).map_or(Vec::new(), |forces| force_numbers(&forces)));
                let values = changed.measure(&state, &derived);
                all.extend(values.into_iter().map(|value| vec![value]));
                all
            };
            let samples = [-2.0, -1.0, 1.0, 2.0].map(at);
            let mut exact = lists([&by.q, &by.q_dot, &by.q_ddot], &by.points);
            exact.push(by.forces.as_ref().map_or(Vec::new(), force_numbers));
            let mut second = lists([&by_rows.q, &by_rows.q_dot, &by_rows.q_ddot], &by_rows.points);
            second.push(by_rows.forces.as_ref().map_or(Vec::new(), force_numbers));
            let slopes = || derived_by.iter().map(|by| vec![by[index]]);
            exact.extend(slopes());
            second.extend(slopes());
            differences.at(format_args!("{} at t = {t}, by {}", model.name, by.parameter));
            for (list, (exact, second)) in exact.iter().zip(&second).enumerate() {
                let [a, b, c, d] = samples.each_ref().map(|sample| &sample[list]);
                // What has no value has no derivative: a force that redundancy leaves open, the magnitude of none.
                if exact.iter().any(|exact| exact.is_nan()) {
                    let at_rest = |sample: &Vec<f64>| sample.iter().all(|x| x.is_nan() || x.abs() < 1e-9);
                    assert!(at_rest(a) && at_rest(b) && at_rest(c) && at_rest(d), "{list}: {a:?}");
                    continue;
                }
                let quotient = |k: usize| (8.0 * (c[k] - b[k]) - (d[k] - a[k])) / (12.0 * step);
                let quotients: Vec<f64> = (0..a.len()).map(quotient).collect();
                let size = largest(&quotients).max(largest(a) / value.abs().max(0.05)).max(1e-3);
                differences.vector("derivative", |k| format!("{list}[{k}]"), &quotients, exact, CLOSE * size);
                differences.vector("derivative by all rows", |k| format!("{list}[{k}]"), exact, second, 1e-9 * size);
            }
        }
    }
    if !parameters.is_empty() {
        differences.finish();
    }
}

/// The gradient of a weighted sum of quantities is the weighted sum of their derivatives.
fn backwards_is_forwards(mechanism: &dyn Varied, state: &State) {
    let model = mechanism.model();
    let all = (0..model.parameters.len()).collect::<Vec<usize>>();
    let measures = Measure::all(model);
    let by = mechanism.measure_sensitivities(state, &measures, &all);
    let mut random = Random::new(41);
    // What has no derivative has no weight.
    let known = |by: &Vec<f64>| by.iter().all(|by| by.is_finite());
    let weights: Vec<f64> = by.iter().map(|by| if known(by) { random.between(-1.0, 1.0) } else { 0.0 }).collect();
    let found = mechanism.gradient(state, &measures, &weights).unwrap();
    for (k, found) in found.into_iter().enumerate() {
        let terms = || by.iter().zip(&weights).filter(|(_, weight)| **weight != 0.0).map(|(by, weight)| by[k] * weight);
        let (exact, size) = (terms().sum::<f64>(), terms().fold(1.0, |size: f64, term| size.max(term.abs())));
        assert!((found - exact).abs() <= 1e-9 * size, "{}: {found} instead of {exact}", model.name);
    }
    assert!(mechanism.gradient(state, &measures, &weights[1..]).is_err());
}

/// Where sensitivities do not exist, the error gives the reason.
fn refused(mechanism: &dyn Varied, state: &State, error: &SolveError) {
    let model = mechanism.model();
    match error {
        SolveError::NotDetermined { open: 0, .. } => {
            assert!(model.rows.iter().any(|row| row.level == Level::Velocity));
        }
        SolveError::NotDetermined { open, could_be_given, .. } => {
            assert_eq!(*open, state.degrees_of_freedom_left);
            assert!(!could_be_given.is_empty(), "{error}");
        }
        // The loop closes for equal cranks only.
        SolveError::NoSensitivity { parameter, row_name: Some(_), .. } => {
            let index = model.parameters.iter().position(|info| info.name == *parameter).unwrap();
            let value = mechanism.parameters()[index];
            let changed = mechanism.with_parameter(index, 1.001 * value);
            assert!(changed.state_from(&state.instant(), &state.q).is_err(), "{error}");
        }
        SolveError::NoSensitivity { row_name: None, .. } => assert!(!model.functions.is_empty(), "{error}"),
        other => panic!("{other}"),
    }
}

macro_rules! law_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(#[test]
        fn $moving() {
            are_derivatives(&$Moving::default(), $from, $to);
        })*
    };
}

every_mechanism!(law_tests);

macro_rules! of_forces {
    ($($name:ident: $Mechanism:ident;)*) => {
        mod forces {
            use super::*;

            $(#[test]
            fn $name() {
                are_derivatives(&loaded::$Mechanism::default(), 0.0, 1.0);
            })*
        }
    };
}

of_forces! {
    fourbar_lecture_mid: FourbarLectureMid;
    fourbar_lecture_angles: FourbarLectureAngles;
    bogie_on_rail: BogieOnRail;
    cam_oscillating_follower: CamOscillatingFollower;
    planetary_basic: PlanetaryBasic;
    quick_return: QuickReturn;
    rack_pinion_slider: RackPinionSlider;
    slider_crank_inline: SliderCrankInline;
}

#[test]
fn parameters_that_do_not_exist_are_errors() {
    let mechanism = FourbarLectureMid::default();
    let solver = mechanism.solver();
    let state = solver.state(&0.0.into()).unwrap();
    assert_eq!(Err(SolveError::UnknownParameter { index: 6, parameters: 6 }), solver.sensitivities_by(&state, &[0, 6]));
    let some = solver.sensitivities_by(&state, &[2]).unwrap();
    assert_eq!(vec!["l3"], some.by.iter().map(|by| by.parameter).collect::<Vec<_>>());
    assert_eq!(some["l3"], solver.sensitivities(&state).unwrap()["l3"]);
    assert_eq!(Ok(vec![some]), solver.sensitivities_along(std::slice::from_ref(&state), &[2]));
}

/// A slider-crank: x = r cos φ + √(l² − r² sin² φ), which is singular where the root is 0.
#[kin_runtime::mechanism]
#[body(crank, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[distance(rod: crank @ (r, 0), slider @ (0, 0), length = l)]
#[driver(drive: crank.phi = t)]
#[guess(slider.x = r + l)]
struct SliderCrank {
    #[param(1.0)]
    r: f64,
    #[param(1.5)]
    l: f64,
}

/// Beside a dead centre a derivative is as exact as the position is there, or it is refused.
#[test]
fn derivatives_beside_a_dead_centre_are_right_or_refused() {
    let (t, mut right) = (1.2_f64, 0);
    for k in 1..=16 {
        // The root is this share of l.
        let w = 10_f64.powf(-0.5 * f64::from(k));
        let l = t.sin() / (1.0 - w * w).sqrt();
        let mechanism = SliderCrank { r: 1.0, l };
        let solver = mechanism.solver();
        let Ok(state) = solver.state(&t.into()) else { continue };
        let Ok(by) = solver.sensitivities(&state) else { continue };
        right += 1;
        let found = [by["l"].q[1], by["r"].q[1]];
        let exact = [1.0 / w, t.cos() - t.sin() * t.sin() / (l * w)];
        for (found, exact) in found.into_iter().zip(exact) {
            let rounding = 1e-14 / (w * w);
            assert!((found - exact).abs() <= rounding * exact.abs(), "{found} instead of {exact} at {w}");
        }
    }
    assert!(right >= 4, "only {right} are there");
}
