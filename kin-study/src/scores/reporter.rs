//! Quantities in lanes: of a block of four sets at one instant.

use super::quantity::{Quantity, Source};
use kin_runtime::batch::Moment;
use kin_runtime::model::{Frame, Geometry, Model};
use kin_runtime::{Instant, Lanes, Mechanism, Observations, Scalar, Signal};
use std::f64::consts::FRAC_PI_2;
use std::marker::PhantomData;

/// Gives the quantities that the scores of a study want.
pub(crate) struct Reporter<M> {
    quantities: Vec<Quantity>,
    /// The inputs at every instant, those of one instant after those of another.
    inputs: Vec<Signal<Lanes>>,
    observes: bool,
    has_forces: bool,
    /// For every row of the observables, its entries in their Jacobian: (place, column).
    entries: Vec<Vec<(usize, usize)>>,
    mechanism: PhantomData<fn() -> M>,
}

/// What is evaluated once for a moment; empty where no quantity wants it.
pub(super) struct Evaluated<M: Mechanism> {
    observations: Option<Box<Observations<M, Lanes>>>,
    geometry: Vec<Lanes>,
    forces: Vec<Lanes>,
}

impl<M: Mechanism> Reporter<M> {
    /// The quantities with these names, for a motion with these inputs at its instants.
    pub(crate) fn new(names: &[&str], inputs: Vec<Signal<Lanes>>) -> Result<Self, String> {
        let model = M::model();
        let quantities = names.iter().map(|name| Quantity::find(model, name)).collect::<Result<Vec<_>, _>>()?;
        let any = |wanted: fn(&Source) -> bool| quantities.iter().any(|quantity| wanted(&quantity.source));
        let observes = any(|source| matches!(source, Source::Observable { .. } | Source::Transmission { .. }));
        let has_forces = any(|source| matches!(source, Source::Force(_) | Source::ForceLength(_)));
        let mut entries = vec![Vec::new(); model.observable_pattern.rows];
        for (place, &(row, column)) in model.observable_pattern.entries.iter().enumerate() {
            entries[row].push((place, column));
        }
        Ok(Self { quantities, inputs, observes, has_forces, entries, mechanism: PhantomData })
    }

    /// Evaluates what the quantities have in common.
    #[inline]
    pub(super) fn evaluate(&self, mechanism: &M, moment: &Moment<'_>) -> Evaluated<M> {
        let mut evaluated = Evaluated { observations: None, geometry: Vec::new(), forces: Vec::new() };
        if self.observes || self.has_forces {
            self.fill(mechanism, moment, &mut evaluated);
        }
        evaluated
    }

    fn fill(&self, mechanism: &M, moment: &Moment<'_>, evaluated: &mut Evaluated<M>) {
        let zero = Lanes::from(0.0);
        let inputs = &self.inputs[moment.instant * M::INPUTS..][..M::INPUTS];
        let at = Instant { t: Lanes::from(moment.t), inputs };
        let Moment { parameters, q, q_dot, q_ddot, .. } = moment;
        let mut fits = Ok(());
        if self.observes {
            let mut observations = Box::new(M::observations::<Lanes>());
            fits = fits.and(mechanism.observe_with(parameters, &at, q, q_dot, &mut observations));
            evaluated.observations = Some(observations);
            evaluated.geometry = vec![zero; M::model().geometry];
            fits = fits.and(mechanism.write_geometry(parameters, &at, &mut evaluated.geometry));
        }
        if self.has_forces {
            evaluated.forces = vec![zero; M::model().forces.map_or(0, |forces| forces.count)];
            let forces = &mut evaluated.forces;
            fits = fits.and(mechanism.forces_with(parameters, &at, q, q_dot, q_ddot, &[], forces));
        }
        debug_assert!(fits.is_ok(), "all lists have the lengths of the mechanism");
    }

    /// The quantity at a place of the list.
    #[inline]
    pub(super) fn value(&self, place: usize, evaluated: &Evaluated<M>, moment: &Moment<'_>) -> Lanes {
        let quantity = &self.quantities[place];
        let value = match quantity.source {
            Source::Coordinate { place, order } => [moment.q, moment.q_dot, moment.q_ddot][order][place],
            ref other => self.derived(other, evaluated, moment),
        };
        if quantity.magnitude { value.abs() } else { value }
    }

    fn derived(&self, source: &Source, evaluated: &Evaluated<M>, moment: &Moment<'_>) -> Lanes {
        let length = |[x, y]: [Lanes; 2]| (x * x + y * y).sqrt();
        match *source {
            Source::Observable { row, order } => self.observable(row, order, evaluated, moment),
            Source::Transmission { ref points, deviation } => {
                let [centre, a, b] = points.each_ref().map(|point| self.place(point, evaluated));
                let [(ax, ay), (bx, by)] = [a, b].map(|p| (p[0] - centre[0], p[1] - centre[1]));
                let angle = (ax * by - ay * bx).abs().atan2(ax * bx + ay * by);
                if deviation { (angle - Lanes::from(FRAC_PI_2)).abs() } else { angle }
            }
            Source::Force(place) => evaluated.forces[place],
            Source::ForceLength(place) => length([evaluated.forces[place], evaluated.forces[place + 1]]),
            Source::Coordinate { place, order } => [moment.q, moment.q_dot, moment.q_ddot][order][place],
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
