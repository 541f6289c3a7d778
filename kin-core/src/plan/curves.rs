//! Curves: functions whose course between two configurations the configurations themselves do not show.
//!
//! Vectors that rotate with a body, and products of lengths with them, change no faster than the body turns, and the
//! steps of a motion are limited by the turns of bodies. A function of a coordinate, of time or of an input may rise and
//! fall between two places at which it has the same value and the same rates, as sin³(8θ) does between θ = 0 and θ = π/8.

use super::tree::{Block, BlockPart, Core, SolutionMethod};
use crate::constraint::{ConstraintRow, RowMeaning};
use crate::expr::{Depends, ExprId, Graph, IdMap, Node, Symbol};
use crate::program::{Program, Slot, lower};
use crate::vocabulary::Function;
use std::collections::{BTreeMap, BTreeSet};

/// Functions in rows that are known where the motion is, and whose course between two configurations these do not show.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KnownCurves {
    /// Whether a coordinate may move between two configurations otherwise than these show: a row contains a function of
    /// time, of an input, or of a coordinate for which the plan does not iterate on the row, and more than one sinusoid.
    pub hide_motion: bool,
    /// Whether a row contains a sinusoid of an input, or a product or power of what inputs change, which may change and return
    /// between two values of the inputs; only rates along the path of the inputs show it.
    pub inputs_curve: bool,
    /// The curves that can be enclosed over a step: functions of time and inputs alone or of a single coordinate, and curves
    /// over curves, as a radius over the angle of a point; where velocities are integrated, functions of several variables,
    /// too, and the functions of which these consist; then the arguments of supplied functions.
    pub program: Program,
    /// The supplied functions, in the order of their arguments.
    pub supplied: Vec<usize>,
}

/// True if an expression has curves over coordinates: if it depends on them in another way than by sums, products and
/// rotated vectors.
pub(super) fn has_curves(graph: &Graph, expressions: &[ExprId]) -> bool {
    let varies = |id: ExprId| graph.depends(id).on(Depends::COORDINATE);
    graph.reachable(expressions.iter().copied()).into_iter().any(|id| match graph.node(id) {
        Node::Call(_, a) => varies(a),
        _ => is_other_curve(graph, id, &varies),
    })
}

/// True for a node that is a curve over what varies, other than a function of the language.
fn is_other_curve(graph: &Graph, id: ExprId, varies: &dyn Fn(ExprId) -> bool) -> bool {
    match graph.node(id) {
        Node::Supplied(_, _, a) | Node::Powf(a, _) => varies(a),
        Node::Powi(a, n) => !(0..=2).contains(&n) && varies(a),
        Node::Div(_, b) => varies(b),
        Node::Atan2(y, x) => varies(y) || varies(x),
        _ => false,
    }
}

/// True if the value of an expression may change and return although its rate and acceleration vanish at both ends.
///
/// One sinusoid of an affine argument cannot, nor can its square: rate and acceleration of a sin x never vanish together.
/// The sum of two can, as sin³ x = ¾ sin x − ¼ sin 3x shows; so can vectors that turn with bodies held at two such angles. A
/// polynomial that changes and returns in this way has three zeros at each end, so that its degree is at least 6.
fn hides_motion(graph: &Graph, expression: ExprId, varies: &dyn Fn(ExprId) -> bool) -> bool {
    let (mut arguments, mut degrees) = (BTreeSet::new(), IdMap::default());
    // The argument of a sinusoid, unless it turns no faster than the bodies.
    let sinusoid = |id: ExprId| turning_argument(graph, id).filter(|&a| varies(a) && !is_sum_of_angles(graph, a));
    let has_sinusoid = |id: ExprId| graph.reachable([id]).into_iter().any(|id| sinusoid(id).is_some());
    graph.reachable([expression]).into_iter().any(|id| match (graph.node(id), turning_argument(graph, id)) {
        (_, Some(a)) if is_affine(graph, a) => sinusoid(id).is_some() && arguments.insert(a) && arguments.len() > 1,
        (_, Some(a)) | (Node::Call(_, a), _) => varies(a),
        (Node::Mul(a, b), _) if a != b && (has_sinusoid(a) && varies(b) || has_sinusoid(b) && varies(a)) => true,
        (node, _) => add_degree((id, node), varies, &mut degrees) > 5 || is_other_curve(graph, id, varies),
    })
}

/// The argument of a sine or cosine, or the angle of a vector that turns with time or an input.
fn turning_argument(graph: &Graph, id: ExprId) -> Option<ExprId> {
    match graph.node(id) {
        Node::Call(Function::Sin | Function::Cos, a) => Some(a),
        Node::RotX(r) | Node::RotY(r) if graph.depends(r.angle).is_rheonomic() => Some(r.angle),
        _ => None,
    }
}

/// Adds the degree of a polynomial to those of its operands, and returns it; 0 for all other expressions.
fn add_degree((id, node): (ExprId, Node), varies: &dyn Fn(ExprId) -> bool, degrees: &mut IdMap<u32>) -> u32 {
    let of = |id: ExprId| degrees.or(id, 0);
    let degree = match node {
        Node::Symbol(_) => u32::from(varies(id)),
        Node::Neg(a) | Node::Opaque(a) | Node::Div(a, _) => of(a),
        Node::Add(a, b) | Node::Sub(a, b) => of(a).max(of(b)),
        Node::Mul(a, b) => of(a).saturating_add(of(b)),
        _ => 0,
    };
    degrees.insert(id, degree);
    degree
}

/// The parts of rows that hide motion and depend on time and inputs alone or on a single coordinate, or are curves over
/// curves, each once, without supplied functions; and these functions with their arguments. If velocities are integrated, all
/// parts that hide motion.
fn enclosable(
    graph: &mut Graph,
    rows: &[ConstraintRow],
    is_integrated: bool,
) -> (Vec<ExprId>, BTreeSet<(usize, ExprId)>) {
    let mut curves = Curves { is_integrated, ..Curves::default() };
    let expressions: Vec<_> = rows.iter().map(|row| row.velocity.map_or(row.phi, |velocity| velocity.eta)).collect();
    expressions.iter().for_each(|&expression| curves.add_sum(graph, expression));
    if is_integrated {
        curves.found.extend(functions_within(graph, &expressions));
    }
    let supplied = graph.reachable(expressions).into_iter().filter_map(|id| match graph.node(id) {
        Node::Supplied(function, _, argument) => Some((function as usize, argument)),
        _ => None,
    });
    (curves.found.into_iter().collect(), supplied.collect())
}

/// The functions of which rows consist, each by itself: the sum or product in which it stands may vary so much in a step that
/// a pulse of the function is small beside it.
fn functions_within(graph: &Graph, rows: &[ExprId]) -> Vec<ExprId> {
    let varies = |id: ExprId| !graph.depends(id).is_static();
    let may_have_pulses = |id: ExprId| match graph.node(id) {
        Node::Call(Function::Sin | Function::Cos, a) => varies(a) && !is_affine(graph, a),
        Node::Call(_, a) => varies(a),
        _ => is_other_curve(graph, id, &varies),
    };
    let is_known = |id: ExprId| !graph.depends(id).on(Depends::RATE) && !has_supplied(graph, id);
    graph.reachable(rows.iter().copied()).into_iter().filter(|&id| may_have_pulses(id) && is_known(id)).collect()
}

/// The curves of rows.
#[derive(Default)]
struct Curves {
    found: BTreeSet<ExprId>,
    /// The sums that have been searched.
    seen: BTreeSet<ExprId>,
    /// Whether velocities are integrated, so that any function of several variables counts.
    is_integrated: bool,
}

impl Curves {
    /// Adds the curves of a sum: the terms that depend on the same variable together, and the curves within the other terms.
    fn add_sum(&mut self, graph: &mut Graph, sum: ExprId) {
        if !self.seen.insert(sum) {
            return;
        }
        let mut of_variable: BTreeMap<Variable, ExprId> = BTreeMap::new();
        let mut terms = vec![(sum, false)];
        while let Some((id, is_negative)) = terms.pop() {
            match graph.node(id) {
                Node::Add(a, b) => terms.extend([(b, is_negative), (a, is_negative)]),
                Node::Sub(a, b) => terms.extend([(b, !is_negative), (a, is_negative)]),
                Node::Neg(a) => terms.push((a, !is_negative)),
                Node::Opaque(a) => terms.push((a, is_negative)),
                node => match variable(graph, id) {
                    Some(Variable::None) => {}
                    Some(Variable::Several) if !self.is_integrated && is_composed(graph, id) => {
                        self.found.insert(id);
                    }
                    Some(variable)
                        if variable != Variable::Several || self.is_integrated && !has_supplied(graph, id) =>
                    {
                        let before = of_variable.get(&variable).copied().unwrap_or_else(|| graph.zero());
                        let sum = if is_negative { graph.sub(before, id) } else { graph.add(before, id) };
                        of_variable.insert(variable, sum);
                    }
                    _ => {
                        let mut operands = Vec::new();
                        match node {
                            // The curve of a rate over a divisor is the factor of the rate.
                            Node::Div(a, b) if graph.depends(a).on(Depends::RATE) => {
                                let one = graph.number(1.0);
                                operands.extend([a, graph.div(one, b)]);
                            }
                            _ => node.for_each_operand(|operand| operands.push(operand)),
                        }
                        operands.into_iter().for_each(|operand| self.add_sum(graph, operand));
                    }
                },
            }
        }
        let graph = &*graph;
        let varies = |id: ExprId| graph.depends(id).on(RHEONOMIC.or(Depends::COORDINATE));
        self.found.extend(of_variable.into_values().filter(|&sum| hides_motion(graph, sum, &varies)));
    }
}

/// True for a curve over a curve of several variables, as a radius over the angle of a point, without supplied functions.
fn is_composed(graph: &Graph, id: ExprId) -> bool {
    let varies = |id: ExprId| !graph.depends(id).is_static();
    let is_curve = |id: ExprId| match graph.node(id) {
        Node::Call(_, a) => varies(a),
        _ => is_other_curve(graph, id, &varies),
    };
    let within = graph.reachable([id]);
    let is_of_several = |id: ExprId| variable(graph, id) == Some(Variable::Several);
    is_curve(id)
        && within.iter().any(|&inner| inner != id && is_curve(inner) && is_of_several(inner))
        && !has_supplied(graph, id)
}

/// True if an expression contains a supplied function.
fn has_supplied(graph: &Graph, id: ExprId) -> bool {
    graph.reachable([id]).into_iter().any(|id| matches!(graph.node(id), Node::Supplied(..)))
}

/// What a part of a row varies with.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Variable {
    /// Nothing that counts here: it is constant during a motion, or has a supplied function, which is listed by itself.
    None,
    /// Time and inputs.
    Instant,
    /// One coordinate.
    Coordinate(u32),
    /// Several coordinates, or coordinates and the instant.
    Several,
}

/// What an expression varies with; `None` if it depends on rates, which are not known where curves are enclosed.
fn variable(graph: &Graph, id: ExprId) -> Option<Variable> {
    let depends = graph.depends(id);
    if depends.on(Depends::RATE) {
        return None;
    }
    if depends.is_static() {
        return Some(Variable::None);
    }
    let mut found = depends.is_rheonomic().then_some(Variable::Instant);
    for id in graph.reachable([id]) {
        match graph.node(id) {
            Node::Supplied(..) => return Some(Variable::None),
            Node::Symbol(Symbol::Coordinate(k)) => match found {
                None => found = Some(Variable::Coordinate(k)),
                Some(_) => return Some(Variable::Several),
            },
            _ => {}
        }
    }
    found
}

/// True for a sum and difference of coordinates and constants.
fn is_sum_of_angles(graph: &Graph, id: ExprId) -> bool {
    match graph.node(id) {
        Node::Symbol(Symbol::Coordinate(_)) => true,
        Node::Neg(a) => is_sum_of_angles(graph, a),
        Node::Add(a, b) | Node::Sub(a, b) => is_sum_of_angles(graph, a) && is_sum_of_angles(graph, b),
        _ => graph.depends(id).is_static(),
    }
}

/// True for a sum of symbols with constant factors.
fn is_affine(graph: &Graph, id: ExprId) -> bool {
    let is_static = |id: ExprId| graph.depends(id).is_static();
    match graph.node(id) {
        Node::Symbol(_) => true,
        Node::Neg(a) | Node::Opaque(a) => is_affine(graph, a),
        Node::Add(a, b) | Node::Sub(a, b) => is_affine(graph, a) && is_affine(graph, b),
        Node::Mul(a, b) => is_static(a) && is_affine(graph, b) || is_static(b) && is_affine(graph, a),
        Node::Div(a, b) => is_static(b) && is_affine(graph, a),
        _ => is_static(id),
    }
}

/// True if the plan iterates on rows with curves.
pub(super) fn iterates_on_curves(graph: &Graph, block: &Block) -> bool {
    any_core(block, &mut |core| match &core.method {
        SolutionMethod::Newton { residuals } => has_curves(graph, residuals),
        _ => false,
    })
}

/// Where known values curve: the functions that can be enclosed over a step.
pub(super) fn known_curves(
    graph: &mut Graph,
    rows: &[ConstraintRow],
    plan: Option<(&Block, &[BTreeSet<usize>])>,
) -> KnownCurves {
    let hide_motion = known_values_curve(graph, rows, plan);
    let inputs_curve = inputs_curve(graph, rows);
    // Velocities that are integrated hide motion, too.
    let is_integrated = rows.iter().any(|row| row.velocity.is_some());
    if !hide_motion && !is_integrated {
        return KnownCurves { inputs_curve, ..KnownCurves::default() };
    }
    let (formulas, supplied) = enclosable(graph, rows, is_integrated);
    let all = formulas.into_iter().chain(supplied.iter().map(|(_, argument)| *argument));
    let outputs: Vec<_> = all.enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
    KnownCurves {
        hide_motion,
        inputs_curve,
        program: lower(graph, &outputs),
        supplied: supplied.into_iter().map(|(function, _)| function).collect(),
    }
}

/// True if a row contains a sinusoid of an input, or a product or power of what inputs change. The square of a prescribed
/// length alone does not count: a length is not negative, and so its square is as steady as the length.
fn inputs_curve(graph: &Graph, rows: &[ConstraintRow]) -> bool {
    let varies = |id: ExprId| graph.depends(id).on(Depends::INPUT);
    rows.iter().any(|row| {
        let square_of_length = match (row.meaning, graph.node(row.phi)) {
            (RowMeaning::SquaredDistance, Node::Sub(_, square)) => Some(square),
            _ => None,
        };
        graph.reachable([row.phi]).into_iter().any(|id| match (graph.node(id), turning_argument(graph, id)) {
            (_, Some(argument)) => varies(argument),
            (Node::Mul(a, b), _) => varies(a) && varies(b) && Some(id) != square_of_length,
            (Node::Powi(a, _), _) => varies(a),
            _ => false,
        })
    })
}

/// True if a row contains a function that may hide motion, of time, of an input, or of a coordinate for which the plan does
/// not iterate on that row. `sources` are the rows that each row of the plan combines; without a plan no row is iterated.
fn known_values_curve(graph: &Graph, rows: &[ConstraintRow], plan: Option<(&Block, &[BTreeSet<usize>])>) -> bool {
    let (mut iterated, mut found) = (BTreeSet::new(), false);
    if let Some((tree, sources)) = plan {
        any_core(tree, &mut |core| {
            if let SolutionMethod::Newton { residuals } = &core.method {
                iterated.extend(core.rows.iter().flat_map(|&row| &sources[row]).copied());
                found |= residuals.iter().any(|&f| hides_motion(graph, f, &|id| depends_on_known(graph, id, core)));
            }
            found
        });
    }
    let varies = |id: ExprId| graph.depends(id).on(RHEONOMIC.or(Depends::COORDINATE));
    let mut closed = rows.iter().enumerate().filter(|(row, _)| !iterated.contains(row));
    found || closed.any(|(_, row)| hides_motion(graph, row.phi, &varies))
}

const RHEONOMIC: Depends = Depends::TIME.or(Depends::INPUT);

/// True if an expression depends on time, on an input, or on a coordinate that the core does not give.
fn depends_on_known(graph: &Graph, id: ExprId, core: &Core) -> bool {
    let is_known =
        |id: ExprId| matches!(graph.node(id), Node::Symbol(Symbol::Coordinate(k)) if !core.coordinates.contains(&k));
    graph.depends(id).on(RHEONOMIC) || graph.reachable([id]).into_iter().any(is_known)
}

/// True if the condition holds for a core of the block.
fn any_core(block: &Block, condition: &mut dyn FnMut(&Core) -> bool) -> bool {
    block.parts.iter().any(|part| match part {
        BlockPart::Core(core) => condition(core),
        BlockPart::Block(block) => any_core(block, condition),
        BlockPart::Pair(pair) => any_core(&pair.inner, condition),
    })
}
