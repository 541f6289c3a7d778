//! Forms of joints, drivers, equations, masses and loads, derived from the kinds and forms of kin-core.

use kin_core::mechanism::{OperandSlot, OperandType, StatementForm, Written};
use kin_core::{joints, loads};
use std::sync::LazyLock;

/// The form of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OptionForm {
    /// `key = value`.
    Value(OperandType),
    /// `key(theta) = expression`, with the fixed words in the parentheses.
    Curve(&'static [&'static str]),
    /// `key(u) = (ex, ey)`.
    Path,
}

/// The form of the statements with one keyword.
pub(super) struct KeywordForm {
    /// The name of the attribute.
    pub(super) keyword: &'static str,
    /// The kinds that share the keyword: they have the same operands and different options.
    pub(super) kinds: Vec<&'static StatementForm>,
    /// The operands after the name, in order.
    pub(super) operands: Vec<OperandType>,
    /// The options `key = value` after the operands.
    pub(super) options: Vec<(&'static str, OptionForm)>,
}

/// The forms of all statements of the language, in the order of the guide.
pub(super) static FORMS: LazyLock<Vec<KeywordForm>> = LazyLock::new(|| {
    let mut rows: Vec<KeywordForm> = Vec::new();
    for form in joints::forms().chain(loads::forms()) {
        let options = form.written(Written::Option).flat_map(options_of);
        match rows.last_mut().filter(|row| row.keyword == form.kind.keyword()) {
            Some(row) => {
                row.kinds.push(form);
                let new: Vec<_> =
                    options.filter(|(key, _)| row.options.iter().all(|(known, _)| known != key)).collect();
                row.options.extend(new);
            }
            None => rows.push(KeywordForm {
                keyword: form.kind.keyword(),
                kinds: vec![form],
                operands: form.written(Written::Operand).map(|slot| slot.takes).collect(),
                options: options.collect(),
            }),
        }
    }
    rows
});

/// The options from which a slot is read.
fn options_of(slot: &OperandSlot) -> Vec<(&'static str, OptionForm)> {
    match slot.takes {
        OperandType::Support => vec![(slot.key, OptionForm::Curve(&["theta"]))],
        OperandType::Curve => vec![
            ("polar", OptionForm::Curve(&["theta"])),
            ("implicit", OptionForm::Curve(&["X", "Y"])),
            ("parametric", OptionForm::Path),
            ("roller", OptionForm::Value(OperandType::Radius)),
        ],
        takes => vec![(slot.key, OptionForm::Value(takes))],
    }
}

impl KeywordForm {
    /// An example of a statement.
    pub(super) fn example(&self) -> &'static str {
        self.kinds.first().map_or("", |form| form.example)
    }

    /// The text of a message that shows the correct form: the example or, for a kind other than the first, the
    /// explanation of how to choose the kind.
    pub(super) fn right(&self, kind: &'static StatementForm) -> String {
        if self.kinds.first() == Some(&kind) { format!("`{}`", self.example()) } else { kind.choice.to_owned() }
    }

    /// True if the statement must begin with a name; otherwise the name is optional.
    pub(super) fn is_named(&self) -> bool {
        self.kinds.iter().any(|form| form.named)
    }

    /// True if `= expression` follows the last operand.
    pub(super) fn is_equation(&self) -> bool {
        self.kinds.iter().any(|form| form.is_equation())
    }
}

impl core::fmt::Debug for KeywordForm {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.keyword)
    }
}
