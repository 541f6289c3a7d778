//! Rolling: regular repetition in a program becomes loops.
//!
//! ```text
//! Program → stream of items → loops of the stream → Rolled
//!          stream            detect              resolve, join
//! ```
//!
//! Nothing is asked of whoever wrote the program: a chain that is written out rolls as one that is written with a
//! range. A loop is a stretch of the program that repeats with a fixed period, its loads, outputs and operands advancing
//! by fixed steps; literals that differ go to a table. Values that are read outside of their own iteration – by the next
//! one, by another loop, by straight code – stand in arrays. What does not fit stays straight.
//!
//! Results are the same to the last bit: the same operations in the same order, for every value.

mod detect;
mod join;
mod resolve;
mod rolled;
mod straight;
mod stream;

pub use join::Angles;
pub use rolled::{Keep, Part, Piece, Rolled, Source, Step};

use super::Program;

/// What repetition is worth a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Worth {
    /// The fewest members of a loop.
    pub members: usize,
    /// The fewest steps that need not be written, over all loops of a program.
    pub saved: usize,
}

impl Worth {
    /// Everything that repeats at all.
    pub const ANYTHING: Self = Self { members: 2, saved: 1 };
}

impl Default for Worth {
    /// Below, straight code is as quick to compile, and quicker to run.
    fn default() -> Self {
        Self { members: 6, saved: 96 }
    }
}

/// `program` as it is written down: with loops where they are worth it, and otherwise as one straight piece.
pub fn finished(program: &Program) -> Rolled {
    roll(program, Worth::default()).unwrap_or_else(|| straight::straight(program))
}

/// `program` with its repetition rolled up; nothing when there is none worth a loop.
pub fn roll(program: &Program, worth: Worth) -> Option<Rolled> {
    let stream = stream::Stream::of(program);
    let loops = detect::loops(&stream, worth.members.max(2));
    let saved: usize = loops.iter().map(|span| span.saved()).sum();
    if saved < worth.saved.max(1) {
        return None;
    }
    let mut rolled = resolve::resolve(program, &stream, &loops);
    join::join(&mut rolled);
    Some(rolled)
}
