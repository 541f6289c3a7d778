//! Layout: expands families into instances, with their names and their indices in q.

use super::assembly::Assembly;
use super::pose::Pose;
use super::set::{BodyInstance, ConstraintSet, Coordinate, CoordinateKind, Family};
use crate::expr::{ExprId, Graph};
use crate::mechanism::{Component, Mechanism};
use std::collections::{BTreeSet, HashMap};

/// `name` or `name[index]`.
pub(crate) fn indexed(name: &str, is_array: bool, index: impl core::fmt::Display) -> String {
    if is_array { format!("{name}[{index}]") } else { name.to_owned() }
}

impl<'m> Assembly<'m> {
    /// An assembly in which all parameters, bodies and coordinates are laid out.
    pub(crate) fn new(mechanism: &'m Mechanism, set: &mut ConstraintSet) -> Self {
        let mut first_parameter = Vec::new();
        for parameter in &mechanism.parameters {
            first_parameter.push(set.parameters.len() as u32);
            for index in 0..parameter.len.unwrap_or(1) {
                set.parameters.push(indexed(&parameter.name, parameter.len.is_some(), index));
            }
        }
        let mut first_function = Vec::new();
        for function in &mechanism.functions {
            first_function.push(set.functions.len() as u32);
            let names = (0..function.len.unwrap_or(1)).map(|k| indexed(&function.name, function.len.is_some(), k));
            set.functions.extend(names);
        }
        let mut first_input = Vec::new();
        for input in &mechanism.inputs {
            first_input.push(set.inputs.len() as u32);
            set.inputs.extend((0..input.len.unwrap_or(1)).map(|k| indexed(&input.name, input.len.is_some(), k)));
        }
        let (mut first_body, mut coordinates_of) = (Vec::new(), Vec::new());
        for (family, body) in mechanism.bodies.iter().enumerate() {
            first_body.push(coordinates_of.len());
            if let Some(members) = body.len {
                let first = coordinates_of.len();
                set.body_families.push(Family { name: body.name.clone(), first, members, stride: 1 });
            }
            for index in 0..body.len.unwrap_or(1) {
                let name = indexed(&body.name, body.len.is_some(), index);
                let place = coordinates_of.len();
                let coordinates = Component::ALL.map(|component| {
                    body.is_free(component).then(|| {
                        set.coordinates.push(Coordinate {
                            name: format!("{name}.{component}"),
                            kind: CoordinateKind::Pose(place, component),
                            scales_with_length: component != Component::Phi,
                        });
                        set.coordinates.len() as u32 - 1
                    })
                });
                coordinates_of.push(coordinates);
                set.bodies.push(BodyInstance {
                    name,
                    family: (family, index),
                    coordinates,
                    carried_by: None,
                    carried_at: None,
                    pose: [ExprId::default(); 3],
                    observables: [0; 3],
                });
            }
        }
        let mut first_scalar = Vec::new();
        for scalar in &mechanism.scalars {
            first_scalar.push(set.coordinates.len() as u32);
            for index in 0..scalar.len.unwrap_or(1) {
                let name = indexed(&scalar.name, scalar.len.is_some(), index);
                // Scalars are looked at when the rows are known.
                set.coordinates.push(Coordinate { name, kind: CoordinateKind::Scalar, scales_with_length: false });
            }
        }
        let poses = vec![Pose::Unknown; coordinates_of.len()];
        let mut graph = Graph::new();
        let ground = [graph.zero(); 3];
        Self {
            mechanism,
            graph,
            ground,
            first_body,
            poses,
            coordinates_of,
            first_scalar,
            first_parameter,
            first_input,
            first_function,
            defines: HashMap::new(),
            index: 0,
            member: None,
            variables: Default::default(),
            at_rest: false,
            outline: None,
            distances: BTreeSet::new(),
            errors: Vec::new(),
        }
    }
}
