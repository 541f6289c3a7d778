//! Tests that help texts fit the screen, and that their examples use the names of the mechanism.

use crate::{failed, good, kin};

const MECHANISMS: [&str; 3] = ["fourbar", "leg", "underdriven"];
const COMMANDS: [&str; 10] =
    ["", "info", "solve", "sweep", "extremes", "check", "equations", "animate", "plot", "completions"];
const MORE_COMMANDS: [&str; 5] = ["forces", "sensitivities", "design", "modes", "limits"];

/// The first line of a help text that does not fit the screen. The first line of all is the documentation of the mechanism;
/// the option for inputs is appended to every example.
fn too_long(text: &str) -> Option<&str> {
    text.lines().skip(1).find(|line| line.chars().count() > 100 && !line.contains("--input '"))
}

/// The help of commands that have no example for some mechanisms fits the screen as well.
#[test]
fn help_of_more_commands_fits_the_screen() {
    for mechanism in ["fourbar", "leg", "eccentric"] {
        for command in MORE_COMMANDS {
            for help in ["-h", "--help"] {
                let line = format!("{mechanism} {command} {help}");
                assert_eq!(too_long(&good(&line)), None, "{line}");
            }
        }
    }
}

#[test]
fn help_fits_the_screen_and_has_examples() {
    for mechanism in MECHANISMS {
        for command in COMMANDS {
            for help in ["-h", "--help"] {
                let line = format!("{mechanism} {command} {help}");
                let text = good(&line);
                assert!(text.contains("\nExamples:\n  several"), "{line}: {text}");
                assert_eq!(too_long(&text), None, "{line}");
                assert!(!text.contains('\u{1b}'), "{line}: colours in a pipe");
            }
        }
    }
    let long = good("fourbar sweep --help");
    for part in ["Parameters:  l1, l2", "Coordinates: crank.x", "Modes:       A-B-D", "--set l1=0.1 ", "--mode A-B-D=-"]
    {
        assert!(long.contains(part), "`{part}` is not in\n{long}");
    }
    assert!(long.contains("[default: 100]") && good("fourbar plot -h").contains("[default: 360]"));
    assert!(good("limits sweep --help").contains("--stop-at-events  "), "the mechanism has limits");
    assert!(!long.contains("--stop-at-events  "), "the mechanism has no limits");
    assert!(good("underdriven solve -h").contains(" --given "));
}

/// The arguments in a line of an example, split as a shell does, without the comment.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for letter in line.trim().chars() {
        match letter {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(std::mem::take(&mut word)),
            other => word.push(other),
        }
    }
    words.push(word);
    // Two spaces end the command.
    let end = words.iter().position(String::is_empty).unwrap_or(words.len());
    words.truncate(end);
    words
}

/// Every example in every help text runs successfully.
#[test]
fn examples_run() {
    let place = std::env::temp_dir().join(format!("kin-examples-{}", std::process::id()));
    std::fs::create_dir_all(&place).expect("a directory");
    let (mut tried, mut failed) = (0, Vec::new());
    for mechanism in ["fourbar", "leg", "underdriven", "limits", "redundant", "cam", "ends", "teeth"] {
        // The programs of the examples try all commands of all mechanisms, optimised.
        let more: &[&str] = if ["fourbar", "leg"].contains(&mechanism) { &MORE_COMMANDS } else { &[] };
        for command in COMMANDS.iter().chain(more) {
            let help = good(&format!("{mechanism} {command} --help"));
            // Commands that draw have no example for a mechanism without anything to draw.
            let Some(examples) = help.split("\nExamples:\n").nth(1) else { continue };
            let examples = examples.split("\n\n").next().unwrap_or_default();
            for example in examples.lines().filter(|line| line.starts_with("  several") && !line.contains('>')) {
                // A picture of points takes seconds to write; one mechanism is enough for those.
                let points = if mechanism == "fourbar" { ".png" } else { ".svg" };
                let args = words(&example.replace(".png", points));
                let output = std::process::Command::new(env!("CARGO_BIN_EXE_several"))
                    .arg(mechanism)
                    .args(&args[1..])
                    .current_dir(&place)
                    .output()
                    .expect("the program starts");
                tried += 1;
                if !output.status.success() {
                    failed.push(format!("{mechanism}: {example}\n{}", String::from_utf8_lossy(&output.stderr)));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{} of {tried}:\n{}", failed.len(), failed.join("\n"));
    assert!(tried > 300, "{tried} examples");
    assert!(place.join("motion.html").is_file() && place.join("paths.svg").is_file());
    std::fs::remove_dir_all(place).expect("the directory goes");
}

#[test]
fn wrong_names_of_a_design_are_told_all_at_once() {
    let line = "fourbar design --free l9=1..2 --peak C.effort --range C.z=0..1 --path nowhere=points.csv";
    let missing =
        ["parameter named `l9`", "quantity named `C.effort`", "quantity named `C.z`", "point named `nowhere`"];
    failed(line, 2, &missing.map(|what| format!("no {what}")).iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn a_design_without_a_wish_or_a_free_parameter_names_both_options() {
    failed("fourbar design", 2, &["--free: no parameter may vary; write --free NAME=", "--path: nothing is wanted"]);
}

#[test]
fn an_error_names_the_mechanism_once() {
    let ran = kin("fourbar solve --forces");
    assert!(ran.err.starts_with("error: FourbarLectureMid has neither masses nor loads"), "{}", ran.err);
}

#[test]
fn a_file_and_a_value_are_set_one_by_one() {
    failed("fourbar solve --set @best.json,l1=0.1", 2, &["--set: cannot read", "write --set @best.json --set l1=0.1"]);
}

#[test]
fn wrong_options_are_told_all_at_once() {
    let ran = kin("fourbar sweep --from x --steps 0 --to 1 --set l9=1,l1=a --guess l1=3 --mode A-B-D=up --out a.svg");
    assert_eq!(ran.status, Some(2));
    for part in [
        "error: --from: `x` is not a number",
        "error: --steps: at least 1",
        "error: --out: `a.svg` should end in .txt, .json or .csv; svg is written by `animate` and `plot`",
        "error: --set: no parameter named `l9`; did you mean",
        "error: --set l1: `a` is not a number",
        "error: --guess: no coordinate named `l1`; it is a parameter, which --set sets",
        "error: --mode A-B-D: `up` is no sign",
    ] {
        assert!(ran.err.contains(part), "`{part}` is not in\n{}", ran.err);
    }
    let ran = kin("fourbar plot crank.fi tip:t nothing --vary l1=1..2 --out x.pdf");
    let parts = ["no quantity named `crank.fi`; did you mean `crank.phi`?", "`tip`", "`nothing`", "--vary", "x.pdf"];
    assert!(ran.status == Some(2) && parts.iter().all(|part| ran.err.contains(part)), "{}", ran.err);
    assert_eq!(ran.err.matches("  quantities: t, crank.x, crank.y, crank.phi,").count(), 1, "{}", ran.err);
    // Examples in errors use the names of the mechanism, and errors suggest corrections.
    failed("fourbar solve --set x --guess y", 2, &["write --set l1=0.12\n", "write --guess crank.x=0.9\n"]);
    failed("fourbar solve --mode D=+", 2, &["no mode named `D`; did you mean `A-B-D`?"]);
    failed("fourbar check --configurations 1e3", 2, &["--configurations: `1e3` is no number of configurations"]);
    let no_angle = "`A>40` asks for 40 rad; a transmission angle is 0 to 90deg, as 'JOINT>40deg'";
    failed("fourbar design --free l1 --transmission A>40", 2, &[no_angle]);
    let file = std::env::temp_dir().join(format!("kin-parameters-{}.json", std::process::id()));
    std::fs::write(&file, r#"{"parameters": {"l1": 0.1, "l2": "long"}}"#).unwrap();
    failed(&format!("fourbar solve --set @{}", file.display()), 2, &["the parameter `l2` is no number"]);
    std::fs::remove_file(&file).unwrap();
    failed("fourbar solve 0.5", 2, &["An instant is written --at 0.5\n"]);
    failed("fourbar solve -at 0.5", 2, &["Options have two dashes: --at 0.5\n"]);
    let ran = kin("fourbar equations A X Y");
    assert!(ran.status == Some(2) && ran.err.contains("named `X`") && ran.err.contains("named `Y`"), "{}", ran.err);
}

/// The last angle of a slider-crank is that of its slider, which does not turn.
#[test]
fn examples_are_about_coordinates_that_move() {
    let text = good("limits extremes --help");
    assert!(text.contains("several extremes rod.phi_dot") && !text.contains("slider.phi_dot"), "{text}");
}
