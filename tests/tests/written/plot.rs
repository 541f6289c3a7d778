//! Diagrams from the command line: their contents, and the errors for options that contradict one another.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn kin(line: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_several");
    Command::new(program).args(line.split_whitespace()).stdin(Stdio::null()).output().expect("the program starts")
}

fn svg(line: &str) -> String {
    let output = kin(line);
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("SVG is UTF-8")
}

fn refused(line: &str, expected: &[&str]) {
    let output = kin(line);
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{line}: {text}");
    for part in expected {
        assert!(text.contains(part), "{line}: `{part}` is not in\n{text}");
    }
}

/// The points of the curves of a colour, in pixels.
fn curve(svg: &str, colour: &str) -> Vec<Vec<[f64; 2]>> {
    let tags = svg.split("<path ").filter_map(|text| text.split('>').next());
    let paths = tags.filter(|path| path.contains(&format!("stroke=\"{colour}\"")));
    let numbers = |path: &str| -> Vec<[f64; 2]> {
        let way = path.split("d=\"").nth(1).and_then(|d| d.split('"').next()).unwrap_or_default();
        let list: Vec<f64> = way.split(['M', 'L', ' ', ',']).filter_map(|word| word.parse().ok()).collect();
        list.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    paths.map(numbers).filter(|points| points.len() > 5).collect()
}

#[test]
fn a_curve_has_every_instant_where_the_numbers_are() {
    let picture = svg("fourbar plot crank.phi --to 2 --steps 40");
    let [points] = &curve(&picture, "#0072b2")[..] else { panic!("one curve") };
    assert_eq!(points.len(), 41);
    // The crank turns at constant speed, so that its curve is a straight line.
    let (first, last) = (points[0], points[40]);
    for (k, point) in points.iter().enumerate() {
        for axis in 0..2 {
            let expected = first[axis] + (last[axis] - first[axis]) * k as f64 / 40.0;
            assert!((point[axis] - expected).abs() < 0.02, "{point:?}");
        }
    }
    assert!(last[0] > first[0] && last[1] < first[1], "to the right and up");
    for text in ["FourbarLectureMid", "crank.phi in rad", "t in s"] {
        assert!(picture.contains(text), "{text}");
    }
}

#[test]
fn the_axis_of_time_ends_where_the_motion_ends() {
    // A turn takes 2.73 s.
    let picture = svg("fourbar plot rocker.phi");
    assert!(picture.contains(">2.5<") && !picture.contains(">3<"), "a tick stands where no curve is");
}

#[test]
fn without_a_question_a_path_stands_beside_what_moves_most() {
    let picture = svg("ends plot");
    for text in [".x in m", ".y in m", "t in s"] {
        assert!(picture.contains(text), "{text}");
    }
    let [first, second] = &curve(&picture, "#0072b2")[..] else { panic!("two curves") };
    assert!(first.len() > 100 && second.len() > 100);
    // If the two plots were one below the other, the picture would be higher than wide.
    let number = |name: &str| picture.split(&format!("{name}=\"")).nth(1)?.split('"').next()?.parse::<f64>().ok();
    let [width, height] = ["width", "height"].map(|name| number(name).expect("a size"));
    assert!(width > 1.5 * height, "{width} by {height}");
}

#[test]
fn several_quantities_share_the_axis_of_time() {
    let picture = svg("fourbar plot rocker.phi rocker.phi_dot rocker.phi_ddot");
    assert_eq!(picture.matches("t in s").count(), 1);
    let curves = curve(&picture, "#0072b2");
    assert_eq!(curves.len(), 3);
    let ends = |points: &[[f64; 2]]| [points[0][0], points[points.len() - 1][0]];
    assert!(curves.iter().all(|points| ends(points) == ends(&curves[0])));
}

#[test]
fn many_curves_have_many_colours_and_a_whole_legend() {
    let picture = svg("fourbar plot rocker.phi coupler.phi --vary l2=0.35..0.45:14 --steps 20");
    let strokes = picture
        .split("<path ")
        .filter_map(|text| text.split('>').next())
        .filter(|text| text.contains("stroke-width=\"2\""));
    let colours: BTreeSet<&str> =
        strokes.filter_map(|text| text.split("stroke=\"").nth(1)?.split('"').next()).collect();
    assert!(colours.len() >= 28, "{colours:?}");
    assert_eq!(picture.matches(", l2 = ").count(), 28);
}

#[test]
fn a_path_has_equal_axes() {
    // The origin of the crank's frame moves on a circle around the origin.
    let picture = svg("fourbar plot crank --steps 72");
    let [points] = &curve(&picture, "#0072b2")[..] else { panic!("one curve") };
    let extent = |axis: usize| {
        let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[axis]), h.max(p[axis])));
        high - low
    };
    assert!((extent(0) / extent(1) - 1.0).abs() < 0.01, "{} {}", extent(0), extent(1));
}

#[test]
fn one_curve_for_each_value_and_each_quantity() {
    let picture = svg("fourbar plot rocker.phi coupler.phi --vary l2=0.38..0.42:3 --steps 12");
    let colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
    let all: Vec<_> = colours.iter().flat_map(|colour| curve(&picture, colour)).collect();
    assert_eq!(all.len(), 6);
    for text in ["rocker.phi, l2 = 0.38", "coupler.phi, l2 = 0.42", "in rad"] {
        assert!(picture.contains(text), "{text}");
    }
    let distinct = |k: usize| all.iter().any(|other| other != &all[k]);
    assert!((0..6).all(distinct));
}

#[test]
fn files_by_their_ending() {
    let file: PathBuf = std::env::temp_dir().join(format!("kin-plot-{}.png", std::process::id()));
    let output = kin(&format!("fourbar plot --out {}", file.display()));
    assert!(output.status.success() && output.stdout.is_empty());
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&file).expect("a picture")));
    let reader = decoder.read_info().expect("a PNG");
    assert!(reader.info().width > 1000);
    fs::remove_file(&file).expect("the file is there");
    refused("fourbar plot --out motion.pdf", &["--out", "`motion.pdf` should end in .svg or .png"]);
}

#[test]
fn options_that_make_no_sense_are_named() {
    refused("fourbar plot rocker.ph", &["no quantity named `rocker.ph`; did you mean `rocker.phi`?"]);
    refused("fourbar plot rocker.phi:speed", &["no quantity named `speed`"]);
    refused("fourbar plot --vary l9=1,2", &["--vary", "no parameter named `l9`"]);
    refused("fourbar plot --vary l1", &["--vary", "write NAME=0.08..0.12:5"]);
    refused("fourbar plot --vary l1=1..2", &["--vary", "write NAME=0.08..0.12:5"]);
    refused("fourbar plot --vary l1=1..2:1", &["--vary", "between 2 and 14 values"]);
    refused("fourbar plot --vary l1=0.1,0.11 --vary l1=0.12", &["--vary", "`l1` is varied twice"]);
    refused("fourbar plot --vary l1=0.1..0.11:4 --vary l2=0.4..0.42:4", &["--vary", "more than 14 combinations"]);
    refused("fourbar plot --vary l1=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15", &["--vary", "15 values of l1", "at most 14"]);
}
