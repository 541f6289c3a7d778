//! Fuzzing: the complete expansion of damaged descriptions never panics and never hangs.
//!
//! Every input is derived from a number: a description composed from the vocabulary, in which a few tokens are deleted,
//! repeated, exchanged or replaced. A few inputs run with the other tests; a long run is
//!
//! ```text
//! KIN_FUZZ=10000000 cargo test --profile fuzz -p kin-derive --lib fuzz -- --nocapture
//! ```
//!
//! `KIN_FUZZ_FROM` sets the number of the first input. A stack overflow ends the process; with `KIN_FUZZ_STEP=1` the
//! number of every input is printed before it runs.

mod corpus;
mod damage;

use corpus::Corpus;
use proc_macro2::TokenStream;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// A linear congruential generator, which gives the same damage in every run.
struct Dice(u64);

impl Dice {
    /// The generator for the input with this number.
    fn of(number: u64) -> Self {
        let mut dice = Self(number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x243f_6a88_85a3_08d3);
        dice.below(2);
        dice
    }

    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n.max(1)
    }

    fn of_these<'a, T>(&mut self, these: &'a [T]) -> &'a T {
        &these[self.below(these.len())]
    }
}

/// Arguments and item of the input with this number.
fn input(corpus: &Corpus, number: u64) -> (TokenStream, TokenStream) {
    let mut dice = Dice::of(number);
    let mut item = corpus.description(&mut dice);
    let mut args = if dice.below(8) == 0 { dice.of_these(&corpus.flags).clone() } else { Vec::new() };
    let times = if dice.below(16) == 0 { 0 } else { 1 + dice.below(4) };
    for _ in 0..times {
        damage::damage(&mut item, &mut dice, corpus);
    }
    if dice.below(64) == 0 {
        damage::damage(&mut args, &mut dice, corpus);
    }
    (damage::stream(args), damage::stream(item))
}

/// Expands an input. Returns whether it has errors, or a message if the expansion panics, is slow or is not valid Rust.
fn trial(number: u64, args: &TokenStream, item: &TokenStream) -> Result<bool, String> {
    const SLOW: Duration = Duration::from_secs(1);
    let run = || {
        let start = Instant::now();
        let expanded = catch_unwind(AssertUnwindSafe(|| crate::derive(args.clone(), item.clone())));
        (expanded, start.elapsed())
    };
    let (mut expanded, mut elapsed) = run();
    // On a busy machine other processes may delay a run, so a slow one is repeated.
    for _ in 0..2 {
        if elapsed > SLOW {
            let (again, shorter) = run();
            (expanded, elapsed) = (again, elapsed.min(shorter));
        }
    }
    let expanded = expanded.map_err(|_| format!("panicked: {}", PANIC.take()))?;
    if elapsed > SLOW {
        return Err(format!("took {elapsed:?}"));
    }
    let is_wrong = expanded.clone().into_iter().take(8).any(|tree| tree.to_string() == "compile_error");
    // The expansion of a valid input must be valid Rust; only some are parsed, because that takes longer than
    // everything else.
    if !is_wrong && number.is_multiple_of(16) {
        syn::parse2::<syn::File>(expanded).map_err(|error| format!("expands to no Rust: {error}"))?;
    }
    Ok(is_wrong)
}

thread_local! {
    /// The message of the last panic.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// A number from an environment variable.
fn setting(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

#[test]
fn damaged_descriptions_expand() {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if std::thread::current().name() == Some("fuzz") {
            PANIC.set(info.to_string());
        } else {
            before(info);
        }
    }));
    let worker = std::thread::Builder::new().name("fuzz".to_owned()).spawn(run).unwrap();
    let findings = worker.join().unwrap();
    assert!(findings.is_empty(), "{} findings; the first: {}", findings.len(), findings[0]);
}

fn run() -> Vec<String> {
    let corpus = Corpus::new();
    let (count, from) = (setting("KIN_FUZZ").unwrap_or(2_000), setting("KIN_FUZZ_FROM").unwrap_or(0));
    let steps = setting("KIN_FUZZ_STEP").unwrap_or(100_000);
    let (mut findings, mut right) = (Vec::new(), 0_u64);
    let start = Instant::now();
    for number in from..from + count {
        if number % steps == 0 && count > 2_000 {
            let found = findings.len();
            println!("input {number}, {:.0?}: {right} right, {found} findings", start.elapsed());
        }
        let (args, item) = input(&corpus, number);
        match trial(number, &args, &item) {
            Ok(is_wrong) => right += u64::from(!is_wrong),
            Err(what) => {
                let finding = format!("input {number} {what}\n#[mechanism({args})]\n{item}");
                println!("{finding}\n");
                findings.push(finding);
            }
        }
    }
    println!("{count} inputs from {from}, {:.0?}: {right} right, {} findings", start.elapsed(), findings.len());
    // The test is only meaningful if neither valid nor invalid inputs are rare.
    assert!(right * 20 > count && right * 20 < count * 19, "{right} of {count} are right");
    findings
}
