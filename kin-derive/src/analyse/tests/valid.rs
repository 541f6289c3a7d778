use super::{equation, errors, good, pendulum, tokens};
use crate::analyse::analyse;
use crate::lower::{FieldRole, MentionKind};
use kin_core::joints::{Belt, Constraint, Driver, Fixed, Gear, RackPinion, Revolute, RollingOnDisc, RollingOnLine};
use kin_core::mechanism::{BodyOrigin, BodyRef, Component, Formula, GuessTarget, Index, TypedOperands};
use quote::ToTokens;

const FOUR_BAR: &str = r#"
    /// The lecture's four-bar,
    /// joint by joint.
    ///
    /// More about it.
    #[bodies(crank, coupler, rocker)]
    #[derive(Clone)]
    #[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
    #[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
    #[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
    #[revolute(
        /// The pivot of the rocker
        D: rocker @ (l3/2, 0), ground @ (d1, d2),
    )]
    #[driver(drive: crank.phi = phi0 + omega * t)]
    #[point(tip = coupler @ (0, 0.1))]
    #[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
    #[serde(rename_all = "camelCase")]
    pub struct FourBar {
        /// Crank length
        #[param(0.1, unit = "m")] pub l1: f64,
        #[param(0.4, unit = "m")] pub l2: f64,
        #[param(40)] l3: f64,
        #[param(-pi/4)] d1: f64,
        d2: f64,
        #[param] phi0: f64,
        #[param(2.0*pi, unit = "rad/s")] #[serde(skip)] omega: f64,
    }
"#;

#[test]
fn the_four_bar_of_the_design_page() {
    let four_bar = good(FOUR_BAR);
    let m = &four_bar.mechanism;
    assert_eq!(m.name, "FourBar");
    let names: Vec<&str> = m.bodies.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["crank", "coupler", "rocker"]);
    let rows: Vec<String> = m.joints.iter().map(|j| format!("{} {}", j.operands.keyword(), j.name)).collect();
    assert_eq!(rows, ["revolute C", "revolute A", "revolute B", "revolute D", "driver drive"]);
    let Some(Revolute { p, q }) = &Revolute::of(&m.joints[1].operands) else { panic!() };
    assert!(matches!(p.body, BodyRef::Body { family: 0, index: Index { scale: 0, offset: 0 }, .. }));
    assert!(matches!(&q.x, Formula::Div(a, _, _) if matches!(&**a, Formula::Neg(_))));
    assert_eq!(q.y, Formula::Number(0.0));
    assert_eq!((m.points.len(), m.guesses.len()), (1, 2));
    assert!(matches!(m.guesses[1].target, GuessTarget::Pose(BodyRef::Body { family: 2, .. }, Component::Phi)));

    let defaults: Vec<Option<f64>> = m.parameters.iter().map(|p| p.default.as_ref().map(|d| d[0])).collect();
    let pi = std::f64::consts::PI;
    assert_eq!(defaults, [Some(0.1), Some(0.4), Some(40.0), Some(-pi / 4.0), None, None, Some(2.0 * pi)]);
    assert_eq!(m.parameters[0].unit.as_deref(), Some("m"));
    assert_eq!(m.parameters[0].doc, "Crank length");

    assert!(!four_bar.derives_default);
    assert_eq!(four_bar.docs.mechanism, "The lecture's four-bar, joint by joint.");
    assert_eq!(four_bar.docs.rows, [("D".to_owned(), "The pivot of the rocker".to_owned())]);
    assert_eq!(four_bar.fields.len(), 7);
    assert_eq!(four_bar.fields[3].role, FieldRole::Parameter(3));
}

#[test]
fn only_our_attributes_are_taken_off() {
    let item = good(FOUR_BAR).item;
    let attributes: Vec<String> = item.attrs.iter().map(|a| a.path().to_token_stream().to_string()).collect();
    assert_eq!(attributes, ["doc", "doc", "doc", "doc", "derive", "serde"]);
    let text = item.to_token_stream().to_string();
    assert!(!text.contains("param") && text.contains("skip") && text.contains("pub l1 : f64"), "{text}");
}

#[test]
fn every_name_is_mentioned() {
    let four_bar = good(FOUR_BAR);
    let count = |kind, name: &str| four_bar.mentions.iter().filter(|m| m.kind == kind && m.ident == name).count();
    assert_eq!(count(MentionKind::Body, "crank"), 4);
    assert_eq!(count(MentionKind::Body, "ground"), 0);
    assert_eq!(count(MentionKind::Parameter, "l1"), 2);
    assert_eq!(count(MentionKind::Parameter, "omega"), 1);
    assert_eq!(count(MentionKind::Point, "tip"), 1);
}

#[test]
fn origins_of_the_model_have_spans() {
    let four_bar = good(FOUR_BAR);
    let last = four_bar.mechanism.guesses.last().unwrap().origin.0 as usize;
    assert!(last < four_bar.spans.len());
}

#[test]
fn held_and_carried_bodies() {
    let m = good(
        "#[body(crank, x = 0, y = 0.5*t)] #[body(coupler, origin = crank @ (l, 0))] #[body(slider, phi = 0, x = l)] \
         #[body(plate, origin = tip)] #[point(tip = coupler @ (l, 0))] \
         #[revolute(A: tip, slider @ (0, 0))] #[angle(B: plate = 0)] struct S { l: f64 }",
    )
    .mechanism;
    assert!(matches!(&m.bodies[0].origin_at, BodyOrigin::Free { x: Some(_), y: Some(Formula::Mul(..)) }));
    let BodyOrigin::Carried(place) = &m.bodies[1].origin_at else { panic!() };
    assert!(matches!(place.body, BodyRef::Body { family: 0, .. }));
    assert!(matches!(&m.bodies[2].origin_at, BodyOrigin::Free { x: Some(_), y: None }));
    assert_eq!(m.bodies[2].phi, Some(Formula::Number(0.0)));
    let BodyOrigin::Carried(place) = &m.bodies[3].origin_at else { panic!() };
    assert!(matches!(place.body, BodyRef::Body { family: 1, .. }));
}

#[test]
fn gears_and_rolling_discs() {
    let m = good(
        "#[bodies(a, b, c)] #[coordinates(psi[2])] \
         #[gear(g: a, b, radii = (l, -2*l))] \
         #[gear(gc: a, b, carrier = c, offset = 0.1*t, radii = (l, 2),)] \
         #[belt(bt: a, b, radii = (20, 40), carrier = ground)] \
         #[rack_pinion(rp: c @ (0, 0), a @ (l, 0), pinion = b, axis = (1, l), radius = -l)] \
         #[rolling(rl: a @ (0, 0), b @ (0, 0), radius = l, axis = (0, 1), offset = t)] \
         #[rolling(rd[i in 0..2]: a @ (0, 0), b @ (0, 0), radii = (l, 1), along = psi[1 - i])] \
         struct S { l: f64 }",
    )
    .mechanism;
    let rows: Vec<&str> = m.joints.iter().map(|j| j.operands.keyword()).collect();
    assert_eq!(rows, ["gear", "gear", "belt", "rack_pinion", "rolling", "rolling"]);
    let Some(Gear { radii, carrier, offset, .. }) = &Gear::of(&m.joints[0].operands) else { panic!() };
    assert!(carrier.is_ground() && *offset == Formula::ZERO);
    assert!(matches!(radii.i.value, Formula::Parameter(_)) && matches!(radii.j.value, Formula::Mul(..)));
    let Some(Gear { carrier, offset, .. }) = &Gear::of(&m.joints[1].operands) else { panic!() };
    assert!(matches!(carrier, BodyRef::Body { family: 2, .. }) && matches!(offset, Formula::Mul(..)));
    assert!(matches!(Belt::of(&m.joints[2].operands), Some(Belt { carrier: BodyRef::Ground(_), .. })));
    let Some(RackPinion { pinion, radius, .. }) = &RackPinion::of(&m.joints[3].operands) else { panic!() };
    assert!(matches!(pinion, BodyRef::Body { family: 1, .. }) && matches!(radius.value, Formula::Neg(_)));
    assert!(matches!(RollingOnLine::of(&m.joints[4].operands), Some(RollingOnLine { offset: Formula::Time, .. })));
    let Some(RollingOnDisc { along, .. }) = &RollingOnDisc::of(&m.joints[5].operands) else { panic!() };
    assert_eq!(along.index, Index { scale: -1, offset: 1 });
}

#[test]
fn every_row_of_the_vocabulary() {
    let m = good(
        "#[bodies(a, b)] #[coordinates(u)] \
         #[revolute(r: a @ (0, 0), b @ (0, 0))] \
         #[translational(tr: a @ (0, 0), b @ (0, 0), angle = pi/2, axis = (1, l))] \
         #[fixed(f: a @ (0, 0), b @ (0, 0))] \
         #[point_on_line(pl: a @ (0, 0), b @ (0, 0), axis = (0, 1), offset = 0.1*t,)] \
         #[distance(d: a @ (0, 0), b @ (0, 0), length = 1 + 0.1*t)] \
         #[x(x: a @ (1, 0) = 0.1)] #[y(y: P = t)] #[angle(an: b = l)] #[relative_angle(ra: a, b = 0)] \
         #[constraint(c: a.x * u = P.y)] #[driver(dr: distance(P, b @ (1, 1)) = 2 + sin(t))] \
         #[define(s = P.x - l)] #[driver(dr2: s = t)] #[point(P = a @ (l, 0))] \
         struct S { l: f64 }",
    )
    .mechanism;
    let rows: Vec<&str> = m.joints.iter().map(|j| j.operands.keyword()).collect();
    assert_eq!(rows.len(), 12);
    assert_eq!(&rows[..5], ["revolute", "translational", "fixed", "point_on_line", "distance"]);
    assert_eq!(&rows[5..10], ["x", "y", "angle", "relative_angle", "constraint"]);
    let Some(Fixed { angle, .. }) = &Fixed::of(&m.joints[2].operands) else { panic!() };
    assert_eq!(*angle, Formula::ZERO);
    let Some(Driver { left, .. }) = &Driver::of(&m.joints[10].operands) else { panic!() };
    assert!(matches!(left, Formula::Distance(p, _) if matches!(p.x, Formula::Parameter(_))));
}

/// The formula of the left side of an equation in `u`, `v`, `l1`, `l2`.
fn formula(expr: &str) -> Formula {
    let m = good(&equation(expr)).mechanism;
    let Some(Constraint { left, .. }) = &Constraint::of(&m.joints[0].operands) else { panic!() };
    left.clone()
}

fn shape(f: &Formula) -> String {
    match f {
        Formula::Number(v) => format!("{v:?}"),
        Formula::Pi => "pi".into(),
        Formula::Time => "t".into(),
        Formula::Index(at) => format!("{}*i+{}", at.scale, at.offset),
        Formula::Parameter(m) => ["l1", "l2"][m.family].into(),
        Formula::Scalar(m) => ["u", "v"][m.family].into(),
        Formula::Neg(a) => format!("-{}", shape(a)),
        Formula::Add(a, b) => format!("({} + {})", shape(a), shape(b)),
        Formula::Sub(a, b) => format!("({} - {})", shape(a), shape(b)),
        Formula::Mul(a, b) => format!("({} * {})", shape(a), shape(b)),
        Formula::Div(a, b, _) => format!("({} / {})", shape(a), shape(b)),
        Formula::Pow(a, n) => format!("{}^{n:?}", shape(a)),
        Formula::Call(f, a) => format!("{}({})", f.name(), shape(a)),
        Formula::Atan2(y, x) => format!("atan2({}, {})", shape(y), shape(x)),
        other => format!("{other:?}"),
    }
}

#[test]
fn expressions_bind_as_in_rust() {
    for (source, expected) in [
        ("l1*cos(u) + l2*v.cos()", "((l1 * cos(u)) + (l2 * cos(v)))"),
        ("u - v - l1", "((u - v) - l1)"),
        ("u / v * l1", "((u / v) * l1)"),
        ("-u.sin()", "-sin(u)"),
        ("-u * v", "(-u * v)"),
        ("u*-v", "(u * -v)"),
        ("--u", "--u"),
        ("-(u + v)", "-(u + v)"),
        ("u.powi(2) + pow(v, -1.0/2)", "(u^2.0 + v^-0.5)"),
        ("u.powf(1.0/3.0).sqrt()", "sqrt(u^0.3333333333333333)"),
        ("pow(u, pi)", "u^3.141592653589793"),
        ("2.sin() + 1e-3*u + 1_000 + 2f64 + 0x10 + 1.", "(((((sin(2.0) + (0.001 * u)) + 1000.0) + 2.0) + 16.0) + 1.0)"),
        ("u.atan2(v) + atan2(l1, l2,) + pi + t", "(((atan2(u, v) + atan2(l1, l2)) + pi) + t)"),
        ("(u + v).abs().ln().exp()", "exp(ln(abs((u + v))))"),
        ("r#u + 1", "(u + 1.0)"),
    ] {
        assert_eq!(shape(&formula(source)), expected, "{source}");
    }
}

/// True if `name` is part of a divisor.
fn divides(f: &Formula, name: &str) -> bool {
    match f {
        Formula::Div(a, b, _) => divides(a, name) || shape(b).contains(name),
        Formula::Mul(a, b) => divides(a, name) || divides(b, name),
        _ => false,
    }
}

/// Factors of a long product, which may be 0, stay factors when the product is balanced.
#[test]
fn no_factor_becomes_a_divisor() {
    for count in [1, 15, 16, 17, 40] {
        let others = " * l1".repeat(count);
        for source in
            [format!("2 / u * v{others}"), format!("2{others} / u * v"), format!("2{others} / u / u / u * v * v")]
        {
            let product = formula(&source);
            assert!(divides(&product, "u") && !divides(&product, "v") && !divides(&product, "l1"), "{source}");
        }
    }
}

#[test]
fn fragments_of_macro_rules_bind_as_the_user_sees_them() {
    use proc_macro2::{Delimiter, Group};
    let sum = Group::new(Delimiter::None, tokens("u + l1"));
    let name = Group::new(Delimiter::None, tokens("v"));
    let source = quote::quote! {
        #[coordinates(#name, u)] #[constraint(c: #sum * #name = 0)] struct S { l1: f64 }
    };
    let (_, result) = analyse(tokens(""), source);
    let m = result.map_err(super::messages).unwrap_or_else(|e| panic!("{e:?}")).mechanism;
    let Some(Constraint { left, .. }) = &Constraint::of(&m.joints[0].operands) else { panic!() };
    assert!(matches!(left, Formula::Mul(a, _) if matches!(&**a, Formula::Add(..))));
}

#[test]
fn names_that_collide_with_nothing() {
    let m = good(
        "#[bodies(gamma, modes, e, default)] #[coordinates(jacobian, q, r#type)] \
         #[constraint(gamma: r#type * q = jacobian + gamma.x + modes.y + e.phi + default.x)] \
         struct r#struct { phi: f64, x: f64, i: f64 }",
    )
    .mechanism;
    assert_eq!((m.name.as_str(), m.scalars[2].name.as_str()), ("struct", "type"));
    assert_eq!(m.bodies.len(), 4);
}

#[test]
fn flags_and_lifetimes() {
    let source = "#[coordinates(u)] #[driver(d: u = t)] struct S<'a, const N: usize = 3>;";
    let (_, result) = analyse(tokens("cross_check, check_units,"), tokens(source));
    let flags = result.ok().unwrap().flags;
    assert!(flags.cross_check && flags.check_units && !flags.allow_redundant);
    good("#[coordinates(u)] #[driver(d: u = t)] struct S {}");
}

#[test]
fn the_struct_comes_back_from_a_wrong_description() {
    let (item, result) = analyse(tokens(""), tokens(&pendulum("#[x(B: crank @ = 3)] #[derive(Clone)]")));
    assert!(result.is_err());
    assert_eq!(item.unwrap().attrs.len(), 1);
}

#[test]
fn editors_complete_names() {
    let source = pendulum("#[revolute(B: crraCompletionMarker @ (0, 0), ground @ (0, 0))]");
    let lowered = good(&source);
    assert!(lowered.mentions.iter().any(|m| m.kind == MentionKind::Body && m.ident == "crraCompletionMarker"));
    assert_eq!(lowered.mechanism.bodies.len(), 1);
    let lowered = good(&pendulum("#[driver(B: crank.phi = intellijRulezz)]"));
    assert!(lowered.mentions.iter().any(|m| m.kind == MentionKind::Parameter && m.ident == "intellijRulezz"));
    assert!(errors(&pendulum("#[driver(B: crank.raCompletionMarker = t)]")).is_empty());
}
