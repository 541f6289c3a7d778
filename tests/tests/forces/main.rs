//! Forces: the reference files, and laws that hold for every machine.

mod laws;
mod machines;
mod references;
