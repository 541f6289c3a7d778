//! The static [`Model`] of a mechanism: names, rows, patterns, geometry.

use super::derivation;
use super::entries::{frame, optional, variant};
use super::instructions::literal;
use super::joints::joints;
use super::table::{Cell, Writer};
use kin_core::Kernels;
use kin_core::constraint::{Coordinate, CoordinateKind, ObservableKind};
use kin_core::kernels::Pattern;
use kin_core::mechanism::Mechanism;
use kin_core::plan::SolutionPlan;
use kin_core::structure::Structure;
use kin_core::system::KinematicSystem;
use kin_core::units::Units;
use kin_core::vocabulary::{Component, OperationCount, Role};
use proc_macro2::TokenStream;
use quote::quote;

/// The data from which the tables are printed.
pub(crate) struct Tables<'a> {
    pub(crate) mechanism: &'a Mechanism,
    pub(crate) system: &'a KinematicSystem,
    pub(crate) kernels: &'a Kernels,
    pub(crate) doc: &'a str,
    pub(crate) allow_redundant: bool,
    pub(crate) structure: &'a Structure,
    pub(crate) plan: &'a SolutionPlan,
}

/// The static model and the tables to which it refers.
pub(crate) fn model(tables: &Tables<'_>) -> TokenStream {
    let set = &tables.system.set;
    let (name, doc, allow_redundant) = (&set.name, tables.doc, tables.allow_redundant);
    let writer = writer(tables);
    let coordinates = coordinates(tables.system, writer);
    let parameters = parameters(tables.mechanism, &set.parameters, writer);
    let inputs = set.inputs.iter();
    let input_defaults = tables.mechanism.inputs.iter().flat_map(|input| {
        let default = optional(input.default.map(literal));
        std::iter::repeat_n(default, input.len.unwrap_or(1))
    });
    let units = units(tables.mechanism);
    let functions = set.functions.iter();
    let arguments = &tables.kernels.arguments;
    let bodies = bodies(tables.system, writer);
    let points = set.points.iter().map(|point| {
        let (name, frame, local, observables) = (&point.name, frame(point.frame), point.local, point.observables);
        quote! {
            __kin::PointInfo { name: #name, frame: #frame, local: #local, observables: [#(#observables),*] }
        }
    });
    let defines = set.defines.iter().map(|define| {
        let (name, observable, varies) = (&define.name, define.observable, define.varies);
        quote! { __kin::DefineInfo { name: #name, observable: #observable, varies: #varies } }
    });
    let joints = joints(tables.system, writer);
    let rows = rows(tables.system, writer);
    let observables = observables(tables.system, writer);
    let conditions = set.conditions.iter().map(|condition| {
        let (name, text, rheonomic) = (&condition.name, &condition.text, condition.rheonomic);
        let (observable, corners) = (condition.observable, condition.corners);
        quote! {
            __kin::ConditionInfo {
                name: #name, text: #text, observable: #observable, corners: #corners, rheonomic: #rheonomic,
            }
        }
    });
    let constraint_pattern = pattern(&tables.kernels.constraint_pattern, writer);
    let observable_pattern = pattern(&tables.kernels.observable_pattern, writer);
    let guesses = set.guesses.iter().map(|(k, _)| *k as usize);
    let geometry = set.geometry.len();
    let has_curves = set.joints.iter().any(|joint| joint.kind.follows_curve());
    let has_sizes = set.joints.iter().any(|joint| {
        let has_second_point = joint.geometry.iter().any(|entry| entry.role == Role::Q);
        joint.geometry.iter().any(|entry| joint.kind.may_degenerate(entry.role, has_second_point))
    });
    let operations = operations(tables.kernels.operations);
    let forces = match tables.kernels.force_operations {
        Some(_) => quote! { __kin::Some(&__FORCES) },
        None => quote! { __kin::None },
    };
    let equations = derivation::equations(tables.system);
    let solution = derivation::solution(tables.plan);
    let structure = structure(tables.system, tables.structure);
    let plan = super::steps::table(tables.plan, writer);
    let least_sizes = least_sizes(&set.coordinates, &tables.kernels.constraint_pattern);
    let least_sizes = least_sizes.iter().filter(|_| !writer.packed).map(|sizes| {
        let [of_lengths, of_others] = sizes.map(literal);
        quote! { [#of_lengths, #of_others] }
    });
    let model = quote! {
        __kin::Model {
            name: #name,
            doc: #doc,
            coordinates: #coordinates,
            parameters: #parameters,
            inputs: &[#(#inputs),*],
            input_defaults: &[#(#input_defaults),*],
            units: #units,
            functions: &[#(#functions),*],
            arguments: &[#(#arguments),*],
            bodies: #bodies,
            points: &[#(#points),*],
            defines: &[#(#defines),*],
            joints: #joints,
            rows: #rows,
            conditions: &[#(#conditions),*],
            constraint_pattern: #constraint_pattern,
            observables: #observables,
            observable_pattern: #observable_pattern,
            guesses: &[#(#guesses),*],
            geometry: #geometry,
            has_curves: #has_curves,
            has_sizes: #has_sizes,
            least_sizes: &[#(#least_sizes),*],
            allow_redundant: #allow_redundant,
            structure: __kin::Some(#structure),
            plan: #plan,
            operations: #operations,
            forces: #forces,
            equations: &[#(#equations),*],
            solution: &[#(#solution),*],
        }
    };
    if writer.packed {
        quote! { static __MODEL: __kin::tables::Unpacked = __kin::tables::unpacked!(#model); }
    } else {
        quote! { static __MODEL: __kin::Model = #model; }
    }
}

/// The writer, which packs tables if one of them is so long that literals would slow the compiler down.
fn writer(tables: &Tables<'_>) -> Writer {
    let set = &tables.system.set;
    let parameters = tables.mechanism.parameters.iter().map(|parameter| parameter.len.unwrap_or(1)).sum();
    let Kernels { constraint_pattern, observable_pattern, .. } = tables.kernels;
    Writer::of(&[
        set.coordinates.len(),
        set.rows.len(),
        set.joints.len(),
        parameters,
        set.bodies.len(),
        set.observables.len(),
        constraint_pattern.entries.len(),
        observable_pattern.entries.len(),
    ])
}

fn component(component: Component) -> TokenStream {
    variant("Component", component.variant())
}

fn coordinates(system: &KinematicSystem, writer: Writer) -> TokenStream {
    let entries = system.set.coordinates.iter().map(|coordinate| {
        let (body, component) = match coordinate.kind {
            CoordinateKind::Pose(body, component) => (body, Some(component)),
            CoordinateKind::Scalar => (0, None),
        };
        (component, [Cell::Name(&coordinate.name), Cell::Word(body)])
    });
    writer.table("coordinates", entries, |kind, [name, body]| {
        let kind = match kind.map(component) {
            Some(component) => quote! { __kin::CoordinateKind::Pose { body: #body, component: #component } },
            None => quote! { __kin::CoordinateKind::Scalar },
        };
        quote! { __kin::CoordinateInfo { name: #name, kind: #kind } }
    })
}

fn bodies(system: &KinematicSystem, writer: Writer) -> TokenStream {
    let entries = system.set.bodies.iter().map(|body| {
        let [x, y, phi] = body.coordinates.map(|k| Cell::Place(k.map(|k| k as usize)));
        let [seen_x, seen_y, seen_phi] = body.observables.map(Cell::Word);
        [Cell::Name(&body.name), x, y, phi, Cell::Origin(body.carried_by), seen_x, seen_y, seen_phi]
    });
    writer.alike("bodies", entries, |[name, x, y, phi, origin, seen_x, seen_y, seen_phi]| {
        quote! {
            __kin::BodyInfo {
                name: #name, coordinates: [#x, #y, #phi], origin: #origin, observables: [#seen_x, #seen_y, #seen_phi],
            }
        }
    })
}

fn observables(system: &KinematicSystem, writer: Writer) -> TokenStream {
    let entries = system.set.observables.iter().map(|observable| {
        let (kind, a, b) = match observable.kind {
            ObservableKind::Pose(body, c) => (ObservableKind::Pose(0, c), body, 0),
            ObservableKind::Point(point, c) => (ObservableKind::Point(0, c), point, 0),
            ObservableKind::Define(k) => (ObservableKind::Define(0), k, 0),
            ObservableKind::Joint(joint, quantity) => (ObservableKind::Joint(0, 0), joint, quantity),
            ObservableKind::Condition(k) => (ObservableKind::Condition(0), k, 0),
        };
        (kind, [a, b].map(Cell::Word))
    });
    writer.table("observables", entries, |kind, [a, b]| match *kind {
        ObservableKind::Pose(_, c) => {
            let c = component(c);
            quote! { __kin::Observable::Pose { body: #a, component: #c } }
        }
        ObservableKind::Point(_, c) => {
            let c = component(c);
            quote! { __kin::Observable::Point { point: #a, component: #c } }
        }
        ObservableKind::Define(_) => quote! { __kin::Observable::Define(#a) },
        ObservableKind::Joint(..) => quote! { __kin::Observable::Joint { joint: #a, quantity: #b } },
        ObservableKind::Condition(_) => quote! { __kin::Observable::Condition(#a) },
    })
}

fn units(mechanism: &Mechanism) -> TokenStream {
    let Units { length, time, named } = kin_core::units::derive(mechanism);
    let (length, time) = (optional(length), optional(time));
    let named = named.iter().map(|(name, unit)| quote! { (#name, #unit) });
    quote! { __kin::Units { length: #length, time: #time, named: &[#(#named),*] } }
}

fn parameters(mechanism: &Mechanism, names: &[String], writer: Writer) -> TokenStream {
    let elements = mechanism.parameters.iter().enumerate().flat_map(|(number, parameter)| {
        let default = |index: usize| parameter.default.as_ref().and_then(|values| values.get(index)).copied();
        (0..parameter.len.unwrap_or(1)).map(move |index| (number, default(index)))
    });
    let entries = elements.zip(names).map(|(kind, name)| (kind, [Cell::Name(name)]));
    writer.table("parameters", entries, |(number, default), [name]| {
        let parameter = &mechanism.parameters[*number];
        let (unit, doc, default) = (optional(parameter.unit.as_ref()), &parameter.doc, optional(default.map(literal)));
        quote! { __kin::ParameterInfo { name: #name, unit: #unit, default: #default, doc: #doc } }
    })
}

fn rows(system: &KinematicSystem, writer: Writer) -> TokenStream {
    let rows = system.set.rows.iter().zip(&system.classes);
    let entries = rows.map(|(row, class)| (*class, [Cell::Name(&row.name), Cell::Word(row.joint)]));
    writer.table("rows", entries, |class, [name, joint]| {
        let (rheonomic, driving) = (class.rheonomic, class.driving);
        let level = variant("Level", if class.holonomic { "Position" } else { "Velocity" });
        quote! {
            __kin::RowInfo {
                name: #name, joint: #joint, level: #level, rheonomic: #rheonomic, driving: #driving, bilateral: true,
            }
        }
    })
}

fn pattern(pattern: &Pattern, writer: Writer) -> TokenStream {
    let rows = pattern.rows;
    let entries = pattern.entries.iter().map(|(row, column)| [*row, *column].map(Cell::Word));
    let entries = writer.alike("entries", entries, |[row, column]| quote! { (#row, #column) });
    let constants = pattern.constants.iter().map(|(index, value)| (*value, [Cell::Word(*index)]));
    let constants = writer.table("constants", constants, |value, [index]| {
        let value = literal(*value);
        quote! { (#index, #value) }
    });
    quote! { __kin::Pattern { rows: #rows, entries: #entries, constants: #constants } }
}

/// For every row the sums of the sizes of its constant entries, those for x and y of bodies and those for other
/// coordinates; empty if a row has none.
fn least_sizes(coordinates: &[Coordinate], pattern: &Pattern) -> Vec<[f64; 2]> {
    let mut sizes = vec![[0.0; 2]; pattern.rows];
    for &(entry, value) in &pattern.constants {
        let (row, column) = pattern.entries[entry];
        let is_length = coordinates[column].kind.is_length();
        sizes[row][usize::from(!is_length)] += value.abs();
    }
    if sizes.contains(&[0.0; 2]) { Vec::new() } else { sizes }
}

pub(super) fn operations(count: OperationCount) -> TokenStream {
    let OperationCount { add, mul, neg, div, sqrt, sincos, function } = count;
    quote! {
        __kin::OperationCount {
            add: #add, mul: #mul, neg: #neg, div: #div, sqrt: #sqrt, sincos: #sincos, function: #function,
        }
    }
}

/// The generic ranks and the redundant rows.
fn structure(system: &KinematicSystem, structure: &Structure) -> TokenStream {
    let set = &system.set;
    let redundant = structure.redundant.iter().map(|redundancy| {
        let (row, joint_of_row) = (redundancy.row, set.rows[redundancy.row].joint);
        let mut joints: Vec<usize> = redundancy.circuit.iter().map(|row| set.rows[*row].joint).collect();
        joints.dedup();
        let names = joints.iter().filter(|joint| **joint != joint_of_row).map(|joint| &set.joints[*joint].name);
        quote! { __kin::GenericRedundancy { row: #row, circuit: &[#(#names),*] } }
    });
    let Structure { rank, rank_without_driving, rank_of_position, .. } = structure;
    quote! {
        __kin::Structure {
            rank: #rank, rank_without_driving: #rank_without_driving,
            position_rank_without_driving: #rank_of_position, redundant: &[#(#redundant),*],
        }
    }
}
