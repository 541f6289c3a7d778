//! The reference cases in `tests/data`; their format is described in `CONVENTIONS.md` there.

use serde::Deserialize;
use serde::de::Deserializer;

/// One mechanism with its exact solutions.
#[derive(Debug, Deserialize)]
pub struct Case {
    /// The name of the file without its extension.
    pub name: String,
    /// The expected kind: `regular`, `redundant`, `singular`, `infeasible`, `underdriven` or `nonholonomic`.
    pub expect: String,
    /// The names of the entries of q, such as `phi_crank`.
    pub coordinates: Vec<String>,
    /// The number of coordinates.
    pub n: usize,
    /// The number of rows.
    pub s: usize,
    /// The number of rows in which time appears.
    pub s_drivers: usize,
    /// The rank of all rows at the first instant of the first mode.
    pub rank: Option<usize>,
    /// The rank without the driving rows.
    pub rank_without_drivers: Option<usize>,
    /// n − rank without the driving rows.
    pub dof_without_drivers: Option<usize>,
    /// n − rank.
    pub dof_remaining: Option<usize>,
    /// The time of the first instant.
    #[serde(deserialize_with = "number")]
    pub t0: f64,
    /// The assembly modes.
    pub modes: Vec<Mode>,
    /// The linear equations at the first instant of the first mode.
    pub linearization: Option<Linearization>,
    /// The equations at a configuration that does not satisfy Φ = 0.
    pub offmanifold: OffManifold,
    /// A singular configuration, if the file contains one.
    pub singular: Option<Singular>,
    /// Unit vectors y with yᵀ Φ_q = 0.
    #[serde(default, deserialize_with = "vectors")]
    pub left_null_space: Vec<Vec<f64>>,
    /// Unit vectors z with Φ_q z = 0.
    #[serde(default, deserialize_with = "vectors")]
    pub null_space: Vec<Vec<f64>>,
    /// The least-norm solutions of an under-driven mechanism.
    pub minimum_norm: Option<MinimumNorm>,
    /// Rows that are not part of the system, but determine the sampled states.
    #[serde(default)]
    pub completion_constraint: Vec<Completion>,
    constraints: Vec<Constraint>,
}

/// An assembly mode.
#[derive(Debug, Deserialize)]
pub struct Mode {
    /// The name of the mode.
    pub name: String,
    /// A configuration near that of the first instant; empty where the position is not determined by equations.
    #[serde(default, deserialize_with = "numbers")]
    pub initial_guess: Vec<f64>,
    /// The exact states.
    pub instants: Vec<Instant>,
}

impl Mode {
    /// The start of a sweep: the guess near the first instant, or its exact position where there is no guess.
    #[must_use]
    pub fn start(&self) -> &[f64] {
        match self.instants.first() {
            Some(first) if self.initial_guess.is_empty() => &first.q,
            _ => &self.initial_guess,
        }
    }

    /// The times of the instants.
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        self.instants.iter().map(|instant| instant.t).collect()
    }
}

/// An exact state.
#[derive(Debug, Deserialize)]
pub struct Instant {
    /// The time.
    #[serde(deserialize_with = "number")]
    pub t: f64,
    /// q.
    #[serde(deserialize_with = "numbers")]
    pub q: Vec<f64>,
    /// q̇.
    #[serde(rename = "qd", deserialize_with = "numbers")]
    pub q_dot: Vec<f64>,
    /// q̈.
    #[serde(rename = "qdd", deserialize_with = "numbers")]
    pub q_ddot: Vec<f64>,
    /// The motions of points.
    #[serde(default)]
    pub points: Vec<PointMotion>,
}

/// The motion of a point.
#[derive(Debug, Deserialize)]
pub struct PointMotion {
    /// The name `body.point`.
    pub point: String,
    /// Position.
    #[serde(deserialize_with = "numbers")]
    pub r: Vec<f64>,
    /// Velocity.
    #[serde(deserialize_with = "numbers")]
    pub v: Vec<f64>,
    /// Acceleration.
    #[serde(deserialize_with = "numbers")]
    pub a: Vec<f64>,
}

/// The linear equations at one configuration.
#[derive(Debug, Deserialize)]
pub struct Linearization {
    /// Φ_q.
    #[serde(rename = "Phi_q", deserialize_with = "entries")]
    pub phi_q: Vec<(usize, usize, f64)>,
    /// Φ_t.
    #[serde(rename = "Phi_t", deserialize_with = "numbers")]
    pub phi_t: Vec<f64>,
    /// γ.
    #[serde(deserialize_with = "numbers")]
    pub gamma: Vec<f64>,
}

/// The equations at a configuration that does not satisfy Φ = 0.
#[derive(Debug, Deserialize)]
pub struct OffManifold {
    /// The time.
    #[serde(deserialize_with = "number")]
    pub t: f64,
    /// q.
    #[serde(deserialize_with = "numbers")]
    pub q: Vec<f64>,
    /// q̇.
    #[serde(rename = "qd", deserialize_with = "numbers")]
    pub q_dot: Vec<f64>,
    /// Φ; 0 for a row of velocity level.
    #[serde(rename = "Phi", deserialize_with = "numbers_or_zero")]
    pub phi: Vec<f64>,
    /// Φ_q, Φ_t and γ.
    #[serde(flatten)]
    pub linear: Linearization,
}

/// A singular configuration.
#[derive(Debug, Deserialize)]
pub struct Singular {
    /// The time.
    #[serde(deserialize_with = "number")]
    pub t: f64,
    /// The configuration q.
    #[serde(deserialize_with = "numbers")]
    pub q: Vec<f64>,
    /// Rank of Φ_q there.
    pub rank: usize,
    /// Whether the velocity equations have a solution there.
    pub velocity_consistent: bool,
    /// Unit vectors z with Φ_q z = 0.
    #[serde(deserialize_with = "vectors")]
    pub right_null_space: Vec<Vec<f64>>,
    /// Unit vectors y with yᵀ Φ_q = 0.
    #[serde(deserialize_with = "vectors")]
    pub left_null_space: Vec<Vec<f64>>,
}

/// Least-norm velocity and acceleration at the first instant.
#[derive(Debug, Deserialize)]
pub struct MinimumNorm {
    /// q̇.
    #[serde(rename = "qd", deserialize_with = "numbers")]
    pub q_dot: Vec<f64>,
    /// q̈, with γ at this q̇.
    #[serde(rename = "qdd", deserialize_with = "numbers")]
    pub q_ddot: Vec<f64>,
}

/// The prescribed angle that determines the sampled states of an under-driven mechanism.
#[derive(Debug, Deserialize)]
pub struct Completion {
    /// The body whose angle is prescribed.
    pub body_i: String,
    /// (t, value, rate, acceleration) at the instants.
    #[serde(deserialize_with = "vectors")]
    pub f_samples: Vec<Vec<f64>>,
}

#[derive(Debug, Deserialize)]
struct Constraint {
    #[serde(rename = "type")]
    kind: String,
    rows: Vec<usize>,
    v: Option<Axis>,
}

#[derive(Debug, Deserialize)]
struct Axis {
    #[serde(deserialize_with = "numbers")]
    value: Vec<f64>,
}

impl Case {
    /// Reads the case with this name.
    ///
    /// # Panics
    /// If the file does not exist or is not a case.
    #[must_use]
    pub fn read(name: &str) -> Self {
        let path = format!("{}/data/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
    }

    /// The names of the entries of q in kin's notation: `crank.phi` for the file's `phi_crank`.
    #[must_use]
    pub fn coordinate_names(&self) -> Vec<String> {
        let in_kin = |name: &String| match name.split_once('_') {
            Some((component @ ("x" | "y" | "phi"), body)) => format!("{body}.{component}"),
            _ => name.clone(),
        };
        self.coordinates.iter().map(in_kin).collect()
    }

    /// The factors by which rows of the file must be multiplied where their axis is not a unit vector; 1 elsewhere.
    #[must_use]
    pub fn row_scales(&self) -> Vec<f64> {
        let mut scales = vec![1.0; self.s];
        for constraint in &self.constraints {
            if let ("translational" | "point_on_line", Some(axis)) = (constraint.kind.as_str(), &constraint.v) {
                scales[constraint.rows[0]] = 1.0 / axis.value[0].hypot(axis.value[1]);
            }
        }
        scales
    }
}

/// A number in a file: a string of 34 digits or a JSON number.
#[derive(Deserialize)]
#[serde(untagged)]
enum Digits {
    Text(String),
    Number(f64),
}

impl Digits {
    fn value<E: serde::de::Error>(self) -> Result<f64, E> {
        match self {
            Self::Text(text) => text.parse().map_err(E::custom),
            Self::Number(number) => Ok(number),
        }
    }
}

fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Digits::deserialize(from)?.value()
}

fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    Vec::<Digits>::deserialize(from)?.into_iter().map(Digits::value).collect()
}

fn numbers_or_zero<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<Digits>>::deserialize(from)?;
    numbers.into_iter().map(|digits| digits.map_or(Ok(0.0), Digits::value)).collect()
}

fn vectors<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let rows = Vec::<Vec<Digits>>::deserialize(from)?;
    rows.into_iter().map(|row| row.into_iter().map(Digits::value).collect()).collect()
}

fn entries<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(usize, usize, f64)>, D::Error> {
    let entries = Vec::<(usize, usize, Digits)>::deserialize(from)?;
    entries.into_iter().map(|(row, column, value)| Ok((row, column, value.value()?))).collect()
}
