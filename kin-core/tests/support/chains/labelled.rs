//! The chains with a number of links counted straight from the definition, as graphs whose vertices have names. It
//! shares nothing with the enumeration that grows them.

struct Count {
    links: usize,
    /// Pairs of links, in order.
    pairs: Vec<[usize; 2]>,
    /// The neighbours of every link, as a set.
    neighbours: Vec<u32>,
    /// The number of joints within every set of links.
    within: Vec<u8>,
    /// The most that it may have: 3(n − 1) − 2j ≥ 1.
    most: Vec<u8>,
    found: usize,
}

/// The number of labelled graphs that are chains of one degree of freedom with `links` links.
pub fn labelled_chains(links: usize) -> usize {
    let sets = 1_u32 << links;
    let mut count = Count {
        links,
        pairs: (0..links).flat_map(|a| (a + 1..links).map(move |b| [a, b])).collect(),
        neighbours: vec![0; links],
        within: vec![0; sets as usize],
        most: (0..sets).map(|set| ((3 * set.count_ones()).saturating_sub(4) / 2) as u8).collect(),
        found: 0,
    };
    count.decide(0, (3 * links - 4) / 2);
    count.found
}

impl Count {
    /// On the pairs from `next` on, of which `left` are to be joined.
    fn decide(&mut self, next: usize, left: usize) {
        if left == 0 {
            self.found += usize::from(self.is_in_loops());
            return;
        }
        let Some(&[a, b]) = self.pairs.get(next) else { return };
        // Nothing joins the links before this pair's any more.
        if self.pairs.len() - next < left || self.neighbours[..a].iter().any(|set| set.count_ones() < 2) {
            return;
        }
        self.decide(next + 1, left);
        if self.join(a, b, 1) {
            self.decide(next + 1, left - 1);
        }
        self.join(a, b, u8::MAX);
    }

    /// Joins two links, or with −1 parts them; true when no part has become rigid.
    fn join(&mut self, a: usize, b: usize, by: u8) -> bool {
        self.neighbours[a] ^= 1 << b;
        self.neighbours[b] ^= 1 << a;
        let both = 1 << a | 1 << b;
        let rest = (self.within.len() - 1) & !both;
        let (mut set, mut moves) = (rest, true);
        loop {
            let counted = &mut self.within[set | both];
            *counted = counted.wrapping_add(by);
            moves &= *counted <= self.most[set | both];
            if set == 0 {
                return moves;
            }
            set = (set - 1) & rest;
        }
    }

    /// Every link has two joints, and all hangs together without any one of them.
    fn is_in_loops(&self) -> bool {
        let all = (1_u32 << self.links) - 1;
        self.neighbours.iter().all(|set| set.count_ones() >= 2)
            && (0..self.links).all(|without| {
                let rest = all & !(1 << without);
                let mut reached = rest & rest.wrapping_neg();
                loop {
                    let joined = (0..self.links).filter(|link| reached >> link & 1 == 1);
                    let next = reached | joined.fold(0, |sum, link| sum | self.neighbours[link] & rest);
                    if next == reached {
                        return reached == rest;
                    }
                    reached = next;
                }
            })
    }
}
