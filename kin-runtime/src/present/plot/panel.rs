//! Panels: curves that share a pair of axes.

/// A curve with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// Its name, which distinguishes it from the others of its panel.
    pub(crate) name: String,
    /// (x, y), all finite.
    pub(crate) points: Vec<(f64, f64)>,
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
    /// What they are, for the legend.
    pub(crate) name: String,
    /// (x, y), all finite.
    pub(crate) points: Vec<(f64, f64)>,
}

impl Panel {
    /// The least and the greatest x or y of its curves.
    pub(super) fn range(&self, axis: usize) -> (f64, f64) {
        let numbers = self.curves.iter().flat_map(|curve| &curve.points).map(|&(x, y)| if axis == 0 { x } else { y });
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
