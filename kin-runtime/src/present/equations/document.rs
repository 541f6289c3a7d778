//! As LaTeX, a document or its inside, and as a page with MathML.

use super::own::own;
use super::{Row, joints, rows, symbol, what, write};
use crate::model::{JointInfo, Level, Model};
use crate::present::drawing::escaped;
use kin_core::notation::Notation::{Latex, MathMl};

/// A document that compiles as it is, with pdfLaTeX too.
pub(crate) fn latex(model: &Model, chosen: &[usize]) -> String {
    format!(
        "\\documentclass[a4paper]{{article}}\n\\usepackage[T1]{{fontenc}}\n\\usepackage[utf8]{{inputenc}}\n\
         \\usepackage{{amsmath}}\n\\usepackage[margin=2cm]{{geometry}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\
         \\section*{{{}}}\n{}\\end{{document}}\n",
        prose(model.name),
        latex_fragment(model, chosen)
    )
}

/// The inside of a document: a paragraph for every joint, each with one display.
pub(crate) fn latex_fragment(model: &Model, chosen: &[usize]) -> String {
    let joint = |joint: &JointInfo| {
        let own = own(model, joint).into_iter().map(|equation| format!("& {}", write::write(&equation, Latex)));
        let rows = rows(model, joint).into_iter().flat_map(|row| of_row(&row));
        let lines: Vec<String> = own.chain(rows).collect();
        let what = prose(&what(model, joint));
        format!(
            "\\paragraph{{{}}} {what}\n\\begin{{align*}}\n{}\n\\end{{align*}}\n",
            prose(joint.name),
            lines.join(" \\\\\n")
        )
    };
    joints(model, chosen).map(joint).collect()
}

fn of_row(row: &Row<'_>) -> Vec<String> {
    let name = row.name.replace('_', r"\_");
    let position = row.level == Level::Position;
    let letter = if position { r"\Phi" } else { r"\eta" };
    let phi = format!(r"{letter}_{{\mathrm{{{name}}}}}");
    let mut lines = vec![format!("{phi} &= {} = 0", row.phi.write(Latex))];
    for (coordinate, entry) in &row.phi_q {
        let by = if position { symbol(coordinate, Latex) } else { symbol(&format!("{coordinate}_dot"), Latex) };
        lines.push(format!(r"\frac{{\partial {phi}}}{{\partial {by}}} &= {}", entry.write(Latex)));
    }
    let rest = if position {
        format!(r"\frac{{\partial {phi}}}{{\partial t}}")
    } else {
        format!(r"{phi}\big|_{{\dot q = 0}}")
    };
    lines.push(format!("{rest} &= {}", row.phi_t.write(Latex)));
    lines.push(format!(r"\gamma_{{\mathrm{{{name}}}}} &= {}", row.gamma.write(Latex)));
    lines
}

/// A text beside formulas.
fn prose(text: &str) -> String {
    text.replace('_', r"\_").replace('–', "--").replace('&', r"\&").replace('#', r"\#")
}

/// A page that needs nothing else; browsers show MathML by themselves.
pub(crate) fn page(model: &Model, chosen: &[usize]) -> String {
    let name = escaped(model.name);
    let sections: String = joints(model, chosen).map(|joint| section(model, joint)).collect();
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{name}: equations</title>\n\
         <style>body{{font:16px/1.5 system-ui,sans-serif;margin:1rem auto;max-width:60rem;padding:0 1rem;color:#1f2937}}\
         h2{{margin:1.6rem 0 .4rem;font-size:1.1rem}}h2 span{{color:#6b7280;font-weight:400}}\
         .wide{{overflow-x:auto;padding:.15rem 0}}table{{border-spacing:.6rem .15rem}}td:first-child{{text-align:right;\
         white-space:nowrap}}td{{vertical-align:baseline}}tr.row td{{padding-top:.7rem}}</style>\n</head>\n<body>\n\
         <h1>{name}</h1>\n<p>{}</p>\n{sections}</body>\n</html>\n",
        escaped(model.doc)
    )
}

fn section(model: &Model, joint: &JointInfo) -> String {
    let own: String = own(model, joint)
        .into_iter()
        .map(|equation| format!("<p class=\"wide\">{}</p>\n", math(&write::write(&equation, MathMl))))
        .collect();
    let rows: String = rows(model, joint).iter().map(table_rows).collect();
    format!(
        "<section>\n<h2>{} <span>{}</span></h2>\n{own}<div class=\"wide\"><table>\n{rows}</table></div>\n</section>\n",
        escaped(joint.name),
        escaped(&what(model, joint))
    )
}

fn table_rows(row: &Row<'_>) -> String {
    let position = row.level == Level::Position;
    let letter = if position { "Φ" } else { "η" };
    let phi = format!("<msub><mi>{letter}</mi><mi mathvariant=\"normal\">{}</mi></msub>", escaped(row.name));
    let line = |class: &str, left: &str, right: &str| {
        let (left, right) = (math(left), math(&format!("<mo>=</mo>{right}")));
        format!("<tr{class}><td>{left}</td><td>{right}</td></tr>\n")
    };
    let mut out = line(" class=\"row\"", &phi, &format!("{}<mo>=</mo><mn>0</mn>", row.phi.write(MathMl)));
    for (coordinate, entry) in &row.phi_q {
        let by = if position { symbol(coordinate, MathMl) } else { symbol(&format!("{coordinate}_dot"), MathMl) };
        let left = format!("<mfrac><mrow><mo>∂</mo>{phi}</mrow><mrow><mo>∂</mo>{by}</mrow></mfrac>");
        out.push_str(&line("", &left, &entry.write(MathMl)));
    }
    let rest = if position {
        format!("<mfrac><mrow><mo>∂</mo>{phi}</mrow><mrow><mo>∂</mo><mi>t</mi></mrow></mfrac>")
    } else {
        format!("{phi}<mtext> at rest</mtext>")
    };
    out.push_str(&line("", &rest, &row.phi_t.write(MathMl)));
    let gamma = format!("<msub><mi>γ</mi><mi mathvariant=\"normal\">{}</mi></msub>", escaped(row.name));
    out.push_str(&line("", &gamma, &row.gamma.write(MathMl)));
    out
}

fn math(inner: &str) -> String {
    format!("<math>{inner}</math>")
}
