//! The material of inputs: small descriptions, every form of the vocabulary, and single words.

use super::Dice;
use super::damage::{Tree, trees};
use crate::parse::vocabulary;
use proc_macro2::TokenStream;

/// Declarations and rows that are compatible with the examples of the vocabulary.
const PARTS: &str = r#"
    #[bodies(crank, coupler, rocker, slider, plate, link[3])]
    #[bodies(crank, cam, follower, sleigh, wheel, slider, rack, pinion, sun, planet, carrier)]
    #[bodies(crank, arm, wheel)]
    #[bodies(link[2])]
    #[coordinates(phi1, phi2, u, w[3])]
    #[coordinates(u)]
    #[input(feed)]
    #[input(boom_length, stick_length)]
    #[function(f)]
    #[body(rocker, x = 0, y = 0)]
    #[body(arm, origin = crank @ (l1, 0))]
    #[body(sun, x = 0.1*t, phi = -pi/2)]
    #[body(leg[i in 0..3], origin = ground @ (l[i], 0))]
    #[point(tip = coupler @ (0, l1))]
    #[point(p[i in 0..3] = link[i] @ (l[i], 0), base = ground @ (0, 0))]
    #[define(stroke = slider.x - d1)]
    #[define(s = tip.x.sin() + pow(u, -1.0/3.0), r[i in 1..3] = w[i] * p[i].x)]
    #[guess(coupler.phi = 0.9, link[i in 0..3].x = 1, w[0] = 2)]
    #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    #[revolute(N[i in 0..2]: link[i] @ (l[i], 0), link[i+1] @ (0, 0))]
    #[revolute(B: tip, rocker @ (0, 0))]
    #[translational(T: ground @ (0, 0), slider @ (0, 0), axis = (1, 2), angle = -pi/2)]
    #[distance(D: tip, arm @ (0, 0), length = l1 + 0.1*t)]
    #[angle(a[i in 0..3]: link[i] = i * t)]
    #[on_curve(n[i in 0..3]: crank @ (0, 0), link[i] @ (0, 0), parametric(w[i]) = (l1*cos(w[i]), f(w[i])), roller = -l1)]
    #[on_curve(m: crank @ (0, 0), tip, implicit(X, Y) = X*X + Y.powi(2) - l1)]
    #[driver(drive: crank.phi = omega * t)]
    #[driver(lift: distance(ground @ (0, 0), tip) = l1 + feed)]
    #[driver(turn[i in 0..3]: w[i] = l[i] * exp(-t))]
    #[constraint(c: atan2(u, l1) - ln(2 + sqrt(abs(u))) = stroke / (1 - omega))]
    #[constraint(loop_x: l1*cos(phi1) + l2*cos(phi2) = d1)]
    #[unilateral(stop: slider.x < l1 + feed)]
    #[unilateral(clear[i in 0..3]: w[i] > -l[i])]
    #[unilateral(reach: distance(tip, ground @ (0, 0)) > l1)]
    #[on_curve(I: cam @ (0, 0), tip, implicit(X, Y) = X*X/4 + pow(Y, 2) - l1*l1)]
    #[on_curve(P: cam @ (0, l1), wheel @ (0, 0), parametric(u) = (u, 0.1*u.powi(2)), roller = 0.2)]
    #[on_curve(R: ground @ (0, 0), wheel @ (0, 0), polar(theta) = f(theta), roller = r)]
    #[speed(V: wheel @ (0, 0), angle = feed, value = f(t))]
    #[nonholonomic(H[i in 0..3]: dot(link[i].phi) * l1 - dot(p[i].x) = i*t)]
    #[constraint(data: u = f(2*t) + f(crank.phi))]
    #[derive(Clone)]
    #[cfg_attr(all(), derive(Debug))]
    #[doc = "A paragraph."]
"#;

/// Valid mechanisms.
const WHOLE: [&str; 12] = [
    "#[bodies(arm)] #[revolute(O: ground @ (0, 0), arm @ (-l1, 0))] #[driver(d: arm.phi = omega*t)] \
     struct S { #[param(0.5, unit = \"m\")] l1: f64, #[param(2)] omega: f64 }",
    "#[coordinates(phi1, phi2)] #[constraint(x: l1*cos(phi1) + l2*cos(phi2) = 1)] #[driver(d: phi1 = t)] \
     pub struct Loop<T> { l1: T, #[param(0.3)] l2: T }",
    "#[body(arm, x = 0, y = 0)] #[body(rod, origin = arm @ (l1, 0))] #[define(e = rod.x*u)] #[coordinates(u)] \
     #[driver(d: arm.phi = t)] #[relative_angle(r: arm, rod = sin(t))] #[constraint(c: u = e - arm.phi.cos())] \
     struct S { l1: f64 }",
    "#[bodies(link[2])] #[revolute(r: ground @ (0, 0), link[0] @ (0, 0))] #[angle(a[i in 0..2]: link[i] = i*t)] \
     #[revolute(n[i in 0..1]: link[i] @ (l[i], 0), link[i+1] @ (0, 0))] #[point(tip = link[1] @ (l[1], 0))] \
     #[guess(link[i in 0..2].phi = 1)] struct Chain { #[param([0.5, 1])] l: [f64; 2] }",
    "#[bodies(r, s)] #[translational(a: ground @ (0, 0), r @ (0, 1), axis = (1, 0))] #[x(b: r @ (0, 0) = 0.1*t)] \
     #[fixed(c: r @ (l1, 0), s @ (0, 0), angle = pi/4)] struct S { #[param([1, 2], unit = \"mm\")] l: [f32; 2], l1: f64 }",
    "#[bodies(b)] #[point_on_line(p: ground @ (0, 0), b @ (0, 0), axis = (1, l1), offset = 0.1)] #[angle(a: b = 0)] \
     #[distance(e: ground @ (3, 0), b @ (0, 0), length = 2 + 0.1*t)] struct S<'a, const N: usize> { l1: f64 }",
    "#[coordinates(u, v)] #[input(feed)] #[driver(a: u = feed)] #[driver(b: v = pow(u, 2) + t.powi(3) - 1/u)] struct S;",
    "#[coordinates(r#type)] #[driver(a: r#type = exp(-t) + atan2(t, 2) + abs(ln(2 + t)))] struct r#struct {}",
    "#[bodies(cam, follower)] #[revolute(O: ground @ (0, 0), cam @ (0, 0))] #[driver(d: cam.phi = t)] #[angle(a: follower = 0)] \
     #[x(g: follower @ (0, 0) = l1)] #[on_curve(c: cam @ (0, 0), follower @ (0, 0), polar(theta) = 1 + 0.2*cos(theta))] \
     #[unilateral(low: follower.y > 0)] struct Cam { l1: f64 }",
    "#[bodies(sleigh)] #[knife_edge(k: sleigh @ (l1, 0), angle = 0)] #[speed(s: sleigh @ (l1, 0), angle = 0, value = v)] \
     #[nonholonomic(n: dot(sleigh.phi) = f(t))] #[function(f)] struct Sleigh<F> { l1: f64, v: f64, f: F }",
    "#[bodies(cam, b)] #[revolute(O: ground @ (0, 0), cam @ (0, 0))] #[driver(d: cam.phi = t)] #[angle(a: b = 0)] #[x(g: b @ (0, 0) = 0)] \
     #[flat_follower(c: cam @ (0, 0), b @ (0, 0), axis = (1, 0), support(theta) = 1 + 0.1*cos(2*theta))] struct S;",
    "#[bodies(b)] #[point(p = b @ (1, 0))] #[y(h: p = 0)] #[x(g: p = t)] #[driver(d: b.phi = distance(p, b @ (0, 0)))] \
     struct S {}",
];

const STRUCT: &str = r#"pub(crate) struct FourBar {
    /// A length.
    #[param(0.1, unit = "m")] l1: f64, #[param(0.4)] l2: f64, l3: f32, d1: f64, d2: f64,
    #[param([1, 2, 3], unit = "rad/s")] l: [f64; 3], #[param] omega: f64, f: Table, ra: f64, rb: f64,
    r: f64, e: f64, R: f64, v: f64, phi0: f64,
}"#;

const FLAGS: [&str; 6] =
    ["cross_check", "allow_redundant", "check_units", "check_units, allow_redundant", "chek_units", "cross_check = 1"];

const WORDS: &str = r#"
    ^ % == < > >= .. ..= ! & && | ? : :: ; => -> ~ $ # @ , . - + * / = 'a 'c' b"" "s" "m" "rad/s" () [] {} (0, 0) [0] [i]
    [i in 0..3] r#fn r#type fn _ self Self super crate struct enum where for if match loop let mut pub dyn impl as in
    true false i j t pi ground x y phi X Y theta u w p q e default gamma jacobian model modes dot rad deg f64 f32 T N
    axis angle offset length radii radius carrier origin value unit polar implicit parametric support roller along psi
    sin cos tan asin acos atan atan2 sqrt exp ln abs pow powi powf signum distance crank coupler rocker slider plate link arm
    rod b leg tip base l l1 l2 l3 d1 d2 omega phi1 phi2 v feed stroke S f param cfg derive Default doc allow raCompletionMarker
"#;

const NUMBERS: &str = "0 1 2 3 -1 1e999 1e308 1e-320 5e-324 0.0 0.1 1e3 17 40 10001 65536 4294967296 18446744073709551616 \
    340282366920938463463374607431768211456 9223372036854775807 2147483647 2147483648 0x10 0b1 1f32 1u8 1_000 2.5 1.5e-7 \
    0x7fffffffffffffff 1e5 300 7i64 0o7 1e+2";

/// The token trees from which inputs are composed.
pub(super) struct Corpus {
    /// Attributes, including the number sign.
    parts: Vec<Vec<Tree>>,
    whole: Vec<Vec<Tree>>,
    structs: Vec<Tree>,
    pub(super) flags: Vec<Vec<Tree>>,
    pub(super) words: Vec<Tree>,
    pub(super) numbers: Vec<Tree>,
}

impl Corpus {
    /// Parses the texts above and the vocabulary of the language.
    pub(super) fn new() -> Self {
        let examples: String = vocabulary().iter().filter_map(|(_, example)| *example).collect();
        let attributes = |source: &str| {
            let all = trees(source);
            all.chunks(2).map(<[Tree]>::to_vec).collect::<Vec<_>>()
        };
        let mut parts = attributes(PARTS);
        // Each form of the language is as likely as each of the other parts.
        parts.extend(attributes(&examples));
        let mut words = trees(WORDS);
        words.extend(vocabulary().iter().flat_map(|(word, _)| trees(word)));
        Self {
            parts,
            whole: WHOLE.iter().map(|source| trees(source)).collect(),
            structs: trees(STRUCT),
            flags: FLAGS.iter().map(|source| trees(source)).collect(),
            words,
            numbers: trees(NUMBERS),
        }
    }

    /// A valid mechanism, a valid mechanism with additional parts, or random parts with a struct.
    pub(super) fn description(&self, dice: &mut Dice) -> Vec<Tree> {
        let extra = match dice.below(4) {
            0 | 1 => 0,
            2 => 1 + dice.below(2),
            _ => 3 + dice.below(8),
        };
        let mut item: Vec<Tree> = (0..extra).flat_map(|_| dice.of_these(&self.parts).clone()).collect();
        if extra < 3 {
            item.extend(dice.of_these(&self.whole).iter().cloned());
        } else {
            item.splice(0..0, self.parts[dice.below(6)].clone());
            item.extend(self.structs.iter().cloned());
        }
        item
    }

    /// A random subtree of a random part or mechanism, possibly a single token.
    pub(super) fn any(&self, dice: &mut Dice) -> Tree {
        let list = if dice.below(2) == 0 { &self.parts } else { &self.whole };
        let mut list = dice.of_these(list);
        loop {
            match dice.of_these(list) {
                Tree::Group(_, inner) if !inner.is_empty() && dice.below(3) > 0 => list = inner,
                found => return found.clone(),
            }
        }
    }
}

#[test]
fn whole_mechanisms_are_right() {
    for source in WHOLE {
        let expanded = crate::derive(TokenStream::new(), source.parse().unwrap());
        let errors = expanded.to_string();
        assert!(!errors.contains("compile_error"), "{source}\n{}", &errors[..errors.len().min(600)]);
    }
}
