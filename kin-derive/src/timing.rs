//! How long the macro takes over every mechanism of the repository: printed, not asserted, since machines are noisy.
//!
//! ```text
//! cargo test -p kin-derive --lib -- --ignored --nocapture macro_time             # as a user gets it: unoptimised
//! cargo test --release -p kin-derive --lib -- --ignored --nocapture macro_time   # optimised
//! ```

use proc_macro2::TokenStream;
use quote::ToTokens;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use syn::visit::Visit;

/// A mechanism as it stands in a source file.
pub(crate) struct Found {
    pub(crate) name: String,
    pub(crate) args: TokenStream,
    pub(crate) item: TokenStream,
}

/// Everything under a `#[mechanism]`, wherever it stands.
#[derive(Default)]
struct Finder {
    found: Vec<Found>,
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        let mut item = item.clone();
        let ours = |attribute: &syn::Attribute| attribute.path().is_ident("mechanism");
        let Some(place) = item.attrs.iter().position(ours) else { return };
        let attribute = item.attrs.remove(place);
        let args = attribute.meta.require_list().map(|list| list.tokens.clone()).unwrap_or_default();
        self.found.push(Found { name: item.ident.to_string(), args, item: item.to_token_stream() });
    }
}

/// The Rust files below a directory, in order.
fn files(directory: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(directory) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let of = |path: PathBuf| match path.extension() {
        _ if path.is_dir() => files(&path),
        Some(extension) if extension == "rs" => vec![path],
        _ => Vec::new(),
    };
    paths.into_iter().flat_map(of).collect()
}

pub(crate) fn corpus() -> Vec<Found> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut finder = Finder::default();
    for directory in ["examples", "tests/mechanisms", "tests/tests"] {
        for path in files(&root.join(directory)) {
            let text = std::fs::read_to_string(&path).expect("a source file");
            finder.visit_file(&syn::parse_file(&text).expect("Rust"));
        }
    }
    finder.found
}

#[test]
#[ignore = "prints times"]
fn macro_time() {
    let corpus = corpus();
    assert!(corpus.len() > 30, "the mechanisms of the repository");
    let mut rows: Vec<(Duration, usize, String)> = Vec::new();
    for Found { name, args, item } in corpus {
        let (_, lowered) = crate::analyse::analyse(args.clone(), item.clone());
        let Ok(lowered) = lowered else { continue };
        let coordinates = kin_core::assemble(&lowered.mechanism).map_or(0, |set| set.coordinates.len());
        let once = || {
            let start = Instant::now();
            let tokens = crate::derive(args.clone(), item.clone());
            let time = start.elapsed();
            assert!(!tokens.is_empty());
            time
        };
        let best = (0..3).map(|_| once()).min().unwrap_or_default();
        rows.push((best, coordinates, name));
    }
    rows.sort();
    for (time, coordinates, name) in &rows {
        println!("{:9.2} ms  {coordinates:4} coordinates  {name}", time.as_secs_f64() * 1e3);
    }
    let total: Duration = rows.iter().map(|row| row.0).sum();
    println!("{} mechanisms, {:.0} ms together", rows.len(), total.as_secs_f64() * 1e3);
}
