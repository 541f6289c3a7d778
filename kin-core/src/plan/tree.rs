//! The tree of a plan: blocks with their pivots, and what each part of a block is.

use super::form::Key;
use crate::expr::ExprId;

/// Rows and unknowns that are solved together.
///
/// First the pivots in order: each takes one coordinate out of all other rows. Then the parts, in order; each knows the
/// coordinates of those before it. Last the pivots' coordinates, in reverse order.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) pivots: Vec<Pivot>,
    pub(super) parts: Vec<Part>,
}

/// A coordinate that one row gives: it is linear there with a coefficient that does not change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pivot {
    /// The row.
    pub(super) row: usize,
    /// The coordinate, place in q.
    pub(super) coordinate: u32,
    /// Its coefficient there.
    pub(super) coefficient: ExprId,
    /// Its value by the other coordinates.
    pub(super) value: ExprId,
}

/// A part of a block.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// Solved at once.
    Core(Core),
    /// A block of its own.
    Block(Block),
    /// Two rows that are one row after an unknown of both has been eliminated.
    Pair(Box<Pair>),
}

/// An unknown that appears in two rows only; together they say one thing without it. The first row is replaced by that
/// one, the second is used up.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub(super) rows: [usize; 2],
    pub(super) coordinate: u32,
    pub(super) value: PairValue,
    /// Rows that had the unknown, too, before they gave it up.
    pub(super) exchanges: Vec<Exchange>,
    /// The block without it.
    pub(super) inner: Block,
}

/// A row h that becomes h − α f − β g with the rows f and g of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exchange {
    pub(super) row: usize,
    /// α and β.
    pub(super) factors: [ExprId; 2],
}

/// How a pair gives its unknown, once the others are known.
#[derive(Clone, Debug)]
pub(super) enum PairValue {
    /// The cosine and sine of a sum of multiples of angles, among which the coordinate is.
    /// Both are given times `size`, which is positive where `square` is there: the squared length of the vector that is
    /// turned, where both rows see the same one.
    /// Where the rows see different vectors, `size` is the square of their cross product, and `vectors` are their
    /// squared lengths.
    Angle {
        turn: Vec<(u32, i32)>,
        cos: ExprId,
        sin: ExprId,
        size: ExprId,
        square: Option<ExprId>,
        vectors: Option<[ExprId; 2]>,
    },
    /// The value, f₁ and g₁ by which it is linear in both rows, and f₁² + g₁² where that is the same at all q.
    Linear { value: ExprId, by: [ExprId; 2], square: Option<ExprId> },
}

/// What closes a part.
#[derive(Clone, Debug)]
pub(super) struct Core {
    /// Rows as they stand after all eliminations.
    pub(super) rows: Vec<usize>,
    /// The coordinates that it gives.
    pub(super) coordinates: Vec<u32>,
    pub(super) way: Way,
}

/// How a core is solved. Expressions hold the coordinates of other parts as symbols.
#[derive(Clone, Debug)]
pub(super) enum Way {
    /// matrix · x + constant = 0, row by row.
    Linear { matrix: Vec<Vec<ExprId>>, constant: Vec<ExprId> },
    /// a cos nφ + b sin nφ = c, n being `times`.
    Angle { times: i32, a: ExprId, b: ExprId, c: ExprId },
    /// a x² + b x + c = 0.
    Quadratic { a: ExprId, b: ExprId, c: ExprId },
    /// A circle e(x² + y²) + l·(x, y) + k = 0 that a line n·(x, y) + m = 0 meets; the line may be that of two circles.
    Circle { e: ExprId, l: [ExprId; 2], k: ExprId, n: [ExprId; 2], m: ExprId, of_two: bool },
    /// Residuals that an iteration brings to zero.
    Newton { residuals: Vec<ExprId> },
}

impl Key {
    /// The key of a coordinate to a power.
    pub(super) fn power(coordinate: u32, power: u8) -> Self {
        Self { powers: vec![(coordinate, power)], turn: Vec::new() }
    }
}
