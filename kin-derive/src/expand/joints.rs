//! The joints in the static model: kinds, frames, geometry and quantities.

use super::entries::{frame, optional, variant};
use super::packed::Packed;
use kin_core::constraint::Frame;
use kin_core::system::KinematicSystem;
use kin_core::vocabulary::JointKind;
use kin_core::vocabulary::Role;
use proc_macro2::TokenStream;
use quote::quote;

/// The joints.
pub(super) fn joints(system: &KinematicSystem, packed: bool) -> TokenStream {
    let joints = &system.set.joints;
    let role = |role: Role| variant("Role", &format!("{role:?}"));
    let geometry = |of: Role, frame: Frame, offset: usize| {
        let (role, frame) = (role(of), self::frame(frame));
        quote! { __kin::Geometry { role: #role, frame: #frame, offset: #offset } }
    };
    let quantity = |name: &str, observable: usize| {
        quote! { __kin::DefineInfo { name: #name, observable: #observable, varies: true } }
    };
    if packed {
        let mut packed = Packed::new(joints.len());
        let mut all_geometry = Packed::new(joints.iter().map(|joint| joint.geometry.len()).sum());
        let mut all_quantities = Packed::new(joints.iter().map(|joint| joint.quantities.len()).sum());
        for joint in joints {
            packed.name(&joint.name);
            packed.kind(joint.kind);
            joint.frames.into_iter().for_each(|frame| packed.frame(frame));
            for word in [joint.first_row, joint.rows, joint.geometry.len(), joint.quantities.len()] {
                packed.word(word);
            }
            for entry in &joint.geometry {
                all_geometry.kind(entry.role);
                all_geometry.frame(Some(entry.frame));
                all_geometry.word(entry.offset);
            }
            for entry in &joint.quantities {
                all_quantities.kind(entry.name);
                all_quantities.word(entry.observable);
            }
        }
        let kinds = packed.kinds(|tag| variant("JointKind", &kind(*tag)));
        let all_geometry = all_geometry.with_kinds("geometry", |role| geometry(*role, Frame::Ground, 0));
        let all_quantities = all_quantities.with_kinds("quantities", |name| quantity(name, 0));
        return packed.unpacked("joints", &quote! { , #kinds, #all_geometry, #all_quantities });
    }
    let joints = joints.iter().map(|joint| {
        let (name, first_row, rows) = (&joint.name, joint.first_row, joint.rows);
        let kind = variant("JointKind", &kind(joint.kind));
        let frames = joint.frames.map(|f| optional(f.map(frame)));
        let geometry = joint.geometry.iter().map(|entry| geometry(entry.role, entry.frame, entry.offset));
        let quantities = joint.quantities.iter().map(|entry| quantity(entry.name, entry.observable));
        quote! {
            __kin::JointInfo {
                name: #name, kind: #kind, frames: [#(#frames),*], first_row: #first_row, rows: #rows,
                geometry: &[#(#geometry),*], quantities: &[#(#quantities),*],
            }
        }
    });
    quote! { &[#(#joints),*] }
}

/// The variant's name, which is the same in kin-core and kin-runtime.
fn kind(kind: JointKind) -> String {
    format!("{kind:?}")
}
