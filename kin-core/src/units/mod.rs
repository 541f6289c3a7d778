//! Units: parses them, checks them wherever quantities are added, compared or equated, and derives those of results.
//!
//! kin computes with plain numbers in any consistent units. Rules:
//!
//! - Lengths, times, masses and angles; an angle is a number, and radians are its unit. Different scales of one kind
//!   (mm and m, deg and rad) are inconsistent.
//! - x and y of bodies and points, and distances, are lengths in the unit of length that most of the written units
//!   contain; φ is an angle; t is a time in the unit of time that most of them contain, or s; `dot` divides by the unit of t.
//! - A plain number takes the unit that its context needs: in `l + 0.1` it is a length, in `2*l` a factor. Products of
//!   a number with t or with another number, as in `2*t` and `0.1*sin(a)`, take any unit, too; those with an angle, as in
//!   `2*phi`, any but degrees and turns. A factor that is typical of conversions (powers of ten, 12, 25.4, 30, 60, 180, …)
//!   leaves the scale open: `l_mm/1000`, `n*2*pi/60`.
//! - t alone takes any unit, too, as in `phi = t`; multiplied by a quantity with a unit it is a time.
//! - Parameters, scalar coordinates, inputs and defines without a unit, and supplied functions, agree with every unit; a
//!   scalar coordinate or an input with the same one in every place.
//! - Arguments of sin, cos, tan, asin, acos, atan, exp and ln are numbers; so are their results.

#[cfg(feature = "compiler")]
mod check;
#[cfg(feature = "compiler")]
mod checker;
#[cfg(feature = "compiler")]
mod conversion;
#[cfg(feature = "compiler")]
mod derived;
#[cfg(feature = "compiler")]
mod forces;
mod parse;
#[cfg(feature = "compiler")]
mod product;
#[cfg(feature = "compiler")]
mod quantity;
mod text;
#[cfg(feature = "compiler")]
mod turns;
mod unit;

#[cfg(feature = "compiler")]
pub use check::check;
#[cfg(feature = "compiler")]
pub use derived::{Units, are_written, derive};
#[cfg(feature = "compiler")]
pub use forces::{ForceUnits, force_units};
pub use parse::{AngleFactor, UnknownUnit, angle_factor, parse};
pub use unit::Unit;
