//! A motion as one page that needs nothing else: the drawing, plots that go with it, and the controls.
//!
//! The page holds numbers only; what moves is [drawn](super::drawing) here, and the script in it moves and turns groups
//! of a picture.

use super::drawing::{Carrier, Scene, View, still};
use super::drawing::{animated, escaped, force_scale, round_below};
use crate::model::Model;
use crate::present::number::rounded;
use serde::Serialize;

/// A motion with what is plotted beside it.
pub(crate) struct Run {
    /// What distinguishes it from the others, an assembly mode for example.
    pub(crate) name: String,
    /// What there is to say of it.
    pub(crate) note: Option<String>,
    /// The drawing.
    pub(crate) scene: Scene,
    /// A list of numbers for every column.
    pub(crate) columns: Vec<Vec<f64>>,
}

/// What a column is.
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
    pub(crate) runs: Vec<Run>,
    /// What the columns of all of them are.
    pub(crate) columns: Vec<ColumnInfo>,
    /// The columns plotted at first.
    pub(crate) shown: Vec<usize>,
    /// The columns of what is driven, whose values stand beside the time.
    pub(crate) drivers: Vec<usize>,
    /// The unit of length.
    pub(crate) length: Option<String>,
    /// The unit of time.
    pub(crate) time: Option<String>,
    /// That of forces, where they are shown.
    pub(crate) force: Option<&'static str>,
}

#[derive(Serialize)]
struct Data<'a> {
    runs: Vec<RunData<'a>>,
    columns: &'a [ColumnInfo],
    shown: &'a [usize],
    drivers: &'a [usize],
    time: Option<&'a str>,
    /// How long the whole motion takes to watch.
    seconds: f64,
}

#[derive(Serialize)]
struct RunData<'a> {
    name: &'a str,
    note: Option<&'a str>,
    t: &'a [f64],
    /// Width and height in pixels.
    size: [f64; 2],
    /// For every carrier, x, y in pixels and the angle in degrees, clockwise; of arrows their size, too.
    tracks: Vec<Vec<Vec<f64>>>,
    columns: Vec<Vec<f32>>,
}

impl Animation {
    /// The page.
    ///
    /// # Errors
    /// When the numbers cannot be written, which they can.
    pub(crate) fn page(&self) -> Result<String, String> {
        // Every motion has a view of its own: one mode may need much more room than another.
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
                // What stands still is said once.
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
            // Half the digits are more than a plot shows.
            columns: run.columns.iter().map(|list| list.iter().map(|x| *x as f32).collect()).collect(),
        });
        let (columns, time) = (&self.columns, self.time.as_deref());
        let (shown, drivers, seconds) = (&self.shown[..], &self.drivers[..], self.seconds());
        let data = Data { runs: runs.collect(), columns, shown, drivers, time, seconds };
        let data = serde_json::to_string(&data).map_err(|error| format!("cannot write the page: {error}"))?;
        // Nothing in the data can end the element that holds it.
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

    /// The first motion as a picture that moves; names show what is what in a small mechanism and hide a large one.
    pub(crate) fn picture(&self, names: bool) -> String {
        let scene = &self.runs[0].scene;
        let title = format!("{}: {}", self.model.name, self.model.doc);
        animated(scene, &View::of([scene]), &title, self.seconds(), names, self.force)
    }

    /// As long as the motion takes, where that can be watched.
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

/// Parts of the picture's width that the bar for a length takes at most.
const BAR: f64 = 0.25;

/// A bar that is as long as it says, 1, 2 or 5 times a power of ten, in the lower left corner of a drawing.
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
