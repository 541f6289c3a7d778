//! Columns: one quantity over all configurations of a batch.

use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::lanes::Pack;
use crate::signal::{Instant, Signal};
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
        check_signals(M::INPUTS, self.inputs, count)?;
        self.t.check("the column of t", count)?;
        check_list("parameters", M::PARAMETERS, self.parameters, count)?;
        check_list("q", M::COORDINATES, self.q, count)?;
        check_list("q_dot", M::COORDINATES, self.q_dot, count)
    }
}

/// Checks that a list has as many columns as it must, each with `count` numbers.
pub(super) fn check_list(
    list_name: &'static str,
    expected: usize,
    list: &[Column<'_>],
    count: usize,
) -> Result<(), LengthError> {
    if list.len() != expected {
        return Err(LengthError { what: list_name, expected, found: list.len() });
    }
    let column = match list_name {
        "parameters" => "a column of the parameters",
        "q" => "a column of q",
        "q_dot" => "a column of q_dot",
        "modes" => "a column of the modes",
        _ => "a column of the start",
    };
    list.iter().try_for_each(|numbers| numbers.check(column, count))
}

/// The same for inputs.
pub(super) fn check_signals(expected: usize, inputs: &[Signal<Column<'_>>], count: usize) -> Result<(), LengthError> {
    if inputs.len() != expected {
        return Err(LengthError { what: "inputs", expected, found: inputs.len() });
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
///
/// The lengths are those of the lists of columns and not those of a mechanism's arrays, so that the code is compiled
/// once for all mechanisms.
pub(super) struct Arguments<'a, V> {
    /// For every block of the tile the parameters, q and q̇, then t.
    numbers: Vec<V>,
    /// The inputs, block after block; empty for a mechanism without inputs.
    inputs: Vec<Signal<V>>,
    configurations: &'a Configurations<'a>,
    /// The tile that has been read.
    tile: Option<usize>,
}

/// The arguments of one block.
pub(super) struct Block<'b, V> {
    pub(super) parameters: &'b [V],
    pub(super) at: Instant<'b, V>,
    pub(super) q: &'b [V],
    pub(super) q_dot: &'b [V],
}

impl Configurations<'_> {
    /// The columns in the order of the numbers of a block.
    fn columns(&self) -> [&[Column<'_>]; 4] {
        [self.parameters, self.q, self.q_dot, core::slice::from_ref(&self.t)]
    }
}

impl<'a, V: Pack> Arguments<'a, V> {
    /// Buffers that contain the shared numbers.
    pub(super) fn new(configurations: &'a Configurations<'a>) -> Self {
        let numbers: Vec<V> = configurations.columns().into_iter().flatten().map(Column::shared).collect();
        let inputs: Vec<Signal<V>> = configurations.inputs.iter().map(|u| u.map(|column| column.shared())).collect();
        let (numbers, inputs) = (numbers.repeat(tile::<V>()), inputs.repeat(tile::<V>()));
        Self { numbers, inputs, configurations, tile: None }
    }

    /// The arguments of the block whose first configuration is `first`.
    #[inline(always)]
    pub(super) fn block(&mut self, first: usize) -> Block<'_, V> {
        let block = first / V::COUNT;
        let (inputs, stride) = (self.configurations.inputs.len(), self.numbers.len() / tile::<V>());
        let (tile, k) = (block / tile::<V>(), block % tile::<V>());
        if self.tile != Some(tile) {
            self.read(tile * TILE);
            self.tile = Some(tile);
        }
        let (parameter_count, coordinate_count) = (self.configurations.parameters.len(), self.configurations.q.len());
        let (parameters, rest) = self.numbers[k * stride..][..stride].split_at(parameter_count);
        let (q, rest) = rest.split_at(coordinate_count);
        let (q_dot, t) = rest.split_at(rest.len() - 1);
        let at = Instant { t: t[0], inputs: &self.inputs[k * inputs..][..inputs] };
        Block { parameters, at, q, q_dot }
    }

    /// Reads the tile whose first configuration is `first`; the numbers of shared columns remain.
    #[inline(never)]
    fn read(&mut self, first: usize) {
        let Self { numbers, inputs, configurations, .. } = self;
        let stride = numbers.len() / tile::<V>();
        let mut index = 0;
        for columns in configurations.columns() {
            for column in columns {
                column.read(first, |k, x| numbers[k * stride + index] = x);
                index += 1;
            }
        }
        let stride = configurations.inputs.len();
        for (index, column) in configurations.inputs.iter().enumerate() {
            column.value.read(first, |k, x| inputs[k * stride + index].value = x);
            column.rate.read(first, |k, x| inputs[k * stride + index].rate = x);
            column.acceleration.read(first, |k, x| inputs[k * stride + index].acceleration = x);
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

    pub(super) fn check(&self, list_name: &'static str, count: usize) -> Result<(), LengthError> {
        match self {
            Self::Each(numbers) if numbers.len() != count => {
                Err(LengthError { what: list_name, expected: count, found: numbers.len() })
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
