//! The metadata that a registry requires of the three crates, and the minimum Rust version of their dependencies.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// `cargo metadata` of the workspace.
fn metadata() -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["metadata", "--format-version", "1", "--locked", "--all-features"];
    let output = Command::new(cargo).args(arguments).current_dir(root).output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn text<'a>(package: &'a Value, key: &str) -> &'a str {
    package[key].as_str().unwrap_or_default()
}

/// `1.89.0` as numbers; empty if a package states no minimum version.
fn version(package: &Value) -> Vec<u32> {
    text(package, "rust_version").split('.').filter_map(|part| part.parse().ok()).collect()
}

#[test]
fn the_three_crates_can_be_published_and_no_other() {
    let metadata = metadata();
    let members: Vec<&Value> = metadata["packages"]
        .as_array()
        .expect("packages")
        .iter()
        .filter(|package| metadata["workspace_members"].as_array().is_some_and(|all| all.contains(&package["id"])))
        .collect();
    let mut published = Vec::new();
    for package in members {
        let name = text(package, "name");
        assert!(!text(package, "description").is_empty() && !text(package, "license").is_empty(), "{name}");
        if package["publish"].as_array().is_some_and(Vec::is_empty) {
            continue;
        }
        published.push(name);
        let folder = Path::new(text(package, "manifest_path")).parent().expect("a folder");
        assert!(folder.join(text(package, "readme")).is_file(), "{name} has no readme");
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(folder.join(licence).is_file(), "{name} without {licence}");
        }
        assert_eq!(format!("https://docs.rs/{name}"), text(package, "documentation"));
        assert_eq!(true, package["metadata"]["docs"]["rs"]["all-features"], "{name}");
        let keywords = package["keywords"].as_array().expect("keywords");
        assert!(
            (1..=5).contains(&keywords.len()) && keywords.iter().all(|k| k.as_str().unwrap().len() <= 20),
            "{name}"
        );
        assert!(!package["categories"].as_array().expect("categories").is_empty(), "{name}");
        // A dependency given by a path needs a version as well, by which the registry resolves it.
        for dependency in package["dependencies"].as_array().expect("dependencies") {
            let local = dependency["path"].is_string() && dependency["kind"].is_null();
            assert!(!local || text(dependency, "req").starts_with("^0."), "{name}: {}", dependency["name"]);
        }
    }
    assert_eq!(["kin-core", "kin-derive", "kin-runtime"], published[..]);
}

/// Clippy checks the code against the stated version; this test checks the dependencies.
#[test]
fn no_dependency_needs_a_newer_rust_than_is_stated() {
    let metadata = metadata();
    let packages = metadata["packages"].as_array().expect("packages");
    let stated =
        packages.iter().find(|package| text(package, "name") == "kin-runtime").map(version).expect("kin-runtime");
    assert!(stated >= vec![1, 85], "{stated:?}");
    for package in packages {
        let mut asked = version(package);
        asked.truncate(2);
        assert!(asked <= stated, "{} {} asks for {asked:?}", text(package, "name"), text(package, "version"));
    }
}
