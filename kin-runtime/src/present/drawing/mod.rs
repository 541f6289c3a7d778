//! A mechanism as a drawing that moves: links, pins, sliders, wheels, cams, the ground, and the paths of its points.
//!
//! A [`Scene`] is made of [`Carrier`]s. Each has a pose for every instant and parts that never change in its own frame,
//! so that showing the motion means only moving and turning carriers. Bodies are carriers, and so are the block of a
//! slider, which has its position on one body and the direction of another, the barrel and the rod of an actuator, and
//! belts.
//!
//! ```text
//! subject     poses and geometry of every instant, and where points stand
//! links       the shapes of bodies        slides, wheels, outlines, paths    what joints look like
//! arrows      forces and couples
//! part        lines, bars, circles, …     palette, labels    colours, and where names stand
//! view        from lengths to pixels      svg                the text
//! ```

mod arrows;
mod carrier;
mod joints;
mod labels;
mod links;
mod outlines;
mod palette;
mod part;
mod paths;
mod ropes;
mod scene;
mod slides;
mod subject;
mod svg;
mod teeth;
mod view;
mod wheels;

pub(crate) use carrier::Carrier;
pub(crate) use scene::Scene;
pub(crate) use subject::{Snapshot, Subject};
pub(crate) use svg::{animated, escaped, force_scale, round_below, still};
pub(crate) use view::View;
