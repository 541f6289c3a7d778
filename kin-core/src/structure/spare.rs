//! Which rows a solution of all coordinates can leave out.
//!
//! Any rows that depend on the others would do for the rank. But what is redundant at all may be so for special dimensions
//! only, as parallel cranks are: three of them hold a platform, in general, and say nothing of it where they are parallel.
//! So the rows that are kept have to lead from what drives to everything else, and a circuit is left at the joint that
//! closes it.

use super::diagnosis::{DRAWS, Drawn, Redundancy};
use super::field::Draw;
use crate::constraint::{CoordinateKind, Frame, RowMeaning};
use crate::system::{KinematicSystem, RowClass};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Φ_q at a drawn pose, for one choice after another.
pub(crate) struct Spare<'a> {
    system: &'a KinematicSystem,
    drawn: Drawn<'a>,
    /// Driving rows that the geometry leaves no room for.
    driving: Vec<usize>,
    /// Rows of joints between bodies that other joints connect already, so that nothing would be free between them.
    doubled: BTreeSet<usize>,
}

impl<'a> Spare<'a> {
    pub(crate) fn new(system: &'a KinematicSystem) -> Self {
        // One draw will do: should it be unlucky, the rows that are kept are singular, and a margin says so.
        let drawn = Drawn::new(system, Draw(DRAWS[0]));
        // Geometry that is rigid but for special dimensions makes a driving row redundant all by itself: somebody who
        // drives such a mechanism has those dimensions, and it is the geometry that says something twice.
        let classes = &system.classes;
        let rigid = |found: &Redundancy| {
            classes[found.row].driving && !found.circuit.iter().any(|&other| classes[other].driving)
        };
        let redundant = drawn.redundant(drawn.drivers_last(), |_, _| {});
        let driving = redundant.iter().filter(|found| rigid(found)).map(|found| found.row).collect();
        let doubled = doubled(system, &drawn);
        Self { system, drawn, driving, doubled }
    }

    /// The rows to leave out: the last of every circuit by `places`, `rather` before all others, then joints that are there
    /// twice. Driving rows are left out only where other driving rows leave no room for them, and joints of bodies that a
    /// held coordinate moves only before these.
    pub(crate) fn rows(&self, places: &[usize], rather: &[usize]) -> Vec<Redundancy> {
        let key = |row: usize| {
            let class = self.system.classes[row];
            let level = match self.driving.contains(&row) {
                true => 0,
                false => 1 + u8::from(class.leads()) + u8::from(class.driving),
            };
            (rather.contains(&row), self.doubled.contains(&row), level, places[row])
        };
        self.drawn.redundant(key, |_, _| {})
    }

    /// The places of the rows in the order of declaration.
    pub(crate) fn declared(&self) -> Vec<usize> {
        (0..self.system.equations.len()).collect()
    }

    /// The places of the rows on a walk from the bodies that are driven to all others, breadth first: each row comes as
    /// soon as all its bodies have been reached.
    pub(crate) fn walked(&self) -> Vec<usize> {
        let nodes = self.nodes();
        let all = self.system.classes.iter().zip(&nodes);
        let nodes_of = |leads: fn(&RowClass) -> bool| {
            let rows = all.clone().filter(move |(class, _)| leads(class));
            rows.flat_map(|(_, nodes)| nodes.iter().copied())
        };
        let mut queue: VecDeque<usize> = nodes_of(|class| class.driving).collect();
        // Bodies that are fastened to something that moves come next.
        queue.extend(nodes_of(|class| class.leads()));
        // Whatever nothing leads to but the ground comes after that.
        queue.extend(all.flat_map(|(_, nodes)| nodes.iter().copied()));
        let mut rows_of: Vec<Vec<usize>> = vec![Vec::new(); self.system.set.coordinates.len()];
        nodes.iter().enumerate().for_each(|(row, nodes)| nodes.iter().for_each(|&node| rows_of[node].push(row)));
        let mut missing: Vec<usize> = nodes.iter().map(BTreeSet::len).collect();
        let mut places = vec![0; nodes.len()];
        let (mut reached, mut next) = (BTreeSet::new(), 0);
        // Neighbours go before the seeds that are left.
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

    /// The bodies of every row, each by the first of its coordinates; scalars stand for themselves.
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

/// The rows of joints that would lock two bodies together which another joint of as many rows or more connects: it is
/// meant to say the same, as two pins on one axis or two guides along one line do. Rows of angles alone may be meant to lock.
fn doubled(system: &KinematicSystem, drawn: &Drawn<'_>) -> BTreeSet<usize> {
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
            if k > 0 && drawn.rank_of(&own) == 3 {
                out.extend(rows(joint));
            }
        }
    }
    out
}
