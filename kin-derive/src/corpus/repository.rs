//! The mechanisms in the repository: those of tests, of examples, and of code blocks in its Markdown pages.

use proc_macro2::TokenStream;
use quote::ToTokens;
use std::path::{Path, PathBuf};
use syn::visit::Visit;

/// A mechanism as written in a file.
pub(crate) struct Found {
    pub(crate) name: String,
    /// The arguments of `#[mechanism(…)]`.
    pub(crate) args: TokenStream,
    /// The struct with its other attributes.
    pub(crate) item: TokenStream,
}

impl Found {
    /// True if the flags include `allow_redundant`.
    pub(super) fn may_be_redundant(&self) -> bool {
        self.args.to_string().contains("allow_redundant")
    }
}

/// Collects all structs with `#[mechanism]` in a file.
#[derive(Default)]
struct Finder {
    found: Vec<Found>,
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        let mut item = item.clone();
        // Attributes in `cfg_attr` are expanded by the compiler only.
        if item.attrs.iter().any(|attribute| attribute.path().is_ident("cfg_attr")) {
            return;
        }
        let ours = |attribute: &syn::Attribute| attribute.path().is_ident("mechanism");
        let Some(index) = item.attrs.iter().position(ours) else { return };
        let attribute = item.attrs.remove(index);
        let args = attribute.meta.require_list().map(|list| list.tokens.clone()).unwrap_or_default();
        self.found.push(Found { name: item.ident.to_string(), args, item: item.to_token_stream() });
    }
}

fn mechanisms_of(file: &syn::File) -> Vec<Found> {
    let mut finder = Finder::default();
    finder.visit_file(file);
    finder.found
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The files with an extension below a directory, in alphabetical order.
fn files(directory: &Path, extension: &str) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(directory) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let of = |path: PathBuf| match path.extension() {
        _ if path.is_dir() => files(&path, extension),
        Some(found) if found == extension => vec![path],
        _ => Vec::new(),
    };
    paths.into_iter().flat_map(of).collect()
}

/// The mechanisms of examples and tests, except those of the compile-fail tests.
pub(crate) fn mechanisms() -> Vec<Found> {
    let directories = ["examples", "tests/mechanisms", "tests/tests", "tests/src"];
    let sources = directories.into_iter().flat_map(|directory| files(&root().join(directory), "rs"));
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).expect("a source file");
        mechanisms_of(&syn::parse_file(&text).expect("Rust"))
    };
    sources.flat_map(read).collect()
}

/// The mechanisms of the README, the guide and the vocabulary.
pub(super) fn mechanisms_of_pages() -> Vec<Found> {
    let mut pages = files(&root().join("kin-runtime/src"), "md");
    pages.push(root().join("README.md"));
    let read = |path: PathBuf| std::fs::read_to_string(path).expect("a page");
    let parse = |block: String| {
        let whole = syn::parse_file(&block);
        whole.or_else(|_| syn::parse_file(&format!("fn main() {{ {block} }}"))).ok()
    };
    let blocks = pages.into_iter().flat_map(|path| blocks(&read(path)));
    blocks.filter_map(parse).flat_map(|file| mechanisms_of(&file)).collect()
}

/// The code blocks of a Markdown page, with the lines that rustdoc hides, except blocks that are examples of errors.
fn blocks(page: &str) -> Vec<String> {
    let (mut blocks, mut open, mut wrong) = (Vec::new(), None::<String>, false);
    for line in page.lines() {
        match (&mut open, line.trim_start().starts_with("```")) {
            (None, true) => {
                open = Some(String::new());
                wrong = line.contains("compile_fail");
            }
            (Some(_), true) => blocks.extend(open.take().filter(|_| !wrong)),
            (Some(block), false) => {
                let shown = line.strip_prefix("# ").unwrap_or(line);
                block.push_str(if shown == "#" { "" } else { shown });
                block.push('\n');
            }
            (None, false) => {}
        }
    }
    blocks
}
