//! The order of the crates' modules: imports of files form no cycle, and every top-level module imports only those that
//! ARCHITECTURE.md lists above it.

mod source;

use source::Crate;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What every node imports.
type Imports = BTreeMap<String, BTreeSet<String>>;

const CRATES: [&str; 4] = ["kin-core", "kin-derive", "kin-runtime", "kin-study"];

/// The nodes that are part of a circle or lie between two circles, with what they import of one another.
fn circles(imports: &Imports) -> Imports {
    let mut left = imports.clone();
    loop {
        let imported: BTreeSet<String> = left.values().flatten().cloned().collect();
        let before = left.len();
        left.retain(|node, of| imported.contains(node) && !of.is_empty());
        let nodes: BTreeSet<String> = left.keys().cloned().collect();
        left.values_mut().for_each(|of| of.retain(|node| nodes.contains(node)));
        if left.len() == before && left.values().all(|of| !of.is_empty()) {
            return left;
        }
    }
}

fn read(name: &str) -> Crate {
    Crate::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name).join("src"))
}

#[test]
fn no_file_imports_another_one_in_a_circle() {
    for name in CRATES {
        let imports = read(name).imports();
        assert!(imports.values().map(BTreeSet::len).sum::<usize>() > 20, "{name}: {imports:?}");
        assert_eq!(circles(&imports), Imports::new(), "{name}");
    }
}

/// The modules of a crate in the order of its table in ARCHITECTURE.md, each with its row.
fn listed(architecture: &str, name: &str) -> BTreeMap<String, usize> {
    let section = architecture.split_once(&format!("## {name}\n")).expect("a section for the crate").1;
    let section = section.split("\n## ").next().unwrap_or(section);
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `")).enumerate();
    let modules = rows.flat_map(|(row, line)| {
        let first = line.split(" | ").next().unwrap_or_default();
        first.split([',', '`', ' ']).map(move |module| (module.trim_end_matches('/').to_owned(), row))
    });
    modules.filter(|(module, _)| !module.is_empty()).collect()
}

/// The crates whose modules ARCHITECTURE.md lists in tables.
const LISTED: [&str; 3] = ["kin-core", "kin-derive", "kin-runtime"];

#[test]
fn modules_import_only_those_above_them() {
    let architecture = include_str!("../../../ARCHITECTURE.md");
    for name in LISTED {
        let order = listed(architecture, name);
        let top = |file: &str| file.split('/').next().unwrap_or_default().to_owned();
        let of = |module: &str| order.get(module).unwrap_or_else(|| panic!("{name}: `{module}` is not listed"));
        for (file, imported) in read(name).imports().into_iter().filter(|(file, _)| file != "lib") {
            for other in imported.iter().filter(|other| top(other) != top(&file) && *other != "lib") {
                assert!(of(&top(other)) <= of(&top(&file)), "{name}: `{file}` imports `{other}` from below");
            }
        }
    }
}

#[test]
fn few_files_lie_beside_the_directories() {
    for name in CRATES {
        let flat = read(name).files().filter(|file| !file.contains('/')).count();
        assert!(flat <= 12, "{name}: {flat}");
    }
}

#[test]
fn circles_are_found() {
    let graph = |arrows: &[(&str, &str)]| {
        let mut imports = Imports::new();
        for (from, to) in arrows {
            imports.entry((*from).to_owned()).or_default().insert((*to).to_owned());
        }
        circles(&imports)
    };
    assert!(graph(&[("a", "b"), ("b", "c"), ("a", "c")]).is_empty());
    assert_eq!(graph(&[("a", "b"), ("b", "c"), ("c", "b"), ("c", "d")]).len(), 2);
}

#[test]
fn imports_are_read_through_lists_and_re_exports() {
    let files = [
        ("a.rs", "pub(crate) use deep::Deep;\nmod deep;\n#[cfg(test)]\nmod tests {\n    use crate::c::Three;\n}\n"),
        ("a/deep.rs", "use super::super::b::{self, inner::{One as Two}};\npub(crate) struct Deep;\n"),
        ("b/mod.rs", "//! use crate::c;\nfn f() { crate::c::g(\"crate::a::Deep\") }\npub mod inner;\n"),
        ("b/inner.rs", "use crate::a::Deep;\n"),
        ("c.rs", "pub fn g() {}\n"),
        ("lib.rs", "mod a;\nmod b;\nmod c;\npub use b::inner;\n"),
    ];
    let read = Crate::of(files.map(|(file, text)| (file.to_owned(), text.to_owned())));
    let imports = read.imports();
    let of = |file: &str| imports[file].iter().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(of("a/deep"), ["b", "b/inner"]);
    assert_eq!(of("b"), ["c"]);
    assert_eq!(of("b/inner"), ["a/deep"], "the file that defines it, not the one that re-exports it");
    assert!(of("a").is_empty() && of("lib").is_empty() && of("c").is_empty(), "{imports:?}");
    assert_eq!(circles(&imports).len(), 2);
}
