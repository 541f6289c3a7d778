//! Studies on many machines, by Ballista: a scheduler, workers, and a client that hands out the rows.
//!
//! All three are the program of `kin_study::main`, started with different arguments: a worker has the mechanism
//! compiled in, and gets the study as text. The client cuts the rows into waves of some seconds, merges the results of
//! the workers, and writes the same files as a run on one machine.
//!
//! Scheduler and workers accept every connection: they have no passwords and no encryption, and must run in a network
//! whose machines trust one another. They listen on the loopback interface unless another one is given.

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
