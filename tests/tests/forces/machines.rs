//! Machines with masses and loads, for all kinds of joints that the reference files do not contain.

use kin_runtime::mechanism;

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
pub(crate) struct Middle;

/// The four-bar with frames at the ends of the links, origins held by the previous link, and angles from the same
/// lines.
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
pub(crate) struct Carried;

/// The four-bar by its angles alone; the poses of the bodies are held by formulas of them.
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
pub(crate) struct Angles;

/// A carriage with a prescribed motion, and a driven arm on it, from which a family of links hangs.
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
pub(crate) struct Carriage;

/// Two links in a field of gravity that varies in time.
#[mechanism]
#[bodies(arm, hand)]
#[revolute(O: ground @ (0.4, -0.3), arm @ (0, 0))]
#[revolute(A: arm @ (0.5, 0), hand @ (0, 0))]
#[driver(lift: arm.phi = sin(t))]
#[driver(turn: hand.phi = 2*t)]
#[gravity(3*sin(2*t), -9.81*(1 + 0.2*t))]
#[mass(arm @ (0.2, 0.01), mass = 3, inertia = 0.1)]
#[mass(hand @ (0.1, 0.02), mass = 1, inertia = 0.01)]
#[derive(Default)]
pub(crate) struct Shaken;

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
pub(crate) struct Belts;

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
pub(crate) struct Incline;

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
pub(crate) struct Discs;

/// The discs with a carrier of exactly the length that they keep, so that the carrier is redundant and swings freely.
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
pub(crate) struct FreeCarrier;

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
pub(crate) struct FlatFace;

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
pub(crate) struct Roller;

/// A block and tackle: the hook hangs on two strands and slides in a guide.
#[mechanism]
#[bodies(hook)]
#[point(eye = hook @ (0, 0.1))]
#[translational(guide: ground @ (0.1, 0), hook @ (0, 0), axis = (0, 1))]
#[rope(tackle: ground @ (0, 2), eye, ground @ (0.2, 2), length = 3 - 0.2*t - 0.1*sin(t))]
#[guess(hook.y = 0.3)]
#[gravity(0, -9.81)]
#[mass(hook @ (0, -0.05), mass = 12, inertia = 0.1)]
#[derive(Default)]
pub(crate) struct Tackle;

/// A screw press.
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
pub(crate) struct Press;

/// An arm on a cylinder; the length of the cylinder and the payload are inputs.
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
pub(crate) struct Lift;

/// A parallelogram with three cranks, one more than it needs.
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
pub(crate) struct Parallelogram;

/// A pendulum without a driver.
#[mechanism]
#[bodies(rod)]
#[revolute(O: ground @ (0, 0), rod @ (0, 0))]
#[gravity(0, -9.81)]
#[mass(rod @ (0.5, 0), mass = 2, inertia = 0.1)]
#[derive(Default)]
pub(crate) struct Pendulum;

/// A blade that cannot slip sideways, on a body with prescribed heading and speed.
#[mechanism]
#[bodies(sleigh)]
#[driver(heading: sleigh.phi = 0.3 + 0.8*t)]
#[knife_edge(blade: sleigh @ (0.3, -0.07), angle = 0.2)]
#[speed(pull: sleigh @ (0.3, -0.07), angle = 0.2, value = 0.9 + 0.25*t)]
#[guess(sleigh.x = 0, sleigh.y = 0)]
#[mass(sleigh @ (0.1, 0.05), mass = 7, inertia = 0.6)]
#[derive(Default)]
pub(crate) struct Sleigh;
