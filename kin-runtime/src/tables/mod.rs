//! The tables of large mechanisms, unpacked at the first use of the model.
//!
//! A thousand struct literals take the compiler as long as the code of the mechanism, and so does a constant that it
//! evaluates entry by entry. Generated code therefore writes a long table as one text with all names, a short list of
//! `kinds`, entries with the values of the remaining fields, and one string of bytes with the numbers ("words") of
//! every entry; a program unpacks it once. Without `std`, where nothing can be allocated at run time, the same bytes
//! are unpacked while the user's crate is compiled.
//!
//! The words of one entry follow those of another, each as LEB128: seven bits in a byte, the lowest first, and only the
//! last byte below 128. A word "kind" is an index of `kinds`; a word "length of the name" takes as many bytes from the
//! text.

use crate::model::{
    BodyInfo, CoordinateInfo, CoordinateKind, DefineInfo, Frame, Geometry, JointInfo, Model, Observable, OriginKind,
    ParameterInfo, RowInfo,
};
use crate::plan::{ModeInfo, PlanStep, StepKind};

mod rest;

pub use rest::Rest;

/// A model with packed tables.
#[derive(Debug)]
pub struct Unpacked {
    /// Unpacks it.
    #[cfg(feature = "std")]
    pub make: fn() -> Model,
    /// The model, once it is unpacked.
    #[cfg(feature = "std")]
    pub model: std::sync::OnceLock<Model>,
    /// The model.
    #[cfg(not(feature = "std"))]
    pub model: Model,
}

impl core::ops::Deref for Unpacked {
    type Target = Model;

    fn deref(&self) -> &Model {
        #[cfg(feature = "std")]
        return self.model.get_or_init(self.make);
        #[cfg(not(feature = "std"))]
        return &self.model;
    }
}

/// A model, unpacked at its first use.
#[cfg(feature = "std")]
#[doc(hidden)]
#[macro_export]
macro_rules! __unpacked {
    ($model:expr) => {
        $crate::tables::Unpacked { make: || $model, model: $crate::tables::OnceLock::new() }
    };
}

/// A model, unpacked by the compiler.
#[cfg(not(feature = "std"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __unpacked {
    ($model:expr) => {
        $crate::tables::Unpacked { model: $model }
    };
}

/// A table with this number of entries.
#[cfg(feature = "std")]
#[doc(hidden)]
#[macro_export]
macro_rules! __unpack {
    ($table:ident, $entries:literal, $($argument:expr),*) => {
        $crate::tables::$table::leaked($entries, $($argument),*)
    };
}

/// A table with this number of entries.
#[cfg(not(feature = "std"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __unpack {
    ($table:ident, $entries:literal, $($argument:expr),*) => {
        &$crate::tables::$table::array::<$entries>($($argument),*)
    };
}

#[cfg(feature = "std")]
pub use std::sync::OnceLock;
pub use {__unpack as unpack, __unpacked as unpacked};

/// Defines a module that unpacks a kind of table, from an expression that unpacks one entry: `array` for the compiler,
/// and `leaked` for a program.
macro_rules! unpack {
    ($(#[$doc:meta])* $name:ident -> $entry:ty, $empty:expr, ($($argument:ident: $ty:ty),*), |$rest:ident| $unpack:expr) => {
        $(#[$doc])*
        pub mod $name {
            use super::*;

            /// All entries, by the compiler.
            #[allow(unused_mut, reason = "not every table counts in its arguments")]
            pub const fn array<const N: usize>(
                text: &'static str,
                bytes: &[u8],
                $(mut $argument: $ty),*
            ) -> [$entry; N] {
                let mut out = [$empty; N];
                let mut $rest = Rest::new(text, bytes);
                let mut k = 0;
                while k < N {
                    out[k] = $unpack;
                    k += 1;
                }
                out
            }

            /// All entries, by a program; their memory is never freed.
            #[cfg(feature = "std")]
            #[allow(unused_mut, reason = "not every table counts in its arguments")]
            pub fn leaked(
                entries: usize,
                text: &'static str,
                bytes: &[u8],
                $(mut $argument: $ty),*
            ) -> &'static [$entry] {
                let mut $rest = Rest::new(text, bytes);
                let out: std::vec::Vec<$entry> = (0..entries).map(|_| $unpack).collect();
                out.leak()
            }
        }
    };
}

unpack!(
    /// Words: kind, length of the name, body; names and bodies of `kinds` are not used.
    coordinates -> CoordinateInfo,
    CoordinateInfo { name: "", kind: CoordinateKind::Scalar },
    (kinds: &[CoordinateInfo]),
    |rest| {
        let kind = kinds[rest.word()].kind;
        let (name, body) = (rest.name(), rest.word());
        let kind = match kind {
            CoordinateKind::Pose { component, .. } => CoordinateKind::Pose { body, component },
            CoordinateKind::Scalar => CoordinateKind::Scalar,
        };
        CoordinateInfo { name, kind }
    }
);

unpack!(
    /// Words: kind, length of the name; names of `kinds` are not used.
    parameters -> ParameterInfo,
    ParameterInfo { name: "", unit: None, default: None, doc: "" },
    (kinds: &[ParameterInfo]),
    |rest| {
        let kind = kinds[rest.word()];
        ParameterInfo { name: rest.name(), ..kind }
    }
);

unpack!(
    /// Words: length of the name, places in q, the frame that carries the origin, observables.
    bodies -> BodyInfo,
    BodyInfo { name: "", coordinates: [None; 3], origin: OriginKind::Free, observables: [0; 3] },
    (),
    |rest| BodyInfo {
        name: rest.name(),
        coordinates: [rest.index_if_any(), rest.index_if_any(), rest.index_if_any()],
        origin: match rest.frame() {
            None => OriginKind::Free,
            Some(frame) => OriginKind::Carried(frame),
        },
        observables: [rest.word(), rest.word(), rest.word()],
    }
);

unpack!(
    /// Words: kind, length of the name, joint; names and joints of `kinds` are not used.
    rows -> RowInfo,
    NO_ROW,
    (kinds: &[RowInfo]),
    |rest| {
        let kind = kinds[rest.word()];
        RowInfo { name: rest.name(), joint: rest.word(), ..kind }
    }
);

const NO_ROW: RowInfo = RowInfo {
    name: "",
    joint: 0,
    level: crate::model::Level::Position,
    rheonomic: false,
    driving: false,
    bilateral: true,
};

unpack!(
    /// Words: kind, frame, offset; of `kinds` only the role is used.
    geometry -> Geometry,
    Geometry { role: crate::model::Role::P, frame: Frame::Ground, offset: 0 },
    (kinds: &[Geometry]),
    |rest| {
        let role = kinds[rest.word()].role;
        let frame = match rest.frame() {
            Some(frame) => frame,
            None => Frame::Ground,
        };
        Geometry { role, frame, offset: rest.word() }
    }
);

unpack!(
    /// Words: kind, observable; of `kinds` only the name is used.
    quantities -> DefineInfo,
    DefineInfo { name: "", observable: 0, varies: true },
    (kinds: &[DefineInfo]),
    |rest| {
        let name = kinds[rest.word()].name;
        DefineInfo { name, observable: rest.word(), varies: true }
    }
);

unpack!(
    /// Words: kind, length of the name, two frames, first row, number of rows, numbers of entries of `geometry` and of
    /// `quantities`; of `kinds` only the kind of joint is used.
    joints -> JointInfo,
    NO_JOINT,
    (kinds: &[JointInfo], geometry: &'static [Geometry], quantities: &'static [DefineInfo]),
    |rest| {
        let kind = kinds[rest.word()].kind;
        let (name, frames) = (rest.name(), [rest.frame(), rest.frame()]);
        let (first_row, rows) = (rest.word(), rest.word());
        let (own_geometry, other_geometry) = geometry.split_at(rest.word());
        let (own_quantities, other_quantities) = quantities.split_at(rest.word());
        (geometry, quantities) = (other_geometry, other_quantities);
        JointInfo { name, kind, frames, first_row, rows, geometry: own_geometry, quantities: own_quantities }
    }
);

const NO_JOINT: JointInfo = JointInfo {
    name: "",
    kind: crate::model::JointKind::Revolute,
    frames: [None; 2],
    first_row: 0,
    rows: 0,
    geometry: &[],
    quantities: &[],
};

unpack!(
    /// Words: kind and two indices; of `kinds` only the variant and the component are used.
    observables -> Observable,
    Observable::Define(0),
    (kinds: &[Observable]),
    |rest| {
        let (kind, a, b) = (kinds[rest.word()], rest.word(), rest.word());
        match kind {
            Observable::Pose { component, .. } => Observable::Pose { body: a, component },
            Observable::Point { component, .. } => Observable::Point { point: a, component },
            Observable::Define(_) => Observable::Define(a),
            Observable::Joint { .. } => Observable::Joint { joint: a, quantity: b },
            Observable::Condition(_) => Observable::Condition(a),
        }
    }
);

unpack!(
    /// Words: row, column.
    entries -> (usize, usize),
    (0, 0),
    (),
    |rest| (rest.word(), rest.word())
);

unpack!(
    /// Words: kind, place; of `kinds` only the value is used.
    constants -> (usize, f64),
    (0, 0.0),
    (kinds: &[(usize, f64)]),
    |rest| {
        let (_, value) = kinds[rest.word()];
        (rest.word(), value)
    }
);

unpack!(
    /// Words: the number.
    numbers -> usize,
    0,
    (),
    |rest| rest.word()
);

unpack!(
    /// Words: kind, numbers of entries of `joints` and of `coordinates`, first index and end of its modes and of its
    /// margins; all other fields are those of `kinds`.
    steps -> PlanStep,
    NO_STEP,
    (kinds: &[PlanStep], joints: &'static [usize], coordinates: &'static [(usize, usize)]),
    |rest| {
        let kind = kinds[rest.word()];
        let (own_joints, other_joints) = joints.split_at(rest.word());
        let (own_coordinates, other_coordinates) = coordinates.split_at(rest.word());
        (joints, coordinates) = (other_joints, other_coordinates);
        PlanStep {
            joints: own_joints,
            coordinates: own_coordinates,
            modes: (rest.word(), rest.word()),
            margins: (rest.word(), rest.word()),
            ..kind
        }
    }
);

const NO_STEP: PlanStep = PlanStep {
    kind: StepKind::Explicit,
    rows: &[],
    group: "",
    joints: &[],
    coordinates: &[],
    modes: (0, 0),
    margins: (0, 0),
    singular: "",
};

unpack!(
    /// Words: length of the name, step, margin.
    modes -> ModeInfo,
    ModeInfo { name: "", step: 0, margin: 0 },
    (),
    |rest| ModeInfo { name: rest.name(), step: rest.word(), margin: rest.word() }
);

#[cfg(test)]
mod tests;
