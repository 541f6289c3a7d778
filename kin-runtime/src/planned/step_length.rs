//! Lengths of the steps between two points of a course, by the plan and by full Newton.

use crate::scalar::Scalar;

/// The shortest step allowed between two parameters of a course, if the first step could have the length `natural`;
/// `least` is relative to the shorter one of the two lengths.
pub(crate) fn shortest_step(least: f64, natural: f64, [s, end]: [f64; 2]) -> f64 {
    let shortest = least * natural.min((end - s).abs());
    shortest.max(4.0 * f64::EPSILON * s.abs().max(end.abs()))
}

/// The next parameter in steps of this length, and the remaining distance in such steps.
pub(crate) fn next_parameter([s, end]: [f64; 2], length: f64) -> (f64, f64) {
    let remaining = end - s;
    let share = remaining.abs() / length;
    // The remaining distance is split equally between the last two steps, so that none of them is very short.
    let next = match share {
        share if share <= 1.0 => end,
        share if share < 2.0 => s + 0.5 * remaining,
        _ => s + length.copysign(remaining),
    };
    (next, share)
}

/// The factor by which the next step may be longer, from the correction of this one relative to the largest allowed. The
/// error of a prediction by a parabola grows with the third power of the step.
pub(crate) fn growth(effort: f64) -> f64 {
    if effort <= 0.3 / 64.0 { 4.0 } else { Scalar::powf(0.3 / effort, 1.0 / 3.0).clamp(0.5, 4.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_two_steps_share_the_remaining_distance() {
        let next = |length: f64| [next_parameter([2.0, 3.0], length).0, next_parameter([3.0, 2.0], length).0];
        assert_eq!([3.0, 2.0], next(f64::INFINITY));
        assert_eq!([3.0, 2.0], next(1.0));
        assert_eq!([[2.5, 2.5]; 2], [0.9, 0.51].map(next));
        assert_eq!([2.25, 2.75], next(0.25));
        assert_eq!(4.0, next_parameter([2.0, 3.0], 0.25).1);
    }

    #[test]
    fn a_step_grows_with_the_cube_root_of_what_its_correction_leaves() {
        assert_eq!([4.0, 4.0, 0.5, 0.5], [0.0, 0.3 / 64.0, 2.4, 100.0].map(growth));
        assert!((growth(0.3) - 1.0).abs() < 1e-15 && (growth(0.3 / 8.0) - 2.0).abs() < 1e-15);
    }
}
