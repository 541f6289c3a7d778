//! Panels: curves that share a pair of axes.

use core::ops::Range;

/// A curve with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// Its name, which distinguishes it from the others of its panel.
    pub(crate) name: String,
    /// (x, y); at a point that is not finite the curve has no value, and a gap.
    pub(crate) points: Vec<(f64, f64)>,
    /// The deviation of y on either side, for every point; empty for a curve without a band.
    pub(crate) band: Vec<f64>,
}

impl Curve {
    /// A copy of it with gaps at the points at which something is not known.
    pub(crate) fn with_gaps(self) -> Self {
        let half = self.band.iter().copied().chain(core::iter::repeat(0.0));
        let known = |((x, y), half): ((f64, f64), f64)| match x.is_finite() && y.is_finite() && half.is_finite() {
            true => (x, y),
            false => (f64::NAN, f64::NAN),
        };
        Self { points: self.points.iter().copied().zip(half).map(known).collect(), ..self }
    }

    /// The parts of the curve between its gaps, as ranges of points.
    pub(super) fn parts(&self) -> Vec<Range<usize>> {
        let known = |k: &usize| self.points[*k].1.is_finite();
        let places: Vec<usize> = (0..self.points.len()).filter(known).collect();
        places.chunk_by(|a, b| a + 1 == *b).map(|part| part[0]..part[0] + part.len()).collect()
    }

    /// The lower or the upper edge of its band; the curve itself if it has none.
    pub(super) fn edge(&self, side: f64) -> impl Iterator<Item = f64> + '_ {
        let half = self.band.iter().copied().chain(core::iter::repeat(0.0));
        self.points.iter().zip(half).map(move |((_, y), half)| y + side * half)
    }
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Panel {
    /// Labels of the horizontal and of the vertical axis.
    pub(crate) labels: [String; 2],
    /// Whether both axes have the same scale, for paths in the plane.
    pub(crate) equal: bool,
    /// At least one.
    pub(crate) curves: Vec<Curve>,
    /// Points of curves that are marked.
    pub(crate) marks: Vec<Mark>,
}

/// Marked points of curves, such as limits at which motions end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mark {
    /// Their name in the legend.
    pub(crate) name: String,
    /// (x, y), all finite.
    pub(crate) points: Vec<(f64, f64)>,
}

impl Panel {
    /// The least and the greatest x or y of its curves.
    pub(super) fn range(&self, axis: usize) -> (f64, f64) {
        let numbers = self.curves.iter().flat_map(|curve| -> Box<dyn Iterator<Item = f64> + '_> {
            match axis {
                0 => Box::new(curve.points.iter().map(|(x, _)| *x)),
                _ => Box::new(curve.edge(-1.0).chain(curve.edge(1.0))),
            }
        });
        let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if low <= high { (low, high) } else { (0.0, 1.0) }
    }

    /// A label with its unit.
    pub(crate) fn label(name: &str, unit: Option<&str>) -> String {
        match unit {
            Some(unit) => format!("{name} in {unit}"),
            None => name.to_owned(),
        }
    }
}
