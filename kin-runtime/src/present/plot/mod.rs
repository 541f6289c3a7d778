//! Diagrams of a motion as files: panels of curves with names, units and a legend.

mod panel;

pub(crate) use panel::{Curve, Panel};

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::Scene;
use std::sync::Arc;

use crate::present::number::rounded;

/// Width of a panel in pixels, its axes and legend included.
const WIDTH: f64 = 860.0;
/// Height of a panel over time, and of one whose axes are equal.
const HEIGHTS: [f64; 2] = [400.0, 620.0];
/// Pixels of a PNG per pixel of the drawing.
const DENSITY: f32 = 2.0;

/// Colours that people with any kind of colour vision tell apart (Okabe and Ito, 2008), without yellow.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];

/// Panels below one another.
pub(crate) struct Diagram {
    /// What stands above.
    pub(crate) title: String,
    /// At least one.
    pub(crate) panels: Vec<Panel>,
}

impl Diagram {
    /// As SVG whose curves are paths of numbers.
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
        let layouts = self.panels.iter().zip(&plots).map(|(panel, plots)| layout(panel, plots)).collect();
        let mut figure = Figure::new(self.panels.len(), 1)
            .with_title(self.title.clone())
            .with_cell_size(WIDTH, HEIGHTS[0])
            .with_plots(plots)
            .with_layouts(layouts);
        for (row, panel) in self.panels.iter().enumerate() {
            figure = figure.with_row_height(row, HEIGHTS[usize::from(panel.equal)]);
        }
        figure.render()
    }
}

fn plots(panel: &Panel) -> Vec<Plot> {
    let curves = panel.curves.iter().enumerate();
    let plot = |(k, curve): (usize, &Curve)| {
        let line = LinePlot::new().with_data(curve.points.iter().copied()).with_stroke_width(2.0);
        let line = line.with_color(COLOURS[k % COLOURS.len()]);
        // Beyond the colours, dashes distinguish.
        let line = if k / COLOURS.len() % 2 == 1 { line.with_dashed() } else { line };
        let line = if panel.curves.len() > 1 { line.with_legend(curve.name.clone()) } else { line };
        Plot::from(line)
    };
    curves.map(plot).collect()
}

fn layout(panel: &Panel, plots: &[Plot]) -> Layout {
    let layout =
        Layout::auto_from_plots(plots).with_x_label(panel.labels[0].clone()).with_y_label(panel.labels[1].clone());
    let [x, y] = [layout.x_range, layout.y_range].map(|(from, to)| ticks(to - from));
    let layout = layout.with_x_tick_format(x).with_y_tick_format(y);
    if panel.equal { layout.with_equal_aspect() } else { layout }
}

/// Numbers at the ticks of an axis of some length, with all their digits: kuva's own format has three decimals, which
/// makes 0.022 of 0.0225.
fn ticks(length: f64) -> TickFormat {
    TickFormat::Custom(Arc::new(move |value| match value.abs() {
        size if size <= 1e-9 * length.abs() => "0".to_owned(),
        1e-4..1e6 => rounded(value),
        _ => TickFormat::Auto.format(value),
    }))
}

#[cfg(test)]
mod tests {
    use super::ticks;

    #[test]
    fn ticks_have_all_their_digits_and_no_noise() {
        let ticks = ticks(0.02);
        let texts = [0.0225, 0.02, 1e-18, -0.0175, 1500.0, 2.5e-7].map(|value| ticks.format(value));
        assert_eq!(texts[..5], ["0.0225", "0.02", "0", "-0.0175", "1500"]);
        assert!(texts[5].contains("2.5"), "{}", texts[5]);
    }
}
