//! The test mechanisms, one per file. A new mechanism needs a line here and one in
//! [`every_mechanism`](crate::every_mechanism); every law then tests it.

mod andrews_cartesian;
mod andrews_pins;
mod belt_drive;
mod bogie_on_rail;
mod cam_ellipse_implicit;
mod cam_oscillating_follower;
mod cam_table;
mod cams_on_carriage;
mod cardan_circles;
mod chain10;
mod dwell_press;
mod eccentric_flat_oscillating;
mod eccentric_flat_translating;
mod eccentric_roller;
mod elliptic_roller;
mod elliptic_trammel;
mod excavator;
mod five_bar_leg;
mod fourbar_ends;
mod fourbar_lecture_angles;
mod fourbar_lecture_mid;
mod fourbar_relative;
mod gear_train;
mod geared_fivebar;
mod infeasible_fourbar;
mod klann_leg;
pub mod loaded;
mod macpherson_strut;
mod marghitu_six_link;
mod measured_excavator;
mod nikravesh_fourbar;
mod ondsel_fourbar;
mod peaucellier;
mod planetary_basic;
mod planetary_two_stage;
mod profile_slider;
mod quick_return;
mod rack_pinion_slider;
mod rate_driven_slider_crank;
mod rate_table;
mod redundant_parallelogram;
mod robot_3rrr;
mod rolling_incline;
mod rope_crane;
mod scotch_yoke;
mod screw_beam;
mod signal_table;
mod singular_slider_crank;
mod sleigh_knife_edge;
mod slider_crank_inline;
mod steered_car;
mod stroke_limits;
mod toggle_press;
mod truck_with_trailers;
mod underdriven_fivebar;
mod watt_sixbar;
mod welded_pendulums;
mod wheel_by_rates;

pub use andrews_cartesian::AndrewsCartesian;
pub use andrews_pins::AndrewsPins;
pub use belt_drive::BeltDrive;
pub use bogie_on_rail::BogieOnRail;
pub use cam_ellipse_implicit::CamEllipseImplicit;
pub use cam_oscillating_follower::CamOscillatingFollower;
pub use cam_table::CamTable;
pub use cams_on_carriage::CamsOnCarriage;
pub use cardan_circles::CardanCircles;
pub use chain10::Chain10;
pub use dwell_press::DwellPress;
pub use eccentric_flat_oscillating::EccentricFlatOscillating;
pub use eccentric_flat_translating::EccentricFlatTranslating;
pub use eccentric_roller::{EccentricRollerImplicit, EccentricRollerParametric, EccentricRollerPolar};
pub use elliptic_roller::{EllipticPath, EllipticRoller};
pub use elliptic_trammel::EllipticTrammel;
pub use excavator::Excavator;
pub use five_bar_leg::{DrivenLeg, FiveBarLeg};
pub use fourbar_ends::FourbarEnds;
pub use fourbar_lecture_angles::FourbarLectureAngles;
pub use fourbar_lecture_mid::FourbarLectureMid;
pub use fourbar_relative::FourbarRelative;
pub use gear_train::GearTrain;
pub use geared_fivebar::GearedFivebar;
pub use infeasible_fourbar::InfeasibleFourbar;
pub use klann_leg::KlannLeg;
pub use macpherson_strut::MacphersonStrut;
pub use marghitu_six_link::MarghituSixLink;
pub use measured_excavator::MeasuredExcavator;
pub use nikravesh_fourbar::NikraveshFourbar;
pub use ondsel_fourbar::OndselFourbar;
pub use peaucellier::Peaucellier;
pub use planetary_basic::PlanetaryBasic;
pub use planetary_two_stage::PlanetaryTwoStage;
pub use profile_slider::{Bell, ProfileSlider};
pub use quick_return::QuickReturn;
pub use rack_pinion_slider::RackPinionSlider;
pub use rate_driven_slider_crank::RateDrivenSliderCrank;
pub use rate_table::RateTable;
pub use redundant_parallelogram::RedundantParallelogram;
pub use robot_3rrr::Robot3rrr;
pub use rolling_incline::RollingIncline;
pub use rope_crane::RopeCrane;
pub use scotch_yoke::ScotchYoke;
pub use screw_beam::ScrewBeam;
pub use signal_table::SignalTable;
pub use singular_slider_crank::SingularSliderCrank;
pub use sleigh_knife_edge::SleighKnifeEdge;
pub use slider_crank_inline::SliderCrankInline;
pub use steered_car::SteeredCar;
pub use stroke_limits::StrokeLimits;
pub use toggle_press::TogglePress;
pub use truck_with_trailers::TruckWithTrailers;
pub use underdriven_fivebar::UnderdrivenFivebar;
pub use watt_sixbar::WattSixbar;
pub use welded_pendulums::WeldedPendulums;
pub use wheel_by_rates::WheelByRates;

use kin_runtime::model::Model;
use kin_runtime::{Mechanism, Signal};

/// The inputs of a test mechanism at time t, which are smooth over its interval; empty for a mechanism without inputs.
#[must_use]
pub fn signals<M: Mechanism>(t: f64) -> Vec<Signal> {
    signals_of(M::model(), t)
}

fn signals_of(model: &Model, t: f64) -> Vec<Signal> {
    match model.name {
        "FiveBarLeg" => five_bar_leg::signals(t).to_vec(),
        "MeasuredExcavator" => measured_excavator::signals(t).to_vec(),
        "RateTable" => rate_table::signals(t).to_vec(),
        "SignalTable" => signal_table::signals(t).to_vec(),
        _ => (0..model.inputs.len()).map(|k| wave(k, t)).collect(),
    }
}

/// An input, given its index, for a mechanism that does not define its own.
fn wave(place: usize, t: f64) -> Signal {
    let (base, (sin, cos)) = (1.0 + 0.2 * place as f64, (1.3 * t).sin_cos());
    Signal::new(base + 0.1 * sin, 0.13 * cos, -0.169 * sin)
}

/// [`signals`] in the form that `Solver::with_inputs` takes.
pub fn write_signals<M: Mechanism>(t: f64, inputs: &mut [Signal]) {
    inputs.copy_from_slice(&signals::<M>(t));
}

/// Calls the macro `$law` with every test mechanism: a name for its tests, its type, and an interval of time in which
/// it moves. Mechanisms without an interval never assemble.
#[macro_export]
macro_rules! every_mechanism {
    ($law:ident) => {
        $law! {
            moving {
                andrews_cartesian: AndrewsCartesian, 0.0, 0.027;
                andrews_pins: AndrewsPins, 0.0, 0.02;
                bogie_on_rail: BogieOnRail, 0.0, 1.9;
                cam_ellipse_implicit: CamEllipseImplicit, 0.0, 1.9;
                cam_oscillating_follower: CamOscillatingFollower, 0.0, 1.9;
                cam_table: CamTable, 0.0, 2.0;
                cams_on_carriage: CamsOnCarriage, 0.0, 1.9;
                belt_drive: BeltDrive, 0.0, 1.9;
                cardan_circles: CardanCircles, 0.0, 1.9;
                chain10: Chain10, 0.0, 1.9;
                dwell_press: DwellPress, 0.0, 2.0;
                eccentric_flat_oscillating: EccentricFlatOscillating, 0.0, 1.9;
                eccentric_flat_translating: EccentricFlatTranslating, 0.0, 1.9;
                eccentric_roller_implicit: EccentricRollerImplicit, 0.0, 1.9;
                eccentric_roller_parametric: EccentricRollerParametric, 0.0, 1.9;
                eccentric_roller_polar: EccentricRollerPolar, 0.0, 1.9;
                elliptic_path: EllipticPath, 0.0, 1.9;
                elliptic_roller: EllipticRoller, 0.0, 1.9;
                elliptic_trammel: EllipticTrammel, 0.0, 1.9;
                excavator: Excavator, 0.0, 1.9;
                driven_leg: DrivenLeg, 0.0, 1.9;
                five_bar_leg: FiveBarLeg, 0.0, 1.9;
                fourbar_ends: FourbarEnds, 0.0, 2.6;
                fourbar_lecture_angles: FourbarLectureAngles, 0.0, 2.6;
                fourbar_lecture_mid: FourbarLectureMid, 0.0, 2.6;
                fourbar_relative: FourbarRelative, 0.0, 2.6;
                gear_train: GearTrain, 0.0, 1.9;
                geared_fivebar: GearedFivebar, 0.0, 1.9;
                klann_leg: KlannLeg, 0.0, 3.1;
                macpherson_strut: MacphersonStrut, 0.0, 1.9;
                marghitu_six_link: MarghituSixLink, 0.0, 0.08;
                measured_excavator: MeasuredExcavator, 0.0, 1.9;
                nikravesh_fourbar: NikraveshFourbar, 0.0, 0.9;
                ondsel_fourbar: OndselFourbar, 0.0, 0.9;
                peaucellier: Peaucellier, 0.0, 1.9;
                profile_slider: ProfileSlider, 0.0, 1.9;
                planetary_basic: PlanetaryBasic, 0.0, 1.9;
                planetary_two_stage: PlanetaryTwoStage, 0.0, 1.9;
                quick_return: QuickReturn, 0.0, 1.9;
                rate_driven_slider_crank: RateDrivenSliderCrank, 0.0, 1.9;
                rack_pinion_slider: RackPinionSlider, 0.0, 1.9;
                redundant_parallelogram: RedundantParallelogram, 0.0, 1.6;
                robot_3rrr: Robot3rrr, 0.0, 1.5;
                wheel_by_rates: WheelByRates, 0.0, 1.7;
                rate_table: RateTable, 0.0, 1.9;
                rolling_incline: RollingIncline, 0.0, 1.9;
                rope_crane: RopeCrane, 0.0, 1.9;
                scotch_yoke: ScotchYoke, 0.0, 1.9;
                screw_beam: ScrewBeam, 0.0, 1.9;
                signal_table: SignalTable, 0.0, 1.9;
                singular_slider_crank: SingularSliderCrank, 0.0, 0.44;
                sleigh_knife_edge: SleighKnifeEdge, 0.0, 1.9;
                slider_crank_inline: SliderCrankInline, 0.0, 1.9;
                steered_car: SteeredCar, 0.0, 1.9;
                stroke_limits: StrokeLimits, 0.0, 1.9;
                toggle_press: TogglePress, 0.0, 1.27;
                truck_with_trailers: TruckWithTrailers, 0.0, 1.9;
                underdriven_fivebar: UnderdrivenFivebar, 0.0, 1.3;
                watt_sixbar: WattSixbar, 0.0, 1.9;
                welded_pendulums: WeldedPendulums, 0.0, 1.9;
            }
            unassembled {
                infeasible_fourbar: InfeasibleFourbar;
            }
        }
    };
}
