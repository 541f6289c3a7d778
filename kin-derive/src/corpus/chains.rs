//! Families: chains, lifts, and a fault in one of their members.

use super::Case;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "open chain",
        parameters: "l",
        attributes: "bodies(link[10])
            revolute(root: ground @ (0, 0), link[0] @ (0, 0)); revolute(pin[i in 0..9]: link[i] @ (l, 0), link[i + 1] @ (0, 0))",
        counts: [30, 20, 20, 10],
        fault: "",
    },
    Case {
        name: "chain closed to the ground, driven at eight of its pins",
        parameters: "l d",
        attributes: "bodies(link[10])
            revolute(root: ground @ (0, 0), link[0] @ (0, 0)); revolute(pin[i in 0..9]: link[i] @ (l, 0), link[i + 1] @ (0, 0))
            revolute(end: link[9] @ (l, 0), ground @ (d, 0)); driver(turn[i in 0..8]: link[i].phi = t)",
        counts: [30, 30, 30, 8],
        fault: "",
    },
    Case {
        name: "chain closed to the ground, driven at nine of its pins",
        parameters: "l d",
        attributes: "bodies(link[10])
            revolute(root: ground @ (0, 0), link[0] @ (0, 0)); revolute(pin[i in 0..9]: link[i] @ (l, 0), link[i + 1] @ (0, 0))
            revolute(end: link[9] @ (l, 0), ground @ (d, 0)); driver(turn[i in 0..9]: link[i].phi = t)",
        counts: [30, 31, 30, 8],
        fault: "turn",
    },
    Case {
        name: "chain with two of its pins said twice",
        parameters: "l",
        attributes: "bodies(link[10])
            revolute(root: ground @ (0, 0), link[0] @ (0, 0)); revolute(pin[i in 0..9]: link[i] @ (l, 0), link[i + 1] @ (0, 0))
            revolute(again[i in 3..5]: link[i] @ (l, 0), link[i + 1] @ (0, 0))",
        counts: [30, 24, 20, 10],
        fault: "again",
    },
    Case {
        name: "scissor lift",
        parameters: "l",
        attributes: "bodies(a[6], b[6])
            revolute(foot: ground @ (0, 0), a[0] @ (0, 0)); point_on_line(roller: ground @ (0, 0), b[0] @ (0, 0), axis = (1, 0))
            revolute(cross[i in 0..6]: a[i] @ (l/2, 0), b[i] @ (l/2, 0))
            revolute(left[i in 0..5]: b[i] @ (l, 0), a[i + 1] @ (0, 0)); revolute(right[i in 0..5]: a[i] @ (l, 0), b[i + 1] @ (0, 0))",
        counts: [36, 35, 35, 1],
        fault: "",
    },
    Case {
        name: "scissor lift with a second roller at the foot that is pinned",
        parameters: "l",
        attributes: "bodies(a[6], b[6])
            revolute(foot: ground @ (0, 0), a[0] @ (0, 0)); point_on_line(roller: ground @ (0, 0), b[0] @ (0, 0), axis = (1, 0))
            revolute(cross[i in 0..6]: a[i] @ (l/2, 0), b[i] @ (l/2, 0))
            revolute(left[i in 0..5]: b[i] @ (l, 0), a[i + 1] @ (0, 0)); revolute(right[i in 0..5]: a[i] @ (l, 0), b[i + 1] @ (0, 0))
            y(floor: a[0] @ (0, 0) = 0)",
        counts: [36, 36, 35, 1],
        fault: "floor",
    },
    Case {
        name: "row of four-bars",
        parameters: "a b c d",
        attributes: "bodies(p[8], q[8])
            revolute(O: ground @ (0, 0), p[0] @ (0, 0)); revolute(A[i in 0..8]: p[i] @ (a, 0), q[i] @ (0, 0))
            revolute(B[i in 0..7]: q[i] @ (b, 0), p[i + 1] @ (c, 0)); revolute(D[i in 0..7]: ground @ (d, 1), p[i + 1] @ (0, 0))
            driver(last: q[7].phi = 0.1*t)",
        counts: [48, 47, 47, 2],
        fault: "",
    },
    Case {
        name: "carried chain",
        parameters: "l",
        attributes: "body(root, x = 0, y = 0); body(next, origin = root @ (l, 0)); body(last, origin = next @ (l, 0))
            driver(a: root.phi = t); driver(b: next.phi = 2*t); x(wall: last @ (l, 0) = l)",
        counts: [3, 3, 3, 2],
        fault: "",
    },
    Case {
        name: "chain of thirty links with a pin said twice at its end",
        parameters: "l",
        attributes: "bodies(link[30]); revolute(root: ground @ (0, 0), link[0] @ (0, 0))
            revolute(pin[i in 0..29]: link[i] @ (l, 0), link[i + 1] @ (0, 0))
            revolute(again: link[28] @ (l, 0), link[29] @ (0, 0))
            driver(turn[i in 0..30]: link[i].phi = t)",
        counts: [90, 92, 90, 30],
        fault: "again",
    },
];
