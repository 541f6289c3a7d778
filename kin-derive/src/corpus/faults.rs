//! Planted faults: joints that are declared twice, frames with one bar too many, and welds in a circle.

use super::{Case, diagnosed};
use proc_macro2::TokenStream;
use std::str::FromStr;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "a revolute joint declared twice",
        parameters: "a b c d",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))
            revolute(again: coupler @ (b, 0), rocker @ (c, 0))",
        counts: [9, 10, 8, 1],
        fault: "again",
    },
    Case {
        name: "a revolute joint declared twice, the other way round",
        parameters: "a b c d",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0)); revolute(again: crank @ (0, 0), ground @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))",
        counts: [9, 10, 8, 1],
        fault: "again",
    },
    Case {
        name: "a four-bar on a frame that an input pitches, driven twice",
        parameters: "a b c d",
        attributes: "input(pitch); body(frame, x = 0, y = 0, phi = pitch); bodies(crank, coupler, rocker)
            revolute(O: frame @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: frame @ (d, 0), rocker @ (0, 0))
            driver(turn: crank.phi = t); driver(push: rocker.phi = 2 * t)",
        counts: [9, 10, 9, 1],
        fault: "push",
    },
    Case {
        name: "three bodies on one pin, joined all round",
        parameters: "a b c",
        attributes: "bodies(p, q, r)
            revolute(A: p @ (a, 0), q @ (b, 0)); revolute(B: q @ (b, 0), r @ (c, 0)); revolute(C: r @ (c, 0), p @ (a, 0))",
        counts: [9, 6, 4, 5],
        fault: "A B C",
    },
    Case {
        name: "a door with two hinges",
        parameters: "a b",
        attributes: "bodies(frame, door)
            revolute(O: ground @ (0, 0), frame @ (0, 0)); revolute(upper: frame @ (a, 0), door @ (0, 0)); revolute(lower: frame @ (b, 0), door @ (a, b))",
        counts: [6, 6, 5, 1],
        fault: "upper lower",
    },
    Case {
        name: "a frame with both diagonals, hidden behind a free chain",
        parameters: "a b c d e f",
        attributes: "bodies(p, q, r, s, free, swing)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (0, 0))
            revolute(C: r @ (c, 0), s @ (0, 0)); revolute(D: s @ (d, 0), p @ (0, 0))
            distance(rising: p @ (0, 0), r @ (0, 0), length = e); distance(falling: p @ (a, 0), s @ (0, 0), length = f)
            revolute(E: ground @ (e, 0), free @ (0, 0)); revolute(F: free @ (a, 0), swing @ (0, 0))",
        counts: [18, 16, 15, 3],
        fault: "rising falling",
    },
    Case {
        name: "a frame with one diagonal",
        parameters: "a b c d e",
        attributes: "bodies(p, q, r, s)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (0, 0))
            revolute(C: r @ (c, 0), s @ (0, 0)); revolute(D: s @ (d, 0), p @ (0, 0)); distance(rising: p @ (0, 0), r @ (0, 0), length = e)",
        counts: [12, 11, 11, 1],
        fault: "",
    },
    Case {
        name: "four points and all their distances",
        parameters: "a b c d e f",
        attributes: "body(p, phi = 0); body(q, phi = 0); body(r, phi = 0); body(s, phi = 0)
            distance(A: p @ (0, 0), q @ (0, 0), length = a); distance(B: q @ (0, 0), r @ (0, 0), length = b)
            distance(C: r @ (0, 0), s @ (0, 0), length = c); distance(D: s @ (0, 0), p @ (0, 0), length = d)
            distance(E: p @ (0, 0), r @ (0, 0), length = e); distance(F: q @ (0, 0), s @ (0, 0), length = f)",
        counts: [8, 6, 5, 3],
        fault: "A B C D E F",
    },
    Case {
        name: "a bar declared twice",
        parameters: "a b c d",
        attributes: "bodies(crank, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))
            distance(coupler: crank @ (a, 0), rocker @ (c, 0), length = b); distance(again: rocker @ (c, 0), crank @ (a, 0), length = d)",
        counts: [6, 6, 5, 1],
        fault: "again",
    },
    Case {
        name: "two braces on one corner",
        parameters: "a b c d",
        attributes: "bodies(post, beam)
            revolute(O: ground @ (0, 0), post @ (0, 0)); revolute(A: post @ (a, 0), beam @ (0, 0))
            distance(short: post @ (b, 0), beam @ (b, 0), length = c); distance(long: post @ (c, 0), beam @ (c, 0), length = d)",
        counts: [6, 6, 5, 1],
        fault: "short long",
    },
    Case {
        name: "four bars to the ground",
        parameters: "a b c d",
        attributes: "bodies(table)
            distance(A: ground @ (0, 0), table @ (0, 0), length = a); distance(B: ground @ (1, 0), table @ (b, 0), length = b)
            distance(C: ground @ (2, 0), table @ (c, 0), length = c); distance(D: ground @ (3, 1), table @ (d, 0), length = d)",
        counts: [3, 4, 3, 0],
        fault: "A B C D",
    },
    Case {
        name: "three parallel bars to the ground: singular only because of its lengths",
        parameters: "a",
        attributes: "bodies(table)
            distance(A: ground @ (0, 0), table @ (0, 0), length = a); distance(B: ground @ (1, 0), table @ (1, 0), length = a)
            distance(C: ground @ (2, 0), table @ (2, 0), length = a)",
        counts: [3, 3, 3, 0],
        fault: "",
    },
    Case {
        name: "a weld declared twice",
        parameters: "a b c",
        attributes: "bodies(p, q)
            revolute(O: ground @ (0, 0), p @ (0, 0)); fixed(weld: p @ (a, 0), q @ (0, 0)); fixed(again: p @ (b, 0), q @ (c, 0), angle = c)",
        counts: [6, 8, 5, 1],
        fault: "again",
    },
    Case {
        name: "three bodies welded all round",
        parameters: "a b c",
        attributes: "bodies(p, q, r)
            fixed(A: p @ (a, 0), q @ (0, 0)); fixed(B: q @ (b, 0), r @ (0, 0)); fixed(C: r @ (c, 0), p @ (0, 0))",
        counts: [9, 9, 6, 3],
        fault: "A B C",
    },
    Case {
        name: "two welds and a pin in a loop",
        parameters: "a b c",
        attributes: "bodies(p, q, r)
            fixed(A: p @ (a, 0), q @ (0, 0)); fixed(B: q @ (b, 0), r @ (0, 0)); revolute(C: r @ (c, 0), p @ (0, 0))",
        counts: [9, 8, 6, 3],
        fault: "C",
    },
    Case {
        name: "a line through the point that is pinned",
        parameters: "a b",
        attributes: "bodies(crank)
            revolute(O: ground @ (0, 0), crank @ (a, 0)); point_on_line(rail: ground @ (0, b), crank @ (a, 0), axis = (2, 1))",
        counts: [3, 3, 2, 1],
        fault: "rail",
    },
    Case {
        name: "a bar from the pivot to a point that keeps that distance anyway",
        parameters: "a",
        attributes: "bodies(arm); body(crank, x = 0, y = 0)
            revolute(A: crank @ (a, 0), arm @ (0, 0)); distance(bar: ground @ (0, 0), crank @ (a, 0), length = a)",
        counts: [4, 3, 2, 2],
        fault: "bar",
    },
    Case {
        name: "a pin at the origin that is carried already",
        parameters: "a b c d",
        attributes: "body(crank, x = 0, y = 0); body(coupler, origin = crank @ (a, 0)); body(rocker, origin = coupler @ (b, 0))
            revolute(D: rocker @ (c, 0), ground @ (d, 0)); revolute(again: coupler @ (0, 0), crank @ (a, 0))",
        counts: [3, 4, 2, 1],
        fault: "again",
    },
    Case {
        name: "x said by a point on a line and by itself",
        parameters: "a",
        attributes: "bodies(block)
            point_on_line(wall: ground @ (1, 0), block @ (a, 0), axis = (0, 1)); x(again: block @ (a, 0) = 2); y(up: block @ (a, 0) = t)",
        counts: [3, 3, 2, 2],
        fault: "wall again",
    },
    Case {
        name: "a closure of the global method written twice",
        parameters: "a b c d",
        attributes: "coordinates(u, v, w)
            constraint(close_x: a*cos(u) + b*cos(v) + c*cos(w) = d); constraint(close_y: a*sin(u) + b*sin(v) + c*sin(w) = 0)
            constraint(again: 2*(a*cos(u) + b*cos(v) + c*cos(w)) = 2*d)",
        counts: [3, 3, 2, 1],
        fault: "close_x again",
    },
    Case {
        name: "two loops of the global method and their sum",
        parameters: "a b c d e",
        attributes: "coordinates(u, v, w, p)
            constraint(one: a*cos(u) + b*cos(v) = c); constraint(two: d*cos(w) + e*cos(p) = a)
            constraint(both: a*cos(u) + b*cos(v) + d*cos(w) + e*cos(p) = c + a)",
        counts: [4, 3, 2, 2],
        fault: "one two both",
    },
];

/// The errors for a crank with one additional row.
fn said(row: &str) -> Vec<String> {
    let item = format!(
        "#[bodies(crank, arm[2])] #[revolute(O: ground @ (0, 0), crank @ (0, 0))] \
         #[revolute(P[i in 0..2]: crank @ (1, 0), arm[i] @ (0, 0))] {row} struct Crank;"
    );
    diagnosed(TokenStream::from_str(&item).unwrap()).messages()
}

/// A row whose two sides are equal is reported as empty, and not as redundant to other rows.
#[test]
fn a_row_with_the_same_on_both_sides_is_told_so() {
    let rows = [
        "#[driver(d: crank.phi = crank.phi)]",
        "#[driver(d: crank.phi - crank.x = crank.phi - crank.x)]",
        "#[constraint(d: 2 * crank.phi = crank.phi * 2)]",
    ];
    for row in rows {
        let said = said(row);
        assert_eq!(said.len(), 1, "{row}: {said:?}");
        assert!(said[0].starts_with("`d` constrains nothing: both sides of it are the same;"), "{row}: {said:?}");
    }
    let members = said("#[driver(d[i in 0..2]: arm[i].phi = arm[i].phi)]");
    assert!(
        members[0].starts_with("`d[0]` and `d[1]` constrain nothing: both sides of each are the same;"),
        "{members:?}"
    );
    // The sides differ, but their difference depends on no coordinate.
    let timed = said("#[driver(d: crank.phi = crank.phi + t)]");
    assert!(timed[0].starts_with("`d` constrains nothing: its residual does not depend"), "{timed:?}");
    // Members of a family that repeat one another are still reported as redundant.
    let family = said("#[driver(d[i in 0..2]: crank.phi = t + i)]");
    assert!(family[0].contains("`d[1]` prescribes what `d[0]` already determines"), "{family:?}");
}

/// Held coordinates are named among the causes.
#[test]
fn held_coordinates_are_named() {
    let said = |item: &str| diagnosed(TokenStream::from_str(item).unwrap()).messages().concat();
    let driven = said(
        "#[body(a, x = 0, y = 0, phi = t)] #[bodies(b)] #[revolute(P: a @ (1, 0), b @ (0, 0))] #[driver(e: b.x = t)] struct S;",
    );
    assert!(driven.ends_with("; the held coordinates `a.x`, `a.y` and `a.phi` count as prescribed"), "{driven}");
    let by_itself = said(
        "#[body(a[2], phi = 1)] #[body(b, phi = 2)] #[x(X: a[0] @ (0, 0) = t)] \
         #[translational(T: a[1] @ (0, 0), b @ (0, 0), axis = (1, 0))] struct S;",
    );
    assert!(by_itself.contains("because of the held coordinates `a[1].phi` and `b.phi` it is"), "{by_itself}");
}
