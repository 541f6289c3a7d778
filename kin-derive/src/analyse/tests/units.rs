//! Tests that the units of all mechanisms in the repository agree, and of the units derived from them.

use super::tokens;
use crate::analyse::analyse;
use kin_core::units;

#[test]
fn units_of_the_repository_agree() {
    let (mut with_units, mut wrong) = (0, Vec::new());
    for found in crate::corpus::repository::mechanisms() {
        match analyse(found.args, found.item).1 {
            Ok(lowered) => with_units += usize::from(units::are_written(&lowered.mechanism)),
            Err(broken) => {
                let errors: Vec<_> = broken.error.into_iter().map(|error| error.to_string()).collect();
                if errors.iter().any(|error| error.contains("units") || error.contains("radii are lengths")) {
                    wrong.push(format!("{}: {errors:?}", found.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(with_units > 30, "{with_units} mechanisms with units");
}

/// The errors of a description.
fn errors(source: &str) -> Vec<String> {
    match analyse(tokens(""), tokens(source)).1 {
        Ok(_) => Vec::new(),
        Err(broken) => broken.error.into_iter().map(|error| error.to_string()).collect(),
    }
}

#[test]
fn units_that_differ_in_scale_are_named_with_what_to_do() {
    let source = "#[bodies(crank, rod)] #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
        #[revolute(A: crank @ (r, 0), rod @ (l, 0))] #[driver(drive: crank.phi = omega*t)] #[driver(b: rod.phi = t)]
        struct S { #[param(0.2, unit = \"m\")] r: f64, #[param(700, unit = \"mm\")] l: f64,
            #[param(60, unit = \"deg/s\")] omega: f64 }";
    let [length, angle] = &errors(source)[..] else { panic!("{:?}", errors(source)) };
    assert_eq!(
        length,
        "the units do not agree: this is mm, but m, the unit of `r`, is expected here; divided by 1000 it is m"
    );
    assert_eq!(
        angle,
        "the units do not agree: this is deg, but the other quantity is a number or rad; times pi/180 it is rad"
    );
}

/// The first length has a wrong unit: it is the one that is told, not those that agree with one another.
#[test]
fn one_wrong_unit_is_the_one_that_is_told() {
    let source = "#[bodies(crank, rod)] #[revolute(O: ground @ (a, b), crank @ (0, 0))]
        #[revolute(A: crank @ (r, 0), rod @ (l, b))] #[driver(drive: crank.phi = t)] #[driver(b: rod.phi = t)]
        struct S { #[param(200, unit = \"mm\")] a: f64, #[param(0.1, unit = \"m\")] b: f64,
            #[param(0.2, unit = \"m\")] r: f64, #[param(0.7, unit = \"m\")] l: f64 }";
    let [only] = &errors(source)[..] else { panic!("{:?}", errors(source)) };
    assert_eq!(
        "the units do not agree: this is mm, but m, the unit of `b`, is expected here; divided by 1000 it is m",
        only
    );
}

/// An energy is no mass, although J contains kg: couples in N·m beside lengths in mm are the couples of some unit of mass.
#[test]
fn a_unit_of_energy_is_no_unit_of_mass() {
    let energies = ["J", "kJ"].map(|unit| {
        format!(
            "#[bodies(crank)] #[revolute(O: ground @ (0, 0), crank @ (l, 0))] #[driver(drive: crank.phi = t)]
            #[torque(load: crank = m)] #[define(e = e0*crank.phi)]
            struct S {{ #[param(1, unit = \"mm\")] l: f64, #[param(1, unit = \"N*m\")] m: f64,
                #[param(1, unit = \"{unit}\")] e0: f64 }}"
        )
    });
    assert_eq!([const { Vec::<String>::new() }; 2], energies.map(|source| errors(&source)));
}

/// A ratio of lengths says nothing about the unit of positions.
#[test]
fn a_slope_is_no_length() {
    let source = "#[bodies(block)] #[translational(O: ground @ (0, 0), block @ (0, h), axis = (1, slope/1000))]
        #[driver(drive: block.x = v*t)]
        struct S { #[param(2, unit = \"mm/m\")] slope: f64, #[param(1, unit = \"m/s\")] v: f64, #[param(1)] h: f64 }";
    assert_eq!(Vec::<String>::new(), errors(source));
    assert_eq!(Some("m"), derived(source).length.as_deref());
}

/// A statement that is degenerate is so whatever its units are.
#[test]
fn units_do_not_hide_what_is_degenerate() {
    let source =
        "#[bodies(crank)] #[revolute(O: ground @ (0, 0), crank @ (l, 0))] #[driver(drive: crank.phi = w*t + 1/(2 - 2))]
        struct S { #[param(1, unit = \"m\")] l: f64, #[param(1, unit = \"rpm\")] w: f64 }";
    let [divisor, speed] = &errors(source)[..] else { panic!("{:?}", errors(source)) };
    assert!(divisor.contains("division by zero") && speed.contains("units do not agree"), "{divisor}, {speed}");
    // Nor does it hide units.
    let axis = "#[point_on_line(P: ground @ (0, 0), crank @ (0, 0), axis = (0, 0))] struct S";
    let [axis, again] = &errors(&source.replace("1/(2 - 2)", "1").replace("struct S", axis))[..] else { panic!() };
    assert!(axis.contains("no direction") && again == speed, "{axis}, {again}");
}

/// The units that are derived for the names of a description.
fn derived(source: &str) -> units::Units {
    match analyse(tokens(""), tokens(source)).1 {
        Ok(lowered) => units::derive(&lowered.mechanism),
        Err(broken) => panic!("{}", broken.error),
    }
}

#[test]
fn units_follow_from_expressions() {
    let found = derived(
        "#[body(crank, x = 0, y = 0)] #[coordinates(u, v, n)] #[input(feed, turn)] #[input(p, unit = \"Pa\")]
        #[define(area = l*crank.phi*l, speed = w*crank.phi*l, way = 2*crank.x + l, ratio = l/r, angle = crank.phi + 0.1)]
        #[define(force = crank.phi*k, unit = \"N\")]
        #[driver(a: crank.phi = turn)] #[constraint(b: u = l + 2*feed)] #[constraint(c: v = feed - l)]
        #[constraint(d: n = sin(t))]
        struct S { #[param(200, unit = \"mm\")] l: f64, #[param(3, unit = \"mm\")] r: f64, #[param(1)] k: f64,
            #[param(1, unit = \"1/s\")] w: f64 }",
    );
    assert_eq!((found.length.as_deref(), found.time.as_deref()), (Some("mm"), Some("s")));
    let named: Vec<String> = found.named.iter().map(|(name, unit)| format!("{name} {unit}")).collect();
    let expected =
        ["u mm", "v mm", "feed mm", "turn rad", "p Pa", "area mm²", "speed mm/s", "way mm", "angle rad", "force N"];
    assert_eq!(named, expected);
    let nothing = derived("#[coordinates(u)] #[driver(a: u = t)] struct S { l: f64 }");
    assert_eq!(nothing, units::Units::default());
}

/// The unit of a quantity times a factor of conversion is not known, nor is that of a number times an angle: it may be in
/// degrees, in turns or a travel.
#[test]
fn a_product_with_a_conversion_has_no_derived_unit() {
    let found = derived(
        "#[body(crank, x = 0, y = 0)] #[body(slider, y = 0, phi = 0)] #[coordinates(s, travel, lift)] #[input(u, w)]
        #[define(in_mm = slider.x*1000, speed = v*3600/1000, rpm = omega*60/(2*pi), share = slider.x/l*100)]
        #[define(degrees = crank.phi*180/pi, turns = omega*t/(2*pi), camber = -180/pi*crank.phi, part = 0.5*crank.phi)]
        #[define(twice = 2*slider.x, angle = -crank.phi, rate = 2*omega)]
        #[define(e = u - slider.x*1000, f = w - 2*crank.phi)]
        #[driver(a: crank.phi = omega*t)] #[driver(b: slider.x = l)]
        #[constraint(c: s = 0.05*crank.phi)] #[constraint(d: travel = slider.x*1000)]
        #[constraint(g: lift = slider.x*1000 + k)]
        struct S { #[param(0.7, unit = \"m\")] l: f64, #[param(3, unit = \"rad/s\")] omega: f64,
            #[param(10, unit = \"m/s\")] v: f64, #[param(10, unit = \"mm\")] k: f64 }",
    );
    let named: Vec<String> = found.named.iter().map(|(name, unit)| format!("{name} {unit}")).collect();
    assert_eq!(named, ["lift mm", "twice m", "angle rad", "rate rad/s"]);
}

/// A frequency in Hz times a time counts turns.
#[test]
fn turns_are_not_taken_for_radians() {
    let of = |formula: &str, define: &str| {
        errors(&format!(
            "#[bodies(crank)] #[revolute(O: ground @ (0, 0), crank @ (0, 0))] {define} #[driver(drive: {formula})]
            struct S {{ #[param(2, unit = \"Hz\")] f: f64, #[param(0.3, unit = \"rad\")] a: f64, #[param(1)] k: f64,
                #[param(3, unit = \"1/s\")] rate: f64 }}"
        ))
    };
    let said = "this is a number of turns, a frequency in Hz times a time, and an angle in rad is expected here; \
                times 2*pi it is rad";
    for wrong in
        ["crank.phi = f*t", "crank.phi = a + f*t", "crank.phi = a*sin(f*t)", "crank.phi = -2*f*t", "f*t = crank.phi"]
    {
        let found = of(wrong, "");
        assert!(matches!(&found[..], [only] if only == said), "{wrong}: {found:?}");
    }
    assert_eq!(vec![said], of("crank.phi = turned", "#[define(turned = f*t)]"));
    for right in [
        "crank.phi = 2*pi*f*t",
        "crank.phi = 2*pi*(f*t)",
        "crank.phi = 6.2832*f*t",
        "crank.phi = a*sin(2*pi*f*t + a)",
        "crank.phi = a*cos(t*f*2*pi)",
        "crank.phi = rate*t",
        "crank.phi = k*f*t",
        "crank.phi = a*exp(-f*t)",
        "crank.phi = a*(f/rate)",
    ] {
        assert_eq!(Vec::<String>::new(), of(right, ""), "{right}");
    }
    assert!(of("crank.phi = w*t", "#[define(w = 2*pi*f)]").is_empty());
}

/// A number has no unit, so that a number times a rate is no couple.
#[test]
fn a_load_that_is_a_number_times_a_rate_says_what_the_factor_is() {
    let of = |load: &str| {
        errors(&format!(
            "#[bodies(crank)] #[revolute(O: ground @ (0, 0), crank @ (0, 0))] #[driver(drive: crank.phi = t)] #[{load}]
            struct S {{ #[param(2, unit = \"mm\")] r: f64, #[param(3, unit = \"N*mm*s\")] c: f64 }}"
        ))
    };
    let damping = of("torque(friction: crank = -0.01*dot(crank.phi))");
    assert_eq!(
        damping,
        ["the units do not agree: this is 1/s, but a couple is expected here; a number has no unit: let a parameter \
          or a factor be a couple per angular speed"]
    );
    assert_eq!(Vec::<String>::new(), of("torque(friction: crank = -c*dot(crank.phi))"));
    assert_eq!(Vec::<String>::new(), of("torque(friction: crank = -c*0.01*dot(crank.phi))"));
}

/// A scalar coordinate or an input without a unit has one unit wherever it occurs.
#[test]
fn degrees_do_not_reach_a_sine_through_a_name_without_a_unit() {
    let of = |rows: &str| {
        errors(&format!(
            "#[coordinates(phi, psi, list[2])] #[input(turn)] {rows}
            struct S {{ #[param(30, unit = \"deg\")] g: f64, #[param(1, unit = \"m\")] l: f64, #[param(1)] k: f64 }}"
        ))
    };
    let row = "#[constraint(row: l*cos(phi) + l*cos(psi) = l*sin(list[0]) + l*sin(list[1]))]";
    let said =
        "the units do not agree: this is deg, but `phi` is a number or rad in another place; times pi/180 it is rad";
    for driver in ["phi = g", "-phi = g + 3", "g = phi"] {
        assert_eq!(vec![said], of(&format!("{row} #[driver(d: {driver})]")), "{driver}");
    }
    assert_eq!(vec![said], of(&format!("{row} #[driver(d: phi = 2)] #[guess(phi = g)]")));
    let said = "the units do not agree: `phi` is deg in another place, but a number or rad is expected here; \
                times pi/180 it is rad";
    assert_eq!(vec![said], of(&format!("#[driver(d: phi = g)] {row}")));
    let said = "the units do not agree: `turn` is deg in another place, but a number or rad is expected here; \
                times pi/180 it is rad";
    let through_input = "#[driver(d: phi = 2)] #[define(e = turn - g)]";
    assert_eq!(vec![said], of(&format!("{row} {through_input} #[driver(f: psi = sin(turn))]")));
    let said = "the units do not agree: this is deg, but `list[1]` is a number or rad in another place; \
                times pi/180 it is rad";
    assert_eq!(vec![said], of(&format!("{row} #[driver(d: list[1] = g)]")));
    let of_members = "#[constraint(a: list[0] = l)] #[constraint(b: list[1] = g)]";
    for right in [
        &format!("{row} #[driver(d: phi = g*pi/180)]"),
        "#[constraint(row: l*cos(phi*pi/180) = psi)] #[driver(d: phi = g)]",
        "#[constraint(row: l*cos(k*phi) = psi)] #[driver(d: phi = g)]",
        of_members,
    ] {
        let units: Vec<_> = of(right).into_iter().filter(|error| error.contains("units")).collect();
        assert_eq!(Vec::<String>::new(), units, "{right}");
    }
}

/// If no mass has a unit, the forces, couples, stiffnesses and dampings must agree with one another.
#[test]
fn forces_agree_where_no_mass_has_a_unit() {
    let of = |loads: &str, units: [&str; 3]| {
        let [f, k, tau] = units;
        errors(&format!(
            "#[body(crank, x = 0, y = 0)] #[driver(d: crank.phi = 0.3)] {loads}
            struct S {{ #[param(1, unit = \"m\")] l: f64, #[param(3, unit = \"GPa\")] modulus: f64,
                #[param(2, unit = \"{f}\")] f: f64, #[param(500, unit = \"{k}\")] k: f64,
                #[param(5, unit = \"{tau}\")] tau: f64 }}"
        ))
    };
    let force = "#[force(F: crank @ (l, 0), (0, f))]";
    let spring = "#[spring(S: ground @ (0, 0), crank @ (0, l), stiffness = k)]";
    let torque = "#[torque(T: crank = tau)]";
    let torsion = "#[torsion_spring(T: ground, crank, stiffness = tau)]";
    assert_eq!(
        of(&format!("{force} {spring}"), ["kN", "N/m", "N*m"]),
        ["the units do not agree: this is N/m, but N/mm is expected here; divided by 1000 it is N/mm"]
    );
    assert_eq!(
        of(&format!("{force} {torque}"), ["N", "N/m", "N*mm"]),
        ["the units do not agree: this is N·mm, but N·m is expected here; divided by 1000 it is N·m"]
    );
    // Two of three are in N.
    assert_eq!(
        of(&format!("{force} {spring} {torque}"), ["kN", "N/m", "N*m"]),
        ["the units do not agree: this is kN, but N is expected here; times 1000 it is N"]
    );
    let per_degree = "the units do not agree: this is N·m/deg, but N·m is expected here; times 180/pi it is N·m";
    assert_eq!(of(torsion, ["N", "N/m", "N*m/deg"]), [per_degree]);
    assert_eq!(of(&format!("{force} {torsion}"), ["N", "N/m", "N*m/deg"]), [per_degree]);
    for (loads, units) in [
        (format!("{force} {spring} {torque}"), ["N", "N/m", "N*m"]),
        (format!("{force} {spring} {torsion}"), ["kN", "N/mm", "kN*m/rad"]),
        ("#[torsion_spring(T: ground, crank, stiffness = tau*180/pi)]".to_owned(), ["kN", "N/m", "N*m/deg"]),
        ("#[force(F: crank @ (l, 0), (0, f))] #[torque(T: crank = tau/1000)]".to_owned(), ["N", "N/m", "N*mm"]),
    ] {
        assert_eq!(Vec::<String>::new(), of(&loads, units), "{loads}");
    }
}

/// A mechanism with angles and times in several units; `d` is its driver, `parts` are other attributes.
fn angles(driver: &str, parts: &str) -> Vec<String> {
    errors(&format!(
        "#[body(crank, x = 0, y = 0)] #[body(slider, y = 0, phi = 0)] #[driver(d: {driver})] #[driver(s: slider.x = l)] {parts}
        struct S {{ #[param(30, unit = \"deg\")] g: f64, #[param(2, unit = \"rev\")] turns: f64,
            #[param(2, unit = \"Hz\")] f: f64, #[param(2, unit = \"s\")] period: f64, #[param(1, unit = \"m\")] l: f64,
            #[param(0.3, unit = \"rad\")] a: f64, #[param(3)] k: f64 }}"
    ))
}

/// In `2*crank.phi` the number is a factor: the product is in rad, not in degrees or turns.
#[test]
fn a_multiple_of_an_angle_is_not_in_degrees() {
    let said = "the units do not agree: this is deg, but the other quantity is a number or rad; times pi/180 it is rad";
    for wrong in ["2*crank.phi = g", "crank.phi/2 = g + 3", "2*crank.phi + 3*a = g", "-2*crank.phi = g"] {
        assert_eq!(angles(wrong, ""), [said], "{wrong}");
    }
    assert_eq!(angles("crank.phi = t", "#[define(e = 2*crank.phi)] #[unilateral(end: e < g)]"), [said]);
    let said = "the units do not agree: this is a number or rad, but rev is expected here; divided by (2*pi) it is rev";
    assert_eq!(angles("crank.phi = t", "#[define(turned = 1*crank.phi, unit = \"rev\")]"), [said]);
    let gear = |rest: &str| {
        let gear = format!("#[body(wheel, x = 1, y = 0)] #[gear(G: crank, wheel, radii = {rest})]");
        angles("crank.phi = t", &gear)
    };
    assert_eq!(
        gear("(20, 30), offset = g"),
        ["the units do not agree: this is deg, but an angle in rad is expected here; times pi/180 it is rad"]
    );
    for right in ["(20, 30), offset = 20*a", "(20, 30), offset = l", "(0.2, 0.3), offset = 20*g*pi/180"] {
        assert_eq!(Vec::<String>::new(), gear(right), "{right}");
    }
    for right in [
        "2*crank.phi = a",
        "crank.phi*180/pi = g",
        "180/pi*crank.phi = g + 3",
        "57.3*crank.phi = g",
        "crank.phi/6.2832 = turns",
        "2*crank.phi = g*pi/180",
        "k*crank.phi = g",
        "crank.phi = 2*(turns*360)*pi/180",
        "2*crank.phi = l",
        "30*sin(crank.phi) = g",
        "crank.phi = 2*a*(l/l)",
    ] {
        assert_eq!(Vec::<String>::new(), angles(right, ""), "{right}");
    }
    assert_eq!(
        Vec::<String>::new(),
        angles("crank.phi = t", "#[define(e = 2*crank.phi)] #[define(h = 2*e*180/pi, unit = \"deg\")]")
    );
}

/// The order of the factors of a number of turns makes no difference.
#[test]
fn a_multiple_of_a_number_of_turns_is_no_angle() {
    let said = "this is a number of turns, a frequency in Hz times a time, and an angle in rad is expected here; \
                times 2*pi it is rad";
    for wrong in ["crank.phi = f*t*3", "crank.phi = a*sin(f*t*3)", "2*crank.phi = f*t*3", "crank.phi = -(f*t)/2"] {
        assert_eq!(angles(wrong, ""), [said], "{wrong}");
    }
    assert_eq!(angles("crank.phi = e", "#[define(e = f*t*3)]"), [said]);
    assert_eq!(angles("crank.phi = t", "#[define(e = f*t*3, unit = \"rad\")]"), [said]);
    for right in ["crank.phi = f*t*3*2*pi", "crank.phi = f*t*360/57.3"] {
        assert_eq!(Vec::<String>::new(), angles(right, ""), "{right}");
    }
    for right in ["turns < f*t*3 + k*crank.phi", "g < f*t*360 + k*crank.phi", "k*crank.phi < f*t*3", "slider.x < f*t*3"]
    {
        assert_eq!(Vec::<String>::new(), angles("crank.phi = t", &format!("#[unilateral(u: {right})]")), "{right}");
    }
    assert_eq!(Vec::<String>::new(), angles("crank.phi = t", "#[define(e = f*t*3, unit = \"1\")]"));
}

/// A number times a period is a period; a number times t may have any unit.
#[test]
fn a_multiple_of_a_time_is_a_time() {
    let distance =
        |length: &str| format!("#[distance(D: ground @ (0, 0), rod @ (0, 0), length = {length})] #[bodies(rod)]");
    assert_eq!(
        angles("crank.phi = t", &distance("2*period")),
        ["the units do not agree: this is s, but m is expected here"]
    );
    let units = |driver: &str| {
        let all = angles(driver, "");
        all.into_iter().filter(|error| error.contains("units")).collect::<Vec<_>>()
    };
    for right in [
        "crank.phi = 2*t",
        "crank.phi = 3*(t - period)",
        "crank.phi = 0.5*(t - period)*(t - period)",
        "crank.phi = 2*pi*t/period",
        "crank.phi = t/(2*period)",
        "crank.phi = sin(2*pi*(t - 2*period)/period)",
        "period + t = 2*period + 0*crank.phi*t",
    ] {
        assert_eq!(Vec::<String>::new(), units(right), "{right}");
    }
}
