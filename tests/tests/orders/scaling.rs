//! Exact identities: scaling of time, and agreement with γ; absence of allocations.

use allocation_counter::measure;
use kin_runtime::series::HigherOrders;
use kin_runtime::{Instant, Kinematics, LengthError, Mechanism, Options, SolveError, Solver, State, mechanism};
use kin_tests::mechanisms::{AndrewsPins, Excavator, PlanetaryBasic, SleighKnifeEdge};

/// A four-bar whose crank turns at the constant rate `omega`.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0.1), rocker @ (0, 0))]
#[driver(drive: crank.phi = 0.3 + omega * t + 0.2 * sin(omega * t))]
#[guess(coupler.phi = 0.9, rocker.phi = 2.2)]
struct FourBar {
    #[param(1.0)]
    omega: f64,
}

/// Replacing t by 2t multiplies the derivative of order k by 2^k, bit for bit.
#[test]
fn faster_time_multiplies_every_order() {
    let (slow, fast) = (FourBar { omega: 1.0 }, FourBar { omega: 2.0 });
    let state = slow.solver().state(&0.5.into()).unwrap();
    let found = slow.solver().derivatives(&state, 10).unwrap();
    let mut doubled = state.clone();
    doubled.t = 0.25;
    doubled.q_dot.iter_mut().for_each(|rate| *rate *= 2.0);
    doubled.q_ddot.iter_mut().for_each(|acceleration| *acceleration *= 4.0);
    let twice = fast.solver().derivatives(&doubled, 10).unwrap();
    for (order, (slow, fast)) in found.q.iter().zip(&twice.q).enumerate() {
        let expected: Vec<f64> = slow.iter().map(|value| value * 2.0_f64.powi(order as i32)).collect();
        assert_eq!(&expected, fast, "{order}");
    }
    assert!(found.q[10].iter().any(|value| *value != 0.0));
}

/// At the lowest order the right-hand side of the recursion is γ: with t³ in place of t, the third derivative at t = 0
/// is 6 q̇.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0.1), rocker @ (0, 0))]
#[driver(drive: crank.phi = 0.3 + 1.7 * pow(t, 3))]
#[guess(coupler.phi = 0.9, rocker.phi = 2.2)]
struct Cubed;

/// The same four-bar driven by t instead of t³.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(C: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0.1), rocker @ (0, 0))]
#[driver(drive: crank.phi = 0.3 + 1.7 * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 2.2)]
struct Uniform;

/// With τ³ in place of t, the derivative of order 3k is (3k)!/k! times that of order k for the other: the orders 3, 6,
/// 9 reproduce q̇, q̈, q⃛.
#[test]
fn low_orders_come_back_as_high_ones() {
    let uniform = Uniform.solver();
    let state = uniform.state(&0.0.into()).unwrap();
    let low = uniform.derivatives(&state, 3).unwrap();
    let cubed = Cubed.solver();
    let high = cubed.derivatives(&cubed.state(&0.0.into()).unwrap(), 9).unwrap();
    for (k, factor) in [(1, 6.0), (2, 360.0), (3, 60480.0)] {
        for (low, high) in low.q[k].iter().zip(&high.q[3 * k]) {
            assert!((factor * low - high).abs() <= 1e-13 * factor * (1.0 + low.abs()), "{k}: {low} {high}");
        }
    }
    for (order, derivative) in high.q.iter().enumerate().filter(|(order, _)| order % 3 != 0) {
        assert!(derivative.iter().all(|value| value.abs() < 1e-9), "{order}: {derivative:?}");
    }
}

fn allocates_nothing<M: Kinematics + Default>() {
    let mechanism = M::default();
    let states = [0.2, 0.5, 0.9].map(|t| mechanism.state_at(&t.into()).unwrap());
    let mut orders = HigherOrders::new(&mechanism, 8);
    let mut run = |t: f64, known: [&[f64]; 3]| {
        orders.begin(&Instant::at(t), known[0], known[1], known[2]).unwrap();
        while orders.order() < 8 {
            orders.advance(known[1]).unwrap();
        }
        assert!(orders.right().iter().all(|b| b.is_finite()));
    };
    run(states[0].t, [&states[0].q, &states[0].q_dot, &states[0].q_ddot]);
    let counted = measure(|| {
        for state in &states {
            run(state.t, [&state.q, &state.q_dot, &state.q_ddot]);
        }
    });
    assert_eq!(0, counted.count_total, "{}", M::model().name);
}

#[test]
fn instants_after_the_first_allocate_nothing() {
    allocates_nothing::<FourBar>();
    allocates_nothing::<Excavator>();
    allocates_nothing::<SleighKnifeEdge>();
}

/// All orders from the dense factorisation of Φ_q.
fn densely<M: Mechanism>(mechanism: &M, state: &State, order: usize) -> Vec<Vec<f64>> {
    let options = Options { use_plan: false, ..Options::default() };
    let found = Solver::new(mechanism).with_options(options).derivatives(state, order).unwrap();
    assert!(!found.by_plan);
    found.q
}

/// All orders from the factors of the plan's blocks, against those from the dense factorisation; nothing is allocated.
fn plan_gives_the_same<M: Kinematics + Default>() {
    let mechanism = M::default();
    let mut orders = HigherOrders::new(&mechanism, 10);
    let mut x = vec![0.0; M::COORDINATES];
    for (number, t) in [0.2, 0.5, 0.9].into_iter().enumerate() {
        let state = mechanism.state_at(&t.into()).unwrap();
        let expected = densely(&mechanism, &state, 10);
        let by_plan = mechanism.derivatives(&state, 10).unwrap();
        assert!(by_plan.by_plan);
        let counted = measure(|| {
            let at = Instant::at(t);
            orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
            assert!(orders.factorise(&at).unwrap());
            for (expected, by_plan) in expected[3..].iter().zip(&by_plan.q[3..]) {
                orders.solve(&mut x).unwrap();
                let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
                let off = x.iter().zip(expected).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                assert!(off <= 1e-11 * size, "{}, order {}: {off:e} of {size:e}", M::model().name, orders.order());
                let off = by_plan.iter().zip(expected).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                assert!(off <= 1e-11 * size, "{}, order {}: {off:e} of {size:e}", M::model().name, orders.order());
                orders.advance(&x).unwrap();
            }
        });
        assert!(number == 0 || counted.count_total == 0, "{}: {counted:?}", M::model().name);
    }
    assert!(orders.solve(&mut x[1..]).is_err());
}

/// All orders by the plan in one pass, against those from the dense factorisation.
fn plan_gives_all_at_once<M: Kinematics + Default>() {
    let mechanism = M::default();
    for highest in [3, 4, 5, 7, 10] {
        for t in [0.2, 0.5, 0.9] {
            let state = mechanism.state_at(&t.into()).unwrap();
            let expected = densely(&mechanism, &state, highest);
            let found = mechanism.derivatives(&state, highest).unwrap();
            assert!(found.by_plan && found.order() == highest);
            for (order, (found, expected)) in found.q.iter().zip(&expected).enumerate() {
                let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
                let off = found.iter().zip(expected).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                assert!(off <= 1e-11 * size, "{}, order {order}: {off:e} of {size:e}", M::model().name);
            }
        }
    }
}

#[test]
fn the_plan_gives_all_orders_at_once() {
    plan_gives_all_at_once::<FourBar>();
    plan_gives_all_at_once::<Excavator>();
    plan_gives_all_at_once::<AndrewsPins>();
    plan_gives_all_at_once::<PlanetaryBasic>();
}

#[test]
fn the_plan_solves_every_order() {
    plan_gives_the_same::<FourBar>();
    plan_gives_the_same::<Excavator>();
}

/// Where coupler and rocker are collinear, the plan's block is singular, and so is Φ_q: no derivative is finite.
#[test]
fn singular_blocks_are_seen() {
    let four_bar = FourBar::default();
    let mut state = four_bar.state_at(&0.2.into()).unwrap();
    let mut orders = HigherOrders::new(&four_bar, 4);
    let at = Instant::at(state.t);
    for (apart, good) in [(0.0, false), (1e-7, false), (1e-3, true), (std::f64::consts::PI, false)] {
        state.q[8] = state.q[5] + apart;
        orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
        assert_eq!(good, orders.factorise(&at).unwrap(), "{apart}");
        match four_bar.solver().derivatives(&state, 4) {
            Ok(found) => assert!(good && found.by_plan, "{apart}"),
            Err(error) => assert!(!good && matches!(error, SolveError::Singular { .. }), "{apart}: {error}"),
        }
    }
}

/// Without a plan, `factorise` and `solve` return no solution.
#[test]
fn without_a_plan_nothing_is_solved() {
    let sleigh = SleighKnifeEdge::default();
    let state = sleigh.state_at(&0.2.into()).unwrap();
    let mut orders = HigherOrders::new(&sleigh, 3);
    let at = Instant::at(state.t);
    orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
    assert!(!orders.factorise(&at).unwrap());
}

/// A right-hand side exists only after the solution of the order before was given, and lengths of slices are checked.
#[test]
fn orders_go_one_by_one() {
    let four_bar = FourBar::default();
    let state = four_bar.state_at(&0.1.into()).unwrap();
    let mut orders = HigherOrders::new(&four_bar, 4);
    let at = Instant::at(state.t);
    orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
    assert_eq!((3, FourBar::ROWS), (orders.order(), orders.right().len()));
    assert!(orders.advance(&[0.0]).is_err());
    assert!(orders.begin(&at, &state.q, &[], &state.q_ddot).is_err());
    orders.begin(&at, &state.q, &state.q_dot, &state.q_ddot).unwrap();
    orders.advance(&state.q_dot).unwrap();
    assert_eq!((4, FourBar::ROWS), (orders.order(), orders.right().len()));
    // Four was the highest order: there is no right-hand side of order five, and the one of order four is gone.
    assert!(orders.factorise(&at).unwrap());
    let mut untouched = vec![7.0; FourBar::COORDINATES];
    for _ in 0..2 {
        orders.advance(&state.q_dot).unwrap();
        assert_eq!((0, &[][..]), (orders.order(), orders.right()));
        let none = LengthError { what: "b", expected: FourBar::ROWS, found: 0 };
        assert_eq!(Err(none), orders.solve(&mut untouched));
    }
    assert_eq!(vec![7.0; FourBar::COORDINATES], untouched);
}

/// If the highest order given is 3 or less, the third order is the last.
#[test]
fn the_third_order_may_be_the_last() {
    let four_bar = FourBar::default();
    let state = four_bar.state_at(&0.1.into()).unwrap();
    for highest in [0, 2, 3] {
        let mut orders = HigherOrders::new(&four_bar, highest);
        orders.begin(&Instant::at(state.t), &state.q, &state.q_dot, &state.q_ddot).unwrap();
        assert_eq!((3, FourBar::ROWS), (orders.order(), orders.right().len()));
        orders.advance(&state.q_dot).unwrap();
        assert_eq!((0, &[][..]), (orders.order(), orders.right()), "{highest}");
    }
}
