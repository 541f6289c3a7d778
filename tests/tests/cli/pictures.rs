//! What pictures show of a mechanism.

use super::{good, kin, temporary};

/// A slider whose y and φ are held has a rail and a block, although no joint guides it, and its pin lies on the block.
#[test]
fn a_slider_that_is_held_has_a_rail_and_a_block() {
    let picture = temporary("held_slider.svg");
    let ran = kin(&format!("with_units animate --steps 3 --input turn=0.5 --out {}", picture.display()));
    assert_eq!((Some(0), ""), (ran.status, ran.err.as_str()));
    let svg = std::fs::read_to_string(&picture).expect("a picture");
    std::fs::remove_file(&picture).expect("it is there");
    let last = |part: &str| svg.rfind(part).unwrap_or_else(|| panic!("no {part} in {svg}"));
    // The pin of the slider is drawn after the block.
    assert!(last("<rect x=\"-9\"") < last("<circle cx=\"0\" cy=\"0\" r=\"3\""));
    // A rail is a long horizontal line with short strokes after it; the foot of the crank has the same form, but is short.
    let length = |path: &str| -> Option<f64> {
        let (from, rest) = path.split_once(",0L")?;
        let (to, _) = rest.split_once(",0M")?;
        Some(to.parse::<f64>().ok()? - from.parse::<f64>().ok()?)
    };
    let lengths: Vec<f64> = svg.split("d=\"M").filter_map(length).collect();
    assert!(lengths.iter().any(|length| *length > 50.0), "{lengths:?}");
}

/// The parts of a picture, one per line, with their first positions.
fn parts(line: &str) -> Vec<([f64; 2], String)> {
    let svg = good(line);
    assert!(!svg.contains("NaN"), "{svg}");
    let part = |line: &str| {
        let (at, rest) = line.strip_prefix("<g transform=\"translate(")?.split_once(')')?;
        let (x, y) = at.split_once(',')?;
        Some(([x.parse().ok()?, y.parse().ok()?], rest.to_owned()))
    };
    svg.lines().filter_map(part).collect()
}

/// A sun that is pinned to the ground, where its carrier is pinned too, is drawn around this pin, wherever its origin is.
#[test]
fn a_wheel_is_centred_on_its_axle() {
    for motion in ["--to 1 --steps 2", "--times 0"] {
        let all = parts(&format!("sun animate --format svg {motion}"));
        let corners = |text: &str| -> Option<Vec<[f64; 2]>> {
            let (path, _) = text.split_once("<path d=\"M")?.1.split_once("Z\" fill=\"#")?;
            let corner = |text: &str| text.split_once(',').and_then(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]));
            path.split('L').map(corner).collect()
        };
        let wheels: Vec<[f64; 2]> = all
            .iter()
            .filter_map(|([x, y], text)| {
                let corners = corners(text).filter(|corners| corners.len() > 20)?;
                let mean = |axis: usize| corners.iter().map(|corner| corner[axis]).sum::<f64>() / corners.len() as f64;
                Some([x + mean(0), y + mean(1)])
            })
            .collect();
        let foot = all.iter().find(|(_, text)| text.contains("<circle cx=\"0\" cy=\"0\"")).expect("a foot").0;
        assert_eq!(wheels.len(), 2, "{motion}: sun and planet");
        let off = wheels.iter().map(|at| (at[0] - foot[0]).hypot(at[1] - foot[1])).fold(f64::INFINITY, f64::min);
        assert!(off < 0.05, "{motion}: the sun is {off} pixels beside its axle");
    }
}

/// The effort of a driver of a sum of angles acts on both bodies; an arrow on one of them alone would be wrong.
#[test]
fn an_effort_without_one_body_has_no_arrow() {
    let turns = |text: &str| text.contains("#7c3aed") && text.contains("M18,0A");
    let count =
        parts("sun animate --forces --format svg --to 1 --steps 2").iter().filter(|(_, text)| turns(text)).count();
    // That of the difference turns back during the motion, which takes an arrow for either sense.
    assert_eq!(count, 2);
}

/// A single instant does not move; its arrows have no animation, whose times would not be numbers.
#[test]
fn a_picture_of_one_instant_has_no_animation() {
    let svg = good("sun animate --forces --format svg --times 0.3");
    assert!(svg.contains("class=\"force\"") && !svg.contains("<animateTransform") && !svg.contains("NaN"), "{svg}");
}

/// The texts of a diagram.
fn texts(line: &str) -> Vec<String> {
    let svg = good(line);
    let texts = svg.split("<text").skip(1).filter_map(|text| text.split_once('>')?.1.split_once('<'));
    texts.map(|(text, _)| text.to_owned()).collect()
}

/// What is drawn by default depends neither on the size of a mechanism nor on the unit of angles, and labels have no
/// rounding errors.
#[test]
fn diagrams_are_alike_at_every_size_and_in_degrees() {
    let of = |options: &str| texts(&format!("sized plot {options}"));
    for options in ["", "--degrees", "--set size=1e-9", "--set size=1e-4 --degrees", "--set size=1e6"] {
        let texts = of(options);
        assert!(texts.iter().any(|text| text == "slider.x in m"), "{options}: {texts:?}");
        assert!(texts.iter().all(|text| text.len() < 14), "{options}: {texts:?}");
    }
    assert!(of("--set size=1e-4").iter().any(|text| text == "5e-5" || text == "6e-5"));
}

/// At a dead centre rates have no value, and curves a gap.
#[test]
fn a_curve_does_not_cross_a_dead_centre() {
    let ran = kin("waves plot x_dot --along-arc --to 1 --steps 40");
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    assert_eq!(ran.out.matches("<path").count(), 2, "{}", ran.out);
}
