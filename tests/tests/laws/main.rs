//! Laws that every mechanism obeys, tested for all test mechanisms.

mod commands;
mod drawing;
mod equations;
mod examples;
mod finite;
mod four_bars;
mod motion;
mod observables;
mod orders;
mod plan;
mod press;
mod results;
mod sparse;
mod structure;
mod typeset;

use kin_runtime::{Instant, Mechanism, Signal};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::*;
use kin_tests::random::Random;
use kin_tests::subject::Subject;

/// Laws of Φ, Φ_q, Φ_t and γ at any configuration.
macro_rules! equation_laws {
    ($Mechanism:ident) => {
        use crate::*;

        #[test]
        fn closed_forms_equal_duals() {
            equations::closed_forms_equal_duals(&$Mechanism::default());
        }

        #[test]
        fn typeset_equations_are_the_code() {
            typeset::typeset_equations_are_the_code(&$Mechanism::default());
        }

        #[test]
        fn subsets_equal_the_whole() {
            equations::subsets_equal_the_whole(&$Mechanism::default());
        }

        #[test]
        fn single_precision_agrees() {
            equations::single_precision_agrees(&$Mechanism::default());
        }

        #[test]
        fn joints_do_not_feel_rigid_motion() {
            equations::joints_do_not_feel_rigid_motion(&$Mechanism::default());
        }
    };
}

/// Laws of solved configurations, between two instants.
macro_rules! motion_laws {
    ($Mechanism:ident, $from:literal, $to:literal) => {
        #[test]
        fn solved_configurations_close() {
            motion::solved_configurations_close(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn rates_are_derivatives() {
            motion::rates_are_derivatives(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn plans_equal_newton() {
            plan::plans_equal_newton(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn typeset_solutions_are_the_analysis() {
            typeset::typeset_solutions_are_the_analysis(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn sweeps_by_plan_equal_newton() {
            plan::sweeps_by_plan_equal_newton(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn sparse_elimination_changes_nothing() {
            sparse::sparse_elimination_changes_nothing(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn planned_instants_equal_newton() {
            plan::planned_instants_equal_newton(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn states_show_the_motion() {
            results::states_show_the_motion(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn drawings_show_the_poses() {
            drawing::drawings_show_the_poses(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn far_instants_equal_close_ones() {
            motion::far_instants_equal_close_ones(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn any_start_closes_or_fails() {
            motion::any_start_closes_or_fails(&$Mechanism::default(), $from);
        }

        #[test]
        fn observables_are_differentiated() {
            observables::observables_are_differentiated(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn point_jacobians_give_velocities() {
            observables::point_jacobians_give_velocities(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn third_and_fourth_are_derivatives() {
            orders::third_and_fourth_are_derivatives(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn series_reach_the_motion() {
            orders::series_reach_the_motion(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn reported_orders_are_derivatives() {
            orders::reported_orders_are_derivatives(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn low_orders_are_the_motion() {
            orders::low_orders_are_the_motion(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn velocity_ratios_add_up() {
            observables::velocity_ratios_add_up(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn ranks_are_generic() {
            structure::ranks_are_generic(&$Mechanism::default(), $from, $to);
        }

        #[test]
        fn input_ratios_are_derivatives() {
            if <$Mechanism as Mechanism>::INPUTS > 0 {
                observables::input_ratios_are_derivatives(&$Mechanism::default(), $from, $to);
            }
        }

        #[test]
        fn nothing_comes_of_what_is_not_finite() {
            finite::nothing_comes_of_what_is_not_finite(&$Mechanism::default(), $from);
        }

        #[test]
        fn wrong_lengths_are_errors() {
            finite::wrong_lengths_are_errors(&$Mechanism::default(), $from);
        }
    };
}

macro_rules! law_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(mod $moving {
            equation_laws!($Moving);
            motion_laws!($Moving, $from, $to);
        })*
        $(mod $other {
            equation_laws!($Other);
        })*
    };
}

every_mechanism!(law_tests);

/// An instant with the inputs of the mechanism at that time.
struct When {
    t: f64,
    inputs: Vec<Signal>,
}

impl When {
    fn of(mechanism: &dyn Subject, t: f64) -> Self {
        Self { t, inputs: mechanism.signals(t) }
    }

    fn at(&self) -> Instant<'_> {
        Instant { t: self.t, inputs: &self.inputs }
    }
}

/// A random instant, q and q̇, which do not satisfy the equations.
fn random_configuration(mechanism: &dyn Subject, random: &mut Random) -> (When, Vec<f64>, Vec<f64>) {
    let when = When::of(mechanism, random.between(0.0, 1.0));
    let n = mechanism.model().coordinates.len();
    (when, random.vector(n, -1.5, 1.5), random.vector(n, -2.0, 2.0))
}
