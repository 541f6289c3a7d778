//! Tests of the equations in the documentation of the struct.

use super::text;
use crate::analyse::{analyse, derive_equations};
use crate::corpus::repository::{Found, mechanisms};
use kin_core::sheet::{Rows, Sheet};
use proc_macro2::TokenStream;
use quote::quote;

fn documented(item: TokenStream) -> String {
    text(quote! { () #item })
}

/// The sheet of a correct description.
fn sheet(item: TokenStream) -> Sheet {
    let Ok(lowered) = analyse(TokenStream::new(), item).1 else { panic!("a description with errors") };
    let (system, structure) = derive_equations(&lowered).expect("correct rows");
    let plan = kin_core::plan::plan_with_formulas(&system, structure.rank);
    Sheet::of_system(&lowered.mechanism, &system, &plan)
}

fn matrices(item: TokenStream) -> Sheet {
    Sheet { rows: Rows::Together, ..sheet(item) }
}

/// Φ has no rows of velocity level; what such a row is at rest is 0 if nothing moves it.
#[test]
fn the_rows_of_every_matrix_have_their_own_names() {
    let text = matrices(quote! {
        #[bodies(w)]
        #[knife_edge(K: w @ (0, 0))]
        #[speed(V: w @ (0, 0), value = 2)]
        #[angle(W: w = t)]
        struct Skate;
    })
    .text();
    for line in ["Φ = [ φ_w − t ]  W\n", "Φ_t = ⎡  0 ⎤  K\n", "⎢ −2 ⎥  V\n", "⎣ −1 ⎦  W\n"] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let velocities = matrices(quote! {
        #[coordinates(u)]
        #[nonholonomic(V: dot(u) = 2)]
        struct Moved;
    });
    assert!(!velocities.text().contains("Φ =") && !velocities.latex().contains(r"\Phi &="), "{}", velocities.text());
}

#[test]
fn names_that_would_be_one_symbol_are_shown_as_they_are_written() {
    let sheet = sheet(quote! {
        #[body(crank, x = 0, y = 0)]
        #[coordinates(u, u_dot)]
        #[nonholonomic(slip: dot(u) = dot(crank.phi) + l2*dot(u_dot))]
        #[constraint(turn: crank.phi = phi_crank + l1*t - l_1*t + l[1]*t + l2*t)]
        #[constraint(second: u_dot = l2)]
        struct Names { phi_crank: f64, l1: f64, l_1: f64, l: [f64; 2], l2: f64 }
    });
    let text = sheet.text();
    let rows = [
        "Φ turn = crank.phi − phi_crank − l1 t + l_1 t − l[1] t − l₂ t = 0",
        "Φ second = u_dot − l₂ = 0",
        "η slip = u̇ − crank.phi_dot − l₂ u_dot_dot = 0",
        "∂η/∂u̇ = 1",
        "∂η/∂u_dot_dot = −l₂",
    ];
    let spaces = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for row in rows {
        assert!(spaces(&text).contains(row), "{row}\n{text}");
    }
    let latex = sheet.latex();
    assert!(latex.contains(r"\mathrm{l[1]}\,t") && latex.contains(r"\mathrm{l\_1}\,t"), "{latex}");
    assert!(latex.contains(r"\dot{u}") && latex.contains(r"\mathrm{u\_dot}"), "{latex}");
}

#[test]
fn a_slider_crank() {
    insta::assert_snapshot!(documented(quote! {
        #[bodies(crank, rod)]
        #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
        #[translational(slide: crank @ (r, 0), rod @ (0, 0), axis = (0, 1))]
        #[driver(turn: crank.phi = omega * t)]
        #[distance(L: rod @ (0, 0), ground @ (r, 0), length = 0.2)]
        struct Slider { r: f64, omega: f64 }
    }));
}

#[test]
fn a_pendulum_with_a_spring() {
    insta::assert_snapshot!(documented(quote! {
        #[bodies(rod)]
        #[revolute(O: ground @ (0, 0), rod @ (0, 0))]
        #[driver(swing: rod.phi = 0.3 * sin(t))]
        #[gravity(0, -9.81)]
        #[mass(rod @ (l/2, 0), mass = m, inertia = m*l*l/12)]
        #[spring(S: ground @ (0, h), rod @ (l, 0), stiffness = k, free_length = l, damping = c)]
        struct Pendulum { l: f64, m: f64, k: f64, c: f64, h: f64 }
    }));
}

/// What is written before the name of a joint stands at its equations.
#[test]
fn a_joint_is_described_in_its_words() {
    let docs = documented(quote! {
        #[bodies(crank)]
        #[revolute(/** The pivot, l < 1 */ O: ground @ (0, 0), crank @ (0, 0))]
        #[driver(drive: crank.phi = t)]
        struct Crank;
    });
    assert!(docs.contains("</h4>\n<p>The pivot, l &lt; 1</p>\n"), "{docs}");
}

/// Markdown ends an HTML block at a blank line, and treats four spaces as code.
#[test]
fn every_mechanism_is_well_formed_html_that_markdown_leaves_alone() {
    let mut seen = 0;
    for Found { name, args, item } in mechanisms() {
        let docs = text(quote! { (#args) #item });
        if docs.is_empty() {
            continue;
        }
        seen += 1;
        let sections = docs.split("\n\n# ").skip(1).map(|section| section.split_once("\n\n").unwrap_or_default());
        for (heading, block) in sections {
            assert!(matches!(heading, "Equations" | "Solution" | "Forces"), "{name}: {heading}");
            assert!(block.starts_with('<') && block.trim_end().ends_with("</div>"), "{name}");
            assert!(block.lines().all(|line| !line.trim().is_empty() && !line.starts_with("    ")), "{name}");
            well_formed(&name, block);
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Checks that a block is well-formed XML with formulas, whose elements have the required number of children.
fn well_formed(name: &str, block: &str) {
    let tree = format!("<doc>{block}</doc>");
    let tree = roxmltree::Document::parse(&tree).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(tree.descendants().any(|node| node.has_tag_name("math")), "{name}");
    for node in tree.descendants().filter(|node| node.is_element()) {
        let count = node.children().filter(roxmltree::Node::is_element).count();
        match node.tag_name().name() {
            "mfrac" | "msub" | "msup" | "mover" => assert_eq!(count, 2, "{name}"),
            "msubsup" => assert_eq!(count, 3, "{name}"),
            "mi" | "mn" | "mo" | "mtext" => assert!(count == 0 && node.text().is_some(), "{name}"),
            _ => {}
        }
    }
}

#[test]
fn members_of_a_family_are_written_once() {
    let docs = documented(quote! {
        #[bodies(link[40])]
        #[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
        #[revolute(pin[i in 0..39]: link[i] @ (l[i], 0), link[i + 1] @ (0, 0))]
        #[driver(turn[i in 0..40]: link[i].phi = t)]
        struct Chain { l: [f64; 40] }
    });
    assert!(docs.contains("The equations of pin[1], pin[2], … pin[38] (38 in all) have the same form."), "{docs}");
    let (equations, solution) = docs.split_once("# Solution").expect("both sections");
    assert_eq!(equations.matches("<h4>").count(), 3);
    assert!(equations.len() < 20_000 && solution.len() < 250_000, "{} {}", equations.len(), solution.len());
}

#[test]
fn linear_systems_have_their_unknowns() {
    let text = sheet(quote! {
        #[coordinates(u, v)]
        #[constraint(a: (x̄ + t) * u + cos(t) * v = 1)]
        #[constraint(b: t * u + (x̄ - t) * v = x̄)]
        struct Two { x̄: f64 }
    })
    .text();
    for line in ["u (x̄ + t) + v cos t = 1\n", "t u + v (x̄ − t) "] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

#[test]
fn members_with_other_numbers_are_written_by_themselves() {
    let text = sheet(quote! {
        #[coordinates(u[4])]
        #[constraint(step[i in 0..3]: u[i + 1] = u[i] + 0.25 * i)]
        #[driver(drive: u[0] = t)]
        struct Steps;
    })
    .text();
    for number in ["0.25", "0.5"] {
        assert!(text.contains(&format!("− {number} = 0")), "{number}\n{text}");
    }
}

#[test]
fn of_large_mechanisms_the_rest_is_named() {
    let rows = (0..300_usize).map(|k| {
        let (row, q) = (quote::format_ident!("row{k}"), quote::format_ident!("q{k}"));
        quote! { #[constraint(#row: #q + sin(#q) + cos(t * #q) + exp(#q * #q) = t)] }
    });
    let names = (0..300_usize).map(|k| quote::format_ident!("q{k}"));
    let docs = documented(quote! { #[coordinates(#(#names),*)] #(#rows)* struct Many; });
    assert!(docs.len() < 600_000, "{}", docs.len());
    assert!(docs.contains(" in all) are omitted here; the command"), "{docs}");
}

#[test]
fn what_is_wrong_has_no_equations() {
    assert_eq!(documented(quote! { #[bodies(a)] struct Wrong; }), "");
}
