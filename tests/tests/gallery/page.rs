//! The gallery page: it has a picture of every example, and every number on it is measured here.

use kin_runtime::{Kinematics, cli};
use kin_tests::examples::hart::Hart;
use kin_tests::examples::jansen::Jansen;
use kin_tests::examples::robot_3rrr::Robot3rrr;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The largest size of a picture in bytes.
const LARGEST: u64 = 150_000;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

fn text() -> String {
    fs::read_to_string(examples().join("README.md")).expect("the page").replace('\n', " ")
}

/// Fails unless the section with the picture of the example contains the text.
#[track_caller]
pub(crate) fn says(example: &str, figure: &str) {
    let page = text();
    let picture = format!("(pictures/{example}.svg)");
    let section = page.split(" ## ").find(|section| section.contains(&picture));
    let section = section.unwrap_or_else(|| panic!("{picture} is in no section of the page"));
    assert!(section.contains(figure), "the section of `{example}` should say: {figure}");
}

fn names(directory: &Path, ending: &str) -> BTreeSet<String> {
    let files = fs::read_dir(directory).expect("a directory").map(|entry| entry.expect("an entry").file_name());
    files.filter_map(|name| name.to_str()?.strip_suffix(ending).map(str::to_owned)).collect()
}

#[test]
fn every_example_has_a_section_with_a_picture() {
    let page = text();
    let sections: Vec<&str> = page.split(" ## ").filter(|section| section.contains("(pictures/")).collect();
    // `lib` is empty, and `template` is not an example of a particular mechanism.
    let shown = |name: &String| !["lib", "template"].contains(&name.as_str());
    for name in names(&examples(), ".rs").into_iter().filter(shown) {
        let named =
            |section: &&str| section.contains(&format!("`{name}`")) || section.contains(&format!("example {name} "));
        assert!(sections.iter().any(named), "`{name}` is on the page with no picture");
    }
}

#[test]
fn every_picture_is_there_and_small_and_shown() {
    let (page, directory) = (text(), examples().join("pictures"));
    let there = names(&directory, ".svg");
    let shown: BTreeSet<String> = page
        .split("(pictures/")
        .skip(1)
        .map(|rest| rest.split_once(".svg)").map_or(rest, |(name, _)| name).to_owned())
        .collect();
    assert_eq!(shown, there, "pictures on the page, and files; `examples/gallery.sh` draws them");
    for name in there {
        let path = directory.join(format!("{name}.svg"));
        let (picture, size) = (fs::read_to_string(&path).expect("a text"), fs::metadata(&path).expect("a size").len());
        assert!(picture.starts_with("<svg") || picture.starts_with("<?xml"), "{name}");
        assert!(size <= LARGEST, "{name} has {size} bytes");
    }
}

/// The picture that `animate` draws with the given options.
fn drawn(name: &str, options: &[&str]) -> String {
    let file = std::env::temp_dir().join(format!("kin-gallery-{}-{name}.svg", std::process::id()));
    let path = file.display().to_string();
    let line = ["hart", "animate", "--out", path.as_str()].into_iter().chain(options.iter().copied());
    let _ = cli::run_from::<Hart>(line);
    let text = fs::read_to_string(&file).expect("a picture");
    fs::remove_file(&file).expect("it is there");
    text
}

#[test]
fn a_picture_says_only_what_it_needs() {
    let plain = drawn("plain", &["--to", "6", "--steps", "6"]);
    let named = drawn("named", &["--to", "6", "--steps", "6", "--names"]);
    let uneven = drawn("uneven", &["--times", "0,1,3"]);
    assert_eq!([&plain, &named, &uneven].map(|text| text.contains("<text")), [false, true, false]);
    assert_eq!([&plain, &named, &uneven].map(|text| text.contains("keyTimes")), [false, false, true]);
    assert!(named.contains(">coupler</text>") && named.contains(">q</text>"));
}

/// The colours of the bodies on the page of a mechanism, with their names.
fn colours<M: Kinematics + Default>(name: &str) -> Vec<(&'static str, String)> {
    let file = std::env::temp_dir().join(format!("kin-gallery-{}-{name}.html", std::process::id()));
    let path = file.display().to_string();
    let _ = cli::run_from::<M>([name, "animate", "--to", "0.1", "--steps", "2", "--out", path.as_str()]);
    let page = fs::read_to_string(&file).expect("a page");
    fs::remove_file(&file).expect("it is there");
    let bodies = M::model().bodies.iter().enumerate();
    let of = |(place, body): (usize, &kin_runtime::model::BodyInfo)| {
        let group = page.split(&format!("<g data-body=\"{place}\">")).nth(1).expect("its group");
        let colour = group.split("stroke=\"#").nth(1).expect("its colour")[..6].to_owned();
        (body.name, colour)
    };
    bodies.map(of).collect()
}

#[test]
fn neighbours_have_different_colours() {
    let robot = colours::<Robot3rrr>("robot_3rrr");
    let distinct: BTreeSet<&String> = robot.iter().map(|(_, colour)| colour).collect();
    assert_eq!(distinct.len(), robot.len(), "{robot:?}");

    // There are eleven colours for thirteen bodies; within a leg all colours are different.
    let jansen = colours::<Jansen>("jansen");
    for side in ["[0]", "[1]"] {
        let leg: Vec<&String> = jansen
            .iter()
            .filter(|(name, _)| name.ends_with(side) || *name == "crank")
            .map(|(_, colour)| colour)
            .collect();
        let distinct: BTreeSet<&&String> = leg.iter().collect();
        assert_eq!((leg.len(), distinct.len()), (7, 7), "{jansen:?}");
    }
}

/// Paths are drawn as smooth curves through few points.
#[test]
fn paths_are_curves() {
    let picture = fs::read_to_string(examples().join("pictures/jansen.svg")).expect("a picture");
    let paths: Vec<&str> = picture.split("<path ").filter(|path| path.contains("class=\"path\"")).collect();
    assert_eq!(paths.len(), 2);
    for path in paths {
        let way = path.split("d=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("its way");
        assert!(way.matches('C').count() >= 48 && !way.contains('L'), "{way}");
    }
}
