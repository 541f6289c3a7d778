//! The vocabulary of `#[mechanism]`: for each kind its equation, its rows, a sketch and an example.
//!
//! In all of it r_P = r_i + A_i s′ is a point P of body i, A(φ) = [[cos φ, −sin φ], [sin φ, cos φ]],
//! perp(v) = (−v_y, v_x), v̂ = v/|v| (normalised by kin), and the first operand belongs to body i, the second to body j.
//! The examples are compiled and compared with dual numbers by the tests.
//!
//! - [`all`]: every attribute in one table, formulas, flags, and conventions;
//! - [`parts`]: bodies, coordinates, points, defines, guesses, families;
//! - [`joints`]: revolute, translational, fixed, point on line;
//! - [`relations`]: distances, absolute and relative coordinates;
//! - [`gears`]: gears, belts, racks, rolling discs;
//! - [`equations`]: free equations and drivers;
//! - [`functions`]: supplied functions, splines, motion laws;
//! - [`curves`]: cams, followers, contacts with curves;
//! - [`inputs`]: signals known only at run time;
//! - [`velocity`]: knife edges, speeds and other rows of velocity level;
//! - [`loads`]: masses, gravity, forces, couples, springs;
//! - [`unilateral`]: inequalities that are monitored during a motion;
//! - [`units`]: units of parameters, inputs, coordinates and defines, and that they agree.
//!
//! These modules hold documentation only.

#[doc(alias("attributes", "reference", "cheat sheet", "formula", "conventions", "signs"))]
#[doc = include_str!("all.md")]
pub mod all {}
#[doc(alias("cam", "follower", "slot", "roller"))]
#[doc = include_str!("curves.md")]
pub mod curves {}
#[doc(alias("constraint", "driver", "motor", "free equation"))]
#[doc = include_str!("equations.md")]
pub mod equations {}
#[doc(alias("spline", "motion law", "cam table", "profile"))]
#[doc = include_str!("functions.md")]
pub mod functions {}
#[doc(alias("gear", "belt", "rack", "pinion", "planetary", "rolling", "screw", "wheel"))]
#[doc = include_str!("gears.md")]
pub mod gears {}
#[doc(alias("signal", "sensor", "measured"))]
#[doc = include_str!("inputs.md")]
pub mod inputs {}
#[doc(alias("revolute", "hinge", "pin", "prismatic", "slider", "weld", "slot"))]
#[doc = include_str!("joints.md")]
pub mod joints {}
#[doc(alias("body", "point", "guess", "family", "array", "define"))]
#[doc = include_str!("parts.md")]
pub mod parts {}
#[doc(alias("mass", "gravity", "force", "torque", "couple", "spring", "damper", "load", "inertia"))]
#[doc = include_str!("loads.md")]
pub mod loads {}
#[doc(alias("distance", "rod", "rope", "cylinder", "actuator"))]
#[doc = include_str!("relations.md")]
pub mod relations {}
#[doc(alias("limit", "limits", "end stop", "inequality", "event", "range"))]
#[doc = include_str!("unilateral.md")]
pub mod unilateral {}
#[doc(alias("metre", "millimetre", "degrees", "dimension"))]
#[doc = include_str!("units.md")]
pub mod units {}
#[doc(alias("knife edge", "nonholonomic", "wheel", "rolling without slipping"))]
#[doc = include_str!("velocity.md")]
pub mod velocity {}
