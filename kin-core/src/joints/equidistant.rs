//! The example of the guide's chapter on a new constraint, `equidistant(N: P, Q, R)`: it compiles, and Φ is what it says.

use crate::constraint::{Assembly, ConstraintSet, Rows};
use crate::error::Origin;
use crate::mechanism::{BodyRef, Formula, Mechanism, Place};

struct Equidistant {
    p: Place,
    q: Place,
    r: Place,
}

impl Equidistant {
    fn rows(&self, a: &mut Assembly<'_>) -> Rows {
        let [p, q, r] = [&self.p, &self.q, &self.r].map(|place| a.place(place));
        let (to_q, to_r) = (a.square_of_distance(&p, &q), a.square_of_distance(&p, &r));
        Rows { residuals: vec![("", a.graph.sub(to_q, to_r))], ..Rows::between(&p, &q) }
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
    let [(suffix, phi)] = rows.residuals[..] else { panic!("one row") };
    assert_eq!(("", Some(25.0 - 5.0)), (suffix, assembly.graph.literal(phi)));
}
