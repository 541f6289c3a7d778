//! Linkages with random dimensions: they are assembled exactly if their geometry allows it, and the result of a sweep
//! does not depend on the spacing of its instants.

use kin_runtime::{Instant, Kinematics, SolveError, mechanism};
use kin_tests::random::Random;

#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = start + t + 0.5 * sin(3 * t))]
struct FourBar {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    start: f64,
}

impl FourBar {
    fn random(random: &mut Random) -> Self {
        let mut length = || random.between(0.1, 1.5);
        Self { a: length(), b: length(), c: length(), d: length(), start: random.between(-3.0, 3.0) }
    }

    /// How far the two-link chain between the end of the crank and the fixed pin is from its limits; negative beyond
    /// them.
    fn margin(&self) -> f64 {
        let (x, y) = (self.a * self.start.cos() - self.d, self.a * self.start.sin());
        let distance = x.hypot(y);
        (self.b + self.c - distance).min(distance - (self.b - self.c).abs())
    }
}

#[mechanism]
#[bodies(crank, block, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), block @ (0, 0))]
#[translational(slot: rocker @ (0, offset), block @ (0, 0), axis = (1, lean))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = start + t)]
struct SlottedRocker {
    a: f64,
    d: f64,
    offset: f64,
    lean: f64,
    start: f64,
}

impl SlottedRocker {
    fn random(random: &mut Random) -> Self {
        Self {
            a: random.between(0.1, 1.5),
            d: random.between(0.1, 1.5),
            offset: random.between(-1.5, 1.5),
            lean: random.between(-1.0, 1.0),
            start: random.between(-3.0, 3.0),
        }
    }

    /// How much farther the end of the crank is from the rocker's pivot than the slot's line is.
    fn margin(&self) -> f64 {
        let (x, y) = (self.a * self.start.cos() - self.d, self.a * self.start.sin());
        x.hypot(y) - self.offset.abs() / self.lean.hypot(1.0)
    }
}

/// Position analysis without a guess and from a random start succeeds exactly if `margin` is positive.
fn assembles_when_it_can<M: Kinematics>(mechanism: &M, margin: f64, random: &mut Random) {
    if margin.abs() < 1e-3 {
        return;
    }
    let (at, solver) = (Instant::at(0.0), mechanism.solver());
    let start = random.vector(M::COORDINATES, -2.0, 2.0);
    for answer in [solver.assemble(&at), solver.position(&at, &start).map(|position| position.q)] {
        match (margin > 0.0, answer) {
            (true, Ok(_)) | (false, Err(SolveError::NotAssembled { .. })) => {}
            (_, answer) => panic!("margin {margin}, from {start:?}: {answer:?}"),
        }
    }
}

#[test]
fn linkages_assemble_exactly_when_they_can() {
    let mut random = Random::new(41);
    for _ in 0..60 {
        let four_bar = FourBar::random(&mut random);
        assembles_when_it_can(&four_bar, four_bar.margin(), &mut random);
        let slotted = SlottedRocker::random(&mut random);
        assembles_when_it_can(&slotted, slotted.margin(), &mut random);
    }
}

/// A sweep in one step and one in a hundred steps end in the same state, or both end with an error where the branch
/// ends.
fn ends_alike<M: Kinematics>(mechanism: &M, random: &mut Random) -> Option<bool> {
    let solver = mechanism.solver();
    let start = solver.assemble(&Instant::at(0.0)).ok()?;
    let end = random.between(-6.0, 6.0);
    let close: Vec<f64> = (0..=100).map(|k| end * f64::from(k) / 100.0).collect();
    match (solver.sweep_from(&start, &[0.0, end]), solver.sweep_from(&start, &close)) {
        (Ok(far), Ok(close)) => {
            let gap = far.states[1].q.iter().zip(&close.states[100].q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(gap < 1e-9, "until {end} from {start:?}: {gap}");
            Some(true)
        }
        (Err(far), Err(close)) => {
            for error in [far, close] {
                let known = matches!(error.source, SolveError::Singular { .. } | SolveError::StepRefused { .. });
                assert!(known, "until {end} from {start:?}: {error}");
            }
            Some(false)
        }
        (far, close) => panic!("until {end} from {start:?}: {:?} and {:?}", far.map(|_| ()), close.map(|_| ())),
    }
}

#[test]
fn sweeps_of_linkages_follow_one_branch() {
    let mut random = Random::new(43);
    let mut endings = Vec::new();
    for _ in 0..20 {
        endings.extend(ends_alike(&FourBar::random(&mut random), &mut random));
        endings.extend(ends_alike(&SlottedRocker::random(&mut random), &mut random));
    }
    let arrived = endings.iter().filter(|arrived| **arrived).count();
    assert!(arrived >= 10 && endings.len() - arrived >= 3, "{arrived} of {} arrived", endings.len());
}

/// The crank of a double rocker cannot turn fully: a sweep to an instant beyond the gap, where the linkage could be
/// assembled again, is an error.
#[test]
fn no_sweep_jumps_a_gap() {
    let rocker = FourBar { a: 1.0, b: 0.6, c: 0.8, d: 1.2, start: 0.6 };
    let turn = std::f64::consts::TAU;
    for end in [turn, -turn, 10.0 * turn] {
        let error = rocker.kinematic_analysis(&[0.0, end]).unwrap_err();
        let SolveError::Singular { t, rank: 8, expected_rank: 9, .. } = error.source else { panic!("{error}") };
        assert!(t * end > 0.0 && t.abs() < turn, "{error}");
        assert_eq!(1, error.trajectory.len());
    }
}

/// In its stretched configuration, the motions of a parallelogram and of the crossed four-bar branch: a sweep ends
/// there with an error instead of choosing one.
#[test]
fn no_sweep_chooses_at_a_change_point() {
    let parallelogram = FourBar { a: 0.3, b: 0.7, c: 0.3, d: 0.7, start: 0.6 };
    let start = [0.0, 0.0, 0.6, 0.25, 0.17, 0.0, 0.7, 0.0, 0.6];
    let before = parallelogram.solver().sweep_from(&start, &[0.0, -0.2]).unwrap();
    let q = &before.states[1].q;
    assert!(q[5].abs() < 1e-12 && (q[2] - q[8]).abs() < 1e-12, "{q:?}");
    for times in [&[0.0, -0.8][..], &[0.0, -0.2, -0.8], &[0.0, 3.0]] {
        let error = parallelogram.solver().sweep_from(&start, times).unwrap_err();
        assert!(matches!(error.source, SolveError::Singular { .. }), "{error}");
    }
}
