//! Groups solved by iteration from starts that are far from the solution: branch and orientation are taken from the
//! solution, not from the start.

use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Mechanism, Planned, mechanism};

/// A platform on three driven cranks: its plan has an iteration.
#[mechanism]
#[bodies(crank[3], link[3], platform)]
#[revolute(O0: ground @ (0, 0), crank[0] @ (0, 0))]
#[revolute(O1: ground @ (1, 0), crank[1] @ (0, 0))]
#[revolute(O2: ground @ (0.5, 0.9), crank[2] @ (0, 0))]
#[revolute(A[i in 0..3]: crank[i] @ (0.3, 0), link[i] @ (0, 0))]
#[revolute(B0: link[0] @ (0.4, 0), platform @ (-0.12, -0.1))]
#[revolute(B1: link[1] @ (0.4, 0), platform @ (0.12, -0.1))]
#[revolute(B2: link[2] @ (0.4, 0), platform @ (0, 0.13))]
#[driver(d0: crank[0].phi = 0.8 + 0.5 * sin(t))]
#[driver(d1: crank[1].phi = 2.6 + 0.5 * sin(t + 1))]
#[driver(d2: crank[2].phi = 4.6 + 0.5 * sin(t + 2))]
#[guess(platform.x = 0.5, platform.y = 0.33, platform.phi = 0)]
struct Platform;

/// The first instants of a motion, before any limit.
const TIMES: [f64; 4] = [0.0, 0.001, 0.002, 0.003];

/// The instant at which a motion in a batch ends, if it does, and its last state, if it begins at q.
fn in_a_batch(q: &[f64]) -> (Option<usize>, Vec<f64>) {
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let sweeps = Sweeps { parameters: &[], times: &TIMES, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(1, Vec::new());
    sweep(&Platform, &sweeps, &mut out, &always, |seen: &mut Vec<f64>, moment| {
        *seen = moment.q.iter().map(|x| x.to_array()[0]).collect();
    })
    .unwrap();
    (out.ends().next().flatten().map(|end| end.instant), out.blocks().next().unwrap().clone())
}

#[test]
fn a_motion_goes_on_from_wherever_its_iteration_has_ended() {
    let q = Platform.solver().assemble(&Instant::at(0.0)).unwrap();
    let place = |name: &str| Platform::model().coordinates.iter().position(|c| c.name == name).expect("a coordinate");
    let (x, y, phi) = (place("platform.x"), place("platform.y"), place("platform.phi"));
    let (mut begun, mut elsewhere) = (0, 0);
    for k in 0..400 {
        let mut start = q.clone();
        start[phi] += 0.02 * f64::from(k % 40 - 20) * f64::from(1 + k % 7);
        start[x] += 0.05 * f64::from(k % 11 - 5);
        start[y] += 0.05 * f64::from(k % 13 - 6);
        let at = |t: f64| Instant::at(t);
        let Ok(mut planned) = Planned::new(&Platform, &at(0.0), &start) else { continue };
        // Configurations close to a limit are skipped.
        if planned.margins().iter().any(|margin| *margin < 0.05) {
            continue;
        }
        begun += 1;
        let first = planned.q()[phi];
        elsewhere += usize::from((first - q[phi]).abs() > 0.1);
        for &t in &TIMES[1..] {
            planned.at(&at(t)).unwrap_or_else(|error| panic!("start number {k}: {error}"));
        }
        assert!((planned.q()[phi] - first).abs() < 0.05, "start number {k}");
        let last_angle = planned.q()[phi];
        for _ in 0..2 {
            planned.restart(&at(0.0), &start).unwrap();
            assert!((planned.q()[phi] - first).abs() < 1e-9, "start number {k}");
        }
        let (end, last) = in_a_batch(&start);
        assert_eq!(None, end, "start number {k}");
        assert!((last[phi] - last_angle).abs() < 1e-9, "start number {k}");
    }
    assert!(begun > 100 && elsewhere > 10, "{begun} begin, {elsewhere} of them elsewhere");
}
