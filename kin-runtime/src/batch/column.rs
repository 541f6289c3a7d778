//! Columns: one quantity over all configurations of a batch.

use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::lanes::Pack;
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
    /// The parameters, in the order of [`Model::parameters`](crate::model::Model::parameters).
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
    /// Checks that there are as many columns as `M` needs, each with `count` numbers.
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

/// Checks that a list has as many columns as it must, each with `count` numbers.
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

/// Configurations that are read together, so that the kind of a column is tested once for all of them.
const TILE: usize = 32;

/// The number of blocks in a tile.
const fn tile<V: Pack>() -> usize {
    TILE / V::COUNT
}

/// The arguments of a tile of blocks, and the columns that they come from.
pub(super) struct Arguments<'a, M: Mechanism, V: Pack> {
    /// On the heap: the blocks of a large mechanism are too large for the stack of a thread.
    blocks: Vec<Numbers<M, V>>,
    /// The inputs, block after block; empty for a mechanism without inputs.
    inputs: Vec<Signal<V>>,
    configurations: &'a Configurations<'a>,
    /// The tile that has been read.
    tile: Option<usize>,
}

/// The numbers of one block.
struct Numbers<M: Mechanism, V: Pack> {
    parameters: M::Parameters<V>,
    t: V,
    q: M::Coordinates<V>,
    q_dot: M::Coordinates<V>,
}

impl<M: Mechanism, V: Pack> Clone for Numbers<M, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism, V: Pack> Copy for Numbers<M, V> {}

/// The arguments of one block.
pub(super) struct Block<'b, V> {
    pub(super) parameters: &'b [V],
    pub(super) at: Instant<'b, V>,
    pub(super) q: &'b [V],
    pub(super) q_dot: &'b [V],
}

impl<'a, M: Mechanism, V: Pack> Arguments<'a, M, V> {
    /// Buffers that contain the shared numbers.
    pub(super) fn new(configurations: &'a Configurations<'a>) -> Self {
        let shared = |columns: &[Column<'_>], index: usize| columns.get(index).map_or(V::default(), Column::shared);
        let numbers = Numbers {
            parameters: Array::generate(V::default(), |index| shared(configurations.parameters, index)),
            t: configurations.t.shared(),
            q: Array::generate(V::default(), |index| shared(configurations.q, index)),
            q_dot: Array::generate(V::default(), |index| shared(configurations.q_dot, index)),
        };
        let inputs = configurations.inputs.iter().map(|u| u.map(|column| column.shared()));
        let inputs = inputs.collect::<Vec<_>>().repeat(tile::<V>());
        Self { blocks: alloc::vec![numbers; tile::<V>()], inputs, configurations, tile: None }
    }

    /// The arguments of the block whose first configuration is `first`.
    #[inline(always)]
    pub(super) fn block(&mut self, first: usize) -> Block<'_, V> {
        let block = first / V::COUNT;
        let (tile, k) = (block / tile::<V>(), block % tile::<V>());
        let inputs = self.configurations.inputs.len();
        if self.tile != Some(tile) {
            self.read(tile * TILE);
            self.tile = Some(tile);
        }
        let Numbers { parameters, t, q, q_dot } = &self.blocks[k];
        Block {
            parameters: parameters.as_ref(),
            at: Instant { t: *t, inputs: &self.inputs[k * inputs..][..inputs] },
            q: q.as_ref(),
            q_dot: q_dot.as_ref(),
        }
    }

    /// Reads the tile whose first configuration is `first`; the numbers of shared columns remain.
    #[inline(never)]
    fn read(&mut self, first: usize) {
        let Configurations { parameters, t, inputs, q, q_dot } = self.configurations;
        let blocks = &mut self.blocks;
        for (index, column) in parameters.iter().enumerate() {
            column.read(first, |k, numbers| blocks[k].parameters.as_mut()[index] = numbers);
        }
        for (index, column) in q.iter().enumerate() {
            column.read(first, |k, numbers| blocks[k].q.as_mut()[index] = numbers);
        }
        for (index, column) in q_dot.iter().enumerate() {
            column.read(first, |k, numbers| blocks[k].q_dot.as_mut()[index] = numbers);
        }
        t.read(first, |k, numbers| blocks[k].t = numbers);
        for (index, column) in inputs.iter().enumerate() {
            let at = |k: usize| k * inputs.len() + index;
            column.value.read(first, |k, numbers| self.inputs[at(k)].value = numbers);
            column.rate.read(first, |k, numbers| self.inputs[at(k)].rate = numbers);
            column.acceleration.read(first, |k, numbers| self.inputs[at(k)].acceleration = numbers);
        }
    }
}

impl Column<'_> {
    /// The number of one configuration.
    #[inline]
    pub(super) fn at(&self, index: usize) -> f64 {
        match self {
            Self::Shared(value) => *value,
            Self::Each(numbers) => numbers[index],
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

    fn shared<V: Pack>(&self) -> V {
        match self {
            Self::Shared(value) => V::from_f64(*value),
            Self::Each(_) => V::default(),
        }
    }

    /// Passes the blocks of the tile that begins at configuration `first` to `put`; an incomplete last block is padded
    /// with the last number.
    #[inline(always)]
    fn read<V: Pack>(&self, first: usize, mut put: impl FnMut(usize, V)) {
        let Self::Each(numbers) = self else { return };
        let rest = numbers.get(first..).unwrap_or_default();
        let rest = &rest[..rest.len().min(TILE)];
        let ragged = V::read(rest, &mut put);
        if let Some(last) = ragged.last() {
            put(rest.len() / V::COUNT, V::generate(|lane| *ragged.get(lane).unwrap_or(last)));
        }
    }
}
