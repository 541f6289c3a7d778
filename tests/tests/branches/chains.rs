//! Two to four parallelograms that drive one another, with change points at the same time or one after the other. The
//! last parallelogram may be replaced by a four-bar that is near a crossing.

use crate::case::{Case, Group};
use crate::closure::FourBar;
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::PI;

/// The dimensions of a chain of any length: crank radii, couplers, ground links, directions of the pins on the cranks
/// and of the ground links, and the start.
#[derive(Clone, Debug)]
struct Dimensions {
    radii: Vec<f64>,
    couplers: Vec<f64>,
    grounds: Vec<f64>,
    ahead: Vec<f64>,
    turned: Vec<f64>,
    last: FourBar,
    start: f64,
}

/// A mechanism of `COUNT` four-bars.
trait Chain: Sized {
    const COUNT: usize;
    fn new(dimensions: &Dimensions) -> Self;
}

macro_rules! chain {
    ($Name:ident, $count:tt, $less:tt) => {
        /// The crank of a four-bar is the rocker of the previous one; its pin for the next coupler is at the angle
        /// `ahead`.
        #[mechanism]
        #[bodies(crank, coupler[$count], rocker[$count])]
        #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
        #[revolute(A0: crank @ (radius[0]*cos(ahead[0]), radius[0]*sin(ahead[0])), coupler[0] @ (0, 0))]
        #[revolute(A[i in 0..$less]: rocker[i] @ (radius[i+1]*cos(ahead[i+1]), radius[i+1]*sin(ahead[i+1])),
                                                            coupler[i+1] @ (0, 0))]
        #[revolute(B[i in 0..$count]: coupler[i] @ (length[i], 0),
                                                            rocker[i] @ (own[i]*cos(ahead[i]), own[i]*sin(ahead[i])))]
        #[revolute(D[i in 0..$count]: ground @ (x[i], y[i]), rocker[i] @ (0, 0))]
        #[driver(drive: crank.phi = start + t)]
        #[derive(Clone, Debug)]
        struct $Name {
            radius: [f64; $count],
            own: [f64; $count],
            length: [f64; $count],
            ahead: [f64; $count],
            x: [f64; $count],
            y: [f64; $count],
            start: f64,
        }

        impl Chain for $Name {
            const COUNT: usize = $count;

            fn new(dimensions: &Dimensions) -> Self {
                let list = |of: &[f64]| std::array::from_fn(|k| of[k]);
                let pivots = dimensions.pivots();
                let mut own: [f64; $count] = list(&dimensions.radii);
                own[$count - 1] = dimensions.last.c;
                Self {
                    radius: list(&dimensions.radii),
                    own,
                    length: list(&dimensions.couplers),
                    ahead: list(&dimensions.ahead),
                    x: std::array::from_fn(|k| pivots[k][0]),
                    y: std::array::from_fn(|k| pivots[k][1]),
                    start: dimensions.start,
                }
            }
        }
    };
}

chain!(Two, 2, 1);
chain!(Three, 3, 2);
chain!(Four, 4, 3);

impl Dimensions {
    /// The ground pins of the rockers.
    fn pivots(&self) -> Vec<[f64; 2]> {
        let mut at = [0.0; 2];
        let step = |(d, angle): (&f64, &f64)| {
            // Along the axis there is no rounding error.
            at = if *angle == 0.0 { [at[0] + d, at[1]] } else { [at[0] + d * angle.cos(), at[1] + d * angle.sin()] };
            at
        };
        self.grounds.iter().zip(&self.turned).map(step).collect()
    }

    /// The angle of the crank in the last four-bar minus that of the first crank.
    fn offset(&self) -> f64 {
        let last = self.ahead.len() - 1;
        self.ahead[last] - self.turned[last]
    }

    fn drawn(random: &mut Random, count: usize, times: &[f64], exact: bool) -> Self {
        let at_once = random.chance(0.5);
        loop {
            let mut list = |low: f64, high: f64| -> Vec<f64> {
                (0..count).map(|_| crate::closure::dyadic(random.between(low, high))).collect()
            };
            let (radii, mut grounds) = (list(0.15, 0.5), list(0.6, 1.0));
            let (mut ahead, mut turned) = (list(-PI, PI), list(-PI, PI));
            if at_once {
                ahead.fill(0.0);
                turned.fill(0.0);
            }
            let couplers = grounds.clone();
            let (a, b) = (radii[count - 1], grounds[count - 1]);
            let mut last = FourBar { a, b, c: a, d: b, sign: random.sign() };
            if !exact {
                last.d += random.small(-9.0, -3.0);
                grounds[count - 1] = last.d;
            } else if random.chance(0.5) {
                // An antiparallelogram, whose branches cross where those of the parallelograms do.
                last.sign = -1.0;
            }
            let start = -random.meeting(times, 0.05, 0.9) + if at_once { 0.0 } else { turned[0] - ahead[0] };
            let found = Self { radii, couplers, grounds, ahead, turned, last, start };
            let apart = |(ahead, turned): (&f64, &f64)| (start + ahead - turned).sin().abs() > 0.05;
            if found.ahead.iter().zip(&found.turned).all(apart) && last.is_free(start + found.offset(), 0.05) {
                return found;
            }
        }
    }

    /// A case of parallelograms, except for the last four-bar; their couplers keep the direction of their ground links.
    fn case<M: Chain>(self, end: f64) -> Case<M> {
        let count = M::COUNT;
        let mechanism = M::new(&self);
        let Self { start, last, .. } = self;
        let [low, high] = [start, start + end];
        let offset = self.offset();
        let [folds, crossings] = last.places(low + offset, high + offset);
        let folds = folds.into_iter().map(|place| place - offset - start).collect();
        let mut crossings: Vec<f64> = crossings.into_iter().map(|place| place - offset - start).collect();
        for (ahead, turned) in self.ahead.iter().zip(&self.turned).take(count - 1) {
            crossings.extend((-6..=6).map(|half| PI * f64::from(half) + turned - ahead - start));
        }
        let note = format!("last {last:?}");
        let branch = move |t: f64, off: f64| {
            let phi = Jet::time(t) + start;
            let [coupler, rocker] = last.close(phi + offset, off)?;
            let (zero, pivots) = (Jet::default(), self.pivots());
            let mut q = vec![zero, zero, phi];
            for k in 0..count {
                let [x, y] = if k == 0 { [0.0; 2] } else { pivots[k - 1] };
                let pin = phi + self.ahead[k];
                let turned = self.turned[k];
                let direction = if k + 1 == count { coupler + turned } else { Jet::from(turned) };
                q.extend([pin.cos() * self.radii[k] + x, pin.sin() * self.radii[k] + y, direction]);
            }
            for (k, [x, y]) in pivots.into_iter().enumerate() {
                let rocker = if k + 1 == count { rocker + self.turned[k] - self.ahead[k] } else { phi };
                q.extend([Jet::from(x), Jet::from(y), rocker]);
            }
            Some(q)
        };
        Case::new(mechanism, branch, [folds, crossings], note)
    }
}

fn drawn<M: Chain>(random: &mut Random, exact: bool) -> Group<M> {
    let end = random.sign() * random.between(1.5, 4.5);
    let times = random.grid(end);
    let cases = (0..2).map(|_| Dimensions::drawn(random, M::COUNT, &times, exact).case(end)).collect();
    Group::new(times, cases)
}

#[test]
fn chains_of_change_points() {
    let (mut random, mut tally) = (Random::new(221), Tally::default());
    for round in 0..motions(0.05).div_ceil(6) {
        let exact = round % 2 == 0;
        follow(&mut tally, &drawn::<Two>(&mut random, exact));
        follow(&mut tally, &drawn::<Three>(&mut random, exact));
        follow(&mut tally, &drawn::<Four>(&mut random, exact));
    }
    tally.obeys("chains of change points");
}
