//! Diagrams of a motion as files: panels of curves with names, units and a legend.

mod panel;

pub(crate) use panel::{Curve, Mark, Panel};

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{ColorMap, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::Scene;
use std::sync::Arc;

use crate::present::number::{exponent, without_zeros};

/// Width of a panel in pixels, its axes and legend included.
const WIDTH: f64 = 860.0;
/// Width of each of two panels that stand beside one another.
const HALF: f64 = 560.0;
/// Height of a panel over time, and of one whose axes are equal.
const HEIGHTS: [f64; 2] = [400.0, 620.0];
/// Height of an entry of the legend, and of the space above and below all entries.
const LEGEND: [f64; 2] = [18.0, 90.0];
/// Room to the left of panels that share an axis, in pixels.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
/// Widths for an entry of the legend: of its line and frame, and of one letter.
const ENTRY: [f64; 2] = [45.0, 7.4];
/// Free room above and below the curves, as a part of their height.
const MARGIN: f64 = 0.05;
/// Pixels of a PNG per pixel of the drawing.
const DENSITY: f32 = 2.0;

/// Colour and shapes of the ends of curves.
const MARK: &str = "#000000";
const SHAPES: [MarkerShape; 4] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond];

/// Colours that people with any kind of colour vision tell apart (Okabe and Ito, 2008), without yellow.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];
/// The part of the colour map that is used for more curves: its end is a yellow that is invisible on white.
const MAP_END: f64 = 0.92;

/// Panels below one another, or two of them side by side.
pub(crate) struct Diagram {
    /// The title above the panels.
    pub(crate) title: String,
    /// At least one.
    pub(crate) panels: Vec<Panel>,
    /// Whether two panels are side by side.
    pub(crate) beside: bool,
}

impl Diagram {
    /// The diagram as SVG.
    pub(crate) fn svg(&self) -> String {
        SvgBackend.render_scene(&self.scene())
    }

    /// As PNG.
    ///
    /// # Errors
    /// When the picture cannot be encoded.
    pub(crate) fn png(&self) -> Result<Vec<u8>, String> {
        PngBackend::new().with_scale(DENSITY).render_scene(&self.scene())
    }

    fn scene(&self) -> Scene {
        let plots: Vec<Vec<Plot>> = self.panels.iter().map(plots).collect();
        let over_time = self.shares_axis();
        let margins = over_time.then(|| [LEFT, self.right()]);
        let layouts = self.panels.iter().zip(&plots).map(|(panel, plots)| layout(panel, plots, margins)).collect();
        let beside = self.beside && self.panels.len() == 2;
        let (rows, columns, width) = if beside { (1, 2, HALF) } else { (self.panels.len(), 1, WIDTH) };
        let mut figure = Figure::new(rows, columns)
            .with_title(self.title.clone())
            .with_cell_size(width, HEIGHTS[0])
            .with_plots(plots)
            .with_layouts(layouts);
        for (index, panel) in self.panels.iter().enumerate() {
            figure = figure.with_row_height(index % rows, height(panel));
        }
        if over_time { figure.with_shared_x_all().render() } else { figure.render() }
    }

    /// Whether several panels below one another have the same horizontal quantity, so that they share one axis.
    fn shares_axis(&self) -> bool {
        let first = &self.panels[0];
        let same =
            |panel: &Panel| panel.labels[0] == first.labels[0] && !panel.equal && panel.range(0) == first.range(0);
        !self.beside && self.panels.len() > 1 && self.panels.iter().all(same)
    }

    /// Room on the right of all panels for the widest of their legends.
    fn right(&self) -> f64 {
        let curves = self.panels.iter().filter(|panel| panel.curves.len() > 1).flat_map(|panel| &panel.curves);
        let marks = self.panels.iter().flat_map(|panel| &panel.marks).map(|mark| &mark.name);
        let widest = curves.map(|curve| &curve.name).chain(marks).map(|name| name.chars().count()).max();
        widest.map_or(RIGHT, |letters| RIGHT + ENTRY[0] + ENTRY[1] * letters as f64)
    }
}

/// Tall enough for every entry of its legend.
fn height(panel: &Panel) -> f64 {
    HEIGHTS[usize::from(panel.equal)].max(LEGEND[1] + LEGEND[0] * (panel.curves.len() + panel.marks.len()) as f64)
}

fn plots(panel: &Panel) -> Vec<Plot> {
    let curves = panel.curves.iter().enumerate();
    // A curve is as many lines as it has parts. A point between two gaps is a dot: a line from it to itself is invisible.
    let plot = |(k, curve): (usize, &Curve)| {
        let colour = colour(k, panel.curves.len());
        let parts = curve.parts();
        let lines = parts.iter().enumerate().map(|(part, range)| {
            let points = curve.points[range.clone()].iter().copied();
            let has_legend = part == 0 && panel.curves.len() > 1;
            if range.len() == 1 {
                let dot = ScatterPlot::new().with_data(points).with_color(colour.clone()).with_size(2.0);
                return Plot::from(if has_legend { dot.with_legend(curve.name.clone()) } else { dot });
            }
            let line = LinePlot::new().with_data(points).with_stroke_width(2.0).with_color(colour.clone());
            let edge = |side: f64| curve.edge(side).skip(range.start).take(range.len()).collect::<Vec<_>>();
            let line = if curve.band.is_empty() { line } else { line.with_band(edge(-1.0), edge(1.0)) };
            Plot::from(if has_legend { line.with_legend(curve.name.clone()) } else { line })
        });
        lines.collect::<Vec<_>>()
    };
    // Marks come after the curves, each with a shape of its own.
    let mark = |(k, mark): (usize, &Mark)| {
        let points = ScatterPlot::new().with_data(mark.points.iter().copied()).with_color(MARK).with_size(4.0);
        Plot::from(points.with_marker(SHAPES[k % SHAPES.len()]).with_legend(mark.name.clone()))
    };
    curves.flat_map(plot).chain(panel.marks.iter().enumerate().map(mark)).collect()
}

/// The colour of a curve among several: no two have the same.
fn colour(index: usize, count: usize) -> String {
    match COLOURS.get(index) {
        Some(colour) if count <= COLOURS.len() => (*colour).to_owned(),
        _ => ColorMap::Viridis.map(MAP_END * index as f64 / (count.max(2) - 1) as f64),
    }
}

/// Axes that end where the curves end. The label of the vertical axis is above it, so that it needs no rotated text.
fn layout(panel: &Panel, plots: &[Plot], sides: Option<[f64; 2]>) -> Layout {
    let layout =
        Layout::auto_from_plots(plots).with_x_label(panel.labels[0].clone()).with_title(panel.labels[1].clone());
    let layout = layout.with_title_size(14);
    let [x, y] = [panel.range(0), panel.range(1)].map(|range| ends(range, 0.0)).map(|(from, to)| ticks(to - from));
    let layout = layout.with_x_tick_format(x).with_y_tick_format(y);
    // A path has a margin on all sides; a curve over time above and below, and at its ends if they are marked.
    let beside = if panel.marks.is_empty() { 0.0 } else { 0.3 * MARGIN };
    let margins = if panel.equal { [MARGIN; 2] } else { [beside, MARGIN] };
    let [(left, right), (low, high)] = [0, 1].map(|axis| ends(panel.range(axis), margins[axis]));
    let layout = layout.with_x_axis_min(left).with_x_axis_max(right).with_y_axis_min(low).with_y_axis_max(high);
    let layout = if panel.equal { layout.with_equal_aspect() } else { layout };
    match sides {
        Some([left, right]) => layout.with_force_margins(left, right),
        None => layout,
    }
}

/// The ends of an axis. A constant quantity gets an interval around its value.
fn ends((low, high): (f64, f64), margin: f64) -> (f64, f64) {
    let length = high - low;
    let size = low.abs().max(high.abs());
    if length <= 1e-9 * size || length == 0.0 {
        let band = if size > 0.0 { 0.1 * size } else { 1.0 };
        return (low - band, high + band);
    }
    (low - margin * length, high + margin * length)
}

/// Labels of the ticks of an axis of this length with all significant digits and without rounding errors: kuva's own
/// format has three decimals, so that 0.0225 would be 0.022, or as many as the number has, 4.9999999999999996e-6.
fn ticks(length: f64) -> TickFormat {
    // The decimal of a thousandth of the axis.
    let last = 3 - length.abs().log10().floor() as i32;
    TickFormat::Custom(Arc::new(move |value| match value.abs() {
        size if size <= 1e-9 * length.abs() => "0".to_owned(),
        1e-4..1e6 => without_zeros(&format!("{value:.0$}", last.max(0) as usize)),
        size => exponent(value, (last + size.log10().floor() as i32).max(5) as usize),
    }))
}

#[cfg(test)]
mod tests {
    use super::{COLOURS, Curve, Diagram, Panel, colour, ends, ticks};
    use std::collections::BTreeSet;

    #[test]
    fn axes_end_where_the_curves_end() {
        assert_eq!(ends((0.0, 6.3), 0.0), (0.0, 6.3));
        assert_eq!(ends((-1.0, 1.0), 0.05), (-1.1, 1.1));
        assert_eq!(ends((2.0, 2.0), 0.05), (1.8, 2.2));
        assert_eq!(ends((0.0, 0.0), 0.0), (-1.0, 1.0));
    }

    #[test]
    fn no_two_curves_have_one_colour() {
        for count in [1, 7, 8, 40] {
            let colours: BTreeSet<String> = (0..count).map(|place| colour(place, count)).collect();
            assert_eq!(colours.len(), count);
        }
        assert_eq!(colour(6, 7), COLOURS[6]);
    }

    #[test]
    fn a_legend_has_all_its_entries() {
        let curve = |k: u32| Curve {
            name: format!("curve {k}"),
            points: vec![(0.0, 0.0), (1.0, f64::from(k))],
            band: Vec::new(),
        };
        let labels = ["t in s", "x in m"].map(str::to_owned);
        let panel = Panel { labels, equal: false, curves: (0..42).map(curve).collect(), marks: Vec::new() };
        let picture = Diagram { title: "Many".to_owned(), panels: vec![panel], beside: false }.svg();
        for k in 0..42 {
            assert!(picture.contains(&format!(">curve {k}<")), "curve {k} is not in the legend");
        }
        assert!(!picture.contains("more)") && !picture.contains("rotate("), "a label is cut or turned");
    }

    #[test]
    fn ticks_have_all_their_digits_and_no_noise() {
        let ticks = ticks(0.02);
        let texts = [0.0225, 0.02, 1e-18, -0.0175, 1500.0, 2.5e-7].map(|value| ticks.format(value));
        assert_eq!(texts[..5], ["0.0225", "0.02", "0", "-0.0175", "1500"]);
        assert!(texts[5].contains("2.5"), "{}", texts[5]);
    }

    #[test]
    fn ticks_of_any_size_have_no_rounding_errors_and_differ() {
        let texts = |length: f64, values: [f64; 2]| values.map(|value| ticks(length).format(value));
        assert_eq!(texts(2e-5, [4.9999999999999996e-6, 2.4999999999999998e-5]), ["5e-6", "2.5e-5"]);
        assert_eq!(texts(2.0, [0.1 + 0.2, -0.5]), ["0.3", "-0.5"]);
        assert_eq!(texts(5e-7, [1000.0000001, 1000.0000002]), ["1000.0000001", "1000.0000002"]);
        assert_eq!(texts(0.5, [2e6 + 0.1, 3e7]), ["2.0000001e6", "3e7"]);
    }

    /// A line across a gap would show values that do not exist.
    #[test]
    fn a_curve_ends_where_it_has_no_value() {
        let points =
            [(0.0, 1.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, -1.0), (4.0, f64::INFINITY), (5.0, 0.5), (6.0, 0.0)];
        let curve = |band: Vec<f64>| Curve { name: "rate".to_owned(), points: points.to_vec(), band }.with_gaps();
        assert_eq!(curve(Vec::new()).parts(), [0..2, 3..4, 5..7]);
        assert_eq!(curve(vec![0.1, 0.1, 0.1, 0.1, 0.1, f64::NAN, 0.1]).parts(), [0..2, 3..4, 6..7]);
        let labels = ["t in s", "rate"].map(str::to_owned);
        let panel = Panel { labels, equal: false, curves: vec![curve(Vec::new())], marks: Vec::new() };
        assert_eq!([panel.range(0), panel.range(1)], [(0.0, 6.0), (-1.0, 2.0)]);
        let picture = Diagram { title: "Gaps".to_owned(), panels: vec![panel], beside: false }.svg();
        assert_eq!(picture.matches("<path").count(), 2, "{picture}");
        assert!(picture.contains("<circle") && !picture.contains("NaN"), "{picture}");
    }
}
