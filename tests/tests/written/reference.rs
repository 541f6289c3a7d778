//! The reference cases of `tests/data`: every mode at every instant, and the equations at arbitrary configurations.

use kin_runtime::model::Point;
use kin_runtime::{Instant, Kinematics, Mechanism, Subset};
use kin_tests::case::{self, Case, Linearization, Mode};
use kin_tests::compare::{Differences, largest};
use kin_tests::mechanisms::*;

/// The tolerance of q, q̇, q̈ and the points, relative to the largest entry.
const SOLUTION: f64 = 1e-10;
/// The tolerance of Φ, Φ_q, Φ_t, γ, relative to the largest entry, at least to 1.
const EQUATIONS: f64 = 1e-12;

macro_rules! cases {
    ($($name:ident: $Mechanism:ty,)*) => {$(
        mod $name {
            use super::*;

            #[test]
            fn description() {
                super::description::<$Mechanism>(stringify!($name));
            }

            #[test]
            fn equations() {
                super::equations::<$Mechanism>(stringify!($name));
            }

            #[test]
            fn ranks_and_degrees_of_freedom() {
                super::ranks::<$Mechanism>(stringify!($name));
            }

            #[test]
            fn motion() {
                super::motion::<$Mechanism>(stringify!($name));
            }

            #[test]
            fn own_guess() {
                super::own_guess::<$Mechanism>(stringify!($name));
            }
        }
    )*};
}

cases! {
    andrews_cartesian: AndrewsCartesian,
    bogie_on_rail: BogieOnRail,
    cam_ellipse_implicit: CamEllipseImplicit,
    cam_oscillating_follower: CamOscillatingFollower,
    chain10: Chain10,
    elliptic_trammel: EllipticTrammel,
    excavator: Excavator,
    fourbar_lecture_angles: FourbarLectureAngles,
    fourbar_lecture_mid: FourbarLectureMid,
    geared_fivebar: GearedFivebar,
    infeasible_fourbar: InfeasibleFourbar,
    klann_leg: KlannLeg,
    macpherson_strut: MacphersonStrut,
    peaucellier: Peaucellier,
    planetary_basic: PlanetaryBasic,
    quick_return: QuickReturn,
    rack_pinion_slider: RackPinionSlider,
    redundant_parallelogram: RedundantParallelogram,
    robot_3rrr: Robot3rrr,
    scotch_yoke: ScotchYoke,
    singular_slider_crank: SingularSliderCrank,
    sleigh_knife_edge: SleighKnifeEdge,
    slider_crank_inline: SliderCrankInline,
    toggle_press: TogglePress,
    underdriven_fivebar: UnderdrivenFivebar,
    watt_sixbar: WattSixbar,
}

/// Counts and names: the mechanism of the tests matches that of the file.
fn description<M: Mechanism>(name: &str) {
    let case = Case::read(name);
    let model = M::model();
    let mut differences = Differences::new();
    differences.at(name);
    differences.equal("n", case.n, M::COORDINATES);
    differences.equal("s", case.s, M::ROWS);
    differences.equal("driving rows", case.s_drivers, model.rows.iter().filter(|row| row.driving).count());
    let names: Vec<_> = model.coordinates.iter().map(|coordinate| coordinate.name.to_owned()).collect();
    differences.equal("coordinates", case.coordinate_names(), names);
    differences.equal("allow_redundant", case.expect == "redundant", model.allow_redundant);
    differences.finish();
}

/// Φ, Φ_q, Φ_t, γ off the constraint manifold, and at the first instant.
fn equations<M: Mechanism + Default>(name: &str) {
    let case = Case::read(name);
    let mut differences = Differences::new();
    let off = &case.offmanifold;
    differences.at(format_args!("{name}, off the manifold"));
    compare_equations::<M>(&case, &mut differences, [&off.q, &off.q_dot], off.t, Some(&off.phi), &off.linear);
    if let (Some(mode), Some(expected)) = (case.modes.first(), &case.linearization) {
        let first = &mode.instants[0];
        differences.at(format_args!("{name}, first instant of {}", mode.name));
        compare_equations::<M>(&case, &mut differences, [&first.q, &first.q_dot], first.t, None, expected);
    }
    differences.finish();
}

fn compare_equations<M: Mechanism + Default>(
    case: &Case,
    differences: &mut Differences,
    [q, q_dot]: [&Vec<f64>; 2],
    t: f64,
    phi: Option<&Vec<f64>>,
    expected: &Linearization,
) {
    let model = M::model();
    let scales = case.row_scales();
    let rescaled = |rows: &[f64]| rows.iter().zip(&scales).map(|(value, scale)| value * scale).collect::<Vec<_>>();
    let tolerance = |rows: &[f64]| EQUATIONS * largest(rows).max(1.0);
    let mut found = M::workspace::<f64>();
    M::default().evaluate(Subset::ALL, &Instant::at(t), q, q_dot, &mut found).expect("lengths agree");

    let parts = [
        ("Φ", phi, found.phi()),
        ("Φ_t", Some(&expected.phi_t), found.phi_t()),
        ("γ", Some(&expected.gamma), found.gamma()),
    ];
    for (part, expected, found) in parts {
        if let Some(expected) = expected.map(|rows| rescaled(rows)) {
            differences.vector(part, |row| model.rows[row].name, &expected, found, tolerance(&expected));
        }
    }

    let (rows, columns) = (M::ROWS, M::COORDINATES);
    let mut dense = vec![0.0; rows * columns];
    for (&(row, column), &value) in model.constraint_pattern.entries.iter().zip(found.phi_q()) {
        dense[row * columns + column] += value;
    }
    let mut expected_dense = vec![0.0; rows * columns];
    for &(row, column, value) in &expected.phi_q {
        expected_dense[row * columns + column] = value * scales[row];
    }
    let entry =
        |place: usize| format!("{} by {}", model.rows[place / columns].name, model.coordinates[place % columns].name);
    differences.vector("Φ_q", entry, &expected_dense, &dense, tolerance(&expected_dense));
}

/// Ranks and degrees of freedom at the first instant of the first mode.
fn ranks<M: Kinematics + Default>(name: &str) {
    let case = Case::read(name);
    let Some(mode) = case.modes.first() else { return };
    let first = &mode.instants[0];
    let mobility = M::default().mobility(&Instant::at(first.t), &first.q).expect("a regular configuration");
    let mut differences = Differences::new();
    differences.at(name);
    differences.equal("rank", case.rank, Some(mobility.rank));
    differences.equal("rank without driving rows", case.rank_without_drivers, Some(mobility.rank_without_driving));
    differences.equal("degrees of freedom", case.dof_without_drivers, Some(mobility.degrees_of_freedom));
    differences.equal("degrees of freedom left", case.dof_remaining, Some(mobility.degrees_of_freedom_left));
    differences.equal("driving rows", case.s_drivers, mobility.driving_rows);
    differences.equal("independent coordinates", mobility.degrees_of_freedom, mobility.independent.len());
    differences.equal("dependent coordinates", mobility.rank_without_driving, mobility.dependent.len());
    differences.equal("redundant rows", case.s - mobility.rank, mobility.redundant.len());
    differences.finish();
}

/// The motion of every mode from its initial guess. The under-driven cases are tested in `special_cases.rs`.
fn motion<M: Kinematics + Default>(name: &str) {
    let case = Case::read(name);
    if case.expect == "underdriven" || case.modes.is_empty() {
        return;
    }
    let mechanism = M::default();
    let mut differences = Differences::new();
    for mode in &case.modes {
        differences.at(format_args!("{name}, {}", mode.name));
        let swept = mechanism.solver().sweep_from(mode.start(), &mode.times());
        let states = match swept {
            Ok(trajectory) => trajectory.states,
            Err(error) => {
                differences.report(&error);
                error.trajectory.states
            }
        };
        for (expected, state) in mode.instants.iter().zip(&states) {
            differences.at(format_args!("{name}, {}, t = {}", mode.name, expected.t));
            compare_state::<M>(&mechanism, &mut differences, expected, state);
        }
    }
    differences.finish();
}

fn compare_state<M: Kinematics>(
    mechanism: &M,
    differences: &mut Differences,
    expected: &case::Instant,
    state: &kin_runtime::State,
) {
    let model = M::model();
    let coordinate = |place: usize| model.coordinates[place].name;
    let levels = [
        ("q", &expected.q, &state.q),
        ("q_dot", &expected.q_dot, &state.q_dot),
        ("q_ddot", &expected.q_ddot, &state.q_ddot),
    ];
    for (what, expected, found) in levels {
        differences.vector(what, coordinate, expected, found, SOLUTION * largest(expected));
    }
    let motion = mechanism.solver().motion(state).expect("a solved state");
    for point in &expected.points {
        let Some(place) = place_of::<M>(&point.point) else {
            differences.report(format_args!("no point {}", point.point));
            continue;
        };
        let found = motion[place];
        let levels = [
            ("r", &point.r, found.r, &expected.q),
            ("v", &point.v, found.v, &expected.q_dot),
            ("a", &point.a, found.a, &expected.q_ddot),
        ];
        for (what, expected, found, level) in levels {
            let scale = largest(expected).max(largest_displacement::<M>(level));
            let name = |axis: usize| format!("{}.{}", point.point, ["x", "y"][axis]);
            differences.vector(what, name, expected, &found, SOLUTION * scale);
        }
    }
}

/// The named point for the file's `body.point`: `point`, or `body_point` where several bodies have a point of that
/// name.
fn place_of<M: Mechanism>(name: &str) -> Option<Point> {
    let (_, short) = name.split_once('.')?;
    let long = name.replace('.', "_");
    M::model().points.iter().position(|point| point.name == short || point.name == long).map(Point)
}

/// The largest absolute x or y entry of a vector of coordinates.
fn largest_displacement<M: Mechanism>(level: &[f64]) -> f64 {
    let entries = M::model().coordinates.iter().zip(level);
    largest(&entries.filter(|(c, _)| !c.name.ends_with(".phi")).map(|(_, &value)| value).collect::<Vec<_>>())
}

/// From the mechanism's own rough guess, with some angles to one decimal, position analysis finds the file's first
/// mode.
fn own_guess<M: Kinematics + Default>(name: &str) {
    let case = Case::read(name);
    if case.expect == "underdriven" {
        return;
    }
    let Some(Mode { name: mode, instants, .. }) = case.modes.first() else { return };
    let mut differences = Differences::new();
    differences.at(format_args!("{name}, {mode}, t = {}", instants[0].t));
    let mechanism = M::default();
    match mechanism.state_at(&Instant::at(instants[0].t)) {
        Ok(state) => compare_state::<M>(&mechanism, &mut differences, &instants[0], &state),
        Err(error) => differences.report(error),
    }
    differences.finish();
}
