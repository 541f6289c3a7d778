//! Writes the lines for q, q̇ and q̈ of each item that `collect` has found. The formulas are built as expressions of
//! the graph, which simplifies factors of 0 and 1.

use super::collect::{Item, PartSolution};
use super::line::{Formulas, Line};
use super::share::Naming;
use crate::expr::{ExprId, Graph, Jet, Shown, Symbol, total_derivatives};
use crate::plan::step::{Step, StepId};
use crate::plan::steps::StepList;
use crate::system::KinematicSystem;
use crate::vocabulary::Function;
use crate::vocabulary::StepKind;

struct FormulaWriter<'a> {
    system: &'a KinematicSystem,
    graph: Graph,
    listed: &'a StepList,
    roots: &'a [ExprId],
    jets: Vec<Jet>,
    naming: Naming<'a>,
    out: Vec<Formulas>,
}

/// The lines of all items.
pub(super) fn write(
    system: &KinematicSystem,
    mut graph: Graph,
    listed: &StepList,
    items: &[Item],
    roots: &[ExprId],
) -> Vec<Formulas> {
    let jets = total_derivatives(&mut graph, roots);
    let mut naming = Naming::new(&system.set);
    for (index, mode) in (0..).zip(&listed.modes) {
        let name = naming.fresh("sigma", mode.step.number());
        naming.modes.insert(index, name);
    }
    let mut writer = FormulaWriter { system, graph, listed, roots, jets, naming, out: Vec::new() };
    items.iter().for_each(|item| writer.item(item));
    writer.out
}

impl FormulaWriter<'_> {
    fn item(&mut self, item: &Item) {
        if self.out.last().is_none_or(|last| last.step != item.step) {
            let description = self.description(item.step);
            self.out.push(Formulas { step: item.step, what: description, lines: Default::default() });
        }
        let number = item.step.number();
        match &item.method {
            PartSolution::Explicit { k, value } => self.explicit(*k, *value),
            PartSolution::Linear { unknowns, residuals, matrix, right } => {
                match (matrix.as_slice(), right.as_slice(), unknowns.as_slice()) {
                    ([row], [right], [k]) => {
                        let value = self.graph.div(*right, row[0]);
                        self.equation(0, self.coordinate(*k, 0), value);
                    }
                    _ => self.system(0, matrix, unknowns, right),
                }
                self.implicit(unknowns, residuals);
            }
            PartSolution::Newton { unknowns, residuals } => {
                for &residual in residuals {
                    let (left, value) = (self.naming.fresh("g", number), self.roots[residual]);
                    let right = self.shown(0, value);
                    self.push(0, Line::Zero { left, right });
                }
                self.implicit(unknowns, residuals);
            }
            PartSolution::Angle { k, times, coefficients } => self.angle(*k, *times, *coefficients, number),
            PartSolution::Quadratic { k, coefficients } => self.quadratic(*k, *coefficients, number),
            PartSolution::Circle { at, coefficients, residuals } => {
                self.circle(*at, *coefficients, number);
                self.implicit(at, residuals);
            }
            PartSolution::Turn { k, turn, cos, sin } => self.turn(*k, turn, [*cos, *sin], number),
        }
    }

    /// The description of a step in words.
    fn description(&self, step: StepId) -> String {
        let Step { kind, group, joints, modes, singular, .. } = self.listed.step(step);
        let names: Vec<&str> = joints.iter().map(|&joint| self.system.set.joints[joint].name.as_str()).collect();
        let mut description = names.join(", ");
        match kind {
            StepKind::Explicit => description.push_str(": by formula"),
            StepKind::Linear(1) if group.is_empty() => description.push_str(": a linear equation"),
            StepKind::Linear(n) if group.is_empty() => description.push_str(&format!(": {n} linear equations")),
            StepKind::Closure if group.is_empty() => description.push_str(": in closed form"),
            StepKind::Newton(n) => {
                let unknowns = if *n == 1 { "unknown" } else { "unknowns" };
                description.push_str(&format!(": {n} {unknowns} by Newton's iteration, which brings g to 0"));
            }
            _ => description.push_str(&format!(": dyad {group}, in closed form")),
        }
        for index in modes.clone() {
            let name = &self.listed.modes[index].name;
            description.push_str(&format!(", σ = ±1 the sign of mode {name}"));
        }
        if !singular.is_empty() {
            description.push_str(&format!("; singular with {singular}"));
        }
        description
    }

    fn push(&mut self, order: usize, line: Line) {
        if let Some(last) = self.out.last_mut() {
            last.lines[order].push(line);
        }
    }

    /// The text of an expression, after writing lines for its named parts.
    fn shown(&mut self, order: usize, id: ExprId) -> String {
        let number = self.out.last().map_or(0, |last| last.step.number());
        self.naming.order = order;
        for (left, part) in self.naming.parts(&self.graph, &[id], number) {
            let right = Shown { graph: &self.graph, names: &self.naming, id: part }.to_string();
            self.push(order, Line::Equation { left, right });
        }
        Shown { graph: &self.graph, names: &self.naming, id }.to_string()
    }

    fn equation(&mut self, order: usize, left: String, id: ExprId) {
        let right = self.shown(order, id);
        self.push(order, Line::Equation { left, right });
    }

    /// The name of coordinate k, its rate or its acceleration.
    fn coordinate(&self, k: u32, order: usize) -> String {
        let set = &self.system.set;
        set.rate_name(set.coordinate_name(k), order as u8)
    }

    fn symbol(&mut self, k: u32, order: usize) -> ExprId {
        self.graph.symbol([Symbol::Coordinate(k), Symbol::Rate(k), Symbol::Saved(k)][order])
    }

    /// The first or second time derivative of a root, without the terms of the coordinates `without`.
    fn derivative(&mut self, root: usize, order: usize, without: &[u32]) -> ExprId {
        let jet = &self.jets[root];
        let (mut sum, gradient) = (if order == 1 { jet.partial_t } else { jet.rest }, jet.gradient.clone());
        for (k, entry) in gradient.into_iter().rev().filter(|(k, _)| !without.contains(k)) {
            let symbol = self.symbol(k, order);
            let term = self.graph.mul(entry, symbol);
            sum = self.graph.add(term, sum);
        }
        sum
    }

    fn explicit(&mut self, k: u32, value: usize) {
        self.equation(0, self.coordinate(k, 0), self.roots[value]);
        for order in 1..3 {
            let value = self.derivative(value, order, &[]);
            self.equation(order, self.coordinate(k, order), value);
        }
    }

    fn system(&mut self, order: usize, matrix: &[Vec<ExprId>], unknowns: &[u32], right: &[ExprId]) {
        let matrix = matrix.iter().map(|row| row.iter().map(|&e| self.shown(order, e)).collect()).collect();
        let right = right.iter().map(|&e| self.shown(order, e)).collect();
        let unknowns = unknowns.iter().map(|&k| self.coordinate(k, order)).collect();
        self.push(order, Line::System { matrix, unknowns, right });
    }

    /// Writes the linear systems for the rates and accelerations of the unknowns of `residuals`: Jacobian · rates
    /// equals the negative of the remaining terms.
    fn implicit(&mut self, unknowns: &[u32], residuals: &[usize]) {
        let zero = self.graph.zero();
        let entry = |jet: &Jet, k: u32| jet.gradient.iter().find(|(other, _)| *other == k).map_or(zero, |(_, e)| *e);
        let row = |&residual: &usize| unknowns.iter().map(|&k| entry(&self.jets[residual], k)).collect();
        let matrix: Vec<Vec<ExprId>> = residuals.iter().map(row).collect();
        for order in 1..3 {
            let rest: Vec<ExprId> =
                residuals.iter().map(|&residual| self.derivative(residual, order, unknowns)).collect();
            let right: Vec<ExprId> = rest.into_iter().map(|e| self.graph.neg(e)).collect();
            match (matrix.as_slice(), right.as_slice(), unknowns) {
                ([row], [right], [k]) => {
                    let value = self.graph.div(*right, row[0]);
                    self.equation(order, self.coordinate(*k, order), value);
                }
                _ => self.system(order, &matrix, unknowns, &right),
            }
        }
    }

    /// Defines a name for an expression and for each of its derivatives. A literal gets no name, and a derivative that
    /// is 0 no line.
    fn named(&mut self, letter: &str, root: usize, number: usize) -> [ExprId; 3] {
        let value = self.roots[root];
        let zero = self.graph.zero();
        if self.graph.literal(value).is_some() {
            return [value, zero, zero];
        }
        let name = self.naming.fresh(letter, number);
        let mut symbols = [zero; 3];
        for (order, suffix) in ["", "_dot", "_ddot"].into_iter().enumerate() {
            let value = if order == 0 { value } else { self.derivative(root, order, &[]) };
            if !self.graph.is_zero(value) {
                symbols[order] = self.define(order, format!("{name}{suffix}"), value);
            }
        }
        symbols
    }

    /// Writes a line that defines a name, and returns the symbol of the name.
    fn define(&mut self, order: usize, name: String, value: ExprId) -> ExprId {
        self.equation(order, name.clone(), value);
        self.naming.defined.push(name);
        self.graph.symbol(Symbol::Right(self.naming.defined.len() as u32 - 1))
    }

    /// Defines w = σ √inside.
    fn root(&mut self, inside: ExprId, number: usize) -> ExprId {
        let index = self.listed.modes.iter().position(|mode| mode.step.number() == number).unwrap_or(0);
        let mode = self.graph.symbol(Symbol::Mode(index as u32));
        let root = self.graph.call(Function::Sqrt, inside);
        let value = self.graph.mul(mode, root);
        let name = self.naming.fresh("w", number);
        self.define(0, name, value)
    }

    /// Lines for ψ = nφ: w = σ √(a² + b² − c²), ψ = atan2(b c + a w, a c − b w), ψ̇ w = ȧ cos ψ + ḃ sin ψ − ċ.
    fn angle(&mut self, k: u32, times: i32, coefficients: [usize; 3], number: usize) {
        let [a, b, c] = self.three(coefficients, number);
        let graph = &mut self.graph;
        let (d, square) = (graph.plain_dot([a[0], b[0]], [a[0], b[0]]), graph.square(c[0]));
        let inside = graph.sub(d, square);
        let w = self.root(inside, number);
        let graph = &mut self.graph;
        let n = graph.number(f64::from(times));
        let (y, x) = (graph.plain_dot([b[0], a[0]], [c[0], w]), graph.plain_cross([a[0], b[0]], [w, c[0]]));
        let psi = graph.atan2(y, x);
        let value = graph.div(psi, n);
        self.equation(0, self.coordinate(k, 0), value);
        let [phi, rate] = [0, 1].map(|order| self.symbol(k, order));
        let graph = &mut self.graph;
        let psi = graph.mul(n, phi);
        let (cos, sin, below) = (graph.cos(psi), graph.sin(psi), graph.mul(n, w));
        let psi_dot = graph.mul(n, rate);
        let level = |graph: &mut Graph, [a, b, c]: [ExprId; 3]| {
            let sum = graph.plain_dot([a, b], [cos, sin]);
            graph.sub(sum, c)
        };
        let first = level(graph, [a[1], b[1], c[1]]);
        let first = graph.div(first, below);
        let second = level(graph, [a[2], b[2], c[2]]);
        let across = graph.plain_cross([b[1], a[1]], [sin, cos]);
        let twice = graph.mul(psi_dot, across);
        let twice = graph.double(twice);
        let (square, second) = (graph.square(psi_dot), graph.add(second, twice));
        let central = graph.mul(square, c[0]);
        let second = graph.sub(second, central);
        let second = graph.div(second, below);
        self.equation(1, self.coordinate(k, 1), first);
        self.equation(2, self.coordinate(k, 2), second);
    }

    /// Lines for w = σ √(b²/4 − a c), x = (w − b/2)/a, 2 w ẋ = −(ȧ x² + ḃ x + ċ).
    fn quadratic(&mut self, k: u32, coefficients: [usize; 3], number: usize) {
        let [a, b, c] = self.three(coefficients, number);
        let graph = &mut self.graph;
        let two = graph.number(2.0);
        let half = graph.div(b[0], two);
        let (square, product) = (graph.square(half), graph.mul(a[0], c[0]));
        let inside = graph.sub(square, product);
        let w = self.root(inside, number);
        let graph = &mut self.graph;
        let above = graph.sub(w, half);
        let value = graph.div(above, a[0]);
        self.equation(0, self.coordinate(k, 0), value);
        let [x, rate] = [0, 1].map(|order| self.symbol(k, order));
        let graph = &mut self.graph;
        let below = graph.double(w);
        let level = |graph: &mut Graph, [a, b, c]: [ExprId; 3]| {
            let square = graph.square(x);
            let (first, second) = (graph.mul(a, square), graph.mul(b, x));
            let sum = graph.add(first, second);
            graph.add(sum, c)
        };
        let first = level(graph, [a[1], b[1], c[1]]);
        let second = level(graph, [a[2], b[2], c[2]]);
        // Adds 2 ẋ (2 ȧ x + ḃ) + 2 a ẋ² to the second derivative.
        let inner = graph.mul(a[1], x);
        let inner = graph.double(inner);
        let inner = graph.add(inner, b[1]);
        let central = graph.mul(a[0], rate);
        let inner = graph.add(inner, central);
        let mixed = graph.mul(rate, inner);
        let mixed = graph.double(mixed);
        let second = graph.add(second, mixed);
        for (order, rest) in [(1, first), (2, second)] {
            let rest = self.graph.neg(rest);
            let value = self.graph.div(rest, below);
            self.equation(order, self.coordinate(k, order), value);
        }
    }

    /// Lines for the centre (u, v), d = n·(u, v) + m, w = σ √((u² + v² − k/e) |n|² − d²) and
    /// (x, y) = (u, v) − (d n + w perp⁻¹(n))/|n|².
    fn circle(&mut self, at: [u32; 2], coefficients: [usize; 7], number: usize) {
        let letters = ["e", "l", "l", "k", "n", "n", "m"];
        let mut values = [self.graph.zero(); 7];
        for ((value, letter), root) in values.iter_mut().zip(letters).zip(coefficients) {
            let id = self.roots[root];
            *value = match self.graph.literal(id) {
                Some(_) => id,
                None => {
                    let name = self.naming.fresh(letter, number);
                    self.define(0, name, id)
                }
            };
        }
        let [e, lx, ly, k, nx, ny, m] = values;
        let minus_two = self.graph.number(-2.0);
        let below = self.graph.mul(minus_two, e);
        let mut centre = [lx, ly];
        for (index, letter) in ["u", "v"].into_iter().enumerate() {
            let (name, value) = (self.naming.fresh(letter, number), self.graph.div(centre[index], below));
            centre[index] = self.define(0, name, value);
        }
        let graph = &mut self.graph;
        let off = graph.plain_dot([nx, ny], centre);
        let off = graph.add(off, m);
        let name = self.naming.fresh("d", number);
        let off = self.define(0, name, off);
        let graph = &mut self.graph;
        let (radius, part) = (graph.plain_dot(centre, centre), graph.div(k, e));
        let radius = graph.sub(radius, part);
        let square = graph.plain_dot([nx, ny], [nx, ny]);
        let (full, lost) = (graph.mul(radius, square), graph.square(off));
        let inside = graph.sub(full, lost);
        let w = self.root(inside, number);
        let graph = &mut self.graph;
        let (along, across) = (graph.plain_dot([off, w], [nx, ny]), graph.plain_cross([w, off], [ny, nx]));
        let [dx, dy] = [along, across].map(|part| graph.div(part, square));
        let [x, y] = [graph.sub(centre[0], dx), graph.add(centre[1], dy)];
        self.equation(0, self.coordinate(at[0], 0), x);
        self.equation(0, self.coordinate(at[1], 0), y);
    }

    /// Lines for θ = Σ nᵢ φᵢ = atan2(S, C), θ̇ (C² + S²) = C Ṡ − S Ċ.
    fn turn(&mut self, k: u32, turn: &[(u32, i32)], [cos, sin]: [usize; 2], number: usize) {
        let [c, s] = [("C", cos), ("S", sin)].map(|(letter, root)| self.named(letter, root, number));
        let graph = &mut self.graph;
        let below = graph.plain_dot([c[0], s[0]], [c[0], s[0]]);
        let theta = graph.atan2(s[0], c[0]);
        let first = graph.plain_cross([c[0], s[0]], [c[1], s[1]]);
        let second = graph.plain_cross([c[0], s[0]], [c[2], s[2]]);
        let inward = graph.plain_dot([c[0], s[0]], [c[1], s[1]]);
        let inward = graph.double(inward);
        let mut theta_dot = graph.zero();
        for &(other, n) in turn {
            let (n, rate) = (graph.number(f64::from(n)), graph.symbol(Symbol::Rate(other)));
            let term = graph.mul(n, rate);
            theta_dot = graph.add(theta_dot, term);
        }
        let lost = graph.mul(theta_dot, inward);
        let second = graph.sub(second, lost);
        let (first, second) = (graph.div(first, below), graph.div(second, below));
        for (order, value) in [theta, first, second].into_iter().enumerate() {
            let (mut rest, mut multiple) = (value, 1);
            for &(other, n) in turn {
                if other == k {
                    multiple = n;
                    continue;
                }
                let (n, symbol) = (self.graph.number(f64::from(n)), self.symbol(other, order));
                let term = self.graph.mul(n, symbol);
                rest = self.graph.sub(rest, term);
            }
            let multiple = self.graph.number(f64::from(multiple));
            let value = self.graph.div(rest, multiple);
            self.equation(order, self.coordinate(k, order), value);
        }
    }

    fn three(&mut self, coefficients: [usize; 3], number: usize) -> [[ExprId; 3]; 3] {
        let [a, b, c] = coefficients;
        [("a", a), ("b", b), ("c", c)].map(|(letter, root)| self.named(letter, root, number))
    }
}
