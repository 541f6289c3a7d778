//! Derivatives by parameters: against the reference files, and against the motion solved again.

mod command;
mod laws;
mod machines;
mod references;
