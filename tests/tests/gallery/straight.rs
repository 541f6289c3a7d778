//! Linkages that draw straight lines, exactly or nearly.

use crate::page::says;
use crate::{close, moved, range};
use kin_tests::examples::{hart::Hart, hoecken::Hoecken, peaucellier::Peaucellier};
use std::f64::consts::{PI, TAU};

#[test]
fn peaucelliers_point_goes_straight_to_rounding() {
    let cell = Peaucellier::default();
    let line = (cell.a * cell.a - cell.b * cell.b) / (2.0 * cell.c);
    let motion = moved(&cell, 0.0, TAU, 360);
    for (_, at) in &motion {
        let (p, q) = (at[Peaucellier::P], at[Peaucellier::Q]);
        close(q.r[0], line, 4e-15);
        close(q.v[0], 0.0, 1e-14);
        close(p.r[0].hypot(p.r[1]) * q.r[0].hypot(q.r[1]), cell.a * cell.a - cell.b * cell.b, 4e-15);
    }
    let (low, high) = range(motion.iter().map(|(_, at)| at[Peaucellier::Q].r[1]));
    says("peaucellier", &format!("a line {:.3} m long, straight within 4·10⁻¹⁵ m", high - low));
}

#[test]
fn harts_point_goes_straight_to_rounding() {
    let inversor = Hart::default();
    let power = (inversor.long.powi(2) - inversor.short.powi(2)) / 4.0;
    let motion = moved(&inversor, 0.0, TAU, 360);
    for (_, at) in &motion {
        let (p, q) = (at[Hart::p].r, at[Hart::q].r);
        close(q[0], power / (2.0 * inversor.base), 1e-15);
        close(p[0].hypot(p[1]) * q[0].hypot(q[1]), power, 1e-16);
        close(p[0] * q[1] - p[1] * q[0], 0.0, 1e-16);
    }
    let (low, high) = range(motion.iter().map(|(_, at)| at[Hart::q].r[1]));
    says("hart", &format!("a line {:.1} mm long, straight within 10⁻¹⁵ m", 1e3 * (high - low)));
}

/// R. L. Norton, Design of Machinery, "Link ratios for smallest attainable errors in straightness": β, the error in per
/// cent of the length of the line, and the lengths of ground, coupler and line as multiples of the crank.
const NORTON: [(f64, f64, [f64; 3]); 3] = [
    (120.0, 0.010, [2.625, 3.438, 3.238]),
    (140.0, 0.023, [2.500, 3.250, 3.623]),
    (180.0, 0.096, [2.200, 2.800, 4.181]),
];

#[test]
fn hoeckens_point_goes_as_straight_as_published() {
    for (beta, error, [ground, coupler, length]) in NORTON {
        let r = Hoecken::default().r;
        let linkage = Hoecken { d: ground * r, l: coupler * r, ..Hoecken::default() };
        // The straight line belongs to crank angles around 180°.
        let half = 0.5 * beta.to_radians();
        let motion = moved(&linkage, PI - half, PI + half, 400);
        let extent = |axis: usize| {
            let (low, high) = range(motion.iter().map(|(_, at)| at[Hoecken::T].r[axis]));
            high - low
        };
        close(extent(0) / r, length, 0.000_6);
        close(100.0 * extent(1) / extent(0), error, 0.000_5);
    }
    // The example has the dimensions of one of the rows, and the page has its figures.
    let Hoecken { r, d, l, .. } = Hoecken::default();
    let quoted = |(_, _, [ground, coupler, _]): &(f64, f64, [f64; 3])| {
        (d / r - ground).abs() < 1e-12 && (l / r - coupler).abs() < 1e-12
    };
    let (beta, error, [.., length]) = NORTON.into_iter().find(quoted).expect("a row of the table");
    says(
        "hoecken",
        &format!("over {beta:.0}° of the crank the line is {length} cranks long and {error} % of that wide"),
    );
}
