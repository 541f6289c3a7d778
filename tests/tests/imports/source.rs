//! The imports of a crate, read from its source: `use` declarations, and paths that begin with `crate`, `self` or
//! `super`. What a file imports through a re-export counts as imported from the file that defines it.

use super::Imports;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// One path of a `use` declaration.
struct Use {
    /// True if the declaration begins with `pub`.
    exported: bool,
    path: Vec<String>,
    name: String,
}

struct File {
    /// Its name in `src`.
    name: String,
    uses: Vec<Use>,
    /// The paths outside of declarations.
    paths: Vec<Vec<String>>,
    /// The names of the items that it declares.
    items: Vec<String>,
}

/// The files of a crate by the paths of their modules, without tests.
pub(super) struct Crate(BTreeMap<Vec<String>, File>);

impl Crate {
    pub(super) fn read(src: &Path) -> Self {
        let mut files = Vec::new();
        collect(src, "", &mut files);
        Self::of(files)
    }

    /// The crate of these files, each with its text.
    pub(super) fn of(files: impl IntoIterator<Item = (String, String)>) -> Self {
        let is_test =
            |part: &str| matches!(part, "tests" | "test" | "corpus" | "fuzz" | "fixture") || part.ends_with("_tests");
        let modules = files.into_iter().filter_map(|(file, text)| {
            let mut path: Vec<String> = file.strip_suffix(".rs")?.split('/').map(str::to_owned).collect();
            if path.iter().any(|part| is_test(part)) {
                return None;
            }
            if matches!(path.last().map(String::as_str), Some("mod" | "lib" | "main")) {
                path.pop();
            }
            Some((path, File::parse(file.clone(), &text)))
        });
        Self(modules.collect())
    }

    /// The names of the files in `src`.
    pub(super) fn files(&self) -> impl Iterator<Item = &str> {
        self.0.values().map(|file| file.name.as_str())
    }

    /// The files that every file imports.
    pub(super) fn imports(&self) -> Imports {
        let mut imports = Imports::new();
        for (module, file) in &self.0 {
            let of = imports.entry(name(module)).or_default();
            let used = file.uses.iter().map(|of| (&of.path, of.exported));
            for (path, exported) in used.chain(file.paths.iter().map(|path| (path, false))) {
                let Some(home) = self.absolute(module, path).and_then(|path| self.home(&path, 0)) else { continue };
                // A module that re-exports what its own children define does not depend on them.
                if home != *module && !(exported && home.starts_with(module)) {
                    of.insert(name(&home));
                }
            }
        }
        imports
    }

    /// A path from the root of the crate; none if it leads to another crate.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        let (mut here, mut rest) = (module.to_vec(), path);
        match rest.first()?.as_str() {
            "crate" => return Some(rest[1..].to_vec()),
            "self" | "super" => {}
            _ => {
                here.push(rest[0].clone());
                return self.0.contains_key(&here).then(|| [module, path].concat());
            }
        }
        while let Some((first, tail)) =
            rest.split_first().filter(|(first, _)| matches!(first.as_str(), "self" | "super"))
        {
            if first == "super" {
                here.pop();
            }
            rest = tail;
        }
        Some([&here, rest].concat())
    }

    /// The module whose file defines what a path names.
    fn home(&self, path: &[String], depth: usize) -> Option<Vec<String>> {
        let (length, module) = (0..=path.len()).rev().find_map(|k| Some((k, self.0.get(&path[..k])?)))?;
        let defining = path[..length].to_vec();
        let Some(wanted) = path.get(length).filter(|_| depth < 9) else { return Some(defining) };
        for Use { path: from, name, .. } in module.uses.iter().filter(|of| of.exported) {
            let Some(target) = self.absolute(&defining, from) else { continue };
            if name == wanted {
                return self.home(&[&target, &path[length + 1..]].concat(), depth + 1);
            }
            let star = target.split_last().filter(|_| name == "*").map(|(_, module)| module.to_vec());
            if let Some(star) = star
                && self.0.get(&star).is_some_and(|file| file.items.contains(wanted))
            {
                return Some(star);
            }
        }
        Some(defining)
    }
}

impl File {
    fn parse(name: String, text: &str) -> Self {
        let code = code(text);
        let (mut uses, mut rest) = (Vec::new(), String::new());
        for statement in code.split_inclusive(['{', '}', ';']) {
            rest.push_str(statement);
            // A declaration with a list has braces of its own: it ends at the semicolon.
            if !statement.ends_with(';') {
                continue;
            }
            if let Some(at) = declaration(&rest) {
                let before = rest[..at].trim_end();
                let exported = before.ends_with("pub") || before.ends_with(')');
                let tree = rest[at..].trim_start_matches("use ").trim_end_matches(';').to_owned();
                leaves(&tree, &[], &mut |path, name| uses.push(Use { exported, path, name }));
                rest.truncate(at);
            }
        }
        let words: Vec<&str> =
            rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty()).collect();
        let declares = |word: &str| matches!(word, "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static");
        let items = words.windows(2).filter(|pair| declares(pair[0])).map(|pair| pair[1].to_owned()).collect();
        let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        let paths = rest
            .split(|c: char| !is_path(c))
            .filter(|path| ["crate::", "self::", "super::"].iter().any(|start| path.starts_with(start)));
        let paths =
            paths.map(|path| path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()).collect();
        Self { name, uses, paths, items }
    }
}

/// Where the `use` declaration begins with which a text ends, if it ends with one.
fn declaration(text: &str) -> Option<usize> {
    let at = text.rfind("use ").filter(|at| !text[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))?;
    let of = &text[at..];
    (!of[..of.len() - 1].contains(';') && of.matches('{').count() == of.matches('}').count()).then_some(at)
}

/// The code of a file, without comments, texts, and the tests at its end.
fn code(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_tests = |pair: &[&str]| {
        pair[0].starts_with("#[cfg(") && pair[0].contains("test") && pair[1].contains("mod ") && pair[1].ends_with('{')
    };
    let end = lines.windows(2).position(is_tests).unwrap_or(lines.len());
    let mut out = String::new();
    for line in &lines[..end] {
        let mut pieces = line.split("//").next().unwrap_or_default().split('"');
        out.push_str(pieces.next().unwrap_or_default());
        pieces.skip(1).step_by(2).for_each(|piece| out.push_str(piece));
        out.push('\n');
    }
    out
}

/// All paths of a `use` tree, each with the name that it gets.
fn leaves(tree: &str, prefix: &[String], found: &mut impl FnMut(Vec<String>, String)) {
    let tree = tree.trim();
    if let Some(list) = tree.strip_prefix('{').and_then(|tree| tree.strip_suffix('}')) {
        let (mut depth, mut from) = (0, 0);
        for (at, c) in list.char_indices().chain([(list.len(), ',')]) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    leaves(&list[from..at], prefix, found);
                    from = at + 1;
                }
                _ => {}
            }
        }
    } else if let Some((first, rest)) = tree.split_once("::").filter(|(first, _)| !first.contains(' ')) {
        leaves(rest, &[prefix, &[first.to_owned()]].concat(), found);
    } else if !tree.is_empty() {
        let (own, name) = tree.split_once(" as ").unwrap_or((tree, tree));
        let path = if own == "self" { prefix.to_vec() } else { [prefix, &[own.to_owned()]].concat() };
        let name = if own == "self" { prefix.last().map_or(name, String::as_str) } else { name };
        found(path, name.to_owned());
    }
}

fn collect(directory: &Path, prefix: &str, files: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(directory).expect("a directory of source").flatten() {
        let name = format!("{prefix}{}", entry.file_name().display());
        if entry.path().is_dir() {
            collect(&entry.path(), &format!("{name}/"), files);
        } else if name.ends_with(".rs") {
            files.push((name, fs::read_to_string(entry.path()).expect("a readable file")));
        }
    }
}

fn name(module: &[String]) -> String {
    if module.is_empty() { "lib".to_owned() } else { module.join("/") }
}
