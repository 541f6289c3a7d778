//! What is proven: certificates, all closures, ranges and arcs.

mod arcs;
mod assemblies;
mod certificates;
mod ranges;
mod searched_ranges;
mod three_loops;
