//! Andrews' squeezer with the masses, the spring and the torque of the test set for initial value problem solvers, in
//! its seven angles: the multipliers of its six loop equations at both ends of the interval that is published.
//!
//! Source: E. Hairer and G. Wanner, *Solving Ordinary Differential Equations II*, section VII.7; F. Mazzia and C.
//! Magherini,
//! *Test Set for Initial Value Problem Solvers*, release 2.4, "Andrews' squeezing mechanism".

use kin_runtime::{Forces, Instant, Kinematics, Signal, mechanism};

/// The crank follows the published motion, so that its driver has nothing to supply beside the torque.
#[mechanism]
#[input(crank)]
#[coordinates(beta, theta, gamma, phi, delta, omega, epsilon)]
#[body(K1, x = ra*cos(beta), y = ra*sin(beta), phi = beta)]
#[body(K2, x = rr*cos(beta) - da*cos(beta + theta), y = rr*sin(beta) - da*sin(beta + theta), phi = beta + theta)]
#[body(K3, x = xb + sa*sin(gamma) + sb*cos(gamma), y = yb - sa*cos(gamma) + sb*sin(gamma), phi = gamma)]
#[body(K4, x = xa + zt*cos(delta) + (e - ea)*sin(phi + delta), y = ya + zt*sin(delta) - (e - ea)*cos(phi + delta), phi = phi + delta)]
#[body(K5, x = xa + ta*cos(delta) - tb*sin(delta), y = ya + ta*sin(delta) + tb*cos(delta), phi = delta)]
#[body(K6, x = xa + u*sin(epsilon) + (zf - fa)*cos(omega + epsilon), y = ya - u*cos(epsilon) + (zf - fa)*sin(omega + epsilon), phi = omega + epsilon)]
#[body(K7, x = xa + ua*sin(epsilon) - ub*cos(epsilon), y = ya - ua*cos(epsilon) - ub*sin(epsilon), phi = epsilon)]
#[constraint(g1: rr*cos(beta) - d*cos(beta + theta) - ss*sin(gamma) = xb)]
#[constraint(g2: rr*sin(beta) - d*sin(beta + theta) + ss*cos(gamma) = yb)]
#[constraint(g3: rr*cos(beta) - d*cos(beta + theta) - e*sin(phi + delta) - zt*cos(delta) = xa)]
#[constraint(g4: rr*sin(beta) - d*sin(beta + theta) + e*cos(phi + delta) - zt*sin(delta) = ya)]
#[constraint(g5: rr*cos(beta) - d*cos(beta + theta) - zf*cos(omega + epsilon) - u*sin(epsilon) = xa)]
#[constraint(g6: rr*sin(beta) - d*sin(beta + theta) - zf*sin(omega + epsilon) + u*cos(epsilon) = ya)]
#[driver(drive: beta = crank)]
#[mass(K1 @ (0, 0), mass = 0.04325, inertia = 2.194e-6)]
#[mass(K2 @ (0, 0), mass = 0.00365, inertia = 4.410e-7)]
#[mass(K3 @ (0, 0), mass = 0.02373, inertia = 5.255e-6)]
#[mass(K4 @ (0, 0), mass = 0.00706, inertia = 5.667e-7)]
#[mass(K5 @ (0, 0), mass = 0.07050, inertia = 1.169e-5)]
#[mass(K6 @ (0, 0), mass = 0.00706, inertia = 5.667e-7)]
#[mass(K7 @ (0, 0), mass = 0.05498, inertia = 1.912e-5)]
#[torque(motor: K1 = 0.033)]
#[spring(S: ground @ (0.014, 0.072), K3 @ (sd - sb, sa - sc), stiffness = 4530, free_length = 0.07785)]
#[rustfmt::skip]
struct Squeezer {
    #[param(-0.06934)] xa: f64, #[param(-0.00227)] ya: f64,
    #[param(-0.03635)] xb: f64, #[param(0.03273)] yb: f64,
    #[param(0.028)] d: f64, #[param(0.0115)] da: f64,
    #[param(0.02)] e: f64, #[param(0.01421)] ea: f64,
    #[param(0.02)] zf: f64, #[param(0.01421)] fa: f64,
    #[param(0.007)] rr: f64, #[param(0.00092)] ra: f64,
    #[param(0.035)] ss: f64, #[param(0.01874)] sa: f64, #[param(0.01043)] sb: f64,
    #[param(0.018)] sc: f64, #[param(0.02)] sd: f64,
    #[param(0.02308)] ta: f64, #[param(0.00916)] tb: f64,
    #[param(0.04)] u: f64, #[param(0.01228)] ua: f64, #[param(0.00449)] ub: f64,
    #[param(0.04)] zt: f64,
}

fn forces(crank: Signal, start: [f64; 7]) -> Forces {
    let squeezer = Squeezer::default();
    let inputs = [crank];
    let state = squeezer.solver().state_from(&Instant { t: 0.0, inputs: &inputs }, &start).unwrap();
    squeezer.solver().forces(&state).unwrap()
}

fn near(forces: &Forces, exact: &[f64], tolerance: f64) {
    for (found, exact) in forces.multipliers.iter().zip(exact) {
        assert!((found - exact).abs() <= tolerance * 98.0, "{found} instead of {exact}");
    }
    // The published motion is that of the torque alone.
    let effort = forces.effort("drive").unwrap();
    assert!(effort.abs() <= tolerance, "{effort}");
}

#[test]
fn multipliers_at_the_start() {
    let crank = Signal::new(-0.061_713_890_014_276_45, 0.0, 14_222.443_919_954_114);
    let phi = 0.222_668_390_165_885_88;
    let start =
        [crank.value, 0.0, 0.455_279_819_163_070_4, phi, 0.487_364_979_543_842_6, -phi, 1.230_547_444_549_821_2];
    near(&forces(crank, start), &[98.566_870_396_241_09, -6.122_688_344_255_663, 0.0, 0.0, 0.0, 0.0], 1e-12);
}

#[test]
fn multipliers_at_the_end() {
    let crank = Signal::new(15.810_771_196_299_04, 1_139.920_302_151_208, -24_631.763_169_451_96);
    let start = [
        crank.value,
        -15.756_371_059_842_98,
        0.040_822_240_130_731_01,
        -0.534_730_116_322_694_8,
        0.524_409_965_880_530_4,
        0.534_730_116_322_694_8,
        1.048_080_741_042_263,
    ];
    let exact = [
        199.175_333_373_191,
        -29.755_312_280_150_52,
        23.066_541_190_983_99,
        31.452_713_654_759_27,
        22.642_492_320_827_39,
        11.617_407_000_196_73,
    ];
    // The published state is that of an integration, right to about nine digits.
    near(&forces(crank, start), &exact, 1e-6);
}
