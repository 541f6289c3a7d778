//! Diagrams of a motion as files: panels of curves with names, units and a legend.

mod panel;

pub(crate) use panel::{Curve, Panel};

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

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
    if panel.equal { layout.with_equal_aspect() } else { layout }
}
