//! The vocabulary of `#[mechanism]`: for each kind its equation, its rows, a sketch and an example.
//!
//! In all of it r_P = r_i + A_i s′ is a point P of body i, A(φ) = [[cos φ, −sin φ], [sin φ, cos φ]],
//! perp(v) = (−v_y, v_x), v̂ = v/|v| (normalised by kin), and the first operand belongs to body i, the second to body j.
//! The examples are compiled and compared with dual numbers by the tests.
//!
//! - [`parts`]: bodies, coordinates, points, defines, guesses, families;
//! - [`joints`]: revolute, translational, fixed, point on line;
//! - [`relations`]: distances, absolute and relative coordinates;
//! - [`gears`]: gears, belts, racks, rolling discs;
//! - [`equations`]: free equations and drivers;
//! - [`functions`]: supplied functions, splines, motion laws;
//! - [`curves`]: cams, followers, contacts with curves;
//! - [`inputs`]: signals known only at run time;
//! - [`velocity`]: knife edges, speeds and other rows of velocity level;
//! - [`unilateral`]: inequalities that are watched along a motion;
//! - [`units`]: units of parameters, inputs, coordinates and defines, and that they agree.
//!
//! These modules hold documentation only.

#[doc = include_str!("curves.md")]
pub mod curves {}
#[doc = include_str!("equations.md")]
pub mod equations {}
#[doc = include_str!("functions.md")]
pub mod functions {}
#[doc = include_str!("gears.md")]
pub mod gears {}
#[doc = include_str!("inputs.md")]
pub mod inputs {}
#[doc = include_str!("joints.md")]
pub mod joints {}
#[doc = include_str!("parts.md")]
pub mod parts {}
#[doc = include_str!("relations.md")]
pub mod relations {}
#[doc = include_str!("unilateral.md")]
pub mod unilateral {}
#[doc = include_str!("units.md")]
pub mod units {}
#[doc = include_str!("velocity.md")]
pub mod velocity {}
