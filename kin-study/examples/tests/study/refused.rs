//! What is refused, and how.

use crate::four_bar::FourBar;
use crate::{count, directory, limits, study};
use kin_study::{Study, StudyError, Watch, query, query_to_file, run, run_from};
use std::fs;
use std::path::Path;
use std::process::ExitCode;

#[test]
fn a_study_that_makes_no_sense_says_where_and_what_would() {
    let ranges = "rows = 9\n[motion]\nto = 1\n[parameters]\n";
    let cases = [
        ("rows = 9\nsead = 3", "line 2: no key named `sead`; did you mean `seed`?"),
        ("rows = -3", "line 1: a whole number is expected here, not -3"),
        ("rows = 9\n[motion", "line 2: "),
        ("rows = 9", "a motion needs instants"),
        (&format!("{ranges}l9 = 1"), "line 5: no parameter named `l9`; did you mean `l1`?"),
        (&format!("{ranges}l2 = 1\nl3 = {{ from = 2, to = 1 }}"), "line 6: from = 2 must be less than to = 1"),
        (&format!("{ranges}l2 = nan"), "line 5: a finite number is expected here, not nan"),
        (&format!("{ranges}[derived]\nl2 = \"lx + 1\""), "line 6: `lx + 1`: "),
        (
            &format!("{ranges}[derived]\nl2 = \"0.4 + 0.1 * random()\""),
            "line 6: `0.4 + 0.1 * random()`: `random()` gives",
        ),
        (&format!("{ranges}[conditions]\nafter = [\"random() > 0.5\"]"), "line 6: `random() > 0.5`: `random()` gives"),
        (&format!("{ranges}[conditions]\nbefore = [\"l1 > 'a'\"]"), "line 6: `l1 > 'a'`: "),
        (&format!("{ranges}[scores]\nrow = {{ least = \"tip.x\" }}"), "line 6: there is a column `row` already"),
        (
            &format!("{ranges}[scores]\na = {{ least = \"tip.z\" }}"),
            "line 6: no quantity named `tip.z`; did you mean `tip.x`?",
        ),
        (&format!("{ranges}[scores]\na = {{ at = 0.5055, of = \"tip.x\" }}"), "the nearest is t = 0.51"),
        (&format!("{ranges}[conditions]\nbefore = [\"l1 < l2\",\n\"l1 + l2\"]"), "line 7: `l1 + l2` is no condition"),
        (&format!("{ranges}[keep]\nbest = 3\nby = \"nothing\""), "line 7: `nothing`: "),
        (
            "rows = 0\n[motion]\nto = 1\n[parameters]\nl2 = { from = 0.3, to = 0.4 }",
            "line 1: a study has at least one row",
        ),
        (
            &format!("{ranges}l2 = 0.4\n[keep]\nbest = 0\nby = \"l2\""),
            "line 8: the best 1 to 2147483648 rows can be kept; to keep none, write `rows = false`",
        ),
        (
            &format!(
                "{ranges}l2 = {{ from = 0, to = 1 }}\n[keep]\nhistograms = [{{ of = \"l2\", from = 0, to = 1, bins = 2e6 }}]"
            ),
            "line 7: a histogram needs from < to and 1 to 1000000 bins",
        ),
        (&format!("{ranges}l2 = 0.4\n[keep]\nbest = 3\nby = \"random()\""), "line 8: `random()`: `random()` gives"),
        ("rows = 9\n[motion]\ntimes = [0, 1]\nsteps = 3", "write either `times`, or `to` with `from` and `steps`"),
        (
            &format!(
                "{ranges}l2 = {{ from = 0, to = 1 }}\n[keep]\nhistograms = [{{ of = \"l2\", from = 0, to = 1, bins = 2 }}, \
                 {{ of = \"l2\", from = 0, to = 0.5, bins = 1 }}]"
            ),
            "two histograms of `l2` have a bin from 0 to 0.5; choose other bins",
        ),
        (
            "sampling = \"grid\"\n[motion]\nto = 1\n[parameters]\nl2 = { from = 1, to = 2 }",
            "line 1: a grid needs a list",
        ),
        (
            "rows = 9\n[motion]\nto = 1\nmode = { A-B-X = \"+\" }",
            "line 4: no mode named `A-B-X`; did you mean `A-B-D`?",
        ),
    ];
    let target = directory();
    for (text, expected) in cases {
        let out = target.path().join("none");
        let study = Study::from_toml(text);
        let found = study.and_then(|study| run::<FourBar>(&study, &out, limits(1), &Watch::default()));
        let said = found.expect_err(text).to_string();
        assert!(said.contains(expected), "{text}\n{said}");
        assert!(!out.exists(), "{text}");
    }
}

#[test]
fn files_that_cannot_be_written_are_named() {
    let target = directory();
    let file = target.path().join("file");
    fs::write(&file, "no directory").expect("it can be written");
    let error = run::<FourBar>(&study(10), &file, limits(1), &Watch::default()).expect_err("it is a file");
    assert!(matches!(&error, StudyError::File { path, .. } if *path == file), "{error}");
    let error = run::<FourBar>(&study(10), &target.path().join("a*"), limits(1), &Watch::default());
    assert!(error.expect_err("it is a pattern").to_string().contains("choose another directory"));
    let error = query(target.path(), "select 1").expect_err("there are no rows");
    assert!(error.to_string().contains("has no rows of a study"), "{error}");
    let error = query_to_file(target.path(), "select 1", Path::new("x.txt")).expect_err("it is no table");
    assert!(error.to_string().contains("neither in .csv nor in .parquet"), "{error}");
}

#[test]
fn the_program_says_by_its_status_how_it_went() {
    let target = directory();
    let [file, out] = ["study.toml", "rows"].map(|name| target.path().join(name).to_string_lossy().into_owned());
    let program = |args: &[&str]| {
        let args = ["four_bar"].iter().chain(args).map(|arg| (*arg).to_owned());
        format!("{:?}", run_from::<FourBar>(args))
    };
    let status = |code: u8| format!("{:?}", ExitCode::from(code));
    fs::write(&file, "rows = 100\n[motion]\nto = 1\nsteps = 4\n[parameters]\nl2 = [0.4, 0.5]\n")
        .expect("it can be written");
    assert_eq!(program(&["run", &file, "--out", &out]), status(0));
    assert_eq!(program(&["run", &file, "--out", &out]), status(1));
    assert_eq!(program(&["run", &file, "--out", &out, "--resume"]), status(0));
    assert_eq!(count(Path::new(&out), "select count(*) from study where l2 = 0.4 or l2 = 0.5"), 100);
    assert_eq!(program(&["query", "select nothing from study", "--in", &out]), status(1));
    assert_eq!(program(&["chunk", &file, "--out", &out, "--index", "2", "--of", "2"]), status(2));
    assert_eq!(program(&["walk"]), status(2));
    fs::write(&file, "rows = 100\nmotion = 3\n").expect("it can be written");
    assert_eq!(program(&["run", &file, "--out", &out]), status(2));
    assert_eq!(program(&["run", "no such file", "--out", &out]), status(1));
}
