//! Rates whose coefficients are curves of time, of a coordinate or of an input, compared with exact motions.

use super::close;
use kin_runtime::{Instant, Kinematics, Signal, mechanism};

/// A mechanism with x = 1 + t, φ = 0.1 t, in some cases an input u = 0.3 t, and an equation for the rate of y.
macro_rules! of_rate {
    ($name:ident $(($input:ident))?: $($equation:tt)*) => {
        #[mechanism]
        #[coordinates(x, phi, y)]
        $(#[input($input)])?
        #[driver(along: x = 1 + t)]
        #[driver(turn: phi = 0.1 * t)]
        #[nonholonomic(rate: $($equation)*)]
        #[guess(y = 0)]
        struct $name;
    };
}

of_rate!(Exponential: dot(y) = exp(x) * dot(x));
of_rate!(OfTime: exp(t) * dot(y) = 1);
of_rate!(Tangent: dot(y) = tan(phi) * dot(x));
of_rate!(Power: dot(y) = x.powi(3) * dot(x));
of_rate!(Quotient: dot(y) = dot(x) / x);
of_rate!(Divided: dot(y) = (2 * dot(x) - dot(phi)) / (x + phi));
of_rate!(Root: dot(y) = sqrt(1 + x * x) * dot(x));
of_rate!(Sine: dot(y) = sin(x) * dot(x));
of_rate!(OfInput(u): dot(y) = tan(u) * dot(x));
of_rate!(TwoSinusoids(u): dot(y) = (cos(u) + cos(2 * u)) * dot(x));
of_rate!(OfSeveral: dot(y) = exp(x + phi) * (dot(x) + dot(phi)));

/// A body whose heading and way are driven.
#[mechanism]
#[bodies(cart)]
#[driver(heading: cart.phi = t)]
#[driver(way: cart.x = t)]
#[nonholonomic(drift: dot(cart.y) = cos(cart.phi).powi(3) * dot(cart.x))]
struct Cart;

/// Compares y after two seconds. A tracker changes inputs linearly between two updates if their rates say so.
fn integrates<M: Kinematics>(name: &str, mechanism: &M, y: usize, expected: f64) {
    const END: f64 = 2.0;
    let at = |t: f64| (t, [Signal::new(0.3 * t, 0.3, 0.0)]);
    let [(start, before), (end, after)] = [at(0.0), at(END)];
    let count = M::model().inputs.len();
    let mut tracker = mechanism.solver().tracker(&Instant { t: start, inputs: &before[..count] }).expect(name);
    let state = tracker.update(&Instant { t: end, inputs: &after[..count] }).expect(name);
    close(name, expected, state.q[y], 1e-10);
}

#[test]
fn coefficients_of_rates_may_be_curves() {
    let e = 1.0_f64.exp();
    let of_root = |x: f64| 0.5 * (x * x.hypot(1.0) + x.asinh());
    integrates("exp(x)", &Exponential, 2, e.powi(3) - e);
    integrates("exp(t)", &OfTime, 2, 1.0 - (-2.0_f64).exp());
    integrates("tan(phi)", &Tangent, 2, -10.0 * 0.2_f64.cos().ln());
    integrates("x³", &Power, 2, 20.0);
    integrates("1/x", &Quotient, 2, 3.0_f64.ln());
    integrates("1/(x + phi)", &Divided, 2, 1.9 / 1.1 * 3.2_f64.ln());
    integrates("√(1 + x²)", &Root, 2, of_root(3.0) - of_root(1.0));
    integrates("sin(x)", &Sine, 2, 1.0_f64.cos() - 3.0_f64.cos());
    integrates("tan(u)", &OfInput, 2, -0.6_f64.cos().ln() / 0.3);
    integrates("cos(u) + cos(2u)", &TwoSinusoids, 2, 0.6_f64.sin() / 0.3 + 1.2_f64.sin() / 0.6);
    integrates("exp(x + phi)", &OfSeveral, 2, 3.2_f64.exp() - e);
    integrates("cos³(phi)", &Cart, 1, 2.0_f64.sin() - 2.0_f64.sin().powi(3) / 3.0);
}
