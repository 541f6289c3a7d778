//! The printed M and Q of M q̈ + Φ_qᵀ λ = Q, read and evaluated, give the same Q − M q̈ as the code.

#[path = "../laws/typeset/latex.rs"]
mod latex;

use kin_core::notation::{Name, Notation};
use kin_runtime::{Instant, Mechanism, cli};
use kin_tests::mechanisms::loaded;
use kin_tests::random::Random;
use latex::{Reader, Value};
use std::collections::HashMap;

/// The displayed equations of the document that the program writes, by their left sides.
fn printed<M: Mechanism + Default>() -> HashMap<String, String> {
    let file = format!("{}/forces-{}.tex", env!("CARGO_TARGET_TMPDIR"), M::model().name);
    assert_eq!(std::process::ExitCode::SUCCESS, cli::run_from::<M>(["program", "equations", "--out", &file]));
    let document = std::fs::read_to_string(&file).unwrap();
    assert!(document.contains(r"M \ddot q + \Phi_q^{\mathsf T} \lambda &= Q"), "the law stands above its entries");
    let whole =
        document.replace(" \\\\\n&\\quad {} ", " ").replace(r"\bigl(", r"\left(").replace(r"\bigr)", r"\right)");
    let lines = whole.lines().filter_map(|line| line.trim_end_matches(" \\\\").split_once(" &= "));
    lines.map(|(left, right)| (left.to_owned(), right.to_owned())).collect()
}

/// Q − M q̈ from the printed entries is r of the code, at random configurations.
fn m_and_q_are_the_code<M: Mechanism + Default>() {
    let (mechanism, model, printed) = (M::default(), M::model(), printed::<M>());
    let parameters = mechanism.parameters::<f64>();
    let name = |name: &str| Name::new(name).write(Notation::Latex);
    let names: Vec<String> = model.coordinates.iter().map(|info| name(info.name)).collect();
    let (n, mut random, mut entries) = (M::COORDINATES, Random::new(89), 0);
    for _ in 0..3 {
        let t = random.between(0.0, 1.0);
        let [q, q_dot, q_ddot] = [1.5, 2.0, 2.0].map(|size| random.vector(n, -size, size));
        let mut symbols = HashMap::from([(name("t"), Value::of(t)), (name("pi"), Value::of(std::f64::consts::PI))]);
        for (info, value) in model.parameters.iter().zip(parameters.as_ref()) {
            symbols.insert(name(info.name), Value::of(*value));
        }
        for (k, info) in model.coordinates.iter().enumerate() {
            symbols.insert(names[k].clone(), Value::of(q[k]));
            symbols.insert(name(&format!("{}_dot", info.name)), Value::of(q_dot[k]));
        }
        let mut r = vec![0.0; n];
        let at = Instant { t, inputs: &[] };
        mechanism.generalized_forces_with(parameters.as_ref(), &at, &q, &q_dot, &q_ddot, &mut r).unwrap();
        let mut reader = Reader { symbols: &symbols, function: &|_, _, _| None };
        let mut value = |left: &str| {
            let text = printed.get(left)?;
            Some(reader.read(text).unwrap_or_else(|error| panic!("{left} = {text}: {error}")))
        };
        for j in 0..n {
            let mut sum = value(&format!("Q_{{{}}}", names[j])).unwrap_or(Value::of(0.0));
            for (k, q_ddot) in q_ddot.iter().enumerate() {
                let [low, high] = [j.min(k), j.max(k)];
                if let Some(entry) = value(&format!("M_{{{},\\,{}}}", names[low], names[high])) {
                    entries += 1;
                    sum.value -= entry.value * q_ddot;
                    sum.size = sum.size.max(entry.size * q_ddot.abs());
                }
            }
            let size = sum.size.max(r[j].abs()).max(1.0);
            assert!((sum.value - r[j]).abs() <= 1e-12 * size, "{}: {sum:?} instead of {}", names[j], r[j]);
        }
    }
    assert!(entries >= 3 * model.bodies.len(), "{entries} entries of M");
}

macro_rules! typeset {
    ($($name:ident: $Mechanism:ident;)*) => {$(
        #[test]
        fn $name() {
            m_and_q_are_the_code::<loaded::$Mechanism>();
        }
    )*};
}

typeset! {
    bogie_on_rail: BogieOnRail;
    cam_oscillating_follower: CamOscillatingFollower;
    excavator: Excavator;
    fourbar_lecture_angles: FourbarLectureAngles;
    fourbar_lecture_mid: FourbarLectureMid;
    macpherson_strut: MacphersonStrut;
    planetary_basic: PlanetaryBasic;
    quick_return: QuickReturn;
}
