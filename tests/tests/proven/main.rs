//! What is proven: certificates, all closures, ranges and arcs.

mod arcs;
mod assemblies;
mod certificates;
mod choices;
mod classes;
mod complex_closures;
mod elimination;
mod ranges;
mod residues;
mod searched_ranges;
mod three_loops;
