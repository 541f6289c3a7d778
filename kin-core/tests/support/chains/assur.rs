//! What a chain decomposes into once its ground and driven link are known (Assur 1914): groups of links whose positions
//! follow from those of the links before them, each group without a smaller one inside.

use super::{Chain, chains};
use std::fmt;

/// A chain with a ground link and a driven link beside it.
#[derive(Clone, Debug)]
pub struct Case {
    pub chain: Chain,
    pub ground: usize,
    pub driven: usize,
    /// Number of the chain among those with as many links.
    pub number: usize,
}

/// Every ground link and every joint of it as the driver, of every chain with `links` links.
pub fn cases(links: usize) -> Vec<Case> {
    let mut out = Vec::new();
    for (number, chain) in chains(links).into_iter().enumerate() {
        for ground in 0..links {
            for driven in chain.neighbours(ground) {
                out.push(Case { chain: chain.clone(), ground, driven, number });
            }
        }
    }
    out
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { chain, ground, driven, number } = self;
        write!(f, "{}-link chain {number} on link {ground}, driven at {driven}: {:?}", chain.links, chain.joints)
    }
}

impl Case {
    /// Ground and driven link are the same up to a renaming of links.
    pub fn is_like(&self, other: &Self) -> bool {
        if self.chain.links != other.chain.links || self.number != other.number {
            return false;
        }
        let mut maps = self.chain.isomorphisms(&other.chain).into_iter();
        maps.any(|map| map[self.ground] == other.ground && map[self.driven] == other.driven)
    }

    fn given(&self) -> u32 {
        1 << self.ground | 1 << self.driven
    }

    /// The dyads, as long as there is one: two links joined to each other, each joined to one link that is known
    /// already. And the number of links that are left over, which are in no dyad.
    pub fn dyads(&self) -> (Vec<[usize; 2]>, usize) {
        let mut known = self.given();
        let mut out = Vec::new();
        let reaches = |known: u32, link: usize| {
            let neighbours = self.chain.neighbours(link);
            known >> link & 1 == 0 && neighbours.iter().filter(|&&other| known >> other & 1 == 1).count() == 1
        };
        while let Some(&[a, b]) = self.chain.joints.iter().find(|pair| pair.iter().all(|&link| reaches(known, link))) {
            known |= 1 << a | 1 << b;
            out.push([a, b]);
        }
        (out, self.chain.links - known.count_ones() as usize)
    }

    pub fn is_dyad_only(&self) -> bool {
        self.dyads().1 == 0
    }

    /// The numbers of links of the groups in an order of solution: the smallest set of links whose joints with one
    /// another and with known links are just enough to place them, again and again.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let all = (1_u32 << self.chain.links) - 1;
        let mut known = self.given();
        let mut out = Vec::new();
        while known != all {
            let mut subsets: Vec<u32> = (1..=all).filter(|subset| subset & known == 0).collect();
            subsets.sort_by_key(|subset| subset.count_ones());
            let places = |subset: &u32| {
                let within = |link: &usize| (subset | known) >> link & 1 == 1;
                let meets = |link: &usize| subset >> link & 1 == 1;
                let counts = |joint: &&[usize; 2]| joint.iter().all(within) && joint.iter().any(meets);
                2 * self.chain.joints.iter().filter(counts).count() == 3 * subset.count_ones() as usize
            };
            let group = subsets.into_iter().find(places).expect("as many equations as unknowns in the end");
            known |= group;
            out.push((0..self.chain.links).filter(|link| group >> link & 1 == 1).collect());
        }
        out
    }
}
