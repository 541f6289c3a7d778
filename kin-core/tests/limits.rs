//! Dyads near their limits: errors grow as their conditioning says and never reach the other closure; on a limit and
//! beyond, a margin says so.

mod support;

use kin_core::check::check;
use std::f64::consts::FRAC_PI_2;
use support::chains::*;

/// 2⁻⁵².
const EPS: f64 = f64::EPSILON;

/// A pin that is √δ beside the line on which two closures meet is δ within the limit, and found to C·ε/√δ.
const C: f64 = 16.0;

fn planned(draft: &Draft) -> (Oracle, Planned) {
    assert_eq!(check(&draft.mechanism), []);
    let oracle = Oracle::new(&draft.mechanism, &draft.values);
    let planned = Planned::new(&oracle);
    assert!(planned.newton().is_empty());
    (oracle, planned)
}

#[test]
fn errors_grow_as_conditioning_says() {
    for limit in Limit::OF_LENGTH {
        for writing in 0..limit.kind().writings() {
            for seed in 0..3 {
                let mut last = f64::INFINITY;
                for exponent in 1..=14 {
                    let delta = 10_f64.powi(-exponent);
                    let sides = [1.0, -1.0].map(|side| {
                        let draft = near(limit, writing, side * delta.sqrt(), seed);
                        let name = format!("{limit:?} {writing}, seed {seed}, δ = {delta:e}\n{}", draft.mechanism);
                        let (oracle, planned) = planned(&draft);
                        let q = draft.q();
                        let closures = planned.closures(&oracle, 0.0, &q);
                        assert_eq!(closures.len(), 1, "{name}");
                        let mode = closures[0].signum();
                        let found = planned.run(&oracle, 0.0, &[mode], &q);
                        let off = difference(&q, &found.q);
                        let margin = found.margins.iter().copied().fold(1.0, f64::min);
                        assert!(off <= C * EPS / delta.sqrt(), "off by {off:e}, margin {margin:e}: {name}");
                        assert!(margin > 0.0, "{margin:e}: {name}");
                        // The other closure is 2√δ away, and the one that its sign asks for.
                        let other = planned.run(&oracle, 0.0, &[-mode], &q);
                        let apart = q.iter().zip(&other.q).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                        assert!(apart > 0.5 * delta.sqrt(), "{apart:e}: {name}");
                        (mode, margin)
                    });
                    assert_eq!(sides[0].0, -sides[1].0, "{limit:?} {writing}, seed {seed}, δ = {delta:e}");
                    assert!(sides[0].1 < last, "{limit:?} {writing}, seed {seed}, δ = {delta:e}");
                    last = sides[0].1;
                }
            }
        }
    }
}

#[test]
fn on_a_limit_and_beyond_a_margin_says_so() {
    for limit in Limit::OF_LENGTH {
        for writing in 0..limit.kind().writings() {
            let draft = on_limit(limit, writing);
            let (oracle, planned) = planned(&draft);
            for mode in [1.0, -1.0] {
                let margin = |t: f64| {
                    let found = planned.run(&oracle, t, &[mode], &draft.q());
                    let name = format!("t = {t} of {limit:?} {writing}: {}", draft.mechanism);
                    assert!(found.margins.iter().all(|m| !m.is_nan()), "{:?}: {name}", found.margins);
                    assert!(found.q.iter().all(|e| e.is_finite()), "{:?}: {name}", found.q);
                    found.margins.into_iter().fold(1.0, f64::min)
                };
                let sense = if margin(1e-2) > 0.0 { 1.0 } else { -1.0 };
                assert_eq!(margin(0.0), 0.0, "{limit:?} {writing}");
                for t in [1e-2, 1e-4, 1e-8, 1e-12, 1e-14].map(|t| sense * t) {
                    assert!(margin(t) > 0.0 && margin(-t) < 0.0, "{limit:?} {writing}, t = {t}");
                }
            }
        }
    }
}

/// The smallest margin that a plan without modes gives, if it has any, and how far q is off.
fn without_modes(draft: &Draft) -> (Option<f64>, f64) {
    let (oracle, planned) = planned(draft);
    let found = planned.run(&oracle, 0.0, &[], &draft.q());
    assert!(found.margins.iter().all(|m| !m.is_nan()), "{:?}: {}", found.margins, draft.mechanism);
    (found.margins.iter().copied().reduce(f64::min), difference(&draft.q(), &found.q))
}

#[test]
fn errors_grow_as_guides_become_parallel() {
    for limit in Limit::OF_DIRECTION {
        for writing in 0..limit.kind().writings() {
            for seed in 0..6 {
                let mut last = f64::INFINITY;
                for exponent in 1..=12 {
                    let lean = 10_f64.powi(-exponent);
                    let (margin, off) = without_modes(&near(limit, writing, lean, seed));
                    assert!(off <= C * EPS / lean, "{limit:?} {writing}, seed {seed}, lean {lean:e}: {off:e}");
                    if let Some(margin) = margin {
                        assert!(margin > 0.0 && margin < last, "{limit:?} {writing}, lean {lean:e}: {margin:e}");
                        last = margin;
                    }
                }
            }
        }
    }
}

#[test]
fn parallel_guides_leave_no_margin() {
    for limit in Limit::OF_DIRECTION {
        for writing in 0..limit.kind().writings() {
            let on = on_limit(limit, writing);
            let margin = without_modes(&on).0;
            assert!(margin.is_some_and(|m| m <= 0.0), "{margin:?} of {limit:?} {writing}: {}", on.mechanism);
            let near = near(limit, writing, 0.1, 3);
            let margin = without_modes(&near).0;
            assert!(margin.is_some_and(|m| m < 0.1), "{margin:?} of {limit:?} {writing}: {}", near.mechanism);
        }
    }
}

/// A dyad whose outer pins are `apart`, its links of one length or its guide without offset: where they meet it may turn
/// as it likes.
fn met(kind: Kind, writing: usize, apart: f64) -> Draft {
    let (a, c) = ([1.0, 0.0], [1.0, apart]);
    let height = (4.0 - apart * apart / 4.0).sqrt();
    let b = if kind == Kind::Rrr { [1.0 + height, apart / 2.0] } else { c };
    let shape = Shape { a, b, c, beside: b, psi: FRAC_PI_2, across: 0.0 };
    let mut draft = Draft::new(5);
    draft.plain = true;
    let crank = draft.link(&[[0.0; 2]]);
    draft.pin(FIXED, crank, [0.0; 2]);
    draft.drive(FIXED, crank, 1.0);
    close(&mut draft, kind, writing, [crank, FIXED], &shape);
    draft
}

#[test]
fn pins_that_meet_leave_no_margin() {
    for (kind, writing) in [(Kind::Rrr, 0), (Kind::Rrr, 1), (Kind::Rpr, 0), (Kind::Rpr, 1)] {
        let mut last = f64::INFINITY;
        for apart in [1e-1, 1e-3, 1e-6, 1e-9, 0.0] {
            let draft = met(kind, writing, apart);
            let (oracle, planned) = planned(&draft);
            let q = draft.q();
            let modes: Vec<f64> = planned.closures(&oracle, 0.0, &q).iter().map(|w| w.signum()).collect();
            let margin = planned
                .run(&oracle, 0.0, &modes, &q)
                .margins
                .into_iter()
                .fold(1.0, |a, b: f64| if a < b { a } else { b });
            assert!(margin < last && margin.is_finite(), "{margin:e} of {kind:?} {writing}, {apart:e} apart");
            last = margin;
        }
        assert!(last <= 0.0, "{last:e} of {kind:?} {writing}");
    }
}
