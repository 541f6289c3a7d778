//! Sines and cosines, of several angles at once: their recurrences are the same, so that they go side by side in lanes.

/// Angles side by side.
pub(in crate::series) const LANES: usize = 4;

/// A number for every angle.
pub(in crate::series) type Lanes = [f64; LANES];

/// What is kept of one order: i x_i, and the coefficients of sine and cosine.
#[derive(Clone, Copy)]
pub(in crate::series) struct Pairs {
    x: Lanes,
    pub(in crate::series) sin: Lanes,
    pub(in crate::series) cos: Lanes,
}

/// Numbers in it.
pub(in crate::series) const KEPT: usize = 3 * LANES;

/// Pairs of every order, one after another, as they are kept: s = sin x, c = cos x, from s′ = c x′, c′ = −s x′.
pub(in crate::series) trait Turning {
    /// Those of an order.
    fn at(&self, k: usize) -> Pairs;
    /// Replaces them.
    fn put(&mut self, k: usize, pairs: Pairs);
    /// Σ x_i c_{k−i} and Σ x_i s_{k−i} over 1 < i < k − 1.
    fn middle(&self, k: usize) -> [Lanes; 2];

    /// The values at τ = 0.
    #[inline(always)]
    fn start(&mut self, sin: Lanes, cos: Lanes) {
        self.put(0, Pairs { x: [0.0; LANES], sin, cos });
    }

    /// The k-th coefficients, k ≥ 1, from those of the angles and all lower ones.
    #[inline(always)]
    fn step(&mut self, k: usize, x: Lanes) -> Pairs {
        let (first, last) = (self.at(0), self.at(k - 1));
        let pairs = self.after(k, first, last, x);
        self.put(k, pairs);
        pairs
    }

    /// The same for k ≥ 3, where those of the order before change first, as those of the angles do by `d`; and the
    /// changes.
    ///
    /// The k-th are linear in d, too. So everything else is summed without it, and whoever waits for d waits for one
    /// product and one sum.
    #[inline(always)]
    fn correct_and_step(&mut self, k: usize, d: Lanes, x: Lanes) -> [Pairs; 2] {
        let (first, second, last) = (self.at(0), self.at(1), self.at(k - 1));
        let (before, part) = ((k - 1) as f64, 1.0 / k as f64);
        let change = Pairs { x: scaled(before, d), sin: times(first.cos, d), cos: times(opposite(first.sin), d) };
        let sum = |a: Lanes, b: Lanes, c: Lanes| scaled(part, minus(scaled(before, a), times(b, c)));
        let by_d = [sum(second.cos, second.x, first.sin), opposite(sum(second.sin, opposite(second.x), first.cos))];
        let still = self.after(k, first, last, x);
        let found =
            Pairs { x: still.x, sin: plus(still.sin, times(by_d[0], d)), cos: plus(still.cos, times(by_d[1], d)) };
        let last =
            Pairs { x: plus(last.x, change.x), sin: plus(last.sin, change.sin), cos: plus(last.cos, change.cos) };
        self.put(k - 1, last);
        self.put(k, found);
        [change, found]
    }

    /// The k-th coefficients, given the first ones and those before.
    #[inline(always)]
    fn after(&self, k: usize, first: Pairs, last: Pairs, x: Lanes) -> Pairs {
        let x = scaled(k as f64, x);
        // Sums of products with cosines and with sines.
        let terms = |x: Lanes, pairs: &Pairs| [times(x, pairs.cos), times(x, pairs.sin)];
        let add = |[a, b]: [Lanes; 2], [c, d]: [Lanes; 2]| [plus(a, c), plus(b, d)];
        let mut sums = if k > 1 { terms(last.x, &self.at(1)) } else { terms(x, &first) };
        if k > 2 {
            sums = add(terms(self.at(1).x, &last), sums);
        }
        if k > 3 {
            sums = add(self.middle(k), sums);
        }
        // Angles are mostly coordinates, whose new coefficient is what is asked for.
        if k > 1 && x.iter().any(|x| *x != 0.0) {
            sums = add(terms(x, &first), sums);
        }
        let [of_cos, of_sin] = sums;
        let part = 1.0 / k as f64;
        Pairs { x, sin: scaled(part, of_cos), cos: scaled(-part, of_sin) }
    }
}

#[inline(always)]
fn plus(a: Lanes, b: Lanes) -> Lanes {
    core::array::from_fn(|lane| a[lane] + b[lane])
}

#[inline(always)]
fn times(a: Lanes, b: Lanes) -> Lanes {
    core::array::from_fn(|lane| a[lane] * b[lane])
}

#[inline(always)]
fn minus(a: Lanes, b: Lanes) -> Lanes {
    core::array::from_fn(|lane| a[lane] - b[lane])
}

#[inline(always)]
fn scaled(factor: f64, a: Lanes) -> Lanes {
    core::array::from_fn(|lane| factor * a[lane])
}

#[inline(always)]
fn opposite(a: Lanes) -> Lanes {
    core::array::from_fn(|lane| -a[lane])
}

/// In registers.
impl<const N: usize> Turning for [Pairs; N] {
    #[inline(always)]
    fn at(&self, k: usize) -> Pairs {
        self[k]
    }

    #[inline(always)]
    fn put(&mut self, k: usize, pairs: Pairs) {
        self[k] = pairs;
    }

    #[inline(always)]
    fn middle(&self, k: usize) -> [Lanes; 2] {
        let mut sums = [[0.0; LANES]; 2];
        for i in 2..N {
            if i + 1 < k {
                let (x, other) = (self[i].x, self[k - i]);
                sums = [plus(sums[0], times(x, other.cos)), plus(sums[1], times(x, other.sin))];
            }
        }
        sums
    }
}

/// On a tape.
impl Turning for [[f64; KEPT]] {
    #[inline(always)]
    fn at(&self, k: usize) -> Pairs {
        from(&self[k])
    }

    #[inline(always)]
    fn put(&mut self, k: usize, pairs: Pairs) {
        pairs.keep(&mut self[k]);
    }

    #[inline(always)]
    fn middle(&self, k: usize) -> [Lanes; 2] {
        let mut sums = [[0.0; LANES]; 2];
        let inner = &self[2..k - 1];
        for (one, other) in inner.iter().zip(inner.iter().rev()) {
            let (x, other) = (from(one).x, from(other));
            sums = [plus(sums[0], times(x, other.cos)), plus(sums[1], times(x, other.sin))];
        }
        sums
    }
}

#[inline(always)]
fn from(kept: &[f64; KEPT]) -> Pairs {
    let part = |first: usize| core::array::from_fn(|lane| kept[first + lane]);
    Pairs { x: part(0), sin: part(LANES), cos: part(2 * LANES) }
}

impl Pairs {
    /// Nothing.
    pub(in crate::series) const ZERO: Self = Self { x: [0.0; LANES], sin: [0.0; LANES], cos: [0.0; LANES] };

    /// Writes it down.
    #[inline(always)]
    pub(in crate::series) fn keep(&self, kept: &mut [f64; KEPT]) {
        for lane in 0..LANES {
            kept[lane] = self.x[lane];
            kept[LANES + lane] = self.sin[lane];
            kept[2 * LANES + lane] = self.cos[lane];
        }
    }
}

/// `list` from place `first` on; its last number again where there is none.
#[inline(always)]
pub(in crate::series) fn lanes(first: usize, count: usize, list: impl Fn(usize) -> f64) -> Lanes {
    core::array::from_fn(|lane| list((first + lane).min(count - 1)))
}
