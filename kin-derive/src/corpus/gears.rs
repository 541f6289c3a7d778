//! Gears, belts, racks and rolling discs.

use super::Case;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "planetary gear with a ring that turns",
        parameters: "rs rp",
        attributes: "bodies(sun, arm, ring, p)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0))
            revolute(R: ground @ (0, 0), ring @ (0, 0)); revolute(P: arm @ (rs + rp, 0), p @ (0, 0))
            gear(sp: sun, p, radii = (rs, rp), carrier = arm); gear(pr: p, ring, radii = (rp, -rs - 2*rp), carrier = arm)",
        counts: [12, 10, 10, 2],
        fault: "",
    },
    Case {
        name: "planetary gear with two planets that mesh with everything",
        parameters: "rs rp",
        attributes: "bodies(sun, arm, ring, p, q)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0))
            revolute(R: ground @ (0, 0), ring @ (0, 0))
            revolute(P: arm @ (rs + rp, 0), p @ (0, 0)); revolute(Q: arm @ (-rs - rp, 0), q @ (0, 0))
            gear(sp: sun, p, radii = (rs, rp), carrier = arm); gear(pr: p, ring, radii = (rp, -rs - 2*rp), carrier = arm)
            gear(sq: sun, q, radii = (rs, rp), carrier = arm); gear(qr: q, ring, radii = (rp, -rs - 2*rp), carrier = arm)",
        counts: [15, 14, 13, 2],
        fault: "sp pr sq qr",
    },
    Case {
        name: "three gears in a circle lock",
        parameters: "ra rb rc",
        attributes: "body(a, x = 0, y = 0); body(b, x = 1, y = 0); body(c, x = 0, y = 1)
            gear(ab: a, b, radii = (ra, rb), offset = 1); gear(bc: b, c, radii = (rb, rc), offset = 1)
            gear(ca: c, a, radii = (rc, ra), offset = 1)",
        counts: [3, 3, 3, 0],
        fault: "",
    },
    Case {
        name: "gears with computed radii beside a belt: 0.7*0.1 is 0.07 up to rounding",
        parameters: "",
        attributes: "body(a, x = 0, y = 0); body(b, x = 1, y = 0); body(c, x = 2, y = 0)
            gear(ab: a, b, radii = (0.07, 0.3)); gear(bc: b, c, radii = (0.3, 0.1)); belt(ac: a, c, radii = (0.7*0.1, 0.1))",
        counts: [3, 3, 2, 1],
        fault: "ab bc ac",
    },
    Case {
        name: "four gears in a circle turn, and one mesh says what the others say",
        parameters: "ra rb rc rd",
        attributes: "body(a, x = 0, y = 0); body(b, x = 1, y = 0); body(c, x = 1, y = 1); body(d, x = 0, y = 1)
            gear(ab: a, b, radii = (ra, rb)); gear(bc: b, c, radii = (rb, rc))
            gear(cd: c, d, radii = (rc, rd)); gear(da: d, a, radii = (rd, ra))",
        counts: [4, 4, 3, 1],
        fault: "ab bc cd da",
    },
    Case {
        name: "three pulleys with belts around each two",
        parameters: "ra rb rc",
        attributes: "body(a, x = 0, y = 0); body(b, x = 1, y = 0); body(c, x = 0, y = 1)
            belt(ab: a, b, radii = (ra, rb)); belt(bc: b, c, radii = (rb, rc)); belt(ca: c, a, radii = (rc, ra))",
        counts: [3, 3, 2, 1],
        fault: "ab bc ca",
    },
    Case {
        name: "two racks on one pinion",
        parameters: "r",
        attributes: "bodies(wheel, low, high)
            revolute(O: ground @ (0, 0), wheel @ (0, 0))
            translational(L: ground @ (0, -r), low @ (0, 0), axis = (1, 0)); translational(H: ground @ (0, r), high @ (0, 0), axis = (1, 0))
            rack_pinion(l: ground @ (0, -r), low @ (0, 0), axis = (1, 0), pinion = wheel, radius = r)
            rack_pinion(h: ground @ (0, r), high @ (0, 0), axis = (1, 0), pinion = wheel, radius = -r)",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "a wheel on a road, held at its height once more",
        parameters: "r",
        attributes: "bodies(wheel)
            rolling(road: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = r)
            y(height: wheel @ (0, 0) = r)",
        counts: [3, 3, 2, 1],
        fault: "road height",
    },
    Case {
        name: "a disc on a disc",
        parameters: "ri rj",
        attributes: "bodies(i, j); coordinates(psi)
            revolute(O: ground @ (0, 0), i @ (0, 0))
            rolling(roll: i @ (0, 0), j @ (0, 0), radii = (ri, rj), along = psi)",
        counts: [7, 5, 5, 2],
        fault: "",
    },
];
