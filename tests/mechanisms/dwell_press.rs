//! A press whose crank is driven by a motion with dwells.

use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::mechanism;

/// A slider-crank whose crank follows a motion with dwells, and two feeders with motions of their own.
#[mechanism]
#[function(program, feed)]
#[bodies(crank, rod, ram)]
#[body(feeder[2], y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), ram @ (0, 0))]
#[translational(guide: ground @ (0, 0), ram @ (0, 0), axis = (0, 1), angle = 0)]
#[driver(drive: crank.phi = program(t))]
#[driver(forth[i in 0..2]: feeder[i].x = 0.2 * place[i] + feed[i](t + shift[i]))]
#[guess(rod.phi = 1.7, ram.y = l)]
pub struct DwellPress {
    /// Angle of the crank over time
    pub program: Sequence,
    /// Strokes of the feeders over time
    pub feed: [Sequence; 2],
    /// Crank radius
    pub r: f64,
    /// Rod length
    pub l: f64,
    /// Places of the feeders
    pub place: [f64; 2],
    /// Times by which the feeders are ahead
    pub shift: [f64; 2],
}

impl Default for DwellPress {
    fn default() -> Self {
        let program = Sequence::starting_at(0.0, 0.3)
            .dwell(0.4)
            .rise(MotionLaw::Polynomial345, 1.9, 0.7)
            .dwell(0.2)
            .rise(MotionLaw::ModifiedSine, -1.4, 0.9)
            .build();
        let feed = [MotionLaw::Cycloidal, MotionLaw::ModifiedTrapezoidal].map(|law| {
            let feed = Sequence::starting_at(-0.2, 0.0).rise(law, 0.05, 0.8).dwell(0.1).return_to_start(law, 0.6);
            feed.periodic().expect("it returns")
        });
        let program = program.expect("a sound sequence");
        Self { program, feed, r: 0.12, l: 0.4, place: [1.0, 2.0], shift: [0.0, 0.38] }
    }
}
