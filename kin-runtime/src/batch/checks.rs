//! Checks of the solutions of a block that do not follow from their margins alone; every lane is refused independently.

use super::block_solution::{BlockSolution, Question};
use crate::mechanism::Mechanism;
use crate::plan::Depth;
use crate::planned::Limit;
use crate::planned::branch::FAR_FROM_LIMITS;
use crate::planned::follower::PlanFollower;
use crate::planned::ill_conditioned::may_be_ill_conditioned;
use crate::planned::inputs::write_lane_of_inputs;
use crate::planned::lists::{BranchValues, Distances, Margins, Modes};
use crate::planned::steep_rows::{certainty_of_slopes, may_be_steep};
use crate::scalar::Scalar;
use crate::scalar::compare::{Compare, write_lane};
use crate::scalar::lanes::Octet;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use core::f64::consts::PI;

/// The limits beside which lanes were refused.
pub(super) type LimitsNearby = [Option<Limit>; Octet::COUNT];

impl<Q: AsRef<[Octet]> + AsMut<[Octet]>> BlockSolution<Q> {
    /// Refuses the lanes of a solution if the scalar follower would refuse to start there. `modes` are the signs of all
    /// groups; if they are those of the start, an iteration must keep them. Returns the limits beside which lanes were
    /// refused.
    #[inline(always)]
    pub(super) fn check<M: Mechanism>(
        &mut self,
        mechanism: &M,
        question: &Question<'_>,
        (modes, of_start): (&Modes<M, Octet>, bool),
        margins: &Margins<M, Octet>,
    ) -> LimitsNearby {
        let &Question { parameters, at, start, depth, .. } = question;
        self.refuse_turned::<M>(start);
        self.refuse_steep(mechanism, (parameters, at), depth);
        if of_start {
            self.refuse_other_closures(mechanism, (parameters, at), modes.as_ref());
        }
        self.refuse_negative_lengths(mechanism, (parameters, at));
        let far = (self.margin - Octet::from_f64(1.0)).is_within(1.0 - FAR_FROM_LIMITS);
        // Only rates are inaccurate beside a crossing.
        if far || depth == Depth::Position {
            return [None; Octet::COUNT];
        }
        self.refuse_rounded(mechanism, question, modes, margins)
    }

    /// Refuses lanes so near to a crossing of branches that rounding errors dominate their rates.
    #[cold]
    #[inline(never)]
    fn refuse_rounded<M: Mechanism>(
        &mut self,
        mechanism: &M,
        question: &Question<'_>,
        modes: &Modes<M, Octet>,
        margins: &Margins<M, Octet>,
    ) -> LimitsNearby {
        let &Question { parameters, at, .. } = question;
        let mut distances = Distances::<M, Octet>::filled(Octet::default());
        margins.write_distances(&mut distances);
        let branch_values = BranchValues::at(mechanism, parameters, at, self.q.as_ref());
        let branch_values = branch_values.unwrap_or_else(|_| BranchValues::filled(Octet::default()));
        core::array::from_fn(|lane| {
            let mut groups = distances.as_ref().iter().zip(branch_values.as_ref());
            let is_near = groups.any(|(distance, w)| may_be_ill_conditioned(distance.lane(lane), w.lane(lane)));
            if !is_near || !self.is_good(lane) {
                return None;
            }
            let mut parameters_of_lane = M::Parameters::<f64>::filled(0.0);
            write_lane(parameters_of_lane.as_mut(), parameters, lane);
            let mut q = M::Coordinates::<f64>::filled(0.0);
            write_lane(q.as_mut(), self.q.as_ref(), lane);
            let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
            write_lane_of_inputs(inputs.as_mut(), at.inputs, lane);
            let at = Instant { t: at.t.lane(lane), inputs: inputs.as_ref() };
            let modes = Modes::lane_of(modes, lane);
            let error = PlanFollower::<M>::begin(mechanism, parameters_of_lane, &at, q.as_ref(), modes).err()?;
            self.refuse_at_limit(lane);
            error.limit().copied()
        })
    }

    /// Refuses lanes in which a length that a joint keeps is negative.
    #[inline(always)]
    fn refuse_negative_lengths<M: Mechanism>(
        &mut self,
        mechanism: &M,
        (parameters, at): (&[Octet], &Instant<'_, Octet>),
    ) {
        if M::LENGTHS > 0 {
            let lengths = least_length(mechanism, parameters, at);
            (0..Octet::COUNT).filter(|lane| lengths.lane(*lane) < 0.0).for_each(|lane| self.refuse_at_limit(lane));
        }
    }

    /// Marks a lane as not solved although its margins are large enough.
    fn refuse_at_limit(&mut self, lane: usize) {
        self.refuse(lane);
        self.margin.set(lane, 0.0);
    }

    /// Refuses lanes in which rounding errors dominate a solution because the slopes of iterated rows change too fast.
    /// Rates count if accelerations have been computed.
    #[inline(always)]
    fn refuse_steep<M: Mechanism>(
        &mut self,
        mechanism: &M,
        (parameters, at): (&[Octet], &Instant<'_, Octet>),
        depth: Depth,
    ) {
        if !may_be_steep::<M>() {
            return;
        }
        let [mut turns, still] = [M::Coordinates::<Octet>::filled(Octet::default()); 2];
        let counted = mechanism.turns_with(parameters, at, self.q.as_ref(), turns.as_mut());
        debug_assert!(counted.is_ok(), "the columns have been counted");
        let rates = match depth {
            Depth::Acceleration => [self.q_dot.as_ref(), self.q_ddot.as_ref()],
            _ => [still.as_ref(); 2],
        };
        let solution = [self.q.as_ref(), rates[0], rates[1]];
        let certainty = certainty_of_slopes(M::model(), M::DISTANCES_IN_ROWS, turns.as_ref(), solution);
        for lane in 0..Octet::COUNT {
            // The comparison is written so that NaN is refused.
            let is_certain = certainty.lane(lane) >= 0.0;
            if self.is_good(lane) && !is_certain {
                self.refuse_at_limit(lane);
            }
        }
    }

    /// Refuses lanes in which a group solved by Newton's iteration is more than half a turn away from its start.
    #[inline(always)]
    fn refuse_turned<M: Mechanism>(&mut self, start: &[Octet]) {
        for k in M::model().iterated_angles() {
            let away = self.q.as_ref()[k] - start[k];
            if away.is_within(PI) {
                continue;
            }
            for lane in 0..Octet::COUNT {
                if self.is_good(lane) && away.lane(lane).abs() > PI {
                    self.refuse_at_limit(lane);
                }
            }
        }
    }

    /// Refuses lanes in which an iteration has led to another closure than that of the start: a group has another
    /// orientation than in `signs`, those of the start.
    #[inline(always)]
    fn refuse_other_closures<M: Mechanism>(
        &mut self,
        mechanism: &M,
        (parameters, at): (&[Octet], &Instant<'_, Octet>),
        signs: &[Octet],
    ) {
        let plan = &M::model().plan;
        if !plan.iterates() {
            return;
        }
        let mut found = M::Coordinates::<Octet>::filled(Octet::default());
        let found = &mut found.as_mut()[..plan.signs()];
        let counted = mechanism.branches_with(parameters, at, self.q.as_ref(), found);
        debug_assert!(counted.is_ok(), "the columns have been counted");
        for group in plan.modes.len()..plan.modes.len() + plan.iterations {
            let sign = found[group] * signs[group];
            for lane in 0..Octet::COUNT {
                // The comparison is written so that NaN is refused.
                let keeps = sign.lane(lane) > 0.0;
                if self.is_good(lane) && !keeps {
                    self.refuse_at_limit(lane);
                }
            }
        }
    }
}

/// The smallest of the lengths that joints keep; 1 if there are none.
#[inline]
pub(super) fn least_length<M: Mechanism>(mechanism: &M, parameters: &[Octet], at: &Instant<'_, Octet>) -> Octet {
    let most = Octet::from_f64(1.0);
    if M::LENGTHS == 0 {
        return most;
    }
    let mut lengths = M::Rows::<Octet>::filled(most);
    let lengths = &mut lengths.as_mut()[..M::LENGTHS];
    let counted = mechanism.lengths_with(parameters, at, lengths);
    debug_assert!(counted.is_ok(), "the columns have been counted");
    lengths.iter().fold(most, |least, length| least.least(*length))
}
