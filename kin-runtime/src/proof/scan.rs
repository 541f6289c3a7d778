//! The intervals of t in which a plan closes.

use std::collections::VecDeque;

/// The result for a stretch of t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MarginSign {
    /// All margins are positive on all of it.
    Closed,
    /// This margin is negative on all of it.
    Open(usize),
    /// The sign of this margin, the first such one, is not known on all of it; the number of margins if those of all are
    /// known, and a coordinate has no enclosure.
    Unknown(usize),
}

/// A stretch of t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) seen: MarginSign,
}

/// The stretches from `from` to `to`, in order; neighbours with the same result are joined. A stretch with an unknown
/// result is halved until it is narrower than `narrowest`, the widest ones first, so that after `most` evaluations only
/// narrow ones are still unknown: where a margin touches 0, those are many.
pub(crate) fn stretches(
    [from, to]: [f64; 2],
    narrowest: f64,
    most: usize,
    look: &mut dyn FnMut(f64, f64) -> MarginSign,
) -> Vec<Stretch> {
    let (mut waiting, mut found): (VecDeque<(f64, f64)>, Vec<Stretch>) = (VecDeque::from([(from, to)]), Vec::new());
    let mut looked = 0;
    while let Some((from, to)) = waiting.pop_front() {
        looked += 1;
        let seen = look(from, to);
        let middle = 0.5 * from + 0.5 * to;
        let wide = to - from > narrowest && from < middle && middle < to;
        if matches!(seen, MarginSign::Unknown(_)) && wide && looked < most {
            waiting.extend([(from, middle), (middle, to)]);
            continue;
        }
        found.push(Stretch { from, to, seen });
    }
    found.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut known = Vec::new();
    found.into_iter().for_each(|stretch| push(&mut known, stretch));
    known
}

/// The same stretches; an unknown one between a closed and an open one is halved further. A known stretch between
/// unknown ones that is hardly wider than `narrowest` becomes unknown, because rounding decides there.
pub(crate) fn refined(
    stretches_found: &[Stretch],
    narrowest: [f64; 2],
    most: usize,
    look: &mut dyn FnMut(f64, f64) -> MarginSign,
) -> Vec<Stretch> {
    let [coarse, fine] = narrowest;
    let mut smooth: Vec<Stretch> = Vec::new();
    for (index, stretch) in stretches_found.iter().enumerate() {
        let beside = [index.checked_sub(1), Some(index + 1)].map(|k| stretches_found.get(k?).map(|beside| beside.seen));
        match beside {
            [Some(unknown @ MarginSign::Unknown(_)), Some(MarginSign::Unknown(_))]
                if stretch.to - stretch.from < 100.0 * coarse =>
            {
                push(&mut smooth, Stretch { seen: unknown, ..*stretch });
            }
            _ => push(&mut smooth, *stretch),
        }
    }
    let mut known = Vec::new();
    for (index, stretch) in smooth.iter().enumerate() {
        let beside = [index.checked_sub(1), Some(index + 1)].map(|k| smooth.get(k?).map(|beside| beside.seen));
        let is_limit = matches!(stretch.seen, MarginSign::Unknown(_))
            && matches!(
                beside,
                [Some(MarginSign::Closed), Some(MarginSign::Open(_))]
                    | [Some(MarginSign::Open(_)), Some(MarginSign::Closed)]
            );
        if is_limit {
            let inside = stretches([stretch.from, stretch.to], fine, most, look);
            inside.into_iter().for_each(|stretch| push(&mut known, stretch));
        } else {
            push(&mut known, *stretch);
        }
    }
    known
}

/// Appends a stretch, or extends the last one if the results are of the same kind. Of several negative margins in
/// joined stretches the first is kept.
fn push(known: &mut Vec<Stretch>, next: Stretch) {
    let kind = |seen: MarginSign| match seen {
        MarginSign::Closed => 0,
        MarginSign::Open(_) => 1,
        MarginSign::Unknown(_) => 2,
    };
    match known.last_mut() {
        Some(last) if kind(last.seen) == kind(next.seen) => last.to = next.to,
        _ => known.push(next),
    }
}

#[cfg(test)]
mod tests {
    use super::{MarginSign, Stretch, refined, stretches};

    #[test]
    fn signs_of_a_parabola_are_told_apart() {
        // 1/4 − t², with an enclosure that is too wide.
        let mut look = |from: f64, to: f64| {
            let (least, most) = if from < 0.0 && to > 0.0 {
                (0.0, from.abs().max(to))
            } else {
                (from.abs().min(to.abs()), from.abs().max(to.abs()))
            };
            let slack = 0.1 * (to - from);
            match (0.25 - most * most - slack > 0.0, 0.25 - least * least + slack < 0.0) {
                (true, _) => MarginSign::Closed,
                (_, true) => MarginSign::Open(3),
                _ => MarginSign::Unknown(3),
            }
        };
        let found = stretches([-1.0, 1.0], 1e-9, 10_000, &mut look);
        let kinds: Vec<MarginSign> = found.iter().map(|stretch| stretch.seen).collect();
        assert_eq!(
            kinds,
            [
                MarginSign::Open(3),
                MarginSign::Unknown(3),
                MarginSign::Closed,
                MarginSign::Unknown(3),
                MarginSign::Open(3)
            ]
        );
        let Stretch { from, to, .. } = found[3];
        assert!(from <= 0.5 && 0.5 <= to && to - from < 1e-8, "{from} {to}");
        let found = refined(&found, [1e-9, 1e-13], 1000, &mut look);
        let Stretch { from, to, .. } = found[3];
        assert!(found.len() == 5 && from <= 0.5 && 0.5 <= to && to - from < 1e-12, "{from} {to}");
        assert_eq!((found[0].from, found[4].to), (-1.0, 1.0));
    }

    /// (t − 1/3)², with an enclosure that is too wide, touches 0: with few evaluations, what is unknown is still narrow, and
    /// on both sides of it everything is known.
    #[test]
    fn a_margin_that_touches_zero_leaves_little_unknown() {
        let touch = 1.0 / 3.0;
        let mut look = |from: f64, to: f64| {
            let least = if from < touch && touch < to { 0.0 } else { (from - touch).abs().min((to - touch).abs()) };
            if least * least - 0.1 * (to - from) > 0.0 { MarginSign::Closed } else { MarginSign::Unknown(0) }
        };
        let found = stretches([0.0, 1.0], 1e-12, 2000, &mut look);
        let kinds: Vec<MarginSign> = found.iter().map(|stretch| stretch.seen).collect();
        assert_eq!(kinds, [MarginSign::Closed, MarginSign::Unknown(0), MarginSign::Closed]);
        let Stretch { from, to, .. } = found[1];
        assert!(from < touch && touch < to && to - from < 1e-2, "{from} {to}");
        assert_eq!((found[0].from, found[2].to), (0.0, 1.0));
    }
}
