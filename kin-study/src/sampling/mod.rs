//! Sampled values of parameters. Those of a row depend on its number alone, however the work is divided.

mod counter;
mod permutation;
mod range;
mod sobol;

pub use range::Range;

use counter::{bits, unit};
use permutation::Permutation;
use sobol::Sequence;

/// How values are chosen from the ranges of the parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// Independent random numbers.
    #[default]
    Random,
    /// The range of every parameter is divided into as many intervals of equal probability as there are rows, with one
    /// value in each (McKay, Beckman and Conover, 1979).
    LatinHypercube,
    /// Sobol's sequence, with a random shift that depends on the seed: more even than random numbers in several
    /// parameters together.
    Sobol,
    /// Every combination of lists and fixed values; the parameter that is named last changes fastest.
    Grid,
}

/// Gives the values of the parameters in all rows.
#[derive(Debug)]
pub(crate) struct Sampler {
    ranges: Vec<Range>,
    rows: u64,
    seed: u64,
    way: Way,
}

/// A way of sampling with what it needs.
#[derive(Debug)]
enum Way {
    Random,
    LatinHypercube(Vec<Permutation>),
    Sobol(Sequence),
    /// For every parameter, the number of rows after which it changes.
    Grid(Vec<u64>),
}

impl Sampler {
    /// The sampler of these ranges; `rows` may be missing for a grid only.
    pub(crate) fn new(ranges: Vec<Range>, sampling: Sampling, rows: Option<u64>, seed: u64) -> Result<Self, String> {
        if sampling == Sampling::Grid {
            let mut strides = vec![1; ranges.len()];
            let mut count = 1_u64;
            for (stride, range) in strides.iter_mut().zip(&ranges).rev() {
                *stride = count;
                let values = range.count().ok_or("a grid needs a list, or `values`, for every parameter")?;
                count = count.checked_mul(values).ok_or("the grid has more points than can be counted")?;
            }
            return match rows {
                Some(rows) if rows != count => {
                    Err(format!("the grid has {count} points, not {rows}: leave `rows` out or change the lists"))
                }
                _ => Ok(Self { ranges, rows: count, seed, way: Way::Grid(strides) }),
            };
        }
        let rows = rows.ok_or("how many rows? Write `rows = 1000`; only a grid says so itself")?;
        let way = match sampling {
            Sampling::LatinHypercube => {
                let order = |stream: usize| Permutation::new(rows, seed, stream as u64);
                Way::LatinHypercube((0..ranges.len()).map(order).collect())
            }
            Sampling::Sobol if ranges.len() > Sequence::DIMENSIONS => {
                return Err(format!("Sobol's sequence has at most {} parameters", Sequence::DIMENSIONS));
            }
            Sampling::Sobol => Way::Sobol(Sequence::new(ranges.len(), seed)),
            _ => Way::Random,
        };
        Ok(Self { ranges, rows, seed, way })
    }

    /// How many rows there are.
    pub(crate) fn rows(&self) -> u64 {
        self.rows
    }

    /// The value of one parameter in one row.
    pub(crate) fn at(&self, row: u64, parameter: usize) -> f64 {
        let range = &self.ranges[parameter];
        let random = |counter| unit(bits(self.seed, parameter as u64, counter));
        match &self.way {
            Way::Random => range.quantile(random(row)),
            Way::LatinHypercube(orders) => {
                let slice = orders[parameter].at(row) as f64;
                let share = (slice + random(row)) / self.rows as f64;
                range.quantile(share.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0))
            }
            Way::Sobol(sequence) => range.quantile(unit(sequence.bits(row, parameter))),
            Way::Grid(strides) => match range {
                Range::List(values) => values[(row / strides[parameter]) as usize % values.len()],
                other => other.quantile(0.5),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_latin_hypercube_has_one_value_in_every_slice() {
        let ranges = vec![Range::Uniform { from: 0.0, to: 100.0 }; 3];
        let sampler = Sampler::new(ranges, Sampling::LatinHypercube, Some(100), 9).expect("it makes sense");
        for parameter in 0..3 {
            let mut slices: Vec<u64> = (0..100).map(|row| sampler.at(row, parameter) as u64).collect();
            slices.sort_unstable();
            assert!(slices.into_iter().eq(0..100));
        }
    }

    #[test]
    fn a_grid_counts_and_its_last_parameter_changes_fastest() {
        let ranges = vec![Range::List(vec![1.0, 2.0]), Range::Fixed(7.0), Range::List(vec![3.0, 4.0, 5.0])];
        let sampler = Sampler::new(ranges, Sampling::Grid, None, 0).expect("it makes sense");
        let rows: Vec<[f64; 3]> = (0..sampler.rows()).map(|row| [0, 1, 2].map(|k| sampler.at(row, k))).collect();
        assert_eq!(rows[..4], [[1.0, 7.0, 3.0], [1.0, 7.0, 4.0], [1.0, 7.0, 5.0], [2.0, 7.0, 3.0]]);
        assert_eq!(rows.len(), 6);
    }

    #[test]
    fn rows_are_needed_but_for_grids_and_grids_need_lists() {
        let wrong = |sampling, rows| Sampler::new(vec![Range::Uniform { from: 0.0, to: 1.0 }], sampling, rows, 0).err();
        assert!(wrong(Sampling::Random, None).is_some_and(|text| text.contains("rows = 1000")));
        assert!(wrong(Sampling::Grid, None).is_some_and(|text| text.contains("a list")));
        let ranges = vec![Range::steps(0.0, 1.0, 3)];
        let counted = Sampler::new(ranges, Sampling::Grid, Some(4), 0).err();
        assert!(counted.is_some_and(|text| text.contains("3 points, not 4")));
    }
}
