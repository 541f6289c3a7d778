//! Turns stages into programs. A value that a later stage shares with an earlier one is computed once and stored; it is
//! *saved*.

use super::rewrite::{Substitution, rewrite};
use super::state::Stage;
use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};
use crate::program::{Program, Slot, lower};

/// A section of a solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Section {
    /// Straight-line code.
    Closed(Program),
    /// Newton's iteration.
    Newton {
        /// The unknowns, as indices of q; the outputs of `correction` are in this order.
        unknowns: Vec<u32>,
        /// The program for the corrections that are subtracted from the current values of the unknowns.
        correction: Program,
        /// The index of the saved value that is 1 if the iteration has converged and 0 otherwise.
        converged: u32,
    },
}

impl Section {
    /// The program of the section.
    pub fn program(&self) -> &Program {
        match self {
            Self::Closed(program) | Self::Newton { correction: program, .. } => program,
        }
    }
}

/// Which section computes each expression, and where the saved values are stored.
struct SectionPlaces {
    /// The section that computes an expression.
    owner: IdMap<usize>,
    saved: IdMap<u32>,
    /// (section, index, expression) of every saved value.
    wanted: Vec<(usize, u32, ExprId)>,
    next: u32,
}

impl SectionPlaces {
    /// Assigns an expression to the first section that contains it. A section that rotates a vector also computes the
    /// sine and cosine of the angle.
    fn assign(&mut self, graph: &mut Graph, id: ExprId, section: usize) {
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

/// A substitution of saved values for expressions that earlier sections have computed.
struct SavedValues<'p> {
    places: &'p mut SectionPlaces,
    section: usize,
    /// Whether symbols are saved, too, because later sections cannot read what they stand for.
    symbols: bool,
}

impl SavedValues<'_> {
    /// Whether an earlier section computes the expression, so that it can be saved.
    fn is_saved(&self, graph: &Graph, id: ExprId) -> bool {
        let known = match graph.node(id) {
            // A negated value is cheap to form from the saved value of the other sign.
            Node::Number(_) | Node::Neg(_) => true,
            Node::Symbol(_) => !self.symbols,
            _ => false,
        };
        !known && self.places.owner.get(id).is_some_and(|owner| *owner < self.section)
    }
}

impl Substitution for SavedValues<'_> {
    fn symbol(&mut self, _graph: &mut Graph, _symbol: Symbol) -> Option<ExprId> {
        None
    }

    fn expression(&mut self, graph: &mut Graph, id: ExprId) -> Option<ExprId> {
        if !self.is_saved(graph, id) {
            return None;
        }
        let owner = *self.places.owner.get(id)?;
        let index = match self.places.saved.get(id) {
            Some(&index) => index,
            None => {
                let index = self.places.next;
                self.places.next += 1;
                self.places.wanted.push((owner, index, id));
                self.places.saved.insert(id, index);
                index
            }
        };
        Some(graph.symbol(Symbol::Saved(index)))
    }
}

/// The sections of `stages`, the last of which may be empty, and the number of saved values. Indices below `first` are
/// already in use.
pub(super) fn sections(graph: &mut Graph, stages: Vec<Stage>, first: u32) -> (Vec<Section>, u32) {
    let mut places =
        SectionPlaces { owner: IdMap::default(), saved: IdMap::default(), wanted: Vec::new(), next: first };
    for (number, stage) in stages.iter().enumerate() {
        match stage {
            Stage::Closed(outputs) => {
                for id in graph.reachable(outputs.iter().map(|(_, id)| *id)) {
                    places.assign(graph, id, number);
                }
            }
            Stage::Newton { unknowns, corrections, .. } => {
                assign_constants(graph, &mut places, number, unknowns, corrections)
            }
        }
    }
    let roots: Vec<Vec<(Slot, ExprId)>> = stages
        .iter()
        .map(|stage| match stage {
            Stage::Closed(outputs) => outputs.clone(),
            Stage::Newton { corrections, .. } => {
                corrections.iter().enumerate().map(|(index, id)| (Slot::Entry(index), *id)).collect()
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

/// Assigns the parts of an iteration that do not depend on its unknowns to the preceding section.
fn assign_constants(
    graph: &mut Graph,
    places: &mut SectionPlaces,
    number: usize,
    unknowns: &[u32],
    corrections: &[ExprId],
) {
    let mut moving: IdMap<()> = IdMap::default();
    for id in graph.reachable(corrections.iter().copied()) {
        let node = graph.node(id);
        let mut moves = matches!(node, Node::Symbol(Symbol::Unknown(k)) if unknowns.contains(&k));
        node.for_each_operand(|operand| moves |= moving.contains(operand));
        if moves {
            moving.insert(id, ());
        } else {
            places.assign(graph, id, number.saturating_sub(1));
        }
    }
}

/// Splits the computation of `outputs` into two programs: one for everything that does not depend on right-hand sides,
/// whose results are saved, and one that reads only the saved values and right-hand sides. The first program also stores
/// the values `more` after the saved ones. Returns the programs and the number of values that the first one stores.
pub(super) fn split(graph: &mut Graph, outputs: Vec<(Slot, ExprId)>, more: &[ExprId]) -> ([Program; 2], usize) {
    let mut places = SectionPlaces { owner: IdMap::default(), saved: IdMap::default(), wanted: Vec::new(), next: 0 };
    for id in graph.reachable(outputs.iter().map(|(_, id)| *id)) {
        let node = graph.node(id);
        let mut owner = usize::from(matches!(node, Node::Symbol(Symbol::Right(_))));
        node.for_each_operand(|operand| owner = owner.max(places.owner.or(operand, 0)));
        places.owner.insert(id, owner);
    }
    let more_count = more.len();
    let more: Vec<_> = more.iter().enumerate().map(|(k, &id)| (Slot::Entry(k), id)).collect();
    let mut programs = programs(graph, &mut places, vec![more, outputs], true);
    for (slot, _) in programs.iter_mut().take(1).flat_map(|first| &mut first.outputs) {
        if let Slot::Entry(k) = *slot {
            *slot = Slot::Saved(places.next as usize + k);
        }
    }
    let mut programs = programs.into_iter();
    ([(); 2].map(|()| programs.next().unwrap_or_default()), places.next as usize + more_count)
}

/// The program of every section: its outputs and the values that later sections read from it.
fn programs(
    graph: &mut Graph,
    places: &mut SectionPlaces,
    mut roots: Vec<Vec<(Slot, ExprId)>>,
    symbols: bool,
) -> Vec<Program> {
    let mut rewritten = IdMap::default();
    // From the last section to the first, so that all readers of a section are known when its program is written.
    for section in (0..roots.len()).rev() {
        let wanted = places.wanted.iter().filter(|(owner, ..)| *owner == section);
        let wanted: Vec<_> = wanted.map(|&(_, index, id)| (Slot::Saved(index as usize), id)).collect();
        roots[section].extend(wanted);
        rewritten.clear();
        let mut saved = SavedValues { places: &mut *places, section, symbols };
        save(graph, &roots[section], &mut saved);
        for (_, id) in &mut roots[section] {
            *id = rewrite(graph, *id, &mut rewritten, &mut saved);
        }
    }
    roots.into_iter().map(|outputs| lower(graph, &outputs)).collect()
}

/// Holds everything that `outputs` read from earlier sections. The values are numbered in the order in which the graph
/// created them, so that groups of the same structure use the same order.
fn save(graph: &mut Graph, outputs: &[(Slot, ExprId)], saved: &mut SavedValues<'_>) {
    let (mut seen, mut needed): (IdMap<()>, Vec<ExprId>) = Default::default();
    let mut open: Vec<ExprId> = outputs.iter().map(|(_, id)| *id).collect();
    while let Some(id) = open.pop() {
        if !seen.contains(id) {
            seen.insert(id, ());
            match saved.is_saved(graph, id) {
                true => needed.push(id),
                false => graph.node(id).for_each_operand(|operand| open.push(operand)),
            }
        }
    }
    needed.sort_unstable();
    for id in needed {
        saved.expression(graph, id);
    }
}
