//! Studies as TOML files; every error has its line.

mod node;
mod parts;

use super::Study;
use super::build::grid;
use crate::error::StudyError;
use crate::sampling::Sampling;
use node::Node;
use toml::de::DeTable;

impl Study {
    /// Reads a study from TOML text.
    ///
    /// Top level: `rows`, `seed`, `sampling` (`"random"`, `"latin hypercube"`, `"sobol"`, `"grid"`). Tables, each with
    /// names of your own: `[parameters]` (a number, a list, `{ from, to }` with `values = N` or `scale = "log"`, `{
    /// mean, deviation }` with optional `from` and `to`, `{ from, mode, to }`), `[derived]` (SQL expressions, in
    /// order), `[scores]` (`{ least = "tip.x" }`, likewise `greatest`, `mean`, `range`, `time_of_least`,
    /// `time_of_greatest`; `{ at = 0.5, of = "tip.x" }`; `{ distance = "tip", to = [[0, 1]], measure = "rms" }`; `{
    /// path = "tip", normalised = true }`). `[conditions]` has the lists `before` and `after` of SQL conditions,
    /// `[motion]` either `times` or `from`, `to` and `steps`, besides `mode` (`"all"` or `{ A-B-D = "+" }`) and
    /// `inputs` (`{ u = 1, v = { from = 0, to = 1 } }`), and `[keep]` has `best` and `by`, `rows = false`, and
    /// `histograms` (`[{ of = "swing", from = 0, to = 1, bins = 20 }]`).
    ///
    /// # Errors
    /// [`StudyError::Description`] with the line if the text is no TOML or a value is invalid.
    pub fn from_toml(text: &str) -> Result<Self, StudyError> {
        let table = DeTable::parse(text).map_err(|error| {
            let line = error.span().map(|span| node::line(text, span.start));
            StudyError::Description { line, message: error.message().to_owned() }
        })?;
        let root = Node::root(text, table.get_ref());
        let mut study = Self::default();
        let known = ["rows", "seed", "sampling", "parameters", "derived", "conditions", "motion", "scores", "keep"];
        root.only(&known)?;
        study.rows = root.get("rows").map(|node| node.count()).transpose()?;
        study.seed = root.get("seed").map_or(Ok(0), |node| node.count())?;
        study.sampling = root.get("sampling").map_or(Ok(Sampling::Random), |node| {
            node.one_of(&[
                ("random", Sampling::Random),
                ("latin hypercube", Sampling::LatinHypercube),
                ("sobol", Sampling::Sobol),
                ("grid", Sampling::Grid),
            ])
        })?;
        study.note(&root, "rows");
        study.note(&root, "sampling");
        if let Some(node) = root.get("parameters") {
            for (name, value) in node.entries()? {
                study.lines.insert(format!("parameters.{name}"), value.line());
                study.parameters.push((name, parts::range(&value)?));
            }
        }
        if let Some(node) = root.get("derived") {
            for (name, value) in node.entries()? {
                study.lines.insert(format!("derived.{name}"), value.line());
                study.derived.push((name, value.text()?));
            }
        }
        if let Some(node) = root.get("conditions") {
            node.only(&["before", "after"])?;
            let texts = |key: &str| node.get(key).map_or(Ok(Vec::new()), |list| list.texts());
            (study.before, study.after) = (texts("before")?, texts("after")?);
            for (key, count) in [("before", study.before.len()), ("after", study.after.len())] {
                let items = node.get(key).map_or(Ok(Vec::new()), |list| list.items())?;
                for (place, item) in items.iter().enumerate().take(count) {
                    study.lines.insert(format!("conditions.{key}.{place}"), item.line());
                }
            }
        }
        study.read_motion(&root)?;
        if let Some(node) = root.get("scores") {
            for (name, value) in node.entries()? {
                study.lines.insert(format!("scores.{name}"), value.line());
                study.scores.push((name, parts::score(&value)?));
            }
        }
        study.read_keep(&root)?;
        Ok(study)
    }

    fn note(&mut self, root: &Node<'_>, key: &str) {
        self.lines.extend(root.get(key).map(|node| (key.to_owned(), node.line())));
    }

    fn read_motion(&mut self, root: &Node<'_>) -> Result<(), StudyError> {
        let Some(motion) = root.get("motion") else { return Ok(()) };
        self.lines.insert("motion".to_owned(), motion.line());
        motion.only(&["times", "from", "to", "steps", "mode", "inputs"])?;
        self.times = match (motion.get("times"), motion.get("to")) {
            (Some(times), None) if motion.get("from").is_none() && motion.get("steps").is_none() => times.numbers()?,
            (None, Some(to)) => {
                let from = motion.get("from").map_or(Ok(0.0), |node| node.number())?;
                let steps = motion.get("steps").map_or(Ok(100), |node| node.count())?;
                let steps = usize::try_from(steps).unwrap_or(usize::MAX);
                let (end, most) = (to.number()?, 10_000_000);
                if end == from || !(1..=most).contains(&steps) {
                    return Err(motion.wrong(format!("`to` must differ from `from`, with 1 to {most} steps")));
                }
                grid(from, end, steps)
            }
            _ => return Err(motion.wrong("write either `times`, or `to` with `from` and `steps`")),
        };
        if let Some(mode) = motion.get("mode") {
            self.lines.insert("motion.mode".to_owned(), mode.line());
            self.modes = parts::closures(&mode)?;
        }
        if let Some(inputs) = motion.get("inputs") {
            for (name, value) in inputs.entries()? {
                self.lines.insert(format!("motion.inputs.{name}"), value.line());
                self.inputs.push((name, parts::ramp(&value)?));
            }
        }
        Ok(())
    }

    fn read_keep(&mut self, root: &Node<'_>) -> Result<(), StudyError> {
        let Some(keep) = root.get("keep") else { return Ok(()) };
        keep.only(&["best", "by", "rows", "histograms"])?;
        self.best = match (keep.get("best"), keep.get("by")) {
            (Some(best), Some(by)) => {
                self.lines.insert("keep.by".to_owned(), by.line());
                Some((usize::try_from(best.count()?).unwrap_or(usize::MAX), by.text()?))
            }
            (None, None) => None,
            (Some(node), None) => return Err(node.wrong("the best by what? Write `by = \"swing desc\"` beside it")),
            (None, Some(node)) => return Err(node.wrong("how many? Write `best = 100` beside it")),
        };
        self.no_rows = keep.get("rows").map_or(Ok(true), |node| node.boolean())?.eq(&false);
        for (place, node) in keep.get("histograms").map_or(Ok(Vec::new()), |list| list.items())?.iter().enumerate() {
            self.lines.insert(format!("keep.histograms.{place}"), node.line());
            self.histograms.push(parts::histogram(node)?);
        }
        Ok(())
    }
}
