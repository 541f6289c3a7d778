//! Forces: the reference files, and laws that hold for every machine.

mod batches;
mod contacts;
mod few_contacts;
mod laws;
mod machines;
mod pictures;
mod prescribed;
mod redundant;
mod references;
mod ropes;
mod squeezer;
mod typeset;
mod units;
