//! Expressions of bodies, points and axes in the inertial frame.

use super::assembly::Assembly;
use super::pose::{PlacedAxis, PlacedPoint, Pose};
use crate::expr::{ExprId, Symbol};
use crate::mechanism::{Axis, Body, BodyOrigin, BodyRef, Component, Function, Place, Source};
use crate::vocabulary::Frame;

impl<'m> Assembly<'m> {
    /// The frame that a body reference denotes when the index variable is `index`, if it exists.
    pub(crate) fn resolve(&self, body: &BodyRef, index: i64) -> Option<Frame> {
        match body {
            BodyRef::Ground(_) => Some(Frame::Ground),
            BodyRef::Body { family, index: of, .. } => {
                let found = of.at(index).filter(|i| *i < self.members(*family))?;
                Some(Frame::Body(self.first_body[*family] + found))
            }
        }
    }

    /// The number of bodies of a family.
    fn members(&self, family: usize) -> usize {
        self.mechanism.bodies.get(family).map_or(0, |b| b.len.unwrap_or(1))
    }

    /// The frame that a body reference denotes for the current index variable.
    pub(crate) fn frame(&mut self, body: &BodyRef) -> Option<Frame> {
        let found = self.resolve(body, self.index);
        if let (None, BodyRef::Body { family, origin, .. }) = (found, body) {
            let len = self.members(*family);
            self.error(*origin, format!("the index is out of range: there are {len} bodies of this name"));
        }
        found
    }

    /// x, y, φ of a body for the current index variable.
    pub(crate) fn pose(&mut self, body: &BodyRef) -> [ExprId; 3] {
        let frame = self.frame(body).unwrap_or(Frame::Ground);
        self.pose_in(frame)
    }

    fn pose_in(&mut self, frame: Frame) -> [ExprId; 3] {
        match frame {
            Frame::Body(place) => self.pose_of(place),
            Frame::Ground => self.ground,
        }
    }

    /// x, y, φ of the body at `index`. The poses of its carriers are built first, without recursion.
    pub(crate) fn pose_of(&mut self, index: usize) -> [ExprId; 3] {
        let (mut chain, mut next) = (Vec::new(), Some(index));
        while let Some(index) = next {
            match self.poses[index] {
                Pose::Known(_) => break,
                Pose::Building => {
                    let origin = self.family_of(index).0.origin;
                    self.error(origin, "this body is carried by itself, directly or through other bodies");
                    self.poses[index] = Pose::Known([self.graph.zero(); 3]);
                    break;
                }
                Pose::Unknown => {
                    self.poses[index] = Pose::Building;
                    chain.push(index);
                    next = self.carrier_of(index);
                }
            }
        }
        for index in chain.into_iter().rev() {
            self.poses[index] = Pose::Known(self.build_pose(index));
        }
        match self.poses[index] {
            Pose::Known(pose) => pose,
            _ => [self.graph.zero(); 3],
        }
    }

    /// The family of the body at `index`, and the body's index in it.
    fn family_of(&self, index: usize) -> (&'m Body, i64) {
        let family = self.first_body.partition_point(|first| *first <= index) - 1;
        (&self.mechanism.bodies[family], (index - self.first_body[family]) as i64)
    }

    /// The body that carries the origin of the body at `place`.
    fn carrier_of(&self, place: usize) -> Option<usize> {
        let (body, index) = self.family_of(place);
        let BodyOrigin::Carried(carrier) = &body.origin_at else { return None };
        match self.resolve(&carrier.body, index) {
            Some(Frame::Body(carrier)) => Some(carrier),
            _ => None,
        }
    }

    fn build_pose(&mut self, place: usize) -> [ExprId; 3] {
        let (body, index) = self.family_of(place);
        let outer = std::mem::replace(&mut self.index, index);
        let pose = Component::ALL.map(|component| match body.source(component) {
            Source::Free => match self.coordinates_of[place][component as usize] {
                Some(k) => self.graph.symbol(Symbol::Coordinate(k)),
                None => self.graph.zero(),
            },
            Source::Held(formula) => self.formula(formula),
            Source::Carried(carrier) => self.place(carrier).r[component as usize],
        });
        self.index = outer;
        pose
    }

    /// The position of a body-fixed point in the inertial frame.
    pub(crate) fn place(&mut self, place: &Place) -> PlacedPoint {
        let frame = self.frame(&place.body).unwrap_or(Frame::Ground);
        let [x, y, angle] = self.pose_in(frame);
        let local = [self.formula(&place.x), self.formula(&place.y)];
        let rho = self.graph.rotate(angle, local);
        let r = [self.graph.add(x, rho[0]), self.graph.add(y, rho[1])];
        PlacedPoint { frame, local, base: [x, y], r, angle }
    }

    /// The unit vector v̂ = v/|v| of an axis fixed in the frame of `p`.
    pub(crate) fn axis(&mut self, axis: &Axis, p: &PlacedPoint) -> PlacedAxis {
        let v = [self.formula(&axis.x), self.formula(&axis.y)];
        let local = match (self.graph.literal(v[0]), self.graph.literal(v[1])) {
            (Some(x), Some(y)) => {
                let norm = x.hypot(y);
                if norm == 0.0 {
                    self.degenerate(
                        axis.origin,
                        "this axis",
                        "is (0, 0) and has no direction; kin normalises it, so that any other length will do",
                    );
                    v
                } else {
                    [self.graph.number(x / norm), self.graph.number(y / norm)]
                }
            }
            _ => {
                let square = self.graph.plain_dot(v, v);
                let norm = self.graph.call(Function::Sqrt, square);
                [self.graph.div(v[0], norm), self.graph.div(v[1], norm)]
            }
        };
        PlacedAxis { local, u: self.graph.rotate(p.angle, local), angle: p.angle }
    }

    /// The squared distance |r_Q − r_P|².
    pub(crate) fn square_of_distance(&mut self, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
        let d = [0, 1].map(|k| self.graph.sub(q.r[k], p.r[k]));
        let (x, y) = (self.graph.square(d[0]), self.graph.square(d[1]));
        self.graph.add(x, y)
    }

    /// The distance |r_Q − r_P| of points that may coincide.
    pub(crate) fn distance_of_points(&mut self, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
        let distance = self.distance(p, q);
        self.distances.insert(distance);
        distance
    }

    /// The distance |r_Q − r_P|.
    pub(crate) fn distance(&mut self, p: &PlacedPoint, q: &PlacedPoint) -> ExprId {
        let square = self.square_of_distance(p, q);
        self.graph.call(Function::Sqrt, square)
    }
}
