//! Mechanisms with known mobility: tests of the counts, and of the joints named for a planted fault, under any names
//! and in any order of declarations.

mod assembled;
mod chains;
mod existing;
mod faults;
mod gears;
mod linkages;
mod plans;
mod relations;
pub(crate) mod repository;
mod sliders;
mod timing;

use crate::analyse::analyse;
use crate::lower::Lowered;
use kin_core::{KinematicSystem, Structure};
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use std::collections::BTreeSet;
use std::str::FromStr;

/// A mechanism with its known properties.
struct Case {
    name: &'static str,
    /// The parameters, separated by blanks.
    parameters: &'static str,
    /// The attributes, separated by line breaks or `;`.
    attributes: &'static str,
    /// n, the rows, the generic rank, and the degrees of freedom without driving rows.
    counts: [usize; 4],
    /// The joints that make the mechanism redundant, separated by blanks; without them it is not.
    fault: &'static str,
}

/// A description with its equations and their structural analysis.
struct Diagnosed {
    lowered: Lowered,
    system: KinematicSystem,
    structure: Structure,
}

/// Analyses the structure of a description that is parsed and obeys the rules.
fn diagnosed(item: TokenStream) -> Diagnosed {
    let (_, result) = analyse(TokenStream::new(), item);
    let lowered = result.unwrap_or_else(|broken| panic!("{:?}", broken.error.into_iter().collect::<Vec<_>>()));
    let system = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate).unwrap();
    let structure = kin_core::diagnose(&system);
    Diagnosed { lowered, system, structure }
}

impl Diagnosed {
    fn counts(&self) -> [usize; 4] {
        let Structure { coordinates, rows, rank, .. } = self.structure;
        [coordinates, rows, rank, self.structure.degrees_of_freedom()]
    }

    /// The joint of each redundant row, with the joints of its circuit.
    fn circuits(&self) -> Vec<BTreeSet<String>> {
        let joint = |row: &usize| {
            let joint = &self.system.set.joints[self.system.set.rows[*row].joint];
            self.lowered.mechanism.joints[joint.family.0].name.clone()
        };
        let redundant = self.structure.redundant.iter();
        redundant.map(|r| r.circuit.iter().chain([&r.row]).map(joint).collect()).collect()
    }

    fn messages(&self) -> Vec<String> {
        let errors = kin_core::structure::explain(&self.lowered.mechanism, &self.system, &self.structure);
        errors.into_iter().map(|error| error.message).collect()
    }
}

impl Case {
    fn attributes(&self) -> Vec<&'static str> {
        self.attributes.split([';', '\n']).map(str::trim).filter(|attribute| !attribute.is_empty()).collect()
    }

    fn faults(&self) -> BTreeSet<String> {
        self.fault.split_whitespace().map(str::to_owned).collect()
    }

    fn source(&self, attributes: &[&str]) -> TokenStream {
        let attributes: String = attributes.iter().map(|attribute| format!("#[{attribute}] ")).collect();
        let fields: String = self.parameters.split_whitespace().map(|name| format!("{name}: f64, ")).collect();
        TokenStream::from_str(&format!("{attributes} struct Case {{ {fields} }}")).unwrap()
    }

    fn check(&self) {
        let attributes = self.attributes();
        let found = diagnosed(self.source(&attributes));
        let name = self.name;
        assert_eq!(found.counts(), self.counts, "{name}: {:?}", found.messages());
        self.check_fault(&found);
        assert_eq!(found.messages().is_empty(), self.fault.is_empty(), "{name}: {:?}", found.messages());
        // If a single joint is the fault, the mechanism without it is not redundant.
        let row = |attribute: &str| {
            let row = attribute.split_once('(').map_or("", |(_, rest)| rest);
            row.split([':', '[', ' ']).next().unwrap_or_default().to_owned()
        };
        if self.faults().len() == 1 {
            let kept: Vec<&str> = attributes.iter().copied().filter(|a| row(a) != self.fault).collect();
            let sound = diagnosed(self.source(&kept));
            assert!(sound.structure.redundant.is_empty(), "{name}: {:?}", sound.messages());
        }
        self.check_permuted(&attributes, &found);
    }

    /// Every circuit contains a joint of the fault, and every joint of the fault is in a circuit.
    fn check_fault(&self, found: &Diagnosed) {
        let (circuits, faults) = (found.circuits(), self.faults());
        let (rows, rank) = (found.structure.rows, found.structure.rank);
        assert_eq!(circuits.len(), rows - rank, "{}", self.name);
        for circuit in &circuits {
            assert!(!circuit.is_disjoint(&faults), "{}: {circuit:?}", self.name);
        }
        let blamed: BTreeSet<String> = circuits.into_iter().flatten().collect();
        assert!(faults.is_subset(&blamed), "{}: {blamed:?}", self.name);
    }

    /// The result is the same in other orders and under other names.
    fn check_permuted(&self, attributes: &[&str], found: &Diagnosed) {
        let mut order: Vec<&str> = attributes.to_vec();
        let mut state = 0x9e37_79b9_u32;
        for _ in 0..3 {
            for k in (1..order.len()).rev() {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                order.swap(k, (state >> 8) as usize % (k + 1));
            }
            let permuted = diagnosed(self.source(&order));
            assert_eq!(permuted.counts(), self.counts, "{} as {order:?}", self.name);
            self.check_fault(&permuted);
            if let ([one], [other]) = (&found.circuits()[..], &permuted.circuits()[..]) {
                assert_eq!(one, other, "{} as {order:?}", self.name);
            }
        }
        let mechanism = &found.lowered.mechanism;
        let bodies = mechanism.bodies.iter().map(|body| &body.name);
        let scalars = mechanism.scalars.iter().map(|scalar| &scalar.name);
        let joints = mechanism.joints.iter().map(|joint| &joint.name);
        let names: BTreeSet<String> = bodies.chain(scalars).chain(joints).cloned().collect();
        let renamed = diagnosed(renamed(self.source(attributes), &names));
        assert_eq!(renamed.structure, found.structure, "{}", self.name);
    }
}

/// The tokens with all of `names` renamed, so that their alphabetical order is reversed.
fn renamed(tokens: TokenStream, names: &BTreeSet<String>) -> TokenStream {
    let rename = |tree| match tree {
        TokenTree::Ident(ident) => {
            let name = ident.to_string();
            let index = names.iter().position(|known| *known == name);
            TokenTree::Ident(
                index.map_or(ident, |k| Ident::new(&format!("thing_{}", 900 - k), proc_macro2::Span::call_site())),
            )
        }
        TokenTree::Group(group) => TokenTree::Group(Group::new(group.delimiter(), renamed(group.stream(), names))),
        other => other,
    };
    tokens.into_iter().map(rename).collect()
}

fn all() -> impl Iterator<Item = &'static Case> {
    [linkages::CASES, sliders::CASES, relations::CASES, faults::CASES, chains::CASES, gears::CASES]
        .into_iter()
        .flatten()
}

#[test]
fn counts_circuits_and_orders() {
    let wrong: Vec<&str> =
        all().filter(|case| std::panic::catch_unwind(|| case.check()).is_err()).map(|c| c.name).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    assert!(all().count() >= 50, "{}", all().count());
}

/// `cargo test -p kin-derive --lib corpus::messages -- --ignored --nocapture`
#[test]
#[ignore = "prints what is said, for reading"]
fn messages() {
    for case in all().filter(|case| !case.fault.is_empty()) {
        let found = diagnosed(case.source(&case.attributes()));
        println!("{}\n    {}", case.name, found.messages().join("\n    "));
    }
}
