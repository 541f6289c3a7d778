//! Loops that share all their links: none of the angles is in one loop only, and no link has the same vector in two.

mod support;

use kin_core::mechanism::Formula;
use support::chains::*;
use support::*;

/// Three loops over six angles, each angle in two of them.
const LOOPS: [[usize; 4]; 3] = [[0, 1, 2, 3], [0, 1, 4, 5], [2, 3, 4, 5]];

#[test]
fn angles_of_several_loops_are_left_to_one() {
    let mut compared = 0;
    for seed in 0..20 {
        let mut random = Random(seed);
        let q: Vec<f64> = (0..6).map(|_| random.between(-3.0, 3.0)).collect();
        let mut rows = Vec::new();
        for angles in LOOPS {
            // What the loop's vectors come to in this pose, and a drift.
            let (mut sides, mut end) = ([Formula::ZERO, Formula::ZERO], [0.0; 2]);
            for k in angles {
                let u = [0; 2].map(|_| random.between(-1.0, 1.0));
                end = plus(end, turned(q[k], u));
                let [x, y] = [[u[0], -u[1]], [u[1], u[0]]]
                    .map(|[c, s]| add(mul(number(c), cos(scalar(k))), mul(number(s), sin(scalar(k)))));
                let [a, b] = sides;
                sides = [add(a, x), add(b, y)];
            }
            for (side, end) in sides.into_iter().zip(end) {
                let drift = mul(number(random.between(-0.1, 0.1)), Formula::Time);
                rows.push(sub(sub(side, number(end)), drift));
            }
        }
        let oracle = Oracle::new(&equations(6, 0, rows), &[]);
        let planned = Planned::new(&oracle);
        let Some(truth) = oracle.solve(0.01, &q).filter(|found| found.amplification < 30.0) else { continue };
        assert!(planned.newton().iter().sum::<usize>() <= 5, "{}", planned.0);
        let modes: Vec<f64> = planned.closures(&oracle, 0.01, &truth.q).iter().map(|w| w.signum()).collect();
        let found = planned.run(&oracle, 0.01, &modes, &truth.q);
        assert!(found.margins.iter().all(|margin| *margin > 0.0), "{:?} of {}", found.margins, planned.0);
        for (truth, found) in [(truth.q, found.q), (truth.q_dot, found.q_dot), (truth.q_ddot, found.q_ddot)] {
            let off = difference(&truth, &found);
            assert!(off < 1e-11, "seed {seed}: off by {off:e}\n{truth:?}\n{found:?}\n{}", planned.0);
        }
        compared += 1;
    }
    assert!(compared > 5, "{compared}");
}
