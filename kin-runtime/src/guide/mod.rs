//! A short book: from a first mechanism and the lecture's four-bar to a controller, and into the works.
//!
//! The tests compile and run every mechanism of the book, and run every command that it gives to one.
//!
//! 1. [A mechanism of your own](chapter_01_start): from an empty crate to a drawing that moves;
//! 2. [From configuration to acceleration](chapter_02_lecture): the lecture's path, by hand, with its four-bar;
//! 3. [Writing a mechanism](chapter_03_writing): from a sketch to a description that runs;
//! 4. [Choosing frames and coordinates](chapter_04_frames): the same motion with fewer coordinates and operations;
//! 5. [Drivers and inputs](chapter_05_driving): what moves it, and what is known only at run time;
//! 6. [Reading errors](chapter_06_errors): of the compiler, and of an analysis;
//! 7. [Singular positions and assembly modes](chapter_07_singular): where a mechanism may go two ways, or none;
//! 8. [Forces](chapter_08_forces): what drivers must supply, what joints carry;
//! 9. [Studies and pictures](chapter_09_studies): sweeps, many dimensions at once, diagrams, animations;
//! 10. [In a controller](chapter_10_controller): no allocator, no `std`, one answer per tick;
//! 11. [In a program of your own](chapter_11_program): what the macro adds to your struct, results, features;
//! 12. [How kin solves a mechanism](chapter_12_solving): the steps that an expert would take;
//! 13. [How the derivation works](chapter_13_derivation): from tokens to straight-line code;
//! 14. [Adding a constraint](chapter_14_constraint): for contributors;
//! 15. [What is not there](chapter_15_limits): space, contact, friction;
//! 16. [Proofs](chapter_16_proofs): certificates, all ways in which a mechanism closes, and how far it moves;
//! 17. [Designing](chapter_17_designing): dimensions that do what is wanted, from places on a table to a drawing.
//!
//! The language itself, attribute by attribute, is in [`vocabulary`](crate::vocabulary). These modules hold documentation only;
//! their numbers keep them in order beside the text.

#[doc(alias("getting started", "quick start", "template", "tutorial", "install"))]
#[doc = include_str!("start.md")]
pub mod chapter_01_start {}
#[doc(alias("four-bar", "fourbar", "Jacobian", "Newton", "constraint equations", "textbook"))]
// The picture as an address; on a page of its own the Markdown names the file. The first of the two counts.
#[doc = include_str!("four_bar.md")]
#[doc = include_str!("lecture.md")]
pub mod chapter_02_lecture {}
#[doc(alias("press", "toggle", "joints", "driver", "chain", "array"))]
#[doc = include_str!("writing.md")]
pub mod chapter_03_writing {}
#[doc(alias("coordinates", "slider-crank", "relative coordinates", "global method", "local method"))]
#[doc = include_str!("frames.md")]
pub mod chapter_04_frames {}
#[doc(alias("motor", "actuator", "cylinder", "sensor", "input", "prescribed motion"))]
#[doc = include_str!("driving.md")]
pub mod chapter_05_driving {}
#[doc(alias("error", "diagnostics", "message", "over-constrained", "redundant", "degrees of freedom", "mobility"))]
#[doc = include_str!("errors.md")]
pub mod chapter_06_errors {}
#[doc(alias(
    "singularity",
    "dead centre",
    "dead center",
    "toggle position",
    "branch",
    "limit",
    "limits",
    "transmission angle",
    "change point",
    "assembly mode"
))]
#[doc = include_str!("singular.md")]
pub mod chapter_07_singular {}
#[doc(alias(
    "force",
    "forces",
    "torque",
    "effort",
    "reaction",
    "pin force",
    "inverse dynamics",
    "kinetostatics",
    "statics",
    "inertia",
    "mass",
    "gravity",
    "spring",
    "damper",
    "shaking force",
    "balancing",
    "power",
    "virtual work",
    "dynamics"
))]
#[doc = include_str!("forces.md")]
pub mod chapter_08_forces {}
#[doc(alias(
    "study",
    "parameter study",
    "design study",
    "sweep",
    "optimisation",
    "optimization",
    "sensitivity",
    "Monte Carlo",
    "plot",
    "diagram",
    "animation",
    "path",
    "jerk"
))]
#[doc = include_str!("studies.md")]
pub mod chapter_09_studies {}
#[doc(alias("real time", "embedded", "no_std", "control loop", "tick", "microcontroller", "f32"))]
#[doc = include_str!("controller.md")]
pub mod chapter_10_controller {}
#[doc(alias("features", "handles", "results", "state", "trajectory", "API", "serde"))]
#[doc = include_str!("program.md")]
pub mod chapter_11_program {}
#[doc(alias("solution plan", "dyad", "Assur group", "closed form", "batch", "performance"))]
#[doc = include_str!("solving.md")]
pub mod chapter_12_solving {}
#[doc(alias("differentiation", "code generation", "symbolic", "macro", "expression"))]
#[doc = include_str!("derivation.md")]
pub mod chapter_13_derivation {}
#[doc(alias("contributing", "new joint", "extend"))]
#[doc = include_str!("constraint.md")]
pub mod chapter_14_constraint {}
#[doc(alias(
    "friction",
    "forward dynamics",
    "impact",
    "collision",
    "3D",
    "spatial",
    "synthesis",
    "tolerance",
    "CAD",
    "limitations",
    "missing"
))]
#[doc = include_str!("limits.md")]
pub mod chapter_15_limits {}
#[doc(alias(
    "certificate",
    "proof",
    "interval arithmetic",
    "Krawczyk",
    "interval Newton",
    "assembly modes",
    "closures",
    "forward kinematics",
    "branch and prune"
))]
#[doc = include_str!("proofs.md")]
pub mod chapter_16_proofs {}
#[doc(alias("design", "synthesis", "optimisation", "optimization", "coupler curve", "path generation", "tolerance"))]
#[doc = include_str!("designing.md")]
pub mod chapter_17_designing {}
