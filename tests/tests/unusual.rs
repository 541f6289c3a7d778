//! Valid descriptions in unusual forms: all of the grammar, in every order.
#![deny(missing_docs, warnings)]

use kin_runtime::{Instant, Kinematics, mechanism};

/// The coordinates at time `t`; asserts that the closed-form derivatives agree with those by dual numbers.
fn solved<M: Kinematics>(mechanism: &M, t: f64) -> Vec<f64> {
    let state = mechanism.state_at(&Instant::at(t)).unwrap();
    assert_eq!(0, state.degrees_of_freedom_left);
    let check = mechanism.cross_check().unwrap();
    assert!(check.passes(1e-12), "{check}");
    state.q.clone()
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12 * b.abs().max(1.0));
    assert!(near, "{found:?} is not {expected:?}");
}

/// Every function, as a call and as a method, and every form of number.
#[mechanism]
#[coordinates(a, b, c, d, e, f, g)]
#[constraint(numbers: a = 40 + 0.5 + 1. + 1e-3 + 1_000 + 0x10 + 2f64 + 5e0.abs())]
#[constraint(methods: b = l.sin() + l.cos() + l.tan() + (l/2).asin() + (l/2).acos() + l.atan() + l.atan2(2) + l.sqrt())]
#[constraint(calls: c = exp(l) + ln(l) + abs(-l) + sin(l) + cos(l) + tan(l) + asin(l/2) + acos(l/2) + atan(l))]
#[constraint(powers: d = l.powi(3) + pow(l, 2) + pow(l, -1) + pow(l, 1.5) + l.powf(1/3) + pow(l, pi) + l.powi(-2))]
#[constraint(signs: e = - -l - -(l + 1) + -l.powi(2) * -2 - 3 - 2 + (((l))))]
#[constraint(trailing: f = atan2(l, 2,) + sqrt(l,) + pow(l, 2,),)]
#[constraint(both_sides: 2*g + l = l - g + 3*t)]
struct Arithmetic {
    #[param(1.2)]
    l: f64,
}

#[test]
fn arithmetic() {
    let l = 1.2_f64;
    let pi = std::f64::consts::PI;
    let inverse = (l / 2.0).asin() + (l / 2.0).acos();
    let expected = [
        40.0 + 0.5 + 1.0 + 1e-3 + 1000.0 + 16.0 + 2.0 + 5.0,
        l.sin() + l.cos() + l.tan() + inverse + l.atan() + l.atan2(2.0) + l.sqrt(),
        l.exp() + l.ln() + l + l.sin() + l.cos() + l.tan() + inverse + l.atan(),
        l.powi(3) + l.powi(2) + 1.0 / l + l.powf(1.5) + l.cbrt() + l.powf(pi) + 1.0 / (l * l),
        l + (l + 1.0) + 2.0 * l * l - 5.0 + l,
        l.atan2(2.0) + l.sqrt() + l * l,
        0.7,
    ];
    assert_near(&solved(&Arithmetic { l }, 0.7), &expected);
}

/// Uses before declarations, defines of defines, points of the ground, and attributes in an unusual order.
#[mechanism]
#[guess(rod.phi = 0.5*start, slider.x = pin.x + size + distance(origin, pin),)]
#[driver(drive: turn = start + t,)]
#[define(turn = half + half, /** Half of it. */ half = crank.phi/2)]
#[x(follow: end = reach - 0*t)]
#[define(reach = size*cos(0.3) + distance(origin, pin),)]
#[revolute(/* a comment */ A: origin, crank @ (0, 0,),)]
#[revolute(
    /// The pin of the rod.
    B: tip, rod @ (0, 0)
)]
#[translational(C: slider @ (0, 0), ground @ (pin.x, pin.y), angle = 0.1*t, axis = (size, 0),)]
#[point(end = slider @ (0, 0))]
#[angle(D: rod = turn_of_rod)]
#[define(turn_of_rod = 2*t)]
#[point(tip = crank @ (size, 0), pin = ground @ (size/2, -size/2), origin = ground @ (0, 0),)]
#[define(size = l[0]*l[1])]
#[bodies(crank, rod)]
#[bodies(
    /// Slides.
    slider,
)]
struct Order {
    #[param([2, 0.5],)]
    l: [f64; 2],
    #[param(0.25, unit = "rad")]
    start: f64,
}

#[test]
fn order() {
    let t = 0.3_f64;
    let (crank, rod) = (0.25 + t, 2.0 * t);
    let x = 0.3_f64.cos() + 0.5_f64.sqrt();
    // The slider moves along its own x axis, through the pin.
    let slider = [x, -0.5 + (x - 0.5) * (-0.1 * t).tan(), -0.1 * t];
    let expected = [0.0, 0.0, crank, crank.cos(), crank.sin(), rod, slider[0], slider[1], slider[2]];
    assert_near(&solved(&Order::default(), t), &expected);
}

/// Time in every place where an expression may contain it.
#[mechanism]
#[body(cart, x = 0.1*t, phi = 0)]
#[body(arm, origin = pivot, phi = w*t)]
#[body(hand, origin = arm @ (l, 0))]
#[bodies(rod, plate)]
#[point(pivot = cart @ (0, l))]
#[y(A: cart @ (0, 0) = 0.2*sin(t))]
#[relative_angle(B: arm, hand = t.powi(2))]
#[point_on_line(C: ground @ (0, 0), rod @ (0, 0), axis = (0, 2), offset = -t)]
#[distance(D: ground @ (0, 0), rod @ (0, 0), length = 2 + t)]
#[angle(E: rod = -t)]
#[fixed(F: rod @ (l, 0), plate @ (0, 0), angle = pi/2 - t)]
#[guess(rod.y = 2)]
struct Timed {
    #[param(0.5)]
    l: f64,
    #[param(pi/3)]
    w: f64,
}

#[test]
fn time() {
    let t = 0.4_f64;
    let hand = std::f64::consts::FRAC_PI_3 * t + t * t;
    let rod = [t, ((2.0 + t).powi(2) - t * t).sqrt()];
    let plate = [rod[0] + 0.5 * t.cos(), rod[1] - 0.5 * t.sin(), std::f64::consts::FRAC_PI_2 - 2.0 * t];
    let expected = [0.2 * t.sin(), hand, rod[0], rod[1], -t, plate[0], plate[1], plate[2]];
    assert_near(&solved(&Timed::default(), t), &expected);
}

macro_rules! lever {
    ($(#[$attribute:meta])* $vis:vis struct $name:ident { $body:ident on $at:expr, $offset:expr => $field:ident: $default:literal }) => {
        $(#[$attribute])*
        #[mechanism]
        #[bodies($body)]
        #[revolute(pin: ground @ ($at, 2 * $at), $body @ ($offset, 0))]
        #[driver(drive: $body.phi = $field * t * $at)]
        $vis struct $name {
            #[param($default)]
            $field: f64,
        }
    };
}

lever! {
    #[derive(Debug, Clone)]
    pub(crate) struct Lever { beam on 1 + 1, -0.5 => speed: 3.0 }
}

#[test]
fn fragments_of_macros() {
    let lever = Lever::default();
    assert_near(&[lever.speed, f64::from(u8::try_from(Lever::beam.0).unwrap())], &[3.0, 0.0]);
    let phi = 3.0 * 0.1 * 2.0_f64;
    assert_near(&solved(&lever, 0.1), &[2.0 + 0.5 * phi.cos(), 4.0 + 0.5 * phi.sin(), phi]);
}

/// Other attributes are kept wherever they are, and `cfg_attr` is expanded first.
#[mechanism]
#[must_use]
#[cfg_attr(all(), bodies(wheel))]
#[derive(serde::Serialize, serde::Deserialize, Debug, PartialEq)]
#[cfg_attr(any(), bodies(other), revolut())]
#[serde(rename_all = "UPPERCASE")]
#[revolute(hub: ground @ (0, 0), wheel @ (0, 0))]
#[allow(clippy::struct_field_names)]
#[cfg_attr(all(), driver(drive: wheel.phi = rate * t), doc = "Documented.")]
#[non_exhaustive]
struct Foreign {
    #[serde(default, alias = "speed")]
    #[param(2, unit = "rad/s")]
    #[doc(alias = "omega")]
    rate: f64,
}

#[test]
fn attributes_of_others() {
    let wheel: Foreign = serde_json::from_str(r#"{ "speed": 2.0 }"#).unwrap();
    assert_eq!(wheel, Foreign::default());
    assert_eq!(serde_json::to_string(&wheel).unwrap(), r#"{"RATE":2.0}"#);
    assert_near(&solved(&wheel, 0.5), &[0.0, 0.0, 1.0]);
}

/// Const generics together with a description.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = scale[1] * t)]
struct Generic<const N: usize, const M: usize>
where
    [f64; N]: Sized,
{
    #[param([1, 2])]
    scale: [f64; 2],
}

#[test]
fn generics() {
    assert_near(&solved(&Generic::<3, 4>::default(), 0.5), &[1.0]);
}

mod several {
    //! One module with several mechanisms that use the same names.

    use kin_runtime::mechanism;

    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = t)]
    pub(super) struct First;

    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = First * t)]
    #[expect(non_snake_case, reason = "a parameter called like a type")]
    pub(super) struct Second {
        #[param(2)]
        pub(super) First: f64,
    }

    #[mechanism(allow_redundant, cross_check)]
    #[coordinates(u)]
    #[driver(drive: u = t)]
    #[constraint(again: 2 * u = 2 * t)]
    pub(super) struct Third {}
}

#[test]
fn several_in_a_module() {
    assert_near(&solved(&several::First, 0.5), &[0.5]);
    assert_near(&solved(&several::Second { First: 3.0 }, 0.5), &[1.5]);
    assert_near(&solved(&several::Third {}, 0.5), &[0.5]);
}

/// Families of everything that can have an index.
#[mechanism]
#[bodies(link[4])]
#[body(pad[i in 0..4], origin = link[i] @ (l[i], 0), phi = l[i])]
#[coordinates(u[2])]
#[revolute(base: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..3]: tip[i], link[i + 1] @ (0, 0))]
#[point(tip[i in 0..4] = link[i] @ (l[i], 0))]
#[define(bend[k in 1..4] = link[k].phi - link[k - 1].phi)]
#[angle(first: link[0] = t)]
#[driver(turn[j in 0..3]: bend[3 - j] = l[j] * t)]
#[driver(copy[i in 0..2]: u[1 - i] = pad[2*i + 1].x)]
#[guess(link[i in 0..4].x = l[i], u[0] = 1)]
struct Families {
    #[param([0.4, 0.3, 0.2, 0.1])]
    l: [f64; 4],
}

#[test]
fn families() {
    let t = 0.5_f64;
    let l = [0.4, 0.3, 0.2, 0.1];
    let turn = [t, t + l[2] * t, t + (l[2] + l[1]) * t, t + (l[2] + l[1] + l[0]) * t];
    let (mut expected, mut at) = (Vec::new(), [0.0, 0.0]);
    let mut pads = Vec::new();
    for (l, phi) in l.into_iter().zip(turn) {
        expected.extend([at[0], at[1], phi]);
        at = [at[0] + l * phi.cos(), at[1] + l * phi.sin()];
        pads.push(at[0]);
    }
    expected.extend([pads[3], pads[1]]);
    assert_near(&solved(&Families::default(), t), &expected);
}

/// A coordinate with the name of the rate of another one.
#[mechanism]
#[coordinates(u, u_dot)]
#[body(weight, x = 1, y = 2, phi = 3)]
#[constraint(first: u = 5 * t)]
#[constraint(second: u_dot = 7)]
struct NamedLikeARate;

#[test]
fn columns_of_a_trajectory() {
    let mut trajectory = NamedLikeARate.kinematic_analysis(&[0.0, 1.0]).unwrap();
    assert_eq!(Some(vec![7.0; 2]), trajectory.column("u_dot"), "the coordinate, not the rate of u");
    assert_eq!(Some(vec![0.0; 2]), trajectory.column("u_ddot"));
    assert_eq!(Some(vec![2.0; 2]), trajectory.column("weight.y"));
    assert_eq!((Some(vec![0.0, 1.0]), None), (trajectory.column("t"), trajectory.column("weight")));
    assert_eq!(Some(vec![5.0; 2]), trajectory.column("dot(u)"), "its name is taken");
    let names = trajectory.column_names();
    assert_eq!(["t", "u", "dot(u)", "u_ddot", "u_dot", "u_dot_dot", "u_dot_ddot"], names[..7]);
    assert!(names.iter().all(|name| trajectory.column(name).is_some()));
    // A state that was constructed by hand.
    trajectory.states[1].q.clear();
    trajectory.states[1].bodies.clear();
    for (name, first) in [("u", 0.0), ("weight.y", 2.0)] {
        let column = trajectory.column(name).unwrap();
        assert!(column[0] == first && column[1].is_nan(), "{name}: {column:?}");
    }
}
