//! Names for shared and long parts of expressions.
//!
//! A graph of a hundred nodes may be a million characters when written out, so parts that occur several times are
//! written once. A readable line has a few dozen symbols; longer expressions are split, too.

use crate::constraint::ConstraintSet;
use crate::expr::{ExprId, Graph, Names, Node, Symbol};
use crate::notation::{Name, Notation};
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Maximum number of symbols of an expression that is written in one line.
const MAX_LINE_SYMBOLS: usize = 64;

/// Minimum number of symbols of a shared part that gets a name.
const MIN_NAMED_SYMBOLS: usize = 8;

/// The user's names, and the names that the lines of a plan define.
pub(super) struct Naming<'a> {
    set: &'a ConstraintSet,
    /// Names of the symbols [`Symbol::Right`], which stand for names that a line has defined.
    pub(super) defined: Vec<String>,
    /// Names of the modes.
    pub(super) modes: BTreeMap<u32, String>,
    /// Names of parts, each with the order of derivative of the line that defines it.
    parts: BTreeMap<ExprId, (usize, String)>,
    /// The order of derivative of the lines being written. Lines for positions precede those for rates and cannot use
    /// names that are defined in the latter.
    pub(super) order: usize,
    /// All names as they are typeset, so that no two names look alike.
    taken: HashSet<String>,
}

impl Names for Naming<'_> {
    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Right(k) => self.defined.get(k as usize).cloned().unwrap_or_default(),
            Symbol::Mode(k) => self.modes.get(&k).cloned().unwrap_or_default(),
            // The lines are written before any value is saved, so that this symbol can stand for an
            // acceleration.
            Symbol::Saved(k) => self.set.rate_name(self.set.coordinate_name(k), 2),
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
        Self { set, defined: Vec::new(), modes: BTreeMap::new(), parts: BTreeMap::new(), order: 0, taken }
    }

    /// The name `letter_number`, with a second index if it is taken.
    pub(super) fn fresh(&mut self, letter: &str, number: usize) -> String {
        let mut name = format!("{letter}_{number}");
        let mut place = 1;
        while !self.taken.insert(Name::new(&name).write(Notation::Latex)) {
            place += 1;
            name = format!("{letter}_{number}[{place}]");
        }
        name
    }

    /// Splits expressions that are too long: the parts that get a name, in the order in which their lines can be
    /// written.
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
            let often = uses.get(&id).copied().unwrap_or(0) > 1 && size >= MIN_NAMED_SYMBOLS;
            if (often || size > MAX_LINE_SYMBOLS) && !ids.contains(&id) && !matches!(graph.node(id), Node::Neg(_)) {
                let name = self.fresh("s", number);
                found.push((name.clone(), id));
                self.parts.insert(id, (self.order, name));
                size = 1;
            }
            sizes.insert(id, size);
        }
        found
    }

    /// Whether an expression is short enough for one line. The test needs no table of sizes and is fast for the many
    /// expressions that are short.
    fn is_short(&self, graph: &Graph, id: ExprId) -> bool {
        let (mut open, mut size) = (vec![id], 0);
        while let Some(id) = open.pop() {
            size += 1;
            if size == 1 || self.part(id).is_none() {
                graph.node(id).for_each_operand(|operand| open.push(operand));
            }
            if size > MAX_LINE_SYMBOLS {
                return false;
            }
        }
        true
    }

    /// All subexpressions down to named parts, operands first, and the number of uses of each.
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
        // Operands have smaller ids than the expressions that use them.
        (seen.into_iter().collect(), uses)
    }
}
