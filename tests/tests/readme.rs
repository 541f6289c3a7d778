//! What stands in the README and in the guide is what the program prints, what compiles, and what the compiler says.

use std::process::ExitCode;

const README: &str = include_str!("../../README.md");
const START: &str = include_str!("../../kin-runtime/src/guide/start.md");

#[allow(dead_code, unreachable_pub, reason = "a program of its own, read as a module")]
#[path = "../../examples/four_bar.rs"]
mod four_bar;

/// The pieces of the output that the README shows after its first command; `…` stands for what it leaves out.
fn shown_output() -> Vec<Vec<String>> {
    let block = blocks(README, "console")[0];
    let (command, output) = block.split_once('\n').unwrap();
    assert_eq!(command, "$ cargo run --release --example four_bar");
    let pieces = output.trim_end().split("\n…\n").map(comparable);
    pieces.collect()
}

/// Lines without those whose last digits are rounding errors, which differ from machine to machine.
fn comparable(text: &str) -> Vec<String> {
    text.lines().filter(|line| !line.contains("e-1")).map(|line| line.trim_end().to_owned()).collect()
}

#[test]
fn the_readme_fits_on_a_few_screens_and_its_report_on_one() {
    assert!(README.lines().count() <= 150, "{} lines", README.lines().count());
    let report = blocks(README, "console")[0].lines().count();
    assert!((15..=40).contains(&report), "{report} lines");
    let listing = blocks(README, "rust,no_run")[0];
    assert!(listing.lines().count() <= 20, "{} lines", listing.lines().count());
    // The first picture comes before the first listing, and it moves.
    let before = README.split("```").next().unwrap();
    let picture = before.split("src=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a picture");
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(picture);
    let drawing = std::fs::read_to_string(path).unwrap();
    assert!(drawing.contains("<animateTransform") && drawing.len() < 60_000, "{} bytes", drawing.len());
}

/// The drawing of the lecture's four-bar in the guide is one that kin makes, as a file and as an address for rustdoc.
#[test]
fn the_lectures_four_bar_is_drawn_by_kin() {
    let path = std::env::temp_dir().join(format!("kin-guide-{}.svg", std::process::id()));
    let out = path.display().to_string();
    let code = kin_runtime::cli::run_from::<four_bar::FourBar>([
        "four_bar", "animate", "--times", "0", "--names", "--out", &out,
    ]);
    assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS));
    let drawn = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(drawn, include_str!("../../kin-runtime/src/guide/four_bar.svg"), "`examples/gallery.sh` draws it anew");
    let mut address = drawn.replace('\n', "").replace('%', "%25");
    for letter in ['#', '<', '>', '"', ' ', '(', ')'] {
        address = address.replace(letter, &format!("%{:02X}", u32::from(letter)));
    }
    let definition = include_str!("../../kin-runtime/src/guide/four_bar.md");
    assert_eq!(definition, format!("[four-bar]: data:image/svg+xml,{address}\n"));
    let page = include_str!("../../kin-runtime/src/guide/lecture.md");
    assert!(page.contains("][four-bar]") && page.ends_with("\n[four-bar]: four_bar.svg\n"));
}

/// rustdoc sorts modules by name, so the chapters are in order where their names are.
#[test]
fn the_chapters_of_the_guide_are_in_order() {
    let source = include_str!("../../kin-runtime/src/guide/mod.rs");
    let modules: Vec<&str> =
        source.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(" {}")).collect();
    assert!(modules.is_sorted() && modules.len() >= 14, "{modules:?}");
    let contents = source.lines().filter_map(|line| line.strip_prefix("//! ")?.split("](").nth(1)?.split(')').next());
    let contents: Vec<&str> = contents.filter(|link| link.starts_with("chapter_")).collect();
    assert_eq!(contents, modules);
    // What people look for leads to a chapter.
    for word in ["force", "limit", "parameter study"] {
        assert!(source.contains(&format!("\"{word}\"")), "nothing is found for `{word}`");
    }
}

/// Every file that the README links to is there.
#[test]
fn the_links_of_the_readme_lead_somewhere() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let of =
        |opening: &'static str, end: char| README.split(opening).skip(1).filter_map(move |rest| rest.split(end).next());
    let mut seen = 0;
    for link in
        of("](", ')').chain(of("src=\"", '"')).chain(of("href=\"", '"')).filter(|link| !link.starts_with("http"))
    {
        assert!(root.join(link).is_file(), "no file {link}");
        seen += 1;
    }
    assert!(seen >= 20, "{seen}");
}

#[test]
fn the_first_command_prints_what_the_readme_shows() {
    let path = std::env::temp_dir().join(format!("kin-readme-{}.txt", std::process::id()));
    let arguments = ["four_bar".into(), "--out".into(), path.clone().into_os_string()];
    let code = kin_runtime::cli::run_from::<four_bar::FourBar>(arguments);
    assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS));
    let printed = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let printed = comparable(&printed);
    for piece in shown_output() {
        assert!(printed.windows(piece.len()).any(|lines| lines == piece), "not printed:\n{}", piece.join("\n"));
    }
}

/// The blocks of a page whose fence begins with `fence`, in order.
fn blocks<'a>(page: &'a str, fence: &str) -> Vec<&'a str> {
    let opening = format!("```{fence}\n");
    page.split(&*opening).skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

/// Without the comment at the head of a file.
fn without_head(source: &str) -> &str {
    let head: usize = source.split_inclusive('\n').take_while(|line| line.starts_with("//!")).map(str::len).sum();
    source[head..].trim_start()
}

/// Without the lines that rustdoc hides.
fn without_hidden(listing: &str) -> String {
    listing.split_inclusive('\n').filter(|line| !line.starts_with("# ")).collect()
}

/// Fails unless the error that a page shows is what the compiler says of its listing with `crnk` instead of `crank`.
#[track_caller]
fn shows_the_mistake(page: &str, listing: &str) {
    let mistake = blocks(page, "text").into_iter().find(|block| block.starts_with("error: no body")).unwrap();
    let place = listing.lines().position(|line| line.starts_with("#[revolute(A:")).unwrap();
    let [first, at, _, line, marks] = mistake.lines().collect::<Vec<_>>()[..] else { panic!("{mistake}") };
    assert_eq!(first, "error: no body named `crnk`; did you mean `crank`?");
    assert_eq!(at.trim_start(), format!("--> src/main.rs:{}:15", place + 1));
    let wrong = listing.lines().nth(place).unwrap().replace("A: crank", "A: crnk");
    assert_eq!(line, format!("{} | {wrong}", place + 1));
    assert_eq!(marks.trim_start(), format!("| {:>18}", "^^^^"));
}

#[test]
fn the_starting_point_is_the_template() {
    let template = without_head(include_str!("../../examples/template.rs"));
    assert_eq!(without_hidden(blocks(START, "rust,no_run")[0]), template);

    // The examples are built with what the manifest asks for, diagrams and equations where they are wanted.
    let [manifest] = blocks(START, "toml")[..] else { panic!("a manifest") };
    let examples = include_str!("../../examples/Cargo.toml");
    assert!(examples.contains("kin-runtime = { workspace = true, features = [\"std\", \"cli\"] }"));
    assert!(manifest.contains("features = [\"cli\", \"plot\", \"equations\"]"));
    for feature in ["plot", "equations"] {
        assert!(examples.contains(&format!("{feature} = [\"kin-runtime/{feature}\"]")));
    }
    assert!(manifest.contains("path = \"../kin/kin-runtime\""));

    // The mistakes that are shown are made in the listings above them.
    shows_the_mistake(START, template);
    shows_the_mistake(README, blocks(README, "rust,no_run")[0]);
}

/// A message as it is compared: without the number of a line and without the file.
fn message(text: &str) -> Vec<&str> {
    text.lines()
        .filter(|line| !line.contains("--> "))
        .map(|line| line.trim_end().trim_start_matches(|c: char| c.is_ascii_digit() || c == ' '))
        .collect()
}

#[test]
fn the_errors_of_the_guide_are_those_of_the_compiler() {
    let page = include_str!("../../kin-runtime/src/guide/errors.md");
    let source = include_str!("../compile_fail/guide.rs");
    let said = message(include_str!("../compile_fail/guide.stderr")).join("\n");
    let listings = blocks(page, "compile_fail");
    let messages: Vec<&str> = blocks(page, "text").into_iter().filter(|block| block.starts_with("error: ")).collect();
    assert_eq!((listings.len(), messages.len()), (6, 6));
    for (listing, shown) in listings.into_iter().zip(messages) {
        let listing: String = listing.split_inclusive('\n').filter(|line| !line.starts_with("# ")).collect();
        assert!(source.contains(&listing), "not among the compile-fail cases:\n{listing}");
        let shown = message(shown).join("\n");
        assert!(said.contains(&shown), "the compiler does not say:\n{shown}");
    }
    // And nothing that the compiler says is left out.
    let errors = |text: &str| text.lines().filter(|line| line.starts_with("error")).count();
    assert_eq!(errors(&said), blocks(page, "text").into_iter().map(errors).sum::<usize>());
}

/// A crank whose pin runs in the slot of an arm, as in the guide's chapter on the derivation.
#[kin_runtime::mechanism]
#[body(crank, x = 0, y = h)]
#[body(arm, x = 0, y = 0)]
#[point_on_line(slot: arm @ (0, 0), crank @ (r, 0), axis = (1, 0))]
#[driver(drive: crank.phi = omega * t)]
#[guess(arm.phi = 1)]
struct Slot {
    #[param(0.1)]
    r: f64,
    #[param(0.3)]
    h: f64,
    #[param(2.0)]
    omega: f64,
}

#[test]
fn the_plan_in_the_guide_is_what_the_tool_prints() {
    let page = include_str!("../../kin-runtime/src/guide/derivation.md");
    for (command, begins) in [("info", "Solution plan"), ("equations", "    a₂ ")] {
        let shown = blocks(page, "text").into_iter().find(|block| block.starts_with(begins)).unwrap();
        let path = std::env::temp_dir().join(format!("kin-guide-{command}-{}.txt", std::process::id()));
        let arguments = ["slot".into(), command.into(), "--out".into(), path.clone().into_os_string()];
        let code = kin_runtime::cli::run_from::<Slot>(arguments);
        assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS));
        let printed = std::fs::read_to_string(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert!(printed.contains(shown), "{printed}");
    }
}

/// The steps on the way to the press are lines of the whole, which is compiled and run.
#[test]
fn the_pieces_of_the_guides_press_are_in_its_listing() {
    let page = include_str!("../../kin-runtime/src/guide/writing.md");
    let whole = page.split("# All of it").nth(1).unwrap();
    let pieces = blocks(page, "text").into_iter().flat_map(str::lines).filter(|line| line.starts_with("#["));
    let mut seen = 0;
    for piece in pieces {
        assert!(whole.lines().any(|line| line == piece), "not a line of the listing: {piece}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn the_row_of_the_guides_constraint_is_one_that_compiles() {
    let page = include_str!("../../kin-runtime/src/guide/constraint.md");
    // It borrows a word of the vocabulary.
    let source =
        include_str!("../../kin-core/src/joints/equidistant.rs").replace("Equidistant as Constraint", "Equidistant");
    let listing = blocks(page, "text").into_iter().find(|block| block.contains("fn rows")).unwrap();
    assert!(source.contains(listing), "{listing}");
}

/// What each `cargo test` of the guide asks for is there: package, and test or filter.
#[test]
fn the_tests_that_the_guide_names_are_there() {
    let page = include_str!("../../kin-runtime/src/guide/constraint.md");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let [commands] = blocks(page, "console")[..] else { panic!("one block of commands") };
    for command in commands.lines() {
        let words: Vec<&str> = command.split(" #").next().unwrap().split_whitespace().collect();
        let ["$", "cargo", "test", "-p", package, what @ ..] = &words[..] else { panic!("{command}") };
        let folder = root.join(if *package == "kin-tests" { "tests" } else { package });
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        assert!(manifest.contains(&format!("name = \"{package}\"")), "{command}");
        let found = match what {
            [] | ["--lib"] => true,
            ["--doc", module] => folder.join("src").join(module).is_dir(),
            ["--test", test] => {
                folder.join(format!("tests/{test}.rs")).is_file() || folder.join("tests").join(test).is_dir()
            }
            _ => false,
        };
        assert!(found, "{command}");
    }
}

/// The dependency of a controller is of this version, and as the build without std has it.
#[test]
fn the_dependency_without_std_is_the_one_that_is_built() {
    let page = include_str!("../../kin-runtime/src/guide/controller.md");
    let [shown] = blocks(page, "toml")[..] else { panic!("one manifest") };
    let built = include_str!("../no_std/Cargo.toml");
    let switched_off = "kin-runtime = { path = \"../../kin-runtime\", default-features = false }";
    assert!(built.lines().any(|line| line == switched_off));
    let (major, minor) = (env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR"));
    let version = format!("version = \"{major}.{minor}\"");
    assert_eq!(
        shown.trim_end().replace(&version, "path = \"../../kin-runtime\""),
        format!("[dependencies]\n{switched_off}")
    );
}

#[test]
fn the_files_that_the_guide_names_are_there() {
    let page = include_str!("../../kin-runtime/src/guide/constraint.md");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let rooms = ["", "kin-core", "kin-core/src", "kin-derive/src", "kin-runtime/src"];
    let named = page.split('`').skip(1).step_by(2).filter(|name| name.ends_with(".rs"));
    let mut seen = 0;
    for name in named.filter(|name| *name != "joints/equidistant.rs") {
        assert!(rooms.iter().any(|room| root.join(room).join(name).is_file()), "no file {name}");
        seen += 1;
    }
    assert!(seen >= 10, "{seen}");
}
