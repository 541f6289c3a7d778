//! Rows and scores of one process.

use crate::four_bar::FourBar;
use crate::identity::{cranks, one};
use crate::{count, directory, limits, study, table};
use kin_runtime::Kinematics;
use kin_study::{Histogram, Limits, Measure, Range, Sampling, Score, Study, StudyError, Watch, query, run, run_part};
use std::fs;
use std::num::NonZero;
use std::path::Path;
use std::sync::atomic::Ordering;

#[test]
fn rows_are_the_same_however_the_work_is_cut() {
    for sampling in [Sampling::Random, Sampling::LatinHypercube, Sampling::Sobol] {
        let study = study(10_000).sampling(sampling);
        let whole = directory();
        let report = run::<FourBar>(&study, whole.path(), limits(1), &Watch::default()).expect("it runs");
        assert!(report.is_complete() && report.passed == 10_000);
        assert!((1000..9000).contains(&report.ended), "{report}");
        let expected = table(whole.path());

        let two = directory();
        run::<FourBar>(&study, two.path(), limits(2), &Watch::default()).expect("it runs");
        assert!(table(two.path()) == expected, "two threads, {sampling:?}");

        let parts = directory();
        let of = NonZero::new(7).expect("it is not 0");
        for index in [3, 0, 6, 1, 2, 5, 4] {
            let report = run_part::<FourBar>(&study, parts.path(), (index, of), limits(1), &Watch::default());
            assert!(report.expect("it runs").is_complete());
        }
        assert!(table(parts.path()) == expected, "seven parts, {sampling:?}");
    }
}

#[test]
fn a_stopped_study_goes_on_where_it_was() {
    let study = study(9000);
    let (whole, broken) = (directory(), directory());
    run::<FourBar>(&study, whole.path(), limits(1), &Watch::default()).expect("it runs");

    let stopped = Watch::default();
    stopped.stop.store(true, Ordering::Relaxed);
    let report = run::<FourBar>(&study, broken.path(), limits(1), &stopped).expect("a stop is no error");
    assert!(!report.is_complete() && report.own == 0);
    // Two of three parts are there, then one of them is lost.
    let of = NonZero::new(3).expect("it is not 0");
    for index in [0, 2] {
        run_part::<FourBar>(&study, broken.path(), (index, of), limits(1), &Watch::default()).expect("it runs");
    }
    let error = run::<FourBar>(&study, broken.path(), limits(1), &Watch::default()).expect_err("there are rows");
    assert!(error.to_string().contains("go on with --resume"), "{error}");
    let resume = Limits { resume: true, ..limits(1) };
    let report = run::<FourBar>(&study, broken.path(), resume, &Watch::default()).expect("it goes on");
    assert!(report.is_complete() && report.own == 3000, "{report}");
    assert!(table(broken.path()) == table(whole.path()));

    let other = study.seed(5);
    let error = run::<FourBar>(&other, broken.path(), resume, &Watch::default()).expect_err("it is another study");
    let StudyError::Directory(message) = error else { panic!("{error}") };
    assert!(message.contains("`seed: 4,` where this one has `seed: 5,`"), "{message}");
}

#[test]
fn scores_are_those_of_single_solutions() {
    let corners = vec![[0.1, 0.3], [0.2, 0.2]];
    let distance = |measure| Score::Distance { point: "tip".to_owned(), to: corners.clone(), measure };
    let study = study(64)
        .score("least", Score::Least("coupler.phi".to_owned()))
        .score("mean", Score::Mean("tip.y_dot".to_owned()))
        .score("when", Score::TimeOfGreatest("tip.x_ddot".to_owned()))
        .score("first", Score::TimeOfLeast("tip.x".to_owned()))
        .score("middle", Score::At { of: "rocker.phi_ddot".to_owned(), t: 3.0 })
        .score("transmission", Score::Least("B.transmission".to_owned()))
        .score("worst", Score::Greatest("B.deviation".to_owned()))
        .score("far", distance(Measure::Greatest))
        .score("around", distance(Measure::RootMeanSquare));
    let target = directory();
    run::<FourBar>(&study, target.path(), limits(1), &Watch::default()).expect("it runs");
    let text = table(target.path());
    let mut lines = text.lines();
    let header = lines.next().expect("there is a header");
    assert_eq!(
        header,
        "row,l2,l3,swing,fastest,least,mean,when,first,middle,transmission,worst,far,around,margin,ended,limit"
    );
    let times: Vec<f64> = (0..=40).map(|k| 0.15 * f64::from(k)).collect();
    let (mut complete, mut broken) = (0, 0);
    for line in lines {
        let fields: Vec<&str> = line.splitn(17, ',').collect();
        let number = |k: usize| fields[k].parse::<f64>().expect("it is a number");
        let design = FourBar { l2: number(1), l3: number(2), ..FourBar::default() };
        let path = match design.kinematic_analysis(&times) {
            Ok(path) => path,
            Err(error) => {
                broken += 1;
                assert!(fields[3].is_empty() && number(14) <= 0.0 && fields[16].contains("dyad RRR"), "{line}");
                let reached = error.trajectory.states.len();
                assert!((number(15) - times[reached]).abs() < 1e-9, "{line}: {reached}");
                continue;
            }
        };
        complete += 1;
        let solver = design.solver();
        let motions: Vec<_> = path.states.iter().map(|state| solver.motion(state).expect("it is solved")).collect();
        let of = |name: &str| path.column(name).expect("it is a coordinate");
        let tip =
            |part: fn(&kin_runtime::PointMotion) -> f64| motions.iter().map(|m| part(&m.points[0])).collect::<Vec<_>>();
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let when = |values: &[f64], best: f64| times[values.iter().position(|v| *v == best).expect("it is one")];
        let angles: Vec<f64> = (path.states.iter())
            .map(|state| {
                let angles = solver.transmission_angles(&kin_runtime::Instant::at(state.t), &state.q);
                angles.expect("it is solved").iter().find(|angle| angle.joint == "B").expect("it has one").angle
            })
            .collect();
        let deviations: Vec<f64> = angles.iter().map(|a| (a - std::f64::consts::FRAC_PI_2).abs()).collect();
        let rates: Vec<f64> = of("rocker.phi_dot").iter().map(|v| v.abs()).collect();
        let (x, y, ax) = (tip(|p| p.r[0]), tip(|p| p.r[1]), tip(|p| p.a[0]));
        let away = |c: &[f64; 2]| least(&x.iter().zip(&y).map(|(x, y)| (x - c[0]).hypot(y - c[1])).collect::<Vec<_>>());
        let away: Vec<f64> = corners.iter().map(away).collect();
        let expected = [
            greatest(&of("rocker.phi")) - least(&of("rocker.phi")),
            greatest(&rates),
            least(&of("coupler.phi")),
            tip(|p| p.v[1]).iter().sum::<f64>() / 41.0,
            when(&ax, greatest(&ax)),
            when(&x, least(&x)),
            of("rocker.phi_ddot")[20],
            least(&angles),
            greatest(&deviations),
            greatest(&away),
            (away.iter().map(|d| d * d).sum::<f64>() / 2.0).sqrt(),
        ];
        for (k, expected) in expected.into_iter().enumerate() {
            let found = number(3 + k);
            assert!(
                (found - expected).abs() <= 1e-8 * expected.abs().max(1.0),
                "{k}: {found}, not {expected} in {line}"
            );
        }
        assert!(number(14) > 0.0 && fields[15].is_empty() && fields[16].is_empty());
    }
    assert!(complete > 5 && broken > 5, "{complete} and {broken}");
}

#[test]
fn the_best_rows_conditions_and_histograms_agree_with_the_whole_table() {
    let all = directory();
    run::<FourBar>(&study(20_000), all.path(), limits(2), &Watch::default()).expect("it runs");
    let counted = Histogram { of: "swing".to_owned(), from: 0.0, to: 2.0, bins: 8 };
    let kept = study(20_000)
        .derived("ratio", "l2 / l3")
        .condition("ratio > 1.2")
        .keep_where("swing < 1.0")
        .keep_best(25, "swing desc")
        .histogram(counted);
    let best = directory();
    let of = NonZero::new(3).expect("it is not 0");
    let mut passed = 0;
    for index in 0..3 {
        let report = run_part::<FourBar>(&kept, best.path(), (index, of), limits(2), &Watch::default());
        passed += report.expect("it runs").passed;
    }
    let condition = "l2 / l3 > 1.2 and swing < 1.0";
    let rows = |directory: &Path, sql: &str| query(directory, sql).expect("it is understood").to_string();
    let sql = format!("select row, swing from study where {condition} order by swing desc, row limit 25");
    assert_eq!(rows(best.path(), "select row, swing from study"), rows(all.path(), &sql));
    let sql = format!("select count(*) from study where {condition}");
    assert_eq!(count(all.path(), &sql), passed as i64);
    assert_eq!(count(best.path(), "select cast(sum(count) as bigint) from histogram"), passed as i64);
    let sql = format!("select count(*) from study where {condition} and swing >= 0.5 and swing < 0.75");
    assert_eq!(count(best.path(), "select count from histogram where \"from\" = 0.5"), count(all.path(), &sql));
}

#[test]
fn all_modes_are_rows_of_their_own() {
    let target = directory();
    let study = study(500).all_modes();
    let report = run::<FourBar>(&study, target.path(), limits(2), &Watch::default()).expect("it runs");
    assert_eq!(report.done, 1000);
    assert_eq!(count(target.path(), "select count(distinct mode) from study"), 2);
    assert_eq!(
        count(target.path(), "select count(*) from (select l2 from study group by l2 having count(*) = 2)"),
        500
    );
    // Mirrored about the line through both pins of the rocker's triangle, the least margins are the same.
    let sql = "select count(*) from (select l2 from study group by l2 having max(margin) - min(margin) < 1e-9)";
    assert!(count(target.path(), sql) > 400);
}

#[test]
fn rows_in_which_a_formula_has_no_value_are_rows_like_others() {
    let without = || study(300).derived("root", "sqrt(l2 - 0.4)").derived("log", "ln(l2 - 0.4)");
    let target = directory();
    run::<FourBar>(&without(), target.path(), limits(2), &Watch::default()).expect("it runs");
    let negative = count(target.path(), "select count(*) from study where l2 < 0.4");
    assert!((1..300).contains(&negative), "{negative}");
    let neither = "root is null and log is null and l2 < 0.4";
    assert_eq!(count(target.path(), &format!("select count(*) from study where {neither}")), negative);
    assert_eq!(count(target.path(), "select count(*) from study where root is null"), negative);
    assert_eq!(
        count(target.path(), "select count(*) from study where abs(root * root - (l2 - 0.4)) < 1e-15"),
        300 - negative
    );
    let kept = count(target.path(), "select count(*) from study where root > 0.1");
    for conditioned in [without().condition("sqrt(l2 - 0.4) > 0.1"), without().keep_where("sqrt(l2 - 0.4) > 0.1")] {
        let target = directory();
        run::<FourBar>(&conditioned, target.path(), limits(2), &Watch::default()).expect("it runs");
        assert_eq!(count(target.path(), "select count(*) from study"), kept);
    }
}

#[test]
fn what_has_no_value_meets_no_condition_and_comes_last() {
    let without = || study(300).derived("root", "sqrt(l2 - 0.4)");
    let place = directory();
    let all = place.path().join("all");
    run::<FourBar>(&without(), &all, limits(2), &Watch::default()).expect("it runs");
    let with_value = "select count(*) from study where l2 >= 0.4";
    let expected = count(&all, with_value);
    assert!((10..290).contains(&expected), "{expected}");
    let conditions =
        ["root > -1", "sqrt(l2 - 0.4) > -1", "-sqrt(l2 - 0.4) < 1", "root between -1 and 9", "not root > 9"];
    for (k, condition) in conditions.into_iter().enumerate() {
        for (when, study) in [("before", without().condition(condition)), ("after", without().keep_where(condition))] {
            let target = place.path().join(format!("{when}{k}"));
            let report = run::<FourBar>(&study, &target, limits(2), &Watch::default()).expect("it runs");
            assert_eq!(report.passed as i64, expected, "{when}: {condition}");
            assert_eq!(count(&target, with_value), expected, "{when}: {condition}");
            assert!(when == "after" || report.solved as i64 == expected, "{when}: {condition}");
        }
    }
    // An angle for l2 ≤ 0.4.
    for (k, by) in
        ["acos(l2 * 2.5) desc", "-acos(l2 * 2.5)", "acos(l2 * 2.5)", "angle * 2 desc"].into_iter().enumerate()
    {
        let target = place.path().join(format!("best{k}"));
        let study = study(300).derived("angle", "acos(l2 * 2.5)").keep_best(5, by);
        run::<FourBar>(&study, &target, limits(2), &Watch::default()).expect("it runs");
        assert_eq!(count(&target, "select count(*) from study where l2 <= 0.4"), 5, "{by}");
    }
}

#[test]
fn a_value_for_what_has_none_is_given_in_conditions_and_orders() {
    // The root is an error of the engine for l2 < 0.4, and the angle NaN for l2 > 0.4.
    let without = || {
        let study = study(300).derived("root", "sqrt(l2 - 0.4)").derived("angle", "coalesce(acos(l2 * 2.5), 7)");
        study.derived("known", "coalesce(root, nvl(root, 7))")
    };
    let place = directory();
    let all = place.path().join("all");
    run::<FourBar>(&without(), &all, limits(2), &Watch::default()).expect("it runs");
    let few = count(&all, "select count(*) from study where l2 < 0.4");
    assert!((10..290).contains(&few), "{few}");
    assert_eq!(count(&all, "select count(*) from study where known = 7"), few);
    assert_eq!(count(&all, "select count(*) from study where angle = 7"), 300 - few);
    for (k, condition) in ["coalesce(root, 9) > 8", "nullif(coalesce(root, 9), 9) is null"].into_iter().enumerate() {
        for (when, study) in [("before", without().condition(condition)), ("after", without().keep_where(condition))] {
            let target = place.path().join(format!("{when}{k}"));
            run::<FourBar>(&study, &target, limits(2), &Watch::default()).expect("it runs");
            assert_eq!(count(&target, "select count(*) from study"), few, "{when}: {condition}");
        }
    }
    let best = place.path().join("best");
    run::<FourBar>(&without().keep_best(5, "coalesce(root, 9) desc"), &best, limits(2), &Watch::default())
        .expect("it runs");
    assert_eq!(count(&best, "select count(*) from study where l2 < 0.4"), 5);
}

#[test]
fn counts_of_rows_that_were_not_written_do_not_count() {
    let counted = Histogram { of: "l2".to_owned(), from: 0.0, to: 1.0, bins: 4 };
    let study = study(900).histogram(counted);
    let target = directory();
    let of = NonZero::new(3).expect("it is not 0");
    for index in 0..3 {
        run_part::<FourBar>(&study, target.path(), (index, of), limits(1), &Watch::default()).expect("it runs");
    }
    let files = fs::read_dir(target.path()).expect("the directory is there").map(|file| file.expect("an entry").path());
    let lost = files
        .filter(|path| path.to_string_lossy().ends_with("rows-0000000000000300-0000000000000600.parquet"))
        .collect::<Vec<_>>();
    assert_eq!(lost.len(), 1);
    fs::remove_file(&lost[0]).expect("it can be removed");
    let total = || count(target.path(), "select cast(sum(count) as bigint) from histogram");
    assert_eq!([total(), count(target.path(), "select count(*) from study")], [600; 2]);
    // In other parts than before.
    let six = NonZero::new(6).expect("it is not 0");
    for index in 2..4 {
        let resume = Limits { resume: true, ..limits(1) };
        run_part::<FourBar>(&study, target.path(), (index, six), resume, &Watch::default()).expect("it runs");
    }
    assert_eq!([total(), count(target.path(), "select count(*) from study")], [900; 2]);
}

#[test]
fn a_design_without_a_score_is_never_the_best() {
    // Many couplers are no number, and with many others the crank cannot turn all the way.
    let study = Study::new()
        .rows(2000)
        .parameter("l3", Range::Uniform { from: 0.1, to: 0.5 })
        .derived("l2", "case when l3 > 0.4 then 0.0 / 0.0 else 0.4 end")
        .turn(0.0, 6.0, 40)
        .score("swing", Score::Range("rocker.phi".to_owned()));
    let target = directory();
    let all = target.path().join("all");
    run::<FourBar>(&study, &all, limits(2), &Watch::default()).expect("it runs");
    let none = count(&all, "select count(*) from study where l2 is null");
    assert!((400..600).contains(&none), "{none}");
    let ended = "ended = 0 and margin <= 0 and swing is null and \"limit\" is not null";
    assert_eq!(count(&all, &format!("select count(*) from study where l2 is null and {ended}")), none);
    let solved = count(&all, "select count(*) from study where swing is not null");
    assert!((200..1600).contains(&solved), "{solved}");
    for (k, by) in ["swing desc", "swing", "swing * 2 desc"].into_iter().enumerate() {
        let target = target.path().join(k.to_string());
        let study = study.clone().keep_best(50, by);
        run::<FourBar>(&study, &target, limits(2), &Watch::default()).expect("it runs");
        assert_eq!(count(&target, "select count(*) from study where swing is not null"), 50, "{by}");
        let sql = format!("select row from (select * from study order by {by}, row limit 50) order by row");
        let [best, expected] = [&target, &all].map(|directory| query(directory, &sql).expect("there are rows"));
        assert_eq!(best.to_string(), expected.to_string(), "{by}");
    }
}

/// The guide passes through the pin B of the slider.
#[test]
fn an_arm_of_length_0_has_no_transmission_angle() {
    let target = directory();
    let study = cranks()
        .score("angle", Score::Least("B.transmission".to_owned()))
        .score("off", Score::Greatest("B.deviation".to_owned()));
    run::<one::Edited>(&study, target.path(), limits(1), &Watch::default()).expect("it runs");
    let without = "select count(*) from study where angle is null and off is null and width > 0 and ended is null";
    assert_eq!(count(target.path(), without), 20);
}
