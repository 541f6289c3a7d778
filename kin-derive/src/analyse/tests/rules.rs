use super::{errors, one_error, pendulum};

#[test]
fn joints_have_two_bodies() {
    one_error(&pendulum("#[revolute(B: crank @ (0, 0), crank @ (1, 0))]"), &["joins `crank` with itself"]);
    one_error(&pendulum("#[revolute(B: ground @ (0, 0), ground @ (1, 0))]"), &["joins `ground` with itself"]);
    one_error(&pendulum("#[relative_angle(B: crank, crank = 1)]"), &["joins `crank` with itself"]);
    one_error(
        "#[bodies(b[3])] #[angle(M[i in 0..3]: b[i] = t)] #[revolute(N[i in 0..2]: b[i] @ (0, 0), b[2*i] @ (1, 0))] struct S;",
        &["joins `b[0]` with itself"],
    );
}

#[test]
fn geometry_is_not_degenerate() {
    one_error(&pendulum("#[translational(B: crank @ (0, 0), ground @ (1, 0), axis = (0, -0.0))]"), &["no direction"]);
    one_error(&pendulum("#[distance(B: crank @ (0, 0), ground @ (1, 0), length = 0)]"), &["a length of 0"]);
    one_error(&pendulum("#[distance(B: crank @ (0, 0), ground @ (1, 0), length = -2)]"), &["is -2"]);
}

#[test]
fn guesses_are_for_coordinates() {
    let held = |guess: &str| {
        pendulum(&format!(
            "#[body(w, x = 0, phi = 1)] #[body(v, origin = crank @ (0, 0))] \
        #[y(B: w @ (0, 0) = 0)] #[angle(C: v = 0)] #[guess({guess})]"
        ))
    };
    one_error(&held("w.x = 1"), &["`w.x` is held"]);
    one_error(&held("w.phi = 1"), &["`w.phi` is held"]);
    one_error(&held("v.x = 1"), &["`v.x` follows from the body that carries `v`"]);
    one_error(&held("ground.x = 1"), &["the ground does not move"]);
    one_error(&held("crank.x = 1, crank.x = 2"), &["guessed twice"]);
    assert!(errors(&held("w.y = 1, v.phi = 2, crank.x = l")).is_empty());
}

#[test]
fn nothing_is_held_and_carried() {
    one_error(
        &pendulum("#[body(v, origin = crank @ (0, 0), x = 1)] #[angle(C: v = 0)]"),
        &["`v` has its origin carried"],
    );
}

#[test]
fn everything_takes_part() {
    one_error("struct S;", &["`S` has no coordinates"]);
    one_error("#[body(b, x = 0, y = 0, phi = 0)] struct S;", &["everything of its body is held"]);
    one_error(&pendulum("#[bodies(wheel)]"), &["no joint or equation contains a coordinate of `wheel`"]);
    one_error(&pendulum("#[coordinates(u)] #[define(s = u)]"), &["no row mentions `u`"]);
    one_error(&pendulum("#[driver(B: l = t)]"), &["driver `B` contains no free coordinate"]);
    one_error(
        &pendulum("#[body(w, phi = 1)] #[x(C: w @ (0, 0) = 0)] #[angle(B: w = 1)]"),
        &[
            "angle `B` contains no free coordinate, because `w.phi` is held by `body` already; remove `B`, or do not hold it",
        ],
    );
    one_error(
        "#[body(crank, x = 0, y = 0)] #[revolute(O: ground @ (0, 0), crank @ (0, 0))] #[driver(d: crank.phi = t)] struct S;",
        &["because `crank.x` and `crank.y` are held by `body` already; remove `O`, or do not hold them"],
    );
    // Coordinates may be mentioned through a define, a named point and a held origin.
    assert!(
        errors(&pendulum(
            "#[bodies(a, b)] #[body(c, origin = b @ (0, 0), phi = 0)] #[coordinates(u)] #[point(p = a @ (1, 0))] \
         #[define(s = p.x + u)] #[driver(D: s = t)] #[x(E: c @ (1, 0) = 0)]"
        ))
        .is_empty()
    );
}

#[test]
fn a_body_without_joints_hides_no_other_error() {
    let with = |attribute: &str| {
        errors(&format!(
            "#[bodies(crank, wheel)] #[revolute(A: ground @ (0, 0), crank @ (0, 0))] {attribute} \
             struct Pendulum {{ #[param(0.2, unit = \"m\")] l: f64, #[param(1, unit = \"rad/s\")] omega: f64 }}"
        ))
    };
    let both = |attribute: &str, other: &str| {
        let found = with(attribute);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("no joint or equation contains a coordinate of `wheel`"), "{found:?}");
        assert!(found[1].contains(other), "{other:?} is not in {found:?}");
    };
    both("#[driver(drive: crank.phi = omega * t + l)]", "the units do not agree");
    both("#[revolute(B: ground @ (0, 0), crank @ (0, 0))]", "`B` repeats or contradicts");
    both("#[driver(drive: crank.phi = t)] #[driver(d: crank.phi = omega * t)]", "2 driving rows");
}

#[test]
fn conditions_hold_what_changes() {
    // The held origin of a body that turns is constant.
    let held = |condition: &str| {
        pendulum(&format!(
            "#[body(w, x = 1, y = 2)] #[body(v, x = t, y = 0)] #[angle(B: w = t)] #[angle(C: v = 0)] \
             #[point(hub = w @ (0, 0), rim = w @ (l, 0), gone = v @ (0, 0))] #[define(far = hub.x)] \
             #[unilateral(limit: {condition})]"
        ))
    };
    for still in ["hub.x > 0", "distance(hub, ground @ (0, 0)) > l", "far > 0", "w.y > 0", "gone.y > 0"] {
        one_error(&held(still), &["`limit` holds no coordinate, no input and no `t`"]);
    }
    for moving in ["rim.x > 0", "distance(rim, hub) > distance(gone, hub)", "far > t", "w.phi > 0", "gone.x > 0"] {
        assert!(errors(&held(moving)).is_empty(), "{moving}");
    }
}

#[test]
fn constants_have_values() {
    for (constant, why) in [
        ("sqrt(-1)", "`sqrt` takes 0 or a positive number, not -1"),
        ("asin(2)", "`asin` takes a number from -1 to 1, not 2"),
        ("acos(-1 - 1)", "`acos` takes a number from -1 to 1, not -2"),
        ("ln(0)", "`ln` takes a positive number, not 0"),
        ("ln(cos(pi))", "`ln` takes a positive number, not -1"),
        ("pow(0, -1)", "0 to the power of -1 divides by 0"),
        ("pow(-2, 0.5)", "-2 is negative, and its power with the exponent 0.5 is no real number"),
        ("exp(1000)", "the value of this is too large"),
        ("(1e300*1e300)", "the value of this is too large"),
        ("sqrt(-s)", "`sqrt` takes 0 or a positive number, not -4"),
    ] {
        let define = "#[define(s = 2 + 2)]";
        one_error(&pendulum(&format!("{define} #[driver(B: crank.phi = 3 + {constant}*t)]")), &[why]);
    }
    // The errors of one formula are all reported, and none twice.
    assert_eq!(errors(&pendulum("#[driver(B: crank.phi = sqrt(sqrt(-1) + l) + ln(0)*t)]")).len(), 2);
    for formula in ["sqrt(0)", "pow(0, 2)", "pow(-2, 3)", "asin(1)", "sqrt(l - 5)", "sqrt(t - 5)", "atan2(0, -1)"] {
        assert!(errors(&pendulum(&format!("#[driver(B: crank.phi = t + {formula})]"))).is_empty(), "{formula}");
    }
    // Defines that use one another are computed once each.
    let doubled: String = (1..80).map(|k| format!("#[define(c{k} = c{0} + c{0})] ", k - 1)).collect();
    assert!(
        errors(&pendulum(&format!("#[define(c0 = 1)] {doubled} #[driver(B: crank.phi = sqrt(c79)*t)]"))).is_empty()
    );
}
