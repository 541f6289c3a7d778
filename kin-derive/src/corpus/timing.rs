//! How long the macro takes: `cargo test -p kin-derive --lib corpus::timing -- --ignored --nocapture`, once as it is
//! (as a user gets it: macros are built unoptimised) and once with `--release`.

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
    let mut worst = (Duration::ZERO, "");
    for case in all() {
        let found = super::diagnosed(case.source(&case.attributes()));
        let structure = shortest(3, || drop(kin_core::diagnose(&found.system)));
        let whole = whole(case);
        worst = worst.max((whole, case.name));
        println!("{:8.2} ms, structure {:7.2} ms: {}", ms(whole), ms(structure), case.name);
    }
    println!("slowest of {}: {} ({:.1} ms)", all().count(), worst.1, ms(worst.0));
    for links in [100, 300] {
        let source = format!(
            "#[bodies(link[{links}])] #[revolute(root: ground @ (0, 0), link[0] @ (0, 0))] \
             #[revolute(pin[i in 0..{last}]: link[i] @ (l, 0), link[i + 1] @ (0, 0))] \
             #[driver(turn[i in 0..{links}]: link[i].phi = t)] struct Chain {{ l: f64 }}",
            last = links - 1
        );
        let tokens: TokenStream = source.parse().unwrap();
        let found = super::diagnosed(tokens.clone());
        let structure = shortest(1, || drop(kin_core::diagnose(&found.system)));
        let whole = shortest(1, || drop(crate::derive(TokenStream::new(), tokens.clone())));
        println!("{:8.2} ms, structure {:7.2} ms: chain of {links} links", ms(whole), ms(structure));
    }
}

fn ms(duration: Duration) -> f64 {
    1e3 * duration.as_secs_f64()
}

/// A guard against blowing up, far above what is measured.
#[test]
fn a_long_chain_is_analysed_quickly() {
    let source = "#[bodies(link[100])] #[revolute(root: ground @ (0, 0), link[0] @ (0, 0))] \
                  #[revolute(pin[i in 0..99]: link[i] @ (l, 0), link[i + 1] @ (0, 0))] \
                  #[revolute(again: link[98] @ (l, 0), link[99] @ (0, 0))] \
                  #[driver(turn[i in 0..100]: link[i].phi = t)] struct Chain { l: f64 }";
    let found = super::diagnosed(source.parse().unwrap());
    assert_eq!(found.counts(), [300, 302, 300, 100]);
    let structure = shortest(1, || drop(kin_core::diagnose(&found.system)));
    assert!(structure < Duration::from_secs(5), "{structure:?}");
}
