//! Selects the rows that a plan uses when there are more rows than coordinates, and builds the tree of the plan.
//!
//! Two sets of rows to leave out are compared first. A *circuit* is a minimal set of linearly dependent rows. The first
//! set consists of the row declared last in each circuit; the second, of the rows that close the circuits on a walk
//! from the driver, is taken if it leaves fewer angles and scalars that no driver moves or, if equally many, fewer
//! unknowns to iterate on. A driving row is left out only if it depends on other driving rows. If the better tree still
//! needs an iteration, other rows of the same circuits are tried. A row that is left out can still be used if another
//! row of the same joint is kept and both rotate the same vector: together they give the cosine and the sine of the
//! angle, so no sign has to be chosen.

use super::guides::Guides;
use super::matching;
use super::reduce::{PairedRows, Reduction};
use super::term_sum::ReaderCache;
use super::tree::{Block, BlockPart, SolutionMethod};
use crate::expr::{Graph, IdMap};
use crate::structure::RemovableRows;
use crate::system::KinematicSystem;
use std::collections::{BTreeMap, BTreeSet};

/// Maximum number of alternative rows that are tried.
const MAX_ALTERNATIVE_ROWS: usize = 16;

/// A tree, and the rows from which it was built.
pub(super) struct Chosen {
    pub(super) tree: Block,
    /// For each row, the original rows that it has been combined from.
    pub(super) source_rows: Vec<BTreeSet<usize>>,
    /// Redundant rows that the tree does not use, in order of declaration.
    pub(super) left_out: Vec<usize>,
    /// The redundant rows that give an angle together with a kept row.
    pub(super) paired: Vec<PairedRows>,
    score: Score,
}

/// Chooses the rows and the tree for a system of full column rank.
pub(super) fn choose(system: &KinematicSystem, graph: &mut Graph) -> Option<Chosen> {
    let set = &system.set;
    let mut search = TreeSearch { system, graph, memory: ReaderCache::new(set.coordinates.len()) };
    if set.rows.len() == set.coordinates.len() {
        return search.best_without(Vec::new());
    }
    let removable = RemovableRows::new(system);
    let (mut best, mut named) = (None, Vec::new());
    for places in [removable.declared(), removable.walked()] {
        let found = removable.rows(&places, &[]);
        let next = search.best_without(found.iter().map(|found| found.row).collect());
        if best.is_none() || cost(&next) < cost(&best) {
            (best, named) = (next, vec![(places, found)]);
        }
    }
    let mut tries = MAX_ALTERNATIVE_ROWS;
    for (places, named) in named {
        for found in &named {
            // Rows declared last are tried first. Driving rows are always kept.
            let mut alternatives: Vec<usize> = found.circuit.clone();
            alternatives.retain(|&row| !system.classes[row].driving);
            alternatives.sort_by_key(|&row| std::cmp::Reverse(places[row]));
            for row in alternatives {
                let done = best.as_ref().is_some_and(|best| best.score.iterated == 0);
                if done || tries == 0 {
                    return best;
                }
                tries -= 1;
                let still_left_out =
                    best.iter().flat_map(|best| &best.left_out).copied().filter(|&other| other != found.row);
                let preferred: Vec<usize> = still_left_out.chain([row]).collect();
                let next =
                    search.best_without(removable.rows(&places, &preferred).iter().map(|found| found.row).collect());
                if cost(&next) < cost(&best) {
                    best = next;
                }
            }
        }
    }
    best
}

/// The search for the best tree of steps without given rows.
struct TreeSearch<'a> {
    system: &'a KinematicSystem,
    graph: &'a mut Graph,
    memory: ReaderCache,
}

impl TreeSearch<'_> {
    /// The better of two trees without the given rows: one that uses left-out rows together with kept rows of the same
    /// joint, and one that does not.
    fn best_without(&mut self, mut left_out: Vec<usize>) -> Option<Chosen> {
        left_out.sort_unstable();
        let rows = &self.system.set.rows;
        if rows.len() != self.system.set.coordinates.len() + left_out.len() {
            return None;
        }
        let partner = |&row: &usize| {
            let mut kept_rows = (0..rows.len()).filter(|other| !left_out.contains(other));
            kept_rows.find(|&other| rows[other].joint == rows[row].joint).map(|other| (other, row))
        };
        let partners: BTreeMap<usize, usize> = left_out.iter().filter_map(partner).collect();
        let alone = self.tree(&left_out, BTreeMap::new());
        if partners.is_empty() {
            return alone;
        }
        let helped = self.tree(&left_out, partners);
        better(helped, alone)
    }

    fn tree(&mut self, left_out: &[usize], partners: BTreeMap<usize, usize>) -> Option<Chosen> {
        let (set, equations) = (&self.system.set, &self.system.equations);
        let all = 0..set.rows.len();
        let rows_used: Vec<usize> = all.clone().filter(|row| left_out.binary_search(row).is_err()).collect();
        let pattern = rows_used.iter().map(|row| {
            let rows = [Some(row), partners.get(row)].into_iter().flatten();
            let held: BTreeSet<usize> = rows.flat_map(|&row| &equations[row].phi_q).map(|(k, _)| *k as usize).collect();
            held.into_iter().collect()
        });
        let pattern: Vec<Vec<usize>> = pattern.collect();
        let blocks = matching::blocks(&pattern, set.coordinates.len()).ok()?;
        let mut reduction = Reduction {
            graph: &mut *self.graph,
            memory: &mut self.memory,
            rows: set.rows.iter().map(|row| row.phi).collect(),
            source_rows: all.map(|row| BTreeSet::from([row])).collect(),
            replaced: BTreeSet::new(),
            rewritten: IdMap::default(),
            paired: Vec::new(),
            guides: Guides::new(set),
        };
        let (mut tree, mut moves) = (Block::default(), vec![false; set.coordinates.len()]);
        for (rows, unknowns) in blocks {
            let driven = rows.iter().any(|&index| {
                self.system.classes[rows_used[index]].leads() || pattern[index].iter().any(|&k| moves[k])
            });
            unknowns.iter().for_each(|&k| moves[k] = driven);
            let rows: Vec<usize> = rows.into_iter().map(|index| rows_used[index]).collect();
            let unknowns: BTreeSet<u32> = unknowns.into_iter().map(|k| k as u32).collect();
            let removable: Vec<usize> = rows.iter().filter_map(|row| partners.get(row)).copied().collect();
            tree.parts.push(BlockPart::Block(reduction.with_guides(&rows, &unknowns, &removable)?));
        }
        let Reduction { source_rows, paired, .. } = reduction;
        let undriven = moves.iter().zip(&set.coordinates).filter(|(moves, k)| !**moves && !k.kind.is_length()).count();
        let iterated =
            tree.sum(&|core| if let SolutionMethod::Newton { residuals } = &core.method { residuals.len() } else { 0 });
        let two = |method: &SolutionMethod| {
            matches!(
                method,
                SolutionMethod::Angle { .. } | SolutionMethod::Quadratic { .. } | SolutionMethod::Circle { .. }
            )
        };
        let closures = tree.sum(&|core| usize::from(two(&core.method)));
        let score = Score { undriven, iterated, closures };
        Some(Chosen { tree, source_rows, left_out: left_out.to_vec(), paired, score })
    }
}

/// The cost of a tree; smaller is better. The fields are compared in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Score {
    /// Number of angles and scalars that no driving row reaches. If a mechanism moves only because of its special
    /// dimensions, a plan in which scleronomic rows fix such a coordinate by themselves is singular.
    undriven: usize,
    /// Number of unknowns of iterations.
    iterated: usize,
    /// Number of parts that have two solutions.
    closures: usize,
}

/// A key for comparison: a missing tree is worse than any tree.
fn score(chosen: &Option<Chosen>) -> (bool, Option<Score>) {
    (chosen.is_none(), chosen.as_ref().map(|chosen| chosen.score))
}

/// The score without the number of closures. Fewer closures are no advantage: they may only mean that the tree relies
/// on rows that agree with the others for special dimensions alone.
fn cost(chosen: &Option<Chosen>) -> (bool, Option<[usize; 2]>) {
    (chosen.is_none(), chosen.as_ref().map(|Chosen { score, .. }| [score.undriven, score.iterated]))
}

/// The tree with the better score; the first one if both scores are equal.
fn better(first: Option<Chosen>, second: Option<Chosen>) -> Option<Chosen> {
    if score(&second) < score(&first) { second } else { first }
}
