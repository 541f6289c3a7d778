//! Every kind of joint occurs in the mechanisms for which the laws are tested.

use crate::kinds;
use kin_core::joints::forms;
use kin_runtime::model::JointKind;
use std::collections::BTreeSet;

#[test]
fn every_kind_of_joint_bears_forces() {
    let found: BTreeSet<JointKind> = kinds().iter().flat_map(|(_, joints)| joints.iter().map(|j| j.kind)).collect();
    // A curve has one keyword for its three forms, and a rolling disc for its two.
    for kind in [
        JointKind::OnPolarCurve,
        JointKind::OnImplicitCurve,
        JointKind::OnParametricCurve,
        JointKind::RollingOnLine,
        JointKind::RollingOnDisc,
    ] {
        assert!(found.contains(&kind), "no mechanism has {kind:?}");
    }
    let found: BTreeSet<&str> = found.into_iter().map(JointKind::keyword).collect();
    let missing: Vec<&str> = forms().map(|form| form.kind.keyword()).filter(|word| !found.contains(word)).collect();
    assert!(missing.is_empty(), "no mechanism has {missing:?}");
}
