//! Every simple-revolute chain of one degree of freedom with 4, 6 and 8 links, on every ground link, driven at every
//! joint of it: how many there are, what they decompose into, and their solution plans against a dense Newton iteration.

mod support;

use kin_core::diagnose;
use std::collections::BTreeMap;
use support::chains::*;

#[test]
fn there_are_as_many_chains_as_is_known() {
    // One four-bar; Watt's and Stephenson's chains; the sixteen with eight links.
    for (links, expected) in [(4, 1), (6, 2), (8, 16)] {
        let found = chains(links);
        assert_eq!(found.len(), expected, "{links} links");
        assert!(found.iter().all(Chain::is_sound));
        // Counted once more from the definition: n!/|Aut| labelled graphs belong to each.
        let orders: usize = (1..=links).product();
        let labelled: usize = found.iter().map(|chain| orders / chain.isomorphisms(chain).len()).sum();
        assert_eq!(labelled, labelled_chains(links), "{links} links");
    }
}

/// Cases, cases that differ, those of them that are dyads only, and the numbers of links of the groups of all.
#[test]
fn there_are_356_cases() {
    let expected = [
        (4, [8, 1, 8, 1], vec![(vec![2], 8)]),
        (6, [28, 9, 22, 6], vec![(vec![2, 2], 22), (vec![4], 6)]),
        (8, [320, 153, 150, 69], vec![(vec![2, 2, 2], 150), (vec![2, 4], 106), (vec![6], 64)]),
    ];
    for (links, counts, groups) in expected {
        let all = cases(links);
        let mut distinct: Vec<&Case> = Vec::new();
        for case in &all {
            if !distinct.iter().any(|known| known.is_like(case)) {
                distinct.push(case);
            }
        }
        let dyads = all.iter().filter(|case| case.is_dyad_only()).count();
        let distinct_dyads = distinct.iter().filter(|case| case.is_dyad_only()).count();
        assert_eq!([all.len(), distinct.len(), dyads, distinct_dyads], counts, "{links} links");
        let mut found = BTreeMap::<Vec<usize>, usize>::new();
        for case in &all {
            let mut sizes: Vec<usize> = case.groups().iter().map(Vec::len).collect();
            assert_eq!(case.is_dyad_only(), sizes.iter().all(|size| *size == 2), "{case}");
            sizes.sort_unstable();
            *found.entry(sizes).or_default() += 1;
        }
        assert_eq!(found, BTreeMap::from_iter(groups), "{links} links");
    }
    assert_eq!([4, 6, 8].map(|links| cases(links).len()).iter().sum::<usize>(), 356);
}

/// Every case with random dimensions.
fn subjects(links: usize) -> impl Iterator<Item = (Case, Subject)> {
    cases(links).into_iter().enumerate().map(|(seed, case)| {
        let subject = subject(&case.to_string(), seed as u64, |seed| linkage(&case, seed).draft);
        (case, subject)
    })
}

/// Compares all cases; gives the unknowns of iterations by the number of links of their group.
fn agrees(links: usize) -> BTreeMap<(usize, usize), usize> {
    let mut tallies = [Tally::default(); 2];
    let (mut turned, mut unknowns) = ([0, 0], BTreeMap::new());
    for (case, subject) in subjects(links) {
        let groups: Vec<usize> = case.groups().iter().map(Vec::len).collect();
        let large: Vec<usize> = groups.iter().copied().filter(|links| *links > 2).collect();
        let newton = subject.planned.newton();
        assert_eq!(newton.len(), large.len(), "{case}: {newton:?}");
        large.iter().zip(newton).for_each(|pair| *unknowns.entry((*pair.0, pair.1)).or_default() += 1);
        let dyads = groups.len() - large.len();
        assert_eq!(subject.planned.closed(), dyads, "{case}: {}", subject.planned.0);
        assert_eq!(subject.planned.0.modes.len(), dyads, "{case}: {}", subject.planned.0);
        subject.compare(3, 0.15, &mut tallies[usize::from(large.is_empty())]);
        let drawn = linkage(&case, subject.seed);
        if large.is_empty() {
            subject.start_elsewhere(&drawn.carried_along(&case));
        }
        let [closed, open] = subject.turn_around(|q| large.is_empty().then(|| drawn.slack(&case, q)));
        turned = [turned[0] + closed, turned[1] + open];
    }
    let [iterated, closed] = tallies;
    println!("{links} links, dyads only: {closed:?}");
    println!("{links} links, others: {iterated:?}, unknowns by links {unknowns:?}");
    println!("{links} links, turned around: {turned:?} assemble and do not");
    assert!(turned[0] > 3 * turned[1]);
    assert!(closed.compared > 2 * closed.skipped && iterated.compared >= iterated.skipped);
    unknowns
}

#[test]
fn four_links_agree_with_newton() {
    assert_eq!(agrees(4), BTreeMap::new());
}

#[test]
fn six_links_agree_with_newton() {
    // A triad is left with two angles.
    assert_eq!(agrees(6), BTreeMap::from([((4, 2), 6)]));
}

#[test]
fn eight_links_agree_with_newton() {
    let unknowns = agrees(8);
    assert_eq!(unknowns.get(&(4, 2)), Some(&106));
    let large = unknowns.iter().filter(|((links, _), _)| *links == 6);
    assert_eq!(large.clone().map(|(_, cases)| cases).sum::<usize>(), 64);
    assert!(large.clone().all(|((_, unknowns), _)| *unknowns <= 4), "{unknowns:?}");
    assert_eq!(unknowns.values().sum::<usize>(), 106 + 64);
}

/// Chains in which about every third joint slides, as far as they move as a chain does.
fn sliding(links: &[usize]) -> Tally {
    let (mut tally, mut drawn) = (Tally::default(), [0, 0]);
    for (number, case) in links.iter().flat_map(|&links| cases(links)).enumerate() {
        let of = |seed| driven_at(&case, [case.ground, case.driven], 30, seed).draft;
        let first = of(1000 * number as u64);
        let oracle = Oracle::new(&first.mechanism, &first.values);
        let regular = diagnose(&oracle.system).redundant.is_empty();
        let moves = regular && oracle.solve(0.0, &first.q()).is_some_and(|start| start.is_calm());
        drawn[usize::from(moves)] += 1;
        if moves {
            let subject = subject(&case.to_string(), number as u64, of);
            let groups = case.groups().iter().filter(|group| group.len() > 2).count();
            let newton = subject.planned.newton();
            assert!(newton.len() <= groups, "{newton:?} of {}{}", subject.planned.0, subject.name);
            subject.compare(2, 0.15, &mut tally);
            subject.turn_around(|_| None);
        }
    }
    println!("sliding, {links:?} links: {tally:?}, not drawn and drawn {drawn:?}");
    assert!(drawn[1] > 20);
    tally
}

#[test]
fn joints_may_slide() {
    let tally = sliding(&[4, 4, 4, 4, 6, 6, 6]);
    assert!(tally.compared > 2 * tally.skipped);
}

#[test]
fn joints_of_eight_links_may_slide() {
    let tally = sliding(&[4, 4, 4, 4, 6, 6, 6, 8]);
    assert!(tally.compared > 2 * tally.skipped);
}

#[test]
fn any_joint_may_be_driven() {
    let mut tally = Tally::default();
    let mut unknowns = BTreeMap::<Vec<usize>, usize>::new();
    for (seed, case) in [4, 6].into_iter().flat_map(cases).enumerate() {
        // Ground and chain are met once for every joint of the ground; one of them will do.
        if case.chain.neighbours(case.ground)[0] != case.driven {
            continue;
        }
        for &[a, b] in &case.chain.joints {
            if [a, b].contains(&case.ground) {
                continue;
            }
            let of = |seed| driven_at(&case, [a, b], 0, seed).draft;
            let subject = subject(&format!("{case}, driven between {a} and {b}"), seed as u64, of);
            subject.compare(2, 0.15, &mut tally);
            subject.turn_around(|_| None);
            *unknowns.entry(subject.planned.newton()).or_default() += 1;
        }
    }
    println!("driven anywhere: {tally:?}, unknowns {unknowns:?}");
    assert!(tally.compared > 2 * tally.skipped);
    // Not more than the dense system has angles.
    assert!(unknowns.keys().flatten().all(|unknowns| *unknowns <= 3));
}

#[test]
fn every_dyad_is_named_by_its_three_joints() {
    for (case, subject) in [4, 6, 8].into_iter().flat_map(subjects) {
        let dyads = case.groups().iter().filter(|group| group.len() == 2).count();
        assert_eq!(subject.planned.groups(), vec!["RRR"; dyads], "{}of {}", subject.planned.0, subject.name);
        let names = subject.planned.0.modes.iter().map(|mode| mode.name.split('-').count());
        assert_eq!(names.collect::<Vec<_>>(), vec![3; dyads], "{:?}", subject.planned.0.modes);
    }
}
