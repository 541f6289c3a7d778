//! Substitution of the index variable in a member of a family of points at the place of its use.

use kin_core::mechanism::{BodyRef, Formula, Index, Member, Place};

/// `place` with `at` substituted for its index variable.
pub(super) fn place(place: &Place, at: Index) -> Place {
    Place { body: body(place.body, at), x: formula(&place.x, at), y: formula(&place.y, at), origin: place.origin }
}

fn body(body: BodyRef, at: Index) -> BodyRef {
    match body {
        BodyRef::Ground(origin) => BodyRef::Ground(origin),
        BodyRef::Body { family, index, origin } => BodyRef::Body { family, index: compose(index, at), origin },
    }
}

fn member(member: Member, at: Index) -> Member {
    Member { index: compose(member.index, at), ..member }
}

/// The composition of two indices. It saturates: an index that overflows is out of range anyway, and is reported as
/// such.
fn compose(outer: Index, inner: Index) -> Index {
    Index {
        scale: outer.scale.saturating_mul(inner.scale),
        offset: outer.scale.saturating_mul(inner.offset).saturating_add(outer.offset),
    }
}

/// `f` with `at` substituted for its index variable.
pub(super) fn formula(f: &Formula, at: Index) -> Formula {
    let inside = |a: &Formula| Box::new(formula(a, at));
    match f {
        Formula::Number(_) | Formula::Pi | Formula::Time | Formula::Curve(_) => f.clone(),
        Formula::Index(i) => Formula::Index(compose(*i, at)),
        Formula::Parameter(m) => Formula::Parameter(member(*m, at)),
        Formula::Input(m) => Formula::Input(member(*m, at)),
        Formula::Scalar(m) => Formula::Scalar(member(*m, at)),
        Formula::Define(m) => Formula::Define(member(*m, at)),
        Formula::Pose(b, component) => Formula::Pose(body(*b, at), *component),
        Formula::PointCoordinate(p, component) => Formula::PointCoordinate(Box::new(place(p, at)), *component),
        Formula::Distance(p, q) => Formula::Distance(Box::new(place(p, at)), Box::new(place(q, at))),
        Formula::Neg(a) => Formula::Neg(inside(a)),
        Formula::Add(a, b) => Formula::Add(inside(a), inside(b)),
        Formula::Sub(a, b) => Formula::Sub(inside(a), inside(b)),
        Formula::Mul(a, b) => Formula::Mul(inside(a), inside(b)),
        Formula::Div(a, b, origin) => Formula::Div(inside(a), inside(b), *origin),
        Formula::Pow(a, n) => Formula::Pow(inside(a), *n),
        Formula::Call(function, a) => Formula::Call(*function, inside(a)),
        Formula::Atan2(y, x) => Formula::Atan2(inside(y), inside(x)),
        Formula::Supplied(m, a) => Formula::Supplied(member(*m, at), inside(a)),
        Formula::Dot(a, origin) => Formula::Dot(inside(a), *origin),
    }
}
