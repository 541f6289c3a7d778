//! Laws of drawings: every body on a page has the pose that the analysis computes.

use crate::motion::grid;
use kin_runtime::Signal;
use kin_tests::subject::{Inputs, Setup, Subject};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The indices of the groups that belong to bodies in the first motion of a page, with the indices of the bodies.
fn groups_of_bodies(page: &str) -> Vec<(usize, usize)> {
    let start = page.find("<g class=\"run\">").expect("a drawing") + "<g class=\"run\">".len();
    let end = page[start..].find("<g class=\"run\">").map_or(page.len(), |length| start + length);
    let groups = page[start..end].split("<g").skip(1).enumerate();
    let body = |text: &str| text.strip_prefix(" data-body=\"")?.split('"').next()?.parse().ok();
    groups.filter_map(|(place, text)| Some((place, body(text)?))).collect()
}

fn data(page: &str) -> Value {
    let start = page.find("id=\"data\">").expect("the data") + "id=\"data\">".len();
    let text = &page[start..];
    serde_json::from_str(&text[..text.find("</script>").expect("its end")]).expect("JSON")
}

/// The x, y and angle of a group at an instant; constant numbers occur once.
fn pose(data: &Value, group: usize, instant: usize) -> [f64; 3] {
    let track = &data["runs"][0]["tracks"][group];
    [0, 1, 2].map(|axis| {
        let list = track[axis].as_array().expect("a list");
        list[if list.len() == 1 { 0 } else { instant }].as_f64().expect("a number")
    })
}

/// The inputs at the first instant, as command-line options.
fn inputs(mechanism: &dyn Subject, from: f64) -> Vec<String> {
    let option = |(name, u): (&&str, &Signal)| format!("--input={name}={},{},{}", u.value, u.rate, u.acceleration);
    mechanism.model().inputs.iter().zip(&mechanism.signals(from)).map(option).collect()
}

/// The poses of the groups are those of the bodies, up to the translation, scaling and reflection of the picture.
pub(crate) fn drawings_show_the_poses(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    if model.bodies.is_empty() {
        return;
    }
    // Inputs given as options continue with constant acceleration, so the motion is short enough for every mechanism.
    let times = grid(from, from + 0.05 * (to - from), 3);
    let file: PathBuf = std::env::temp_dir().join(format!("kin-drawing-{}-{}.html", std::process::id(), model.name));
    let instants: Vec<String> = times.iter().map(f64::to_string).collect();
    let mut line = vec!["program".to_owned(), "animate".to_owned(), "--least-norm".to_owned()];
    line.push(format!("--times={}", instants.join(",")));
    line.push(format!("--out={}", file.display()));
    line.extend(inputs(mechanism, from));
    let _ = mechanism.run(line.into_iter().map(Into::into).collect());
    let page = read(&file);
    let (data, groups) = (data(&page), groups_of_bodies(&page));
    assert_eq!(groups.len(), model.bodies.len());

    let first = mechanism.signals(from);
    let after = |t: f64, out: &mut [Signal]| {
        out.iter_mut().zip(&first).for_each(|(to, u)| *to = u.after(t - from));
    };
    let states = mechanism
        .solver_with(Setup { inputs: Inputs::By(&after), ..Setup::default() })
        .sweep(&times)
        .expect("it moves");
    let mut pairs = Vec::new();
    for (instant, state) in states.iter().enumerate() {
        let motion = mechanism.solver().motion(state).expect("it is solved");
        for &(group, body) in &groups {
            let body = &motion.bodies[body];
            let [x, y, angle] = pose(&data, group, instant);
            assert!((angle + body.phi.to_degrees()).abs() < 0.006, "{angle} {}", body.phi);
            pairs.push(([body.x, body.y], [x, y]));
        }
    }
    // All bodies have the same scale and translation.
    let far = |axis: usize| {
        let by = |a: &&([f64; 2], [f64; 2]), b: &&([f64; 2], [f64; 2])| a.0[axis].total_cmp(&b.0[axis]);
        (pairs.iter().min_by(by).expect("a body"), pairs.iter().max_by(by).expect("a body"))
    };
    for (axis, sign) in [(0, 1.0), (1, -1.0)] {
        let (low, high) = far(axis);
        let extent = high.0[axis] - low.0[axis];
        let scale = sign * (high.1[axis] - low.1[axis]) / extent;
        assert!(extent < 1e-9 || scale > 0.0, "axis {axis} is not as a picture has it");
        for (place, pixels) in &pairs {
            let expected =
                if extent > 1e-9 { low.1[axis] + sign * scale * (place[axis] - low.0[axis]) } else { low.1[axis] };
            assert!((pixels[axis] - expected).abs() < 0.03, "{place:?} is drawn at {pixels:?}");
        }
    }
    fs::remove_file(&file).expect("the file is there");
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("the page is written")
}
