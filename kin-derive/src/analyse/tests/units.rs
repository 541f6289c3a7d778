//! The mechanisms of the repository with `check_units`: units are right where they are given, except where a bare t
//! stands for an angle or a number.

use crate::analyse::analyse;
use kin_core::units;

/// A length is taken for an angle, roots of 1 + t² are taken, an angle is t.
const KNOWN: [&str; 3] = ["CamsOnCarriage", "WeldedPendulums", "Order"];

#[test]
fn units_of_the_repository_agree() {
    let (mut with_units, mut wrong) = (0, Vec::new());
    for found in crate::corpus::repository::mechanisms() {
        let (_, result) = analyse(found.args, found.item);
        let Ok(lowered) = result else { continue };
        let given: Vec<_> = lowered.mechanism.parameters.iter().filter_map(|p| p.unit.as_deref()).collect();
        if given.is_empty() {
            continue;
        }
        with_units += 1;
        let unknown: Vec<_> = given.iter().filter_map(|unit| units::parse(unit).err()).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", found.name);
        let mut errors: Vec<_> = units::check(&lowered.mechanism).into_iter().map(|error| error.message).collect();
        assert!(!errors.is_empty() || !KNOWN.contains(&found.name.as_str()), "{}", found.name);
        errors.retain(|message| !message.contains("this is s, "));
        if !errors.is_empty() && !KNOWN.contains(&found.name.as_str()) {
            wrong.push(format!("{}: {errors:?}", found.name));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(with_units > 30, "{with_units} mechanisms with units");
}
