//! Studies as TOML text, which [`Study::from_toml`] reads.

use super::{Closures, Study};
use crate::sampling::{Range, Sampling};
use crate::scores::{Measure, Score};
use std::fmt::{self, Write};

impl Study {
    /// The study as TOML text, from which [`from_toml`](Self::from_toml) makes the same study with the same numbers.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        // Nothing fails when it is written to a string.
        let _ = self.write_toml(&mut text);
        text
    }

    fn write_toml(&self, f: &mut String) -> fmt::Result {
        if let Some(rows) = self.rows {
            writeln!(f, "rows = {rows}")?;
        }
        let sampling = match self.sampling {
            Sampling::Random => "random",
            Sampling::LatinHypercube => "latin hypercube",
            Sampling::Sobol => "sobol",
            Sampling::Grid => "grid",
        };
        writeln!(f, "seed = {}\nsampling = \"{sampling}\"", self.seed)?;
        table(f, "parameters", self.parameters.iter().map(|(name, parameter)| (name, range(parameter))))?;
        table(f, "derived", self.derived.iter().map(|(name, formula)| (name, quoted(formula))))?;
        let texts = |texts: &[String]| list(texts.iter().map(|text| quoted(text)));
        writeln!(f, "\n[conditions]\nbefore = {}\nafter = {}", texts(&self.before), texts(&self.after))?;
        if !self.times.is_empty() {
            writeln!(f, "\n[motion]\ntimes = {}", numbers(&self.times))?;
            let pair = |(name, value): (&String, String)| format!("{} = {value}", quoted(name));
            match &self.modes {
                Closures::OfGuess => {}
                Closures::All => writeln!(f, "mode = \"all\"")?,
                Closures::Signs(signs) => {
                    let signs = signs.iter().map(|(name, sign)| pair((name, quoted(&sign.to_string()))));
                    writeln!(f, "mode = {{ {} }}", signs.collect::<Vec<_>>().join(", "))?;
                }
            }
            let inputs = self
                .inputs
                .iter()
                .map(|(name, ramp)| pair((name, format!("{{ from = {:?}, to = {:?} }}", ramp.from, ramp.to))));
            writeln!(f, "inputs = {{ {} }}", inputs.collect::<Vec<_>>().join(", "))?;
        }
        table(f, "scores", self.scores.iter().map(|(name, definition)| (name, score(definition))))?;
        writeln!(f, "\n[keep]\nrows = {}", !self.no_rows)?;
        if let Some((count, by)) = &self.best {
            writeln!(f, "best = {count}\nby = {}", quoted(by))?;
        }
        let histograms = self.histograms.iter().map(|histogram| {
            format!(
                "{{ of = {}, from = {:?}, to = {:?}, bins = {} }}",
                quoted(&histogram.of),
                histogram.from,
                histogram.to,
                histogram.bins
            )
        });
        writeln!(f, "histograms = {}", list(histograms))
    }
}

/// A TOML table whose keys are names of the user.
fn table<'a>(f: &mut String, title: &str, entries: impl Iterator<Item = (&'a String, String)>) -> fmt::Result {
    writeln!(f, "\n[{title}]")?;
    entries.into_iter().try_for_each(|(name, value)| writeln!(f, "{} = {value}", quoted(name)))
}

fn range(range: &Range) -> String {
    let ends = |from: f64, to: f64| format!("from = {from:?}, to = {to:?}");
    match range {
        Range::Fixed(value) => format!("{value:?}"),
        Range::List(values) => numbers(values),
        Range::Uniform { from, to } => format!("{{ {} }}", ends(*from, *to)),
        Range::LogUniform { from, to } => format!("{{ {}, scale = \"log\" }}", ends(*from, *to)),
        Range::Normal { mean, deviation, from, to } => {
            let end = |key: &str, value: f64| match value.is_finite() {
                true => format!(", {key} = {value:?}"),
                false => String::new(),
            };
            format!("{{ mean = {mean:?}, deviation = {deviation:?}{}{} }}", end("from", *from), end("to", *to))
        }
        Range::Triangular { from, mode, to } => format!("{{ {}, mode = {mode:?} }}", ends(*from, *to)),
    }
}

fn score(score: &Score) -> String {
    let written = |rule: &str, name: &str| format!("{{ {rule} = {} }}", quoted(name));
    match score {
        Score::Least(name) => written("least", name),
        Score::Greatest(name) => written("greatest", name),
        Score::Mean(name) => written("mean", name),
        Score::Range(name) => written("range", name),
        Score::TimeOfLeast(name) => written("time_of_least", name),
        Score::TimeOfGreatest(name) => written("time_of_greatest", name),
        Score::At { of, t } => format!("{{ at = {t:?}, of = {} }}", quoted(of)),
        Score::Path { point, normalised } => format!("{{ path = {}, normalised = {normalised} }}", quoted(point)),
        Score::Distance { point, to, measure } => {
            let to = list(to.iter().map(|point| numbers(point)));
            let measure = match measure {
                Measure::Greatest => "greatest",
                Measure::RootMeanSquare => "rms",
            };
            format!("{{ distance = {}, to = {to}, measure = \"{measure}\" }}", quoted(point))
        }
    }
}

fn numbers(values: &[f64]) -> String {
    list(values.iter().map(|value| format!("{value:?}")))
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

/// A text of one line in quotes.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            // Nothing fails when it is written to a string.
            control if control.is_control() => drop(write!(out, "\\u{:04X}", u32::from(control))),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Histogram, Ramp};
    use kin_runtime::Sign;

    #[test]
    fn a_study_comes_back_from_its_text() {
        let normal = |from, to| Range::Normal { mean: 0.1, deviation: 1e-17, from, to };
        let quantity = || "|tip.x_ddot|".to_owned();
        let study = Study::new()
            .rows(12_345_678_901)
            .seed(u64::MAX)
            .sampling(Sampling::LatinHypercube)
            .parameter("a", Range::Fixed(-0.0))
            .parameter("b[3]", Range::List(vec![0.1 + 0.2, 1e300]))
            .parameter("c", Range::Uniform { from: -1.0, to: 1.0 / 3.0 })
            .parameter("d", Range::LogUniform { from: 1e-9, to: 1.0 })
            .parameter("e", normal(f64::NEG_INFINITY, f64::INFINITY))
            .parameter("f", normal(-1.0, f64::INFINITY))
            .parameter("g", Range::Triangular { from: 0.0, mode: 0.25, to: 1.0 })
            .derived("h", "a + \"b[3]\" -- it's \\ a\n\ttest")
            .condition("a < c")
            .keep_where("mean > 1")
            .times(&[0.0, 0.1, 1e-3])
            .mode("A-B-D", Sign::Minus)
            .input("u", Ramp { from: 1.0, to: -2.5e-8 })
            .score("least", Score::Least(quantity()))
            .score("greatest", Score::Greatest(quantity()))
            .score("mean", Score::Mean(quantity()))
            .score("range", Score::Range(quantity()))
            .score("first", Score::TimeOfLeast(quantity()))
            .score("last", Score::TimeOfGreatest(quantity()))
            .score("at", Score::At { of: quantity(), t: 0.1 })
            .score(
                "far",
                Score::Distance {
                    point: "tip".to_owned(),
                    to: vec![[0.0, 1.0], [0.5, 0.25]],
                    measure: Measure::RootMeanSquare,
                },
            )
            .score("path", Score::Path { point: "tip".to_owned(), normalised: true })
            .keep_best(7, "far, \"least\" desc")
            .histogram(Histogram { of: "far".to_owned(), from: 0.0, to: 0.1, bins: 3 });
        for study in [study.clone().all_modes().keep_no_rows(), study, Study::new().sampling(Sampling::Sobol)] {
            let text = study.to_toml();
            let again = Study::from_toml(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(format!("{study:?}"), format!("{again:?}"), "{text}");
        }
    }
}
