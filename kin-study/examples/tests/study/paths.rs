//! Paths as a table, and the atlas that is made of them.

use crate::atlas::{self, Curve, nearest};
use crate::{directory, limits};
use kin_runtime::{Instant, Kinematics};
use kin_study::arrow::array::{Array, AsArray};
use kin_study::arrow::datatypes::{Float32Type, Float64Type};
use kin_study::{Range, Score, Study, StudyError, Watch, normalise, query, query_to_file, run};

fn study(rows: u64) -> Study {
    let path = |normalised| Score::Path { point: "tip".to_owned(), normalised };
    Study::new()
        .rows(rows)
        .parameter("l1", Range::Uniform { from: 0.1, to: 0.9 })
        .parameter("l2", Range::Fixed(0.9))
        .parameter("l3", Range::Uniform { from: 0.4, to: 1.2 })
        .parameter("u", Range::Fixed(0.5))
        .parameter("v", Range::Uniform { from: -1.0, to: 1.0 })
        .turn(0.0, 6.25, 99)
        .score("plain", path(false))
        .score("curve", path(true))
}

#[test]
fn paths_are_those_of_single_solutions() {
    let target = directory();
    let report = run::<atlas::FourBar>(&study(50), target.path(), limits(2), &Watch::default()).expect("it runs");
    assert!((5..45).contains(&report.ended), "{report}");
    let answer = query(target.path(), "select l1, l3, v, plain, curve, ended from study order by row");
    let mut complete = 0;
    for batch in answer.expect("there are rows").batches {
        for k in 0..batch.num_rows() {
            let [l1, l3, v] = [0, 1, 2].map(|column| batch.column(column).as_primitive::<Float64Type>().value(k));
            let [plain, curve] = [3, 4].map(|column| batch.column(column).as_fixed_size_list());
            assert_eq!([plain.is_null(k), curve.is_null(k)], [batch.column(5).is_valid(k); 2]);
            if plain.is_null(k) {
                continue;
            }
            complete += 1;
            let design = atlas::FourBar { l1, l3, v, ..Default::default() };
            let mut expected = Vec::new();
            let mut q = design.state_at(&Instant::at(0.0)).expect("it closes").q;
            for step in 0..100 {
                let state = design.solver().state_from(&Instant::at(6.25 * f64::from(step) / 99.0), &q);
                let state = state.expect("it turns");
                expected.extend(state.points[0].r);
                q = state.q;
            }
            for list in [plain, curve] {
                let numbers = list.value(k);
                let numbers = numbers.as_primitive::<Float32Type>().values();
                assert_eq!(numbers.len(), 200);
                let worst = numbers.iter().zip(&expected).map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max);
                assert!(worst < 1e-6, "{worst}");
                normalise(&mut expected);
            }
        }
    }
    assert!(complete >= 5);
    let error = query_to_file(target.path(), "select * from study", &target.path().join("all.csv"));
    assert!(matches!(error, Err(StudyError::Engine(_))), "{error:?}");
    assert!(query_to_file(target.path(), "select * from study", &target.path().join("all.parquet")).is_ok());
}

#[test]
fn an_atlas_knows_its_own_curves() {
    let target = directory();
    let study = study(3000).keep_where("curve is not null");
    run::<atlas::FourBar>(&study, target.path(), limits(2), &Watch::default()).expect("it runs");
    let all = nearest(target.path(), &Curve::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), usize::MAX).expect("an atlas");
    assert!(all.len() > 300 && all.is_sorted_by(|a, b| a.0 <= b.0), "{}", all.len());
    let (_, wanted) = &all[all.len() / 2];
    // Turned by a right angle, mirrored, larger, elsewhere, the other way round, from another point on.
    let mut points: Vec<[f64; 2]> = wanted.curve.points().iter().map(|[x, y]| [5.0 + 3.0 * y, 3.0 * x]).rev().collect();
    points.rotate_left(17);
    let found = nearest(target.path(), &Curve::new(&points), 3).expect("an atlas");
    assert_eq!((found.len(), found[0].1.row), (3, wanted.row));
    assert!(found[0].0 < 0.05 && found[1].0 > found[0].0, "{} and {}", found[0].0, found[1].0);
}
