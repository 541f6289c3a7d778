//! The hash-consed arena: every distinct expression once.

use super::node::{Bits, Depends, ExprId, Node, Symbol};
use crate::hash::Table;

/// An arena of expressions. Operands always come before the expressions that use them.
///
/// Constructors simplify locally (see `simplify.rs`) and never expand a product over a sum; only [`Graph::intern`] keeps an
/// operation as it is written.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    depends: Vec<Depends>,
    known: Table,
    /// The literal 0, which is asked for more often than anything else.
    zero: Option<ExprId>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of distinct expressions.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// True when nothing has been built yet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The operation behind `id`.
    pub fn node(&self, id: ExprId) -> Node {
        self.nodes[id.index()]
    }

    /// What `id` depends on.
    pub fn depends(&self, id: ExprId) -> Depends {
        self.depends[id.index()]
    }

    /// The id of `node` if it has been built.
    pub(super) fn find(&self, node: &Node) -> Option<ExprId> {
        self.found(node, node.hashed())
    }

    fn found(&self, node: &Node, hash: u64) -> Option<ExprId> {
        self.known.find(hash, |place| self.nodes[place] == *node).map(|place| ExprId(place as u32))
    }

    /// The id of `node`, built as it is when it is new.
    pub fn intern(&mut self, node: Node) -> ExprId {
        let hash = node.hashed();
        if let Some(id) = self.found(&node, hash) {
            return id;
        }
        let mut depends = match node {
            Node::Symbol(symbol) => Depends::of(symbol),
            _ => Depends::NOTHING,
        };
        node.for_each_operand(|operand| depends = depends.or(self.depends[operand.index()]));
        // A description has far fewer than 2³² expressions; saturating keeps this total.
        let id = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node);
        self.depends.push(depends);
        self.known.insert(hash, id.index());
        id
    }

    /// The literal `value`.
    pub fn number(&mut self, value: f64) -> ExprId {
        self.intern(Node::Number(Bits::new(value)))
    }

    /// The literal 0.
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

    /// A symbol.
    pub fn symbol(&mut self, symbol: Symbol) -> ExprId {
        self.intern(Node::Symbol(symbol))
    }

    /// The value of a literal.
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

    /// Every expression that was built, operands first.
    pub fn ids(&self) -> impl Iterator<Item = ExprId> + use<> {
        (0..self.nodes.len() as u32).map(ExprId)
    }

    /// Everything that `roots` are made of, operands first.
    pub fn reachable(&self, roots: impl IntoIterator<Item = ExprId>) -> Vec<ExprId> {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<ExprId> = roots.into_iter().collect();
        // Only what is found is walked over, so that many small questions to a large graph stay cheap.
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
        // Much of the graph: whoever is seen stands in order already.
        found.clear();
        let mut place = 0;
        while place < seen.len() {
            if seen[place] {
                found.push(ExprId(place as u32));
            }
            place += 1;
        }
        found
    }
}
