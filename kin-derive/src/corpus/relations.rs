//! Relations between angles: gear trains by their equations, drivers, prescribed and held coordinates.

use super::Case;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "planetary train, two degrees of freedom",
        parameters: "rs rp",
        attributes: "bodies(sun, planet, arm)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0)); revolute(P: arm @ (rs + rp, 0), planet @ (0, 0))
            constraint(mesh: rs*(sun.phi - arm.phi) + rp*(planet.phi - arm.phi) = 0)",
        counts: [9, 7, 7, 2],
        fault: "",
    },
    Case {
        name: "planetary train with its ring held",
        parameters: "rs rp",
        attributes: "bodies(sun, planet, arm)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0)); revolute(P: arm @ (rs + rp, 0), planet @ (0, 0))
            constraint(mesh: rs*(sun.phi - arm.phi) + rp*(planet.phi - arm.phi) = 0)
            constraint(ring: rp*(planet.phi - arm.phi) + (rs + 2*rp)*arm.phi = 0); driver(drive: sun.phi = t)",
        counts: [9, 9, 9, 1],
        fault: "",
    },
    Case {
        name: "planetary train with a second planet, which shares the load and says nothing new",
        parameters: "rs rp",
        attributes: "bodies(sun, planet, other, arm)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0))
            revolute(P: arm @ (rs + rp, 0), planet @ (0, 0)); revolute(Q: arm @ (-rs - rp, 0), other @ (0, 0))
            constraint(mesh: rs*(sun.phi - arm.phi) + rp*(planet.phi - arm.phi) = 0)
            constraint(ring: rp*(planet.phi - arm.phi) + (rs + 2*rp)*arm.phi = 0)
            constraint(other_mesh: rs*(sun.phi - arm.phi) + rp*(other.phi - arm.phi) = 0)
            constraint(other_ring: rp*(other.phi - arm.phi) + (rs + 2*rp)*arm.phi = 0)",
        counts: [12, 12, 11, 1],
        fault: "mesh ring other_mesh other_ring",
    },
    Case {
        name: "three wheels in a ring of ratios",
        parameters: "za zb zc",
        attributes: "coordinates(a, b, c)
            constraint(ab: za*a + zb*b = 0); constraint(bc: zb*b + zc*c = 0); constraint(ca: za*a - zc*c = 0)",
        counts: [3, 3, 2, 1],
        fault: "ab bc ca",
    },
    Case {
        name: "three wheels that lock one another",
        parameters: "za zb zc",
        attributes: "coordinates(a, b, c)
            constraint(ab: za*a + zb*b = 0); constraint(bc: zb*b + zc*c = 0); constraint(ca: za*a + zc*c = 0)",
        counts: [3, 3, 3, 0],
        fault: "",
    },
    Case {
        name: "decimal ratios that multiply to one another",
        parameters: "",
        attributes: "coordinates(a, b, c)
            constraint(ab: b = 0.3*a); constraint(bc: c = 0.1*b); constraint(ca: c = 0.03*a)",
        counts: [3, 3, 2, 1],
        fault: "ab bc ca",
    },
    Case {
        name: "decimal ratios that do not",
        parameters: "",
        attributes: "coordinates(a, b, c)
            constraint(ab: b = 0.3*a); constraint(bc: c = 0.1*b); constraint(ca: c = 0.04*a)",
        counts: [3, 3, 3, 0],
        fault: "",
    },
    Case {
        name: "angles in a circle",
        parameters: "a b",
        attributes: "bodies(p, q, r)
            relative_angle(A: p, q = a); relative_angle(B: q, r = b); relative_angle(C: p, r = a + b)
            x(P: p @ (0, 0) = 0); x(Q: q @ (0, 0) = 0); y(R: r @ (0, 0) = t)",
        counts: [9, 6, 5, 5],
        fault: "A B C",
    },
    Case {
        name: "an angle that a guide has said",
        parameters: "",
        attributes: "bodies(table); translational(guide: ground @ (0, 0), table @ (0, 0), axis = (1, 2)); angle(level: table = 0)",
        counts: [3, 3, 2, 1],
        fault: "level",
    },
    Case {
        name: "a four-bar with two drivers",
        parameters: "a b c d",
        attributes: "bodies(crank, coupler, rocker)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), coupler @ (0, 0))
            revolute(B: coupler @ (b, 0), rocker @ (c, 0)); revolute(D: ground @ (d, 0), rocker @ (0, 0))
            driver(first: crank.phi = t); driver(second: rocker.phi = 2*t)",
        counts: [9, 10, 9, 1],
        fault: "second",
    },
    Case {
        name: "a crank that is driven twice beside a free pendulum",
        parameters: "a b",
        attributes: "bodies(crank, pendulum)
            revolute(O: ground @ (0, 0), crank @ (0, 0)); revolute(A: crank @ (a, 0), pendulum @ (0, 0))
            driver(first: crank.phi = t); driver(second: crank.phi = b*t)",
        counts: [6, 6, 5, 2],
        fault: "second",
    },
    Case {
        name: "a driven structure",
        parameters: "a b c",
        attributes: "bodies(p, q)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: p @ (a, 0), q @ (0, 0)); revolute(C: q @ (b, 0), ground @ (c, 0))
            driver(drive: p.phi = t)",
        counts: [6, 7, 6, 0],
        fault: "drive",
    },
    Case {
        name: "a point driven in x and y, and its distance as well",
        parameters: "l",
        attributes: "bodies(table)
            driver(across: table.x = t); driver(up: table.y = t); driver(far: distance(table @ (0, 0), ground @ (0, 0)) = l + t)",
        counts: [3, 3, 2, 3],
        fault: "far",
    },
    Case {
        name: "excavator with its cylinders driven",
        parameters: "a b c d e f",
        attributes: "bodies(boom, stick)
            revolute(O: ground @ (0, 0), boom @ (0, 0)); revolute(A: boom @ (a, 0), stick @ (0, 0))
            driver(lift: distance(ground @ (b, 0), boom @ (c, d)) = e + t); driver(crowd: distance(boom @ (a, d), stick @ (f, 0)) = e - t)",
        counts: [6, 6, 6, 2],
        fault: "",
    },
    Case {
        name: "planetary gear with its ring held",
        parameters: "rs rp rr",
        attributes: "bodies(sun, planet, arm)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0)); revolute(P: arm @ (rs + rp, 0), planet @ (0, 0))
            gear(mesh: sun, planet, radii = (rs, rp), carrier = arm); gear(ring: planet, ground, radii = (rp, -rr), carrier = arm)",
        counts: [9, 8, 8, 1],
        fault: "",
    },
    Case {
        name: "planetary gear with three planets",
        parameters: "rs rp rr",
        attributes: "bodies(sun, planet[3], arm)
            revolute(S: ground @ (0, 0), sun @ (0, 0)); revolute(C: ground @ (0, 0), arm @ (0, 0))
            revolute(P: arm @ (rs + rp, 0), planet[0] @ (0, 0)); revolute(Q: arm @ (0, rs + rp), planet[1] @ (0, 0)); revolute(R: arm @ (-rs, -rp), planet[2] @ (0, 0))
            gear(mesh[i in 0..3]: sun, planet[i], radii = (rs, rp), carrier = arm); gear(ring[i in 0..3]: planet[i], ground, radii = (rp, -rr), carrier = arm)",
        counts: [15, 16, 14, 1],
        fault: "mesh ring",
    },
    Case {
        name: "two planetary trains on one sun, one arm held",
        parameters: "a b c d e",
        attributes: "coordinates(sun, arm, ring, other_arm, p, q)
            constraint(mesh: a*(sun - arm) + b*(p - arm) = 0); constraint(inner: b*(p - arm) - c*(ring - arm) = 0)
            constraint(other: a*(sun - other_arm) + d*(q - other_arm) = 0); constraint(outer: d*(q - other_arm) - e*(arm - other_arm) = 0)
            driver(drive: ring = t); constraint(brake: other_arm = 0)",
        counts: [6, 6, 6, 1],
        fault: "",
    },
    Case {
        name: "two shafts joined by a gear and by a belt of another ratio",
        parameters: "a b c d e",
        attributes: "bodies(p, q)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: ground @ (e, 0), q @ (0, 0))
            gear(mesh: p, q, radii = (a, b)); belt(loop_belt: p, q, radii = (c, d))",
        counts: [6, 6, 6, 0],
        fault: "",
    },
    Case {
        name: "two shafts joined by two belts of the same pulleys",
        parameters: "a b e",
        attributes: "bodies(p, q)
            revolute(A: ground @ (0, 0), p @ (0, 0)); revolute(B: ground @ (e, 0), q @ (0, 0))
            belt(front: p, q, radii = (a, b)); belt(back: p, q, radii = (2*a, 2*b))",
        counts: [6, 6, 5, 1],
        fault: "front back",
    },
    Case {
        name: "rack and pinion",
        parameters: "r",
        attributes: "bodies(rack, wheel)
            revolute(O: ground @ (0, r), wheel @ (0, 0)); translational(guide: ground @ (0, 0), rack @ (0, 0), axis = (1, 0))
            rack_pinion(mesh: ground @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = wheel, radius = r)",
        counts: [6, 5, 5, 1],
        fault: "",
    },
    Case {
        name: "rolling disc",
        parameters: "r",
        attributes: "bodies(disc); rolling(road: ground @ (0, 0), disc @ (0, 0), axis = (1, 0), radius = r)",
        counts: [3, 2, 2, 1],
        fault: "",
    },
    Case {
        name: "cart on two axles",
        parameters: "a",
        attributes: "bodies(cart); knife_edge(rear: cart @ (0, 0)); knife_edge(front: cart @ (a, 0)); speed(engine: cart @ (0, 0), value = 1)",
        counts: [3, 3, 3, 1],
        fault: "",
    },
    Case {
        name: "cart on two axles that is driven to turn",
        parameters: "a",
        attributes: "bodies(cart); knife_edge(rear: cart @ (0, 0)); knife_edge(front: cart @ (a, 0)); driver(turn: cart.phi = t)",
        counts: [3, 3, 2, 1],
        fault: "turn",
    },
    Case {
        name: "driven distance that is a coordinate",
        parameters: "",
        attributes: "body(s, y = 0, phi = 0); coordinates(u)
            driver(a: s.x = 2 + t); driver(b: distance(ground @ (0, 1), s @ (0, 0)) = u)",
        counts: [2, 2, 2, 2],
        fault: "",
    },
    Case {
        name: "driven distance that is another distance",
        parameters: "",
        attributes: "body(s, y = 0, phi = 0); body(r, y = 0, phi = 0)
            driver(a: s.x = 2 + t); driver(b: distance(ground @ (0, 1), s @ (0, 0)) = distance(ground @ (0, 2), r @ (0, 0)))",
        counts: [2, 2, 2, 2],
        fault: "",
    },
    Case {
        name: "angle by defines that double",
        parameters: "p",
        attributes: "bodies(a, b); revolute(A: ground @ (0, 0), a @ (0, 0)); revolute(B: a @ (1, 0), b @ (0, 0))
            define(d1 = p + (p + 0.1)); define(d2 = d1 + (d1 + p)); define(d3 = d2 + (d2 + p)); define(d4 = d3 + (d3 + p))
            define(d5 = d4 + (d4 + p)); define(d6 = d5 + (d5 + p)); define(d7 = d6 + (d6 + p)); define(d8 = d7 + (d7 + p))
            define(d9 = d8 + (d8 + p)); define(e1 = d9 + (d9 + p)); define(e2 = e1 + (e1 + p)); define(e3 = e2 + (e2 + p))
            define(e4 = e3 + (e3 + p)); define(e5 = e4 + (e4 + p)); define(e6 = e5 + (e5 + p)); define(e7 = e6 + (e6 + p))
            define(e8 = e7 + (e7 + p)); define(e9 = e8 + (e8 + p)); define(f1 = e9 + (e9 + p)); define(f2 = f1 + (f1 + p))
            define(f3 = f2 + (f2 + p)); define(f4 = f3 + (f3 + p)); define(f5 = f4 + (f4 + p)); define(f6 = f5 + (f5 + p))
            define(f7 = f6 + (f6 + p)); define(f8 = f7 + (f7 + p)); define(f9 = f8 + (f8 + p)); define(g1 = f9 + (f9 + p))
            relative_angle(C: a, b = g1); angle(D: b = f9)",
        counts: [6, 6, 6, 0],
        fault: "",
    },
    Case {
        name: "lines that are parallel where the driver stands, and not in general",
        parameters: "",
        attributes: "body(beam, x = 0, y = 0); body(pin, phi = 0)
            point_on_line(fixed: ground @ (0, 0), pin @ (0, 0), axis = (1, 0))
            point_on_line(turning: beam @ (0, 0), pin @ (0, 0), axis = (1, 0)); driver(drive: beam.phi = 0)",
        counts: [3, 3, 3, 1],
        fault: "",
    },
    Case {
        name: "a power of a high degree",
        parameters: "a",
        attributes: "coordinates(u); define(s = u.powi(4).powi(4)); constraint(row: s.powi(4).powi(4) + u = a)",
        counts: [1, 1, 1, 0],
        fault: "",
    },
];
