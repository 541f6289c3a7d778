//! A platform on three legs, followed by an arc-length continuation that is independent of kin. The legs are driven
//! cranks with links, or cylinders.

use crate::arithmetic::{along, determinant, dot, solve};
use crate::jet::Jet;
use kin_tests::random::Random;

/// The largest step along the arc, and the largest change of its direction in one step.
const STEP: f64 = 0.03;
const TURN: f64 = 0.03;

/// The positions of ground pins, the lengths of cranks and links, and the pins on the platform. The angles of the cranks
/// are `start` + `rate` s, and the lengths of the links are `l` + `stroke` s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rig {
    pub(crate) x: [f64; 3],
    pub(crate) y: [f64; 3],
    pub(crate) r: [f64; 3],
    pub(crate) l: [f64; 3],
    pub(crate) px: [f64; 3],
    pub(crate) py: [f64; 3],
    pub(crate) start: [f64; 3],
    pub(crate) rate: [f64; 3],
    pub(crate) stroke: [f64; 3],
    /// The pose of the platform at s = 0.
    pub(crate) pose: [f64; 3],
}

/// The solution curve from s = 0 on: points (x, y, φ, s) and directions.
#[derive(Clone, Debug)]
pub(crate) struct Arc {
    nodes: Vec<([f64; 4], [f64; 4])>,
    /// The s at which the curve turns back.
    pub(crate) fold: Option<f64>,
}

impl Rig {
    /// A random platform with cranks that assembles, far from singular poses.
    pub(crate) fn drawn(random: &mut Random) -> Self {
        Self::drawn_with(random, false)
    }

    /// A random platform on three cylinders that assembles, far from singular poses.
    pub(crate) fn of_cylinders(random: &mut Random) -> Self {
        Self::drawn_with(random, true)
    }

    fn drawn_with(random: &mut Random, cylinders: bool) -> Self {
        loop {
            let mut three = |low: f64, high: f64| -> [f64; 3] { std::array::from_fn(|_| random.between(low, high)) };
            let (dx, dy, r, start) = (three(-0.2, 0.2), three(-0.2, 0.2), three(0.2, 0.45), three(-3.0, 3.0));
            let (px, py) = (three(-0.25, 0.25), three(-0.25, 0.25));
            let (rate, [x, y, phi]) = (three(-1.0, 1.0), three(-0.3, 0.3));
            let mut rig = Self {
                x: [dx[0], 1.0 + dx[1], 0.5 + dx[2]],
                y: [dy[0], dy[1], 0.9 + dy[2]],
                r,
                l: [0.0; 3],
                px,
                py,
                start,
                rate,
                stroke: [0.0; 3],
                pose: [x + 0.5, y + 0.3, 5.0 * phi],
            };
            if cylinders {
                (rig.r, rig.rate, rig.stroke) = ([0.0; 3], [0.0; 3], rate);
            }
            let z = [rig.pose[0], rig.pose[1], rig.pose[2], 0.0];
            rig.l = rig.links(z.map(Jet::from)).map(|[x, y]| x.x.hypot(y.x));
            let rows = rig.rows(&z);
            let size: f64 = rows.iter().map(|row| row[0].hypot(row[1])).product();
            let tilt = rig.px[0] * (rig.py[1] - rig.py[2])
                + rig.px[1] * (rig.py[2] - rig.py[0])
                + rig.px[2] * (rig.py[0] - rig.py[1]);
            let fast = rate.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
            let det = determinant(std::array::from_fn(|i| std::array::from_fn(|k| rows[i][k])));
            let fair = rig.l.iter().all(|l| (0.25..1.2).contains(l));
            if fair && det.abs() > 0.05 * size && tilt.abs() > 0.02 && fast > 0.5 {
                return rig;
            }
        }
    }

    /// The angles of the cranks.
    pub(crate) fn cranks(&self, s: Jet) -> [Jet; 3] {
        std::array::from_fn(|i| s * self.rate[i] + self.start[i])
    }

    /// The positions of the pins on the platform.
    fn pins(&self, [x, y, phi]: [Jet; 3]) -> [[Jet; 2]; 3] {
        let (sin, cos) = (phi.sin(), phi.cos());
        std::array::from_fn(|i| {
            let (px, py) = (self.px[i], self.py[i]);
            [x + cos * px - sin * py, y + sin * px + cos * py]
        })
    }

    /// The positions of the ends of the cranks.
    pub(crate) fn ends(&self, s: Jet) -> [[Jet; 2]; 3] {
        let cranks = self.cranks(s);
        std::array::from_fn(|i| [cranks[i].cos() * self.r[i] + self.x[i], cranks[i].sin() * self.r[i] + self.y[i]])
    }

    /// The vectors along the links.
    pub(crate) fn links(&self, [x, y, phi, s]: [Jet; 4]) -> [[Jet; 2]; 3] {
        let (pins, ends) = (self.pins([x, y, phi]), self.ends(s));
        std::array::from_fn(|i| [pins[i][0] - ends[i][0], pins[i][1] - ends[i][1]])
    }

    /// The lengths of the links.
    pub(crate) fn lengths(&self, s: Jet) -> [Jet; 3] {
        std::array::from_fn(|i| s * self.stroke[i] + self.l[i])
    }

    /// The residuals ½ (|link|² − l²), where the lengths of the links are increased by the relative amounts `off` times
    /// 1, 2, 3.
    fn gaps(&self, z: [Jet; 4], off: f64) -> [Jet; 3] {
        let (links, lengths) = (self.links(z), self.lengths(z[3]));
        std::array::from_fn(|i| {
            let ([x, y], l) = (links[i], lengths[i] * (1.0 + off * (i + 1) as f64));
            (x * x + y * y - l * l) * 0.5
        })
    }

    /// The derivatives of the residuals with respect to x, y, φ and s.
    fn rows(&self, z: &[f64; 4]) -> [[f64; 4]; 3] {
        let mut rows = [[0.0; 4]; 3];
        for k in 0..4 {
            let moved = std::array::from_fn(|j| Jet::new(z[j], if j == k { 1.0 } else { 0.0 }, 0.0));
            let gaps = self.gaps(moved, 0.0);
            rows.iter_mut().zip(gaps).for_each(|(row, gap)| row[k] = gap.v);
        }
        rows
    }

    /// Corrects z to a root of the residuals, perpendicularly to `across`. Returns also the length of the correction.
    fn close(&self, mut z: [f64; 4], across: &[f64; 4], off: f64) -> Option<([f64; 4], f64)> {
        let (mut way, mut before) = (0.0, f64::INFINITY);
        for _ in 0..20 {
            let gaps = self.gaps(z.map(Jet::from), off);
            let [a, b, c] = self.rows(&z);
            let step = solve([a, b, c, *across], [-gaps[0].x, -gaps[1].x, -gaps[2].x, 0.0])?;
            z = along(&z, 1.0, &step);
            let length = dot(&step, &step).sqrt();
            way += length;
            // The iteration ends at the level of rounding, which is higher near a singular pose.
            if length < 1e-15 || length > 0.1 * before && length < 1e-8 {
                return Some((z, way));
            }
            before = length;
        }
        None
    }

    /// The direction of the curve, on the side of `before`.
    fn direction(&self, z: &[f64; 4], before: &[f64; 4]) -> [f64; 4] {
        let rows = self.rows(z);
        let minor = |k: usize| -> f64 {
            determinant(std::array::from_fn(|i| std::array::from_fn(|j| rows[i][if j < k { j } else { j + 1 }])))
        };
        let direction = [minor(0), -minor(1), minor(2), -minor(3)];
        let size = dot(&direction, &direction).sqrt().copysign(dot(&direction, before));
        direction.map(|x| x / size)
    }

    /// Follows the curve until s is `until` or turns back.
    pub(crate) fn arc(&self, until: f64) -> Option<Arc> {
        let z = [self.pose[0], self.pose[1], self.pose[2], 0.0];
        let mut node = (z, self.direction(&z, &[0.0, 0.0, 0.0, 1.0]));
        let mut nodes = vec![node];
        let mut h = STEP;
        while node.0[3] < until {
            let next = self.close(along(&node.0, h, &node.1), &node.1, 0.0).and_then(|(z, way)| {
                let direction = self.direction(&z, &node.1);
                (way < 0.1 * h && dot(&direction, &node.1) > TURN.cos()).then_some((z, direction))
            });
            let Some(next) = next else {
                h *= 0.5;
                if h < 1e-9 {
                    return None;
                }
                continue;
            };
            if next.1[3] <= 0.0 {
                let fold = self.turning(&node, h)?;
                nodes.push(fold);
                return Some(Arc { nodes, fold: Some(fold.0[3]) });
            }
            node = next;
            nodes.push(node);
            h = (1.5 * h).min(STEP);
        }
        Some(Arc { nodes, fold: None })
    }

    /// The times at which a motion s = `reach` sin t passes a fold.
    pub(crate) fn folds(arc: &Arc, reach: f64) -> Vec<f64> {
        let fold = arc.fold.filter(|fold| *fold < reach).map(|fold| (fold / reach).asin());
        fold.map_or(vec![], |t| vec![t, std::f64::consts::PI - t])
    }

    /// The point within the distance `h` of a node at which s turns back.
    fn turning(&self, node: &([f64; 4], [f64; 4]), h: f64) -> Option<([f64; 4], [f64; 4])> {
        let (mut low, mut high) = (0.0, h);
        let mut found = *node;
        while high - low > 1e-13 {
            let middle = 0.5 * (low + high);
            let (z, _) = self.close(along(&node.0, middle, &node.1), &node.1, 0.0)?;
            let direction = self.direction(&z, &node.1);
            if direction[3] > 0.0 {
                low = middle
            } else {
                high = middle
            }
            found = (z, direction);
        }
        Some(found)
    }

    /// The pose of the platform with its rates, for s with its rates.
    pub(crate) fn pose(&self, arc: &Arc, s: Jet, off: f64) -> Option<[Jet; 3]> {
        if arc.fold.is_some_and(|fold| s.x >= fold) {
            return None;
        }
        let next = arc.nodes.iter().position(|(z, _)| z[3] >= s.x)?.max(1);
        let z = between(&arc.nodes[next - 1], &arc.nodes[next], s.x);
        let still = [0.0, 0.0, 0.0, 1.0];
        let (z, way) = self.close(z, &still, 0.0)?;
        // The Hermite interpolation is accurate, so that a larger correction would lead to another solution.
        if way > 1e-3 {
            return None;
        }
        let side = self.side(&z);
        let (z, way) = if off == 0.0 { (z, 0.0) } else { self.close(z, &still, off)? };
        if way > 1e-3 || side * self.side(&z) <= 0.0 {
            return None;
        }
        let rows = self.rows(&z).map(|row| [row[0], row[1], row[2]]);
        let at = |v: [f64; 3], a: [f64; 3]| {
            let moved = |k: usize| Jet::new(z[k], v[k], a[k]);
            self.gaps([moved(0), moved(1), moved(2), s], off)
        };
        let v = solve(rows, at([0.0; 3], [0.0; 3]).map(|gap| -gap.v))?;
        let a = solve(rows, at(v, [0.0; 3]).map(|gap| -gap.a))?;
        Some(std::array::from_fn(|k| Jet::new(z[k], v[k], a[k])))
    }

    /// The determinant at the pose, relative to the sizes of its rows: 0 at singular poses.
    pub(crate) fn relative_side(&self) -> f64 {
        let z = [self.pose[0], self.pose[1], self.pose[2], 0.0];
        let size: f64 = self.rows(&z).iter().map(|row| row[0].hypot(row[1])).product();
        self.side(&z) / size
    }

    /// The sign of a determinant that changes at singular poses.
    fn side(&self, z: &[f64; 4]) -> f64 {
        let rows = self.rows(z);
        determinant(std::array::from_fn(|i| std::array::from_fn(|k| rows[i][k])))
    }
}

/// The point with this s on the Hermite cubic between two nodes.
fn between((from, out): &([f64; 4], [f64; 4]), (to, into): &([f64; 4], [f64; 4]), s: f64) -> [f64; 4] {
    let gap: [f64; 4] = std::array::from_fn(|k| to[k] - from[k]);
    let h = dot(&gap, &gap).sqrt();
    let at = |u: f64| -> [f64; 4] {
        let (v, w) = (u * u * (3.0 - 2.0 * u), u * (1.0 - u));
        std::array::from_fn(|k| from[k] + gap[k] * v + h * w * ((1.0 - u) * out[k] - u * into[k]))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at(middle)[3] < s { low = middle } else { high = middle }
    }
    let mut z = at(low);
    z[3] = s;
    z
}
