//! Diagrams of forces.

use crate::machines::Middle;
use kin_runtime::Kinematics;
use kin_runtime::cli::run_from;

fn plotted(what: &[&str]) -> String {
    let name = what.join("-").replace([':', '.'], "_");
    let file = format!("{}/forces-{name}.svg", env!("CARGO_TARGET_TMPDIR"));
    let args: Vec<&str> = ["middle", "plot", "--out", &file].into_iter().chain(what.iter().copied()).collect();
    assert_eq!(std::process::ExitCode::SUCCESS, run_from::<Middle>(args), "{what:?}");
    std::fs::read_to_string(&file).unwrap()
}

#[test]
fn the_force_of_a_joint_is_a_polar_diagram() {
    let polar = plotted(&["B"]);
    let curve =
        |svg: &str| svg.split("<path d=").nth(1).and_then(|path| path.split(" stroke").next().map(str::to_owned));
    assert!(curve(&polar).is_some());
    assert_eq!(curve(&polar), curve(&plotted(&["B.force_x:B.force_y"])));
    assert!(polar.contains("B.force_x") && polar.contains("B.force_y"));
    let shaking = plotted(&["shaking"]);
    assert!(shaking.contains("shaking.force_x"));
    // Several forces share one diagram with one scale.
    let both = plotted(&["A", "B"]);
    assert!(both.contains("A.force") && both.contains("B.force"));
}

/// The page with arrows, and the data in it.
fn page(name: &str, arrows: bool) -> (String, serde_json::Value) {
    let file = format!("{}/{name}.html", env!("CARGO_TARGET_TMPDIR"));
    let args = ["middle", "animate", "--to", "1", "--steps", "10", "--out", &file];
    let asked = arrows.then_some("--forces");
    assert_eq!(std::process::ExitCode::SUCCESS, run_from::<Middle>(args.into_iter().chain(asked)));
    let page = std::fs::read_to_string(&file).unwrap();
    let data = page.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data = serde_json::from_str(data).unwrap();
    (page, data)
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// x, y, angle and size of an arrow at every instant.
type Arrow = [Vec<f64>; 4];

/// The arrows of a page: shafts and heads take turns.
fn arrows(data: &serde_json::Value) -> Vec<Arrow> {
    let tracks = data["runs"][0]["tracks"].as_array().unwrap().iter().filter_map(|track| track.as_array());
    let whole = |list: Vec<f64>| if list.len() == 1 { vec![list[0]; 11] } else { list };
    let arrows = tracks.filter(|track| track.len() == 4);
    arrows.map(|track| [0, 1, 2, 3].map(|axis| whole(numbers(&track[axis])))).collect()
}

/// Every reaction and every load has an arrow whose direction and length are those of the force, to one scale, with its
/// head at the end.
#[test]
fn arrows_are_the_forces() {
    let (html, data) = page("arrows", true);
    let arrows = arrows(&data);
    let times: Vec<f64> = (0..=10).map(|k| 0.1 * f64::from(k)).collect();
    let states = Middle.solver().sweep(&times).unwrap().states;
    let mut forces: Vec<(&str, Vec<[f64; 2]>)> = Vec::new();
    for joint in ["O", "A", "B", "D"] {
        let at = |state| Middle.solver().forces(state).unwrap().reaction(joint).unwrap().force.unwrap();
        forces.push((joint, states.iter().map(at).collect()));
    }
    let loads = states.iter().map(|state| Middle.solver().loads(state).unwrap()).collect::<Vec<_>>();
    for place in 0..loads[0].len() {
        if let Some(first) = loads[0][place].force {
            assert!(first[1] != [0.0; 2]);
            forces.push((loads[0][place].name, loads.iter().map(|at| at[place].force.unwrap()[1]).collect()));
        }
    }
    let names: Vec<&str> = forces.iter().map(|(name, _)| *name).collect();
    assert_eq!(["O", "A", "B", "D", "gravity", "gravity", "gravity", "pull", "S"], names[..]);
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    let largest = forces.iter().flat_map(|(_, list)| list).fold(0.0, |most: f64, force| most.max(size(*force)));
    let mut scale = None;
    for (name, list) in &forces {
        let shows = |pair: &&[Arrow]| {
            list.iter().enumerate().all(|(k, force)| {
                let share = size(*force) / largest;
                let shaft = (share - 0.03 * (share / 0.1).min(1.0)).max(0.0);
                // Pictures turn clockwise.
                let off = (pair[0][2][k].to_radians() + force[1].atan2(force[0])).rem_euclid(std::f64::consts::TAU);
                let turned = off.min(std::f64::consts::TAU - off) < 1e-3;
                turned && (pair[0][3][k] - shaft).abs() < 1e-3
            })
        };
        let pair = arrows.windows(2).find(shows).unwrap_or_else(|| panic!("no arrow shows {name}: {list:?}"));
        for (k, force) in list.iter().enumerate().filter(|(_, force)| size(**force) > 0.1 * largest) {
            let length = (pair[1][0][k] - pair[0][0][k]).hypot(pair[1][1][k] - pair[0][1][k]);
            let by_force = length / size(*force);
            assert!((by_force / *scale.get_or_insert(by_force) - 1.0).abs() < 0.01, "{name} at {k}");
        }
    }
    assert!(scale.unwrap() * largest > 50.0, "the largest arrow can be seen");
    assert!(html.contains("class=\"force\"") && html.contains("<label><input id=\"forces\""));
}

#[test]
fn without_being_asked_for_there_are_no_arrows() {
    let (html, data) = page("no-arrows", false);
    let tracks = data["runs"][0]["tracks"].as_array().unwrap();
    assert!(tracks.iter().all(|track| track.as_array().unwrap().len() == 3));
    assert!(!html.contains("class=\"force\"") && html.contains("<label hidden><input id=\"forces\""));
}

#[test]
fn a_picture_has_arrows_that_grow_and_a_scale() {
    let file = format!("{}/arrows.svg", env!("CARGO_TARGET_TMPDIR"));
    let args = ["middle", "animate", "--forces", "--to", "1", "--steps", "10", "--out", &file];
    assert_eq!(std::process::ExitCode::SUCCESS, run_from::<Middle>(args));
    let svg = std::fs::read_to_string(&file).unwrap();
    // A shaft and a head for every joint, the couple of the motor, and the scale.
    assert!(svg.matches("type=\"scale\"").count() >= 9, "{svg}");
    let label = svg.rsplit("<text").next().unwrap().split(['>', '<']).nth(1).unwrap();
    assert!(label.trim().parse::<f64>().is_ok_and(|force| force > 0.0), "{label}");
}
