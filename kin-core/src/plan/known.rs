//! Values, rotations and rates of the coordinates that are already solved, and the rewriting of expressions in terms of
//! them.

use super::rewrite::{Substitution, Turned, rewrite};
use crate::expr::{ExprId, Graph, IdMap, Node, Symbol};
use crate::hash::FastMap;
use crate::structure::turn::terms;

/// The coordinates that are already solved, by their index of q.
#[derive(Default)]
pub(super) struct Known {
    pub(super) values: FastMap<u32, ExprId>,
    pub(super) turns: FastMap<u32, Turned>,
    pub(super) rates: FastMap<u32, ExprId>,
    /// Cache of the rewritten expressions of the system.
    pub(super) rewritten: IdMap<ExprId>,
}

impl Known {
    /// Rewrites an expression of the system in terms of the known coordinates.
    pub(super) fn value(&mut self, graph: &mut Graph, id: ExprId) -> ExprId {
        let Self { values, turns, rates, rewritten } = self;
        rewrite(graph, id, rewritten, &mut KnownValues { values, turns, rates })
    }
}

/// The substitution of the known coordinates.
struct KnownValues<'k> {
    values: &'k FastMap<u32, ExprId>,
    turns: &'k FastMap<u32, Turned>,
    rates: &'k FastMap<u32, ExprId>,
}

impl Substitution for KnownValues<'_> {
    fn symbol(&mut self, _graph: &mut Graph, symbol: Symbol) -> Option<ExprId> {
        match symbol {
            Symbol::Coordinate(k) => self.values.get(&k).copied(),
            Symbol::Rate(k) => self.rates.get(&k).copied(),
            _ => None,
        }
    }

    fn turn(&mut self, graph: &mut Graph, known: &IdMap<ExprId>, angle: ExprId) -> Option<Turned> {
        Some(turned(graph, self.turns, known, angle))
    }
}

/// The rotation by an angle: a product of the known cosines and sines of its terms, and a rotation by the remaining
/// terms.
pub(super) fn turned(graph: &mut Graph, turns: &FastMap<u32, Turned>, known: &IdMap<ExprId>, angle: ExprId) -> Turned {
    let mut pair: Option<[ExprId; 2]> = None;
    let mut rest = graph.zero();
    for (times, id) in terms(graph, angle) {
        let turn = match graph.node(id) {
            Node::Symbol(Symbol::Coordinate(k)) => turns.get(&k).copied(),
            _ => None,
        };
        match turn {
            Some(Turned::Pair([cos, sin])) if times.unsigned_abs() <= 3 => {
                let sin = if times < 0 { graph.neg(sin) } else { sin };
                for _ in 0..times.unsigned_abs() {
                    pair = Some(match pair {
                        None => [cos, sin],
                        Some([c, s]) => [graph.plain_cross([c, s], [sin, cos]), graph.plain_dot([s, c], [cos, sin])],
                    });
                }
            }
            _ => {
                let (factor, value) = (graph.number(times as f64), known.or(id, id));
                let term = graph.mul(factor, value);
                rest = graph.add(rest, term);
            }
        }
    }
    match pair {
        None => Turned::Angle(known.or(angle, rest)),
        Some(pair) if graph.is_zero(rest) => Turned::Pair(pair),
        Some(pair) => Turned::Pair(graph.rotate(rest, pair)),
    }
}
