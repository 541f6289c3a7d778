//! A motion as one self-contained page: the drawing, plots beside it, and the controls.
//!
//! The parts of the [drawing](super::drawing) are written as groups of an SVG; the script of the page moves and turns
//! them by the poses that the page holds as numbers.

use super::drawing::{Carrier, Scene, View, still};
use super::drawing::{animated, escaped, force_scale, round_below};
use crate::model::Model;
use crate::present::number::rounded;
use serde::Serialize;

/// A motion with the columns that can be plotted beside it.
pub(crate) struct AnimatedMotion {
    /// Its name, which distinguishes it from the others, an assembly mode for example.
    pub(crate) name: String,
    /// A sentence about it, if it ended early.
    pub(crate) note: Option<String>,
    /// The drawing.
    pub(crate) scene: Scene,
    /// A list of numbers for every column.
    pub(crate) columns: Vec<Vec<f64>>,
}

/// The name and the unit of a column.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ColumnInfo {
    /// `crank.phi_dot`.
    pub(crate) name: String,
    /// Its unit, where one is known.
    pub(crate) unit: Option<String>,
}

/// Everything that a page shows.
pub(crate) struct Animation {
    /// The mechanism.
    pub(crate) model: &'static Model,
    /// At least one motion.
    pub(crate) runs: Vec<AnimatedMotion>,
    /// The columns, which are the same for all motions.
    pub(crate) columns: Vec<ColumnInfo>,
    /// The columns plotted at first.
    pub(crate) shown: Vec<usize>,
    /// The columns of the driven quantities, whose values are shown beside the time.
    pub(crate) drivers: Vec<usize>,
    /// The unit of length.
    pub(crate) length: Option<String>,
    /// What the instants are numbered by: `t`, or `step` along an arc, on which t goes up and down.
    pub(crate) along: &'static str,
    /// The unit of time.
    pub(crate) time: Option<String>,
    /// The unit of force, if forces are shown.
    pub(crate) force: Option<&'static str>,
}

#[derive(Serialize)]
struct Data<'a> {
    runs: Vec<RunData<'a>>,
    columns: &'a [ColumnInfo],
    shown: &'a [usize],
    drivers: &'a [usize],
    along: &'a str,
    time: Option<&'a str>,
    /// How long the page takes to play the motion.
    seconds: f64,
}

#[derive(Serialize)]
struct RunData<'a> {
    name: &'a str,
    note: Option<&'a str>,
    t: &'a [f64],
    /// Width and height in pixels.
    size: [f64; 2],
    /// For every carrier, x and y in pixels, the angle in degrees, clockwise, and for arrows their size.
    tracks: Vec<Vec<Vec<f64>>>,
    columns: Vec<Vec<f32>>,
}

impl Animation {
    /// The page.
    ///
    /// # Errors
    /// If the numbers cannot be serialised.
    pub(crate) fn page(&self) -> Result<String, String> {
        // Every motion has its own view: one mode may need much more room than another.
        let views: Vec<View> = self.runs.iter().map(|run| View::of([&run.scene])).collect();
        let tracks = |scene: &Scene, view: &View| -> Vec<Vec<Vec<f64>>> {
            let digits = |x: f64, scale: f64| (x * scale).round() / scale;
            let track = |carrier: &Carrier| {
                let mut out = vec![Vec::new(), Vec::new(), Vec::new()];
                for pose in carrier.poses.iter().map(|&pose| view.pose(pose)) {
                    for (list, number) in out.iter_mut().zip(pose) {
                        list.push(digits(number, 100.0));
                    }
                }
                if !carrier.sizes.is_empty() {
                    out.push(carrier.sizes.iter().map(|size| digits(*size, 1e4)).collect());
                }
                // A track that never changes has a single entry.
                out.iter_mut().for_each(|list| {
                    if list.iter().all(|x| *x == list[0]) {
                        list.truncate(1);
                    }
                });
                out
            };
            scene.carriers.iter().map(track).collect()
        };
        let runs = self.runs.iter().zip(&views).map(|(run, view)| RunData {
            name: &run.name,
            note: run.note.as_deref(),
            t: &run.scene.times,
            size: view.size.map(f64::round),
            tracks: tracks(&run.scene, view),
            // `f32` has more digits than a plot shows, and halves the size of the page.
            columns: run.columns.iter().map(|list| list.iter().map(|x| *x as f32).collect()).collect(),
        });
        let (columns, time) = (&self.columns, self.time.as_deref());
        let (shown, drivers, seconds) = (&self.shown[..], &self.drivers[..], self.seconds());
        let data = Data { runs: runs.collect(), columns, shown, drivers, along: self.along, time, seconds };
        let data = serde_json::to_string(&data).map_err(|error| format!("cannot write the page: {error}"))?;
        // Escaped so that the data cannot end the script element that holds it.
        let data = data.replace('<', "\\u003c");
        let unit = self.length.as_deref();
        let drawings: String = self.runs.iter().zip(&views).map(|(run, view)| drawing(&run.scene, view)).collect();
        let bars = self.runs.iter().zip(&views).map(|(run, view)| {
            let forces =
                run.scene.forces.as_ref().map_or_else(String::new, |scale| force_scale(view, scale, self.force));
            format!("<g class=\"scale\">{}{forces}</g>", scale_bar(view, unit))
        });
        let bars: String = bars.collect();
        let [width, height] = views[0].size.map(f64::round);
        let (name, doc) = (escaped(self.model.name), escaped(self.model.doc));
        let picture = format!(
            "<svg id=\"drawing\" class=\"without-names\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-label=\"{name} in motion\">{drawings}{bars}</svg>"
        );
        Ok(include_str!("page.html")
            .replace("{{name}}", &name)
            .replace("{{doc}}", &doc)
            .replace("{{style}}", include_str!("page.css"))
            .replace("{{script}}", include_str!("page.js"))
            .replace("{{forces}}", if self.runs[0].scene.forces.is_some() { "" } else { " hidden" })
            .replace("{{drawing}}", &picture)
            .replace("{{data}}", &data))
    }

    /// The first motion as an animated picture, with or without names, which may cover a large mechanism.
    pub(crate) fn picture(&self, names: bool) -> String {
        let scene = &self.runs[0].scene;
        let title = format!("{}: {}", self.model.name, self.model.doc);
        animated(scene, &View::of([scene]), &title, self.seconds(), names, self.force)
    }

    /// The time for which the motion is played: its own duration if that is easy to watch, otherwise five seconds.
    fn seconds(&self) -> f64 {
        let times = &self.runs[0].scene.times;
        let span = (times.last().copied().unwrap_or(0.0) - times.first().copied().unwrap_or(0.0)).abs();
        if (1.5..=12.0).contains(&span) { span } else { 5.0 }
    }
}

fn drawing(scene: &Scene, view: &View) -> String {
    let groups = still(scene, view).groups;
    let groups = groups.into_iter().zip(&scene.carriers).map(|(group, carrier)| match carrier.body {
        Some(body) => format!("<g data-body=\"{body}\">{group}</g>"),
        None => format!("<g>{group}</g>"),
    });
    format!("<g class=\"run\">{}</g>", groups.collect::<String>())
}

/// Largest width of the scale bar, relative to the picture.
const BAR: f64 = 0.25;

/// A scale bar in the lower left corner of a drawing; its length is 1, 2 or 5 times a power of ten.
fn scale_bar(view: &View, unit: Option<&str>) -> String {
    let length = round_below(BAR * view.size[0] / view.scale);
    let right = 10.0 + (length * view.scale).round();
    let middle = 0.5 * (10.0 + right);
    let label = match unit {
        Some(unit) => format!("{} {}", rounded(length), escaped(unit)),
        None => rounded(length),
    };
    let [above, base, text] = [12.0, 8.0, 14.0].map(|up| view.size[1].round() - up);
    format!(
        "<path class=\"bar\" d=\"M10,{above}V{base}H{right}V{above}\"/><text class=\"bar\" x=\"{middle}\" y=\"{text}\">{label}</text>"
    )
}
