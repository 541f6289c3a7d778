//! What users guess: attributes, functions, units and forms of other tools.

use super::{errors, one_error, pendulum};

#[test]
fn guessed_attributes_are_answered() {
    for (attribute, right) in [
        ("pin(B: ground @ (0, 0), crank @ (0, 0))", "it is called `revolute`"),
        ("slot(B: ground @ (0, 0), crank @ (0, 0))", "a `point_on_line`"),
        ("rod(B: ground @ (0, 0), crank @ (0, 0))", "a `distance`"),
        ("cylinder(B: ground @ (0, 0), crank @ (0, 0))", "a `distance` whose `length`"),
        ("rack(B: ground @ (0, 0), crank @ (0, 0))", "`rack_pinion`"),
        ("wheel(B: ground @ (0, 0), crank @ (0, 0))", "a `rolling`"),
        ("cam(B: ground @ (0, 0), crank @ (0, 0))", "`on_curve`"),
        ("pulley(B: ground @ (0, 0), crank @ (0, 0))", "a `belt`"),
        ("chain(B: ground @ (0, 0), crank @ (0, 0))", "a `belt`"),
        ("rail(B: ground @ (0, 0), crank @ (0, 0))", "`translational`"),
        ("guide(B: ground @ (0, 0), crank @ (0, 0))", "`translational`"),
        ("fix(B: crank)", "`fixed`"),
        ("lock(crank)", "`#[body(crank, x = 0, y = 0)]`"),
        ("start(crank.phi = 1)", "`guess`"),
        ("init(crank.phi = 1)", "`guess`"),
        ("initial(crank.phi = 1)", "`guess`"),
        ("velocity(B: crank.phi = 1)", "`speed`"),
        ("output(o = crank.phi)", "a `define`"),
        ("unit(\"m\")", "`#[param(0.1, unit = \"m\")]`"),
        ("units(m, s)", "`#[param(0.1, unit = \"m\")]`"),
        ("joint(B: ground @ (0, 0), crank @ (0, 0))", "called by its kind"),
        ("friction(A = 0.1)", "there is no friction"),
        ("world(frame)", "`ground` in every mechanism"),
    ] {
        let word = attribute.split('(').next().unwrap();
        one_error(&pendulum(&format!("#[{attribute}]")), &[&format!("no attribute `{word}` in kin"), right]);
    }
    // They may belong to a macro of another crate.
    assert!(errors(&pendulum("#[pin(a)] #[unit(b)] #[derive(Clone, other::Trait)]")).is_empty());
    assert_eq!(errors(&pendulum("#[pin(a)] #[derive(Clone, core::fmt::Debug)]")).len(), 1);
    // What they may declare is not reported as missing.
    one_error(&pendulum("#[output(o = crank.phi)] #[driver(d: o = t)]"), &["no attribute `output`"]);
}

#[test]
fn numbers_have_no_units() {
    for (number, right) in [
        ("50deg", "50 degrees are written `50*pi/180`"),
        ("2rad", "which are not written: `2`"),
        ("5mm", "numbers have no units; a parameter has one, `#[param(5, unit = \"mm\")]`"),
        ("0.1kg", "`#[param(0.1, unit = \"kg\")]`"),
        ("2t", "a product is written with `*`: `2*t`"),
        ("0x1p3", "the suffix `p3` has no meaning here"),
        ("100 N/m", "a unit belongs to a parameter"),
        ("0.1 m", "a unit belongs to a parameter"),
    ] {
        one_error(&pendulum(&format!("#[driver(d: crank.phi = {number})]")), &[right]);
    }
}

#[test]
fn functions_of_other_languages_are_replaced() {
    for (formula, right) in [
        ("max(t, 1)", "`(a + b + abs(a - b))/2`"),
        ("min(t, 1)", "`(a + b - abs(a - b))/2`"),
        ("t.max(1)", "`(a + b + abs(a - b))/2`"),
        ("sign(t)", "`a/abs(a)`"),
        ("mod(t, 1)", "it jumps"),
        ("floor(t)", "it jumps"),
        ("angle(crank, ground)", "the angle from body `a` to body `b` is `b.phi - a.phi`"),
        ("norm(crank)", "`distance(P, Q)`"),
    ] {
        let name = formula.trim_start_matches("t.").split('(').next().unwrap();
        let said = format!("there is no function `{name}`; ");
        one_error(&pendulum(&format!("#[driver(d: crank.phi = {formula})]")), &[&said, right]);
    }
    // A supplied function may have such a name.
    assert!(
        errors(
            "#[bodies(crank)] #[revolute(A: ground @ (0, 0), crank @ (0, 0))] #[function(angle, max)] \
             #[driver(d: crank.phi = angle(t) + max(t))] struct S { angle: Box<F>, max: Box<F> }"
        )
        .is_empty()
    );
}

#[test]
fn names_of_joints_are_known() {
    let rod = "#[bodies(rod)] #[revolute(B: crank @ (l, 0), rod @ (0, 0))] #[point(tip = rod @ (l, 0))]";
    let said = |more: &str| errors(&pendulum(&format!("{rod} {more}")));
    for (more, right) in [
        (
            "#[driver(d: B.angle = t)]",
            "`B` is the name of a `revolute`, and its angle is written `rod.phi - crank.phi`",
        ),
        ("#[driver(d: A.angle = t)]", "`A` is the name of a `revolute`, and its angle is written `crank.phi`"),
        ("#[driver(d: B = t)]", "its angle is written `rod.phi - crank.phi`"),
        ("#[driver(d: rod.phi = t)] #[define(s = d)]", "`d` is the name of a `driver`, and a formula contains"),
        ("#[define(s = B.x)]", "a point is written `body @ (x, y)`"),
        ("#[point(p = B)]", "a point is written `body @ (x, y)`"),
        ("#[driver(d: tip.speed = t)]", "`speed` does not exist: a rate is written `dot(…)`"),
        ("#[driver(d: tip.x_dot = t)]", "a rate is written `dot(…)`"),
        ("#[driver(d: tip.ax = t)]", "no accelerations"),
        ("#[x(d: world @ (0, 0) = t)]", "the fixed body is called `ground`"),
        ("#[x(d: base @ (0, 0) = t)]", "the fixed body is called `ground`"),
    ] {
        let said = said(more);
        assert!(said.len() == 1 && said[0].contains(right), "{more}: {said:?}");
    }
}

#[test]
fn index_variables_are_named_in_brackets() {
    let arms = |body: &str| format!("#[body({body}, y = 0)] #[driver(d[j in 0..2]: arm[j].phi = t)] struct S;");
    one_error(&arms("arm[2], x = 0.2 + 0.5*i"), &["the brackets of the family name it: `arm[i in 0..2]`"]);
    one_error(
        &pendulum("#[revolute(O[i in 0..2][j in 0..2]: crank @ (0, 0), ground @ (i, 0))]"),
        &["counted by one index"],
    );
    one_error(
        &pendulum("#[revolute(O[i in 0..2][j in 0..2]: crank @ (i, j), ground @ (0, 0))]"),
        &["counted by one index"],
    );
    for range in ["3..0", "0..n", "0..=3", "0..3 step 2"] {
        assert_eq!(errors(&arms(&format!("arm[i in {range}], x = 0.5*i"))).len(), 1, "{range}");
        let driver = format!("#[driver(d[i in {range}]: crank.phi = i + t)]");
        assert_eq!(errors(&pendulum(&driver)).len(), 1, "{range}");
    }
}

#[test]
fn one_slip_is_one_error() {
    let said = errors(
        "#[bodies(crank coupler rocker)] #[revolute(A: crank @ (0, 0), coupler @ (0, 0))] \
         #[revolute(B: rocker @ (0, 0), coupler @ (0, 0))] struct S;",
    );
    assert_eq!(said, ["expected a comma before this"; 2]);
    for declared in ["bodies()", "body(crank, coupler)"] {
        one_error(
            &format!("#[{declared}] #[revolute(A: crank @ (0, 0), coupler @ (0, 0))] struct S;"),
            &[declared.split('(').next().unwrap()],
        );
    }
    one_error(&pendulum("#[bodies(ground)]"), &["`ground` is the fixed frame in every mechanism"]);
    one_error(&pendulum("#[coordinates(pi)]"), &["`pi` is the number π"]);
}

#[test]
fn options_and_values_are_told_apart() {
    for (attribute, right) in [
        (
            "input(lift, value = 1.0)",
            "`input` has no option `value`; it has `default` and `unit`; did you mean `default`?",
        ),
        ("input(lift, defualt = 1.0)", "did you mean `default`?"),
        ("coordinates(u, unit = 3)", "a unit is written in quotes"),
        ("coordinates(u, start = 3)", "a start is given with `#[guess(u = 0)]`"),
        ("bodies(self)", "`self` is a keyword of Rust and cannot be a name"),
        ("define(zz = \"a\")", "a number is written without quotes"),
        ("define(zz = l, units = \"m\")", "did you mean `unit`?"),
        ("torque(F: crank, 3)", "a value follows an `=`"),
        ("define(zz = l, unit = \"m**2\")", "did you mean `m^2`?"),
    ] {
        let row = if attribute.starts_with("coordinates") { "#[driver(d: u = t)]" } else { "" };
        one_error(&pendulum(&format!("#[{attribute}] {row}")), &[right]);
    }
    assert!(errors(&pendulum("#[define(value = l, units = 2*l)]")).is_empty());
}

#[test]
fn a_screw_has_a_lead() {
    let screw = |lead: &str| {
        let source = format!(
            "#[bodies(nut)] #[body(carriage, y = 0, phi = 0)] #[revolute(O: ground @ (0, 0), nut @ (0, 0))] \
             #[driver(d: nut.phi = t)] #[screw(S: ground @ (0, 0), carriage @ (0, 0), axis = (1, 0), nut = nut, \
             lead = {lead})] struct S {{ l: f64 }}"
        );
        let lowered = super::good(&source);
        crate::analyse::derive_equations(&lowered).err().map(|error| error.to_string())
    };
    assert_eq!(screw("l"), None);
    for zero in ["0", "l - l", "0*t"] {
        let said = screw(zero).unwrap();
        assert_eq!(said, "this lead is 0; a lead is positive, or negative where the stroke is reversed");
    }
}
