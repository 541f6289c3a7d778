//! Whole mechanisms against an evaluation that builds no expressions: names, Φ and everything that is reported, and
//! the derivatives of both by dual numbers and by the definition of γ.

mod support;

use kin_core::constraint::ObservableKind;
use kin_core::expr::ExprId;
use kin_core::mechanism::{BodyRef, Component, Index, Mechanism, Relation};
use kin_core::program::Slot;
use kin_core::system::{Equation, KinematicSystem};
use kin_core::{assemble, differentiate};
use num_dual::{Dual2_64, Dual64};
use support::*;

const MECHANISMS: u64 = 50;

/// A random mechanism, differentiated, and a random instant of it.
fn case(seed: u64) -> (Mechanism, KinematicSystem, Values) {
    let mechanism = mechanism(seed);
    let set = assemble(&mechanism).unwrap_or_else(|errors| panic!("seed {seed}: {errors:?}"));
    let mut random = Random(!seed);
    let mut some = |n: usize, a: f64, b: f64| (0..n).map(|_| random.between(a, b)).collect::<Vec<f64>>();
    let values = Values {
        parameters: some(set.parameters.len(), 0.3, 1.5),
        t: some(1, -1.0, 1.0)[0],
        inputs: (0..2).map(|_| [0; 3].map(|_| some(1, -1.0, 1.0)[0])).collect(),
        q: some(set.coordinates.len(), -1.5, 1.5),
        q_dot: some(set.coordinates.len(), -1.5, 1.5),
    };
    (mechanism, differentiate(set).expect("no third derivatives"), values)
}

/// The mechanism itself with numbers of any kind.
fn direct<'m, S: Number>(
    mechanism: &'m Mechanism,
    values: &'m Values,
    number: impl Fn(kin_core::expr::Symbol) -> S,
) -> Direct<'m, S> {
    use kin_core::expr::Symbol::{Coordinate, Input, Time};
    let inputs = (0..values.inputs.len() as u32).map(|k| number(Input(k, 0))).collect();
    let q = (0..values.q.len() as u32).map(|k| number(Coordinate(k))).collect();
    Direct::new(mechanism, &values.parameters, number(Time), inputs, q)
}

/// The rows, then the observables of bodies, points and defines, in the order of the system's own lists.
fn everything<S: Number>(system: &KinematicSystem, direct: &Direct<'_, S>) -> Vec<(String, S)> {
    let mut out = direct.rows();
    let mechanism = direct.mechanism;
    for observable in &system.set.observables {
        let pick = |r: Complex<S>, component| if component == Component::X { r.x } else { r.y };
        let value = match observable.kind {
            ObservableKind::Pose(body, component) => {
                let (family, index) = system.set.bodies[body].family;
                let index = Index::constant(index as i64);
                let (r, phi) = direct.pose(&BodyRef::Body { family, index, origin: AT }, 0);
                if component == Component::Phi { phi } else { pick(r, component) }
            }
            ObservableKind::Point(point, component) => {
                let (family, index) = system.set.points[point].family;
                pick(direct.point(&mechanism.points[family].place, index as i64), component)
            }
            ObservableKind::Define(define) => {
                let (family, index) = system.set.defines[define].family;
                direct.formula(&mechanism.defines[family].formula, index as i64)
            }
            ObservableKind::Condition(condition) => {
                let (family, index) = system.set.conditions[condition].family;
                let condition = &mechanism.conditions[family];
                let sides = [&condition.left, &condition.right].map(|side| direct.formula(side, index));
                match condition.relation {
                    Relation::Greater => sides[0] - sides[1],
                    Relation::Less => sides[1] - sides[0],
                }
            }
            ObservableKind::Joint(..) => continue,
        };
        out.push((format!("{:?}", observable.kind), value));
    }
    out
}

/// The equations that belong to [`everything`].
fn equations(system: &KinematicSystem) -> Vec<&Equation> {
    let reported = (system.set.observables.iter().zip(&system.observables))
        .filter(|(observable, _)| !matches!(observable.kind, ObservableKind::Joint(..)))
        .map(|(_, equation)| equation);
    system.equations.iter().chain(reported).collect()
}

#[test]
fn names_are_those_of_the_language() {
    for seed in 0..MECHANISMS {
        let (mechanism, system, values) = case(seed);
        let names: Vec<&str> = system.set.coordinates.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, coordinate_names(&mechanism), "seed {seed}");
        let rows: Vec<String> = system.set.rows.iter().map(|row| row.name.clone()).collect();
        let expected = direct(&mechanism, &values, values.plain::<f64>()).rows();
        assert_eq!(rows, expected.into_iter().map(|(name, _)| name).collect::<Vec<_>>(), "seed {seed}");
        let mut next = 0;
        for (place, joint) in system.set.joints.iter().enumerate() {
            assert_eq!(joint.first_row, next);
            next += joint.rows;
            assert!(system.set.rows[joint.first_row..next].iter().all(|row| row.joint == place));
        }
        assert_eq!(next, system.set.rows.len());
    }
}

#[test]
fn families_have_indexed_names() {
    let set = assemble(&chain(4)).expect("a sound mechanism");
    let coordinates: Vec<&str> = set.coordinates.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(coordinates[..4], ["crank[0].x", "crank[0].y", "crank[0].phi", "crank[1].x"]);
    assert_eq!(coordinates[35], "rocker[3].phi");
    let rows: Vec<&str> = set.rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(rows[..3], ["C[0].x", "C[0].y", "C[1].x"]);
    assert_eq!(rows[32..], ["turn[1]", "turn[2]", "turn[3]", "drive"]);
    assert_eq!(set.parameters[..5], ["l1[0]", "l1[1]", "l1[2]", "l1[3]", "l2[0]"]);
}

#[test]
fn phi_is_what_the_table_says() {
    let mut compared = 0;
    for seed in 0..MECHANISMS {
        let (mechanism, system, values) = case(seed);
        let expected = everything(&system, &direct(&mechanism, &values, values.plain::<Bounded>()));
        let phi: Vec<ExprId> = equations(&system).iter().map(|equation| equation.phi).collect();
        let found = evaluate(&system.set.graph, &phi, &values);
        assert_eq!(expected.len(), found.len());
        for ((name, expected), found) in expected.iter().zip(found) {
            if expected.is_sound() {
                compared += 1;
                assert!(expected.agrees(found), "seed {seed}, {name}: expected {expected:?}, found {found}");
            }
        }
    }
    assert!(compared > 80 * MECHANISMS / 2, "only {compared} values were compared");
}

#[test]
fn derivatives_are_those_of_dual_numbers() {
    let mut compared = 0;
    for seed in 0..MECHANISMS {
        let (mechanism, system, values) = case(seed);
        let graph = &system.set.graph;
        let motion: Vec<(String, Dual2_64)> = everything(&system, &direct(&mechanism, &values, values.motion()));
        let in_time = everything(&system, &direct(&mechanism, &values, values.along_time()));
        let along: Vec<Vec<(String, Dual64)>> = (0..values.q.len() as u32)
            .map(|k| everything(&system, &direct(&mechanism, &values, values.along(k))))
            .collect();
        for (place, equation) in equations(&system).into_iter().enumerate() {
            let (name, motion) = &motion[place];
            let scale = motion.re.abs() + motion.v1.abs() + motion.v2.abs() + 1.0;
            let mut check = |what: &str, id: ExprId, dual: f64| {
                let Some(mut expected) = bounded(graph, id, values.plain()).filter(|_| dual.is_finite()) else {
                    return;
                };
                expected.error += 1e-15 * scale;
                compared += 1;
                assert!(expected.agrees(dual), "seed {seed}, {what} of {name}: expected {expected:?}, dual {dual}");
            };
            check("Φ_t", equation.phi_t, in_time[place].1.eps);
            check("γ", equation.gamma, -motion.v2);
            for (k, along) in along.iter().enumerate() {
                match equation.phi_q.iter().find(|(column, _)| *column as usize == k) {
                    Some((_, entry)) => check("Φ_q", *entry, along[place].1.eps),
                    None => {
                        let dual = along[place].1.eps;
                        assert!(
                            dual.abs() <= 1e-9 * scale || !dual.is_finite(),
                            "seed {seed}: {name} lacks column {k}, {dual}"
                        );
                    }
                }
            }
        }
    }
    assert!(compared > 100 * MECHANISMS, "only {compared} values were compared");
}

#[test]
fn gamma_is_its_definition() {
    let mut compared = 0;
    for seed in 0..MECHANISMS / 5 {
        let (_, system, values) = case(seed);
        let mut graph = system.set.graph.clone();
        for (row, equation) in system.equations.iter().enumerate() {
            let n = system.set.coordinates.len() as u32;
            let definition = gamma(&mut graph, equation.phi, n, 2);
            let (expected, found) =
                (bounded(&graph, definition, values.plain()), bounded(&graph, equation.gamma, values.plain()));
            if let (Some(mut expected), Some(found)) = (expected, found) {
                expected.error += found.error;
                compared += 1;
                let name = &system.set.rows[row].name;
                assert!(expected.agrees(found.value), "seed {seed}, {name}: {expected:?}, {found:?}");
            }
        }
    }
    assert!(compared > 8 * MECHANISMS / 5, "only {compared} rows were compared");
}

#[test]
fn rows_know_whether_time_moves_them() {
    use kin_core::vocabulary::JointKind;
    for seed in 0..MECHANISMS {
        let (mechanism, system, values) = case(seed);
        let later = Values { t: values.t + 0.37, inputs: vec![[0.91, 0.0, 0.0], [-0.73, 0.0, 0.0]], ..values.clone() };
        let now = direct(&mechanism, &values, values.plain::<Bounded>()).rows();
        let then = direct(&mechanism, &later, later.plain::<f64>()).rows();
        for (row, class) in system.classes.iter().enumerate() {
            let name = &now[row].0;
            assert!(class.holonomic);
            if now[row].1.is_sound() && !now[row].1.agrees(then[row].1) {
                assert!(class.rheonomic, "seed {seed}: {name} moves with time");
            }
            let equation = &system.equations[row];
            if !class.rheonomic {
                assert!(system.set.graph.is_zero(equation.phi_t), "seed {seed}: Φ_t of {name}");
            }
            let joint = &system.set.joints[system.set.rows[row].joint];
            let own = system.set.rows[row].operands_move;
            assert_eq!(class.driving, class.rheonomic && own || joint.kind == JointKind::Driver, "seed {seed}: {name}");
        }
        // A mechanism that never looks at t or an input has no rheonomic row.
        let looked = direct(&mechanism, &values, values.plain::<f64>());
        looked.rows();
        assert!(looked.saw_time.get() || system.classes.iter().all(|class| !class.rheonomic));
    }
}

#[test]
fn programs_compute_the_system() {
    for seed in 0..MECHANISMS {
        let (_, system, values) = case(seed);
        let program = combined(&system);
        let found = interpret(&program, &values);
        let mut outputs = found.iter();
        for (row, equation) in system.equations.iter().enumerate() {
            let entries = equation.phi_q.iter().map(|(_, e)| (None, *e));
            let parts = [(Some(Slot::Phi(row)), equation.phi)]
                .into_iter()
                .chain(entries)
                .chain([(Some(Slot::PhiT(row)), equation.phi_t), (Some(Slot::Gamma(row)), equation.gamma)]);
            for (slot, id) in parts {
                let (found_slot, found) = outputs.next().expect("as many outputs as were asked for");
                assert!(slot.is_none_or(|slot| slot == *found_slot));
                if let Some(expected) = bounded(&system.set.graph, id, values.plain()) {
                    assert!(expected.agrees(*found), "seed {seed}, {found_slot:?}: {expected:?}, {found}");
                }
            }
        }
        assert!(outputs.next().is_none());
    }
}

#[test]
fn the_same_mechanism_gives_the_same_program() {
    for seed in 0..20 {
        let build = || {
            let system =
                differentiate(assemble(&mechanism(seed)).expect("a sound mechanism")).expect("no third derivatives");
            (combined(&system).to_string(), system.to_string())
        };
        assert_eq!(build(), build(), "seed {seed}");
    }
}
