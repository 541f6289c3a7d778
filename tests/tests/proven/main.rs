//! Proofs: certificates, all closures and ranges; and arcs of solution curves.

mod arcs;
mod assemblies;
mod bounds;
mod certificates;
mod choices;
mod claims;
mod classes;
mod complex_closures;
mod elimination;
mod lifts;
mod neighbouring_places;
mod ranges;
mod residues;
mod searched_ranges;
mod stephenson;
mod three_loops;
mod unknown_geometry;
mod vanishing_lengths;
