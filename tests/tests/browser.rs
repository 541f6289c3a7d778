//! Tests of the pages in a real browser, where one is installed: headless Chromium, started as `chromium` or by the
//! name in `CHROMIUM`.
//!
//! The test appends a script to a copy of the page, which simulates a user and stores its observations in the document;
//! the browser then prints the document.

use kin_runtime::{Kinematics, cli};
use kin_tests::mechanisms::{FourbarLectureMid, loaded};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A temporary directory for one test.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("kin-browser-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The name of the browser's program; `None` if it does not run.
fn chromium() -> Option<String> {
    let name = std::env::var("CHROMIUM").unwrap_or_else(|_| "chromium".to_owned());
    let runs = Command::new(&name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let there = runs.is_ok_and(|status| status.success());
    if !there {
        eprintln!("skipped: no Chromium (`{name}` does not run); install it, or say in CHROMIUM where it is");
    }
    there.then_some(name)
}

fn browse(chromium: &str, scratch: &Scratch, page: &Path, what: &[&str]) -> Vec<u8> {
    let profile = scratch.0.join("profile");
    let output = Command::new(chromium)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars"])
        .args(["--force-prefers-reduced-motion", "--virtual-time-budget=2000"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(what)
        .arg(format!("file://{}", page.display()))
        .output()
        .expect("the browser runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Writes the page of the lecture's four-bar, with 37 instants of one turn.
fn written(scratch: &Scratch) -> PathBuf {
    written_of::<FourbarLectureMid>(scratch, &[])
}

/// The page of a mechanism, with more options.
fn written_of<M: Kinematics + Default>(scratch: &Scratch, options: &[&str]) -> PathBuf {
    let file = scratch.0.join("motion.html");
    let out = file.display().to_string();
    let args = ["four_bar", "animate", "--to", "6", "--steps", "36", "--out", &out];
    let _ = cli::run_from::<M>(args.iter().chain(options).copied());
    assert!(file.exists(), "the page is written");
    file
}

/// Runs a script at the end of the page and returns the values that it stores.
fn tried(chromium: &str, scratch: &Scratch, script: &str) -> Value {
    tried_on(chromium, scratch, "1200,800", script)
}

/// As [`tried`], for a screen of the given size.
fn tried_on(chromium: &str, scratch: &Scratch, size: &str, script: &str) -> Value {
    tried_page(chromium, scratch, &written(scratch), size, script)
}

/// As [`tried_on`], for a page that is written already.
fn tried_page(chromium: &str, scratch: &Scratch, page: &Path, size: &str, script: &str) -> Value {
    let page = fs::read_to_string(page).expect("the page");
    let listen = "<script>window.faults = []; window.onerror = (m) => { faults.push(String(m)); };</script>";
    let report = format!(
        "<script>const seen = {{}}; {script}; seen.faults = faults; seen.ready = document.documentElement.dataset.ready;\n\
         const out = document.createElement('script'); out.type = 'application/json'; out.id = 'seen';\n\
         out.textContent = JSON.stringify(seen); document.body.append(out);</script>"
    );
    let page =
        page.replacen("<head>", &format!("<head>{listen}"), 1).replacen("</body>", &format!("{report}</body>"), 1);
    let file = scratch.0.join("tried.html");
    fs::write(&file, page).expect("a copy");
    let document =
        String::from_utf8(browse(chromium, scratch, &file, &["--dump-dom", &format!("--window-size={size}")]))
            .expect("UTF-8");
    let start = document.find("id=\"seen\">").expect("the report") + "id=\"seen\">".len();
    let text = &document[start..];
    serde_json::from_str(&text[..text.find("</script>").expect("its end")]).expect("JSON")
}

#[test]
fn the_slider_moves_the_crank_to_the_computed_pose() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("slider");
    let seen = tried(
        &chromium,
        &scratch,
        "const slider = document.getElementById('slider'), crank = document.querySelector('g.run [data-body=\"0\"]');\n\
         seen.last = slider.max; seen.poses = [];\n\
         for (const k of [0, 9, 36]) { slider.value = k; slider.dispatchEvent(new Event('input'));\n\
           seen.poses.push([document.getElementById('now').textContent, crank.getAttribute('transform')]); }",
    );
    assert_eq!(seen["faults"], serde_json::json!([]));
    assert_eq!((&seen["ready"], &seen["last"]), (&"true".into(), &"36".into()));
    let mechanism = FourbarLectureMid::default();
    for (place, pose) in [0.0, 1.5, 6.0].into_iter().zip(seen["poses"].as_array().expect("three poses")) {
        let state = mechanism.state_at(&place.into()).expect("it is solved");
        let turned = state.q[2].to_degrees();
        assert!(pose[0].as_str().expect("a text").starts_with(&format!("t = {place}")), "{pose}");
        let transform = pose[1].as_str().expect("a text");
        let angle = transform.split("rotate(").nth(1).and_then(|text| text.trim_end_matches(')').parse::<f64>().ok());
        assert!((angle.expect("an angle") + turned).abs() < 0.006, "{transform}, {turned}");
    }
}

#[test]
fn keys_plots_and_modes_work() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("keys");
    let seen = tried(
        &chromium,
        &scratch,
        "const $ = (id) => document.getElementById(id), mode = $('mode');\n\
         const plots = () => document.querySelectorAll('.chart').length;\n\
         const space = () => document.body.dispatchEvent(new KeyboardEvent('keydown', { key: ' ', bubbles: true }));\n\
         seen.still = $('play').getAttribute('aria-pressed') === 'true'; space();\n\
         seen.plays = $('play').getAttribute('aria-pressed') === 'true'; space();\n\
         seen.plots = [plots()]; $('more').click(); seen.plots.push(plots());\n\
         document.querySelector('.chart button').click(); seen.plots.push(plots());\n\
         seen.modes = [...mode.options].map((o) => o.text);\n\
         const shown = () => [...document.querySelectorAll('g.run')].map((g) => g.style.display !== 'none');\n\
         seen.before = shown(); mode.value = 1; mode.dispatchEvent(new Event('change')); seen.after = shown();\n\
         $('names').click(); seen.names = getComputedStyle(document.querySelector('text.body')).display !== 'none';\n\
         seen.labelled = [...document.querySelectorAll('button, select, input')].every((e) =>\n\
           e.textContent.trim() || e.getAttribute('aria-label') || e.closest('label'));\n\
         document.body.style.width = '360px'; seen.wide = document.body.scrollWidth;",
    );
    assert_eq!(seen["faults"], serde_json::json!([]));
    assert_eq!((&seen["still"], &seen["plays"]), (&false.into(), &true.into()));
    assert_eq!(seen["plots"], serde_json::json!([2, 3, 2]));
    assert_eq!(seen["modes"].as_array().expect("a list").len(), 2);
    assert_eq!(
        (&seen["before"], &seen["after"]),
        (&serde_json::json!([true, false]), &serde_json::json!([false, true]))
    );
    assert_eq!((&seen["names"], &seen["labelled"]), (&true.into(), &true.into()));
}

/// A headless browser may be wider than a phone, so the page is shown in a frame.
#[test]
fn the_page_fits_a_phone_and_says_what_is_driven() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("phone");
    let seen = tried_on(
        &chromium,
        &scratch,
        "600,844",
        "document.body.style.width = '360px'; const $ = (id) => document.getElementById(id);\n\
         document.querySelectorAll('.chart select').forEach((list) => {\n\
           list.options[0].text = 'a_quantity_with_a_name_that_is_longer_than_a_telephone_is_wide.phi_ddot'; });\n\
         const right = (e) => Math.round(e.getBoundingClientRect().right);\n\
         seen.widest = Math.max(...[...document.querySelectorAll('main *')].map(right));\n\
         seen.mode = Math.round($('mode').getBoundingClientRect().bottom);\n\
         const slider = $('slider'); slider.value = 9; slider.dispatchEvent(new Event('input'));\n\
         seen.drivers = $('drivers').textContent; seen.scale = document.querySelector('.scale text').textContent;",
    );
    assert_eq!(seen["faults"], serde_json::json!([]));
    assert!(seen["widest"].as_i64().is_some_and(|right| right <= 360), "{seen}");
    assert!(seen["mode"].as_i64().is_some_and(|bottom| bottom < 400), "{seen}");
    assert_eq!(seen["drivers"], "crank.phi = 4.235 rad");
    assert!(seen["scale"].as_str().is_some_and(|text| text.ends_with(" m")), "{seen}");
}

#[test]
fn arrows_of_forces_follow_the_time_and_can_be_switched_off() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("forces");
    let page = written_of::<loaded::FourbarLectureMid>(&scratch, &["--forces"]);
    let script = "const $ = (id) => document.getElementById(id), slider = $('slider');\n\
         const arrow = [...document.querySelector('g.run').children].findLast((g) => g.querySelector('.force'));\n\
         seen.at = [0, 9].map((k) => { slider.value = k; slider.dispatchEvent(new Event('input'));\n\
           return arrow.getAttribute('transform'); });\n\
         const shown = () => getComputedStyle(document.querySelector('.force')).display !== 'none';\n\
         seen.shown = [shown()]; $('forces').click(); seen.shown.push(shown());\n\
         seen.offered = $('forces').getBoundingClientRect().width > 0;";
    let seen = tried_page(&chromium, &scratch, &page, "1200,800", script);
    assert_eq!(seen["faults"], serde_json::json!([]));
    assert_eq!(seen["shown"], serde_json::json!([true, false]));
    assert_eq!(seen["offered"], true);
    let at = seen["at"].as_array().expect("two instants");
    assert!(
        at[0] != at[1] && at.iter().all(|text| text.as_str().is_some_and(|text| text.contains("scale("))),
        "{seen}"
    );
}

/// The page with another number in every column of the first run at an instant.
fn with_number(page: &Path, place: usize, number: &Value) {
    let text = fs::read_to_string(page).expect("the page");
    let start = text.find("id=\"data\"").expect("the data");
    let start = start + text[start..].find('>').expect("the end of its tag") + 1;
    let end = start + text[start..].find("</script>").expect("its end");
    let mut data: Value = serde_json::from_str(&text[start..end]).expect("JSON");
    let columns = data["runs"][0]["columns"].as_array_mut().expect("columns");
    columns.iter_mut().for_each(|column| column[place] = number.clone());
    fs::write(page, format!("{}{data}{}", &text[..start], &text[end..])).expect("a file");
}

#[test]
fn what_has_no_value_is_a_gap_in_a_plot() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("gap");
    let page = written(&scratch);
    with_number(&page, 9, &Value::Null);
    let script = "const slider = document.getElementById('slider'), chart = document.querySelector('.chart');\n\
         seen.parts = chart.querySelector('path.way').getAttribute('d').split('M').length - 1;\n\
         seen.at = [9, 10].map((k) => { slider.value = k; slider.dispatchEvent(new Event('input'));\n\
           return [chart.querySelector('.value').textContent.split(': ')[1] === 'no value',\n\
             document.getElementById('drivers').textContent.endsWith('= no value'),\n\
             chart.querySelector('circle.now').getAttribute('visibility')]; });";
    let seen = tried_page(&chromium, &scratch, &page, "1200,800", script);
    assert_eq!(seen["faults"], serde_json::json!([]));
    assert_eq!(seen["parts"], 2);
    assert_eq!(seen["at"], serde_json::json!([[true, true, "hidden"], [false, false, "visible"]]));
}

#[test]
fn a_screenshot_shows_the_mechanism_on_a_desk_and_on_a_phone() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("screenshot");
    let page = written(&scratch);
    for size in ["1200,800", "390,844"] {
        let picture = scratch.0.join("page.png");
        let what = [format!("--screenshot={}", picture.display()), format!("--window-size={size}")];
        browse(&chromium, &scratch, &page, &what.each_ref().map(String::as_str));
        let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&picture).expect("a picture")));
        let mut reader = decoder.read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("its size")];
        let info = reader.next_frame(&mut pixels).expect("its pixels");
        let step = info.color_type.samples();
        // A few pixels must have the colours of crank, coupler and rocker.
        for (name, of) in
            [("crank", [0x33, 0x8e, 0xc1]), ("coupler", [0xdd, 0x7e, 0x33]), ("rocker", [0x33, 0xb2, 0x8f])]
        {
            let near = |pixel: &&[u8]| pixel.iter().zip(of).all(|(a, b): (&u8, u8)| a.abs_diff(b) < 12);
            let count = pixels.chunks(step).map(|pixel| &pixel[..3]).filter(near).count();
            assert!(count > 200, "{name} covers {count} pixels of {size}");
        }
    }
}

/// Numbers of any size are shown; only those that are rounding errors beside the others are 0.
#[test]
fn plots_show_small_numbers() {
    let Some(chromium) = chromium() else { return };
    let scratch = Scratch::new("small");
    let page = written_of::<Minute>(&scratch, &[]);
    let seen = tried_page(
        &chromium,
        &scratch,
        &page,
        "1200,800",
        "const chart = document.querySelector('.chart'), pick = chart.querySelector('select');\n\
         const shown = (name) => { pick.value = [...pick.options].findIndex((o) => o.text === name); pick.onchange();\n\
           return [...chart.querySelectorAll('text[x=\"51\"]')].map((label) => label.textContent); };\n\
         seen.small = shown('tip.y_ddot'); seen.constant = shown('axle.y');\n\
         const heights = chart.querySelector('.way').getAttribute('d').match(/,[-0-9.]+/g).map((y) => Number(y.slice(1)));\n\
         seen.bent = Math.max(...heights) - Math.min(...heights);",
    );
    assert_eq!(seen["faults"], serde_json::json!([]));
    let labels = seen["small"].as_array().expect("labels");
    assert!(labels.len() > 2 && labels.iter().filter(|label| *label == "0").count() < 2, "{seen}");
    // The place of the axle varies by rounding alone.
    assert!(seen["bent"].as_f64().is_some_and(|bent| bent < 1.0), "{seen}");
}

/// A lever as long as a virus, turning once in an hour and a half; its axle is where its end seems to be from its middle.
#[kin_runtime::mechanism]
#[body(arm, x = 1e-7 * cos(0.001 * t), y = 1e-7 * sin(0.001 * t))]
#[driver(drive: arm.phi = 0.001 * t)]
#[point(tip = arm @ (l, 0))]
#[point(axle = arm @ (-1e-7, 0))]
struct Minute {
    #[param(1e-7, unit = "m")]
    l: f64,
}
