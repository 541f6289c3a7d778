//! Joins the arrays of sines and of cosines of consecutive loops, so that one call computes the values of several
//! loops.
//!
//! A mechanism with members of several kinds has one loop and one array per kind of angle. A call processes eight
//! angles at a time and pads the last group, so one call for thirty angles is cheaper than three calls for ten.

use super::rolled::{Keep, OperandSource, Piece, ResultPart, Rolled, RolledStep};
use crate::program::{Instruction, ValueId};

/// A step that computes a sine and a cosine.
pub struct Angles<'r> {
    /// The angle, as an index of [`Rolled::sources`].
    pub angle: ValueId,
    /// The arrays that store the sine and cosine.
    pub keeps: &'r [Keep],
}

impl Rolled {
    /// The number of iterations and the steps of a loop that computes nothing but sines and cosines of angles that are
    /// known before the loop.
    pub fn angles<'r>(&self, piece: &'r Piece) -> Option<(usize, Vec<Angles<'r>>)> {
        let Piece::Loop { count, body } = piece else { return None };
        let steps: Option<Vec<Angles<'r>>> = (body.iter())
            .map(|step| match step {
                RolledStep::Compute { instruction: Instruction::SinCos(angle), keeps, .. } => {
                    Some(Angles { angle: *angle, keeps })
                }
                _ => None,
            })
            .collect();
        let steps = steps?;
        let arrays: Vec<usize> = steps.iter().flat_map(|step| step.keeps).map(|keep| keep.array).collect();
        steps.iter().all(|step| self.is_known_before(step.angle, &arrays)).then_some((*count, steps))
    }

    /// True if the angle is neither an element of the `arrays` nor a sine or cosine computed in the same iteration.
    fn is_known_before(&self, angle: ValueId, arrays: &[usize]) -> bool {
        match self.sources[angle.index()] {
            OperandSource::Element { array, .. } => !arrays.contains(&array),
            OperandSource::Local(_, part) => part == ResultPart::Whole,
            _ => true,
        }
    }

    /// The arrays of sines and cosines, [sin, cos] for each step, that a loop fills from the first element to the
    /// last; `None` if the loop does anything else.
    fn filled(&self, piece: &Piece, known: &[[usize; 2]]) -> Option<Vec<[usize; 2]>> {
        let (count, steps) = self.angles(piece)?;
        let array = |step: &Angles<'_>, part: ResultPart| {
            let keep = step.keeps.iter().find(|keep| keep.part == part)?;
            (keep.first == 0 && self.arrays[keep.array] == count).then_some(keep.array)
        };
        let pair = |step: &Angles<'_>| {
            let alone = step.keeps.len() == 2 && self.is_known_before(step.angle, known.as_flattened());
            alone.then(|| Some([array(step, ResultPart::Sin)?, array(step, ResultPart::Cos)?])).flatten()
        };
        steps.iter().map(pair).collect()
    }
}

/// Joins the arrays of consecutive loops.
pub(super) fn join(rolled: &mut Rolled) {
    // For every array, the array that it becomes a part of and the index of its first element there.
    let mut places: Vec<(usize, usize)> = (0..rolled.arrays.len()).map(|array| (array, 0)).collect();
    let mut run: Vec<[usize; 2]> = Vec::new();
    for piece in &rolled.pieces {
        let Some(pairs) = rolled.filled(piece, &run).or_else(|| {
            run.clear();
            rolled.filled(piece, &run)
        }) else {
            continue;
        };
        for pair in pairs {
            if let (Some(&first), Some(last)) = (run.first(), run.last()) {
                for (of_pair, array) in pair.into_iter().enumerate() {
                    places[array] = (first[of_pair], places[last[of_pair]].1 + rolled.arrays[last[of_pair]]);
                }
            }
            run.push(pair);
        }
    }
    let mut lengths: Vec<usize> = vec![0; places.len()];
    for (&(whole, first), length) in places.iter().zip(&rolled.arrays) {
        lengths[whole] = lengths[whole].max(first + length);
    }
    // The arrays that are left are numbered without gaps.
    let mut numbers = Vec::new();
    let mut next_number = 0..;
    for length in &lengths {
        numbers.push(if *length > 0 { next_number.next().unwrap_or(0) } else { 0 });
    }
    rolled.arrays = lengths.into_iter().filter(|length| *length > 0).collect();
    let moved = |array: &mut usize, first: &mut usize| {
        let (whole, offset) = places[*array];
        (*array, *first) = (numbers[whole], *first + offset);
    };
    for source in &mut rolled.sources {
        if let OperandSource::Element { array, first, .. } = source {
            moved(array, first);
        }
    }
    for piece in &mut rolled.pieces {
        let (Piece::Straight(steps) | Piece::Loop { body: steps, .. }) = piece;
        for step in steps {
            if let RolledStep::Compute { keeps, .. } = step {
                keeps.iter_mut().for_each(|keep| moved(&mut keep.array, &mut keep.first));
            }
        }
    }
}
