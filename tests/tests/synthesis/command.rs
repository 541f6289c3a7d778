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

#[path = "../../../examples/pump_jack.rs"]
#[allow(dead_code, unreachable_pub, reason = "a program of its own")]
mod pump_jack;

/// The counterweight with which the pump jack needs the smallest motor.
#[test]
fn the_greatest_torque_is_made_least() {
    use kin_runtime::{Kinematics, Mechanism};
    use pump_jack::PumpJack;

    let file = std::env::temp_dir().join(format!("kin-peak-{}.json", std::process::id()));
    let out = file.to_string_lossy().into_owned();
    let args = ["pump_jack", "design", "--peak", "motor.effort", "--free", "counterweight=500..9000"];
    let args = [&args[..], &["--starts", "1", "--out", &out]].concat();
    assert_eq!(ExitCode::SUCCESS, run_from::<PumpJack>(args.into_iter().map(str::to_owned)));
    let found: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    std::fs::remove_file(&file).unwrap();
    // The same by trying all of them.
    let turn = std::f64::consts::TAU / PumpJack::default().omega;
    let times: Vec<f64> = (0..37).map(|k| turn * f64::from(k) / 36.0).collect();
    let greatest = |counterweight: f64| {
        let pump = PumpJack { counterweight, ..PumpJack::default() };
        let solver = pump.solver();
        let states = solver.sweep(&times).unwrap().states;
        let torque = |state| solver.forces(state).unwrap().effort("motor").unwrap().abs();
        states.iter().map(torque).fold(0.0, f64::max)
    };
    let best = (50..=900).map(|k| greatest(10.0 * f64::from(k))).fold(f64::INFINITY, f64::min);
    let least = found["least"].as_f64().unwrap();
    assert!(least <= best && least > 0.98 * best, "{least} instead of {best}: {found}");
    let counterweight = found["parameters"]["counterweight"].as_f64().unwrap();
    assert!((greatest(counterweight) - least).abs() < 1e-6 * least, "{counterweight}");
    assert!(PumpJack::model().forces.is_some());
}
