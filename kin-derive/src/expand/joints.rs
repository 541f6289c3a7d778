//! The joints in the static model: kinds, frames, geometry and quantities.

use super::entries::variant;
use super::table::{Cell, Writer};
use kin_core::system::KinematicSystem;
use proc_macro2::TokenStream;
use quote::quote;

/// The table of joints.
pub(super) fn joints(system: &KinematicSystem, writer: Writer) -> TokenStream {
    let joints = &system.set.joints;
    let geometry = joints.iter().map(|joint| {
        joint.geometry.iter().map(|entry| (entry.role, [Cell::Frame(entry.frame), Cell::Word(entry.offset)])).collect()
    });
    let geometry = writer.lists("geometry", geometry, |role, [frame, offset]| {
        let role = variant("Role", role.variant());
        quote! { __kin::Geometry { role: #role, frame: #frame, offset: #offset } }
    });
    let quantities = joints.iter().map(|joint| {
        joint.quantities.iter().map(|quantity| (quantity.name, [Cell::Word(quantity.observable)])).collect()
    });
    let quantities = writer.lists("quantities", quantities, |name, [observable]| {
        quote! { __kin::DefineInfo { name: #name, observable: #observable, varies: true } }
    });
    let entries = joints.iter().zip(geometry.cells.into_iter().zip(quantities.cells));
    let entries = entries.map(|(joint, (geometry, quantities))| {
        let [first, second] = joint.frames.map(Cell::End);
        let [first_row, rows] = [joint.first_row, joint.rows].map(Cell::Word);
        (joint.kind, [Cell::Name(&joint.name), first, second, first_row, rows, geometry, quantities])
    });
    let lists = [geometry.whole, quantities.whole];
    writer.with_lists("joints", entries, lists, |kind, [name, first, second, first_row, rows, geometry, quantities]| {
        let kind = variant("JointKind", kind.variant());
        quote! {
            __kin::JointInfo {
                name: #name, kind: #kind, frames: [#first, #second], first_row: #first_row, rows: #rows,
                geometry: #geometry, quantities: #quantities,
            }
        }
    })
}
