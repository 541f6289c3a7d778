//! Whether a motion ends because a row of Φ does: beyond the last place reached the row is not defined, as √(1 − t) beyond
//! t = 1, or it jumps there, as the angle of a vector does by a full turn.
//!
//! A jump is as large over a hundredth of an interval as over the whole of it. The change of a continuous function is at
//! most half as large, unless it is steeper than the sixth root of |x| at 0.

use super::error::PlanError;
use super::follower::PlanFollower;
use crate::course::Course;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// What becomes of a row, given by its index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum RowEnd {
    /// It is not a finite number.
    Undefined(usize),
    /// It is discontinuous.
    Jump(usize),
}

/// How far beyond the last place reached the rows are evaluated, relative to the length of the course.
const PROBE_DISTANCE: f64 = 1e-9;

/// Largest change of a coordinate over this distance, relative to 1 + |q_k|.
const MAX_PROBE_CHANGE: f64 = 1e-6;

/// The share of the distance over which a jump is as large as over the whole of it.
const JUMP_SHARE: f64 = 0.01;

/// Smallest jump, relative to 1 + |q_k| of the largest coordinate; smaller differences may be rounding errors.
const MIN_JUMP: f64 = 1e-9;

/// The rows beyond the last place reached on a course, and around the configuration there.
pub(crate) trait RowsBeyond {
    /// Writes Φ at a configuration and at a distance from the place reached; false where this is not possible.
    fn write(&mut self, distance: f64, q: &[f64], phi: &mut [f64]) -> bool;
}

/// The end of a row at a configuration q with the rates q̇ along the course, whose length, with its direction as the sign,
/// is `length`. `spacing` is that of floating-point numbers on the course. `at` and the pair `phi` are buffers.
pub(crate) fn row_end(
    rows: &mut dyn RowsBeyond,
    [q, q_dot]: [&[f64]; 2],
    (length, spacing): (f64, f64),
    (at, [phi, other]): (&mut [f64], [&mut [f64]; 2]),
) -> Option<RowEnd> {
    let relative = q.iter().zip(q_dot).map(|(q, v)| v.abs() / (1.0 + q.abs()));
    let fastest = relative.fold(0.0, f64::max);
    let distance = (PROBE_DISTANCE * length.abs()).min(MAX_PROBE_CHANGE / fastest).copysign(length);
    let count = phi.len();
    let mut write = |time: f64, share: f64, phi: &mut [f64]| {
        at.iter_mut().zip(q).zip(q_dot).for_each(|((at, q), v)| *at = q + share * distance * v);
        rows.write(time, at, phi)
    };
    // Where a coordinate goes to infinity, the distance is short; time alone may go farther.
    for (time, share) in [(MAX_PROBE_CHANGE * length, 0.0), (distance, 1.0)] {
        // The comparison is written so that NaN is rejected.
        let is_far = time.abs() >= 8.0 * spacing;
        if !is_far || !write(time, share, phi) {
            return None;
        }
        if let Some(row) = phi.iter().position(|phi| !phi.is_finite()) {
            return Some(RowEnd::Undefined(row));
        }
    }
    // The changes of a row over the whole distance to each side, and over a small share of it.
    let least = MIN_JUMP * (1.0 + q.iter().fold(0.0, |most: f64, q| most.max(q.abs())));
    let mut jumps = |row: usize, side: f64| {
        let mut change = |share: f64| {
            let is_known = write(0.0, share, phi) && write(0.0, 0.0, other);
            if is_known { (phi[row] - other[row]).abs() } else { f64::NAN }
        };
        let (whole, part) = (change(side), change(JUMP_SHARE * side));
        part > least && part >= 0.5 * whole
    };
    (0..count).find(|row| jumps(*row, 1.0) || jumps(*row, -1.0)).map(RowEnd::Jump)
}

/// The rows of a mechanism along a course.
struct AlongCourse<'a, M: Mechanism> {
    mechanism: &'a M,
    parameters: &'a [f64],
    course: &'a dyn Course,
    s: f64,
}

impl<M: Mechanism> RowsBeyond for AlongCourse<'_, M> {
    fn write(&mut self, distance: f64, q: &[f64], phi: &mut [f64]) -> bool {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        let t = self.course.at(self.s + distance, inputs.as_mut());
        let mut rows = M::Rows::<f64>::filled(0.0);
        let at = Instant { t, inputs: inputs.as_ref() };
        let is_known = self.mechanism.constraints_with(self.parameters, &at, q, &mut rows).is_ok();
        phi.copy_from_slice(rows.as_ref());
        is_known
    }
}

impl<M: Mechanism> PlanFollower<M> {
    /// The error if a motion that has reached the place `s` of the course, with these q and q̇, ends there because a row
    /// does; `t` is the time there and `t_refused` that of the instant requested.
    #[cold]
    #[inline(never)]
    pub(super) fn end_of_row(
        &self,
        mechanism: &M,
        (course, s): (&dyn Course, f64),
        rates: [&[f64]; 2],
        [t, t_refused]: [f64; 2],
    ) -> Option<PlanError> {
        let [start, end] = course.ends();
        if s == end {
            return None;
        }
        let mut rows = AlongCourse { mechanism, parameters: self.parameters.as_ref(), course, s };
        let mut at = M::Coordinates::<f64>::filled(0.0);
        let [mut phi, mut other] = [M::Rows::<f64>::filled(0.0); 2];
        let buffers = (at.as_mut(), [phi.as_mut(), other.as_mut()]);
        let found = row_end(&mut rows, rates, (end - start, f64::EPSILON * s.abs()), buffers)?;
        Some(match found {
            RowEnd::Undefined(index) => undefined(M::model(), index, t),
            RowEnd::Jump(_) => PlanError::Jump { t, t_refused },
        })
    }
}

fn undefined(model: &Model, index: usize, t: f64) -> PlanError {
    PlanError::NonFinite { what: "Φ", index, name: model.rows.get(index).map_or("", |row| row.name), t }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One row, as a function of the distance and of q.
    struct One<F>(F);

    impl<F: Fn(f64, f64) -> f64> RowsBeyond for One<F> {
        fn write(&mut self, distance: f64, q: &[f64], phi: &mut [f64]) -> bool {
            phi[0] = (self.0)(distance, q[0]);
            true
        }
    }

    fn found(row: impl Fn(f64, f64) -> f64, [q, q_dot]: [f64; 2], length: f64) -> Option<RowEnd> {
        let buffers = (&mut [0.0][..], [&mut [0.0][..], &mut [0.0][..]]);
        row_end(&mut One(row), [&[q], &[q_dot]], (length, 1e-16), buffers)
    }

    #[test]
    fn a_row_that_is_not_defined_beyond_is_told_from_one_that_jumps() {
        for length in [1.0_f64, -3.0] {
            // Just before the end at a distance of 1e-13, in time or by the motion of q.
            let in_time = |s: f64, q: f64| (1e-13 - s * length.signum()).sqrt() - q;
            assert_eq!(Some(RowEnd::Undefined(0)), found(in_time, [3e-7, 0.0], length));
            assert_eq!(None, found(|s, q| (1.0 - s * length.signum()).sqrt() - q, [1.0, 0.0], length));
            let of_q = |_: f64, q: f64| q.sqrt();
            assert_eq!(Some(RowEnd::Undefined(0)), found(of_q, [1e-13, -length], length));
            // A full turn.
            let wrapping = |_: f64, q: f64| q.sin().atan2(q.cos());
            let turn = std::f64::consts::PI - 1e-13;
            assert_eq!(Some(RowEnd::Jump(0)), found(wrapping, [turn, length], length));
            assert_eq!(None, found(wrapping, [turn - 1e-3, length], length));
        }
    }

    #[test]
    fn what_is_continuous_does_not_jump() {
        let rows: [fn(f64, f64) -> f64; 5] =
            [|_, q| q, |_, q| q.abs(), |_, q| q.abs().powf(0.3), |_, q| 1e9 * q, |_, q| q + q.abs()];
        for row in rows {
            for q in [0.0, 1e-14, -1e-14, 0.3] {
                for v in [0.0, 1.0, -1e9] {
                    assert_eq!(None, found(row, [q, v], 1.0), "{q} {v}");
                }
            }
        }
        // The rounding of a large coordinate is no jump.
        assert_eq!(None, found(|_, q| (q - 3e13) * 0.7, [3e13, 1e26], 1.0));
        // Where numbers are too coarse nothing is known.
        let buffers = (&mut [0.0][..], [&mut [0.0][..], &mut [0.0][..]]);
        assert_eq!(None, row_end(&mut One(|_, _| f64::NAN), [&[0.0], &[1.0]], (1.0, 1e-6), buffers));
    }
}
