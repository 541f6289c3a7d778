//! One tick of a controller: the lecture's excavator with the measured lengths of its three cylinders, including the
//! tip and its Jacobian with respect to them: `cargo bench -p kin-benches --bench controller`.

use kin_benches::paired::{Contender, compare};
use kin_benches::placed::Placed;
use kin_runtime::{Instant, Kinematics, Mechanism, Planned, Signal, mechanism};
use std::hint::black_box;

/// The number of ticks in a round.
const TICKS: usize = 1000;

/// An excavator arm with inputs for the lengths of its three cylinders.
#[mechanism]
#[bodies(boom, stick, lever, bucket)]
#[input(boom_length, stick_length, bucket_length)]
#[point(tip = bucket @ (0.5, -0.2))]
#[revolute(O: ground @ (0, 0.2), boom @ (0, 0))]
#[revolute(S: boom @ (3.1, 0.2), stick @ (0, 0))]
#[revolute(L: stick @ (1.25, 0.1), lever @ (-0.21, 0))]
#[revolute(B: stick @ (1.6, 0), bucket @ (-0.4, -0.1))]
#[distance(bucket_link: lever @ (0.19, 0.05), bucket @ (-0.15, 0.1), length = 0.4)]
#[distance(boom_cylinder: ground @ (0.45, -0.05), boom @ (1.4, 0.35), length = boom_length)]
#[distance(stick_cylinder: boom @ (1.5, 0.8), stick @ (-0.6, 0.15), length = stick_length)]
#[distance(bucket_cylinder: stick @ (0.25, 0.3), lever @ (0.21, 0), length = bucket_length)]
#[guess(boom.phi = 0.6, stick.phi = -1.3, lever.phi = -0.1, bucket.phi = -0.7)]
struct Excavator;

fn inputs(t: f64) -> [Signal; 3] {
    let (a, b) = ((0.8 * t).sin_cos(), (1.1 * t).sin_cos());
    [
        Signal::new(1.42 + 0.12 * a.0, 0.096 * a.1, -0.0768 * a.0),
        Signal::new(1.94 - 0.15 * t + 0.05 * t * t, -0.15 + 0.1 * t, 0.1),
        Signal::new(1.11 + 0.06 * b.1, -0.066 * b.0, -0.0726 * b.1),
    ]
}

fn main() {
    let of = |work: fn(&Planned<'static, Excavator>)| {
        let first = inputs(0.0);
        let at = Instant { t: 0.0, inputs: &first };
        let start = Excavator.state_at(&at).expect("it closes");
        let mut planned = Placed::new(move || Planned::owned(Excavator, &at, &start.q).expect("a plan"));
        let mut tick = 0;
        move || {
            let planned = planned.carried();
            for _ in 0..TICKS {
                // The motion goes back and forth over one second.
                tick = (tick + 1) % 2000;
                let t = 0.001 * f64::from(if tick < 1000 { tick } else { 2000 - tick });
                let inputs = inputs(t);
                planned.at(&Instant { t: black_box(t), inputs: &inputs }).expect("it follows");
                work(planned);
                black_box(planned.q());
            }
        }
    };
    let mut contenders = [
        Contender { name: "q, q̇, q̈ of one tick", work: Box::new(of(|_| ())) },
        Contender {
            name: "and place, velocity, acceleration of the tip",
            work: Box::new(of(|planned| {
                black_box(planned.point(Excavator::tip).expect("its point"));
            })),
        },
        Contender {
            name: "and its Jacobian to the three cylinders",
            work: Box::new(of(|planned| {
                let mut jacobian = [[0.0; 2]; Excavator::INPUTS];
                black_box(planned.point(Excavator::tip).expect("its point"));
                planned.point_jacobian(Excavator::tip, &mut jacobian).expect("three columns");
                black_box(&jacobian);
            })),
        },
    ];
    compare("One tick of the excavator", TICKS, &mut contenders);
}
