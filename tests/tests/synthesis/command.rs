//! The command `design`, and `--set @FILE`.

use crate::published::{FourBar, timed};
use kin_runtime::cli::run_from;
use serde_json::Value;
use std::process::ExitCode;

#[test]
fn a_design_is_found_and_read_again() {
    let folder = std::env::temp_dir().join(format!("kin-design-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let lines = timed(2).into_iter().map(|(t, [x, y])| format!("{t},{x},{y}\n"));
    std::fs::write(file("points.csv"), format!("t,x,y\n{}", lines.collect::<String>())).unwrap();
    let run = |args: &[String]| run_from::<FourBar>([&["four_bar".to_owned()], args].concat());
    let args = |list: &[&str]| list.iter().map(|arg| (*arg).to_owned()).collect::<Vec<String>>();
    let path = format!("P={}", file("points.csv"));
    let free = "r1=0.1..10,r2=0.1..10,r3=0.1..10,r4=0.1..10,rcx=-10..10,rcy=-10..10";
    let common = ["design", "--path", &path, "--free", free, "--grashof", "r1,r2,r3,r4", "--mode", "A-B-D=-"];
    let best = file("best.json");
    let search = ["--starts", "3", "--seed", "1", "--out", &best];
    assert_eq!(ExitCode::SUCCESS, run(&args(&[&common[..], &search].concat())));
    let found: Value = serde_json::from_str(&std::fs::read_to_string(&best).unwrap()).unwrap();
    assert!(found["error"].as_f64().unwrap() <= 7.4158e-7, "{found}");
    assert_eq!("-", found["modes"]["A-B-D"]);

    let (set, solved) = (format!("@{best}"), file("solved.json"));
    // The file has the assembly mode as well.
    let again = ["solve", "--set", &set, "--at", "1.0471975511965976", "--out", &solved];
    assert_eq!(ExitCode::SUCCESS, run(&args(&again)));
    let state: Value = serde_json::from_str(&std::fs::read_to_string(&solved).unwrap()).unwrap();
    let r = &state["points"]["P"]["r"];
    assert!((r[0].as_f64().unwrap() - 2.372).abs() < 1e-3 && (r[1].as_f64().unwrap() - 3.663).abs() < 1e-3, "{r}");
    let wrong = ["design", "--path", &path, "--free", "r9=1..2"];
    assert_ne!(ExitCode::SUCCESS, run(&args(&wrong)));
    let missing = ["solve", "--set", "@nowhere.json"];
    assert_ne!(ExitCode::SUCCESS, run(&args(&missing)));
    std::fs::remove_dir_all(&folder).unwrap();
}
