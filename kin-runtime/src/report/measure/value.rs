//! Where quantities come from, and their values at a solved state.

use super::{Along, DriverPlace, Kind, Measure, Source, force};
use crate::analysis::forces::{Sharing, forces};
use crate::equations::Equations;
use crate::error::SolveError;
use crate::forces::Forces;
use crate::model::{Model, Observable};
use crate::motion::{BodyMotion, Motion, PointMotion};
use crate::ratios::{first_ratios, observed_ratio};
use crate::report::motion::motion;
use crate::signal::Signal;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::transmission::angles;

impl Measure {
    /// Where its value comes from. None for a velocity ratio, for forces that no closed form gives, and for efforts of
    /// inputs and of prescribed coordinates.
    pub fn source(&self, model: &'static Model) -> Option<Source> {
        if self.per.is_some() {
            return None;
        }
        let order = self.order;
        match self.kind {
            Kind::Time => Some(Source::Time),
            Kind::Coordinate(place) => Some(Source::Coordinate { place, order }),
            Kind::Point(place, axis) => Some(Source::Observable { row: model.points[place].observables[axis], order }),
            Kind::Speed(place) => Some(Source::Speed(model.points[place].observables)),
            Kind::Observable(row) => Some(Source::Observable { row, order }),
            Kind::Input(place) => Some(Source::Input { place, order }),
            Kind::Force(_, source) => source,
            Kind::Effort(_) => None,
            Kind::Transmission(pair) => Some(Source::Transmission(pair.places)),
        }
    }

    /// Its value, if it is an entry of the state; NaN if a state that was constructed by hand has no such entry.
    pub(crate) fn of_state(&self, state: &State) -> Option<f64> {
        if self.per.is_some() {
            return None;
        }
        match self.kind {
            Kind::Time => Some(state.t),
            Kind::Coordinate(index) => {
                let list = [&state.q, &state.q_dot, &state.q_ddot][self.order];
                Some(list.get(index).copied().unwrap_or(f64::NAN))
            }
            Kind::Point(index, axis) => {
                let component = |point: &PointMotion| [point.r, point.v, point.a][self.order][axis];
                Some(state.points.get(index).map_or(f64::NAN, component))
            }
            Kind::Speed(index) => Some(state.points.get(index).map_or(f64::NAN, |point| point.v[0].hypot(point.v[1]))),
            Kind::Input(index) => Some(state.inputs.get(index).map_or(f64::NAN, |input| of_order(*input, self.order))),
            Kind::Observable(_) | Kind::Force(..) | Kind::Effort(_) | Kind::Transmission(_) => None,
        }
    }
}

impl Trajectory {
    /// One quantity over all states, by its name ([`Measure`]): `t`, a coordinate (`crank.phi`), x, y or φ of a body
    /// (held and carried ones, too), x, y or the speed of a named point (`tip.x`), or an input; also its rate
    /// (`crank.phi_dot`) and its acceleration (`crank.phi_ddot`). The rate of u is called `dot(u)` where something else
    /// is called `u_dot`. `None` for other names, and for quantities that a state does not contain.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let measure = Measure::all(self.model).into_iter().find(|measure| measure.name == name)?;
        let value = |state: &State| match measure.kind {
            Kind::Observable(row) => Some(of_order(of_pose(self.model, &state.bodies, row)?, measure.order)),
            _ => measure.of_state(state),
        };
        self.states.iter().map(value).collect()
    }
}

fn of_order(rates: Signal, order: usize) -> f64 {
    [rates.value, rates.rate, rates.acceleration].get(order).copied().unwrap_or(f64::NAN)
}

/// The velocity ratios of all quantities to a driving row or an input.
struct Ratio {
    place: DriverPlace,
    /// ∂q/∂f.
    first: Vec<f64>,
    /// The velocity ratios of observables.
    observed: Vec<f64>,
}

/// The values at a state. A value that does not exist is NaN: a transmission angle if an arm has no length, a force
/// that redundant rows leave undetermined, a ratio to a driver that cannot move alone.
pub(crate) fn values(
    equations: &mut Equations<'_>,
    state: &State,
    measures: &[Measure],
    sharing: Sharing,
) -> Result<Vec<f64>, SolveError> {
    let has =
        |is_kind: fn(&Kind) -> bool| measures.iter().any(|measure| measure.per.is_none() && is_kind(&measure.kind));
    let observed = has(|kind| matches!(kind, Kind::Observable(_)));
    let motion = observed.then(|| motion(equations, state)).transpose()?;
    let loads: Option<Forces> = match has(|kind| matches!(kind, Kind::Force(..) | Kind::Effort(_))) {
        true => match forces(equations, state, sharing) {
            Err(error @ SolveError::NegativeMass { .. }) => return Err(error),
            found => found.ok(),
        },
        false => None,
    };
    let mut of_forces = Vec::new();
    force::column_values(equations.model, loads.as_ref(), &mut of_forces);
    let pair = |measure: &Measure| match measure.kind {
        Kind::Transmission(pair) => Some(pair),
        _ => None,
    };
    let pairs: Vec<_> = measures.iter().filter_map(pair).collect();
    let transmitted = if pairs.is_empty() { Vec::new() } else { angles(equations, &state.q, &pairs)? };
    let mut transmitted = transmitted.into_iter();
    let mut places: Vec<DriverPlace> =
        measures.iter().filter_map(|measure| Some(measure.per.as_ref()?.place)).collect();
    places.dedup();
    let ratios = if places.is_empty() { Vec::new() } else { ratios(equations, state, &places).unwrap_or_default() };
    let value = |measure: &Measure| match (measure.kind, measure.per) {
        (Kind::Transmission(_), _) => transmitted.next().flatten().unwrap_or(f64::NAN),
        (_, Some(driver)) => {
            let ratio = ratios.iter().find(|ratio| ratio.place == driver.place);
            ratio.map_or(f64::NAN, |ratio| of_ratio(equations, measure.kind, ratio))
        }
        (Kind::Observable(index), _) => {
            motion.as_ref().map_or(f64::NAN, |motion| of_order(of_observable(motion, index), measure.order))
        }
        (Kind::Effort(along), _) => {
            loads.as_ref().and_then(|forces| effort(equations.model, forces, along)).unwrap_or(f64::NAN)
        }
        (Kind::Force(index, _), _) => of_forces.get(index).copied().unwrap_or(f64::NAN),
        _ => measure.of_state(state).unwrap_or(f64::NAN),
    };
    Ok(measures.iter().map(value).collect())
}

#[cfg(feature = "cli")]
impl Measure {
    /// The efforts of coordinates that are given and of inputs, which are no [columns of all forces](Self::forces), with
    /// their values. An input that has the name of a driver is left out.
    pub(crate) fn further_efforts(forces: &Forces) -> impl Iterator<Item = (Self, f64)> {
        let declared = forces.model.forces.map_or(0, |info| info.efforts.len());
        let (drivers, given) = forces.efforts.split_at(declared.min(forces.efforts.len()));
        let inputs = forces.inputs.iter().filter(|input| drivers.iter().all(|driver| driver.name != input.name));
        given.iter().chain(inputs).filter_map(|effort| {
            let measure = Self::effort(forces.model, &format!("{}.effort", effort.name))?;
            Some((measure, effort.effort.unwrap_or(f64::NAN)))
        })
    }
}

/// The effort of an input or of a coordinate that is given.
fn effort(model: &Model, forces: &Forces, along: Along) -> Option<f64> {
    match along {
        Along::Input(index) => forces.inputs.get(index)?.effort,
        Along::Given(index) => {
            let (name, declared) = (model.coordinates[index].name, model.forces?.efforts.len());
            forces.efforts.iter().skip(declared).find(|effort| effort.name == name)?.effort
        }
    }
}

/// A pose of a body, a define or a quantity of a joint, by its observable.
fn of_observable(motion: &Motion, observable: usize) -> Signal {
    let model = motion.model;
    if let Some(rates) = of_pose(model, &motion.bodies, observable) {
        return rates;
    }
    let defines = model.defines.iter().zip(&motion.defines);
    let joints = model.joints.iter().zip(&motion.joints).flat_map(|(joint, rates)| joint.quantities.iter().zip(rates));
    let found = defines.chain(joints).find(|(info, _)| info.observable == observable);
    found.map_or(Signal::UNKNOWN, |(_, rates)| *rates)
}

/// A component of the pose of a body, if this is what the observable is.
fn of_pose(model: &Model, bodies: &[BodyMotion], observable: usize) -> Option<Signal> {
    let Some(&Observable::Pose { body, component }) = model.observables.get(observable) else { return None };
    Some(bodies.get(body).map_or(Signal::UNKNOWN, |body| body.rates(component)))
}

/// The ratios to driving rows and inputs, of those that can move alone.
fn ratios(equations: &mut Equations<'_>, state: &State, places: &[DriverPlace]) -> Result<Vec<Ratio>, SolveError> {
    let row = |place: &DriverPlace| if let DriverPlace::Row(row) = place { Some(*row) } else { None };
    let input = |place: &DriverPlace| if let DriverPlace::Input(input) = place { Some(*input) } else { None };
    let (rows, inputs): (Vec<usize>, Vec<usize>) =
        (places.iter().filter_map(row).collect(), places.iter().filter_map(input).collect());
    let [of_rows, of_inputs] = first_ratios(equations, &state.q, &rows, &inputs)?;
    let of_rows = rows.into_iter().map(DriverPlace::Row).zip(of_rows);
    let mut all = Vec::new();
    for (place, first) in of_rows.chain(inputs.into_iter().map(DriverPlace::Input).zip(of_inputs)) {
        let Some(first) = first else { continue };
        let observed = observed_ratio(equations, &state.q, &first, input(&place))?;
        all.push(Ratio { place, first, observed });
    }
    Ok(all)
}

fn of_ratio(equations: &Equations<'_>, kind: Kind, ratio: &Ratio) -> f64 {
    let seen = |observable: usize| ratio.observed.get(observable).copied().unwrap_or(f64::NAN);
    let points = equations.model.points;
    match kind {
        Kind::Coordinate(index) => ratio.first.get(index).copied().unwrap_or(f64::NAN),
        Kind::Point(index, axis) => seen(points[index].observables[axis]),
        Kind::Speed(index) => {
            let [x, y] = points[index].observables.map(seen);
            x.hypot(y)
        }
        Kind::Observable(index) => seen(index),
        Kind::Time | Kind::Input(_) | Kind::Force(..) | Kind::Effort(_) | Kind::Transmission(_) => f64::NAN,
    }
}
