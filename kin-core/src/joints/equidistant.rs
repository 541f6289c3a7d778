//! The example of the guide's chapter on a new constraint, `equidistant(N: P, Q, R)`; the test checks its row of Φ.

use super::joint::{JointType, joint};
use crate::constraint::{Assembly, ConstraintSet, JointRows, RowMeaning};
use crate::error::Origin;
use crate::mechanism::{BodyRef, Formula, Mechanism, OperandSlot, Place};

// The example borrows the variant `Constraint` of the vocabulary; a real kind has a variant of its own.
joint! {
    /// Operands of a point with two equal distances.
    Equidistant as Constraint {
        /// P of body i.
        p: Place = OperandSlot::point("p"),
        /// Q of body j.
        q: Place = OperandSlot::point("q"),
        /// R of a third body.
        r: Place = OperandSlot::point("r"),
    }
    example: "#[equidistant(N: runner @ (0, 0), left @ (l, 0), right @ (l, 0))]"
}

impl JointType for Equidistant {
    fn rows(&self, a: &mut Assembly<'_>) -> JointRows {
        let [p, q, r] = [&self.p, &self.q, &self.r].map(|place| a.place(place));
        let (to_q, to_r) = (a.square_of_distance(&p, &q), a.square_of_distance(&p, &r));
        JointRows { residuals: vec![("", RowMeaning::Other, a.graph.sub(to_q, to_r))], ..JointRows::between(&p, &q) }
    }
}

#[test]
fn the_row_is_the_difference_of_two_squares() {
    let origin = Origin(0);
    let place =
        |x: f64, y: f64| Place { body: BodyRef::Ground(origin), x: Formula::Number(x), y: Formula::Number(y), origin };
    let (mechanism, mut set) = (Mechanism::default(), ConstraintSet::default());
    let mut assembly = Assembly::new(&mechanism, &mut set);
    let joint = Equidistant { p: place(1.0, 2.0), q: place(4.0, 6.0), r: place(-1.0, 3.0) };
    let rows = joint.rows(&mut assembly);
    let [(suffix, RowMeaning::Other, phi)] = rows.residuals[..] else { panic!("one row") };
    assert_eq!(("", Some(25.0 - 5.0)), (suffix, assembly.graph.literal(phi)));
}
