//! How long the macro takes: `cargo test -p kin-derive --lib corpus::timing -- --ignored --nocapture`, once as it is
//! (as a user gets it: macros are built unoptimised) and once with `--release`.

use super::repository::{Found, mechanisms};
use super::{Case, all};
use proc_macro2::TokenStream;
use std::time::{Duration, Instant};

/// The shortest of some runs, so that other programs do not count.
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
