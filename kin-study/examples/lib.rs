//! Studies, each a complete program in a file of its own; the tests of this package run them. Here are the pictures that
//! they draw of what they found.

use kin_study::arrow::array::AsArray;
use kin_study::arrow::datatypes::{Float64Type, Int64Type};
use kin_study::query;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{Histogram, ParallelPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

/// What is drawn, or why there is nothing to draw.
type Drawn = Result<String, Box<dyn Error>>;

/// A histogram that a study counted, as SVG; `shown` is the number at the axis for a number of the study.
///
/// # Errors
/// Where the directory holds no study with this histogram.
pub fn histogram(study: &str, title: &str, of: &str, shown: fn(f64) -> f64) -> Drawn {
    let sql = format!("select \"from\", \"to\", count from histogram where \"of\" = '{of}' order by \"from\"");
    let (mut edges, mut counts) = (Vec::new(), Vec::new());
    for batch in query(Path::new(study), &sql)?.batches {
        let [from, to] = [0, 1].map(|column| batch.column(column).as_primitive::<Float64Type>().values());
        edges.truncate(counts.len());
        edges.extend(from.iter().chain(to.last()).copied().map(shown));
        counts.extend(batch.column(2).as_primitive::<Int64Type>().values().iter().map(|count| *count as f64));
    }
    if counts.is_empty() {
        return Err(format!("{study} has no histogram of {of}").into());
    }
    Ok(drawn(Plot::Histogram(Histogram::from_bins(edges, counts).with_color("#0072b2")), title))
}

/// The first hundred rows of a study in an order, over some of their columns, as SVG.
///
/// # Errors
/// Where the directory holds no study with these columns.
pub fn parallel(study: &str, title: &str, columns: &[&str], by: &str) -> Drawn {
    let sql = format!("select {} from study order by {by} limit 100", columns.join(", "));
    let mut plot = ParallelPlot::new().with_axis_names(columns.iter().copied()).with_opacity(0.35);
    for batch in query(Path::new(study), &sql)?.batches {
        let numbers: Vec<_> = (0..columns.len()).map(|k| batch.column(k).as_primitive::<Float64Type>()).collect();
        for row in 0..batch.num_rows() {
            plot = plot.with_row(numbers.iter().map(|column| column.value(row)));
        }
    }
    Ok(drawn(Plot::Parallel(plot), title))
}

fn drawn(plot: Plot, title: &str) -> String {
    let plots = vec![plot];
    let layout = Layout::auto_from_plots(&plots).with_title(title);
    SvgBackend.render_scene(&render_multiple(plots, layout))
}

/// Writes a picture to a file; says what is wrong otherwise.
pub fn picture(picture: Drawn, out: &str) -> ExitCode {
    let written = picture.and_then(|svg| std::fs::write(out, svg).map_err(|error| format!("{out}: {error}").into()));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
