//! Scores of forces against single solutions.

use crate::press::Press;
use crate::{directory, limits, table};
use kin_runtime::Kinematics;
use kin_study::{Range, Score, Study, Watch, run};

/// What a score makes of the forces at all instants.
type Rule = fn(&[f64]) -> f64;

#[test]
fn scores_of_forces_are_those_of_single_solutions() {
    let least: Rule = |values| values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest: Rule = |values| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mean: Rule = |values| values.iter().sum::<f64>() / values.len() as f64;
    let named = |name: &str| name.to_owned();
    let scores = [
        ("torque", Score::Greatest(named("drive.effort"))),
        ("back", Score::Least(named("drive.effort"))),
        ("pin", Score::Greatest(named("L.force"))),
        ("across", Score::Least(named("K.force_x"))),
        ("up", Score::Mean(named("T.force_y"))),
        ("tilt", Score::Greatest(named("guide.moment"))),
        ("shaking", Score::Greatest(named("shaking.force"))),
        ("moment", Score::Least(named("shaking.moment"))),
        ("kinetic", Score::Greatest(named("energy.kinetic"))),
        ("power", Score::Mean(named("power.drivers"))),
        ("applied", Score::Least(named("power.applied"))),
    ];
    let study = Study::new()
        .rows(20)
        .seed(2)
        .parameter("r", Range::Uniform { from: 0.05, to: 0.1 })
        .parameter("b", Range::Uniform { from: 0.4, to: 0.5 })
        .parameter("work", Range::Uniform { from: 0.0, to: 3e4 })
        .turn(0.0, 1.0, 50);
    let study = scores.iter().fold(study, |study, (name, score)| study.score(name, score.clone()));
    let target = directory();
    let report = run::<Press>(&study, target.path(), limits(1), &Watch::default()).expect("it runs");
    assert_eq!((report.done, report.ended), (20, 0));
    let times: Vec<f64> = (0..=50).map(|k| 0.02 * f64::from(k)).collect();
    for line in table(target.path()).lines().skip(1) {
        let number = |k: usize| line.split(',').nth(k).and_then(|text| text.parse::<f64>().ok()).expect("a number");
        let design = Press { r: number(1), b: number(2), work: number(3), ..Press::default() };
        let path = design.kinematic_analysis(&times).expect("it turns");
        let solver = design.solver();
        let forces: Vec<_> = path.states.iter().map(|state| solver.forces(state).expect("they are known")).collect();
        let of = |part: &dyn Fn(&kin_runtime::Forces) -> f64| forces.iter().map(part).collect::<Vec<_>>();
        let reaction = |name: &'static str, part: fn(&kin_runtime::Reaction) -> f64| {
            of(&|forces| part(forces.reactions.iter().find(|joint| joint.name == name).expect("it is a joint")))
        };
        let effort = of(&|forces| forces.efforts[0].effort.expect("it is determined"));
        let expected = [
            greatest(&effort),
            least(&effort),
            greatest(&reaction("L", |joint| joint.force.map_or(f64::NAN, |[x, y]| x.hypot(y)))),
            least(&reaction("K", |joint| joint.force.map_or(f64::NAN, |[x, _]| x))),
            mean(&reaction("T", |joint| joint.force.map_or(f64::NAN, |[_, y]| y))),
            greatest(&reaction("guide", |joint| joint.moment.expect("it is determined"))),
            greatest(&of(&|forces| forces.shaking.force[0].hypot(forces.shaking.force[1]))),
            least(&of(&|forces| forces.shaking.moment)),
            greatest(&of(&|forces| forces.kinetic)),
            mean(&of(&|forces| forces.driver_power)),
            least(&of(&|forces| forces.applied_power)),
        ];
        for ((name, _), (k, expected)) in scores.iter().zip(expected.into_iter().enumerate()) {
            let found = number(4 + k);
            assert!((found - expected).abs() <= 1e-8 * expected.abs().max(1.0), "{name}: {found}, not {expected}");
        }
    }
}
