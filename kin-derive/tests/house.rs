//! Files of the three crates import downwards only: no file uses one that uses it, directly or along a chain. Where two
//! files need one another, what both need belongs into a third below them. No two types of a crate have the same name.
//! Pages have every heading once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, UseTree, Visibility};

/// A module by its path from the root of its crate.
type Module = Vec<String>;

/// What a file names.
#[derive(Default)]
struct Source {
    /// Imports: whether they are public, the path, and the name here.
    uses: Vec<(bool, Module, String)>,
    /// Paths that are written out where they are used.
    paths: Vec<Module>,
    /// The names of its structs, enums and traits.
    types: Vec<String>,
}

impl<'ast> Visit<'ast> for Source {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) {
            return;
        }
        self.types.extend(type_name(item));
        visit::visit_item(self, item);
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let public = !matches!(item.vis, Visibility::Inherited);
        leaves(&item.tree, &mut Vec::new(), &mut |path, name| self.uses.push((public, path, name)));
    }

    /// `pub(crate)` names no file.
    fn visit_visibility(&mut self, _: &'ast Visibility) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.paths.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }
}

/// The name of a struct, an enum or a trait.
fn type_name(item: &Item) -> Option<String> {
    match item {
        Item::Struct(item) => Some(item.ident.to_string()),
        Item::Enum(item) => Some(item.ident.to_string()),
        Item::Trait(item) => Some(item.ident.to_string()),
        _ => None,
    }
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Mod(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        _ => &[],
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    let is_test = |list: &syn::MetaList| list.path.is_ident("cfg") && list.tokens.to_string() == "test";
    attributes.iter().any(|attribute| attribute.meta.require_list().is_ok_and(is_test))
}

fn leaves(tree: &UseTree, path: &mut Module, found: &mut impl FnMut(Module, String)) {
    match tree {
        UseTree::Path(inner) => {
            path.push(inner.ident.to_string());
            leaves(&inner.tree, path, found);
            path.pop();
        }
        UseTree::Group(group) => group.items.iter().for_each(|tree| leaves(tree, path, found)),
        UseTree::Name(name) if name.ident == "self" => {
            found(path.clone(), path.last().cloned().unwrap_or_default());
        }
        UseTree::Name(name) => found([&path[..], &[name.ident.to_string()]].concat(), name.ident.to_string()),
        UseTree::Rename(rename) => {
            found([&path[..], &[rename.ident.to_string()]].concat(), rename.rename.to_string());
        }
        UseTree::Glob(_) => found(path.clone(), "*".to_owned()),
    }
}

/// The files of a crate, tests and what only they use left out.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or_default();
        if ["tests", "corpus", "fuzz", "fixture", "snapshots"].contains(&name) || name.ends_with("_tests") {
            continue;
        }
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

fn module(file: &Path, root: &Path) -> Module {
    let inside = file.strip_prefix(root).expect("inside of the crate").with_extension("");
    let mut module: Module = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if module.last().is_some_and(|last| last == "mod" || last == "lib") {
        module.pop();
    }
    module
}

struct Crate {
    sources: BTreeMap<Module, Source>,
}

impl Crate {
    fn new(root: &Path) -> Self {
        let mut paths = Vec::new();
        files(root, &mut paths);
        let read = |path: PathBuf| {
            let text = std::fs::read_to_string(&path).expect("a file");
            let mut source = Source::default();
            source.visit_file(&syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display())));
            (module(&path, root), source)
        };
        Self { sources: paths.into_iter().map(read).collect() }
    }

    /// A path of a module from the root of the crate; none for one that leads out of it.
    fn absolute(&self, module: &Module, path: &[String]) -> Option<Module> {
        let mut here = module.clone();
        let mut rest = path;
        let mut relative = false;
        while let Some((first, others)) = rest.split_first() {
            match first.as_str() {
                "crate" => return Some(others.to_vec()),
                "self" => {}
                "super" => drop(here.pop()),
                _ => break,
            }
            (rest, relative) = (others, true);
        }
        let whole = [&here[..], rest].concat();
        let child = [&here[..], rest.get(..1)?].concat();
        (relative || self.sources.contains_key(&child)).then_some(whole)
    }

    /// The file that defines what a path names: re-exports are followed.
    fn home(&self, path: &[String], depth: usize) -> Option<Module> {
        let at = (0..=path.len()).rev().find(|&k| self.sources.contains_key(&path[..k]))?;
        let module = path[..at].to_vec();
        let Some(name) = path.get(at).filter(|_| depth < 16) else { return Some(module) };
        let export = self.sources[&module].uses.iter().find(|(_, _, exported)| exported == name);
        let target = export.and_then(|(_, target, _)| self.absolute(&module, target));
        match target {
            Some(target) => self.home(&[&target[..], &path[at + 1..]].concat(), depth + 1),
            None => Some(module),
        }
    }

    /// Which file uses which others. A room that re-exports what is in it does not use it.
    fn arrows(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let of = |(module, source): (&Module, &Source)| {
            let uses = source.uses.iter().map(|(public, path, _)| (*public, path));
            let all = uses.chain(source.paths.iter().map(|path| (false, path)));
            let targets = all.filter_map(|(public, path)| {
                let home = self.home(&self.absolute(module, path)?, 0)?;
                let inside = public && home.starts_with(module);
                (home != *module && !inside).then_some(home)
            });
            (module.clone(), targets.collect())
        };
        self.sources.iter().map(of).collect()
    }
}

#[test]
fn no_file_uses_one_that_uses_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for (name, least) in [("kin-core", 50), ("kin-derive", 50), ("kin-runtime", 50), ("kin-study", 40)] {
        let house = Crate::new(&root.join(name).join("src"));
        let mut arrows = house.arrows();
        assert!(arrows.len() > least, "{name}: only {} files", arrows.len());
        // Who uses nobody that is left is in no circle.
        loop {
            let left: BTreeSet<Module> = arrows.keys().cloned().collect();
            arrows.retain(|_, uses| uses.iter().any(|used| left.contains(used)));
            if arrows.len() == left.len() {
                break;
            }
        }
        let left: BTreeSet<Module> = arrows.keys().cloned().collect();
        found.extend(arrows.iter().map(|(module, uses)| {
            let uses: Vec<String> = uses.intersection(&left).map(|used| used.join("/")).collect();
            format!("{name}/{} uses {}", module.join("/"), uses.join(", "))
        }));
    }
    assert!(found.is_empty(), "in a circle, or using one:\n{}", found.join("\n"));
}

/// A name says what a thing is, so that it is not used for two things.
#[test]
fn no_two_types_of_a_crate_have_the_same_name() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for name in ["kin-core", "kin-derive", "kin-runtime", "kin-study"] {
        let house = Crate::new(&root.join(name).join("src"));
        let mut homes: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for (module, source) in &house.sources {
            source.types.iter().for_each(|found| homes.entry(found).or_default().push(module.join("/")));
        }
        assert!(homes.len() > 40, "{name}: only {} types", homes.len());
        // Users call the progress of a batch `batch::Progress`, and that of a search `design::Progress`.
        homes.retain(|of, homes| homes.len() > 1 && *of != "Progress");
        found.extend(homes.iter().map(|(of, homes)| format!("{name}: {of} in {}", homes.join(", "))));
    }
    assert!(found.is_empty(), "names of two types:\n{}", found.join("\n"));
}

#[test]
fn no_folder_of_a_crate_is_a_flat_pile() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for name in ["kin-core", "kin-derive", "kin-runtime", "kin-study"] {
        let entries = std::fs::read_dir(root.join(name).join("src")).expect("a crate");
        let flat = entries.filter(|entry| entry.as_ref().is_ok_and(|entry| entry.path().is_file())).count();
        assert!(flat <= 12, "{name}: {flat} files lie flat in src");
    }
}

/// The pages of the guide and of the vocabulary begin with a sentence that says what they are about, and have every heading
/// once: what was pasted twice, or cut in the middle, has not.
#[test]
fn no_page_has_a_heading_twice() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kin-runtime/src");
    let mut seen = 0;
    for folder in ["guide", "vocabulary"] {
        for entry in std::fs::read_dir(source.join(folder)).expect("a folder") {
            let page = entry.expect("an entry").path();
            if page.extension().is_none_or(|end| end != "md") {
                continue;
            }
            let text = std::fs::read_to_string(&page).expect("a page");
            let mut headings = BTreeSet::new();
            let mut in_code = false;
            for line in text.lines() {
                in_code ^= line.trim_start().starts_with("```");
                if !in_code && line.starts_with('#') {
                    assert!(headings.insert(line), "{}: {line} stands there twice", page.display());
                }
            }
            assert!(!in_code, "{}: a block of code has no end", page.display());
            let contents = text.lines().filter(|line| line.starts_with("[Contents]")).count();
            assert!(contents == 0 || contents == 2, "{}: {contents} lines lead to the contents", page.display());
            seen += 1;
        }
    }
    assert!(seen >= 30, "only {seen} pages");
}

/// The fuzzer compiles the modules of kin-derive, because a macro cannot be linked; it has to have all of them.
#[test]
fn the_fuzzer_has_all_modules() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let modules = |path: PathBuf| -> BTreeSet<String> {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let file = syn::parse_file(&text).expect("Rust");
        let modules = file.items.into_iter().filter(|item| !is_test(attributes(item)));
        modules
            .filter_map(|item| if let Item::Mod(module) = item { Some(module.ident.to_string()) } else { None })
            .collect()
    };
    assert_eq!(modules(here.join("src/lib.rs")), modules(here.join("../fuzz/fuzz_targets/expansion.rs")));
}
