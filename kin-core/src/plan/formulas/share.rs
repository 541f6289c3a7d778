//! Names for parts of long expressions.
//!
//! A graph of a hundred nodes may be a text of a million: what occurs several times is written once. A line that a person
//! can read has some dozens of symbols; what is longer is taken apart as well.

use crate::constraint::ConstraintSet;
use crate::expr::{ExprId, Graph, Names, Node, Symbol};
use crate::notation::{Name, Notation};
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Symbols of an expression that is written as it is.
const SHORT: usize = 64;

/// Symbols that a part with a name has at least.
const WORTH: usize = 8;

/// The user's names, and those of what the lines of a plan define.
pub(super) struct Naming<'a> {
    set: &'a ConstraintSet,
    /// Of [`Symbol::Right`], which stands for what a line has defined.
    pub(super) own: Vec<String>,
    /// Of modes.
    pub(super) modes: BTreeMap<u32, String>,
    /// Of parts, with the order of the lines that define them.
    parts: BTreeMap<ExprId, (usize, String)>,
    /// The order of the lines that are being written: positions stand before rates, and do not know their parts.
    pub(super) order: usize,
    /// All of them as they are typeset: two names of one symbol would be one to a reader.
    taken: HashSet<String>,
}

impl Names for Naming<'_> {
    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Right(k) => self.own.get(k as usize).cloned().unwrap_or_default(),
            Symbol::Mode(k) => self.modes.get(&k).cloned().unwrap_or_default(),
            // Accelerations have no symbol in the graph; no plan has held anything where lines are written.
            Symbol::Held(k) => format!("{}_ddot", self.set.coordinate_name(k)),
            other => self.set.symbol(other),
        }
    }

    fn function(&self, index: u32) -> String {
        self.set.function(index)
    }

    fn part(&self, id: ExprId) -> Option<&str> {
        self.parts.get(&id).filter(|(order, _)| *order <= self.order).map(|(_, name)| name.as_str())
    }
}

impl<'a> Naming<'a> {
    pub(super) fn new(set: &'a ConstraintSet) -> Self {
        let coordinates = set.coordinates.iter().map(|coordinate| &coordinate.name);
        let users = coordinates.chain(&set.parameters).chain(&set.inputs).map(String::as_str).chain(["t", "pi"]);
        let taken = users.map(|name| Name::new(name).write(Notation::Latex)).collect();
        Self { set, own: Vec::new(), modes: BTreeMap::new(), parts: BTreeMap::new(), order: 0, taken }
    }

    /// `letter_5`, or with a second index where that is taken.
    pub(super) fn fresh(&mut self, letter: &str, number: usize) -> String {
        let mut name = format!("{letter}_{number}");
        let mut place = 1;
        while !self.taken.insert(Name::new(&name).write(Notation::Latex)) {
            place += 1;
            name = format!("{letter}_{number}[{place}]");
        }
        name
    }

    /// Parts of expressions that are too long, in the order in which they can be written, with their new names.
    pub(super) fn parts(&mut self, graph: &Graph, ids: &[ExprId], number: usize) -> Vec<(String, ExprId)> {
        if ids.iter().all(|&id| self.is_short(graph, id)) {
            return Vec::new();
        }
        let (order, uses) = self.reached(graph, ids);
        let mut sizes: BTreeMap<ExprId, usize> = BTreeMap::new();
        let mut found = Vec::new();
        for id in order {
            if self.part(id).is_some() {
                sizes.insert(id, 1);
                continue;
            }
            let mut size = 1;
            graph.node(id).for_each_operand(|operand| size += sizes.get(&operand).copied().unwrap_or(1));
            let often = uses.get(&id).copied().unwrap_or(0) > 1 && size >= WORTH;
            if (often || size > SHORT) && !ids.contains(&id) && !matches!(graph.node(id), Node::Neg(_)) {
                let name = self.fresh("s", number);
                found.push((name.clone(), id));
                self.parts.insert(id, (self.order, name));
                size = 1;
            }
            sizes.insert(id, size);
        }
        found
    }

    /// Whether an expression is written as it is. Most are, and seen to be without a table of what they are made of.
    fn is_short(&self, graph: &Graph, id: ExprId) -> bool {
        let (mut open, mut size) = (vec![id], 0);
        while let Some(id) = open.pop() {
            size += 1;
            if size == 1 || self.part(id).is_none() {
                graph.node(id).for_each_operand(|operand| open.push(operand));
            }
            if size > SHORT {
                return false;
            }
        }
        true
    }

    /// What expressions are made of down to parts that have names, operands first, and how often each is used.
    fn reached(&self, graph: &Graph, ids: &[ExprId]) -> (Vec<ExprId>, BTreeMap<ExprId, usize>) {
        let (mut seen, mut uses) = (BTreeSet::new(), BTreeMap::new());
        let mut open: Vec<ExprId> = ids.to_vec();
        while let Some(id) = open.pop() {
            if !seen.insert(id) || self.part(id).is_some() && !ids.contains(&id) {
                continue;
            }
            graph.node(id).for_each_operand(|operand| {
                *uses.entry(operand).or_insert(0) += 1;
                open.push(operand);
            });
        }
        // Operands are older than what they are operands of.
        (seen.into_iter().collect(), uses)
    }
}
