//! The range of an input: the values with which the mechanism closes, around the last accepted state.
//!
//! From that state the branch is followed with time and all other inputs constant, while the one input increases and
//! then decreases, until a group reaches its limit ([`search`]). [`limit`](super::limit) locates the limit as in any
//! motion. An input that turns a body is followed until the motion repeats ([`period`]).

mod period;
mod search;

use super::error::PlanError;
use super::group_limit::Limit;
use super::{MaybeOwned, Planned};
use crate::mechanism::{LengthError, Mechanism};
use crate::model::Input;
use crate::signal::{Instant, Signal};
use crate::text::rounded;
use crate::workspace::Array;
use core::fmt;

/// The values of an input with which the mechanism closes, with time and the other inputs constant: those between the
/// limits of the branch of a known state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct InputRange {
    /// The input's name.
    pub input: &'static str,
    /// The least value, in the input's own unit; −∞ where no limit was met.
    pub least: f64,
    /// The greatest value; ∞ where no limit was met.
    pub greatest: f64,
    /// The unit of the input, if it is known.
    pub unit: Option<&'static str>,
    /// The groups that are at their limits at either end, if they are known.
    pub limits: [Option<Limit>; 2],
}

/// A value of an input with which the mechanism does not close, and the range in which it closes.
///
/// It prints as `input boom_length = 9: the mechanism cannot close; possible values here: 0.62 to 1.41`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct OutOfRange {
    /// The value that was requested.
    pub value: f64,
    /// The range in which it closes.
    pub range: InputRange,
}

impl InputRange {
    /// Whether the mechanism closes with this value.
    pub fn contains(&self, value: f64) -> bool {
        (self.least..=self.greatest).contains(&value)
    }

    fn write_unit(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.unit.map_or(Ok(()), |unit| write!(f, " {unit}"))
    }
}

/// `boom_length from 0.62 to 1.41`.
impl fmt::Display for InputRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.input)?;
        match (self.least.is_finite(), self.greatest.is_finite()) {
            (true, true) => write!(f, "from {} to {}", rounded(self.least), rounded(self.greatest)),
            (true, false) => write!(f, "at least {}", rounded(self.least)),
            (false, true) => write!(f, "up to {}", rounded(self.greatest)),
            (false, false) => return f.write_str("unlimited"),
        }?;
        self.write_unit(f)
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let range @ InputRange { input, least, greatest, .. } = self.range;
        // All digits where six would make the value equal to the limit that it is beyond.
        let alike = |limit: f64| rounded(self.value).to_bits() == rounded(limit).to_bits();
        let number = |x: f64| if alike(least) || alike(greatest) { x } else { rounded(x) };
        write!(f, "input {input} = {}", number(self.value))?;
        range.write_unit(f)?;
        f.write_str(": the mechanism cannot close; possible values here: ")?;
        match (least.is_finite(), greatest.is_finite()) {
            (true, true) => write!(f, "{} to {}", number(least), number(greatest)),
            (true, false) => write!(f, "at least {}", number(least)),
            _ => write!(f, "up to {}", number(greatest)),
        }?;
        range.write_unit(f)
    }
}

impl<M: Mechanism> Planned<'_, M> {
    /// The values of an input with which the mechanism closes, with time and the other inputs as at the last accepted
    /// state, on the branch of that state. The limits are exact to rounding.
    ///
    /// The state does not change, and nothing is allocated. It takes as long as some hundred calls of
    /// [`at`](Self::at), whose errors therefore do not contain the range; if a body turns hundreds of times on the way to
    /// a limit, as the spindle of a jack does, it takes longer. An input that moves nothing has no limits, nor has one with
    /// which the motion repeats after whole turns of a body.
    ///
    /// # Errors
    /// [`PlanError::Length`] with the handle of another mechanism. [`PlanError::TooManySteps`] if after 20 000 steps in
    /// one direction there is neither a limit nor a motion that repeats.
    ///
    /// ```
    /// use kin_runtime::{Instant, Kinematics, Signal, mechanism};
    ///
    /// #[mechanism]
    /// #[bodies(boom)]
    /// #[input(cylinder)]
    /// #[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
    /// #[distance(ram: ground @ (0.6, 0), boom @ (1, 0), length = cylinder)]
    /// #[guess(boom.phi = 0.7)]
    /// struct Boom;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let inputs = [Signal::constant(0.8)];
    /// let boom = Boom.solver().planned(&Instant { t: 0.0, inputs: &inputs })?;
    /// let range = boom.range_of(Boom::cylinder)?;
    /// // Foot and ram on one line, on the same and on opposite sides of the foot.
    /// assert!((range.least - 0.4).abs() < 1e-12 && (range.greatest - 1.6).abs() < 1e-12);
    /// # Ok(())
    /// # }
    /// ```
    pub fn range_of(&self, input: Input) -> Result<InputRange, PlanError> {
        let name = M::model().inputs.get(input.0).copied();
        let unknown = LengthError { what: "inputs", expected: M::INPUTS, found: input.0 + 1 };
        let name = name.ok_or(unknown)?;
        let mechanism = self.mechanism.get();
        let turns_freely = self.follower.repeats_in_turns(mechanism, input.0);
        let end = |direction: f64| match turns_freely {
            true => Ok((direction * f64::INFINITY, None)),
            false => self.follower.range_end(mechanism, input.0, direction),
        };
        let [(least, low), (greatest, high)] = [end(-1.0)?, end(1.0)?];
        Ok(InputRange { input: name, least, greatest, unit: M::model().units.of(name), limits: [low, high] })
    }

    /// The input because of which the mechanism does not close at an instant, with the range in which it closes, for an
    /// error message. The inputs that have changed since the last accepted state are tested in their order, each with
    /// all others at their new values or, if the mechanism does not close with these, at their old ones. `None` if no
    /// single input is the cause, or if its range cannot be found.
    ///
    /// The state does not change, and nothing is allocated. It takes as long as some hundred calls of [`at`](Self::at)
    /// for every input.
    ///
    /// ```
    /// # use kin_runtime::{Instant, Kinematics, Signal, mechanism};
    /// # #[mechanism]
    /// # #[bodies(boom)]
    /// # #[input(cylinder)]
    /// # #[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
    /// # #[distance(ram: ground @ (0.6, 0), boom @ (1, 0), length = cylinder)]
    /// # #[guess(boom.phi = 0.7)]
    /// # struct Boom;
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # let inputs = [Signal::constant(0.8)];
    /// # let mut boom = Boom.solver().planned(&Instant { t: 0.0, inputs: &inputs })?;
    /// let broken = [Signal::constant(9.0)];
    /// let tick = Instant { t: 0.001, inputs: &broken };
    /// assert!(boom.at(&tick).is_err());
    /// let why = boom.out_of_range(&tick).ok_or("no input is to blame")?;
    /// assert_eq!(why.to_string(), "input cylinder = 9: the mechanism cannot close; possible values here: 0.4 to 1.6");
    /// # Ok(())
    /// # }
    /// ```
    pub fn out_of_range(&self, at: &Instant<'_>) -> Option<OutOfRange> {
        if at.inputs.len() != M::INPUTS {
            return None;
        }
        let mechanism = self.mechanism.get();
        (0..M::INPUTS).find_map(|k| {
            let requested = at.inputs.get(k)?.value;
            let held = self.follower.inputs.as_ref().get(k).copied()?;
            if requested == held.value {
                return None;
            }
            let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
            inputs.as_mut().iter_mut().zip(at.inputs).for_each(|(to, u)| *to = Signal::constant(u.value));
            *inputs.as_mut().get_mut(k)? = Signal::constant(held.value);
            let mut moved = Planned { mechanism: MaybeOwned::Borrowed(mechanism), follower: self.follower };
            let instant = Instant { t: moved.t(), inputs: inputs.as_ref() };
            // If the mechanism does not close with the new values of the others either, these keep their old values.
            let _ = moved.at(&instant);
            let range = moved.range_of(Input(k)).ok()?;
            (!range.contains(requested)).then_some(OutOfRange { value: requested, range })
        })
    }
}
