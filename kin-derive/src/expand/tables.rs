//! The static [`Model`] of a mechanism: names, rows, patterns, geometry.

use super::derivation;
use super::entries::{frame, optional, variant};
use super::instructions::literal;
use super::joints::joints;
use super::kernel::Layout;
use super::packed::{Packed, any_is_long};
use kin_core::constraint::{CoordinateKind, Family, ObservableKind};
use kin_core::mechanism::{Component, Mechanism};
use kin_core::plan::SolutionPlan;
use kin_core::program::OperationCount;
use kin_core::structure::Structure;
use kin_core::system::{KinematicSystem, RowClass};
use kin_core::units::Units;
use proc_macro2::TokenStream;
use quote::quote;

/// Everything the table needs.
pub(crate) struct Tables<'a> {
    pub(crate) mechanism: &'a Mechanism,
    pub(crate) system: &'a KinematicSystem,
    pub(crate) constraints: &'a Layout,
    pub(crate) observables: &'a Layout,
    pub(crate) operations: OperationCount,
    pub(crate) doc: &'a str,
    pub(crate) allow_redundant: bool,
    pub(crate) structure: &'a Structure,
    pub(crate) plan: &'a SolutionPlan,
}

/// The static model and what it refers to.
pub(crate) fn model(tables: &Tables<'_>) -> TokenStream {
    let set = &tables.system.set;
    let (name, doc, allow_redundant) = (&set.name, tables.doc, tables.allow_redundant);
    let packed = is_packed(tables);
    let coordinates = coordinates(tables.system, packed);
    let parameters = parameters(tables.mechanism, packed);
    let inputs = set.inputs.iter();
    let input_defaults = tables.mechanism.inputs.iter().flat_map(|input| {
        let default = optional(input.default.map(literal));
        std::iter::repeat_n(default, input.len.unwrap_or(1))
    });
    let units = units(tables.mechanism);
    let functions = set.functions.iter();
    let arguments = super::supplied::arguments(tables.system).into_iter().map(|(function, _)| function as usize);
    let bodies = bodies(tables.system, packed);
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
    let joints = joints(tables.system, packed);
    let rows = rows(tables.system, packed);
    let observables = observables(tables.system, packed);
    let conditions = set.conditions.iter().map(|condition| {
        let (name, text, rheonomic) = (&condition.name, &condition.text, condition.rheonomic);
        let observable = condition.observable;
        quote! {
            __kin::ConditionInfo { name: #name, text: #text, observable: #observable, rheonomic: #rheonomic }
        }
    });
    let constraint_pattern = pattern(tables.constraints, set.rows.len(), packed);
    let observable_pattern = pattern(tables.observables, set.observables.len(), packed);
    let families = families(tables.system);
    let guesses = set.guesses.iter().map(|(k, _)| *k as usize);
    let geometry = set.geometry.len();
    let operations = operations(tables.operations);
    let equations = derivation::equations(tables.system);
    let solution = derivation::solution(tables.plan);
    let structure = structure(tables.system, tables.structure);
    let plan = super::steps::table(tables.plan, packed);
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
            families: &[#(#families),*],
            guesses: &[#(#guesses),*],
            geometry: #geometry,
            allow_redundant: #allow_redundant,
            structure: __kin::Some(#structure),
            plan: #plan,
            operations: #operations,
            equations: &[#(#equations),*],
            solution: &[#(#solution),*],
        }
    };
    if packed {
        quote! { static __MODEL: __kin::tables::Unpacked = __kin::tables::unpacked!(#model); }
    } else {
        quote! { static __MODEL: __kin::Model = #model; }
    }
}

/// Whether some table is so long that the compiler would take its time.
fn is_packed(tables: &Tables<'_>) -> bool {
    let set = &tables.system.set;
    let parameters = tables.mechanism.parameters.iter().map(|parameter| parameter.len.unwrap_or(1)).sum();
    let [constraints, observables] = [tables.constraints, tables.observables].map(|layout| layout.rows.entries.len());
    let (coordinates, rows, joints) = (set.coordinates.len(), set.rows.len(), set.joints.len());
    any_is_long(&[
        coordinates,
        rows,
        joints,
        parameters,
        set.bodies.len(),
        set.observables.len(),
        constraints,
        observables,
    ])
}

fn component(component: Component) -> TokenStream {
    variant("Component", ["X", "Y", "Phi"][component as usize])
}

fn coordinates(system: &KinematicSystem, packed: bool) -> TokenStream {
    let coordinates = &system.set.coordinates;
    let kind = |body: usize, component: Option<Component>| match component {
        Some(c) => {
            let c = self::component(c);
            quote! { __kin::CoordinateKind::Pose { body: #body, component: #c } }
        }
        None => quote! { __kin::CoordinateKind::Scalar },
    };
    let parts = |c: &kin_core::constraint::Coordinate| match c.kind {
        CoordinateKind::Pose(body, c) => (body, Some(c)),
        CoordinateKind::Scalar => (0, None),
    };
    if packed {
        let mut packed = Packed::new(coordinates.len());
        for coordinate in coordinates {
            let (body, component) = parts(coordinate);
            packed.name(&coordinate.name);
            packed.word(body);
            packed.kind(component);
        }
        return packed.with_kinds("coordinates", |component| kind(0, *component));
    }
    let coordinates = coordinates.iter().map(|coordinate| {
        let (name, (body, component)) = (&coordinate.name, parts(coordinate));
        let kind = kind(body, component);
        quote! { __kin::CoordinateInfo { name: #name, kind: #kind } }
    });
    quote! { &[#(#coordinates),*] }
}

fn bodies(system: &KinematicSystem, packed: bool) -> TokenStream {
    let bodies = &system.set.bodies;
    let places = |body: &kin_core::constraint::BodyInstance| body.coordinates.map(|k| k.map(|k| k as usize));
    if packed {
        let mut packed = Packed::<()>::new(bodies.len());
        for body in bodies {
            packed.name(&body.name);
            places(body).into_iter().for_each(|place| packed.place(place));
            packed.frame(body.carried_by);
            body.observables.into_iter().for_each(|observable| packed.word(observable));
        }
        return packed.unpacked("bodies", &TokenStream::new());
    }
    let bodies = bodies.iter().map(|body| {
        let (name, observables) = (&body.name, body.observables);
        let coordinates = places(body).map(optional);
        let origin = match body.carried_by {
            None => quote! { __kin::OriginKind::Free },
            Some(frame) => {
                let frame = self::frame(frame);
                quote! { __kin::OriginKind::Carried(#frame) }
            }
        };
        quote! {
            __kin::BodyInfo {
                name: #name, coordinates: [#(#coordinates),*], origin: #origin, observables: [#(#observables),*],
            }
        }
    });
    quote! { &[#(#bodies),*] }
}

fn observables(system: &KinematicSystem, packed: bool) -> TokenStream {
    let observables = &system.set.observables;
    let tokens = |kind: &ObservableKind| match *kind {
        ObservableKind::Pose(body, c) => {
            let c = component(c);
            quote! { __kin::Observable::Pose { body: #body, component: #c } }
        }
        ObservableKind::Point(point, c) => {
            let c = component(c);
            quote! { __kin::Observable::Point { point: #point, component: #c } }
        }
        ObservableKind::Define(k) => quote! { __kin::Observable::Define(#k) },
        ObservableKind::Joint(joint, quantity) => {
            quote! { __kin::Observable::Joint { joint: #joint, quantity: #quantity } }
        }
        ObservableKind::Condition(k) => quote! { __kin::Observable::Condition(#k) },
    };
    if packed {
        let mut packed = Packed::new(observables.len());
        for observable in observables {
            let (kind, a, b) = match observable.kind {
                ObservableKind::Pose(body, c) => (ObservableKind::Pose(0, c), body, 0),
                ObservableKind::Point(point, c) => (ObservableKind::Point(0, c), point, 0),
                ObservableKind::Define(k) => (ObservableKind::Define(0), k, 0),
                ObservableKind::Joint(joint, quantity) => (ObservableKind::Joint(0, 0), joint, quantity),
                ObservableKind::Condition(k) => (ObservableKind::Condition(0), k, 0),
            };
            packed.kind(kind);
            packed.word(a);
            packed.word(b);
        }
        return packed.with_kinds("observables", tokens);
    }
    let observables = observables.iter().map(|observable| tokens(&observable.kind));
    quote! { &[#(#observables),*] }
}

fn units(mechanism: &Mechanism) -> TokenStream {
    let Units { length, time, named } = kin_core::units::derive(mechanism);
    let (length, time) = (optional(length), optional(time));
    let named = named.iter().map(|(name, unit)| quote! { (#name, #unit) });
    quote! { __kin::Units { length: #length, time: #time, named: &[#(#named),*] } }
}

fn parameters(mechanism: &Mechanism, packed: bool) -> TokenStream {
    let mut all = Vec::new();
    for (number, parameter) in mechanism.parameters.iter().enumerate() {
        for index in 0..parameter.len.unwrap_or(1) {
            let name = match parameter.len {
                Some(_) => format!("{}[{index}]", parameter.name),
                None => parameter.name.clone(),
            };
            let default = parameter.default.as_ref().and_then(|values| values.get(index)).copied();
            all.push((name, number, default));
        }
    }
    let tokens = |name: &str, number: usize, default: Option<f64>| {
        let parameter = &mechanism.parameters[number];
        let (unit, doc, default) = (optional(parameter.unit.as_ref()), &parameter.doc, optional(default.map(literal)));
        quote! { __kin::ParameterInfo { name: #name, unit: #unit, default: #default, doc: #doc } }
    };
    if packed {
        let mut packed = Packed::new(all.len());
        for (name, number, default) in &all {
            packed.name(name);
            packed.kind((*number, *default));
        }
        return packed.with_kinds("parameters", |(number, default)| tokens("", *number, *default));
    }
    let all = all.iter().map(|(name, number, default)| tokens(name, *number, *default));
    quote! { &[#(#all),*] }
}

fn rows(system: &KinematicSystem, packed: bool) -> TokenStream {
    let rows = system.set.rows.iter().zip(&system.classes);
    let tokens = |name: &str, joint: usize, class: &RowClass| {
        let (rheonomic, driving) = (class.rheonomic, class.driving);
        let level = variant("Level", if class.holonomic { "Position" } else { "Velocity" });
        quote! {
            __kin::RowInfo {
                name: #name, joint: #joint, level: #level, rheonomic: #rheonomic, driving: #driving, bilateral: true,
            }
        }
    };
    if packed {
        let mut packed = Packed::new(rows.len());
        for (row, class) in rows {
            packed.name(&row.name);
            packed.word(row.joint);
            packed.kind(*class);
        }
        return packed.with_kinds("rows", |class| tokens("", 0, class));
    }
    let rows = rows.map(|(row, class)| tokens(&row.name, row.joint, class));
    quote! { &[#(#rows),*] }
}

fn families(system: &KinematicSystem) -> impl Iterator<Item = TokenStream> {
    let of = |families: &[Family], kind: &'static str| {
        let tokens = families.iter().map(|family| {
            let (name, first, members, stride) = (&family.name, family.first, family.members, family.stride);
            let kind = variant("FamilyKind", kind);
            quote! {
                __kin::FamilyInfo { name: #name, kind: #kind, first: #first, members: #members, stride: #stride }
            }
        });
        tokens.collect::<Vec<_>>()
    };
    let set = &system.set;
    of(&set.body_families, "Bodies").into_iter().chain(of(&set.row_families, "Rows"))
}

fn pattern(layout: &Layout, rows: usize, packed: bool) -> TokenStream {
    let entries = if packed {
        let mut packed = Packed::<()>::new(layout.rows.entries.len());
        for (row, column) in &layout.rows.entries {
            packed.word(*row);
            packed.word(*column);
        }
        packed.unpacked("entries", &TokenStream::new())
    } else {
        let entries = layout.rows.entries.iter().map(|(row, column)| quote! { (#row, #column) });
        quote! { &[#(#entries),*] }
    };
    let constants = if packed {
        let mut packed = Packed::new(layout.rows.constants.len());
        for (place, value) in &layout.rows.constants {
            packed.word(*place);
            packed.kind(*value);
        }
        packed.with_kinds("constants", |value| literal(*value))
    } else {
        let constants = layout.rows.constants.iter().map(|(place, value)| {
            let value = literal(*value);
            quote! { (#place, #value) }
        });
        quote! { &[#(#constants),*] }
    };
    quote! { __kin::Pattern { rows: #rows, entries: #entries, constants: #constants } }
}

fn operations(count: OperationCount) -> TokenStream {
    let OperationCount { add, mul, neg, div, sqrt, sincos, function } = count;
    quote! {
        __kin::OperationCount {
            add: #add, mul: #mul, neg: #neg, div: #div, sqrt: #sqrt, sincos: #sincos, function: #function,
        }
    }
}

/// Generic ranks and redundant rows.
fn structure(system: &KinematicSystem, structure: &Structure) -> TokenStream {
    let set = &system.set;
    let redundant = structure.redundant.iter().map(|redundancy| {
        let (row, own) = (redundancy.row, set.rows[redundancy.row].joint);
        let mut joints: Vec<usize> = redundancy.circuit.iter().map(|row| set.rows[*row].joint).collect();
        joints.dedup();
        let names = joints.iter().filter(|joint| **joint != own).map(|joint| &set.joints[*joint].name);
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
