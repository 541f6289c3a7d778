//! A mechanism solved by its plan at one instant after the other: what is named in an error, what stays after one.

use kin_runtime::planned::{PlanError, Planned, Sign};
use kin_runtime::{Instant, Kinematics, Mechanism, Signal, mechanism};
use std::f64::consts::TAU;

/// A boom on a cylinder, both of a length that is told, and a stick; time is nowhere in it.
#[mechanism]
#[input(ram, tilt)]
#[bodies(boom, stick)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (foot, 0), boom @ (arm, 0), length = ram)]
#[revolute(elbow: boom @ (1.5, 0), stick @ (0, 0))]
#[driver(turn: stick.phi = boom.phi + tilt + 0 * reach)]
#[guess(boom.phi = 0.8)]
struct Crane {
    #[param(1.0)]
    foot: f64,
    #[param(1.2)]
    arm: f64,
    #[param(0.0)]
    reach: f64,
}

const TOLD: [Signal; 2] = [Signal::new(0.9, 0.1, -0.2), Signal::new(0.3, 0.2, 0.1)];

fn said(result: Result<&Planned<'_, Crane>, PlanError>) -> String {
    result.map(Planned::t).unwrap_err().to_string()
}

#[test]
fn what_is_not_a_number_is_named_and_the_last_good_state_stays() {
    let (crane, good) = (Crane::default(), Instant { t: 0.5, inputs: &TOLD });
    let mut planned = crane.solver().planned(&good).unwrap();
    let before = [planned.q(), planned.q_dot(), planned.q_ddot()].map(<[f64]>::to_vec);
    for bad in [f64::NAN, f64::INFINITY] {
        for part in 0..3 {
            for (place, name) in [(0, "ram"), (1, "tilt")] {
                let mut told = TOLD;
                let number = &mut told[place];
                *[&mut number.value, &mut number.rate, &mut number.acceleration][part] = bad;
                let error = said(planned.at(&Instant { t: 0.6, inputs: &told }));
                assert_eq!(format!("inputs[{place}] ({name}) is not a finite number at t = 0.6"), error);
            }
        }
        assert!(said(planned.at(&Instant { t: bad, inputs: &TOLD })).starts_with("t[0] (t) is not a finite number"));
        for (place, name) in [(0, "foot"), (1, "arm")] {
            let mut broken = Crane::default();
            assert!(broken.set_parameter(place, bad));
            let error = Planned::new(&broken, &good, planned.q()).unwrap_err().to_string();
            assert_eq!(format!("parameters[{place}] ({name}) is not a finite number at t = 0.5"), error);
        }
    }
    assert_eq!(before, [planned.q(), planned.q_dot(), planned.q_ddot()].map(<[f64]>::to_vec));
    assert_eq!(0.5, planned.t());
    assert!(planned.at(&Instant { t: 0.6, inputs: &TOLD }).is_ok());
}

#[test]
fn a_restart_that_fails_leaves_the_modes_as_they_were() {
    let (crane, good) = (Crane::default(), Instant { t: 0.0, inputs: &TOLD });
    let mut planned = crane.solver().planned(&good).unwrap();
    let (q, sign) = (planned.q().to_vec(), planned.mode(0).unwrap());
    let other = crane.solver().with_mode(0, sign.flipped()).assemble(&good).unwrap();
    // Longer than foot and arm together.
    let long = [Signal::new(3.0, 0.0, 0.0), TOLD[1]];
    let error = planned.restart(&Instant { t: 0.1, inputs: &long }, &other).unwrap_err();
    assert!(matches!(error, PlanError::Limit { t: 0.1, limit } if limit.margin < 0.0), "{error}");
    assert_eq!((Some(sign), 0.0), (planned.mode(0), planned.t()));
    assert_eq!(q, planned.at(&good).unwrap().q());
    assert_eq!(Some(sign.flipped()), planned.restart(&good, &other).unwrap().mode("pin-cylinder"));
    assert_eq!(None, Sign::of(0.0));
}

/// A pin that runs in a slot about almost the same pivot: the slot turns as the crank does, faster and faster.
#[mechanism]
#[bodies(crank, slot)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (0.0001, 0), slot @ (0, 0))]
#[point_on_line(pin: slot @ (0, 0), crank @ (1, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 100 * t + 50 * t * t)]
#[guess(slot.phi = 0.01)]
struct Spinning;

#[test]
fn fast_bodies_go_on_counting_over_many_turns() {
    let slot = Spinning::model().coordinates.iter().position(|c| c.name == "slot.phi").unwrap();
    let mut planned = Spinning.solver().planned(&Instant::at(0.0)).unwrap();
    let begun = planned.q()[slot];
    for k in 1..=20 {
        // Several turns from one instant to the next, and more than a radian of it by acceleration alone.
        let t = 0.2 * f64::from(k);
        let turned = planned.at(&Instant::at(t)).unwrap().q()[slot] - begun;
        assert!((turned - (100.0 + 50.0 * t) * t).abs() < 0.1, "{t}: {turned}, {} turns", turned / TAU);
    }
}
