//! Supplied functions: errors in their declarations and calls, and other things in their places.

use kin_runtime::function::CubicSpline;
use kin_runtime::mechanism;

#[mechanism]
#[function(lift, prfile, table[3], spare = 3, twice, twice, crank)]
#[function]
#[function()]
#[bodies(crank)]
#[coordinates(u)]
#[revolute(A: crank @ (lift, 0), ground @ (0, 0))]
#[driver(bare: crank.phi = lift)]
#[driver(none: crank.phi = lift())]
#[driver(two: crank.phi = lift(t, 2))]
#[driver(indexed: crank.phi = lift[0](t))]
#[driver(member: crank.phi = strokes(t) + strokes[2](t) + strokes[0])]
#[driver(number: u = l(t))]
#[driver(method: u = t.lift())]
#[x(place: crank @ (lift(u), 0) = lift(u))]
#[function(strokes, matrix, open)]
struct Declared {
    lift: CubicSpline,
    profile: CubicSpline,
    #[param(0.1, unit = "m")]
    twice: CubicSpline,
    strokes: [CubicSpline; 2],
    matrix: [[CubicSpline; 2]; 2],
    open: [CubicSpline; N],
    table: CubicSpline,
    spare: CubicSpline,
    l: f64,
}

const N: usize = 2;

/// Misspelt names, as functions and in their arguments.
#[mechanism]
#[function(lift)]
#[coordinates(u)]
#[driver(misspelt: u = lfit(t))]
#[driver(inner: u = lift(v) + lift(l(lift)))]
#[driver(component: u = lift.x + lift(t).y)]
struct Misspelt {
    lift: CubicSpline,
    l: f64,
}

/// Fields with functions that are not declared as functions.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = profile(t))]
struct Undeclared<'a> {
    profile: CubicSpline,
    boxed: Box<CubicSpline>,
    borrowed: &'a CubicSpline,
}

/// A function that is declared at the field instead of the struct.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = profile(t))]
struct OnField {
    #[function]
    profile: Box<dyn kin_runtime::ScalarFunction>,
    #[function(other)]
    other: CubicSpline,
}

/// A type that does not implement `ScalarFunction`.
#[mechanism(cross_check)]
#[function(profile)]
#[coordinates(u)]
#[driver(drive: u = profile(t))]
struct NoFunction {
    profile: Vec<f64>,
}

impl Default for NoFunction {
    fn default() -> Self {
        Self { profile: Vec::new() }
    }
}

/// Numbers that are declared as functions: one error for each field, however often it is used.
#[mechanism]
#[function(f, g)]
#[coordinates(u, v)]
#[constraint(first: v = f(u) + g[0](u) + g[1](v))]
#[driver(drive: u = f(t) + g[1](t))]
struct Numbers {
    f: f64,
    g: [f64; 2],
}

/// A parameter of a wrong type that is used in many rows causes a single error.
#[mechanism]
#[coordinates(u, v)]
#[constraint(first: v = l * u)]
#[driver(drive: u = l * t)]
struct Words {
    #[param(0.1)]
    l: Length,
}

pub struct Length(pub f64);

/// An array whose length the struct does not show: `l` would be its first element alone.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = l * t)]
struct Hidden {
    l: Lengths,
}

type Lengths = [f64; 3];

/// An undeclared field whose type is known to the compiler only.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
struct Forgotten {
    profile: CubicSpline,
}

fn main() {}
