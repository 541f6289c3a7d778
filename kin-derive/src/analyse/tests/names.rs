use super::{errors, good, one_error, pendulum};

#[test]
fn unknown_names_come_with_a_suggestion() {
    one_error(&pendulum("#[angle(B: crnk = 0)]"), &["no body named `crnk`; did you mean `crank`?"]);
    one_error(&pendulum("#[angle(B: grund = 0)]"), &["did you mean `ground`?"]);
    one_error(&pendulum("#[angle(B: wheel = 0)]"), &["no body named `wheel`; there are `crank`"]);
    one_error(&pendulum("#[driver(B: crank.phi = omga*t)]"), &["did you mean `omega`?"]);
    one_error(&pendulum("#[driver(B: crnk.phi = t)]"), &["no body or point named `crnk`; did you mean `crank`?"]);
    one_error(&pendulum("#[x(B: tip = 0)]"), &["no point named `tip`; none is declared; points are declared with"]);
    one_error(&pendulum("#[x(B: omga @ (0, 0) = 0)]"), &["no body named `omga`; there is a parameter `omega`"]);
}

#[test]
fn names_of_another_kind_are_called_by_it() {
    one_error(&pendulum("#[angle(B: l = 0)]"), &["`l` is a parameter; a body is needed here"]);
    one_error(&pendulum("#[x(B: l = 0)]"), &["`l` is a parameter; a point is needed here"]);
    one_error(&pendulum("#[driver(B: crank = t)]"), &["`crank` is a body; its coordinates are `crank.x`"]);
    one_error(&pendulum("#[point(p = crank @ (0, 0))] #[driver(B: p = t)]"), &["`p` is a point; its coordinates"]);
    one_error(&pendulum("#[driver(B: l.x = t)]"), &["`l` is a parameter and has no components"]);
    one_error(&pendulum("#[driver(B: crank.theta = t)]"), &["a body has `x`, `y` and `phi`"]);
    one_error(&pendulum("#[point(p = crank @ (0, 0))] #[driver(B: p.phi = t)]"), &["a point has `x` and `y`"]);
    one_error(&pendulum("#[guess(crank.theta = 1)]"), &["a body has `x`, `y` and `phi`"]);
}

#[test]
fn one_namespace_for_all_but_rows() {
    one_error(&pendulum("#[bodies(crank)]"), &["there is a body `crank` already"]);
    one_error(&pendulum("#[body(crank, x = 0)]"), &["there is a body `crank` already"]);
    one_error(&pendulum("#[point(l = crank @ (0, 0))]"), &["`l` is a point already, and here a parameter"]);
    one_error(&pendulum("#[x(A: crank @ (0, 0) = 0)]"), &["the name `A` is already used by a `revolute`"]);
    assert!(errors(&pendulum("#[x(crank: crank @ (0, 0) = 0)] #[point(A = crank @ (0, 0))]")).is_empty());
    one_error(&pendulum("#[define(r#crank = 1)]"), &["`crank` is a body already, and here a define"]);
}

#[test]
fn words_of_the_language_are_taken() {
    one_error("#[coordinates(u)] #[driver(d: u = t)] struct S { t: f64 }", &["`t` is time"]);
    one_error(&pendulum("#[point(ground = crank @ (0, 0))]"), &["`ground` is the fixed frame"]);
    one_error(&pendulum("#[define(sin = 1)]"), &["`sin` is a function"]);
    one_error(&pendulum("#[bodies(loop)]"), &["written `r#loop`"]);
}

#[test]
fn mistakes_of_declarations_do_not_cascade() {
    one_error(
        "#[bodies(crank, 3x, rocker)] #[revolute(A: crank @ (0, 0), x3 @ (0, 0))] struct S;",
        &["expected a name"],
    );
    one_error(&pendulum("#[point(p = crank @ (0))] #[x(B: p = 0)]"), &["second component"]);
    // A name whose declaration has an error is known, so that only other unknown names are reported.
    assert_eq!(errors(&pendulum("#[point(p = crank @ (0 0))] #[x(B: q = 0)] #[y(C: p = 0)]")).len(), 2);
    one_error(&pendulum("#[define(s = crank.z)] #[driver(B: s = 0)]"), &["a body has"]);
    one_error(&pendulum("#[body(w[n], x = 0)] #[angle(B: w[2] = 0)]"), &["length"]);
    one_error(&pendulum("#[function(3f)] #[driver(B: crank.phi = f(t))]"), &["expected a name"]);
    one_error(&pendulum("#[function(f)] #[driver(B: crank.phi = f(t) + f[2](t))]"), &["no field named `f`"]);
    one_error(&pendulum("#[body(w, x = ^)] #[angle(B: w = 0)]"), &["powers"]);
}

#[test]
fn only_what_makes_sense_stands_in_its_place() {
    one_error(
        &pendulum("#[x(B: crank @ (t, 0) = 0)]"),
        &["`t` is time; a body-fixed point takes numbers and parameters only"],
    );
    one_error(&pendulum("#[x(B: crank @ (crank.x, 0) = 0)]"), &["`crank.x` is a coordinate; a body-fixed point"]);
    one_error(&pendulum("#[x(B: crank @ (0, 0) = crank.y)]"), &["the right-hand side of `x` takes"]);
    one_error(
        &pendulum("#[distance(B: crank @ (0, 0), ground @ (0, 0), length = crank.phi)]"),
        &["`length` takes numbers, parameters, `t` and inputs only"],
    );
    one_error(&pendulum("#[translational(B: crank @ (0, 0), ground @ (0, 0), axis = (t, 1))]"), &["an axis takes"]);
    one_error(&pendulum("#[guess(crank.phi = t)]"), &["a guess takes"]);
    one_error(&pendulum("#[body(w, x = crank.x)] #[angle(B: w = 0)]"), &["a held coordinate takes"]);
    // Through a define, too, which may contain what a held coordinate takes.
    let through = "#[define(d = crank.x)] #[body(w, x = d)] #[angle(B: w = 0)]";
    one_error(&pendulum(through), &["`d` contains coordinates of bodies; a held coordinate takes"]);
    good("#[coordinates(s)] #[define(d = 2*s + t)] #[body(w, x = 0, y = 0, phi = d)] #[driver(c: s = t)] struct S;");
    one_error(
        &pendulum("#[define(s = crank.x)] #[x(B: crank @ (s, 0) = 0)]"),
        &["the define `s` contains coordinates"],
    );
    one_error(
        &pendulum("#[define(s = 2*t)] #[define(r = s + 1)] #[x(B: crank @ (r, 0) = 0)]"),
        &["the define `r` contains `t` or inputs"],
    );
    one_error(
        &pendulum("#[point(p = crank @ (0, 0))] #[x(B: crank @ (0, 0) = distance(p, ground @ (0, 0)))]"),
        &["this distance contains coordinates"],
    );
    assert!(errors(&pendulum("#[define(s = 2*l)] #[x(B: crank @ (s, 0) = s*t)]")).is_empty());
    assert!(
        errors(&pendulum("#[point(p = ground @ (l, 0))] #[x(B: crank @ (p.x, 0) = distance(p, ground @ (0, 0)))]"))
            .is_empty()
    );
}

#[test]
fn declarations_may_follow_their_uses() {
    assert!(
        errors(&pendulum(
            "#[driver(B: s + p.x = t)] #[define(s = r + p.y)] #[define(r = l)] #[point(p = crank @ (r, 0))]"
        ))
        .is_empty()
    );
}

#[test]
fn circles_are_named() {
    one_error(
        &pendulum("#[define(a = b + 1)] #[define(b = c)] #[define(c = a)]"),
        &["`a` uses `b`, `b` uses `c`, `c` uses `a`"],
    );
    one_error(&pendulum("#[define(a = a + 1)] #[driver(B: a = t)]"), &["`a` uses itself"]);
    one_error(&pendulum("#[point(p = crank @ (s, 0))] #[define(s = p.x)]"), &["`p` uses `s`, `s` uses `p`"]);
    one_error(
        "#[body(a, origin = b @ (0, 0))] #[body(b, origin = a @ (1, 0))] #[angle(N: a = t)] #[angle(M: b = t)] struct S;",
        &["`a` is carried by `b`, `b` is carried by `a`"],
    );
    one_error("#[body(a, origin = a @ (0, 0))] #[angle(N: a = t)] struct S;", &["`a` carries itself"]);
}

/// The units of the other statements are checked, too, and so is whether these are degenerate.
#[test]
fn a_wrong_unit_is_reported_beside_a_wrong_name() {
    let of = |revolute: &str, driver: &str, rest: &str| {
        errors(&format!(
            "#[bodies(crank)] #[revolute(O: ground @ (0, 0), crank @ ({revolute}, 0))] #[driver(drive: {driver})] {rest}
            struct S {{ #[param(1, unit = \"m\")] l: f64, #[param(1, unit = \"kg\")] m: f64 }}"
        ))
    };
    let name = "no body or point named `crnk`; did you mean `crank`?";
    let unit = "the units do not agree: this is kg, but the other quantity is m";
    assert_eq!(of("l + m", "crnk.phi = 3*t", ""), [name, unit]);
    assert_eq!(of("l + m", "crank.phi = 3*t", ""), [unit]);
    assert_eq!(of("l", "crnk.phi = 3*t", ""), [name]);
    // A define that cannot be read has no unit.
    let misspelt = of("l + reach", "crank.phi = t", "#[define(reach = crnk.x, unit = \"m\")]");
    assert_eq!(misspelt, [name]);
}
