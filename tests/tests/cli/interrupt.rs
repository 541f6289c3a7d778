//! Ctrl-C: all finished results are written, and the exit status reports the interruption.

use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

/// Starts a command that runs for a long time, and waits until it handles signals.
fn start(line: &str) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_several"))
        .args(line.split_whitespace())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // SIGINT is signal number 2; its bit is set when the program handles it.
    until(&child, "SigCgt:", |mask| u64::from_str_radix(mask, 16).is_ok_and(|mask| mask & 0b10 != 0));
    std::thread::sleep(Duration::from_millis(100));
    child
}

/// Waits until a line of the process status satisfies a condition.
fn until(child: &Child, key: &str, wanted: impl Fn(&str) -> bool) {
    let began = Instant::now();
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).expect("the process is there");
        let value = status.lines().find_map(|line| line.strip_prefix(key)).unwrap_or_default();
        if wanted(value.trim()) {
            return;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "{key} stays {value}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn interrupt(child: &Child) {
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
}

/// The output and the error output of an interrupted command.
fn interrupted(line: &str) -> (String, String) {
    let child = start(line);
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
    assert_eq!(output.status.code(), Some(130), "{line}: {err}");
    assert!(err.starts_with("interrupted: ") && err.lines().count() == 1, "{line}: {err}");
    (out, err)
}

/// The number 12 in `12 of 1000001 instants`.
fn finished(err: &str) -> usize {
    let number = err.strip_prefix("interrupted: ").and_then(|rest| rest.split(' ').next());
    number.and_then(|number| number.parse().ok()).expect("a number")
}

#[test]
fn a_sweep_leaves_its_finished_rows() {
    let (out, err) = interrupted("fourbar sweep --to 1000 --steps 1000000 --format csv");
    assert!(err.contains(" of 1000001 instants finished, up to t = "), "{err}");
    let rows: Vec<Vec<f64>> =
        out.lines().skip(1).map(|l| l.split(',').map(|n| n.parse().expect("a number")).collect()).collect();
    assert!(out.ends_with('\n') && rows.iter().all(|row| row.len() == 28));
    assert_eq!(rows.len(), finished(&err));
    assert!(!rows.is_empty() && rows.len() < 1_000_001);
    assert!((rows[rows.len() - 1][0] - 0.001 * (rows.len() - 1) as f64).abs() < 1e-9);
}

#[test]
fn a_file_is_whole_and_says_that_the_motion_is_not() {
    let file = std::env::temp_dir().join(format!("kin-interrupted-{}.json", std::process::id()));
    std::fs::write(&file, "old").expect("a file");
    let line = "fourbar sweep --to 1000 --steps 1000000";
    for points in ["", "--points"] {
        let (out, err) = interrupted(&format!("{line} {points} --out {}", file.display()));
        let text = std::fs::read_to_string(&file).expect("a file");
        let swept: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!((out.as_str(), &swept["complete"]), ("", &Value::Bool(false)));
        assert_eq!(swept["states"].as_array().map(Vec::len), Some(finished(&err)));
    }
    std::fs::remove_file(file).expect("the file goes");
}

#[test]
fn two_instants_that_are_far_apart_are_no_trap() {
    let (out, err) = interrupted("fourbar sweep --times 0,30000 --format csv");
    assert_eq!((out.lines().count(), finished(&err)), (2, 1));
}

#[test]
fn pages_diagrams_and_checks_end_too() {
    let (page, err) = interrupted("fourbar animate --to 1000 --steps 1000000");
    let told = format!("The motion was interrupted: {}", err.trim_end().trim_start_matches("interrupted: "));
    assert!(page.contains(&told), "{told}");
    let (svg, err) = interrupted("fourbar plot --vary l1=0.09..0.11:5 --to 1000 --steps 300000");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && err.contains(" of 5 motions"), "{err}");
    let (out, err) = interrupted("fourbar check --configurations 100000000");
    assert!(out.is_empty() && err.contains(" of 100000001 configurations"), "{err}");
}

#[test]
fn the_second_ends_the_program_at_once() {
    // Nobody reads the output, so that the program blocks and cannot end by itself.
    let mut child = start("fourbar sweep --to 1000 --steps 1000000 --points --format csv");
    std::thread::sleep(Duration::from_millis(300));
    interrupt(&child);
    until(&child, "State:", |state| state.starts_with('S'));
    interrupt(&child);
    let status = child.wait().expect("the program ends");
    assert_eq!(status.signal(), Some(2), "{status}");
    let mut err = String::new();
    child.stderr.take().expect("stderr").read_to_string(&mut err).expect("UTF-8");
    assert_eq!(err, "");
}

/// Rows are written as they are computed, so that a long sweep needs no more memory than a short one.
#[test]
fn a_long_sweep_takes_little_memory() {
    let file = std::env::temp_dir().join(format!("kin-long-{}", std::process::id()));
    for ending in ["csv", "json"] {
        let path = file.with_extension(ending);
        let line = format!("fourbar sweep --points --to 100 --steps 100000 --out {}", path.display());
        let mut child = start(&line);
        let mut most = 0;
        while child.try_wait().expect("the process is there").is_none() {
            let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
            let peak =
                status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.parse().ok());
            most = peak.unwrap_or(0).max(most);
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(child.wait().expect("a status").success());
        let size = std::fs::metadata(&path).expect("a file").len();
        std::fs::remove_file(&path).expect("a file");
        // The memory is limited to 50 MB, which is less than the size of the file.
        assert!(most > 0 && most < 50_000 && size > 50_000_000, "{ending}: {most} kB for {size} bytes");
    }
}
