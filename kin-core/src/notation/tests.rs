use super::{FormulaTree, Name, Notation};

fn all(text: &str) -> [String; 2] {
    let formula = FormulaTree::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    [Notation::Unicode, Notation::Latex].map(|notation| formula.write(notation))
}

#[test]
fn names_become_symbols() {
    for (written, unicode, latex) in [
        ("crank.phi", "φ_crank", r"\varphi_{\mathrm{crank}}"),
        ("crank.phi_dot", "φ̇_crank", r"\dot{\varphi}_{\mathrm{crank}}"),
        ("link[3].x_ddot", "ẍ_link₃", r"\ddot{x}_{\mathrm{link},3}"),
        ("l1", "l₁", "l_{1}"),
        ("l[2]", "l₂", "l_{2}"),
        ("phi0", "φ₀", r"\varphi_{0}"),
        ("omega", "ω", r"\omega"),
        ("stroke", "stroke", r"\mathrm{stroke}"),
        ("d_max", "d_max", r"d_{\mathrm{max}}"),
        ("boom_length", "boom_length", r"\mathrm{boom\_length}"),
        ("t", "t", "t"),
        ("φ", "φ", r"\varphi"),
        ("ω_max", "ω_max", r"\omega_{\mathrm{max}}"),
        ("Δs", "Δs", r"\mathrm{{\Delta}s}"),
        ("crank_ω.x", "x_crank_ω", r"x_{\mathrm{crank\_{\omega}}}"),
    ] {
        let name = Name::new(written);
        assert_eq!(name.write(Notation::Unicode), unicode, "{written}");
        assert_eq!(name.write(Notation::Latex), latex, "{written}");
    }
}

#[test]
fn brackets_stand_where_they_must() {
    for (text, unicode, latex) in [
        ("a - (b - c)", "a − (b − c)", r"a - \left(b - c\right)"),
        ("(a - b) - c", "a − b − c", "a - b - c"),
        ("-(a + b)*c", "−(a + b) c", r"-\left(a + b\right)\,c"),
        ("a*(b/c)", "a b/c", r"a\,\frac{b}{c}"),
        ("(a + b)/(c*d)", "(a + b)/(c d)", r"\frac{a + b}{c\,d}"),
        ("cos(phi)*a", "(cos φ) a", r"\left(\cos\varphi\right)\,a"),
        ("a*cos(phi)", "a cos φ", r"a\,\cos\varphi"),
        ("sin(a + b)^2", "(sin(a + b))²", r"\left(\sin\left(a + b\right)\right)^{2}"),
        ("x_dot^2", "ẋ²", r"\dot{x}^{2}"),
        ("a^-1", "a⁻¹", "a^{-1}"),
        ("sqrt(a*b)", "√(a b)", r"\sqrt{a\,b}"),
        ("f''(u)", "f′′(u)", r"\operatorname{f}''\left(u\right)"),
        ("-a*-b", "a b", r"a\,b"),
        ("(0.1 + 0.2)^1.5", "(0.1 + 0.2)^1.5", r"\left(0.1 + 0.2\right)^{1.5}"),
        ("0.30000000000000004^1.5", "0.30000000000000004^1.5", r"\left(3.0000000000000004\cdot 10^{-1}\right)^{1.5}"),
        ("asin(a)*b", "asin(a) b", r"\left(\arcsin a\right)\,b"),
        ("a*f(t)*cos(phi)", "a f(t) cos φ", r"a\,\operatorname{f}\left(t\right)\,\cos\varphi"),
    ] {
        assert_eq!(all(text), [unicode, latex], "{text}");
    }
}

#[test]
fn tidied_formulas_lose_brackets_and_keep_their_values() {
    for (text, unicode, latex) in [
        ("-(a + b) - (c - d)", "−a − b − c + d", "-a - b - c + d"),
        ("cos(phi)*(a - b)*2", "2 (a − b) cos φ", r"2\,\left(a - b\right)\,\cos\varphi"),
        ("x_dot*l1*x_dot", "ẋ² l₁", r"\dot{x}^{2}\,l_{1}"),
        ("sin(a)*cos(b)*c", "c sin a cos b", r"c\,\sin a\,\cos b"),
        ("sin(a)*sin(a)", "(sin a)²", r"\left(\sin a\right)^{2}"),
        ("(-a)*(-b)/(-(c))", "−(a b)/c", r"-\frac{a\,b}{c}"),
        ("2*2*a", "4 a", r"4\,a"),
        ("0.5*(2*a)", "a", "a"),
        ("0.5*l1", "l₁/2", r"\frac{l_{1}}{2}"),
        ("-0.5*l1*sin(crank.phi)", "−(l₁/2) sin φ_crank", r"-\frac{l_{1}}{2}\,\sin\varphi_{\mathrm{crank}}"),
        ("0.75*a*x_dot", "3 (a/4) ẋ", r"3\,\frac{a}{4}\,\dot{x}"),
        ("0.25*cos(phi_dot)*crank.x", "0.25 x_crank cos φ̇", r"0.25\,x_{\mathrm{crank}}\,\cos\dot{\varphi}"),
        ("0.7*l1", "0.7 l₁", r"0.7\,l_{1}"),
        ("0.1*0.2*a", "0.1 0.2 a", r"0.1\,0.2\,a"),
        ("0.5*a*b + c + 0.5*a*b", "a b + c", r"a\,b + c"),
        ("a - a + a", "2 a − a", r"2\,a - a"),
        ("a/b*(c + d)/e*f", "(a f (c + d))/(b e)", r"\frac{a\,f\,\left(c + d\right)}{b\,e}"),
        ("6.283185307179586*a/60", "(2 π a)/60", r"\frac{2\,\pi\,a}{60}"),
        ("0.017453292519943295*a", "(π a)/180", r"\frac{\pi\,a}{180}"),
        ("-(-(a - b))", "a − b", "a - b"),
        ("a*(b*c)*a^2", "a³ b c", r"a^{3}\,b\,c"),
    ] {
        let parsed = FormulaTree::parse(text).expect("a formula");
        let tidied = parsed.clone().tidied();
        assert_eq!([Notation::Unicode, Notation::Latex].map(|n| tidied.write(n)), [unicode, latex], "{text}");
        assert_eq!(tidied, tidied.clone().tidied(), "{text}");
        let of = |name: &Name| match name.written.as_str() {
            "pi" => std::f64::consts::PI,
            other => 0.3 + other.bytes().map(f64::from).sum::<f64>() / 97.0,
        };
        assert!((value(&parsed, &of) - value(&tidied, &of)).abs() < 1e-12, "{text}");
    }
}

#[test]
fn long_sums_are_broken_before_their_signs() {
    let formula = FormulaTree::parse("a*b - c/d + sin(phi) - e").expect("a formula");
    for notation in [Notation::Unicode, Notation::Latex, Notation::MathMl] {
        let [one, two] = [usize::MAX, 12].map(|width| formula.lines(notation, width));
        assert_eq!((one.len(), two.len()), (1, 2));
        let whole = formula.write(notation);
        let inner = whole.strip_prefix("<mrow>").and_then(|text| text.strip_suffix("</mrow>")).unwrap_or(&whole);
        assert_eq!(two.concat(), inner);
    }
    assert_eq!(formula.lines(Notation::Unicode, 12), ["a b − c/d", " + sin φ − e"]);
    let nested = FormulaTree::parse("-2*((a + b + c)*(d - e) + f)").expect("a formula");
    assert_eq!(nested.lines(Notation::Unicode, 12), ["−2 ((a + b", " + c) (d − e)", " + f)"]);
    assert_eq!(nested.lines(Notation::Latex, 40), [nested.write(Notation::Latex)]);
}

/// The argument of a supplied function is in brackets, because l f t would be a product.
#[test]
fn only_functions_of_the_language_have_no_brackets() {
    let mathml = |text: &str| FormulaTree::parse(text).expect("a formula").write(Notation::MathMl);
    for (text, opens) in
        [("l*f(t)*cos(phi)", 1), ("f'(t)", 1), ("f(t)*l", 1), ("l*sin(t)*exp(phi)", 0), ("sin(t)*l", 1)]
    {
        assert_eq!(mathml(text).matches("<mo>(</mo>").count(), opens, "{text}");
    }
}

#[test]
fn a_factor_of_1_has_no_place_beside_a_number_of_many_digits() {
    let formula = FormulaTree::parse("0.011111111111111112*1*a").expect("a formula").tidied();
    assert_eq!(formula.write(Notation::Unicode), "0.011111111111111112 a");
}

#[test]
fn rounding_errors_of_decimal_numbers_are_not_shown() {
    for (text, shown) in [
        ("0.04000000000000001*a", "0.04 a"),
        ("0.30000000000000004 - 2.9999999999999996*a", "0.3 − 3 a"),
        ("5000000000000001*a", "5000000000000001 a"),
        ("0.3333333333333333*a", "0.3333333333333333 a"),
        ("0.1234567890123 + 1.000000000001*a", "0.1234567890123 + 1.000000000001 a"),
        ("0.9999999999999999*a", "a"),
    ] {
        let formula = FormulaTree::parse(text).expect("a formula").tidied();
        assert_eq!(formula.write(Notation::Unicode), shown, "{text}");
    }
}

#[test]
fn names_may_have_marks_above_their_letters() {
    for (text, unicode) in [("x̄*φ̂.phi_dot - 2", "x̄ φ̇_φ̂ − 2"), ("℘[2]", "℘₂")] {
        assert_eq!(all(text)[0], unicode);
    }
}

/// A factor behind a slash would seem to be below it, also if it is a sum that is broken into lines.
#[test]
fn a_fraction_before_a_broken_sum_is_in_brackets() {
    let formula = FormulaTree::parse("l1/2*(sin(phi) + cos(psi) + exp(theta))").expect("a formula").tidied();
    let [short, long] = [10, 1000].map(|width| formula.lines(Notation::Unicode, width).concat());
    assert_eq!((short.as_str(), long.as_str()), (long.as_str(), "(l₁/2) (sin φ + cos ψ + exp(θ))"));
}

#[test]
fn exponents_stand_above_indices() {
    let formula = FormulaTree::parse("crank.phi_dot^2").expect("a formula");
    let mathml = formula.write(Notation::MathMl);
    assert!(mathml.starts_with("<msubsup><mover") && mathml.ends_with("<mn>2</mn></msubsup>"), "{mathml}");
}

#[test]
fn what_is_no_formula_is_refused_where_it_ends_to_be_one() {
    for (text, at) in [("a +", 3), ("a b", 2), ("(a", 2), ("f(a", 3), ("a…", 1), ("", 0)] {
        assert_eq!(FormulaTree::parse(text).map_err(|error| error.at), Err(at), "{text}");
    }
    let deep = "(".repeat(100_000);
    assert!(FormulaTree::parse(&deep).is_err());
}

#[test]
fn formulas_have_values() {
    let formula = FormulaTree::parse("2*a^2 - b/4 + sin(b)*abs(-a)").expect("a formula");
    let found = value(&formula, &|name| if name.written == "a" { 3.0 } else { 8.0 });
    assert_eq!(found, 18.0 - 2.0 + 8.0_f64.sin() * 3.0);
}

/// The value of a formula for given values of its names.
fn value(formula: &FormulaTree, symbol: &dyn Fn(&Name) -> f64) -> f64 {
    let of = |formula: &FormulaTree| value(formula, symbol);
    match formula {
        FormulaTree::Number(value) => *value,
        FormulaTree::Name(name) => symbol(name),
        FormulaTree::Minus(a) => -of(a),
        FormulaTree::Sum(terms) => terms.iter().map(|(minus, term)| if *minus { -of(term) } else { of(term) }).sum(),
        FormulaTree::Product(factors) => factors.iter().map(of).product(),
        FormulaTree::Quotient(a, b) => of(a) / of(b),
        FormulaTree::Power(a, n) => of(a).powf(*n),
        FormulaTree::Call(name, _, arguments) => {
            match (name.as_str(), arguments.iter().map(of).collect::<Vec<_>>().as_slice()) {
                ("sin", [x]) => x.sin(),
                ("cos", [x]) => x.cos(),
                ("sqrt", [x]) => x.sqrt(),
                ("abs", [x]) => x.abs(),
                ("sign", [x]) => x.signum(),
                ("atan2", [y, x]) => y.atan2(*x),
                _ => panic!("no function `{name}` in the cases"),
            }
        }
    }
}
