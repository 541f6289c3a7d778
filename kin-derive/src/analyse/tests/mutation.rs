//! Whatever stands in the brackets, `analyse` answers: damaged descriptions neither panic nor pass unseen.

use super::tokens;
use crate::analyse::analyse;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

const SEED: &str = r#"
    #[bodies(crank, link[4])] #[coordinates(u, w[3])]
    #[body(slider, phi = 0, y = 0.1*t)] #[body(arm, origin = crank @ (l1, 0))]
    #[revolute(A: ground @ (0, 0), crank @ (-l1/2, 0))]
    #[translational(T: ground @ (0, 0), slider @ (0, 0), axis = (1, 0), angle = -pi/2)]
    #[revolute(N[i in 0..3]: link[i] @ (l[i], 0), link[i+1] @ (0, 0))]
    #[distance(D: tip, arm @ (0, 0), length = l1 + 0.1*t)]
    #[point(tip = slider @ (0, 0.1), p[i in 0..3] = link[i] @ (l[i], 0))]
    #[define(s = tip.x.sin() + pow(u, -1.0/3.0), r[i in 1..3] = w[i] * p[i].x)]
    #[constraint(c: s - distance(tip, p[2]) = r[1] - w[0]*w[2])]
    #[driver(drive: crank.phi = omega * t)] #[angle(an: arm = 0)] #[relative_angle(ra: crank, slider = l1)]
    #[guess(crank.phi = 0.9, link[i in 0..4].x = 1, w[0] = 2)]
    struct S { #[param(0.1, unit = "m")] l1: f64, l: [f64; 4], #[param] omega: f64 }"#;

/// A linear congruential generator: the same damage in every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n.max(1)
    }
}

fn count(stream: &TokenStream) -> usize {
    stream.clone().into_iter().map(|tree| 1 + inner(&tree).map_or(0, |inner| count(&inner))).sum()
}

fn inner(tree: &TokenTree) -> Option<TokenStream> {
    match tree {
        TokenTree::Group(group) => Some(group.stream()),
        _ => None,
    }
}

/// Damages the token `at`, counted through all groups.
fn damage(stream: TokenStream, at: &mut isize, dice: &mut Dice, stock: &[TokenTree]) -> TokenStream {
    let mut out: Vec<TokenTree> = Vec::new();
    for tree in stream {
        *at -= 1;
        if *at == -1 {
            let other = stock[dice.below(stock.len())].clone();
            match dice.below(6) {
                0 => {}
                1 => out.extend([tree.clone(), tree]),
                2 => out.push(other),
                3 => out.extend([other, tree]),
                4 => {
                    let last = out.pop();
                    out.push(tree);
                    out.extend(last);
                }
                _ => out.push(Group::new(Delimiter::None, tree.into()).into()),
            }
            continue;
        }
        out.push(match tree {
            TokenTree::Group(group) => Group::new(group.delimiter(), damage(group.stream(), at, dice, stock)).into(),
            leaf => leaf,
        });
    }
    out.into_iter().collect()
}

fn leaves(stream: TokenStream, out: &mut Vec<TokenTree>) {
    for tree in stream {
        if let Some(inner) = inner(&tree) {
            leaves(inner, out);
        }
        out.push(tree);
    }
}

#[test]
fn damaged_descriptions_get_an_answer() {
    let seed = tokens(SEED);
    let rounds = std::env::var("KIN_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(3_000);
    let mut stock = Vec::new();
    leaves(seed.clone(), &mut stock);
    leaves(
        tokens(
            "^ % == < .. ..= 1e999 -1 0 99999999999999999999 \"s\" 'c' b\"\" t pi ground {} [] () ; :: => r#fn _ self",
        ),
        &mut stock,
    );
    assert!(analyse(TokenStream::new(), seed.clone()).1.is_ok(), "{:?}", super::errors(SEED));
    let mut dice = Dice(1);
    let mut wrong = 0;
    for _ in 0..rounds {
        let mut damaged = seed.clone();
        for _ in 0..1 + dice.below(3) {
            let mut at = dice.below(count(&damaged)) as isize;
            damaged = damage(damaged, &mut at, &mut dice, &stock);
        }
        let args = if dice.below(20) == 0 { damaged.clone() } else { TokenStream::new() };
        let (_, analysed) = analyse(args.clone(), damaged.clone());
        let is_wrong = analysed.map_or(true, |lowered| crate::system(&lowered).is_err());
        wrong += usize::from(is_wrong);
        // What passes all gates expands; the rest has its errors.
        let expanded = crate::derive(args, damaged).to_string();
        assert_eq!(is_wrong, expanded.contains("compile_error"), "{expanded}");
    }
    assert!(wrong > rounds / 2);
}
