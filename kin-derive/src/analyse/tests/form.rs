use super::{equation, errors, good, messages, one_error, pendulum, tokens};
use crate::analyse::analyse;

#[test]
fn expressions_say_what_would_be_right() {
    for (source, right) in [
        ("u^2", "`pow(a, n)` or `a.powi(n)`"),
        ("u**2", "powers are written"),
        ("u % 2", "remainder"),
        ("u == v", "single `=`"),
        ("u < v", "comparisons"),
        ("2 u", "a product is written with `*`"),
        ("u (v)", "a product is written with `*`"),
        ("u, v", "expected `=`"),
        ("(u, v)", "a pair is written"),
        ("+u", "unary plus"),
        ("u +", "expected an expression before this"),
        ("", "expected an expression before this"),
        ("()", "expected an expression before this"),
        ("u as f64", "no cast"),
        ("[u]", "an array cannot stand here"),
        ("{u}", "a block"),
        ("u @ (0, 0)", "a point is written"),
        ("3u8", "suffix `u8`"),
        ("1f32", "suffix `f32`"),
        ("1e999", "too large"),
        ("1e400", "too large"),
        ("1e-400 * u", "too small and would become 0"),
        ("0.001E-330", "too small and would become 0"),
        ("'u'", "expected a number"),
        ("std::f64::consts::PI", "paths"),
        ("max!(u)", "macros"),
        ("self.l1", "names stand alone"),
        ("sin(u, v)", "`sin(a)`"),
        ("sin()", "`sin(a)`"),
        ("sin", "is a function"),
        ("pow(u)", "`pow(a, n)`"),
        ("pow(u, v)", "an exponent is a constant"),
        ("pow(u, 1/0)", "finite"),
        ("u.powi(0.5)", "integer"),
        ("powi(u, 2)", "`pow(a, n)`"),
        ("u.pow(2)", "`a.powi(n)`"),
        ("u.sinus()", "no function `sinus`"),
        ("u.cosh()", "`(exp(a) + exp(-a))/2`"),
        ("sine(u)", "did you mean `sin`"),
        ("max(u, v)", "no function `max`"),
        ("l1(u)", "a parameter, not a function"),
        ("u.x", "`u` is a coordinate and has no components"),
        ("(u + v).x", "belongs to a body"),
        ("u.0", "after the dot"),
        ("dot(u)", "is allowed only in `nonholonomic`, `force` and `torque`"),
        ("u.dot()", "is allowed only in `nonholonomic`, `force` and `torque`"),
        ("dot(u, v)", "is written `dot(a)`"),
        ("distance(u)", "two points"),
        ("u / 0", "divides by 0"),
        ("u / (-0.0)", "divides by 0"),
        ("t.x", "`t` has no components"),
        ("t[0]", "takes no index"),
        ("ground", "is a body"),
        ("if u", "no branches"),
        ("u ? v", "the operators are"),
        ("true", "expected a number"),
        (".5", "begins with a digit"),
        ("match", "no branches"),
        ("type", "written `r#type`"),
        ("90 deg", "radians"),
        ("rad(90)", "radians"),
        ("90.to_radians()", "radians"),
        ("\"90\"", "without quotes"),
        ("u.x()", "without brackets"),
        ("u.sin", "`u.sin()`"),
        ("log(u)", "`ln`"),
        ("t(u)", "no function"),
        ("pow(u, l1)", "`exp(n*ln(a))`"),
        ("time", "time is `t`"),
        ("PI", "π is `pi`"),
        ("U", "did you mean `u`?"),
        ("u = v", "one `=` at most"),
    ] {
        let errors = errors(&equation(source));
        assert_eq!(errors.len(), 1, "{source}: {errors:?}");
        assert!(errors[0].contains(right), "{source}: {errors:?}");
    }
}

#[test]
fn depth_is_bounded() {
    let deep = |n: usize| format!("{}u{}", "(".repeat(n), ")".repeat(n));
    assert!(errors(&equation(&deep(40))).is_empty());
    for source in [
        deep(45),
        deep(400),
        format!("{}u", "-".repeat(5000)),
        format!("u{}", ".sin()".repeat(5000)),
        format!("{}u{}", "sin(".repeat(44), ")".repeat(44)),
        format!("{}l1{}", "distance(ground @ (".repeat(20), ", 0), ground @ (0, 0))".repeat(20)),
    ] {
        assert!(errors(&equation(&source)).len() <= 1, "{:?} {source}", errors(&equation(&source)));
    }
    assert_eq!(errors(&equation(&format!("u{}", ".sin()".repeat(300)))).len(), 1);
    assert!(errors(&equation(&format!("u{}", ".sin()".repeat(150)))).is_empty());
    assert_eq!(errors(&equation(&deep(400))).len(), 1);
}

/// A zero is accepted in every notation, and so is the smallest positive number.
#[test]
fn numbers_that_are_zero_or_tiny_are_read() {
    for number in ["0.0", "0e-400", "00.000E5", "5e-324", "1e-320", "0x0"] {
        assert!(errors(&equation(&format!("u + v + {number}"))).is_empty(), "{number}");
    }
    one_error("#[coordinates(u)] #[driver(d: u = t)] struct S { #[param(1e-400)] l: f64 }", &["too small"]);
    one_error("#[coordinates(u)] #[driver(d: u = t)] struct S { #[param([1, 1e400])] l: [f64; 2] }", &["too large"]);
}

/// Sums and products of many terms are balanced, so that their trees are not deep.
#[test]
fn long_sums_and_products_are_read() {
    for count in [2, 15, 16, 17, 18, 31, 200, 500, 5000] {
        let sum: String = (0..count).map(|k| format!("{} {k}.5 * u", if k % 3 == 1 { " -" } else { " +" })).collect();
        let product: String =
            (0..count).map(|k| format!(" {} (u + {k})", if k % 5 == 2 { "/" } else { "*" })).collect();
        for source in [format!("v{sum}"), format!("v{product}"), format!("sin(v{sum}) - (u{sum})")] {
            assert_eq!(errors(&equation(&source)), Vec::<String>::new(), "{count}");
        }
    }
}

/// A long chain of operators is evaluated from left to right.
#[test]
fn long_chains_of_numbers_have_their_value() {
    for count in 1..80_u32 {
        for pattern in [0b1_u32, 0b10, 0b101, 0b110_1001, 0xffff_ffff, 0x9a3c_55e1] {
            let taken = |k: u32| pattern.rotate_right(k) & 1 == 1;
            let (mut sum, mut product, mut sums, mut products) = (1.0, 1.0, "1".to_owned(), "1".to_owned());
            for k in 1..count {
                let value = 1.0 + f64::from(k % 7) / 8.0;
                sum += if taken(k) { -value } else { value };
                product *= if taken(k) { 1.0 / value } else { value };
                sums += &format!(" {} {value}", if taken(k) { "-" } else { "+" });
                products += &format!(" {} {value}", if taken(k) { "/" } else { "*" });
            }
            let source = format!(
                "#[coordinates(u)] #[driver(d: u = t)] struct S {{ #[param({sums})] a: f64, #[param({products})] b: f64 }}"
            );
            let parameters = good(&source).mechanism.parameters;
            let [a, b] = [0, 1].map(|k| parameters[k].default.as_ref().unwrap()[0]);
            assert_eq!(a, sum, "{sums}");
            assert!((b - product).abs() <= 1e-13 * product, "{products}");
        }
    }
}

#[test]
fn rows_say_how_they_are_written() {
    for (source, right) in [
        ("#[revolute(B: crank @ (0, 0))]", "takes two points: `#[revolute(A: crank @ (l1, 0)"),
        ("#[revolute(B: crank @ (0, 0), ground @ (0, 0), ground @ (1, 0))]", "takes two points"),
        ("#[revolute(B: crank @ (0, 0), ground @ (0, 0), axis = (1, 0))]", "`revolute` has no options"),
        ("#[revolute(crank @ (0, 0), ground @ (0, 0))]", "begins with its name and a colon"),
        ("#[revolute]", "is written `#[revolute("),
        ("#[revolute()]", "begins with its name"),
        ("#[revolute{B: crank @ (0, 0), ground @ (0, 0)}]", "parentheses"),
        ("#[revolute = 3]", "is written"),
        ("#[revolute(B: crank @ (0), ground @ (0, 0))]", "second component is missing"),
        ("#[revolute(B: crank @ (0, 0, 0), ground @ (0, 0))]", "two components"),
        ("#[revolute(B: crank @, ground @ (0, 0))]", "`body @ (x, y)`"),
        ("#[revolute(B: crank, ground @ (0, 0))]", "`crank` is a body; a point of it is written `crank @ (0, 0)`"),
        ("#[revolute(B: ground, crank @ (0, 0))]", "`ground` is a body; a point of it"),
        ("#[revolute(B: crank.x, ground @ (0, 0))]", "without a component"),
        ("#[revolute(B: 3, ground @ (0, 0))]", "expected a point"),
        ("#[revolute(B: crank @ (0, 0) ground @ (0, 0))]", "expected a comma"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0))]", "needs `axis = …`"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), axis = 3)]", "an axis is a pair"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), axi = (1, 0))]", "did you mean `axis`?"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), axis = (1, 0), axis = (1, 0))]", "given twice"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), axis: (1, 0))]", "`axis` is given with `=`"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), axis (1, 0))]", "`axis` is given with `=`"),
        ("#[translational(B: crank @ (0, 0), ground @ (0, 0), (1, 0))]", "two points, then options"),
        ("#[distance(B: crank @ (0, 0), ground @ (0, 0) = 1)]", "no equation"),
        ("#[revolute(B: crank (0, 0), ground @ (0, 0))]", "`body @ (x, y)`"),
        ("#[revolute(B: crank @ 0, 0, ground @ (0, 0))]", "`body @ (x, y)`"),
        ("#[coordinates(u = 0)] #[driver(D: u = t)]", "`#[guess(u = 0)]`"),
        ("#[guess(crank. = 1)]", "after the dot"),
        ("#[driver(B: crank.phi_dot = 1)]", "a rate is written `dot(…)`"),
        ("#[speed(B: crank @ (0, 0))]", "needs `value = …`"),
        ("#[driver(B: crank.phi() = 1)]", "without brackets"),
        ("#[prismatic(B: crank @ (0, 0), ground @ (0, 0))]", "it is called `translational`"),
        ("#[distance(B: crank @ (0, 0), ground @ (0, 0))]", "needs `length = …`"),
        ("#[distance(B: crank @ (0, 0), ground @ (0, 0), lenght = 1)]", "did you mean `length`?"),
        ("#[x(B: crank @ (0, 0))]", "expected `=` and a value"),
        ("#[x(B: crank @ (0, 0) = )]", "expected an expression before this"),
        ("#[x(B: crank @ (0, 0) = 1 = 2)]", "one `=` at most"),
        ("#[x(B: crank @ (0, 0) == 1)]", "a single `=`"),
        ("#[angle(B: crank.phi = 1)]", "not its coordinate"),
        ("#[angle(B: crank @ (0, 0) = 1)]", "not a point"),
        ("#[relative_angle(B: crank = 1)]", "takes two bodies"),
        ("#[driver(B: crank.phi)]", "expected `=` and a value"),
        ("#[driver(crank.phi = omega*t)]", "begins with its name"),
        ("#[point(tip)]", "expected `=` and a value: `#[point("),
        ("#[point(tip[3] = crank @ (0, 0))]", "needs an index variable"),
        ("#[define(s)]", "expected `=`"),
        ("#[guess(crank.phi)]", "expected `=`"),
        ("#[guess(crank = 1)]", "a guess is for one coordinate of it"),
        ("#[guess(omega = 1)]", "is a parameter; a guess is for a coordinate"),
        ("#[guess()]", "is empty"),
        ("#[bodies()]", "is empty"),
        ("#[body(wheel, z = 1)] #[angle(W: wheel = 0)]", "`body` has no option `z`"),
        ("#[body(wheel, x = 1, x = 2)] #[angle(W: wheel = 0)]", "given twice"),
        ("#[body(wheel, other)] #[angle(W: wheel = 0)]", "declares one body"),
        ("#[bodies(#[cfg(a)] wheel)]", "only a doc comment"),
        ("#[param(1)]", "stands on a field"),
        ("#[mechanism]", "once"),
        ("#[input()] #[driver(D: crank.phi = t)]", "is empty"),
        (
            "#[coordinates(unit = \"rad\")] #[driver(D: crank.phi = t + u)]",
            "`coordinates` declares no name; names come before the options: `#[coordinates(phi1, phi2)]`",
        ),
        ("#[input(default = 3, unit = \"m\")]", "`input` declares no name"),
        ("#[define(unit = \"m\")]", "`define` declares no name"),
        ("#[define(unit = \"nonsense\")]", "unit"),
        (
            "#[input(u = 1)] #[driver(D: crank.phi = u)]",
            "its value is given at run time, and a default with `#[input(u, default = …)]`",
        ),
        ("#[input(u, default = 1.1m)] #[driver(D: crank.phi = u)]", "stands beside: `default = 1.1, unit = \"m\"`"),
        ("#[input(u[i in 1..3])] #[driver(D: crank.phi = u[0])]", "counted from 0: `#[input(u[3])]`"),
        ("#[gear(G: crank, ground)]", "`gear` needs `radii = …`"),
        ("#[gear(G: crank, radii = (1, 2))]", "`gear` takes two bodies, then options"),
        ("#[gear(G: crank, wheel @ (0, 0), radii = (1, 2))]", "not a point"),
        ("#[gear(G: crank, ground, radii = 2)]", "radii are a pair"),
        ("#[gear(G: crank, ground, radii = (1, 2), carrier = arm @ (0, 0))]", "not a point"),
        ("#[gear(G: crank, ground, radii = (1, t), carrier = crank)]", "`radii` takes numbers and parameters only"),
        ("#[belt(G: crank, crank, radii = (1, 2))]", "joins `crank` with itself"),
        (
            "#[belt(G: crank, ground, radii = (1, 2))]",
            "the ground cannot be one of the two bodies that belt `G` couples",
        ),
        ("#[belt(G: ground, crank, radii = (1, 2), carrier = crank)]", "one of the two bodies that belt `G` couples"),
        ("#[rack_pinion(R: ground @ (0, 0), crank @ (0, 0), axis = (1, 0), radius = 1)]", "needs `pinion = …`"),
        ("#[rack_pinion(R: ground @ (0, 0), crank @ (0, 0), axis = (1, 0), radius = 1, pinion = 3)]", "name of a body"),
        (
            "#[rolling(R: ground @ (0, 0), crank @ (0, 0))]",
            "on a line with `axis = (1, 0), radius = r`, on another disc",
        ),
        ("#[rolling(R: ground @ (0, 0), crank @ (0, 0), radius = 1)]", "needs `axis = …`"),
        (
            "#[rolling(R: ground @ (0, 0), crank @ (0, 0), radii = (1, 1), radius = 1)]",
            "`radius` belongs to the other form",
        ),
        (
            "#[rolling(R: ground @ (0, 0), crank @ (0, 0), axis = (1, 0), along = u)]",
            "`along` belongs to the other form",
        ),
        (
            "#[rolling(R: ground @ (0, 0), crank @ (0, 0), radii = (1, 1), along = crank)]",
            "`along` names a scalar coordinate",
        ),
        (
            "#[rolling(R: ground @ (0, 0), crank @ (0, 0), radii = (1, 1), along = crank.phi)]",
            "name of a scalar coordinate",
        ),
        ("#[rolling(R: ground @ (0, 0), crank @ (0, 0), radii = (1, 1), along = psi)]", "no coordinate named `psi`"),
    ] {
        let errors = errors(&pendulum(source));
        assert_eq!(errors.len(), 1, "{source}: {errors:?}");
        assert!(errors[0].contains(right), "{source}: {errors:?}");
    }
}

#[test]
fn attributes_that_are_nearly_ours() {
    one_error(&pendulum("#[revolut(B: a @ (0, 0), b @ (0, 0))]"), &["no attribute `revolut`", "`revolute`"]);
    one_error(&pendulum("#[drivers(D: crank.phi = t)]"), &["`driver`"]);
    one_error(&pendulum("#[moment(D: crank = t)]"), &["it is called `torque`"]);
    one_error(&pendulum("#[damper(D: crank @ (1, 0), ground @ (0, 0))]"), &["a `spring` with `damping = c`"]);
    // A misspelt declaration does not cause a second error for the names that it declares.
    one_error("#[bodys(a, b)] #[revolute(A: a @ (0, 0), b @ (0, 0))] struct S;", &["`bodies` or `body`"]);
    one_error(&pendulum("").replace("#[param(1)]", "#[parm(1)]"), &["did you mean `param`"]);
    one_error(&pendulum("").replace("#[param(1)]", "#[point(p = crank @ (0, 0))]"), &["stands above the struct"]);
}

#[test]
fn parameters_say_how_they_are_written() {
    for (field, right) in [
        ("#[param(1, 2)] a: f64", "one default"),
        ("#[param(l)] a: f64", "made of numbers and `pi`"),
        ("#[param(1/0)] a: f64", "finite"),
        ("#[param(1, units = \"m\")] a: f64", "did you mean `unit`"),
        ("#[param(unit = m)] a: f64", "in quotes"),
        ("#[param(unit = \"m\", unit = \"m\")] a: f64", "given twice"),
        ("#[param(1)] #[param(2)] a: f64", "given twice"),
        ("#[param = 1] a: f64", "is written"),
        ("#[param([1, 2])] a: f64", "single number"),
        ("#[param([1, 2])] a: [f64; 3]", "3 elements and 2 defaults"),
        ("#[param([1; 3])] a: [f64; 3]", "one number stands for all"),
        ("a: [f64; N]", "integer literal"),
        ("a: [[f64; 2]; 2]", "one index"),
        ("a: &'static f64", "a parameter is a number"),
        ("a: (f64, f64)", "a parameter is a number"),
        ("a: [f64]", "a parameter is a number"),
        ("a: fn(f64) -> f64", "a parameter is a number"),
        ("#[cfg(test)] a: f64", "cannot depend on `cfg`"),
        ("#[cfg_attr(all(), param(1))] a: f64", "not inside `cfg_attr`"),
        ("a: usize", "a parameter is a number"),
        ("a: std::string::String", "a parameter is a number"),
        ("a: [i32; 3]", "a parameter is a number"),
    ] {
        one_error(&pendulum("").replace("omega: f64", field), &[right]);
    }
    for field in [
        "a: Real",
        "#[cfg_attr(all(), serde(skip))] a: f64",
        "a: [f32; 3]",
        "a: std::primitive::f64",
        "#[param(sin(pi/2)*pow(2, 3))] a: (f64)",
    ] {
        assert!(errors(&pendulum("").replace("omega: f64", field)).is_empty(), "{field}");
    }
}

#[test]
fn only_structs_with_names_are_mechanisms() {
    for item in ["enum E { A }", "union U { a: f64 }", "fn f() {}"] {
        one_error(item, &["a mechanism is a struct"]);
    }
    one_error("struct S(#[param(1)] f64);", &["have names"]);
    one_error("#[coordinates(u)] #[driver(d: u = t)] struct S<T> { a: Vec2<T> }", &["such as `T`"]);
    one_error("#[coordinates(u)] #[driver(d: u = t)] struct S<const __T: usize> { a: f64 }", &["generated code"]);
    assert_eq!(errors("struct").len(), 1);
}

#[test]
fn flags_are_known() {
    let flags = |args: &str| {
        let item = tokens("#[coordinates(u)] #[driver(d: u = t)] struct S;");
        analyse(tokens(args), item).1.map_or_else(messages, |_| Vec::new())
    };
    assert!(flags("cross_chek")[0].contains("did you mean `cross_check`"));
    let [attribute] = &flags("gravity = (0, -9.81)")[..] else { panic!("one error") };
    assert!(attribute.ends_with("; write `#[gravity(0, -9.81)]` below"), "{attribute}");
    assert!(flags("bodies(crank)")[0].ends_with("; write `#[bodies(…)]` below"));
    assert!(flags("cross_check, cross_check")[0].contains("twice"));
    assert!(flags("cross_check = true")[0].contains("alone"));
    assert_eq!(flags("3, allow, cross_check = 4").len(), 3);
}

#[test]
fn all_mistakes_come_at_once() {
    let source = "#[bodies(crank, rocker)] \
        #[revolute(A: crnk @ (l, 0), rokcer @ (m, 0))] \
        #[revolute(B: crank @ (u^2, 0), rocker @ (n/0, 0))] \
        #[distance(C: crank @ (0, 0), ground @ (0, 0), length = -1)] \
        #[gear(G: crank, rocker)] \
        struct S { l: f64, #[param(x)] k: f64 }";
    let errors = errors(source);
    assert_eq!(errors.len(), 9, "{errors:#?}");
}

#[test]
fn a_derived_default_does_not_discard_the_defaults_of_fields() {
    let derived = |fields: &str| {
        format!(
            "#[coordinates(u)] #[driver(d: u = t)] #[derive(Clone, core::default::Default)] struct S {{ {fields} }}"
        )
    };
    one_error(
        &derived("#[param(0.1)] l: f64, #[param([1, 2])] m: [f64; 2]"),
        &["sets every number to 0", "the defaults of `l` and `m`; remove it: kin implements `Default` with them"],
    );
    one_error(
        &derived("#[param(0.1)] l: f64, m: f64"),
        &["the default of `l`; remove it: kin implements `Default` if every field has a default, and `m` has none"],
    );
    assert!(good(&derived("l: f64, #[param(unit = \"m\")] m: f64")).derives_default);
    assert!(good("#[coordinates(u)] #[driver(d: u = t)] #[derive(Default)] struct S;").derives_default);
}
