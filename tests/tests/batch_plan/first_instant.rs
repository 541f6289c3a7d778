//! The first instant of a batch of motions: an iteration must keep the closure of its start.

use kin_runtime::batch::{Column, Modes, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Lanes, Planned, mechanism};

/// A four-bar driven by the sum of two angles.
#[mechanism]
#[body(left, x = 0, y = 0)]
#[bodies(coupler)]
#[body(right, x = d, y = 0)]
#[revolute(A: left @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), right @ (c, 0))]
#[driver(sum: left.phi + right.phi = 2 + t)]
#[guess(left.phi = 1, right.phi = 1, coupler.phi = 0)]
struct Sum {
    #[param(1.97)]
    b: f64,
    #[param(1.1)]
    c: f64,
    #[param(2.0)]
    d: f64,
}

#[test]
fn a_motion_begins_where_a_plan_does() {
    let mut begun = [0; 2];
    let (bar, at) = (Sum::default(), Instant::at(0.0));
    let solved = bar.solver().state(&at).expect("it closes").q;
    for k in 0..60 {
        let left = 0.6 + 0.02 * f64::from(k);
        // A guess with a coupler that lies level, and a solution that is moved a little.
        let mut start = [left, left.cos(), left.sin(), 0.0, 2.0 - left];
        if k % 2 == 0 {
            start.copy_from_slice(&solved);
            start[0] += 0.001 * f64::from(k - 30);
        }
        let begins = Planned::new(&bar, &at, &start).is_ok();
        let (start, parameters) = (start.map(Column::Shared), [1.97, 1.1, 2.0].map(Column::Shared));
        let (t, modes) = (Column::Shared(0.0), Modes::OfStart);
        let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
        let mut solved = Solutions::<Sum>::new(1);
        solve(&bar, Depth::Acceleration, &problems, &mut solved, &always).expect("there is a plan");
        assert_eq!(Some(begins), solved.solved().next(), "{left}");
        let sweeps = Sweeps { parameters: &parameters, times: &[0.0], inputs: &[], modes, start: &start };
        let mut motions = Motions::new(1, Lanes::from(0.0));
        sweep(&bar, &sweeps, &mut motions, &always, |_: &mut Lanes, _| {}).expect("there is a plan");
        assert_eq!(begins, motions.ends().next().flatten().is_none(), "{left}");
        begun[usize::from(begins)] += 1;
    }
    assert!(begun[0] > 0 && begun[1] > 0, "{begun:?}");
}
