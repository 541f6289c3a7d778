//! The nodes of the expression graph.

use crate::vocabulary::Function;

/// An expression: an index of the [`Graph`](super::Graph)'s arena. Equal ids mean equal expressions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ExprId(pub(crate) u32);

impl ExprId {
    /// The index in the arena.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The highest order of derivatives of inputs and supplied functions that the caller supplies: value, rate,
/// acceleration.
pub const MAX_ORDER: u8 = 2;

/// A symbol: a quantity whose value is given to an evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A parameter; array fields are numbered element by element.
    Parameter(u32),
    /// Time t.
    Time,
    /// A declared input: its value, rate or acceleration (order 0, 1, 2). Differentiation may produce a higher order,
    /// up to twice the highest; [`differentiate`](crate::system::differentiate) reports an error if a result contains
    /// one.
    Input(u32, u8),
    /// A generalized coordinate q_k; or [`ARGUMENT`](Self::ARGUMENT), which a `match` must therefore list before this
    /// variant.
    Coordinate(u32),
    /// The rate q̇_k of a coordinate.
    Rate(u32),
    /// The acceleration q̈_k of a coordinate, used for forces only.
    Acceleration(u32),
    /// The sign, ±1, of an assembly mode. This and the following symbols occur only in the programs of a solution
    /// plan.
    Mode(u32),
    /// The start value of q_k: angles are taken within half a turn of it, and iterations start from it.
    Start(u32),
    /// An unknown of an iteration: its current value and, after the iteration, its solution.
    Unknown(u32),
    /// A value that an earlier part of the solution has stored.
    Saved(u32),
    /// Entry b_k of the right-hand side of Φ_q x = b.
    Right(u32),
    /// The factor by which squared tolerances of the scalar type are larger than those of `f64`; 1 for `f64`.
    Coarseness,
}

/// The index of a curve's argument, which is treated as a coordinate but is not part of q.
const ARGUMENT: u32 = u32::MAX;

impl Symbol {
    /// The free argument of a curve. It is a coordinate that is not part of q, so that [`partial`](super::partial)
    /// differentiates with respect to it as with respect to any other.
    pub const ARGUMENT: Self = Self::Coordinate(ARGUMENT);

    /// The index of the symbol in its array; 0 for time.
    pub const fn index(self) -> u32 {
        match self {
            Self::Time | Self::Coarseness => 0,
            Self::Parameter(k)
            | Self::Input(k, _)
            | Self::Coordinate(k)
            | Self::Rate(k)
            | Self::Acceleration(k)
            | Self::Mode(k)
            | Self::Start(k)
            | Self::Unknown(k)
            | Self::Saved(k)
            | Self::Right(k) => k,
        }
    }

    /// The symbol at index `k` of the same array.
    pub const fn at(self, k: u32) -> Self {
        match self {
            Self::Time => Self::Time,
            Self::Parameter(_) => Self::Parameter(k),
            Self::Input(_, order) => Self::Input(k, order),
            Self::Coordinate(_) => Self::Coordinate(k),
            Self::Rate(_) => Self::Rate(k),
            Self::Acceleration(_) => Self::Acceleration(k),
            Self::Mode(_) => Self::Mode(k),
            Self::Start(_) => Self::Start(k),
            Self::Unknown(_) => Self::Unknown(k),
            Self::Saved(_) => Self::Saved(k),
            Self::Right(_) => Self::Right(k),
            Self::Coarseness => Self::Coarseness,
        }
    }

    /// The name of a symbol that occurs only in solution plans.
    pub(crate) fn of_plan(self) -> String {
        match self {
            Self::Mode(k) => format!("mode{k}"),
            Self::Start(k) => format!("start{k}"),
            Self::Unknown(k) => format!("unknown{k}"),
            Self::Saved(k) => format!("saved{k}"),
            Self::Right(k) => format!("right{k}"),
            Self::Coarseness => "coarseness".to_owned(),
            _ => String::new(),
        }
    }
}

/// A finite number, compared and hashed by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bits(u64);

impl Bits {
    /// The bits of a number; −0 is stored as 0, so that zero has one representation.
    pub fn new(value: f64) -> Self {
        Self(if value == 0.0 { 0 } else { value.to_bits() })
    }

    /// True for the number 0.
    pub const fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// The number.
    pub fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// An operation on expressions.
///
/// `RotX`, `RotY` are the components of a rotated body vector ρ = A(φ)·s, kept as one node so that its derivative is
/// φ̇ perp(ρ) and not a sum of four products. `Dot` and `Cross` are u·d and u×d = perp(u)·d of a unit vector u that
/// turns with φ and any vector d, kept as nodes for the same reason: each is the derivative of the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// A literal.
    Number(Bits),
    /// A symbol.
    Symbol(Symbol),
    /// −a.
    Neg(ExprId),
    /// a + b.
    Add(ExprId, ExprId),
    /// a − b.
    Sub(ExprId, ExprId),
    /// a · b.
    Mul(ExprId, ExprId),
    /// a / b.
    Div(ExprId, ExprId),
    /// a to an integer power.
    Powi(ExprId, i32),
    /// a to a real constant power.
    Powf(ExprId, Bits),
    /// A function of one argument.
    Call(Function, ExprId),
    /// The sign of a, ±1: the derivative of |a|.
    Sign(ExprId),
    /// atan2(y, x).
    Atan2(ExprId, ExprId),
    /// The angle a + 2πn that is nearest to b.
    Nearest(ExprId, ExprId),
    /// The value a as an opaque unit: sums and products with it are not rearranged together with the parts of a.
    Opaque(ExprId),
    /// cos φ·s_x − sin φ·s_y.
    RotX(Rotation),
    /// sin φ·s_x + cos φ·s_y.
    RotY(Rotation),
    /// u·d.
    Dot(Turning),
    /// u_x d_y − u_y d_x.
    Cross(Turning),
    /// A supplied function or its first or second derivative (order 0, 1, 2) at an argument.
    Supplied(u32, u8, ExprId),
}

/// A body-fixed vector s turned by the angle φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rotation {
    /// The angle φ.
    pub angle: ExprId,
    /// The component s_x.
    pub x: ExprId,
    /// The component s_y.
    pub y: ExprId,
}

/// A unit vector u = A(φ)·v̂ and a vector d.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Turning {
    /// The angle φ that u rotates with.
    pub angle: ExprId,
    /// The vector u.
    pub u: [ExprId; 2],
    /// The vector d.
    pub d: [ExprId; 2],
}

impl Node {
    /// Calls `f` on every operand.
    pub fn for_each_operand(&self, mut f: impl FnMut(ExprId)) {
        match *self {
            Self::Number(_) | Self::Symbol(_) => {}
            Self::Neg(a)
            | Self::Powi(a, _)
            | Self::Powf(a, _)
            | Self::Call(_, a)
            | Self::Sign(a)
            | Self::Opaque(a)
            | Self::Supplied(_, _, a) => f(a),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Atan2(a, b)
            | Self::Nearest(a, b) => {
                f(a);
                f(b);
            }
            Self::RotX(r) | Self::RotY(r) => {
                f(r.angle);
                f(r.x);
                f(r.y);
            }
            Self::Dot(t) | Self::Cross(t) => {
                f(t.angle);
                f(t.u[0]);
                f(t.u[1]);
                f(t.d[0]);
                f(t.d[1]);
            }
        }
    }
}

/// The kinds of symbols that an expression depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Depends(u8);

impl Depends {
    /// No symbols: a literal.
    pub const NOTHING: Self = Self(0);
    /// Parameters.
    pub const PARAMETER: Self = Self(1);
    /// Time.
    pub const TIME: Self = Self(2);
    /// Inputs.
    pub const INPUT: Self = Self(4);
    /// Coordinates.
    pub const COORDINATE: Self = Self(8);
    /// Rates of coordinates.
    pub const RATE: Self = Self(16);
    /// Symbols of a solution plan: modes, start values, unknowns, saved values.
    pub const PLAN: Self = Self(32);

    /// The union of both sets.
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// True if the sets have a common element.
    pub const fn on(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// True for literals and expressions of parameters, which are constant during a motion.
    pub const fn is_static(self) -> bool {
        self.0 & !Self::PARAMETER.0 == 0
    }

    /// True if the expression depends on t or on an input.
    pub const fn is_rheonomic(self) -> bool {
        self.on(Self(Self::TIME.0 | Self::INPUT.0))
    }

    pub(crate) const fn of(symbol: Symbol) -> Self {
        match symbol {
            Symbol::Parameter(_) => Self::PARAMETER,
            Symbol::Time => Self::TIME,
            Symbol::Input(..) => Self::INPUT,
            Symbol::Coordinate(_) => Self::COORDINATE,
            Symbol::Rate(_) | Symbol::Acceleration(_) => Self::RATE,
            Symbol::Mode(_)
            | Symbol::Start(_)
            | Symbol::Unknown(_)
            | Symbol::Saved(_)
            | Symbol::Right(_)
            | Symbol::Coarseness => Self::PLAN,
        }
    }
}
