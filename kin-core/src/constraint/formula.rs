//! Converts the user's formulas to expressions.

use super::assembly::Assembly;
use crate::expr::{ExprId, Symbol, total_derivatives};
use crate::mechanism::{Component, Formula, Member, nodes};

impl Assembly<'_> {
    /// The index in q of a scalar coordinate for the current index variable, if it exists.
    pub(crate) fn scalar(&mut self, member: &Member) -> Option<u32> {
        let len = self.mechanism.scalars.get(member.family)?.len.unwrap_or(1);
        let index = member.index.at(self.index).filter(|i| *i < len)?;
        Some(self.first_scalar[member.family] + index as u32)
    }

    /// The expression of a formula for the current index variable.
    pub(crate) fn formula(&mut self, formula: &Formula) -> ExprId {
        match formula {
            Formula::Number(value) => self.graph.number(*value),
            Formula::Pi => self.graph.number(core::f64::consts::PI),
            Formula::Time => self.graph.symbol(Symbol::Time),
            Formula::Index(index) => {
                let value = index.scale.saturating_mul(self.index).saturating_add(index.offset);
                self.graph.number(value as f64)
            }
            Formula::Parameter(member) => {
                let len = self.mechanism.parameters.get(member.family).map_or(0, |p| p.len.unwrap_or(1));
                match member.index.at(self.index).filter(|i| *i < len) {
                    Some(i) => {
                        let first = self.first_parameter[member.family];
                        self.graph.symbol(Symbol::Parameter(first + i as u32))
                    }
                    None => {
                        self.error(member.origin, format!("the index is out of range: the array has {len} elements"))
                    }
                }
            }
            Formula::Input(member) => {
                let len = self.mechanism.inputs.get(member.family).map_or(0, |input| input.len.unwrap_or(1));
                match member.index.at(self.index).filter(|i| *i < len) {
                    Some(i) => {
                        let first = self.first_input[member.family];
                        self.graph.symbol(Symbol::Input(first + i as u32, 0))
                    }
                    None => self.error(member.origin, format!("the index is out of range: there are {len} inputs")),
                }
            }
            Formula::Pose(body, component) => self.pose(body)[*component as usize],
            Formula::Scalar(member) => match self.scalar(member) {
                Some(k) if self.variables.is_parameter(k) => self.graph.symbol(Symbol::ARGUMENT),
                Some(k) => self.graph.symbol(Symbol::Coordinate(k)),
                None => self.error(member.origin, "the index is out of range"),
            },
            Formula::PointCoordinate(place, component) => {
                let r = self.place(place).r;
                r[usize::from(*component != Component::X)]
            }
            Formula::Distance(p, q) => {
                let (p, q) = (self.place(p), self.place(q));
                self.distance_of_points(&p, &q)
            }
            Formula::Define(member) => self.define(member),
            // A curve variable outside a curve has been reported when names were resolved.
            Formula::Curve(variable) => self.variables.get(*variable).unwrap_or_else(|| self.graph.zero()),
            Formula::Neg(a) => {
                let a = self.formula(a);
                self.graph.neg(a)
            }
            Formula::Add(..) | Formula::Sub(..) | Formula::Mul(..) | Formula::Div(..) => self.arithmetic(formula),
            Formula::Pow(a, n) => {
                let a = self.formula(a);
                self.graph.powf(a, *n)
            }
            Formula::Call(f, a) => {
                let a = self.formula(a);
                self.graph.call(*f, a)
            }
            Formula::Atan2(y, x) => {
                let (y, x) = (self.formula(y), self.formula(x));
                self.graph.atan2(y, x)
            }
            Formula::Dot(a, _) => {
                let a = self.formula(a);
                self.rate(a)
            }
            Formula::Supplied(member, a) => {
                let a = self.formula(a);
                let len = self.mechanism.functions.get(member.family).map_or(0, |f| f.len.unwrap_or(1));
                match member.index.at(self.index).filter(|i| *i < len) {
                    Some(i) => self.graph.supplied(self.first_function[member.family] + i as u32, 0, a),
                    None => {
                        self.error(member.origin, format!("the index is out of range: the array has {len} elements"))
                    }
                }
            }
        }
    }

    /// ė of an expression without q̇, or its partial time derivative e_t while `at_rest` is set.
    pub(crate) fn rate(&mut self, e: ExprId) -> ExprId {
        match total_derivatives(&mut self.graph, &[e]).first() {
            Some(jet) if self.at_rest => jet.partial_t,
            Some(jet) => jet.rate,
            None => self.graph.zero(),
        }
    }

    /// Sums and products. A long one is deeply nested on the left, so the left operands are visited in a loop, not
    /// recursively.
    fn arithmetic(&mut self, formula: &Formula) -> ExprId {
        let (mut operations, mut left) = (Vec::new(), formula);
        while let Formula::Add(a, _) | Formula::Sub(a, _) | Formula::Mul(a, _) | Formula::Div(a, ..) = left {
            operations.push(left);
            left = a;
        }
        let mut value = self.formula(left);
        for operation in operations.into_iter().rev() {
            value = match operation {
                Formula::Add(_, b) => {
                    let b = self.formula(b);
                    self.graph.add(value, b)
                }
                Formula::Sub(_, b) => {
                    let b = self.formula(b);
                    self.graph.sub(value, b)
                }
                Formula::Mul(_, b) => {
                    let b = self.formula(b);
                    self.graph.mul(value, b)
                }
                Formula::Div(_, divisor, origin) => {
                    let b = self.formula(divisor);
                    if self.graph.is_zero(b) {
                        let in_family = nodes(divisor).iter().any(|node| matches!(node, Formula::Index(_)));
                        let at = in_family.then(|| format!(" where the index variable is {}", self.index));
                        self.error(*origin, format!("division by zero{}", at.unwrap_or_default()))
                    } else {
                        self.graph.div(value, b)
                    }
                }
                _ => value,
            };
        }
        value
    }
}
