//! A map from expressions to values, indexed by expression id.

use super::ExprId;

/// A map whose lookup is an array access, which is fast even without compiler optimisation.
#[derive(Clone, Debug)]
pub(crate) struct IdMap<V> {
    /// For every expression, 0 or the index of its value plus one.
    slots: Vec<u32>,
    ids: Vec<ExprId>,
    values: Vec<V>,
}

impl<V> Default for IdMap<V> {
    fn default() -> Self {
        Self { slots: Vec::new(), ids: Vec::new(), values: Vec::new() }
    }
}

impl<V> IdMap<V> {
    fn slot(&self, id: ExprId) -> u32 {
        let index = id.index();
        if index < self.slots.len() { self.slots[index] } else { 0 }
    }

    /// The value of `id`, if there is one.
    pub(crate) fn get(&self, id: ExprId) -> Option<&V> {
        match self.slot(id) {
            0 => None,
            slot => Some(&self.values[slot as usize - 1]),
        }
    }

    /// Whether `id` has a value.
    pub(crate) fn contains(&self, id: ExprId) -> bool {
        self.slot(id) != 0
    }

    /// Sets the value of `id`.
    pub(crate) fn insert(&mut self, id: ExprId, value: V) {
        let index = id.index();
        if index >= self.slots.len() {
            let mut longer = vec![0; (2 * self.slots.len()).max(index + 1).max(64)];
            longer[..self.slots.len()].copy_from_slice(&self.slots);
            self.slots = longer;
        }
        match self.slots[index] {
            0 => {
                self.ids.push(id);
                self.values.push(value);
                self.slots[index] = self.values.len() as u32;
            }
            slot => self.values[slot as usize - 1] = value,
        }
    }

    /// Removes all values, in time proportional to their number.
    pub(crate) fn clear(&mut self) {
        let mut k = 0;
        while k < self.ids.len() {
            self.slots[self.ids[k].index()] = 0;
            k += 1;
        }
        self.ids.clear();
        self.values.clear();
    }

    /// All values, in the order in which their expressions were first inserted.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (ExprId, &V)> {
        self.ids.iter().copied().zip(&self.values)
    }
}

impl<V: Copy> IdMap<V> {
    /// The value of `id`, or `otherwise` if there is none.
    pub(crate) fn or(&self, id: ExprId, otherwise: V) -> V {
        match self.slot(id) {
            0 => otherwise,
            slot => self.values[slot as usize - 1],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_forgotten_is_not_known_and_what_is_told_twice_is_the_later() {
        let mut map = IdMap::default();
        for k in [900, 3, 70, 3] {
            map.insert(ExprId(k), k + map.iter().count() as u32);
        }
        assert_eq!([900, 3, 70].map(|k| map.get(ExprId(k)).copied()), [Some(900), Some(6), Some(72)]);
        assert!(!map.contains(ExprId(4)) && map.get(ExprId(5000)).is_none() && map.or(ExprId(71), 1) == 1);
        assert_eq!(map.iter().map(|(id, _)| id.0).collect::<Vec<_>>(), [900, 3, 70]);
        map.clear();
        assert!((0..1000).all(|k| !map.contains(ExprId(k))));
        map.insert(ExprId(70), 1);
        assert_eq!(map.or(ExprId(70), 0), 1);
    }
}
