//! Text tables.

use super::number::Style;

/// The alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// A table of text: a header, a rule, rows; two spaces between columns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without columns.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Adds a column of words to the right.
    pub(crate) fn words<S: Into<String>>(mut self, header: &str, cells: impl IntoIterator<Item = S>) -> Self {
        self.push(header, Align::Left, cells.into_iter().map(Into::into).collect());
        self
    }

    /// Adds a column of numbers to the right, all in one style.
    pub(crate) fn numbers(mut self, header: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let style = Style::of(values.iter().copied());
        self.push(header, Align::Right, values.into_iter().map(|v| style.write(v)).collect());
        self
    }

    /// Adds a column of texts that are aligned at the right.
    pub(crate) fn right<S: Into<String>>(mut self, header: &str, cells: impl IntoIterator<Item = S>) -> Self {
        self.push(header, Align::Right, cells.into_iter().map(Into::into).collect());
        self
    }

    fn push(&mut self, header: &str, align: Align, cells: Vec<String>) {
        let index = self.columns.len();
        self.columns.push((header.to_owned(), align));
        self.rows.resize(self.rows.len().max(cells.len()), Vec::new());
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.resize(index, String::new());
            row.push(cell);
        }
    }

    /// True when there are no rows.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The text, every line indented by two spaces; columns whose cells are all empty are left out.
    pub(crate) fn render(&self) -> String {
        let cell = |row: &[String], column: usize| row.get(column).cloned().unwrap_or_default();
        let shown: Vec<usize> = (0..self.columns.len())
            .filter(|&c| self.rows.iter().any(|r| r.get(c).is_some_and(|t| !t.is_empty())))
            .collect();
        let widths: Vec<usize> = shown
            .iter()
            .map(|&c| {
                let header = self.columns.get(c).map_or(0, |(h, _)| width(h));
                self.rows.iter().map(|r| r.get(c).map_or(0, |t| width(t))).fold(header, usize::max)
            })
            .collect();
        let mut out = String::new();
        let mut line = |cells: Vec<String>| {
            let mut text = String::new();
            for ((cell, &w), &c) in cells.iter().zip(&widths).zip(&shown) {
                let pad = " ".repeat(w.saturating_sub(width(cell)));
                text.push_str("  ");
                match self.columns.get(c).map(|(_, align)| *align) {
                    Some(Align::Right) => text.extend([pad.as_str(), cell]),
                    _ => text.extend([cell, pad.as_str()]),
                }
            }
            out.push_str(text.trim_end());
            out.push('\n');
        };
        line(shown.iter().filter_map(|&c| self.columns.get(c)).map(|(h, _)| h.clone()).collect());
        line(widths.iter().map(|&w| "─".repeat(w)).collect());
        for row in &self.rows {
            line(shown.iter().map(|&c| cell(row, c)).collect());
        }
        out
    }
}

/// Width of a text on the screen: combining marks (the dots of q̇) have no width.
pub(crate) fn width(text: &str) -> usize {
    text.chars().filter(|c| !('\u{300}'..='\u{36f}').contains(c)).count()
}

/// Words with a comma, or nothing, after each but the last, broken into lines of at most `columns` columns, the first
/// after `lead`, the others indented as far.
pub(crate) fn wrapped<S: AsRef<str>>(
    lead: &str,
    words: impl IntoIterator<Item = S>,
    comma: &str,
    columns: usize,
) -> String {
    let indent = width(lead);
    let mut out = lead.to_owned();
    let mut at = indent;
    let mut first = true;
    for word in words {
        let word = word.as_ref();
        if first {
            first = false;
        } else if at + comma.len() + 1 + width(word) + comma.len() > columns {
            out.push_str(&format!("{comma}\n{}", " ".repeat(indent)));
            at = indent;
        } else {
            out.push_str(&format!("{comma} "));
            at += comma.len() + 1;
        }
        out.push_str(word);
        at += width(word);
    }
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_the_right_under_their_header() {
        let table = Table::new().words("name", ["a", "bc"]).numbers("q̇", [1.0, -10.5]);
        assert_eq!(
            table.render(),
            concat!("  name           q̇\n", "  ────  ──────────\n", "  a       1.000000\n", "  bc    -10.500000\n")
        );
    }

    #[test]
    fn an_empty_column_disappears() {
        let table = Table::new().words("name", ["a"]).words("unit", [""]).words("doc", ["x"]);
        assert_eq!(table.render(), "  name  doc\n  ────  ───\n  a     x\n");
    }

    #[test]
    fn long_lists_are_broken_under_their_lead() {
        let text = wrapped("  w  ", ["alpha", "beta", "gamma"], ",", 18);
        assert_eq!(text, "  w  alpha, beta,\n     gamma\n");
    }
}
