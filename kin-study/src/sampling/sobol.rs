//! Sobol's sequence, of which any point is computed directly (direction numbers of Joe and Kuo, 2008).

use super::counter::bits;
use sobol::Sobol;
use sobol::params::JoeKuoD6;

/// Direction numbers, and a random shift of every dimension.
#[derive(Debug)]
pub(super) struct Sequence {
    directions: Vec<Vec<u64>>,
    shifts: Vec<u64>,
}

impl Sequence {
    /// Largest number of dimensions.
    pub(super) const DIMENSIONS: usize = 1000;

    /// The sequence in `dimensions` dimensions, at most [`DIMENSIONS`](Self::DIMENSIONS).
    pub(super) fn new(dimensions: usize, seed: u64) -> Self {
        let table = JoeKuoD6::standard();
        let directions = Sobol::<f64>::init_direction_vals(dimensions, u64::BITS as usize, &table);
        Self { directions, shifts: (0..dimensions as u64).map(|dimension| bits(seed, dimension, 0)).collect() }
    }

    /// 64 bits of the point at `row` in one dimension: a digital shift keeps the evenness of the sequence.
    pub(super) fn bits(&self, row: u64, dimension: usize) -> u64 {
        let directions = &self.directions[dimension];
        let mut rest = row;
        let mut value = self.shifts[dimension];
        while rest != 0 {
            value ^= directions[rest.trailing_zeros() as usize];
            rest &= rest - 1;
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_points_are_the_published_ones() {
        // Without its shift. The published points are in the order of the Gray code of the row.
        let sequence = Sequence { shifts: vec![0; 3], ..Sequence::new(3, 0) };
        let point = |row: u64| [0, 1, 2].map(|k| sequence.bits(row ^ (row >> 1), k) as f64 / 2.0_f64.powi(64));
        assert_eq!(point(0), [0.0; 3]);
        assert_eq!(point(1), [0.5; 3]);
        assert_eq!(point(2), [0.75, 0.25, 0.25]);
        assert_eq!(point(3), [0.25, 0.75, 0.75]);
        assert_eq!(point(4), [0.375, 0.375, 0.625]);
    }

    #[test]
    fn every_interval_of_a_power_of_two_holds_one_point() {
        let sequence = Sequence::new(8, 5);
        for dimension in 0..8 {
            let mut cells: Vec<u64> = (0..256).map(|row| sequence.bits(row, dimension) >> 56).collect();
            cells.sort_unstable();
            assert!(cells.into_iter().eq(0..256), "{dimension}");
        }
    }
}
