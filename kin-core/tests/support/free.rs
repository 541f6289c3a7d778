//! Mechanisms of scalar coordinates and free equations.

use super::*;
use kin_core::joints::Constraint;
use kin_core::mechanism::{Formula, Function, Mechanism, Operands, Scalar};

/// `left` = 0 for every row; coordinates are `q0`, `q1`, …, parameters `p0`, `p1`, ….
pub fn equations(coordinates: usize, parameters: usize, rows: Vec<Formula>) -> Mechanism {
    let names: Vec<String> = (0..parameters).map(|k| format!("p{k}")).collect();
    let names: Vec<(&str, Option<usize>)> = names.iter().map(|name| (name.as_str(), None)).collect();
    let row = |(k, left)| joint(&format!("N{k}"), Constraint { left, right: Formula::ZERO }.into());
    Mechanism {
        name: "Free".into(),
        parameters: super::parameters(&names),
        scalars: (0..coordinates)
            .map(|k| Scalar { name: format!("q{k}"), len: None, origin: AT, unit: None })
            .collect(),
        joints: rows.into_iter().enumerate().map(row).collect(),
        ..Mechanism::default()
    }
}

/// A scalar coordinate.
pub fn scalar(k: usize) -> Formula {
    Formula::Scalar(member(k, index(0, 0)))
}

pub fn sin(a: Formula) -> Formula {
    Formula::Call(Function::Sin, Box::new(a))
}

pub fn cos(a: Formula) -> Formula {
    Formula::Call(Function::Cos, Box::new(a))
}

pub fn square(a: Formula) -> Formula {
    Formula::Pow(Box::new(a), 2.0)
}

/// a + b + ….
pub fn sum<const N: usize>(terms: [Formula; N]) -> Formula {
    terms.into_iter().reduce(add).unwrap_or(Formula::ZERO)
}
