//! Tables unpacked by the compiler and by a program from the same bytes are equal.

use super::*;
use crate::model::Component;

/// What the compiler unpacks and what a program unpacks, of one and the same bytes.
macro_rules! both {
    ($table:ident, $entries:literal, $($argument:expr),*) => {{
        let constant = $table::array::<$entries>($($argument),*);
        #[cfg(feature = "std")]
        assert_eq!($table::leaked($entries, $($argument),*), constant);
        constant
    }};
}

#[test]
fn numbers_of_any_length_come_back() {
    assert_eq!(both!(numbers, 5, "", b"\x00\x7f\x80\x01\xac\x02\xff\xff\x03"), [0, 127, 128, 300, 65535]);
}

#[test]
fn names_and_kinds_are_handed_out_in_order() {
    let kinds = &[CoordinateKind::Scalar, CoordinateKind::Pose { body: 0, component: Component::Phi }];
    let kinds = &kinds.map(|kind| CoordinateInfo { name: "", kind });
    let coordinates = both!(coordinates, 2, "us\u{e4}ge.phi", b"\x00\x01\x00\x01\x09\x05", kinds);
    assert_eq!(coordinates[0], CoordinateInfo { name: "u", kind: CoordinateKind::Scalar });
    let kind = CoordinateKind::Pose { body: 5, component: Component::Phi };
    assert_eq!(coordinates[1], CoordinateInfo { name: "s\u{e4}ge.phi", kind });
}

#[test]
fn steps_have_their_own_joints_and_coordinates() {
    let kind = PlanStep { kind: StepKind::Closure, group: "RRR", singular: "never", ..NO_STEP };
    let (joints, coordinates): (&[usize], &[(usize, usize)]) = (&[7, 8, 9], &[(1, 7), (2, 8), (3, 9)]);
    let bytes = b"\x00\x02\x01\x00\x01\x00\x01\x01\x01\x02\x01\x01\x01\x02";
    let steps = both!(steps, 2, "", bytes, &[NO_STEP, kind], joints, coordinates);
    let explicit = PlanStep { joints: &[7, 8], coordinates: &[(1, 7)], modes: (0, 1), margins: (0, 1), ..NO_STEP };
    let closure = PlanStep { joints: &[9], coordinates: &[(2, 8), (3, 9)], modes: (1, 1), margins: (1, 2), ..kind };
    assert_eq!(steps, [explicit, closure]);
}
