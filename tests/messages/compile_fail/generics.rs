//! Structs with type parameters.

use core::marker::PhantomData;
use kin_runtime::{Kinematics, mechanism};

struct Wrapper<T>(T);

#[mechanism(cross_check)]
#[coordinates(u)]
#[driver(drive: u = a * t)]
struct Fields<T, U, const N: usize> {
    a: T,
    wrapped: Wrapper<T>,
    marker: PhantomData<T>,
    projected: <T as Iterator>::Item,
    nested: [Wrapper<T>; 3],
    matrix: [[T; 2]; 2],
    list: Vec<T>,
    unused: PhantomData<U>,
}

#[mechanism]
#[coordinates(u)]
#[driver(drive: u = a * t)]
struct Reserved<__T> {
    a: __T,
}

#[mechanism]
#[coordinates(u)]
#[driver(drive: u = a * t)]
struct __Parameters {
    a: f64,
}

#[mechanism]
#[coordinates(u)]
#[driver(drive: u = a * t)]
struct Right<T> {
    #[param(1)]
    a: T,
}

fn main() {
    // A field whose type is not a number is no parameter, and such a mechanism cannot be solved.
    let _ = Right { a: 1.0 }.solver();
    let _ = Right { a: 1_u8 }.solver();
    let _ = Right::<u8>::default();
}
