//! Measures the time that the macro takes: `cargo test -p kin-derive --lib corpus::timing -- --ignored --nocapture`,
//! once without optimisation (as users run it, because macros are built unoptimised) and once with `--release`.

use super::repository::{Found, mechanisms};
use super::{Case, all};
use proc_macro2::TokenStream;
use std::time::{Duration, Instant};

/// The shortest time of several runs, which other programs disturb least.
fn shortest(runs: usize, mut work: impl FnMut()) -> Duration {
    let run = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..runs).map(run).min().unwrap_or_default()
}

fn whole(case: &Case) -> Duration {
    let source = case.source(&case.attributes());
    shortest(3, || drop(crate::derive(TokenStream::new(), source.clone())))
}

#[test]
#[ignore = "a measurement, not a test"]
fn times() {
    let mut rows: Vec<(Duration, usize, String)> = Vec::new();
    for case in all() {
        rows.push((whole(case), case.counts[0], case.name.to_owned()));
    }
    for Found { name, args, item } in mechanisms() {
        let (_, Ok(lowered)) = crate::analyse::analyse(args.clone(), item.clone()) else { continue };
        let coordinates = kin_core::assemble(&lowered.mechanism).map_or(0, |set| set.coordinates.len());
        let time = shortest(3, || drop(crate::derive(args.clone(), item.clone())));
        rows.push((time, coordinates, name));
    }
    rows.sort();
    for (time, coordinates, name) in &rows {
        println!("{:8.2} ms, {coordinates:4} coordinates: {name}", ms(*time));
    }
    let of_ten_bodies = rows.iter().filter(|row| row.1 <= 30).map(|row| row.0).max().unwrap_or_default();
    println!("{} mechanisms; slowest with at most 30 coordinates {:.1} ms", rows.len(), ms(of_ten_bodies));
    for links in [10, 100, 300] {
        let tokens = chain(links);
        let found = super::diagnosed(tokens.clone());
        let structure = shortest(1, || drop(kin_core::diagnose(&found.system)));
        let whole = shortest(1, || drop(crate::derive(TokenStream::new(), tokens.clone())));
        println!("{:8.2} ms, structure {:7.2} ms: chain of {links} links", ms(whole), ms(structure));
    }
}

/// The time of each stage for a chain of four-bars, each of which has as many rows as a typical mechanism.
#[test]
#[ignore = "a measurement, not a test"]
fn stages() {
    for (name, tokens) in [
        ("alone", written_out(1)),
        ("a hundred with a range", ranged(100)),
        ("a hundred written out", written_out(100)),
    ] {
        let of = |work: &mut dyn FnMut()| ms(shortest(1, work));
        let analysed = of(&mut || drop(crate::analyse::analyse(TokenStream::new(), tokens.clone())));
        let (_, Ok(lowered)) = crate::analyse::analyse(TokenStream::new(), tokens.clone()) else { continue };
        let equations = of(&mut || drop(kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate)));
        let system = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate).unwrap();
        let structure = of(&mut || drop(kin_core::diagnose(&system)));
        let planned = of(&mut || drop(kin_core::plan::plan(&system)));
        let rank = system.set.coordinates.len();
        let formulas = of(&mut || drop(kin_core::plan::plan_with_formulas(&system, rank)));
        let shown = of(&mut || drop(system.equations.iter().map(|e| system.set.show(e.gamma)).collect::<Vec<_>>()));
        let whole = of(&mut || drop(crate::derive(TokenStream::new(), tokens.clone())));
        println!(
            "four-bars, {name}: parsed {analysed:.0} ms, equations {equations:.0} ms, \
             structure {structure:.0} ms, plan {planned:.0} ms, with its formulas {formulas:.0} ms, \
             γ as text {shown:.0} ms, all {whole:.0} ms"
        );
    }
}

const FIELDS: &str = "l1: [f64; 100], l2: [f64; 100], l3: [f64; 100], d1: [f64; 100], d2: [f64; 100], omega: f64";

fn ranged(n: usize) -> TokenStream {
    let source = format!(
        "#[bodies(crank[{n}], coupler[{n}], rocker[{n}])] \
         #[revolute(C[i in 0..{n}]: ground @ (0, 0), crank[i] @ (-l1[i]/2, 0))] \
         #[revolute(A[i in 0..{n}]: crank[i] @ (l1[i]/2, 0), coupler[i] @ (-l2[i]/2, 0))] \
         #[revolute(B[i in 0..{n}]: coupler[i] @ (l2[i]/2, 0), rocker[i] @ (-l3[i]/2, 0))] \
         #[revolute(D[i in 0..{n}]: rocker[i] @ (l3[i]/2, 0), ground @ (d1[i], d2[i]))] \
         #[gear(mesh[i in 1..{n}]: rocker[i - 1], crank[i], radii = (0.1, 0.1))] \
         #[driver(drive: crank[0].phi = omega * t)] struct Chain {{ {FIELDS} }}"
    );
    source.parse().unwrap()
}

fn written_out(n: usize) -> TokenStream {
    let members = (0..n).map(|k| {
        let turn = match k {
            0 => "#[driver(drive: crank0.phi = omega * t)]".to_owned(),
            _ => format!("#[gear(mesh{k}: rocker{}, crank{k}, radii = (0.1, 0.1))]", k - 1),
        };
        format!(
            "#[bodies(crank{k}, coupler{k}, rocker{k})] \
             #[revolute(C{k}: ground @ (0, 0), crank{k} @ (-l1[{k}]/2, 0))] \
             #[revolute(A{k}: crank{k} @ (l1[{k}]/2, 0), coupler{k} @ (-l2[{k}]/2, 0))] \
             #[revolute(B{k}: coupler{k} @ (l2[{k}]/2, 0), rocker{k} @ (-l3[{k}]/2, 0))] \
             #[revolute(D{k}: rocker{k} @ (l3[{k}]/2, 0), ground @ (d1[{k}], d2[{k}]))] {turn} "
        )
    });
    let members: String = members.collect();
    format!("{members} struct Chain {{ {FIELDS} }}").parse().unwrap()
}

fn chain(links: usize) -> TokenStream {
    let source = format!(
        "#[bodies(link[{links}])] #[revolute(root: ground @ (0, 0), link[0] @ (0, 0))] \
         #[revolute(pin[i in 0..{last}]: link[i] @ (l, 0), link[i + 1] @ (0, 0))] \
         #[driver(turn[i in 0..{links}]: link[i].phi = t)] struct Chain {{ l: f64 }}",
        last = links - 1
    );
    source.parse().unwrap()
}

fn ms(duration: Duration) -> f64 {
    1e3 * duration.as_secs_f64()
}
