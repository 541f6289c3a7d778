//! How joints, drivers, equations, masses and loads are written: the kinds and their forms are kin-core's.

use kin_core::mechanism::{Slot, StatementForm, Takes, Written};
use kin_core::{joints, loads};
use std::sync::LazyLock;

/// What an operand is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OperandForm {
    Point,
    /// Two points or more.
    Points,
    Body,
    /// One body, or two, in front of `=`.
    Bodies,
    /// `(fx, fy)`.
    Vector,
    Expression,
}

/// What the value of an option is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OptionForm {
    Axis,
    Expression,
    /// `key(theta) = expression`, with the words that stand in the brackets.
    Curve(&'static [&'static str]),
    /// `key(u) = (ex, ey)`.
    Path,
    Radii,
    Body,
    /// The name of a scalar coordinate.
    Scalar,
}

/// How the rows of a keyword are written.
pub(super) struct RowForm {
    /// The attribute.
    pub(super) keyword: &'static str,
    /// The kinds that share it: they have the same operands, and options of their own.
    pub(super) kinds: Vec<&'static StatementForm>,
    /// What stands behind the name, in order.
    pub(super) operands: Vec<OperandForm>,
    /// What can follow as `key = value`.
    pub(super) options: Vec<(&'static str, OptionForm)>,
}

/// Every row of the language, in the order of the guide.
pub(super) static FORMS: LazyLock<Vec<RowForm>> = LazyLock::new(|| {
    let mut rows: Vec<RowForm> = Vec::new();
    for form in joints::forms().chain(loads::forms()) {
        let options = form.written(Written::Option).flat_map(options_of);
        match rows.last_mut().filter(|row| row.keyword == form.kind.keyword()) {
            Some(row) => {
                row.kinds.push(form);
                let new: Vec<_> =
                    options.filter(|(key, _)| row.options.iter().all(|(known, _)| known != key)).collect();
                row.options.extend(new);
            }
            None => rows.push(RowForm {
                keyword: form.kind.keyword(),
                kinds: vec![form],
                operands: form.written(Written::Operand).map(operand_of).collect(),
                options: options.collect(),
            }),
        }
    }
    rows
});

fn operand_of(slot: &Slot) -> OperandForm {
    match slot.takes {
        Takes::Point => OperandForm::Point,
        Takes::Points => OperandForm::Points,
        Takes::Body | Takes::Carrier => OperandForm::Body,
        Takes::Bodies => OperandForm::Bodies,
        Takes::Vector => OperandForm::Vector,
        _ => OperandForm::Expression,
    }
}

/// The options that a slot is written with.
fn options_of(slot: &Slot) -> Vec<(&'static str, OptionForm)> {
    let form = match slot.takes {
        Takes::Axis => OptionForm::Axis,
        Takes::Radii => OptionForm::Radii,
        Takes::Body | Takes::Carrier => OptionForm::Body,
        Takes::Scalar(_) => OptionForm::Scalar,
        Takes::Support => OptionForm::Curve(&["theta"]),
        Takes::Curve => {
            return vec![
                ("polar", OptionForm::Curve(&["theta"])),
                ("implicit", OptionForm::Curve(&["X", "Y"])),
                ("parametric", OptionForm::Path),
                ("roller", OptionForm::Expression),
            ];
        }
        _ => OptionForm::Expression,
    };
    vec![(slot.key, form)]
}

impl RowForm {
    /// A row as the user writes it.
    pub(super) fn example(&self) -> &'static str {
        self.kinds.first().map_or("", |form| form.example)
    }

    /// What would be right, for a message: the example, or for a kind that it is none of, how the kinds are told apart.
    pub(super) fn right(&self, kind: &'static StatementForm) -> String {
        if self.kinds.first() == Some(&kind) { format!("`{}`", self.example()) } else { kind.choice.to_owned() }
    }

    /// True when it begins with a name; otherwise it may.
    pub(super) fn is_named(&self) -> bool {
        self.kinds.iter().any(|form| form.named)
    }

    /// True when `= expression` follows the last operand.
    pub(super) fn is_equation(&self) -> bool {
        self.kinds.iter().any(|form| form.is_equation())
    }
}

impl core::fmt::Debug for RowForm {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.keyword)
    }
}
