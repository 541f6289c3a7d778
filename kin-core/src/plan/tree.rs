//! The tree of a plan: blocks with their pivots, and the parts of each block.

use super::term_sum::TermKey;
use crate::expr::ExprId;

/// Rows and unknowns that are solved together.
///
/// The pivots come first, in order: each eliminates one coordinate from all other rows. Then the parts are solved in
/// order; the coordinates of earlier parts are known in later ones. Finally back substitution gives the pivots'
/// coordinates in reverse order.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) pivots: Vec<Pivot>,
    pub(super) parts: Vec<BlockPart>,
}

/// A coordinate that is eliminated by one row, in which it is linear with a constant coefficient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pivot {
    /// The row that gives the coordinate.
    pub(super) row: usize,
    /// The coordinate, as an index of q.
    pub(super) coordinate: u32,
    /// The coefficient of the coordinate in this row.
    pub(super) coefficient: ExprId,
    /// The coordinate in terms of the other coordinates.
    pub(super) value: ExprId,
}

/// A part of a block.
#[derive(Clone, Debug)]
pub(super) enum BlockPart {
    /// Rows that are solved at once.
    Core(Core),
    /// A nested block.
    Block(Block),
    /// Two rows that are combined into one row without one of their unknowns.
    Pair(Box<Pair>),
}

/// Elimination of an unknown that appears in two rows only. The combination of the two rows that does not contain the
/// unknown replaces the first row; the second row is used to find the unknown.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub(super) rows: [usize; 2],
    pub(super) coordinate: u32,
    pub(super) value: PairValue,
    /// Other rows that contained the unknown, and how it was removed from them beforehand.
    pub(super) exchanges: Vec<Exchange>,
    /// The block that is left after the elimination.
    pub(super) inner: Block,
}

/// A row h that is replaced by h − α f − β g, where f and g are the rows of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exchange {
    pub(super) row: usize,
    /// The factors α and β.
    pub(super) factors: [ExprId; 2],
}

/// How a pair gives its unknown once the other unknowns are known.
#[derive(Clone, Debug)]
pub(super) enum PairValue {
    /// The cosine and sine of `turn`, a sum of integer multiples of angles that includes the unknown, both multiplied
    /// by `size`. If both rows rotate the same vector, `size` is its squared length; `square` is the same expression if
    /// it is also the sum of the squares of the two entries of Φ_q for the unknown. If the rows rotate different
    /// vectors, `size` is the square of their cross product, and `vectors` holds their squared lengths.
    Angle {
        turn: Vec<(u32, i32)>,
        cos: ExprId,
        sin: ExprId,
        size: ExprId,
        square: Option<ExprId>,
        vectors: Option<[ExprId; 2]>,
    },
    /// The value of the unknown; its coefficients f₁ and g₁ in the two rows; f₁² + g₁² if that is constant.
    Linear { value: ExprId, by: [ExprId; 2], square: Option<ExprId> },
}

/// A part that is solved at once.
#[derive(Clone, Debug)]
pub(super) struct Core {
    /// The rows; their expressions are those after all eliminations.
    pub(super) rows: Vec<usize>,
    /// The coordinates that the part gives.
    pub(super) coordinates: Vec<u32>,
    pub(super) method: SolutionMethod,
}

/// The method of solution of a core. Its expressions contain the coordinates of other parts as symbols.
#[derive(Clone, Debug)]
pub(super) enum SolutionMethod {
    /// A linear system matrix · x + constant = 0; the matrix is listed row by row.
    Linear { matrix: Vec<Vec<ExprId>>, constant: Vec<ExprId> },
    /// a cos nφ + b sin nφ = c, where n is `times`.
    Angle { times: i32, a: ExprId, b: ExprId, c: ExprId },
    /// a x² + b x + c = 0.
    Quadratic { a: ExprId, b: ExprId, c: ExprId },
    /// A circle e(x² + y²) + l·(x, y) + k = 0 and a line n·(x, y) + m = 0. If there is a `second` circle, which has this
    /// number in the place of e, the line is the common chord of both.
    Circle { e: ExprId, l: [ExprId; 2], k: ExprId, n: [ExprId; 2], m: ExprId, second: Option<ExprId> },
    /// Residuals that Newton's iteration brings to zero.
    Newton { residuals: Vec<ExprId> },
}

impl Block {
    /// The sum of a number over all cores.
    pub(super) fn sum(&self, number: &impl Fn(&Core) -> usize) -> usize {
        let part = |part: &BlockPart| match part {
            BlockPart::Core(core) => number(core),
            BlockPart::Block(block) => block.sum(number),
            BlockPart::Pair(pair) => pair.inner.sum(number),
        };
        self.parts.iter().map(part).sum()
    }
}

impl TermKey {
    /// The key of a power of a coordinate.
    pub(super) fn power(coordinate: u32, power: u8) -> Self {
        Self { powers: vec![(coordinate, power)], angle: Vec::new() }
    }
}
