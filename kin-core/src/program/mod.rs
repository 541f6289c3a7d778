//! Straight-line programs in which every value is computed once and shared by all outputs.
//!
//! This module depends on `expr` only.

mod display;
mod group_atan2;
mod lower;
mod reassociate;
mod roll;
mod signs;
mod value_numbering;

pub use group_atan2::group_atan2;
pub use lower::lower;
pub use roll::{Angles, Keep, OperandSource, Piece, ResultPart, Rolled, RolledStep, Worth, finished, roll};

use crate::expr::{Bits, Symbol};
use crate::vocabulary::Function;
use crate::vocabulary::OperationCount;

/// A value of a program: the index of the instruction that computes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(pub u32);

impl ValueId {
    /// The index of the instruction.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instruction {
    /// A literal.
    Number(Bits),
    /// The value of a symbol.
    Load(Symbol),
    /// −a.
    Neg(ValueId),
    /// a + b.
    Add(ValueId, ValueId),
    /// a − b.
    Sub(ValueId, ValueId),
    /// a · b.
    Mul(ValueId, ValueId),
    /// a / b.
    Div(ValueId, ValueId),
    /// The sine and cosine of an angle, computed together.
    SinCos(ValueId),
    /// The sine of a pair.
    SinOf(ValueId),
    /// The cosine of a pair.
    CosOf(ValueId),
    /// A function other than sine and cosine.
    Call(Function, ValueId),
    /// The sign of a, ±1.
    Sign(ValueId),
    /// atan2(y, x).
    Atan2(ValueId, ValueId),
    /// The angle a + 2πn that is nearest to b.
    Nearest(ValueId, ValueId),
    /// a to an integer power.
    Powi(ValueId, i32),
    /// a to a real constant power.
    Powf(ValueId, Bits),
    /// A supplied function with its first two derivatives, computed together.
    Supplied(u32, ValueId),
    /// The value (0), first (1) or second (2) derivative of a supplied function.
    SuppliedOf(ValueId, u8),
}

impl Instruction {
    /// Calls `f` on every operand.
    pub fn for_each_operand(&self, mut f: impl FnMut(ValueId)) {
        match *self {
            Self::Number(_) | Self::Load(_) => {}
            Self::Neg(a)
            | Self::SinCos(a)
            | Self::SinOf(a)
            | Self::CosOf(a)
            | Self::Call(_, a)
            | Self::Sign(a)
            | Self::Powi(a, _)
            | Self::Powf(a, _)
            | Self::Supplied(_, a)
            | Self::SuppliedOf(a, _) => f(a),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Atan2(a, b)
            | Self::Nearest(a, b) => {
                f(a);
                f(b);
            }
        }
    }

    /// The same instruction with other operands.
    pub fn map_operands(self, f: impl Fn(ValueId) -> ValueId) -> Self {
        match self {
            Self::Number(_) | Self::Load(_) => self,
            Self::Neg(a) => Self::Neg(f(a)),
            Self::Add(a, b) => Self::Add(f(a), f(b)),
            Self::Sub(a, b) => Self::Sub(f(a), f(b)),
            Self::Mul(a, b) => Self::Mul(f(a), f(b)),
            Self::Div(a, b) => Self::Div(f(a), f(b)),
            Self::SinCos(a) => Self::SinCos(f(a)),
            Self::SinOf(a) => Self::SinOf(f(a)),
            Self::CosOf(a) => Self::CosOf(f(a)),
            Self::Call(g, a) => Self::Call(g, f(a)),
            Self::Sign(a) => Self::Sign(f(a)),
            Self::Atan2(a, b) => Self::Atan2(f(a), f(b)),
            Self::Nearest(a, b) => Self::Nearest(f(a), f(b)),
            Self::Powi(a, n) => Self::Powi(f(a), n),
            Self::Powf(a, n) => Self::Powf(f(a), n),
            Self::Supplied(g, a) => Self::Supplied(g, f(a)),
            Self::SuppliedOf(a, order) => Self::SuppliedOf(f(a), order),
        }
    }
}

/// Defines the arrays that outputs are written to, with their printed names.
macro_rules! slots {
    ($($(#[$doc:meta])* $array:ident $name:literal,)+) => {
        /// Where an output is written: an array and an index.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Slot {
            $($(#[$doc])* $array(usize),)+
        }

        impl Slot {
            /// The index in the array.
            pub const fn index(self) -> usize {
                match self {
                    $(Self::$array(k))|+ => k,
                }
            }

            /// The slot of the same array at index `k`.
            pub const fn at(self, k: usize) -> Self {
                match self {
                    $(Self::$array(_) => Self::$array(k),)+
                }
            }
        }

        impl core::fmt::Display for Slot {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self {
                    $(Self::$array(k) => write!(f, concat!($name, "[{}]"), k),)+
                }
            }
        }
    };
}

slots! {
    /// An entry of Φ.
    Phi "Φ",
    /// A non-zero entry of Φ_q, by its index in the sparsity pattern.
    PhiQ "Φ_q",
    /// An entry of Φ_t.
    PhiT "Φ_t",
    /// An entry of γ.
    Gamma "γ",
    /// An entry of a plain list (geometry, guesses).
    Entry "",
    /// An entry of q in a solution.
    Position "q",
    /// An entry of q̇ in a solution.
    Velocity "q_dot",
    /// An entry of q̈ in a solution.
    Acceleration "q_ddot",
    /// A margin of a solution.
    Margin "margin",
    /// A value that is saved for later parts of a solution.
    Saved "saved",
}

impl Instruction {
    /// Adds this instruction, executed `times` times, to the operation count.
    fn count(&self, count: &mut OperationCount, times: usize) {
        match self {
            Instruction::Number(_)
            | Instruction::Load(_)
            | Instruction::SinOf(_)
            | Instruction::CosOf(_)
            | Instruction::SuppliedOf(..) => {}
            Instruction::Neg(_) => count.neg += times,
            Instruction::Add(..) | Instruction::Sub(..) => count.add += times,
            Instruction::Mul(..) => count.mul += times,
            Instruction::Div(..) => count.div += times,
            Instruction::SinCos(_) => count.sincos += times,
            Instruction::Call(Function::Sqrt, _) => count.sqrt += times,
            Instruction::Call(..)
            | Instruction::Sign(_)
            | Instruction::Atan2(..)
            | Instruction::Nearest(..)
            | Instruction::Powi(..)
            | Instruction::Powf(..)
            | Instruction::Supplied(..) => count.function += times,
        }
    }
}

/// A straight-line program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Program {
    /// The instructions, operands first. Sines and cosines that do not depend on one another are adjacent, and after
    /// [`group_atan2`] so are atan2 instructions.
    pub instructions: Vec<Instruction>,
    /// The value of every output, in the order given to [`lower`].
    pub outputs: Vec<(Slot, ValueId)>,
}

impl Program {
    /// The operation count of one run.
    pub fn operations(&self) -> OperationCount {
        let mut count = OperationCount::default();
        self.instructions.iter().for_each(|instruction| instruction.count(&mut count, 1));
        count
    }
}
