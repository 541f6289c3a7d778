//! Motions whose derivatives of every order have a closed form.

use crate::expands;
use kin_runtime::{Kinematics, mechanism};
use kin_tests::mechanisms::{
    AndrewsCartesian, AndrewsPins, FourbarLectureMid, PlanetaryBasic, SleighKnifeEdge, SliderCrankInline,
};

/// The derivative dᵏ/dtᵏ of a sin(w t + p).
fn sine(a: f64, w: f64, p: f64, order: usize, t: f64) -> f64 {
    a * w.powi(order as i32) * (w * t + p + order as f64 * std::f64::consts::FRAC_PI_2).sin()
}

/// A point on a wheel that turns at constant speed.
#[mechanism]
#[bodies(wheel)]
#[revolute(pin: ground @ (0.3, -0.2), wheel @ (0, 0))]
#[driver(drive: wheel.phi = 0.4 + omega * t)]
#[point(tip = wheel @ (0.5, 0))]
#[define(height = tip.y)]
struct Wheel {
    #[param(2.5)]
    omega: f64,
}

#[test]
fn circular_motion() {
    let wheel = Wheel::default();
    let solver = wheel.solver();
    for t in [0.0, 0.7, 3.1] {
        let derivatives = solver.derivatives(&solver.state(&t.into()).unwrap(), 12).unwrap();
        let motion = solver.motion_derivatives(&derivatives).unwrap();
        for order in 0..=12 {
            let constant = |value: f64| if order == 0 { value } else { 0.0 };
            let [y, x] = [0.0, std::f64::consts::FRAC_PI_2].map(|shift| sine(0.5, 2.5, 0.4 + shift, order, t));
            let expected = [x + constant(0.3), y + constant(-0.2)];
            let size = 1e-14 * 2.5_f64.powi(order as i32) * (1.0 + order as f64);
            for (found, expected) in motion[Wheel::tip][order].into_iter().zip(expected) {
                assert!((found - expected).abs() < size, "{order}: {found} {expected}");
            }
            assert_eq!(motion[Wheel::tip][order][1], motion.defines[0][order]);
            assert_eq!(motion[Wheel::wheel][order][2], derivatives.q[order][2]);
        }
    }
}

/// Slider-crank: x = r cos φ + √(l² − r² sin² φ) with φ = ω t. With u = r sin φ and s = √(l² − u²), s s′ = −u u′, and
/// the higher derivatives follow by Leibniz's rule, as computed here.
#[mechanism]
#[bodies(crank, rod)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[driver(drive: crank.phi = 1.7 * t)]
#[guess(slider.x = 0.8, rod.phi = 0)]
struct SliderCrank;

#[test]
fn slider_crank_by_leibniz() {
    const ORDER: usize = 10;
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    for t in [0.2, 1.0, 2.9] {
        let u: Vec<f64> = (0..=ORDER).map(|k| sine(0.2, 1.7, 0.0, k, t)).collect();
        let mut s = vec![(0.49 - u[0] * u[0]).sqrt()];
        for k in 1..=ORDER {
            // The k-th derivative of s² + u² = l².
            let inner: f64 = (1..k).map(|i| choose(k, i) * s[i] * s[k - i]).sum();
            let other: f64 = (0..=k).map(|i| choose(k, i) * u[i] * u[k - i]).sum();
            s.push(-(inner + other) / (2.0 * s[0]));
        }
        let solver = SliderCrank.solver();
        let found = solver.derivatives(&solver.state(&t.into()).unwrap(), ORDER).unwrap();
        let place = SliderCrank::slider.0;
        let motion = solver.motion_derivatives(&found).unwrap();
        for (order, s) in s.iter().enumerate() {
            let expected = sine(0.2, 1.7, std::f64::consts::FRAC_PI_2, order, t) + s;
            let found = motion.bodies[place][order][0];
            let tolerance = 1e-12 * 1.7_f64.powi(order as i32) * 2.0_f64.powi(order as i32);
            assert!((found - expected).abs() < tolerance, "{order}: {found} {expected}");
        }
    }
}

/// The angle of a planet carrier is the mean of the angles of sun and ring, weighted with their radii.
#[test]
fn planetary_gear() {
    let gear = PlanetaryBasic::default();
    let solver = gear.solver();
    let t = 0.6;
    let found = solver.motion_derivatives(&solver.derivatives(&solver.state(&t.into()).unwrap(), 9).unwrap()).unwrap();
    let (rs, rr) = (gear.rs, gear.rr);
    for order in 3..=9 {
        let ring = sine(0.4, 2.0, 0.0, order, t);
        let expected = rr * ring / (rs + rr);
        let carrier = found[PlanetaryBasic::carrier][order][2];
        assert!((carrier - expected).abs() < 1e-12 * 2.0_f64.powi(order as i32), "{order}: {carrier} {expected}");
        assert!((found[PlanetaryBasic::ring][order][2] - ring).abs() < 1e-12 * 2.0_f64.powi(order as i32));
    }
}

/// A sleigh on a knife edge whose speed and heading are driven: ṙ_P = (v₀ + a t) (cos ψ, sin ψ), ψ = φ₀ + α + w t.
#[test]
fn sleigh_by_rates() {
    let sleigh = SleighKnifeEdge::default();
    let solver = sleigh.solver();
    for t in [0.0, 0.9] {
        let state = solver.state(&t.into()).unwrap();
        let motion = solver.motion_derivatives(&solver.derivatives(&state, 8).unwrap()).unwrap();
        for order in 3..=8 {
            // The derivative of order k = order − 1 of a product whose first factor is linear.
            let k = order - 1;
            for (axis, shift) in [std::f64::consts::FRAC_PI_2, 0.0].into_iter().enumerate() {
                let part = |k: usize| sine(1.0, 0.8, 0.5 + shift, k, t);
                let expected = (0.9 + 0.25 * t) * part(k) + k as f64 * 0.25 * part(k - 1);
                let found = motion[SleighKnifeEdge::P][order][axis];
                assert!((found - expected).abs() < 1e-13, "{order}: {found} {expected}");
            }
        }
    }
}

/// Taylor series reproduce the positions that position analysis finds at neighbouring instants.
#[test]
fn series_reach_the_positions_around() {
    fn reach<M: Kinematics + Default>(t: f64, h: f64, tolerance: f64) {
        expands(&M::default().solver(), t, h, 14, tolerance);
    }
    reach::<SliderCrankInline>(0.4, 0.05, 1e-13);
    reach::<FourbarLectureMid>(0.7, 0.05, 1e-12);
    reach::<PlanetaryBasic>(0.3, 0.1, 1e-13);
    reach::<AndrewsPins>(0.0, 2e-4, 1e-11);
    reach::<AndrewsCartesian>(0.0, 2e-4, 1e-11);
}
