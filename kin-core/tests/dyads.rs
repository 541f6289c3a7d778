//! Dyads of every kind, one after another, also with links without mass: no plan iterates, and all agree with a dense
//! Newton iteration.

mod support;

use support::chains::*;

/// Thirty mechanisms or more that begin with a dyad of the kind, in every way of writing it.
fn drawn(kind: Kind) -> impl Iterator<Item = (Subject, Dyads)> {
    (0..kind.writings()).flat_map(move |writing| {
        (0..15).map(move |seed| {
            let count = 1 + seed % 3;
            let of = move |seed| dyads(kind, writing, count, seed);
            let name = format!("{count} dyads, the first {} written as {writing}", kind.letters());
            let subject = subject(&name, (seed + 100 * writing) as u64, |seed| of(seed).draft);
            let drawn = of(subject.seed);
            (subject, drawn)
        })
    })
}

fn agrees(kind: Kind) {
    let (mut tally, mut turned) = (Tally::default(), [0, 0]);
    for (subject, dyads) in drawn(kind) {
        let plan = &subject.planned.0;
        assert_eq!(subject.planned.newton(), [], "{plan}{}", subject.name);
        let two = dyads.kinds.iter().filter(|kind| kind.closures() == 2).count();
        assert_eq!([plan.modes.len(), subject.planned.closed()], [two; 2], "{plan}{}", subject.name);
        subject.compare(4, 0.15, &mut tally);
        let [closed, open] = subject.turn_around(|_| None);
        turned = [turned[0] + closed, turned[1] + open];
    }
    println!("{}: {tally:?}, turned around: {turned:?} assemble and do not", kind.letters());
    assert!(tally.compared > 2 * tally.skipped && turned[0] > 3 * turned[1]);
}

#[test]
fn rrr() {
    agrees(Kind::Rrr);
}

#[test]
fn rrp() {
    agrees(Kind::Rrp);
}

#[test]
fn rpr() {
    agrees(Kind::Rpr);
}

#[test]
fn prp() {
    agrees(Kind::Prp);
}

#[test]
fn rpp() {
    agrees(Kind::Rpp);
}

#[test]
fn every_dyad_has_its_letters() {
    for kind in Kind::ALL {
        for (subject, dyads) in drawn(kind) {
            let mut expected: Vec<&str> = dyads.kinds.iter().map(|kind| kind.letters()).collect();
            let mut found = subject.planned.groups();
            expected.sort_unstable();
            found.sort_unstable();
            // A dyad without two closures may be explicit row by row, and then it is no step of its own.
            for letters in ["PRP", "RPP"] {
                let of = |list: &[&str]| list.iter().filter(|own| **own == letters).count();
                assert!(of(&found) <= of(&expected), "{letters}: {}{}", subject.planned.0, subject.name);
            }
            let has_mode = |letters: &&str| !matches!(*letters, "PRP" | "RPP");
            found.retain(has_mode);
            expected.retain(has_mode);
            assert_eq!(found, expected, "{}{}", subject.planned.0, subject.name);
        }
    }
}
