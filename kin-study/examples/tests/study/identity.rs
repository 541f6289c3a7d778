//! A directory holds rows of one study of one mechanism.

use crate::four_bar::FourBar;
use crate::{count, directory, limits, study};
use kin_runtime::Mechanism;
use kin_study::{Limits, Range, Score, Study, Watch, missing, run, run_part};
use std::fs;
use std::num::NonZero;
use std::path::Path;

/// Slider-cranks with the same name and the same parameters, of which each differs from the first in one thing.
macro_rules! edited {
    ($($module:ident: $guide:expr, $speed:expr, $guess:expr, $mass:expr, $tip:expr;)*) => {$(
        pub(crate) mod $module {
            use kin_runtime::mechanism;

            /// A slider-crank.
            #[mechanism]
            #[bodies(crank, rod)]
            #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
            #[revolute(A: crank @ (r, 0), rod @ (0, 0))]
            #[body(slider, phi = 0)]
            #[revolute(B: rod @ (l, 0), slider @ (0, 0))]
            #[point_on_line(guide: ground @ (0, $guide), slider @ (0, 0), axis = (1, 0))]
            #[point(tip = rod @ ($tip, 0.1))]
            #[mass(rod @ (0.1, 0), mass = $mass, inertia = 0.01)]
            #[driver(drive: crank.phi = $speed * t + 0.3)]
            #[guess(rod.phi = $guess, slider.x = 0.8)]
            #[derive(Clone)]
            pub(crate) struct Edited {
                #[param(0.2)]
                r: f64,
                #[param(0.6)]
                l: f64,
            }
        }
    )*};
}

edited! {
    one: 0.0, 1.0, -0.1, 2.0, 0.3;
    other_guide: 0.05, 1.0, -0.1, 2.0, 0.3;
    other_speed: 0.0, 1.1, -0.1, 2.0, 0.3;
    other_guess: 0.0, 1.0, -0.2, 2.0, 0.3;
    other_mass: 0.0, 1.0, -0.1, 2.1, 0.3;
    other_tip: 0.0, 1.0, -0.1, 2.0, 0.31;
}

pub(crate) fn cranks() -> Study {
    Study::new()
        .rows(20)
        .parameter("r", Range::Uniform { from: 0.1, to: 0.3 })
        .turn(0.0, 6.0, 20)
        .score("width", Score::Range("rod.x".to_owned()))
}

fn resumed<M: Mechanism + Default + Send + Sync + 'static>(directory: &Path) -> Result<u64, String> {
    let resume = Limits { resume: true, ..limits(1) };
    let report = run::<M>(&cranks(), directory, resume, &Watch::default());
    report.map(|report| report.own).map_err(|error| error.to_string())
}

#[test]
fn an_edited_mechanism_does_not_go_on_with_the_rows_of_another() {
    let target = directory();
    let half = (0, NonZero::new(2).expect("it is not 0"));
    run_part::<one::Edited>(&cranks(), target.path(), half, limits(1), &Watch::default()).expect("it runs");
    let others = [
        resumed::<other_guide::Edited>(target.path()),
        resumed::<other_speed::Edited>(target.path()),
        resumed::<other_guess::Edited>(target.path()),
        resumed::<other_mass::Edited>(target.path()),
        resumed::<other_tip::Edited>(target.path()),
    ];
    for (k, other) in others.into_iter().enumerate() {
        let error = other.expect_err("it is another mechanism");
        assert!(error.contains("it says `equations, guesses, loads and functions: "), "{k}: {error}");
    }
    assert_eq!(resumed::<one::Edited>(target.path()), Ok(10));
    assert_eq!(count(target.path(), "select count(*) from study"), 20);
}

#[test]
fn a_damaged_directory_says_what_can_be_done() {
    let target = directory();
    let of = NonZero::new(3).expect("it is not 0");
    for index in [0, 2] {
        run_part::<FourBar>(&study(300), target.path(), (index, of), limits(1), &Watch::default()).expect("it runs");
    }
    let many = NonZero::new(1_000_000_000_000).expect("it is not 0");
    assert_eq!(missing::<FourBar>(&study(300), target.path(), of).expect("it can be read"), [1]);
    assert_eq!(missing::<FourBar>(&study(300), target.path(), many).expect("it can be read").len(), 100);
    let resume = || {
        let resume = Limits { resume: true, ..limits(1) };
        run::<FourBar>(&study(300), target.path(), resume, &Watch::default()).map_err(|error| error.to_string())
    };
    let text = target.path().join("study.txt");
    let whole = fs::read(&text).expect("it can be read");
    fs::write(&text, &whole[..60]).expect("it can be written");
    let error = resume().expect_err("it is cut");
    assert!(error.contains("study.txt is damaged") || error.contains("it says"), "{error}");
    fs::write(&text, []).expect("it can be written");
    let error = resume().expect_err("it is empty");
    assert!(error.contains("study.txt is damaged"), "{error}");
    fs::remove_file(&text).expect("it can be removed");
    let error = resume().expect_err("it is not there");
    assert!(error.contains("holds rows, but no study.txt"), "{error}");
    fs::write(&text, &whole).expect("it can be written");
    let part = target.path().join("rows-0000000000000000-0000000000000100.parquet");
    let bytes = fs::read(&part).expect("it can be read");
    fs::write(&part, &bytes[..bytes.len() / 2]).expect("it can be written");
    let error = resume().expect_err("a part is cut");
    assert!(error.contains("remove this file, and go on with --resume"), "{error}");
    fs::remove_file(&part).expect("it can be removed");
    assert_eq!(resume().map(|report| report.own), Ok(100));
    assert_eq!(count(target.path(), "select count(distinct row) from study"), 300);
}

/// Followers of cams from tables that differ at one place, far from where most of them agree.
macro_rules! tables {
    ($($module:ident: $height:expr;)*) => {$(
        mod $module {
            use kin_runtime::function::CubicSpline;
            use kin_runtime::mechanism;

            /// A cam lifts a follower.
            #[mechanism]
            #[bodies(cam)]
            #[body(follower, x = 0, phi = 0)]
            #[function(lift)]
            #[revolute(O: ground @ (0, 0), cam @ (0, 0))]
            #[constraint(contact: follower.y = r + lift(cam.phi))]
            #[driver(drive: cam.phi = t)]
            pub(super) struct Edited {
                r: f64,
                lift: CubicSpline,
            }

            impl Default for Edited {
                fn default() -> Self {
                    let places: Vec<f64> = (0..=20).map(|k| 0.5 * f64::from(k)).collect();
                    let height = |x: &f64| if *x == 8.0 { $height } else { 0.1 * x.sin() };
                    let heights: Vec<f64> = places.iter().map(height).collect();
                    Self { r: 1.0, lift: CubicSpline::natural(&places, &heights).expect("places in order") }
                }
            }
        }
    )*};
}

tables! {
    one_table: 0.1;
    other_table: 0.1001;
}

#[test]
fn an_edited_table_does_not_go_on_with_the_rows_of_another() {
    let study = Study::new().rows(20).parameter("r", Range::Uniform { from: 0.9, to: 1.1 }).turn(0.0, 9.0, 20);
    let target = directory();
    let half = (0, NonZero::new(2).expect("it is not 0"));
    run_part::<one_table::Edited>(&study, target.path(), half, limits(1), &Watch::default()).expect("it runs");
    let resume = Limits { resume: true, ..limits(1) };
    let other = run::<other_table::Edited>(&study, target.path(), resume, &Watch::default());
    assert!(other.expect_err("it is another table").to_string().contains("and functions: "));
    let own = run::<one_table::Edited>(&study, target.path(), resume, &Watch::default()).expect("it goes on");
    assert_eq!(own.own, 10);
}
