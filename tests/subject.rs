//! Mechanisms without their types: a law that takes a `&dyn Subject` is compiled once, and not for every mechanism.

use crate::mechanisms;
use kin_runtime::model::{Model, Point};
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{
    CrossCheck, Derivatives, Instant, Kinematics, LengthError, Mechanism, Mobility, Mode, Motion, MotionDerivatives,
    Options, PlanError, Planned, Position, Scalar, Sign, Signal, SolveError, Solver, State, Subset, SweepError,
    Trajectory, TransmissionAngle, VelocityRatios, cli,
};
use std::ffi::OsString;
use std::process::ExitCode;

/// A mechanism without its type.
pub trait Subject {
    /// A new mechanism of the same type, with its default parameters.
    fn anew(&self) -> Box<dyn Subject>;

    /// Its names, rows and patterns.
    fn model(&self) -> &'static Model;

    /// The values of its parameters.
    fn parameters(&self) -> Vec<f64>;

    /// Gives a parameter a value; false if there is no such parameter.
    fn set_parameter(&mut self, index: usize, value: f64) -> bool;

    /// The inputs of this test mechanism at time t.
    fn signals(&self, t: f64) -> Vec<Signal>;

    /// A supplied function and its first and second derivative at x.
    fn evaluate_function(&self, index: usize, x: f64) -> Option<[f64; 3]>;

    /// Parts of the equations at q and q̇.
    fn evaluate(&self, subset: Subset, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Equations<f64>;

    /// All equations in single precision.
    fn evaluate_single(&self, at: &Instant<'_, f32>, q: &[f32], q_dot: &[f32]) -> Equations<f32>;

    /// Φ alone.
    fn constraints(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError>;

    /// The non-zeros of Φ_q alone.
    fn jacobian(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError>;

    /// Φ_t alone.
    fn time_derivative(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError>;

    /// γ alone.
    fn gamma(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, LengthError>;

    /// The solution of the plan in these modes.
    fn by_plan(&self, at: &Instant<'_>, modes: &[f64], start: &[f64]) -> PlanAnswer;

    /// The modes of a configuration, a sign ±1 for each.
    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64>;

    /// The branch values of a configuration, whose signs are those of its groups.
    fn branch_values(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64>;

    /// [`Kinematics::cross_check`].
    fn cross_check(&self) -> Result<CrossCheck, SolveError>;

    /// [`Kinematics::state_at`].
    fn state_at(&self, at: &Instant<'_>) -> Result<State, SolveError>;

    /// [`Kinematics::position_analysis`].
    fn position_analysis(&self, at: &Instant<'_>, start: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// [`Kinematics::velocity_analysis`].
    fn velocity_analysis(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// [`Kinematics::acceleration_analysis`].
    fn acceleration_analysis(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// [`Kinematics::mobility`].
    fn mobility(&self, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError>;

    /// Runs its program; the first argument is the program's name.
    fn run(&self, arguments: Vec<OsString>) -> ExitCode;

    /// A solver with these settings.
    fn solver_with<'s>(&'s self, setup: Setup<'s>) -> Box<dyn Analyses + 's>;

    /// A solver.
    fn solver(&self) -> Box<dyn Analyses + '_> {
        self.solver_with(Setup::default())
    }

    /// A solver with the inputs of this test mechanism.
    fn driven(&self, options: Options) -> Box<dyn Analyses + '_> {
        self.solver_with(Setup { options, inputs: Inputs::Own, ..Setup::default() })
    }
}

/// The settings of a solver.
#[derive(Default)]
pub struct Setup<'s> {
    /// Tolerances and limits.
    pub options: Options,
    /// The inputs over time.
    pub inputs: Inputs<'s>,
    /// A guess for a coordinate.
    pub guess: Option<(usize, f64)>,
}

/// The inputs of a solver over time.
#[derive(Default)]
pub enum Inputs<'s> {
    /// Those of the first instant.
    #[default]
    Constant,
    /// Those of the test mechanism.
    Own,
    /// Those that this function writes.
    By(&'s dyn Fn(f64, &mut [Signal])),
}

/// Φ, the non-zeros of Φ_q, Φ_t and γ.
#[derive(Clone, Debug)]
pub struct Equations<T> {
    /// Φ.
    pub phi: Vec<T>,
    /// The non-zeros of Φ_q.
    pub phi_q: Vec<T>,
    /// Φ_t.
    pub phi_t: Vec<T>,
    /// γ.
    pub gamma: Vec<T>,
}

/// q, q̇, q̈ and margins by the plan.
#[derive(Clone, Debug)]
pub struct PlanAnswer {
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub q_dot: Vec<f64>,
    /// q̈.
    pub q_ddot: Vec<f64>,
    /// The margins.
    pub margins: Vec<f64>,
}

/// [`Planned`] without the type of its mechanism.
pub trait Follower {
    /// [`Planned::modes`].
    fn modes(&self) -> Vec<Sign>;

    /// [`Planned::at`], with copies of what it computed.
    fn at(&mut self, at: &Instant<'_>) -> Result<PlanAnswer, PlanError>;
}

impl<M: Kinematics> Follower for Planned<'_, M> {
    fn modes(&self) -> Vec<Sign> {
        self.modes().collect()
    }

    fn at(&mut self, at: &Instant<'_>) -> Result<PlanAnswer, PlanError> {
        let found = self.at(at)?;
        let [q, q_dot, q_ddot] = [found.q(), found.q_dot(), found.q_ddot()].map(<[f64]>::to_vec);
        Ok(PlanAnswer { q, q_dot, q_ddot, margins: found.margins().to_vec() })
    }
}

/// Declares [`Analyses`] by methods of [`Solver`].
macro_rules! analyses {
    ($(fn $name:ident($($argument:ident: $Argument:ty),*) -> $Answer:ty;)*) => {
        /// A [`Solver`] without the type of its mechanism: its methods of the same names.
        #[allow(missing_docs, reason = "they are those of the solver")]
        pub trait Analyses {
            $(fn $name(&self, $($argument: $Argument),*) -> Result<$Answer, SolveError>;)*

            fn sweep(&self, times: &[f64]) -> Result<Trajectory, SweepError>;

            fn sweep_from(&self, start: &[f64], times: &[f64]) -> Result<Trajectory, SweepError>;

            /// Both rows of the Jacobian of a point.
            fn point_jacobian(&self, at: &Instant<'_>, q: &[f64], point: Point) -> Result<[Vec<f64>; 2], SolveError>;

            fn planned(&self, at: &Instant<'_>) -> Result<Box<dyn Follower + '_>, SolveError>;
        }

        impl<M: Kinematics> Analyses for Solver<'_, M> {
            $(fn $name(&self, $($argument: $Argument),*) -> Result<$Answer, SolveError> {
                self.$name($($argument),*)
            })*

            fn sweep(&self, times: &[f64]) -> Result<Trajectory, SweepError> {
                self.sweep(times)
            }

            fn sweep_from(&self, start: &[f64], times: &[f64]) -> Result<Trajectory, SweepError> {
                self.sweep_from(start, times)
            }

            fn point_jacobian(&self, at: &Instant<'_>, q: &[f64], point: Point) -> Result<[Vec<f64>; 2], SolveError> {
                let jacobian = self.point_jacobian(at, q, point)?;
                assert_eq!((2, M::COORDINATES), jacobian.shape());
                Ok([0, 1].map(|axis| jacobian.row(axis).iter().copied().collect()))
            }

            fn planned(&self, at: &Instant<'_>) -> Result<Box<dyn Follower + '_>, SolveError> {
                Ok(Box::new(self.planned(at)?))
            }
        }
    };
}

analyses! {
    fn assemble(at: &Instant<'_>) -> Vec<f64>;
    fn state(at: &Instant<'_>) -> State;
    fn state_from(at: &Instant<'_>, start: &[f64]) -> State;
    fn position(at: &Instant<'_>, start: &[f64]) -> Position;
    fn velocity(at: &Instant<'_>, q: &[f64]) -> Vec<f64>;
    fn acceleration(at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Vec<f64>;
    fn modes(at: &Instant<'_>, q: &[f64]) -> Vec<Mode>;
    fn mobility(at: &Instant<'_>, q: &[f64]) -> Mobility;
    fn transmission_angles(at: &Instant<'_>, q: &[f64]) -> Vec<TransmissionAngle>;
    fn motion(state: &State) -> Motion;
    fn velocity_ratios(state: &State) -> VelocityRatios;
    fn condition(state: &State) -> f64;
    fn derivatives(state: &State, order: usize) -> Derivatives;
    fn derivatives_with(state: &State, order: usize, further: &[&[f64]]) -> Derivatives;
    fn motion_derivatives(derivatives: &Derivatives) -> MotionDerivatives;
}

/// Parts of the equations of a mechanism, of any precision.
fn evaluated<M: Kinematics, T: Scalar>(
    mechanism: &M,
    subset: Subset,
    at: &Instant<'_, T>,
    q: &[T],
    q_dot: &[T],
) -> Equations<T> {
    let mut workspace = M::workspace::<T>();
    mechanism.evaluate(subset, at, q, q_dot, &mut workspace).expect("lengths agree");
    let [phi, phi_q, phi_t, gamma] =
        [workspace.phi(), workspace.phi_q(), workspace.phi_t(), workspace.gamma()].map(<[T]>::to_vec);
    Equations { phi, phi_q, phi_t, gamma }
}

impl<M: Kinematics + Default + 'static> Subject for M {
    fn anew(&self) -> Box<dyn Subject> {
        Box::new(M::default())
    }

    fn model(&self) -> &'static Model {
        M::model()
    }

    fn parameters(&self) -> Vec<f64> {
        Mechanism::parameters::<f64>(self).as_ref().to_vec()
    }

    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        Mechanism::set_parameter(self, index, value)
    }

    fn signals(&self, t: f64) -> Vec<Signal> {
        mechanisms::signals::<M>(t)
    }

    fn evaluate_function(&self, index: usize, x: f64) -> Option<[f64; 3]> {
        Mechanism::evaluate_function(self, index, x)
    }

    fn evaluate(&self, subset: Subset, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Equations<f64> {
        evaluated(self, subset, at, q, q_dot)
    }

    fn evaluate_single(&self, at: &Instant<'_, f32>, q: &[f32], q_dot: &[f32]) -> Equations<f32> {
        evaluated(self, Subset::ALL, at, q, q_dot)
    }

    fn constraints(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError> {
        Ok(Mechanism::constraints(self, at, q)?.as_ref().to_vec())
    }

    fn jacobian(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError> {
        Ok(Mechanism::jacobian(self, at, q)?.as_ref().to_vec())
    }

    fn time_derivative(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, LengthError> {
        Ok(Mechanism::time_derivative(self, at, q)?.as_ref().to_vec())
    }

    fn gamma(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, LengthError> {
        Ok(Mechanism::gamma(self, at, q, q_dot)?.as_ref().to_vec())
    }

    fn by_plan(&self, at: &Instant<'_>, modes: &[f64], start: &[f64]) -> PlanAnswer {
        let none = || vec![f64::NAN; M::COORDINATES];
        let margins = vec![f64::NAN; M::model().plan.margins];
        let mut out = PlanAnswer { q: none(), q_dot: none(), q_ddot: none(), margins };
        let PlanAnswer { q, q_dot, q_ddot, margins } = &mut out;
        let (parameters, solved) = (Mechanism::parameters::<f64>(self), Solved { q, q_dot, q_ddot, margins });
        Mechanism::solve_with(self, parameters.as_ref(), at, modes, start, Depth::Acceleration, solved)
            .expect("lengths agree");
        out
    }

    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
        crate::modes(self, at, q)
    }

    fn branch_values(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
        crate::branch_values(self, at, q)
    }

    fn cross_check(&self) -> Result<CrossCheck, SolveError> {
        Kinematics::cross_check(self)
    }

    fn state_at(&self, at: &Instant<'_>) -> Result<State, SolveError> {
        Kinematics::state_at(self, at)
    }

    fn position_analysis(&self, at: &Instant<'_>, start: &[f64]) -> Result<Vec<f64>, SolveError> {
        Kinematics::position_analysis(self, at, start)
    }

    fn velocity_analysis(&self, at: &Instant<'_>, q: &[f64]) -> Result<Vec<f64>, SolveError> {
        Kinematics::velocity_analysis(self, at, q)
    }

    fn acceleration_analysis(&self, at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Result<Vec<f64>, SolveError> {
        Kinematics::acceleration_analysis(self, at, q, q_dot)
    }

    fn mobility(&self, at: &Instant<'_>, q: &[f64]) -> Result<Mobility, SolveError> {
        Kinematics::mobility(self, at, q)
    }

    fn run(&self, arguments: Vec<OsString>) -> ExitCode {
        cli::run_from::<M>(arguments)
    }

    fn solver_with<'s>(&'s self, setup: Setup<'s>) -> Box<dyn Analyses + 's> {
        let solver = Solver::new(self).with_options(setup.options);
        let solver = match setup.inputs {
            Inputs::Constant => solver,
            Inputs::Own => solver.with_inputs(&mechanisms::write_signals::<M>),
            Inputs::By(inputs) => solver.with_inputs(inputs),
        };
        Box::new(match setup.guess {
            Some((coordinate, value)) => solver.with_guess(coordinate, value),
            None => solver,
        })
    }
}
