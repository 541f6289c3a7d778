//! Columns: one quantity over all configurations of a batch.

use crate::lanes::Lanes;
use crate::mechanism::{LengthError, Mechanism};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use alloc::vec::Vec;

/// One quantity over all configurations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column<'a> {
    /// The same number everywhere.
    Shared(f64),
    /// A number for each.
    Each(&'a [f64]),
}

/// The arguments of a batch, a column for each number that one evaluation takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Configurations<'a> {
    /// In the order of [`Model::parameters`](crate::model::Model::parameters).
    pub parameters: &'a [Column<'a>],
    /// Time t.
    pub t: Column<'a>,
    /// The inputs, in the order of declaration.
    pub inputs: &'a [Signal<Column<'a>>],
    /// n columns, in the order of [`Model::coordinates`](crate::model::Model::coordinates).
    pub q: &'a [Column<'a>],
    /// n columns.
    pub q_dot: &'a [Column<'a>],
}

impl Configurations<'_> {
    /// Whether the columns are those of `M`, each with `count` numbers.
    pub(super) fn check<M: Mechanism>(&self, count: usize) -> Result<(), LengthError> {
        let lists = [
            ("parameters", M::PARAMETERS, self.parameters),
            ("q", M::COORDINATES, self.q),
            ("q_dot", M::COORDINATES, self.q_dot),
        ];
        check_signals::<M>(self.inputs, count)?;
        self.t.check("the column of t", count)?;
        lists.into_iter().try_for_each(|(what, expected, list)| check_list(what, expected, list, count))
    }
}

/// Whether a list has as many columns as it must, each with `count` numbers.
pub(super) fn check_list(
    what: &'static str,
    expected: usize,
    list: &[Column<'_>],
    count: usize,
) -> Result<(), LengthError> {
    if list.len() != expected {
        return Err(LengthError { what, expected, found: list.len() });
    }
    let column = match what {
        "parameters" => "a column of the parameters",
        "q" => "a column of q",
        "q_dot" => "a column of q_dot",
        "modes" => "a column of the modes",
        _ => "a column of the start",
    };
    list.iter().try_for_each(|numbers| numbers.check(column, count))
}

/// The same for inputs.
pub(super) fn check_signals<M: Mechanism>(inputs: &[Signal<Column<'_>>], count: usize) -> Result<(), LengthError> {
    if inputs.len() != M::INPUTS {
        return Err(LengthError { what: "inputs", expected: M::INPUTS, found: inputs.len() });
    }
    let numbers = inputs.iter().flat_map(|u| [u.value, u.rate, u.acceleration]);
    numbers.into_iter().try_for_each(|column| column.check("a column of the inputs", count))
}

/// Blocks that are read together: what a column is, is then looked at once for all of them.
const TILE: usize = 8;

/// The arguments of a tile of blocks, and the columns that they come from.
pub(super) struct Arguments<'a, M: Mechanism> {
    parameters: [M::Parameters<Lanes>; TILE],
    t: [Lanes; TILE],
    /// Those of one block after those of another; none where the configurations have none.
    inputs: Vec<Signal<Lanes>>,
    q: [M::Coordinates<Lanes>; TILE],
    q_dot: [M::Coordinates<Lanes>; TILE],
    configurations: &'a Configurations<'a>,
    /// The tile that is there.
    tile: Option<usize>,
}

/// The arguments of one block.
pub(super) struct Block<'b> {
    pub(super) parameters: &'b [Lanes],
    pub(super) at: Instant<'b, Lanes>,
    pub(super) q: &'b [Lanes],
    pub(super) q_dot: &'b [Lanes],
}

impl<'a, M: Mechanism> Arguments<'a, M> {
    /// Shared numbers in place.
    pub(super) fn new(configurations: &'a Configurations<'a>) -> Self {
        let shared = |columns: &[Column<'_>], place: usize| columns.get(place).map_or(0.0.into(), Column::shared);
        let inputs = configurations.inputs.iter().map(|u| u.map(|column| column.shared()));
        Self {
            parameters: [Array::generate(|place| shared(configurations.parameters, place)); TILE],
            t: [configurations.t.shared(); TILE],
            inputs: inputs.collect::<Vec<_>>().repeat(TILE),
            q: [Array::generate(|place| shared(configurations.q, place)); TILE],
            q_dot: [Array::generate(|place| shared(configurations.q_dot, place)); TILE],
            configurations,
            tile: None,
        }
    }

    /// The arguments of the block of configurations from `first`.
    #[inline(always)]
    pub(super) fn block(&mut self, first: usize) -> Block<'_> {
        let block = first / Lanes::COUNT;
        let (tile, k) = (block / TILE, block % TILE);
        let inputs = self.configurations.inputs.len();
        if self.tile != Some(tile) {
            self.read(tile * TILE * Lanes::COUNT);
            self.tile = Some(tile);
        }
        Block {
            parameters: self.parameters[k].as_ref(),
            at: Instant { t: self.t[k], inputs: &self.inputs[k * inputs..][..inputs] },
            q: self.q[k].as_ref(),
            q_dot: self.q_dot[k].as_ref(),
        }
    }

    /// The tile from configuration `first`: every column that differs from one to the next.
    #[inline(never)]
    fn read(&mut self, first: usize) {
        let Configurations { parameters, t, inputs, q, q_dot } = self.configurations;
        for (place, column) in parameters.iter().enumerate() {
            column.read(first, |k, lanes| self.parameters[k].as_mut()[place] = lanes);
        }
        for (place, column) in q.iter().enumerate() {
            column.read(first, |k, lanes| self.q[k].as_mut()[place] = lanes);
        }
        for (place, column) in q_dot.iter().enumerate() {
            column.read(first, |k, lanes| self.q_dot[k].as_mut()[place] = lanes);
        }
        t.read(first, |k, lanes| self.t[k] = lanes);
        for (place, column) in inputs.iter().enumerate() {
            let at = |k: usize| k * inputs.len() + place;
            column.value.read(first, |k, lanes| self.inputs[at(k)].value = lanes);
            column.rate.read(first, |k, lanes| self.inputs[at(k)].rate = lanes);
            column.acceleration.read(first, |k, lanes| self.inputs[at(k)].acceleration = lanes);
        }
    }
}

impl Column<'_> {
    /// The number of one configuration.
    #[inline]
    pub(super) fn at(&self, place: usize) -> f64 {
        match self {
            Self::Shared(value) => *value,
            Self::Each(numbers) => numbers[place],
        }
    }

    pub(super) fn check(&self, what: &'static str, count: usize) -> Result<(), LengthError> {
        match self {
            Self::Each(numbers) if numbers.len() != count => {
                Err(LengthError { what, expected: count, found: numbers.len() })
            }
            _ => Ok(()),
        }
    }

    fn shared(&self) -> Lanes {
        match self {
            Self::Shared(value) => (*value).into(),
            Self::Each(_) => Lanes::default(),
        }
    }

    /// Gives `put` the blocks of the tile from configuration `first`; in the last one the last number is repeated.
    #[inline(always)]
    fn read(&self, first: usize, mut put: impl FnMut(usize, Lanes)) {
        let Self::Each(numbers) = self else { return };
        let rest = numbers.get(first..).unwrap_or_default();
        let (blocks, ragged) = rest[..rest.len().min(TILE * Lanes::COUNT)].as_chunks();
        for (k, block) in blocks.iter().enumerate() {
            put(k, Lanes::new(*block));
        }
        if let Some(last) = ragged.last() {
            put(blocks.len(), Lanes::generate(|lane| *ragged.get(lane).unwrap_or(last)));
        }
    }
}
