//! Laws of forces, for every kind of joint and load: the balance of power, the resultant on the ground, the same machine
//! written in different ways, what is undetermined, and what nothing holds.

use kin_runtime::model::Frame;
use kin_runtime::{Forces, Instant, Kinematics, Mechanism, Signal, SolveError, State, mechanism};
use kin_tests::mechanisms::loaded;

/// Beside the largest of the powers, or of the forces.
const EXACT: f64 = 1e-10;
/// Step of the central difference of the energy.
const STEP: f64 = 1e-3;

/// A four-bar with frames in the middle of the links.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (-0.05, 0))]
#[revolute(A: crank @ (0.05, 0), coupler @ (-0.2, 0))]
#[revolute(B: coupler @ (0.2, 0), rocker @ (-0.15, 0))]
#[revolute(D: ground @ (0.4, 0.1), rocker @ (0.15, 0))]
#[driver(drive: crank.phi = pi/4 + 2.3*t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.01, 0.002), mass = 0.5, inertia = 0.0004)]
#[mass(coupler @ (0.03, -0.01), mass = 2, inertia = 0.027)]
#[mass(rocker @ (-0.02, 0.03), mass = 1.5, inertia = 0.011)]
#[force(pull: coupler @ (0.1, 0.05), (3*sin(t), -2 - dot(coupler.x)), frame = coupler)]
#[torque(brake: rocker = -0.3*dot(rocker.phi))]
#[torque(motor: ground, crank = 0.2)]
#[spring(S: ground @ (0.1, 0.4), rocker @ (0.02, 0.01), stiffness = 120, free_length = 0.2 + 0.01*sin(3*t), damping = 2)]
#[derive(Default)]
struct Middle;

/// The same with frames at the ends of the links, carried by one another, angles counted from the same lines.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(coupler, origin = crank @ (0.1, 0))]
#[bodies(rocker)]
#[revolute(B: coupler @ (0.4, 0), rocker @ (-0.15, 0))]
#[revolute(D: ground @ (0.4, 0.1), rocker @ (0.15, 0))]
#[driver(drive: crank.phi = pi/4 + 2.3*t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
#[point(middle = coupler @ (0.2, 0))]
#[gravity(0, -9.81)]
#[mass(crank @ (0.06, 0.002), mass = 0.5, inertia = 0.0004)]
#[mass(coupler @ (0.23, -0.01), mass = 2, inertia = 0.027)]
#[mass(rocker @ (-0.02, 0.03), mass = 1.5, inertia = 0.011)]
#[force(pull: coupler @ (0.3, 0.05), (3*sin(t), -2 - dot(middle.x)), frame = coupler)]
#[torque(brake: rocker = -0.3*dot(rocker.phi))]
#[torque(motor: ground, crank = 0.2)]
#[spring(S: ground @ (0.1, 0.4), rocker @ (0.02, 0.01), stiffness = 120, free_length = 0.2 + 0.01*sin(3*t), damping = 2)]
#[derive(Default)]
struct Carried;

/// The same by angles alone, the poses of the bodies held at formulas of them.
#[mechanism]
#[coordinates(a, b, c)]
#[body(crank, x = 0.05*cos(a), y = 0.05*sin(a), phi = a)]
#[body(coupler, x = 0.1*cos(a) + 0.2*cos(b), y = 0.1*sin(a) + 0.2*sin(b), phi = b)]
#[body(rocker, x = 0.1*cos(a) + 0.4*cos(b) + 0.15*cos(c), y = 0.1*sin(a) + 0.4*sin(b) + 0.15*sin(c), phi = c)]
#[constraint(loop_x: 0.1*cos(a) + 0.4*cos(b) + 0.3*cos(c) = 0.4)]
#[constraint(loop_y: 0.1*sin(a) + 0.4*sin(b) + 0.3*sin(c) = 0.1)]
#[driver(drive: a = pi/4 + 2.3*t)]
#[guess(b = 0.9, c = 5.0)]
#[gravity(0, -9.81)]
#[mass(crank @ (0.01, 0.002), mass = 0.5, inertia = 0.0004)]
#[mass(coupler @ (0.03, -0.01), mass = 2, inertia = 0.027)]
#[mass(rocker @ (-0.02, 0.03), mass = 1.5, inertia = 0.011)]
#[force(pull: coupler @ (0.1, 0.05), (3*sin(t), -2 - dot(coupler.x)), frame = coupler)]
#[torque(brake: rocker = -0.3*dot(rocker.phi))]
#[torque(motor: ground, crank = 0.2)]
#[spring(S: ground @ (0.1, 0.4), rocker @ (0.02, 0.01), stiffness = 120, free_length = 0.2 + 0.01*sin(3*t), damping = 2)]
#[derive(Default)]
struct Angles;

/// A carriage that moves in a prescribed way, with a driven arm on it; a family of links hangs from the arm.
#[mechanism]
#[body(base, x = 0.3*sin(2*t), y = 0.1*t, phi = 0.2*cos(t))]
#[body(arm, origin = base @ (0.2, 0.1))]
#[bodies(link[3])]
#[revolute(top: arm @ (0.5, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..2]: link[i] @ (0.3, 0.02), link[i+1] @ (0, 0))]
#[driver(swing: arm.phi = 0.4*sin(t))]
#[driver(hang[i in 0..3]: link[i].phi = -1.5 + 0.2*sin(2*t + i))]
#[gravity(0.3, -9.81)]
#[mass(base @ (0.1, 0), mass = 5, inertia = 0.3)]
#[mass(arm @ (0.2, 0.01), mass = 1.5, inertia = 0.02)]
#[mass(M[i in 0..3]: link[i] @ (0.15, 0.01), mass = 0.4 + 0.1*i, inertia = 0.003)]
#[mass(link[2] @ (0.3, 0), mass = 0.7)]
#[torsion_spring(T[i in 0..2]: link[i], link[i+1], stiffness = 2, free_angle = 0.1, damping = 0.05)]
#[derive(Default)]
struct Carriage;

/// A belt in the ground and one on a moving arm, and a spring on the arm.
#[mechanism]
#[bodies(motor, arm, gripper)]
#[revolute(M: ground @ (-0.4, 0.1), motor @ (0, 0))]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[revolute(G: arm @ (0.7, 0), gripper @ (0, 0))]
#[belt(primary: motor, arm, radii = (0.03, 0.12), offset = -0.01)]
#[belt(parallel: ground, gripper, radii = (0.05, 0.05), carrier = arm)]
#[driver(drive: motor.phi = 2*sin(1.7*t))]
#[gravity(0, -9.81)]
#[mass(motor @ (0, 0), mass = 1, inertia = 0.001)]
#[mass(arm @ (0.3, 0), mass = 3, inertia = 0.1)]
#[mass(gripper @ (0.1, 0.02), mass = 1, inertia = 0.01)]
#[derive(Default)]
struct Belts;

/// A disc that rolls on a line of a beam that moves.
#[mechanism]
#[bodies(beam, disc)]
#[x(slide: beam @ (0.1, 0) = 0.2*sin(t))]
#[y(height: beam @ (0.1, 0) = 0.3)]
#[angle(swing: beam = 0.3*cos(2*t))]
#[rolling(track: beam @ (-0.2, 0.05), disc @ (0.01, 0.02), axis = (2, 0.5), radius = 0.15, offset = 0.1)]
#[driver(drive: disc.phi = -1.3*t - 0.2*sin(3*t))]
#[gravity(0, -9.81)]
#[mass(beam @ (0.1, -0.1), mass = 2, inertia = 0.1)]
#[mass(disc @ (0.02, 0.02), mass = 0.5, inertia = 0.004)]
#[derive(Default)]
struct Incline;

/// A disc that rolls on a disc.
#[mechanism]
#[bodies(sun, planet)]
#[coordinates(psi)]
#[revolute(S: ground @ (0, 0), sun @ (0, 0))]
#[rolling(contact: sun @ (0, 0), planet @ (0, 0), radii = (0.2, 0.1), along = psi)]
#[driver(drive: sun.phi = t)]
#[driver(swing: psi = 0.3*sin(2*t))]
#[gravity(0, -9.81)]
#[mass(planet @ (0.01, 0), mass = 2, inertia = 0.01)]
#[mass(sun @ (0.1, 0), mass = 1, inertia = 0.02)]
#[derive(Default)]
struct Discs;

/// The same with a carrier of the very length that the discs keep, so that it swings freely.
#[mechanism]
#[bodies(sun, carrier, planet)]
#[coordinates(psi)]
#[revolute(S: ground @ (0, 0), sun @ (0, 0))]
#[rolling(contact: sun @ (0, 0), planet @ (0, 0), radii = (0.2, 0.1), along = psi)]
#[revolute(C: ground @ (0, 0), carrier @ (0, 0))]
#[revolute(P: carrier @ (0.3, 0), planet @ (0, 0))]
#[driver(drive: sun.phi = t)]
#[gravity(0, -9.81)]
#[mass(planet @ (0.01, 0), mass = 2, inertia = 0.01)]
#[mass(carrier @ (0.1, 0), mass = 1, inertia = 0.02)]
#[derive(Default)]
struct FreeCarrier;

/// A flat face under a cam, on a slide.
#[mechanism]
#[bodies(cam, lever, slide)]
#[revolute(O: ground @ (0, 0), cam @ (0.01, -0.02))]
#[revolute(F: slide @ (0.01, 0), lever @ (0.02, -0.01))]
#[translational(way: ground @ (-0.15, 0.02), slide @ (0, 0), axis = (1, 0.2))]
#[flat_follower(contact: cam @ (0.01, -0.02), lever @ (0.15, 0.005), axis = (1, 0.1), support(theta) = 0.04 + 0.012*cos(theta - 0.4))]
#[driver(drive: cam.phi = 0.3 + 2*t)]
#[driver(feed: slide.x = -0.15 + 0.01*sin(t))]
#[guess(lever.phi = 0.1)]
#[gravity(0, -9.81)]
#[mass(cam @ (0.02, 0), mass = 0.3, inertia = 0.0002)]
#[mass(lever @ (0.08, 0), mass = 0.2, inertia = 0.0004)]
#[mass(slide @ (0, 0.01), mass = 0.4)]
#[spring(back: ground @ (0.1, -0.2), lever @ (0.1, 0), stiffness = 300, free_length = 0.1)]
#[derive(Default)]
struct FlatFace;

/// A roller on an ellipse that grows.
#[mechanism]
#[bodies(cam, lever)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0.005, 0.003))]
#[revolute(F: ground @ (-0.1, 0.03), lever @ (-0.01, 0))]
#[on_curve(contact: cam @ (0.002, -0.004), lever @ (0.12, 0.02), parametric(u) = ((0.05 + 0.004*t)*cos(u), 0.035*sin(u)), roller = -0.01)]
#[driver(drive: cam.phi = 0.3 + 2*t)]
#[guess(lever.phi = 0.05, u = 1.3)]
#[gravity(0, -9.81)]
#[mass(cam @ (0.01, 0), mass = 0.3, inertia = 0.0002)]
#[mass(lever @ (0.08, 0.01), mass = 0.2, inertia = 0.0004)]
#[derive(Default)]
struct Roller;

/// A block and tackle: the hook hangs in two strands, and slides in a guide.
#[mechanism]
#[bodies(hook)]
#[point(eye = hook @ (0, 0.1))]
#[translational(guide: ground @ (0.1, 0), hook @ (0, 0), axis = (0, 1))]
#[rope(tackle: ground @ (0, 2), eye, ground @ (0.2, 2), length = 3 - 0.2*t - 0.1*sin(t))]
#[guess(hook.y = 0.3)]
#[gravity(0, -9.81)]
#[mass(hook @ (0, -0.05), mass = 12, inertia = 0.1)]
#[derive(Default)]
struct Tackle;

/// A press by a screw.
#[mechanism]
#[bodies(wheel, ram)]
#[revolute(W: ground @ (0, 1), wheel @ (0, 0))]
#[translational(guide: ground @ (0, 0), ram @ (0, 0), axis = (0, 1))]
#[screw(thread: ground @ (0, 0), ram @ (0, 0), axis = (0, 1), lead = 0.02, nut = wheel)]
#[driver(turn: wheel.phi = 3*sin(t))]
#[gravity(0, -9.81)]
#[mass(ram @ (0, 0.1), mass = 20)]
#[mass(wheel @ (0.01, 0), mass = 5, inertia = 0.4)]
#[force(work: ram @ (0, 0), (0, 1000 - 200*dot(ram.y)))]
#[derive(Default)]
struct Press;

/// An arm on a cylinder, whose length and what it lifts are inputs.
#[mechanism]
#[input(stroke, payload)]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[distance(cylinder: ground @ (0.5, -0.2), arm @ (0.8, 0.1), length = stroke)]
#[guess(arm.phi = 0.8)]
#[gravity(0, -9.81)]
#[mass(arm @ (1, 0.05), mass = 40, inertia = 8)]
#[force(load: arm @ (2, 0), (0, -9.81*payload))]
#[derive(Default)]
struct Lift;

/// A parallelogram on three cranks: one more than it needs.
#[mechanism(allow_redundant)]
#[bodies(crank, coupler, rocker, middle)]
#[revolute(O1: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.27, 0), coupler @ (-0.315, 0.02))]
#[revolute(B: coupler @ (0.315, 0.02), rocker @ (0.135, 0))]
#[revolute(O2: ground @ (0.63, 0), rocker @ (-0.135, 0))]
#[revolute(O3: ground @ (0.2, 0), middle @ (0, 0))]
#[revolute(C: coupler @ (-0.115, 0.02), middle @ (0.27, 0))]
#[revolute(hinge: coupler @ (0, 0.1), flap @ (0, 0))]
#[bodies(flap)]
#[driver(drive: crank.phi = 0.6 + 1.4*t)]
#[driver(turn: flap.phi = sin(t))]
#[guess(rocker.phi = 0.6, middle.phi = 0.6)]
#[gravity(0, -9.81)]
#[mass(coupler @ (0.05, 0), mass = 3, inertia = 0.1)]
#[mass(flap @ (0.1, 0), mass = 1, inertia = 0.01)]
#[derive(Default)]
struct Parallelogram;

/// A pendulum that nothing drives.
#[mechanism]
#[bodies(rod)]
#[revolute(O: ground @ (0, 0), rod @ (0, 0))]
#[gravity(0, -9.81)]
#[mass(rod @ (0.5, 0), mass = 2, inertia = 0.1)]
#[derive(Default)]
struct Pendulum;

/// A blade that cannot slip sideways, on a body whose heading and speed are given.
#[mechanism]
#[bodies(sleigh)]
#[driver(heading: sleigh.phi = 0.3 + 0.8*t)]
#[knife_edge(blade: sleigh @ (0.3, -0.07), angle = 0.2)]
#[speed(pull: sleigh @ (0.3, -0.07), angle = 0.2, value = 0.9 + 0.25*t)]
#[guess(sleigh.x = 0, sleigh.y = 0)]
#[mass(sleigh @ (0.1, 0.05), mass = 7, inertia = 0.6)]
#[derive(Default)]
struct Sleigh;

fn at(t: f64, signals: &[Signal]) -> Instant<'_> {
    Instant { t, inputs: signals }
}

fn energy(forces: &Forces) -> f64 {
    forces.kinetic + forces.gravity + forces.elastic
}

/// States around t, on the branch of the state at t.
fn forces_near<M: Kinematics>(mechanism: &M, centre: &State, t: f64) -> Forces {
    let inputs: Vec<Signal> = centre.inputs.iter().map(|signal| signal.after(t - centre.t)).collect();
    let state = mechanism.solver().state_from(&at(t, &inputs), &centre.q).unwrap();
    mechanism.solver().forces(&state).unwrap()
}

/// d/dt of all energy is the power of drivers, applied loads and dampers.
fn balanced<M: Kinematics>(mechanism: &M, centre: &State) {
    let forces = mechanism.solver().forces(centre).unwrap();
    let at = |k: f64| energy(&forces_near(mechanism, centre, centre.t + k * STEP));
    // Central differences of the fourth order, of two widths, extrapolated.
    let difference = |w: f64| (8.0 * (at(w) - at(-w)) - (at(2.0 * w) - at(-2.0 * w))) / (12.0 * w * STEP);
    let rate = (16.0 * difference(1.0) - difference(2.0)) / 15.0;
    let power = forces.driver_power + forces.applied_power + forces.damper_power;
    let size = [forces.driver_power, forces.applied_power, forces.damper_power, rate, energy(&forces)]
        .iter()
        .fold(1e-3, |size: f64, value| size.max(value.abs()));
    let name = M::model().name;
    assert!((rate - power).abs() <= 1e-9 * size, "{name} at {}: {rate} instead of {power}\n{forces}", centre.t);
}

/// What joints exert on the ground, with what springs and couples exert there, is the shaking force.
fn on_ground<M: Kinematics>(forces: &Forces, others: [f64; 2]) {
    let mut sum = others;
    for reaction in &forces.reactions {
        let Some(force) = reaction.force else { continue };
        let joint = forces.model.joints.iter().find(|joint| joint.name == reaction.name);
        let grounded =
            joint.is_none_or(|joint| joint.frames.contains(&Some(Frame::Ground)) || joint.frames[1].is_none());
        let sign = if reaction.on == Some(Frame::Ground) { 1.0 } else { -1.0 };
        let carried = reaction.name.ends_with(".origin");
        if grounded && !carried {
            (0..2).for_each(|c| sum[c] += sign * force[c]);
        }
    }
    let size = forces.shaking.force.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
    for c in 0..2 {
        assert!((sum[c] - forces.shaking.force[c]).abs() <= EXACT * size, "{sum:?} instead of {:?}", forces.shaking);
    }
}

macro_rules! powers {
    ($($name:ident: $Mechanism:ty, $times:expr;)*) => {$(
        #[test]
        fn $name() {
            let mechanism = <$Mechanism>::default();
            for t in $times {
                let state = mechanism.state_at(&Instant::at(t)).unwrap();
                balanced(&mechanism, &state);
            }
        }
    )*};
}

mod powers {
    use super::*;

    powers! {
        middle: Middle, [0.0, 0.4, 1.3];
        carried: Carried, [0.0, 0.4, 1.3];
        angles: Angles, [0.0, 0.4, 1.3];
        carriage: Carriage, [0.0, 0.7, 2.0];
        belts: Belts, [0.1, 0.7, 2.0];
        incline: Incline, [0.1, 0.7];
        discs: Discs, [0.1, 0.7];
        flat_face: FlatFace, [0.1, 0.7];
        roller: Roller, [0.1, 0.3];
        tackle: Tackle, [0.1, 1.0];
        press: Press, [0.1, 1.0];
        excavator: loaded::Excavator, [0.1, 0.5];
        planetary: loaded::PlanetaryBasic, [0.1, 0.5];
        bogie: loaded::BogieOnRail, [0.0];
        strut: loaded::MacphersonStrut, [0.1, 0.5];
        platform: loaded::Robot3rrr, [0.0];
    }
}

/// Efforts, the reaction in D and shaking do not depend on how the machine is written.
#[test]
fn one_machine_has_one_set_of_forces() {
    for t in [0.0, 0.4, 1.3] {
        let of = |forces: Result<Forces, SolveError>| forces.unwrap();
        let middle = Middle::default();
        let start = middle.state_at(&Instant::at(t)).unwrap();
        let middle = of(middle.solver().forces(&start));
        let carried = Carried::default();
        let state = carried.state_at(&Instant::at(t)).unwrap();
        let carried = of(carried.solver().forces(&state));
        let angles = Angles::default();
        let state = angles.state_at(&Instant::at(t)).unwrap();
        let angles = of(angles.solver().forces(&state));
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "t = {t}: {a} instead of {b}");
        for other in [&carried, &angles] {
            near(other.effort("drive").unwrap(), middle.effort("drive").unwrap());
            near(other.shaking.moment, middle.shaking.moment);
            near(other.driver_power, middle.driver_power);
            near(other.kinetic, middle.kinetic);
            (0..2).for_each(|c| near(other.shaking.force[c], middle.shaking.force[c]));
        }
        for joint in ["B", "D"] {
            let (found, exact) = (carried.reaction(joint).unwrap(), middle.reaction(joint).unwrap());
            (0..2).for_each(|c| near(found.force.unwrap()[c], exact.force.unwrap()[c]));
        }
        // The pin that carries the coupler, and the one that holds the crank.
        for (name, joint) in [("coupler.origin", "A"), ("crank.x", "O")] {
            let (found, exact) = (carried.reaction(name).unwrap(), middle.reaction(joint).unwrap());
            near(found.force.unwrap()[0], exact.force.unwrap()[0]);
        }
        let d = middle.reaction("D").unwrap().force.unwrap();
        near(angles.reaction("loop_x").unwrap().generalized[0], d[0]);
        near(angles.reaction("loop_y").unwrap().generalized[0], d[1]);
    }
}

#[test]
fn joints_with_the_ground_carry_the_shaking_force() {
    let of = |mechanism: &dyn Fn(f64) -> Forces| [0.1, 0.7].map(mechanism);
    macro_rules! grounded {
        ($($Mechanism:ty),*) => {$(
            for forces in of(&|t| {
                let mechanism = <$Mechanism>::default();
                let state = mechanism.state_at(&Instant::at(t)).unwrap();
                mechanism.solver().forces(&state).unwrap()
            }) {
                on_ground::<$Mechanism>(&forces, [0.0; 2]);
            }
        )*};
    }
    grounded!(Carriage, Belts, Incline, Discs, Press, Roller);
}

#[test]
fn a_cylinder_lifts_what_inputs_say() {
    let lift = Lift;
    let inputs = [Signal::new(0.7, 0.1, 0.0), Signal::new(100.0, 0.0, 0.0)];
    let state = lift.state_at(&at(0.0, &inputs)).unwrap();
    let forces = lift.solver().forces(&state).unwrap();
    balanced(&lift, &state);
    assert_eq!("cylinder", forces.efforts[0].name);
    assert!((forces.efforts[0].rate - 0.1).abs() < 1e-12, "{forces}");
    // At rest the cylinder holds the moments of both weights about the pin.
    let inputs = [Signal::constant(0.7), Signal::constant(100.0)];
    let state = lift.state_at(&at(0.0, &inputs)).unwrap();
    let forces = lift.solver().forces(&state).unwrap();
    let (sin, cos) = state.q[2].sin_cos();
    let place = |x: f64, y: f64| [x * cos - y * sin, x * sin + y * cos];
    let (mass, load, end) = (place(1.0, 0.05), place(2.0, 0.0), place(0.8, 0.1));
    let along = [(end[0] - 0.5) / 0.7, (end[1] + 0.2) / 0.7];
    let arm = end[0] * along[1] - end[1] * along[0];
    let effort = 9.81 * (40.0 * mass[0] + 100.0 * load[0]) / arm;
    let found = forces.efforts[0].effort.unwrap();
    assert!((found - effort).abs() < 1e-9 * effort, "{found} instead of {effort}");
}

#[test]
fn what_redundant_joints_share_is_undetermined_and_the_rest_is_not() {
    let mechanism = Parallelogram;
    let state = mechanism.state_at(&Instant::at(0.2)).unwrap();
    let forces = mechanism.solver().forces(&state).unwrap();
    let determined = |joint: &str| forces.reaction(joint).unwrap().determined;
    for joint in ["A", "B", "C", "O1", "O2", "O3"] {
        assert!(!determined(joint), "{forces}");
    }
    // The flap hangs in one pin alone, and the drive supplies the power whoever carries the load.
    assert!(determined("hinge"), "{forces}");
    assert!(forces.effort("drive").is_some() && forces.effort("turn").is_some(), "{forces}");
    balanced(&mechanism, &state);
}

#[test]
fn what_nothing_holds_is_refused_and_a_given_coordinate_holds_it() {
    let pendulum = Pendulum;
    let state = pendulum.solver().with_guess(2, 0.3).state(&Instant::at(0.0)).unwrap();
    match pendulum.solver().forces(&state) {
        Err(SolveError::NotHeld { open: 1, could_be_given, .. }) => assert!(could_be_given.contains(&"rod.phi")),
        other => panic!("{other:?}"),
    }
    let held = pendulum.solver().with_given(2, Signal::constant(0.3));
    let state = held.state(&Instant::at(0.0)).unwrap();
    let forces = held.forces(&state).unwrap();
    let torque = 2.0 * 9.81 * 0.5 * 0.3_f64.cos();
    assert!((forces.effort("rod.phi").unwrap() - torque).abs() < 1e-12, "{forces}");
}

#[test]
fn what_dimensions_leave_open_is_refused() {
    let carrier = FreeCarrier;
    let state = carrier.state_at(&Instant::at(0.1)).unwrap();
    assert_eq!(1, state.degrees_of_freedom_left);
    match carrier.solver().forces(&state) {
        Err(SolveError::NotHeld { open: 1, .. }) => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_blade_carries_a_side_force() {
    let sleigh = Sleigh;
    let state = sleigh.state_at(&Instant::at(0.0)).unwrap();
    let forces = sleigh.solver().forces(&state).unwrap();
    // What blade, pull and heading exert together moves the mass.
    let sum = ["blade", "pull"].map(|joint| forces.reaction(joint).unwrap().force.unwrap());
    for c in 0..2 {
        let all = sum[0][c] + sum[1][c];
        assert!((all + forces.inertia.force[c]).abs() < 1e-12, "{forces}");
    }
    let angle = state.q[2] + 0.2;
    let along = sum[0][0] * angle.cos() + sum[0][1] * angle.sin();
    assert!(along.abs() < 1e-12, "a blade does not pull along itself: {forces}");
}

#[test]
fn a_mechanism_without_loads_has_no_forces() {
    let four_bar = kin_tests::mechanisms::FourbarLectureMid::default();
    let state = four_bar.state_at(&Instant::at(0.0)).unwrap();
    assert!(matches!(four_bar.solver().forces(&state), Err(SolveError::NoLoads { .. })));
    assert!(kin_tests::mechanisms::FourbarLectureMid::model().forces.is_none());
}
