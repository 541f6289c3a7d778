//! Published numbers; `tests/data/PUBLISHED.md` gives the sources.

use kin_runtime::model::{Body, Point};
use kin_runtime::{Instant, Kinematics, Mechanism, State};
use kin_tests::compare::Differences;
use kin_tests::mechanisms::*;
use std::f64::consts::{FRAC_PI_4, TAU};

const PUBLISHED: &str = include_str!("../data/PUBLISHED.md");

fn state<M: Kinematics + Default>(t: f64) -> State {
    M::default().state_at(&Instant::at(t)).unwrap()
}

fn coordinate<M: Mechanism>(name: &str) -> usize {
    M::model().coordinates.iter().position(|c| c.name == name).unwrap_or_else(|| panic!("no coordinate {name}"))
}

/// |found − printed| is at most half a unit in the last of `digits` decimals (plus rounding).
fn printed(differences: &mut Differences, what: &str, printed: f64, found: f64, digits: i32) {
    differences.number(what, printed, found, 0.500_001 * 10_f64.powi(-digits));
}

/// The lecture (slides 9–14), with frames at the midpoints of the links.
#[test]
fn lecture_four_bar_in_every_printed_digit() {
    let q = state::<FourbarLectureMid>(0.0).q;
    let slide = [0.0354, 0.0354, 0.785, 0.193, 0.229, 0.915, 0.357, 0.244, 5.000];
    let digits = [4, 4, 3, 3, 3, 3, 3, 3, 3];
    let mut differences = Differences::new();
    differences.at("lecture, solution 1");
    for (place, (&expected, &digits)) in slide.iter().zip(&digits).enumerate() {
        printed(&mut differences, FourbarLectureMid::model().coordinates[place].name, expected, q[place], digits);
    }
    differences.finish();
}

/// The lecture's γ of the global method (slide 63), written as an explicit formula.
#[test]
fn lecture_gamma_of_the_global_method() {
    let four_bar = FourbarLectureAngles::default();
    let (q, q_dot) = ([0.3, -0.8, 2.1], [1.7, -0.4, 0.9]);
    let gamma = four_bar.gamma(&Instant::at(0.2), &q, &q_dot).unwrap();
    let lengths = [four_bar.l1, four_bar.l2, four_bar.l3];
    let sum = |f: fn(f64) -> f64| (0..3).map(|k| lengths[k] * q_dot[k] * q_dot[k] * f(q[k])).sum::<f64>();
    let mut differences = Differences::new();
    differences.at("γ");
    differences.vector("γ", |row| row, &[sum(f64::cos), sum(f64::sin), 0.0], &gamma, 1e-15);
    differences.finish();
}

/// OndselSolver, testapp/fourbar.asmt: positions agree to 4e-12, velocities to 2e-11, accelerations to 3e-10 relative
/// to the largest entry, as stated with the table.
#[test]
fn ondsel_four_bar_over_a_full_cycle() {
    let table = ondsel_table();
    let times: Vec<_> = table.iter().map(|row| row.t).collect();
    let trajectory = OndselFourbar.kinematic_analysis(&times).unwrap();
    let mut differences = Differences::new();
    for (row, state) in table.iter().zip(&trajectory) {
        differences.at(format_args!("t = {}", row.t));
        let first = coordinate::<OndselFourbar>(&format!("{}.x", row.body));
        let levels = [(&state.q, 4e-12), (&state.q_dot, 2e-11), (&state.q_ddot, 3e-10)];
        for ((found, agreement), expected) in levels.into_iter().zip(row.levels) {
            let scale = expected.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
            differences.vector(row.body, |k| k, &expected, &found[first..first + 3], agreement * scale);
        }
    }
    differences.finish();
    assert_eq!(8, table.len());
}

struct OndselRow {
    t: f64,
    body: &'static str,
    levels: [[f64; 3]; 3],
}

/// The rows of the table in `PUBLISHED.md`: `t=0.2  coupler  x y φ | ẋ ẏ φ̇ | ẍ ÿ φ̈`.
fn ondsel_table() -> Vec<OndselRow> {
    let parse = |line: &'static str| {
        let (t, rest) = line.strip_prefix("t=")?.split_once(' ')?;
        let (body, numbers) = rest.trim().split_once(' ').filter(|(body, _)| ["coupler", "rocker"].contains(body))?;
        let numbers: Vec<f64> =
            numbers.split([' ', '|']).filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
        assert_eq!(9, numbers.len(), "{line}");
        let levels = [0, 3, 6].map(|from| std::array::from_fn(|k| numbers[from + k]));
        Some(OndselRow { t: t.parse().unwrap(), body, levels })
    };
    PUBLISHED.lines().filter_map(parse).collect()
}

/// Marghitu and Dupac, Advanced Dynamics, examples 5.5 and 5.6, to every printed digit.
#[test]
fn marghitu_and_dupac_six_link() {
    type M = MarghituSixLink;
    let mechanism = M::default();
    let state = state::<M>(0.0);
    let motion = mechanism.solver().motion(&state).unwrap();
    let of = |point: Point| motion[point];
    let (b, d, e, f) = (of(M::B), of(M::D), of(M::E), of(M::F));
    let (link3, link4): (Body, Body) = (M::link3, M::link4);
    let mut differences = Differences::new();
    differences.at("φ1 = 200°");
    let vectors = [
        ("B", [-0.141, -0.051], b.r),
        ("D", [-0.490, 0.061], d.r),
        ("E", [-0.550, 0.188], e.r),
        ("F", [0.176, -0.153], f.r),
        ("vB", [3.761, -10.332], b.v),
        ("aB", [757.409, 275.674], b.a),
        ("vD", [3.189, 9.885], d.v),
        ("aD", [73.937, -1527.948], d.a),
        ("vF", [-7.972, -24.713], f.v),
        ("aF", [-184.842, 3819.871], f.a),
    ];
    for (what, expected, found) in vectors {
        for axis in 0..2 {
            printed(&mut differences, what, expected[axis], found[axis], 3);
        }
    }
    printed(&mut differences, "φ3 in degrees", -17.878, motion[link3].phi.to_degrees(), 3);
    printed(&mut differences, "ω3", -51.934, motion[link3].phi_dot, 3);
    printed(&mut differences, "α3", 7157.347, motion[link3].phi_ddot, 3);
    printed(&mut differences, "ω4", 25.176, motion[link4].phi_dot, 3);
    printed(&mut differences, "α4", 882.339, motion[link4].phi_ddot, 3);
    printed(&mut differences, "vE", 8.383, e.v[1], 3);
    printed(&mut differences, "aE", -1660.866, e.a[1], 3);

    // The book's sliding velocity is that of the link relative to the slider, kin's stroke that of the slider relative
    // to the link.
    let joint = M::model().joints.iter().position(|joint| joint.name == "slide").unwrap();
    let stroke = M::model().joints[joint].quantities.iter().position(|q| q.name == "stroke").unwrap();
    let stroke = motion.joints[joint][stroke];
    printed(&mut differences, "sliding velocity", -6.751, -stroke.rate, 3);
    printed(&mut differences, "sliding acceleration", -1086.945, -stroke.acceleration, 3);
    let (sin, cos) = motion[link3].phi.sin_cos();
    let coriolis = 2.0 * motion[link3].phi_dot * -stroke.rate;
    printed(&mut differences, "Coriolis x", 215.270, -coriolis * sin, 3);
    printed(&mut differences, "Coriolis y", 667.364, coriolis * cos, 3);
    differences.finish();
}

/// The test set's angles and rates in the order (β, Θ, γ, Φ, δ, Ω, ε), from the absolute angles of the bodies K1 … K7.
fn andrews_angles(level: &[f64]) -> [f64; 7] {
    let k: Vec<f64> = (1..=7).map(|n| level[coordinate::<AndrewsPins>(&format!("K{n}.phi"))]).collect();
    [k[0], k[1] - k[0], k[2], k[3] - k[4], k[4], k[5] - k[6], k[6]]
}

/// The consistent initial values of the IVP test set, given with 30 digits: equal to the last digit of `f64`.
#[test]
fn andrews_squeezer_at_the_start() {
    let found = andrews_angles(&state::<AndrewsPins>(0.0).q);
    let expected = [
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_9,
        0.487_364_979_543_842_55,
        -0.222_668_390_165_885_9,
        1.230_547_444_549_821_2,
    ];
    let mut differences = Differences::new();
    differences.at("t = 0");
    differences.vector("angle", |k| k, &expected, &found, 1e-14);
    differences.finish();
}

/// The reference solution of the IVP test set at t = 0.03: given β and β̇, the rest agrees to 2e-15 and 2e-11 relative
/// to the largest entry; the tolerance is half a unit in the last digit of these bounds.
#[test]
fn andrews_squeezer_at_the_end() {
    let q = [
        15.810_771_196_299_04,
        -15.756_371_059_842_98,
        0.040_822_240_130_731_01,
        -0.534_730_116_322_694_8,
        0.524_409_965_880_530_4,
        0.534_730_116_322_694_8,
        1.048_080_741_042_263,
    ];
    let v = [
        1_139.920_302_151_208,
        -1_424.379_294_994_111,
        11.032_912_219_371_34,
        19.293_374_644_213_85,
        0.573_569_928_479_080_8,
        -19.293_374_644_213_85,
        0.323_179_165_802_695_5,
    ];
    let mechanism = AndrewsPins { beta: q[0], beta_dot: v[0], ..AndrewsPins::default() };
    let angles = [q[0], q[0] + q[1], q[2], q[3] + q[4], q[4], q[5] + q[6], q[6]];
    let mut solver = mechanism.solver();
    for (n, angle) in angles.into_iter().enumerate() {
        // The guess is rounded to two decimals, so that the solver has to find the rest.
        let rough = (angle * 100.0).round() / 100.0;
        solver = solver.with_guess(coordinate::<AndrewsPins>(&format!("K{}.phi", n + 1)), rough);
    }
    let state = solver.state(&Instant::at(0.0)).unwrap();
    let mut differences = Differences::new();
    differences.at("t = 0.03");
    differences.vector("angle", |k| k, &q, &andrews_angles(&state.q), 2.5e-15 * 15.8);
    differences.vector("rate", |k| k, &v, &andrews_angles(&state.q_dot), 2.5e-11 * 1_424.0);
    differences.finish();
}

/// A lecture by Nikravesh, to its 4 printed digits.
#[test]
fn nikravesh_four_bar_in_every_printed_digit() {
    let state = state::<NikraveshFourbar>(0.0);
    let mut differences = Differences::new();
    differences.at("θ1 = π/2");
    printed(&mut differences, "θ2", 0.5782, state.q[1], 4);
    printed(&mut differences, "θ3", 1.3357, state.q[2], 4);
    printed(&mut differences, "θ̇1", TAU, state.q_dot[0], 12);
    printed(&mut differences, "θ̇2", 0.7099, state.q_dot[1], 4);
    printed(&mut differences, "θ̇3", 3.4807, state.q_dot[2], 4);
    differences.finish();
}

/// Solutions 2 and 3 of the lecture describe the same four-bar with fewer coordinates: the angles are those of solution
/// 1.
#[test]
fn lecture_solutions_differ_in_their_coordinates_only() {
    assert_eq!([9, 7, 3], [FourbarLectureMid::COORDINATES, FourbarEnds::COORDINATES, FourbarRelative::COORDINATES]);
    let expected = [FRAC_PI_4, 0.915, 5.0];
    for q in [state::<FourbarEnds>(0.0).q, state::<FourbarRelative>(0.0).q] {
        let angles = match q[..] {
            [crank, _, _, coupler, _, _, rocker] => [crank, coupler, rocker],
            [crank, coupler, rocker] => [crank, coupler, rocker],
            _ => panic!("{} coordinates", q.len()),
        };
        for (expected, found) in expected.into_iter().zip(angles) {
            assert!((expected - found).abs() < 0.5e-3, "{angles:?}");
        }
    }
}
