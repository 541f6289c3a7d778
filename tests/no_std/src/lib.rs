//! A controller without std and without an allocator that evaluates a mechanism. It has its own panic handler: if a
//! dependency used std, there would be a second one, and the build would fail with a duplicate lang item.
#![no_std]

use kin_runtime::function::{FromFn, MotionLaw, Polynomial};
use kin_runtime::{GenericMechanism, Instant, Mechanism, Planned, Subset, mechanism};

/// The lecture's four-bar.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (0.4, 0.1))]
#[driver(drive: crank.phi = pi/4 + exp(-t) + atan2(t, 2))]
#[point(tip = coupler @ (0, 0.1))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBar {
    #[param(0.1)]
    l1: f64,
    #[param(0.4)]
    l2: f64,
    #[param(0.3)]
    l3: f64,
}

/// One step of the controller. It returns the sum of all results, so that nothing is optimised away.
#[unsafe(no_mangle)]
pub extern "C" fn step(t: f64) -> f64 {
    sum(t) + f64::from(sum(t as f32))
}

/// One step by the plan.
#[unsafe(no_mangle)]
pub extern "C" fn follow(t: f64) -> f64 {
    let four_bar = FourBar::default();
    let Ok(mut planned) = Planned::new(&four_bar, &Instant::at(0.0), &[t; FourBar::COORDINATES]) else { return 0.0 };
    planned.at(&Instant::at(t)).map_or(0.0, |state| state.q_dot().iter().sum())
}

fn sum<T: kin_runtime::Scalar>(t: T) -> T {
    let four_bar = FourBar::default();
    let (q, q_dot) = ([t; FourBar::COORDINATES], [T::from_f64(1.0); FourBar::COORDINATES]);
    let at = Instant::at(t);
    let mut workspace = FourBar::workspace::<T>();
    let mut observations = FourBar::observations::<T>();
    let parameters = four_bar.parameters::<T>();
    if four_bar.evaluate(Subset::ALL, &at, &q, &q_dot, &mut workspace).is_err()
        || four_bar.observe_with(parameters.as_ref(), &at, &q, &q_dot, &mut observations).is_err()
    {
        return T::from_f64(0.0);
    }
    let parts = [workspace.phi(), workspace.phi_q(), workspace.phi_t(), workspace.gamma(), observations.phi()];
    parts.into_iter().flatten().fold(T::from_f64(0.0), |sum, &value| sum + value)
}

/// A pendulum whose scalar type is chosen by the controller.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (-l, 0))]
#[driver(drive: arm.phi = amplitude[0] * sin(omega * t))]
pub struct Pendulum<T> {
    #[param(0.5)]
    l: T,
    #[param([0.1])]
    amplitude: [T; 1],
    #[param(3)]
    omega: T,
}

/// One step entirely in `f32`, including the parameters.
#[unsafe(no_mangle)]
pub extern "C" fn swing(t: f32) -> f32 {
    let mut workspace = Pendulum::<f32>::own_workspace();
    match Pendulum::default().evaluate_own(Subset::ALL, &Instant::at(t), &[t; 3], &[t; 3], &mut workspace) {
        Ok(()) => workspace.gamma().iter().fold(0.0, |sum, &value| sum + value),
        Err(_) => 0.0,
    }
}

/// A follower driven by functions that need no allocator.
#[mechanism]
#[function(lift, law)]
#[coordinates(y)]
#[driver(rise: y = lift(t) + law(t))]
pub struct Cam<F> {
    lift: Polynomial<[f64; 3]>,
    law: F,
}

/// One step of the cam.
#[unsafe(no_mangle)]
pub extern "C" fn lift(t: f64) -> f64 {
    let law: fn(f64) -> [f64; 3] = |x| MotionLaw::ModifiedSine.normalised(x);
    let cam = Cam { lift: Polynomial([0.0, 0.1, 0.2]), law: FromFn(law) };
    let mut workspace = Cam::<FromFn<fn(f64) -> [f64; 3]>>::workspace::<f64>();
    match cam.evaluate(Subset::ALL, &Instant::at(t), &[t], &[t], &mut workspace) {
        Ok(()) => workspace.gamma().iter().fold(0.0, |sum, &value| sum + value),
        Err(_) => 0.0,
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// A chain so long that its tables are packed; here the compiler unpacks them at compile time.
#[mechanism]
#[bodies(link[24])]
#[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..23]: link[i] @ (l, 0), link[i + 1] @ (0, 0))]
#[driver(turn[i in 0..24]: link[i].phi = t)]
pub struct Chain {
    #[param(0.1)]
    l: f64,
}

/// The total length of the chain's names, and the position of its end.
#[unsafe(no_mangle)]
pub extern "C" fn reach(t: f64) -> f64 {
    let (chain, model) = (Chain::default(), Chain::model());
    let names: usize = model.coordinates.iter().map(|coordinate| coordinate.name.len()).sum();
    let Ok(mut planned) = Planned::new(&chain, &Instant::at(0.0), &[0.0; Chain::COORDINATES]) else { return 0.0 };
    let end = planned.at(&Instant::at(t)).map_or(0.0, |state| state.q()[Chain::COORDINATES - 3]);
    end + names as f64
}
