//! A value of a TOML file with its position.

use crate::error::StudyError;
use crate::suggest::unknown;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The line of the byte with this index, from 1.
pub(super) fn line(text: &str, byte: usize) -> usize {
    1 + text.as_bytes().iter().take(byte).filter(|byte| **byte == b'\n').count()
}

/// A value with its position in the file.
#[derive(Clone, Copy)]
pub(super) struct Node<'t> {
    text: &'t str,
    start: usize,
    value: Value<'t>,
}

#[derive(Clone, Copy)]
enum Value<'t> {
    Table(&'t DeTable<'t>),
    Other(&'t DeValue<'t>),
}

impl<'t> Node<'t> {
    /// The whole file.
    pub(super) fn root(text: &'t str, table: &'t DeTable<'t>) -> Self {
        Self { text, start: 0, value: Value::Table(table) }
    }

    fn of(&self, start: usize, value: &'t Spanned<DeValue<'t>>) -> Self {
        let value = match value.get_ref() {
            DeValue::Table(table) => Value::Table(table),
            other => Value::Other(other),
        };
        Self { text: self.text, start, value }
    }

    /// Its line in the file, from 1.
    pub(super) fn line(&self) -> usize {
        line(self.text, self.start)
    }

    /// An error about it.
    pub(super) fn wrong(&self, message: impl Into<String>) -> StudyError {
        StudyError::Description { line: Some(self.line()), message: message.into() }
    }

    /// The value of a key, if this is a table that has the key.
    pub(super) fn get(&self, key: &str) -> Option<Self> {
        let Value::Table(table) = self.value else { return None };
        table.get_key_value(key).map(|(key, value)| self.of(key.span().start, value))
    }

    /// An error if the table has any other key.
    pub(super) fn only(&self, known: &[&str]) -> Result<(), StudyError> {
        for (name, node) in self.entries()? {
            if !known.contains(&name.as_str()) {
                return Err(node.wrong(unknown("key", &name, known.iter().copied())));
            }
        }
        Ok(())
    }

    /// The entries of a table, in the order of the file.
    pub(super) fn entries(&self) -> Result<Vec<(String, Self)>, StudyError> {
        let Value::Table(table) = self.value else { return Err(self.wrong("a table is expected here")) };
        let each = |(key, value): (&'t Spanned<_>, _)| {
            let name: &std::borrow::Cow<'t, str> = key.get_ref();
            (name.clone().into_owned(), self.of(key.span().start, value))
        };
        let mut entries: Vec<(String, Self)> = table.iter().map(each).collect();
        entries.sort_by_key(|(_, node)| node.start);
        Ok(entries)
    }

    /// The items of a list.
    pub(super) fn items(&self) -> Result<Vec<Self>, StudyError> {
        match self.value {
            Value::Other(DeValue::Array(items)) => {
                Ok(items.iter().map(|item| self.of(item.span().start, item)).collect())
            }
            _ => Err(self.wrong("a list is expected here, in brackets")),
        }
    }

    /// True for a table.
    pub(super) fn is_table(&self) -> bool {
        matches!(self.value, Value::Table(_))
    }

    /// True for a list.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.value, Value::Other(DeValue::Array(_)))
    }

    /// A finite number.
    pub(super) fn number(&self) -> Result<f64, StudyError> {
        let text = match self.value {
            Value::Other(DeValue::Integer(number)) if number.radix() == 10 => number.as_str(),
            Value::Other(DeValue::Float(number)) => number.as_str(),
            _ => return Err(self.wrong("a number is expected here")),
        };
        match text.replace('_', "").parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.wrong(format!("a finite number is expected here, not {text}"))),
        }
    }

    /// A whole number that is not negative; it may be written as 1e6.
    pub(super) fn count(&self) -> Result<u64, StudyError> {
        if let Value::Other(DeValue::Integer(number)) = self.value
            && number.radix() == 10
            && let Ok(whole) = number.as_str().replace('_', "").parse()
        {
            return Ok(whole);
        }
        let number = self.number()?;
        let whole = number.fract() == 0.0 && (0.0..=9e15).contains(&number);
        if whole {
            Ok(number as u64)
        } else {
            Err(self.wrong(format!("a whole number is expected here, not {number}")))
        }
    }

    /// A text.
    pub(super) fn text(&self) -> Result<String, StudyError> {
        match self.value {
            Value::Other(DeValue::String(text)) => Ok(text.clone().into_owned()),
            _ => Err(self.wrong("a text is expected here, in quotes")),
        }
    }

    /// True or false.
    pub(super) fn boolean(&self) -> Result<bool, StudyError> {
        match self.value {
            Value::Other(DeValue::Boolean(value)) => Ok(*value),
            _ => Err(self.wrong("true or false is expected here")),
        }
    }

    /// A list of texts.
    pub(super) fn texts(&self) -> Result<Vec<String>, StudyError> {
        self.items()?.iter().map(Self::text).collect()
    }

    /// A list of numbers.
    pub(super) fn numbers(&self) -> Result<Vec<f64>, StudyError> {
        self.items()?.iter().map(Self::number).collect()
    }

    /// One of several words.
    pub(super) fn one_of<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, StudyError> {
        let text = self.text()?;
        let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
        found.ok_or_else(|| self.wrong(unknown("value", &text, words.iter().map(|(word, _)| *word))))
    }
}
