//! What pictures show of a mechanism.

use super::{kin, temporary};

/// A slider whose y and φ are held has a rail and a block, although no joint guides it, and its pin lies on the block.
#[test]
fn a_slider_that_is_held_has_a_rail_and_a_block() {
    let picture = temporary("held_slider.svg");
    let ran = kin(&format!("with_units animate --steps 3 --input turn=0.5 --out {}", picture.display()));
    assert_eq!((Some(0), ""), (ran.status, ran.err.as_str()));
    let svg = std::fs::read_to_string(&picture).expect("a picture");
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
