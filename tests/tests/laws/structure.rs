//! Laws of the generic rank and the actual rank of Φ_q.

use crate::motion::{grid, swept};
use kin_tests::subject::Subject;

/// No pose has a rank above the generic one; a smaller rank occurs only in mechanisms that allow redundancy.
pub(crate) fn ranks_are_generic(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let (name, structure) = (model.name, model.structure.expect("generated models know their structure"));
    for state in &swept(mechanism, &grid(from, to, 3)) {
        let found = mechanism.mobility(&state.instant(), &state.q).unwrap_or_else(|error| panic!("{error}"));
        assert!(found.rank <= structure.rank, "{name}: {found}");
        assert!(found.rank_without_driving <= structure.rank_without_driving, "{name}: {found}");
        assert!(found.position_rank_without_driving <= structure.position_rank_without_driving, "{name}: {found}");
        if !model.allow_redundant {
            assert_eq!((found.rank, found.redundant.len()), (structure.rank, 0), "{name}: {found}");
            assert_eq!(found.generic_degrees_of_freedom, Some(found.degrees_of_freedom), "{name}: {found}");
        }
    }
}
