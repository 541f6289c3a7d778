//! Derivatives with respect to parameters, compared with the reference files and with finite differences of the motion.

mod batches;
mod command;
mod laws;
mod machines;
mod overflow;
mod references;
mod repeated;
mod undetermined;
mod varied;
