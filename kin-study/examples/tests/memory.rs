//! Ten million rows, all of them kept, in bounded memory. Alone in its process, whose memory is measured.

// Its `main` is not called here.
#[allow(dead_code)]
#[path = "../four_bar.rs"]
mod four_bar;

use four_bar::FourBar;
use kin_study::{Limits, Range, Score, Study, Watch, query, run};

#[test]
fn ten_million_rows_take_less_than_a_gigabyte() {
    let study = Study::new()
        .rows(10_000_000)
        .parameter("l3", Range::Uniform { from: 0.25, to: 0.4 })
        .times(&[0.0, 0.1])
        .score("end", Score::At { of: "rocker.phi".to_owned(), t: 0.1 });
    let target = tempfile::tempdir().expect("there is room for temporary files");
    let report = run::<FourBar>(&study, target.path(), Limits::default(), &Watch::default()).expect("it runs");
    assert!(report.is_complete() && report.passed == 10_000_000, "{report}");
    let answer = query(target.path(), "select count(*) as n, count(distinct l3) > 9999000 as all_differ from study");
    let shown = answer.expect("it is understood").to_string();
    assert!(shown.contains("10000000") && shown.contains("true"), "{shown}");
    // Only Linux says so in a file.
    let Ok(status) = std::fs::read_to_string("/proc/self/status") else { return };
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("it is there");
    let most: u64 = most.trim().trim_end_matches(" kB").parse().expect("it is a number");
    assert!(most < 1_000_000, "{most} kB");
}
