//! Sensitivities compared with the reference files of `tests/data/sensitivities`: every mode at every instant, by the
//! plan and by a factorisation of the whole Φ_q.

use crate::machines::*;
use kin_runtime::{Instant, Kinematics, Options, Sensitivity};
use kin_tests::case::Case;
use kin_tests::compare::{Differences, largest};
use kin_tests::mechanisms::{
    AndrewsCartesian, FourbarLectureAngles, FourbarLectureMid, PlanetaryBasic, QuickReturn, RackPinionSlider,
    SliderCrankInline,
};
use serde_json::Value;

/// The tolerance, relative to the largest derivative by the same parameter.
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

fn numbers(list: &Value) -> Vec<f64> {
    let number = |value: &Value| value.as_str().expect("a number as text").parse().expect("a number");
    list.as_array().expect("a list").iter().map(number).collect()
}

/// The name in kin of a parameter of the file: `boom_o_y` for `boom.O.y`, and `rp` for the radius `R` of a pinion.
fn name_in_kin(parameter: &str) -> String {
    if parameter == "R" { "rp".to_owned() } else { parameter.to_lowercase().replace('.', "_") }
}

fn agrees<M: Kinematics + Default>(name: &str) {
    let text = std::fs::read_to_string(format!("{}/data/sensitivities/{name}.json", env!("CARGO_MANIFEST_DIR")));
    let file: Value = serde_json::from_str(&text.unwrap()).unwrap();
    let case = Case::read(name);
    let mechanism = M::default();
    let names: Vec<&str> = M::model().parameters.iter().map(|parameter| parameter.name).collect();
    let mut differences = Differences::new();
    for exact_mode in file["modes"].as_array().unwrap() {
        let mode = case.modes.iter().find(|mode| exact_mode["name"] == mode.name.as_str()).unwrap();
        for exact in exact_mode["instants"].as_array().unwrap() {
            let t: f64 = exact["t"].as_str().unwrap().parse().unwrap();
            let instant = mode.instants.iter().find(|instant| instant.t == t).unwrap();
            for use_plan in [true, false] {
                let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
                let state = solver.state_from(&Instant::at(t), &instant.q).unwrap();
                let found = solver.sensitivities(&state).unwrap();
                assert_eq!(names.len(), found.by.len());
                for parameter in exact["dq"].as_object().unwrap().keys() {
                    let of = [parameter.clone(), name_in_kin(parameter)];
                    let Some(by) = of.iter().find_map(|name| found.by(name)) else {
                        // The file has it for a spring; the motion does not depend on it.
                        assert!(numbers(&exact["dqdd"][parameter]).iter().all(|by| *by == 0.0), "no {parameter}");
                        continue;
                    };
                    differences.at(format_args!("{name}, {}, t = {t}, by {parameter}, {use_plan}", mode.name));
                    compare(&mut differences, by, exact, parameter, file["output_point"].as_str().unwrap());
                }
            }
        }
    }
    differences.finish();
}

fn compare(differences: &mut Differences, found: &Sensitivity, exact: &Value, parameter: &str, point: &str) {
    let model = found.model;
    for (key, found) in [("dq", &found.q), ("dqd", &found.q_dot), ("dqdd", &found.q_ddot)] {
        let exact = numbers(&exact[key][parameter]);
        let tolerance = EXACT * largest(&exact).max(1e-3);
        differences.vector(key, |place| model.coordinates[place].name, &exact, found, tolerance);
    }
    let name = point.rsplit('.').next().unwrap_or(point);
    if let Some(place) = model.points.iter().position(|info| info.name == name) {
        let motion = found.points[place];
        for (key, found) in [("r", motion.r), ("v", motion.v), ("a", motion.a)] {
            let exact = numbers(&exact["dpoint"][parameter][key]);
            let tolerance = EXACT * largest(&exact).max(1e-3);
            differences.vector(point, |axis| format!("{key}[{axis}]"), &exact, &found, tolerance);
        }
    }
}
