//! The rows of all joints together: Φ, Φ_q, Φ_t and γ as matrices.

use super::{failed, good};

/// The entries of a matrix in the text, row by row.
fn entries(text: &str, name: &str) -> Vec<Vec<String>> {
    let lines = text.lines().skip_while(|line| !line.trim_start().starts_with(&format!("{name} = ⎡")));
    let rows = lines.take_while(|line| line.contains(['⎡', '⎢', '⎣']));
    let inside = |line: &str| {
        let from = line.find(['⎡', '⎢', '⎣']).expect("it opens") + '⎡'.len_utf8();
        let to = line.find(['⎤', '⎥', '⎦']).expect("it closes");
        line[from..to].split("  ").map(str::trim).filter(|entry| !entry.is_empty()).map(str::to_owned).collect()
    };
    rows.map(inside).collect()
}

#[test]
fn the_lectures_four_bar_has_its_matrices() {
    let text = good("fourbar equations --part rows");
    let phi_q = entries(&text, "Φ_q");
    assert_eq!((phi_q.len(), phi_q[0].len()), (9, 9));
    // The row A.x in the notation of the lecture.
    let expected = ["−1", "0", "(l₁/2) sin φ_crank", "1", "0", "(l₂/2) sin φ_coupler", "0", "0", "0"];
    assert!(phi_q.iter().any(|row| row == &expected), "{phi_q:?}");
    assert_eq!(["Φ", "Φ_t", "γ"].map(|name| entries(&text, name).len()), [9; 3]);
    assert!(entries(&text, "γ").iter().flatten().any(|row| row == "−(l₁/2) φ̇_crank² cos φ_crank"));
    assert!(!text.contains("0.5 l"), "halves are decimal numbers");
}

#[test]
fn matrices_are_in_every_form_and_only_of_the_whole() {
    let latex = good("fourbar equations --format latex");
    assert_eq!(latex.matches(r"\begin{pmatrix}").count(), latex.matches(r"\end{pmatrix}").count());
    assert!(latex.contains(r"\Phi_q &= \begin{pmatrix}") && latex.contains(r"\gamma &= \begin{pmatrix}"));
    assert!(good("fourbar equations --format html").contains("<mtable>"));
    for part in ["fourbar equations A", "fourbar equations --part solution"] {
        assert!(!good(part).contains("All rows together"), "{part}");
    }
}

#[test]
fn matrices_alone_are_those_of_the_whole_sheet() {
    let (alone, all) = (good("fourbar equations --part matrices"), good("fourbar equations"));
    for name in ["Φ", "Φ_q", "Φ_t", "γ"] {
        assert!(!entries(&alone, name).is_empty(), "{name}");
        assert_eq!(entries(&alone, name), entries(&all, name), "{name}");
    }
    assert!(all.contains("\nA  revolute") && !alone.contains("\nA  revolute"), "{alone}");
    assert!(all.contains("\nSolution\n") && !alone.contains("\nSolution\n"), "{alone}");
    for form in ["html", "latex"] {
        let [alone, rows] =
            ["matrices", "rows"].map(|part| good(&format!("fourbar equations --part {part} --format {form}")));
        assert!(alone.contains("All rows together") && alone.len() < rows.len(), "{form}");
    }
    failed("fourbar equations A --part matrices", 2, &["--part matrices", "all joints"]);
}

/// Beside its joints the chain's 30 coordinates would be too many.
#[test]
fn matrices_are_written_at_any_size_when_they_are_wanted() {
    assert!(!good("chain equations").contains("All rows together"));
    let phi_q = entries(&good("chain equations --part matrices"), "Φ_q");
    assert_eq!((phi_q.len(), phi_q[0].len()), (30, 30));
}
