//! The parts of a carrier: lengths in the mechanism's units, strokes and symbols in pixels.

use crate::model::Frame;

/// A colour: of a body, of the ground, or of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ink {
    /// Of a body, by its place.
    Body(usize),
    /// Of the ground and of pins.
    Ground,
    /// Of a path, by the place of its point.
    Path(usize),
    /// Of the forces of joints.
    Reaction,
    /// Of the efforts of drivers.
    Effort,
    /// Of the forces of loads.
    Load,
}

impl Ink {
    /// The colour of a frame.
    pub(crate) fn of(frame: Frame) -> Self {
        match frame {
            Frame::Body(body) => Self::Body(body),
            Frame::Ground => Self::Ground,
        }
    }
}

/// A part of a drawing in the frame of its carrier.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Part {
    /// A bar along two points; three or more points are an outline, which is filled.
    Bar { points: Vec<[f64; 2]>, ink: Ink },
    /// A line through two or more points. If it is closed, it returns to its start; it is then filled if its stroke is
    /// [`Full`](Stroke::Full).
    Line { points: Vec<[f64; 2]>, ink: Ink, stroke: Stroke, closed: bool },
    /// The path of a point: a smooth curve through places at which its direction is known, with the two inner control
    /// points of every piece between two of them (cubic Bézier curves).
    Path { points: Vec<[f64; 2]>, controls: Vec<[[f64; 2]; 2]>, ink: Ink },
    /// A pin between bodies.
    Pin([f64; 2]),
    /// A pin on the ground: the foot under it is hatched.
    Foot([f64; 2]),
    /// A weld between bodies.
    Weld([f64; 2]),
    /// A line of the ground with its hatching on the right of the way from `from` to `to`.
    Hatching { from: [f64; 2], to: [f64; 2] },
    /// The block of a slider, along the x axis of its carrier.
    Block(Ink),
    /// A slot or a rail on a body.
    Slot { from: [f64; 2], to: [f64; 2], ink: Ink },
    /// A disc with a spoke that shows how it turns.
    Disc { centre: [f64; 2], radius: f64, ink: Ink },
    /// A named point.
    Dot([f64; 2], Ink),
    /// A position that a point is to pass.
    Target([f64; 2]),
    /// A wheel or blade that does not slip sideways, seen from above, along the x axis of its carrier.
    Tread,
    /// The shaft of an arrow along the x axis, with the length of the arrow of the largest force.
    Shaft(f64, Ink),
    /// The head of an arrow along the x axis, its tip at the origin.
    Head(Ink),
    /// A curved arrow around the origin, for a couple.
    Turn { clockwise: bool, ink: Ink },
    /// A name, always upright.
    Name(String, LabelKind),
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stroke {
    /// As wide as the outline of a body.
    Full,
    /// Thin.
    Thin,
    /// Thin, in dashes.
    Dashed,
}

/// What a name belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LabelKind {
    Body,
    Joint,
    Point,
}

impl Part {
    /// What holds a point of a frame: a foot on the ground, a pin on a body.
    pub(super) const fn held_by(frame: Frame) -> Self {
        match frame {
            Frame::Ground => Self::Foot([0.0; 2]),
            Frame::Body(_) => Self::Pin([0.0; 2]),
        }
    }

    /// A line that is not closed.
    pub(super) const fn line(points: Vec<[f64; 2]>, ink: Ink, stroke: Stroke) -> Self {
        Self::Line { points, ink, stroke, closed: false }
    }

    /// Calls `each` with points that the view must contain, in the carrier's frame.
    pub(crate) fn reach(&self, each: &mut dyn FnMut([f64; 2])) {
        match self {
            Self::Bar { points, .. } | Self::Line { points, .. } | Self::Path { points, .. } => {
                points.iter().copied().for_each(each);
            }
            &Self::Pin(p) | &Self::Foot(p) | &Self::Weld(p) | &Self::Dot(p, _) | &Self::Target(p) => each(p),
            &Self::Hatching { from, to } | &Self::Slot { from, to, .. } => {
                each(from);
                each(to);
            }
            &Self::Disc { centre: [x, y], radius, .. } => {
                let r = radius.abs();
                [[x - r, y], [x + r, y], [x, y - r], [x, y + r]].into_iter().for_each(each);
            }
            Self::Block(_) | Self::Tread | Self::Name(..) | Self::Shaft(..) | Self::Head(_) | Self::Turn { .. } => {
                each([0.0, 0.0]);
            }
        }
    }
}
