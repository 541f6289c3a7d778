//! The equilibrium of free bodies: the generalized forces of loads and inertia that joints and drivers must balance.
//!
//! ```text
//! M q̈ + Φ_qᵀ λ = Q        r = Q − M q̈ = Σ force · ∂quantity/∂q        Φ_qᵀ λ = r
//! ```
//! The same equations hold for free bodies, where every held or carried component v is a coordinate with a row of its
//! own, v − e = 0. The multiplier of this row follows from the equation for v. Bodies at the end of a chain of carriers
//! come first, because their rows also contain the coordinates of their carriers.

use super::free_bodies::FreeBodies;
use super::load::Acting;
use crate::constraint::{Assembly, ConstraintSet, Frame, indexed};
use crate::expr::{ExprId, total_derivatives, velocity_derivatives};
use crate::joints::rows_of;
use crate::mechanism::{BodyOrigin, Component, Source};
use std::collections::BTreeMap;

/// The derivatives of a row with respect to the coordinates of free bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct FreeRow {
    /// ∂Φ/∂coordinate, or ∂η/∂rate of a row of velocity level.
    pub(super) gradient: BTreeMap<u32, ExprId>,
    /// Φ_t, or b of a row of velocity level.
    pub(super) partial_t: ExprId,
}

/// A row v − e = 0 of a coordinate that is held or carried.
#[derive(Clone, Debug)]
pub(super) struct Hold {
    /// The body and the component of its pose.
    pub(super) body: usize,
    pub(super) component: Component,
    /// The index of v among the coordinates of free bodies.
    pub(super) coordinate: u32,
    pub(super) row: FreeRow,
}

/// The parts of the equilibrium of a mechanism that do not depend on λ.
pub(super) struct Equilibrium {
    /// r for the coordinates in q.
    pub(super) posed: Vec<ExprId>,
    /// r for the coordinates of free bodies.
    free: BTreeMap<u32, ExprId>,
    /// The rows of Φ.
    pub(super) rows: Vec<FreeRow>,
    /// The rows of held and carried coordinates; those of a body come after those of the body that carries it.
    pub(super) holds: Vec<Hold>,
}

impl Equilibrium {
    pub(super) fn new(bodies: &mut FreeBodies<'_>, set: &ConstraintSet, acting: &[Acting]) -> Self {
        let rows = free_rows(bodies, set);
        let holds = holds(bodies, set);
        let posed = along(bodies, acting, |work| work.posed);
        let free = along(bodies, acting, |work| work.free);
        let zero = bodies.a.graph.zero();
        let posed = (0..set.coordinates.len()).map(|k| posed.get(&(k as u32)).copied().unwrap_or(zero)).collect();
        let mut all = Self { posed, free, rows, holds };
        all.replace_coordinates(bodies);
        all
    }

    /// Expresses everything in terms of q.
    fn replace_coordinates(&mut self, bodies: &mut FreeBodies<'_>) {
        let rows = self.rows.iter_mut().chain(self.holds.iter_mut().map(|hold| &mut hold.row));
        let entries = rows.flat_map(|row| row.gradient.values_mut().chain([&mut row.partial_t]));
        let mut entries: Vec<&mut ExprId> = entries.chain(self.free.values_mut()).collect();
        let mut values: Vec<ExprId> = entries.iter().map(|id| **id).collect();
        bodies.posed(&mut values);
        entries.iter_mut().zip(values).for_each(|(entry, value)| **entry = value);
        for row in self.rows.iter_mut().chain(self.holds.iter_mut().map(|hold| &mut hold.row)) {
            row.gradient.retain(|_, entry| !bodies.a.graph.is_zero(*entry));
        }
    }

    /// The multipliers of the rows of held and carried coordinates, given those of Φ.
    pub(super) fn multipliers_of_holds(&self, bodies: &mut FreeBodies<'_>, lambda: &[ExprId]) -> Vec<ExprId> {
        let graph = &mut bodies.a.graph;
        let zero = graph.zero();
        let mut multipliers = vec![zero; self.holds.len()];
        for (k, hold) in self.holds.iter().enumerate().rev() {
            let mut value = self.free.get(&hold.coordinate).copied().unwrap_or(zero);
            let of_rows = self.rows.iter().zip(lambda).map(|(row, multiplier)| (row, *multiplier));
            let of_holds = self.holds.iter().map(|hold| &hold.row).zip(multipliers.iter().copied()).skip(k + 1);
            for (row, multiplier) in of_rows.chain(of_holds) {
                if let Some(entry) = row.gradient.get(&hold.coordinate) {
                    let product = graph.mul(*entry, multiplier);
                    value = graph.sub(value, product);
                }
            }
            multipliers[k] = value;
        }
        multipliers
    }
}

/// Σ force · ∂quantity/∂coordinate.
fn along(
    bodies: &mut FreeBodies<'_>,
    acting: &[Acting],
    quantity: impl Fn(&super::load::Work) -> ExprId,
) -> BTreeMap<u32, ExprId> {
    let work: Vec<_> = acting.iter().flat_map(|acting| &acting.work).collect();
    let quantities: Vec<ExprId> = work.iter().map(|work| quantity(work)).collect();
    let graph = &mut bodies.a.graph;
    let jets = total_derivatives(graph, &quantities);
    let mut sums = BTreeMap::new();
    for (work, jet) in work.into_iter().zip(jets) {
        for (k, entry) in jet.gradient {
            let product = graph.mul(work.force, entry);
            let zero = graph.zero();
            let sum = sums.entry(k).or_insert(zero);
            *sum = graph.add(*sum, product);
        }
    }
    sums
}

/// The rows of Φ with the poses of all bodies free.
fn free_rows(bodies: &mut FreeBodies<'_>, set: &ConstraintSet) -> Vec<FreeRow> {
    let values = bodies.free(|a| {
        let mut values = Vec::new();
        for joint in &a.mechanism.joints {
            for (_, index) in Assembly::instances(joint.range) {
                a.index = index;
                let rows = rows_of(a, &joint.operands);
                // The outline of a curve, which is for drawings, is not needed here.
                a.outline = None;
                values.extend(rows.residuals.into_iter().map(|(_, _, phi)| (phi, None)));
                values.extend(rows.velocity.map(|row| (row.eta, Some(row.b))));
            }
        }
        values
    });
    debug_assert_eq!(values.len(), set.rows.len());
    let graph = &mut bodies.a.graph;
    let roots: Vec<ExprId> = values.iter().map(|(value, _)| *value).collect();
    let of_position = |velocity: bool| {
        let zero = graph.zero();
        roots.iter().zip(&values).map(|(root, (_, b))| if b.is_some() == velocity { *root } else { zero }).collect()
    };
    let mut of_position = of_position;
    let (holonomic, velocity): (Vec<_>, Vec<_>) = (of_position(false), of_position(true));
    let jets = total_derivatives(graph, &holonomic);
    let of_rates = velocity_derivatives(graph, &velocity);
    let rows = values.iter().zip(jets).zip(of_rates).map(|(((_, b), jet), of_rates)| match b {
        None => FreeRow { gradient: jet.gradient.into_iter().collect(), partial_t: jet.partial_t },
        Some(b) => FreeRow { gradient: of_rates.gradient.into_iter().collect(), partial_t: *b },
    });
    rows.collect()
}

/// The rows of held and carried coordinates.
fn holds(bodies: &mut FreeBodies<'_>, set: &ConstraintSet) -> Vec<Hold> {
    let mut order: Vec<usize> = (0..set.bodies.len()).collect();
    order.sort_by_key(|&body| depth(set, body));
    let mut holds = Vec::new();
    for body in order {
        let (family, index) = set.bodies[body].family;
        let indices = bodies.indices(Frame::Body(body));
        for component in Component::ALL {
            let value = bodies.free(|a| {
                let body = &a.mechanism.bodies[family];
                a.index = index as i64;
                match body.source(component) {
                    Source::Free => None,
                    Source::Held(formula) => Some(a.formula(formula)),
                    Source::Carried(carrier) => Some(a.place(carrier).r[component as usize]),
                }
            });
            let Some(value) = value else { continue };
            let graph = &mut bodies.a.graph;
            let Some(jet) = total_derivatives(graph, &[value]).pop() else { continue };
            let mut gradient: BTreeMap<u32, ExprId> =
                jet.gradient.into_iter().map(|(k, entry)| (k, graph.neg(entry))).collect();
            let coordinate = indices[component as usize];
            gradient.insert(coordinate, graph.number(1.0));
            let row = FreeRow { gradient, partial_t: graph.neg(jet.partial_t) };
            holds.push(Hold { body, component, coordinate, row });
        }
    }
    holds
}

/// The number of bodies in the chain of carriers of a body.
fn depth(set: &ConstraintSet, index: usize) -> usize {
    let mut depth = 0;
    let mut next = set.bodies[index].carried_by;
    while let Some(Frame::Body(carrier)) = next {
        depth += 1;
        next = set.bodies[carrier].carried_by;
    }
    depth
}

impl Hold {
    /// `b.x`, or `b.origin` for the origin of a carried body.
    pub(super) fn name(&self, bodies: &FreeBodies<'_>, set: &ConstraintSet) -> String {
        let (name, (family, _)) = (&set.bodies[self.body].name, set.bodies[self.body].family);
        let carried = matches!(bodies.a.mechanism.bodies[family].origin_at, BodyOrigin::Carried(_));
        match (carried, self.component) {
            (true, Component::X | Component::Y) => indexed(&format!("{name}.origin"), false, 0),
            _ => format!("{name}.{}", self.component),
        }
    }
}
