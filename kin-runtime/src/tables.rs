//! The tables of large mechanisms, unpacked while the user's crate is compiled.
//!
//! A struct literal for every row of a thousand takes the compiler as long as the code of the mechanism. So generated
//! code writes long tables as names in one text, a few kinds of entries, and numbers; what is left is a constant like any
//! other. Words are the numbers of one entry after another; the first is the length of its name where it has one.

use crate::model::{
    BodyInfo, CoordinateInfo, CoordinateKind, Frame, Geometry, JointInfo, JointQuantity, Observable, OriginKind,
    ParameterInfo, RowInfo,
};

/// What is left of a text and of words.
#[derive(Clone, Copy)]
struct Rest<'w> {
    text: &'static str,
    words: &'w [u32],
    /// The next word. The compiler counts by one faster than it shortens slices.
    at: usize,
}

impl Rest<'_> {
    const fn word(&mut self) -> usize {
        self.at += 1;
        self.words[self.at - 1] as usize
    }

    const fn name(&mut self) -> &'static str {
        let (name, rest) = self.text.split_at(self.word());
        self.text = rest;
        name
    }

    /// 0 stands for none.
    const fn place(&mut self) -> Option<usize> {
        match self.word() {
            0 => None,
            k => Some(k - 1),
        }
    }

    /// 0 stands for none, 1 for ground.
    const fn frame(&mut self) -> Option<Frame> {
        match self.word() {
            0 => None,
            1 => Some(Frame::Ground),
            k => Some(Frame::Body(k - 2)),
        }
    }
}

/// Defines a function that unpacks a table, entry by entry.
macro_rules! unpack {
    ($(#[$doc:meta])* $name:ident -> $entry:ty, $empty:expr, ($($argument:ident: $ty:ty),*), |$rest:ident| $unpack:expr) => {
        $(#[$doc])*
        #[allow(unused_mut)]
        pub const fn $name<const N: usize>(
            text: &'static str,
            words: &[u32],
            $(mut $argument: $ty),*
        ) -> [$entry; N] {
            let mut out = [$empty; N];
            let mut $rest = Rest { text, words, at: 0 };
            let mut k = 0;
            while k < N {
                out[k] = $unpack;
                k += 1;
            }
            out
        }
    };
}

unpack!(
    /// Words: length of the name, body, kind; the kinds say what else there is, their bodies nothing.
    coordinates -> CoordinateInfo,
    CoordinateInfo { name: "", kind: CoordinateKind::Scalar },
    (kinds: &[CoordinateKind]),
    |rest| {
        let (name, body) = (rest.name(), rest.word());
        let kind = match kinds[rest.word()] {
            CoordinateKind::Pose { component, .. } => CoordinateKind::Pose { body, component },
            CoordinateKind::Scalar => CoordinateKind::Scalar,
        };
        CoordinateInfo { name, kind }
    }
);

unpack!(
    /// Words: length of the name, kind; the kinds have no name.
    parameters -> ParameterInfo,
    ParameterInfo { name: "", unit: None, default: None, doc: "" },
    (kinds: &[ParameterInfo]),
    |rest| {
        let name = rest.name();
        ParameterInfo { name, ..kinds[rest.word()] }
    }
);

unpack!(
    /// Words: length of the name, places in q, the frame that carries the origin, observables.
    bodies -> BodyInfo,
    BodyInfo { name: "", coordinates: [None; 3], origin: OriginKind::Free, observables: [0; 3] },
    (),
    |rest| BodyInfo {
        name: rest.name(),
        coordinates: [rest.place(), rest.place(), rest.place()],
        origin: match rest.frame() {
            None => OriginKind::Free,
            Some(frame) => OriginKind::Carried(frame),
        },
        observables: [rest.word(), rest.word(), rest.word()],
    }
);

unpack!(
    /// Words: length of the name, joint, kind; the kinds have neither name nor joint.
    rows -> RowInfo,
    NO_ROW,
    (kinds: &[RowInfo]),
    |rest| {
        let (name, joint) = (rest.name(), rest.word());
        RowInfo { name, joint, ..kinds[rest.word()] }
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
    /// Words: kind, frame, offset; of the kinds only the role counts.
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
    /// Words: kind, observable; of the kinds only the name counts.
    quantities -> JointQuantity,
    JointQuantity { name: "", observable: 0 },
    (kinds: &[JointQuantity]),
    |rest| {
        let name = kinds[rest.word()].name;
        JointQuantity { name, observable: rest.word() }
    }
);

unpack!(
    /// Words: length of the name, kind, two frames, first row, rows, how many entries of `geometry` and `quantities`.
    joints -> JointInfo,
    NO_JOINT,
    (kinds: &[crate::model::JointKind], geometry: &'static [Geometry], quantities: &'static [JointQuantity]),
    |rest| {
        let (name, kind) = (rest.name(), kinds[rest.word()]);
        let frames = [rest.frame(), rest.frame()];
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
    /// Words: kind and two numbers; of the kinds only what they are and their components count.
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
    /// Words: place, which of `values`.
    constants -> (usize, f64),
    (0, 0.0),
    (values: &[f64]),
    |rest| (rest.word(), values[rest.word()])
);
