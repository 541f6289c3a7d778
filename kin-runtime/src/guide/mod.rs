//! A short book: from the lecture's four-bar to a controller, and into the works.
//!
//! The tests compile and run every mechanism of the book, and run every command that it gives to one.
//!
//! 1. [From configuration to acceleration](lecture): the lecture's path, by hand, with its four-bar;
//! 2. [Writing a mechanism](writing): from a sketch to a description that runs;
//! 3. [Choosing frames and coordinates](frames): the same motion with fewer coordinates and operations;
//! 4. [Drivers and inputs](driving): what moves it, and what is known only at run time;
//! 5. [Reading errors](errors): of the compiler, and of an analysis;
//! 6. [Singular positions and assembly modes](singular): where a mechanism may go two ways, or none;
//! 7. [Studies and pictures](studies): sweeps, many dimensions at once, diagrams, animations;
//! 8. [In a controller](controller): no allocator, no `std`, one answer per tick;
//! 9. [How the derivation works](derivation): from tokens to straight-line code;
//! 10. [Adding a constraint](constraint): for contributors.
//!
//! The language itself, word by word, is in [`vocabulary`](crate::vocabulary). These modules hold documentation only.

#[doc = include_str!("constraint.md")]
pub mod constraint {}
#[doc = include_str!("controller.md")]
pub mod controller {}
#[doc = include_str!("derivation.md")]
pub mod derivation {}
#[doc = include_str!("driving.md")]
pub mod driving {}
#[doc = include_str!("errors.md")]
pub mod errors {}
#[doc = include_str!("frames.md")]
pub mod frames {}
#[doc = include_str!("lecture.md")]
pub mod lecture {}
#[doc = include_str!("singular.md")]
pub mod singular {}
#[doc = include_str!("studies.md")]
pub mod studies {}
#[doc = include_str!("writing.md")]
pub mod writing {}
