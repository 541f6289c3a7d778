//! Determines redundant rows that a solution for all coordinates can leave out.
//!
//! For the rank, any row of a circuit could be left out. But rows may be redundant only for special dimensions: three
//! cranks hold a platform in general, and one of them is redundant if they are parallel. Therefore the rows that are
//! kept have to lead from the drivers to all other bodies, and the row that is left out belongs to the joint that
//! closes the circuit.

use super::diagnosis::{DRAWS, RandomJacobian, Redundancy};
use super::field::Draw;
use crate::constraint::{CoordinateKind, Frame, RowMeaning};
use crate::system::{KinematicSystem, RowClass};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Φ_q at a random pose, from which several sets of rows can be chosen.
pub(crate) struct RemovableRows<'a> {
    system: &'a KinematicSystem,
    jacobian: RandomJacobian<'a>,
    /// Driving rows that are redundant because the other rows alone are rigid for general dimensions.
    driving: Vec<usize>,
    /// Rows of joints between bodies that other joints already connect, such that together they would be rigidly
    /// locked.
    doubled: BTreeSet<usize>,
}

impl<'a> RemovableRows<'a> {
    pub(crate) fn new(system: &'a KinematicSystem) -> Self {
        // One random pose suffices: should it be a special one, the kept rows are singular, which a margin reports.
        let jacobian = RandomJacobian::new(system, Draw(DRAWS[0]));
        // If the geometry is rigid for general dimensions, a driving row is redundant to it. A mechanism that is
        // driven nevertheless has special dimensions, so a row of the geometry has to be left out and not the driver.
        let classes = &system.classes;
        let rigid = |found: &Redundancy| {
            classes[found.row].driving && !found.circuit.iter().any(|&other| classes[other].driving)
        };
        let redundant = jacobian.redundant(jacobian.drivers_last(), |_, _| {});
        let driving = redundant.iter().filter(|found| rigid(found)).map(|found| found.row).collect();
        let doubled = doubled(system, &jacobian);
        Self { system, jacobian, driving, doubled }
    }

    /// The rows to leave out: the last row of every circuit. The order is: driving rows that the geometry alone makes
    /// redundant, other rows, rows that a moving held coordinate drives, other driving rows, and within each of these
    /// groups by `places`. Doubled joints come after all of them, and the rows `preferred` last.
    pub(crate) fn rows(&self, places: &[usize], preferred: &[usize]) -> Vec<Redundancy> {
        let key = |row: usize| {
            let class = self.system.classes[row];
            let level = match self.driving.contains(&row) {
                true => 0,
                false => 1 + u8::from(class.leads()) + u8::from(class.driving),
            };
            (preferred.contains(&row), self.doubled.contains(&row), level, places[row])
        };
        self.jacobian.redundant(key, |_, _| {})
    }

    /// The positions of the rows in the order of declaration.
    pub(crate) fn declared(&self) -> Vec<usize> {
        (0..self.system.equations.len()).collect()
    }

    /// The positions of the rows on a breadth-first walk from the driven bodies to all others: a row is listed as soon
    /// as all its bodies have been reached.
    pub(crate) fn walked(&self) -> Vec<usize> {
        let nodes = self.nodes();
        let all = self.system.classes.iter().zip(&nodes);
        let nodes_of = |leads: fn(&RowClass) -> bool| {
            let rows = all.clone().filter(move |(class, _)| leads(class));
            rows.flat_map(|(_, nodes)| nodes.iter().copied())
        };
        let mut queue: VecDeque<usize> = nodes_of(|class| class.driving).collect();
        // Bodies that are joined to something that moves come next.
        queue.extend(nodes_of(|class| class.leads()));
        // Bodies that are connected to the ground only come last.
        queue.extend(all.flat_map(|(_, nodes)| nodes.iter().copied()));
        let mut rows_of: Vec<Vec<usize>> = vec![Vec::new(); self.system.set.coordinates.len()];
        nodes.iter().enumerate().for_each(|(row, nodes)| nodes.iter().for_each(|&node| rows_of[node].push(row)));
        let mut missing: Vec<usize> = nodes.iter().map(BTreeSet::len).collect();
        let mut places = vec![0; nodes.len()];
        let (mut reached, mut next) = (BTreeSet::new(), 0);
        // Neighbours of reached bodies come before the remaining start bodies.
        let mut near = VecDeque::new();
        while let Some(node) = near.pop_front().or_else(|| queue.pop_front()) {
            if !reached.insert(node) {
                continue;
            }
            for &row in &rows_of[node] {
                missing[row] -= 1;
                if missing[row] == 0 {
                    next += 1;
                    places[row] = next;
                }
                near.extend(nodes[row].iter().filter(|other| !reached.contains(other)));
            }
        }
        places
    }

    /// The bodies of every row, each identified by the first of its coordinates; scalars stand for themselves.
    fn nodes(&self) -> Vec<BTreeSet<usize>> {
        let coordinates = &self.system.set.coordinates;
        let node = |k: u32| match coordinates[k as usize].kind {
            CoordinateKind::Pose(body, _) => {
                let own = |kind| matches!(kind, CoordinateKind::Pose(other, _) if other == body);
                coordinates.iter().position(|coordinate| own(coordinate.kind)).unwrap_or(k as usize)
            }
            CoordinateKind::Scalar => k as usize,
        };
        let first: Vec<usize> = (0..coordinates.len() as u32).map(node).collect();
        let equations = self.system.equations.iter();
        equations.map(|equation| equation.phi_q.iter().map(|(k, _)| first[*k as usize]).collect()).collect()
    }
}

/// The rows of joints that would lock two bodies which another joint with at least as many rows connects already. Such
/// a joint is meant to be redundant (two pins on one axis, two guides along one line). Rows of angles alone are not
/// included, since they may be meant to lock the bodies.
fn doubled(system: &KinematicSystem, jacobian: &RandomJacobian<'_>) -> BTreeSet<usize> {
    let set = &system.set;
    let number = |frame: Frame| match frame {
        Frame::Ground => 0,
        Frame::Body(body) => body + 1,
    };
    let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (place, joint) in set.joints.iter().enumerate() {
        let of_places = |meaning: &RowMeaning| {
            matches!(meaning, RowMeaning::Coincidence(_) | RowMeaning::AcrossAxis(_) | RowMeaning::SquaredDistance)
        };
        let says_places = !joint.kind.drives() && set.meanings(joint).iter().any(of_places);
        if let ([Some(a), Some(b)], true) = (joint.frames, says_places) {
            let [a, b] = [a, b].map(number);
            between.entry([a.min(b), a.max(b)]).or_default().push(place);
        }
    }
    let mut out = BTreeSet::new();
    for mut joints in between.into_values().filter(|joints| joints.len() > 1) {
        let rows = |joint: usize| (0..set.rows.len()).filter(move |&row| set.rows[row].joint == joint);
        joints.sort_by_key(|&joint| std::cmp::Reverse(rows(joint).count()));
        let mut own: Vec<usize> = Vec::new();
        for (k, joint) in joints.into_iter().enumerate() {
            own.extend(rows(joint));
            if k > 0 && jacobian.rank_of(&own) == 3 {
                out.extend(rows(joint));
            }
        }
    }
    out
}
