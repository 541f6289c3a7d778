//! Which rows a plan goes by where there are more than coordinates, and the tree that follows from them.
//!
//! The rows that are left out are those of every circuit that were declared last, but for rows that drive; where that
//! leaves bodies that nothing drives, those that close a circuit on a walk from the driver; where an iteration is left,
//! another row of the same circuit may leave none. A row that is left out beside one of the same joint helps it all the same, where both turn one
//! vector: an angle is given by its cosine and its sine, not by one of them and a sign.

use super::form::Memory;
use super::matching;
use super::reduce::{Agreeing, Reduction};
use super::tree::{Block, Part, Way};
use crate::expr::{Graph, IdMap};
use crate::structure::Spare;
use crate::system::KinematicSystem;
use std::collections::{BTreeMap, BTreeSet};

/// Most choices that are tried.
const TRIES: usize = 16;

/// A tree, and what it was made of.
pub(super) struct Chosen {
    pub(super) tree: Block,
    /// The rows that every row is made of.
    pub(super) made_of: Vec<BTreeSet<usize>>,
    /// Rows that the tree does without, in order of declaration.
    pub(super) left_out: Vec<usize>,
    /// Those of them that help all the same.
    pub(super) agreeing: Vec<Agreeing>,
    score: Score,
}

/// Chooses for a system of full rank.
pub(super) fn choose(system: &KinematicSystem, graph: &mut Graph) -> Option<Chosen> {
    let set = &system.set;
    let mut search = Search { system, graph, memory: Memory::new(set.coordinates.len()) };
    if set.rows.len() == set.coordinates.len() {
        return search.of(Vec::new());
    }
    let spare = Spare::new(system);
    let (mut best, mut named) = (None, Vec::new());
    for places in [spare.declared(), spare.walked()] {
        let found = spare.rows(&places, &[]);
        let next = search.of(found.iter().map(|found| found.row).collect());
        if best.is_none() || toil(&next) < toil(&best) {
            (best, named) = (next, vec![(places, found)]);
        }
    }
    let mut tries = TRIES;
    for (places, named) in named {
        for found in &named {
            // From the joint that comes last; a driver is meant to be there.
            let mut others: Vec<usize> = found.circuit.clone();
            others.retain(|&row| !system.classes[row].driving);
            others.sort_by_key(|&row| std::cmp::Reverse(places[row]));
            for row in others {
                let done = best.as_ref().is_some_and(|best| best.score.iterated == 0);
                if done || tries == 0 {
                    return best;
                }
                tries -= 1;
                let kept = best.iter().flat_map(|best| &best.left_out).copied().filter(|&other| other != found.row);
                let rather: Vec<usize> = kept.chain([row]).collect();
                let next = search.of(spare.rows(&places, &rather).iter().map(|found| found.row).collect());
                if toil(&next) < toil(&best) {
                    best = next;
                }
            }
        }
    }
    best
}

struct Search<'a> {
    system: &'a KinematicSystem,
    graph: &'a mut Graph,
    memory: Memory,
}

impl Search<'_> {
    /// The better of the trees without these rows: with those that help, and without.
    fn of(&mut self, mut left_out: Vec<usize>) -> Option<Chosen> {
        left_out.sort_unstable();
        let rows = &self.system.set.rows;
        if rows.len() != self.system.set.coordinates.len() + left_out.len() {
            return None;
        }
        let beside = |&row: &usize| {
            let mut others = (0..rows.len()).filter(|other| !left_out.contains(other));
            others.find(|&other| rows[other].joint == rows[row].joint).map(|other| (other, row))
        };
        let beside: BTreeMap<usize, usize> = left_out.iter().filter_map(beside).collect();
        let alone = self.tree(&left_out, BTreeMap::new());
        if beside.is_empty() {
            return alone;
        }
        let helped = self.tree(&left_out, beside);
        better(helped, alone)
    }

    fn tree(&mut self, left_out: &[usize], beside: BTreeMap<usize, usize>) -> Option<Chosen> {
        let (set, equations) = (&self.system.set, &self.system.equations);
        let all = 0..set.rows.len();
        let used: Vec<usize> = all.clone().filter(|row| left_out.binary_search(row).is_err()).collect();
        let pattern = used.iter().map(|row| {
            let rows = [Some(row), beside.get(row)].into_iter().flatten();
            let held: BTreeSet<usize> = rows.flat_map(|&row| &equations[row].phi_q).map(|(k, _)| *k as usize).collect();
            held.into_iter().collect()
        });
        let pattern: Vec<Vec<usize>> = pattern.collect();
        let blocks = matching::blocks(&pattern, set.coordinates.len()).ok()?;
        let mut reduction = Reduction {
            graph: &mut *self.graph,
            memory: &mut self.memory,
            rows: set.rows.iter().map(|row| row.phi).collect(),
            made_of: all.map(|row| BTreeSet::from([row])).collect(),
            replaced: BTreeSet::new(),
            rewritten: IdMap::default(),
            agreeing: Vec::new(),
        };
        let (mut tree, mut moves) = (Block::default(), vec![false; set.coordinates.len()]);
        for (rows, unknowns) in blocks {
            let driven = rows
                .iter()
                .any(|&place| self.system.classes[used[place]].leads() || pattern[place].iter().any(|&k| moves[k]));
            unknowns.iter().for_each(|&k| moves[k] = driven);
            let rows: Vec<usize> = rows.into_iter().map(|place| used[place]).collect();
            let unknowns: BTreeSet<u32> = unknowns.into_iter().map(|k| k as u32).collect();
            let spare: Vec<usize> = rows.iter().filter_map(|row| beside.get(row)).copied().collect();
            tree.parts.push(Part::Block(reduction.block(&rows, &unknowns, &spare)?));
        }
        let Reduction { made_of, agreeing, .. } = reduction;
        let still = moves.iter().zip(&set.coordinates).filter(|(moves, k)| !**moves && !k.kind.is_length()).count();
        let iterated = sum(&tree, &|way| if let Way::Newton { residuals } = way { residuals.len() } else { 0 });
        let two = |way: &Way| matches!(way, Way::Angle { .. } | Way::Quadratic { .. } | Way::Circle { .. });
        let closures = sum(&tree, &|way| usize::from(two(way)));
        let score = Score { still, iterated, closures };
        Some(Chosen { tree, made_of, left_out: left_out.to_vec(), agreeing, score })
    }
}

/// How much a tree leaves to do; less is better, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Score {
    /// Angles and scalars that stand still whatever leads motion into the mechanism: of a mechanism that moves thanks to its dimensions,
    /// rows that hold it by themselves are singular.
    still: usize,
    /// Unknowns of iterations.
    iterated: usize,
    /// Parts that close in two ways.
    closures: usize,
}

/// The score of what there is; the worst of nothing.
fn score(chosen: &Option<Chosen>) -> (bool, Option<Score>) {
    (chosen.is_none(), chosen.as_ref().map(|chosen| chosen.score))
}

/// The score but for closures: fewer of them may only mean that rows were taken at their word that hold for special
/// dimensions.
fn toil(chosen: &Option<Chosen>) -> (bool, Option<[usize; 2]>) {
    (chosen.is_none(), chosen.as_ref().map(|Chosen { score, .. }| [score.still, score.iterated]))
}

/// The one with the better score; the first where they are alike.
fn better(first: Option<Chosen>, second: Option<Chosen>) -> Option<Chosen> {
    if score(&second) < score(&first) { second } else { first }
}

fn sum(block: &Block, of: &impl Fn(&Way) -> usize) -> usize {
    let part = |part: &Part| match part {
        Part::Core(core) => of(&core.way),
        Part::Block(block) => sum(block, of),
        Part::Pair(pair) => sum(&pair.inner, of),
    };
    block.parts.iter().map(part).sum()
}
