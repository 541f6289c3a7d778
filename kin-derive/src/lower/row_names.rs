//! Messages for names of joints and other statements where a formula, a point or a body stands.

use crate::ast::{BodyExpr, Item, OperandExpr, PointExpr, Statement, text};
use std::collections::BTreeMap;

/// The names of statements and conditions, which have a namespace of their own.
#[derive(Debug, Default)]
pub(super) struct RowNames {
    /// For every name, the end of the message for its use as another thing.
    all: BTreeMap<String, (String, String)>,
}

impl RowNames {
    pub(super) fn of(items: &[Item]) -> Self {
        let mut all = BTreeMap::new();
        for item in items {
            let (keyword, name, right) = match item {
                Item::Statement(row) => (&row.keyword, &row.name, in_formulas(row)),
                Item::Condition(decl) => (&decl.keyword, &decl.name, COORDINATES.to_owned()),
                _ => continue,
            };
            if keyword != &name.ident {
                all.entry(text(&name.ident)).or_insert((text(keyword), right));
            }
        }
        Self { all }
    }

    /// The message for the use of a row's name where a `noun` is expected; `is_formula` where this is a part of a
    /// formula.
    pub(super) fn used_as(&self, name: &str, noun: &str, is_formula: bool) -> Option<String> {
        let (keyword, in_formulas) = self.all.get(name)?;
        let right = if is_formula {
            in_formulas
        } else {
            "a point is written `body @ (x, y)`, or gets a name with `#[point(p = body @ (x, y))]`"
        };
        Some(format!("no {noun} named `{name}`; `{name}` is the name of a `{keyword}`, and {right}"))
    }
}

const COORDINATES: &str = "a formula contains coordinates such as `crank.phi` and the names of parameters and defines";

/// What a formula contains instead of the name of a joint: the angle between its bodies.
fn in_formulas(row: &Statement) -> String {
    let bodies: Vec<String> = row.operands.iter().filter_map(body).collect();
    let angle = match bodies.as_slice() {
        [a, b] if a == "ground" => format!("{b}.phi"),
        [a, b] if b == "ground" => format!("{a}.phi"),
        [a, b] => format!("{b}.phi - {a}.phi"),
        _ => return COORDINATES.to_owned(),
    };
    format!("its angle is written `{angle}` in a formula")
}

/// The single body to which an operand belongs.
fn body(operand: &OperandExpr) -> Option<String> {
    let used = match operand {
        OperandExpr::Point(PointExpr::At { body, .. }) | OperandExpr::Body(BodyExpr::Named(body)) => body,
        _ => return None,
    };
    used.index.is_none().then(|| used.text())
}
