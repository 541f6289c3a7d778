//! The units of forces follow from the units in the description.

use kin_runtime::{Measure, Mechanism, mechanism};

macro_rules! arm {
    ($name:ident, $length:literal, $mass:literal, $stiffness:literal) => {
        /// An arm with a weight and a spring.
        #[mechanism]
        #[bodies(arm)]
        #[revolute(O: ground @ (0, 0), arm @ (0, 0))]
        #[driver(motor: arm.phi = 0.3 + t)]
        #[mass(arm @ (l, 0), mass = m)]
        #[spring(S: ground @ (0, 0), arm @ (l, 0), stiffness = k)]
        struct $name {
            #[param(0.3, unit = $length)]
            l: f64,
            #[param(2, unit = $mass)]
            m: f64,
            #[param(5, unit = $stiffness)]
            k: f64,
        }
    };
}

arm!(Metres, "m", "kg", "N/m");
arm!(Millimetres, "mm", "kg", "mN/mm");
arm!(Grams, "m", "g", "mN/m");

/// An arm whose stiffness alone tells the size of a force.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(motor: arm.phi = 0.3 + t)]
#[mass(arm @ (l, 0), mass = 1)]
#[spring(S: ground @ (0, 0), arm @ (l, 0), stiffness = k)]
struct ByStiffness {
    #[param(30, unit = "mm")]
    l: f64,
    #[param(5, unit = "N/mm")]
    k: f64,
}

/// Nothing tells what a mass of 2 is.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[driver(motor: arm.phi = 0.3 + t)]
#[mass(arm @ (l, 0), mass = 2)]
struct Unknown {
    #[param(0.3, unit = "m")]
    l: f64,
}

/// A block on a rod that turns: a point on a line drives it across the line, a relative angle turns the rod.
#[mechanism]
#[bodies(rod, block)]
#[revolute(O: ground @ (0, 0), rod @ (0, 0))]
#[relative_angle(turn: ground, rod = 0.2 + t)]
#[translational(guide: rod @ (0, 0), block @ (0, 0), axis = (1, 0))]
#[point_on_line(lift: ground @ (0, 0), block @ (0, a), axis = (1, 0), offset = a + v * t)]
#[guess(rod.phi = 0.2, block.x = a, block.y = 0)]
#[mass(block @ (0, 0), mass = m)]
struct Lifted {
    #[param(0.1, unit = "m/s")]
    v: f64,
    #[param(0.3, unit = "m")]
    a: f64,
    #[param(2, unit = "kg")]
    m: f64,
}

/// What drives a length is a force, what drives an angle a moment, whatever else the row contains.
#[test]
fn efforts_have_the_units_of_what_they_drive() {
    let out = concat!(env!("CARGO_TARGET_TMPDIR"), "/efforts.svg");
    let args = ["lifted", "plot", "lift.effort", "turn.effort", "--to", "1", "--steps", "4", "--out", out];
    assert_eq!(std::process::ExitCode::SUCCESS, kin_runtime::cli::run_from::<Lifted>(args));
    let picture = std::fs::read_to_string(out).unwrap();
    assert!(["effort in N<", "effort in N·m<"].iter().all(|label| picture.contains(label)), "{picture}");
}

#[test]
fn forces_have_the_units_of_masses_lengths_and_times() {
    let of = |model: &kin_runtime::model::Model| model.forces.unwrap().units.to_string();
    assert_eq!("forces in N, moments in N·m, energies in J, powers in W", of(Metres::model()));
    assert_eq!("forces in mN, moments in mN·mm, energies in uJ, powers in uW".replace("uJ", "mN·mm"), {
        of(Millimetres::model()).replace("µW", "uW")
    });
    assert_eq!("forces in mN, moments in mN·m, energies in mJ, powers in mW", of(Grams::model()));
    assert_eq!("forces in N, moments in N·mm, energies in mJ, powers in mW", of(ByStiffness::model()));
    assert_eq!("", of(Unknown::model()));
}

/// An arm on a held pivot, whose tip is lifted.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[point(tip = arm @ (l, 0))]
#[driver(lift: tip.y = v * t)]
#[guess(arm.phi = 0.1)]
#[mass(arm @ (l, 0), mass = m)]
struct LiftedTip {
    #[param(0.5, unit = "m")]
    l: f64,
    #[param(0.1, unit = "m/s")]
    v: f64,
    #[param(2, unit = "kg")]
    m: f64,
}

/// A wheel that is driven at its rim.
#[mechanism]
#[bodies(wheel)]
#[revolute(O: ground @ (0, 0), wheel @ (0, 0))]
#[driver(rim: r * wheel.phi = v * t)]
#[mass(wheel @ (r, 0), mass = m)]
struct Rim {
    #[param(0.5, unit = "m")]
    r: f64,
    #[param(0.1, unit = "m/s")]
    v: f64,
    #[param(2, unit = "kg")]
    m: f64,
}

/// A block that turns with its guide, a weld that turns, and a pair of gears whose offset moves.
#[mechanism]
#[bodies(block, table, pinion)]
#[translational(guide: ground @ (0, 0), block @ (0, 0), axis = (1, 0), angle = w * t)]
#[driver(push: block.x = v * t)]
#[fixed(weld: ground @ (0, 0), table @ (0, 0), angle = w * t)]
#[revolute(O: ground @ (0, 1), pinion @ (0, 0))]
#[gear(pair: table, pinion, radii = (r, 2 * r), offset = v * t)]
#[mass(block @ (0.1, 0), mass = m)]
struct Turned {
    #[param(2, unit = "kg")]
    m: f64,
    #[param(0.5, unit = "m")]
    r: f64,
    #[param(0.1, unit = "m/s")]
    v: f64,
    #[param(0.3, unit = "rad/s")]
    w: f64,
}

fn unit<M: Mechanism>(name: &str) -> Option<String> {
    Measure::named(M::model(), name).unwrap_or_else(|| panic!("{name}")).unit(&M::model().units)
}

/// The unit of a coordinate says nothing about a formula of it: the effort at a tip that an angle moves is no moment.
#[test]
fn formulas_of_coordinates_do_not_have_the_units_of_coordinates() {
    for (name, found) in [
        ("lift.effort", unit::<LiftedTip>("lift.effort")),
        ("tip.x/lift", unit::<LiftedTip>("tip.x/lift")),
        ("rim.effort", unit::<Rim>("rim.effort")),
        ("wheel.phi/rim", unit::<Rim>("wheel.phi/rim")),
        ("pair.effort", unit::<Turned>("pair.effort")),
    ] {
        assert_eq!(None, found, "{name}");
    }
}

/// The angle of a guide or a weld is a driving row of its own beside others that hold lengths.
#[test]
fn a_joint_that_is_turned_takes_a_moment() {
    for (name, expected) in [
        ("guide.effort", "N·m"),
        ("weld.effort", "N·m"),
        ("push.effort", "N"),
        ("block.phi/guide.angle", ""),
        ("block.x/guide.angle", "m/rad"),
        ("pinion.phi/weld.angle", ""),
        ("block.phi/push", "rad/m"),
    ] {
        assert_eq!(Some(expected), unit::<Turned>(name).as_deref(), "{name}");
    }
    // The stroke of the guide is an output: its angle is driven.
    let driven: Vec<String> = Measure::driven(Turned::model()).iter().map(|driven| driven.name().to_owned()).collect();
    assert_eq!(["block.phi", "block.x", "table.phi"], driven[..]);
}

/// Two motors that move one quantity, and one between them that moves another.
#[mechanism(allow_redundant)]
#[coordinates(u, v)]
#[driver(first: u = t)]
#[driver(other: v = 2 * t)]
#[driver(again: u = t)]
struct Shared;

#[test]
fn a_quantity_that_several_drivers_move_is_named_once() {
    let driven: Vec<String> = Measure::driven(Shared::model()).iter().map(|driven| driven.name().to_owned()).collect();
    assert_eq!(["u", "v"], driven[..]);
}
