//! The names that generated code uses. Not part of the public interface.

pub use crate::evaluation::curve::CurvePoint;
pub use crate::function::ScalarFunction;
pub use crate::generic::GenericMechanism;
pub use crate::mechanism::{LengthError, Mechanism, Observations, Workspace};
pub use crate::model::{
    Body, BodyInfo, Component, ConditionInfo, Coordinate, CoordinateInfo, CoordinateKind, DefineInfo, EffortInfo,
    EquationText, ForceModel, ForceUnits, Frame, GenericRedundancy, Geometry, Input, JointInfo, JointKind, Level,
    LineText, LoadInfo, MassInfo, Model, Observable, OperationCount, OriginKind, ParameterInfo, Pattern, Point,
    PointInfo, Quantity, ReactionInfo, Role, RowInfo, SpringInfo, StepText, Structure, Units,
};
pub use crate::plan::{Depth, ModeInfo, Plan, PlanStep, Solved, StepKind, coarseness, iterate};
pub use crate::scalar::{Interval, Scalar};
pub use crate::signal::{Instant, Signal};
pub use crate::tables;
pub use crate::workspace::{Evaluation, Subset};
pub use core::default::Default;
pub use core::option::Option::{self, None, Some};
pub use core::result::Result::{self, Err, Ok};
pub use kin_core::vocabulary::UnknownKind;
#[cfg(feature = "equations")]
pub use kin_derive::documentation;

/// The names of local variables and arguments in generated code, as functions that its blocks import.
///
/// A `let` cannot shadow a constant or static of the same name in the user's module, since such a name is a pattern. An
/// imported function hides that item within the block, and a `let` can shadow a function.
pub mod locals {
    macro_rules! names {
        ($($name:ident)*) => { $(pub const fn $name() {})* };
    }
    names! {
        acceleration arguments at b branches closeness correction curves depth eta factors forces gamma generalized
        geometry guesses index joint k lengths loads margins modes observations out p parameters phi phi_q phi_t
        position q q_ddot q_dot right s saved solved start subset t turns u unknowns value velocity workspace x
    }
}

/// `slice` as an array, or an error if its length is wrong.
#[inline(always)]
pub fn fixed<'a, T, const N: usize>(what: &'static str, slice: &'a [T]) -> Result<&'a [T; N], LengthError> {
    slice.try_into().map_err(|_| LengthError { what, expected: N, found: slice.len() })
}

/// `slice` as a mutable array, or an error if its length is wrong.
#[inline(always)]
pub fn fixed_mut<'a, T, const N: usize>(what: &'static str, slice: &'a mut [T]) -> Result<&'a mut [T; N], LengthError> {
    let found = slice.len();
    slice.try_into().map_err(|_| LengthError { what, expected: N, found })
}

/// Called in the body of a loop over the members of a family. With AVX-512 it keeps the compiler from computing several
/// members in one vector: the numbers of neighbouring members are far apart in memory, so that such a loop would use
/// gathers and scatters, which take longer than one member after the other. Without AVX-512 there are no scatter
/// instructions, and compilers choose well.
#[inline(always)]
pub fn one_by_one() {
    if cfg!(target_feature = "avx512f") {
        // Compiles to no instruction, but the compiler may not move reads and writes of memory across it.
        core::hint::black_box(());
    }
}

/// A parameter: a field that holds a number, or an element of an array field.
///
/// Arrays are no parameters: what the macro takes for a single number, because its type is the name of an array type, is
/// an error.
#[diagnostic::on_unimplemented(
    message = "a parameter is a number, or an array of numbers whose length the struct shows, and `{Self}` is neither",
    label = "`f64`, `f32`, or an array of them, `[f64; 3]`",
    note = "a field that holds a function is declared with `#[function(name)]` above the struct"
)]
pub trait Parameter {
    /// The number.
    fn get(&self) -> f64;
    /// Sets the number.
    fn set(&mut self, value: f64);
    /// The number `value` in this type.
    fn from_value(value: f64) -> Self;
}

impl Parameter for f64 {
    #[inline(always)]
    fn get(&self) -> f64 {
        *self
    }
    fn set(&mut self, value: f64) {
        *self = value;
    }
    fn from_value(value: f64) -> Self {
        value
    }
}

impl Parameter for f32 {
    #[inline(always)]
    fn get(&self) -> f64 {
        f64::from(*self)
    }
    fn set(&mut self, value: f64) {
        *self = value as f32;
    }
    fn from_value(value: f64) -> Self {
        value as f32
    }
}

/// The test that `#[mechanism(cross_check)]` writes: it compares every closed form with dual numbers.
///
/// # Errors
/// The worst entry, as text, when they disagree by more than 1e-12 or cannot be compared.
#[cfg(feature = "std")]
pub fn cross_check<M: Mechanism>(mechanism: &M) -> Result<(), std::string::String> {
    use std::string::ToString;
    let check = crate::kinematics::Kinematics::cross_check(mechanism).map_err(|error| error.to_string())?;
    if check.passes(1e-12) { Ok(()) } else { Err(check.to_string()) }
}
