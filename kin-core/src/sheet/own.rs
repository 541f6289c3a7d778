//! A joint's own equation, as the lecture writes it: with r + A s′ of both bodies, before anything is written out.

use super::vectors::{Piece, Symbol};
use crate::constraint::JointTag;

/// A joint with what its own equation is about. A body is its name, `None` the ground.
#[derive(Clone, Copy, Debug)]
pub struct Operands<'a> {
    /// Kind.
    pub tag: JointTag,
    /// Name.
    pub name: &'a str,
    /// Frames of the operands, as far as there are any.
    pub frames: [Option<Option<&'a str>>; 2],
    /// Frames that carry the points P and Q.
    pub points: [Option<Option<&'a str>>; 2],
}

/// The equations of a joint's rows; none where the rows are the user's own formulas.
pub(super) fn own(joint: &Operands<'_>) -> Vec<Vec<Piece>> {
    let of = |place: usize| joint.points[place].or(joint.frames[place]).map(|name| Body { name });
    let angle = |place: usize| joint.frames[place].map(|name| Body { name }.phi());
    let name = joint.name;
    let (Some(i), j) = (of(0), of(1)) else { return Vec::new() };
    let turned = |what: Vec<Piece>| angles(angle(1), angle(0), what);
    match (joint.tag, j) {
        (JointTag::Revolute, Some(j)) => vec![equals(difference(&j, &i, name), nothing())],
        (JointTag::Fixed, Some(j)) => {
            vec![equals(difference(&j, &i, name), nothing()), turned(scalar("c", name))]
        }
        (JointTag::Translational, Some(j)) => {
            vec![equals(across(&i, name), nothing()), turned(scalar("c", name)), vector(&j, &i, name)]
        }
        (JointTag::PointOnLine, Some(j)) => {
            vec![equals(across(&i, name), scalar("e", name)), vector(&j, &i, name)]
        }
        (JointTag::Distance, Some(j)) => {
            let square = vec![Piece::Transposed(Symbol::bold("d").of(name)), Piece::Vector(Symbol::bold("d").of(name))];
            vec![equals(square, vec![Piece::Squared(Symbol::plain("e").of(name))]), vector(&j, &i, name)]
        }
        (JointTag::RackPinion, Some(j)) => {
            let arc = [Piece::Op(" − "), Piece::Scalar(Symbol::plain("R").of(name)), Piece::Op("Δφ")];
            let stroke = along(&i, name).into_iter().chain(arc).collect();
            vec![equals(stroke, scalar("e", name)), vector(&j, &i, name)]
        }
        (JointTag::RollingOnLine, Some(j)) => {
            let roll = [
                Piece::Op(" + "),
                Piece::Scalar(Symbol::plain("R").of(name)),
                Piece::Op("("),
                Piece::Scalar(j.phi()),
                Piece::Op(" − "),
                Piece::Scalar(i.phi()),
                Piece::Op(")"),
            ];
            let rolled = along(&i, name).into_iter().chain(roll).collect();
            vec![equals(across(&i, name), scalar("R", name)), equals(rolled, scalar("e", name)), vector(&j, &i, name)]
        }
        (JointTag::KnifeEdge, _) => vec![equals(rate_across(&i, name), nothing())],
        (JointTag::Gear | JointTag::Belt, Some(_)) => gear(joint, angle(0), angle(1)),
        (JointTag::RelativeAngle, _) => vec![turned(scalar("e", name))],
        (JointTag::OnParametricCurve, Some(j)) => {
            let curve = [Piece::Op(" − "), i.matrix(), Piece::Vector(Symbol::bold("c").of(name)), Piece::Op("(u)")];
            vec![equals(difference(&j, &i, name).into_iter().chain(curve).collect(), nothing())]
        }
        _ => Vec::new(),
    }
    .into_iter()
    .filter(|equation| !equation.is_empty())
    .collect()
}

/// A frame with its symbols.
struct Body<'a> {
    name: Option<&'a str>,
}

impl Body<'_> {
    fn index(&self) -> &str {
        self.name.unwrap_or("0")
    }

    fn phi(&self) -> Symbol {
        Symbol::plain("φ").of(self.index())
    }

    fn matrix(&self) -> Piece {
        Piece::Vector(Symbol::bold("A").of(self.index()))
    }

    /// r + A s′, of the ground s alone.
    fn point(&self, joint: &str, sign: &'static str) -> Vec<Piece> {
        let local = Symbol::bold("s").of(self.index()).at(joint);
        match self.name {
            None => vec![Piece::Vector(local)],
            Some(name) => vec![
                Piece::Vector(Symbol::bold("r").of(name)),
                Piece::Op(sign),
                self.matrix(),
                Piece::Vector(local.primed()),
            ],
        }
    }
}

/// r_Q − r_P.
fn difference(j: &Body<'_>, i: &Body<'_>, joint: &str) -> Vec<Piece> {
    j.point(joint, " + ").into_iter().chain([Piece::Op(" − ")]).chain(i.point(joint, " − ")).collect()
}

/// d = r_Q − r_P.
fn vector(j: &Body<'_>, i: &Body<'_>, joint: &str) -> Vec<Piece> {
    equals(vec![Piece::Vector(Symbol::bold("d").of(joint))], difference(j, i, joint))
}

/// (A v̂)⊥ᵀ d.
fn across(i: &Body<'_>, joint: &str) -> Vec<Piece> {
    vec![axis(i, joint, "⊥ᵀ"), Piece::Vector(Symbol::bold("d").of(joint))]
}

/// (A v̂)ᵀ d.
fn along(i: &Body<'_>, joint: &str) -> Vec<Piece> {
    vec![axis(i, joint, "ᵀ"), Piece::Vector(Symbol::bold("d").of(joint))]
}

fn rate_across(i: &Body<'_>, joint: &str) -> Vec<Piece> {
    vec![axis(i, joint, "⊥ᵀ"), Piece::Vector(Symbol::bold("ṙ").of(joint))]
}

fn axis(i: &Body<'_>, joint: &str, mark: &'static str) -> Piece {
    let inner = match i.name {
        None => vec![Piece::Vector(Symbol::bold("v̂").of(joint))],
        Some(_) => vec![i.matrix(), Piece::Vector(Symbol::bold("v̂").of(joint))],
    };
    Piece::Marked(inner, mark)
}

/// φ_j − φ_i = what.
fn angles(j: Option<Symbol>, i: Option<Symbol>, what: Vec<Piece>) -> Vec<Piece> {
    match (j, i) {
        (Some(j), Some(i)) => equals(vec![Piece::Scalar(j), Piece::Op(" − "), Piece::Scalar(i)], what),
        _ => Vec::new(),
    }
}

/// R_a(φ_a − φ_c) ± R_b(φ_b − φ_c) = e, with c the carrier.
fn gear(joint: &Operands<'_>, a: Option<Symbol>, b: Option<Symbol>) -> Vec<Vec<Piece>> {
    let (Some(a), Some(b)) = (a, b) else { return Vec::new() };
    let arc = |place: &'static str, phi: Symbol| {
        [
            Piece::Scalar(Symbol::plain("R").of(place)),
            Piece::Op("("),
            Piece::Scalar(phi),
            Piece::Op(" − "),
            Piece::Scalar(Symbol::plain("φ").of("c")),
            Piece::Op(")"),
        ]
    };
    let sign = if joint.tag == JointTag::Gear { " + " } else { " − " };
    let both = arc("a", a).into_iter().chain([Piece::Op(sign)]).chain(arc("b", b)).collect();
    vec![equals(both, scalar("e", joint.name))]
}

fn scalar(letter: &'static str, joint: &str) -> Vec<Piece> {
    vec![Piece::Scalar(Symbol::plain(letter).of(joint))]
}

fn nothing() -> Vec<Piece> {
    vec![Piece::Op("0")]
}

fn equals(left: Vec<Piece>, right: Vec<Piece>) -> Vec<Piece> {
    left.into_iter().chain([Piece::Op(" = ")]).chain(right).collect()
}
