//! Closed chains with several degrees of freedom: pantograph and parallel robot.

use crate::page::says;
use crate::{close, moved, range};
use kin_runtime::model::Point;
use kin_runtime::{Instant, Kinematics};
use kin_tests::examples::{pantograph::Pantograph, robot_3rrr::Robot3rrr, robot_closures::RobotClosures};
use std::f64::consts::{PI, TAU};

#[test]
fn the_pantograph_enlarges_by_one_ratio() {
    for ratio in [2.5, 4.0] {
        let pantograph = Pantograph { ratio, size: 0.0075 / ratio, at_x: 0.5 / ratio, ..Pantograph::default() };
        for (_, at) in moved(&pantograph, 0.0, TAU, 180) {
            let (stylus, pen) = (at[Pantograph::stylus], at[Pantograph::pen]);
            for axis in 0..2 {
                close(pen.r[axis], ratio * stylus.r[axis], 2e-15);
                close(pen.v[axis], ratio * stylus.v[axis], 1e-14);
                close(pen.a[axis], ratio * stylus.a[axis], 1e-13);
            }
        }
    }
    let motion = moved(&Pantograph::default(), 0.0, TAU, 360);
    let width = |point: Point| {
        let (low, high) = range(motion.iter().map(|(_, at)| at[point].r[0]));
        1e3 * (high - low)
    };
    let text =
        format!("a heart of {:.0} mm becomes one of {:.0} mm", width(Pantograph::stylus), width(Pantograph::pen));
    says("pantograph", &text);
}

/// The angle of a crank by the law of cosines, with the elbow on the left as seen from the motor.
#[test]
fn the_robots_motors_turn_as_its_inverse_kinematics_says() {
    let robot = Robot3rrr { angle: 0.1, ..Robot3rrr::default() };
    for (_, at) in moved(&robot, 0.0, 1.0, 60) {
        let tool = at[Robot3rrr::tool];
        for leg in 0..3 {
            let direction = TAU / 3.0 * leg as f64 - 5.0 * PI / 6.0;
            let motor = [robot.base * direction.cos(), robot.base * direction.sin()];
            let corner = direction + robot.angle;
            let wrist = [tool.r[0] + robot.size * corner.cos(), tool.r[1] + robot.size * corner.sin()];
            let (dx, dy) = (wrist[0] - motor[0], wrist[1] - motor[1]);
            let d = dx.hypot(dy);
            let crank = dy.atan2(dx) + (0.5 * d / robot.l).acos();
            close((at[Robot3rrr::crank[leg]].phi - crank + 1.0).rem_euclid(TAU), 1.0, 1e-14);
            // Its rate: the velocities of wrist and elbow along the rod are equal.
            let elbow = [motor[0] + robot.l * crank.cos(), motor[1] + robot.l * crank.sin()];
            let rod = [wrist[0] - elbow[0], wrist[1] - elbow[1]];
            let along = rod[0] * tool.v[0] + rod[1] * tool.v[1];
            let lever = rod[1] * (elbow[0] - motor[0]) - rod[0] * (elbow[1] - motor[1]);
            close(at[Robot3rrr::crank[leg]].phi_dot, along / lever, 1e-12);
        }
    }
    let motion = moved(&Robot3rrr::default(), 0.0, 1.0, 360);
    let swing = |leg: usize| {
        let (low, high) = range(motion.iter().map(|(_, at)| at[Robot3rrr::crank[leg]].phi));
        (high - low).to_degrees()
    };
    // The robot and the circle are symmetric.
    (1..3).for_each(|leg| close(swing(leg), swing(0), 0.05));
    says("robot_3rrr", &format!("every motor swings by {:.1}°", swing(0)));
}

/// With elbows E and corners s, |p + s(φ) − E|² = m² for all three legs. Two differences of these equations are linear in the
/// platform's position p; the third is then a function of φ alone, whose changes of sign are counted.
#[test]
fn the_robot_stands_in_as_many_ways_as_an_elimination_says() {
    let RobotClosures { base, size, l, m } = RobotClosures::default();
    let motors = [0.5, 0.3, -0.7_f64];
    let direction = |leg: usize| TAU / 3.0 * leg as f64 - 5.0 * PI / 6.0;
    let square = |w: [f64; 2]| w[0] * w[0] + w[1] * w[1];
    let miss = |phi: f64| {
        let away = [0, 1, 2].map(|leg| {
            let (d, motor) = (direction(leg), motors[leg]);
            let elbow = [base * d.cos() + l * motor.cos(), base * d.sin() + l * motor.sin()];
            [size * (d + phi).cos() - elbow[0], size * (d + phi).sin() - elbow[1]]
        });
        let row = |leg: usize| [0, 1].map(|k| 2.0 * (away[leg][k] - away[0][k]));
        let ([a, b], [c, d]) = (row(1), row(2));
        let (u, v) = (square(away[0]) - square(away[1]), square(away[0]) - square(away[2]));
        let det = a * d - b * c;
        let p = [u * d - v * b + det * away[0][0], a * v - c * u + det * away[0][1]];
        square(p) - det * det * m * m
    };
    let steps = 36_000;
    let at = |k: i32| miss(PI * (2.0 * f64::from(k) / f64::from(steps) - 1.0));
    let expected = (0..steps).filter(|&k| at(k) * at(k + 1) < 0.0).count();
    let all = RobotClosures::default().solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete(), "{all}");
    assert_eq!(all.found.len(), expected);
    says("robot_closures", &format!("in {expected} ways"));
}
