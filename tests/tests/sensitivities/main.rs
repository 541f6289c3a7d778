//! Derivatives by parameters: against the reference files, and against finite differences of the motion.

mod batches;
mod command;
mod laws;
mod machines;
mod references;
