//! Every role combined with every name that generated code, the prelude or the language uses: everything compiles, and
//! the handles have the right indices.
#![deny(missing_docs, warnings)]

use kin_runtime::model::{Body, Coordinate, Input, Point, Quantity};
use kin_runtime::{Mechanism, ScalarFunction, mechanism};
use kin_tests::works;

/// The function f(x) = x.
pub struct Identity;

impl ScalarFunction for Identity {
    fn evaluate(&self, x: f64) -> [f64; 3] {
        [x, 1.0, 0.0]
    }
}

/// Mechanisms in which several names have one role, for every role; rows have the same names. As an index a name is alone.
macro_rules! roles {
    ($([$($name:ident)*])*) => { $({
        const NAMES: usize = [$(stringify!($name)),*].len();

        #[mechanism]
        #[bodies(first__, $($name),*)]
        #[fixed(root__: ground @ (0, 0), first__ @ (0, 0))]
        $(#[revolute($name: first__ @ (1, 0), $name @ (0, 0))])*
        $(#[guess($name.phi = 0)])*
        struct OfBodies;
        compiles(&OfBodies, 3 + 3 * NAMES);

        #[mechanism]
        #[coordinates(first__, $($name),*)]
        $(#[constraint($name: $name = 2 * first__)])*
        #[driver(drive: first__ = t)]
        struct OfCoordinates;
        compiles(&OfCoordinates, 1 + NAMES);

        #[mechanism]
        #[bodies(body__)]
        #[fixed(root__: ground @ (1, 0), body__ @ (0, 0))]
        $(#[point($name = body__ @ (1, 0))])*
        #[define(reach__ = 0 $(+ $name.x)*)]
        struct OfPoints;
        compiles(&OfPoints, 3);

        #[mechanism]
        #[coordinates(first__, second__)]
        $(#[define($name = first__ + 1)])*
        #[constraint(sum__: second__ = 0 $(+ $name)*)]
        #[driver(drive: first__ = t)]
        struct OfDefines;
        compiles(&OfDefines, 2);

        #[mechanism]
        #[coordinates(first__[2])]
        #[driver(drive[i in 0..2]: first__[i] = (0 $(+ $name)*) * t)]
        struct OfParameters {
            $(#[param(2)]
            $name: f64,)*
        }
        compiles(&OfParameters::default(), 2);

        #[mechanism]
        #[coordinates(first__)]
        $(#[input($name)])*
        #[driver(drive: first__ = 0 $(+ $name)*)]
        struct OfInputs;
        compiles(&OfInputs, 1);

        #[mechanism]
        #[coordinates(first__)]
        $(#[function($name)])*
        #[driver(drive: first__ = 0 $(+ $name(t))*)]
        struct OfFunctions {
            $($name: Identity,)*
        }
        compiles(&OfFunctions { $($name: Identity),* }, 1);

        #[mechanism]
        #[coordinates($($name[2]),*)]
        $(#[driver($name[i__ in 0..2]: $name[i__] = i__ * t)])*
        struct OfFamilies;
        compiles(&OfFamilies, 2 * NAMES);

        $({
            #[mechanism]
            #[coordinates(first__[2])]
            #[driver(drive[$name in 0..2]: first__[$name] = t)]
            struct OfIndex;
            compiles(&OfIndex, 2);
        })*
    })* };
}

fn compiles<M: Mechanism>(_: &M, coordinates: usize) {
    assert_eq!(coordinates, M::model().coordinates.len());
}

#[test]
fn names_of_generated_code() {
    roles!(
        [gamma modes jacobian q q_dot e default default_]
        [evaluate constraints parameters model set_parameter observations workspace solver]
        [at p u w k x y phi]
        [phi_q phi_t out index value this subset guesses]
        [geometry values everything observe write body]
    );
}

#[test]
fn names_of_the_prelude() {
    #![expect(non_snake_case, reason = "names of types")]
    roles!(
        [Option Some None Result Ok Err Vec Box]
        [String Default Clone Copy Send Sized Drop Fn]
        [Iterator From Into drop f32 f64 usize bool]
        [str char i32 T U X Y theta]
        [core std alloc kin_runtime self_ main test derive]
        [mechanism]
    );
}

#[test]
fn words_of_rust() {
    roles!(
        [r#as r#async r#await r#break r#const r#continue r#do r#dyn]
        [r#else r#enum r#extern r#false r#fn r#for r#if r#impl]
        [r#in r#let r#loop r#match r#mod r#move r#mut r#pub]
        [r#ref r#return r#static r#struct r#trait r#true r#type r#unsafe]
        [r#use r#where r#while r#abstract r#become r#box r#final r#macro]
        [r#override r#priv r#try r#typeof r#unsized r#virtual r#yield r#gen]
        [union auto raw macro_rules safe]
    );
}

/// Handles whose names collide with `default` and with one another.
#[mechanism]
#[bodies(default, default_)]
#[coordinates(first)]
#[input(signal)]
#[point(tip = default @ (1, 0))]
#[define(reach = tip.x)]
#[fixed(a: ground @ (0, 0), default @ (0, 0))]
#[fixed(b: default @ (0, 0), default_ @ (0, 0))]
#[driver(drive: first = signal)]
struct Handles {
    #[param(1)]
    __unused: f64,
}

#[test]
fn handles_have_types_and_places() {
    assert_eq!((Body(0), Body(1)), (Handles::default__, Handles::default_));
    let _: (Coordinate, Input, Point, Quantity) = (Handles::first, Handles::signal, Handles::tip, Handles::reach);
    compiles(&Handles::default(), 7);
}

/// Mechanisms wherever items are allowed: in functions of traits, in closures, in constants, and next to one another.
trait Length {
    fn length(&self) -> f64;
}

impl Length for f64 {
    fn length(&self) -> f64 {
        #[mechanism]
        #[coordinates(u)]
        #[driver(drive: u = speed * t + 1)]
        struct Inner {
            speed: f64,
        }
        works(&Inner { speed: *self });
        let closure = || {
            #[mechanism]
            #[coordinates(u, v)]
            #[driver(drive[i in 0..1]: u = i * t)]
            #[constraint(same: v = u)]
            struct Inner;
            works(&Inner);
        };
        closure();
        *self
    }
}

const COUNT: usize = {
    #[mechanism]
    #[coordinates(u, v)]
    #[driver(drive: u = t)]
    #[constraint(same: v = u)]
    struct Inner;
    Inner::COORDINATES
};

/// Nested modules, each with a mechanism of the same name.
mod outer {
    #[kin_runtime::mechanism]
    #[coordinates(u)]
    #[driver(drive: u = t)]
    pub(super) struct Same;

    pub(super) mod inner {
        use super::Same as Outer;

        #[kin_runtime::mechanism]
        #[bodies(Outer)]
        #[revolute(Same: ground @ (0, 0), Outer @ (0, 0))]
        #[driver(drive: Outer.phi = t)]
        pub(in super::super) struct Same;

        pub(in super::super) fn outer() -> Outer {
            Outer
        }
    }
}

#[test]
fn mechanisms_stand_wherever_items_do() {
    assert_eq!((2.0, 2), (2.0.length(), COUNT));
    works(&outer::Same);
    works(&outer::inner::Same);
    works(&outer::inner::outer());
}

/// A mechanism composed of macro fragments of every kind.
macro_rules! pendulum {
    ($(#[$attribute:meta])* $visibility:vis $name:ident, $body:ident, $length:expr, $default:literal, $unit:literal,
        $speed:ident : $number:ty, $($joint:tt)*) => {
        $(#[$attribute])*
        #[mechanism]
        #[bodies($body)]
        #[revolute($($joint)*: ground @ (0, 0), $body @ (-$length, 0))]
        #[driver(drive: $body.phi = $speed * t)]
        $visibility struct $name {
            #[param($default, unit = $unit)]
            $speed: $number,
        }
    };
}

pendulum!(
    /// Made of fragments.
    #[derive(Clone)]
    pub(crate) Made, arm, 0.5 + 0.25, 2.5, "rad/s", speed: f64, Pivot);

#[test]
fn mechanisms_of_macros() {
    let made = Made::default().clone();
    works(&made);
    assert_eq!(("Pivot.x", 2.5), (Made::model().rows[0].name, made.speed));
}
