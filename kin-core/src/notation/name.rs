//! Names of the user as symbols: `crank.phi_dot` is a letter with a dot and an index.

/// A name, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// As the language has it: `crank.phi_dot`.
    pub written: String,
    /// The letter or word.
    pub base: Base,
    /// 0, 1 or 2 dots.
    pub order: usize,
    /// What stands below: of `crank.phi` the body, of `l1` the digits, of `link[3].x` both body and number.
    pub index: Vec<String>,
}

/// What a symbol is before it has indices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Base {
    /// One Latin letter.
    Letter(char),
    /// A Greek letter by its name: `omega`.
    Greek(&'static str, char),
    /// A word of several letters.
    Word(String),
}

/// Names of letters with the letters.
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
    /// Takes a name apart.
    pub fn new(written: &str) -> Self {
        let (stem, order) = match written.strip_suffix("_ddot") {
            Some(stem) => (stem, 2),
            None => written.strip_suffix("_dot").map_or((written, 0), |stem| (stem, 1)),
        };
        let (owner, own) = match stem.rsplit_once('.') {
            Some((owner, own)) => (Some(owner), own),
            None => (None, stem),
        };
        let (own, place) = element(own);
        let (base, digits) = symbol(own);
        let owner = owner.into_iter().flat_map(|owner| {
            let (owner, place) = element(owner);
            [Some(owner.to_owned()), place.map(str::to_owned)].into_iter().flatten()
        });
        let index = digits.into_iter().chain(place.map(str::to_owned)).chain(owner).collect();
        Self { written: written.to_owned(), base, order, index }
    }
}

/// `link[3]` as `link` and `3`.
fn element(name: &str) -> (&str, Option<&str>) {
    match name.strip_suffix(']').and_then(|name| name.split_once('[')) {
        Some((name, place)) => (name, Some(place)),
        None => (name, None),
    }
}

/// `phi0` as φ with index 0, `l1` as l with 1, `d_max` as d with max, `stroke` as a word.
fn symbol(name: &str) -> (Base, Option<String>) {
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = match name.split_once('_') {
        Some((stem, rest)) if is_symbol(stem) && !rest.is_empty() => (stem, Some(rest)),
        _ if is_symbol(digits) => (digits, Some(&name[digits.len()..])),
        _ => (name, None),
    };
    let mut letters = stem.chars();
    let base = match (letters.next(), letters.next(), GREEK.iter().find(|(greek, _)| *greek == stem)) {
        (_, _, Some(&(greek, letter))) => Base::Greek(greek, letter),
        (Some(letter), None, _) => Base::Letter(letter),
        _ => Base::Word(stem.to_owned()),
    };
    (base, index.filter(|index| !index.is_empty()).map(str::to_owned))
}

fn is_symbol(stem: &str) -> bool {
    stem.chars().count() == 1 || GREEK.iter().any(|(greek, _)| *greek == stem)
}
