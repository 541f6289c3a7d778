//! After an error in a description everything else remains usable: the only errors are those of kin.

use kin_runtime::{Instant, Kinematics, Mechanism, Solver, mechanism};
use std::process::ExitCode;

#[mechanism(cross_check)]
#[derive(Debug, Clone, PartialEq)]
#[bodies(crank, coupler, link[2], wheel[WHEELS])]
#[coordinates(reach)]
#[revolute(C: ground @ (0, 0), crnk @ (-l1/2, 0))]
#[point(tip = coupler @ (0, 0.1), ends[i in 0..2] = link[i] @ (1, 0), torn = coupler @ (0 0))]
#[define(stroke = tip.x - reach, broken = tip.z)]
#[driver(drive: crank.phi = omega * time)]
pub struct FourBar {
    #[param(0.1, unit = "m")]
    pub l1: f64,
    #[param("1")]
    pub omega: f64,
    #[parm([0.1, 0.2])]
    pub l: [f64; 2],
    #[parameter(0.3)]
    pub l2: f64,
    #[param = 0.4]
    pub l3: f64,
}

impl FourBar {
    fn longer(&self) -> Self {
        Self { l1: 2.0 * self.l1, ..self.clone() }
    }
}

/// The bounds of the command line, which is not compiled for this test.
fn run<M: Mechanism + Default>() -> ExitCode {
    ExitCode::from(u8::from(M::COORDINATES > 0))
}

fn main() -> ExitCode {
    let four_bar = FourBar { l1: 0.2, ..Default::default() };
    assert_eq!(four_bar.longer(), FourBar::default().longer());
    let state = four_bar.state_at(&Instant::at(0.0)).unwrap();
    println!("{:?} {:?}", state.q, FourBar::model().coordinates.len());
    println!("{:?} {:?}", FourBar::crank, (FourBar::link[1], FourBar::wheel[3], FourBar::ends[0], FourBar::torn));
    println!("{:?} {:?}", (FourBar::reach, FourBar::stroke), FourBar::broken);
    println!("{:?}", Solver::new(&four_bar).position(&Instant::at(0.0), &[]).is_ok());
    println!("{:?}", four_bar.kinematic_analysis(&[0.0, 1.0]).is_ok());
    run::<FourBar>()
}
