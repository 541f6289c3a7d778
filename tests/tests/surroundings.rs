//! Scopes that could collide with generated code: no prelude, modules and macros of common names, constants with the
//! names of generated local variables.

use kin_tests::works;

/// Without the prelude, with modules and macros that have names which generated code uses, and with keywords of other
/// contexts as identifiers.
mod bare {
    #![no_implicit_prelude]
    use ::kin_runtime::mechanism;

    #[expect(unused_macros, reason = "it is there to be taken by mistake")]
    macro_rules! assert {
        () => {};
    }
    mod core {}
    mod std {}

    #[mechanism]
    #[bodies(x, y, phi)]
    #[coordinates(f, u, out)]
    #[point(p = x @ (1, 0))]
    #[define(d = p.x + p.y)]
    #[revolute(x: ground @ (0, 0), x @ (0, 0))]
    #[revolute(y: p, y @ (0, 0))]
    #[revolute(phi: y @ (1, 0), phi @ (0, 0))]
    #[driver(f: x.phi = t)]
    #[driver(u: y.phi = t)]
    #[driver(out: phi.phi = x.phi + y.x * 2)]
    #[constraint(axis: f = d)]
    #[constraint(angle: u = f)]
    #[constraint(length: out = u + 1)]
    #[guess(x.x = 0, out = 3)]
    pub(super) struct Bare;
}

#[test]
fn bare_surroundings() {
    works(&bare::Bare);
}

/// Only uses outside of the macro are uses of something deprecated.
mod deprecated {
    #![deny(warnings)]

    #[kin_runtime::mechanism(cross_check)]
    #[bodies(arm)]
    #[revolute(O: ground @ (0, 0), arm @ (l, 0))]
    #[driver(drive: arm.phi = t)]
    #[deprecated]
    pub(super) struct Old {
        #[deprecated]
        #[param(1)]
        pub l: f64,
    }
}

#[test]
#[expect(deprecated, reason = "this is a use outside of the macro")]
fn deprecated_items() {
    works(&deprecated::Old::default());
}

/// Constants and statics with the names of generated local variables: a `let` cannot shadow them.
mod constants {
    #![expect(non_upper_case_globals, dead_code, reason = "collisions are wanted")]

    macro_rules! named {
        ($($name:ident)*) => { $(const $name: &str = "the user's";)* };
    }
    named!(at gamma geometry guesses index joint k observations out p parameters phi phi_q phi_t q q_dot s subset u value w
        workspace x this difference v0 v1 v2 v3 s0 s1 c0 c1 d0 e0 f0 branches closeness curves factors loads saved turns);
    static t: f64 = 1.0;

    #[kin_runtime::mechanism(cross_check)]
    #[bodies(arm, pin)]
    #[revolute(O: ground @ (0, 0), arm @ (l[0], 0))]
    #[angle(level: pin = 0)]
    #[x(slot: pin @ (0, 0) = 0)]
    #[on_curve(rim: arm @ (l[0], 0), pin @ (0, 0), polar(theta) = l[0] + 0.1 * cos(theta))]
    #[driver(drive: arm.phi = sin(speed * t) + t * t)]
    #[torque(brake: arm = -speed)]
    #[point(tip = arm @ (l[1], 0))]
    #[guess(arm.x = speed, pin.y = 1)]
    struct Arm {
        #[param([1, 2])]
        l: [f64; 2],
        #[param(3)]
        speed: f64,
    }

    #[test]
    fn of_generated_locals_can_be_the_users() {
        super::works(&Arm::default());
        assert_eq!(1.0, t);
    }
}
