//! The lengths of columns are checked, and a batch of solutions does not allocate memory while it is solved.

use super::Drawn;
use allocation_counter::measure;
use kin_runtime::batch::{
    Column, Configurations, Evaluations, Modes, Motions, Problems, Solutions, Sweeps, always, evaluate, solve, sweep,
};
use kin_runtime::plan::Depth;
use kin_runtime::{Mechanism, Signal, Subset, mechanism};
use kin_tests::mechanisms::FourbarLectureMid;

#[test]
fn a_batch_of_solutions_takes_no_memory_inside_and_counts_its_columns() {
    let drawn = Drawn::new(&FourbarLectureMid::default(), 0.0, 1.0);
    let mechanism = FourbarLectureMid::default();
    let parameters = mechanism.parameters::<f64>().map(Column::Shared);
    let start: Vec<_> = drawn.start.iter().map(|list| Column::Shared(list[0])).collect();
    let [small, large] = [8, 3_000].map(|count| {
        let t = vec![0.01; count];
        let problems = Problems {
            parameters: &parameters,
            t: Column::Each(&t),
            inputs: &[],
            modes: Modes::OfStart,
            start: &start,
        };
        let mut out = Solutions::<FourbarLectureMid>::new(count);
        let counted =
            measure(|| solve(&mechanism, Depth::Acceleration, &problems, &mut out, &always).expect("good columns"));
        assert!(out.solved().all(|good| good));
        // Results that are not requested are set to 0.
        solve(&mechanism, Depth::Position, &problems, &mut out, &always).expect("good columns");
        assert!(out.solved().all(|good| good) && out.q_ddot(8).chain(out.q_dot(8)).all(|x| x == 0.0));
        for (bad, text) in [
            (Problems { start: &start[1..], ..problems }, "start has 8 entries and must have 9"),
            (Problems { parameters: &parameters[1..], ..problems }, "parameters has"),
            (Problems { t: Column::Each(&t[1..]), ..problems }, "the column of t has"),
            (Problems { modes: Modes::Signs(&[]), ..problems }, "modes has 0 entries and must have 1"),
        ] {
            let error = solve(&mechanism, Depth::Position, &bad, &mut out, &always).unwrap_err().to_string();
            assert!(error.starts_with(text), "{error}");
        }
        counted.count_total
    });
    assert_eq!(small, large);
}

/// A boom on a cylinder, and a stick; the length of the cylinder and an angle are inputs.
#[mechanism]
#[input(ram, tilt)]
#[bodies(boom, stick)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (foot, 0), boom @ (arm, 0), length = ram)]
#[revolute(elbow: boom @ (1.5, 0), stick @ (0, 0))]
#[driver(turn: stick.phi = boom.phi + tilt)]
#[guess(boom.phi = 0.8)]
pub(super) struct Crane {
    #[param(1.0)]
    foot: f64,
    #[param(1.2)]
    arm: f64,
}

/// Every list and every column of an evaluation, a solution and a sweep, one element too short and one too long.
#[test]
fn columns_that_are_too_short_or_too_long_are_refused() {
    const COUNT: usize = 6;
    let (crane, right) = (Crane::default(), [0.9; COUNT]);
    let list = Column::Each(&right);
    let told = Signal::new(list, list, list);
    let good = Problems {
        parameters: &[list; 2],
        t: list,
        inputs: &[told; 2],
        modes: Modes::Signs(&[list]),
        start: &[list; 6],
    };
    let evaluated = |of: Problems<'_>| {
        let Problems { parameters, t, inputs, start, .. } = of;
        let columns = Configurations { parameters, t, inputs, q: start, q_dot: start };
        evaluate(&crane, Subset::ALL, &columns, &mut Evaluations::new(COUNT), &always).map_err(|e| e.to_string())
    };
    let solved = |of: Problems<'_>| {
        solve(&crane, Depth::Position, &of, &mut Solutions::new(COUNT), &always).map_err(|e| e.to_string())
    };
    // In a sweep, the columns of the inputs must have the length of the times.
    let swept = |of: Problems<'_>| {
        let Problems { parameters, inputs, modes, start, .. } = of;
        let sweeps = Sweeps { parameters, times: &right, inputs, modes, start };
        sweep(&crane, &sweeps, &mut Motions::new(COUNT, ()), &always, |(), _| ()).map_err(|e| e.to_string())
    };
    assert_eq!([Ok(()), Ok(()), Ok(())], [evaluated(good), solved(good), swept(good)]);
    for wrong in [&[0.9; COUNT - 1][..], &[0.9; COUNT + 1]] {
        let bad = Column::Each(wrong);
        let refused = |what: &str, result: Result<(), String>| {
            let error = result.expect_err(what);
            assert_eq!(format!("{what} has {} entries and must have 6", wrong.len()), error);
        };
        let of_parameters = Problems { parameters: &[list, bad], ..good };
        let of_time = Problems { t: bad, ..good };
        let of_start = Problems { start: &[list, list, list, list, list, bad], ..good };
        let of_modes = Problems { modes: Modes::Signs(&[bad]), ..good };
        for result in [evaluated(of_parameters), solved(of_parameters), swept(of_parameters)] {
            refused("a column of the parameters", result);
        }
        for result in [evaluated(of_time), solved(of_time)] {
            refused("the column of t", result);
        }
        for told in [Signal::new(bad, list, list), Signal::new(list, bad, list), Signal::new(list, list, bad)] {
            let of_inputs = Problems { inputs: &[Signal::new(list, list, list), told], ..good };
            for result in [evaluated(of_inputs), solved(of_inputs), swept(of_inputs)] {
                refused("a column of the inputs", result);
            }
        }
        refused("a column of q", evaluated(of_start));
        for result in [solved(of_start), swept(of_start)] {
            refused("a column of the start", result);
        }
        for result in [solved(of_modes), swept(of_modes)] {
            refused("a column of the modes", result);
        }
    }
    let refused = |what: &str, result: Result<(), String>| assert_eq!(what, result.expect_err(what));
    for (count, list) in [(5, &[list; 5][..]), (7, &[list; 7])] {
        let of_start = Problems { start: list, ..good };
        for result in [solved(of_start), swept(of_start)] {
            refused(&format!("start has {count} entries and must have 6"), result);
        }
        refused(&format!("q has {count} entries and must have 6"), evaluated(of_start));
    }
    for (count, inputs) in [("1 entry", &[told; 1][..]), ("3 entries", &[told; 3])] {
        let of_inputs = Problems { inputs, ..good };
        for result in [evaluated(of_inputs), solved(of_inputs), swept(of_inputs)] {
            refused(&format!("inputs has {count} and must have 2"), result);
        }
    }
    for (count, signs) in [(0, &[][..]), (2, &[list; 2])] {
        let of_modes = Problems { modes: Modes::Signs(signs), ..good };
        for result in [solved(of_modes), swept(of_modes)] {
            refused(&format!("modes has {count} entries and must have 1"), result);
        }
    }
}
