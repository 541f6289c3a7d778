//! Forces on the command line for joints whose forces are not determined.

use serde_json::Value;

use super::{good, kin};

#[test]
fn what_is_not_determined_is_an_empty_cell_and_no_number() {
    let table = good("loaded sweep --from 0 --to 0.2 --steps 2 --points --format csv");
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|column| *column == name).unwrap();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[column("A.force_x")], "", "{line}");
        assert!(cells[column("drive.effort")].parse::<f64>().unwrap().is_finite(), "{line}");
        assert!(!line.contains("NaN"), "{line}");
    }
    let ran = kin("loaded forces --at 0.2 --format json");
    assert!(ran.status == Some(0) && ran.err.contains("redundant rows share the load"), "{}", ran.err);
    let answer: Value = serde_json::from_str(&ran.out).unwrap();
    assert!(answer["reactions"]["A"]["force"].is_null(), "{answer}");
}
