//! Gears, belts, racks and rolling discs compared with closed forms from textbooks.

use kin_runtime::error::Degeneracy;
use kin_runtime::model::{Body, Model, Role};
use kin_runtime::{Instant, Kinematics, Mechanism, Motion, SolveError, State, mechanism};
use kin_tests::mechanisms::{
    BeltDrive, CardanCircles, GearTrain, PlanetaryBasic, PlanetaryTwoStage, RackPinionSlider, RollingIncline,
};

const TIMES: [f64; 5] = [0.0, 0.4, 0.9, 1.3, 1.9];

/// The states and motions at `TIMES`.
fn motions<M: Kinematics>(mechanism: &M) -> Vec<(State, Motion)> {
    let swept = mechanism.kinematic_analysis(&TIMES).unwrap();
    let solver = mechanism.solver();
    swept.states.into_iter().map(|state| (state.clone(), solver.motion(&state).unwrap())).collect()
}

#[track_caller]
fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} instead of {expected}");
}

/// The velocity of the point of a body that is currently at the position `at`.
fn velocity(motion: &Motion, body: Body, at: [f64; 2]) -> [f64; 2] {
    let body = motion[body];
    let arm = [at[0] - body.x, at[1] - body.y];
    [body.x_dot - body.phi_dot * arm[1], body.y_dot + body.phi_dot * arm[0]]
}

#[track_caller]
fn same(a: [f64; 2], b: [f64; 2]) {
    close(a[0], b[0]);
    close(a[1], b[1]);
}

/// (ω_sun − ω_arm) z_sun = −(ω_ring − ω_arm) z_ring in each stage, and the corresponding equation for the planet.
#[test]
fn planetary_stages_obey_willis() {
    let train = PlanetaryTwoStage::default();
    let (zr1, zr2) = (train.zs1 + 2.0 * train.zp1, train.zs2 + 2.0 * train.zp2);
    type M = PlanetaryTwoStage;
    for (State { t, .. }, motion) in motions(&train) {
        let sun = [4.0 + 0.6 * t, 0.6];
        let ring = [0.4 * (2.0 * t).cos(), -0.8 * (2.0 * t).sin()];
        for (order, (sun, ring)) in sun.into_iter().zip(ring).enumerate() {
            let rate = |body: Body| [motion[body].phi_dot, motion[body].phi_ddot][order];
            let arm1 = sun * train.zs1 / (train.zs1 + zr1);
            let arm2 = (train.zs2 * arm1 + zr2 * ring) / (train.zs2 + zr2);
            close(rate(M::arm1), arm1);
            close(rate(M::arm2), arm2);
            close(rate(M::planet1), arm1 - train.zs1 / train.zp1 * (sun - arm1));
            close(rate(M::planet2), arm2 - train.zs2 / train.zp2 * (arm1 - arm2));
        }
    }
    let mobility = train.mobility(&Instant::at(0.0), &[0.0; M::COORDINATES]).unwrap();
    assert_eq!((mobility.degrees_of_freedom, mobility.degrees_of_freedom_left), (2, 0));
}

/// Sun and planet have the same velocity at their pitch point, and so have planet and ring.
#[test]
fn gears_in_mesh_do_not_slip() {
    type M = PlanetaryBasic;
    let gear = M::default();
    for (_, motion) in motions(&gear) {
        let [centre, planet] = [motion[M::sun], motion[M::planet]].map(|body| [body.x, body.y]);
        let out = [0, 1].map(|k| (planet[k] - centre[k]) / gear.l);
        let pitch = |radius: f64| [0, 1].map(|k| centre[k] + radius * out[k]);
        same(velocity(&motion, M::sun, pitch(gear.rs)), velocity(&motion, M::planet, pitch(gear.rs)));
        same(velocity(&motion, M::planet, pitch(gear.rr)), velocity(&motion, M::ring, pitch(gear.rr)));
    }
}

/// In a train of four meshes, the ratio of the last wheel to the first depends only on their own teeth.
#[test]
fn wheels_between_do_not_matter() {
    for (State { t, .. }, motion) in motions(&GearTrain::default()) {
        let first = 0.4 + 3.0 * t;
        close(motion[GearTrain::wheel[4]].phi, first * 20.0 / 25.0);
        close(motion[GearTrain::wheel[1]].phi, -first * 20.0 / 31.0);
        close(motion[GearTrain::wheel[4]].phi_dot, 3.0 * 20.0 / 25.0);
    }
}

/// The first belt turns the arm by the ratio of the pulleys, and the belt along the arm keeps the direction of the
/// gripper.
#[test]
fn a_belt_along_an_arm_keeps_the_direction() {
    let drive = BeltDrive::default();
    for (State { t, .. }, motion) in motions(&drive) {
        let motor = 2.0 * (1.7 * t).sin();
        close(motion[BeltDrive::arm].phi, (drive.r1 * motor + 0.01) / drive.r2);
        close(motion[BeltDrive::gripper].phi, 0.0);
        close(motion[BeltDrive::gripper].phi_dot, 0.0);
        close(motion[BeltDrive::tip].r[1], drive.l * motion[BeltDrive::arm].phi.sin());
    }
}

/// If the pinion turns counter-clockwise, the point of its rim to the right of the axis moves with the rack.
#[test]
fn a_rack_moves_with_the_rim_of_its_pinion() {
    type M = RackPinionSlider;
    let rack = M::default();
    for (_, motion) in motions(&rack) {
        let axis = [0.96, 0.28];
        let axle = [0.5, 0.2];
        let rim = velocity(&motion, M::pinion, [axle[0] + rack.rp * axis[1], axle[1] - rack.rp * axis[0]]);
        let body = motion[M::rack];
        same(rim, [body.x_dot, body.y_dot]);
        let joint = M::model().joints.iter().position(|joint| joint.name == "mesh").unwrap();
        let stroke = motion.joints[joint][0];
        close(stroke.rate, axis[0] * body.x_dot + axis[1] * body.y_dot);
    }
}

/// The centre and the angle of the disc on the beam, and no slip at the contact.
#[test]
fn a_disc_on_an_incline_stands_where_it_rolled_to() {
    type M = RollingIncline;
    let rolling = M::default();
    for (_, motion) in motions(&rolling) {
        let (beam, disc) = (motion[M::beam], motion[M::disc]);
        let unit = [2.0, 0.5].map(|v| v / 2.0_f64.hypot(0.5));
        let along = rolling.c - rolling.r * (disc.phi - beam.phi);
        let local = [
            -0.2 + along * unit[0] - rolling.r * unit[1], //
            0.05 + along * unit[1] + rolling.r * unit[0],
        ];
        let turned = |[x, y]: [f64; 2], phi: f64| [x * phi.cos() - y * phi.sin(), x * phi.sin() + y * phi.cos()];
        let (on_beam, in_disc) = (turned(local, beam.phi), turned([0.01, 0.02], disc.phi));
        let centre = [disc.x + in_disc[0], disc.y + in_disc[1]];
        same(centre, [beam.x + on_beam[0], beam.y + on_beam[1]]);
        let normal = turned([-unit[1], unit[0]], beam.phi);
        let contact = [0, 1].map(|k| centre[k] - rolling.r * normal[k]);
        same(velocity(&motion, M::beam, contact), velocity(&motion, M::disc, contact));
    }
}

/// Cardan's circles: a rim point of a disc in a ring of twice its radius moves on a diameter of the ring.
#[test]
fn rim_points_of_cardan_circles_move_on_diameters() {
    type M = CardanCircles;
    let r = M::default().r;
    for (state, motion) in motions(&M::default()) {
        let ring = motion[M::ring];
        for k in 0..2 {
            let rim = motion[M::rim[k]].r;
            let (dx, dy) = (rim[0] - ring.x, rim[1] - ring.y);
            let (sin, cos) = ring.phi.sin_cos();
            let [along, across] = [cos * dx + sin * dy, cos * dy - sin * dx];
            let psi = state.q[M::model().coordinate(&format!("psi[{k}]")).unwrap()] - ring.phi;
            close(across, 0.0);
            close(along, -2.0 * r * psi.cos());
        }
    }
}

/// A coin around an equal coin turns twice on one way around.
#[mechanism]
#[bodies(table, coin)]
#[coordinates(psi)]
#[fixed(still: ground @ (0.3, 0.2), table @ (0, 0))]
#[rolling(roll: table @ (0, 0), coin @ (0, 0), radii = (r, r), along = psi)]
#[driver(drive: psi = t)]
struct Coins {
    #[param(0.012)]
    r: f64,
}

#[test]
fn a_coin_around_a_coin_turns_twice() {
    let swept = Coins::default().kinematic_analysis(&[0.0, std::f64::consts::TAU]).unwrap();
    let [first, last] = &swept.states[..] else { panic!("two instants") };
    let phi = Coins::model().coordinate("coin.phi").unwrap();
    close(last.q[phi] - first.q[phi], 2.0 * std::f64::consts::TAU);
}

/// Radii that couple nothing, or leave no line of centres, cause errors that name the joint.
#[test]
fn degenerate_radii_are_errors() {
    let at = Instant::at(0.0);
    let error = Coins { r: 0.0 }.state_at(&at).unwrap_err();
    let radius = |error: &SolveError, joint: &str| matches!(error, SolveError::DegenerateContact { joint: j, what: Degeneracy::Radius { .. }, .. } if *j == joint);
    assert!(radius(&error, "roll"), "{error}");
    let error = PlanetaryBasic { rp: 0.0, ..PlanetaryBasic::default() }.state_at(&at).unwrap_err();
    assert!(radius(&error, "inner"), "{error}");
    let error = InRing { ring: -0.1, disc_radius: 0.1 }.state_at(&at).unwrap_err();
    let what = Degeneracy::OneCentre { sum: 0.0 };
    assert!(matches!(error, SolveError::DegenerateContact { joint: "roll", what: w, .. } if w == what), "{error}");
    assert!(InRing::default().state_at(&at).is_ok());
}

/// A disc in a fixed ring.
#[mechanism]
#[bodies(disc)]
#[coordinates(psi)]
#[rolling(roll: ground @ (0, 0), disc @ (0, 0), radii = (ring, disc_radius), along = psi)]
#[driver(drive: psi = t)]
struct InRing {
    #[param(-0.2)]
    ring: f64,
    #[param(0.1)]
    disc_radius: f64,
}

/// The radii are part of the geometry for drawings, with the bodies to which they belong.
#[test]
fn radii_are_geometry() {
    let radii = |model: &Model, joint: &str| {
        let joint = model.joints.iter().find(|j| j.name == joint).unwrap();
        let radii = joint.geometry.iter().filter(|g| g.role == Role::Radius);
        radii.map(|g| (g.frame, g.offset)).collect::<Vec<_>>()
    };
    let model = PlanetaryBasic::model();
    let mesh = radii(model, "outer");
    assert_eq!(mesh.len(), 2);
    let mut numbers = vec![0.0; model.geometry];
    let gear = PlanetaryBasic::default();
    gear.write_geometry(&gear.parameters::<f64>(), &Instant::at(0.0), &mut numbers).unwrap();
    assert_eq!(mesh.iter().map(|(_, offset)| numbers[*offset]).collect::<Vec<_>>(), [0.085, -0.29]);
    assert_eq!(radii(RollingIncline::model(), "track").len(), 1);
    assert_eq!(radii(CardanCircles::model(), "R[1]").len(), 2);
}
