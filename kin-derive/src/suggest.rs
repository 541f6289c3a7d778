//! Suggestions for misspelt names.

pub(crate) use kin_core::error::quoted;

/// The candidate closest to `name`, if it is close enough to be a misspelling.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (distance(name, candidate), candidate))
        .filter(|(d, candidate)| is_near(*d, name, candidate) || *d > 0 && name.eq_ignore_ascii_case(candidate))
        .min_by_key(|(d, _)| *d)
        .map(|(_, candidate)| candidate)
}

/// All candidates of which `name` may be a misspelling, in their order.
pub(crate) fn near<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    candidates.into_iter().filter(|candidate| is_near(distance(name, candidate), name, candidate)).collect()
}

/// The number of edits between two words, where a swap of neighbours counts as one.
fn distance(a: &str, b: &str) -> usize {
    strsim::osa_distance(a, b)
}

/// True for at most two edits, at most one for every three letters, and at least one common letter: short names are not
/// misspellings of one another.
fn is_near(distance: usize, a: &str, b: &str) -> bool {
    let (a, b) = (a.chars().count(), b.chars().count());
    distance > 0 && distance <= 2 && distance < a.max(b) && 3 * distance <= a.max(b).max(3)
}

/// `; did you mean …?`, or an empty string.
pub(crate) fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map(|best| format!("; did you mean `{best}`?")).unwrap_or_default()
}

/// The end of the message for an unknown component that is a rate; empty for other components.
pub(crate) fn rate_of_a_component(name: &str) -> &'static str {
    match name {
        "x_dot" | "y_dot" | "phi_dot" | "xdot" | "ydot" | "phidot" | "dot" | "omega" | "v" | "vx" | "vy" | "speed"
        | "velocity" | "rate" => {
            ": a rate is written `dot(…)`, in `nonholonomic`, `force` and `torque`; the command line reports rates as `x_dot`"
        }
        "a" | "ax" | "ay" | "acceleration" | "x_ddot" | "y_ddot" | "phi_ddot" | "ddot" | "alpha" => {
            ": formulas contain no accelerations; the command line reports them as `x_ddot`"
        }
        _ => "",
    }
}

/// True for names of rates in other languages.
pub(crate) fn is_rate(word: &str) -> bool {
    matches!(word, "d" | "der" | "ddt" | "diff" | "deriv" | "derivative" | "rate" | "vel" | "velocity")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_found_and_strangers_are_not() {
        assert_eq!(nearest("crnk", ["rocker", "crank"]), Some("crank"));
        assert_eq!(nearest("rokcer", ["rocker", "crank"]), Some("rocker"));
        assert_eq!(nearest("l5", ["l1", "l2"]), Some("l1"));
        assert_eq!(nearest("m", ["a", "b"]), None);
        assert_eq!(nearest("serde", ["speed", "gear"]), None);
        assert_eq!(nearest("test", ["belt"]), None);
        assert_eq!(near("bodys", ["bodies", "body", "belt"]), ["bodies", "body"]);
    }

    #[test]
    fn lists_read_like_sentences() {
        assert_eq!(quoted(["a"], "and"), "`a`");
        assert_eq!(quoted(["a", "b", "c"], "or"), "`a`, `b` or `c`");
        assert!(quoted(["a"; 20], "and").ends_with("(20 in all)"));
    }
}
