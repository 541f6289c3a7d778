//! Attributes that users guess, and which kin calls otherwise. Their names are so common that attributes of other crates
//! may have them, too, so that they are answered only above a struct without derives of other crates.

use syn::punctuated::Punctuated;
use syn::{Attribute, Meta, Path, Token};

/// A guessed attribute, what to write instead, and whether it may have been meant to declare a name.
const GUESSED: &[(&str, &str, bool)] = &[
    ("ball", "a joint about which bodies turn is a `revolute`", false),
    ("base", GROUND, true),
    ("cam", "a cam with a point or a roller is an `on_curve`, one with a flat follower a `flat_follower`", false),
    ("chain", "a chain that keeps the ratio of two wheels is a `belt`", false),
    ("clamp", FIXED, false),
    ("cylinder", "a cylinder is a `distance` whose `length` is an input or depends on `t`", false),
    ("def", "a named expression is a `define`", true),
    ("fix", FIXED, false),
    ("frame", GROUND, true),
    ("friction", "there is no friction; a `force` or a `torque` may depend on rates, `dot(…)`", false),
    ("ground", GROUND, true),
    ("guide", SLIDING, false),
    ("hinged", "it is called `revolute`", false),
    ("init", GUESS, false),
    ("initial", GUESS, false),
    (
        "joint",
        "a joint is called by its kind: `revolute`, `translational`, `fixed`, `point_on_line`, `distance`, …",
        false,
    ),
    ("link", "a body is declared with `bodies`; a rod between two points is a `distance`", true),
    ("lock", FIXED, false),
    ("measure", OUTPUT, true),
    ("output", OUTPUT, true),
    ("pin", "it is called `revolute`", false),
    ("prism", "it is called `translational`", false),
    ("pulley", "a belt over two pulleys is a `belt`, a rope over points a `rope`", false),
    ("rack", "it is called `rack_pinion`", false),
    ("rail", SLIDING, false),
    ("rod", "a rod between two points is a `distance`; a body is declared with `bodies`", false),
    ("slide", "it is called `translational`", false),
    ("slot", "a pin in a slot is a `point_on_line`", false),
    ("spring_damper", "it is a `spring` with `stiffness = k` and `damping = c`", false),
    ("start", GUESS, false),
    ("unit", UNIT, false),
    ("units", UNIT, false),
    ("var", "a named expression is a `define`, a parameter a field of the struct", true),
    (
        "velocity",
        "a speed of a point along a direction is prescribed with `speed`, a motion in time with `driver`",
        false,
    ),
    ("wheel", "a wheel on a line or on another wheel is a `rolling`", false),
    ("world", GROUND, true),
];

const FIXED: &str =
    "two bodies are joined firmly with `fixed`; coordinates of a body are held with `#[body(crank, x = 0, y = 0)]`";
const GROUND: &str = "the fixed body is `ground` in every mechanism; it is not declared";
const GUESS: &str = "the start of an unknown coordinate is a `guess`: `#[guess(coupler.phi = 0.9)]`";
const OUTPUT: &str = "a named expression is a `define`, a named point a `point`; all of them are reported";
const SLIDING: &str =
    "a body that slides along a line without turning is joined with `translational`, a point with `point_on_line`";
const UNIT: &str = "a unit belongs to a parameter, `#[param(0.1, unit = \"m\")]`, or to the names of one attribute, \
                    `#[define(lift = slider.y, unit = \"m\")]`";

/// The message for a guessed attribute, and whether names may be missing because of it.
pub(super) fn guessed(name: &str) -> Option<(String, bool)> {
    let (_, right, declares) = GUESSED.iter().find(|(word, ..)| *word == name)?;
    Some((format!("no attribute `{name}` in kin; {right}"), *declares))
}

/// True if the attribute derives a trait that is not in the standard library: its macro may have attributes of its own.
pub(super) fn derives_of_others(attribute: &Attribute) -> bool {
    const STANDARD: [&str; 9] = ["Clone", "Copy", "Debug", "Default", "PartialEq", "Eq", "PartialOrd", "Ord", "Hash"];
    let Meta::List(list) = &attribute.meta else { return false };
    let is_standard = |path: &Path| path.segments.last().is_some_and(|s| STANDARD.iter().any(|known| s.ident == known));
    attribute.path().is_ident("cfg_attr")
        || attribute.path().is_ident("derive")
            && !list
                .parse_args_with(Punctuated::<Path, Token![,]>::parse_terminated)
                .is_ok_and(|paths| paths.iter().all(is_standard))
}
