//! Replaces regular repetition in a program by loops.
//!
//! ```text
//! Program → stream of items → loops of the stream → Rolled
//!          stream            detect              resolve, join
//! ```
//!
//! The input needs no annotation: a chain of bodies declared one by one becomes a loop like one declared as a family. A
//! loop replaces a part of the program that repeats with a fixed period, while the indices of its loads, outputs and
//! operands advance by fixed steps; literals that differ between iterations become a table. Values that are read
//! outside their own iteration (in the next iteration, in another loop or in straight code) are stored in arrays. Code
//! without repetition remains straight.
//!
//! The results are bitwise unchanged, because every value is computed by the same operations in the same order.

mod detect;
mod join;
mod resolve;
mod rolled;
mod straight;
mod stream;

pub use join::Angles;
pub use rolled::{Keep, OperandSource, Piece, ResultPart, Rolled, RolledStep};

use super::Program;

/// The thresholds for replacing repetition by loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Worth {
    /// Minimum number of iterations of a loop.
    pub members: usize,
    /// Minimum number of steps that the loops of a program must save in total.
    pub saved: usize,
}

impl Default for Worth {
    /// Below these thresholds straight code compiles as fast and runs faster.
    fn default() -> Self {
        Self { members: 6, saved: 96 }
    }
}

/// The final form of `program`: with loops if they are worthwhile, otherwise as one straight piece.
pub fn finished(program: &Program) -> Rolled {
    roll(program, Worth::default()).unwrap_or_else(|| straight::straight(program))
}

/// `program` with loops; `None` if it has no repetition that reaches the thresholds.
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
