//! All simple-revolute kinematic chains with one degree of freedom, as graphs: links are vertices, joints edges.

/// A kinematic chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    pub links: usize,
    /// The two links of every joint.
    pub joints: Vec<[usize; 2]>,
}

impl Chain {
    /// A single loop.
    fn cycle(links: usize) -> Self {
        Self { links, joints: (0..links).map(|k| [k, (k + 1) % links]).collect() }
    }

    /// With a path of `interior` new links from `a` to `b`.
    fn with_ear(&self, a: usize, b: usize, interior: usize) -> Self {
        let mut out = self.clone();
        let mut last = a;
        for new in self.links..self.links + interior {
            out.joints.push([last, new]);
            last = new;
        }
        out.joints.push([last, b]);
        out.links += interior;
        out
    }

    /// The links joined to `link`.
    pub fn neighbours(&self, link: usize) -> Vec<usize> {
        let other = |joint: &[usize; 2]| match *joint {
            [a, b] if a == link => Some(b),
            [a, b] if b == link => Some(a),
            _ => None,
        };
        self.joints.iter().filter_map(other).collect()
    }

    pub fn joined(&self, a: usize, b: usize) -> bool {
        self.joints.contains(&[a, b]) || self.joints.contains(&[b, a])
    }

    /// 3(n − 1) − 2j of the links in `subset` with the joints among them.
    pub fn mobility(&self, subset: u32) -> i64 {
        let within = |joint: &&[usize; 2]| joint.iter().all(|&link| subset >> link & 1 == 1);
        let joints = self.joints.iter().filter(within).count();
        3 * (i64::from(subset.count_ones()) - 1) - 2 * joints as i64
    }

    /// No part of it is rigid or more.
    fn every_part_moves(&self) -> bool {
        (1..1_u32 << self.links).filter(|subset| subset.count_ones() > 1).all(|subset| self.mobility(subset) >= 1)
    }

    /// It hangs together without any one of its links.
    fn is_biconnected(&self) -> bool {
        (0..self.links).all(|left_out| {
            let first = usize::from(left_out == 0);
            let mut reached = 1_u32 << first | 1 << left_out;
            let mut front = vec![first];
            while let Some(link) = front.pop() {
                for next in self.neighbours(link) {
                    if reached >> next & 1 == 0 {
                        reached |= 1 << next;
                        front.push(next);
                    }
                }
            }
            reached.count_ones() as usize == self.links
        })
    }

    /// The definition: one degree of freedom, no part rigid, every link in a loop, nothing that hangs on one link only.
    pub fn is_sound(&self) -> bool {
        let all = (1 << self.links) - 1;
        self.mobility(all) == 1
            && (0..self.links).all(|link| self.neighbours(link).len() >= 2)
            && self.every_part_moves()
            && self.is_biconnected()
    }

    /// Every renaming of the links of `self` that makes it `other`.
    pub fn isomorphisms(&self, other: &Self) -> Vec<Vec<usize>> {
        let mut out = Vec::new();
        if self.links == other.links && self.joints.len() == other.joints.len() {
            self.extend(other, &mut Vec::new(), &mut out);
        }
        out
    }

    fn extend(&self, other: &Self, map: &mut Vec<usize>, out: &mut Vec<Vec<usize>>) {
        let link = map.len();
        if link == self.links {
            return out.push(map.clone());
        }
        for image in 0..self.links {
            let same = || (0..link).all(|k| self.joined(k, link) == other.joined(map[k], image));
            if !map.contains(&image) && same() {
                map.push(image);
                self.extend(other, map, out);
                map.pop();
            }
        }
    }
}

/// All chains with `links` links, one of every isomorphism class: a graph is biconnected exactly when it is a cycle to
/// which paths between two different vertices were added one after another (Whitney 1932), and no part of one of the
/// graphs on that way is less mobile than it is at the end.
pub fn chains(links: usize) -> Vec<Chain> {
    let joints = (3 * links - 4) / 2;
    let mut grown: Vec<Chain> = (3..=links).map(Chain::cycle).filter(Chain::every_part_moves).collect();
    for _ in 0..joints - links {
        let mut next: Vec<Chain> = Vec::new();
        for chain in &grown {
            let ends = (0..chain.links).flat_map(|b| (0..b).map(move |a| (a, b)));
            for (a, b) in ends {
                for interior in 0..=links - chain.links {
                    let new = chain.with_ear(a, b, interior);
                    if new.every_part_moves() && !next.iter().any(|known| known.is_like(&new)) {
                        next.push(new);
                    }
                }
            }
        }
        grown = next;
    }
    grown.retain(|chain| chain.links == links);
    grown
}

impl Chain {
    /// Isomorphic; the links' degrees rule most out at once.
    fn is_like(&self, other: &Self) -> bool {
        let degrees = |chain: &Self| {
            let mut out: Vec<usize> = (0..chain.links).map(|link| chain.neighbours(link).len()).collect();
            out.sort_unstable();
            out
        };
        degrees(self) == degrees(other) && !self.isomorphisms(other).is_empty()
    }
}
