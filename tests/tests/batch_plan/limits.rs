//! Tests of the lanes that count as solved: NaN, limits, and failing neighbours in a block.

use super::{close, columns::Crane, results};
use kin_runtime::batch::{Column, Modes, Problems, Solutions, always, solve};
use kin_runtime::plan::{Depth, Plan, StepKind};
use kin_runtime::{Instant, Kinematics, Mechanism, Signal, mechanism};

fn solutions<M: Mechanism + Sync>(mechanism: &M, count: usize, problems: &Problems<'_>) -> Solutions<M> {
    let mut out = Solutions::new(count);
    solve(mechanism, Depth::Acceleration, problems, &mut out, &always).unwrap();
    out
}

#[test]
fn what_is_not_a_number_is_not_solved_whatever_its_margin() {
    let crane = Crane::default();
    let parameters = crane.parameters::<f64>().map(Column::Shared);
    let (still, told) =
        (Column::Shared(0.0), Signal::new(Column::Shared(0.9), Column::Shared(0.1), Column::Shared(0.0)));
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        let wrong = [0.0, 0.1, bad, 0.2, 0.0];
        for tilt in [
            Signal::new(Column::Each(&wrong), still, still),
            Signal::new(still, Column::Each(&wrong), still),
            Signal::new(still, still, Column::Each(&wrong)),
        ] {
            let inputs = [told, tilt];
            let (modes, start) = (Modes::Signs(&[Column::Shared(1.0)]), &[still; 6]);
            let problems = Problems { parameters: &parameters, t: still, inputs: &inputs, modes, start };
            let out = solutions(&crane, wrong.len(), &problems);
            assert!(out.solved().eq([true, true, false, true, true]), "{bad} {tilt:?}");
            assert_eq!([0.0; 3].map(|zero| vec![zero; 6]), results(&out, 2));
            // The margin of the cylinder does not depend on the stick.
            let margins: Vec<f64> = out.margin().collect();
            assert!(margins[0] > 0.1 && margins.iter().all(|margin| *margin == margins[0]), "{margins:?}");
        }
    }
}

#[test]
fn solved_is_what_has_a_margin() {
    // The boom is stretched away from the foot of the cylinder: cylinder = foot + arm, slightly shorter and slightly
    // longer.
    let crane = Crane::default();
    let parameters = crane.parameters::<f64>().map(Column::Shared);
    let lengths: Vec<f64> = (-2000..200).map(|k| 2.2 + 5e-16 * f64::from(k)).collect();
    let still = Column::Shared(0.0);
    let inputs = [Signal::new(Column::Each(&lengths), still, still), Signal::new(still, still, still)];
    let (modes, start) = (Modes::Signs(&[Column::Shared(1.0)]), &[still; 6]);
    let problems = Problems { parameters: &parameters, t: still, inputs: &inputs, modes, start };
    let out = solutions(&crane, lengths.len(), &problems);
    let (mut below, mut above) = (0, 0);
    for (solved, margin) in out.solved().zip(out.margin()) {
        assert_eq!(solved, margin > Plan::SMALLEST_MARGIN, "{margin:e}");
        below += usize::from(margin > 0.0 && !solved);
        above += usize::from(solved);
    }
    assert!(below > 100 && above > 100, "{below} {above}");
}

/// A 3-RRR robot with cranks that follow inputs, and a dyad on its platform: a Newton iteration followed by a mode.
#[mechanism]
#[input(a1, a2, a3)]
#[bodies(crank1, rod1, crank2, rod2, crank3, rod3, platform, left, right)]
#[revolute(B1: ground @ (0, 0), crank1 @ (0, 0))]
#[revolute(A1: crank1 @ (0.38, 0), rod1 @ (0, 0))]
#[revolute(P1: rod1 @ (0.42, 0), platform @ (-0.15, -0.1))]
#[revolute(B2: ground @ (1.2, 0.05), crank2 @ (0, 0))]
#[revolute(A2: crank2 @ (0.4, 0), rod2 @ (0, 0))]
#[revolute(P2: rod2 @ (0.4, 0), platform @ (0.16, -0.09))]
#[revolute(B3: ground @ (0.55, 1.1), crank3 @ (0, 0))]
#[revolute(A3: crank3 @ (0.36, 0), rod3 @ (0, 0))]
#[revolute(P3: rod3 @ (0.44, 0), platform @ (0, 0.18))]
#[driver(d1: crank1.phi = a1)]
#[driver(d2: crank2.phi = a2)]
#[driver(d3: crank3.phi = a3)]
#[revolute(L: platform @ (0, 0.18), left @ (0, 0))]
#[revolute(M: left @ (0.5, 0), right @ (0.6, 0))]
#[revolute(R: right @ (0, 0), ground @ (1.2, 1.0))]
#[guess(rod1.phi = -0.3, rod2.phi = 1.8, rod3.phi = -2.3, platform.phi = 0.1)]
struct Robot;

#[test]
fn who_does_not_converge_is_left_behind() {
    let angles = [1.49, 3.4, -0.73];
    let told = angles.map(|angle| Signal::new(angle, 0.2, -0.1));
    let q = Robot.solver().assemble(&Instant { t: 0.0, inputs: &told }).unwrap();
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let [first, signs] = [[1.49, 1.47, 1.5, 1.46], [1.0, -1.0, -1.0, 1.0]];
    let modes = Robot::model().plan.modes.len();
    assert!(modes == 1 && Robot::model().plan.steps.iter().any(|step| matches!(step.kind, StepKind::Newton(_))));
    let solved = |first: &[f64], signs: &[f64]| {
        let rest = told.map(|u| u.map(Column::Shared));
        let inputs = [Signal::new(Column::Each(first), rest[0].rate, rest[0].acceleration), rest[1], rest[2]];
        let modes = Modes::Signs(&[Column::Each(signs)]);
        let problems = Problems { parameters: &[], t: Column::Shared(0.0), inputs: &inputs, modes, start: &start };
        solutions(&Robot, first.len(), &problems)
    };
    for bad in 0..4 {
        let mut beside = first;
        beside[bad] = f64::NAN;
        let out = solved(&beside, &signs);
        assert!(out.solved().eq((0..4).map(|lane| lane != bad)), "{bad}");
        for lane in (0..4).filter(|lane| *lane != bad) {
            let alone = solved(&first[lane..=lane], &signs[lane..=lane]);
            for (found, expected) in results(&out, lane).iter().zip(&results(&alone, 0)) {
                close("beside one that is no number", found, expected, 1e-10);
            }
            let [found, expected] = [out.margin().nth(lane), alone.margin().next()].map(Option::unwrap);
            assert!((found - expected).abs() < 1e-9 && expected < 0.999, "{found} {expected}");
        }
    }
}
