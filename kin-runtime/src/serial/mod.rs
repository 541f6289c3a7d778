//! How results serialise whose names come from the model: as maps by name, in the order of declaration.

mod forces;
mod sensitivities;

use crate::arc::ArcPlaceKind;
use crate::model::{BodyInfo, Model, PointInfo};
use crate::motion::{BodyMotion, Motion, PointMotion};
use crate::series::MotionDerivatives;
use crate::state::State;
use crate::trajectory::Trajectory;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

/// Named values in order, written as one map.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NamedValues<T, N = &'static str>(Vec<(N, T)>);

impl<T, N> FromIterator<(N, T)> for NamedValues<T, N> {
    fn from_iter<I: IntoIterator<Item = (N, T)>>(iter: I) -> Self {
        Self(iter.into_iter().collect())
    }
}

#[cfg(feature = "cli")]
impl<T, N> NamedValues<T, N> {
    /// Names with their values.
    pub(crate) fn iter(&self) -> core::slice::Iter<'_, (N, T)> {
        self.0.iter()
    }

    /// The names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &N> {
        self.0.iter().map(|(name, _)| name)
    }
}

impl<T> NamedValues<T> {
    /// True if there are no values.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize, N: Serialize> Serialize for NamedValues<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

fn body_names(model: &Model) -> impl Iterator<Item = &'static str> + use<> {
    let bodies: &'static [BodyInfo] = model.bodies;
    bodies.iter().map(|body| body.name)
}

fn point_names(model: &Model) -> impl Iterator<Item = &'static str> + use<> {
    let points: &'static [PointInfo] = model.points;
    points.iter().map(|point| point.name)
}

/// The names of all coordinates.
pub(crate) fn coordinate_names(model: &Model) -> Vec<&'static str> {
    model.coordinates.iter().map(|coordinate| coordinate.name).collect()
}

/// A state that serialises without names.
struct Bare<'a>(&'a State);

impl Serialize for Bare<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut s = serializer.serialize_struct("State", 11)?;
        fields(self.0, &mut s)?;
        s.serialize_field("bodies", &self.0.bodies)?;
        s.serialize_field("points", &self.0.points)?;
        s.end()
    }
}

/// The fields of a state that serialise in the same way with and without names.
fn fields<S: SerializeStruct>(state: &State, s: &mut S) -> Result<(), S::Error> {
    s.serialize_field("t", &state.t)?;
    s.serialize_field("inputs", &state.inputs)?;
    s.serialize_field("q", &state.q)?;
    s.serialize_field("q_dot", &state.q_dot)?;
    s.serialize_field("q_ddot", &state.q_ddot)?;
    s.serialize_field("residual", &state.residual)?;
    s.serialize_field("iterations", &state.iterations)?;
    s.serialize_field("condition", &state.condition)?;
    s.serialize_field("degrees_of_freedom_left", &state.degrees_of_freedom_left)
}

/// With the names of the coordinates, and bodies and points by name.
impl Serialize for State {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let bodies: NamedValues<&BodyMotion> = body_names(self.model).zip(&self.bodies).collect();
        let points: NamedValues<&PointMotion> = point_names(self.model).zip(&self.points).collect();
        let mut s = serializer.serialize_struct("State", 13)?;
        s.serialize_field("mechanism", self.model.name)?;
        s.serialize_field("coordinates", &coordinate_names(self.model))?;
        fields(self, &mut s)?;
        s.serialize_field("bodies", &bodies)?;
        s.serialize_field("points", &points)?;
        s.end()
    }
}

/// With all names once; in the states, values are in the order of these names.
impl Serialize for Trajectory {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let states: Vec<Bare<'_>> = self.states.iter().map(Bare).collect();
        let violated: Vec<&str> = self.violated_at_start().map(|condition| condition.name).collect();
        let mut s = serializer.serialize_struct("Trajectory", 11)?;
        s.serialize_field("mechanism", self.model.name)?;
        s.serialize_field("coordinates", &coordinate_names(self.model))?;
        s.serialize_field("bodies", &body_names(self.model).collect::<Vec<_>>())?;
        s.serialize_field("points", &point_names(self.model).collect::<Vec<_>>())?;
        s.serialize_field("states", &states)?;
        s.serialize_field("events", &self.events)?;
        s.serialize_field("violated_at_start", &violated)?;
        s.serialize_field("unwatched", &self.unwatched)?;
        s.serialize_field("stopped", &self.stopped)?;
        s.serialize_field("fallbacks", &self.fallbacks)?;
        s.serialize_field("arc", &self.arc)?;
        s.end()
    }
}

/// As it prints: `dead centre`.
impl Serialize for ArcPlaceKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Implements `Serialize` for a report on the bodies, points, defines, joints and conditions of a mechanism: all by
/// name.
macro_rules! by_name {
    ($report:ident $(, $more:ident)?) => {
        impl Serialize for $report {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let model = self.model;
                let bodies: NamedValues<_> = body_names(model).zip(&self.bodies).collect();
                let points: NamedValues<_> = point_names(model).zip(&self.points).collect();
                let defines: NamedValues<_> = model.defines.iter().map(|d| d.name).zip(&self.defines).collect();
                let joints = model.joints.iter().zip(&self.joints).filter(|(joint, _)| !joint.quantities.is_empty());
                let joints: NamedValues<NamedValues<_>> = joints
                    .map(|(joint, all)| (joint.name, joint.quantities.iter().map(|q| q.name).zip(all).collect()))
                    .collect();
                let conditions: NamedValues<_> = model.conditions.iter().map(|c| c.name).zip(&self.conditions).collect();
                let count = 5 $(+ usize::from(self.$more.is_some()))?;
                let mut s = serializer.serialize_struct(stringify!($report), count)?;
                s.serialize_field("points", &points)?;
                s.serialize_field("bodies", &bodies)?;
                s.serialize_field("defines", &defines)?;
                s.serialize_field("joints", &joints)?;
                s.serialize_field("conditions", &conditions)?;
                $(if let Some($more) = &self.$more {
                    s.serialize_field(stringify!($more), $more)?;
                })?
                s.end()
            }
        }
    };
}
by_name!(Motion, forces);
by_name!(MotionDerivatives);
