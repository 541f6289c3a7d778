//! Writes the test mechanisms once more, each with a mass on every body and with random loads, for the laws of forces.
//!
//! The numbers follow from the name of a mechanism alone, so that every build has the same. Beside each mechanism stands
//! a table of its masses and loads, from which the laws compute what the bodies need.

#[path = "random.rs"]
#[allow(dead_code, unreachable_pub)]
mod random;

use random::Random;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=mechanisms");
    println!("cargo::rerun-if-changed=random.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo names a directory")).join("weighted.rs");
    fs::write(out, all(Path::new("mechanisms"))).expect("the directory can be written to");
}

/// All mechanisms of a directory, a module for each file.
fn all(directory: &Path) -> String {
    let files = fs::read_dir(directory).expect("the mechanisms are there");
    let mut files: Vec<PathBuf> = files.map(|file| file.expect("a readable entry").path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "rs") && !file.ends_with("mod.rs"));
    files.sort();
    let mut out = String::new();
    for file in &files {
        let module = file.file_stem().and_then(|name| name.to_str()).expect("a name in letters");
        let text = fs::read_to_string(file).expect("a text");
        let (written, names) = weighted(&text);
        let _ = writeln!(out, "mod {module} {{\n{written}}}");
        for name in names {
            let _ = writeln!(out, "pub use {module}::{name};");
        }
    }
    out
}

/// A file of mechanisms with masses and loads, and the names of its mechanisms.
fn weighted(text: &str) -> (String, Vec<String>) {
    let (mut out, mut tables, mut names) = (String::new(), String::new(), Vec::new());
    let mut bodies: Option<Vec<String>> = None;
    for line in text.lines().filter(|line| !line.starts_with("//!")) {
        if line.starts_with("#[mechanism") {
            bodies = Some(Vec::new());
        }
        if let (Some(known), Some(declared)) = (&mut bodies, declared(line)) {
            known.extend(declared);
        }
        if let Some(rest) = line.strip_prefix("pub struct ")
            && let Some(bodies) = bodies.take()
        {
            let name = rest.trim_end_matches([';', '{', ' ']).to_owned();
            let loads = Loads::random(&name, &bodies);
            out.push_str(&loads.attributes());
            tables.push_str(&loads.table(&name));
            names.push(name);
        }
        let _ = writeln!(out, "{line}");
    }
    (out + &tables, names)
}

/// The bodies that a line declares: `#[bodies(a, b[2])]`, `#[body(c, x = 0)]`.
fn declared(line: &str) -> Option<Vec<String>> {
    let several = line.strip_prefix("#[bodies(").map(|rest| rest.trim_end_matches(")]").split(',').collect::<Vec<_>>());
    let one = line.strip_prefix("#[body(").map(|rest| vec![rest.split([',', ')']).next().unwrap_or(rest)]);
    let members = |written: &str| match written.trim().split_once('[') {
        None => vec![written.trim().to_owned()],
        Some((family, count)) => {
            let count = count.trim_end_matches(']').rsplit(['.', ' ']).next().expect("a count");
            let count: usize = count.parse().expect("a family has a number of members");
            (0..count).map(|k| format!("{family}[{k}]")).collect()
        }
    };
    Some(several.or(one)?.into_iter().flat_map(members).collect())
}

/// A place on a body: its name, and the point in its frame.
type Place = (String, [f64; 2]);

/// The masses and loads of a mechanism.
#[derive(Default)]
struct Loads {
    gravity: [f64; 2],
    /// Centre, mass, moment of inertia.
    masses: Vec<(Place, f64, f64)>,
    /// Place, components, and whether these turn with the body.
    forces: Vec<(Place, [f64; 2], bool)>,
    /// The body on which it reacts, the body that it turns, and the couple.
    torques: Vec<(Option<String>, String, f64)>,
    /// Both ends, stiffness, free length, damping.
    springs: Vec<(Place, Place, [f64; 3])>,
    /// Both bodies, stiffness, free angle, damping.
    torsion_springs: Vec<(String, String, [f64; 3])>,
}

impl Loads {
    /// A mass on every body, and every kind of load; nothing where there are no bodies.
    fn random(name: &str, bodies: &[String]) -> Self {
        let seed = name.bytes().fold(17_u64, |seed, byte| seed.wrapping_mul(31).wrapping_add(byte.into()));
        let mut random = Random::new(seed);
        let Some((first, last)) = bodies.first().zip(bodies.last()) else { return Self::default() };
        let mut number = |low: f64, high: f64| (random.between(low, high) * 1e4).round() / 1e4;
        let place = |body: &str, number: &mut dyn FnMut(f64, f64) -> f64| {
            (body.to_owned(), [number(-0.1, 0.1), number(-0.1, 0.1)])
        };
        let mut loads = Self { gravity: [number(-1.0, 1.0), number(-10.0, -9.0)], ..Self::default() };
        for body in bodies {
            loads.masses.push((place(body, &mut number), number(0.5, 3.0), number(0.001, 0.02)));
        }
        // Several masses of a body add up.
        loads.masses.push((place(first, &mut number), number(0.5, 1.0), 0.0));
        loads.forces.push((place(first, &mut number), [number(-9.0, 9.0), number(-9.0, 9.0)], false));
        loads.forces.push((place(last, &mut number), [number(-9.0, 9.0), number(-9.0, 9.0)], true));
        loads.torques.push((None, first.clone(), number(-1.0, 1.0)));
        let from = if first == last { "ground" } else { first.as_str() };
        if from != "ground" {
            loads.torques.push((Some(from.to_owned()), last.clone(), number(-1.0, 1.0)));
        }
        for [a, b] in [["ground", last.as_str()], [from, last.as_str()]] {
            let ends = (place(a, &mut number), place(b, &mut number));
            loads.springs.push((ends.0, ends.1, [number(10.0, 50.0), number(0.1, 0.5), number(0.1, 1.0)]));
        }
        let spring = [number(0.5, 2.0), number(-0.5, 0.5), number(0.01, 0.1)];
        loads.torsion_springs.push((from.to_owned(), last.clone(), spring));
        loads
    }

    /// As words of the language.
    fn attributes(&self) -> String {
        if self.masses.is_empty() {
            return String::new();
        }
        let at = |(body, [x, y]): &Place| format!("{body} @ ({x}, {y})");
        let mut out = format!("#[gravity({}, {})]\n", self.gravity[0], self.gravity[1]);
        for (centre, mass, inertia) in &self.masses {
            let _ = writeln!(out, "#[mass({}, mass = {mass}, inertia = {inertia})]", at(centre));
        }
        for (k, (place, [x, y], turns)) in self.forces.iter().enumerate() {
            let frame = if *turns { format!(", frame = {}", place.0) } else { String::new() };
            let _ = writeln!(out, "#[force(applied_force_{k}: {}, ({x}, {y}){frame})]", at(place));
        }
        for (k, (from, on, couple)) in self.torques.iter().enumerate() {
            let bodies = from.iter().chain([on]).map(String::as_str).collect::<Vec<_>>().join(", ");
            let _ = writeln!(out, "#[torque(applied_torque_{k}: {bodies} = {couple})]");
        }
        for (k, (a, b, [stiffness, free, damping])) in self.springs.iter().enumerate() {
            let numbers = format!("stiffness = {stiffness}, free_length = {free}, damping = {damping}");
            let _ = writeln!(out, "#[spring(applied_spring_{k}: {}, {}, {numbers})]", at(a), at(b));
        }
        for (k, (a, b, [stiffness, free, damping])) in self.torsion_springs.iter().enumerate() {
            let numbers = format!("stiffness = {stiffness}, free_angle = {free}, damping = {damping}");
            let _ = writeln!(out, "#[torsion_spring(applied_torsion_spring_{k}: {a}, {b}, {numbers})]");
        }
        out
    }

    /// As a constant in Rust.
    fn table(&self, name: &str) -> String {
        let Self { gravity, masses, forces, torques, springs, torsion_springs } = self;
        format!(
            "impl crate::Weighted for {name} {{\n\
             const LOADS: crate::Loads = crate::Loads {{ gravity: {gravity:?}, masses: &{masses:?}, forces: &{forces:?}, \
             torques: &{torques:?}, springs: &{springs:?}, torsion_springs: &{torsion_springs:?} }};\n}}\n",
        )
    }
}
