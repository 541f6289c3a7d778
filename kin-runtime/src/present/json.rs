//! Results as JSON: keys in the order of the fields, numbers with all digits, and null for numbers that are not finite.

use serde::Serialize;

/// A record as JSON, a line per value, with a final line break.
pub(crate) fn to_json<T: Serialize>(record: &T) -> Result<String, String> {
    let text = serde_json::to_string_pretty(record).map_err(|error| format!("cannot write JSON: {error}"))?;
    Ok(text + "\n")
}
