//! Constructors with local simplification.
//!
//! Operations on literals are evaluated; zero terms and factors of 1 are dropped; signs are moved outwards, so that e
//! and −e share one node; the factors of a product are sorted (numbers, parameters, other values, rates), so that equal
//! products become one node; rotation by a right angle only permutes components. Products are never expanded, and
//! nothing is cancelled that could hide a division by zero (x/x is kept).

use super::graph::Graph;
use super::node::{Bits, ExprId, Node};
use super::vectors::quarter_turns;
use crate::vocabulary::Function;

/// Maximum number of factors of a product that is sorted. The time of sorting grows with the square of their number,
/// and nested squares can have exponentially many factors.
const MAX_FACTORS: usize = 24;

/// Maximum number of nodes among which factors 2 are looked for, since nested products can have exponentially many terms.
const MAX_VISITS: usize = 1000;

/// Classes of factors, in the order in which they appear in a product.
const STATIC: u8 = 0;
const MOVING: u8 = 1;
const RATES: u8 = 2;

impl Graph {
    /// −a.
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        match self.node(a) {
            Node::Number(bits) => return self.number(-bits.value()),
            Node::Neg(inner) => return inner,
            _ => {}
        }
        self.intern(Node::Neg(a))
    }

    /// The sign and the magnitude of an expression: (true, a) for −a and for a negative literal −a.
    pub(super) fn unsigned(&mut self, a: ExprId) -> (bool, ExprId) {
        match self.node(a) {
            Node::Neg(inner) => (true, inner),
            Node::Number(bits) if bits.value() < 0.0 => (true, self.number(-bits.value())),
            _ => (false, a),
        }
    }

    pub(super) fn signed(&mut self, negative: bool, a: ExprId) -> ExprId {
        if negative { self.neg(a) } else { a }
    }

    /// a + b.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.is_zero(a) {
            return b;
        }
        if self.is_zero(b) {
            return a;
        }
        if let Some(sum) = self.fold(a, b, |x, y| x + y) {
            return sum;
        }
        match (self.unsigned(a), self.unsigned(b)) {
            ((false, a), (false, b)) if a == b => {
                let two = self.number(2.0);
                self.mul(two, a)
            }
            ((false, a), (false, b)) => match (self.half(a), self.half(b)) {
                (Some(a), Some(b)) => {
                    let (two, sum) = (self.number(2.0), self.add(a, b));
                    self.mul(two, sum)
                }
                _ => self.intern(Node::Add(a.min(b), a.max(b))),
            },
            ((true, a), (true, b)) => {
                let sum = self.add(a, b);
                self.neg(sum)
            }
            ((false, a), (true, b)) => self.sub(a, b),
            ((true, a), (false, b)) => self.sub(b, a),
        }
    }

    /// a − b.
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if a == b {
            return self.zero();
        }
        if self.is_zero(b) {
            return a;
        }
        if self.is_zero(a) {
            return self.neg(b);
        }
        if let Some(difference) = self.fold(a, b, |x, y| x - y) {
            return difference;
        }
        match (self.unsigned(a), self.unsigned(b)) {
            ((false, a), (false, b)) => match (self.half(a), self.half(b), self.find(&Node::Sub(b, a))) {
                (Some(a), Some(b), _) => {
                    let (two, difference) = (self.number(2.0), self.sub(a, b));
                    self.mul(two, difference)
                }
                (_, _, Some(opposite)) => self.neg(opposite),
                _ => self.intern(Node::Sub(a, b)),
            },
            ((false, a), (true, b)) => self.add(a, b),
            ((true, a), (false, b)) => {
                let sum = self.add(a, b);
                self.neg(sum)
            }
            ((true, a), (true, b)) => self.sub(b, a),
        }
    }

    /// a · b.
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero();
        }
        if let Some(product) = self.fold(a, b, |x, y| x * y) {
            return product;
        }
        let ((negative_a, a), (negative_b, b)) = (self.unsigned(a), self.unsigned(b));
        let product = match self.factors(a, b).and_then(|factors| self.product(&factors)) {
            Some(product) => product,
            None => self.intern(Node::Mul(a.min(b), a.max(b))),
        };
        self.signed(negative_a != negative_b, product)
    }

    /// The product of any number of factors.
    pub fn mul_all<const N: usize>(&mut self, factors: [ExprId; N]) -> ExprId {
        let one = self.number(1.0);
        factors.into_iter().fold(one, |product, factor| self.mul(product, factor))
    }

    /// The factors of a · b, unless there are too many.
    fn factors(&self, a: ExprId, b: ExprId) -> Option<Vec<ExprId>> {
        let (mut factors, mut waiting) = (Vec::new(), vec![b, a]);
        while let Some(id) = waiting.pop() {
            match self.node(id) {
                Node::Mul(x, y) => waiting.extend([y, x]),
                _ => factors.push(id),
            }
            if factors.len() + waiting.len() > MAX_FACTORS {
                return None;
            }
        }
        Some(factors)
    }

    /// The product of unsigned factors: the number and the values first, then the product of the rates. Keeping rates
    /// together lets several products share φ̇². `None` if the numbers multiply to 0 or overflow.
    fn product(&mut self, factors: &[ExprId]) -> Option<ExprId> {
        let mut number = 1.0_f64;
        // (class, factor) by insertion sort, since there are few factors.
        let mut sorted: Vec<(u8, ExprId)> = Vec::with_capacity(factors.len());
        for &factor in factors {
            let depends = self.depends(factor);
            let class = match self.literal(factor) {
                Some(value) => {
                    number *= value;
                    continue;
                }
                None if depends.on(super::Depends::RATE) => RATES,
                None if depends.is_static() => STATIC,
                None => MOVING,
            };
            let mut place = sorted.len();
            while place > 0 && (class, factor) < sorted[place - 1] {
                place -= 1;
            }
            sorted.insert(place, (class, factor));
        }
        if !number.is_normal() {
            return None;
        }
        let mut values = if number == 1.0 { None } else { Some(self.number(number)) };
        let mut rates = None;
        for (class, factor) in sorted {
            let product = if class == RATES { &mut rates } else { &mut values };
            *product = Some(match *product {
                None => factor,
                Some(product) => self.intern(Node::Mul(product, factor)),
            });
        }
        Some(match (values, rates) {
            (Some(a), Some(b)) => self.intern(Node::Mul(a, b)),
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => self.number(1.0),
        })
    }

    /// a / b.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.literal(b) == Some(1.0) {
            return a;
        }
        if self.is_zero(a) && !self.is_zero(b) {
            return a;
        }
        if let Some(quotient) = self.fold(a, b, |x, y| x / y) {
            return quotient;
        }
        if let Some(divisor) = self.literal(b)
            && divisor != 0.0
            && divisor.to_bits().trailing_zeros() >= 52
            && divisor.recip().is_normal()
        {
            // The reciprocal of a power of two is exact, and multiplication is cheaper than division.
            let factor = self.number(divisor.recip());
            return self.mul(factor, a);
        }
        let ((negative_a, a), (negative_b, b)) = (self.unsigned(a), self.unsigned(b));
        let quotient = self.intern(Node::Div(a, b));
        self.signed(negative_a != negative_b, quotient)
    }

    /// The expression a if `id` is the product 2·a.
    fn half(&self, id: ExprId) -> Option<ExprId> {
        match self.node(id) {
            Node::Mul(two, a) if self.literal(two) == Some(2.0) => Some(a),
            _ => None,
        }
    }

    /// a/2, where a factor 2 cancels if every term has one.
    pub(super) fn half_of(&mut self, a: ExprId) -> ExprId {
        let mut visits = MAX_VISITS;
        self.without_two(a, &mut visits).unwrap_or_else(|| {
            let half = self.number(0.5);
            self.mul(half, a)
        })
    }

    /// a/2 if every term of a has a factor that can be halved, and no more than `visits` nodes are looked at.
    fn without_two(&mut self, a: ExprId, visits: &mut usize) -> Option<ExprId> {
        *visits = visits.checked_sub(1)?;
        match self.node(a) {
            Node::Number(bits) => Some(self.number(0.5 * bits.value())),
            Node::Neg(a) => self.without_two(a, visits).map(|half| self.neg(half)),
            Node::Add(a, b) if a == b => Some(a),
            Node::Add(a, b) => {
                let (a, b) = (self.without_two(a, visits)?, self.without_two(b, visits)?);
                Some(self.add(a, b))
            }
            Node::Sub(a, b) => {
                let (a, b) = (self.without_two(a, visits)?, self.without_two(b, visits)?);
                Some(self.sub(a, b))
            }
            Node::Mul(a, b) => match self.without_two(a, visits) {
                Some(half) => Some(self.mul(half, b)),
                None => self.without_two(b, visits).map(|half| self.mul(a, half)),
            },
            _ => None,
        }
    }

    /// 2a as the sum a + a, a single factor that several products can share.
    pub fn double(&mut self, a: ExprId) -> ExprId {
        if let Some(sum) = self.fold(a, a, |x, y| x + y) {
            return sum;
        }
        let (negative, a) = self.unsigned(a);
        let double = self.intern(Node::Add(a, a));
        self.signed(negative, double)
    }

    /// The literal result of an operation on two literals, if it is finite.
    fn fold(&mut self, a: ExprId, b: ExprId, f: impl Fn(f64, f64) -> f64) -> Option<ExprId> {
        let value = f(self.literal(a)?, self.literal(b)?);
        value.is_finite().then(|| self.number(value))
    }

    /// a².
    pub fn square(&mut self, a: ExprId) -> ExprId {
        let (_, a) = self.unsigned(a);
        self.mul(a, a)
    }

    /// a to the integer power n.
    pub fn powi(&mut self, a: ExprId, n: i32) -> ExprId {
        match n {
            0 => return self.number(1.0),
            1 => return a,
            2 => return self.square(a),
            _ => {}
        }
        if let Some(value) = self.literal(a).map(|v| v.powi(n)).filter(|v| v.is_finite()) {
            return self.number(value);
        }
        let (negative, a) = self.unsigned(a);
        let power = self.intern(Node::Powi(a, n));
        self.signed(negative && n % 2 != 0, power)
    }

    /// a to the real constant power n.
    pub fn powf(&mut self, a: ExprId, n: f64) -> ExprId {
        if n == n.trunc() && n.abs() <= 1024.0 {
            return self.powi(a, n as i32);
        }
        if n == 0.5 {
            return self.call(Function::Sqrt, a);
        }
        self.intern(Node::Powf(a, Bits::new(n)))
    }

    /// f(a).
    pub fn call(&mut self, f: Function, a: ExprId) -> ExprId {
        if self.is_zero(a) {
            match f {
                Function::Cos | Function::Exp => return self.number(1.0),
                Function::Sin | Function::Tan | Function::Asin | Function::Atan | Function::Sqrt | Function::Abs => {
                    return a;
                }
                Function::Acos | Function::Ln => {}
            }
        }
        if let (Function::Sin | Function::Cos, Some(quarters)) = (f, self.literal(a).and_then(quarter_turns)) {
            let cosines = [1.0, 0.0, -1.0, 0.0];
            return self.number(cosines[if f == Function::Cos { quarters } else { (quarters + 3) % 4 }]);
        }
        let (negative, inner) = self.unsigned(a);
        match f {
            Function::Sin | Function::Tan | Function::Asin | Function::Atan => {
                let value = self.intern(Node::Call(f, inner));
                self.signed(negative, value)
            }
            Function::Cos | Function::Abs => self.intern(Node::Call(f, inner)),
            Function::Sqrt => match self.literal(a).filter(|v| *v > 0.0 && v.is_finite()) {
                Some(value) => self.number(value.sqrt()),
                None => self.intern(Node::Call(f, a)),
            },
            _ => self.intern(Node::Call(f, a)),
        }
    }

    /// sin a.
    pub fn sin(&mut self, a: ExprId) -> ExprId {
        self.call(Function::Sin, a)
    }

    /// cos a.
    pub fn cos(&mut self, a: ExprId) -> ExprId {
        self.call(Function::Cos, a)
    }

    /// The sign of a.
    pub fn sign(&mut self, a: ExprId) -> ExprId {
        let (negative, inner) = self.unsigned(a);
        let sign = self.intern(Node::Sign(inner));
        self.signed(negative, sign)
    }

    /// atan2(y, x).
    pub fn atan2(&mut self, y: ExprId, x: ExprId) -> ExprId {
        self.intern(Node::Atan2(y, x))
    }

    /// The value a as an opaque unit; numbers, symbols and their negatives are opaque already.
    pub fn opaque(&mut self, a: ExprId) -> ExprId {
        let (negative, inner) = self.unsigned(a);
        match self.node(inner) {
            Node::Number(_) | Node::Symbol(_) | Node::Opaque(_) => a,
            _ => {
                let whole = self.intern(Node::Opaque(inner));
                self.signed(negative, whole)
            }
        }
    }

    /// The angle a + 2πn that is nearest to b.
    pub fn nearest(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.intern(Node::Nearest(a, b))
    }

    /// A supplied function (`order` 0) or its first or second derivative at `a`.
    pub fn supplied(&mut self, function: u32, order: u8, a: ExprId) -> ExprId {
        self.intern(Node::Supplied(function, order, a))
    }
}
