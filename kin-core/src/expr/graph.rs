//! The hash-consed graph of expressions, which stores every distinct expression once.

use super::node::{Bits, Depends, ExprId, Node, Symbol};
use crate::hash::{Table, hash_of};

/// An arena of expressions, in which operands always come before the expressions that use them.
///
/// The constructors simplify locally (see `simplify.rs`) and never expand a product over a sum; only [`Graph::intern`]
/// stores an operation as it is given.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    depends: Vec<Depends>,
    known: Table,
    /// The literal 0, cached because it is requested most often.
    zero: Option<ExprId>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of distinct expressions.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// True for a graph without expressions.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node of `id`.
    pub fn node(&self, id: ExprId) -> Node {
        self.nodes[id.index()]
    }

    /// The kinds of symbols that `id` depends on.
    pub fn depends(&self, id: ExprId) -> Depends {
        self.depends[id.index()]
    }

    /// The id of `node` if the graph contains it.
    pub(super) fn find(&self, node: &Node) -> Option<ExprId> {
        self.found(node, hash_of(node))
    }

    fn found(&self, node: &Node, hash: u64) -> Option<ExprId> {
        self.known.find(hash, |index| self.nodes[index] == *node).map(|index| ExprId(index as u32))
    }

    /// The id of `node`, which is added without simplification if it is new.
    pub fn intern(&mut self, node: Node) -> ExprId {
        let hash = hash_of(&node);
        if let Some(id) = self.found(&node, hash) {
            return id;
        }
        let mut depends = match node {
            Node::Symbol(symbol) => Depends::of(symbol),
            _ => Depends::NOTHING,
        };
        node.for_each_operand(|operand| depends = depends.or(self.depends[operand.index()]));
        // A mechanism has far fewer than 2³² expressions; saturation only avoids a panic.
        let id = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node);
        self.depends.push(depends);
        self.known.insert(hash, id.index());
        id
    }

    /// The id of the literal `value`.
    pub fn number(&mut self, value: f64) -> ExprId {
        self.intern(Node::Number(Bits::new(value)))
    }

    /// The id of the literal 0.
    pub fn zero(&mut self) -> ExprId {
        match self.zero {
            Some(zero) => zero,
            None => {
                let zero = self.number(0.0);
                self.zero = Some(zero);
                zero
            }
        }
    }

    /// The id of a symbol.
    pub fn symbol(&mut self, symbol: Symbol) -> ExprId {
        self.intern(Node::Symbol(symbol))
    }

    /// The value of `id` if it is a literal.
    pub fn literal(&self, id: ExprId) -> Option<f64> {
        match self.node(id) {
            Node::Number(bits) => Some(bits.value()),
            _ => None,
        }
    }

    /// True for the literal 0.
    pub fn is_zero(&self, id: ExprId) -> bool {
        matches!(self.node(id), Node::Number(bits) if bits.is_zero())
    }

    /// All expressions of the graph, operands first.
    pub fn ids(&self) -> impl Iterator<Item = ExprId> + use<> {
        (0..self.nodes.len() as u32).map(ExprId)
    }

    /// The expressions `roots` and all their subexpressions, operands first.
    pub fn reachable(&self, roots: impl IntoIterator<Item = ExprId>) -> Vec<ExprId> {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<ExprId> = roots.into_iter().collect();
        // The list of the expressions found keeps searches of a small part of a large graph cheap.
        let mut found = Vec::new();
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut seen[id.index()], true) {
                found.push(id);
                self.node(id).for_each_operand(|operand| stack.push(operand));
            }
        }
        if found.len() < self.nodes.len() / 16 {
            found.sort_unstable();
            return found;
        }
        // If a large part of the graph is reachable, a scan in ascending order is cheaper than sorting.
        found.clear();
        let mut index = 0;
        while index < seen.len() {
            if seen[index] {
                found.push(ExprId(index as u32));
            }
            index += 1;
        }
        found
    }
}
