//! Stages to programs: what a later stage needs of an earlier one is held, and computed once.

use super::build::Stage;
use super::rewrite::{Substitution, rewrite};
use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};
use crate::program::{Program, Slot, lower};

/// A stretch of a solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Section {
    /// Straight-line code.
    Closed(Program),
    /// Newton's iteration.
    Newton {
        /// The unknowns, places in q; the outputs of `correction` are in this order.
        unknowns: Vec<u32>,
        /// What is subtracted from the unknowns, for their current values.
        correction: Program,
        /// The place among the values held that says whether it has converged: 1, or 0.
        converged: u32,
    },
}

impl Section {
    /// Its code.
    pub fn program(&self) -> &Program {
        match self {
            Self::Closed(program) | Self::Newton { correction: program, .. } => program,
        }
    }
}

/// Where the value of an expression is found.
struct Places {
    /// The section that computes it.
    owner: IdMap<usize>,
    held: IdMap<u32>,
    /// (section, place, expression) of everything that is held.
    wanted: Vec<(usize, u32, ExprId)>,
    next: u32,
}

impl Places {
    /// The first section that has it computes it. Whoever turns a vector has sine and cosine, too.
    fn own(&mut self, graph: &mut Graph, id: ExprId, section: usize) {
        let turned = match graph.node(id) {
            Node::RotX(r) | Node::RotY(r) => [Some(graph.sin(r.angle)), Some(graph.cos(r.angle))],
            _ => [None, None],
        };
        for id in [Some(id), turned[0], turned[1]].into_iter().flatten() {
            if !self.owner.contains(id) {
                self.owner.insert(id, section);
            }
        }
    }
}

/// Everything that a section finds done.
struct Done<'p> {
    places: &'p mut Places,
    section: usize,
    /// Whether symbols are held, too: whoever comes later does not know them.
    symbols: bool,
}

impl Done<'_> {
    /// Whether an earlier section computes it and holds it.
    fn is_held(&self, graph: &Graph, id: ExprId) -> bool {
        let known = match graph.node(id) {
            // The other sign is as good.
            Node::Number(_) | Node::Neg(_) => true,
            Node::Symbol(_) => !self.symbols,
            _ => false,
        };
        !known && self.places.owner.get(id).is_some_and(|owner| *owner < self.section)
    }
}

impl Substitution for Done<'_> {
    fn symbol(&mut self, _graph: &mut Graph, _symbol: Symbol) -> Option<ExprId> {
        None
    }

    fn whole(&mut self, graph: &mut Graph, id: ExprId) -> Option<ExprId> {
        if !self.is_held(graph, id) {
            return None;
        }
        let owner = *self.places.owner.get(id)?;
        let place = match self.places.held.get(id) {
            Some(&place) => place,
            None => {
                let place = self.places.next;
                self.places.next += 1;
                self.places.wanted.push((owner, place, id));
                self.places.held.insert(id, place);
                place
            }
        };
        Some(graph.symbol(Symbol::Held(place)))
    }
}

/// The sections of `stages`, of which the last may be empty, and how many values they hold; `first` are taken.
pub(super) fn sections(graph: &mut Graph, stages: Vec<Stage>, first: u32) -> (Vec<Section>, u32) {
    let mut places = Places { owner: IdMap::default(), held: IdMap::default(), wanted: Vec::new(), next: first };
    for (number, stage) in stages.iter().enumerate() {
        match stage {
            Stage::Closed(outputs) => {
                for id in graph.reachable(outputs.iter().map(|(_, id)| *id)) {
                    places.own(graph, id, number);
                }
            }
            Stage::Newton { unknowns, corrections, .. } => {
                own_constants(graph, &mut places, number, unknowns, corrections)
            }
        }
    }
    let roots: Vec<Vec<(Slot, ExprId)>> = stages
        .iter()
        .map(|stage| match stage {
            Stage::Closed(outputs) => outputs.clone(),
            Stage::Newton { corrections, .. } => {
                corrections.iter().enumerate().map(|(place, id)| (Slot::Entry(place), *id)).collect()
            }
        })
        .collect();
    let programs = programs(graph, &mut places, roots, false);
    let sections = stages.into_iter().zip(programs).map(|(stage, program)| match stage {
        Stage::Closed(_) => Section::Closed(program),
        Stage::Newton { unknowns, converged, .. } => Section::Newton { unknowns, correction: program, converged },
    });
    (sections.collect(), places.next)
}

/// What an iteration needs and never changes belongs to the section before it.
fn own_constants(graph: &mut Graph, places: &mut Places, number: usize, unknowns: &[u32], corrections: &[ExprId]) {
    let mut moving: IdMap<()> = IdMap::default();
    for id in graph.reachable(corrections.iter().copied()) {
        let node = graph.node(id);
        let mut moves = matches!(node, Node::Symbol(Symbol::Unknown(k)) if unknowns.contains(&k));
        node.for_each_operand(|operand| moves |= moving.contains(operand));
        if moves {
            moving.insert(id, ());
        } else {
            places.own(graph, id, number.saturating_sub(1));
        }
    }
}

/// The same outputs in two programs: what does not depend on right sides, held, and the rest, which reads what is held
/// and right sides alone. The first leaves `more` behind what it holds. Gives how many values it leaves, too.
pub(super) fn split(graph: &mut Graph, outputs: Vec<(Slot, ExprId)>, more: &[ExprId]) -> ([Program; 2], usize) {
    let mut places = Places { owner: IdMap::default(), held: IdMap::default(), wanted: Vec::new(), next: 0 };
    for id in graph.reachable(outputs.iter().map(|(_, id)| *id)) {
        let node = graph.node(id);
        let mut owner = usize::from(matches!(node, Node::Symbol(Symbol::Right(_))));
        node.for_each_operand(|operand| owner = owner.max(places.owner.or(operand, 0)));
        places.owner.insert(id, owner);
    }
    let left = more.len();
    let more: Vec<_> = more.iter().enumerate().map(|(k, &id)| (Slot::Entry(k), id)).collect();
    let mut programs = programs(graph, &mut places, vec![more, outputs], true);
    for (slot, _) in programs.iter_mut().take(1).flat_map(|first| &mut first.outputs) {
        if let Slot::Entry(k) = *slot {
            *slot = Slot::Held(places.next as usize + k);
        }
    }
    let mut programs = programs.into_iter();
    ([(); 2].map(|()| programs.next().unwrap_or_default()), places.next as usize + left)
}

/// A program for the outputs of every section, and for what later ones want of it.
fn programs(
    graph: &mut Graph,
    places: &mut Places,
    mut roots: Vec<Vec<(Slot, ExprId)>>,
    symbols: bool,
) -> Vec<Program> {
    let mut rewritten = IdMap::default();
    // From the last to the first: what is wanted of a section is known when it is written.
    for section in (0..roots.len()).rev() {
        let wanted = places.wanted.iter().filter(|(owner, ..)| *owner == section);
        let wanted: Vec<_> = wanted.map(|&(_, place, id)| (Slot::Held(place as usize), id)).collect();
        roots[section].extend(wanted);
        rewritten.clear();
        let mut done = Done { places: &mut *places, section, symbols };
        hold(graph, &roots[section], &mut done);
        for (_, id) in &mut roots[section] {
            *id = rewrite(graph, *id, &mut rewritten, &mut done);
        }
    }
    roots.into_iter().map(|outputs| lower(graph, &outputs)).collect()
}

/// Asks `done` for all that `outputs` need of it, in the order in which it was derived: so equal groups hold theirs in equal
/// order.
fn hold(graph: &mut Graph, outputs: &[(Slot, ExprId)], done: &mut Done<'_>) {
    let (mut seen, mut needed): (IdMap<()>, Vec<ExprId>) = Default::default();
    let mut open: Vec<ExprId> = outputs.iter().map(|(_, id)| *id).collect();
    while let Some(id) = open.pop() {
        if !seen.contains(id) {
            seen.insert(id, ());
            match done.is_held(graph, id) {
                true => needed.push(id),
                false => graph.node(id).for_each_operand(|operand| open.push(operand)),
            }
        }
    }
    needed.sort_unstable();
    for id in needed {
        done.whole(graph, id);
    }
}
