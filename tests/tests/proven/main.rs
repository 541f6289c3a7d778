//! What is proven: certificates, all closures, ranges and arcs.

mod arcs;
mod assemblies;
mod certificates;
mod ranges;
mod three_loops;
