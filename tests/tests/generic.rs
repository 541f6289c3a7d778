//! Mechanisms that are generic over their scalar type: `f64`, `f32`, and scalar types that are only used for
//! evaluation.
#![deny(missing_docs, warnings)]

use core::ops::{Add, Div, Mul, Neg, Sub};
use kin_runtime::{GenericMechanism, Instant, Kinematics, LengthError, Mechanism, Scalar, Subset, mechanism};
use kin_tests::works;
use num_dual::Dual64;

/// The lecture's four-bar.
#[mechanism(cross_check)]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l[0]/2, 0))]
#[revolute(A: crank @ (l[0]/2, 0), coupler @ (-l[1]/2, 0))]
#[revolute(B: coupler @ (l[1]/2, 0), rocker @ (-l[2]/2, 0))]
#[revolute(D: rocker @ (l[2]/2, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = pi/4 + omega * t)]
#[point(tip = coupler @ (0, l[1]/4))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar<T> {
    /// Lengths of crank, coupler and rocker.
    #[param([0.1, 0.4, 0.3])]
    pub l: [T; 3],
    /// The fixed pivot of the rocker.
    #[param(0.4)]
    pub d1: T,
    /// The height of that pivot.
    #[param(0.1)]
    pub d2: T,
    /// Speed of the crank.
    #[param(1.5)]
    pub omega: T,
}

const Q: [f64; 9] = [0.04, 0.03, 0.8, 0.2, 0.2, 0.9, 0.4, 0.2, 5.0];
const RATES: [f64; 9] = [0.3, -0.2, 1.5, 0.7, 0.1, -0.4, 0.2, 0.9, 0.6];

#[test]
fn numbers_of_both_widths_are_mechanisms() {
    works(&FourBar::<f64>::default());
    let (wide, narrow) = (FourBar::<f64>::default(), FourBar::<f32>::default());
    assert_eq!(([0.1_f32, 0.4, 0.3], 0.4_f32), (narrow.l, narrow.d1));
    let check = narrow.cross_check().unwrap();
    assert!(check.passes(1e-12), "{check}");
    let [wide, narrow] = [wide.state_at(&0.2.into()).unwrap(), narrow.state_at(&0.2.into()).unwrap()];
    for (a, b) in wide.q.iter().zip(&narrow.q) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    // The dimensions of the `f32` mechanism are rounded to `f32`, but the mechanism is solved in `f64`.
    assert_ne!(wide.q, narrow.q);
    assert_eq!(FourBar::<f64>::COORDINATES, FourBar::<f32>::model().coordinates.len());
    assert_eq!(FourBar::<f64>::crank, FourBar::<f32>::crank);
}

#[test]
fn the_command_line_takes_both() {
    for code in [
        kin_runtime::cli::run_from::<FourBar<f64>>(["four_bar", "check", "--set", "l[1]=0.41"]),
        kin_runtime::cli::run_from::<FourBar<f32>>(["four_bar", "check", "--set", "l[1]=0.41"]),
    ] {
        assert_eq!(format!("{:?}", std::process::ExitCode::SUCCESS), format!("{code:?}"));
    }
    let mut narrow = FourBar::<f32>::default();
    assert!(narrow.set_parameter(1, 0.41));
    assert_eq!(0.41_f32, narrow.l[1]);
}

/// The four parts of an evaluation at the mechanism's own parameters.
fn own<T: Scalar>(four_bar: &FourBar<T>) -> [Vec<T>; 4] {
    let number = |values: [f64; 9]| values.map(T::from_f64);
    let mut workspace = FourBar::<T>::own_workspace();
    let at = Instant::at(T::from_f64(0.3));
    four_bar.evaluate_own(Subset::ALL, &at, &number(Q), &number(RATES), &mut workspace).unwrap();
    let mut observations = FourBar::<T>::own_observations();
    four_bar.observe_own(&at, &number(Q), &number(RATES), &mut observations).unwrap();
    [workspace.phi(), workspace.phi_q(), workspace.gamma(), observations.phi()].map(<[T]>::to_vec)
}

#[test]
fn f32_stays_f32() {
    let narrow = FourBar::<f32>::default();
    let (q, rates) = (Q.map(|x| x as f32), RATES.map(|x| x as f32));
    let mut workspace = FourBar::<f32>::workspace::<f32>();
    narrow.evaluate(Subset::ALL, &Instant::at(0.3_f32), &q, &rates, &mut workspace).unwrap();
    let [phi, phi_q, gamma, _] = own(&narrow);
    assert_eq!(
        (phi.as_slice(), phi_q.as_slice(), gamma.as_slice()),
        (workspace.phi(), workspace.phi_q(), workspace.gamma())
    );
    // Φ of joint C by hand, entirely in `f32`.
    let (s, c) = q[2].sin_cos();
    let half = 0.1_f32 / 2.0;
    assert!((phi[0] - (q[0] - half * c)).abs() <= f32::EPSILON, "{phi:?}");
    assert!((phi[1] - (q[1] - half * s)).abs() <= f32::EPSILON, "{phi:?}");
    assert_eq!(narrow.own_parameters(), narrow.parameters::<f32>());
}

/// Derivatives with respect to a length, by a dual number, compared with central differences.
#[test]
fn derivatives_by_a_length() {
    let mut dual = FourBar::<Dual64>::default();
    dual.l[1] = dual.l[1].derivative();
    let found = own(&dual);
    let step = 1e-6;
    let at = |l1: f64| own(&FourBar { l: [0.1, l1, 0.3], ..FourBar::default() });
    let (above, below) = (at(0.4 + step), at(0.4 - step));
    let mut largest = 0.0_f64;
    for ((found, above), below) in found.iter().zip(&above).zip(&below) {
        for ((found, above), below) in found.iter().zip(above).zip(below) {
            assert!((found.eps - (above - below) / (2.0 * step)).abs() < 1e-8, "{found} {above} {below}");
            largest = largest.max(found.eps.abs());
        }
    }
    // Φ of joint A by hand: x_2 − l₂/2 cos φ₂ − (x_1 + …), so that ∂Φ/∂l₂ = −cos φ₂ / 2.
    assert!((found[0][2].eps.abs() - Q[5].cos() / 2.0).abs() < 1e-15, "{}", found[0][2]);
    assert!(largest > 0.1);
}

/// A scalar type with two lanes, for two mechanisms of different dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lanes([f64; 2]);

macro_rules! lanes {
    (scalar $($method:ident)*) => { $(
        fn $method(self) -> Self {
            Self(self.0.map(f64::$method))
        }
    )* };
    ($($trait:ident $method:ident)*) => { $(
        impl $trait for Lanes {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self([0, 1].map(|k: usize| self.0[k].$method(other.0[k])))
            }
        }
    )* };
}
lanes!(Add add Sub sub Mul mul Div div);

impl Neg for Lanes {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl Scalar for Lanes {
    fn from_f64(value: f64) -> Self {
        Self([value; 2])
    }
    fn sin_cos(self) -> (Self, Self) {
        (Self(self.0.map(f64::sin)), Self(self.0.map(f64::cos)))
    }
    lanes!(scalar tan asin acos atan sqrt exp ln abs signum);
    fn atan2(self, x: Self) -> Self {
        Self([0, 1].map(|k: usize| self.0[k].atan2(x.0[k])))
    }
    fn powi(self, n: i32) -> Self {
        Self(self.0.map(|x| x.powi(n)))
    }
    fn powf(self, n: f64) -> Self {
        Self(self.0.map(|x| x.powf(n)))
    }
    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
        let [a, b] = self.0.map(f);
        [0, 1, 2].map(|k: usize| Self([a[k], b[k]]))
    }
}

#[test]
fn lanes_hold_different_dimensions() {
    let both = FourBar { d1: Lanes([0.4, 0.5]), ..FourBar::default() };
    let [left, right] = [0.4, 0.5].map(|d1| own(&FourBar { d1, ..FourBar::default() }));
    for ((both, left), right) in own(&both).iter().zip(&left).zip(&right) {
        let expected: Vec<_> = left.iter().zip(right).map(|(&a, &b)| Lanes([a, b])).collect();
        assert_eq!(&expected, both);
    }
    assert_ne!(left[0], right[0]);
}

#[test]
fn wrong_lengths_are_refused() {
    let four_bar = FourBar::<f32>::default();
    let error = four_bar
        .evaluate_own(Subset::PHI, &Instant::at(0.0), &[0.0; 8], &[0.0; 9], &mut FourBar::own_workspace())
        .unwrap_err();
    assert_eq!(LengthError { what: "q", expected: 9, found: 8 }, error);
}

/// A struct with bounds, defaults, a where clause, a lifetime, a constant and a second type parameter; other fields
/// have fixed types.
#[mechanism(cross_check)]
#[bodies(link[3])]
#[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..2]: link[i] @ (l[i], 0), link[i+1] @ (0, 0))]
#[angle(drive[i in 0..3]: link[i] = omega[i] * t + phase)]
#[derive(Debug)]
struct Chain<T: Copy = f64, S = f32, const N: usize = 3>
where
    S: core::fmt::Debug,
{
    #[param(0.5)]
    l: [T; 3],
    #[param([1, 2, 3])]
    omega: [S; 3],
    #[param(0.25)]
    phase: f64,
}

/// A field of a type parameter and one of a fixed type; the constant parameter is unused.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = speed * t + offset)]
struct Drive<const N: usize, Number> {
    #[param(2)]
    speed: Number,
    #[param(0.5)]
    offset: f32,
}

/// A constant parameter may have any name.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
struct Constant<const T: usize>;

#[test]
fn parameters_of_all_kinds() {
    works(&Chain::<f64, f32, 5>::default());
    works(&Chain::<f32, f64, 0>::default());
    works(&Drive::<1, f64>::default());
    works(&Constant::<3>);
    assert_eq!([2.0_f32, 0.5], Drive::<7, f32>::default().own_parameters());
}

/// Type parameters with names that occur in generated code.
#[test]
fn names_of_type_parameters() {
    macro_rules! named {
        ($($name:ident)*) => { $({
            #[mechanism]
            #[coordinates(u)]
            #[driver(drive: u = speed * t)]
            struct Named<$name> {
                #[param(2)]
                speed: $name,
            }
            works(&Named::<f64>::default());
        })* };
    }
    named!(T Scalar Mechanism Option Default Parameter Number Rows Coordinates r#Type Self_ U);
}

/// Generic code over a generic mechanism.
fn residual<T: Scalar>(arm: &FourBar<T>) -> T
where
    FourBar<T>: Mechanism,
{
    let phi = arm.constraints(&Instant::at(T::from_f64(0.0)), &Q.map(T::from_f64)).unwrap();
    phi.as_ref().iter().fold(T::from_f64(0.0), |sum, &x| sum + x * x)
}

#[test]
fn generic_callers() {
    let (wide, narrow) = (residual(&FourBar::<f64>::default()), residual(&FourBar::<f32>::default()));
    assert!((wide - f64::from(narrow)).abs() < 1e-5 && wide > 1e-3, "{wide} {narrow}");
}

/// Supplied functions in structs with a type parameter, with and without a bound on the struct.
mod functions {
    use super::works;
    use kin_runtime::{GenericMechanism, Instant, ScalarFunction, Subset, mechanism};

    /// The function f(x) = x².
    #[derive(Clone, Copy)]
    struct Square;

    impl ScalarFunction for Square {
        fn evaluate(&self, x: f64) -> [f64; 3] {
            [x * x, 2.0 * x, 2.0]
        }
    }

    #[mechanism]
    #[coordinates(u)]
    #[function(law)]
    #[driver(drive: u = l * law(t))]
    #[derive(Clone)]
    struct Cam<T, F> {
        l: T,
        law: F,
    }

    #[mechanism]
    #[coordinates(u)]
    #[function(law)]
    #[driver(drive: u = law(t + l[0]) - l[1])]
    struct Bounded<F: ScalarFunction + Clone, T, const N: usize> {
        l: [T; 2],
        law: F,
    }

    #[test]
    fn beside_generic_numbers() {
        works(&Cam { l: 0.5, law: Square });
        works(&Cam { l: 0.5_f32, law: Square });
        works(&Bounded::<_, _, 3> { l: [0.5, 1.0], law: Square });
        let cam = Cam { l: 0.5_f32, law: Square }.clone();
        let mut workspace = Cam::<f32, Square>::own_workspace();
        cam.evaluate_own(Subset::ALL, &Instant::at(3.0), &[1.0], &[0.0], &mut workspace).unwrap();
        assert_eq!(([-3.5_f32], [1.0_f32]), ([workspace.phi()[0]], [workspace.gamma()[0]]));
    }
}
