//! The ranges of inputs in which a mechanism closes, compared with closed forms and with a fine search by the follower.

use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Signal, mechanism};
use kin_tests::mechanisms::{MeasuredExcavator, signals};

/// A platform on three cylinders, which closes by iteration only.
#[mechanism]
#[bodies(platform)]
#[input(first, default = 1.0)]
#[input(second, default = 1.1)]
#[input(third, default = 1.2)]
#[distance(leg_1: ground @ (0, 0), platform @ (-0.3, -0.2), length = first)]
#[distance(leg_2: ground @ (1.6, 0), platform @ (0.3, -0.2), length = second)]
#[distance(leg_3: ground @ (0.2, 1.9), platform @ (0, 0.35), length = third)]
#[guess(platform.x = 0.8, platform.y = 0.7, platform.phi = 0.1)]
struct Platform;

/// A crank-rocker whose crank is an input.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[input(angle)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0), rocker @ (0, 0))]
#[driver(turn: crank.phi = angle)]
#[guess(coupler.phi = 0.9, rocker.phi = 2)]
struct Bars {
    #[param(0.1)]
    l1: f64,
}

/// A boom that a cylinder raises.
#[mechanism]
#[bodies(boom)]
#[input(ram, unit = "m")]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (1, 0), boom @ (l, 0), length = ram)]
#[guess(boom.phi = 1)]
struct Raised {
    #[param(0.4, unit = "m")]
    l: f64,
}

/// A row with the square of a length does not tell how to change a length of 0, and is satisfied by −0.6, too.
#[test]
fn possible_lengths_are_positive_and_have_a_unit() {
    let raised = Raised::default();
    for asked in [0.0, 1e-6, 0.3, 5.0] {
        let inputs = constant(&[asked]);
        let why = raised.solver().out_of_range(&Instant { t: 0.0, inputs: &inputs }).expect("the input is the cause");
        assert!((why.range.least - 0.6).abs() < 1e-12 && (why.range.greatest - 1.4).abs() < 1e-12, "{asked}: {why}");
        assert_eq!(
            format!("input ram = {asked} m: the mechanism cannot close; possible values here: 0.6 to 1.4 m"),
            why.to_string()
        );
        assert_eq!("ram from 0.6 to 1.4 m", why.range.to_string());
    }
}

fn constant(values: &[f64]) -> Vec<Signal> {
    values.iter().map(|value| Signal::constant(*value)).collect()
}

/// The last value of an input, in steps that are halved, that the follower can take.
fn searched<M: Mechanism>(start: &Planned<'_, M>, values: &[f64], input: usize, mut step: f64) -> f64 {
    let inputs = constant(values);
    let at = Instant { t: 0.0, inputs: &inputs };
    let mut planned = Planned::new(start.mechanism(), &at, start.q()).expect("it closes");
    let mut values = values.to_vec();
    while step.abs() > 1e-9 {
        values[input] += step;
        let inputs = constant(&values);
        if planned.at(&Instant { t: 0.0, inputs: &inputs }).is_err() {
            values[input] -= step;
            step *= 0.5;
        }
    }
    values[input]
}

#[test]
fn the_cylinders_of_an_excavator_have_the_ranges_of_their_triangles() {
    let excavator = MeasuredExcavator;
    let inputs: Vec<Signal> =
        signals::<MeasuredExcavator>(0.0).into_iter().map(|u| Signal::constant(u.value)).collect();
    let values: Vec<f64> = inputs.iter().map(|u| u.value).collect();
    let planned = excavator.solver().planned(&Instant { t: 0.0, inputs: &inputs }).expect("it closes");
    let boom = planned.range_of(MeasuredExcavator::boom_length).expect("its own input");
    let [a, b] = [0.45_f64.hypot(0.25), 1.4_f64.hypot(0.35)];
    assert!((boom.least - (b - a)).abs() < 1e-12 && (boom.greatest - (a + b)).abs() < 1e-12, "{boom}");
    let joints: Vec<&str> = boom.limits[1].expect("a limit").joints().collect();
    assert_eq!(joints, ["O", "cyl_boom"]);
    // The bucket's own dyad ends before the triangle of its cylinder does.
    for input in [MeasuredExcavator::stick_length, MeasuredExcavator::bucket_length] {
        let range = planned.range_of(input).expect("its own input");
        let [least, greatest] = [-0.01, 0.01].map(|step| searched(&planned, &values, input.0, step));
        assert!(
            (range.least - least).abs() < 1e-6 && (range.greatest - greatest).abs() < 1e-6,
            "{range}: {least}, {greatest}"
        );
        assert!(range.contains(values[input.0]) && !range.contains(9.0));
    }
    assert_eq!(planned.q(), excavator.solver().planned(&Instant { t: 0.0, inputs: &inputs }).expect("it closes").q());
}

#[test]
fn a_platform_that_closes_by_iteration_has_ranges_too() {
    let values = [1.0, 1.1, 1.2];
    let inputs = constant(&values);
    let planned = Platform.solver().planned(&Instant { t: 0.0, inputs: &inputs }).expect("it closes");
    for input in [Platform::first, Platform::second, Platform::third] {
        let range = planned.range_of(input).expect("its own input");
        let [least, greatest] = [-0.01, 0.01].map(|step| searched(&planned, &values, input.0, step));
        assert!(
            (range.least - least).abs() < 1e-6 && (range.greatest - greatest).abs() < 1e-6,
            "{range}: {least}, {greatest}"
        );
    }
}

#[test]
fn an_angle_that_turns_fully_has_no_limits_and_one_that_does_not_has_two() {
    let inputs = constant(&[0.4]);
    let at = Instant { t: 0.0, inputs: &inputs };
    let range = Bars::default().solver().range_of(&at, Bars::angle).expect("it closes");
    assert_eq!([range.least, range.greatest], [f64::NEG_INFINITY, f64::INFINITY]);
    assert_eq!(range.to_string(), "angle unlimited");
    let rocking = Bars { l1: 0.6 };
    let inputs = constant(&[0.8]);
    let range = rocking.solver().range_of(&Instant { t: 0.0, inputs: &inputs }, Bars::angle).expect("it closes");
    // From where coupler and rocker are folded to where they are stretched.
    let at = |reach: f64| ((0.36 + 0.16 - reach * reach) / (2.0 * 0.6 * 0.4_f64)).acos();
    let folded = if 0.6 - 0.4 > 0.1 { f64::NAN } else { at(0.1) };
    assert!(folded.is_nan(), "the crank's end never comes so near to D");
    assert!((range.greatest - at(0.7)).abs() < 1e-9 && (range.least + at(0.7)).abs() < 1e-9, "{range}");
}

#[test]
fn a_broken_sensor_is_named_with_what_it_can_be() {
    let excavator = MeasuredExcavator;
    let mut inputs: Vec<Signal> = signals::<MeasuredExcavator>(0.0);
    let mut planned = excavator.solver().planned(&Instant { t: 0.0, inputs: &inputs }).expect("it closes");
    // A tick in which all have moved a little, and the boom's sensor is broken.
    inputs.iter_mut().for_each(|u| *u = Signal::constant(u.value + 1e-4));
    inputs[MeasuredExcavator::boom_length.0] = Signal::constant(9.0);
    let tick = Instant { t: 0.001, inputs: &inputs };
    assert!(planned.at(&tick).is_err());
    let why = planned.out_of_range(&tick).expect("an input is to blame");
    assert_eq!(
        why.to_string(),
        "input boom_length = 9: the mechanism cannot close; possible values here: 0.928305 to 1.95787"
    );
    assert_eq!((why.range.input, why.value, planned.t()), ("boom_length", 9.0, 0.0));
    // The solver, which has no last good state, says the same.
    let why = excavator.solver().out_of_range(&tick).expect("an input is to blame");
    assert_eq!(
        why.to_string(),
        "input boom_length = 9: the mechanism cannot close; possible values here: 0.928305 to 1.95787"
    );
    inputs[MeasuredExcavator::boom_length.0] = Signal::constant(1.42);
    let tick = Instant { t: 0.001, inputs: &inputs };
    assert_eq!((planned.out_of_range(&tick), excavator.solver().out_of_range(&tick)), (None, None));
    assert!(planned.at(&tick).is_ok());
}

#[test]
fn several_broken_sensors_do_not_hide_one_another() {
    let excavator = MeasuredExcavator;
    let mut inputs: Vec<Signal> = signals::<MeasuredExcavator>(0.0);
    inputs[MeasuredExcavator::stick_length.0] = Signal::constant(0.2);
    inputs[MeasuredExcavator::bucket_length.0] = Signal::constant(5.0);
    // The one that is farthest from where the guess closes comes first, the other when that one is mended.
    let why = excavator.solver().out_of_range(&Instant { t: 0.0, inputs: &inputs }).expect("an input is to blame");
    assert_eq!((why.range.input, why.value), ("bucket_length", 5.0));
    inputs[MeasuredExcavator::bucket_length.0] = signals::<MeasuredExcavator>(0.0)[MeasuredExcavator::bucket_length.0];
    let why = excavator.solver().out_of_range(&Instant { t: 0.0, inputs: &inputs }).expect("an input is to blame");
    assert_eq!((why.range.input, why.value), ("stick_length", 0.2));
    assert!((why.range.greatest - (1.6_f64.hypot(0.6) + 0.6_f64.hypot(0.15))).abs() < 1e-9, "{why}");
}

/// A boom on a cylinder, in millimetres.
#[mechanism]
#[bodies(boom)]
#[input(cylinder, default = 900)]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[distance(ram: ground @ (500, -200), boom @ (1000, 100), length = cylinder)]
#[guess(boom.phi = 0.7)]
struct InMillimetres;

/// The size of an input does not matter: the range is told however far away a value is.
#[test]
fn ranges_are_told_in_any_unit() {
    let (a, b) = (500.0_f64.hypot(200.0), 1000.0_f64.hypot(100.0));
    for value in [1.0, 2000.0, 9000.0, 20_000.0, 1e7] {
        let inputs = [Signal::constant(value)];
        let at = Instant { t: 0.0, inputs: &inputs };
        let why = InMillimetres.solver().out_of_range(&at).unwrap_or_else(|| panic!("{value}"));
        let range = why.range;
        assert!(
            !range.contains(value) && range.contains(b - a + 1e-6) && range.contains(b + a - 1e-6),
            "{value}: {why}"
        );
        assert!(!range.contains(b - a - 1e-3) && !range.contains(b + a + 1e-3), "{value}: {why}");
    }
}

/// A parallelogram with a third crank, which a ram lifts through the position in which it lies flat. Where the input is 0,
/// nothing moves by it in the first or second order.
#[mechanism(allow_redundant)]
#[bodies(first, second, platform)]
#[input(slow)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (2, 0), second @ (0, 0))]
#[revolute(C: first @ (1, 0), platform @ (0, 0))]
#[revolute(D: second @ (1, 0), platform @ (2, 0))]
#[distance(third: ground @ (1, 0.5), platform @ (1, 0.5), length = 1)]
#[distance(ram: ground @ (0, -3), first @ (1, 0), length = 3 + slow.powi(3))]
#[guess(first.phi = -0.17, second.phi = -0.17)]
struct Lifted;

/// A range is that of the motion in time: limits that redundant rows lead through do not end it, nor does an input whose
/// rates vanish count as one that moves nothing.
#[test]
fn a_range_goes_through_limits_of_the_kept_rows_and_begins_at_rest() {
    for start in [0.0, 0.2, 0.7] {
        let inputs = constant(&[start]);
        let range = Lifted.solver().range_of(&Instant { t: 0.0, inputs: &inputs }, Lifted::slow).expect("it closes");
        assert!((range.least + 1.0).abs() < 1e-9 && (range.greatest - 1.0).abs() < 1e-9, "{start}: {range}");
    }
    let [low, high] = [constant(&[-0.5]), constant(&[0.9])];
    let mut planned = Lifted.solver().planned(&Instant { t: 0.0, inputs: &low }).expect("it closes");
    for t in [0.0, 1.0] {
        let ahead = planned.at(&Instant { t, inputs: &high }).expect("it is lifted").q()[2];
        assert!((10.0 + 6.0 * ahead.sin() - 3.729_f64.powi(2)).abs() < 1e-12, "{t}: {ahead}");
        planned.at(&Instant { t, inputs: &low }).expect("it is lowered");
    }
}

/// The smooth path of the input leads beyond the range, the straight one does not.
#[test]
fn a_path_that_is_not_taken_leaves_no_limit() {
    let raised = Raised::default();
    let (from, to) = ([Signal::new(1.25, 0.56, -0.84)], [Signal::new(1.39, -0.28, -0.84)]);
    let mut planned = raised.solver().planned(&Instant { t: 0.0, inputs: &from }).expect("it closes");
    planned.at(&Instant { t: 1.0, inputs: &to }).expect("the straight path is within the range");
    assert_eq!(None, planned.q_at_limit());
}
