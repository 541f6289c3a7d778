//! A designer's use of the command line: quantities by name, varied parameters, extremes, and motions up to their
//! limits, compared with closed forms.

use std::f64::consts::{FRAC_PI_4, PI};
use std::process::{Command, Output, Stdio};

use kin_runtime::{Kinematics, Measure, Mechanism, cli, mechanism};
use kin_tests::mechanisms::FourbarLectureMid;

/// A crank of 0.2 m and a rod of 0.7 m whose slider runs 0.1 m above the crankshaft.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, e), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 3 * t)]
#[define(lean = abs(rod.phi))]
#[point(pin = rod @ (l, 0))]
#[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = r + l)]
struct SliderCrank {
    #[param(0.2, unit = "m")]
    r: f64,
    #[param(0.7, unit = "m")]
    l: f64,
    #[param(0.1, unit = "m")]
    e: f64,
}

fn kin(line: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_several");
    Command::new(program).args(line.split_whitespace()).stdin(Stdio::null()).output().expect("the program starts")
}

/// stdout and stderr of a command that succeeds.
fn good(line: &str) -> (String, String) {
    let output = kin(line);
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{line}: {err}");
    (out, err)
}

fn rows(csv: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = csv.lines();
    let names = lines.next().expect("a header").split(',').collect();
    let number = |cell: &str| cell.parse().unwrap_or(f64::NAN);
    (names, lines.map(|line| line.split(',').map(number).collect()).collect())
}

/// What the slider-crank writes as json.
fn slider(line: &str) -> serde_json::Value {
    let place = format!("kin-designer-{}-{:?}.json", std::process::id(), std::thread::current().id());
    let file = std::env::temp_dir().join(place);
    let path = file.display().to_string();
    let words = ["slider"].into_iter().chain(line.split_whitespace()).chain(["--out", &path]);
    let code = cli::run_from::<SliderCrank>(words);
    assert_eq!(format!("{code:?}"), format!("{:?}", std::process::ExitCode::SUCCESS), "{line}");
    let text = std::fs::read_to_string(&file).expect("it is written");
    std::fs::remove_file(&file).expect("it is there");
    serde_json::from_str(&text).expect("json")
}

/// The least or the greatest of a quantity in the first motion.
fn extreme(json: &serde_json::Value, quantity: &str, side: &str) -> (f64, f64, String) {
    let all = json["motions"][0]["extremes"].as_array().expect("extremes");
    let found = all.iter().find(|range| range["quantity"] == quantity).unwrap_or_else(|| panic!("{quantity}: {json}"));
    let found = &found[side];
    let number = |name: &str| found[name].as_f64().unwrap_or(f64::NAN);
    (number("value"), number("t"), found["where"].as_str().expect("where").to_owned())
}

const BARS: [f64; 3] = [0.1, 0.4, 0.3];

/// The transmission angle where the crank's end is so far from the rocker's pivot.
fn transmission(distance: f64) -> f64 {
    let [_, l2, l3] = BARS;
    ((l2 * l2 + l3 * l3 - distance * distance) / (2.0 * l2 * l3)).acos()
}

#[test]
fn transmission_angles_speeds_and_velocity_ratios_are_columns() {
    let (csv, _) =
        good("fourbar sweep B.transmission rocker.phi/drive B.speed/drive B.speed t --steps 20 --format csv");
    let (names, rows) = rows(&csv);
    assert_eq!(names, ["t", "B.transmission", "rocker.phi/drive", "B.speed/drive", "B.speed", "t"]);
    assert_eq!(rows.len(), 21);
    let four_bar = FourbarLectureMid::default();
    let solver = four_bar.solver();
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    for (state, row) in solver.sweep(&times).expect("it turns").iter().zip(&rows) {
        let phi = state.q[2];
        let d = (0.4 - 0.1 * phi.cos()).hypot(0.1 - 0.1 * phi.sin());
        assert!((row[1] - transmission(d)).abs() < 1e-12);
        let omega = state.q_dot[2];
        assert!((row[2] - state.q_dot[8] / omega).abs() < 1e-12);
        let v = state[FourbarLectureMid::B].v;
        assert!((row[4] - v[0].hypot(v[1])).abs() < 1e-12 && (row[3] - row[4] / omega.abs()).abs() < 1e-12);
    }
}

#[test]
fn degrees_and_units_follow_the_quantity() {
    let model = SliderCrank::model();
    let unit = |name: &str| Measure::named(model, name).and_then(|measure| measure.unit(&model.units));
    assert_eq!(unit("slider.x/drive").as_deref(), Some("m/rad"));
    assert_eq!(unit("pin.speed").as_deref(), Some("m/s"));
    assert_eq!(unit("A.transmission"), None, "its crank is driven");
    assert_eq!(Measure::named(model, "slider.x_dot/drive"), None, "a rate has no velocity ratio");
    let radians = slider("sweep slider.x/drive rod.phi/drive --times 0.2");
    let degrees = slider("sweep slider.x/drive rod.phi/drive --times 0.2 --degrees");
    let value = |json: &serde_json::Value, name: &str| json["states"][0]["quantities"][name].as_f64().expect("a value");
    let ratio = value(&radians, "slider.x/drive") / value(&degrees, "slider.x/drive");
    assert!((ratio - 180.0 / PI).abs() < 1e-10, "by radian and by degree");
    assert_eq!(value(&radians, "rod.phi/drive"), value(&degrees, "rod.phi/drive"));
}

#[test]
fn unknown_quantities_and_drivers_say_what_there_is() {
    for (line, parts) in [
        ("fourbar sweep B.transmision", ["did you mean `B.transmission`?", "velocity ratios NAME/DRIVER to drive"]),
        ("fourbar extremes B.x/driv", ["no driver named `driv`; did you mean `drive`?", "drivers: drive"]),
        ("fourbar plot B.transmission/drive", ["`B.transmission` has no velocity ratio", "coordinates, points"]),
    ] {
        let output = kin(line);
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{line}");
        parts.iter().for_each(|part| assert!(err.contains(part), "{line}: {err}"));
    }
}

#[test]
fn a_sweep_over_values_of_parameters_has_them_in_every_row() {
    let (csv, _) = good("fourbar sweep --vary l1=0.08..0.1:3 --vary l2=0.4,0.42 --steps 4 --format csv");
    let (names, rows) = rows(&csv);
    assert_eq!(names[..4], ["l1", "l2", "t", "crank.x"]);
    assert_eq!(rows.len(), 3 * 2 * 5);
    assert_eq!([rows[0][0], rows[0][1], rows[29][0], rows[29][1]], [0.08, 0.4, 0.1, 0.42]);
    assert!(rows.iter().all(|row| (row[3].hypot(row[6]) - 0.5 * row[0]).abs() < 1e-12), "the crank's middle");
    let json = slider("sweep rod.phi --vary r=0.1..0.2:2 --steps 2");
    let motions = json["motions"].as_array().expect("motions");
    assert_eq!((motions.len(), &json["varied"]), (2, &serde_json::json!(["r"])));
    assert_eq!(motions[1]["varied"]["r"], 0.2);
    assert_eq!(motions[0]["states"].as_array().map(Vec::len), Some(3));
    let (text, _) = good("fourbar sweep B.x --vary l1=0.08,0.1 --steps 2");
    assert!(text.contains("l1 = 0.08, 3 instants") && text.contains("l1 = 0.1, 3 instants"), "{text}");
}

#[test]
fn one_of_several_motions_that_fails_leaves_the_others() {
    let output = kin("fourbar sweep crank.phi --vary l1=0.1,0.9 --steps 4 --to 0.2 --format csv");
    assert_eq!(output.status.code(), Some(1));
    let out = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(rows(&out).1.iter().filter(|row| row[0] == 0.1).count(), 5);
    assert!(String::from_utf8_lossy(&output.stderr).contains("note: l1 = 0.9: "));
}

#[test]
fn extremes_are_exact_between_instants() {
    let json = slider("extremes slider.x slider.x_dot rod.phi lean drive.nothing".trim_end_matches(" drive.nothing"));
    let (r, l, e) = (0.2_f64, 0.7_f64, 0.1_f64);
    // Crank and rod on one line, outwards and inwards.
    let expected = [("greatest", l + r), ("least", l - r)].map(|(side, reach)| (side, (reach * reach - e * e).sqrt()));
    for (side, expected) in expected {
        let (value, t, place) = extreme(&json, "slider.x", side);
        assert!((value - expected).abs() < 1e-13 * expected, "{side}: {value} and {expected}");
        // The crank is in line with the rod there.
        let phi = (e / if side == "greatest" { l + r } else { -(l - r) }).asin();
        let phi = if side == "greatest" { phi } else { PI + phi.abs() };
        assert!((3.0 * t - phi).abs() < 1e-9, "{side} at {t}");
        assert_eq!(place, "between instants");
    }
    let (value, t, _) = extreme(&json, "rod.phi", "greatest");
    assert!((value - ((e + r) / l).asin()).abs() < 1e-13 && (3.0 * t - 1.5 * PI).abs() < 1e-9);
    // Where the rod lies level, |φ| has a kink.
    let (value, t, place) = extreme(&json, "lean", "least");
    assert!(value.abs() < 1e-9 && place == "kink", "{value} {place}");
    assert!((r * (3.0 * t).sin() - e).abs() < 1e-9);
    // At the extreme of a rate the acceleration is 0.
    let (_, t, _) = extreme(&json, "slider.x_dot", "greatest");
    let at = slider(&format!("sweep slider.x_ddot slider.x_dot --times {t:e}"));
    let ddot = at["states"][0]["quantities"]["slider.x_ddot"].as_f64().expect("a value");
    assert!(ddot.abs() < 1e-7, "{ddot}");
}

#[test]
fn few_instants_do_as_well_as_many() {
    let values = |steps: &str| {
        let json = slider(&format!("extremes slider.x_ddot pin.speed/drive --steps {steps}"));
        let of = |name: &str, side: &str| extreme(&json, name, side).0;
        [of("slider.x_ddot", "least"), of("slider.x_ddot", "greatest"), of("pin.speed/drive", "greatest")]
    };
    for (few, many) in values("24").into_iter().zip(values("3000")) {
        assert!((few - many).abs() < 1e-11 * many.abs(), "{few} and {many}");
    }
}

/// Rod and rail are nearly perpendicular once in a turn, where the slider's acceleration has a spike of a few degrees.
#[test]
fn extremes_between_few_instants_are_those_between_many() {
    let quantities = ["slider.x_ddot", "rod.phi_ddot", "slider.x_dot"];
    let line = |steps: u32| format!("extremes {} --set l=0.3005 --steps {steps}", quantities.join(" "));
    let dense = slider(&line(3000));
    for steps in [1, 5, 30] {
        let json = slider(&line(steps));
        for quantity in quantities {
            for side in ["least", "greatest"] {
                let (found, expected) = (extreme(&json, quantity, side).0, extreme(&dense, quantity, side).0);
                let off = (found - expected).abs();
                assert!(off <= 1e-9 * expected.abs().max(1.0), "{side} {quantity}, {steps} steps: {found} {expected}");
            }
        }
    }
}

#[test]
fn extremes_of_transmission_angles_vary_with_the_dimensions() {
    let (csv, _) = good("fourbar extremes B.transmission --vary l1=0.06..0.1:3 --format csv");
    let header = "l1,quantity,unit,least,least_t,least_crank.phi,least_where,greatest,greatest_t,greatest_crank.phi,greatest_where";
    assert_eq!(csv.lines().next(), Some(header));
    let (_, rows) = rows(&csv);
    assert_eq!(rows.len(), 3);
    let ground = 0.4_f64.hypot(0.1);
    for row in rows {
        let [least, greatest] = [ground - row[0], ground + row[0]].map(transmission);
        assert!((row[3] - least).abs() < 1e-12 && (row[7] - greatest).abs() < 1e-12, "{row:?}");
    }
    let (text, _) = good("fourbar extremes crank.phi --to 1 --degrees");
    assert!(text.contains("first instant") && text.contains("last instant"), "{text}");
}

/// A limit that is near the start on one side is reached however few steps there are.
#[test]
fn few_steps_reach_both_limits() {
    // At 45° the crank is a little before the angle at which coupler and rocker are stretched.
    for speed in ["2", "-2"] {
        let line = format!("fourbar sweep crank.phi --set l1=1.0141,w={speed} --from limit --to limit --format csv");
        let ends = |steps: usize| {
            let (csv, notes) = good(&format!("{line} --steps {steps}"));
            assert!(notes.contains("it begins at t = ") && notes.contains("it ends at t = "), "{steps}: {notes}");
            let (_, rows) = rows(&csv);
            (rows[0][1], rows[rows.len() - 1][1])
        };
        let (first, last) = ends(60);
        assert!((first - last).abs() > 1.0, "{first} {last}");
        for steps in [1, 2, 3, 5, 7] {
            let few = ends(steps);
            assert!((few.0 - first).abs() < 1e-9 && (few.1 - last).abs() < 1e-9, "{steps}: {few:?}");
        }
    }
}

#[test]
fn a_motion_goes_as_far_as_the_mechanism() {
    // A crank that is longer than the ground: the angle at which coupler and rocker lie on one line.
    let line = "fourbar sweep B.transmission rocker.phi_dot crank.phi --set l1=0.5 --from limit --to limit --steps 40";
    let (csv, notes) = good(&format!("{line} --format csv"));
    let (_, rows) = rows(&csv);
    let ground = 0.4_f64.hypot(0.1);
    let direction = 0.1_f64.atan2(0.4);
    let at = |reach: f64| ((0.25 + ground * ground - reach * reach) / ground).acos();
    // Folded at one end, stretched at the other.
    let [folded, stretched] = [direction + at(0.1), direction + at(0.7)];
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    assert!((first[3] - folded).abs() < 1e-9 && first[1].abs() < 1e-6, "{first:?} {folded}");
    assert!((last[3] - stretched).abs() < 1e-9 && (last[1] - PI).abs() < 1e-6, "{last:?} {stretched}");
    assert!(first[2].is_nan() && last[2].is_nan(), "rates have no value at a dead centre");
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    // So close together beside the limits that no step of the angle stands out.
    let steps: Vec<f64> = rows.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs()).collect();
    let largest = steps.iter().copied().fold(0.0, f64::max);
    assert!(largest < 5.0 * PI / 40.0, "{largest}");
    assert!(notes.contains("it begins at t = ") && notes.contains("it ends at t = ") && notes.contains("dead centre"));
    let start = FRAC_PI_4 / FourbarLectureMid::default().w;
    assert!((first[0] - (folded / FourbarLectureMid::default().w - start)).abs() < 1e-9);
}

#[test]
fn a_crank_without_a_limit_turns_once() {
    let (csv, notes) = good("fourbar sweep crank.phi --to limit --steps 4 --format csv");
    let (_, rows) = rows(&csv);
    assert!((rows[4][1] - rows[0][1] - 2.0 * PI).abs() < 1e-12 && rows.len() == 5);
    assert!(notes.contains("no limit is met in a turn of the driven crank"), "{notes}");
}

#[test]
fn a_limit_may_come_after_several_turns() {
    // The rod lies flat at the feed of 0.1: after 10 rad.
    for size in [1.0, 1e-6] {
        let (csv, notes) = good(&format!("spindle sweep slider.x --set size={size} --to limit --steps 4 --format csv"));
        let (_, all) = rows(&csv);
        let last = all.last().expect("rows");
        assert!((last[0] - 5.0).abs() < 1e-9 && (last[1] / size - 0.9).abs() < 1e-9, "{csv}");
        assert!(notes.contains("dead centre"), "{notes}");
    }
    // 100 turns are 200 pi rad.
    let (csv, notes) = good("spindle sweep slider.x --set lead=1e-4 --to limit --steps 4 --format csv");
    let (_, all) = rows(&csv);
    assert!((all.last().expect("rows")[0] - PI).abs() < 1e-12, "{csv}");
    assert!(notes.contains("no limit is met in 100 turns of the driven crank"), "{notes}");
}

#[test]
fn curves_end_at_their_limits_with_a_mark() {
    let (svg, _) = good("fourbar plot rocker.phi B.transmission --set l1=0.5 --from limit --to limit");
    assert!(svg.contains(">dead centre of A, B, D<"), "the legend names it");
    assert!(svg.matches("<circle").count() >= 4, "two ends of two curves");
    let (svg, _) = good("fourbar plot rocker.phi B.transmission");
    assert!(!svg.contains("dead centre"));
}

/// A parallelogram, whose coupler does not turn, with a point at the height of its ground.
#[mechanism]
#[bodies(left, right, coupler)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: ground @ (0.7, 0.1), right @ (0, 0))]
#[revolute(C: left @ (0.3, 0), coupler @ (0, 0))]
#[revolute(D: right @ (0.3, 0), coupler @ (0.7, 0.1))]
#[driver(drive: left.phi = 0.6 + 0.9 * sin(t))]
#[guess(left.phi = 0.6, right.phi = 0.6, coupler.phi = 0)]
#[point(fixed = coupler @ (0.3, 0.2))]
struct Parallelogram;

/// The angle of a coupler that does not turn is rounding, neither least nor greatest.
#[test]
fn rounding_is_no_extreme() {
    let out = concat!(env!("CARGO_TARGET_TMPDIR"), "/rounding.txt");
    let command = |what: &[&str]| {
        let words = [&["parallelogram", "extremes"], what, &["--to", "3", "--out", out]].concat();
        assert_eq!(std::process::ExitCode::SUCCESS, cli::run_from::<Parallelogram>(words));
        std::fs::read_to_string(out).unwrap()
    };
    let all = command(&[]);
    assert!(all.contains("right.phi") && all.contains("fixed.y") && !all.contains("coupler.phi"), "{all}");
    let asked = command(&["coupler.phi", "coupler.phi_dot"]);
    assert_eq!(4, asked.matches("constant").count(), "{asked}");
}
