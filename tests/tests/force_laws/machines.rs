//! A machine has the same forces in every formulation: a slider-crank with Cartesian bodies, with held and carried
//! origins, with other joints for its guide, and by formulas of three scalar coordinates.

use kin_runtime::{Forces, Instant, Kinematics, mechanism};

/// Frames in the middle of the links.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (-0.1, 0))]
#[revolute(A: crank @ (0.1, 0), rod @ (-0.35, 0))]
#[revolute(B: rod @ (0.35, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 0.4 + 3*t + t*t)]
#[guess(rod.phi = -0.1, slider.x = 0.8)]
#[gravity(0.5, -9.81)]
#[mass(crank @ (0.02, 0.01), mass = 2, inertia = 0.03)]
#[mass(rod @ (-0.05, -0.02), mass = 1.5, inertia = 0.08)]
#[mass(slider @ (0.02, 0.03), mass = 3, inertia = 0.01)]
#[force(press: slider @ (0.05, 0.01), (-50 - 4*dot(slider.x), 3))]
#[torque(brake: crank, rod = 0.7)]
#[spring(S: ground @ (0.3, 0.4), rod @ (0.05, 0.03), stiffness = 90, free_length = 0.2, damping = 3)]
#[torsion_spring(T: crank, rod, stiffness = 2, free_angle = 0.3, damping = 0.2)]
#[derive(Default)]
struct Middle;

/// Frames at the joints: the crank's origin is held, the rod's is carried, and the slider cannot leave its axis.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(rod, origin = crank @ (0.2, 0))]
#[body(slider, y = 0, phi = 0)]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[driver(drive: crank.phi = 0.4 + 3*t + t*t)]
#[guess(rod.phi = -0.1, slider.x = 0.8)]
#[gravity(0.5, -9.81)]
#[mass(crank @ (0.12, 0.01), mass = 2, inertia = 0.03)]
#[mass(rod @ (0.3, -0.02), mass = 1.5, inertia = 0.08)]
#[mass(slider @ (0.02, 0.03), mass = 3, inertia = 0.01)]
#[force(press: slider @ (0.05, 0.01), (-50 - 4*dot(slider.x), 3))]
#[torque(brake: crank, rod = 0.7)]
#[spring(S: ground @ (0.3, 0.4), rod @ (0.4, 0.03), stiffness = 90, free_length = 0.2, damping = 3)]
#[torsion_spring(T: crank, rod, stiffness = 2, free_angle = 0.3, damping = 0.2)]
#[derive(Default)]
struct Ends;

/// Frames at the joints with other origins; the guide is a line and an angle, the crank's pin a point kept in x and y.
#[mechanism]
#[bodies(crank, rod, slider)]
#[x(Ox: crank @ (0, 0) = 0)]
#[y(Oy: crank @ (0, 0) = 0)]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[point_on_line(line: ground @ (0, 0), slider @ (0, 0), axis = (2, 0))]
#[angle(level: slider = 0)]
#[driver(drive: crank.phi = 0.4 + 3*t + t*t)]
#[guess(rod.phi = -0.1, slider.x = 0.8)]
#[gravity(0.5, -9.81)]
#[mass(crank @ (0.12, 0.01), mass = 2, inertia = 0.03)]
#[mass(rod @ (0.3, -0.02), mass = 1.5, inertia = 0.08)]
#[mass(slider @ (0.02, 0.03), mass = 3, inertia = 0.01)]
#[force(press: slider @ (0.05, 0.01), (-50 - 4*dot(slider.x), 3))]
#[torque(brake: crank, rod = 0.7)]
#[spring(S: ground @ (0.3, 0.4), rod @ (0.4, 0.03), stiffness = 90, free_length = 0.2, damping = 3)]
#[torsion_spring(T: crank, rod, stiffness = 2, free_angle = 0.3, damping = 0.2)]
#[derive(Default)]
struct Lines;

/// By the angles of crank and rod and the place of the slider; bodies are held by formulas of them.
#[mechanism]
#[coordinates(a, b, s)]
#[body(crank, x = 0, y = 0, phi = a)]
#[body(rod, x = 0.2*cos(a), y = 0.2*sin(a), phi = b)]
#[body(slider, x = s, y = 0, phi = 0)]
#[constraint(along: s = 0.2*cos(a) + 0.7*cos(b))]
#[constraint(across: 0.2*sin(a) + 0.7*sin(b) = 0)]
#[driver(drive: a = 0.4 + 3*t + t*t)]
#[guess(b = -0.1, s = 0.8)]
#[gravity(0.5, -9.81)]
#[mass(crank @ (0.12, 0.01), mass = 2, inertia = 0.03)]
#[mass(rod @ (0.3, -0.02), mass = 1.5, inertia = 0.08)]
#[mass(slider @ (0.02, 0.03), mass = 3, inertia = 0.01)]
#[force(press: slider @ (0.05, 0.01), (-50 - 4*dot(slider.x), 3))]
#[torque(brake: crank, rod = 0.7)]
#[spring(S: ground @ (0.3, 0.4), rod @ (0.4, 0.03), stiffness = 90, free_length = 0.2, damping = 3)]
#[torsion_spring(T: crank, rod, stiffness = 2, free_angle = 0.3, damping = 0.2)]
#[derive(Default)]
struct Formulas;

fn forces<M: Kinematics + Default>(t: f64) -> Forces {
    let mechanism = M::default();
    let state = mechanism.state_at(&Instant::at(t)).unwrap();
    mechanism.solver().forces(&state).unwrap()
}

#[test]
fn a_slider_crank_has_one_set_of_forces() {
    for t in [0.0, 0.3, 0.9, 1.4] {
        let [middle, ends, lines, formulas] =
            [forces::<Middle>(t), forces::<Ends>(t), forces::<Lines>(t), forces::<Formulas>(t)];
        let near = |what: &str, exact: f64, found: f64| {
            assert!((found - exact).abs() <= 1e-10 * exact.abs().max(100.0), "{what} at {t}: {found} is not {exact}");
        };
        for other in [&ends, &lines, &formulas] {
            near("effort", middle.effort("drive").unwrap(), other.effort("drive").unwrap());
            let totals = |f: &Forces| {
                let [x, y] = f.shaking.force;
                let powers = [f.driver_power, f.applied_power, f.damper_power, f.energy_rate];
                [&[x, y, f.shaking.moment, f.kinetic, f.gravity, f.elastic][..], &powers].concat()
            };
            for (exact, found) in totals(&middle).into_iter().zip(totals(other)) {
                near("a total", exact, found);
            }
        }
        let force = |forces: &Forces, joint: &str| forces.reaction(joint).unwrap().force.unwrap();
        let moment = |forces: &Forces, joint: &str| forces.reaction(joint).unwrap().moment.unwrap();
        let same = |what: &str, exact: [f64; 2], found: [f64; 2]| {
            (0..2).for_each(|c| near(what, exact[c], found[c]));
        };
        // The rod's origin is carried by the crank, whose own is held in x and in y.
        let [o, a, b] = ["O", "A", "B"].map(|joint| force(&middle, joint));
        same("O of ends", o, [force(&ends, "crank.x")[0], force(&ends, "crank.y")[1]]);
        same("A of ends", a, force(&ends, "rod.origin"));
        same("B of ends", b, force(&ends, "B"));
        same("O of lines", o, [force(&lines, "Ox")[0], force(&lines, "Oy")[1]]);
        same("A of lines", a, force(&lines, "A"));
        same("B of lines", b, force(&lines, "B"));
        let guide = [force(&middle, "guide")[1], moment(&middle, "guide")];
        same("guide of ends", guide, [force(&ends, "slider.y")[1], moment(&ends, "slider.phi")]);
        same("guide of lines", guide, [force(&lines, "line")[1], moment(&lines, "level")]);
        // The row along the slider's way pushes the slider as the rod does.
        near("B of formulas", b[0], formulas.reaction("along").unwrap().generalized[0]);
        near("couple on the slider", guide[1], moment(&formulas, "slider.phi"));
    }
}
