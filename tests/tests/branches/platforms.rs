//! Platforms with three driven cranks that are moved to a singular pose and back: slightly less far, or slightly
//! farther. There is no closed form, so the reference is an arc-length continuation in this test.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::rig::Rig;
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

pub(crate) fn case(random: &mut Random) -> Case<Platform> {
    loop {
        let rig = Rig::drawn(random);
        let Some(arc) = rig.arc(2.5) else { continue };
        let reach = match arc.fold {
            // A fold at the start is excluded.
            Some(fold) if fold < 0.1 => continue,
            Some(fold) if random.chance(0.7) => fold * (1.0 + random.small(-10.0, -2.0)),
            Some(fold) => fold * random.between(0.9, 1.6),
            None => random.between(1.0, 2.4),
        };
        let fold = arc.fold.filter(|fold| *fold < reach).map(|fold| (fold / reach).asin());
        let folds = fold.map_or(vec![], |t| vec![t, std::f64::consts::PI - t]);
        let Rig { x, y, r, l, px, py, start, rate, pose } = rig;
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
        return Case::new(mechanism, branch, [folds, vec![]], format!("pose {pose:?}"));
    }
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
