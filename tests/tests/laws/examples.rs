//! Laws of every example.

use crate::{equations, typeset};
use kin_tests::{every_example, examples};

/// The template, whose own tests are run here.
#[allow(dead_code, unreachable_pub, missing_docs, reason = "a program of its own")]
#[path = "../../../examples/template.rs"]
mod template;

/// Closed forms equal dual numbers, and the typeset equations are the code.
macro_rules! laws {
    ($($name:ident: $Mechanism:ident;)+) => {
        mod closed_forms_equal_duals {
            $(
                #[test]
                fn $name() {
                    super::equations::closed_forms_equal_duals(&super::examples::$name::$Mechanism::default());
                }
            )+
        }

        mod typeset_equations {
            $(
                #[test]
                fn $name() {
                    super::typeset::typeset_equations_are_the_code(&super::examples::$name::$Mechanism::default());
                }
            )+
        }
    };
}

every_example!(laws);

#[test]
fn no_example_is_left_out() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let files = std::fs::read_dir(folder).expect("the examples").map(|entry| entry.expect("a file").file_name());
    let mut found: Vec<String> = files
        .filter_map(|file| file.to_str()?.strip_suffix(".rs").map(str::to_owned))
        .filter(|name| name != "lib")
        .collect();
    found.sort();
    let mut names = examples::NAMES.to_vec();
    names.sort_unstable();
    assert_eq!(names, found);
}
