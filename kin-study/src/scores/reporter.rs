//! Quantities in lanes: of a block of four sets at one instant.

use super::quantity::{Made, Quantity};
use kin_runtime::batch::Moment;
use kin_runtime::measure::Source;
use kin_runtime::model::{Frame, Geometry, Model};
use kin_runtime::{Lanes, Mechanism, Observations, Scalar};
use std::any::Any;
use std::cell::Cell;
use std::f64::consts::FRAC_PI_2;
use std::marker::PhantomData;

/// An arm that is shorter than this, relative to the other one, has no direction, as in kin-runtime.
const NO_ARM: f64 = 1e-9;

/// Evaluates the quantities that the scores of a study need.
pub(crate) struct Reporter<M> {
    quantities: Vec<Quantity>,
    observes: bool,
    places: bool,
    has_forces: bool,
    /// For every row of the observables, its entries in their Jacobian: (place, column).
    entries: Vec<Vec<(usize, usize)>>,
    mechanism: PhantomData<fn() -> M>,
}

thread_local! {
    /// Buffers that a thread uses again at every moment, for any mechanism.
    static ROOM: Cell<Option<Box<dyn Any>>> = const { Cell::new(None) };
}

/// What is evaluated once for a moment, as far as a quantity needs it.
pub(super) struct Evaluated<M: Mechanism> {
    observations: Option<Observations<M, Lanes>>,
    geometry: Vec<Lanes>,
    forces: Vec<Lanes>,
}

impl<M: Mechanism + 'static> Reporter<M> {
    /// The quantities with these names.
    pub(crate) fn new(names: &[&str]) -> Result<Self, String> {
        let model = M::model();
        let quantities = names.iter().map(|name| Quantity::find(model, name)).collect::<Result<Vec<_>, _>>()?;
        let any = |wanted: fn(&Source) -> bool| quantities.iter().any(|quantity| wanted(&quantity.source));
        let places = any(|source| matches!(source, Source::Transmission(_)));
        let observes = places || any(|source| matches!(source, Source::Observable { .. } | Source::Speed(_)));
        let has_forces = any(|source| matches!(source, Source::Force(_) | Source::ForceLength(_)));
        let mut entries = vec![Vec::new(); model.observable_pattern.rows];
        for (place, &(row, column)) in model.observable_pattern.entries.iter().enumerate() {
            entries[row].push((place, column));
        }
        Ok(Self { quantities, observes, places, has_forces, entries, mechanism: PhantomData })
    }

    /// Whether a quantity needs more than t, inputs, coordinates and their rates.
    #[inline]
    pub(super) fn evaluates(&self) -> bool {
        self.observes || self.has_forces
    }

    /// Buffers for what the quantities have in common: those of this thread, if it has some of the right lengths.
    pub(super) fn room(&self) -> Box<Evaluated<M>> {
        let known = ROOM.take().and_then(|room| room.downcast::<Evaluated<M>>().ok());
        let fits = |room: &Evaluated<M>| {
            (room.observations.is_some(), !room.geometry.is_empty(), !room.forces.is_empty())
                == (self.observes, self.places, self.has_forces)
        };
        known.filter(|room| fits(room)).unwrap_or_else(|| self.new_room())
    }

    /// Keeps the buffers for the next moment of this thread.
    pub(super) fn keep(room: Box<Evaluated<M>>) {
        ROOM.set(Some(room));
    }

    fn new_room(&self) -> Box<Evaluated<M>> {
        let count = |wanted: bool, count: usize| if wanted { count } else { 0 };
        let list = |count: usize| vec![Lanes::from(0.0); count];
        let forces = M::model().forces.map_or(0, |forces| forces.count);
        Box::new(Evaluated {
            observations: self.observes.then(|| M::observations::<Lanes>()),
            geometry: list(count(self.places, M::model().geometry)),
            forces: list(count(self.has_forces, forces)),
        })
    }

    /// Evaluates what the quantities have in common.
    pub(super) fn evaluate(&self, mechanism: &M, moment: &Moment<'_>, evaluated: &mut Evaluated<M>) {
        let (at, Moment { parameters, q, q_dot, .. }) = (moment.at(), moment);
        let mut fits = true;
        if let Some(observations) = &mut evaluated.observations {
            fits &= mechanism.observe_with(parameters, &at, q, q_dot, observations).is_ok();
        }
        if self.places {
            fits &= mechanism.write_geometry(parameters, &at, &mut evaluated.geometry).is_ok();
        }
        if self.has_forces {
            fits &= moment.forces(mechanism, &mut evaluated.forces).is_ok();
        }
        debug_assert!(fits, "all lists have the lengths of the mechanism");
    }

    /// The value of the quantity with this index.
    #[inline]
    pub(super) fn value(&self, place: usize, evaluated: Option<&Evaluated<M>>, moment: &Moment<'_>) -> Lanes {
        let quantity = &self.quantities[place];
        let value = match (&quantity.source, evaluated) {
            (&Source::Coordinate { place, order: 0 }, _) => moment.q[place],
            (&Source::Coordinate { place, order: 1 }, _) => moment.q_dot[place],
            (&Source::Coordinate { place, .. }, _) => moment.q_ddot[place],
            (source, evaluated) => self.derived(source, evaluated, moment),
        };
        let value = match quantity.made {
            Made::Value => value,
            Made::Deviation => (value - Lanes::from(FRAC_PI_2)).abs(),
        };
        if quantity.magnitude { value.abs() } else { value }
    }

    fn derived(&self, source: &Source, evaluated: Option<&Evaluated<M>>, moment: &Moment<'_>) -> Lanes {
        let length = |[x, y]: [Lanes; 2]| (x * x + y * y).sqrt();
        match (*source, evaluated) {
            (Source::Time, _) => Lanes::from(moment.t),
            (Source::Input { place, order }, _) => {
                let input = &moment.at().inputs[place];
                [input.value, input.rate, input.acceleration][order]
            }
            (Source::Observable { row, order }, Some(evaluated)) => self.observable(row, order, evaluated, moment),
            (Source::Speed(rows), Some(evaluated)) => {
                length(rows.map(|row| self.observable(row, 1, evaluated, moment)))
            }
            (Source::Transmission(points), Some(evaluated)) => {
                let [centre, a, b] = points.map(|point| self.place(point, evaluated));
                let [(ax, ay), (bx, by)] = [a, b].map(|p| (p[0] - centre[0], p[1] - centre[1]));
                let angle = (ax * by - ay * bx).abs().atan2(ax * bx + ay * by);
                let [angle, a, b] = [angle, length([ax, ay]), length([bx, by])].map(Lanes::to_array);
                let has_arms = |lane: usize| a[lane] > NO_ARM * b[lane] && b[lane] > NO_ARM * a[lane];
                Lanes::generate(|lane| if has_arms(lane) { angle[lane] } else { f64::NAN })
            }
            (Source::Force(place), Some(evaluated)) => evaluated.forces[place],
            (Source::ForceLength(place), Some(evaluated)) => {
                length([evaluated.forces[place], evaluated.forces[place + 1]])
            }
            _ => Lanes::from(f64::NAN),
        }
    }

    /// An observable o, its rate o_q q̇ + o_t, or its acceleration o_q q̈ − γ.
    fn observable(&self, row: usize, order: usize, evaluated: &Evaluated<M>, moment: &Moment<'_>) -> Lanes {
        let Some(observations) = &evaluated.observations else { return Lanes::from(f64::NAN) };
        let along = |start: Lanes, rates: &[Lanes]| {
            let entries = self.entries[row].iter();
            entries.fold(start, |sum, &(place, column)| sum + observations.phi_q()[place] * rates[column])
        };
        match order {
            0 => observations.phi()[row],
            1 => along(observations.phi_t()[row], moment.q_dot),
            _ => {
                let gamma: Lanes = observations.gamma()[row];
                along(-gamma, moment.q_ddot)
            }
        }
    }

    /// A point of a joint in the inertial frame.
    fn place(&self, point: &Geometry, evaluated: &Evaluated<M>) -> [Lanes; 2] {
        let model: &Model = M::model();
        let [u, v] = [0, 1].map(|k| evaluated.geometry[point.offset + k]);
        let (Frame::Body(body), Some(observations)) = (point.frame, &evaluated.observations) else { return [u, v] };
        let [x, y, phi] = model.bodies[body].observables.map(|row| observations.phi()[row]);
        let (sin, cos) = phi.sin_cos();
        [x + cos * u - sin * v, y + sin * u + cos * v]
    }
}
