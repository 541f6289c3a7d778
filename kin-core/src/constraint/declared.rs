//! Lays out what a mechanism declares besides its joints: bodies, points, defines and guesses, member by member.

use super::assembly::Assembly;
use super::layout::indexed;
use super::set::{ConstraintSet, DefineInstance, ObservableKind, PointInstance};
use crate::mechanism::{BodyOrigin, Component, GuessTarget};
use crate::vocabulary::Frame;

impl Assembly<'_> {
    /// Writes the poses of all bodies.
    pub(crate) fn bodies(&mut self, set: &mut ConstraintSet) {
        for place in 0..set.bodies.len() {
            let (family, index) = set.bodies[place].family;
            let pose = self.pose_of(place);
            if let BodyOrigin::Carried(carrier) = &self.mechanism.bodies[family].origin_at {
                set.bodies[place].carried_by = self.resolve(&carrier.body, index as i64);
                self.index = index as i64;
                set.bodies[place].carried_at = Some([self.formula(&carrier.x), self.formula(&carrier.y)]);
            }
            set.bodies[place].pose = pose;
            set.bodies[place].observables =
                std::array::from_fn(|c| self.observe(set, ObservableKind::Pose(place, Component::ALL[c]), pose[c]));
        }
    }

    /// Writes all named points.
    pub(crate) fn points(&mut self, set: &mut ConstraintSet) {
        for (family, point) in self.mechanism.points.iter().enumerate() {
            for (shown, index) in Self::instances(point.range) {
                self.index = index;
                let placed = self.place(&point.place);
                let local = set.geometry.len();
                set.geometry.extend(placed.local);
                let place = set.points.len();
                let observables = [(Component::X, 0), (Component::Y, 1)]
                    .map(|(component, c)| self.observe(set, ObservableKind::Point(place, component), placed.r[c]));
                set.points.push(PointInstance {
                    name: indexed(&point.name, shown.is_some(), index),
                    family: (family, index.max(0) as usize),
                    frame: placed.frame,
                    local,
                    observables,
                });
            }
        }
    }

    /// Writes all named expressions.
    pub(crate) fn defines(&mut self, set: &mut ConstraintSet) {
        for (family, define) in self.mechanism.defines.iter().enumerate() {
            for (shown, index) in Self::instances(define.range) {
                let value = self.define_at(family, index, define.origin);
                let observable = self.observe(set, ObservableKind::Define(set.defines.len()), value);
                set.defines.push(DefineInstance {
                    name: indexed(&define.name, shown.is_some(), index),
                    origin: define.origin,
                    family: (family, index.max(0) as usize),
                    observable,
                    varies: !self.graph.depends(value).is_static(),
                });
            }
        }
    }

    /// Writes all guesses.
    pub(crate) fn guesses(&mut self, set: &mut ConstraintSet) {
        for guess in &self.mechanism.guesses {
            for (_, index) in Self::instances(guess.range) {
                self.index = index;
                let coordinate = match &guess.target {
                    GuessTarget::Pose(body, component) => match self.frame(body) {
                        Some(Frame::Body(place)) => self.coordinates_of[place][*component as usize],
                        _ => None,
                    },
                    GuessTarget::Scalar(member) => self.scalar(member),
                };
                let value = self.formula(&guess.value);
                match coordinate {
                    Some(coordinate) => set.guesses.push((coordinate, value)),
                    None => {
                        self.error(guess.origin, "this coordinate does not vary, so it cannot have a guess");
                    }
                }
            }
        }
    }
}
