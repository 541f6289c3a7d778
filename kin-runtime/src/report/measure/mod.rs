//! Quantities of a mechanism at an instant, by name: what can be tabulated, plotted, searched for extremes and scored.
//!
//! | name | what it is |
//! |---|---|
//! | `t` | time |
//! | `crank.phi`, `s` | a coordinate, the name of which is that in [`Model::coordinates`] |
//! | `ram.y` | x, y or phi of a body that is no coordinate, because it is held or carried |
//! | `tip.x`, `tip.y` | a named point in the inertial frame |
//! | `boom_length` | an input |
//! | `tip.speed` | \|ṙ\| of a named point |
//! | `reach` | a define |
//! | `B.angle`, `slide.stroke` | a quantity of a joint ([`JointInfo::quantities`](crate::model::JointInfo::quantities)) |
//! | `B.transmission` | the transmission angle at a revolute joint ([`transmission`](crate::transmission)), in [0, π]; with several pairs of neighbours `B.transmission_A_D` |
//! | `drive.effort`, `B.force`, … | what drivers supply and joints carry, where there are masses or loads |
//! | `boom_length.effort` | the effort of an input, or of a driver of the same name: the power that enters with it through drivers and held coordinates is effort · rate ([`Forces::inputs`](crate::Forces::inputs)) |
//! | `crank.phi.effort` | the effort that holds or moves a coordinate that is given ([`Solver::with_given`](crate::Solver::with_given)) |
//! | `tip.x/drive` | the velocity ratio of coordinates, points, defines and joint quantities to a driver or an input: ∂x/∂f with all other drivers and inputs constant |
//!
//! Coordinates, points, defines, joint quantities and inputs have a rate (`tip.x_dot`) and an acceleration (`tip.x_ddot`).

mod dimension;
mod force;
mod poses;
mod source;
#[cfg(feature = "cli")]
mod terms;
mod value;
mod varied;

pub(crate) use dimension::Dimension;
use dimension::driven_dimension;
pub(crate) use force::{column_values, magnitude_parts};
#[cfg(feature = "cli")]
pub(crate) use force::{columns, dimension_of_driven};
pub use source::Source;
pub(crate) use value::values;
pub(crate) use varied::Needs;

#[cfg(feature = "cli")]
use crate::model::{Component, CoordinateKind};
use crate::model::{Model, Units};
use crate::transmission::{Pair, pairs};
use core::fmt;

/// A quantity that a mechanism has at every instant, by its name; [`Solver::measure`](crate::Solver::measure) computes
/// its value.
///
/// ```
/// use kin_runtime::{Instant, Kinematics, Measure, Mechanism, mechanism};
///
/// #[mechanism]
/// #[bodies(crank, rod, slider)]
/// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
/// #[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
/// #[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
/// #[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
/// #[driver(drive: crank.phi = 3 * t)]
/// #[guess(crank.phi = 0.1, rod.phi = -0.1, slider.x = 0.9)]
/// struct SliderCrank;
///
/// # fn main() -> Result<(), kin_runtime::SolveError> {
/// let solver = SliderCrank.solver();
/// let state = solver.state(&Instant::at(0.3))?;
/// let names = ["slider.x", "slider.x_dot", "slider.x/drive"];
/// let measures: Vec<Measure> = names.iter().filter_map(|name| Measure::named(SliderCrank::model(), name)).collect();
/// let values = solver.measure(&state, &measures)?;
/// assert_eq!(values[0], state[SliderCrank::slider].x);
/// // The driver has the rate 3.
/// assert!((values[1] - 3.0 * values[2]).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    name: String,
    kind: Kind,
    /// 0, 1 or 2: the value, its rate or its acceleration.
    order: usize,
    /// The driver of a velocity ratio; none for other quantities.
    per: Option<Driver>,
    dimension: Dimension,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Time,
    Coordinate(usize),
    /// x or y of a named point.
    Point(usize, usize),
    /// |ṙ| of a named point.
    Speed(usize),
    /// A define or a quantity of a joint, by its observable.
    Observable(usize),
    Input(usize),
    /// A column of forces, and where its number comes from.
    Force(usize, Option<Source>),
    /// The effort of an input, or of a coordinate that is given.
    Effort(Along),
    Transmission(Pair),
}

/// What an effort that no driver supplies is conjugate to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Along {
    Given(usize),
    Input(usize),
}

/// A driving row or an input, with the dimension of the driven quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Driver {
    place: DriverPlace,
    dimension: Dimension,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum DriverPlace {
    Row(usize),
    Input(usize),
}

impl Measure {
    /// The quantity with this name; `None` if the mechanism has none.
    pub fn named(model: &'static Model, name: &str) -> Option<Self> {
        let found = Self::all(model).into_iter().find(|measure| measure.name == name);
        found.or_else(|| Self::effort(model, name)).or_else(|| {
            let (quantity, driver) = name.rsplit_once('/')?;
            let quantity = Self::named(model, quantity).filter(Self::has_ratio)?;
            let per = Some(drivers(model).find(|(other, _)| *other == driver)?.1);
            Some(Self { name: name.to_owned(), per, ..quantity })
        })
    }

    /// `boom_length.effort`; `crank.phi.effort`, which exists where the coordinate is given.
    fn effort(model: &'static Model, name: &str) -> Option<Self> {
        let (quantity, dimension) = (name.strip_suffix(".effort")?, force::dimension_of_effort(model));
        let given = || model.coordinates.iter().position(|coordinate| coordinate.name == quantity).map(Along::Given);
        let along = model.inputs.iter().position(|input| *input == quantity).map(Along::Input).or_else(given)?;
        Some(Self::new(name.to_owned(), Kind::Effort(along), dimension(quantity)?))
    }

    /// All quantities but velocity ratios and efforts of coordinates that are given: t, coordinates, points, defines, joint
    /// quantities, forces, speeds of points, inputs and transmission angles.
    pub fn all(model: &'static Model) -> Vec<Self> {
        let mut all = Self::standard(model, true);
        let speed = |(k, point): (usize, &crate::model::PointInfo)| Self {
            order: 1,
            ..Self::new(format!("{}.speed", point.name), Kind::Speed(k), Dimension::Length)
        };
        all.extend(Self::held_poses(model));
        all.extend(model.points.iter().enumerate().map(speed));
        for (k, name) in model.inputs.iter().enumerate() {
            all.extend(Self::with_rates(model, name, Kind::Input(k), Dimension::named(&model.units, name)));
            let effort = format!("{name}.effort");
            if all.iter().all(|measure| measure.name != effort) {
                all.extend(Self::effort(model, &effort));
            }
        }
        all.extend(Self::transmission_angles(model));
        all
    }

    /// The transmission angles, in order of declaration of their joints.
    pub fn transmission_angles(model: &'static Model) -> Vec<Self> {
        let pairs = pairs(model);
        let name = |joint: usize| model.joints[joint].name;
        let angle = |pair: &Pair| {
            let several = pairs.iter().filter(|other| other.joint == pair.joint).count() > 1;
            let [a, b] = pair.between.map(name);
            let end = if several { format!("_{a}_{b}") } else { String::new() };
            let name = format!("{}.transmission{end}", name(pair.joint));
            Self::new(name, Kind::Transmission(*pair), Dimension::Angle)
        };
        pairs.iter().map(angle).collect()
    }

    /// The names of driving rows and inputs, which come after the slash in the name of a velocity ratio.
    pub fn drivers(model: &'static Model) -> Vec<&'static str> {
        drivers(model).map(|(name, _)| name).collect()
    }

    /// t and every coordinate with its rate and acceleration; with `reported` also the other reported quantities.
    pub(crate) fn standard(model: &'static Model, reported: bool) -> Vec<Self> {
        let mut out = vec![Self::new("t".to_owned(), Kind::Time, Dimension::In(dimension::time(&model.units)))];
        let mut add = |name: &str, kind: Kind, dimension| out.extend(Self::with_rates(model, name, kind, dimension));
        for (k, coordinate) in model.coordinates.iter().enumerate() {
            add(coordinate.name, Kind::Coordinate(k), Dimension::of_coordinate(model, k));
        }
        if !reported {
            return out;
        }
        for (k, point) in model.points.iter().enumerate() {
            for (axis, name) in ["x", "y"].iter().enumerate() {
                add(&format!("{}.{name}", point.name), Kind::Point(k, axis), Dimension::Length);
            }
        }
        for define in model.defines {
            add(define.name, Kind::Observable(define.observable), Dimension::named(&model.units, define.name));
        }
        for joint in model.joints {
            for quantity in joint.quantities {
                let name = format!("{}.{}", joint.name, quantity.name);
                let dimension = Dimension::named(&model.units, &name);
                add(&name, Kind::Observable(quantity.observable), dimension);
            }
        }
        out.extend(Self::forces(model));
        out
    }

    /// The columns of forces.
    pub(crate) fn forces(model: &'static Model) -> impl Iterator<Item = Self> {
        let columns = force::columns(model).into_iter().enumerate();
        columns.map(|(k, (name, dimension, source))| Self::new(name, Kind::Force(k, source), dimension))
    }

    /// The driven quantities, each once: the quantity that the joint of a driver reports, if this is what its row
    /// prescribes, or else the one coordinate in its row.
    pub fn driven(model: &'static Model) -> Vec<Self> {
        let rows = model.rows.iter().enumerate().filter(|(_, row)| row.driving);
        let names: Vec<String> = rows.filter_map(|(row, _)| driven_by(model, row)).collect();
        let once = names.iter().enumerate().filter(|(k, name)| !names[..*k].contains(name));
        once.filter_map(|(_, name)| Self::named(model, name)).collect()
    }

    /// A value with its rate and its acceleration.
    fn with_rates(model: &Model, name: &str, kind: Kind, dimension: Dimension) -> [Self; 3] {
        let mut orders = 0..;
        let with = |name| Self { order: orders.next().unwrap_or(0), ..Self::new(name, kind, dimension) };
        model.with_rates(name).map(with)
    }

    fn new(name: String, kind: Kind, dimension: Dimension) -> Self {
        Self { name, kind, order: 0, per: None, dimension }
    }

    /// Whether it is a function of the coordinates, so that it has a ratio to a driver.
    fn has_ratio(&self) -> bool {
        match self.kind {
            Kind::Coordinate(_) | Kind::Point(..) | Kind::Observable(_) => self.order == 0 && self.per.is_none(),
            Kind::Speed(_) => self.per.is_none(),
            Kind::Time | Kind::Input(_) | Kind::Force(..) | Kind::Effort(_) | Kind::Transmission(_) => false,
        }
    }

    /// Whether it is a velocity ratio.
    pub(crate) const fn is_ratio(&self) -> bool {
        self.per.is_some()
    }

    /// Its index among the columns of forces.
    pub(crate) const fn force(&self) -> Option<usize> {
        if let (Kind::Force(place, _), None) = (self.kind, self.per) { Some(place) } else { None }
    }

    /// Whether it is one of the forces.
    #[cfg(feature = "cli")]
    pub(crate) const fn is_force(&self) -> bool {
        self.per.is_none() && matches!(self.kind, Kind::Force(..) | Kind::Effort(_))
    }

    /// Whether it is the effort of a prescribed coordinate.
    #[cfg(feature = "cli")]
    pub(crate) const fn is_given_effort(&self) -> bool {
        matches!(self.kind, Kind::Effort(Along::Given(_)))
    }

    /// Whether it is kept fixed while parameters vary: t and the inputs.
    pub(crate) const fn is_held(&self) -> bool {
        self.per.is_none() && matches!(self.kind, Kind::Time | Kind::Input(_))
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its unit, if the description determines it: `m/s`, `rad`, `m/rad`.
    pub fn unit(&self, units: &Units) -> Option<String> {
        self.unit_in(units, false)
    }

    /// Its unit, with angles in degrees if `degrees`.
    pub(crate) fn unit_in(&self, units: &Units, degrees: bool) -> Option<String> {
        let Some(driver) = self.per else { return self.dimension.unit(units, self.order, degrees) };
        let [above, below] = [self.dimension, driver.dimension].map(|dimension| dimension.unit(units, 0, degrees));
        let (above, below) = (above?, below?);
        Some(match above == below {
            true => String::new(),
            false if below.contains(['/', ' ']) => format!("{above}/({below})"),
            false => format!("{above}/{below}"),
        })
    }

    /// The factor that converts its value from radians to degrees.
    #[cfg(feature = "cli")]
    pub(crate) fn in_degrees(&self) -> f64 {
        let factor = |dimension: Dimension| if dimension == Dimension::Angle { 1_f64.to_degrees() } else { 1.0 };
        factor(self.dimension) / self.per.map_or(1.0, |driver| factor(driver.dimension))
    }

    /// Whether it depends on the position only, so that it has a value at a limit, where rates do not exist.
    #[cfg(feature = "cli")]
    pub(crate) const fn is_place(&self) -> bool {
        self.order == 0 && self.per.is_none() && !self.is_force()
    }

    /// Whether it is an angle, not a rate or a ratio of one.
    #[cfg(feature = "design")]
    pub(crate) fn is_angle(&self) -> bool {
        self.dimension == Dimension::Angle && self.order == 0 && self.per.is_none()
    }

    /// Whether it is a transmission angle.
    #[cfg(feature = "cli")]
    pub(crate) const fn is_transmission(&self) -> bool {
        matches!(self.kind, Kind::Transmission(_))
    }

    /// The default quantities of `extremes`: transmission angles; angles, scalars and points; defines and the strokes
    /// of joints; efforts of drivers. Driven quantities are left out.
    #[cfg(feature = "cli")]
    pub(crate) fn default_outputs(model: &'static Model) -> Vec<Self> {
        let driven = Self::driven(model);
        let is_output = |measure: &Self| match measure.kind {
            Kind::Speed(_) | Kind::Transmission(_) => true,
            Kind::Coordinate(index) => measure.order == 0 && shows_motion(model, index),
            Kind::Point(..) => measure.order == 0,
            Kind::Observable(_) => {
                measure.order == 0 && measure.dimension != Dimension::Angle || measure.is_define(model)
            }
            Kind::Force(..) => measure.name.ends_with(".effort"),
            Kind::Effort(_) | Kind::Time | Kind::Input(_) => false,
        };
        let all = Self::all(model).into_iter();
        let (angles, others): (Vec<Self>, Vec<Self>) =
            all.filter(|measure| is_output(measure) && !driven.contains(measure)).partition(Self::is_transmission);
        angles.into_iter().chain(others).collect()
    }

    #[cfg(feature = "cli")]
    fn is_define(&self, model: &Model) -> bool {
        self.order == 0 && model.defines.iter().any(|define| self.kind == Kind::Observable(define.observable))
    }
}

/// Whether a coordinate describes the motion of its body: angles and scalars do, x and y only of a body that does not
/// turn or has no angle of its own.
#[cfg(feature = "cli")]
fn shows_motion(model: &Model, coordinate: usize) -> bool {
    match model.coordinates[coordinate].kind {
        CoordinateKind::Pose { body, component: Component::X | Component::Y } => {
            let slides = |joint: &crate::model::JointInfo| {
                let [a, b] = joint.frames;
                let body = Some(crate::model::Frame::Body(body));
                let ground = Some(crate::model::Frame::Ground);
                joint.kind == crate::model::JointKind::Translational
                    && (a == body && b == ground || b == body && a == ground)
            };
            model.bodies[body].coordinates[2].is_none() || model.joints.iter().any(slides)
        }
        _ => true,
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

/// The name of the quantity that a driving row drives: the one that its joint reports, if this is what the row
/// prescribes, or else the one coordinate in the row.
fn driven_by(model: &'static Model, row: usize) -> Option<String> {
    let joint = &model.joints[model.rows[row].joint];
    if let (Some(quantity), true) = (joint.quantities.first(), joint.keeps_distance() || joint.kind.prescribes_angle())
    {
        return Some(format!("{}.{}", joint.name, quantity.name));
    }
    let mut entries = model.constraint_pattern.entries.iter().filter(|(other, _)| *other == row);
    match (entries.next(), entries.next()) {
        (Some(&(_, column)), None) => Some(model.coordinates[column].name.to_owned()),
        _ => None,
    }
}

/// Driving rows and inputs with their names and dimensions.
fn drivers(model: &'static Model) -> impl Iterator<Item = (&'static str, Driver)> {
    let row = move |(place, row): (usize, &'static crate::model::RowInfo)| {
        (row.name, Driver { place: DriverPlace::Row(place), dimension: driven_dimension(model, place) })
    };
    let input = move |(place, name): (usize, &&'static str)| {
        (*name, Driver { place: DriverPlace::Input(place), dimension: Dimension::named(&model.units, name) })
    };
    let rows = model.rows.iter().enumerate().filter(|(_, row)| row.driving).map(row);
    rows.chain(model.inputs.iter().enumerate().map(input))
}
