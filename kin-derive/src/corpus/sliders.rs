//! Sliders, slots and wedges.

use super::Case;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "a block in a vertical slot, whose angle is a right angle up to rounding, beside a wall",
        parameters: "a",
        attributes: "body(frame, x = 0, y = 0, phi = 5*pi/6 - pi/3); body(block, phi = 0)
            point_on_line(slot: frame @ (0, 0), block @ (0, 0), axis = (1, 0)); x(wall: block @ (0, 0) = a)",
        counts: [2, 2, 1, 1],
        fault: "slot wall",
    },
    Case {
        name: "slider-crank",
        parameters: "a b",
        attributes: "bodies(crank, rod, slider)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), rod @ (0, 0)); revolute(B: rod @ (b, 0), slider @ (0, 0))
            translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0)); driver(drive: crank.phi = t)",
        counts: [9, 9, 9, 1],
        fault: "",
    },
    Case {
        name: "slider-crank with a held slider",
        parameters: "a b",
        attributes: "bodies(crank, rod); body(slider, y = 0, phi = 0)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), rod @ (0, 0)); revolute(B: rod @ (b, 0), slider @ (0, 0))",
        counts: [7, 6, 6, 1],
        fault: "",
    },
    Case {
        name: "oscillating cylinder, the slider-crank's first inversion",
        parameters: "a d",
        attributes: "bodies(crank, rod, cylinder)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), rod @ (0, 0)); revolute(C: ground @ (d, 0), cylinder @ (0, 0))
            translational(bore: cylinder @ (0, 0), rod @ (0, 0), axis = (1, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "quick return with a block",
        parameters: "a d",
        attributes: "bodies(crank, block, arm)
            revolute(O: ground @ (0, d), crank @ (0, 0)); revolute(A: crank @ (a, 0), block @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0))
            translational(slot: arm @ (0, 0), block @ (0, 0), axis = (1, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "pump with the slider fixed, the slider-crank's third inversion",
        parameters: "a b",
        attributes: "bodies(handle, rod, plunger)
            translational(bore: ground @ (0, 0), plunger @ (0, 0), axis = (0, 1)); revolute(A: plunger @ (0, 0), handle @ (0, 0))
            revolute(B: handle @ (a, 0), rod @ (0, 0)); revolute(C: rod @ (b, 0), ground @ (b, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "Scotch yoke",
        parameters: "r",
        attributes: "bodies(crank, yoke)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); point_on_line(slot: yoke @ (0, 0), crank @ (r, 0), axis = (0, 1))
            translational(guide: ground @ (0, 0), yoke @ (0, 0), axis = (1, 0))",
        counts: [6, 5, 5, 1],
        fault: "",
    },
    Case {
        name: "Scotch yoke with a block",
        parameters: "r",
        attributes: "bodies(crank, block, yoke)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (r, 0), block @ (0, 0))
            translational(slot: yoke @ (0, 0), block @ (0, 0), axis = (0, 1))
            translational(guide: ground @ (0, 0), yoke @ (0, 0), axis = (1, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "elliptic trammel",
        parameters: "a",
        attributes: "bodies(bar); point_on_line(A: ground @ (0, 0), bar @ (0, 0), axis = (1, 0))
            point_on_line(B: ground @ (0, 0), bar @ (a, 0), axis = (0, 1))",
        counts: [3, 2, 2, 1],
        fault: "",
    },
    Case {
        name: "elliptic trammel with blocks",
        parameters: "a",
        attributes: "bodies(bar, p, q)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0)); translational(B: ground @ (0, 0), q @ (0, 0), axis = (0, 1))
            revolute(C: bar @ (0, 0), p @ (0, 0)); revolute(D: bar @ (a, 0), q @ (0, 0))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "Oldham coupling",
        parameters: "d",
        attributes: "bodies(disc, cross, other)
            revolute(O: ground @ (0, 0), disc @ (0, 0)); revolute(P: ground @ (d, 0), other @ (0, 0))
            translational(A: disc @ (0, 0), cross @ (0, 0), axis = (1, 0)); translational(B: other @ (0, 0), cross @ (0, 0), axis = (0, 1))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "wedges: three sliders in a loop, where Grübler's count is wrong",
        parameters: "",
        attributes: "bodies(p, q)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0)); translational(B: p @ (0, 0), q @ (0, 0), axis = (3, 4))
            translational(C: ground @ (1, 0), q @ (0, 0), axis = (0, 1))",
        counts: [6, 6, 5, 1],
        fault: "A B C",
    },
    Case {
        name: "wedges at angles that are parameters",
        parameters: "a b c d alpha beta",
        attributes: "bodies(p, q)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0), angle = alpha); translational(B: p @ (0, 0), q @ (0, 0), axis = (a, b), angle = beta)
            translational(C: ground @ (1, 0), q @ (0, 0), axis = (c, d), angle = alpha + beta)",
        counts: [6, 6, 5, 1],
        fault: "A B C",
    },
    Case {
        name: "wedges whose last angle is left to the others",
        parameters: "",
        attributes: "bodies(p, q)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0)); translational(B: p @ (0, 0), q @ (0, 0), axis = (3, 4))
            point_on_line(C: ground @ (1, 0), q @ (0, 0), axis = (0, 1))",
        counts: [6, 5, 5, 1],
        fault: "",
    },
    Case {
        name: "wedges that all slide the same way",
        parameters: "a b",
        attributes: "bodies(p, q)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0)); translational(B: p @ (0, 0), q @ (0, a), axis = (2, 0))
            translational(C: ground @ (1, b), q @ (0, 0), axis = (-1, 0))",
        counts: [6, 6, 4, 2],
        fault: "A B C",
    },
    Case {
        name: "four sliders in a loop",
        parameters: "a b c d",
        attributes: "bodies(p, q, r)
            translational(A: ground @ (0, 0), p @ (0, 0), axis = (1, 0)); translational(B: p @ (0, 0), q @ (0, 0), axis = (a, b))
            translational(C: q @ (0, 0), r @ (0, 0), axis = (c, d)); translational(D: ground @ (1, 0), r @ (0, 0), axis = (0, 1))",
        counts: [9, 8, 7, 2],
        fault: "A B C D",
    },
    Case {
        name: "three sliders and a pin in a loop",
        parameters: "a",
        attributes: "bodies(p, q, r)
            revolute(A: ground @ (0, 0), p @ (0, 0)); translational(B: p @ (0, 0), q @ (0, 0), axis = (1, 1))
            translational(C: q @ (0, 0), r @ (0, 0), axis = (1, 2)); translational(D: ground @ (1, 0), r @ (a, 0), axis = (0, 1))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "two sliders and two pins in a loop",
        parameters: "a b",
        attributes: "bodies(p, q, r)
            revolute(A: ground @ (0, 0), p @ (0, 0)); translational(B: p @ (0, 0), q @ (0, 0), axis = (0, 1))
            revolute(C: q @ (a, 0), r @ (0, 0)); translational(D: ground @ (1, 0), r @ (b, 0), axis = (0, 1))",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "two parallel guides",
        parameters: "h",
        attributes: "bodies(table)
            translational(lower: ground @ (0, 0), table @ (0, 0), axis = (1, 0)); translational(upper: ground @ (0, h), table @ (0, h), axis = (1, 0))",
        counts: [3, 4, 2, 1],
        fault: "upper",
    },
    Case {
        name: "two guides along one parameter",
        parameters: "h a b",
        attributes: "bodies(table)
            translational(lower: ground @ (0, 0), table @ (0, 0), axis = (a, b)); translational(upper: ground @ (0, h), table @ (0, h), axis = (a, b))",
        counts: [3, 4, 2, 1],
        fault: "upper",
    },
    Case {
        name: "two guides across each other",
        parameters: "h",
        attributes: "bodies(table)
            translational(lower: ground @ (0, 0), table @ (0, 0), axis = (1, 0)); translational(upper: ground @ (0, h), table @ (0, h), axis = (0, 1))",
        counts: [3, 4, 3, 0],
        fault: "upper",
    },
    Case {
        name: "a rod in two parallel bores of a body that turns",
        parameters: "h a",
        attributes: "bodies(housing, rod)
            revolute(O: ground @ (0, 0), housing @ (0, 0)); point_on_line(front: housing @ (0, h), rod @ (0, 0), axis = (3, 4))
            point_on_line(back: housing @ (0, h), rod @ (a, 0), axis = (6, 8))",
        counts: [6, 4, 4, 2],
        fault: "",
    },
    Case {
        name: "three rollers on one rail",
        parameters: "a b",
        attributes: "bodies(trolley)
            point_on_line(A: ground @ (0, 0), trolley @ (0, 0), axis = (1, 0)); point_on_line(B: ground @ (0, 0), trolley @ (a, 0), axis = (1, 0))
            point_on_line(C: ground @ (0, 0), trolley @ (b, 0), axis = (1, 0))",
        counts: [3, 3, 2, 1],
        fault: "C",
    },
];
