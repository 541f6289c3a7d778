//! Rope: a taut, inextensible rope from the first point over all others to the last.
//!
//! Row (1), in units of length; between two points that of a [distance](super::Distance), in units of length squared,
//! because it often has a closed solution:
//! ```text
//! Σ |r_{k+1} − r_k| − e = 0        |r_Q − r_P|² − e² = 0
//! ```
//! The rope runs freely over the points in between, which are pulleys of negligible radius. A point may occur more
//! than once, as in a block and tackle; a length that varies is a winch. Singular where two consecutive points
//! coincide, because their distance has no gradient there. The row is an equation, so it does not detect a rope that
//! would have to push. Reports the length.

use super::distance;
use super::joint::{JointType, Reaction, joint};
use crate::constraint::{Assembly, Frame, JointRows, RowMeaning};
use crate::error::ModelError;
use crate::mechanism::{Mechanism, OperandSlot, OperandType, Place, Statement, Value};
use crate::vocabulary::Role;

joint! {
    /// Operands of a rope.
    Rope {
        /// The points, in their order along the rope.
        points: Vec<Place> = OperandSlot::points("points"),
        /// The length e.
        length: Value = OperandSlot::option("length", OperandType::Signal).positive(),
    }
    example: "#[rope(N: ground @ (0, 0), hook @ (0, 0), ground @ (0.2, 0), length = l)]"
}

impl JointType for Rope {
    const REACTION: Reaction = Reaction::Tension;

    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let points: Vec<_> = self.points.iter().map(|place| a.place(place)).collect();
        let mut length = a.graph.zero();
        for (pair, place) in points.windows(2).zip(self.points.iter().skip(1)) {
            let square = a.square_of_distance(&pair[0], &pair[1]);
            if a.graph.is_zero(square) {
                let message = "is the one before it, so that the distance of the two has no gradient";
                a.degenerate(place.origin, "this point of the rope", message);
            }
            let part = a.distance_of_points(&pair[0], &pair[1]);
            length = a.graph.add(length, part);
        }
        if let [p, q] = &points[..] {
            return JointRows { quantities: vec![("length", length)], ..distance::between(a, p, q, &self.length) };
        }
        let target = a.length(&self.length);
        let role = |k: usize| match k {
            0 => Role::P,
            k if k + 1 == points.len() => Role::Q,
            _ => Role::Via,
        };
        let mut rows = JointRows {
            frames: [points.first(), points.last()].map(|point| point.map(|point| point.frame)),
            geometry: points.iter().enumerate().map(|(k, p)| (role(k), p.frame, p.local.to_vec())).collect(),
            ..JointRows::default()
        };
        rows.geometry.push((Role::Value, rows.frames[0].unwrap_or(Frame::Ground), vec![target]));
        rows.residuals = vec![("", RowMeaning::Other, a.graph.sub(length, target))];
        rows.quantities = vec![("length", length)];
        rows
    }

    /// Rule: a rope has at least two points.
    fn check(&self, joint: &Statement, _: &Mechanism, errors: &mut Vec<ModelError>) {
        if self.points.len() < 2 {
            let message = format!("rope `{}` runs over two points or more", joint.name);
            errors.push(ModelError::new(joint.origin, message));
        }
    }
}
