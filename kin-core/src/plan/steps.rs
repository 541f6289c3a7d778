//! Lists the steps of a plan in order, with their modes and margins.

use super::groups::{letters_of_method, letters_of_pair, name_group};
use super::step::{Mode, Step, StepId};
use super::tree::{Block, BlockPart, Core, SolutionMethod};
use crate::constraint::{ConstraintSet, CoordinateKind};
use crate::expr::Graph;
use crate::system::KinematicSystem;
use crate::vocabulary::StepKind;
use std::collections::{BTreeMap, BTreeSet};

/// The steps, modes and margins of a plan, in the order in which they are found.
#[derive(Debug, Default)]
pub(super) struct StepList {
    pub(super) steps: Vec<Step>,
    pub(super) modes: Vec<Mode>,
    pub(super) margins: usize,
    /// The step that gives each coordinate.
    giving: BTreeMap<u32, StepId>,
    /// The step of each margin.
    of_margins: Vec<StepId>,
    /// The final index of each margin, by the order in which margins were found; empty until they are numbered.
    indices: Vec<usize>,
}

impl StepList {
    /// Lists the steps of a tree in order of solution.
    pub(super) fn new(system: &KinematicSystem, graph: &Graph, tree: &Block, source_rows: &[BTreeSet<usize>]) -> Self {
        let mut listed = Self::default();
        listed.block((system, graph), tree, source_rows);
        let given = |(index, step): (usize, &Step)| {
            step.coordinates.iter().map(|&(k, _)| (k, StepId(index))).collect::<Vec<_>>()
        };
        listed.giving = listed.steps.iter().enumerate().flat_map(given).collect();
        listed.add_explicit_joints(&system.set);
        for step in &mut listed.steps {
            name_group(&system.set, step);
        }
        listed
    }

    /// Adds joints whose rows are explicit (an origin on a known pin, an axis along a known axis) to the group of the
    /// body that they position.
    fn add_explicit_joints(&mut self, set: &ConstraintSet) {
        let explicit = self.steps.iter().filter(|step| step.kind == StepKind::Explicit);
        let given: Vec<(usize, usize)> = explicit
            .flat_map(|step| &step.coordinates)
            .filter_map(|&(k, joint)| Some((body_of(set, k)?, joint)))
            .collect();
        for step in self.steps.iter_mut().filter(|step| step.kind != StepKind::Explicit) {
            let mut bodies = bodies(set, step);
            loop {
                let before = (bodies.len(), step.joints.len());
                for &(body, joint) in &given {
                    // A body that a joint of the group rotates belongs to the group even if all its coordinates are
                    // explicit.
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

    fn block(&mut self, system_and_graph: (&KinematicSystem, &Graph), block: &Block, source_rows: &[BTreeSet<usize>]) {
        let (system, graph) = system_and_graph;
        for part in &block.parts {
            match part {
                BlockPart::Core(core) => self.add(system, core, source_rows),
                BlockPart::Block(block) => self.block(system_and_graph, block, source_rows),
                BlockPart::Pair(pair) => {
                    self.block(system_and_graph, &pair.inner, source_rows);
                    if let (Some(letters), Some(step)) = (letters_of_pair(graph, pair), self.steps.last_mut()) {
                        step.closed_as = Some(letters);
                    }
                    self.attach(system, pair.rows[0], pair.coordinate);
                }
            }
        }
        for pivot in block.pivots.iter().rev() {
            self.attach(system, pivot.row, pivot.coordinate);
        }
    }

    fn add(&mut self, system: &KinematicSystem, core: &Core, source_rows: &[BTreeSet<usize>]) {
        let rows: BTreeSet<usize> = core.rows.iter().flat_map(|&row| source_rows[row].iter().copied()).collect();
        let kind = match &core.method {
            SolutionMethod::Linear { matrix, .. } if matrix.len() == 1 => StepKind::Explicit,
            SolutionMethod::Linear { matrix, .. } => StepKind::Linear(matrix.len()),
            SolutionMethod::Newton { residuals } => StepKind::Newton(residuals.len()),
            _ => StepKind::Closure,
        };
        let joint = |index: usize| {
            let row = core.rows.get(index).or(core.rows.first());
            row.map_or(0, |&row| system.set.rows[row].joint)
        };
        let coordinates = core.coordinates.iter().enumerate().map(|(index, &k)| (k, joint(index))).collect();
        let step = new_step(&system.set, kind, rows, coordinates);
        self.steps.push(Step { closed_as: letters_of_method(&core.method), ..step });
    }

    /// Adds a coordinate that `row` gives once the rest of its group is known. It is added to the step that uses the
    /// row, to the preceding explicit step of the same joint, or to a new explicit step.
    fn attach(&mut self, system: &KinematicSystem, row: usize, coordinate: u32) {
        let joint = system.set.rows[row].joint;
        if let Some(index) = self.steps.iter().rposition(|step| step.rows.contains(&row)) {
            self.steps[index].coordinates.push((coordinate, joint));
            return;
        }
        if let Some(step) = self.steps.last_mut()
            && step.kind == StepKind::Explicit
            && step.joints == [joint]
        {
            step.rows.insert(row);
            step.coordinates.push((coordinate, joint));
            return;
        }
        self.steps.push(new_step(&system.set, StepKind::Explicit, BTreeSet::from([row]), vec![(coordinate, joint)]));
    }

    /// The step that gives a coordinate.
    pub(super) fn giving(&self, coordinate: u32) -> StepId {
        self.giving.get(&coordinate).copied().unwrap_or_default()
    }

    /// The step with this id.
    pub(super) fn step(&self, id: StepId) -> &Step {
        &self.steps[id.index()]
    }

    /// Adds a margin to a step; its index is provisional until [`number_margins`](Self::number_margins).
    pub(super) fn margin(&mut self, step: StepId) -> usize {
        self.of_margins.push(step);
        self.of_margins.len() - 1
    }

    /// The [`Mode`] that describes a group whose determinant has a sign; `margin` is the provisional index of its margin.
    pub(super) fn oriented(&self, system: &KinematicSystem, step: StepId, margin: usize) -> Mode {
        let name = self.joined(system, step);
        Mode { name, step, margin: self.indices.get(margin).copied().unwrap_or(margin) }
    }

    /// Numbers the margins in the order of the steps. Returns the final index for each provisional one.
    pub(super) fn number_margins(&mut self) -> Vec<usize> {
        self.margins = self.of_margins.len();
        let mut order: Vec<usize> = (0..self.margins).collect();
        order.sort_by_key(|&found| self.of_margins[found]);
        let mut indices = vec![0; self.margins];
        order.iter().enumerate().for_each(|(index, &found)| indices[found] = index);
        let mut next = 0;
        for (number, step) in self.steps.iter_mut().enumerate() {
            let count = self.of_margins.iter().filter(|step| step.index() == number).count();
            step.margins = next..next + count;
            next += count;
        }
        self.modes.iter_mut().for_each(|mode| mode.margin = indices[mode.margin]);
        self.indices.clone_from(&indices);
        indices
    }

    /// Adds a step for the redundant rows of each joint. Returns the step of every row, in the order of `rows`.
    pub(super) fn redundant_steps(&mut self, set: &ConstraintSet, rows: &[usize]) -> Vec<StepId> {
        let mut steps: Vec<StepId> = Vec::new();
        for &row in rows {
            let joint = set.rows[row].joint;
            match steps.last().map(|step| &mut self.steps[step.index()]) {
                Some(step) if step.joints == [joint] => _ = step.rows.insert(row),
                _ => self.steps.push(new_step(set, StepKind::RedundantRows, BTreeSet::from([row]), Vec::new())),
            }
            steps.push(StepId(self.steps.len() - 1));
        }
        steps
    }

    /// The names of the joints of a step, joined with `-`.
    fn joined(&self, system: &KinematicSystem, step: StepId) -> String {
        let names = self.step(step).joints.iter().map(|&joint| system.set.joints[joint].name.as_str());
        names.collect::<Vec<_>>().join("-")
    }

    /// Adds a mode to a step and returns its index.
    pub(super) fn mode(&mut self, system: &KinematicSystem, step: StepId, margin: usize) -> usize {
        let plain = self.joined(system, step);
        let index = self.modes.len();
        let joints = |step: StepId| &self.step(step).joints;
        let same_joints = self.modes.iter().filter(|mode| joints(mode.step) == joints(step));
        let name = match same_joints.count() {
            0 => plain,
            count => format!("{plain}#{}", count + 1),
        };
        self.modes.push(Mode { name, step, margin });
        self.steps[step.index()].modes = index..index + 1;
        index
    }
}

fn new_step(set: &ConstraintSet, kind: StepKind, rows: BTreeSet<usize>, coordinates: Vec<(u32, usize)>) -> Step {
    let mut joints: Vec<usize> = rows.iter().map(|&row| set.rows[row].joint).collect();
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
        closed_as: None,
    }
}

fn body_of(set: &ConstraintSet, k: u32) -> Option<usize> {
    match set.coordinates[k as usize].kind {
        CoordinateKind::Pose(body, _) => Some(body),
        CoordinateKind::Scalar => None,
    }
}

/// The bodies whose coordinates a step gives.
fn bodies(set: &ConstraintSet, step: &Step) -> BTreeSet<usize> {
    step.coordinates.iter().filter_map(|&(k, _)| body_of(set, k)).collect()
}
