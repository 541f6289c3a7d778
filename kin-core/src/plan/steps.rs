//! The steps of a plan in words: which joint gives which coordinate, in which order, how, and when that is singular.

use super::tree::{Block, Core, Part, Way};
use crate::constraint::{ConstraintSet, CoordinateKind, Frame, JointTag};
use crate::system::KinematicSystem;
use std::collections::BTreeSet;

/// What kind of step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Given by a formula of what is known.
    Explicit,
    /// A linear system of so many unknowns.
    Linear(usize),
    /// A group that closes without iteration, in one of two ways.
    Closure,
    /// An iteration over so many unknowns.
    Newton(usize),
}

/// A step of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// What kind.
    pub kind: Kind,
    /// Its kinematic group where it is a dyad: `RRR`, `RRP`, …; empty otherwise.
    pub group: String,
    /// Its joints, along the group where it is a dyad.
    pub joints: Vec<usize>,
    /// The coordinates that it gives, each with the joint whose row gives it.
    pub coordinates: Vec<(u32, usize)>,
    /// Its modes, as places in [`SolutionPlan::modes`](super::SolutionPlan::modes).
    pub modes: core::ops::Range<usize>,
    /// Its margins, as places among those of a solution.
    pub margins: core::ops::Range<usize>,
    /// When it is singular.
    pub singular: String,
    pub(super) rows: BTreeSet<usize>,
    /// The bodies of its group, while it is being named.
    bodies: BTreeSet<usize>,
}

/// An assembly mode: a group that closes in two ways, told apart by a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode {
    /// The names of its joints, joined with `-`.
    pub name: String,
    /// Its step.
    pub step: usize,
    /// Its margin.
    pub margin: usize,
}

/// The steps, modes and margins of a plan, as they are found.
#[derive(Debug, Default)]
pub(super) struct Listed {
    pub(super) steps: Vec<Step>,
    pub(super) modes: Vec<Mode>,
    pub(super) margins: usize,
    /// The steps of cores, in their order.
    of_cores: Vec<usize>,
    taken: usize,
}

impl Listed {
    /// Lists the steps of a tree in the order in which it is solved.
    pub(super) fn new(system: &KinematicSystem, tree: &Block, made_of: &[BTreeSet<usize>]) -> Self {
        let mut listed = Self::default();
        listed.block(system, tree, made_of);
        listed.take_in_explicit(&system.set);
        for step in &mut listed.steps {
            name_group(&system.set, step);
        }
        listed
    }

    /// A joint whose rows are explicit (an origin on a known pin, an axis along a known one) is a joint of the group
    /// that its body belongs to all the same.
    fn take_in_explicit(&mut self, set: &ConstraintSet) {
        let explicit = self.steps.iter().filter(|step| step.kind == Kind::Explicit);
        let given: Vec<(usize, usize)> = explicit
            .flat_map(|step| &step.coordinates)
            .filter_map(|&(k, joint)| Some((body_of(set, k)?, joint)))
            .collect();
        for step in self.steps.iter_mut().filter(|step| step.kind != Kind::Explicit) {
            let mut bodies = bodies(set, step);
            loop {
                let before = (bodies.len(), step.joints.len());
                for &(body, joint) in &given {
                    // A body that one of the group's joints turns belongs to it even where nothing else is left of it.
                    match (bodies.contains(&body), step.joints.contains(&joint)) {
                        (true, false) => step.joints.push(joint),
                        (false, true) => _ = bodies.insert(body),
                        _ => {}
                    }
                }
                if before == (bodies.len(), step.joints.len()) {
                    break;
                }
            }
            step.joints.sort_unstable();
            step.bodies = bodies;
        }
    }

    fn block(&mut self, system: &KinematicSystem, block: &Block, made_of: &[BTreeSet<usize>]) {
        for part in &block.parts {
            match part {
                Part::Core(core) => self.add(system, core, made_of),
                Part::Block(block) => self.block(system, block, made_of),
                Part::Pair(pair) => {
                    self.block(system, &pair.inner, made_of);
                    self.attach(system, pair.rows[0], pair.coordinate);
                }
            }
        }
        for pivot in block.pivots.iter().rev() {
            self.attach(system, pivot.row, pivot.coordinate);
        }
    }

    fn add(&mut self, system: &KinematicSystem, core: &Core, made_of: &[BTreeSet<usize>]) {
        let rows: BTreeSet<usize> = core.rows.iter().flat_map(|&row| made_of[row].iter().copied()).collect();
        let kind = match &core.way {
            Way::Linear { matrix, .. } if matrix.len() == 1 => Kind::Explicit,
            Way::Linear { matrix, .. } => Kind::Linear(matrix.len()),
            Way::Newton { residuals } => Kind::Newton(residuals.len()),
            _ => Kind::Closure,
        };
        let joint = |place: usize| {
            let row = core.rows.get(place).or(core.rows.first());
            row.map_or(0, |&row| system.set.rows[row].joint)
        };
        let coordinates = core.coordinates.iter().enumerate().map(|(place, &k)| (k, joint(place))).collect();
        self.of_cores.push(self.steps.len());
        self.steps.push(new_step(system, kind, rows, coordinates));
    }

    /// A coordinate that a row gives once the rest of its group is known.
    fn attach(&mut self, system: &KinematicSystem, row: usize, coordinate: u32) {
        let joint = system.set.rows[row].joint;
        if let Some(step) = self.steps.iter_mut().rev().find(|step| step.rows.contains(&row)) {
            step.coordinates.push((coordinate, joint));
            return;
        }
        if let Some(step) = self.steps.last_mut()
            && step.kind == Kind::Explicit
            && step.joints == [joint]
        {
            step.rows.insert(row);
            step.coordinates.push((coordinate, joint));
            return;
        }
        self.steps.push(new_step(system, Kind::Explicit, BTreeSet::from([row]), vec![(coordinate, joint)]));
    }

    /// The step of the next core.
    pub(super) fn core(&mut self) -> usize {
        self.taken += 1;
        self.of_cores[self.taken - 1]
    }

    /// A new margin of a step.
    pub(super) fn margin(&mut self, step: usize) -> usize {
        let margin = self.margins;
        self.margins += 1;
        self.steps[step].margins = margin..margin + 1;
        margin
    }

    /// A new mode of a step.
    pub(super) fn mode(&mut self, system: &KinematicSystem, step: usize, margin: usize) -> usize {
        let names = self.steps[step].joints.iter().map(|&joint| system.set.joints[joint].name.as_str());
        let plain = names.collect::<Vec<_>>().join("-");
        let place = self.modes.len();
        let taken = self.modes.iter().filter(|mode| mode.name == plain || mode.name.starts_with(&format!("{plain}#")));
        let name = match taken.count() {
            0 => plain,
            others => format!("{plain}#{}", others + 1),
        };
        self.modes.push(Mode { name, step, margin });
        self.steps[step].modes = place..place + 1;
        place
    }
}

fn new_step(system: &KinematicSystem, kind: Kind, rows: BTreeSet<usize>, coordinates: Vec<(u32, usize)>) -> Step {
    let mut joints: Vec<usize> = rows.iter().map(|&row| system.set.rows[row].joint).collect();
    joints.dedup();
    Step {
        kind,
        group: String::new(),
        joints,
        coordinates,
        modes: 0..0,
        margins: 0..0,
        singular: String::new(),
        rows,
        bodies: BTreeSet::new(),
    }
}

fn body_of(set: &ConstraintSet, k: u32) -> Option<usize> {
    match set.coordinates[k as usize].kind {
        CoordinateKind::Pose(body, _) => Some(body),
        CoordinateKind::Scalar => None,
    }
}

/// The bodies that a step places.
fn bodies(set: &ConstraintSet, step: &Step) -> BTreeSet<usize> {
    step.coordinates.iter().filter_map(|&(k, _)| body_of(set, k)).collect()
}

/// Orders the joints of a dyad along it, and says what it is and when it is singular.
fn name_group(set: &ConstraintSet, step: &mut Step) {
    let bodies = std::mem::take(&mut step.bodies);
    if step.kind != Kind::Explicit
        && let Some((joints, letters)) = walk(set, &step.joints, &bodies)
    {
        step.joints = joints;
        step.group = letters;
    }
    let names = |joints: &[usize]| {
        let names: Vec<&str> = joints.iter().map(|&joint| set.joints[joint].name.as_str()).collect();
        match names.as_slice() {
            [] => String::new(),
            [one] => (*one).to_owned(),
            [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
        }
    };
    let joints = names(&step.joints);
    step.singular = match (step.kind, step.group.as_str()) {
        (Kind::Explicit, _) => String::new(),
        (Kind::Closure, "RRR") => format!("{joints} on one line"),
        (Kind::Closure, "RRP") => "the link square to the guide".to_owned(),
        (Kind::Closure, _) => format!("both closures of {joints} in one place"),
        (Kind::Linear(_), "PRP") => "both guides parallel".to_owned(),
        (Kind::Linear(n), _) => format!("determinant {n}×{n} of {joints} zero"),
        (Kind::Newton(n), _) => format!("Jacobian {n}×{n} of {joints} singular"),
    };
}

/// The joints of a dyad from one side to the other, and its letters; `None` where it is none.
fn walk(set: &ConstraintSet, joints: &[usize], bodies: &BTreeSet<usize>) -> Option<(Vec<usize>, String)> {
    let inside = |frame: Option<Frame>| match frame {
        Some(Frame::Body(body)) => bodies.contains(&body).then_some(body),
        _ => None,
    };
    let ends = |joint: usize| set.joints[joint].frames.map(inside);
    let outer: Vec<usize> = joints.iter().copied().filter(|&j| ends(j).iter().flatten().count() == 1).collect();
    let inner: Vec<usize> = joints.iter().copied().filter(|&j| ends(j).iter().flatten().count() == 2).collect();
    let (&[first, last], true) = (outer.as_slice(), inner.len() <= 1 && outer.len() + inner.len() == joints.len())
    else {
        return None;
    };
    if inner.len() + 1 != bodies.len() {
        return None;
    }
    let mut letters = String::new();
    // Entered from outside, crossed from the first body, left to the outside: forwards is from body i to body j.
    let entered = ends(first);
    let start = entered.iter().flatten().next().copied();
    for &joint in [first].iter().chain(&inner).chain(&[last]) {
        let own = ends(joint);
        let forwards =
            if joint == first { own[1].is_some() } else { joint == last && own[0].is_some() || own[0] == start };
        letters.push_str(match (set.joints[joint].tag, forwards) {
            (JointTag::Revolute, _) => "R",
            (JointTag::Translational, _) => "P",
            (JointTag::Distance, _) => "RR",
            // A driven distance is a link whose length changes.
            (JointTag::Driver, _) if set.joints[joint].frames.iter().all(Option::is_some) => "RR",
            (JointTag::PointOnLine, true) => "PR",
            (JointTag::PointOnLine, false) => "RP",
            _ => return None,
        });
    }
    let mut ordered = vec![first];
    ordered.extend(inner);
    ordered.push(last);
    if letters.len() != 3 {
        return None;
    }
    let reversed: String = letters.chars().rev().collect();
    let letters = match reversed.as_str() {
        "RRP" | "RPP" => reversed,
        _ => letters,
    };
    Some((ordered, letters))
}
