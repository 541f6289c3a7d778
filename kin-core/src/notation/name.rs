//! The user's names as mathematical symbols: `crank.phi_dot` is a letter with a dot and an index.

/// A name, split into its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name in the user's language: `crank.phi_dot`.
    pub written: String,
    /// The letter or word.
    pub base: BaseSymbol,
    /// The number of dots: 0, 1 or 2.
    pub order: usize,
    /// The indices: for `crank.phi` the body, for `l1` the digits, for `link[3].x` the body and its number.
    pub index: Vec<String>,
}

/// A symbol without dots and indices.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BaseSymbol {
    /// A single Latin letter.
    Letter(char),
    /// A Greek letter and its name, such as `omega`.
    Greek(&'static str, char),
    /// A word of several letters.
    Word(String),
}

/// The Greek letters and their names.
const GREEK: [(&str, char); 30] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("pi", 'π'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Sigma", 'Σ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];

impl Name {
    /// Splits a name into its parts; a name in backquotes is shown as it is written.
    pub fn new(written: &str) -> Self {
        if let Some(verbatim) = written.strip_prefix('`').and_then(|name| name.strip_suffix('`')) {
            let base = BaseSymbol::Word(verbatim.to_owned());
            return Self { written: verbatim.to_owned(), base, order: 0, index: Vec::new() };
        }
        let (stem, order) = Self::stem(written);
        let (owner, name) = match stem.rsplit_once('.') {
            Some((owner, name)) => (Some(owner), name),
            None => (None, stem),
        };
        let (name, place) = element(name);
        let (base, digits) = symbol(name);
        let owner = owner.into_iter().flat_map(|owner| {
            let (owner, place) = element(owner);
            [Some(owner.to_owned()), place.map(str::to_owned)].into_iter().flatten()
        });
        let index = digits.into_iter().chain(place.map(str::to_owned)).chain(owner).collect();
        Self { written: written.to_owned(), base, order, index }
    }
}

impl Name {
    /// The name without its derivatives, and their number: `u` and 1 for `u_dot` and for `dot(u)`.
    pub(crate) fn stem(written: &str) -> (&str, usize) {
        let inside = |function: &str| written.strip_prefix(function)?.strip_prefix('(')?.strip_suffix(')');
        let of_order = |order: usize, suffix: &str, function: &str| {
            Some((written.strip_suffix(suffix).or_else(|| inside(function))?, order))
        };
        of_order(2, "_ddot", "ddot").or_else(|| of_order(1, "_dot", "dot")).unwrap_or((written, 0))
    }
}

/// Splits `link[3]` into `link` and `3`.
fn element(name: &str) -> (&str, Option<&str>) {
    match name.strip_suffix(']').and_then(|name| name.split_once('[')) {
        Some((name, index)) => (name, Some(index)),
        None => (name, None),
    }
}

/// Splits `phi0` into φ and 0, `l1` into l and 1, `d_max` into d and max; `stroke` is a word without an index.
fn symbol(name: &str) -> (BaseSymbol, Option<String>) {
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = match name.split_once('_') {
        Some((stem, rest)) if is_symbol(stem) && !rest.is_empty() => (stem, Some(rest)),
        _ if is_symbol(digits) => (digits, Some(&name[digits.len()..])),
        _ => (name, None),
    };
    let mut letters = stem.chars();
    let named = GREEK.iter().find(|(greek, letter)| *greek == stem || stem.chars().eq([*letter]));
    let base = match (letters.next(), letters.next(), named) {
        (_, _, Some(&(greek, letter))) => BaseSymbol::Greek(greek, letter),
        (Some(letter), None, _) => BaseSymbol::Letter(letter),
        _ => BaseSymbol::Word(stem.to_owned()),
    };
    (base, index.filter(|index| !index.is_empty()).map(str::to_owned))
}

fn is_symbol(stem: &str) -> bool {
    stem.chars().count() == 1 || GREEK.iter().any(|(greek, _)| *greek == stem)
}

/// The name of a Greek letter.
pub(crate) fn greek(letter: char) -> Option<&'static str> {
    GREEK.iter().find(|(_, greek)| *greek == letter).map(|(name, _)| *name)
}
