//! What descriptions can contain, and the results and errors for it: families, frames, units, lengths, functions.

mod designer;
mod edges;
mod moving_frames;
mod named_groups;
mod negative_lengths;
mod plot;
mod publishing;
mod random_linkages;
mod reference;
mod repetition;
mod structure;
mod supplied;
mod units;
