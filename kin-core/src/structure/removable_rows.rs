//! Determines redundant rows that can be left out of a solution for all coordinates.
//!
//! To preserve the rank, any row of a circuit (a minimal set of linearly dependent rows) could be left out. But rows
//! may be redundant only for special dimensions: three cranks fix a platform in general, and one of them is redundant
//! if they are parallel. Therefore the rows that are kept have to connect the drivers with all other bodies, and the
//! row that is left out belongs to the joint that closes the circuit.

use super::diagnosis::{POSE_SEEDS, RandomJacobian, Redundancy};
use super::field::Draw;
use crate::constraint::{CoordinateKind, Frame, RowMeaning};
use crate::system::{KinematicSystem, RowClass};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Φ_q at a random pose, from which several sets of rows can be chosen.
pub(crate) struct RemovableRows<'a> {
    system: &'a KinematicSystem,
    jacobian: RandomJacobian<'a>,
    /// Driving rows that, for general dimensions, depend only on rows that are not driving.
    driving: Vec<usize>,
    /// Rows of joints between two bodies that another joint already connects, where both joints together would lock the
    /// two bodies.
    doubled: BTreeSet<usize>,
}

impl<'a> RemovableRows<'a> {
    pub(crate) fn new(system: &'a KinematicSystem) -> Self {
        // One random pose suffices: if its rank is too small, the kept rows are singular, which a margin reports.
        let jacobian = RandomJacobian::new(system, Draw(POSE_SEEDS[0]));
        // A driver whose row depends only on rows that are not driving can move the mechanism for special dimensions
        // only. One of those rows has to be left out then, not the driving row.
        let classes = &system.classes;
        let rigid = |found: &Redundancy| {
            classes[found.row].driving && !found.circuit.iter().any(|&other| classes[other].driving)
        };
        let redundant = jacobian.redundant(jacobian.drivers_last(), |_, _| {});
        let driving = redundant.iter().filter(|found| rigid(found)).map(|found| found.row).collect();
        let doubled = doubled(system, &jacobian);
        Self { system, jacobian, driving, doubled }
    }

    /// The rows to leave out: the last row of every circuit. The order is: the driving rows in `driving`, rows that are
    /// not driving, rows that a moving held coordinate makes rheonomic, other driving rows; within each of these groups
    /// the order of `places`. The rows in `doubled` come after all of them, and the rows `preferred`, which are to be
    /// left out, last.
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
        // Next come the bodies of rows that a moving held coordinate makes rheonomic.
        queue.extend(nodes_of(|class| class.leads()));
        // All other bodies come last.
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

    /// The bodies of every row, each identified by the first of its coordinates; a scalar counts as a body.
    fn nodes(&self) -> Vec<BTreeSet<usize>> {
        let coordinates = &self.system.set.coordinates;
        let node = |k: u32| match coordinates[k as usize].kind {
            CoordinateKind::Pose(body, _) => {
                let is_of_body = |kind| matches!(kind, CoordinateKind::Pose(other, _) if other == body);
                coordinates.iter().position(|coordinate| is_of_body(coordinate.kind)).unwrap_or(k as usize)
            }
            CoordinateKind::Scalar => k as usize,
        };
        let first: Vec<usize> = (0..coordinates.len() as u32).map(node).collect();
        let equations = self.system.equations.iter();
        equations.map(|equation| equation.phi_q.iter().map(|(k, _)| first[*k as usize]).collect()).collect()
    }
}

/// The rows of joints that would lock two bodies already connected by another joint with at least as many rows. Such a
/// joint is intentionally redundant (two pins on one axis, two guides along one line). Joints with rows for angles only
/// are not included, since they may be intended to lock the bodies.
fn doubled(system: &KinematicSystem, jacobian: &RandomJacobian<'_>) -> BTreeSet<usize> {
    let set = &system.set;
    let number = |frame: Frame| match frame {
        Frame::Ground => 0,
        Frame::Body(body) => body + 1,
    };
    let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (index, joint) in set.joints.iter().enumerate() {
        let of_places = |meaning: &RowMeaning| {
            matches!(meaning, RowMeaning::Coincidence(_) | RowMeaning::AcrossAxis(_) | RowMeaning::SquaredDistance)
        };
        let says_places = !joint.kind.drives() && set.meanings(joint).iter().any(of_places);
        if let ([Some(a), Some(b)], true) = (joint.frames, says_places) {
            let [a, b] = [a, b].map(number);
            between.entry([a.min(b), a.max(b)]).or_default().push(index);
        }
    }
    let mut out = BTreeSet::new();
    for mut joints in between.into_values().filter(|joints| joints.len() > 1) {
        let rows = |joint: usize| (0..set.rows.len()).filter(move |&row| set.rows[row].joint == joint);
        joints.sort_by_key(|&joint| std::cmp::Reverse(rows(joint).count()));
        let mut rows_of_pair: Vec<usize> = Vec::new();
        for (k, joint) in joints.into_iter().enumerate() {
            rows_of_pair.extend(rows(joint));
            if k > 0 && jacobian.rank_of(&rows_of_pair) == 3 {
                out.extend(rows(joint));
            }
        }
    }
    out
}
