//! Studies on many machines, by Ballista: a scheduler, workers, and a client that hands out the rows.
//!
//! All three are the program that `kin_study::main` makes, started with other arguments: a worker knows the mechanism because
//! it is compiled in, and gets the study as its text. The client cuts the rows into waves of some seconds, merges what the
//! workers send, and writes the same files as a run on one machine.
//!
//! Scheduler and workers accept whatever reaches them: they have no passwords and no encryption, and must stand in a network
//! whose machines trust one another. They listen on the loopback interface unless they are told otherwise.

mod client;
mod function;
mod parcel;
mod presence;
mod roles;
mod submission;

/// The largest message between the members of a cluster, in bytes.
const MESSAGE: u32 = 64 << 20;

pub use client::{Cluster, run_on};
pub use roles::{Listen, Standing, scheduler, worker};
