//! Diagrams of forces.

use crate::machines::Middle;
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
