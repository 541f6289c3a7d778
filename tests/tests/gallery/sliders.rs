//! Mechanisms with slides, compared with closed forms.

use crate::page::says;
use crate::{close, moved};
use kin_runtime::Kinematics;
use kin_tests::examples::{quick_return::QuickReturn, scotch_yoke::ScotchYoke, slider_crank::SliderCrank};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn the_scotch_yoke_is_a_sine_to_rounding() {
    let pump = ScotchYoke::default();
    let omega = TAU * pump.rpm / 60.0;
    for (t, at) in moved(&pump, 0.0, 60.0 / pump.rpm, 72) {
        let ((sin, cos), piston) = ((omega * t).sin_cos(), at[ScotchYoke::piston]);
        close(piston.r[0], pump.l + pump.r * cos, 1e-15);
        close(piston.v[0], -pump.r * omega * sin, 1e-14);
        close(piston.a[0], -pump.r * omega * omega * cos, 1e-12);
        assert_eq!(piston.r[1], 0.0);
    }
    says("scotch_yoke", "r cos φ within 10⁻¹⁵ m, over the whole turn");
}

#[test]
fn the_piston_obeys_the_formula_of_the_offset_slider_crank() {
    let engine = SliderCrank::default();
    let SliderCrank { r, l, offset, rpm } = engine;
    let piston = |phi: f64| r * phi.cos() + (l * l - (offset - r * phi.sin()).powi(2)).sqrt();
    let solver = engine.solver();
    for degree in (0..=360).step_by(5) {
        let phi = f64::from(degree).to_radians();
        let t = (phi - 0.5) / (TAU * rpm / 60.0);
        let motion = solver.motion(&solver.state(&t.into()).unwrap()).unwrap();
        close(motion[SliderCrank::piston].x, piston(phi), 1e-15);
    }
    let stroke = ((l + r).powi(2) - offset * offset).sqrt() - ((l - r).powi(2) - offset * offset).sqrt();
    // At the dead centres crank and rod are in line.
    for (length, turn) in [(l + r, 0.0), (l - r, PI)] {
        let phi = (offset / length).asin() + turn;
        let t = (phi - 0.5) / (TAU * rpm / 60.0);
        let motion = solver.motion(&solver.state(&t.into()).unwrap()).unwrap();
        close(motion[SliderCrank::piston].x_dot, 0.0, 1e-13);
    }
    says("slider_crank", &format!("the stroke is {:.2} mm instead of 2r = {:.0} mm", 1e3 * stroke, 2e3 * r));
}

#[test]
fn the_quick_return_has_the_time_ratio_of_its_tangents() {
    let shaper = QuickReturn::default();
    // The rocker reverses where it is tangent to the circle of the crank pin.
    let alpha = (shaper.r / shaper.a).acos();
    let (begin, end) = (-FRAC_PI_2 + alpha, 1.5 * PI - alpha);
    let motion = moved(&shaper, begin / shaper.omega, (begin + TAU) / shaper.omega, 1000);
    let solver = shaper.solver();
    for phi in [begin, end] {
        let state = solver.state(&(phi / shaper.omega).into()).unwrap();
        close(solver.motion(&state).unwrap()[QuickReturn::ram].x_dot, 0.0, 1e-14);
    }
    for (t, at) in &motion[1..1000] {
        let slow = shaper.omega * t < end;
        assert_eq!(at[QuickReturn::ram].x_dot < 0.0, slow, "at t = {t}");
    }
    says("quick_return", &format!("time ratio {:.3}", (end - begin) / (TAU - (end - begin))));
    let fastest = motion.iter().map(|(_, at)| at[QuickReturn::ram].x_dot);
    let (slow, fast) = crate::range(fastest);
    says("quick_return", &format!("at most {:.2} m/s forth and {fast:.2} m/s back", -slow));
}
