//! Derivatives with respect to parameters, of many solved configurations.

use super::BatchError;
use super::run::{BatchShape, CHUNK, Progress, drive};
use super::solution::{Problems, Solutions};
use crate::measure::{Measure, Needs, Source};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Model;
use crate::results::varied::{Number, Varied, WIDTH};
use crate::scalar::Scalar;
use crate::scalar::compare::write_lane;
use crate::scalar::lanes::Octet;
use crate::sensitivity::measured::complete;
use crate::sensitivity::{MAX_STACK_COORDINATES, Variation, Varying, is_integrated, is_same, modes_at};
use crate::signal::{Instant, Signal};
use core::ops::ControlFlow;

/// Values and derivatives of quantities for every configuration of a batch.
pub struct SensitivitySolutions {
    count: usize,
    measures: usize,
    parameters: usize,
    /// For every configuration: 1 if it is solved, then each quantity with its derivatives, padded to whole lanes.
    numbers: Vec<f64>,
}

impl SensitivitySolutions {
    /// Room for `count` configurations, with this number of quantities and their derivatives with respect to this
    /// number of parameters.
    pub fn new(count: usize, measures: usize, parameters: usize) -> Self {
        let mut out = Self { count, measures, parameters, numbers: Vec::new() };
        out.numbers.resize(count * out.stride(), 0.0);
        out
    }

    /// The number of entries of a configuration.
    fn stride(&self) -> usize {
        1 + self.measures * self.width()
    }

    /// The number of entries of a quantity.
    fn width(&self) -> usize {
        1 + self.parameters.next_multiple_of(WIDTH)
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether each configuration has derivatives. It has none if [`solve`](super::solve) found no solution or solved
    /// another problem, if it is so near to a limit that derivatives are not finite or its mode is undecided, or if one of
    /// the quantities is not a finite number: a force of a spring between points that coincide.
    pub fn solved(&self) -> impl Iterator<Item = bool> {
        self.column(0).map(|solved| solved > 0.0)
    }

    /// A quantity, by its index in the list: a number for every configuration, 0 where it is not solved.
    ///
    /// # Panics
    /// If there is no such quantity.
    pub fn value(&self, measure: usize) -> impl Iterator<Item = f64> {
        self.column(self.index_of(measure))
    }

    /// The derivative of a quantity with respect to a parameter, by their indices in the lists. NaN where it does not
    /// exist: for a transmission angle whose arms are on one line, or the magnitude of a force that is zero.
    ///
    /// # Panics
    /// If there is no such quantity or parameter.
    pub fn by(&self, measure: usize, parameter: usize) -> impl Iterator<Item = f64> {
        assert!(parameter < self.parameters, "parameter {parameter} of {}", self.parameters);
        self.column(self.index_of(measure) + 1 + parameter)
    }

    fn index_of(&self, measure: usize) -> usize {
        assert!(measure < self.measures, "quantity {measure} of {}", self.measures);
        1 + measure * self.width()
    }

    fn column(&self, index: usize) -> impl Iterator<Item = f64> {
        self.numbers.iter().skip(index).step_by(self.stride()).copied()
    }

    /// Checks that the room is for lists of these lengths.
    fn check(&self, measures: usize, parameters: usize) -> Result<(), LengthError> {
        let lists = [
            ("the list of quantities", self.measures, measures),
            ("the list of parameters", self.parameters, parameters),
        ];
        let wrong = lists.into_iter().find(|(_, expected, found)| expected != found);
        wrong.map_or(Ok(()), |(list, expected, found)| Err(LengthError { what: list, expected, found }))
    }
}

/// Values of quantities, and their exact derivatives with respect to parameters (indices in
/// [`Model::parameters`](crate::model::Model::parameters)), for configurations that [`solve`](super::solve) has solved,
/// for the same problems. Instants, inputs and assembly modes are constant, as in
/// [`Solver::measure_sensitivities`](crate::Solver::measure_sensitivities).
///
/// Eight parameters are treated at once: the plan is evaluated once over numbers with eight derivatives. `watch` gets
/// the progress and may stop the batch. Negative masses are not refused, as in [`forces`](super::forces()).
///
/// ```
/// use kin_runtime::batch::{Column, Modes, Problems, SensitivitySolutions, Solutions, always, sensitivities, solve};
/// use kin_runtime::plan::Depth;
/// use kin_runtime::{Measure, Mechanism, mechanism};
///
/// /// A crank whose end is at (l cos φ, l sin φ).
/// #[mechanism]
/// #[bodies(crank)]
/// #[point(tip = crank @ (l, 0))]
/// #[revolute(pin: ground @ (0, 0), crank @ (0, 0))]
/// #[driver(drive: crank.phi = t)]
/// struct Crank {
///     #[param(0.2)]
///     l: f64,
/// }
///
/// let times = [0.1, 0.4, 0.7];
/// let start = [Column::Shared(0.0); 3];
/// let (parameters, modes) = ([Column::Shared(0.2)], Modes::OfStart);
/// let problems = Problems { parameters: &parameters, t: Column::Each(&times), inputs: &[], modes, start: &start };
/// let mut solutions = Solutions::<Crank>::new(3);
/// solve(&Crank::default(), Depth::Acceleration, &problems, &mut solutions, &always)?;
/// let height: Vec<Measure> = Measure::named(Crank::model(), "tip.y").into_iter().collect();
/// let mut out = SensitivitySolutions::new(3, 1, 1);
/// sensitivities(&Crank::default(), &problems, &solutions, &height, &[0], &mut out, &always)?;
/// for (by, t) in out.by(0, 0).zip(times) {
///     assert!((by - t.sin()).abs() < 1e-15);
/// }
/// # Ok::<(), kin_runtime::batch::BatchError>(())
/// ```
///
/// # Errors
/// [`NoSensitivities`](BatchError::NoSensitivities) where redundant rows or rows of velocity level leave no closed
/// form, for a mechanism of more than 160 coordinates, and for a quantity without [`source`](Measure::source);
/// [`UnknownParameter`](BatchError::UnknownParameter); if a list or a column has the wrong length, and if `watch` stops
/// the batch.
pub fn sensitivities<M: Mechanism + Sync>(
    mechanism: &M,
    problems: &Problems<'_>,
    solutions: &Solutions<M>,
    measures: &[Measure],
    parameters: &[usize],
    out: &mut SensitivitySolutions,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<(), BatchError> {
    let model = M::model();
    check(model)?;
    problems.check::<M>(out.count)?;
    solutions.check(out.count)?;
    out.check(measures.len(), parameters.len())?;
    let list = List::new(model, measures, parameters)?;
    let shape = BatchShape { count: out.count, width: 1, stride: out.stride(), chunk: CHUNK };
    let scratch = || SensitivityBuffers::<M>::new(mechanism);
    drive(&shape, &mut out.numbers, watch, scratch, |place, scratch, out| {
        let block = solutions.block(place / Octet::COUNT);
        let lane = place % Octet::COUNT;
        let good = block.good.lane(lane) > 0.0;
        write_lane(&mut scratch.q, block.q, lane);
        if !good || scratch.derive(mechanism, problems, place, &list, out).is_none() {
            out.fill(0.0);
        }
    })
}

/// An error for a mechanism that the plan over numbers with derivatives does not solve.
fn check(model: &'static Model) -> Result<(), BatchError> {
    if let Some(why) = model.plan.absent {
        return Err(BatchError::NoPlan(why));
    }
    if model.plan.has_redundant_rows() {
        let why = "redundant rows may be consistent for these parameters only; use `Solver::measure_sensitivities`";
        return Err(BatchError::NoSensitivities(why));
    }
    if is_integrated(model) {
        return Err(BatchError::NoSensitivities("with nonholonomic rows the position depends on the preceding motion"));
    }
    if model.coordinates.len() > MAX_STACK_COORDINATES {
        return Err(BatchError::NoSensitivities("there are more than 160 coordinates"));
    }
    Ok(())
}

/// The quantities and parameters that are requested.
struct List<'a> {
    measures: &'a [Measure],
    sources: Vec<Source>,
    parameters: &'a [usize],
}

impl<'a> List<'a> {
    /// Checks that all of them exist and have derivatives.
    fn new(model: &'static Model, measures: &'a [Measure], parameters: &'a [usize]) -> Result<Self, BatchError> {
        let count = model.parameters.len();
        if let Some(&index) = parameters.iter().find(|&&index| index >= count) {
            return Err(BatchError::UnknownParameter { index, parameters: count });
        }
        let sources: Option<Vec<Source>> = measures.iter().map(|measure| measure.source(model)).collect();
        let sources = sources.ok_or_else(|| {
            let is_solved = model.forces.is_some_and(|forces| forces.solved);
            BatchError::NoSensitivities(match measures.iter().any(Measure::is_ratio) {
                true => "velocity ratios have no derivatives by parameters here",
                false if is_solved => {
                    "efforts of inputs and of given coordinates have no derivatives by parameters here"
                }
                false => "one of the forces has no closed form",
            })
        })?;
        Ok(Self { measures, sources, parameters })
    }

    /// Writes the quantities and their derivatives with respect to one group of parameters, of which `first` is the first;
    /// `None` if one of them has no finite value.
    fn write(&self, at: &Instant<'_>, varied: &Varied, first: usize, numbers: &mut [f64], model: &Model) -> Option<()> {
        let width = 1 + self.parameters.len().next_multiple_of(WIDTH);
        for ((measure, source), out) in self.measures.iter().zip(&self.sources).zip(numbers.chunks_mut(width)) {
            // Numbers with derivatives are large, so existing ones are not copied.
            let computed;
            let number = match *source {
                Source::Coordinate { place, order } => {
                    [&varied.q, &varied.q_dot, &varied.q_ddot].get(order)?.get(place)?
                }
                Source::Force(place) => varied.forces.get(place)?,
                _ => {
                    computed = match *source {
                        Source::Time => Number::from_f64(at.t),
                        Source::Input { place, order } => {
                            let input = at.inputs.get(place)?;
                            Number::from_f64(*[input.value, input.rate, input.acceleration].get(order)?)
                        }
                        _ => measure.varied(model, varied)?,
                    };
                    &computed
                }
            };
            if !number.value().is_finite() {
                return None;
            }
            out[0] = number.value();
            if let Some(out) = out.get_mut(1 + first..1 + first + WIDTH) {
                out.copy_from_slice(&number.by());
            }
        }
        Some(())
    }
}

/// The buffers of one thread.
struct SensitivityBuffers<'m, M: Mechanism> {
    varying: Varying<'m, M>,
    varied: Varied,
    parameters: Vec<f64>,
    inputs: Vec<Signal>,
    q: Vec<f64>,
}

impl<'m, M: Mechanism> SensitivityBuffers<'m, M> {
    fn new(mechanism: &'m M) -> Self {
        Self {
            varying: Varying::new(mechanism),
            varied: Varied::default(),
            parameters: vec![0.0; M::PARAMETERS],
            inputs: Vec::new(),
            q: vec![0.0; M::COORDINATES],
        }
    }

    /// Writes the entries of the configuration with the index `place`, whose coordinates are in `q`; `None` if it has
    /// no derivatives.
    fn derive(
        &mut self,
        mechanism: &M,
        problems: &Problems<'_>,
        place: usize,
        list: &List<'_>,
        out: &mut [f64],
    ) -> Option<()> {
        let Self { varying, varied, parameters, inputs, q } = self;
        read(problems, place, parameters, inputs);
        let at = Instant { t: problems.t.at(place), inputs };
        let modes = modes_at(mechanism, parameters, &at, q).ok()??;
        let needs = Needs::of(list.measures);
        let (solved, numbers) = out.split_first_mut()?;
        // One pass without parameters if only values are requested.
        let mut first = 0;
        while first == 0 || first < list.parameters.len() {
            let end = list.parameters.len().min(first + WIDTH);
            varying.vary_around(parameters, &at, &list.parameters[first..end]);
            varying.solve_from(modes.of_closures(), q, needs.depth, varied).ok()?;
            if !(is_finite(varied) && is_same(&varied.q, Number::value, q)) {
                return None;
            }
            complete(varying, varied, needs).ok()?;
            list.write(&at, varied, first, numbers, M::model())?;
            first += WIDTH;
        }
        *solved = 1.0;
        Some(())
    }
}

/// Reads the parameters and the inputs of a configuration.
fn read(problems: &Problems<'_>, place: usize, parameters: &mut [f64], inputs: &mut Vec<Signal>) {
    parameters.iter_mut().zip(problems.parameters).for_each(|(number, column)| *number = column.at(place));
    inputs.clear();
    inputs.extend(problems.inputs.iter().map(|input| input.map(|column| column.at(place))));
}

/// Whether all coordinates, their rates and the derivatives of these are finite.
fn is_finite(varied: &Varied) -> bool {
    [&varied.q, &varied.q_dot, &varied.q_ddot].into_iter().all(|list| all_finite(list))
}

/// Whether all values and derivatives are finite: 0 times any other number is NaN. Every lane has its own sum, so that
/// the compiler vectorises the loop.
fn all_finite(numbers: &[Number]) -> bool {
    let (mut sum, mut by) = (0.0, [0.0; WIDTH]);
    for number in numbers {
        sum += number.value() * 0.0;
        by.iter_mut().zip(number.by()).for_each(|(sum, by)| *sum += by * 0.0);
    }
    sum == 0.0 && by == [0.0; WIDTH]
}
