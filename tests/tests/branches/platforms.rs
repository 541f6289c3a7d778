//! Platforms on three driven cranks with links, or on three cylinders, that are moved to a singular pose and back, to
//! slightly before it or slightly beyond it. There is no closed form, so the reference is an arc-length continuation in
//! this test.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::rig::{Arc, Rig};
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;

/// A 3-RRR platform.
#[mechanism]
#[bodies(crank[3], link[3], platform)]
#[revolute(O[i in 0..3]: ground @ (x[i], y[i]), crank[i] @ (0, 0))]
#[revolute(A[i in 0..3]: crank[i] @ (r[i], 0), link[i] @ (0, 0))]
#[revolute(B[i in 0..3]: link[i] @ (l[i], 0), platform @ (px[i], py[i]))]
#[driver(drive[i in 0..3]: crank[i].phi = start[i] + rate[i] * reach * sin(t))]
#[derive(Clone, Debug)]
pub(crate) struct Platform {
    x: [f64; 3],
    y: [f64; 3],
    r: [f64; 3],
    l: [f64; 3],
    px: [f64; 3],
    py: [f64; 3],
    start: [f64; 3],
    rate: [f64; 3],
    reach: f64,
}

/// A 3-RPR platform.
#[mechanism]
#[bodies(platform)]
#[driver(ram[i in 0..3]: distance(ground @ (x[i], y[i]), platform @ (px[i], py[i])) = l[i] + stroke[i] * reach * sin(t))]
#[derive(Clone, Debug)]
struct Rams {
    x: [f64; 3],
    y: [f64; 3],
    l: [f64; 3],
    px: [f64; 3],
    py: [f64; 3],
    stroke: [f64; 3],
    reach: f64,
}

/// A platform with its arc, the amplitude of s = reach sin t, and the folds.
fn drawn(random: &mut Random, draw: fn(&mut Random) -> Rig) -> (Rig, Arc, f64, Vec<f64>) {
    loop {
        let rig = draw(random);
        let Some(arc) = rig.arc(2.5) else { continue };
        let reach = match arc.fold {
            // A fold at the start is excluded.
            Some(fold) if fold < 0.1 => continue,
            Some(fold) if random.chance(0.7) => fold * (1.0 + random.small(-10.0, -2.0)),
            Some(fold) => fold * random.between(0.9, 1.6),
            None => random.between(1.0, 2.4),
        };
        let folds = Rig::folds(&arc, reach);
        if rig.lengths(Jet::from(reach)).iter().any(|length| length.x < 0.1) {
            continue;
        }
        return (rig, arc, reach, folds);
    }
}

pub(crate) fn case(random: &mut Random) -> Case<Platform> {
    let (rig, arc, reach, folds) = drawn(random, Rig::drawn);
    let Rig { x, y, r, l, px, py, start, rate, pose, .. } = rig;
    let branch = move |t: f64, off: f64| {
        let s = (Jet::time(t) * (1.0 + off)).sin() * reach;
        let [x, y, phi] = rig.pose(&arc, s, off)?;
        let (cranks, ends, links) = (rig.cranks(s), rig.ends(s), rig.links([x, y, phi, s]));
        let mut q = Vec::new();
        (0..3).for_each(|i| q.extend([Jet::from(rig.x[i]), Jet::from(rig.y[i]), cranks[i]]));
        (0..3).for_each(|i| q.extend([ends[i][0], ends[i][1], links[i][1].atan2(links[i][0])]));
        q.extend([x, y, phi]);
        Some(q)
    };
    let mechanism = Platform { x, y, r, l, px, py, start, rate, reach };
    Case::new(mechanism, branch, [folds, vec![]], format!("pose {pose:?}"))
}

fn case_of_cylinders(random: &mut Random) -> Case<Rams> {
    let (rig, arc, reach, folds) = drawn(random, Rig::of_cylinders);
    on_cylinders(rig, arc, reach, folds)
}

fn on_cylinders(rig: Rig, arc: Arc, reach: f64, folds: Vec<f64>) -> Case<Rams> {
    let Rig { x, y, l, px, py, stroke, pose, .. } = rig;
    let branch = move |t: f64, off: f64| {
        let s = (Jet::time(t) * (1.0 + off)).sin() * reach;
        rig.pose(&arc, s, off).map(|pose| pose.to_vec())
    };
    let mechanism = Rams { x, y, l, px, py, stroke, reach };
    Case::new(mechanism, branch, [folds, vec![]], format!("pose {pose:?}"))
}

#[test]
fn platforms_near_singular_poses() {
    let (mut random, mut tally) = (Random::new(271), Tally::default());
    for _ in 0..motions(0.08).div_ceil(4) {
        let end = random.between(1.7, 3.1);
        let mut times = random.grid(end);
        random.hit(&mut times, std::f64::consts::FRAC_PI_2);
        let cases = (0..4).map(|_| case(&mut random)).collect();
        follow(&mut tally, &Group::new(times, cases));
    }
    tally.obeys("platforms");
}

/// With three cylinders, kin iterates on the position of the platform. In a step across two folds the platform may move
/// far without turning.
#[test]
fn platforms_on_cylinders() {
    let (mut random, mut tally) = (Random::new(272), Tally::default());
    for _ in 0..motions(0.08).div_ceil(4) {
        let end = random.between(1.7, 3.1);
        let mut times = if random.chance(0.5) { random.grid(end) } else { vec![0.0, 0.5 * end, end] };
        if random.chance(0.3) {
            random.hit(&mut times, std::f64::consts::FRAC_PI_2);
        }
        let cases = (0..4).map(|_| case_of_cylinders(&mut random)).collect();
        follow(&mut tally, &Group::new(times, cases));
    }
    tally.obeys("platforms on cylinders");
}

/// A 3-RPR platform that is moved along a straight line without turning.
#[mechanism]
#[bodies(platform)]
#[driver(ram[i in 0..3]: distance(ground @ (x[i], y[i]), platform @ (px[i], py[i]))
    = sqrt(pow(dx[i] + vx * t, 2) + pow(dy[i] + vy * t, 2)))]
#[derive(Clone, Debug)]
struct Carried {
    x: [f64; 3],
    y: [f64; 3],
    px: [f64; 3],
    py: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
    vx: f64,
    vy: f64,
}

/// A platform that moves by (vx, vy) t from the pose of the rig.
fn carried(rig: Rig, [vx, vy]: [f64; 2]) -> Case<Carried> {
    let Rig { x, y, px, py, pose: [x0, y0, phi], .. } = rig;
    let d = rig.links([x0, y0, phi, 0.0].map(Jet::from)).map(|[x, y]| [x.x, y.x]);
    let (dx, dy) = (d.map(|d| d[0]), d.map(|d| d[1]));
    let branch = move |t: f64, off: f64| {
        let t = Jet::time(t) * (1.0 + off);
        Some(vec![t * vx + x0, t * vy + y0, Jet::from(phi)])
    };
    Case::new(Carried { x, y, px, py, dx, dy, vx, vy }, branch, [vec![], vec![]], String::new())
}

/// Where nothing turns, rates of angles tell nothing of how near a crossing is.
#[test]
fn platforms_that_translate() {
    let (mut random, mut tally) = (Random::new(273), Tally::default());
    let times: Vec<f64> = (0..=10).map(|k| 0.1 * f64::from(k)).collect();
    let mut left = motions(0.2);
    while left > 0 {
        let (rig, v) = (Rig::of_cylinders(&mut random), [random.between(-0.2, 0.2), random.between(-0.2, 0.2)]);
        let [x0, y0, phi] = rig.pose;
        let moved = |t: f64| Rig { pose: [x0 + v[0] * t, y0 + v[1] * t, phi], ..rig };
        let sides: Vec<f64> = (0..=50).map(|k| moved(0.02 * f64::from(k)).relative_side()).collect();
        // Singular poses are excluded, and those in their neighbourhood.
        if sides.iter().any(|side| sides[0].signum() * side < 0.03) {
            continue;
        }
        follow(&mut tally, &Group::new(times.clone(), vec![carried(rig, v)]));
        left -= 1;
    }
    // Its rams are nearly parallel.
    let rig = Rig {
        x: [-0.1, -1.3, 1.0],
        y: [-0.6, 0.5, -1.1],
        r: [0.0; 3],
        l: [0.0; 3],
        px: [-0.2, -0.4, -0.3],
        py: [-0.5, -0.1, -0.2],
        start: [0.0; 3],
        rate: [0.0; 3],
        stroke: [0.0; 3],
        pose: [-0.3, -0.3, 2.0],
    };
    follow(&mut tally, &Group::new(times, vec![carried(rig, [-0.1, -0.1])]));
    tally.obeys("platforms that translate");
}

/// The platform returns to a pose of the other branch, which it reaches without turning much: of all steps across two
/// folds the one that is most like a motion.
#[test]
fn a_platform_that_moves_without_turning() {
    let rig = Rig {
        x: [0.16915039467031023, 1.0344267428904386, 0.5375833319132611],
        y: [0.17737964457549282, 0.09141925223404535, 0.841920099638389],
        r: [0.0; 3],
        l: [0.32383892950284004, 0.38961391150755337, 0.5545064992478134],
        px: [-0.06807160847570998, 0.09042804409798272, -0.06806964867551674],
        py: [-0.04567186986225885, 0.053028551628458986, 0.23285882324418294],
        start: [0.0; 3],
        rate: [0.0; 3],
        stroke: [0.5295689268696873, 0.8414375312911886, -0.9965750826219144],
        pose: [0.5601368615994129, 0.17125550485832503, -1.1535806143731917],
    };
    let (reach, arc) = (0.5526255561660267, rig.arc(2.5).unwrap());
    let folds = Rig::folds(&arc, reach);
    assert_eq!(2, folds.len());
    let mut tally = Tally::default();
    let case = on_cylinders(rig, arc, reach, folds);
    follow(&mut tally, &Group::new(vec![0.0, 0.9949825624169389, 1.9899651248338779], vec![case]));
    tally.obeys("platform that moves without turning");
}
