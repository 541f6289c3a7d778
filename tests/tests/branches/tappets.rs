//! Tappets on cams with many lobes: a tappet may rise and fall several times between two instants, while the cam turns
//! little. Whatever the instants are, it stays on its side of the cam.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::FRAC_PI_2;

/// A tappet that slides along a line through the cam's centre: y = ±(ρ + h cos n(±π/2 − φ)).
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(tappet, x = 0, phi = 0)]
#[on_curve(contact: cam @ (0, 0), tappet @ (0, 0), polar(theta) = rho + h * cos(n * theta))]
#[driver(turn: cam.phi = t)]
#[derive(Clone, Debug)]
struct Tappet {
    rho: f64,
    h: f64,
    n: f64,
}

/// A cam whose slope h n/ρ is at most 4, and a tappet on either side.
fn drawn(random: &mut Random) -> Case<Tappet> {
    let (rho, n) = (random.between(0.4, 1.0), random.between(2.0, 60.0).floor());
    let h = rho * random.between(0.02, 0.5_f64.min(4.0 / n));
    let side = random.sign();
    let branch = move |t: f64, off: f64| {
        let phi = Jet::time(t) * (1.0 + off);
        let y = (((Jet::from(side * FRAC_PI_2) - phi) * n).cos() * h + rho) * side;
        Some(vec![phi, y])
    };
    let mechanism = Tappet { rho, h, n };
    let note = format!("{mechanism:?} on side {side}");
    Case::new(mechanism, branch, [Vec::new(), Vec::new()], note)
}

#[test]
fn tappets_stay_on_their_side_of_the_cam() {
    let (mut random, mut tally) = (Random::new(1011), Tally::default());
    for _ in 0..motions(0.05).div_ceil(4) {
        let (count, step) = (random.whole(2, 14), random.sign() * random.between(0.03, 0.7));
        let times = (0..=count).map(|k| k as f64 * step).collect();
        let cases = (0..4).map(|_| drawn(&mut random)).collect();
        follow(&mut tally, &Group::new(times, cases));
    }
    tally.obeys("tappets");
}
