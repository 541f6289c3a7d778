//! Motions that need too many internal steps, which are not at a limit.

use super::{failed, kin};

/// A crank that becomes faster and faster turns for ever, but cannot be followed for ever.
#[test]
fn too_many_steps_are_no_limit() {
    let said =
        ["no limit is met up to t = 39.1", "too many internal steps", "write a time in place of the limit: --to 39.1"];
    let ran = failed("faster sweep --to limit --steps 4", 1, &said);
    assert_eq!(ran.out, "");
    failed("faster sweep --from limit --to 0 --steps 4", 1, &["write a time in place of the limit: --from -39.1"]);
    let file = super::temporary("no_limit.svg");
    failed(&format!("faster plot crank.phi --to limit --out {}", file.display()), 1, &said);
    assert!(!file.exists());
    // The whole motion in one step, without an end and with one.
    let ran = kin("faster sweep --from 60 --steps 1 --to 99");
    assert!(ran.status == Some(1) && ran.err.contains("add instants in between"), "{}", ran.err);
}
