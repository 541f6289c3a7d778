//! Constructors for rotated vectors with local simplification: a right angle only permutes the components, and ρ and
//! −ρ share one node.

use super::ROUNDING;
use super::graph::Graph;
use super::node::{ExprId, Node, Rotation, Turning};
use core::f64::consts::FRAC_PI_2;

/// The number of quarter turns (0 to 3) of an angle that is a small multiple of π/2 up to rounding. A user who writes `pi/2`
/// or `5*pi/6 - pi/3` means a right angle and not a nearby number whose cosine is 6e-17.
pub(crate) fn quarter_turns(angle: f64) -> Option<usize> {
    let quarters = (angle / FRAC_PI_2).round();
    let is_multiple = quarters.abs() <= 16.0 && (quarters * FRAC_PI_2 - angle).abs() <= ROUNDING * angle.abs().max(1.0);
    is_multiple.then(|| quarters.rem_euclid(4.0) as usize)
}

impl Graph {
    /// The rotated vector ρ = A(φ)·(x, y). ρ and −ρ share one node and differ by a sign.
    pub fn rotate(&mut self, angle: ExprId, [x, y]: [ExprId; 2]) -> [ExprId; 2] {
        if let Some(quarters) = self.literal(angle).and_then(quarter_turns) {
            let (minus_x, minus_y) = (self.neg(x), self.neg(y));
            return [[x, y], [minus_y, x], [minus_x, minus_y], [y, minus_x]][quarters];
        }
        if self.is_zero(x) && self.is_zero(y) {
            return [x, y];
        }
        let ((negative_x, positive_x), (negative_y, positive_y)) = (self.unsigned(x), self.unsigned(y));
        // The node is built for the vector whose first component that is not 0 has no minus sign; the opposite vector
        // is the negated node.
        let negative = if self.is_zero(x) { negative_y } else { negative_x };
        let base = if negative { [positive_x, if negative_y { positive_y } else { self.neg(y) }] } else { [x, y] };
        let rotation = Rotation { angle, x: base[0], y: base[1] };
        let (rx, ry) = (self.intern(Node::RotX(rotation)), self.intern(Node::RotY(rotation)));
        [self.signed(negative, rx), self.signed(negative, ry)]
    }

    /// u·d for a unit vector `u` that rotates with `angle`.
    pub fn dot(&mut self, angle: ExprId, u: [ExprId; 2], d: [ExprId; 2]) -> ExprId {
        if self.depends(angle).is_static() {
            return self.plain_dot(u, d);
        }
        if d.iter().all(|component| self.is_zero(*component)) {
            return self.zero();
        }
        self.intern(Node::Dot(Turning { angle, u, d }))
    }

    /// u×d = perp(u)·d for a unit vector `u` that rotates with `angle`.
    pub fn cross(&mut self, angle: ExprId, u: [ExprId; 2], d: [ExprId; 2]) -> ExprId {
        if self.depends(angle).is_static() {
            return self.plain_cross(u, d);
        }
        if d.iter().all(|component| self.is_zero(*component)) {
            return self.zero();
        }
        self.intern(Node::Cross(Turning { angle, u, d }))
    }

    /// a_x b_x + a_y b_y as products and a sum.
    pub fn plain_dot(&mut self, a: [ExprId; 2], b: [ExprId; 2]) -> ExprId {
        let (x, y) = (self.mul(a[0], b[0]), self.mul(a[1], b[1]));
        self.add(x, y)
    }

    /// a_x b_y − a_y b_x as products and a difference.
    pub fn plain_cross(&mut self, a: [ExprId; 2], b: [ExprId; 2]) -> ExprId {
        let (x, y) = (self.mul(a[0], b[1]), self.mul(a[1], b[0]));
        self.sub(x, y)
    }
}
