//! The lecture's four-bar in four formulations has the same motion.

use kin_runtime::{Kinematics, Mechanism, Trajectory};
use kin_tests::compare::{Differences, largest};
use kin_tests::mechanisms::{FourbarEnds, FourbarLectureAngles, FourbarLectureMid, FourbarRelative};

const TIMES: [f64; 7] = [0.0, 0.37, 0.81, 1.3, 1.9, 2.6, 5.0];

fn motion<M: Kinematics + Default>() -> Trajectory {
    M::default().kinematic_analysis(&TIMES).unwrap_or_else(|error| panic!("{}: {error}", M::model().name))
}

/// The angles of crank, coupler and rocker, their rates and accelerations, at all instants.
fn angles(trajectory: &Trajectory, names: [&str; 3]) -> Vec<Vec<f64>> {
    let levels = ["", "_dot", "_ddot"];
    let column = |name: String| trajectory.column(&name).unwrap_or_else(|| panic!("no column {name}"));
    levels.iter().flat_map(|level| names.map(|name| column(format!("{name}{level}")))).collect()
}

#[test]
fn global_local_and_reduced_coordinates_move_alike() {
    let bodies = ["crank.phi", "coupler.phi", "rocker.phi"];
    let reference = angles(&motion::<FourbarLectureMid>(), bodies);
    let others = [
        ("global method", angles(&motion::<FourbarLectureAngles>(), ["phi1", "phi2", "phi3"])),
        ("solution 2", angles(&motion::<FourbarEnds>(), bodies)),
        ("solution 3", angles(&motion::<FourbarRelative>(), bodies)),
    ];
    let mut differences = Differences::new();
    for (what, found) in others {
        for (column, (expected, found)) in reference.iter().zip(found).enumerate() {
            differences.at(format_args!("{what}, {} derivative {}", bodies[column % 3], column / 3));
            differences.vector("instant", |place| TIMES[place], expected, &found, 1e-11 * largest(expected).max(1.0));
        }
    }
    differences.finish();
}

/// Poses include held coordinates and origins: body origins and the joint B agree between solutions 2 and 3.
#[test]
fn held_and_carried_origins_are_reported() {
    let mut differences = Differences::new();
    for (ends, relative) in motion::<FourbarEnds>().iter().zip(&motion::<FourbarRelative>()) {
        let ends = FourbarEnds::default().solver().motion(ends).unwrap();
        let relative = FourbarRelative::default().solver().motion(relative).unwrap();
        for (body, (expected, found)) in ends.bodies.iter().zip(&relative.bodies).enumerate() {
            differences.at(FourbarEnds::model().bodies[body].name);
            let levels = [
                ([expected.x, expected.y, expected.phi], [found.x, found.y, found.phi]),
                ([expected.x_dot, expected.y_dot, expected.phi_dot], [found.x_dot, found.y_dot, found.phi_dot]),
                ([expected.x_ddot, expected.y_ddot, expected.phi_ddot], [found.x_ddot, found.y_ddot, found.phi_ddot]),
            ];
            for (expected, found) in levels {
                differences.vector("pose", |k| ["x", "y", "phi"][k], &expected, &found, 1e-11);
            }
        }
        let (expected, found) = (ends[FourbarEnds::B], relative[FourbarRelative::B]);
        differences.at("B");
        differences.vector("r", |k| k, &expected.r, &found.r, 1e-12);
        differences.vector("v", |k| k, &expected.v, &found.v, 1e-11);
        differences.vector("a", |k| k, &expected.a, &found.a, 1e-10);
    }
    differences.finish();
}

#[test]
fn degrees_of_freedom_are_those_of_the_lecture() {
    fn check<M: Kinematics + Default>(rows: usize) {
        let state = &motion::<M>().states[0];
        let mobility = M::default().mobility(&state.instant(), &state.q).unwrap();
        assert_eq!((1, 0), (mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), "{}", M::model().name);
        assert_eq!((rows, 1), (mobility.rows, mobility.driving_rows), "{}", M::model().name);
    }
    check::<FourbarLectureMid>(9);
    check::<FourbarLectureAngles>(3);
    check::<FourbarEnds>(7);
    check::<FourbarRelative>(3);
}

/// In metres, millimetres and nanometres the angles are the same, and so is the number of iterations.
#[test]
fn no_unit_changes_the_analysis() {
    let in_units = |unit: f64| {
        let [l1, l2, l3, d1, d2] = [0.1, 0.4, 0.3, 0.4, 0.1].map(|length| length / unit);
        let four_bar = FourbarLectureMid { l1, l2, l3, d1, d2, ..FourbarLectureMid::default() };
        let trajectory = four_bar.kinematic_analysis(&TIMES).unwrap_or_else(|error| panic!("{unit}: {error}"));
        let iterations: usize = trajectory.iter().map(|state| state.iterations).sum();
        (angles(&trajectory, ["crank.phi", "coupler.phi", "rocker.phi"]), iterations)
    };
    let (metres, effort) = in_units(1.0);
    let mut differences = Differences::new();
    for unit in [1e-9, 1e-6, 1e-3, 1e3, 1e6] {
        let (found, iterations) = in_units(unit);
        differences.at(format_args!("unit {unit}"));
        for (expected, found) in metres.iter().zip(found) {
            differences.vector("instant", |place| TIMES[place], expected, &found, 1e-11 * largest(expected).max(1.0));
        }
        if iterations > 2 * effort {
            differences.report(format_args!("{iterations} iterations instead of {effort}"));
        }
    }
    differences.finish();
}
