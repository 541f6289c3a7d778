//! Identifiers and struct shapes that could collide with generated code: each mechanism here compiles without a warning
//! and is solved.
#![deny(missing_docs, warnings)]

use kin_runtime::model::{Body, Coordinate, Input, Point};
use kin_runtime::{Instant, Kinematics, Mechanism, mechanism};
use kin_tests::works;

#[mechanism]
#[bodies(gamma, modes, jacobian, q, q_dot, default, e, evaluate, constraints, parameters, model)]
#[revolute(A: ground @ (0, 0), gamma @ (0, 0))]
#[revolute(B: gamma @ (1, 0), modes @ (0, 0))]
#[revolute(C: modes @ (1, 0), jacobian @ (0, 0))]
#[revolute(D: jacobian @ (1, 0), q @ (0, 0))]
#[revolute(E: q @ (1, 0), q_dot @ (0, 0))]
#[revolute(F: q_dot @ (1, 0), default @ (0, 0))]
#[revolute(G: default @ (1, 0), e @ (0, 0))]
#[revolute(H: e @ (1, 0), evaluate @ (0, 0))]
#[revolute(I: evaluate @ (1, 0), constraints @ (0, 0))]
#[revolute(J: constraints @ (1, 0), parameters @ (0, 0))]
#[revolute(K: parameters @ (1, 0), model @ (0, 0))]
#[angle(a: gamma = t)]
#[angle(b: modes = 2 * t)]
#[angle(c: jacobian = 3 * t)]
#[angle(d: q = 4 * t)]
#[angle(f: q_dot = 5 * t)]
#[angle(g: default = 6 * t)]
#[angle(h: e = 7 * t)]
#[angle(i: evaluate = 8 * t)]
#[angle(j: constraints = 9 * t)]
#[angle(k: parameters = 10 * t)]
#[angle(l: model = 11 * t)]
struct Bodies;

#[mechanism]
#[coordinates(gamma, modes, jacobian, q, q_dot, default, e, evaluate, constraints, parameters, model, solver, new)]
#[constraint(gamma: gamma = t)]
#[constraint(modes: modes = gamma + 1)]
#[constraint(jacobian: jacobian = modes + sin(gamma))]
#[constraint(q: q = jacobian * modes)]
#[constraint(q_dot: q_dot = q + 1)]
#[constraint(default: default = q_dot + 1)]
#[constraint(e: e = exp(-default))]
#[constraint(evaluate: evaluate = e + 1)]
#[constraint(constraints: constraints = evaluate + 1)]
#[constraint(parameters: parameters = constraints + 1)]
#[constraint(model: model = parameters + e)]
#[constraint(solver: solver = model + 1)]
#[constraint(new: new = solver + 1)]
struct Coordinates {}

#[mechanism]
#[bodies(b)]
#[point(gamma = b @ (1, 0))]
#[point(modes = b @ (2, 0))]
#[point(jacobian = b @ (3, 0))]
#[point(q = b @ (4, 0))]
#[point(q_dot = b @ (5, 0))]
#[point(default = b @ (6, 0))]
#[point(e = b @ (7, 0))]
#[point(evaluate = b @ (8, 0))]
#[point(constraints = b @ (9, 0))]
#[point(parameters = b @ (10, 0))]
#[point(model = b @ (11, 0))]
#[define(observations = gamma.x + modes.y)]
#[revolute(gamma: ground @ (0, 0), gamma)]
#[driver(drive: b.phi = t)]
struct Points;

#[mechanism]
#[coordinates(c)]
#[input(gamma, modes, jacobian, q, q_dot, default, e, evaluate, u, p, w, at, inputs, phi, r#type, T[2])]
#[driver(drive: c = gamma + modes + jacobian + q + q_dot + default + e + evaluate + u + p + w + at * inputs * phi
    + r#type + T[0] * T[1])]
struct Inputs;

#[mechanism]
#[coordinates(u)]
#[driver(drive: u = gamma + modes + jacobian + q + q_dot + default + e + evaluate + constraints + parameters + model
    + at * subset * workspace * phi * phi_q * v0 * p0 * T * core)]
#[expect(non_snake_case, reason = "a type parameter's usual name")]
struct Parameters {
    #[param(1)]
    gamma: f64,
    #[param(1)]
    modes: f64,
    #[param(1)]
    jacobian: f64,
    #[param(1)]
    q: f64,
    #[param(1)]
    q_dot: f64,
    #[param(1)]
    default: f64,
    #[param(1)]
    e: f64,
    #[param(1)]
    evaluate: f64,
    #[param(1)]
    constraints: f64,
    #[param(1)]
    parameters: f64,
    #[param(1)]
    model: f64,
    #[param(2)]
    at: f64,
    #[param(2)]
    subset: f64,
    #[param(2)]
    workspace: f64,
    #[param(2)]
    phi: f64,
    #[param(2)]
    phi_q: f64,
    #[param(2)]
    v0: f64,
    #[param(2)]
    p0: f64,
    #[param(2)]
    T: f64,
    #[param(2)]
    core: f64,
}

#[mechanism]
#[bodies(r#type, r#loop)]
#[coordinates(r#match)]
#[point(r#fn = r#loop @ (r#use, 0))]
#[revolute(r#struct: ground @ (0, 0), r#type @ (0, 0))]
#[revolute(r#impl: r#type @ (r#use, 0), r#loop @ (0, 0))]
#[angle(r#for: r#type = t)]
#[angle(r#in: r#loop = 2 * t)]
#[constraint(r#let: r#match = r#fn.x + r#loop.phi)]
struct RawIdentifiers {
    #[param(1)]
    r#use: f64,
}

#[test]
fn awkward_names() {
    works(&Bodies);
    works(&Coordinates {});
    works(&Points);
    works(&Inputs);
    works(&Parameters::default());
    works(&RawIdentifiers::default());
}

#[test]
fn handles_have_their_types() {
    // A constant called `default` would hide `Default::default`, so the generated name gets an underscore.
    let bodies: [Body; 3] = [Bodies::gamma, Bodies::default_, Bodies::model];
    assert_eq!([Body(0), Body(5), Body(10)], bodies);
    let coordinate: Coordinate = Coordinates::jacobian;
    assert_eq!(Coordinate(2), coordinate);
    let point: Point = Points::modes;
    assert_eq!(Point(1), point);
    assert_eq!((Body(0), Body(1)), (RawIdentifiers::r#type, RawIdentifiers::r#loop));
    let [first, second]: [Input; 2] = Inputs::T;
    assert_eq!((Input(15), Input(16)), (first, second));
    assert_eq!(Some(Inputs::r#type), Inputs::model().input("type"));
    assert_eq!("T[1]", Inputs::model().inputs[second.0]);
}

#[test]
fn raw_identifiers_are_named_without_their_prefix() {
    let names: Vec<_> = RawIdentifiers::model().coordinates.iter().map(|c| c.name).collect();
    assert_eq!(["type.x", "type.y", "type.phi", "loop.x", "loop.y", "loop.phi", "match"], names[..]);
    assert_eq!("struct.x", RawIdentifiers::model().rows[0].name);
    assert_eq!("use", RawIdentifiers::model().parameters[0].name);
}

#[test]
fn methods_and_handles_of_one_name_live_together() {
    let rows = Points.gamma(&Instant::at(0.0), &[0.0; 3], &[1.0; 3]).unwrap();
    assert_eq!([1.0, 0.0, 0.0], rows);
    assert_eq!(11, <Bodies as Mechanism>::model().bodies.len());
}

/// Types with the names of types that generated code uses.
mod types {
    use kin_runtime::mechanism;

    macro_rules! named {
        ($($name:ident)*) => {
            $(
                #[mechanism]
                #[coordinates(u)]
                #[driver(drive: u = t)]
                struct $name;
            )*

            #[test]
            fn of_generated_code_can_be_the_users() {
                $(super::works(&$name);)*
            }
        };
    }

    named!(Mechanism Scalar Model Instant Option Some Result Ok Err Default Array T Subset Workspace Body Signal);
}

mod visibility {
    use kin_runtime::mechanism;

    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = speed * t)]
    pub(crate) struct Crate {
        /// Private, with a default value: the struct can still be built with `Default`.
        #[param(2)]
        speed: f64,
    }

    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = speed * t)]
    pub(in crate::visibility) struct Restricted {
        #[param(2)]
        pub(super) speed: f64,
    }

    #[test]
    fn restricted() {
        super::works(&Restricted { speed: 1.0 });
    }
}

#[test]
fn visibilities() {
    works(&visibility::Crate::default());
}

#[mechanism]
#[derive(Debug, Clone, PartialEq)]
#[coordinates(u)]
#[driver(drive: u = speed * t)]
struct DerivedBelow {
    #[param(2)]
    speed: f64,
}

#[derive(Debug, Clone, PartialEq)]
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = speed * t)]
struct DerivedAbove {
    #[param(2)]
    speed: f64,
}

#[mechanism]
#[cfg_attr(all(), derive(Debug, Clone, Copy, PartialEq))]
#[derive(Default)]
#[coordinates(u)]
#[driver(drive: u = 1 + speed * t)]
struct OwnDefault {
    #[param]
    speed: f64,
}

#[test]
fn derives() {
    assert_eq!(DerivedBelow { speed: 2.0 }, DerivedBelow::default().clone());
    assert_eq!(DerivedAbove { speed: 2.0 }, DerivedAbove::default().clone());
    assert_eq!(OwnDefault { speed: 0.0 }, OwnDefault::default());
    works(&OwnDefault { speed: 1.0 });
}

/// The first paragraph is the mechanism's.
///
/// The second is not.
#[mechanism]
#[bodies(
    /// The only one.
    body
)]
#[revolute(
    /// In the middle.
    O: ground @ (0, 0), body @ (0, 0)
)]
#[driver(drive: body.phi = speed * t)]
struct Documented {
    /// How fast.
    ///
    /// In detail.
    #[param(2, unit = "rad/s")]
    speed: f64,
}

#[test]
fn documentation_is_kept() {
    let model = Documented::model();
    assert_eq!("The first paragraph is the mechanism's.", model.doc);
    let parameter = model.parameters[0];
    assert_eq!(("speed", Some("rad/s"), Some(2.0)), (parameter.name, parameter.unit, parameter.default));
    assert_eq!("How fast.", parameter.doc);
    works(&Documented::default());
}

#[test]
fn mechanisms_inside_functions() {
    fn inner() -> usize {
        #[mechanism]
        #[coordinates(u, v)]
        #[constraint(sum: u + v = 1)]
        #[driver(drive: u = t)]
        struct Local;
        works(&Local);
        Local::COORDINATES
    }
    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = start + t)]
    struct Local {
        start: f64,
    }
    works(&Local { start: 0.5 });
    assert_eq!((1, 2), (Local::COORDINATES, inner()));
}

/// A parameter without a default value has to be given; the rest of the struct literal can still be taken from another
/// value with `..`.
#[test]
fn parameters_without_defaults() {
    #[mechanism]
    #[coordinates(u)]
    #[driver(drive: u = a + b * t)]
    #[derive(Clone, Copy)]
    struct Line {
        a: f64,
        #[param(-3)]
        b: f64,
    }
    let line = Line { a: 1.0, b: 2.0 };
    works(&line);
    works(&Line { a: 5.0, ..line });
    assert_eq!([None, Some(-3.0)], [0, 1].map(|k: usize| Line::model().parameters[k].default));
}

#[test]
fn array_parameters() {
    #[mechanism]
    #[body(first, origin = ground @ (0, 0))]
    #[body(second, origin = first @ (l[0], 0))]
    #[coordinates(reach)]
    #[driver(a: first.phi = t)]
    #[angle(b: second = speeds[1] * t)]
    #[constraint(c: reach = distance(ground @ (0, 0), second @ (l[1], 0)))]
    struct Arm {
        #[param([0.4, 0.3])]
        l: [f64; 2],
        #[param(2)]
        speeds: [f64; 2],
    }
    let names: Vec<_> = Arm::model().parameters.iter().map(|p| p.name).collect();
    assert_eq!(["l[0]", "l[1]", "speeds[0]", "speeds[1]"], names[..]);
    works(&Arm::default());
    let state = Arm { l: [1.0, 2.0], ..Arm::default() }.state_at(&Instant::at(0.0)).unwrap();
    assert!((state.q[2] - 3.0).abs() < 1e-12, "{:?}", state.q);
}
