//! Forces compared with the reference files in `tests/data/forces`: every mode at every instant.

use kin_runtime::model::Frame;
use kin_runtime::{Forces, Instant, Kinematics, Reaction};
use kin_tests::case::Case;
use kin_tests::mechanisms::loaded::*;
use serde_json::Value;

/// Tolerance relative to the largest force or couple of the instant.
const EXACT: f64 = 1e-9;

macro_rules! cases {
    ($($name:ident: $Mechanism:ty,)*) => {$(
        #[test]
        fn $name() {
            agrees::<$Mechanism>(stringify!($name));
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
    klann_leg: KlannLeg,
    macpherson_strut: MacphersonStrut,
    peaucellier: Peaucellier,
    planetary_basic: PlanetaryBasic,
    quick_return: QuickReturn,
    rack_pinion_slider: RackPinionSlider,
    robot_3rrr: Robot3rrr,
    scotch_yoke: ScotchYoke,
    slider_crank_inline: SliderCrankInline,
    toggle_press: TogglePress,
    watt_sixbar: WattSixbar,
}

fn number(value: &Value) -> f64 {
    value.as_str().expect("a number as text").parse().expect("a number")
}

fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn agrees<M: Kinematics + Default>(name: &str) {
    let text = std::fs::read_to_string(format!("{}/data/forces/{name}.json", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    let case = Case::read(name);
    let mechanism = M::default();
    let mut compared = 0;
    for (mode, forces) in case.modes.iter().zip(file["modes"].as_array().unwrap()) {
        assert_eq!(forces["name"], mode.name.as_str());
        for (instant, exact) in mode.instants.iter().zip(forces["instants"].as_array().unwrap()) {
            let at = Instant { t: instant.t, inputs: &[] };
            let state = mechanism.solver().state_from(&at, &instant.q).unwrap();
            let found = mechanism.solver().forces(&state).unwrap();
            compare(&found, exact, &format!("{name}, {}, t = {}", mode.name, instant.t));
            compared += 1;
        }
    }
    assert!(compared > 0);
}

fn compare(found: &Forces, exact: &Value, at: &str) {
    let of = |key: &str| exact[key].as_array().unwrap();
    let efforts = of("efforts").iter().map(|effort| number(&effort["effort"]));
    let reactions = of("reactions").iter().flat_map(|reaction| {
        let force = reaction.get("force").map_or([0.0; 2], pair);
        [force[0], force[1], reaction.get("moment").map_or(0.0, number)]
    });
    let largest = efforts.chain(reactions).fold(0.0, |largest, value: f64| value.abs().max(largest));
    let near = |found: f64, exact: f64, what: &str| {
        let size = largest.max(exact.abs());
        assert!((found - exact).abs() <= EXACT * size, "{at}: {what} is {found} instead of {exact}");
    };
    for effort in of("efforts") {
        let driver = effort["driver"].as_str().unwrap();
        let found =
            found.efforts.iter().find(|found| found.name == driver).unwrap_or_else(|| panic!("{at}: no {driver}"));
        near(found.effort.unwrap(), number(&effort["effort"]), driver);
        near(found.rate, number(&effort["rate"]), driver);
    }
    let drivers: Vec<&str> = of("efforts").iter().map(|effort| effort["driver"].as_str().unwrap()).collect();
    for reaction in of("reactions").iter().filter(|reaction| !drivers.contains(&reaction["name"].as_str().unwrap())) {
        let same = |joint: &&Reaction| is(found, joint, reaction, EXACT * largest);
        assert!(found.reactions.iter().any(|joint| same(&joint)), "{at}: no joint has {reaction}\n{found}");
    }
    let shaking = &exact["shaking"];
    for (found, force, moment) in
        [(found.shaking, "force", "moment"), (found.inertia, "inertia_force", "inertia_moment")]
    {
        let [x, y] = pair(&shaking[force]);
        near(found.force[0], x, force);
        near(found.force[1], y, force);
        near(found.moment, number(&shaking[moment]), moment);
    }
    near(found.kinetic, number(&exact["energy"]["kinetic"]), "kinetic energy");
    near(found.gravity, number(&exact["energy"]["gravity"]), "energy of gravity");
    near(found.elastic, number(&exact["energy"]["springs"]), "energy of springs");
    near(found.driver_power, number(&exact["power"]["drivers"]), "power of drivers");
    near(found.applied_power, number(&exact["power"]["applied"]), "applied power");
    near(found.damper_power, number(&exact["power"]["dampers"]), "power of dampers");
    near(found.energy_rate, number(&exact["power"]["energy_rate"]), "rate of all energy");
    let springs = of("springs").iter().map(|spring| (spring, "length", "tension"));
    let torsion = of("torsion_springs").iter().map(|spring| (spring, "angle", "torque"));
    for (spring, length, force) in springs.chain(torsion) {
        let name = spring["name"].as_str().unwrap();
        let found = found.springs.iter().find(|found| found.name == name).unwrap();
        near(found.length, number(&spring[length]), length);
        near(found.rate, number(&spring["rate"]), "rate");
        near(found.force, number(&spring[force]), force);
        near(found.energy, number(&spring["energy"]), "energy");
        near(found.damper_power, number(&spring["damping_power"]), "power of a damper");
    }
}

/// True if a joint has the reaction that the file contains.
fn is(forces: &Forces, joint: &Reaction, exact: &Value, tolerance: f64) -> bool {
    let name = |frame: Frame| match frame {
        Frame::Ground => "ground",
        Frame::Body(place) => forces.model.bodies[place].name,
    };
    let near = |found: f64, exact: f64| (found - exact).abs() <= tolerance.max(1e-12);
    let near_pair = |found: [f64; 2], exact: [f64; 2]| near(found[0], exact[0]) && near(found[1], exact[1]);
    if let Some(torques) = exact["torques"].as_object() {
        return torques.iter().all(|(body, couple)| {
            joint.couples.iter().any(|(frame, found)| name(*frame) == body && near(*found, number(couple)))
        });
    }
    if let Some(value) = exact.get("generalized") {
        return joint.generalized.iter().any(|found| near(*found, number(value)));
    }
    let on = joint.on.is_some_and(|frame| exact["on"] == name(frame));
    let force = match (exact.get("force"), joint.force, joint.point) {
        (Some(force), Some(found), Some(point)) => {
            near_pair(found, pair(force)) && near_pair(point, pair(&exact["point"]))
        }
        (None, found, _) => found.is_none(),
        _ => false,
    };
    let moment = near(joint.moment.unwrap_or(0.0), exact.get("moment").map_or(0.0, number));
    on && force && moment
}
