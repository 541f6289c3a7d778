//! The attributes that belong to kin.

use super::forms::{self, KeywordForm};
use crate::suggest::{near, quoted};

/// The meaning of an attribute of kin.
#[derive(Clone, Copy, Debug)]
pub(super) enum Keyword {
    Bodies,
    Body,
    Coordinates,
    Input,
    Point,
    Define,
    Guess,
    /// Fields that hold supplied functions.
    Function,
    /// A joint, driver, equation, mass or load.
    Statement(&'static KeywordForm),
    /// A unilateral condition.
    Condition,
    /// An attribute of a field.
    Param,
    /// A second `#[mechanism]`.
    Mechanism,
}

impl Keyword {
    /// True if names may be missing when such an attribute cannot be read.
    pub(super) const fn declares(self) -> bool {
        matches!(
            self,
            Self::Bodies | Self::Body | Self::Coordinates | Self::Input | Self::Point | Self::Define | Self::Function
        )
    }
}

/// The keywords other than those of statements.
const WORDS: [(&str, Keyword); 11] = [
    ("bodies", Keyword::Bodies),
    ("body", Keyword::Body),
    ("coordinates", Keyword::Coordinates),
    ("point", Keyword::Point),
    ("define", Keyword::Define),
    ("guess", Keyword::Guess),
    ("param", Keyword::Param),
    ("mechanism", Keyword::Mechanism),
    ("input", Keyword::Input),
    ("function", Keyword::Function),
    ("unilateral", Keyword::Condition),
];

fn words() -> impl Iterator<Item = (&'static str, Keyword)> {
    WORDS.into_iter().chain(forms::FORMS.iter().map(|form| (form.keyword, Keyword::Statement(form))))
}

/// All keywords of the language, with an example for those of statements.
#[cfg(test)]
pub(crate) fn vocabulary() -> Vec<(&'static str, Option<&'static str>)> {
    let example = |keyword| if let Keyword::Statement(form) = keyword { Some(form.example()) } else { None };
    words().map(|(word, keyword)| (word, example(keyword))).collect()
}

/// The keyword with this name.
pub(super) fn find(name: &str) -> Option<Keyword> {
    words().find(|(word, _)| *word == name).map(|(_, keyword)| keyword)
}

/// Attributes of the compiler or of common crates, which are never taken for misspelt keywords.
const FOREIGN: [&str; 18] = [
    "allow",
    "automatically_derived",
    "cfg",
    "cfg_attr",
    "cold",
    "default",
    "deny",
    "deprecated",
    "derive",
    "doc",
    "expect",
    "forbid",
    "inline",
    "must_use",
    "non_exhaustive",
    "repr",
    "serde",
    "warn",
];

/// Words that other tools use, with the corresponding keyword.
const SYNONYMS: &[(&str, &str)] = &[
    ("actuator", "driver"),
    ("assembly", "guess"),
    ("cable", "rope"),
    ("couple", "torque"),
    ("damper", "spring"),
    ("dashpot", "spring"),
    ("equation", "constraint"),
    ("hinge", "revolute"),
    ("inequality", "unilateral"),
    ("inertia", "mass"),
    ("initial_guess", "guess"),
    ("limit", "unilateral"),
    ("links", "bodies"),
    ("load", "force"),
    ("moment", "torque"),
    ("motor", "driver"),
    ("parameter", "param"),
    ("pin_joint", "revolute"),
    ("prismatic", "translational"),
    ("revolute_joint", "revolute"),
    ("rigid", "fixed"),
    ("signal", "input"),
    ("slider", "translational"),
    ("weld", "fixed"),
];

/// The message for an unknown attribute that resembles a keyword, and whether names may be missing because of it.
pub(super) fn near_miss(name: &str) -> Option<(String, bool)> {
    if FOREIGN.contains(&name) {
        return None;
    }
    let synonym = SYNONYMS.iter().find(|(word, _)| *word == name).map(|(_, keyword)| *keyword);
    // `x` and `y` are too short to be recognised as misspelt.
    let candidates = match synonym {
        Some(keyword) => vec![keyword],
        None => near(name, words().map(|(word, _)| word).filter(|word| word.len() > 2)),
    };
    let declares = candidates.iter().any(|word| find(word).is_some_and(Keyword::declares));
    let right = match synonym {
        // A damper has no keyword of its own.
        Some("spring") => "it is a `spring` with `damping = c`, and without `stiffness`".to_owned(),
        Some(keyword) => format!("it is called `{keyword}`"),
        None if candidates.is_empty() => return None,
        None => format!("did you mean {}?", quoted(candidates, "or")),
    };
    Some((format!("no attribute `{name}` in kin; {right}"), declares))
}

/// True for `keyword`, its misspellings and its synonyms.
pub(super) fn is_nearly(name: &str, keyword: &str) -> bool {
    name == keyword
        || SYNONYMS.iter().any(|(word, meant)| (*word, *meant) == (name, keyword))
        || find(name).is_none() && !FOREIGN.contains(&name) && !near(name, [keyword]).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_our_words_are_seen() {
        for (slip, meant) in [("revolut", "`revolute`"), ("drivers", "`driver`"), ("bodys", "`bodies` or `body`")] {
            let (message, _) = near_miss(slip).unwrap();
            assert!(message.contains(meant), "{message}");
        }
        assert!(near_miss("bodys").unwrap().1);
        assert!(!near_miss("revolut").unwrap().1);
        assert_eq!(near_miss("links").map(|(_, declares)| declares), Some(true));
        assert_eq!(near_miss("hinge").map(|(_, declares)| declares), Some(false));
    }

    #[test]
    fn attributes_of_others_are_left_alone() {
        for name in ["derive", "serde", "doc", "test", "repr", "diesel", "garde", "builder", "pin", "error", "from"] {
            assert!(near_miss(name).is_none(), "{name}");
            assert!(find(name).is_none(), "{name}");
        }
    }
}
