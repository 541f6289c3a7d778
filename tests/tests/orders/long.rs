//! Kernels so long that they are generated as several functions.

use kin_runtime::series::HigherOrders;
use kin_runtime::{Derivatives, Instant, Kinematics, Mechanism, mechanism};

const LINKS: usize = 270;

/// A chain of equal links that all turn with the same angle.
#[mechanism]
#[bodies(link[270])]
#[revolute(pin[i in 0..269]: link[i] @ (0.6 * l[i], cos(l[i])), link[i+1] @ (-0.4 * l[i+1], 0))]
#[revolute(first: ground @ (0, 0), link[0] @ (-0.4 * l[0], 0))]
#[driver(drive[i in 0..270]: link[i].phi = sin(t) + cos(l[i]))]
#[point(tip[i in 0..270] = link[i] @ (0.6 * l[i], 0.1))]
struct Chain {
    #[param(0.3)]
    l: [f64; 270],
}

/// If every link has the same motion, all members of a family have the same right-hand sides.
#[test]
fn members_of_a_family_have_equal_right_hand_sides() {
    let chain = Chain::default();
    let of = |link: [f64; 3]| -> Vec<f64> { (0..LINKS).flat_map(|_| link).collect() };
    let mut orders = HigherOrders::new(&chain, 5);
    orders.begin(&Instant::at(0.3), &of([0.1, 0.2, 0.3]), &of([0.5, -0.6, 0.7]), &of([1.1, 0.9, -0.8])).unwrap();
    let mut before = [0.0; 3];
    for order in 3..=5 {
        let right = orders.right();
        assert_eq!((order, Chain::ROWS), (orders.order(), right.len()));
        for pair in right[..2 * (LINKS - 1)].chunks(2) {
            assert_eq!(right[..2], *pair);
        }
        let drivers = &right[2 * LINKS..];
        assert!(drivers.iter().all(|drive| *drive == drivers[0]));
        let expected = [-(0.3_f64.cos()), 0.3_f64.sin(), 0.3_f64.cos()][order - 3];
        assert!((drivers[0] - expected).abs() < 1e-15);
        assert!(right[0] != before[0] && right[1] != before[1]);
        before = [right[0], right[1], drivers[0]];
        orders.advance(&of([0.2, -0.3, 0.4])).unwrap();
    }
}

/// If every link has the same motion, all tips have the same derivatives.
#[test]
fn members_of_a_family_have_equal_points() {
    let of = |link: [f64; 3]| -> Vec<f64> { (0..LINKS).flat_map(|_| link).collect() };
    let orders = [[0.1, 0.2, 0.3], [0.5, -0.6, 0.7], [1.1, 0.9, -0.8], [0.2, -0.3, 0.4], [3.0, 2.0, 1.0]];
    let derivatives = Derivatives {
        t: 0.3,
        inputs: Vec::new(),
        further: Vec::new(),
        q: orders.into_iter().map(of).collect(),
        by_plan: false,
    };
    let motion = Chain::default().solver().motion_derivatives(&derivatives).unwrap();
    assert_eq!(LINKS, motion.points.len());
    assert!(motion.points.iter().all(|point| *point == motion.points[0]));
    for (expected, found) in orders.iter().zip(&motion.bodies[LINKS - 1]).take(4) {
        assert_eq!(expected, found);
    }
    let ([sx, sy], phi) = ([0.18, 0.1], 0.3_f64);
    let expected = 0.5 - 0.7 * (sx * phi.sin() + sy * phi.cos());
    assert!((motion.points[7][1][0] - expected).abs() < 1e-15);
}
