//! The rule for unilateral conditions.

use super::mention::changes;
use crate::error::ModelError;
use crate::mechanism::Mechanism;

/// Rule: a condition contains a coordinate, t or an input, because otherwise no motion can change it.
pub(super) fn conditions_vary(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for condition in &mechanism.conditions {
        let mut indices = condition.range.map_or(0..1, |range| range.indices());
        if !indices.is_empty() && !indices.any(|i| changes(mechanism, &[&condition.left, &condition.right], i)) {
            let message = format!(
                "unilateral `{}` holds no coordinate, no input and no `t`, so that no motion changes it; \
                 one of its sides must vary",
                condition.name
            );
            errors.push(ModelError::new(condition.keyword, message));
        }
    }
}
