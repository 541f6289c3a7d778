//! Whole studies: rows that do not depend on how the work is cut, scores as single solutions give them, what is kept, what is
//! refused, and programs that are interrupted, killed, or have no room on their disk.

// Their `main` is not called here.
#[allow(dead_code, unreachable_pub)]
#[path = "../../atlas.rs"]
mod atlas;
#[allow(dead_code, unreachable_pub)]
#[path = "../../four_bar.rs"]
mod four_bar;
#[allow(dead_code, unreachable_pub)]
#[path = "../../press.rs"]
mod press;

#[cfg(all(feature = "cluster", target_os = "linux"))]
mod clusters;
mod forces;
mod identity;
mod inputs;
mod paths;
#[cfg(target_os = "linux")]
mod processes;
mod refused;
mod rows;

use kin_study::{Limits, Range, Score, Study, query, query_to_file};
use std::fs;
use std::num::NonZero;
use std::path::Path;
use tempfile::TempDir;

fn directory() -> TempDir {
    tempfile::tempdir().expect("there is room for temporary files")
}

/// Four-bars of which some cannot turn all the way.
fn study(rows: u64) -> Study {
    Study::new()
        .rows(rows)
        .seed(4)
        .parameter("l2", Range::Uniform { from: 0.15, to: 0.5 })
        .parameter("l3", Range::Normal { mean: 0.3, deviation: 0.1, from: 0.1, to: 0.5 })
        .turn(0.0, 6.0, 40)
        .score("swing", Score::Range("rocker.phi".to_owned()))
        .score("fastest", Score::Greatest("|rocker.phi_dot|".to_owned()))
}

fn limits(threads: usize) -> Limits {
    Limits { threads: NonZero::new(threads), resume: false }
}

/// All rows of a directory as CSV text.
fn table(directory: &Path) -> String {
    let file = directory.join("all.csv");
    query_to_file(directory, "select * from study order by row", &file).expect("there are rows");
    fs::read_to_string(file).expect("it was written")
}

/// The number in the first row and column of an answer.
fn count(directory: &Path, sql: &str) -> i64 {
    let text = query(directory, sql).expect("it is understood").to_string();
    let number = text.lines().nth(3).expect("there is a row").trim_matches(['|', ' ']).to_owned();
    number.parse().unwrap_or_else(|_| panic!("{number} is no number"))
}
