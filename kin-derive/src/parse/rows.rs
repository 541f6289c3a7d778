//! Joints, drivers and equations: how each is written, and what its parts become.
//!
//! A new kind is an entry of [`FORMS`] and a function that takes its [`Parts`] apart.

use super::parts::{OperandForm, OptionForm, Parts};
use crate::ast::{PairExpr, RowKind};

/// How a row is written.
pub(super) struct RowForm {
    /// The attribute.
    pub(super) keyword: &'static str,
    /// What stands behind the name, in order.
    pub(super) operands: &'static [OperandForm],
    /// True when `= expression` follows the last operand.
    pub(super) equals: bool,
    /// What can follow as `key = value`.
    pub(super) options: &'static [(&'static str, OptionForm)],
    /// A row as the user writes it.
    pub(super) example: &'static str,
    /// Takes the parts apart.
    pub(super) build: fn(&mut Parts) -> RowKind,
}

impl core::fmt::Debug for RowForm {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.keyword)
    }
}

use OperandForm::{Body, Expression, Point};

const TWO_POINTS: &[OperandForm] = &[Point, Point];
const TWO_BODIES: &[OperandForm] = &[Body, Body];

/// The options of gears and belts.
const PAIR: &[(&str, OptionForm)] =
    &[("radii", OptionForm::Radii), ("carrier", OptionForm::Body), ("offset", OptionForm::Expression)];

/// Every row of the language, in the order of the guide.
pub(super) const FORMS: &[RowForm] = &[
    RowForm {
        keyword: "revolute",
        operands: TWO_POINTS,
        equals: false,
        options: &[],
        example: "#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]",
        build: revolute,
    },
    RowForm {
        keyword: "translational",
        operands: TWO_POINTS,
        equals: false,
        options: &[("axis", OptionForm::Axis), ("angle", OptionForm::Expression)],
        example: "#[translational(A: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]",
        build: translational,
    },
    RowForm {
        keyword: "fixed",
        operands: TWO_POINTS,
        equals: false,
        options: &[("angle", OptionForm::Expression)],
        example: "#[fixed(A: crank @ (l1, 0), plate @ (0, 0), angle = 0)]",
        build: fixed,
    },
    RowForm {
        keyword: "point_on_line",
        operands: TWO_POINTS,
        equals: false,
        options: &[("axis", OptionForm::Axis), ("offset", OptionForm::Expression)],
        example: "#[point_on_line(A: rocker @ (0, 0), crank @ (l1, 0), axis = (1, 0))]",
        build: point_on_line,
    },
    RowForm {
        keyword: "distance",
        operands: TWO_POINTS,
        equals: false,
        options: &[("length", OptionForm::Expression)],
        example: "#[distance(A: crank @ (l1, 0), rocker @ (0, 0), length = l2)]",
        build: distance,
    },
    RowForm {
        keyword: "x",
        operands: &[Point],
        equals: true,
        options: &[],
        example: "#[x(A: slider @ (0, 0) = 0.1)]",
        build: x,
    },
    RowForm {
        keyword: "y",
        operands: &[Point],
        equals: true,
        options: &[],
        example: "#[y(A: slider @ (0, 0) = 0)]",
        build: y,
    },
    RowForm {
        keyword: "angle",
        operands: &[Body],
        equals: true,
        options: &[],
        example: "#[angle(A: slider = 0)]",
        build: angle,
    },
    RowForm {
        keyword: "relative_angle",
        operands: TWO_BODIES,
        equals: true,
        options: &[],
        example: "#[relative_angle(A: crank, rocker = pi/2)]",
        build: relative_angle,
    },
    RowForm {
        keyword: "on_curve",
        operands: TWO_POINTS,
        equals: false,
        options: &[
            ("polar", OptionForm::Curve(&["theta"])),
            ("implicit", OptionForm::Curve(&["X", "Y"])),
            ("parametric", OptionForm::Path),
            ("roller", OptionForm::Expression),
        ],
        example: "#[on_curve(A: cam @ (0, 0), follower @ (0, 0), polar(theta) = r + e*cos(theta))]",
        build: on_curve,
    },
    RowForm {
        keyword: "flat_follower",
        operands: TWO_POINTS,
        equals: false,
        options: &[("axis", OptionForm::Axis), ("support", OptionForm::Curve(&["theta"]))],
        example: "#[flat_follower(A: cam @ (0, 0), follower @ (0, 0), axis = (1, 0), support(theta) = r + e*cos(theta))]",
        build: flat_follower,
    },
    RowForm {
        keyword: "gear",
        operands: TWO_BODIES,
        equals: false,
        options: PAIR,
        example: "#[gear(A: sun, planet, radii = (r1, r2), carrier = arm)]",
        build: gear,
    },
    RowForm {
        keyword: "belt",
        operands: TWO_BODIES,
        equals: false,
        options: PAIR,
        example: "#[belt(A: motor, spindle, radii = (r1, r2))]",
        build: belt,
    },
    RowForm {
        keyword: "rack_pinion",
        operands: TWO_POINTS,
        equals: false,
        options: &[
            ("axis", OptionForm::Axis),
            ("pinion", OptionForm::Body),
            ("radius", OptionForm::Expression),
            ("offset", OptionForm::Expression),
        ],
        example: "#[rack_pinion(A: ground @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = wheel, radius = r)]",
        build: rack_pinion,
    },
    RowForm {
        keyword: "rolling",
        operands: TWO_POINTS,
        equals: false,
        options: &[
            ("axis", OptionForm::Axis),
            ("radius", OptionForm::Expression),
            ("radii", OptionForm::Radii),
            ("along", OptionForm::Scalar),
            ("offset", OptionForm::Expression),
        ],
        example: "#[rolling(A: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = r)]",
        build: rolling,
    },
    RowForm {
        keyword: "constraint",
        operands: &[Expression],
        equals: true,
        options: &[],
        example: "#[constraint(close_x: l1*cos(phi1) + l2*cos(phi2) = d1)]",
        build: constraint,
    },
    RowForm {
        keyword: "knife_edge",
        operands: &[Point],
        equals: false,
        options: &[("angle", OptionForm::Expression)],
        example: "#[knife_edge(A: sleigh @ (0, 0), angle = 0)]",
        build: knife_edge,
    },
    RowForm {
        keyword: "speed",
        operands: &[Point],
        equals: false,
        options: &[("angle", OptionForm::Expression), ("value", OptionForm::Expression)],
        example: "#[speed(A: sleigh @ (0, 0), angle = 0, value = v)]",
        build: speed,
    },
    RowForm {
        keyword: "nonholonomic",
        operands: &[Expression],
        equals: true,
        options: &[],
        example: "#[nonholonomic(A: dot(wheel.x) = -R*dot(wheel.phi))]",
        build: nonholonomic,
    },
    RowForm {
        keyword: "driver",
        operands: &[Expression],
        equals: true,
        options: &[],
        example: "#[driver(drive: crank.phi = phi0 + omega*t)]",
        build: driver,
    },
];

fn revolute(parts: &mut Parts) -> RowKind {
    RowKind::Revolute { p: parts.point(), q: parts.point() }
}

fn translational(parts: &mut Parts) -> RowKind {
    RowKind::Translational {
        p: parts.point(),
        q: parts.point(),
        axis: parts.axis("axis"),
        angle: parts.or_zero("angle"),
    }
}

fn fixed(parts: &mut Parts) -> RowKind {
    RowKind::Fixed { p: parts.point(), q: parts.point(), angle: parts.or_zero("angle") }
}

fn point_on_line(parts: &mut Parts) -> RowKind {
    RowKind::PointOnLine {
        p: parts.point(),
        q: parts.point(),
        axis: parts.axis("axis"),
        offset: parts.or_zero("offset"),
    }
}

fn distance(parts: &mut Parts) -> RowKind {
    RowKind::Distance { p: parts.point(), q: parts.point(), length: parts.required("length") }
}

fn x(parts: &mut Parts) -> RowKind {
    RowKind::X { p: parts.point(), value: parts.right() }
}

fn y(parts: &mut Parts) -> RowKind {
    RowKind::Y { p: parts.point(), value: parts.right() }
}

fn angle(parts: &mut Parts) -> RowKind {
    RowKind::Angle { body: parts.body(), value: parts.right() }
}

fn relative_angle(parts: &mut Parts) -> RowKind {
    RowKind::RelativeAngle { a: parts.body(), b: parts.body(), value: parts.right() }
}

fn on_curve(parts: &mut Parts) -> RowKind {
    RowKind::OnCurve { p: parts.point(), q: parts.point(), curve: parts.curve() }
}

fn flat_follower(parts: &mut Parts) -> RowKind {
    RowKind::FlatFollower {
        p: parts.point(),
        q: parts.point(),
        axis: parts.axis("axis"),
        support: parts.required("support"),
    }
}

fn gear(parts: &mut Parts) -> RowKind {
    RowKind::Gear(pair(parts))
}

fn belt(parts: &mut Parts) -> RowKind {
    RowKind::Belt(pair(parts))
}

fn pair(parts: &mut Parts) -> PairExpr {
    PairExpr {
        a: parts.body(),
        b: parts.body(),
        radii: parts.radii("radii"),
        carrier: parts.carrier("carrier"),
        offset: parts.or_zero("offset"),
    }
}

fn rack_pinion(parts: &mut Parts) -> RowKind {
    RowKind::RackPinion {
        p: parts.point(),
        q: parts.point(),
        axis: parts.axis("axis"),
        pinion: parts.name("pinion"),
        radius: parts.required("radius"),
        offset: parts.or_zero("offset"),
    }
}

/// A disc rolls on a line or on a disc; the options tell which.
fn rolling(parts: &mut Parts) -> RowKind {
    const LINE: [&str; 2] = ["axis", "radius"];
    const DISC: [&str; 2] = ["radii", "along"];
    const FORMS: &str =
        "a disc rolls on a line with `axis = (1, 0), radius = r`, on another disc with `radii = (r1, r2), along = psi`";
    let on_disc = match (parts.given(&LINE), parts.given(&DISC)) {
        (Some(line), Some(disc)) => {
            // What comes first says what is meant.
            let on_disc = parts.given(&[LINE, DISC].concat()) == Some(disc);
            let wrong = if on_disc { line } else { disc };
            let message = format!("`{wrong}` belongs to the other form of `{}`: {FORMS}", parts.keyword);
            parts.report.error(wrong.span(), message);
            parts.lost_option = true;
            on_disc
        }
        (None, None) => {
            if !parts.lost_option {
                parts.report.error(parts.keyword.span(), FORMS);
                parts.lost_option = true;
            }
            false
        }
        (_, disc) => disc.is_some(),
    };
    let (p, q) = (parts.point(), parts.point());
    if on_disc {
        let missing = DISC.into_iter().find(|key| parts.given(&[*key]).is_none());
        if let (Some(key), false) = (missing, parts.lost_option) {
            parts.report.error(parts.keyword.span(), format!("`{}` needs `{key} = …`: {FORMS}", parts.keyword));
            parts.lost_option = true;
        }
        let (radii, along) = (parts.radii("radii"), parts.name("along"));
        return RowKind::RollingOnDisc { p, q, radii, along, offset: parts.or_zero("offset") };
    }
    let (axis, radius) = (parts.axis("axis"), parts.required("radius"));
    RowKind::RollingOnLine { p, q, axis, radius, offset: parts.or_zero("offset") }
}

fn constraint(parts: &mut Parts) -> RowKind {
    RowKind::Constraint { left: parts.expr(), right: parts.right() }
}

fn knife_edge(parts: &mut Parts) -> RowKind {
    RowKind::KnifeEdge { p: parts.point(), angle: parts.or_zero("angle") }
}

fn speed(parts: &mut Parts) -> RowKind {
    RowKind::Speed { p: parts.point(), angle: parts.or_zero("angle"), value: parts.required("value") }
}

fn nonholonomic(parts: &mut Parts) -> RowKind {
    RowKind::Nonholonomic { left: parts.expr(), right: parts.right() }
}

fn driver(parts: &mut Parts) -> RowKind {
    RowKind::Driver { left: parts.expr(), right: parts.right() }
}
