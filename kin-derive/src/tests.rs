//! Snapshots of expansions, formatted for readers. Run `cargo insta review` after a change.

use proc_macro2::TokenStream;
use quote::quote;

/// The formatted expansion.
fn expansion(args: TokenStream, item: TokenStream) -> String {
    let tokens = crate::derive(args, item);
    let file = syn::parse2(tokens.clone()).unwrap_or_else(|error| panic!("{error} in {tokens}"));
    prettyplease::unparse(&file)
}

#[test]
fn slider_on_an_inclined_guide() {
    insta::assert_snapshot!(expansion(
        quote! {},
        quote! {
            /// A crank with a sliding rod.
            #[bodies(crank, rod)]
            #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
            #[translational(slide: crank @ (r, 0), rod @ (0, 0), axis = (0, 1))]
            #[driver(turn: crank.phi = 2.0 * t)]
            #[point(tip = rod @ (0.1, 0))]
            #[define(reach = distance(tip, ground @ (0, 0)))]
            #[guess(rod.y = r)]
            pub struct Slider {
                /// Radius
                #[param(0.2, unit = "m")]
                pub r: f64,
            }
        },
    ));
}

/// Both angles of a dyad are computed in one call, which costs little more than one of them.
#[test]
fn the_two_angles_of_a_dyad_are_taken_at_once() {
    let code = expansion(
        quote! {},
        quote! {
            #[bodies(crank, coupler, rocker)]
            #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
            #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
            #[revolute(B: coupler @ (0.4, 0), rocker @ (0, 0))]
            #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
            #[driver(drive: crank.phi = t)]
            struct FourBar;
        },
    );
    let calls: Vec<&str> = code.split("atan2_all([").skip(1).filter_map(|rest| rest.split("])").next()).collect();
    assert!(matches!(calls[..], [vectors] if vectors.matches('(').count() == 2), "{calls:?}");
}

#[test]
fn the_sines_and_cosines_of_a_family_are_taken_at_once() {
    let code = expansion(
        quote! {},
        quote! {
            #[bodies(link[40])]
            #[revolute(pin[i in 0..40]: ground @ (i, 0), link[i] @ (a[i], 0))]
            #[driver(drive[i in 0..40]: link[i].phi = t)]
            struct Fan {
                a: [f64; 40],
            }
        },
    );
    let kernel = code.split("fn everything").nth(1).and_then(|rest| rest.split("\n    fn ").next()).unwrap_or_default();
    let calls: Vec<&str> = kernel.split("sin_cos_in_place(").skip(1).collect();
    assert!(calls.len() == 1 && calls[0].contains("[0..40]") && !kernel.contains("sin_cos_all"), "{kernel}");
}

#[test]
fn the_rows_of_a_member_are_one_loop() {
    let code = expansion(
        quote! {},
        quote! {
            #[bodies(crank[30], coupler[30], rocker[30])]
            #[revolute(C[i in 0..30]: ground @ (0, 0), crank[i] @ (-l[i]/2, 0))]
            #[revolute(A[i in 0..30]: crank[i] @ (l[i]/2, 0), coupler[i] @ (-0.2, 0))]
            #[revolute(B[i in 0..30]: coupler[i] @ (0.2, 0), rocker[i] @ (-0.15, 0))]
            #[revolute(D[i in 0..30]: rocker[i] @ (0.15, 0), ground @ (0.4, 0.1))]
            #[gear(mesh[i in 1..30]: rocker[i - 1], crank[i], radii = (1, 1))]
            #[driver(drive: crank[0].phi = t)]
            struct Chain {
                l: [f64; 30],
            }
        },
    );
    let kernel = code.split("fn everything").nth(1).and_then(|rest| rest.split("\n    fn ").next()).unwrap_or_default();
    // Three lists of angles are adjacent in one array, so that one call takes the sines and cosines of all of them.
    // One more loop covers all but the first member; no other array connects the loops.
    let loops: Vec<&str> = kernel.matches("for __k in 0..30").chain(kernel.matches("for __k in 0..29")).collect();
    assert_eq!(loops.len(), 4, "{kernel}");
    assert!(kernel.contains("let mut __a1") && !kernel.contains("let mut __a2"), "{kernel}");
    assert_eq!(kernel.matches("sin_cos_in_place(&mut __a1[0..90], &mut __a0[0..90])").count(), 1, "{kernel}");
}

#[test]
fn literals_are_short_and_say_the_number() {
    for value in [1e-300, -2.5e-7, 1e-4, 0.1, -3.0, 9e15, 1.5e16, f64::MAX, f64::MIN_POSITIVE, 5e-324, 0.0] {
        let written = crate::expand::literal(value).to_string().replace(' ', "");
        assert_eq!(written.strip_suffix("f64").and_then(|digits| digits.parse().ok()), Some(value), "{written}");
        assert!(written.len() < 30, "{written}");
    }
}

#[test]
fn a_follower_with_supplied_functions() {
    insta::assert_snapshot!(expansion(
        quote! {},
        quote! {
            #[function(lift, law)]
            #[coordinates(y)]
            #[driver(rise: y = scale * lift(law[1](t)) + law[0](y))]
            struct Follower<F> {
                law: [F; 2],
                scale: f64,
                lift: Box<dyn ScalarFunction>,
            }
        },
    ));
}

#[test]
fn a_family_with_an_array_of_parameters() {
    insta::assert_snapshot!(expansion(
        quote! {},
        quote! {
            #[bodies(link[2])]
            #[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
            #[revolute(pin[i in 0..1]: link[i] @ (l[i], 0), link[i + 1] @ (0, 0))]
            #[driver(turn[i in 0..2]: link[i].phi = t)]
            struct Chain {
                #[param([0.5, 0.25])]
                l: [f64; 2],
            }
        },
    ));
}

#[test]
fn names_that_collide_with_everything() {
    insta::assert_snapshot!(expansion(
        quote! { cross_check },
        quote! {
            #[coordinates(gamma, default, q, r#type)]
            #[constraint(e: gamma + default = q)]
            #[driver(phi: gamma = t)]
            #[driver(jacobian: r#type = 2.0 * t)]
            #[driver(w: q = t * t)]
            struct Names;
        },
    ));
}

#[test]
fn mistakes_leave_the_struct_and_an_empty_mechanism() {
    insta::assert_snapshot!(expansion(
        quote! {},
        quote! {
            #[bodies(crank)]
            #[revolute(C: ground @ (0, 0), crnk @ (r, 0))]
            #[driver(drive: crank.theta = t)]
            struct Wrong {
                #[param(1.0)]
                r: f64,
            }
        },
    ));
}

#[test]
fn the_same_description_gives_the_same_tokens() {
    let describe = || {
        quote! {
            #[bodies(a, b, c)]
            #[revolute(A: a @ (l, 0), b @ (0, m))]
            #[distance(B: b @ (l, m), c @ (m, l), length = 1)]
            #[driver(drive: distance(ground @ (0, 0), a @ (0, 0)) = 1 + t)]
            struct Same { #[param(1.0)] l: f64, #[param(2.0)] m: f64 }
        }
    };
    let first = crate::derive(quote! {}, describe()).to_string();
    for _ in 0..5 {
        assert_eq!(first, crate::derive(quote! {}, describe()).to_string());
    }
}

/// Statements are grouped in blocks of at most 500, which return only the values that later blocks need.
#[test]
fn long_programs_are_nested() {
    let rows = (0..60_usize).map(|k| {
        let (a, b) = (quote::format_ident!("c{k}"), quote::format_ident!("c{}", (k + 1) % 60));
        let row = quote::format_ident!("row{k}");
        // The rows have no regular order, so that they cannot become a loop.
        let irregular = match (k * k * 7919 / 13) % 3 {
            0 => quote! { sin(#a) * exp(#b) },
            1 => quote! { cos(#a + t) * #b },
            _ => quote! { sqrt(2 + #b * #b) },
        };
        quote! { #[constraint(#row: #irregular + sin(#a) + #a * #b * #b + #a / (2 + #b * #b) = t)] }
    });
    let names = (0..60_usize).map(|k| quote::format_ident!("c{k}"));
    let text = expansion(
        quote! {},
        quote! {
            #[coordinates(#(#names),*)]
            #(#rows)*
            struct Long;
        },
    );
    assert!(!text.contains("compile_error"), "{text}");
    let file: syn::File = syn::parse_str(&text).unwrap();
    let mut longest = Longest::default();
    syn::visit::visit_file(&mut longest, &file);
    assert!(longest.lets > 100 && longest.lets <= 500, "{}", longest.lets);
    assert!(longest.nested > 0);
}

/// The largest number of `let`s in a block, and the number of blocks that return values.
#[derive(Default)]
struct Longest {
    lets: usize,
    nested: usize,
}

impl<'ast> syn::visit::Visit<'ast> for Longest {
    fn visit_block(&mut self, block: &'ast syn::Block) {
        let lets = block.stmts.iter().filter(|s| matches!(s, syn::Stmt::Local(_))).count();
        self.lets = self.lets.max(lets);
        self.nested += block.stmts.iter().filter(|s| quote!(#s).to_string().starts_with("let [__v")).count();
        syn::visit::visit_block(self, block);
    }
}

/// Every stage of the macro accepts a sum of thousands of terms, because no recursion depends on its length.
#[test]
fn a_sum_of_thousands_of_terms_is_expanded() {
    let long = |count: usize, term: &str| -> TokenStream {
        let terms: String = (1..=count).map(|k| format!("+ {}", term.replace('k', &k.to_string()))).collect();
        let factors: String = (1..=count / 10).map(|k| format!("* (u + {k}) ")).collect();
        let item = format!(
            "#[coordinates(u, v)] #[constraint(long: v {terms} = 0)] #[driver(drive: u = t)] \
             #[define(much = 1 {factors})] struct Long;"
        );
        item.parse().unwrap()
    };
    for tokens in [long(500, "sin(k * u) / k * v "), long(5000, "k * u * v ")] {
        let code = crate::derive(TokenStream::new(), tokens).to_string();
        assert!(!code.contains("compile_error") && code.contains("Mechanism"), "{}", &code[..500]);
    }
    let tokens = long(500, "sin(k * u) / k * v ");
    let sheet = crate::documentation::text(quote! { () #tokens });
    assert!(sheet.contains("long") && sheet.contains("drive"), "{sheet}");
}

/// A handle is an array; where the members of a family are not counted from 0, its documentation says so.
#[test]
fn handles_say_from_where_their_members_are_counted() {
    let code = expansion(
        quote! {},
        quote! {
            #[bodies(link[3])]
            #[revolute(pin[i in 0..3]: ground @ (i, 0), link[i] @ (0, 0))]
            #[driver(drive[i in 0..3]: link[i].phi = t)]
            /// The tips.
            #[point(p[i in 1..3] = link[i] @ (i, 0))]
            #[define(s[i in 0..3] = link[i].phi)]
            struct Fan;
        },
    );
    let said = "counted from 0: the first is `p[1]` of the description, the last `p[2]`.";
    assert!(code.contains(said) && code.matches("counted from 0").count() == 1, "{code}");
}
