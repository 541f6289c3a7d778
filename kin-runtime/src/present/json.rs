//! JSON that a person can read too: objects broken into lines down to a small depth, lists of numbers on one line.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// Objects deeper than this stand on one line.
const DEPTH: usize = 2;

/// A record as JSON with a final line break; numbers in full, what is not finite as null.
pub(crate) fn to_json<T: Serialize>(record: &T) -> Result<String, String> {
    let failed = |e: &dyn std::fmt::Display| format!("cannot write JSON: {e}");
    let mut bytes = Vec::new();
    record.serialize(&mut Serializer::with_formatter(&mut bytes, Lines::default())).map_err(|e| failed(&e))?;
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(|e| failed(&e))
}

/// An open object or list.
#[derive(Clone, Copy)]
struct Open {
    array: bool,
    /// Its parts stand on lines of their own.
    broken: bool,
    empty: bool,
}

#[derive(Default)]
struct Lines(Vec<Open>);

impl Lines {
    fn line<W: ?Sized + Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.0.iter().filter(|o| o.broken).count()).try_for_each(|_| writer.write_all(b"  "))
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if let Some(open) = self.0.pop()
            && open.broken
            && !open.empty
        {
            self.line(writer)?;
        }
        writer.write_all(bracket)
    }

    /// The next part of the innermost object or list begins.
    fn part<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        let Some(open) = self.0.last_mut() else { return Ok(()) };
        open.empty = false;
        let broken = open.broken;
        if !first {
            writer.write_all(if broken { b"," } else { b", " })?;
        }
        if broken { self.line(writer) } else { Ok(()) }
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.0.push(Open { array: true, broken: false, empty: true });
        writer.write_all(b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        // A list breaks only when an object begins in it.
        match self.0.last() {
            Some(open) if open.broken => writer.write_all(if first { b"" } else { b"," }),
            _ => self.part(writer, first),
        }
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let objects = self.0.iter().filter(|o| !o.array).count();
        let shallow = objects < DEPTH;
        if shallow && self.0.last().is_some_and(|o| o.array) {
            if let Some(list) = self.0.last_mut() {
                list.broken = true;
                list.empty = false;
            }
            self.line(writer)?;
        }
        let in_list = self.0.iter().any(|o| o.array);
        self.0.push(Open { array: false, broken: shallow && !in_list, empty: true });
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.part(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    struct Inner {
        a: Vec<f64>,
        b: f64,
    }

    #[derive(Serialize)]
    struct Outer {
        t: f64,
        list: Vec<Inner>,
        inner: Inner,
        empty: Vec<f64>,
    }

    #[test]
    fn objects_are_broken_and_lists_of_numbers_are_not() {
        let inner = || Inner { a: vec![0.1, 2.0], b: f64::NAN };
        let outer = Outer { t: 1e-17, list: vec![inner(), inner()], inner: inner(), empty: vec![] };
        let expected = r#"{
  "t": 1e-17,
  "list": [
    {"a": [0.1, 2.0], "b": null},
    {"a": [0.1, 2.0], "b": null}
  ],
  "inner": {
    "a": [0.1, 2.0],
    "b": null
  },
  "empty": []
}
"#;
        assert_eq!(to_json(&outer), Ok(expected.to_owned()));
    }
}
