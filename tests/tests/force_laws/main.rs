//! Laws of forces for every test mechanism, with a mass on every body and random loads of every kind.
//!
//! The build script writes the mechanisms with their masses and loads, and a table of these beside each. The forces
//! that the accelerations of bodies require are computed from that table and from the motion; the forces that act on
//! them, from the reported reactions.

mod bodies;
mod energy;
mod equilibrium;
mod machines;
mod vocabulary;
mod work;

use kin_runtime::{Forces, Kinematics, SolveError, State, Trajectory};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::write_signals;

/// The test mechanisms with masses and loads.
#[allow(dead_code, unreachable_pub, unused_imports, clippy::approx_constant)]
mod weighted {
    include!(concat!(env!("OUT_DIR"), "/weighted.rs"));
}
use weighted::*;

/// A place on a body: its name, or `ground`, and the point in its frame.
type Place = (&'static str, [f64; 2]);

/// The masses and loads of a mechanism.
struct Loads {
    gravity: [f64; 2],
    /// Centre, mass, moment of inertia about it.
    masses: &'static [(Place, f64, f64)],
    /// Place, components, and whether these turn with the body.
    forces: &'static [(Place, [f64; 2], bool)],
    /// The body on which it reacts, the body that it turns, and the couple.
    torques: &'static [(Option<&'static str>, &'static str, f64)],
    /// Both ends, and stiffness, free length and damping.
    springs: &'static [(Place, Place, [f64; 3])],
    /// Both bodies, and stiffness, free angle and damping.
    torsion_springs: &'static [(&'static str, &'static str, [f64; 3])],
}

/// A mechanism whose masses and loads are known.
trait Weighted: Kinematics + Default {
    const LOADS: Loads;
}

macro_rules! force_laws {
    (
        moving { $($name:ident: $Mechanism:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(mod $name {
            use crate::*;

            #[test]
            fn reactions_balance_every_body() {
                equilibrium::reactions_balance_every_body::<$Mechanism>($from, $to);
            }

            #[test]
            fn power_is_the_rate_of_energy() {
                energy::power_is_the_rate_of_energy::<$Mechanism>($from, $to);
            }
        })*

        /// The kinds of joints of all mechanisms.
        fn kinds() -> Vec<(&'static str, &'static [kin_runtime::model::JointInfo])> {
            vec![$((stringify!($Mechanism), <$Mechanism as kin_runtime::Mechanism>::model().joints)),*]
        }
    };
}

every_mechanism!(force_laws);

fn swept<M: Weighted>(mechanism: &M, times: &[f64]) -> Trajectory {
    mechanism.solver().with_inputs(&write_signals::<M>).sweep(times).unwrap_or_else(|error| panic!("{error}"))
}

/// The forces at a state, the least ones where redundant rows share them. None for a mechanism without bodies, which has
/// no masses, and where loads act along degrees of freedom that no driver holds: there they must be refused.
fn forces_at<M: Weighted>(mechanism: &M, state: &State) -> Option<Forces> {
    match mechanism.solver().forces_of_least_norm(state) {
        Err(SolveError::NoLoads { .. }) if M::model().bodies.is_empty() => None,
        Err(SolveError::NotHeld { open, .. }) if state.degrees_of_freedom_left > 0 => {
            assert_eq!(state.degrees_of_freedom_left, open);
            None
        }
        Err(error) => panic!("{error}"),
        Ok(_) if state.degrees_of_freedom_left > 0 => panic!("{} degrees are free", state.degrees_of_freedom_left),
        Ok(forces) => Some(forces),
    }
}
