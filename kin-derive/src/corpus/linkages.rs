//! Linkages with revolute joints, and bars as bodies or distances. Mobilities by counting independent loops.

use super::Case;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "four-bar",
        parameters: "a b c d",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "four-bar in the middle of its links, driven",
        parameters: "a b c d e w",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (-a/2, 0)); revolute(A: crank @ (a/2, 0), coupler @ (-b/2, 0))
            revolute(B: coupler @ (b/2, 0), rocker @ (-c/2, 0)); revolute(D: rocker @ (c/2, 0), ground @ (d, e))
            driver(drive: crank.phi = w*t)",
        counts: [9, 9, 9, 1],
        fault: "",
    },
    Case {
        name: "five-bar",
        parameters: "a b c d e",
        attributes: "bodies(p, q, r, s)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: p @ (a, 0), q @ (0, 0)); revolute(C: q @ (b, 0), r @ (0, 0))
            revolute(D: r @ (c, 0), s @ (0, 0)); revolute(E: s @ (d, 0), ground @ (e, 0))",
        counts: [12, 10, 10, 2],
        fault: "",
    },
    Case {
        name: "Watt I",
        parameters: "a b c d e f g h",
        attributes: "bodies(p, q, r, s, u)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: ground @ (d, 0), r @ (0, 0)); revolute(E: q @ (e, f), s @ (0, 0)); revolute(F: s @ (g, 0), u @ (0, 0))
            revolute(G: u @ (h, 0), r @ (c, e))",
        counts: [15, 14, 14, 1],
        fault: "",
    },
    Case {
        name: "Watt II",
        parameters: "a b c d e f g h",
        attributes: "bodies(p, q, r, s, u)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: ground @ (d, 0), r @ (0, 0)); revolute(E: r @ (e, f), s @ (0, 0)); revolute(F: s @ (g, 0), u @ (0, 0))
            revolute(G: u @ (h, 0), ground @ (d, e))",
        counts: [15, 14, 14, 1],
        fault: "",
    },
    Case {
        name: "Stephenson I",
        parameters: "a b c d e f g h",
        attributes: "bodies(p, q, r, s, u)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: ground @ (d, 0), r @ (0, 0)); revolute(E: p @ (e, f), s @ (0, 0)); revolute(F: s @ (g, 0), u @ (0, 0))
            revolute(G: u @ (h, 0), r @ (c, e))",
        counts: [15, 14, 14, 1],
        fault: "",
    },
    Case {
        name: "Stephenson II",
        parameters: "a b c d e f g h",
        attributes: "bodies(x, p, q, r, u)
            revolute(O: x @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: x @ (d, 0), r @ (0, 0)); revolute(E: q @ (e, f), ground @ (0, 0)); revolute(F: ground @ (g, 0), u @ (0, 0))
            revolute(G: u @ (h, 0), x @ (d, e))",
        counts: [15, 14, 14, 1],
        fault: "",
    },
    Case {
        name: "Stephenson III",
        parameters: "a b c d e f g h",
        attributes: "bodies(p, q, r, s, u)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: ground @ (d, 0), r @ (0, 0)); revolute(E: q @ (e, f), s @ (0, 0)); revolute(F: s @ (g, 0), u @ (0, 0))
            revolute(G: u @ (h, 0), ground @ (d, e))",
        counts: [15, 14, 14, 1],
        fault: "",
    },
    Case {
        name: "eight-bar of three loops, one after another",
        parameters: "a b c d e f g h",
        attributes: "bodies(p, q, r, s, u, v, w)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (c, 0))
            revolute(D: ground @ (d, 0), r @ (0, 0)); revolute(E: r @ (e, f), s @ (0, 0)); revolute(F: s @ (g, 0), u @ (h, 0))
            revolute(G: u @ (0, 0), ground @ (d, e)); revolute(H: u @ (f, g), v @ (0, 0)); revolute(I: v @ (a, 0), w @ (b, 0))
            revolute(J: w @ (0, 0), ground @ (e, f))",
        counts: [21, 20, 20, 1],
        fault: "",
    },
    Case {
        name: "double butterfly, an eight-bar without a four-bar loop",
        parameters: "a b c d e f g h",
        attributes: "bodies(t1, t2, t3, b1, b2, b3, b4)
            revolute(A: ground @ (0, 0), t1 @ (0, 0)); revolute(B: ground @ (a, 0), b1 @ (0, 0)); revolute(C: ground @ (a, b), b2 @ (0, 0))
            revolute(D: t1 @ (c, 0), t2 @ (0, 0)); revolute(E: t1 @ (c, d), b3 @ (0, 0)); revolute(F: t2 @ (e, 0), b1 @ (f, 0))
            revolute(G: t2 @ (e, g), b4 @ (0, 0)); revolute(H: t3 @ (0, 0), b2 @ (g, 0)); revolute(I: t3 @ (h, 0), b3 @ (a, 0))
            revolute(J: t3 @ (h, a), b4 @ (b, 0))",
        counts: [21, 20, 20, 1],
        fault: "",
    },
    Case {
        name: "Peaucellier's cell",
        parameters: "a b c",
        attributes: "bodies(crank, p, q, r, s, u, v)
            revolute(O: ground @ (0, 0), u @ (0, 0)); revolute(P: ground @ (0, 0), v @ (0, 0)); revolute(C: ground @ (c, 0), crank @ (0, 0))
            revolute(A1: u @ (a, 0), p @ (0, 0)); revolute(A2: u @ (a, 0), q @ (0, 0))
            revolute(B1: v @ (a, 0), r @ (0, 0)); revolute(B2: v @ (a, 0), s @ (0, 0))
            revolute(D1: p @ (b, 0), r @ (b, 0)); revolute(D2: crank @ (c, 0), p @ (b, 0))
            revolute(E: q @ (b, 0), s @ (b, 0))",
        counts: [21, 20, 20, 1],
        fault: "",
    },
    Case {
        name: "pantograph",
        parameters: "a b c",
        attributes: "bodies(p, q, r, s)
            revolute(O: ground @ (0, 0), p @ (0, 0)); revolute(A: p @ (a, 0), q @ (0, 0)); revolute(B: q @ (b, 0), r @ (0, 0))
            revolute(C: r @ (a, 0), s @ (0, 0)); revolute(D: s @ (b, 0), p @ (c, 0)); point(pen = q @ (c, 0))",
        counts: [12, 10, 10, 2],
        fault: "",
    },
    Case {
        name: "planar 3-RRR robot",
        parameters: "a b c d e f",
        attributes: "bodies(platform, p[3], q[3])
            revolute(A: ground @ (0, 0), p[0] @ (0, 0)); revolute(B: ground @ (a, 0), p[1] @ (0, 0)); revolute(C: ground @ (b, c), p[2] @ (0, 0))
            revolute(K[i in 0..3]: p[i] @ (d, 0), q[i] @ (0, 0))
            revolute(D: q[0] @ (e, 0), platform @ (0, 0)); revolute(E: q[1] @ (e, 0), platform @ (f, 0)); revolute(F: q[2] @ (e, 0), platform @ (f, d))",
        counts: [21, 18, 18, 3],
        fault: "",
    },
    Case {
        name: "triangle: a structure",
        parameters: "a b c",
        attributes: "bodies(p, q)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: p @ (a, 0), q @ (0, 0)); revolute(C: q @ (b, 0), ground @ (c, 0))",
        counts: [6, 6, 6, 0],
        fault: "",
    },
    Case {
        name: "four-bar with a massless coupler",
        parameters: "a b c d",
        attributes: "bodies(crank, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))
            distance(coupler: crank @ (a, 0), rocker @ (c, 0), length = b)",
        counts: [6, 5, 5, 1],
        fault: "",
    },
    Case {
        name: "four-bar by the global method",
        parameters: "a b c d",
        attributes: "coordinates(u, v, w)
            constraint(close_x: a*cos(u) + b*cos(v) + c*cos(w) = d); constraint(close_y: a*sin(u) + b*sin(v) + c*sin(w) = 0)",
        counts: [3, 2, 2, 1],
        fault: "",
    },
    Case {
        name: "six-bar by the global method",
        parameters: "a b c d e f",
        attributes: "coordinates(u, v, w, p, q)
            constraint(x1: a*cos(u) + b*cos(v) - c*cos(w) = d); constraint(y1: a*sin(u) + b*sin(v) - c*sin(w) = 0)
            constraint(x2: c*cos(w) + e*cos(p) - f*cos(q) = a); constraint(y2: c*sin(w) + e*sin(p) - f*sin(q) = b)
            driver(drive: u = t)",
        counts: [5, 5, 5, 1],
        fault: "",
    },
    Case {
        name: "four-bar with held and carried origins",
        parameters: "a b c d",
        attributes: "body(crank, x = 0, y = 0); body(coupler, origin = crank @ (a, 0)); body(rocker, origin = coupler @ (b, 0))
            revolute(D: rocker @ (c, 0), ground @ (d, 0))",
        counts: [3, 2, 2, 1],
        fault: "",
    },
    Case {
        name: "parallelogram with a fifth bar: movable only because of its lengths",
        parameters: "a b c",
        attributes: "bodies(p, q, r, table)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: ground @ (b, 0), q @ (0, 0)); revolute(C: ground @ (c, 0), r @ (0, 0))
            revolute(D: table @ (0, 0), p @ (a, 0)); revolute(E: table @ (b, 0), q @ (a, 0)); revolute(F: table @ (c, 0), r @ (a, 0))",
        counts: [12, 12, 12, 0],
        fault: "",
    },
    Case {
        name: "parallelogram whose table is held parallel",
        parameters: "a b",
        attributes: "bodies(p, q); body(table, phi = 0)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: ground @ (b, 0), q @ (0, 0))
            revolute(D: table @ (0, 0), p @ (a, 0)); revolute(E: table @ (b, 0), q @ (a, 0))",
        counts: [8, 8, 8, 0],
        fault: "",
    },
    Case {
        name: "parallelogram with one angle said more",
        parameters: "a b c d",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))
            relative_angle(parallel: crank, rocker = 0)",
        counts: [9, 9, 9, 0],
        fault: "",
    },
];
