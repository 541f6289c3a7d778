use super::{errors, good, one_error};
use crate::analyse::derive_equations;
use kin_core::joints::{Driver, Revolute};
use kin_core::mechanism::{BodyOrigin, BodyRef, Formula, GuessTarget, Index, Range, TypedOperands};

const CHAIN: &str = "
    #[bodies(link[10])]
    #[revolute(base: ground @ (0, 0), link[0] @ (0, 0))]
    #[revolute(N[i in 0..9]: link[i] @ (l[i], 0), link[i+1] @ (0, 0))]
    #[point(p[i in 0..5] = link[2*i + 1] @ (l[i]/2, 0))]
    #[define(s[i in 1..10] = link[i].phi - link[i-1].phi)]
    #[driver(D[j in 0..5]: p[j].x = s[2*j + 1])]
    #[guess(link[i in 0..10].phi = phi0[i], link[3].x = 0)]
    struct Chain { #[param(0.1)] l: [f64; 10], #[param([0, 1, 2, 3, 4, 5, 6, 7, 8, 9])] phi0: [f64; 10] }";

#[test]
fn a_chain_of_links() {
    let chain = good(CHAIN);
    let m = &chain.mechanism;
    assert_eq!(m.bodies[0].len, Some(10));
    assert_eq!(m.parameters[0].default.as_deref(), Some(&[0.1; 10][..]));
    assert_eq!(m.parameters[1].default.as_ref().unwrap()[9], 9.0);
    assert_eq!(chain.fields[0].len, Some(10));
    let Some(Revolute { p, q }) = &Revolute::of(&m.joints[1].operands) else { panic!() };
    assert_eq!(m.joints[1].range, Some(Range { start: 0, end: 9 }));
    assert!(matches!(p.body, BodyRef::Body { index: Index { scale: 1, offset: 0 }, .. }));
    assert!(matches!(q.body, BodyRef::Body { index: Index { scale: 1, offset: 1 }, .. }));
    assert!(matches!(m.guesses[0].target, GuessTarget::Pose(BodyRef::Body { index: Index { scale: 1, .. }, .. }, _)));
    assert_eq!((m.guesses[0].range, m.guesses[1].range), (Some(Range { start: 0, end: 10 }), None));
}

#[test]
fn points_of_a_family_are_seen_from_where_they_are_used() {
    let m = good(CHAIN).mechanism;
    let Some(Driver { left: Formula::PointCoordinate(place, _), right, .. }) = &Driver::of(&m.joints[2].operands)
    else {
        panic!()
    };
    assert!(matches!(place.body, BodyRef::Body { index: Index { scale: 2, offset: 1 }, .. }));
    assert!(matches!(&right.value, Formula::Define(member) if member.index == Index { scale: 2, offset: 1 }));
    let m = good(
        "#[bodies(b[9])] #[point(p[i in 0..3] = b[3*i] @ (l[i], 0))] #[driver(N[i in 0..3]: b[3*i+1].x = b[3*i+2].y)] \
         #[driver(M[i in 0..2]: p[2 - 2*i].x = t)] #[driver(d: p[1].x = t)] struct S { l: [f64; 3] }",
    )
    .mechanism;
    let Some(Driver { left: Formula::PointCoordinate(place, _), .. }) = &Driver::of(&m.joints[1].operands) else {
        panic!()
    };
    assert!(matches!(place.body, BodyRef::Body { index: Index { scale: -6, offset: 6 }, .. }));
    assert!(matches!(&place.x, Formula::Parameter(l) if l.index == Index { scale: -2, offset: 2 }));
    let Some(Driver { left: Formula::PointCoordinate(place, _), .. }) = &Driver::of(&m.joints[2].operands) else {
        panic!()
    };
    assert!(matches!(place.body, BodyRef::Body { index: Index { scale: 0, offset: 3 }, .. }));
}

#[test]
fn families_of_carried_bodies() {
    let m = good(
        "#[bodies(base[4])] #[body(arm[i in 0..4], origin = base[i] @ (l[i], 0), phi = l[i])] #[body(free[3], y = 0)] \
         #[angle(N[i in 0..4]: base[i] = t)] #[x(M[i in 0..4]: arm[i] @ (0, 0) = 1)] #[y(O[i in 0..4]: arm[i] @ (0, 0) = 1)] \
         #[x(P[i in 0..3]: free[i] @ (1, 0) = 2)] struct S { l: [f64; 4] }",
    )
    .mechanism;
    let BodyOrigin::Carried(place) = &m.bodies[1].origin_at else { panic!() };
    assert!(matches!(place.body, BodyRef::Body { index: Index { scale: 1, offset: 0 }, .. }));
    assert!(matches!(&m.bodies[2].origin_at, BodyOrigin::Free { x: None, y: Some(_) }));
}

#[test]
fn scalar_families() {
    let m = good("#[coordinates(u[3])] #[driver(N[i in 0..3]: u[2-i] = t)] struct S;").mechanism;
    let Some(Driver { left: Formula::Scalar(u), .. }) = &Driver::of(&m.joints[0].operands) else { panic!() };
    assert_eq!(u.index, Index { scale: -1, offset: 2 });
}

fn chain(attribute: &str) -> String {
    CHAIN.replace("struct Chain", &format!("{attribute} struct Chain"))
}

#[test]
fn indices_are_checked_at_every_step() {
    one_error(
        &chain("#[revolute(X[i in 0..10]: link[i] @ (0, 0), link[i+1] @ (0, 0))]"),
        &["`link[10]` does not exist (where `i` is 9)", "`link[0]` to `link[9]`"],
    );
    one_error(&chain("#[angle(X[i in 0..2]: link[i-1] = 0)]"), &["`link[-1]` does not exist"]);
    one_error(&chain("#[angle(X: link[10] = 0)]"), &["`link[10]` does not exist;"]);
    one_error(&chain("#[x(X: link[0] @ (l[10], 0) = 0)]"), &["`l[10]`"]);
    one_error(&chain("#[x(X: p[5] = 0)]"), &["`p[5]` does not exist; there are `p[0]` to `p[4]`"]);
    one_error(&chain("#[driver(X: s[0] = 0)]"), &["`s[0]` does not exist; there are `s[1]` to `s[9]`"]);
    one_error(&chain("#[point(z[i in 0..9] = link[2*i] @ (0, 0))] #[x(X: z[0] = 1)]"), &["`link[16]`"]);
}

#[test]
fn indices_stand_where_they_belong() {
    one_error(&chain("#[angle(X: link = 0)]"), &["`link` is a family", "`link[0]` to `link[9]`"]);
    one_error(&chain("#[angle(X: link[i] = 0)]"), &["no index variable `i`", "N[i in 0..10]"]);
    one_error(&chain("#[angle(X[k in 0..2]: link[i] = 0)]"), &["no index variable `i`", "`k`"]);
    one_error(&chain("#[angle(X: link[l] = 0)]"), &["`l` is a parameter"]);
    one_error(&chain("#[angle(X: ground[0] = 0)]"), &["there is one ground"]);
    one_error(&chain("#[angle(X[k in 0..2]: link[k] = k[0])]"), &["`k` is the index variable", "no index"]);
    one_error(&chain("#[angle(X[k in 0..2]: link[k*k] = 0)]"), &["linear"]);
    one_error(&chain("#[angle(X: link[1.5] = 0)]"), &["integers"]);
    one_error(&chain("#[angle(X: link[] = 0)]"), &["an index is missing"]);
    one_error(&chain("#[angle(X: link[9999999999999999999999] = 0)]"), &["at most"]);
    one_error("#[coordinates(u)] #[driver(d: u[0] = t)] struct S;", &["`u` is a coordinate, not a family"]);
}

#[test]
fn ranges_are_literals_that_hold_something() {
    one_error(&chain("#[angle(X[i in 3..3]: link[i] = 0)]"), &["the range 3..3 is empty"]);
    one_error(&chain("#[angle(X[i in 0..=3]: link[i] = 0)]"), &["start..end"]);
    one_error(&chain("#[angle(X[i in 0..n]: link[i] = 0)]"), &["integer literals"]);
    one_error(&chain("#[angle(X[3]: link[0] = 0)]"), &["needs an index variable"]);
    // Uses of the index variable that is missing are no further errors.
    one_error(&chain("#[angle(X[3]: link[i] = i*t)]"), &["needs an index variable"]);
    one_error(&chain("#[point(X[3] = link[i] @ (i, 0))]"), &["needs an index variable"]);
    one_error(&chain("#[define(X[3] = link[i].phi + i)]"), &["needs an index variable"]);
    one_error(&chain("#[bodies(y[3])] #[body(X[k in 1..3], x = 2*k, y = 0)]"), &["counted from 0"]);
    one_error(&chain("#[angle(X[0..3]: link[0] = 0)]"), &["names its index"]);
    one_error(&chain("#[angle(X[i in -1..3]: link[0] = 0)]"), &["begins at 0 or later"]);
    one_error(&chain("#[bodies(more[-1])]"), &["at least one member"]);
    one_error(&chain("#[angle(X[i in 0..99999]: link[i] = 0)]"), &["10000"]);
    assert_eq!(errors("#[bodies(a[0], b[n], c[99999999])] #[angle(N: b[1] = 0)] struct S;").len(), 3);
    one_error("#[coordinates(u[i in 1..3])] #[driver(d: u[1] = t)] struct S;", &["counted from 0"]);
    one_error(
        "#[bodies(link[3])] #[angle(N[i in 0..2]: link[i] = t)] struct S;",
        &["contains a coordinate of `link[2]`"],
    );
}

#[test]
fn an_index_variable_has_a_name_of_its_own() {
    let taken = [("l", "a parameter"), ("s", "a define"), ("p", "a point"), ("link", "a body")];
    for (name, noun) in taken {
        let said = format!("`{name}` is {noun} already, and here an index variable, which needs another name");
        for row in [
            "#[angle(X[NAME in 0..2]: link[NAME] = 2*NAME)]",
            "#[body(X[NAME in 0..2], x = NAME, y = 0)] #[angle(Y[i in 0..2]: X[i] = 1)]",
            "#[bodies(X[NAME in 0..2])] #[angle(Y[i in 0..2]: X[i] = 1)]",
            "#[coordinates(X[NAME in 0..2])] #[driver(Y[i in 0..2]: X[i] = t)]",
            "#[input(X[NAME in 0..2])]",
            "#[point(X[NAME in 0..2] = link[NAME] @ (NAME, 0))]",
            "#[define(X[NAME in 0..2] = NAME)]",
            "#[unilateral(X[NAME in 0..2]: link[NAME].x > NAME)]",
            "#[mass(X[NAME in 0..2]: link[NAME] @ (NAME, 0), mass = 1)]",
            "#[guess(link[NAME in 0..2].y = NAME)]",
        ] {
            one_error(&chain(&row.replace("NAME", name)), &[&said]);
        }
    }
    one_error(&chain("#[angle(X[t in 0..2]: link[t] = t)]"), &["`t` is time in every mechanism; an index variable"]);
    one_error(&chain("#[angle(X[pi in 0..2]: link[pi] = pi)]"), &["`pi` is the number π", "an index variable"]);
    one_error(
        &chain("#[on_curve(X[theta in 0..2]: link[0] @ (0, 0), link[theta + 1] @ (0, 0), polar(theta) = 1)]"),
        &["`theta` is a variable of this curve; an index variable needs another name"],
    );
    // Rows have names of their own.
    assert!(errors(&chain("#[angle(X[N in 0..2]: link[N] = N)]")).is_empty());
}

#[test]
fn a_division_by_zero_says_at_which_index() {
    for (divisor, message) in
        [("i - 1", "division by zero where the index variable is 1"), ("s[1] - s[1]", "division by zero")]
    {
        let lowered = good(&chain(&format!("#[define(w[i in 0..2] = 1/({divisor}))]")));
        let error = derive_equations(&lowered).map(|_| ()).unwrap_err();
        assert_eq!(message, error.to_string());
    }
}

#[test]
fn constants_have_values_at_every_index() {
    for (constant, why) in [
        ("sqrt(i - 1)", "`sqrt` takes 0 or a positive number, not -1 (where `i` is 0)"),
        ("1 + asin(i/2)", "`asin` takes a number from -1 to 1, not 1.5 (where `i` is 3)"),
        ("pow(i - 2, -1)", "0 to the power of -1 divides by 0 (where `i` is 2)"),
    ] {
        one_error(&chain(&format!("#[define(w[i in 0..4] = phi0[i]*{constant})]")), &[why]);
    }
    assert!(errors(&chain("#[define(w[i in 1..4] = ln(i) + sqrt(l[i] - i))]")).is_empty());
}
