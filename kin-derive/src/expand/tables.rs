//! The static [`Model`] of a mechanism: names, rows, patterns, geometry.

use super::kernel::Layout;
use super::program::literal;
use kin_core::constraint::{CoordinateKind, Family, Frame, JointTag, ObservableKind, Role};
use kin_core::mechanism::{Component, Mechanism};
use kin_core::program::OperationCount;
use kin_core::structure::Structure;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
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
    pub(crate) plan: &'a TokenStream,
}

/// The `Model` expression.
pub(crate) fn model(tables: &Tables<'_>) -> TokenStream {
    let set = &tables.system.set;
    let (name, doc, allow_redundant) = (&set.name, tables.doc, tables.allow_redundant);
    let coordinates = set.coordinates.iter().map(|c| {
        let name = &c.name;
        let kind = match c.kind {
            CoordinateKind::Pose(body, c) => {
                let c = component(c);
                quote! { __kin::CoordinateKind::Pose { body: #body, component: #c } }
            }
            CoordinateKind::Scalar => quote! { __kin::CoordinateKind::Scalar },
        };
        quote! { __kin::CoordinateInfo { name: #name, kind: #kind } }
    });
    let parameters = parameters(tables.mechanism);
    let inputs = set.inputs.iter();
    let functions = set.functions.iter();
    let arguments = super::functions::arguments(tables.system).into_iter().map(|(function, _)| function as usize);
    let bodies = set.bodies.iter().map(|body| {
        let name = &body.name;
        let coordinates = body.coordinates.map(|k| optional(k.map(|k| k as usize)));
        let observables = body.observables;
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
    let (joints, rows) = (joints(tables.system), rows(tables.system));
    let observables = set.observables.iter().map(|observable| match observable.kind {
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
    });
    let conditions = set.conditions.iter().map(|condition| {
        let (name, text, rheonomic) = (&condition.name, &condition.text, condition.rheonomic);
        let observable = condition.observable;
        quote! {
            __kin::ConditionInfo { name: #name, text: #text, observable: #observable, rheonomic: #rheonomic }
        }
    });
    let constraint_pattern = pattern(tables.constraints, set.rows.len());
    let observable_pattern = pattern(tables.observables, set.observables.len());
    let families = families(tables.system);
    let guesses = set.guesses.iter().map(|(k, _)| *k as usize);
    let geometry = set.geometry.len();
    let operations = operations(tables.operations);
    let equations = equations(tables.system);
    let (structure, plan) = (structure(tables.system, tables.structure), tables.plan);
    quote! {
        __kin::Model {
            name: #name,
            doc: #doc,
            coordinates: &[#(#coordinates),*],
            parameters: &[#(#parameters),*],
            inputs: &[#(#inputs),*],
            functions: &[#(#functions),*],
            arguments: &[#(#arguments),*],
            bodies: &[#(#bodies),*],
            points: &[#(#points),*],
            defines: &[#(#defines),*],
            joints: &[#(#joints),*],
            rows: &[#(#rows),*],
            conditions: &[#(#conditions),*],
            constraint_pattern: #constraint_pattern,
            observables: &[#(#observables),*],
            observable_pattern: #observable_pattern,
            families: &[#(#families),*],
            guesses: &[#(#guesses),*],
            geometry: #geometry,
            allow_redundant: #allow_redundant,
            structure: __kin::Some(#structure),
            plan: #plan,
            operations: #operations,
            equations: &[#(#equations),*],
        }
    }
}

fn variant(path: &str, name: &str) -> TokenStream {
    let (path, name) = (Ident::new(path, Span::call_site()), Ident::new(name, Span::call_site()));
    quote! { __kin::#path::#name }
}

fn component(component: Component) -> TokenStream {
    variant("Component", ["X", "Y", "Phi"][component as usize])
}

fn frame(frame: Frame) -> TokenStream {
    match frame {
        Frame::Ground => quote! { __kin::Frame::Ground },
        Frame::Body(body) => quote! { __kin::Frame::Body(#body) },
    }
}

fn optional(value: Option<impl quote::ToTokens>) -> TokenStream {
    match value {
        Some(value) => quote! { __kin::Some(#value) },
        None => quote! { __kin::None },
    }
}

fn parameters(mechanism: &Mechanism) -> Vec<TokenStream> {
    let mut out = Vec::new();
    for parameter in &mechanism.parameters {
        let unit = optional(parameter.unit.as_ref());
        let doc = &parameter.doc;
        for index in 0..parameter.len.unwrap_or(1) {
            let name = match parameter.len {
                Some(_) => format!("{}[{index}]", parameter.name),
                None => parameter.name.clone(),
            };
            let default = parameter.default.as_ref().and_then(|values| values.get(index));
            let default = optional(default.map(|value| literal(*value)));
            out.push(quote! {
                __kin::ParameterInfo { name: #name, unit: #unit, default: #default, doc: #doc }
            });
        }
    }
    out
}

fn joints(system: &KinematicSystem) -> impl Iterator<Item = TokenStream> {
    system.set.joints.iter().map(|joint| {
        let (name, first_row, rows) = (&joint.name, joint.first_row, joint.rows);
        let kind = variant("JointKind", kind(joint.tag));
        let frames = joint.frames.map(|f| optional(f.map(frame)));
        let geometry = joint.geometry.iter().map(|geometry| {
            let (frame, offset) = (frame(geometry.frame), geometry.offset);
            let role = match geometry.role {
                Role::P => variant("Role", "P"),
                Role::Q => variant("Role", "Q"),
                Role::Axis => variant("Role", "Axis"),
                Role::Value => variant("Role", "Value"),
                Role::Radius => variant("Role", "Radius"),
            };
            quote! { __kin::Geometry { role: #role, frame: #frame, offset: #offset } }
        });
        let quantities = joint.quantities.iter().map(|quantity| {
            let (name, observable) = (quantity.name, quantity.observable);
            quote! { __kin::JointQuantity { name: #name, observable: #observable } }
        });
        quote! {
            __kin::JointInfo {
                name: #name, kind: #kind, frames: [#(#frames),*], first_row: #first_row, rows: #rows,
                geometry: &[#(#geometry),*], quantities: &[#(#quantities),*],
            }
        }
    })
}

fn kind(tag: JointTag) -> &'static str {
    match tag {
        JointTag::Revolute => "Revolute",
        JointTag::Translational => "Translational",
        JointTag::Fixed => "Fixed",
        JointTag::PointOnLine => "PointOnLine",
        JointTag::Distance => "Distance",
        JointTag::X => "X",
        JointTag::Y => "Y",
        JointTag::Angle => "Angle",
        JointTag::RelativeAngle => "RelativeAngle",
        JointTag::OnPolarCurve => "OnPolarCurve",
        JointTag::OnImplicitCurve => "OnImplicitCurve",
        JointTag::OnParametricCurve => "OnParametricCurve",
        JointTag::FlatFollower => "FlatFollower",
        JointTag::Gear => "Gear",
        JointTag::Belt => "Belt",
        JointTag::RackPinion => "RackPinion",
        JointTag::RollingOnLine => "RollingOnLine",
        JointTag::RollingOnDisc => "RollingOnDisc",
        JointTag::Constraint => "Constraint",
        JointTag::KnifeEdge => "KnifeEdge",
        JointTag::Speed => "Speed",
        JointTag::Nonholonomic => "Nonholonomic",
        JointTag::Driver => "Driver",
    }
}

fn rows(system: &KinematicSystem) -> impl Iterator<Item = TokenStream> {
    system.set.rows.iter().zip(&system.classes).map(|(row, class)| {
        let (name, joint, rheonomic, driving) = (&row.name, row.joint, class.rheonomic, class.driving);
        let level = variant("Level", if class.holonomic { "Position" } else { "Velocity" });
        quote! {
            __kin::RowInfo {
                name: #name, joint: #joint, level: #level, rheonomic: #rheonomic, driving: #driving, bilateral: true,
            }
        }
    })
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

fn pattern(layout: &Layout, rows: usize) -> TokenStream {
    let entries = layout.entries.iter().map(|(row, column)| quote! { (#row, #column) });
    let constants = layout.constants.iter().map(|(place, value)| {
        let value = literal(*value);
        quote! { (#place, #value) }
    });
    quote! { __kin::Pattern { rows: #rows, entries: &[#(#entries),*], constants: &[#(#constants),*] } }
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

/// The derivation as text, only for those who asked for it: a controller does not carry it.
fn equations(system: &KinematicSystem) -> Vec<TokenStream> {
    // Snapshots are the same whichever features the rest of a workspace asks for.
    if !cfg!(feature = "equations") || cfg!(test) {
        return Vec::new();
    }
    let set = &system.set;
    (set.rows.iter().zip(&system.equations))
        .map(|(row, equation)| {
            let value = row.velocity.map_or(equation.phi, |velocity| velocity.eta);
            let (name, phi) = (&row.name, set.show(value));
            let (phi_t, gamma) = (set.show(equation.phi_t), set.show(equation.gamma));
            let entries = equation.phi_q.iter().map(|(k, e)| {
                let (coordinate, e) = (set.coordinate_name(*k), set.show(*e));
                quote! { (#coordinate, #e) }
            });
            quote! {
                __kin::EquationText {
                    row: #name, phi: #phi, phi_q: &[#(#entries),*], phi_t: #phi_t, gamma: #gamma,
                }
            }
        })
        .collect()
}
