//! Units of what is plotted, as far as the parameters tell them.

use crate::model::Model;

/// The unit of length and that of time of a mechanism; none where its parameters name several. Without a name a length has no
/// unit, and time is in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Units {
    length: Option<&'static str>,
    time: Option<&'static str>,
}

const LENGTHS: [&str; 7] = ["m", "mm", "cm", "µm", "km", "in", "ft"];
const TIMES: [&str; 4] = ["s", "ms", "min", "h"];

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// Something that nobody has named.
    Unknown,
}

impl Units {
    /// Those that the parameters agree on.
    pub(crate) fn of(model: &Model) -> Self {
        let words = || {
            let units = model.parameters.iter().filter_map(|parameter| parameter.unit);
            units.flat_map(|unit| unit.split(['/', '*', '·', '^', ' ', '2', '²']))
        };
        // The one of these that is named; none where several are, and `otherwise` where none is.
        let only = |known: &[&str], otherwise: Option<&'static str>| {
            let mut found: Option<&'static str> = None;
            for word in words().filter(|word| known.contains(word)) {
                match found {
                    Some(other) if other != word => return None,
                    _ => found = Some(word),
                }
            }
            found.or(otherwise)
        };
        Self { length: only(&LENGTHS, None), time: only(&TIMES, Some("s")) }
    }

    /// The unit of time.
    pub(crate) fn time(&self) -> Option<&'static str> {
        self.time
    }

    /// The unit of the derivative of an order.
    pub(crate) fn derivative(&self, measure: Measure, order: usize) -> Option<String> {
        let base = match measure {
            Measure::Length => self.length?,
            Measure::Angle => "rad",
            Measure::Unknown => return None,
        };
        match (order, self.time) {
            (0, _) => Some(base.to_owned()),
            (1, Some(time)) => Some(format!("{base}/{time}")),
            (_, Some(time)) => Some(format!("{base}/{time}²")),
            (_, None) => None,
        }
    }
}
