//! The angles of a group that is solved by Newton's iteration stay within half a turn of where it begins: near a dead
//! centre its first step may turn by many turns, and what rolls or winds on the body would be there, too.

use core::f64::consts::PI;
use kin_runtime::batch::{Column, Modes, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
use kin_runtime::plan::Depth;
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, Options, Planned, mechanism};

/// A cam lifts a follower, and a rack rolls on it. The slope of the cam is 0 near the guess.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(follower, x = 0, phi = 0)]
#[body(rack, y = 0, phi = 0)]
#[on_curve(K: cam @ (0, 0), follower @ (0, 0), polar(theta) = 1 + 0.3 * cos(theta))]
#[driver(lift: follower.y = y)]
#[rack_pinion(Z: ground @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = cam, radius = 1)]
#[guess(cam.phi = g)]
struct Wound {
    y: f64,
    g: f64,
}

#[test]
fn a_single_state_is_within_half_a_turn_of_its_guess() {
    let mut far = 0;
    for k in 0..120 {
        let wound = Wound { y: 1.0, g: 0.5 + 0.01 * f64::from(k) };
        let at = Instant::at(0.0);
        let state = |use_plan| wound.solver().with_options(Options { use_plan, ..Options::default() }).state(&at);
        let (by_plan, by_newton) = (state(true), state(false));
        let (Ok(by_plan), Ok(by_newton)) = (&by_plan, &by_newton) else { panic!("{by_plan:?} {by_newton:?}") };
        let [cam, rack] = ["cam.phi", "rack.x"].map(|name| Wound::model().coordinate(name).expect("it is there"));
        assert!((by_plan.q[cam] - wound.g).abs() <= PI, "{}: {:?}", wound.g, by_plan.q);
        assert!((by_plan.q[rack].abs() - by_plan.q[cam].abs()).abs() < 1e-12, "{:?}", by_plan.q);
        assert!((by_plan.q[cam] - by_newton.q[cam]).abs() < 1e-12, "{}: {:?} {:?}", wound.g, by_plan.q, by_newton.q);
        far += usize::from((by_plan.q[cam] - wound.g).abs() > 1.0);
    }
    assert!(far > 10, "{far}");
}

#[test]
fn what_a_batch_solves_is_within_half_a_turn_of_its_start() {
    let count = 200;
    let starts: Vec<f64> = (0..count).map(|k| 0.4 + 0.01 * k as f64).collect();
    let cam = Wound::model().coordinate("cam.phi").expect("it is there");
    let column = |(k, _)| if k == cam { Column::Each(&starts) } else { Column::Shared(0.9) };
    let start: Vec<Column<'_>> = Wound::model().coordinates.iter().enumerate().map(column).collect();
    let parameters = [Column::Shared(1.0), Column::Shared(1.0)];
    let (t, modes) = (Column::Shared(0.0), Modes::OfStart);
    let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
    let mut solutions = Solutions::<Wound>::new(count);
    let wound = Wound { y: 1.0, g: 1.0 };
    solve(&wound, Depth::Acceleration, &problems, &mut solutions, &always).expect("the columns have these lengths");
    let mut solved = 0;
    for ((good, q), start) in solutions.solved().zip(solutions.q(cam)).zip(&starts) {
        assert!(!good || (q - start).abs() <= PI, "{start}: {q}");
        solved += usize::from(good);
    }
    assert!((50..count).contains(&solved), "{solved}");
}

/// Motions begin within half a turn of their start as well, in batches and one by one.
#[test]
fn motions_begin_within_half_a_turn_of_their_start() {
    let wound = Wound { y: 1.0, g: 1.0 };
    let starts: Vec<f64> = (0..200).map(|k| 0.4 + 0.01 * f64::from(k)).collect();
    let cam = Wound::model().coordinate("cam.phi").expect("it is there");
    let column = |(k, _)| if k == cam { Column::Each(&starts) } else { Column::Shared(0.9) };
    let start: Vec<Column<'_>> = Wound::model().coordinates.iter().enumerate().map(column).collect();
    let parameters = [Column::Shared(1.0); 2];
    let sweeps = Sweeps { parameters: &parameters, times: &[0.0], inputs: &[], modes: Modes::OfStart, start: &start };
    let mut motions = Motions::new(starts.len(), Lanes::from(0.0));
    sweep(&wound, &sweeps, &mut motions, &always, |q: &mut Lanes, moment| *q = moment.keep(*q, moment.q[cam]))
        .expect("the columns have these lengths");
    let mut begun = 0;
    for ((q, end), start) in motions.scores(|q| *q).zip(motions.ends()).zip(&starts) {
        let mut at_start = vec![0.9; Wound::model().coordinates.len()];
        at_start[cam] = *start;
        let planned = Planned::new(&wound, &Instant::at(0.0), &at_start);
        assert_eq!(planned.is_ok(), end.is_none(), "{start}");
        for q in planned.iter().map(|planned| planned.q()[cam]).chain(end.is_none().then_some(q)) {
            assert!((q - start).abs() <= PI, "{start}: {q}");
        }
        begun += usize::from(end.is_none());
    }
    assert!((50..200).contains(&begun), "{begun}");
}
