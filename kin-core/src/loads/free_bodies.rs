//! Free bodies: the bodies of a mechanism without their joints, each with its own x, y and φ.
//!
//! Held and carried coordinates are not in q, and the ground has no coordinates. To compute reactions, they are
//! introduced as further symbols after those of q; expressions are differentiated with respect to them, and then they
//! are replaced by their values in terms of q.

use crate::constraint::{Assembly, ConstraintSet, Frame, PlacedPoint, Pose};
use crate::expr::{ExprId, Graph, IdMap, Symbol, total_derivatives};
use crate::mechanism::{BodyRef, Formula, Mechanism, Place};
use crate::plan::{Substitution, rewrite};
use std::collections::{BTreeMap, HashMap};

/// An expression with its first and second time derivative, q̈ being a symbol.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) rate: ExprId,
    pub(super) acceleration: ExprId,
}

/// The bodies of a mechanism in two views: *posed*, with all poses in terms of q, and *free*, with x, y and φ of every
/// body and of the ground as coordinates.
pub(super) struct FreeBodies<'m> {
    pub(super) a: Assembly<'m>,
    /// The field of gravity.
    pub(super) field: [ExprId; 2],
    /// The poses of the other view, and the defines that depend on them.
    other: View,
    /// The indices of x, y, φ of the ground and of all bodies among the coordinates of free bodies.
    ground: [u32; 3],
    bodies: Vec<[u32; 3]>,
    /// The values, in terms of q, of the coordinates that are not in q.
    values: BTreeMap<u32, ExprId>,
}

/// The parts that differ between the views: poses of the ground and of bodies, and defines.
struct View {
    ground: [ExprId; 3],
    poses: Vec<Pose>,
    defines: HashMap<(usize, i64), Option<ExprId>>,
}

impl<'m> FreeBodies<'m> {
    /// The bodies of an assembled mechanism; `graph` contains the expressions of the assembly and perhaps more.
    pub(super) fn new(mechanism: &'m Mechanism, set: &ConstraintSet, graph: Graph) -> Self {
        let mut a = Assembly::new(mechanism, &mut ConstraintSet::default());
        a.graph = graph;
        let zero = a.graph.zero();
        let mut next = set.coordinates.len() as u32;
        let mut values = BTreeMap::new();
        let mut introduce = |value: ExprId| {
            values.insert(next, value);
            next += 1;
            next - 1
        };
        let bodies: Vec<[u32; 3]> = set
            .bodies
            .iter()
            .map(|body| std::array::from_fn(|c| body.coordinates[c].unwrap_or_else(|| introduce(body.pose[c]))))
            .collect();
        let ground = [(); 3].map(|()| introduce(zero));
        let mut symbols = |indices: [u32; 3]| indices.map(|k| a.graph.symbol(Symbol::Coordinate(k)));
        let poses = bodies.iter().map(|indices| Pose::Known(symbols(*indices))).collect();
        let other = View { ground: symbols(ground), poses, defines: Default::default() };
        a.poses = set.bodies.iter().map(|body| Pose::Known(body.pose)).collect();
        Self { a, field: [zero; 2], other, ground, bodies, values }
    }

    /// The results of `write` in both views: posed, free.
    pub(super) fn both<T>(&mut self, write: impl Fn(&mut Assembly<'m>) -> T) -> [T; 2] {
        let posed = write(&mut self.a);
        self.exchange();
        let free = write(&mut self.a);
        self.exchange();
        [posed, free]
    }

    /// The result of `write` in the free view.
    pub(super) fn free<T>(&mut self, write: impl FnOnce(&mut Assembly<'m>) -> T) -> T {
        self.exchange();
        let free = write(&mut self.a);
        self.exchange();
        free
    }

    fn exchange(&mut self) {
        std::mem::swap(&mut self.a.ground, &mut self.other.ground);
        std::mem::swap(&mut self.a.poses, &mut self.other.poses);
        std::mem::swap(&mut self.a.defines, &mut self.other.defines);
    }

    /// The indices of x, y, φ of a frame among the coordinates of free bodies.
    pub(super) fn indices(&self, frame: Frame) -> [u32; 3] {
        match frame {
            Frame::Ground => self.ground,
            Frame::Body(index) => self.bodies[index],
        }
    }

    /// x, y, φ of a frame in terms of q.
    pub(super) fn pose(&mut self, frame: Frame) -> [ExprId; 3] {
        match frame {
            Frame::Ground => [self.a.graph.zero(); 3],
            Frame::Body(place) => self.a.pose_of(place),
        }
    }

    /// A point in both views.
    pub(super) fn place(&mut self, place: &Place) -> [PlacedPoint; 2] {
        self.both(|a| a.place(place))
    }

    /// The angle of a body in both views.
    pub(super) fn angle(&mut self, body: &BodyRef) -> [ExprId; 2] {
        self.both(|a| a.pose(body)[2])
    }

    /// A formula in terms of q.
    pub(super) fn formula(&mut self, formula: &Formula) -> ExprId {
        self.a.formula(formula)
    }

    /// An expression in terms of q with its time derivatives.
    pub(super) fn motion(&mut self, e: ExprId) -> Motion {
        let graph = &mut self.a.graph;
        let zero = graph.zero();
        let Some(jet) = total_derivatives(graph, &[e]).pop() else { return Motion { rate: zero, acceleration: zero } };
        let mut acceleration = jet.rest;
        for (k, coefficient) in jet.gradient {
            let q_ddot = graph.symbol(Symbol::Acceleration(k));
            let product = graph.mul(coefficient, q_ddot);
            acceleration = graph.add(acceleration, product);
        }
        Motion { rate: jet.rate, acceleration }
    }

    /// Replaces the coordinates that are not in q by their values.
    pub(super) fn posed(&mut self, free: &mut [ExprId]) {
        let rates: BTreeMap<u32, ExprId> = {
            let values: Vec<(u32, ExprId)> = self.values.iter().map(|(k, value)| (*k, *value)).collect();
            let roots: Vec<ExprId> = values.iter().map(|(_, value)| *value).collect();
            let jets = total_derivatives(&mut self.a.graph, &roots);
            values.into_iter().zip(jets).map(|((k, _), jet)| (k, jet.rate)).collect()
        };
        let (mut known, mut poses) = (IdMap::default(), Posed { values: &self.values, rates });
        for id in free {
            *id = rewrite(&mut self.a.graph, *id, &mut known, &mut poses);
        }
    }
}

/// The substitution of coordinates that are not in q.
struct Posed<'v> {
    values: &'v BTreeMap<u32, ExprId>,
    rates: BTreeMap<u32, ExprId>,
}

impl Substitution for Posed<'_> {
    fn symbol(&mut self, _graph: &mut Graph, symbol: Symbol) -> Option<ExprId> {
        match symbol {
            Symbol::Coordinate(k) => self.values.get(&k).copied(),
            Symbol::Rate(k) => self.rates.get(&k).copied(),
            _ => None,
        }
    }
}
