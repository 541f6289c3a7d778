//! Unilateral conditions with syntax errors, or that depend on nothing that can change.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(slider)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = t)]
#[unilateral(a: slider.x >= 1)]
#[unilateral(b: slider.x <= 1)]
#[unilateral(c: slider.x == 1)]
#[unilateral(d: slider.x = 1)]
#[unilateral(e: slider.x != 1)]
#[unilateral(f: slider.x => 1)]
#[unilateral(g: slider.x >> 1)]
#[unilateral(h: slider.x)]
#[unilateral(i: slider.x, 1)]
#[unilateral(j: 0 < slider.x < 1)]
#[unilateral(k: slider.x < 1 > 0)]
#[unilateral(l: slider.x <)]
#[unilateral(m: < slider.x)]
#[unilateral(n: slider.x < 1, stop = 1)]
#[unilateral(o: slider.x 2 < 1)]
#[unilateral(p: slider.x < 1 2)]
#[unilateral(q: slider.x * < 1 +)]
#[unilateral(slider.x < 1)]
#[unilateral(r)]
#[unilateral(s:)]
#[unilateral()]
#[unilateral]
#[unilateral(u: (slider.x < 1))]
#[unilateral(v: slider.x & slider.y > 0)]
#[unilateral(w: slider.x >= sldr.x)]
#[unilateral(x: pow(slider.x) > 1 deg)]
#[inequality(y: slider.x < 1)]
#[unilatral(z: slider.x < 1)]
struct Form;

#[mechanism]
#[bodies(slider)]
#[body(held, x = l, y = 0, phi = 0)]
#[body(carried, origin = held @ (1, 0), phi = 2)]
#[point(P = carried @ (l, 0))]
#[define(size = 2 * l)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = t)]
#[unilateral(a: l > 0)]
#[unilateral(b: 1 < 2)]
#[unilateral(c: held.x + size < 3)]
#[unilateral(d: P.x > carried.y)]
#[unilateral(e: distance(P, held @ (0, 0)) > l)]
#[unilateral(guide: slider.x < 1)]
#[unilateral(twice: slider.x < 1)]
#[unilateral(twice: slider.x > 0)]
#[unilateral(f: slidr.x < ll)]
#[unilateral(g: slider < P)]
#[unilateral(h: slider.x / 0 < 1)]
#[unilateral(rate: dot(slider.x) < 1)]
#[unilateral(good: slider.x < size)]
#[unilateral(timed: l > t)]
struct Meaning {
    l: f64,
}

#[mechanism]
#[bodies(link[3])]
#[revolute(A[i in 0..3]: ground @ (0, 0), link[i] @ (0, 0))]
#[unilateral(a[i in 0..4]: link[i].phi > 0)]
#[unilateral(b[3]: link[0].phi > 0)]
#[unilateral(c[i in 0..3]: link[j].phi > 0)]
#[unilateral(d[i in 2..2]: link[i].phi > 0)]
#[unilateral(e: link.phi > 0)]
#[unilateral(e[i in 0..3]: link[i].phi > l[i])]
struct Families {
    l: [f64; 3],
}

/// A unilateral condition does not count as a row that holds a body.
#[mechanism]
#[bodies(slider, ghost)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = t)]
#[unilateral(a: ghost.x < slider.x)]
struct Ghost;

fn main() {}
