//! Completion scripts, which include the names of the mechanism.

use std::process::Command;

use crate::{failed, good};

/// The completions that bash offers for the last of `words`.
fn offered(script: &str, words: &[&str]) -> Vec<String> {
    let quoted: Vec<String> = words.iter().map(|word| format!("'{word}'")).collect();
    let (last, before) = (words[words.len() - 1], words[words.len() - 2]);
    let call = format!(
        "source /dev/stdin\nCOMP_WORDS=({})\nCOMP_CWORD={}\n\
         _several_names several '{last}' '{before}'\nprintf '%s\\n' \"${{COMPREPLY[@]}}\"",
        quoted.join(" "),
        words.len() - 1
    );
    let mut bash = Command::new("bash");
    let output = run(bash.args(["--norc", "-c", &call]), script);
    output.lines().map(str::to_owned).collect()
}

/// The output of a program with a text as its input.
fn run(command: &mut Command, text: &str) -> String {
    let path =
        std::env::temp_dir().join(format!("kin-completions-{}-{:?}", std::process::id(), std::thread::current().id()));
    std::fs::write(&path, text).expect("a file");
    let output = command.stdin(std::fs::File::open(&path).expect("a file")).output().expect("it starts");
    let _ = std::fs::remove_file(path);
    let err = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && err.is_empty(), "{command:?}: {err}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn bash_completes_commands_options_and_names() {
    if Command::new("bash").arg("--version").output().is_err() {
        eprintln!("skipped: there is no bash");
        return;
    }
    let script = good("leg completions bash");
    run(Command::new("bash").arg("-n"), &script);
    assert_eq!(offered(&script, &["several", "sw"]), ["sweep"]);
    assert_eq!(offered(&script, &["several", "solve", "--gu"]), ["--guess"]);
    assert_eq!(offered(&script, &["several", "solve", "--set", "hip"]), ["hip_x[0]=", "hip_x[1]="]);
    assert_eq!(offered(&script, &["several", "sweep", "--given", "shank[1].p"]), ["shank[1].phi="]);
    assert_eq!(offered(&script, &["several", "sweep", "--input", ""]), ["motor[0]=", "motor[1]="]);
    let modes = ["knee[0]-ankle-knee[1]=+", "knee[0]-ankle-knee[1]=-"];
    assert_eq!(offered(&script, &["several", "animate", "--mode", "k"]), modes);
    assert_eq!(offered(&script, &["several", "solve", "--format", ""]), ["text", "json", "csv"]);
    assert_eq!(offered(&script, &["several", "plot", "--format", ""]), ["svg", "png"]);
    assert!(offered(&script, &["several", "plot", "foot"]).contains(&"foot.x_dot".to_owned()));
    assert!(offered(&script, &["several", "equations", "knee"]).contains(&"knee[1]".to_owned()));
}

#[test]
fn other_shells_have_the_names_too() {
    for shell in ["zsh", "fish", "powershell", "elvish"] {
        let script = good(&format!("fourbar completions {shell}"));
        assert!(script.contains("sweep") && script.contains("least-norm"), "{shell}");
        let named = script.contains("crank.phi") || matches!(shell, "powershell" | "elvish");
        assert!(named, "{shell}: {script}");
    }
    failed("fourbar completions basch", 2, &["basch", "bash"]);
}
