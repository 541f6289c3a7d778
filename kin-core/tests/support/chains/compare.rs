//! A plan against the dense Newton iteration, along a motion.

use super::{Draft, Instant, Oracle, Planned, difference};
use kin_core::check::check;
use std::f64::consts::TAU;

/// Agreement, relative to the largest entry of q, q̇ or q̈ and to 1.
pub const AGREEMENT: f64 = 1e-12;

/// Steps in time of what a plan is compared with.
const STEP: f64 = 0.025;

/// A mechanism with its plan, and where it starts.
pub struct Subject {
    pub oracle: Oracle,
    pub planned: Planned,
    pub start: Instant,
    /// ±1 for every mode, as the pose that the mechanism was drawn around has them.
    pub modes: Vec<f64>,
    pub name: String,
    /// What it was drawn from.
    pub seed: u64,
}

/// What was compared.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub compared: usize,
    pub skipped: usize,
    pub worst: [f64; 3],
}

/// The first of the mechanisms that `draft` makes of seeds from `seed` on which is calm where it starts.
pub fn subject(name: &str, seed: u64, draft: impl Fn(u64) -> Draft) -> Subject {
    for seed in (seed * 1000..).take(200) {
        let draft = draft(seed);
        let name = format!("{name}, seed {seed}: {}with {:?}", draft.mechanism, draft.values);
        assert_eq!(check(&draft.mechanism), [], "{name}");
        let oracle = Oracle::new(&draft.mechanism, &draft.values);
        let Some(start) = oracle.solve(0.0, &draft.q()) else { continue };
        if start.is_calm() {
            assert!(difference(&start.q, &draft.q()) < 1e-12, "{name}");
            let planned = Planned::new(&oracle);
            let closures = planned.closures(&oracle, 0.0, &start.q);
            assert!(closures.iter().all(|w| w.abs() > 1e-6 && w.abs() <= 1.0 + 1e-12), "{closures:?} of {name}");
            let modes = closures.iter().map(|w| w.signum()).collect();
            return Subject { oracle, planned, start, modes, name, seed };
        }
    }
    panic!("no mechanism of {name} is calm");
}

impl Subject {
    /// Compares at the start and at `instants` instants before and after it, `step` apart.
    pub fn compare(&self, instants: usize, step: f64, tally: &mut Tally) {
        self.compare_at(&self.start, &self.start.q, tally);
        for sense in [-1.0, 1.0] {
            let mut now = self.start.clone();
            for k in 1..=instants {
                let t = sense * step * k as f64;
                let Some(next) = self.oracle.follow(&now, t, STEP) else {
                    tally.skipped += instants + 1 - k;
                    break;
                };
                // Closed forms need to know the whole turns only; iterations start where the motion leads.
                let closed = self.planned.newton().is_empty();
                self.compare_at(&next, if closed { &now.q } else { &next.start }, tally);
                now = next;
            }
        }
    }

    fn compare_at(&self, expected: &Instant, start: &[f64], tally: &mut Tally) {
        let t = expected.t;
        let found = self.planned.run(&self.oracle, t, &self.modes, start);
        assert!(found.margins.iter().all(|m| *m > 0.0), "t = {t}, margins {:?} of {}", found.margins, self.name);
        let pairs = [
            ("q", &expected.q, &found.q),
            ("q_dot", &expected.q_dot, &found.q_dot),
            ("q_ddot", &expected.q_ddot, &found.q_ddot),
        ];
        for (worst, (what, expected, found)) in tally.worst.iter_mut().zip(pairs) {
            let off = difference(expected, found);
            assert!(off <= AGREEMENT, "t = {t}: {what} is off by {off:e}\n{expected:?}\n{found:?}\n{}", self.name);
            *worst = worst.max(off);
        }
        tally.compared += 1;
        // Any right side, of size 1.
        let b: Vec<f64> = (0..expected.q.len()).map(|k| (k as f64 + 7.0 * t).sin()).collect();
        let x = self.oracle.resolve(t, &expected.q, &b).expect("a regular Φ_q");
        let off = difference(&x, &self.planned.resolve(&self.oracle, t, &expected.q, &b));
        assert!(off <= AGREEMENT, "t = {t}: Φ_q x = b is off by {off:e} of {}", self.name);
        let closures = self.planned.closures(&self.oracle, t, &expected.q);
        let kept = closures.iter().zip(&self.modes).all(|(w, mode)| w * mode > 0.0);
        assert!(kept, "t = {t}: {closures:?} in modes {:?} of {}", self.modes, self.name);
    }

    /// Angles come out within half a turn of those of the start, and nothing else of it matters: the start is moved by
    /// whole turns of the bodies `turning`, and all else of it by anything. For plans without iterations.
    pub fn start_elsewhere(&self, turning: &[usize]) {
        let mut start = self.start.q.clone();
        start.iter_mut().enumerate().for_each(|(k, q)| *q += 1.5 * (k as f64).sin());
        let mut expected = self.start.q.clone();
        for (k, body) in turning.iter().enumerate() {
            let turns = TAU * [2.0, -1.0, 1.0][k % 3];
            let phi = 3 * (body - 1) + 2;
            start[phi] += turns;
            expected[phi] += turns;
        }
        let found = self.planned.run(&self.oracle, 0.0, &self.modes, &start);
        let off = difference(&expected, &found.q);
        assert!(off <= AGREEMENT, "off by {off:e}: {:?} of {}", found.q, self.name);
    }

    /// Turns each mode around, with all others as they are: another assembly of those modes, or no margin. Gives the
    /// numbers of both. `slack` says of a q, if anything, whether it closes.
    pub fn turn_around(&self, slack: impl Fn(&[f64]) -> Option<f64>) -> [usize; 2] {
        let mut out = [0, 0];
        for k in 0..self.modes.len() {
            let mut modes = self.modes.clone();
            modes[k] = -modes[k];
            let found = self.planned.run(&self.oracle, 0.0, &modes, &self.start.q);
            assert!(found.margins.iter().all(|m| !m.is_nan()), "{:?} of {}", found.margins, self.name);
            let closes = found.margins.iter().all(|m| *m > 0.0);
            if let Some(slack) = slack(&found.q) {
                assert_eq!(closes, slack > 0.0, "mode {k}: slack {slack:e}, {:?} of {}", found.margins, self.name);
            }
            if !closes {
                out[1] += 1;
                continue;
            }
            out[0] += 1;
            let residual = self.oracle.residual(0.0, &found.q);
            let size = found.q.iter().fold(1.0, |most: f64, e| most.max(e.abs()));
            assert!(residual <= 1e-11 * size * size, "mode {k}: Φ = {residual:e} at {:?} of {}", found.q, self.name);
            let closures = self.planned.closures(&self.oracle, 0.0, &found.q);
            let kept = closures.iter().zip(&modes).all(|(w, mode)| w * mode > 0.0);
            assert!(kept, "mode {k}: {closures:?} in modes {modes:?} of {}", self.name);
            assert!(difference(&self.start.q, &found.q) > 1e-6, "mode {k} changes nothing of {}", self.name);
        }
        out
    }
}
