//! Open chains: a chain with a free end, and a car.

use crate::page::says;
use crate::{close, moved};
use kin_tests::examples::{car::Car, chain::Chain};
use std::f64::consts::TAU;

#[test]
fn the_chains_end_is_the_sum_of_its_links() {
    let uneven = Chain {
        l: std::array::from_fn(|i| 0.05 + 0.004 * i as f64),
        bend: std::array::from_fn(|i| 0.02 * (i as f64).sin()),
        omega: 1.7,
    };
    for chain in [Chain::default(), uneven] {
        for (t, at) in moved(&chain, 0.0, TAU / chain.omega, 24) {
            let (sin, cos) = (chain.omega * t).sin_cos();
            let omega = chain.omega;
            let (mut phi, mut rate, mut acceleration) = (0.4 * sin, 0.4 * omega * cos, -0.4 * omega * omega * sin);
            let [mut r, mut v, mut a] = [[0.0; 2]; 3];
            for (i, l) in chain.l.into_iter().enumerate() {
                if i > 0 {
                    phi += chain.bend[i] * cos;
                    rate -= chain.bend[i] * omega * sin;
                    acceleration -= chain.bend[i] * omega * omega * cos;
                }
                close(at[Chain::link[i]].phi, phi, 1e-13);
                let (along, across) = ([l * phi.cos(), l * phi.sin()], [-l * phi.sin(), l * phi.cos()]);
                for k in 0..2 {
                    r[k] += along[k];
                    v[k] += rate * across[k];
                    a[k] += acceleration * across[k] - rate * rate * along[k];
                }
            }
            for k in 0..2 {
                close(at[Chain::end].r[k], r[k], 1e-13);
                close(at[Chain::end].v[k], v[k], 1e-12);
                close(at[Chain::end].a[k], a[k], 1e-11);
            }
        }
    }
}

/// The integral of f from `from` to `to` by Simpson's rule.
fn integral(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let steps = 200;
    let h = (to - from) / f64::from(steps);
    let weight = |k: i32| if k == 0 || k == steps { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    (0..=steps).map(|k| weight(k) * f(from + h * f64::from(k))).sum::<f64>() * h / 3.0
}

#[test]
fn the_car_turns_about_a_point_on_its_rear_axle() {
    let slow = Car { wheelbase: 3.1, lock: -0.4, v: 0.7, duration: 9.0 };
    for car in [slow, Car::default()] {
        let Car { wheelbase, lock, v, duration } = car;
        let steering = |t: f64| lock * (TAU * t / duration).sin();
        // The yaw rate is the speed divided by the radius, wheelbase / tan δ; its integral is the heading.
        let yaw = |t: f64| -v * steering(t).tan() / wheelbase;
        let motion = moved(&car, 0.0, duration, 60);
        let [mut phi, mut x, mut y] = [0.0; 3];
        let mut before = 0.0;
        for (t, at) in &motion {
            let heading = |u: f64| phi + integral(yaw, before, u);
            let (x_now, y_now) = (
                x - v * integral(|u| heading(u).cos(), before, *t),
                y - v * integral(|u| heading(u).sin(), before, *t),
            );
            (phi, x, y, before) = (heading(*t), x_now, y_now, *t);
            let (body, nose) = (at[Car::car], at[Car::nose]);
            close(at[Car::steering].value, steering(*t), 1e-15);
            close(body.phi_dot, yaw(*t), 1e-14);
            // Rear axle and nose move on circles about the same point: the axle is abeam of it, the nose ahead.
            let (radius, ahead) = (wheelbase / steering(*t).tan(), wheelbase + 0.9);
            close(body.x_dot.hypot(body.y_dot), v, 1e-14);
            close(nose.v[0].hypot(nose.v[1]), v * (1.0 + (ahead / radius).powi(2)).sqrt(), 1e-14);
            close(body.phi, phi, 1e-11);
            close(body.x, x, 1e-11);
            close(body.y, y, 1e-11);
        }
    }
    let car = Car::default();
    let (_, end) = moved(&car, 0.0, car.duration, 60).pop().expect("an end");
    let body = end[Car::car];
    close(body.phi, 0.0, 1e-11);
    let [back, aside] = [-body.x, body.y];
    says("car", &format!("{back:.2} m back and {aside:.2} m aside, parallel to where it began"));
    let radius = car.wheelbase / car.lock.tan();
    says("car", &format!("at full lock the rear axle turns about a point {radius:.2} m beside it"));
}
