//! Different names have different symbols on a sheet: names that would become one symbol are shown as they are written.
//!
//! Examples are l1 and l[1], φ_crank for `phi_crank` and `crank.phi`, and a coordinate that is called `u_dot`, like the
//! rate of u.

use super::content::Sheet;
use super::shown::{Row, ShownFormula};
use super::steps::StepLine;
use crate::notation::{BaseSymbol, Name};
use std::collections::{BTreeMap, BTreeSet};

impl Sheet {
    /// The sheet with names in backquotes, see [`Name::new`], where they are ambiguous as symbols.
    #[must_use]
    pub fn with_distinct_symbols(mut self) -> Self {
        let mut names = BTreeSet::new();
        self.for_each_name(&mut |name| {
            names.insert(name.to_owned());
            None
        });
        let ambiguous = ambiguous(&names, &self.coordinates);
        if !ambiguous.is_empty() {
            self.for_each_name(&mut |name| {
                let is_ambiguous = ambiguous.contains(name) || ambiguous.contains(Name::stem(name).0);
                is_ambiguous.then(|| format!("`{name}`"))
            });
        }
        self
    }

    /// Calls `rename` with every name, and replaces the name by the result, if there is one.
    fn for_each_name(&mut self, rename: &mut dyn FnMut(&str) -> Option<String>) {
        self.coordinates.iter_mut().for_each(|name| text(name, rename));
        for row in self.joints.iter_mut().flat_map(|joint| &mut joint.rows) {
            let Row { phi, phi_q, phi_t, gamma, .. } = row;
            [phi, phi_t, gamma].into_iter().for_each(|shown| formula(shown, rename));
            for (name, entry) in phi_q {
                text(name, rename);
                formula(entry, rename);
            }
        }
        for line in self.steps.iter_mut().flat_map(|step| step.lines.iter_mut().flatten()) {
            match line {
                StepLine::Equation { left, right, .. } => {
                    text(left, rename);
                    formula(right, rename);
                }
                StepLine::System { matrix, unknowns, right } => {
                    matrix.iter_mut().flatten().chain(right).for_each(|shown| formula(shown, rename));
                    unknowns.iter_mut().for_each(|name| text(name, rename));
                }
            }
        }
        if let Some(dynamics) = &mut self.dynamics {
            for (names, entry) in &mut dynamics.mass {
                names.iter_mut().for_each(|name| text(name, rename));
                formula(entry, rename);
            }
            for (name, entry) in &mut dynamics.forces {
                text(name, rename);
                formula(entry, rename);
            }
        }
    }
}

fn text(name: &mut String, rename: &mut dyn FnMut(&str) -> Option<String>) {
    if let Some(new) = rename(name) {
        *name = new;
    }
}

fn formula(shown: &mut ShownFormula, rename: &mut dyn FnMut(&str) -> Option<String>) {
    let ShownFormula::Formula(tree) = shown else { return };
    tree.for_each_name(&mut |name| {
        if let Some(new) = rename(&name.written) {
            *name = Name::new(&new);
        }
    });
}

/// The names, without their derivatives, that share a symbol with another one.
fn ambiguous(names: &BTreeSet<String>, coordinates: &[String]) -> BTreeSet<String> {
    // A name such as `u_dot` that is not the rate of u.
    let is_no_rate = |name: &str| {
        let (stem, order) = Name::stem(name);
        let rate = format!("{}({stem})", ["", "dot", "ddot"][order]);
        order > 0 && (names.contains(&rate) || coordinates.iter().any(|coordinate| coordinate == name))
    };
    let mut ambiguous: BTreeSet<String> =
        names.iter().filter(|name| !name.ends_with(')') && is_no_rate(name)).cloned().collect();
    let mut by_symbol: BTreeMap<(BaseSymbol, Vec<String>), BTreeSet<&str>> = BTreeMap::new();
    for name in names.iter().filter(|name| !ambiguous.contains(*name)) {
        let Name { base, index, .. } = Name::new(name);
        let (stem, _) = Name::stem(name);
        if !ambiguous.contains(stem) {
            by_symbol.entry((base, index)).or_default().insert(stem);
        }
    }
    let shared = by_symbol.into_values().filter(|stems| stems.len() > 1).flatten();
    ambiguous.extend(shared.map(str::to_owned));
    ambiguous
}
