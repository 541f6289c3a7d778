//! Motions followed instant by instant: by trackers and plans, with inputs, in batches, and up to limits.

mod batch;
mod close_folds;
mod coincident;
mod controller;
mod guesses;
mod guides;
mod hidden;
mod input_ranges;
mod inputs;
mod jumps;
mod larger;
mod late;
mod limits;
mod narrow;
mod orientations;
mod passing_pins;
mod plan_check;
mod planned;
mod poles;
mod ratios;
mod redundant;
mod row_ends;
mod special_dimensions;
mod steep_rows;
mod tracker;
mod transmission;
