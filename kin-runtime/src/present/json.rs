//! Results as JSON: keys in the order in which they are written, numbers with all digits, and null for numbers that are
//! not finite.

use serde::Serialize;
use serde_json::Value;

/// Names with their values.
pub(crate) type Record = serde_json::Map<String, Value>;

/// A value for a record. Only maps with keys that are no strings cannot be written as JSON, and results have none.
pub(crate) fn value(serializable: &impl Serialize) -> Value {
    serde_json::to_value(serializable).unwrap_or_default()
}

/// The record of a type with named fields.
pub(crate) fn fields(serializable: &impl Serialize) -> Record {
    if let Value::Object(record) = value(serializable) { record } else { Record::new() }
}

/// A record, written like the fields of a struct.
macro_rules! record {
    ($($name:ident: $value:expr),* $(,)?) => {
        $crate::present::json::Record::from_iter([$(
            (stringify!($name).to_owned(), $crate::present::json::value(&$value))
        ),*])
    };
}
pub(crate) use record;
