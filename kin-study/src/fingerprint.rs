//! A number that changes with a mechanism's description: parts of a directory must come from the same mechanism, which
//! its name and the defaults of its parameters do not tell apart from an edited one.

use kin_runtime::workspace::{Array, Subset};
use kin_runtime::{Instant, Mechanism, Signal, Solver};
use std::fmt::Write;

/// Numbers below this count as 0, since they may be rounding errors, which differ between processors.
const NOTHING: f64 = 1e-9;

/// Supplied functions are evaluated at arguments of both signs, whose sizes form a geometric sequence: the least, the
/// ratio, and how many.
const ARGUMENTS: (f64, f64, i32) = (1e-3, 1.02, 800);

/// Equations are evaluated several times: by how much the parameters differ from their defaults, each by a share of its
/// own, and the size of the coordinates. Parameters with the same default are told apart in this way, and a formula without
/// a value at one size, as the root of a difference, may have one at another.
const VARIANTS: [(f64, f64); 3] = [(0.0, 1.0), (0.1, 1.0), (0.1, 0.01)];

/// The fingerprint of a mechanism: a hash of its names, and of its guesses, default inputs, equations, points, loads and
/// functions, evaluated at configurations without any symmetry and rounded to six digits.
pub(crate) fn fingerprint<M: Mechanism>(mechanism: &M) -> u64 {
    let model = M::model();
    let mut text = format!("{:?} {:?} {:?}\n", model.coordinates, model.inputs, model.input_defaults);
    Solver::new(mechanism).guess().into_iter().for_each(|guess| write_number(&mut text, guess.unwrap_or(f64::NAN)));
    for row in model.rows {
        let _ = writeln!(text, "{}", row.name);
    }
    for point in model.points {
        let _ = writeln!(text, "{}", point.name);
    }
    for define in model.defines {
        let _ = writeln!(text, "{}", define.name);
    }
    VARIANTS.into_iter().for_each(|variant| write_equations(mechanism, variant, &mut text));
    let (least, ratio, count) = ARGUMENTS;
    for (index, name) in model.functions.iter().enumerate() {
        let _ = writeln!(text, "{name}");
        for x in (0..count).map(|k| least * ratio.powi(k)).flat_map(|x| [x, -x]) {
            let values = mechanism.evaluate_function(index, x).unwrap_or([f64::NAN; 3]);
            write_number(&mut text, values[0]);
        }
    }
    hash(&text)
}

/// Writes equations, observables and loads at one configuration, with parameters that differ by `share` from their defaults.
fn write_equations<M: Mechanism>(mechanism: &M, (share, size): (f64, f64), text: &mut String) {
    // The fractional parts of multiples of the golden ratio are nowhere near each other.
    let number = |k: usize| 0.2 + (0.618_033_988_749_895 * (k + 1) as f64).fract();
    let vector = |from: usize| {
        let mut vector = M::Coordinates::<f64>::filled(0.0);
        vector.as_mut().iter_mut().enumerate().for_each(|(k, x)| *x = size * number(from + k));
        vector
    };
    let [q, q_dot, q_ddot] = [0, 1, 2].map(|order| vector(order * M::COORDINATES));
    let inputs: Vec<Signal> = (0..M::INPUTS).map(|k| Signal::new(number(k), 0.3, 0.7)).collect();
    let at = Instant { t: 0.37, inputs: &inputs };
    let mut parameters = mechanism.parameters::<f64>();
    for (k, parameter) in parameters.as_mut().iter_mut().enumerate() {
        *parameter += share * number(k) * if *parameter == 0.0 { 1.0 } else { *parameter };
    }
    let (mut workspace, mut observations) = (M::workspace::<f64>(), M::observations::<f64>());
    let mut forces = M::Coordinates::<f64>::filled(0.0);
    let (q, q_dot) = (q.as_ref(), q_dot.as_ref());
    // All lists have the lengths that the mechanism requires.
    let written = [
        mechanism.evaluate_with(parameters.as_ref(), Subset::ALL, &at, q, q_dot, &mut workspace),
        mechanism.observe_with(parameters.as_ref(), &at, q, q_dot, &mut observations),
        mechanism.generalized_forces_with(parameters.as_ref(), &at, q, q_dot, q_ddot.as_ref(), forces.as_mut()),
    ];
    debug_assert!(written.iter().all(Result::is_ok), "{written:?}");
    let rows = [workspace.phi(), workspace.phi_q(), workspace.phi_t(), workspace.gamma()];
    let observed = [observations.phi(), observations.phi_t(), forces.as_ref()];
    rows.into_iter().chain(observed).flatten().for_each(|x| write_number(text, *x));
}

/// Writes six digits of a number.
fn write_number(text: &mut String, x: f64) {
    let _ = if x.abs() < NOTHING { writeln!(text, "0") } else { writeln!(text, "{x:.5e}") };
}

/// FNV-1a, which is the same on all machines and in all versions.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::{fingerprint, hash};
    use kin_runtime::mechanism;

    #[test]
    fn the_hash_is_that_of_the_published_vectors() {
        assert_eq!([hash(""), hash("a"), hash("foobar")], [0xcbf29ce484222325, 0xaf63dc4c8601ec8c, 0x85944171f73967e8]);
    }

    /// A length that occurs in `$e`.
    macro_rules! length {
        ($name:ident, $value:literal, $e:expr) => {
            #[mechanism]
            #[coordinates(x, y)]
            #[input(u, default = $value)]
            #[constraint(c: y = $e)]
            #[driver(d: x = u)]
            struct $name {
                #[param(0.1)]
                a: f64,
                #[param(0.1)]
                b: f64,
            }
        };
    }

    length!(First, 1.0, sqrt(a * a - x * x));
    length!(Second, 1.0, sqrt(b * b - x * x));
    length!(Half, 1.0, sqrt(0.25 * a * a - x * x));
    length!(OtherInput, 2.0, sqrt(a * a - x * x));

    /// Parameters with the same default, a formula without a value at x = 0.8, and the default of an input.
    #[test]
    fn mechanisms_that_differ_in_one_place_have_other_fingerprints() {
        let all = [
            fingerprint(&First::default()),
            fingerprint(&Second::default()),
            fingerprint(&Half::default()),
            fingerprint(&OtherInput::default()),
        ];
        for (k, one) in all.iter().enumerate() {
            assert!(!all[..k].contains(one), "{k}: {all:x?}");
        }
    }
}
