//! The mechanisms of the tests and examples: none is redundant by its structure, unless it says so.

use super::diagnosed;
use quote::ToTokens;
use std::path::Path;
use syn::visit::Visit;

/// The mechanisms of a file, wherever they stand in it, and whether they may be redundant.
#[derive(Default)]
struct Mechanisms(Vec<(syn::ItemStruct, bool)>);

impl Visit<'_> for Mechanisms {
    fn visit_item_struct(&mut self, item: &syn::ItemStruct) {
        let mut item = item.clone();
        // What `cfg_attr` writes is expanded by the compiler alone.
        if item.attrs.iter().any(|attribute| attribute.path().is_ident("cfg_attr")) {
            return;
        }
        let place = item.attrs.iter().position(|attribute| attribute.path().is_ident("mechanism"));
        if let Some(place) = place {
            let flags = item.attrs.remove(place).to_token_stream().to_string();
            self.0.push((item, flags.contains("allow_redundant")));
        }
    }
}

#[test]
fn no_alarm_at_the_mechanisms_of_the_tests_and_examples() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut seen = 0;
    for folder in ["tests/mechanisms", "tests/tests", "tests/tests/laws", "tests/src/bin", "examples"] {
        let Ok(entries) = std::fs::read_dir(root.join(folder)) else { continue };
        for entry in entries {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "rs") {
                continue;
            }
            let file = syn::parse_file(&std::fs::read_to_string(&path).unwrap()).unwrap();
            let mut found = Mechanisms::default();
            found.visit_file(&file);
            for (item, redundant) in found.0 {
                let found = diagnosed(item.to_token_stream());
                let name = &item.ident;
                let errors = found.messages();
                assert!(errors.is_empty() || redundant, "{}: {name}: {errors:?}", path.display());
                seen += 1;
            }
        }
    }
    assert!(seen >= 45, "{seen}");
}

/// The Rust of a page of Markdown, block by block.
fn blocks(page: &str) -> Vec<String> {
    let (mut blocks, mut open) = (Vec::new(), None::<String>);
    for line in page.lines() {
        match (&mut open, line.trim_start().starts_with("```")) {
            (None, true) => open = Some(String::new()),
            (Some(_), true) => blocks.extend(open.take()),
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

#[test]
fn no_alarm_at_the_mechanisms_of_the_pages() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut seen = 0;
    for folder in ["", "kin-runtime/src", "kin-runtime/src/vocabulary"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "md") {
                continue;
            }
            for block in blocks(&std::fs::read_to_string(&path).unwrap()) {
                let mut found = Mechanisms::default();
                let Ok(file) =
                    syn::parse_file(&block).or_else(|_| syn::parse_file(&format!("fn main() {{ {block} }}")))
                else {
                    continue;
                };
                found.visit_file(&file);
                for (item, redundant) in found.0 {
                    let (_, result) = crate::analyse::analyse(proc_macro2::TokenStream::new(), item.to_token_stream());
                    if result.is_ok() {
                        let found = diagnosed(item.to_token_stream());
                        assert!(found.messages().is_empty() || redundant, "{}: {:?}", path.display(), found.messages());
                        seen += 1;
                    }
                }
            }
        }
    }
    assert!(seen >= 8, "{seen}");
}
